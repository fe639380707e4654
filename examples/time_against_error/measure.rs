//! One scene by all contenders, and how wrong each is.

use super::buffers::by_buffer;
use super::sampled::by_samples;
use super::scenes::Scene;
use glam::DVec2;
use std::error::Error;
use std::time::Instant;
use umriss::exact;
use umriss::kernel::predicates::{Exact, FilterOnly, Place, Plain, Policy, Predicates};
use umriss::model::{FeatureOptions, LineClass, LineOrigin, Mesh};
use umriss::run::Run;
use umriss::view::{ExactLines, LineQuestion, PreparedView};
use umriss::visibility::{AppelOptions, appel};

pub(crate) type Outcome<T> = Result<T, Box<dyn Error>>;

/// For each edge of the mesh the stretches that are visible, from 0 to 1 from
/// its first vertex to its second, in order. None if it is not drawn at all.
pub(crate) type Visible = Vec<Vec<[f64; 2]>>;

/// Medians are of so many rounds.
const ROUNDS: usize = 5;

/// A way to find visible lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Contender {
    Appel,
    FilterOnly,
    Plain,
    Roberts,
    /// Points at steps of this part of the picture's longer side.
    Sampled(u32),
    /// An image of so many pixels.
    Buffer(u32),
}

impl Contender {
    /// All of them. The first is right.
    pub(crate) fn all() -> Vec<Self> {
        let mut all =
            vec![Contender::Appel, Contender::FilterOnly, Contender::Plain, Contender::Roberts];
        all.extend([64, 256, 1024, 4096, 16384].map(Contender::Sampled));
        all.extend([128, 256, 512, 1024, 2048].map(Contender::Buffer));
        all
    }

    pub(crate) fn name(self) -> String {
        match self {
            Contender::Appel => "appel, exact".into(),
            Contender::FilterOnly => "appel, filter only".into(),
            Contender::Plain => "appel, plain floats".into(),
            Contender::Roberts => "roberts, exact".into(),
            Contender::Sampled(steps) => format!("rays at 1/{steps}"),
            Contender::Buffer(size) => format!("z-buffer of {size}"),
        }
    }

    fn run(self, scene: &Scene) -> Outcome<Visible> {
        match self {
            Contender::Appel => by_appel::<Exact>(scene),
            Contender::FilterOnly => by_appel::<FilterOnly>(scene),
            Contender::Plain => by_appel::<Plain>(scene),
            Contender::Roberts => with_question::<Exact, _>(scene, |question, run| {
                Ok(visible(question, &exact::roberts(question, None, run)?))
            }),
            Contender::Sampled(steps) => Ok(by_samples(&scene.mesh, &scene.view, steps)),
            Contender::Buffer(size) => with_question::<Exact, _>(scene, |question, run| {
                by_buffer(scene, question, size, run)
            }),
        }
    }
}

/// What one contender did with one scene.
pub(crate) struct Measured {
    /// Milliseconds.
    pub(crate) time: f64,
    /// Shares of the length of all lines: drawn wrongly, missed.
    pub(crate) wrong: [f64; 2],
}

/// What all contenders did with one scene.
pub(crate) struct Found {
    pub(crate) triangles: usize,
    pub(crate) edges: usize,
    pub(crate) results: Vec<Measured>,
}

/// Runs all contenders in turn.
pub(crate) fn measure(scene: &Scene, contenders: &[Contender]) -> Outcome<Found> {
    let mesh = &scene.mesh;
    let image = |vertex: u32| scene.view.frame.image(mesh.vertices()[vertex as usize]);
    let lengths: Vec<f64> = (0..mesh.edges().len() as u32)
        .map(|edge| {
            let [a, b]: [DVec2; 2] = mesh.edges().ends(edge).map(image);
            a.distance(b)
        })
        .collect();
    let mut times = vec![Vec::new(); contenders.len()];
    let mut answers = vec![Visible::new(); contenders.len()];
    for _ in 0..ROUNDS {
        for (i, contender) in contenders.iter().enumerate() {
            let start = Instant::now();
            answers[i] = contender.run(scene)?;
            times[i].push(start.elapsed().as_secs_f64() * 1e3);
        }
    }
    let all: f64 = lengths.iter().sum();
    let wrong = |answer: &Visible| {
        let mut sum = [0.0; 2];
        for ((own, right), length) in answer.iter().zip(&answers[0]).zip(&lengths) {
            let common = common_length(own, right);
            sum[0] += length * (total(own) - common).max(0.0);
            sum[1] += length * (total(right) - common).max(0.0);
        }
        sum.map(|sum| sum / all)
    };
    let results = times.iter_mut().zip(&answers).map(|(times, answer)| {
        times.sort_unstable_by(f64::total_cmp);
        Measured { time: times[times.len() / 2], wrong: wrong(answer) }
    });
    let (triangles, edges) = (mesh.triangles().len(), lengths.len());
    Ok(Found { triangles, edges, results: results.collect() })
}

