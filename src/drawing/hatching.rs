//! Hatching: parallel lines, clipped to what is seen of a surface.
//!
//! Lines of a hatch are numbered: line k runs at k times the spacing beside
//! a fixed point of the page, or of the object. So they go on from one region
//! of a face to the next, and from face to face, and where two tones meet
//! the lines of the lighter one are lines of the darker one too: light tones
//! take every fourth or every second line, dark ones all, the darkest lines
//! in both directions.
//!
//! A line is two points far outside of the page. On which side of it a corner
//! lies is decided exactly, so it enters and leaves an area as often as it
//! should, whatever corners it passes; each end is then moved out bit by bit
//! until it is not inside any more, so that no line ends before the border.

use super::surfaces::Light;
use super::{DrawingError, Length, Strokes};
use crate::run::map_chunks;
use crate::view::{ImageRegion, ImageRegions};
use glam::DVec2;
use robust::{Coord, orient2d};
use std::str::FromStr;

/// What decides how dense a hatch is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HatchTone {
    /// The same everywhere.
    Flat,
    /// The darker, the denser.
    #[default]
    Shade,
}

/// Reads `flat`, `shade`.
impl FromStr for HatchTone {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        match text {
            "flat" => Ok(HatchTone::Flat),
            "shade" => Ok(HatchTone::Shade),
            _ => Err(DrawingError::Choice { word: text.to_owned(), expected: "flat or shade" }),
        }
    }
}

/// Where the lines of a hatch begin to be counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HatchAnchor {
    /// At the upper left corner of the page.
    #[default]
    Page,
    /// At the first vertex of each object: its hatch moves with it.
    Object,
}

/// Reads `page`, `object`.
impl FromStr for HatchAnchor {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        match text {
            "page" => Ok(HatchAnchor::Page),
            "object" => Ok(HatchAnchor::Object),
            _ => Err(DrawingError::Choice { word: text.to_owned(), expected: "page or object" }),
        }
    }
}

/// How surfaces are hatched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hatch {
    /// What decides how dense it is.
    pub tone: HatchTone,
    /// From line to line where it is densest, or everywhere if it is flat.
    pub spacing: Length,
    /// Which way the lines rise, degrees counterclockwise.
    pub degrees: f64,
    /// Where lines are counted from.
    pub anchor: HatchAnchor,
}

impl Default for Hatch {
    /// By shade, 1 mm, rising at 45 degrees, anchored to the page.
    fn default() -> Self {
        Hatch {
            tone: HatchTone::Shade,
            spacing: Length::from_millimetres(1.0),
            degrees: 45.0,
            anchor: HatchAnchor::Page,
        }
    }
}

/// The finest hatch that is drawn, mm: below it paper is plain black.
const FINEST: f64 = 0.02;

/// Ends nearer to one another than this, mm, are one: corners are rounded.
const SAME: f64 = 1e-6;

/// Regions per task.
const PART: usize = 256;

/// Which line: the direction, the object it is anchored to, its number.
type Key = (u8, u32, i64);

/// A part of a line, by the distances of its ends from its beginning.
type Span = (Key, [f64; 2]);

/// The page on which hatches lie.
#[derive(Debug, Clone, Copy)]
struct Sheet<'a, F> {
    hatch: &'a Hatch,
    light: Light,
    place: &'a F,
    anchors: &'a [DVec2],
    /// Farther than anything on the page.
    reach: f64,
}

/// The strokes of a hatch on a page of this size, mm. O(n + k) for n corners
/// and k crossings.
///
/// # Errors
///
/// If the spacing is none.
pub(super) fn hatches(
    regions: &ImageRegions,
    light: Light,
    hatch: &Hatch,
    size: DVec2,
    place: &(impl Fn(DVec2) -> DVec2 + Sync),
) -> Result<Strokes, DrawingError> {
    let spacing = hatch.spacing.millimetres();
    if !(FINEST <= spacing && hatch.degrees.is_finite()) {
        return Err(DrawingError::HatchSpacing(spacing));
    }
    let farthest = regions.anchors.iter().map(|&anchor| place(anchor).length());
    let reach = farthest.fold(size.length(), f64::max) * 4.0;
    let sheet = Sheet { hatch, light, place, anchors: &regions.anchors, reach };
    let parts = map_chunks(regions.regions.len(), PART, |part| {
        let mut spans = Vec::new();
        regions.regions[part].iter().for_each(|region| sheet.hatch_region(region, &mut spans));
        spans
    });
    let mut spans: Vec<Span> = parts.concat();
    spans.sort_unstable_by(|(a, s), (b, t)| {
        a.cmp(b).then(s[0].total_cmp(&t[0])).then(s[1].total_cmp(&t[1]))
    });
    let mut strokes = Strokes::default();
    for same in spans.chunk_by(|a, b| a.0 == b.0) {
        let key = same[0].0;
        let line = sheet.line(key);
        let mut joined: Vec<[f64; 2]> = Vec::new();
        for (_, [from, to]) in same {
            match joined.last_mut() {
                Some(last) if *from <= last[1] + SAME => last[1] = last[1].max(*to),
                _ => joined.push([*from, *to]),
            }
        }
        // A corner that a line just touches is no stroke.
        joined.retain(|[from, to]| SAME < to - from);
        // To and fro, as a hand would draw it.
        if key.2 % 2 != 0 {
            joined.iter_mut().for_each(|span| span.swap(0, 1));
            joined.reverse();
        }
        for span in joined {
            strokes.push(span.map(|t| line.at(t) + DVec2::ZERO));
        }
    }
    Ok(strokes)
}

