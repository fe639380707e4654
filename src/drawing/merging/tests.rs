//! What is promised of lines that nearly coincide, on random pages: twins,
//! chains of neighbours, flat crossings, corners, lenses, dashes.

#![allow(clippy::unwrap_used)]

use super::super::{Drawing, DrawingOptions, Hidden, Length, Paper, Scale, is_closed};
use super::LONG;
use super::joining::MOVED;
use crate::model::Unit;
use crate::run::Counters;
use crate::view::{Frame, LineClass, LinePiece, LineSource, VisibleLines};
use glam::{DVec2, dvec2};
use proptest::prelude::*;

mod doubled;
mod input;
mod ranks;

/// The sides of the page, mm.
const SIDE: f64 = 400.0;

/// The reach of all tests, mm.
const REACH: f64 = 0.1;

fn lines(pieces: Vec<LinePiece>) -> VisibleLines {
    VisibleLines {
        frame: Frame::PLANE,
        objects: vec!["all".into()],
        pieces,
        counters: Counters::default(),
    }
}

fn piece(run: u32, points: [DVec2; 2], visible: bool) -> LinePiece {
    LinePiece {
        class: LineClass::Crease,
        invisibility: u32::from(!visible),
        outline: false,
        points,
        depth: [0.0; 2],
        object: 0,
        source: LineSource::Edge([2 * run, 2 * run + 1]),
        run,
    }
}

fn drawn(view: &VisibleLines, reach: f64) -> Drawing {
    let options = DrawingOptions {
        paper: Paper::Sheet { width: SIDE, height: SIDE },
        scale: Scale::Factor(1.0),
        unit: Unit::Millimetre,
        hidden: Hidden::Solid,
        merge: Some(Length::new(reach).unwrap()),
        ..DrawingOptions::default()
    };
    Drawing::new(view, &options).unwrap()
}

fn segments(drawing: &Drawing) -> Vec<[DVec2; 2]> {
    let strokes = drawing.layers.iter().flat_map(|layer| layer.strokes.iter());
    strokes.flat_map(|stroke| stroke.windows(2).map(|pair| [pair[0], pair[1]])).collect()
}

fn stroke_count(drawing: &Drawing) -> usize {
    drawing.layers.iter().map(|layer| layer.strokes.len()).sum()
}

fn open_count(drawing: &Drawing) -> usize {
    let strokes = drawing.layers.iter().flat_map(|layer| layer.strokes.iter());
    strokes.filter(|stroke| !is_closed(stroke)).count()
}

fn length(drawing: &Drawing) -> f64 {
    drawing.layers.iter().map(|layer| layer.strokes.length()).sum()
}

