//! The order of strokes: pen-up length and time, beside vpype where that is
//! installed.
//!
//! 1. 50 000 separate strokes of 0.5 to 3 mm, shuffled: what `linesort` of
//!    vpype makes of them, greedy order, and greater and greater effort.
//!    vpype's time is that of a run with the command less that of one without.
//! 2. 50 000 of the edges of a grid of triangles, shuffled: the number of trails
//!    against half the number of odd joints.
//! 3. All edges of a torus, hidden ones too, 200 000 pieces and more: the time
//!    that their visibility takes, and that of styling, joining and ordering.
//!
//! `cargo bench --bench pen_order`; UMRISS_VPYPE names the program if it is
//! not on the path. Tables on standard output.

#![allow(clippy::print_stdout)]

use glam::{DVec2, DVec3};
use std::error::Error;
use std::path::Path;
use std::process::Command;
use std::time::Instant;
use umriss::drawing::{
    Drawing, DrawingOptions, Effort, Hidden, Layer, LayerTags, LineStyle, Paper, Strokes, Styles,
};
use umriss::exact;
use umriss::export::{SvgOptions, to_svg};
use umriss::model::{Camera, Color, FeatureOptions, Mesh, Soup};
use umriss::run::{Counters, Run};
use umriss::view::{Frame, LineClass, LinePiece, LineSource, VisibleLines};
use umriss::visibility::AppelOptions;

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let folder = tempfile::tempdir()?;
    println!("| 50 000 separate strokes | seconds | pen-up, m | ratio |");
    println!("| --- | ---: | ---: | ---: |");
    let strokes = separate(50_000);
    let svg = folder.path().join("strokes.svg");
    std::fs::write(&svg, to_svg(&strokes, &SvgOptions { precision: 6, ..SvgOptions::default() })?)?;
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
    grid()?;
    whole()
}

/// A drawing with everything: halos, widths by depth, dashes, an order.
fn whole() -> Outcome<()> {
    let (around, across) = (310_u32, 220_u32);
    let at = |i: u32, j: u32| {
        let [u, v] = [f64::from(i) / f64::from(around), f64::from(j) / f64::from(across)]
            .map(|turn| turn * std::f64::consts::TAU);
        let reach = 10.0 + 4.0 * v.cos();
        DVec3::new(reach * u.cos(), reach * u.sin(), 4.0 * v.sin())
    };
    let vertices = (0..around).flat_map(|i| (0..across).map(move |j| at(i, j))).collect();
    let mut soup = Soup { vertices, ..Soup::default() };
    for i in 0..around {
        for j in 0..across {
            let [k, l] = [(i + 1) % around, (j + 1) % across];
            let [a, b, c, d] = [[i, j], [k, j], [k, l], [i, l]].map(|[i, j]| i * across + j);
            soup.faces.push(&[a, b, c], None);
            soup.faces.push(&[a, c, d], None);
        }
    }
    let mesh = Mesh::new(vec![soup], None)?;
    let view =
        Camera::Orthographic { forward: DVec3::new(0.5, 0.7, -0.6), target: None, up: DVec3::Z };
    let view = view.view(mesh.bounds())?;
    let features = FeatureOptions::default().with_classes(&LineClass::ALL);
    let run = Run::default();
    let options = DrawingOptions {
        hidden: Hidden::Dashed,
        halo: "0.3mm".parse()?,
        weight: Some("0.35..0.1mm".parse()?),
        junctions: true,
        ..DrawingOptions::default()
    };
    println!("\n| all edges of a torus | seconds |");
    println!("| --- | ---: |");
    let mut best = [f64::INFINITY; 4];
    let mut pieces = 0;
    for _ in 0..3 {
        let start = Instant::now();
        let prepared = exact::prepare(&mesh, &view, &features, &run)?;
        let question = prepared.question(true);
        let answer = exact::appel(&question, &AppelOptions::default(), &run)?;
        let (lines, crossings) = exact::reduce_with_crossings(&question, &answer, &run)?;
        best[0] = best[0].min(start.elapsed().as_secs_f64());
        pieces = lines.pieces.len();
        let start = Instant::now();
        let mut drawing = Drawing::new(&lines, &options)?;
        drawing.order(Effort::Best);
        best[1] = best[1].min(start.elapsed().as_secs_f64());
        let start = Instant::now();
        let mut drawing = Drawing::styled(&lines, &crossings, &options, &Styles::default())?;
        best[2] = best[2].min(start.elapsed().as_secs_f64());
        drawing.order(Effort::Greedy);
        best[3] = best[3].min(start.elapsed().as_secs_f64());
    }
    println!("| visibility and crossings of {pieces} pieces | {:.2} |", best[0]);
    println!("| styled in widths and dashes, joined, best order | {:.2} |", best[1]);
    println!("| the same with halos, without order | {:.2} |", best[2]);
    println!("| the same with halos, greedy order | {:.2} |", best[3]);
    Ok(())
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
    let layer =
        Layer { number: 1, label: "1-visible".into(), style, strokes, tags: LayerTags::default() };
    Drawing {
        size: DVec2::new(420.0, 297.0),
        scale: 1.0,
        layers: vec![layer],
        fills: Vec::new(),
        painting: Vec::new(),
    }
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
        frame: Frame::PLANE,
        objects: vec!["grid".into()],
        pieces,
        counters: Counters::default(),
    };
    let start = Instant::now();
    let mut drawing = Drawing::new(
        &lines,
        &DrawingOptions { paper: Paper::A4, junctions: true, ..DrawingOptions::default() },
    )?;
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
        outline: false,
        points: ends.map(|(x, y)| DVec2::new(f64::from(x), f64::from(y))),
        depth: [0.0; 2],
        object: 0,
        source: LineSource::Edge([0, 1]),
        run,
    }
}
