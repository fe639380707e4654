//! Image-space methods against image size and number of triangles, and
//! against the object-space method.
//!
//! Methods run in turn, round after round, so that a machine whose speed
//! drifts slows all of them alike; the least of the rounds is printed, for
//! other work on the machine can only add to it. The surface is a torus,
//! generated here, in a general view. What is timed is the way from the
//! prepared view to the item buffer, and for Appel's method to the lines:
//! all edges, hidden ones left out.
//!
//! `cargo bench --bench raster` (up to 100 thousand triangles and 1024
//! pixels; `-- 10` for fewer thousands).

#![allow(clippy::print_stdout)]

use glam::DVec3;
use std::error::Error;
use std::time::Instant;
use umriss::exact;
use umriss::model::{Camera, FeatureOptions, LineClass, Mesh, Soup};
use umriss::raster::Samples;
use umriss::run::Run;
use umriss::visibility::AppelOptions;

type Outcome<T> = Result<T, Box<dyn Error>>;

const SIZES: [u32; 3] = [256, 512, 1024];
const ROUNDS: usize = 5;

fn main() -> Outcome<()> {
    let most = std::env::args().skip(1).find_map(|word| word.parse().ok()).unwrap_or(100);
    let counts: Vec<usize> = [1, 10, 100].into_iter().filter(|&count| count <= most).collect();
    let mut names: Vec<&str> = exact::image_methods().iter().map(|(name, _)| *name).collect();
    names.push("appel, all edges");
    let mut columns = Vec::new();
    for &thousands in &counts {
        columns.extend(times(&torus(thousands * 1000)?)?);
    }
    println!("Milliseconds, by thousand triangles and pixels each way\n");
    let heads = counts.iter().flat_map(|count| SIZES.map(|size| format!(" {count}k, {size} |")));
    println!("| |{}", heads.collect::<String>());
    println!("| --- |{}", " ---: |".repeat(columns.len()));
    for (i, name) in names.iter().enumerate() {
        let cells: String = columns.iter().map(|column| format!(" {:.1} |", column[i])).collect();
        println!("| {name} |{cells}");
    }
    Ok(())
}

/// A torus of about so many triangles.
fn torus(triangles: usize) -> Outcome<Mesh> {
    let around = (triangles as f64).sqrt().round() as u32;
    let across = triangles as u32 / (2 * around);
    let turn = |i: u32, n: u32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
    let mut soup = Soup::default();
    for i in 0..around {
        for j in 0..across {
            let (a, b) = (turn(i, around), turn(j, across));
            let ring = 2.0 + 0.8 * b.cos();
            soup.vertices.push(DVec3::new(ring * a.cos(), ring * a.sin(), 0.8 * b.sin()));
        }
    }
    let at = |i: u32, j: u32| (i % around) * across + j % across;
    for i in 0..around {
        for j in 0..across {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            soup.faces.push(&[a, b, c], []);
            soup.faces.push(&[a, c, d], []);
        }
    }
    Ok(Mesh::new(vec![soup], None)?)
}

/// For each size the least milliseconds of all methods, Appel's last.
fn times(mesh: &Mesh) -> Outcome<Vec<Vec<f64>>> {
    let run = Run::default();
    let forward = DVec3::new(-7.3, 11.1, -8.7);
    let camera = Camera::Orthographic { forward, target: None, up: DVec3::new(0.1, 0.2, 1.0) };
    let view = camera.view(mesh.bounds())?;
    let options = FeatureOptions::default().with_classes(&LineClass::ALL);
    let prepared = exact::prepare(mesh, &view, &options, &run)?;
    let question = prepared.question(false);
    let count = mesh.vertices().len() as u32;
    let methods = exact::image_methods();
    let mut columns = Vec::new();
    for size in SIZES {
        let samples = Samples::around(&view.frame, question.coordinates, count, size)
            .ok_or("a torus has an image")?;
        let mut times = vec![Vec::new(); methods.len() + 1];
        for _ in 0..ROUNDS {
            for (i, (_, method)) in methods.iter().enumerate() {
                let start = Instant::now();
                std::hint::black_box(method(&view, &question, &samples, &run)?);
                times[i].push(start.elapsed().as_secs_f64() * 1e3);
            }
            let start = Instant::now();
            let answer = exact::appel(&question, &AppelOptions::default(), &run)?;
            std::hint::black_box(exact::reduce(&question, &answer, &run)?);
            times[methods.len()].push(start.elapsed().as_secs_f64() * 1e3);
        }
        columns.push(times.iter().map(|times| least(times)).collect());
    }
    Ok(columns)
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}
