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

/// Places that one task looks at.
const PART: usize = 1 << 10;

/// Leads borders through what lies beside them; how many faces collapse.
pub(super) fn close(
    net: &mut Net<'_>,
    borders: &[Side],
    tolerance: Tolerance,
    run: &Run<'_>,
) -> usize {
    let mut splits = Splits::default();
    for (side, place) in beside(net, borders, tolerance, run) {
        splits.add(side, place);
    }
    splits.apply(net, tolerance).collapsed
}

/// Borders with the ends of other borders of the same object that lie beside
/// them.
fn beside(
    net: &Net<'_>,
    borders: &[Side],
    tolerance: Tolerance,
    run: &Run<'_>,
) -> Vec<(Side, u32)> {
    let ends_of = |side: &Side| side.ends.map(|end| net.at(end));
    let boxes: Vec<[DVec3; 2]> =
        borders.iter().map(ends_of).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    let (rounding, hierarchy) = hierarchy(&boxes, tolerance);
    let mut ends: Vec<(u32, u32)> =
        borders.iter().flat_map(|side| side.ends.map(|end| (side.object, end))).collect();
    ends.sort_unstable();
    ends.dedup();
    let parts = map_chunks(ends.len(), PART, |part| {
        let mut found = Vec::new();
        for &(object, place) in &ends[part] {
            if run.is_stopped() {
                break;
            }
            let position = net.at(place);
            let around = rounding.around(position, position);
            hierarchy.visit(
                |group| group.overlapping(&around),
                |border| {
                    let side = borders[border as usize];
                    if side.object == object
                        && !side.ends.contains(&place)
                        && tolerance.beside(position, ends_of(&side)).is_some()
                    {
                        found.push((side, place));
                    }
                },
            );
        }
        found
    });
    parts.concat()
}
