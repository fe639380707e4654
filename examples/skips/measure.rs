//! Drawing with and without a shortcut.

use super::{Outcome, Scene};
use glam::DVec2;
use std::time::Instant;
use umriss::kernel::predicates::{Carrier, Exact, Policy, Unfiltered};
use umriss::model::{FeatureOptions, LineClass, LineOrigin};
use umriss::run::Run;
use umriss::view::{Culling, ExactPiece, ObjectWish, PreparedView, Skips};
use umriss::visibility::{AppelOptions, appel};

/// A shortcut that is not taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Skipped {
    Culling,
    Convex,
    Early,
    Carry,
    Filter,
    FeaturesOnly,
    NoInterpenetration,
}

impl Skipped {
    pub(crate) const ALL: [Skipped; 7] = [
        Skipped::Culling,
        Skipped::Convex,
        Skipped::Early,
        Skipped::Carry,
        Skipped::Filter,
        Skipped::FeaturesOnly,
        Skipped::NoInterpenetration,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Skipped::Culling => "culling",
            Skipped::Convex => "convex parts",
            Skipped::Early => "early",
            Skipped::Carry => "carry",
            Skipped::Filter => "filter",
            Skipped::FeaturesOnly => "features only",
            Skipped::NoInterpenetration => "no interpenetration",
        }
    }

    /// The classes that are drawn with the shortcut, and without.
    fn classes(self) -> [Vec<LineClass>; 2] {
        let all_but = |left_out: &[LineClass]| {
            LineClass::ALL.into_iter().filter(|class| !left_out.contains(class)).collect()
        };
        let features = || all_but(&[LineClass::Mesh, LineClass::Intersection]);
        let edges = || all_but(&[LineClass::Intersection]);
        match self {
            Skipped::FeaturesOnly => [features(), edges()],
            Skipped::NoInterpenetration => [features(), all_but(&[LineClass::Mesh])],
            _ => [edges(), edges()],
        }
    }

    fn skips(self) -> Skips {
        let all = Skips::default();
        match self {
            Skipped::Culling => Skips { culling: Culling::Never, ..all },
            Skipped::Convex => Skips { convex: false, ..all },
            Skipped::Early => Skips { early: false, ..all },
            Skipped::Carry => Skips { carry: false, ..all },
            Skipped::Filter | Skipped::FeaturesOnly | Skipped::NoInterpenetration => all,
        }
    }
}

/// What a line is, whatever else is found.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Name {
    Line(LineOrigin),
    Crossing(Carrier),
}

/// The visible pieces of lines.
type Answer = Vec<(Name, Vec<ExactPiece>)>;

/// Milliseconds from the mesh to exact pieces, and what they are.
fn drawn<P: Policy>(scene: &Scene, classes: &[LineClass], skips: Skips) -> Outcome<(f64, Answer)> {
    drawn_within::<P>(scene, classes, skips, None)
}

/// The same for a part of the picture between two corners.
fn drawn_within<P: Policy>(
    scene: &Scene,
    classes: &[LineClass],
    skips: Skips,
    window: Option<[DVec2; 2]>,
) -> Outcome<(f64, Answer)> {
    let features = FeatureOptions::default().with_classes(classes);
    let wish = ObjectWish { features, see_through: false };
    let wishes = vec![wish; scene.mesh.objects().len()];
    let run = Run::default();
    let start = Instant::now();
    let prepared =
        PreparedView::for_visible_lines::<P>(&scene.mesh, &scene.view, &wishes, &skips, &run)?;
    let question = prepared.question(false);
    let question = match window {
        Some([low, high]) => question.within(low, high),
        None => question,
    };
    let appel_options = AppelOptions { skips, ..AppelOptions::default() };
    let found = appel::<P>(&question, &appel_options, &run)?;
    let time = start.elapsed().as_secs_f64() * 1e3;
    let pieces = |(index, line): (usize, &umriss::model::FeatureLine)| {
        let name = match line.origin {
            LineOrigin::Intersection(_) => Name::Crossing(question.carrier(line)),
            own => Name::Line(own),
        };
        (name, found.line(index).to_vec())
    };
    Ok((time, question.lines.iter().enumerate().map(pieces).collect()))
}

