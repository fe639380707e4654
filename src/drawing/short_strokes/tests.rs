//! What is too short, by hand and by strokes.

use super::*;
use crate::drawing::chaining::chain;
use proptest::prelude::*;

fn kept(segments: &[[[f64; 2]; 2]]) -> Vec<bool> {
    let segments: Vec<_> = segments.iter().map(|ends| ends.map(DVec2::from)).collect();
    long_enough(&segments, 1.0)
}

#[test]
fn what_hangs_on_nothing_or_on_one_end_is_left_out() {
    let speck = [[50.0, 50.0], [50.5, 50.0]];
    let line = [[0.0, 0.0], [10.0, 0.0]];
    let on = [[10.0, 0.0], [20.0, 0.0]];
    let twig = [[10.0, 0.0], [10.0, 0.5]];
    let on_the_twig = [[[10.0, 0.5], [10.3, 0.8]], [[10.0, 0.5], [9.7, 0.8]]];
    let all = [speck, line, on, twig, on_the_twig[0], on_the_twig[1]];
    assert_eq!(kept(&all), [false, true, true, false, false, false]);
}

#[test]
fn a_short_stroke_between_others_is_kept() {
    let bars = [[[0.0, 0.0], [10.0, 0.0]], [[10.0, 0.0], [20.0, 0.0]]];
    let others = [[[0.0, 0.5], [10.0, 0.5]], [[10.0, 0.5], [20.0, 0.5]]];
    let link = [[10.0, 0.0], [10.0, 0.5]];
    assert_eq!(kept(&[bars[0], bars[1], others[0], others[1], link]), [true; 5]);
    assert_eq!(kept(&[bars[0], bars[1], link]), [true, true, false]);
}

#[test]
fn short_pieces_of_a_long_line_are_kept() {
    let at = |i: usize| [0.3 * i as f64, 0.0];
    let pieces: Vec<_> = (0..5).map(|i| [at(i), at(i + 1)]).collect();
    assert_eq!(kept(&pieces), [true; 5]);
    assert_eq!(kept(&pieces[..3]), [false; 3]);
}

/// Paths of short and of longer steps that begin on a coarse grid, so that
/// they meet; no segment twice.
fn net() -> impl Strategy<Value = Vec<[DVec2; 2]>> {
    let step = (-3..=3_i32, -3..=3_i32);
    let path = ((0..4_i32, 0..4_i32), prop::collection::vec(step, 1..7));
    prop::collection::vec(path, 1..10).prop_map(|paths| {
        let mut all = Vec::new();
        for ((x, y), steps) in paths {
            let mut at = (6 * x, 6 * y);
            for (dx, dy) in steps {
                let next = (at.0 + dx, at.1 + dy);
                if at != next {
                    all.push([at.min(next), at.max(next)]);
                }
                at = next;
            }
        }
        all.sort_unstable();
        all.dedup();
        // Off the grid, so that no three points are on one line.
        let off = |x: i32, y: i32| f64::from((7 * x * x + 3 * x * y + 5 * y * y).rem_euclid(19));
        let place = |(x, y): (i32, i32)| {
            let point = DVec2::new(f64::from(x), f64::from(y));
            (point + 0.01 * DVec2::new(off(x, y), off(y + 1, x))) / 6.0
        };
        all.into_iter().map(|ends| ends.map(place)).collect()
    })
}

fn length(stroke: &[DVec2]) -> f64 {
    stroke.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

fn is_part([a, b]: [DVec2; 2], stroke: &[DVec2]) -> bool {
    stroke.windows(2).any(|pair| pair == [a, b] || pair == [b, a])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn no_piece_of_a_long_stroke_is_left_out(net in net(), least in 0.2..4.0) {
        let kept = long_enough(&net, least);
        let strokes = chain(&net, &[], true);
        for stroke in strokes.iter().filter(|stroke| least + 1e-9 < length(stroke)) {
            for (segment, kept) in net.iter().zip(&kept) {
                prop_assert!(*kept || !is_part(*segment, stroke), "{:?} of {:?}", segment, stroke);
            }
        }
    }

    /// No hole is made: where a stroke is left out, of its ends at most one is
    /// on something that is drawn.
    #[test]
    fn what_is_left_out_connects_nothing(net in net(), least in 0.2..4.0) {
        let kept = long_enough(&net, least);
        let is_drawn = |point: DVec2| {
            net.iter().zip(&kept).any(|(ends, kept)| *kept && ends.contains(&point))
        };
        for stroke in chain(&net, &[], true).iter().filter(|stroke| length(stroke) + 1e-9 < least) {
            let is_kept = net.iter().zip(&kept).any(|(ends, kept)| *kept && is_part(*ends, stroke));
            let (first, last) = (stroke[0], stroke[stroke.len() - 1]);
            let joins = is_drawn(first) && is_drawn(last) && first != last;
            prop_assert!(is_kept || !joins, "{:?}", stroke);
        }
    }

    #[test]
    fn nothing_is_too_short_for_nothing(net in net()) {
        prop_assert!(long_enough(&net, 0.0).into_iter().all(|kept| kept));
    }
}
