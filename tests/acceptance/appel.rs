//! The product equals the judge.
//!
//! Appel's method counts once and adds up events at a few edges; Roberts
//! intersects every line with every triangle. They share the predicates and
//! nothing else, and the judge is tested against the definition in integers
//! beside its own code. So every piece of every line must be the same: as
//! many, hidden by as many sheets, with ends that are equal exactly. A
//! difference is reduced to the fewest faces that show it before it is
//! reported.
//!
//! The same must hold if the piercings are searched line by line, and for
//! the visible pieces alone; and edges that gain nothing may be handed in
//! as effective ones without effect. Each deliberate fault must be noticed.

use super::scenes::{
    Kind, Random, orthographic, perspective, polygons, random_camera, random_soups, rounds,
};
use glam::{DVec3, dvec3};
use std::cmp::Ordering;
use umriss::kernel::predicates::{Carrier, Exact, Place, Predicates};
use umriss::model::{EffectiveEdge, FeatureOptions, LineClass, Mesh, Soup, View};
use umriss::run::Run;
use umriss::view::{ExactLines, ExactPiece, LineQuestion, PreparedView};
use umriss::visibility::{AppelOptions, Fault, appel, roberts};

fn every_class() -> FeatureOptions {
    FeatureOptions::default().with_classes(&LineClass::ALL)
}

fn ask_appel(question: &LineQuestion<'_>) -> ExactLines {
    let run = Run::default();
    let answer = appel::<Exact>(question, &AppelOptions::default(), &run).expect("not cancelled");
    assert_eq!(run.counters().get("carried-contradictions"), 0);
    answer
}

fn ask_roberts(question: &LineQuestion<'_>) -> ExactLines {
    roberts::<Exact>(question, None, &Run::default()).expect("not cancelled")
}

/// Whether two places of a carrier are the same point.
fn same_place(predicates: &Predicates<'_, Exact>, carrier: Carrier, a: Place, b: Place) -> bool {
    match (a, b) {
        (Place::Cut(a), Place::Cut(b)) => {
            let [x, y] = [a, b].map(|cut| carrier.ends.map(|end| predicates.value(cut, end)));
            predicates.order(carrier, (a, &x), (b, &y)) == Ordering::Equal
        }
        (a, b) => a == b,
    }
}

/// The first line on which two answers differ.
fn first_difference(
    question: &LineQuestion<'_>,
    found: &ExactLines,
    expected: &ExactLines,
) -> Option<String> {
    let predicates = Predicates::<Exact>::new(question.points);
    (0..question.lines.len()).find_map(|i| {
        let carrier = question.carrier(&question.lines[i]);
        let same = |a: &ExactPiece, b: &ExactPiece| {
            a.invisibility == b.invisibility
                && same_place(&predicates, carrier, a.from, b.from)
                && same_place(&predicates, carrier, a.to, b.to)
        };
        let (x, y) = (found.line(i), expected.line(i));
        let equal = x.len() == y.len() && x.iter().zip(y).all(|(a, b)| same(a, b));
        (!equal).then(|| {
            format!("line {:?} {carrier:?}\n  found    {x:?}\n  expected {y:?}", question.lines[i])
        })
    })
}

/// All comparisons on one scene; the number of pieces if all is well.
fn check(soups: &[Soup], view: &View) -> Result<usize, String> {
    let Ok(mesh) = Mesh::new(soups.to_vec(), None) else {
        return Ok(0);
    };
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, view, &every_class(), &run).expect("a view");
    let question = prepared.question(true);
    let judged = ask_roberts(&question);
    let compare =
        |what: &str, question: &LineQuestion<'_>, expected: &ExactLines| match first_difference(
            question,
            &ask_appel(question),
            expected,
        ) {
            Some(difference) => Err(format!("{what}: {difference}")),
            None => Ok(()),
        };
    compare("all pieces", &question, &judged)?;
    compare("piercings line by line", &LineQuestion { piercings: None, ..question }, &judged)?;
    let effective = with_idle_edges(&question);
    compare("idle edges", &LineQuestion { effective: &effective, ..question }, &judged)?;
    let mut visible = ExactLines::default();
    for i in 0..judged.len() {
        visible.push_line(judged.line(i).iter().copied().filter(|piece| piece.invisibility == 0));
    }
    compare("visible pieces", &prepared.question(false), &visible)?;
    Ok(judged.piece_count())
}

/// All edges as effective ones, most of them with a gain of nothing.
fn with_idle_edges(question: &LineQuestion<'_>) -> Vec<EffectiveEdge> {
    let gain = |edge| {
        let found = question.effective.iter().find(|effective| effective.edge == edge);
        found.map_or(0, |effective| effective.gain)
    };
    let edges = 0..question.mesh.edges().len() as u32;
    edges.map(|edge| EffectiveEdge { edge, gain: gain(edge) }).collect()
}