/// What was measured of a scene.
pub(crate) struct Found {
    /// All edges.
    pub(crate) lines: usize,
    /// Milliseconds for all edges with all shortcuts.
    pub(crate) time: f64,
    /// How many times longer it takes without each shortcut.
    pub(crate) factors: Vec<f64>,
}

/// Draws a scene with and without each shortcut in turn.
pub(crate) fn measure(scene: &Scene, rounds: usize) -> Outcome<Found> {
    let mut found = Found { lines: 0, time: 0.0, factors: Vec::new() };
    for skipped in Skipped::ALL {
        let [with, without] = skipped.classes();
        let mut ratios = Vec::new();
        let mut times = Vec::new();
        for _ in 0..rounds {
            let (time, answer) = drawn::<Exact>(scene, &with, Skips::default())?;
            let (longer, same) = match skipped {
                Skipped::Filter => drawn::<Unfiltered>(scene, &without, Skips::default())?,
                _ => drawn::<Exact>(scene, &without, skipped.skips())?,
            };
            let [few, many] = [&with, &without].map(Vec::len);
            if !agree(&answer, &same, few == many) {
                return Err(
                    format!("{}: {} changes the drawing", scene.name, skipped.name()).into()
                );
            }
            if skipped == Skipped::Culling {
                found.lines = same.len();
            }
            times.push(time);
            ratios.push(longer / time);
        }
        if skipped == Skipped::Culling {
            found.time = median(&mut times);
        }
        found.factors.push(median(&mut ratios));
    }
    Ok(found)
}

/// Whether lines that are in both answers have the same pieces. The lesser
/// answer's lines are among those of the other, in the same order; of others
/// only such as are hidden may be left out, if `all` are to be drawn.
fn agree(lesser: &Answer, greater: &Answer, all: bool) -> bool {
    let mut own = lesser.iter().peekable();
    let same = greater.iter().all(|other| match own.next_if(|own| own.0 == other.0) {
        Some(own) => own.1 == other.1,
        None => !all || other.1.is_empty(),
    });
    same && own.next().is_none()
}

/// Milliseconds for two scenes, all edges, measured in turn.
pub(crate) fn median_times(scenes: [&Scene; 2], rounds: usize) -> Outcome<[f64; 2]> {
    let [edges, _] = Skipped::Culling.classes();
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..rounds {
        for (scene, times) in scenes.into_iter().zip(&mut times) {
            times.push(drawn::<Exact>(scene, &edges, Skips::default())?.0);
        }
    }
    Ok(times.map(|mut times| median(&mut times)))
}

/// The middle ninth of the picture and the whole, measured in turn:
/// milliseconds, and how many lines are left out of the part.
pub(crate) fn part_and_whole(scene: &Scene, rounds: usize) -> Outcome<([f64; 2], usize)> {
    let [edges, _] = Skipped::Culling.classes();
    let frame = &scene.view.frame;
    let images = scene.mesh.vertices().iter().map(|&vertex| frame.coordinates(vertex).truncate());
    let (low, high) = images.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), image| {
        (low.min(image), high.max(image))
    });
    let window = [low.lerp(high, 1.0 / 3.0), low.lerp(high, 2.0 / 3.0)];
    let (mut times, mut left_out) = ([Vec::new(), Vec::new()], 0);
    for _ in 0..rounds {
        let (time, part) = drawn_within::<Exact>(scene, &edges, Skips::default(), Some(window))?;
        times[0].push(time);
        let (time, whole) = drawn::<Exact>(scene, &edges, Skips::default())?;
        times[1].push(time);
        let mut differing = part.iter().zip(&whole).filter(|(own, other)| own != other);
        if !differing.clone().all(|(own, other)| own.0 == other.0 && own.1.is_empty()) {
            return Err(format!("{}: the frame changes the drawing", scene.name).into());
        }
        left_out = differing.by_ref().count();
    }
    Ok((times.map(|mut times| median(&mut times)), left_out))
}

fn median(list: &mut [f64]) -> f64 {
    list.sort_unstable_by(f64::total_cmp);
    list[list.len() / 2]
}
