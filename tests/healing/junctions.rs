//! Corners beside the edges that they were on.

use super::scenes::{
    Polygons, Random, farthest, healed, mapped, narrow, prism, rounded, seeds, soup_of, topology,
};
use glam::DVec3;
use proptest::prelude::*;

/// A box whose top is cut into strips, some of them once more across, while
/// its walls are whole: every cut ends inside an edge of another face.
fn box_of_strips(random: &mut Random, strips: usize) -> Polygons {
    let cuts: Vec<f64> = (0..=strips).map(|i| i as f64 / strips as f64).collect();
    let at = |x: f64, y: f64, z: f64| DVec3::new(3.0 * x, 2.0 * y, z);
    let mut faces = Vec::new();
    for pair in cuts.windows(2) {
        let across = if random.below(2) == 0 { vec![0.0, 1.0] } else { vec![0.0, 0.4, 1.0] };
        for part in across.windows(2) {
            let ([x, u], [y, v]) = ([pair[0], pair[1]], [part[0], part[1]]);
            faces.push(vec![at(x, y, 1.0), at(u, y, 1.0), at(u, v, 1.0), at(x, v, 1.0)]);
        }
    }
    faces.push(vec![at(0.0, 0.0, 0.0), at(0.0, 1.0, 0.0), at(1.0, 1.0, 0.0), at(1.0, 0.0, 0.0)]);
    let rim = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    for (i, [x, y]) in rim.into_iter().enumerate() {
        let [u, v] = rim[(i + 1) % 4];
        faces.push(vec![at(x, y, 0.0), at(u, v, 0.0), at(u, v, 1.0), at(x, y, 1.0)]);
    }
    faces
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(80))]

    #[test]
    fn strips_with_rounded_corners_are_closed(seed in seeds(), strips in 2_usize..7) {
        let mut random = Random(seed);
        let turn = random.rotation();
        let exact = mapped(&box_of_strips(&mut random, strips), |p| turn * p * 10.0);
        for round in [|p| rounded(p, 6), |p| rounded(p, 4), narrow] {
            let soups = [soup_of("box", &mapped(&exact, round))];
            prop_assert!(topology(&soups).boundary_edges > 0);
            let resolution = soups[0].precision.resolution(&soups[0].vertices);
            let (after, report) = healed(&soups, resolution);
            let found = topology(&after);
            prop_assert_eq!(found.boundary_edges, 0);
            prop_assert!(found.is_closed());
            prop_assert!(report.closed_borders > 0);
            prop_assert!(farthest(&soups, &after) <= resolution);
            let (again, report) = healed(&after, resolution);
            prop_assert_eq!(&again, &after);
            prop_assert_eq!(report, Default::default());
        }
    }

    #[test]
    fn slivers_that_fill_a_seam_are_taken_out(seed in seeds(), corners in 3_usize..7) {
        // The wall of a prism is split where no other face is, and a triangle
        // without width, but for rounding, joins what is left.
        let mut random = Random(seed);
        let turn = random.rotation();
        let mut faces = prism(&mut random, corners);
        let wall = faces.pop().unwrap();
        let middle = wall[0].lerp(wall[1], 0.3 + 0.2 * random.unit());
        faces.push(vec![middle, wall[1], wall[2], wall[3]]);
        faces.push(vec![wall[0], middle, wall[3]]);
        faces.push(vec![wall[0], wall[1], middle]);
        let round = |p: DVec3| narrow(turn * p);
        let soups = [soup_of("prism", &mapped(&faces, round))];
        let resolution = soups[0].precision.resolution(&soups[0].vertices);
        let (after, report) = healed(&soups, resolution);
        let found = topology(&after);
        prop_assert!(found.is_closed());
        prop_assert_eq!((found.boundary_edges, found.non_manifold_edges), (0, 0));
        prop_assert_eq!(report.collapsed_faces, 1);
        prop_assert_eq!(report.moved, 0);
    }
}

#[test]
fn corners_that_are_added_have_the_numbers_of_the_file() {
    // A square against two halves of one, the corner between them off by the
    // last digit.
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.1 * x + 0.3 * y);
    let mut soup = soup_of("flat", &[]);
    soup.vertices = vec![
        corner(0.0, 0.0),
        corner(2.0, 0.0),
        corner(2.0, 1.0),
        corner(0.0, 1.0),
        corner(1.0, 0.0) + DVec3::splat(1e-9),
        corner(0.0, -1.0),
        corner(2.0, -1.0),
    ];
    soup.vertex_numbers = Some(vec![10, 11, 12, 13, 14, 15, 16]);
    soup.faces.push(&[0, 1, 2, 3], []);
    soup.faces.push(&[0, 5, 6, 4], []);
    soup.faces.push(&[4, 6, 1], []);
    let (after, report) = healed(&[soup.clone()], 1e-8);
    assert_eq!(after[0].vertices, soup.vertices);
    assert_eq!(after[0].vertex_numbers, soup.vertex_numbers);
    let rings: Vec<Vec<&[u32]>> = (0..3).map(|face| after[0].faces.rings(face).collect()).collect();
    assert_eq!(rings[0], [&[0, 4, 1, 2, 3][..]]);
    assert_eq!(rings[1..], [[&[0, 5, 6, 4][..]], [&[4, 6, 1][..]]]);
    assert_eq!((report.moved, report.closed_borders), (0, 3));
}
