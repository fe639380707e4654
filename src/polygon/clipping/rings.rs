//! From borders to polygons: simple rings, each hole with its outline.

use super::borders::{Border, Borders, Flank, NO_BORDER};
use super::sweep::Edge;
use super::{Corner, Polygon, Ring};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Chart, ImageLine, ImagePoint, Policy, Predicates};
use std::collections::BTreeMap;

/// A simple ring, the first of its points first.
struct Loop {
    /// The flanks that leave its corners.
    flanks: Vec<Flank>,
    label: u32,
    /// The connected area on its left.
    area: u32,
    is_outline: bool,
}

/// Makes polygons of borders, for each label in ascending order.
pub(super) fn polygons<P: Policy>(
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    edges: &[Edge],
    borders: &mut Borders,
    keep_collinear: bool,
) -> BTreeMap<u32, Vec<Polygon>> {
    let mut builder = Builder { predicates, chart, edges, borders, keep_collinear };
    let mut loops = builder.loops();
    // Outlines before holes, each by their points, which are numbered in the
    // order of the sweep: whatever order edges were given in.
    loops.sort_by_cached_key(|ring| {
        let points: Vec<u32> = ring.flanks.iter().map(|&flank| builder.start(flank)).collect();
        (ring.label, !ring.is_outline, points)
    });
    let mut outline_of = rustc_hash::FxHashMap::default();
    let mut polygons: BTreeMap<u32, Vec<Polygon>> = BTreeMap::new();
    for ring in &loops {
        let corners = builder.corners(&ring.flanks);
        let list = polygons.entry(ring.label).or_default();
        if ring.is_outline {
            outline_of.insert(ring.area, list.len());
            list.push(Polygon { rings: vec![corners] });
        } else if let Some(&outline) = outline_of.get(&ring.area) {
            list[outline].rings.push(corners);
        } else {
            debug_assert!(false, "a hole without an outline");
        }
    }
    polygons
}

struct Builder<'a, 'p, P: Policy> {
    predicates: &'a Predicates<'p, P>,
    chart: &'a Chart,
    edges: &'a [Edge],
    borders: &'a mut Borders,
    keep_collinear: bool,
}

impl<P: Policy> Builder<'_, '_, P> {
    fn start(&self, flank: Flank) -> u32 {
        self.borders.border(flank).start(flank)
    }

    /// All simple rings. Where a ring of flanks comes to a point twice, it
    /// is cut in two there.
    fn loops(&mut self) -> Vec<Loop> {
        let mut done = vec![false; self.borders.next.len()];
        let mut place = vec![NO_BORDER; self.borders.points.len()];
        let (mut loops, mut path) = (Vec::new(), Vec::new());
        for first in 0..done.len() as Flank {
            let wanted = self.borders.border(first).label(first) != 0;
            if done[first as usize] || !wanted {
                continue;
            }
            let mut flank = first;
            loop {
                let start = self.start(flank) as usize;
                if place[start] != NO_BORDER {
                    let ring = path.split_off(place[start] as usize);
                    loops.push(self.close(ring, &mut place));
                }
                if done[flank as usize] {
                    break;
                }
                done[flank as usize] = true;
                place[start] = path.len() as u32;
                path.push(flank);
                flank = self.borders.next[flank as usize];
            }
        }
        loops
    }

    /// Makes a ring of its flanks.
    fn close(&mut self, mut flanks: Vec<Flank>, place: &mut [u32]) -> Loop {
        for &flank in &flanks {
            place[self.start(flank) as usize] = NO_BORDER;
        }
        let first = (0..flanks.len()).min_by_key(|&i| self.start(flanks[i])).unwrap_or(0);
        flanks.rotate_left(first);
        // Both lines at the first point leave it to the right.
        let (out, back) = (flanks[0], flanks[flanks.len() - 1]);
        let bend = self.predicates.bend(self.chart, self.line(out), self.line(back));
        let border: Border = *self.borders.border(out);
        let mut before = back;
        flanks.retain(|&flank| {
            let is_corner = self.is_corner(before, flank);
            before = flank;
            is_corner
        });
        Loop {
            label: border.label(out),
            area: self.borders.find(border.face(out)),
            is_outline: bend == Sign::Positive,
            flanks,
        }
    }

    /// The line of a flank, directed with the sweep.
    fn line(&self, flank: Flank) -> ImageLine {
        self.edges[self.borders.border(flank).edge as usize].line
    }

    fn corners(&self, flanks: &[Flank]) -> Ring {
        let corner = |&flank: &Flank| {
            let line = self.line(flank);
            Corner {
                point: self.point(flank),
                line: if flank & 1 == 0 { line } else { line.reversed() },
            }
        };
        flanks.iter().map(corner).collect()
    }

    fn point(&self, flank: Flank) -> ImagePoint {
        self.borders.points[self.start(flank) as usize]
    }

    /// Whether the direction changes between two flanks, or the point
    /// between them is to be kept anyway.
    fn is_corner(&self, before: Flank, after: Flank) -> bool {
        if self.keep_collinear && matches!(self.point(after), ImagePoint::Vertex(_)) {
            return true;
        }
        !self.predicates.bend(self.chart, self.line(before), self.line(after)).is_zero()
    }
}
