//! Joining segments, by hand and by chance.

use super::*;
use crate::drawing::is_closed;
use proptest::prelude::*;
use std::collections::BTreeMap;

fn at(x: i32, y: i32) -> DVec2 {
    DVec2::new(f64::from(x), f64::from(y))
}

fn strokes(segments: &[[DVec2; 2]]) -> Vec<Vec<DVec2>> {
    chain(segments, &[], true).iter().map(<[DVec2]>::to_vec).collect()
}

/// A segment without direction, as bits.
fn key(a: DVec2, b: DVec2) -> [[u64; 2]; 2] {
    let mut ends = [a, b].map(|end| [end.x.to_bits(), end.y.to_bits()]);
    ends.sort_unstable();
    ends
}

/// A stroke without direction, and without beginning where it is closed.
fn shape(stroke: &[DVec2]) -> Vec<[[u64; 2]; 2]> {
    let mut edges: Vec<_> = stroke.windows(2).map(|pair| key(pair[0], pair[1])).collect();
    edges.sort_unstable();
    edges
}

fn shapes(segments: &[[DVec2; 2]]) -> Vec<Vec<[[u64; 2]; 2]>> {
    let mut shapes: Vec<_> = chain(segments, &[], true).iter().map(shape).collect();
    shapes.sort_unstable();
    shapes
}

#[test]
fn a_square_in_any_order_is_one_closed_stroke() {
    let corners = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
    let side = |i: usize| [corners[i], corners[(i + 1) % 4]];
    let segments = [side(2), [corners[1], corners[0]], side(3), side(1)];
    let strokes = strokes(&segments);
    assert_eq!(strokes.len(), 1);
    assert!(is_closed(&strokes[0]) && strokes[0].len() == 5);
}

#[test]
fn a_stroke_begins_at_its_end_and_keeps_the_sense_of_its_first_segment() {
    let segments = [[at(1, 0), at(2, 1)], [at(1, 0), at(0, 5)], [at(3, 3), at(2, 1)]];
    assert_eq!(strokes(&segments), [vec![at(0, 5), at(1, 0), at(2, 1), at(3, 3)]]);
}

#[test]
fn a_joint_on_a_straight_line_is_no_point() {
    let segments = [[at(0, 0), at(3, 1)], [at(3, 1), at(9, 3)], [at(9, 3), at(9, 9)]];
    assert_eq!(strokes(&segments), [vec![at(0, 0), at(9, 3), at(9, 9)]]);
    // Rounded points of one exact line, and the same without knowing it.
    let rounded = [[at(0, 0), DVec2::new(0.1, 0.3)], [DVec2::new(0.1, 0.3), at(1, 3)]];
    assert_eq!(chain(&rounded, &[7, 7], true).get(0), [at(0, 0), at(1, 3)]);
    assert_eq!(chain(&rounded, &[7, 8], true).get(0).len(), 3);
    // Back on itself is not straight on, and where three meet the point stays.
    assert_eq!(strokes(&[[at(0, 0), at(4, 0)], [at(4, 0), at(1, 0)]])[0].len(), 3);
    let crossed = [[at(0, 0), at(1, 0)], [at(1, 0), at(2, 0)], [at(1, 0), at(1, 5)]];
    assert_eq!(chain(&crossed, &[], true).point_count(), 5);
    // Unless nobody needs to know where they meet.
    assert_eq!(chain(&crossed, &[], false).point_count(), 4);
    let corners = [at(1, 0), at(2, 0), at(2, 2), at(0, 2), at(0, 0)];
    let ring: Vec<_> = (0..5).map(|i| [corners[i], corners[(i + 1) % 5]]).collect();
    assert_eq!(strokes(&ring), [vec![at(2, 0), at(2, 2), at(0, 2), at(0, 0), at(2, 0)]]);
}

#[test]
fn a_crossing_is_passed_straight() {
    let middle = at(0, 0);
    let segments =
        [[at(-1, 0), middle], [at(0, -1), middle], [middle, at(1, 0)], [middle, at(0, 1)]];
    let expected = [vec![at(-1, 0), middle, at(1, 0)], vec![at(0, -1), middle, at(0, 1)]];
    assert_eq!(strokes(&segments), expected);
}

