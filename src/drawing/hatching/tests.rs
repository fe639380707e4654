//! Hatches of areas that are known.

use super::*;
use crate::drawing::SurfaceOptions;
use crate::model::Frame;
use glam::{DVec3, dvec2};

fn light() -> Light {
    Light::new(
        &Frame::PLANE,
        &SurfaceOptions { light: Some(DVec3::Z), ..SurfaceOptions::default() },
    )
}

fn region(rings: Vec<Vec<DVec2>>, normal: DVec3) -> ImageRegion {
    ImageRegion { face: 0, object: 0, normal, color: None, polygons: vec![rings] }
}

fn square(low: f64, high: f64) -> Vec<DVec2> {
    vec![dvec2(low, low), dvec2(high, low), dvec2(high, high), dvec2(low, high)]
}

fn hatched(regions: Vec<ImageRegion>, hatch: &Hatch) -> Strokes {
    let regions = ImageRegions { regions, anchors: vec![dvec2(0.25, 0.5)] };
    hatches(&regions, light(), hatch, dvec2(100.0, 100.0), &|point| point).expect("a hatch")
}

fn flat(degrees: f64) -> Hatch {
    Hatch { tone: HatchTone::Flat, degrees, ..Hatch::default() }
}

#[test]
fn lines_have_the_length_of_the_area_over_the_spacing() {
    let hole: Vec<DVec2> = square(20.0, 40.0).into_iter().rev().collect();
    let area = 60.0 * 60.0 - 20.0 * 20.0;
    for degrees in [0.0, 17.0, 45.0, 90.0, 123.0] {
        let region = region(vec![square(10.0, 70.0), hole.clone()], DVec3::Z);
        for spacing in [0.5, 0.25] {
            let spacing = Length::from_millimetres(spacing);
            let hatch = Hatch { spacing, ..flat(degrees) };
            let length = hatched(vec![region.clone()], &hatch).length();
            let expected = area / spacing.millimetres();
            assert!((length / expected - 1.0).abs() < 0.02, "{degrees}: {length} {expected}");
        }
    }
}

#[test]
fn a_line_goes_on_across_the_regions_of_a_face() {
    let whole = hatched(vec![region(vec![square(10.0, 70.0)], DVec3::Z)], &flat(30.0));
    let [a, b, c, d] = [dvec2(10.0, 10.0), dvec2(70.0, 10.0), dvec2(70.0, 70.0), dvec2(10.0, 70.0)];
    let halves = [vec![a, b, c], vec![a, c, d]].map(|ring| region(vec![ring], DVec3::Z));
    let halves = hatched(halves.to_vec(), &flat(30.0));
    assert_eq!(whole.len(), halves.len());
    for (one, other) in whole.iter().zip(halves.iter()) {
        assert!(one.iter().zip(other).all(|(p, q)| p.distance(*q) < 1e-9));
    }
}

#[test]
fn no_line_ends_before_the_border() {
    let ring = vec![dvec2(3.1, 4.7), dvec2(91.3, 17.9), dvec2(40.1, 88.3)];
    let hatch = Hatch { spacing: Length::from_millimetres(0.1), ..flat(33.0) };
    let strokes = hatched(vec![region(vec![ring.clone()], DVec3::Z)], &hatch);
    assert!(strokes.len() > 500);
    for end in strokes.iter().flatten() {
        let inside =
            (0..3).all(|i| orient2d(coord(ring[i]), coord(ring[(i + 1) % 3]), coord(*end)) > 0.0);
        assert!(!inside, "{end} is inside");
        let near = (0..3).any(|i| {
            let (a, b) = (ring[i], ring[(i + 1) % 3]);
            ((b - a).perp_dot(*end - a) / a.distance(b)).abs() < 1e-11
        });
        assert!(near, "{end} is off the border");
    }
}

#[test]
fn darker_faces_are_denser_and_the_darkest_are_crossed() {
    let tilted = |cosine: f64| DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
    let lengths: Vec<f64> = [1.0, 0.7, 0.4, 0.1, -0.1, -0.4]
        .map(|cosine| {
            let region = region(vec![square(10.0, 70.0)], tilted(cosine));
            hatched(vec![region], &Hatch::default()).length()
        })
        .to_vec();
    assert_eq!(lengths[0], 0.0);
    assert!(lengths.windows(2).all(|pair| pair[0] < pair[1]), "{lengths:?}");
}

#[test]
fn an_object_takes_its_hatch_along() {
    let hatch = Hatch { anchor: HatchAnchor::Object, ..flat(45.0) };
    let shift = dvec2(0.4, 0.3);
    let strokes = |shift: DVec2| {
        let ring = square(10.0, 70.0).into_iter().map(|point| point + shift).collect();
        let regions = vec![region(vec![ring], DVec3::Z)];
        let regions = ImageRegions { regions, anchors: vec![dvec2(10.0, 10.0) + shift] };
        let size = dvec2(100.0, 100.0);
        hatches(&regions, light(), &hatch, size, &|point| point).expect("a hatch")
    };
    let (still, moved) = (strokes(DVec2::ZERO), strokes(shift));
    assert_eq!(still.len(), moved.len());
    for (one, other) in still.iter().flatten().zip(moved.iter().flatten()) {
        assert!((*one + shift).distance(*other) < 1e-9);
    }
}

#[test]
fn a_spacing_of_nothing_is_refused() {
    let hatch = Hatch { spacing: Length::from_millimetres(0.0), ..Hatch::default() };
    let none = ImageRegions::default();
    let refused = hatches(&none, light(), &hatch, DVec2::ONE, &|point| point);
    assert_eq!(refused, Err(DrawingError::HatchSpacing(0.0)));
}
