//! The image of a triangle by the names of its corners, cut by lines.
//!
//! Cuts are Sutherland's and Hodgman's (1974), for convex rings, with exact
//! signs. A cut makes corners that are crossings of an edge with the cutting
//! line, so their names are as deep as those of any other crossing.

use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Chart, Cut, ImageLine, ImagePoint, Point, Policy, Predicates};
use crate::polygon::clipping::{Corner, Ring};

/// How a triangle lies to the near plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NearSide {
    /// Some corner lies in front of it, none behind it.
    Front,
    /// It is cut.
    Cut,
    /// Nothing of it lies in front.
    Behind,
}

/// On which side of the near plane a triangle lies.
pub(super) fn near_side<P: Policy>(predicates: &Predicates<'_, P>, corners: [u32; 3]) -> NearSide {
    if !predicates.points().has_near_plane() {
        return NearSide::Front;
    }
    let signs = near_signs(predicates, corners);
    if !signs.contains(&Sign::Positive) {
        NearSide::Behind
    } else if signs.contains(&Sign::Negative) {
        NearSide::Cut
    } else {
        NearSide::Front
    }
}

fn near_signs<P: Policy>(predicates: &Predicates<'_, P>, corners: [u32; 3]) -> [Sign; 3] {
    corners.map(|corner| predicates.value_sign(Cut::Near, Point::Vertex(corner)))
}

/// The image of a triangle that is not edge-on, counterclockwise, as far as
/// it lies in front of the near plane.
pub(super) fn outline<P: Policy>(
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    [a, b, c]: [u32; 3],
    facing: Sign,
    side: NearSide,
) -> Ring {
    let corners = if facing == Sign::Positive { [a, b, c] } else { [a, c, b] };
    let edge = |i: usize| ImageLine::Edge([corners[i], corners[(i + 1) % 3]]);
    let corner = |i: usize| Corner { point: ImagePoint::Vertex(corners[i]), line: edge(i) };
    let ring = vec![corner(0), corner(1), corner(2)];
    match side {
        NearSide::Front => ring,
        NearSide::Behind => Vec::new(),
        NearSide::Cut => {
            let signs = near_signs(predicates, corners);
            let near = ImageLine::Near(corners);
            // Where an edge leaves the front, the cut turns left from it; one
            // that enters the front turns left from the cut.
            let cut = (0..3).find_map(|i| {
                let bend = || predicates.bend(chart, edge(i), near);
                match (signs[i], signs[(i + 1) % 3]) {
                    (Sign::Positive, Sign::Negative) => Some(bend()),
                    (Sign::Negative, Sign::Positive) => Some(-bend()),
                    _ => None,
                }
            });
            let near = if cut == Some(Sign::Negative) { near.reversed() } else { near };
            kept(&ring, near, &signs)
        }
    }
}

/// What of a convex ring lies left of a line.
pub(super) fn left_of<P: Policy>(
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    ring: &[Corner],
    line: ImageLine,
) -> Ring {
    let signs: Vec<Sign> =
        ring.iter().map(|corner| predicates.beside(chart, line, corner.point)).collect();
    kept(ring, line, &signs)
}

/// The part of a convex ring whose corners have these signs that lies left
/// of a line; nothing if that has no area.
fn kept(ring: &[Corner], line: ImageLine, signs: &[Sign]) -> Ring {
    if !signs.contains(&Sign::Positive) {
        return Vec::new();
    }
    let mut kept = Vec::with_capacity(ring.len() + 1);
    for (i, corner) in ring.iter().enumerate() {
        let next = signs[(i + 1) % signs.len()];
        match (signs[i], next) {
            (Sign::Zero, Sign::Negative) => kept.push(Corner { point: corner.point, line }),
            (Sign::Positive, Sign::Negative) => {
                kept.push(*corner);
                kept.push(Corner { point: ImagePoint::Crossing([corner.line, line]), line });
            }
            (Sign::Negative, Sign::Positive) => {
                let point = ImagePoint::Crossing([line, corner.line]);
                kept.push(Corner { point, line: corner.line });
            }
            (Sign::Negative, _) => {}
            _ => kept.push(*corner),
        }
    }
    kept
}
