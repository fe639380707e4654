//! What the drawing promises of its strokes, on random pictures: what is
//! drawn is as long as what was found, nothing is drawn twice, widths grow
//! with nearness, and an order of the pen is a permutation.

use glam::DVec2;
use proptest::prelude::*;
use umriss::drawing::{
    Drawing, DrawingOptions, Effort, Hidden, HiddenBy, LayerBy, Paper, Scale, Strokes, Styles,
    Weight, WeightBy,
};
use umriss::model::Unit;
use umriss::run::Counters;
use umriss::view::{Frame, LineClass, LinePiece, LineSource, VisibleLines};

/// Pieces on the lines of a grid, none of which covers another: runs are
/// rows, columns and diagonals; depths are a plane.
fn pictures() -> impl Strategy<Value = VisibleLines> {
    let place = (0..4_u32, 0..12_u32, 0..12_u32, 0..3_u32, 0..7_usize);
    prop::collection::btree_map((0..3_u32, 0..12_i32, 0..12_i32), place, 1..120).prop_map(|map| {
        let mut pieces = Vec::new();
        for ((way, x, y), (invisibility, _, _, object, class)) in map {
            let step = [DVec2::X, DVec2::Y, DVec2::ONE][way as usize];
            let from = DVec2::new(f64::from(x), f64::from(y)) * 1.37;
            let points = [from, from + step * 1.37];
            let run = match way {
                0 => y,
                1 => 100 + x,
                _ => 200 + x - y,
            };
            let depth = points.map(|p| 50.0 + 3.0 * p.x - 2.0 * p.y);
            pieces.push(LinePiece {
                class: LineClass::ALL[class],
                // More often visible than hidden.
                invisibility: invisibility.saturating_sub(1) * 2,
                outline: false,
                points,
                depth,
                object,
                source: LineSource::Edge([0, 1]),
                run: run as u32,
            });
        }
        let frame = Frame::PLANE;
        let objects = ["a", "b", "c"].map(str::to_owned).to_vec();
        VisibleLines { frame, objects, pieces, counters: Counters::default() }
    })
}

fn options() -> impl Strategy<Value = DrawingOptions> {
    let layers = prop_oneof![
        Just(LayerBy::Visibility),
        Just(LayerBy::Class),
        Just(LayerBy::Object),
        Just(LayerBy::Part)
    ];
    let weight = prop::option::of((0.2..1.0_f64, 0.1..1.0_f64, any::<bool>(), 1..9_u32));
    (layers, weight, any::<bool>(), any::<bool>()).prop_map(|(layer_by, weight, hidden, sheets)| {
        DrawingOptions {
            paper: Paper::Tight,
            scale: Scale::Factor(1.0),
            unit: Unit::Millimetre,
            layer_by,
            hidden: if hidden { Hidden::Solid } else { Hidden::None },
            hidden_by: if sheets { HiddenBy::Sheets } else { HiddenBy::Together },
            weight: weight.map(|(near, far, class, steps)| Weight {
                near,
                far,
                by: if class { WeightBy::Class } else { WeightBy::Depth },
                steps: Some(steps),
            }),
            ..DrawingOptions::default()
        }
    })
}

fn drawn(lines: &VisibleLines, options: &DrawingOptions) -> Drawing {
    Drawing::styled(lines, &[], options, &Styles::default()).unwrap()
}

fn segments(strokes: &Strokes) -> impl Iterator<Item = [DVec2; 2]> + '_ {
    strokes.iter().flat_map(|stroke| stroke.windows(2).map(|pair| [pair[0], pair[1]]))
}

/// What strokes draw, without order or sense.
fn ink(strokes: &Strokes) -> Vec<[[u64; 2]; 2]> {
    let bits = |p: DVec2| [p.x.to_bits(), p.y.to_bits()];
    let mut all: Vec<_> = segments(strokes)
        .map(|segment| {
            let [a, b] = segment.map(bits);
            [a.min(b), a.max(b)]
        })
        .collect();
    all.sort_unstable();
    all
}

