//! Winding numbers in rational numbers, straight from their definition.

use super::draw::Rings;
use glam::DVec2;
use umriss::kernel::numbers::{Fraction, Sign};
use umriss::polygon::clipping::{FillRule, PlaneShape};

pub(crate) type Exact = [Fraction; 2];

/// The rings of polygons with exact coordinates.
pub(crate) type ExactRings = Vec<Vec<Vec<Exact>>>;

pub(crate) fn exact(point: DVec2) -> Exact {
    [Fraction::of_float(point.x), Fraction::of_float(point.y)]
}

/// How often a ring winds around a point that is on none of its edges.
pub(crate) fn winding(ring: &[Exact], [x, y]: &Exact) -> i32 {
    let mut sum = 0;
    for (i, a) in ring.iter().enumerate() {
        let b = &ring[(i + 1) % ring.len()];
        let (up, down) = (a[1] <= *y && b[1] > *y, b[1] <= *y && a[1] > *y);
        if up || down {
            let left = (b[0].clone() - a[0].clone()) * (y.clone() - a[1].clone())
                - (b[1].clone() - a[1].clone()) * (x.clone() - a[0].clone());
            match left.sign() {
                Sign::Positive if up => sum += 1,
                Sign::Negative if down => sum -= 1,
                _ => {}
            }
        }
    }
    sum
}

/// Whether a point is inside by the rule, as its definition says.
pub(crate) fn is_inside(polygons: &[Rings], rule: FillRule, point: &Exact) -> bool {
    let of = |ring: &Vec<DVec2>| {
        let ring: Vec<_> = ring.iter().map(|&corner| exact(corner)).collect();
        winding(&ring, point)
    };
    let total: i32 = polygons.iter().flatten().map(of).sum();
    match rule {
        FillRule::EvenOdd => total % 2 != 0,
        FillRule::NonZero => total != 0,
        FillRule::Positive => total > 0,
        FillRule::Negative => total < 0,
        FillRule::Polygons => polygons
            .iter()
            .any(|rings| of(&rings[0]) % 2 != 0 && rings[1..].iter().all(|hole| of(hole) % 2 == 0)),
    }
}

/// The rings of a result with exact coordinates.
pub(crate) fn exact_rings(shape: &PlaneShape) -> ExactRings {
    let points = shape.positions();
    points.into_iter().collect()
}

/// How often the rings of a result wind around a point: 0 or 1.
pub(crate) fn winding_of_result(rings: &ExactRings, point: &Exact) -> i32 {
    rings.iter().flatten().map(|ring| winding(ring, point)).sum()
}
