//! Tolerances measured by brute force; what stays where it is.

use super::simplify::from_segment;
use super::*;
use proptest::prelude::*;

fn strokes(all: &[Vec<DVec2>]) -> Strokes {
    let mut strokes = Strokes::default();
    all.iter().for_each(|stroke| strokes.push(stroke.iter().copied()));
    strokes
}

fn smoothed(all: &[Vec<DVec2>], how: Smoothing, tolerance: f64) -> Strokes {
    smooth(&[strokes(all)], how, tolerance, 0.0).remove(0)
}

/// The greatest distance of any of many points of `from` from `to`.
fn far(from: &[DVec2], to: &[DVec2]) -> f64 {
    let mut worst: f64 = 0.0;
    for pair in from.windows(2) {
        for part in 0..=20 {
            let point = pair[0].lerp(pair[1], f64::from(part) / 20.0);
            let near = |side: &[DVec2]| from_segment(point, side[0], side[1]);
            worst = worst.max(to.windows(2).map(near).fold(f64::INFINITY, f64::min));
        }
    }
    worst
}

fn both(a: &[DVec2], b: &[DVec2]) -> f64 {
    far(a, b).max(far(b, a))
}

fn arc(radius: f64, from: f64, to: f64, parts: u32) -> Vec<DVec2> {
    let angle = |part: u32| from + (to - from) * f64::from(part) / f64::from(parts);
    (0..=parts).map(|part| DVec2::splat(100.0) + radius * DVec2::from_angle(angle(part))).collect()
}

#[test]
fn a_fine_circle_becomes_a_few_curves() {
    let mut circle = arc(40.0, 0.0, std::f64::consts::TAU, 200);
    circle[200] = circle[0];
    let fitted = smoothed(&[circle.clone()], Smoothing::Fit, 0.05);
    assert!(fitted.point_count() <= 13, "{}", fitted.point_count());
    assert!(is_closed(fitted.get(0)));
    assert!(both(fitted.flat(1e-4).get(0), &circle) <= 0.05);
    let simplified = smoothed(&[circle], Smoothing::Simplify, 0.05);
    assert!((20..100).contains(&simplified.point_count()), "{}", simplified.point_count());
}

#[test]
fn a_line_that_ends_on_an_arc_still_does_and_corners_stay() {
    let mut outline = arc(50.0, 0.0, 1.5, 60);
    let end = outline[20].lerp(outline[21], 0.3);
    let corner = outline[60];
    outline.extend((1..40).map(|step| corner + f64::from(step) * DVec2::new(0.5, 0.1)));
    let line = vec![DVec2::splat(100.0), end];
    for how in [Smoothing::Fit, Smoothing::Simplify] {
        let all = smoothed(&[outline.clone(), line.clone()], how, 0.05);
        assert!(all.get(0).contains(&end) && all.get(1).contains(&end), "{how:?}");
        let kept = all.get(0).iter().map(|p| p.distance(corner)).fold(f64::INFINITY, f64::min);
        assert!(kept <= if how == Smoothing::Fit { 0.0 } else { 0.05 }, "{how:?}: {kept}");
        assert!(all.point_count() < 30, "{how:?}: {}", all.point_count());
    }
}

#[test]
fn an_end_in_another_layer_is_a_junction_too() {
    let outline = arc(50.0, 0.0, 1.5, 60);
    let end = outline[20].lerp(outline[21], 0.3);
    let layers = [strokes(&[outline]), strokes(&[vec![DVec2::ZERO, end]])];
    let all = smooth(&layers, Smoothing::Fit, 0.05, 0.0);
    assert!(all[0].get(0).contains(&end));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Wiggling strokes of all sizes: never farther than the tolerance,
    /// measured both ways; ends stay; no more nodes than there were.
    #[test]
    fn the_tolerance_holds_both_ways(
        bends in prop::collection::vec((-0.6..0.6f64, 0.1..3.0f64), 2..60),
        close in any::<bool>(),
        tolerance in prop::sample::select(vec![0.01, 0.05, 0.5]),
    ) {
        let mut stroke = vec![DVec2::splat(100.0)];
        let (mut angle, mut at) = (0.0, stroke[0]);
        for (turn, length) in bends {
            angle += turn;
            at += length * DVec2::from_angle(angle);
            stroke.push(at);
        }
        if close {
            stroke.push(stroke[0]);
        }
        for how in [Smoothing::Fit, Smoothing::Simplify] {
            let smooth = smoothed(&[stroke.clone()], how, tolerance);
            let flat = smooth.flat(tolerance / 100.0);
            let apart = both(flat.get(0), &stroke);
            prop_assert!(apart <= tolerance * 1.02, "{how:?}: {apart}");
            prop_assert!(smooth.point_count() <= stroke.len());
            if !close {
                prop_assert_eq!(smooth.get(0)[0], stroke[0]);
                prop_assert_eq!(smooth.get(0).last(), stroke.last());
            }
            prop_assert_eq!(is_closed(flat.get(0)), is_closed(&stroke));
        }
    }
}

