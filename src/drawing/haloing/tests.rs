//! Gaps by their formula, and where there must be none.

use super::*;
use crate::run::Counters;
use crate::view::{Frame, LineClass, LineSource};
use glam::{DVec3, dvec2};
use proptest::prelude::*;

/// A piece from two points with depth.
fn piece(a: [f64; 3], b: [f64; 3]) -> LinePiece {
    LinePiece {
        class: LineClass::Line,
        invisibility: 0,
        outline: false,
        points: [dvec2(a[0], a[1]), dvec2(b[0], b[1])],
        depth: [a[2], b[2]],
        object: 0,
        source: LineSource::Edge([0, 1]),
        run: 0,
    }
}

fn lines(pieces: Vec<LinePiece>, projection: Projection) -> VisibleLines {
    let frame = Frame {
        projection,
        origin: DVec3::ZERO,
        right: DVec3::X,
        up: DVec3::Y,
        forward: DVec3::Z,
        shear: DVec2::ZERO,
        half_height: None,
    };
    VisibleLines { frame, objects: vec![String::new()], pieces, counters: Counters::default() }
}

fn interrupted(pieces: &[LinePiece], crossings: &[[u32; 2]], radius: f64) -> Vec<LinePiece> {
    let lines = lines(pieces.to_vec(), Projection::Orthographic);
    let crossings: Vec<_> = crossings.iter().map(|&[near, far]| Crossing { near, far }).collect();
    interrupt(&lines, &crossings, &vec![true; pieces.len()], radius, &Run::default())
        .unwrap()
        .pieces
}

fn length(pieces: &[LinePiece]) -> f64 {
    pieces.iter().map(|piece| piece.points[0].distance(piece.points[1])).sum()
}

/// Points on a circle, as a polyline at one depth.
fn arc(radius: f64, depth: f64, count: u32) -> Vec<LinePiece> {
    let at = |i: u32| {
        let angle = f64::from(i) / f64::from(count) * std::f64::consts::PI;
        [radius * angle.cos(), radius * angle.sin(), depth]
    };
    (0..count).map(|i| piece(at(i), at(i + 1))).collect()
}

proptest! {
    #[test]
    fn a_gap_is_the_halo_over_the_sine(
        degrees in 10.0..170.0_f64, turn in 0.0..6.3_f64, halo in 0.01..1.0_f64, at in -3.0..3.0_f64,
    ) {
        let (angle, far) = (degrees.to_radians(), DVec2::from_angle(turn));
        let near = DVec2::from_angle(turn + angle);
        let end = |way: DVec2, t: f64, depth: f64| [(way * t).x, (way * t).y, depth];
        let pieces = [
            piece(end(near, -20.0, 1.0), end(near, 20.0, 1.5)),
            piece(end(far, -20.0 + at, 3.0), end(far, 20.0 + at, 2.0)),
        ];
        let left = interrupted(&pieces, &[[0, 1]], 0.5 * halo);
        prop_assert_eq!(left.len(), 3);
        prop_assert_eq!(left[0], pieces[0]);
        let gap = left[1].points[1].distance(left[2].points[0]);
        prop_assert!((gap - halo / angle.sin()).abs() < 1e-9, "{} {}", gap, halo / angle.sin());
        let middle = left[1].points[1].midpoint(left[2].points[0]);
        prop_assert!(middle.length() < 1e-9);
    }

    /// The near line, or the far one, or both in many pieces: the same gap.
    #[test]
    fn pieces_of_chains_make_one_gap(cuts in 1..60_u32, halo in 0.05..2.0_f64, both in any::<bool>()) {
        let split = |from: [f64; 3], to: [f64; 3], count: u32| -> Vec<LinePiece> {
            let at = |i: u32| {
                let t = f64::from(i) / f64::from(count);
                std::array::from_fn(|k| from[k] + (to[k] - from[k]) * t)
            };
            (0..count).map(|i| piece(at(i), at(i + 1))).collect()
        };
        let mut pieces = split([-5.0, -5.0, 1.0], [5.0, 5.0, 1.0], cuts);
        let far = split([-7.0, 0.3, 2.0], [7.0, 0.3, 2.0], if both { 2 * cuts + 1 } else { 1 });
        let first = pieces.len() as u32;
        let meets = |piece: &LinePiece| piece.points[0].x <= 0.3 && 0.3 <= piece.points[1].x;
        let mut crossings = Vec::new();
        for near in (0..first).filter(|i| meets(&pieces[*i as usize])) {
            for (i, _) in far.iter().enumerate().filter(|(_, piece)| meets(piece)) {
                crossings.push([near, first + i as u32]);
            }
        }
        pieces.extend(far);
        let left = interrupted(&pieces, &crossings, 0.5 * halo);
        let expected = length(&pieces) - halo * 2.0_f64.sqrt();
        prop_assert!((length(&left) - expected).abs() < 1e-9, "{} {}", length(&left), expected);
    }

    #[test]
    fn the_order_of_pieces_and_crossings_does_not_matter(seed in 0..1000_u32, halo in 0.05..0.5_f64) {
        // A fan of lines in front of arcs, each at a depth of its own.
        let mut pieces: Vec<LinePiece> = (1..6).flat_map(|i| arc(f64::from(i), 5.0, 23)).collect();
        let first = pieces.len() as u32;
        for i in 0..7 {
            let end = DVec2::from_angle(0.2 + 0.4 * f64::from(i)) * 7.0;
            pieces.push(piece([0.0, -0.1, 1.0 + f64::from(i)], [end.x, end.y, 1.0 + f64::from(i)]));
        }
        let crosses = |a: &LinePiece, b: &LinePiece| {
            let side = |l: &LinePiece, p: DVec2| (l.points[1] - l.points[0]).perp_dot(p - l.points[0]);
            side(a, b.points[0]) * side(a, b.points[1]) < 0.0
                && side(b, a.points[0]) * side(b, a.points[1]) < 0.0
        };
        let mut crossings = Vec::new();
        for a in 0..first {
            for b in first..pieces.len() as u32 {
                let pair = [pieces[a as usize], pieces[b as usize]];
                if crosses(&pair[0], &pair[1]) {
                    crossings.push(if pair[0].depth[0] < pair[1].depth[0] { [a, b] } else { [b, a] });
                }
            }
        }
        prop_assert!(30 < crossings.len());
        let key = |piece: &LinePiece| piece.points.map(|p| p.to_array().map(f64::to_bits));
        let mut expected = interrupted(&pieces, &crossings, halo);
        expected.sort_by_key(key);
        // Another order: a multiplication modulo the number of pieces.
        let count = pieces.len() as u32;
        let step = [1, 7, 11, 13, 17][seed as usize % 5];
        let place = |i: u32| (i * step + seed) % count;
        let mut moved = pieces.clone();
        (0..count).for_each(|i| moved[place(i) as usize] = pieces[i as usize]);
        let mut crossings: Vec<_> = crossings.iter().map(|pair| pair.map(place)).collect();
        crossings.reverse();
        let mut found = interrupted(&moved, &crossings, halo);
        found.sort_by_key(key);
        prop_assert_eq!(found, expected);
    }
}

