//! Vertices to edges: a corner beside a border of its own object becomes a
//! corner of that border too.
//!
//! Where a long side lies against several short ones, the ends of the short ones lie beside the long
//! one, off by the rounding of their coordinates. Each border is led through
//! all ends of other borders that are near it, once, by its place in the file,
//! so nothing drifts.

use super::Tolerance;
use super::coordinates::hierarchy;
use super::net::Net;
use super::splits::{Side, Splits};
use crate::run::{Run, map_chunks};
use glam::DVec3;

/// Ends that one task looks at.
const PART: usize = 1 << 10;

/// A border, by its object and the names and positions of its ends.
pub(super) struct Border {
    pub(super) object: u32,
    pub(super) names: [u32; 2],
    pub(super) ends: [DVec3; 2],
}

/// An end of borders of an object.
pub(super) struct End {
    pub(super) object: u32,
    pub(super) name: u32,
    pub(super) position: DVec3,
}

/// Leads borders through what lies beside them; how many faces collapse.
pub(super) fn close(
    net: &mut Net<'_>,
    sides: &[Side],
    tolerance: Tolerance,
    run: &Run<'_>,
) -> usize {
    let border = |side: &Side| Border {
        object: side.object,
        names: side.ends,
        ends: side.ends.map(|end| net.at(end)),
    };
    let borders: Vec<Border> = sides.iter().map(border).collect();
    let mut names: Vec<(u32, u32)> =
        sides.iter().flat_map(|side| side.ends.map(|end| (side.object, end))).collect();
    names.sort_unstable();
    names.dedup();
    let end = |(object, name)| End { object, name, position: net.at(name) };
    let ends: Vec<End> = names.into_iter().map(end).collect();
    let mut splits = Splits::default();
    for [border, end] in beside(&borders, &ends, tolerance, run) {
        splits.add(sides[border as usize], ends[end as usize].name);
    }
    splits.apply(net, tolerance).collapsed
}

/// Borders with the ends of other borders of the same object that lie beside
/// them, by their places in the lists.
pub(super) fn beside(
    borders: &[Border],
    ends: &[End],
    tolerance: Tolerance,
    run: &Run<'_>,
) -> Vec<[u32; 2]> {
    let boxes: Vec<[DVec3; 2]> =
        borders.iter().map(|border| border.ends).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    let (rounding, hierarchy) = hierarchy(&boxes, tolerance);
    let parts = map_chunks(ends.len(), PART, |part| {
        let mut found = Vec::new();
        for (number, end) in (part.start as u32..).zip(&ends[part]) {
            if run.is_stopped() {
                break;
            }
            let around = rounding.around(end.position, end.position);
            hierarchy.visit(
                |group| group.overlapping(&around),
                |place| {
                    let border = &borders[place as usize];
                    if border.object == end.object
                        && !border.names.contains(&end.name)
                        && tolerance.beside(end.position, border.ends).is_some()
                    {
                        found.push([place, number]);
                    }
                },
            );
        }
        found
    });
    parts.concat()
}
