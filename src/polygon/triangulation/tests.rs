//! The two ways to cut an outline against one another.

use super::*;
use glam::dvec3;
use proptest::prelude::*;
use std::collections::BTreeMap;

/// Twice the area of triangles, all of them counterclockwise.
fn doubled_area(outline: &Outline, triangles: &[[u32; 3]]) -> f64 {
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|point| outline.points[point as usize]);
        let area = (b - a).perp_dot(c - a);
        assert!(area > 0.0, "{corners:?}");
        area
    };
    triangles.iter().map(area).sum()
}

/// What is left of the edges of triangles once opposite ones have cancelled
/// out, in parts between neighbouring points.
fn border(outline: &Outline, triangles: &[[u32; 3]]) -> BTreeMap<[u32; 2], i32> {
    let mut chain: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    for &[a, b, c] in triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let count = if from < to { 1 } else { -1 };
            let on = (from.min(to) + 1..from.max(to)).filter(|&point| {
                let [p, q, r] = [from, to, point].map(|p| outline.points[p as usize]);
                (q - p).perp_dot(r - p) == 0.0
            });
            let mut places: Vec<u32> = on.chain([from, to]).collect();
            places.sort_unstable();
            for part in places.windows(2) {
                *chain.entry([part[0], part[1]]).or_default() += count;
            }
        }
    }
    chain.retain(|_, count| *count != 0);
    chain
}

proptest! {
    #[test]
    fn a_sweep_and_delaunay_find_the_same_inside_of_any_rings(
        rings in prop::collection::vec(
            prop::collection::vec(prop::array::uniform2(0..5_i32), 3..10), 1..4),
    ) {
        let place = |&[x, y]: &[i32; 2]| dvec3(f64::from(x), f64::from(y), 0.0);
        let rings: Vec<Vec<DVec3>> =
            rings.iter().map(|ring| ring.iter().map(place).collect()).collect();
        let corners = rings.concat();
        let Some(projection) = Projection::along_axis(&corners, rings[0].len(), 2) else {
            return Ok(());
        };
        let outline = Outline::new(&rings, &corners, &projection).expect("planar");
        let one = delaunay::triangulate(&outline).expect("in range");
        let other = sweep::triangulate(&outline);
        match (one, other) {
            (Ok(one), Ok(other)) => {
                prop_assert_eq!(doubled_area(&outline, &one), doubled_area(&outline, &other));
                prop_assert_eq!(border(&outline, &one), border(&outline, &other));
            }
            // Edges that bound nothing together may cross others.
            (Err(_), _) => {}
            (one, other) => prop_assert!(false, "{:?} {:?}", one, other),
        }
    }
}
