//! How time and memory grow with the model, stage by stage.
//!
//! Tori of one thousand to two million triangles, as binary STL, are drawn
//! as SVG: features only, and all edges. Each run is a process of its own,
//! which tells the time of each stage and its peak memory (where the system
//! tells it); sizes take turns, and medians are told. Exponents are slopes of
//! straight lines through the logarithms, from 30 thousand triangles on.
//!
//! The floor of all this is to read the file and to find out which corners
//! are one vertex: how near the whole comes to it is told too.
//!
//! `cargo run --release --example growth`, or with a number for other sizes:
//! the largest, in thousands. Times are of one machine.

#![allow(clippy::print_stdout)]

mod fit;
mod one_run;

use fit::{exponent, median};
use one_run::{Figures, Lines};
use std::path::PathBuf;
use std::process::Command;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// As in the program.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Triangles, in thousands.
const SIZES: [usize; 8] = [1, 3, 10, 30, 100, 300, 1000, 2000];

/// Exponents are fitted from this size on.
const LARGE: usize = 30;

/// Runs of each size.
const ROUNDS: usize = 5;

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments[..] {
        [] => tables(2000),
        [most] => tables(most.parse()?),
        [path, lines] => one_run::tell(path.as_ref(), lines.parse()?),
        _ => Err("expected the largest size, in thousands of triangles".into()),
    }
}

/// All figures of one size, round by round.
struct Size {
    thousands: usize,
    path: PathBuf,
    runs: Vec<Figures>,
}

impl Size {
    fn median(&self, of: impl Fn(&Figures) -> f64) -> f64 {
        median(self.runs.iter().map(of).collect())
    }
}

fn tables(most: usize) -> Outcome<()> {
    let folder = tempfile::tempdir()?;
    for lines in [Lines::Features, Lines::AllEdges] {
        let mut sizes = Vec::new();
        for thousands in SIZES.into_iter().filter(|&size| size <= most) {
            let path = folder.path().join(format!("torus-{thousands}k.stl"));
            one_run::write_torus(&path, thousands)?;
            sizes.push(Size { thousands, path, runs: Vec::new() });
        }
        for _ in 0..ROUNDS {
            for size in &mut sizes {
                size.runs.push(in_a_process(size, lines)?);
            }
        }
        print(lines, &sizes);
    }
    Ok(())
}

/// One run, in a process that has not drawn before.
fn in_a_process(size: &Size, lines: Lines) -> Outcome<Figures> {
    let program = std::env::current_exe()?;
    let output = Command::new(program).arg(&size.path).arg(lines.name()).output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    Figures::parse(&String::from_utf8(output.stdout)?)
}

fn print(lines: Lines, sizes: &[Size]) {
    let Some(largest) = sizes.last() else { return };
    let stages: Vec<&str> = largest.runs[0].stages.iter().map(|(name, _)| &name[..]).collect();
    println!("\n{}, microseconds a triangle\n", lines.name());
    let heads: Vec<String> = sizes.iter().map(|size| format!("{}k", size.thousands)).collect();
    println!("| | {} | exponent |", heads.join(" | "));
    println!("| --- |{} ---: |", " ---: |".repeat(sizes.len()));
    for (place, name) in stages.iter().enumerate() {
        row(name, sizes, 1e6, |figures| figures.stages.get(place).map_or(0.0, |stage| stage.1));
    }
    row("all", sizes, 1e6, Figures::seconds);
    let floor = |figures: &Figures| figures.floor();
    row("all, of reading and welding", sizes, 0.0, |figures| figures.seconds() / floor(figures));
    row("peak memory, bytes a triangle", sizes, 1.0, |figures| figures.bytes);
}

/// A line of the table: each size's figure times `unit` a triangle, or as it
/// is where the unit is zero.
fn row(name: &str, sizes: &[Size], unit: f64, of: impl Fn(&Figures) -> f64) {
    let figures: Vec<(f64, f64)> =
        sizes.iter().map(|size| (size.thousands as f64 * 1e3, size.median(&of))).collect();
    let cells: Vec<String> = figures
        .iter()
        .map(|(triangles, figure)| match unit {
            0.0 => format!("{figure:.2}"),
            _ => format!("{:.3}", figure * unit / triangles),
        })
        .collect();
    let large: Vec<(f64, f64)> =
        figures.into_iter().filter(|(triangles, _)| *triangles >= LARGE as f64 * 1e3).collect();
    let slope = exponent(&large).map_or(String::new(), |slope| format!("{slope:.2}"));
    println!("| {name} | {} | {slope} |", cells.join(" | "));
}
