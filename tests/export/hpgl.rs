//! HPGL, read back by a parser that forgives nothing.

use crate::fixture::cube;
use crate::strict_plotter::{self, Limits, Plot};
use glam::DVec2;
use proptest::prelude::*;
use umriss::drawing::{Drawing, DrawingOptions, Hidden, Layer, LayerTags, LineStyle, Strokes};
use umriss::export::{ExportError, PLOTTER_UNIT, to_hpgl};
use umriss::model::Color;

/// A generic plotter with a page of this size, plotter units.
fn plot(text: &str, high: [i64; 2]) -> Result<Plot, String> {
    strict_plotter::plot(text, Limits { low: [0, 0], high, pens: 8, select: None })
}

fn drawing(size: DVec2, strokes: &[Vec<DVec2>], number: u32) -> Drawing {
    let mut all = Strokes::default();
    strokes.iter().for_each(|stroke| all.push(stroke.iter().copied()));
    let style = LineStyle { width: 0.5, color: Color([0; 3]) };
    let layer = Layer {
        number,
        label: format!("{number}-test"),
        style,
        strokes: all,
        tags: LayerTags::default(),
    };
    Drawing { size, scale: 1.0, layers: vec![layer], fills: Vec::new(), painting: Vec::new() }
}

#[test]
fn pens_follow_the_layers_and_begin_again_after_the_eighth() {
    let options = DrawingOptions { hidden: Hidden::Solid, ..DrawingOptions::default() };
    let text = to_hpgl(&Drawing::new(&cube(), &options).unwrap()).unwrap();
    let pens: Vec<u32> = plot(&text, [8400, 11880]).unwrap().iter().map(|s| s.0).collect();
    assert!(pens.is_sorted_by_key(|pen| std::cmp::Reverse(*pen)) && pens.contains(&2));
    let ninth = drawing(DVec2::splat(9.0), &[vec![DVec2::ZERO, DVec2::ONE]], 9);
    assert!(to_hpgl(&ninth).unwrap().starts_with("IN;\nSP1;\nPU0,360;\nPD40,320;\n"));
}

#[test]
fn a_page_beyond_16_bits_is_refused_with_its_numbers() {
    let a1 = drawing(DVec2::new(841.0, 594.0), &[], 1);
    let message = to_hpgl(&a1).unwrap_err().to_string();
    assert!(message.contains("33640") && message.contains("32767"), "{message}");
}

#[test]
fn a_stroke_that_leaves_the_page_is_refused() {
    let stroke = vec![DVec2::ONE, DVec2::new(9.1, 1.0)];
    let outside = to_hpgl(&drawing(DVec2::splat(9.0), &[stroke], 1));
    assert!(matches!(outside, Err(ExportError::OutsidePage { x: 9.1, .. })));
}

proptest! {
    /// Every vertex within one unit of where the drawing has it; what is
    /// lost is shorter than a unit.
    #[test]
    fn the_plot_is_the_drawing_within_a_unit(
        strokes in prop::collection::vec(
            prop::collection::vec((0.0..200.0f64, 0.0..100.0f64), 2..200), 0..6),
        tiny in any::<bool>(),
    ) {
        let size = DVec2::new(200.0, 100.0);
        let shrink = if tiny { 1e-3 } else { 1.0 };
        let strokes: Vec<Vec<DVec2>> = strokes
            .into_iter()
            .map(|stroke| stroke.into_iter().map(|p| DVec2::from(p) * shrink).collect())
            .collect();
        let plotted = plot(&to_hpgl(&drawing(size, &strokes, 1)).unwrap(), [8000, 4000]);
        let plotted = plotted.map_err(TestCaseError::fail)?;
        let mut plotted = plotted.iter();
        for stroke in &strokes {
            let mut expected: Vec<DVec2> = stroke.iter().map(|p| {
                (DVec2::new(p.x, size.y - p.y) / PLOTTER_UNIT).round()
            }).collect();
            expected.dedup();
            if expected.len() < 2 {
                continue;
            }
            let (_, points) = plotted.next().unwrap();
            prop_assert_eq!(points.len(), expected.len());
            for (point, expected) in points.iter().zip(expected) {
                let point = DVec2::new(point[0] as f64, point[1] as f64);
                prop_assert!((point - expected).abs().max_element() <= 1.0);
            }
        }
        prop_assert!(plotted.next().is_none());
    }
}
