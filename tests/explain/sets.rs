//! Sets have as many members as the engine counts, and are those that
//! Roberts' rule finds: each face alone against the line, its shadow found
//! as an interval, and the point looked up in it.

use super::scenes::{model, views};
use glam::DVec2;
use std::cmp::Ordering;
use umriss::kernel::numbers::Sign;
use umriss::kernel::predicates::{Exact, Predicates};
use umriss::model::{FeatureOptions, LineClass, Mesh, View};
use umriss::run::Run;
use umriss::verify::{Explainer, FaceThere, LineThere, Side};
use umriss::view::{ExactLines, LineQuestion, PreparedView};
use umriss::visibility::{AppelOptions, appel, reduce, roberts};

/// What Roberts' rule says of a scene in which few faces hide.
struct Alone<'q> {
    question: &'q LineQuestion<'q>,
    /// For each triangle the lines as they are hidden by it alone.
    answers: Vec<ExactLines>,
}

/// The lines of a question as some of its triangles hide them.
fn hidden_by(question: &LineQuestion<'_>, triangles: &[u32], line: Option<u32>) -> ExactLines {
    let mut facing = vec![Sign::Zero; question.facing.len()];
    for &triangle in triangles {
        facing[triangle as usize] = question.facing[triangle as usize];
    }
    let question = LineQuestion { facing: &facing, ..*question };
    let line = line.map(|line| vec![line]);
    roberts::<Exact>(&question, line.as_deref(), &Run::default()).unwrap()
}

impl<'q> Alone<'q> {
    fn new(question: &'q LineQuestion<'q>) -> Self {
        let triangles = 0..question.mesh.triangles().len() as u32;
        let answers = triangles.map(|triangle| hidden_by(question, &[triangle], None)).collect();
        Alone { question, answers }
    }

    /// The triangles that hide the probe of a place, on any side.
    fn set(&self, there: &LineThere) -> Vec<u32> {
        let hides = |&triangle: &u32| {
            let answer = &self.answers[triangle as usize];
            invisibility(self.question, answer, there.line as usize, there) > 0
        };
        (0..self.answers.len() as u32).filter(hides).collect()
    }
}

/// How often a place's probe is hidden by an answer, in which its line has
/// the number `line`.
fn invisibility(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    line: usize,
    there: &LineThere,
) -> u32 {
    let predicates = Predicates::<Exact>::new(question.points);
    let carrier = question.carrier(&question.lines[there.line as usize]);
    let axis = predicates.axis_across(carrier).unwrap();
    let order = |place| predicates.order_at(axis, (carrier, there.probe), (carrier, place));
    let mut around = answer
        .line(line)
        .iter()
        .filter(|piece| order(piece.from) != Ordering::Less && order(piece.to) == Ordering::Less);
    let piece = around.next().unwrap();
    assert!(around.next().is_none(), "two pieces at one place");
    piece.invisibility
}

/// Checks some places of every piece of a drawing; returns how many, and how
/// many of them were hidden differently on the two sides of a line.
fn check(mesh: &Mesh, view: &View, name: &str, alone: bool) -> [usize; 2] {
    let run = Run::default();
    let options = FeatureOptions::default().with_classes(&LineClass::ALL);
    let prepared = PreparedView::new::<Exact>(mesh, view, &options, &run).unwrap();
    let question = prepared.question(true);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).unwrap();
    let explainer = Explainer::new(view, &question, &answer, &run).unwrap();
    let lines = explainer.lines();
    assert_eq!(lines.pieces, reduce::<Exact>(&question, &answer, &run).unwrap().pieces, "{name}");
    let oracle = alone.then(|| Alone::new(&question));
    let mut counts = [0; 2];
    for (index, piece) in lines.pieces.iter().enumerate() {
        let [a, b] = piece.points;
        for share in [0.5, 0.1, 1.5] {
            let there = explainer.piece(index, a.lerp(b, share));
            let what = format!("{name}, piece {index} at {share}: {piece:?}\n{there:?}");
            assert_eq!(there.hidden_by.len(), piece.invisibility as usize, "{what}");
            assert_eq!(
                answer.line(there.line as usize)[there.piece].invisibility,
                piece.invisibility,
                "{what}"
            );
            check_order(&there, &what);
            counts[0] += 1;
            counts[1] += usize::from(there.side != Side::Both);
            let Some(oracle) = &oracle else { continue };
            let mut set = triangles(&there.hidden_by);
            let group = hidden_by(&question, &set, Some(there.line));
            assert_eq!(invisibility(&question, &group, 0, &there), piece.invisibility, "{what}");
            set.sort_unstable();
            let all = oracle.set(&there);
            match there.side {
                Side::Both => assert_eq!(set, all, "{what}"),
                Side::Left | Side::Right => {
                    assert!(set.iter().all(|triangle| all.contains(triangle)), "{what}");
                }
            }
        }
    }
    counts
}