fn distance(point: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let along = b - a;
    let share = ((point - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    point.distance(a + along * share)
}

/// The farthest that a point of some segments, one in each twentieth of a
/// millimetre, is from others.
fn farthest(of: &[[DVec2; 2]], from: &[[DVec2; 2]]) -> f64 {
    let mut most = 0.0_f64;
    for &[a, b] in of {
        let steps = (a.distance(b) / 0.05).ceil().max(1.0);
        for step in 0..=steps as u32 {
            let point = a.lerp(b, f64::from(step) / steps);
            let nearest = from.iter().map(|&segment| distance(point, segment));
            most = most.max(nearest.fold(f64::INFINITY, f64::min));
        }
    }
    most
}

/// What stands beside a line.
#[derive(Debug, Clone, Copy)]
enum Beside {
    /// A line so many reaches aside, that begins and ends elsewhere, turned a
    /// little.
    Twin { aside: f64, from: f64, to: f64, turn: f64 },
    /// Lines 0.6 reaches aside from one another.
    Chain(u32),
    /// A line across it at a flat angle.
    Crossing(f64),
    /// A line from its end back at a flat angle.
    Corner(f64),
    /// Two lines from end to end, that meet so many reaches aside.
    Lens(f64),
    /// A line so many reaches aside, in so many parts that are seen and hidden
    /// by turns.
    Dashes { aside: f64, parts: u32 },
}

fn beside() -> impl Strategy<Value = Beside> {
    prop_oneof![
        (-1.5..1.5, -0.3..0.4, 0.6..1.3, -0.004..0.004)
            .prop_map(|(aside, from, to, turn)| Beside::Twin { aside, from, to, turn }),
        (1..9_u32).prop_map(Beside::Chain),
        (0.001..0.2).prop_map(Beside::Crossing),
        (0.001..0.2).prop_map(Beside::Corner),
        (-1.5..1.5).prop_map(Beside::Lens),
        (-1.5..1.5, 2..9_u32).prop_map(|(aside, parts)| Beside::Dashes { aside, parts }),
    ]
}

/// Lines up to 40 mm long, each with some beside it; whether seen.
fn page() -> impl Strategy<Value = Vec<([DVec2; 2], bool)>> {
    page_of(1.0)
}

/// The same so many times as large, with the same distances aside.
fn page_of(size: f64) -> impl Strategy<Value = Vec<([DVec2; 2], bool)>> {
    let point = (0..30_i32, 0..30_i32).prop_map(move |(x, y)| size * dvec2(x.into(), y.into()));
    let line = [point.clone(), point].prop_filter("a point", |[a, b]| a != b);
    let group = (line, any::<bool>(), prop::collection::vec((beside(), any::<bool>()), 0..4));
    prop::collection::vec(group, 1..4).prop_map(|groups| {
        let mut all = Vec::new();
        for ([a, b], seen, others) in groups {
            all.push(([a, b], seen));
            let (along, aside) = (b - a, (b - a).perp().normalize() * REACH);
            let turned = |angle: f64| DVec2::from_angle(angle).rotate(along);
            for (other, seen) in others {
                match other {
                    Beside::Twin { aside: reaches, from, to, turn } => {
                        let start = a + aside * reaches;
                        all.push(([start + turned(turn) * from, start + turned(turn) * to], seen));
                    }
                    Beside::Chain(count) => all.extend((1..=count).map(|i| {
                        let off = aside * (0.6 * f64::from(i));
                        ([a + off, b + off], seen)
                    })),
                    Beside::Crossing(angle) => {
                        let (middle, half) = (a.lerp(b, 0.5), turned(angle) * 0.5);
                        all.push(([middle - half, middle + half], seen));
                    }
                    Beside::Corner(angle) => all.push(([b, b - turned(angle)], seen)),
                    Beside::Lens(reaches) => {
                        let middle = a.lerp(b, 0.5) + aside * reaches;
                        all.extend([([a, middle], seen), ([middle, b], seen)]);
                    }
                    Beside::Dashes { aside: reaches, parts } => {
                        let at = |i: u32| a.lerp(b, f64::from(i) / f64::from(parts));
                        let off = aside * reaches;
                        all.extend(
                            (0..parts)
                                .map(|i| ([at(i) + off, at(i + 1) + off], seen == (i % 2 == 0))),
                        );
                    }
                }
            }
        }
        all
    })
}

fn view_of(page: &[([DVec2; 2], bool)]) -> VisibleLines {
    lines((0..).zip(page).map(|(run, &(points, seen))| piece(run, points, seen)).collect())
}

/// What is drawn, without order or sense.
fn ink(drawing: &Drawing) -> Vec<[[u64; 2]; 2]> {
    let bits = |p: DVec2| [p.x.to_bits(), p.y.to_bits()];
    let mut all: Vec<_> = segments(drawing)
        .into_iter()
        .map(|segment| {
            let [a, b] = segment.map(bits);
            [a.min(b), a.max(b)]
        })
        .collect();
    all.sort_unstable();
    all
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn what_is_drawn_is_within_reach_of_what_was_both_ways(page in page()) {
        let view = view_of(&page);
        let [all, merged] = [0.0, REACH].map(|reach| segments(&drawn(&view, reach)));
        let lost = farthest(&all, &merged);
        prop_assert!(lost <= REACH + 1e-9, "{} mm away from all that is drawn", lost);
        let added = farthest(&merged, &all);
        prop_assert!(added <= REACH + 1e-9, "{} mm away from all that was", added);
    }

    /// Open strokes are counted: a ring that hung on nothing but what is left
    /// out becomes a stroke by itself, which has no ends.
    #[test]
    fn a_stroke_more_leaves_out_as_much_as_it_is_worth(page in page()) {
        let view = view_of(&page);
        let [all, merged] = [0.0, REACH].map(|reach| drawn(&view, reach));
        let left_out = length(&all) - length(&merged);
        prop_assert!(left_out >= -1e-9);
        // Less what is drawn to join the two ends of a stretch.
        let least = (LONG * (1.0 - MOVED) - 2.0) * REACH;
        let worth = (left_out / least).floor().max(0.0) as usize;
        let (before, after) = (stroke_count(&all), open_count(&merged));
        prop_assert!(after <= before + worth, "{} mm for {} of {}", left_out, after, before);
    }

    #[test]
    fn neither_order_nor_threads_matter(page in page(), seed in any::<u64>()) {
        let view = view_of(&page);
        let mut other = view.clone();
        let place = |piece: &LinePiece| (seed ^ u64::from(piece.run)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        other.pieces.sort_by_key(place);
        let [one, two] = [1, 2].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| drawn(&view, REACH))
        });
        prop_assert_eq!(&one, &two);
        prop_assert_eq!(ink(&one), ink(&drawn(&other, REACH)));
    }

    #[test]
    fn lines_that_cross_are_not_cut(angle in 0.001..0.2, seen in any::<[bool; 2]>()) {
        let (half, turn) = (dvec2(40.0, 0.0), DVec2::from_angle(angle));
        let page = [([-half, half], seen[0]), ([-turn.rotate(half), turn.rotate(half)], seen[1])];
        let view = view_of(&page);
        let [all, merged] = [0.0, REACH].map(|reach| ink(&drawn(&view, reach)));
        // Where they part by less than a reach in 40 mm they are twins, but
        // for those few that come near to it.
        if angle * 40.0 > 1.01 * REACH {
            prop_assert_eq!(all, merged);
        } else if angle * 40.0 < 0.98 * REACH {
            prop_assert_eq!(merged.len(), 1);
        }
    }

    #[test]
    fn twins_are_drawn_once(
        aside in -0.5..0.5,
        shift in -3.0..3.0,
        seen in any::<[bool; 2]>(),
        tilt in -0.001..0.001,
    ) {
        let (a, b) = (dvec2(0.0, 0.0), dvec2(60.0, 0.0));
        let twin = [dvec2(shift, aside * REACH), dvec2(60.0 + shift, aside * REACH + tilt)];
        let drawing = drawn(&view_of(&[([a, b], seen[0]), (twin, seen[1])]), REACH);
        let expected = if seen[0] == seen[1] { 1..=1 } else { 1..=2 };
        prop_assert!(expected.contains(&stroke_count(&drawing)), "{}", stroke_count(&drawing));
        let all = 60.0 + shift.abs();
        prop_assert!((length(&drawing) - all).abs() < 2.0 * REACH, "{} of {}", length(&drawing), all);
        // A seen line is there as long as it was.
        prop_assert!(length(&drawing) >= 60.0 - 1e-9);
    }
}

