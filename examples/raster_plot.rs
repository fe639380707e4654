//! Where an image-space method is quicker than an exact drawing, and what
//! that costs: the plot `output/raster-error.svg` and its table.
//!
//! A z-buffer, or any other item buffer, draws lines without hidden lines
//! by looking each of their points up: at steps of a pixel, a point is
//! hidden if its pixel and those around it see something nearer. All methods
//! make the same buffer, so all get the same length of lines wrong at a
//! size; they differ in time. Appel's method has one time and no error.
//!
//! All run in turn, round after round, so that a machine whose speed drifts
//! slows all of them alike, and medians of the rounds are told.
//!
//! `cargo run --release --example raster_plot`. Times are of one machine.

#![allow(clippy::print_stdout)]

use glam::DVec3;
use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;
use umriss::exact;
use umriss::export::write_file;
use umriss::model::{Camera, FeatureOptions, LineClass, Scene, SceneOptions, import};
use umriss::raster::{ItemBuffer, Samples};
use umriss::run::{Cancelled, Run};
use umriss::view::VisibleLines;
use umriss::visibility::AppelOptions;

type Outcome<T> = Result<T, Box<dyn Error>>;

const SIZES: [u32; 5] = [128, 256, 512, 1024, 2048];
const ROUNDS: usize = 7;

/// Time in milliseconds and wrong share of the lines' length, by size.
struct Curve {
    name: &'static str,
    points: Vec<[f64; 2]>,
}

fn main() -> Outcome<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let model = import::read_file(&root.join("examples/models/spot.obj"), None)?;
    let mesh = Scene::new(model.objects, &SceneOptions::default())?.mesh;
    let forward = DVec3::new(0.9, -0.4, 0.8);
    let view = Camera::Orthographic { forward, target: None, up: DVec3::Y }.view(mesh.bounds())?;
    let run = Run::default();
    let options = FeatureOptions::default().with_classes(&LineClass::ALL);
    let prepared = exact::prepare(&mesh, &view, &options, &run)?;
    let question = prepared.question(true);

    let draw = || {
        let answer = exact::appel(&question, &AppelOptions::default(), &run)?;
        exact::reduce(&question, &answer, &run)
    };
    let lines = draw()?;

    let mut exact = Vec::new();
    let mut curves: Vec<Curve> =
        exact::image_methods().iter().map(|(name, _)| Curve { name, points: Vec::new() }).collect();
    for size in SIZES {
        let count = mesh.vertices().len() as u32;
        let samples = Samples::around(&view.frame, question.coordinates, count, size)
            .ok_or("the model has an image")?;
        let mut times = vec![Vec::new(); curves.len()];
        let mut wrong = 0.0;
        for _ in 0..ROUNDS {
            exact.push(milliseconds(draw)?.0);
            for (times, (_, method)) in times.iter_mut().zip(exact::image_methods()) {
                let look_up = || {
                    let buffer = method(&view, &question, &samples, &run)?;
                    Ok::<_, Cancelled>(wrong_share(&lines, &samples, &buffer))
                };
                let (time, share) = milliseconds(look_up)?;
                times.push(time);
                wrong = share;
            }
        }
        for (curve, times) in curves.iter_mut().zip(times) {
            curve.points.push([median(times), 100.0 * wrong]);
        }
    }
    let exact = median(exact);
    print_table(&curves, exact);
    write_file(&root.join("output/raster-error.svg"), plot(&curves, exact).as_bytes())?;
    Ok(())
}

/// The share of the lines' length about which a buffer is wrong.
fn wrong_share(lines: &VisibleLines, samples: &Samples, buffer: &ItemBuffer) -> f64 {
    let pixel = samples.pixel();
    let (mut wrong, mut all) = (0.0, 0.0);
    for piece in &lines.pieces {
        let [start, end] = piece.points;
        let length = start.distance(end);
        let steps = (length / pixel).ceil().max(1.0);
        for step in 0..steps as u32 {
            let share = (f64::from(step) + 0.5) / steps;
            let depth = piece.depth[0] + (piece.depth[1] - piece.depth[0]) * share;
            let hidden = samples
                .pixel_of(start.lerp(end, share))
                .is_some_and(|at| farthest_around(buffer, samples, at) < depth - 0.25 * pixel);
            all += length / steps;
            wrong += if hidden == piece.is_visible() { length / steps } else { 0.0 };
        }
    }
    wrong / all
}

/// The greatest depth of a pixel and its neighbours. A line on a surface has
/// something of the surface around it that is not nearer, however steep it
/// is; one behind a surface has not, but for a pixel along its border.
fn farthest_around(buffer: &ItemBuffer, samples: &Samples, [column, row]: [u32; 2]) -> f64 {
    let near = |at: u32, size: u32| at.saturating_sub(1)..(at + 2).min(size);
    let rows = near(row, samples.height());
    let pixels = rows.flat_map(|r| near(column, samples.width()).map(move |c| (c, r)));
    pixels.map(|(c, r)| buffer.depth(c, r)).fold(f64::NEG_INFINITY, f64::max)
}