#[test]
fn a_branch_ends_where_two_others_go_straight_on() {
    let middle = at(0, 0);
    let segments = [[at(0, 9), middle], [at(-9, 1), middle], [middle, at(9, 0)]];
    let expected = [vec![at(0, 9), middle], vec![at(-9, 1), middle, at(9, 0)]];
    assert_eq!(strokes(&segments), expected);
}

#[test]
fn a_great_fan_is_paired_across_its_tip() {
    let rim = |i: usize| DVec2::from_angle(i as f64 * std::f64::consts::TAU / 1000.0);
    let segments: Vec<_> = (0..1000).map(|i| [DVec2::ZERO, rim(i)]).collect();
    let chained = chain(&segments, &[], true);
    assert_eq!(chained.len(), 500);
    for stroke in chained.iter() {
        assert!(stroke[0].distance(stroke[2]) > 1.999);
    }
}

/// A smooth curve goes on as itself across every vertex, whatever folds and
/// other curves end or cross there.
#[test]
fn a_contour_goes_on_across_vertices() {
    let ring = |i: usize| 10.0 * DVec2::from_angle(i as f64 * std::f64::consts::TAU / 40.0);
    let mut segments: Vec<_> = (0..40).map(|i| [ring(i), ring((i + 1) % 40)]).collect();
    // Folds end at some vertices, lines pass through others.
    for i in (0..40).step_by(4) {
        segments.push([ring(i), ring(i) * 0.3]);
        segments.push([ring(i + 2) * 0.5, ring(i + 2)]);
        segments.push([ring(i + 2), ring(i + 2) * 1.5]);
    }
    for junctions in [false, true] {
        let strokes = chain(&segments, &[], junctions);
        let around = strokes.iter().filter(|stroke| {
            is_closed(stroke) && stroke.iter().all(|p| (p.length() - 10.0).abs() < 1e-9)
        });
        assert_eq!(around.map(<[DVec2]>::len).collect::<Vec<_>>(), [41]);
        assert_eq!(strokes.len(), 1 + 10 + 10);
    }
}

proptest! {
    /// Points of which no three are collinear: every segment once, as few open strokes as the odd joints allow, and
    /// the same strokes whatever the order and sense of the segments.
    #[test]
    fn strokes_cover_the_segments_once_in_any_order(
        ends in prop::collection::vec((0i32..5, 0i32..5, 0i32..5, 0i32..5), 1..60),
        order in any::<u64>(),
    ) {
        let at = |x: i32, y: i32| {
            at(x, y) + DVec2::new(0.0137 * f64::from(y * y), 0.0173 * f64::from(x * x))
        };
        let mut distinct = BTreeMap::new();
        for (a, b, c, d) in ends {
            if (a, b) != (c, d) {
                distinct.insert(key(at(a, b), at(c, d)), [at(a, b), at(c, d)]);
            }
        }
        let segments: Vec<_> = distinct.values().copied().collect();
        let mut covered: Vec<_> = shapes(&segments).concat();
        covered.sort_unstable();
        prop_assert_eq!(covered, distinct.keys().copied().collect::<Vec<_>>());

        let mut degrees = BTreeMap::new();
        for end in segments.iter().flatten() {
            *degrees.entry([end.x.to_bits(), end.y.to_bits()]).or_insert(0) += 1;
        }
        let odd = degrees.values().filter(|degree| *degree % 2 == 1).count();
        let open = chain(&segments, &[], true).iter().filter(|stroke| stroke.first() != stroke.last()).count();
        prop_assert!(open <= odd / 2);

        let mut shuffled = segments.clone();
        let mut state = order | 1;
        for i in (1..shuffled.len()).rev() {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            shuffled.swap(i, (state >> 33) as usize % (i + 1));
            if state >> 63 == 1 {
                shuffled[i].reverse();
            }
        }
        prop_assert_eq!(shapes(&shuffled), shapes(&segments));
    }
}
