//! Whole drawings of hand-made and of random pieces.

#![allow(clippy::unwrap_used)]

use super::super::{Length, Paper, Scale, is_closed};
use super::*;
use crate::drawing::{Hidden, LayerBy};
use crate::model::Unit;
use crate::run::Counters;
use crate::view::{Frame, LineClass, LinePiece, LineSource, Projection};
use proptest::prelude::*;

fn lines(pieces: Vec<LinePiece>) -> VisibleLines {
    VisibleLines {
        frame: Frame::PLANE,
        objects: vec!["cup".into(), "".into(), "cup".into()],
        pieces,
        counters: Counters::default(),
    }
}

fn piece(a: (f64, f64), b: (f64, f64), run: u32) -> LinePiece {
    LinePiece {
        class: LineClass::Contour,
        invisibility: 0,
        outline: false,
        points: [a.into(), b.into()],
        depth: [0.0; 2],
        object: 0,
        source: LineSource::Edge([0, 1]),
        run,
    }
}

fn hidden(mut piece: LinePiece) -> LinePiece {
    piece.invisibility = 1;
    piece
}

/// A box of 40 x 20 mm with a hidden diagonal.
fn sample() -> VisibleLines {
    let corners = [(0.0, 0.0), (40.0, 0.0), (40.0, 20.0), (0.0, 20.0)];
    let mut pieces: Vec<_> =
        (0..4).map(|i| piece(corners[i], corners[(i + 1) % 4], i as u32)).collect();
    pieces.push(hidden(piece(corners[0], corners[2], 4)));
    lines(pieces)
}

fn draw(options: DrawingOptions) -> Drawing {
    Drawing::new(&sample(), &options).unwrap()
}

fn labels(drawing: &Drawing) -> Vec<&str> {
    drawing.layers.iter().map(|layer| layer.label.as_str()).collect()
}

#[test]
fn the_box_fits_between_the_margins_in_the_middle_and_upright() {
    let drawing = draw(DrawingOptions::default());
    assert_eq!((drawing.size, drawing.scale), (DVec2::new(210.0, 297.0), 4.75));
    let stroke = drawing.layers[0].strokes.get(0);
    // The lower left corner of the image is the first point; y runs down.
    assert_eq!(stroke[0], DVec2::new(10.0, 196.0));
    assert_eq!(stroke[2], DVec2::new(200.0, 101.0));
    assert!(is_closed(stroke));
}

#[test]
fn scale_and_unit_say_how_large_the_model_becomes() {
    let options = DrawingOptions { paper: Paper::Tight, ..DrawingOptions::default() };
    assert_eq!(draw(options).size, DVec2::new(60.0, 40.0));
    let halved = DrawingOptions { scale: Scale::Ratio(0.5), ..options };
    assert_eq!(draw(halved).size, DVec2::new(40.0, 30.0));
    let inches = DrawingOptions { unit: Unit::Inch, scale: Scale::Factor(0.1), ..options };
    assert!((draw(inches).size - DVec2::new(121.6, 70.8)).abs().max_element() < 1e-12);
    let sheet = DrawingOptions { scale: Scale::Ratio(1.0), ..DrawingOptions::default() };
    assert_eq!((draw(sheet).size, draw(sheet).scale), (DVec2::new(210.0, 297.0), 1.0));
    let lying = DrawingOptions { landscape: true, ..DrawingOptions::default() };
    assert_eq!(draw(lying).size, DVec2::new(297.0, 210.0));
}

#[test]
fn wishes_that_contradict_one_another_are_refused() {
    let refused = |options| Drawing::new(&sample(), &options).unwrap_err();
    let default = DrawingOptions::default();
    let large = DrawingOptions { scale: Scale::Ratio(6.0), ..default };
    assert!(matches!(refused(large), DrawingError::TooLarge { .. }));
    let margin = DrawingOptions { margin: Length::new(105.0).unwrap(), ..default };
    assert!(matches!(refused(margin), DrawingError::Margin { .. }));
    let wide = DrawingOptions { hidden_width: f64::NAN, ..default };
    assert!(matches!(refused(wide), DrawingError::PenWidth(_)));
    let endless = DrawingOptions { paper: Paper::Tight, scale: Scale::Factor(1e6), ..default };
    assert!(matches!(refused(endless), DrawingError::Endless { .. }));
    let nowhere = lines(vec![piece((0.0, f64::NAN), (1.0, 1.0), 0)]);
    assert_eq!(Drawing::new(&nowhere, &default), Err(DrawingError::NotFinite));
}

#[test]
fn perspective_has_factors_but_no_ratios() {
    let mut view = lines(vec![piece((-0.25, 0.0), (0.25, 0.0), 0)]);
    view.frame.projection = Projection::Perspective;
    let draw = |scale, paper| {
        Drawing::new(&view, &DrawingOptions { scale, paper, ..DrawingOptions::default() })
    };
    assert_eq!(draw(Scale::Ratio(0.5), Paper::A4), Err(DrawingError::PerspectiveRatio));
    assert_eq!(draw(Scale::Factor(300.0), Paper::Tight).unwrap().size, DVec2::new(170.0, 20.0));
    assert_eq!(draw(Scale::Fit, Paper::Tight).unwrap().size, DVec2::new(210.0, 20.0));
}

