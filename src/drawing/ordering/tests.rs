//! Orders of strokes: nothing lost, nothing longer, the same every time.

#![allow(clippy::unwrap_used)]

use super::*;
use crate::drawing::{Layer, LayerTags, LineStyle};
use crate::model::Color;
use proptest::prelude::*;
use std::time::Duration;

fn drawing(strokes: &[Vec<DVec2>]) -> Drawing {
    let mut all = Strokes::default();
    strokes.iter().for_each(|stroke| all.push(stroke.iter().copied()));
    let style = LineStyle { width: 0.5, color: Color([0; 3]) };
    let layer = Layer {
        number: 1,
        label: "1-visible".into(),
        style,
        strokes: all,
        tags: LayerTags::default(),
    };
    Drawing {
        size: DVec2::new(200.0, 100.0),
        scale: 1.0,
        layers: vec![layer],
        fills: Vec::new(),
        painting: Vec::new(),
    }
}

fn ordered(strokes: &[Vec<DVec2>], effort: Effort) -> Strokes {
    let mut drawing = drawing(strokes);
    drawing.order(effort);
    drawing.layers.remove(0).strokes
}

/// A number from 0 to 1 that depends on `seed` alone.
fn chance(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64
}

fn hatches(count: usize) -> Vec<Vec<DVec2>> {
    let mut seed = 5;
    let stroke = |_| {
        let from = DVec2::new(200.0 * chance(&mut seed), 100.0 * chance(&mut seed));
        vec![from, from + 2.0 * DVec2::from_angle(7.0 * chance(&mut seed))]
    };
    (0..count).map(stroke).collect()
}

fn at(x: i32, y: i32) -> DVec2 {
    DVec2::new(f64::from(x), f64::from(y))
}

/// A segment without direction, as bits.
fn key(pair: &[DVec2]) -> [[u64; 2]; 2] {
    let mut ends = [pair[0], pair[1]].map(|end| [end.x.to_bits(), end.y.to_bits()]);
    ends.sort_unstable();
    ends
}

fn segments<'a>(strokes: impl Iterator<Item = &'a [DVec2]>) -> Vec<[[u64; 2]; 2]> {
    let mut all: Vec<_> = strokes.flat_map(|stroke| stroke.windows(2).map(key)).collect();
    all.sort_unstable();
    all
}

#[test]
fn strokes_in_a_row_are_drawn_one_after_the_other_and_back_and_forth() {
    let stroke = |x: i32| vec![at(x, 0), at(x, 90)];
    let strokes = ordered(&[stroke(3), stroke(1), stroke(2)], Effort::Best);
    let firsts: Vec<DVec2> = strokes.iter().map(|stroke| stroke[0]).collect();
    assert_eq!(firsts, [at(1, 90), at(2, 0), at(3, 90)]);
}

#[test]
fn a_loop_begins_where_the_pen_passes() {
    let ring = vec![at(60, 40), at(60, 60), at(40, 60), at(40, 40), at(60, 40)];
    let lines = [vec![at(0, 70), at(30, 65)], vec![at(30, 35), at(0, 30)], ring];
    let strokes = ordered(&lines, Effort::Best);
    let begin = strokes.iter().find(|stroke| is_closed(stroke)).unwrap()[0];
    assert_eq!(begin.x, 40.0, "{strokes:?}");
    assert!(strokes.pen_up_length() < 39.0, "{strokes:?}");
}

#[test]
fn steps_help_and_are_reproducible() {
    let strokes = hatches(3000);
    let length = |effort| ordered(&strokes, effort).pen_up_length();
    let (greedy, some) = (length(Effort::Greedy), length(Effort::Steps(9000)));
    let best = length(Effort::Best);
    assert!(best < 0.8 * greedy, "{best} of {greedy}");
    assert!(best < some && some < greedy, "{some}");
    assert_eq!(length(Effort::Best), best);
    assert!(length(Effort::Time(Duration::from_millis(20))) < greedy);
}