/// The soup without one of its faces or lines.
fn without(soup: &Soup, part: usize) -> Soup {
    let mut smaller = Soup { faces: Default::default(), lines: Vec::new(), ..soup.clone() };
    for face in (0..soup.faces.len()).filter(|&face| face != part) {
        let mut rings = soup.faces.rings(face);
        smaller.faces.push(rings.next().expect("an outer ring"), rings);
    }
    let lines = (0..soup.lines.len()).filter(|line| line + soup.faces.len() != part);
    smaller.lines.extend(lines.map(|line| soup.lines[line]));
    smaller
}

/// Takes away whatever the difference does not need, and describes the rest.
fn reduced(mut soups: Vec<Soup>, view: &View) -> String {
    'again: loop {
        for object in 0..soups.len() {
            for part in 0..soups[object].faces.len() + soups[object].lines.len() {
                let mut fewer = soups.clone();
                fewer[object] = without(&soups[object], part);
                if check(&fewer, view).is_err() {
                    soups = fewer;
                    continue 'again;
                }
            }
        }
        break;
    }
    let mut text = format!("{:?} {:?}\n", view.eye, view.near);
    for soup in &soups {
        text += "object\n";
        for face in 0..soup.faces.len() {
            let ring = soup.faces.rings(face).next().expect("an outer ring");
            let ring: Vec<_> = ring.iter().map(|&i| soup.vertices[i as usize].to_array()).collect();
            text += &format!("  face {ring:?}\n");
        }
        for line in &soup.lines {
            let ends = line.map(|i| soup.vertices[i as usize].to_array());
            text += &format!("  line {ends:?}\n");
        }
    }
    let difference = check(&soups, view).err().unwrap_or_default();
    text + &difference
}

fn random_scene(kind: Kind, seed: u64) -> (Vec<Soup>, View) {
    let mut random = Random(seed ^ (kind as u64) << 48);
    let soups = random_soups(&mut random, kind);
    let view = random_camera(&mut random, &soups);
    (soups, view)
}

fn equals_the_judge(kind: Kind, few: u64) {
    let (mut pieces, mut failures) = (0, Vec::new());
    for seed in 0..rounds(few) {
        let (soups, view) = random_scene(kind, seed);
        match check(&soups, &view) {
            Ok(count) => pieces += count,
            Err(_) => failures.push((seed, reduced(soups, &view))),
        }
    }
    failures.sort_by_key(|(_, text)| text.len());
    if let Some((seed, text)) = failures.first() {
        panic!("{} scenes of {kind:?}; seed {seed}: {text}", failures.len());
    }
    assert!(pieces as u64 > 10 * few, "{kind:?}: only {pieces} pieces");
}

#[test]
fn soups_in_general_position() {
    equals_the_judge(Kind::General, 150);
}

#[test]
fn soups_on_a_grid() {
    equals_the_judge(Kind::Grid, 350);
}

#[test]
fn soups_over_few_vertices() {
    equals_the_judge(Kind::Pool, 200);
}

#[test]
fn boxes_on_a_grid() {
    equals_the_judge(Kind::Boxes, 80);
}

#[test]
fn soups_in_few_planes() {
    equals_the_judge(Kind::Planes, 100);
}

#[test]
fn turned_grids() {
    equals_the_judge(Kind::Turned, 80);
}

#[test]
fn nearly_degenerate_soups() {
    equals_the_judge(Kind::Nearly, 80);
}

#[test]
fn cards() {
    equals_the_judge(Kind::Cards, 250);
}

/// The pieces of a single loose line, by both methods.
fn pieces_of_line(line: [DVec3; 2], view: &View) -> [Vec<ExactPiece>; 2] {
    let none: [Vec<DVec3>; 0] = [];
    let mesh = Mesh::new(vec![polygons(&none, &[line])], None).expect("a mesh");
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, view, &every_class(), &run).expect("a view");
    let question = prepared.question(true);
    [ask_appel(&question), ask_roberts(&question)].map(|answer| answer.line(0).to_vec())
}

#[test]
fn a_line_through_the_eye_has_no_image() {
    let eye = dvec3(0.5, 0.25, 0.0);
    let view = perspective(eye, DVec3::Y, 1.0);
    for step in [dvec3(1.0, 2.0, 0.5), dvec3(0.0, 3.0, 0.0), dvec3(2.0, 0.0, -1.0)] {
        for line in [[eye - step, eye + step], [eye + step, eye - step * 2.0]] {
            assert_eq!(pieces_of_line(line, &view), [vec![], vec![]]);
        }
    }
}

#[test]
fn a_line_that_ends_on_the_near_plane_ends_there() {
    let view = perspective(DVec3::ZERO, DVec3::Y, 1.0);
    let [on, beyond] = [dvec3(2.0, 1.0, 3.0), dvec3(1.0, 4.0, 3.0)];
    let whole =
        vec![ExactPiece { from: Place::Start, to: Place::End, invisibility: 0, outline: false }];
    for line in [[on, beyond], [beyond, on]] {
        assert_eq!(pieces_of_line(line, &view), [whole.clone(), whole.clone()]);
    }
}