/// A line of a hatch.
#[derive(Debug, Clone, Copy)]
struct HatchLine {
    start: DVec2,
    end: DVec2,
    along: DVec2,
}

impl HatchLine {
    fn at(&self, t: f64) -> DVec2 {
        self.start + self.along * t
    }

    /// On which side a point lies: positive is left, exactly.
    fn side(&self, point: DVec2) -> f64 {
        orient2d(coord(self.start), coord(self.end), coord(point))
    }
}

/// Where a line crosses an edge.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    key: Key,
    t: f64,
    edge: [DVec2; 2],
}

impl<F: Fn(DVec2) -> DVec2> Sheet<'_, F> {
    /// Directions and line steps of a tone.
    fn families(&self, region: &ImageRegion) -> &'static [(u8, i64)] {
        if self.hatch.tone == HatchTone::Flat {
            return &[(0, 1)];
        }
        match self.light.on(region) {
            bright if bright > 0.85 => &[],
            bright if bright > 0.65 => &[(0, 4)],
            bright if bright > 0.45 => &[(0, 2)],
            bright if bright > 0.25 => &[(0, 1)],
            bright if bright > 0.1 => &[(0, 1), (1, 2)],
            _ => &[(0, 1), (1, 1)],
        }
    }

    /// Unit vectors along and across the lines of a family; y is downwards.
    fn axes(&self, family: u8) -> [DVec2; 2] {
        let angle = (self.hatch.degrees + 90.0 * f64::from(family)).to_radians();
        let along = DVec2::new(angle.cos(), -angle.sin());
        [along, along.perp()]
    }

    /// The point from which lines are counted.
    fn origin(&self, anchor: u32) -> DVec2 {
        match self.hatch.anchor {
            HatchAnchor::Page => DVec2::ZERO,
            HatchAnchor::Object => {
                let anchor = self.anchors.get(anchor as usize).copied();
                (self.place)(anchor.unwrap_or(DVec2::ZERO))
            }
        }
    }

    fn line(&self, (family, anchor, number): Key) -> HatchLine {
        let [along, across] = self.axes(family);
        let offset = number as f64 * self.hatch.spacing.millimetres();
        let middle = self.origin(anchor) + across * offset;
        let (start, end) = (middle - along * self.reach, middle + along * self.reach);
        HatchLine { start, end, along }
    }

    fn hatch_region(&self, region: &ImageRegion, spans: &mut Vec<Span>) {
        let anchor = match self.hatch.anchor {
            HatchAnchor::Page => 0,
            HatchAnchor::Object => region.object,
        };
        for &(family, step) in self.families(region) {
            for polygon in &region.polygons {
                let mut crossings = Vec::new();
                for ring in polygon {
                    let next = ring.iter().cycle().skip(1);
                    for (a, b) in ring.iter().zip(next) {
                        let edge = [*a, *b].map(self.place);
                        self.cross(edge, (family, anchor), step, &mut crossings);
                    }
                }
                crossings.sort_unstable_by(|a, b| a.key.cmp(&b.key).then(a.t.total_cmp(&b.t)));
                for pair in crossings.chunks_exact(2) {
                    if pair[0].key == pair[1].key {
                        spans.push((pair[0].key, self.span(pair)));
                    }
                }
            }
        }
    }

    /// Adds where the lines of a family cross an edge.
    fn cross(
        &self,
        mut edge: [DVec2; 2],
        (family, anchor): (u8, u32),
        step: i64,
        crossings: &mut Vec<Crossing>,
    ) {
        // The same crossing, bit by bit, from both sides of the edge.
        if (edge[1].x, edge[1].y) < (edge[0].x, edge[0].y) {
            edge.swap(0, 1);
        }
        let [_, across] = self.axes(family);
        let number = |point: DVec2| {
            let offset = (point - self.origin(anchor)).dot(across);
            offset / self.hatch.spacing.millimetres() / step as f64
        };
        let (one, other) = (number(edge[0]), number(edge[1]));
        // One more on either side, and let the exact sides decide.
        let numbers = one.min(other).floor() as i64..=one.max(other).ceil() as i64;
        for number in numbers {
            let key = (family, anchor, number * step);
            let line = self.line(key);
            let sides = edge.map(|point| line.side(point));
            if (0.0 < sides[0]) != (0.0 < sides[1]) {
                let share = sides[0] / (sides[0] - sides[1]);
                let point = edge[0] + (edge[1] - edge[0]) * share;
                crossings.push(Crossing { key, t: (point - line.start).dot(line.along), edge });
            }
        }
    }

    /// From where a line enters to where it leaves, no end inside.
    fn span(&self, pair: &[Crossing]) -> [f64; 2] {
        let line = self.line(pair[0].key);
        let step = self.reach * f64::EPSILON;
        let outward = |crossing: &Crossing, far: DVec2, step: f64| {
            let [a, b] = crossing.edge.map(coord);
            let outside = orient2d(a, b, coord(far));
            let mut t = crossing.t;
            // Rounding is off by a few steps; more are no rounding.
            for _ in 0..16 {
                if 0.0 <= orient2d(a, b, coord(line.at(t))) * outside.signum() {
                    break;
                }
                t += step;
            }
            t
        };
        [outward(&pair[0], line.start, -step), outward(&pair[1], line.end, step)]
    }
}

fn coord(point: DVec2) -> Coord<f64> {
    Coord { x: point.x, y: point.y }
}

#[cfg(test)]
mod tests;
