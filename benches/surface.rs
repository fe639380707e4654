//! The floating horizon: seconds for each point of a grid, which should not
//! grow with the grid, and Appel's method on the same surface.
//!
//! Tables on standard output, for two azimuths and a perspective:
//!
//! 1. grids of 100 x 100 to 2000 x 2000 points: seconds for the horizon alone
//!    and for making lines of its answer, nanoseconds to a point, and that as
//!    a ratio to the smallest grid;
//! 2. the same lines on the surface's mesh by Appel's method, up to a number
//!    of points, as a multiple of the horizon's time. What either takes before
//!    it can begin counts too.
//!
//! `cargo bench --bench surface` or `-- 4000` for grids up to that size.

#![allow(clippy::print_stdout)]

use glam::{DVec3, dvec3};
use std::error::Error;
use std::time::Instant;
use umriss::exact;
use umriss::model::surface::{CurveOptions, Curves, Heights, Surface};
use umriss::model::{Camera, FeatureOptions, LineClass, Mesh, View};
use umriss::run::Run;
use umriss::view::PreparedSurface;
use umriss::visibility::AppelOptions;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Of so many runs the quickest counts.
const ROUNDS: usize = 3;

/// Grids beyond this many points each way are not given to Appel's method.
const MESHES: usize = 500;

fn main() -> Outcome<()> {
    let number = std::env::args().skip(1).find_map(|word| word.parse::<usize>().ok());
    let largest = number.unwrap_or(2000);
    println!("| view | grid | pieces | horizon s | ns/point | ratio | lines s | appel / horizon |");
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    for (name, camera) in cameras() {
        let mut first = None;
        for side in [100, 200, 500, 1000, 2000, 4000] {
            if side <= largest {
                let per_point = measure(name, camera, side, first)?;
                first = first.or(Some(per_point));
            }
        }
    }
    Ok(())
}

fn cameras() -> [(&'static str, Camera); 3] {
    let parallel = |forward| Camera::Orthographic { forward, target: None, up: DVec3::Z };
    let eye = Camera::Perspective {
        eye: dvec3(3.0, -25.0, 12.0),
        target: None,
        up: DVec3::Z,
        near: None,
        fov_y_degrees: 45.0,
    };
    [
        ("azimuth 0", parallel(dvec3(0.0, 1.0, -0.5))),
        ("azimuth 30", parallel(dvec3(0.5, 0.866, -0.5))),
        ("perspective", eye),
    ]
}

/// Prints a row; returns the nanoseconds to a point.
fn measure(name: &str, camera: Camera, side: usize, first: Option<f64>) -> Outcome<f64> {
    let steps = |axis| Heights::steps(axis, [-6.0, 6.0], side);
    let (xs, zs) = (steps('x')?, steps('z')?);
    let wave = |x: f64, z: f64| x.sin() * z.cos() + 0.1 * (7.0 * x).sin() * (5.0 * z).sin();
    let values = zs.iter().flat_map(|&z| xs.iter().map(move |&x| wave(x, z))).collect();
    let surface = Surface::new(Heights::new(xs, zs, values)?, None)?;
    let view = camera.view(surface.bounds())?;
    let (mut best, mut reducing, mut pieces) = (f64::INFINITY, f64::INFINITY, 0);
    for _ in 0..ROUNDS {
        let run = Run::default();
        let start = Instant::now();
        let options = CurveOptions::default();
        let prepared = PreparedSurface::new("wave", &surface, &view, &options, &run)?;
        let question = prepared.question(false);
        let answer = exact::floating_horizon(&question, &run)?;
        best = best.min(start.elapsed().as_secs_f64());
        let start = Instant::now();
        pieces = exact::reduce(&question.lines, &answer, &run)?.pieces.len();
        reducing = reducing.min(start.elapsed().as_secs_f64());
    }
    let per_point = best * 1e9 / (side * side) as f64;
    let ratio = first.map_or(String::new(), |first| format!("{:.2}", per_point / first));
    let appel = match side <= MESHES {
        true => format!("{:.1}", by_appel(&surface, &view)? / best),
        false => String::new(),
    };
    println!(
        "| {name} | {side} x {side} | {pieces} | {best:.3} | {per_point:.0} | {ratio} | \
         {reducing:.3} | {appel} |"
    );
    Ok(per_point)
}

/// Seconds that Appel's method takes for the same lines.
fn by_appel(surface: &Surface, view: &View) -> Outcome<f64> {
    let curves = Curves::new(surface, &CurveOptions::default());
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let run = Run::default();
        let start = Instant::now();
        let mesh = Mesh::new(vec![surface.soup("wave", &curves)], None)?;
        let options = FeatureOptions::default().with_classes(&[LineClass::Line]);
        let prepared = exact::prepare(&mesh, view, &options, &run)?;
        exact::appel(&prepared.question(false), &AppelOptions::default(), &run)?;
        best = best.min(start.elapsed().as_secs_f64());
    }
    Ok(best)
}
