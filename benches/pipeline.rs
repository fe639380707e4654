//! The whole way from a file to a drawing, against reading the file.
//!
//! Contenders run in turn, round after round, so that a machine whose speed
//! drifts slows all of them alike; what counts are the ratios. The surface
//! is a torus, generated here, in binary STL. Tables on standard output:
//!
//! 1. binary STL to SVG against `stl_io` merely reading the same file,
//!    without and with the search for interpenetration, and with all edges;
//! 2. growth: the time at each doubling of the triangles, each run in a
//!    process of its own;
//! 3. exact decisions against floats with and without the filter, in a
//!    general and in an axis-aligned view;
//! 4. peak memory in a process of its own.
//!
//! `cargo bench --bench pipeline` (a million triangles; another number of
//! thousands as an argument: `-- 200`).

#![allow(clippy::print_stdout)]

use glam::{DVec3, Vec3};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;
use umriss::drawing::{Drawing, DrawingOptions};
use umriss::export::{SvgOptions, to_svg, write_file};
use umriss::kernel::predicates::{Exact, FilterOnly, Plain, Policy};
use umriss::model::{Camera, FeatureOptions, LineClass, Scene, SceneOptions, import};
use umriss::run::Run;
use umriss::view::{ObjectWish, PreparedView, Skips};
use umriss::visibility::{AppelOptions, appel, reduce};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// As in the program, for all contenders alike.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Which lines are drawn.
#[derive(Clone, Copy, PartialEq)]
enum Lines {
    Features,
    Intersections,
    AllEdges,
}

/// A view that is not aligned with anything, and one that is.
const GENERAL: DVec3 = DVec3::new(-7.3, 11.1, -8.7);
const ALIGNED: DVec3 = DVec3::new(0.0, 1.0, 0.0);

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, what, path, lines] = &arguments[..] {
        match what.as_str() {
            "--memory" => return memory_of_one_run(Path::new(path), lines),
            "--time" => return time_of_one_run(Path::new(path), lines),
            _ => {}
        }
    }
    let thousands = arguments.iter().skip(1).find_map(|word| word.parse().ok()).unwrap_or(1000);
    let folder = tempfile::tempdir()?;
    against_reading(folder.path(), thousands)?;
    growth(folder.path(), thousands)?;
    policies(folder.path(), thousands.min(200))?;
    memory(folder.path(), thousands)
}

/// Writes a torus of about `thousands` thousand triangles.
fn torus(folder: &Path, thousands: usize) -> Outcome<PathBuf> {
    let around = ((thousands * 1000) as f64).sqrt().round() as usize;
    let across = thousands * 500 / around;
    let point = |i: usize, j: usize| {
        let a = std::f64::consts::TAU * (i % around) as f64 / around as f64;
        let b = std::f64::consts::TAU * (j % across) as f64 / across as f64;
        let ring = 2.0 + 0.8 * b.cos();
        Vec3::new((ring * a.cos()) as f32, (ring * a.sin()) as f32, (0.8 * b.sin()) as f32)
    };
    let count = 2 * around * across;
    let mut bytes = Vec::with_capacity(84 + 50 * count);
    bytes.resize(80, b' ');
    bytes.extend((count as u32).to_le_bytes());
    for i in 0..around {
        for j in 0..across {
            let (a, b, c, d) = (point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
            for triangle in [[a, b, c], [a, c, d]] {
                bytes.extend([0; 12]);
                for corner in triangle {
                    corner.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
                }
                bytes.extend([0; 2]);
            }
        }
    }
    let path = folder.join(format!("torus-{thousands}k.stl"));
    std::fs::write(&path, bytes)?;
    Ok(path)
}

/// File in, file out.
fn draw<P: Policy>(path: &Path, lines: Lines, forward: DVec3) -> Outcome<usize> {
    let model = import::read_file(path, None)?;
    let scene = Scene::new(model.objects, &SceneOptions::default())?;
    let up = if forward == ALIGNED { DVec3::Z } else { DVec3::new(0.1, 0.2, 1.0) };
    let camera = Camera::Orthographic { forward, target: None, up };
    let view = camera.view(scene.mesh.bounds())?;
    let classes: Vec<LineClass> = LineClass::ALL
        .into_iter()
        .filter(|&class| match class {
            LineClass::Intersection => lines == Lines::Intersections,
            LineClass::Mesh => lines == Lines::AllEdges,
            _ => true,
        })
        .collect();
    let options = FeatureOptions::default().with_classes(&classes);
    let run = Run::default();
    let wishes =
        vec![ObjectWish { features: options, see_through: false }; scene.mesh.objects().len()];
    let skips = Skips::default();
    let prepared = PreparedView::for_visible_lines::<P>(&scene.mesh, &view, &wishes, &skips, &run)?;
    let question = prepared.question(false);
    let answer = appel::<P>(&question, &AppelOptions::default(), &run)?;
    let visible = reduce::<P>(&question, &answer, &run)?;
    let drawing = Drawing::new(&visible, &DrawingOptions::default())?;
    let svg = to_svg(&drawing, &SvgOptions::default())?;
    write_file(&path.with_extension("svg"), svg.as_bytes())?;
    Ok(visible.pieces.len())
}

fn read_with_stl_io(path: &Path) -> Outcome<usize> {
    let mut file = std::io::BufReader::new(std::fs::File::open(path)?);
    Ok(stl_io::read_stl(&mut file)?.faces.len())
}

/// One thing to be timed.
type Contender<'a> = (&'a str, &'a dyn Fn() -> Outcome<usize>);

/// Runs the contenders in turn and prints each one's median time, and the
/// median of its ratio to the first, round by round.
fn race(title: &str, rounds: usize, contenders: &[Contender]) -> Outcome<()> {
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); contenders.len()];
    for round in 0..=rounds {
        for (i, (_, work)) in contenders.iter().enumerate() {
            let start = Instant::now();
            std::hint::black_box(work()?);
            // The first round only warms up.
            if round > 0 {
                times[i].push(start.elapsed().as_secs_f64());
            }
        }
    }
    println!("\n{title}\n\n| | seconds | ratio |\n| --- | ---: | ---: |");
    for (i, (name, _)) in contenders.iter().enumerate() {
        let mut ratios: Vec<f64> = times[i].iter().zip(&times[0]).map(|(a, b)| a / b).collect();
        println!("| {name} | {:.3} | {:.2} |", median(&mut times[i].clone()), median(&mut ratios));
    }
    Ok(())
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn against_reading(folder: &Path, thousands: usize) -> Outcome<()> {
    let path = &torus(folder, thousands)?;
    race(
        &format!("Binary STL of {thousands} thousand triangles to SVG"),
        7,
        &[
            ("`stl_io` reads the file", &|| read_with_stl_io(path)),
            ("contours, creases, borders", &|| draw::<Exact>(path, Lines::Features, GENERAL)),
            ("with interpenetration", &|| draw::<Exact>(path, Lines::Intersections, GENERAL)),
            ("all edges", &|| draw::<Exact>(path, Lines::AllEdges, GENERAL)),
        ],
    )
}