/// How long something takes, and what comes of it.
fn milliseconds<T, E>(work: impl Fn() -> Result<T, E>) -> Result<(f64, T), E> {
    let start = Instant::now();
    let result = work()?;
    Ok((start.elapsed().as_secs_f64() * 1e3, result))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values[values.len() / 2]
}

fn print_table(curves: &[Curve], exact: f64) {
    let heads: String = SIZES.iter().map(|size| format!(" {size} |")).collect();
    println!("| milliseconds |{heads}\n| --- |{}", " ---: |".repeat(SIZES.len()));
    let row = |name: &str, cells: Vec<String>| println!("| {name} | {} |", cells.join(" | "));
    for curve in curves {
        row(curve.name, curve.points.iter().map(|[time, _]| format!("{time:.1}")).collect());
    }
    row("appel, exact", vec![format!("{exact:.1}"); SIZES.len()]);
    if let Some(curve) = curves.first() {
        let cells = curve.points.iter().map(|[_, wrong]| format!("{wrong:.2} %"));
        row("wrong length of lines", cells.collect());
    }
}

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 460.0;
/// Left, top, right and bottom of the plot.
const PLOT: [f64; 4] = [70.0, 20.0, 560.0, 400.0];
const COLORS: [&str; 8] =
    ["#1b6ca8", "#c1440e", "#2e8b57", "#8e44ad", "#b8860b", "#0e7c7b", "#7f1d1d", "#444444"];

/// Both axes in powers of ten.
struct Axes {
    low: [f64; 2],
    high: [f64; 2],
}

impl Axes {
    fn around(points: impl Iterator<Item = [f64; 2]>) -> Self {
        let start = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let (low, high) = points.fold(start, |(low, high), point| {
            let log = point.map(f64::log10);
            ([0, 1].map(|i| low[i].min(log[i])), [0, 1].map(|i| high[i].max(log[i])))
        });
        Axes { low: low.map(|x| (x - 0.1).floor()), high: high.map(|x| (x + 0.1).ceil()) }
    }

    fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let share = [0, 1].map(|i| (point[i].log10() - self.low[i]) / (self.high[i] - self.low[i]));
        let [left, top, right, bottom] = PLOT;
        [left + share[0] * (right - left), bottom + share[1] * (top - bottom)]
    }
}

/// Error against time, both logarithmic.
fn plot(curves: &[Curve], exact: f64) -> String {
    let least = curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]);
    let least = least.fold(f64::INFINITY, f64::min);
    let points = curves.iter().flat_map(|curve| curve.points.iter().copied());
    let axes = Axes::around(points.chain([[exact, least]]));
    let [left, top, right, bottom] = PLOT;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#ffffff\"/>\n"
    );
    // Writing to a string cannot fail.
    for decade in axes.low[0] as i32..=axes.high[0] as i32 {
        let value = f64::powi(10.0, decade);
        let [x, _] = axes.place([value, least]);
        let _ = writeln!(
            svg,
            "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"#dddddd\"/>\
             <text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{value} ms</text>",
            bottom + 18.0
        );
    }
    for decade in axes.low[1] as i32..=axes.high[1] as i32 {
        let value = f64::powi(10.0, decade);
        let [_, y] = axes.place([exact, value]);
        let _ = writeln!(
            svg,
            "<path d=\"M{left} {y:.1}H{right}\" stroke=\"#dddddd\"/>\
             <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{value} %</text>",
            left - 6.0,
            y + 4.0
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">time; marks are images of {} pixels \
         each way, from above</text>",
        (left + right) / 2.0,
        bottom + 42.0,
        SIZES.map(|size| size.to_string()).join(", ")
    );
    let _ = writeln!(
        svg,
        "<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">length of lines \
         that are wrong</text>",
        (top + bottom) / 2.0
    );
    for (i, curve) in curves.iter().enumerate() {
        let color = COLORS[i % COLORS.len()];
        let places: Vec<_> = curve.points.iter().map(|&point| axes.place(point)).collect();
        let path: Vec<_> = places.iter().map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
        let _ = write!(
            svg,
            "<path d=\"M{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\"/>",
            path.join("L")
        );
        for [x, y] in places {
            let _ = write!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{color}\"/>");
        }
        legend(&mut svg, i, color, curve.name);
    }
    let [x, _] = axes.place([exact, least]);
    let _ =
        write!(svg, "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"#000000\" stroke-width=\"2\"/>");
    legend(&mut svg, curves.len(), "#000000", "appel: no error");
    svg.push_str("</svg>\n");
    svg
}

fn legend(svg: &mut String, line: usize, color: &str, name: &str) {
    let (x, y) = (PLOT[2] + 16.0, PLOT[1] + 10.0 + 20.0 * line as f64);
    let _ = writeln!(
        svg,
        "<path d=\"M{x} {y}h18\" stroke=\"{color}\" stroke-width=\"2\"/>\
         <text x=\"{}\" y=\"{}\">{name}</text>",
        x + 24.0,
        y + 4.0
    );
}