#[test]
fn boxes_without_area_are_centred() {
    let default = DrawingOptions::default();
    let empty = Drawing::new(&lines(vec![]), &default).unwrap();
    assert!(empty.layers.is_empty());
    assert_eq!(empty.size, DVec2::new(210.0, 297.0));
    let upright = lines(vec![piece((5.0, 1.0), (5.0, 2.0), 0)]);
    let drawing = Drawing::new(&upright, &default).unwrap();
    let expected = [DVec2::new(105.0, 287.0), DVec2::new(105.0, 10.0)];
    assert_eq!(drawing.layers[0].strokes.get(0), expected);
    let point = Drawing::new(&lines(vec![piece((7.0, 7.0), (7.0, 7.0), 0)]), &default).unwrap();
    assert!(point.layers.is_empty());
    assert_eq!(point.scale, 1.0);
    let tight = DrawingOptions { paper: Paper::Tight, margin: Length::default(), ..default };
    assert_eq!(Drawing::new(&upright, &tight).unwrap().size, DVec2::ONE);
}

#[test]
fn hidden_layers_are_numbered_last_and_painted_first() {
    let shown = DrawingOptions { hidden: Hidden::Solid, ..DrawingOptions::default() };
    let drawing = draw(shown);
    assert_eq!(labels(&drawing), ["2-hidden", "1-visible"]);
    assert_eq!((drawing.layers[0].style.width, drawing.layers[1].style.width), (0.25, 0.5));
    let mut view = sample();
    view.pieces[1].class = LineClass::Crease;
    view.pieces[1].object = 1;
    view.pieces[4].object = 2;
    let by = |layer_by| {
        Drawing::new(&view, &DrawingOptions { layer_by, ..shown })
            .map(|drawing| labels(&drawing).into_iter().map(str::to_owned).collect::<Vec<_>>())
    };
    assert_eq!(by(LayerBy::Class).unwrap(), ["3-contour-hidden", "1-contour", "2-crease"]);
    assert_eq!(by(LayerBy::Object).unwrap(), ["3-cup-hidden", "1-cup", "2-object"]);
}

#[test]
fn hidden_pieces_neither_drawn_nor_counted_in_the_box_unless_asked_for() {
    let mut view = sample();
    view.pieces.push(hidden(piece((0.0, 0.0), (400.0, 0.0), 9)));
    let without = Drawing::new(&view, &DrawingOptions::default()).unwrap();
    assert_eq!((labels(&without), without.scale), (vec!["1-visible"], 4.75));
    let dashed = DrawingOptions { hidden: Hidden::Dashed, ..DrawingOptions::default() };
    assert_eq!(Drawing::new(&view, &dashed).unwrap().scale, 0.475);
}

#[test]
fn pieces_of_one_run_become_one_segment_even_across_counts() {
    let run = |from: f64, to: f64| hidden(piece((from, 0.0), (to, 0.0), 7));
    let mut view = lines(vec![run(0.0, 1.0), run(1.0, 3.0), run(3.0, 4.0)]);
    view.pieces[1].invisibility = 2;
    let options = DrawingOptions { hidden: Hidden::Solid, ..DrawingOptions::default() };
    let count =
        |view: &VisibleLines| Drawing::new(view, &options).unwrap().layers[0].strokes.point_count();
    assert_eq!(count(&view), 2);
    // Another run that goes on collinearly needs no point either, a bend does.
    view.pieces[2].run = 8;
    assert_eq!(count(&view), 2);
    view.pieces[2].points[1].y = 0.5;
    assert_eq!(count(&view), 3);
}

#[test]
fn classes_stay_apart_and_tiny_strokes_away_on_request() {
    let mut view = sample();
    view.pieces[1].class = LineClass::Crease;
    let strokes =
        |options: DrawingOptions| Drawing::new(&view, &options).unwrap().layers.remove(0).strokes;
    let default = DrawingOptions::default();
    assert!(is_closed(strokes(default).get(0)));
    let apart = DrawingOptions { join: Join::Class, ..default };
    let apart = strokes(apart);
    assert_eq!((apart.len(), apart.get(0).len(), apart.get(1).len()), (2, 4, 2));
    // On the page the crease is 95 mm long, and a part of the outline.
    let min_length = Length::new(100.0).unwrap();
    let long = DrawingOptions { join: Join::Class, min_length, ..default };
    assert_eq!(strokes(long).len(), 2);
    // Hidden lines apart, it is alone if the others are.
    view.pieces[1].points = [(10.0, 5.0), (10.0, 15.0)].map(|(x, y)| DVec2::new(x, y));
    let drawn = Drawing::new(&view, &long).unwrap().layers.remove(0).strokes;
    assert_eq!((drawn.len(), drawn.get(0).len()), (1, 4));
}

proptest! {
    #[test]
    fn the_drawn_length_is_the_length_of_the_pieces(
        ends in prop::collection::vec(
            ((-9i32..9, -9i32..9), (-9i32..9, -9i32..9), 0u32..3, any::<bool>()), 1..80),
    ) {
        let float = |(x, y): (i32, i32)| (f64::from(x) / 3.0, f64::from(y) / 7.0);
        let pieces = ends.iter().enumerate().map(|(run, (a, b, object, seen))| LinePiece {
            object: *object,
            invisibility: u32::from(!seen),
            outline: false,
            ..piece(float(*a), float(*b), run as u32)
        }).collect();
        let view = lines(pieces);
        for layer_by in [LayerBy::Visibility, LayerBy::Class, LayerBy::Object] {
            let options = DrawingOptions {
                layer_by,
                hidden: Hidden::Solid,
                merge: Some(Length::new(0.0).unwrap()),
                ..DrawingOptions::default()
            };
            let drawing = Drawing::new(&view, &options).unwrap();
            let drawn: f64 = drawing.layers.iter().map(|layer| layer.strokes.length()).sum();
            let length = |piece: &LinePiece| piece.points[0].distance(piece.points[1]);
            let given: f64 = view.pieces.iter().map(length).sum::<f64>() * drawing.scale;
            prop_assert!((drawn - given).abs() <= 1e-9 * given);
            prop_assert_eq!(&Drawing::new(&view, &options).unwrap(), &drawing);
        }
    }
}