#[test]
fn every_fault_is_noticed() {
    for fault in Fault::ALL {
        let noticed = (0..200).any(|seed| {
            let (soups, view) = random_scene(Kind::Grid, seed);
            let Ok(mesh) = Mesh::new(soups, None) else {
                return false;
            };
            let run = Run::default();
            let options = AppelOptions { fault: Some(fault), ..AppelOptions::default() };
            let prepared =
                PreparedView::new::<Exact>(&mesh, &view, &every_class(), &run).expect("a view");
            let question = prepared.question(true);
            let found = appel::<Exact>(&question, &options, &run).expect("not cancelled");
            first_difference(&question, &found, &ask_roberts(&question)).is_some()
        });
        assert!(noticed, "{} changes nothing", fault.name());
    }
}

/// A tube around a closed curve as quadrilaterals; `along` points on the
/// curve, `around` it.
fn tube(curve: impl Fn(f64) -> DVec3, radius: f64, along: usize, around: usize) -> Soup {
    let tau = std::f64::consts::TAU;
    let point = |i: usize, j: usize| {
        let (s, t) = ((i % along) as f64 / along as f64, (j % around) as f64 / around as f64);
        let tangent = (curve(s + 1e-4) - curve(s - 1e-4)).normalize();
        let side = tangent.cross(dvec3(0.1, 0.2, 1.0)).normalize();
        let (sin, cos) = (tau * t).sin_cos();
        curve(s) + radius * (side * cos + side.cross(tangent) * sin)
    };
    let mut faces = Vec::new();
    for i in 0..along {
        for j in 0..around {
            let [a, b, c, d] =
                [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| point(i, j));
            faces.extend([vec![a, b, c], vec![a, c, d]]);
        }
    }
    polygons(&faces, &[])
}

/// Counts are carried along all edges of a connected surface, so one of its
/// vertices is counted, however often it passes in front of itself.
#[test]
fn a_connected_surface_is_counted_once() {
    let tau = std::f64::consts::TAU;
    let ring = |s: f64| dvec3((tau * s).cos(), (tau * s).sin(), 0.0);
    let trefoil = |s: f64| {
        let (a, b) = (2.0 * tau * s, 3.0 * tau * s);
        dvec3((2.0 + b.cos()) * a.cos(), (2.0 + b.cos()) * a.sin(), b.sin())
    };
    let far = |s: f64| ring(s) + dvec3(0.3, 0.5, 3.0);
    for (soups, expected) in [
        (vec![tube(ring, 0.3, 40, 17)], 1),
        (vec![tube(trefoil, 0.35, 160, 11)], 1),
        (vec![tube(ring, 0.3, 40, 17), tube(far, 0.2, 31, 13)], 2),
    ] {
        let mesh = Mesh::new(soups, None).expect("a mesh");
        let run = Run::default();
        let view = perspective(dvec3(3.1, 4.7, 9.3), dvec3(-3.1, -4.7, -9.3), 0.01);
        let prepared =
            PreparedView::new::<Exact>(&mesh, &view, &every_class(), &run).expect("a view");
        let question = prepared.question(true);
        let answer =
            appel::<Exact>(&question, &AppelOptions::default(), &run).expect("not cancelled");
        assert_eq!(run.counters().get("vertices-counted"), expected);
        assert_eq!(first_difference(&question, &answer, &ask_roberts(&question)), None);
    }
}

/// Of sheets that lie behind one another edge by edge, all but the first are
/// left as soon as one of many is found to hide them: the work grows with their
/// number, not with its square.
#[test]
fn sheets_on_the_same_image_lines_are_no_crowd() {
    let tested = |count: u32| {
        let sheet = |k: u32| {
            let depth = -f64::from(k);
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
                .map(|[x, y]| dvec3(x, y, depth))
                .to_vec()
        };
        let sheets: Vec<_> = (0..count).map(sheet).collect();
        let mesh = Mesh::new(vec![polygons(&sheets, &[])], None).expect("a mesh");
        let run = Run::default();
        let view = orthographic(dvec3(0.0, 0.0, -1.0));
        let options = FeatureOptions::default();
        let prepared = PreparedView::new::<Exact>(&mesh, &view, &options, &run).expect("a view");
        let question = prepared.question(false);
        let answer =
            appel::<Exact>(&question, &AppelOptions::default(), &run).expect("not cancelled");
        let visible = (0..answer.len()).flat_map(|line| answer.line(line));
        assert_eq!(visible.filter(|piece| piece.invisibility == 0).count(), 4);
        run.counters().get("crossings-tested")
    };
    let [few, many] = [2000, 4000].map(tested);
    assert!(many < 3 * few, "{few} and {many} tests");
}
