//! The painter: how long each of its ways takes, and how that grows.
//!
//! Tables on standard output, all times in microseconds for each triangle,
//! the quickest of some runs:
//!
//! 1. a torus of 1 to 100 thousand triangles, every triangle a face, and
//!    separate tetrahedra as many: the order from the graph, from the list and
//!    from a tree, the pieces of graph and tree, and the order for one more
//!    view of a tree that is there already; what graph and list take as ratios
//!    to the smallest scene;
//! 2. the models that are given as arguments.
//!
//! `cargo bench --bench painter` or `-- model.obj ...`.

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
use umriss::visibility::{Painter, PainterOptions};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Of so many runs the quickest counts.
const ROUNDS: usize = 3;

fn main() -> Outcome<()> {
    let models: Vec<String> =
        std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    println!(
        "| model | triangles | graph | ratio | list | ratio | tree | ratio | one more view | cuts, \
         graph | cuts, tree |"
    );
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    for (name, scene) in [("torus", torus as fn(usize) -> Soup), ("apart", apart)] {
        let mut first = None;
        for thousands in [1, 3, 10, 30, 100] {
            let mesh = Mesh::new(vec![scene(thousands * 1000)], None)?;
            let times = measure(name, &mesh, first)?;
            first = first.or(Some(times));
        }
    }
    for model in models {
        let objects = import::read_file(Path::new(&model), None)?.objects;
        measure(&model, &Mesh::new(objects, None)?, None)?;
    }
    Ok(())
}

/// Prints a row; returns the microseconds for each triangle by all ways.
fn measure(name: &str, mesh: &Mesh, first: Option<[f64; 3]>) -> Outcome<[f64; 3]> {
    let forward = dvec3(-0.62, -0.71, -0.43);
    let camera = Camera::Orthographic { forward, target: None, up: DVec3::Z };
    let view = camera.view(mesh.bounds())?;
    let options = FeatureOptions::default();
    let prepared = exact::prepare(mesh, &view, &options, &Run::default())?;
    let question = prepared.question(false);
    let (mut best, mut cuts, mut more) = ([f64::INFINITY; 3], [0; 3], f64::INFINITY);
    for _ in 0..ROUNDS {
        for (i, painter) in Painter::ALL.into_iter().enumerate() {
            let (run, start) = (Run::default(), Instant::now());
            let options = PainterOptions { painter, ..PainterOptions::default() };
            cuts[i] = exact::paint_order(&question, &options, &run)?.cuts;
            best[i] = best[i].min(start.elapsed().as_secs_f64());
        }
        let tree = exact::paint_tree(&question, &Run::default())?;
        let start = Instant::now();
        exact::paint_order_of_tree(&tree, &question, &Run::default())?;
        more = more.min(start.elapsed().as_secs_f64());
    }
    let count = mesh.triangles().len();
    let each = |seconds: f64| seconds * 1e6 / count as f64;
    let times = best.map(each);
    let [graph, list, tree] = [0, 1, 2].map(|i| {
        let ratio = first.map_or(String::new(), |first| format!("{:.2}", times[i] / first[i]));
        format!("{:.2} | {ratio}", times[i])
    });
    println!(
        "| {name} | {count} | {graph} | {list} | {tree} | {:.2} | {} | {} |",
        each(more),
        cuts[0],
        cuts[2]
    );
    Ok(times)
}