#[test]
fn curves_are_reversed_and_turned_around_with_their_strokes() {
    let bulge = |from: DVec2, to: DVec2| {
        let side = (to - from).perp();
        (to, Some([from.lerp(to, 0.2) + side, from.lerp(to, 0.9) + 0.3 * side]))
    };
    let curved = |corners: &[DVec2]| {
        let mut nodes = vec![(corners[0], None)];
        nodes.extend(corners.windows(2).map(|pair| bulge(pair[0], pair[1])));
        nodes
    };
    let mut drawing = drawing(&[]);
    let ring = [at(60, 60), at(60, 40), at(40, 40), at(40, 60), at(60, 60)];
    let arcs = [[at(20, 70), at(0, 90)], [at(90, 20), at(30, 35)], [at(60, 45), at(150, 20)]];
    let strokes = &mut drawing.layers[0].strokes;
    strokes.push_curved(curved(&ring));
    arcs.iter().for_each(|arc| strokes.push_curved(curved(arc)));
    let cells = |drawing: &Drawing| {
        let flat = drawing.layers[0].strokes.flat(1e-3);
        let mut points: Vec<_> =
            flat.iter().flatten().map(|p| (*p * 1e6).round().as_i64vec2().to_array()).collect();
        points.sort_unstable();
        points.dedup();
        points
    };
    let before = (cells(&drawing), drawing.layers[0].strokes.clone());
    drawing.order(Effort::Best);
    assert_ne!(drawing.layers[0].strokes, before.1);
    assert_eq!(cells(&drawing), before.0);
}

/// The grid of `side` by `side` squares, each with its diagonal, is one graph
/// whose odd joints are known; as chaining leaves it.
#[test]
fn a_grid_of_triangles_takes_half_its_odd_joints() {
    let side = 20;
    let mut edges = Vec::new();
    for x in 0..=side {
        for y in 0..=side {
            for (dx, dy) in [(1, 0), (0, 1), (1, 1)] {
                if x + dx <= side && y + dy <= side {
                    edges.push([at(x, y), at(x + dx, y + dy)]);
                }
            }
        }
    }
    let mut degrees = std::collections::BTreeMap::new();
    for end in edges.iter().flatten() {
        *degrees.entry((end.x as i32, end.y as i32)).or_insert(0) += 1;
    }
    let odd = degrees.values().filter(|degree| *degree % 2 == 1).count();
    let chained: Vec<_> =
        crate::drawing::chaining::chain(&edges, &[], true).iter().map(<[DVec2]>::to_vec).collect();
    let trails = ordered(&chained, Effort::Best);
    assert_eq!(trails.len(), (odd / 2).max(1));
    assert_eq!(segments(trails.iter()), segments(edges.iter().map(|edge| &edge[..])));
}

proptest! {
    /// Whatever the strokes: the same lines, each once, in no more strokes,
    /// and no longer ways than greedy ones.
    #[test]
    fn an_order_is_a_permutation_of_the_strokes(
        strokes in prop::collection::vec(
            prop::collection::vec((0i32..12, 0i32..12), 2..7), 1..60),
        close in any::<u64>(),
        steps in 0u64..3000,
    ) {
        let strokes: Vec<Vec<DVec2>> = strokes.iter().enumerate().map(|(index, points)| {
            let mut points: Vec<_> = points.iter().map(|(x, y)| at(*x, *y)).collect();
            points.dedup();
            if close >> (index % 64) & 1 == 1 && 2 < points.len() && points.first() != points.last() {
                points.push(points[0]);
            }
            points
        }).filter(|points| 1 < points.len()).collect();
        prop_assume!(!strokes.is_empty());
        let greedy = ordered(&strokes, Effort::Greedy);
        let best = ordered(&strokes, Effort::Steps(steps));
        let given = segments(strokes.iter().map(Vec::as_slice));
        for ordered in [&greedy, &best] {
            prop_assert_eq!(&segments(ordered.iter()), &given);
            prop_assert!(ordered.len() <= strokes.len());
            let closed = ordered.iter().filter(|stroke| is_closed(stroke)).count();
            let open = |strokes: usize, closed: usize| strokes - closed;
            let were = strokes.iter().filter(|stroke| is_closed(stroke)).count();
            prop_assert_eq!(open(ordered.len(), closed), open(strokes.len(), were));
        }
        prop_assert!(best.pen_up_length() <= greedy.pen_up_length() + 1e-9);
        prop_assert_eq!(&ordered(&strokes, Effort::Steps(steps)), &best);
    }

    /// Strokes that touch nowhere come out as they went in, but for order,
    /// sense, and where loops begin.
    #[test]
    fn separate_strokes_stay_whole(count in 1usize..300, effort in 0u64..9000) {
        let strokes = hatches(count);
        let ordered = ordered(&strokes, Effort::Steps(effort));
        prop_assert_eq!(ordered.len(), count);
        let mut keys: Vec<_> = ordered.iter().map(key).collect();
        keys.sort_unstable();
        let mut given: Vec<_> = strokes.iter().map(|stroke| key(stroke)).collect();
        given.sort_unstable();
        prop_assert_eq!(keys, given);
    }
}
