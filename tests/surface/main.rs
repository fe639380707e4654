//! Surfaces: the exact horizon against the arrays of pixel columns, and
//! against the methods of meshes.

#![allow(clippy::unwrap_used)]

mod meshes;

use glam::{DVec3, dvec3};
use umriss::kernel::predicates::{Carrier, Exact, Measured, Place, Predicates};
use umriss::model::Camera;
use umriss::model::surface::{CurveOptions, Curves, Heights, Surface};
use umriss::raster::{ColumnsError, horizon_columns};
use umriss::run::Run;
use umriss::view::{PreparedSurface, SurfaceQuestion};
use umriss::visibility::floating_horizon;

/// A surface with a column of points on every column of pixels in the front
/// view, and a little off them in others.
fn surface(side: usize, height: impl Fn(f64, f64) -> f64) -> Surface {
    let steps: Vec<f64> = (0..side).map(|i| i as f64).collect();
    let place = |i: usize| 12.0 * i as f64 / (side - 1) as f64 - 6.0;
    let rows = (0..side).map(|j| (0..side).map(move |i| (i, j)));
    let values = rows.flatten().map(|(i, j)| height(place(i), place(j)) * side as f64).collect();
    let heights = Heights::new(steps.clone(), steps, values).expect("steps that grow");
    Surface::new(heights, None).expect("a surface")
}

/// The visible pieces of a line, from 0 to 1 along it.
fn exact_pieces(question: &SurfaceQuestion<'_>) -> Vec<Vec<[f64; 2]>> {
    let predicates = Predicates::<Exact>::new(question.lines.points);
    let answer = floating_horizon::<Exact>(question, &Run::default()).expect("an answer");
    let share = |carrier: Carrier, place| match place {
        Place::Start => 0.0,
        Place::End => 1.0,
        Place::Cut(cut) => {
            let values: [Measured; 2] = carrier.ends.map(|end| predicates.value(cut, end));
            predicates.parameter(carrier, cut, &values)
        }
    };
    let lines = question.lines.lines.iter().enumerate();
    lines
        .map(|(index, line)| {
            let carrier = question.lines.carrier(line);
            let pieces = answer.line(index).iter();
            pieces.map(|piece| [share(carrier, piece.from), share(carrier, piece.to)]).collect()
        })
        .collect()
}

/// How far a place of a line is from its pieces.
fn distance(pieces: &[[f64; 2]], at: f64) -> f64 {
    pieces.iter().map(|&[from, to]| (from - at).max(at - to).max(0.0)).fold(2.0, f64::min)
}

/// Places along all lines, how many, and how many of them are visible by one
/// method and, by the other, not visible within a column of there.
fn differences(surface: &Surface, forward: DVec3, columns: u32) -> [usize; 2] {
    let camera = Camera::Orthographic { forward, target: None, up: DVec3::Z };
    let view = camera.view(surface.bounds()).expect("a view");
    let run = Run::default();
    let options = CurveOptions::default();
    let prepared = PreparedSurface::new("wave", surface, &view, &options, &run)
        .expect("a surface that can be seen so");
    let question = prepared.question(false);
    let exact = exact_pieces(&question);
    let found = horizon_columns(&question, columns, &run).expect("columns");
    let vertices = surface.vertices();
    let lines = Curves::new(surface, &options).lines(surface);
    let [mut places, mut off] = [0; 2];
    for (index, line) in lines.iter().enumerate() {
        let [a, b] = line.map(|vertex| view.frame.image(vertices[vertex as usize]));
        // A column's width, as a share of the line: of one upright in the
        // image the share of its height.
        let span = (b - a).abs();
        let width = found.width / span.x.max(span.y).max(1e-300);
        for share in [0.1, 0.3, 0.5, 0.7, 0.9] {
            places += 1;
            let [own, other] = [&exact[index], &found.lines[index]];
            let seen = [own, other].map(|pieces| distance(pieces, share) == 0.0);
            let far = |pieces: &[[f64; 2]]| distance(pieces, share) > width;
            off += usize::from((seen[0] && far(other)) || (seen[1] && far(own)));
        }
    }
    [places, off]
}

#[test]
fn columns_of_pixels_agree_within_one_column() {
    // Additive, so that cells are flat.
    let wave = surface(61, |x, z| 0.1 * (x.sin() + z.cos()));
    let [places, off] = differences(&wave, dvec3(0.0, 1.0, -0.4), 61);
    assert!(places > 30_000);
    assert_eq!(off, 0, "of {places} places");
}

#[test]
fn undersides_are_found_by_the_arrays_too() {
    let valley = surface(41, |x, _| -0.12 * x.abs());
    let [places, off] = differences(&valley, dvec3(0.0, 1.0, 0.3), 41);
    assert_eq!(off, 0, "of {places} places");
}

#[test]
fn other_azimuths_agree_but_for_what_is_narrower_than_a_column() {
    let wave = surface(41, |x, z| 0.1 * x.sin() * z.cos());
    for forward in [dvec3(0.5, 1.0, -0.4), dvec3(-1.0, 0.3, -0.5), dvec3(0.7, -0.6, -0.3)] {
        let [places, off] = differences(&wave, forward, 400);
        assert!(off * 100 < places, "{off} of {places} places, {forward}");
    }
}

#[test]
fn arrays_know_parallel_rays_only() {
    let flat = surface(3, |_, _| 0.0);
    let eye = dvec3(1.0, -9.0, 3.0);
    let cameras = [
        (
            Camera::Perspective {
                eye,
                target: None,
                up: DVec3::Z,
                near: None,
                fov_y_degrees: 45.0,
            },
            ColumnsError::Perspective,
        ),
        (
            Camera::Orthographic { forward: -DVec3::Z, target: None, up: DVec3::Y },
            ColumnsError::Vertical,
        ),
    ];
    for (camera, expected) in cameras {
        let view = camera.view(flat.bounds()).unwrap();
        let (run, options) = (Run::default(), CurveOptions::default());
        let prepared = PreparedSurface::new("flat", &flat, &view, &options, &run)
            .expect("a surface that can be seen so");
        let found = horizon_columns(&prepared.question(false), 100, &run);
        assert_eq!(found, Err(expected));
    }
}