/// A bent stroke through a point, so many steps before it and after it.
fn bent(through: DVec2, turns: &[(f64, f64)]) -> Vec<DVec2> {
    let half = turns.len() / 2;
    let way = |turns: &mut dyn Iterator<Item = &(f64, f64)>, start: f64| {
        let (mut angle, mut at) = (start, through);
        let step = |&(turn, length): &(f64, f64)| {
            angle += turn;
            at += length * DVec2::from_angle(angle);
            at
        };
        turns.map(step).collect::<Vec<_>>()
    };
    let start = 10.0 * turns[0].0;
    let mut all = way(&mut turns[..half].iter().rev(), start + std::f64::consts::PI);
    all.reverse();
    all.push(through);
    all.extend(way(&mut turns[half..].iter(), start));
    all
}

fn from(point: DVec2, stroke: &[DVec2]) -> f64 {
    let near = |side: &[DVec2]| from_segment(point, side[0], side[1]);
    stroke.windows(2).map(near).fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Bent strokes that cross in common points, and others that end on them,
    /// in points and between them.
    #[test]
    fn what_met_still_meets_and_there_are_no_more_points(
        crossing in prop::collection::vec(
            prop::collection::vec((-0.3..0.3f64, 0.3..3.0f64), 4..30), 1..4),
        ending in prop::collection::vec(
            (any::<prop::sample::Index>(), any::<prop::sample::Index>(), prop::bool::ANY,
             0.05..0.95f64, prop::collection::vec((-0.3..0.3f64, 0.3..3.0f64), 2..12)), 0..5),
        tolerance in prop::sample::select(vec![0.02, 0.1, 0.5]),
    ) {
        let mut all: Vec<_> =
            crossing.iter().map(|turns| bent(DVec2::splat(100.0), turns)).collect();
        for (stroke, side, between, share, turns) in &ending {
            let on = &all[stroke.index(all.len())];
            let side = side.index(on.len() - 1);
            let foot = if *between { on[side].lerp(on[side + 1], *share) } else { on[side] };
            let mut new = bent(foot, turns);
            new.drain(..turns.len() / 2);
            all.push(new);
        }
        for how in [Smoothing::Fit, Smoothing::Simplify] {
            let smooth = smoothed(&all, how, tolerance);
            let flat = smooth.flat(1e-4);
            prop_assert!(smooth.point_count() <= all.iter().map(Vec::len).sum());
            for (index, stroke) in all.iter().enumerate() {
                let controls = smooth.bends(index).iter().flatten().count() * 2;
                prop_assert!(smooth.get(index).len() + controls <= stroke.len());
                let ends = [stroke[0], stroke[stroke.len() - 1]];
                let nodes = smooth.get(index);
                prop_assert_eq!([nodes[0], nodes[nodes.len() - 1]], ends);
                for (other, before) in all.iter().enumerate().filter(|(other, _)| *other != index) {
                    // Ends on others, and points that both have.
                    let common = stroke.iter().filter(|point| before.contains(point));
                    for point in common {
                        prop_assert!(nodes.contains(point), "{how:?}: {point} of {index}");
                    }
                    for end in ends.into_iter().filter(|end| from(*end, before) <= 1e-9) {
                        let gap = from(end, flat.get(other));
                        prop_assert!(gap <= 1e-6, "{how:?}: {gap} mm to {other}");
                    }
                }
            }
        }
    }
}
