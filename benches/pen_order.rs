//! The order of strokes: pen-up length and time, beside vpype where that is
//! installed.
//!
//! 1. 50 000 separate strokes of 0.5 to 3 mm, shuffled: what `linesort` of
//!    vpype makes of them, greedy order, and greater and greater effort.
//!    vpype's time is that of a run with the command less that of one without.
//! 2. 50 000 of the edges of a grid of triangles, shuffled: the number of trails
//!    against half the number of odd joints.
//!
//! `cargo bench --bench pen_order`; UMRISS_VPYPE names the program if it is
//! not on the path. Tables on standard output.

#![allow(clippy::print_stdout)]

use glam::{DVec2, DVec3};
use std::error::Error;
use std::path::Path;
use std::process::Command;
use std::time::Instant;
use umriss::drawing::{Drawing, DrawingOptions, Effort, Layer, LineStyle, Paper, Strokes};
use umriss::export::{SvgOptions, to_svg};
use umriss::model::Color;
use umriss::run::Counters;
use umriss::view::{Frame, LineClass, LinePiece, LineSource, Projection, VisibleLines};

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let folder = tempfile::tempdir()?;
    println!("| 50 000 separate strokes | seconds | pen-up, m | ratio |");
    println!("| --- | ---: | ---: | ---: |");
    let strokes = separate(50_000);
    let svg = folder.path().join("strokes.svg");
    std::fs::write(&svg, to_svg(&strokes, &SvgOptions { precision: 6, command: None })?)?;
    let mut reference = None;
    if let Some((seconds, metres)) = vpype(&svg)? {
        println!("| vpype linesort | {seconds:.2} | {metres:.2} | 1.00 |");
        reference = Some(metres);
    } else {
        println!("| vpype is not installed | | | |");
    }
    let efforts = [
        ("greedy", Effort::Greedy),
        ("4 steps a stroke", Effort::Steps(4 * 50_000)),
        ("best: 8 steps a stroke", Effort::Best),
        ("16 steps a stroke", Effort::Steps(16 * 50_000)),
        ("64 steps a stroke", Effort::Steps(64 * 50_000)),
    ];
    for (name, effort) in efforts {
        let mut best = f64::INFINITY;
        let mut metres = 0.0;
        for _ in 0..3 {
            let mut drawing = strokes.clone();
            let start = Instant::now();
            drawing.order(effort);
            best = best.min(start.elapsed().as_secs_f64());
            metres = pen_up(&drawing);
        }
        let ratio = reference.map_or(String::new(), |other: f64| format!("{:.3}", metres / other));
        println!("| {name} | {best:.2} | {metres:.2} | {ratio} |");
    }
    grid()
}

fn pen_up(drawing: &Drawing) -> f64 {
    drawing.layers.iter().map(|layer| layer.strokes.pen_up_length()).sum::<f64>() / 1000.0
}

/// Strokes of 0.5 to 3 mm anywhere on a sheet of A3.
fn separate(count: usize) -> Drawing {
    let mut dice = Dice(42);
    let mut strokes = Strokes::default();
    while strokes.len() < count {
        let from = DVec2::new(420.0 * dice.roll(), 297.0 * dice.roll());
        let way =
            (0.5 + 2.5 * dice.roll()) * DVec2::from_angle(std::f64::consts::TAU * dice.roll());
        strokes.push([from, from + way]);
    }
    let style = LineStyle { width: 0.3, color: Color([0; 3]) };
    let layer = Layer { number: 1, label: "1-visible".into(), style, strokes };
    Drawing { size: DVec2::new(420.0, 297.0), scale: 1.0, layers: vec![layer], fills: Vec::new() }
}

/// Numbers from 0 to 1 that are the same in every run.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Seconds that `linesort` takes and metres of pen-up way it leaves.
fn vpype(svg: &Path) -> Outcome<Option<(f64, f64)>> {
    let program = std::env::var("UMRISS_VPYPE").unwrap_or_else(|_| "vpype".to_owned());
    let timed = |sort: bool| -> Outcome<Option<(f64, String)>> {
        let start = Instant::now();
        let mut command = Command::new(&program);
        command.arg("read").arg(svg);
        if sort {
            command.arg("linesort");
        }
        match command.arg("stat").output() {
            Ok(output) if output.status.success() => {
                let text = String::from_utf8(output.stdout)?;
                Ok(Some((start.elapsed().as_secs_f64(), text)))
            }
            _ => Ok(None),
        }
    };
    let (Some((without, _)), Some((with, text))) = (timed(false)?, timed(true)?) else {
        return Ok(None);
    };
    let length = text
        .lines()
        .filter(|line| line.contains("Pen-up length"))
        .find_map(|line| line.split_whitespace().find_map(|word| word.parse::<f64>().ok()))
        .ok_or("vpype tells no pen-up length")?;
    // vpype counts in pixels of 1/96 inch.
    Ok(Some((with - without, length / 96.0 * 0.0254)))
}

/// The number of strokes that cover a grid of triangles.
fn grid() -> Outcome<()> {
    let side = 129_u32;
    let mut pieces = Vec::new();
    for x in 0..=side {
        for y in 0..=side {
            for (dx, dy) in [(1, 0), (0, 1), (1, 1)] {
                let (to_x, to_y) = (x + dx, y + dy);
                if to_x <= side && to_y <= side {
                    pieces.push(piece([(x, y), (to_x, to_y)], pieces.len() as u32));
                }
            }
        }
    }
    let mut dice = Dice(7);
    for last in (1..pieces.len()).rev() {
        pieces.swap(last, (dice.roll() * (last + 1) as f64) as usize);
    }
    pieces.truncate(50_000);
    let mut degrees = std::collections::BTreeMap::new();
    for end in pieces.iter().flat_map(|piece| piece.points) {
        *degrees.entry((end.x as u32, end.y as u32)).or_insert(0) += 1;
    }
    let odd = degrees.values().filter(|degree| *degree % 2 == 1).count();
    let edges = pieces.len();
    let lines = VisibleLines {
        frame: Frame {
            projection: Projection::Orthographic,
            origin: DVec3::ZERO,
            right: DVec3::X,
            up: DVec3::Y,
            forward: DVec3::NEG_Z,
            shear: DVec2::ZERO,
            half_height: None,
        },
        objects: vec!["grid".into()],
        pieces,
        counters: Counters::default(),
    };
    let start = Instant::now();
    let mut drawing =
        Drawing::new(&lines, &DrawingOptions { paper: Paper::A4, ..DrawingOptions::default() })?;
    drawing.order(Effort::Best);
    let seconds = start.elapsed().as_secs_f64();
    let trails = drawing.layers[0].strokes.len();
    let metres = pen_up(&drawing);
    println!("\n| a grid of triangles | edges | odd joints / 2 | strokes | pen-up, m | seconds |");
    println!("| --- | ---: | ---: | ---: | ---: | ---: |");
    println!(
        "| joined and ordered | {edges} | {} | {trails} | {metres:.2} | {seconds:.2} |",
        odd / 2
    );
    Ok(())
}

fn piece(ends: [(u32, u32); 2], run: u32) -> LinePiece {
    LinePiece {
        class: LineClass::Mesh,
        invisibility: 0,
        points: ends.map(|(x, y)| DVec2::new(f64::from(x), f64::from(y))),
        depth: [0.0; 2],
        object: 0,
        source: LineSource::Edge([0, 1]),
        run,
    }
}
