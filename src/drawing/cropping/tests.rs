//! Cuts at borders: by hand, and against tiles of the plane.

#![allow(clippy::unwrap_used)]

use super::*;
use crate::view::{LineClass, LineSource};
use proptest::prelude::*;

fn piece(points: [[f64; 2]; 2]) -> LinePiece {
    LinePiece {
        class: LineClass::Crease,
        invisibility: 0,
        outline: false,
        points: points.map(DVec2::from_array),
        depth: [1.0, 3.0],
        object: 0,
        source: LineSource::Edge([0, 1]),
        run: 0,
    }
}

fn cut_in(points: [[f64; 2]; 2], window: &Window) -> Option<[DVec2; 2]> {
    clip(&piece(points), window, Projection::Orthographic).map(|piece| piece.points)
}

#[test]
fn pieces_are_cut_at_the_border_of_the_window() {
    let window = Window::around_zero(DVec2::new(2.0, 1.0));
    let cut = |points| cut_in(points, &window);
    let across = cut([[-4.0, 0.5], [4.0, 0.5]]);
    assert_eq!(across, Some([DVec2::new(-2.0, 0.5), DVec2::new(2.0, 0.5)]));
    assert_eq!(cut([[0.0, 1.5], [1.0, 1.5]]), None);
    assert_eq!(cut([[1.5, 2.0], [4.0, 0.0]]), None);
    let inside = [[0.1, 0.2], [0.3, -0.4]];
    assert_eq!(cut(inside), Some(inside.map(DVec2::from_array)));
}

#[test]
fn a_line_through_a_corner_alone_is_not_in_the_window() {
    let window = Window::around_zero(DVec2::ONE);
    assert_eq!(cut_in([[0.0, 2.0], [2.0, 0.0]], &window), None);
    let next_to_it = cut_in([[0.0, 2.0], [2.0, -f64::EPSILON]], &window);
    assert!(next_to_it.is_some_and(|[a, b]| a != b && a.y == 1.0 && b.x == 1.0), "{next_to_it:?}");
    let border = [DVec2::new(-1.0, 1.0), DVec2::new(1.0, 1.0)];
    assert_eq!(cut_in([[-3.0, 1.0], [3.0, 1.0]], &window), Some(border));
}

#[test]
fn depth_is_linear_in_space_not_in_the_image() {
    let window = Window::around_zero(DVec2::new(2.0, 1.0));
    let depth = |projection| {
        clip(&piece([[0.0, 0.0], [4.0, 0.0]]), &window, projection).map(|piece| piece.depth[1])
    };
    assert_eq!(depth(Projection::Perspective), Some(1.5));
    assert_eq!(depth(Projection::Orthographic), Some(2.0));
}

proptest! {
    /// Four windows around a point, side by side: every line is in them
    /// once, and the cuts of neighbours are the same bits.
    #[test]
    fn tiles_laid_side_by_side_are_the_picture(
        ends in (-9.0..9.0f64, -9.0..9.0f64, -9.0..9.0f64, -9.0..9.0f64),
        grid in any::<bool>(),
        middle in (-4.0..4.0f64, -4.0..4.0f64),
    ) {
        let snap = |x: f64| if grid { x.round() } else { x };
        let [a, b] = [[snap(ends.0), snap(ends.1)], [snap(ends.2), snap(ends.3)]];
        let middle = DVec2::new(snap(middle.0), snap(middle.1));
        prop_assume!(a != b);
        let mut parts = Vec::new();
        for x in [-10.0, 10.0] {
            for y in [-10.0, 10.0] {
                let window = Window::new(middle, DVec2::new(x, y)).unwrap();
                let points = cut_in([a, b], &window);
                if let Some([from, to]) = points {
                    prop_assert!(window.holds(from) && window.holds(to));
                }
                parts.extend(points);
            }
        }
        // A line along a common border is in both of its windows.
        let along = a[0] == b[0] && a[0] == middle.x || a[1] == b[1] && a[1] == middle.y;
        let length: f64 = parts.iter().map(|[from, to]| from.distance(*to)).sum();
        let whole = DVec2::from(a).distance(DVec2::from(b)) * if along { 2.0 } else { 1.0 };
        prop_assert!((length - whole).abs() <= 1e-14 * 40.0, "{length} of {whole}");
        let ends = [DVec2::from(a), DVec2::from(b)];
        for [from, to] in &parts {
            for (end, other) in [(from, 1), (to, 0)] {
                let joined = parts.iter().any(|part| part[other] == *end);
                prop_assert!(along || ends.contains(end) || joined, "{end} in {parts:?}");
            }
        }
    }
}
