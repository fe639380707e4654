//! The rules of dashed lines, on known shapes and on random ones.

#![allow(clippy::unwrap_used)]

use super::*;
use proptest::prelude::*;

/// Width of line in most tests: dashes of 12 mm, gaps of 3 mm.
const WIDTH: f64 = 1.0;

fn dashes(stroke: &[DVec2]) -> Vec<Vec<DVec2>> {
    let mut strokes = Strokes::default();
    strokes.push(stroke.iter().copied());
    dashed(&strokes, Dash::Dashed, WIDTH).iter().map(<[DVec2]>::to_vec).collect()
}

fn x(x: f64) -> DVec2 {
    DVec2::new(x, 0.0)
}

/// Whether dashes are where they should be, but for rounding.
fn agree(dashes: &[Vec<DVec2>], expected: &[&[DVec2]]) -> bool {
    let near = |(a, b): (&DVec2, &DVec2)| a.distance(*b) < 1e-12 * 42.0;
    dashes.len() == expected.len()
        && dashes
            .iter()
            .zip(expected)
            .all(|(dash, other)| dash.len() == other.len() && dash.iter().zip(*other).all(near))
}

#[test]
fn a_line_of_nominal_length_has_nominal_dashes() {
    let expected = [[x(0.0), x(12.0)], [x(15.0), x(27.0)], [x(30.0), x(42.0)]];
    assert!(agree(&dashes(&[x(0.0), x(42.0)]), &expected.each_ref().map(|dash| &dash[..])));
}

#[test]
fn dashes_and_gaps_are_stretched_alike() {
    let expected = [[x(0.0), x(14.0)], [x(17.5), x(31.5)]];
    assert!(agree(&dashes(&[x(0.0), x(31.5)]), &expected.each_ref().map(|dash| &dash[..])));
}

#[test]
fn what_has_no_room_for_a_gap_is_solid() {
    assert_eq!(dashes(&[x(0.0), x(11.0)]), [[x(0.0), x(11.0)]]);
    assert_eq!(dashes(&[x(0.0), x(19.0)]), [[x(0.0), x(19.0)]]);
}

#[test]
fn a_corner_is_drawn_by_one_bent_dash() {
    let (corner, end) = (x(42.0), DVec2::new(42.0, 27.0));
    let dashes = dashes(&[x(0.0), corner, end]);
    assert_eq!(dashes.len(), 4);
    let bent = [x(30.0), corner, DVec2::new(42.0, 12.0)];
    assert!(agree(&dashes[2..], &[&bent, &[DVec2::new(42.0, 15.0), end]]));
}

#[test]
fn a_zigzag_finer_than_the_dashes_is_still_dashed() {
    let zigzag: Vec<_> = (0..100).map(|i| DVec2::new(f64::from(i), f64::from(i % 2))).collect();
    assert!(5 < dashes(&zigzag).len());
}

#[test]
fn a_closed_box_begins_at_a_corner_wherever_its_stroke_began() {
    let box_from =
        |start: DVec2| [start, x(60.0), DVec2::splat(60.0), DVec2::new(0.0, 60.0), x(0.0), start];
    let dashes = dashes(&box_from(x(7.0)));
    assert_eq!(dashes[0][0], x(60.0));
    for corner in [x(0.0), x(60.0), DVec2::splat(60.0), DVec2::new(0.0, 60.0)] {
        assert!(dashes.iter().flatten().any(|point| *point == corner), "{corner}");
    }
}

#[test]
fn a_circle_is_dashed_without_a_seam() {
    let rim = |i: usize| 50.0 * DVec2::from_angle((i % 90) as f64 * std::f64::consts::TAU / 90.0);
    let circle: Vec<_> = (0..=90).map(rim).collect();
    let dashes = dashes(&circle);
    let length =
        |dash: &[DVec2]| -> f64 { dash.windows(2).map(|pair| pair[0].distance(pair[1])).sum() };
    let (first, last) = (&dashes[0], &dashes[dashes.len() - 1]);
    assert_eq!((first[0], last[last.len() - 1]), (circle[0], circle[0]));
    let seam = length(first) + length(last);
    for dash in &dashes[1..dashes.len() - 1] {
        assert!((length(dash) - seam).abs() < 1e-9);
    }
}

proptest! {
    #[test]
    fn dashes_and_gaps_fill_the_line_and_dashes_end_it(
        points in prop::collection::vec((0.0..100.0f64, 0.0..100.0f64), 2..20),
        close in any::<bool>(),
        width in 0.1..2.0f64,
    ) {
        let mut points: Vec<_> = points.into_iter().map(DVec2::from).collect();
        if close {
            points.push(points[0]);
        }
        let path = Path::new(&points);
        let pattern = Pattern::new(Dash::Dashed, width).unwrap().along(&path);
        let length = path.length();
        prop_assert_eq!(pattern[0][0], 0.0);
        prop_assert_eq!(pattern[pattern.len() - 1][1], length);

        let dash_sum: f64 = pattern.iter().map(|dash| dash[1] - dash[0]).sum();
        let gap_sum: f64 = pattern.windows(2).map(|two| two[1][0] - two[0][1]).sum();
        prop_assert!((dash_sum + gap_sum - length).abs() < 1e-9 * length.max(1.0));
        for two in pattern.windows(2) {
            // Two thirds to twice the nominal gap: the pattern is adapted, not spoilt.
            let gap = (two[1][0] - two[0][1]) / (3.0 * width);
            prop_assert!(0.66 < gap && gap < 2.0, "gap of {} nominal", gap);
        }

        let mut strokes = Strokes::default();
        strokes.push(points.iter().copied());
        let drawn = dashed(&strokes, Dash::Dashed, width);
        prop_assert_eq!(drawn.len(), pattern.len());
        prop_assert!((drawn.length() - dash_sum).abs() < 1e-9 * length.max(1.0));
        let first = drawn.get(0)[0];
        let last = *drawn.get(drawn.len() - 1).last().unwrap();
        prop_assert!(points.contains(&first) && points.contains(&last));
        prop_assert!(close || (first == points[0] && last == points[points.len() - 1]));
    }
}