proptest! {
    #[test]
    fn as_long_as_what_was_found(lines in pictures(), options in options()) {
        let seen = |piece: &&LinePiece| piece.is_visible() || options.hidden != Hidden::None;
        let found: f64 =
            lines.pieces.iter().filter(seen).map(|p| p.points[0].distance(p.points[1])).sum();
        let drawing = drawn(&lines, &options);
        let length: f64 = drawing.layers.iter().map(|layer| layer.strokes.length()).sum();
        prop_assert!((length - found).abs() <= 1e-9 * found, "{} of {}", length, found);
    }

    #[test]
    fn nothing_is_drawn_twice(lines in pictures(), options in options()) {
        let drawing = drawn(&lines, &options);
        let all: Vec<_> = drawing.layers.iter().flat_map(|layer| segments(&layer.strokes)).collect();
        for (i, [a, b]) in all.iter().enumerate() {
            for [c, d] in &all[i + 1..] {
                let along = (*b - *a).normalize();
                let off = |p: DVec2| along.perp_dot(p - *a).abs();
                if off(*c).max(off(*d)) < 1e-6 {
                    let at = [*a, *b, *c, *d].map(|p| along.dot(p - *a));
                    let shared = at[0].max(at[1]).min(at[2].max(at[3]))
                        - at[0].min(at[1]).max(at[2].min(at[3]));
                    prop_assert!(shared < 1e-6, "{} {} {} {}", a, b, c, d);
                }
            }
        }
    }

    #[test]
    fn widths_grow_with_nearness(lines in pictures(), near in 0.2..1.0_f64, far in 0.1..1.0_f64) {
        let weight = Weight { near, far, by: WeightBy::Depth, steps: None };
        let base = DrawingOptions {
            paper: Paper::Tight, scale: Scale::Factor(1.0), ..DrawingOptions::default()
        };
        let drawing = drawn(&lines, &DrawingOptions { weight: Some(weight), ..base });
        // The plane of depths, from the page: no place of a layer is nearer
        // than a place of a wider one, if near lines are the wide ones.
        let mut ranges: Vec<(f64, [f64; 2])> = Vec::new();
        let visible = || lines.pieces.iter().filter(|piece| piece.is_visible());
        let low = visible().flat_map(|p| p.points).fold(DVec2::INFINITY, DVec2::min);
        let high = visible().flat_map(|p| p.points).fold(DVec2::NEG_INFINITY, DVec2::max);
        let centre = (low + high) * 0.5;
        for layer in &drawing.layers {
            let depths = layer.strokes.iter().flatten().map(|p| {
                let q = *p - drawing.size * 0.5;
                50.0 + 3.0 * (centre.x + q.x) - 2.0 * (centre.y - q.y)
            });
            let (low, high) = depths
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), d| (l.min(d), h.max(d)));
            ranges.push((layer.style.width, [low, high]));
        }
        let [first, last] = visible().flat_map(|p| p.depth)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], d| [l.min(d), h.max(d)]);
        for (width, [low, high]) in &ranges {
            for depth in [low, high] {
                let share = if last > first { (depth - first) / (last - first) } else { 0.5 };
                let wanted = near + (far - near) * share;
                prop_assert!(last == first || (wanted - width).abs() < 0.05 + 1e-6);
            }
            for (other, [from, _]) in &ranges {
                if near > far && other < width || near < far && other > width {
                    prop_assert!(*high <= from + 1e-6, "{} {}", high, from);
                }
            }
        }
    }

    #[test]
    fn an_order_draws_the_same_in_no_more_strokes(lines in pictures(), options in options(), steps in 0..2000_u64) {
        let before = drawn(&lines, &options);
        for effort in [Effort::Greedy, Effort::Best, Effort::Steps(steps)] {
            let mut after = before.clone();
            after.order(effort);
            prop_assert_eq!(after.layers.len(), before.layers.len());
            for (one, other) in before.layers.iter().zip(&after.layers) {
                prop_assert_eq!(&one.label, &other.label);
                prop_assert_eq!(ink(&one.strokes), ink(&other.strokes));
                prop_assert!(other.strokes.len() <= one.strokes.len());
            }
        }
    }
}