#[test]
fn the_visible_one_is_drawn_and_of_these_the_outline() {
    let at = |y: f64| [dvec2(0.0, y), dvec2(50.0, y)];
    let drawing = drawn(&view_of(&[(at(0.0), false), (at(0.04), true)]), REACH);
    let visible: Vec<_> = drawing.layers.iter().filter(|layer| !layer.strokes.is_empty()).collect();
    assert_eq!(visible.len(), 1);
    assert_eq!(visible[0].strokes.len(), 1);
    assert!(visible[0].label.contains("visible"), "{}", visible[0].label);
    // The upper one of the two, whose y on the page is the lesser.
    let mut view = view_of(&[(at(0.0), true), (at(0.04), true)]);
    for outline in 0..2 {
        view.pieces.iter_mut().for_each(|piece| piece.outline = piece.run == outline);
        let drawing = drawn(&view, REACH);
        let y = segments(&drawing)[0][0].y;
        assert_eq!(segments(&drawing).len(), 1);
        let other = segments(&drawn(&view, 0.0));
        let wanted = other.iter().map(|[a, _]| a.y).fold(
            if outline == 0 { 0.0_f64 } else { 1e9 },
            |m, y| {
                if outline == 0 { m.max(y) } else { m.min(y) }
            },
        );
        assert_eq!(y, wanted, "outline {outline}");
    }
}

#[test]
fn what_goes_on_beyond_its_twin_is_joined_to_it() {
    // Two halves of a line, that lie over one another in the middle.
    let halves = [[dvec2(0.0, 0.0), dvec2(60.0, 0.0)], [dvec2(30.0, 0.05), dvec2(90.0, 0.05)]];
    let drawing = drawn(&view_of(&halves.map(|points| (points, true))), REACH);
    assert_eq!(stroke_count(&drawing), 1);
    assert!((length(&drawing) - 90.0).abs() < REACH);
}

#[test]
fn nothing_drifts_along_a_chain_of_neighbours() {
    let chain: Vec<_> = (0..40)
        .map(|i| {
            let y = 0.6 * REACH * f64::from(i);
            ([dvec2(0.0, y), dvec2(50.0, y)], true)
        })
        .collect();
    let view = view_of(&chain);
    let kept = segments(&drawn(&view, REACH));
    // Every second is within reach of the one before.
    assert_eq!(kept.len(), 20);
    assert!(farthest(&segments(&drawn(&view, 0.0)), &kept) <= REACH);
}
