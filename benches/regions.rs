//! Visible regions: how long they take, and how that grows.
//!
//! Tables on standard output:
//!
//! 1. a torus of 5 to 80 thousand triangles, every triangle a face: seconds,
//!    and how many times longer than with half as many;
//! 2. separate tetrahedra in a square, as many: what lies apart must cost
//!    nothing;
//! 3. the models that are given as arguments.
//!
//! `cargo bench --bench regions` or `-- model.obj ...`.

#![allow(clippy::print_stdout)]

mod scenes;

use glam::{DVec3, dvec3};
use scenes::{apart, torus};
use std::error::Error;
use std::path::Path;
use std::time::Instant;
use umriss::exact;
use umriss::model::{Camera, FeatureOptions, Mesh, Soup, import};
use umriss::run::Run;
use umriss::visibility::RegionOptions;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Of so many runs the quickest counts.
const ROUNDS: usize = 3;

fn main() -> Outcome<()> {
    let models: Vec<String> =
        std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    println!("| model | triangles | regions | clipped | seconds | ratio |");
    println!("| --- | ---: | ---: | ---: | ---: | ---: |");
    for (name, scene) in [("torus", torus as fn(usize) -> Soup), ("apart", apart)] {
        let mut before = None;
        for thousands in [5, 10, 20, 40, 80] {
            let mesh = Mesh::new(vec![scene(thousands * 1000)], None)?;
            before = Some(measure(name, &mesh, before)?);
        }
    }
    for model in models {
        let objects = import::read_file(Path::new(&model), None)?.objects;
        measure(&model, &Mesh::new(objects, None)?, None)?;
    }
    Ok(())
}

/// Prints a row; returns the seconds.
fn measure(name: &str, mesh: &Mesh, before: Option<f64>) -> Outcome<f64> {
    let forward = dvec3(-0.62, -0.71, -0.43);
    let camera = Camera::Orthographic { forward, target: None, up: DVec3::Z };
    let view = camera.view(mesh.bounds())?;
    let options = FeatureOptions::default();
    let prepared = exact::prepare(mesh, &view, &options, &Run::default())?;
    let question = prepared.question(false);
    let (mut best, mut regions, mut clipped) = (f64::INFINITY, 0, 0);
    for _ in 0..ROUNDS {
        let run = Run::default();
        let start = Instant::now();
        let found = exact::visible_regions(&question, &RegionOptions::default(), &run)?;
        best = best.min(start.elapsed().as_secs_f64());
        regions = found.regions().len();
        clipped = run.counters().get("faces-clipped");
    }
    let ratio = before.map_or(String::new(), |before| format!("{:.2}", best / before));
    let count = mesh.triangles().len();
    println!("| {name} | {count} | {regions} | {clipped} | {best:.3} | {ratio} |");
    Ok(best)
}