fn triangles(faces: &[FaceThere]) -> Vec<u32> {
    faces.iter().map(|face| face.triangle).collect()
}

/// Depths grow, and end in front of the line, as far as they are rounded.
fn check_order(there: &LineThere, what: &str) {
    let depths: Vec<f64> = there.hidden_by.iter().map(|face| face.depth).collect();
    let size = depths.iter().chain([&there.depth]).fold(1e-12, |size: f64, d| size.max(d.abs()));
    for pair in depths.windows(2) {
        assert!(pair[0] <= pair[1] + 1e-6 * size, "{what}");
    }
    assert!(depths.iter().all(|depth| *depth <= there.depth + 1e-6 * size), "{what}");
}

#[test]
fn sets_are_those_of_roberts_rule() {
    let mut counts = [0; 2];
    for name in [
        "coplanar_quads.obj",
        "cube_1e-9.obj",
        "cube_row_touching.obj",
        "house_groups.obj",
        "nested_cubes.obj",
        "ngon_L.obj",
        "plates_with_holes.json",
        "slab_tjunction.obj",
        "stair_boxes_touching.obj",
        "three_bars.obj",
        "two_cubes_interpenetrating.obj",
        "two_tris_cross.obj",
    ] {
        let mesh = model(name);
        for (view, camera) in views(&mesh) {
            let [places, sided] = check(&mesh, &camera, &format!("{name} {view}"), true);
            counts = [counts[0] + places, counts[1] + sided];
        }
    }
    assert!(counts[0] > 2000 && counts[1] > 20, "{counts:?}");
}

#[test]
fn sets_are_as_large_as_the_drawing_says() {
    for name in ["bad_soup.obj", "cylinder_on_plate.obj", "knot_wire.obj", "ngon_gear24.obj"] {
        let mesh = model(name);
        for (view, camera) in views(&mesh) {
            let [places, _] = check(&mesh, &camera, &format!("{name} {view}"), false);
            // An eye within may see nothing.
            assert!(places > 0 || view == "inside", "{name} {view}");
        }
    }
}

#[test]
fn a_place_on_a_line_is_found() {
    let mesh = model("two_cubes_interpenetrating.obj");
    for (name, view) in views(&mesh) {
        let run = Run::default();
        let options = FeatureOptions::default();
        let prepared = PreparedView::new::<Exact>(&mesh, &view, &options, &run).unwrap();
        let question = prepared.question(true);
        let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).unwrap();
        let explainer = Explainer::new(&view, &question, &answer, &run).unwrap();
        for piece in &explainer.lines().pieces {
            let [a, b] = piece.points;
            let there = explainer.at(a.lerp(b, 0.3125)).line.unwrap();
            let size = 1.0 + a.abs().max(b.abs()).max_element();
            assert!(there.distance <= 1e-12 * size, "{name} {piece:?} {there:?}");
        }
        let nowhere = explainer.at(DVec2::splat(1e6));
        // An eye within sees faces wherever it looks.
        assert!(nowhere.faces.is_empty() || name == "inside", "{name}");
        assert!(nowhere.line.is_none_or(|line| line.distance > 1e5), "{name}");
    }
}