/// Growth at each doubling: the sizes in turn, round after round, each run in
/// a process of its own. A process that has drawn before would keep the
/// memory of small scenes at hand and not that of large ones.
fn growth(folder: &Path, thousands: usize) -> Outcome<()> {
    const ROUNDS: usize = 9;
    println!("\nGrowth\n\n| thousand triangles | seconds | growth |\n| ---: | ---: | ---: |");
    let mut sizes = vec![2 * thousands];
    while sizes.last().is_some_and(|&size| size > 15) {
        sizes.push(sizes[sizes.len() - 1] / 2);
    }
    sizes.reverse();
    let paths: Vec<PathBuf> =
        sizes.iter().map(|&size| torus(folder, size)).collect::<Outcome<_>>()?;
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); sizes.len()];
    for _ in 0..ROUNDS {
        for (path, times) in paths.iter().zip(&mut times) {
            times.push(in_a_process("--time", path, "interpenetration")?.trim().parse()?);
        }
    }
    for (i, size) in sizes.iter().enumerate() {
        let growth = if i == 0 {
            String::new()
        } else {
            let ratios = times[i].iter().zip(&times[i - 1]).map(|(a, b)| a / b);
            format!("{:.2}", median(&mut ratios.collect::<Vec<f64>>()))
        };
        println!("| {size} | {:.3} | {growth} |", median(&mut times[i].clone()));
    }
    Ok(())
}

/// What this program prints when it is called with such arguments.
fn in_a_process(what: &str, path: &Path, lines: &str) -> Outcome<String> {
    let output = std::process::Command::new(std::env::current_exe()?)
        .args([Path::new(what), path, Path::new(lines)])
        .output()?;
    Ok(String::from_utf8(output.stdout)?)
}

/// The seconds of one run.
fn time_of_one_run(path: &Path, lines: &str) -> Outcome<()> {
    let start = Instant::now();
    draw::<Exact>(path, named(lines), GENERAL)?;
    println!("{}", start.elapsed().as_secs_f64());
    Ok(())
}

fn policies(folder: &Path, thousands: usize) -> Outcome<()> {
    let path = &torus(folder, thousands)?;
    for (name, forward) in [("general", GENERAL), ("axis-aligned", ALIGNED)] {
        race(
            &format!("Decisions, all edges of {thousands} thousand triangles, {name} view"),
            7,
            &[
                ("filter only", &|| draw::<FilterOnly>(path, Lines::AllEdges, forward)),
                ("exact", &|| draw::<Exact>(path, Lines::AllEdges, forward)),
                ("plain floats", &|| draw::<Plain>(path, Lines::AllEdges, forward)),
            ],
        )?;
    }
    Ok(())
}

/// Peak memory, each run in a process of its own.
fn memory(folder: &Path, thousands: usize) -> Outcome<()> {
    let path = torus(folder, thousands)?;
    println!("\nPeak memory\n\n| | MB | bytes a triangle |\n| --- | ---: | ---: |");
    for lines in ["features", "interpenetration", "all edges"] {
        let text = in_a_process("--memory", &path, lines)?;
        let Some(kilobytes) = text.trim().parse::<f64>().ok() else {
            println!("| {lines} | not told by this system | |");
            continue;
        };
        let each = kilobytes * 1024.0 / (thousands * 1000) as f64;
        println!("| {lines} | {:.0} | {each:.0} |", kilobytes / 1024.0);
    }
    Ok(())
}

fn memory_of_one_run(path: &Path, lines: &str) -> Outcome<()> {
    draw::<Exact>(path, named(lines), GENERAL)?;
    let status = std::fs::read_to_string("/proc/self/status")?;
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    println!("{}", peak.map_or("", |text| text.trim().trim_end_matches(" kB")));
    Ok(())
}

fn named(lines: &str) -> Lines {
    match lines {
        "features" => Lines::Features,
        "interpenetration" => Lines::Intersections,
        _ => Lines::AllEdges,
    }
}
