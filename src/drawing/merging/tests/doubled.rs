//! Nothing is drawn twice, but for corners, crossings and what would cost a
//! stroke.

use super::super::{LONG, LONG_CORNER};
use super::*;

/// For what length a segment runs along with another one, within a distance
/// of it and always on one side.
fn alongside(one: [DVec2; 2], other: [DVec2; 2], within: f64) -> f64 {
    let along = (other[1] - other[0]).normalize();
    let place = one.map(|end| along.dot(end - other[0]));
    let side = one.map(|end| along.perp_dot(end - other[0]));
    let end = other[0].distance(other[1]);
    // The shares of `one` at which a quantity, linear along it, is in a range.
    let shares = |[from, to]: [f64; 2], low: f64, high: f64| match to - from {
        0.0 if low <= from && from <= high => [0.0, 1.0],
        0.0 => [1.0, 0.0],
        pace => {
            let (a, b) = ((low - from) / pace, (high - from) / pace);
            [a.min(b).max(0.0), a.max(b).min(1.0)]
        }
    };
    let beside = shares(place, 0.0, end);
    let one_sided = |low: f64, high: f64| {
        let near = shares(side, low, high);
        (near[1].min(beside[1]) - near[0].max(beside[0])).max(0.0)
    };
    let at = |share: f64| side[0] + (side[1] - side[0]) * share;
    if beside[1] <= beside[0] || at(beside[0]) * at(beside[1]) < 0.0 {
        return 0.0;
    }
    one_sided(-within, 0.0).max(one_sided(0.0, within)) * one[0].distance(one[1])
}

#[test]
fn the_length_of_running_along_is_measured() {
    let line = [dvec2(0.0, 0.0), dvec2(10.0, 0.0)];
    let beside = |a, b| alongside([a, b], line, 0.05);
    assert!((beside(dvec2(2.0, 0.04), dvec2(20.0, 0.04)) - 8.0).abs() < 1e-9);
    assert!((beside(dvec2(8.0, 0.0), dvec2(2.0, 0.0)) - 6.0).abs() < 1e-9);
    assert!((beside(dvec2(0.0, 0.0), dvec2(10.0, 0.1)) - 5.0).abs() < 1e-3);
    assert_eq!(beside(dvec2(2.0, 0.06), dvec2(20.0, 0.06)), 0.0);
    assert_eq!(beside(dvec2(10.0, 0.04), dvec2(20.0, 0.04)), 0.0);
    assert_eq!(beside(dvec2(0.0, -0.04), dvec2(10.0, 0.04)), 0.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// The limit is that of corners; it holds for lines that weave too.
    #[test]
    fn no_two_lines_run_along_for_long(page in page_of(6.0)) {
        let merged = segments(&drawn(&view_of(&page), REACH));
        for (i, &one) in merged.iter().enumerate() {
            for &other in &merged[..i] {
                let length = alongside(one, other, 0.5 * REACH);
                let most = LONG_CORNER * REACH;
                prop_assert!(length <= most, "{} mm: {:?} {:?}", length, one, other);
            }
        }
    }
}

#[test]
fn a_line_between_others_is_left_out_from_the_length_on_that_is_worth_a_stroke() {
    // From afar to a line, along it, and away: two strokes more or none.
    let strokes = |reaches: f64| {
        let end = 40.0 + reaches * REACH;
        let way = [
            dvec2(0.0, 30.0),
            dvec2(40.0, 0.4 * REACH),
            dvec2(end, 0.4 * REACH),
            dvec2(end + 40.0, 30.0),
        ];
        let mut page = vec![([dvec2(-10.0, 0.0), dvec2(end + 60.0, 0.0)], true)];
        page.extend(way.windows(2).map(|pair| ([pair[0], pair[1]], true)));
        let [all, merged] = [0.0, REACH].map(|reach| drawn(&view_of(&page), reach));
        assert_eq!(stroke_count(&all), 2);
        assert!(
            (length(&all) - length(&merged) - reaches * REACH).abs() < 4.0 * REACH
                || length(&all) == length(&merged)
        );
        stroke_count(&merged)
    };
    assert_eq!(strokes(0.9 * LONG), 2);
    assert_eq!(strokes(1.1 * LONG), 3);
}

#[test]
fn a_crossing_nearby_does_not_keep_a_hidden_twin() {
    // One stretch is long enough; a flat crossing is not another one.
    let page = [
        ([dvec2(0.0, 0.0), dvec2(70.0, 0.0)], false),
        ([dvec2(45.0, 0.03), dvec2(65.0, 0.05)], true),
        ([dvec2(5.0, -1.84), dvec2(65.0, 1.82)], true),
    ];
    let drawing = drawn(&view_of(&page), REACH);
    let hidden: f64 = drawing
        .layers
        .iter()
        .filter(|layer| layer.tags.level > 0)
        .map(|layer| layer.strokes.length())
        .sum();
    assert!((hidden - 50.0).abs() < 2.0 * REACH, "{hidden}");
}