#[test]
fn no_gap_without_a_crossing_or_at_a_joint() {
    // A corner in front of nothing, and a line that passes by closely.
    let pieces = [
        piece([0.0, 0.0, 1.0], [4.0, 0.0, 1.0]),
        piece([4.0, 0.0, 1.0], [4.0, 4.0, 2.0]),
        piece([0.0, 0.1, 5.0], [3.9, 0.1, 5.0]),
    ];
    assert_eq!(interrupted(&pieces, &[], 1.0), pieces);
}

#[test]
fn a_chain_that_zigzags_makes_no_gap_in_itself() {
    // The third piece comes back under the first, a short way on.
    let pieces = [
        piece([0.0, 0.0, 1.0], [4.0, 0.0, 1.0]),
        piece([4.0, 0.0, 1.0], [4.1, 0.3, 1.2]),
        piece([4.1, 0.3, 1.2], [0.0, -3.0, 1.4]),
    ];
    assert_eq!(interrupted(&pieces, &[[0, 2]], 0.5), pieces);
    // Where halos are small against the loop, it does.
    assert_eq!(interrupted(&pieces, &[[0, 2]], 0.05).len(), 4);
}

#[test]
fn a_gap_ends_where_the_far_line_comes_to_the_front() {
    // They cross at a small angle; a little on, the far line is nearer.
    let pieces =
        [piece([-10.0, 0.0, 1.0], [10.0, 0.0, 1.0]), piece([-10.0, -1.0, 3.0], [10.0, 1.0, 0.9])];
    let left = interrupted(&pieces, &[[0, 1]], 2.0);
    assert_eq!(left.len(), 2);
    // It begins at the end of the line and stops at equal depth.
    let x = -10.0 + 20.0 * (2.0 / 2.1);
    assert!((left[1].points[0].x - x).abs() < 1e-9, "{}", left[1].points[0].x);
    assert_eq!(left[1].points[1], pieces[1].points[1]);
}

#[test]
fn depth_is_cut_by_the_perspective() {
    let pieces =
        vec![piece([-0.5, 0.0, 1.0], [0.5, 0.0, 1.0]), piece([0.0, -1.0, 2.0], [0.0, 1.0, 6.0])];
    let lines = lines(pieces, Projection::Perspective);
    let left = interrupt(&lines, &[Crossing { near: 0, far: 1 }], &[true; 2], 0.1, &Run::default())
        .unwrap()
        .pieces;
    // Half way in the image the depth is the harmonic mean.
    let depth = |t: f64| 1.0 / ((1.0 - t) / 2.0 + t / 6.0);
    assert!((left[1].depth[1] - depth(0.45)).abs() < 1e-12);
    assert!((left[2].depth[0] - depth(0.55)).abs() < 1e-12);
}

#[test]
fn what_is_not_drawn_makes_no_gap() {
    let pieces =
        vec![piece([-1.0, 0.0, 1.0], [1.0, 0.0, 1.0]), piece([0.0, -1.0, 2.0], [0.0, 1.0, 2.0])];
    let lines = lines(pieces, Projection::Orthographic);
    let crossing = [Crossing { near: 0, far: 1 }];
    assert_eq!(
        interrupt(&lines, &crossing, &[false, true], 0.1, &Run::default()).unwrap().pieces,
        lines.pieces
    );
    assert_eq!(
        interrupt(&lines, &crossing, &[true; 2], 0.1, &Run::default()).unwrap().pieces.len(),
        3
    );
}