/// One contender over all scenes.
pub(crate) struct Row {
    pub(crate) contender: Contender,
    /// Logarithms of times, of the exact method's.
    times: Vec<f64>,
    wrong: Vec<f64>,
}

impl Row {
    pub(crate) fn new(contender: Contender) -> Self {
        Row { contender, times: Vec::new(), wrong: Vec::new() }
    }

    pub(crate) fn add(&mut self, result: &Measured, exact: f64) {
        self.times.push((result.time / exact).ln());
        self.wrong.push(result.wrong[0] + result.wrong[1]);
    }

    /// The geometric mean of the ratios of times.
    pub(crate) fn time(&self) -> f64 {
        (self.times.iter().sum::<f64>() / self.times.len() as f64).exp()
    }

    pub(crate) fn mean(&self) -> f64 {
        self.wrong.iter().sum::<f64>() / self.wrong.len() as f64
    }

    pub(crate) fn worst(&self) -> f64 {
        self.wrong.iter().copied().fold(0.0, f64::max)
    }

    pub(crate) fn scenes_with_errors(&self) -> usize {
        // Places are rounded, and so are the differences of right answers.
        self.wrong.iter().filter(|&&wrong| wrong > 1e-12).count()
    }
}

/// Asks about all edges, decided by a policy from the start.
fn with_question<P: Policy, T>(
    scene: &Scene,
    ask: impl FnOnce(&LineQuestion<'_>, &Run<'_>) -> Outcome<T>,
) -> Outcome<T> {
    let classes: Vec<LineClass> =
        LineClass::ALL.into_iter().filter(|&class| class != LineClass::Intersection).collect();
    let options = FeatureOptions::default().with_classes(&classes);
    let run = Run::default();
    let prepared = PreparedView::new::<P>(&scene.mesh, &scene.view, &options, &run)?;
    ask(&prepared.question(false), &run)
}

fn by_appel<P: Policy>(scene: &Scene) -> Outcome<Visible> {
    with_question::<P, _>(scene, |question, run| {
        Ok(visible(question, &appel::<P>(question, &AppelOptions::default(), run)?))
    })
}

/// The stretches of an answer, places rounded once.
fn visible(question: &LineQuestion<'_>, answer: &ExactLines) -> Visible {
    let predicates = Predicates::<Exact>::new(question.points);
    let mut stretches = vec![Vec::new(); question.mesh.edges().len()];
    for (index, line) in question.lines.iter().enumerate() {
        let LineOrigin::Edge(edge) = line.origin else { continue };
        let carrier = question.carrier(line);
        let share = |place| match place {
            Place::Start => 0.0,
            Place::End => 1.0,
            Place::Cut(cut) => {
                let values = carrier.ends.map(|end| predicates.value(cut, end));
                predicates.parameter(carrier, cut, &values)
            }
        };
        let pieces = answer.line(index).iter().filter(|piece| piece.invisibility == 0);
        stretches[edge as usize] =
            pieces.map(|piece| [share(piece.from), share(piece.to)]).collect();
    }
    stretches
}

fn total(stretches: &[[f64; 2]]) -> f64 {
    stretches.iter().map(|[from, to]| (to - from).max(0.0)).sum()
}

fn common_length(first: &[[f64; 2]], second: &[[f64; 2]]) -> f64 {
    let pairs = first.iter().flat_map(|a| second.iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| (a[1].min(b[1]) - a[0].max(b[0])).max(0.0)).sum()
}

/// Joins the steps of a line at whose middles it is visible.
pub(crate) fn joined(steps: u32, is_visible: impl Fn(f64) -> bool) -> Vec<[f64; 2]> {
    let mut stretches: Vec<[f64; 2]> = Vec::new();
    let share = |step: u32| f64::from(step) / f64::from(steps);
    for step in (0..steps).filter(|&step| is_visible((share(step) + share(step + 1)) / 2.0)) {
        match stretches.last_mut() {
            Some(last) if last[1] == share(step) => last[1] = share(step + 1),
            _ => stretches.push([share(step), share(step + 1)]),
        }
    }
    stretches
}

/// The longer side of the picture, view frame units.
pub(crate) fn picture_size(mesh: &Mesh, view: &umriss::model::View) -> f64 {
    let images = mesh.vertices().iter().map(|&point| view.frame.image(point));
    let (low, high) = images.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), place| {
        (low.min(place), high.max(place))
    });
    (high - low).max_element()
}
