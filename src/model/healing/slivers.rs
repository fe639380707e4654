//! Faces no wider than the tolerance: what joins their long sides anyway.
//!
//! A triangle whose third corner lies on its longest side, but for rounding,
//! has no direction that could be relied upon: its edges would be drawn as
//! creases of a smooth face. Its longest side is led through that corner, in
//! the neighbour too; what is left of the triangle is a way there and back,
//! which is no face, and its neighbours have their edges in common.

use super::net::{FaceName, Net, Rings};
use super::splits::{Side, Splits, without_ways_back};
use super::{Tolerance, distance};

/// Faces of more corners are not looked at.
pub(super) const MOST_CORNERS: usize = 6;

/// Neighbours of what collapsed may be slivers in their turn.
const MOST_ROUNDS: usize = 16;

/// Takes slivers out of the surface, of the faces that may be some; how many
/// were.
pub(super) fn collapse(net: &mut Net<'_>, mut thin: Vec<FaceName>, tolerance: Tolerance) -> usize {
    let mut collapsed = 0;
    for _ in 0..MOST_ROUNDS {
        let mut splits = Splits::default();
        let mut rings = Rings::default();
        for &name in &thin {
            net.rings(name, &mut rings);
            let inside = places_beside_sides(net, &rings, tolerance);
            let side = |&(side, place)| (Side::new(name.object, side), place);
            inside.iter().map(side).for_each(|(side, place)| splits.add(side, place));
        }
        if splits.is_empty() {
            break;
        }
        let applied = splits.apply(net, tolerance);
        collapsed += applied.collapsed;
        thin = applied.left;
        thin.retain(|name| net.changed[name].corners.len() <= MOST_CORNERS);
    }
    collapsed
}

/// For a sliver, its corners with the sides that they lie beside; nothing if
/// that would not be the end of it.
fn places_beside_sides(net: &Net<'_>, rings: &Rings, tolerance: Tolerance) -> Vec<([u32; 2], u32)> {
    if rings.ends.len() != 1 || !is_thin(net, &rings.corners, tolerance) {
        return Vec::new();
    }
    let mut beside = Vec::new();
    let mut led: Vec<u32> = Vec::new();
    for side in rings.sides() {
        let ends = side.map(|end| net.at(end));
        let others = rings.corners.iter().filter(|corner| !side.contains(corner));
        let mut inside: Vec<(f64, u32)> = others
            .filter_map(|&corner| Some((tolerance.beside(net.at(corner), ends)?.along, corner)))
            .collect();
        inside.sort_by(|a, b| a.0.total_cmp(&b.0));
        led.push(side[0]);
        led.extend(inside.iter().map(|&(_, corner)| corner));
        beside.extend(inside.iter().map(|&(_, corner)| (side, corner)));
    }
    if without_ways_back(led).len() < 3 { beside } else { Vec::new() }
}

/// Whether all corners lie beside the line between the two that are farthest
/// apart.
fn is_thin(net: &Net<'_>, corners: &[u32], tolerance: Tolerance) -> bool {
    let mut longest = (-1.0, [0, 0]);
    for (i, &a) in corners.iter().enumerate() {
        for &b in &corners[i + 1..] {
            let length = distance(net.at(a), net.at(b));
            if longest.0 < length {
                longest = (length, [a, b]);
            }
        }
    }
    let ends = longest.1.map(|end| net.at(end));
    let is_beside = |&corner: &u32| {
        longest.1.contains(&corner) || tolerance.beside(net.at(corner), ends).is_some()
    };
    longest.0 > 0.0 && corners.iter().all(is_beside)
}
