//! One drawing, in a process of its own: from a file to a file.

use super::Outcome;
use glam::{DVec3, Vec3};
use std::f64::consts::TAU;
use std::path::Path;
use std::time::Instant;
use umriss::drawing::{Drawing, DrawingOptions};
use umriss::exact;
use umriss::export::{SvgOptions, to_svg, write_file};
use umriss::model::{Camera, FeatureOptions, LineClass, Scene, SceneOptions, import};
use umriss::run::Run;
use umriss::view::ObjectWish;
use umriss::visibility::AppelOptions;

/// Which lines are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Lines {
    Features,
    AllEdges,
}

impl Lines {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Lines::Features => "Features only",
            Lines::AllEdges => "All edges",
        }
    }
}

impl std::str::FromStr for Lines {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let all = [Lines::Features, Lines::AllEdges];
        all.into_iter().find(|lines| lines.name() == text).ok_or(format!("unknown lines: {text}"))
    }
}

/// What one run tells.
pub(crate) struct Figures {
    /// Names and seconds, in the order of the run.
    pub(crate) stages: Vec<(String, f64)>,
    /// Peak memory; not a number, where the system does not tell.
    pub(crate) bytes: f64,
}

impl Figures {
    pub(crate) fn seconds(&self) -> f64 {
        self.stages.iter().map(|(_, time)| time).sum()
    }

    /// What no drawing can do without: the file and its mesh.
    pub(crate) fn floor(&self) -> f64 {
        let needed = |name: &str| [READING, MESH].contains(&name);
        self.stages.iter().filter(|(name, _)| needed(name)).map(|(_, time)| time).sum()
    }

    fn print(&self) {
        self.stages.iter().for_each(|(name, time)| println!("{name}\t{time}"));
        println!("\t{}", self.bytes);
    }

    pub(crate) fn parse(text: &str) -> Outcome<Self> {
        let mut figures = Figures { stages: Vec::new(), bytes: f64::NAN };
        for line in text.lines() {
            let (name, figure) = line.split_once('\t').ok_or("expected a name and a number")?;
            match name {
                "" => figures.bytes = figure.parse()?,
                _ => figures.stages.push((name.to_owned(), figure.parse()?)),
            }
        }
        Ok(figures)
    }
}

const READING: &str = "reading";
const MESH: &str = "mesh";

/// Draws a file and prints figures.
pub(crate) fn tell(path: &Path, lines: Lines) -> Outcome<()> {
    let run = Run::default();
    let start = Instant::now();
    let drawn = draw(path, lines, &run)?;
    let all = start.elapsed().as_secs_f64();
    let mut stages: Vec<(String, f64)> = Vec::new();
    for stage in run.times() {
        stages.push((stage.stage.to_owned(), stage.time.as_secs_f64()));
    }
    let staged: f64 = stages.iter().map(|(_, time)| time).sum();
    stages.push(("between stages".to_owned(), (all - staged).max(0.0)));
    std::hint::black_box(drawn);
    Figures { stages, bytes: peak_memory() }.print();
    Ok(())
}

fn draw(path: &Path, lines: Lines, run: &Run<'_>) -> Outcome<usize> {
    let model = run.stage(READING, 0, || import::read_file(path, None))?;
    let scene = run.stage(MESH, 0, || Scene::new(model.objects, &SceneOptions::default()))?;
    let (forward, up) = (DVec3::new(-0.6, -0.8, -0.5), DVec3::new(0.1, 0.2, 1.0));
    let view = Camera::Orthographic { forward, target: None, up }.view(scene.mesh.bounds())?;
    let left_out: &[LineClass] = match lines {
        Lines::Features => &[LineClass::Intersection, LineClass::Mesh],
        Lines::AllEdges => &[LineClass::Intersection],
    };
    let classes: Vec<LineClass> =
        LineClass::ALL.into_iter().filter(|class| !left_out.contains(class)).collect();
    let options = FeatureOptions::default().with_classes(&classes);
    let wishes =
        vec![ObjectWish { features: options, see_through: false }; scene.mesh.objects().len()];
    let prepared = exact::prepare_for_visible_lines(&scene.mesh, &view, &wishes, run)?;
    let question = prepared.question(false);
    let answer = exact::appel(&question, &AppelOptions::default(), run)?;
    let visible = exact::reduce(&question, &answer, run)?;
    let drawing = run.stage("page", 0, || Drawing::new(&visible, &DrawingOptions::default()))?;
    run.stage("SVG", 0, || -> Outcome<()> {
        let svg = to_svg(&drawing, &SvgOptions::default())?;
        Ok(write_file(&path.with_extension("svg"), svg.as_bytes())?)
    })?;
    Ok(visible.pieces.len())
}

/// The most memory that this process has held, in bytes.
fn peak_memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = peak.and_then(|text| text.trim().trim_end_matches(" kB").parse::<f64>().ok());
    kilobytes.map_or(f64::NAN, |kilobytes| kilobytes * 1024.0)
}

/// Writes a torus of about `thousands` thousand triangles.
pub(crate) fn write_torus(path: &Path, thousands: usize) -> Outcome<()> {
    let around = ((thousands * 1000) as f64).sqrt().round() as usize;
    let across = thousands * 500 / around;
    let point = |i: usize, j: usize| {
        let (a, b) = (i % around, j % across);
        let (a, b) = (TAU * a as f64 / around as f64, TAU * b as f64 / across as f64);
        let ring = 2.0 + 0.8 * b.cos();
        Vec3::new((ring * a.cos()) as f32, (ring * a.sin()) as f32, (0.8 * b.sin()) as f32)
    };
    let mut bytes = vec![b' '; 80];
    bytes.extend((2 * (around * across) as u32).to_le_bytes());
    for (i, j) in (0..around).flat_map(|i| (0..across).map(move |j| (i, j))) {
        let (a, b, c, d) = (point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
        for triangle in [[a, b, c], [a, c, d]] {
            bytes.extend([0; 12]);
            triangle.iter().flat_map(Vec3::to_array).for_each(|x| bytes.extend(x.to_le_bytes()));
            bytes.extend([0; 2]);
        }
    }
    Ok(std::fs::write(path, bytes)?)
}
