//! Forms against the predicates they stand for.

use super::super::{Exact, Eye};
use super::*;
use glam::DVec3;

/// Triangles and a lattice of rounded samples behind them.
struct Scene {
    points: Points,
    triangles: Vec<[u32; 3]>,
    first: u32,
}

const COLUMNS: u32 = 24;
const ROWS: u32 = 17;

/// Random triangles, every third with the corners of a coarse grid, seen
/// through samples that are multiples of `grain`.
fn scene(seed: u64, eye: Eye, offset: DVec3, grain: f64) -> Scene {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..40_u32 {
        for _ in 0..3 {
            let point = DVec3::new(random(), random(), random());
            let point = if i % 3 == 0 { (point * 4.0).round() / 4.0 } else { point };
            vertices.push(point + offset);
        }
        triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let first = vertices.len() as u32;
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            let place = DVec3::new(f64::from(column) / 16.0, 0.5, f64::from(row) / 16.0) + offset;
            vertices.push((place / grain).round() * grain);
        }
    }
    Scene { points: Points::new(&vertices, eye, None), triangles, first }
}

fn scenes() -> impl Iterator<Item = Scene> {
    let eyes = |offset: DVec3| {
        [
            Eye::Towards(DVec3::new(0.0, -1.0, 0.0)),
            Eye::Towards(DVec3::new(0.3, -1.0, 0.2)),
            Eye::At(DVec3::new(0.5, -2.0, 0.25) + offset),
            Eye::At(DVec3::new(0.5, 0.25, 0.5) + offset),
        ]
    };
    let places = [(DVec3::ZERO, 1e-13), (DVec3::splat(1e6), 1e-7), (DVec3::ONE, 0.01)];
    places.into_iter().flat_map(move |(offset, grain)| {
        let grain = f64::powi(2.0, f64::log2(grain) as i32);
        eyes(offset).into_iter().map(move |eye| scene(7, eye, offset, grain))
    })
}

#[test]
fn a_certain_sign_is_the_predicate_s() {
    let (mut certain, mut asked) = (0, 0);
    for scene in scenes() {
        let predicates = Predicates::<Exact>::new(&scene.points);
        let lattice = Lattice::new(&scene.points, scene.first, COLUMNS, ROWS);
        for &[p, q, _] in &scene.triangles {
            let form = predicates.side_form(&lattice, p, q);
            for (i, x) in (0..COLUMNS * ROWS).zip(scene.first..) {
                let sign = form.sign(i % COLUMNS, i / COLUMNS);
                asked += 1;
                certain += u32::from(sign.is_some());
                assert!(sign.is_none_or(|sign| sign == predicates.side(p, q, x)));
            }
        }
    }
    assert!(f64::from(certain) > 0.9 * f64::from(asked), "{certain} of {asked}");
}

#[test]
fn a_certain_order_is_the_predicate_s() {
    let (mut certain, mut asked) = (0, 0);
    for scene in scenes() {
        let predicates = Predicates::<Exact>::new(&scene.points);
        let lattice = Lattice::new(&scene.points, scene.first, COLUMNS, ROWS);
        for pair in scene.triangles.windows(2) {
            let facings = [0, 1].map(|i| predicates.facing(pair[i]));
            if facings.contains(&Sign::Zero) {
                continue;
            }
            let forms = [0, 1].map(|i| predicates.nearness_form(&lattice, pair[i]));
            let difference = forms[0].minus(&forms[1]);
            for (i, x) in (0..COLUMNS * ROWS).zip(scene.first..) {
                let sign = difference.sign(i % COLUMNS, i / COLUMNS);
                let truth = predicates.nearer(x, (pair[0], facings[0]), (pair[1], facings[1]));
                asked += 1;
                certain += u32::from(sign.is_some());
                assert!(sign.is_none_or(|sign| sign == truth));
            }
        }
    }
    assert!(f64::from(certain) > 0.9 * f64::from(asked), "{certain} of {asked}");
}

#[test]
fn ranges_end_where_signs_do() {
    for scene in scenes() {
        let predicates = Predicates::<Exact>::new(&scene.points);
        let lattice = Lattice::new(&scene.points, scene.first, COLUMNS, ROWS);
        for &[p, q, _] in &scene.triangles {
            let form = predicates.side_form(&lattice, p, q);
            for row in 0..ROWS {
                let (maybe, surely) =
                    (form.not_negative(3..COLUMNS, row), form.positive(3..COLUMNS, row));
                for column in 3..COLUMNS {
                    let sign = form.sign(column, row);
                    assert_eq!(maybe.contains(&column), sign != Some(Sign::Negative));
                    assert_eq!(surely.contains(&column), sign == Some(Sign::Positive));
                }
            }
        }
    }
}

#[test]
fn a_scene_too_wide_for_floats_has_no_certain_sign() {
    let tiny = DVec3::new(1e-300, 3e-300, 2e-300);
    let vertices = [DVec3::ZERO, tiny, DVec3::ONE, DVec3::X, DVec3::Y, DVec3::X * 1e300];
    let points = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
    let predicates = Predicates::<Exact>::new(&points);
    let lattice = Lattice::new(&points, 2, 2, 2);
    let form = predicates.side_form(&lattice, 0, 1);
    assert_eq!(form.sign(0, 0), None);
    assert_eq!(form.not_negative(0..2, 0), 0..2);
    assert!(form.positive(0..2, 0).is_empty());
    assert_eq!(predicates.nearness_form(&lattice, [0, 1, 2]).sign(1, 1), None);
}
