//! Where lines coincide in the image, one of them is drawn.
//!
//! The drawing of all lines together is compared with the drawings of each
//! line alone, on scenes in which most lines lie on others: together they
//! must cover the same points, a point that any line shows is shown, one
//! that all lines hide has the fewest sheets of any of them, no two pieces
//! overlap, and of equally visible lines of one class the nearest is drawn.

use super::scenes::{Kind, Random, distance, polygons, random_camera, random_soups, rounds};
use glam::{DVec2, DVec3};
use umriss::kernel::predicates::Exact;
use umriss::model::{FeatureOptions, LineClass, Mesh};
use umriss::run::Run;
use umriss::view::{ExactLines, LinePiece, LineQuestion, PreparedView};
use umriss::visibility::{AppelOptions, appel, reduce};

/// Nearer than this, relative to the scene's few units, is the same point.
const NEAR: f64 = 1e-9;

fn reduced(question: &LineQuestion<'_>, answer: &ExactLines) -> Vec<LinePiece> {
    reduce::<Exact>(question, answer, &Run::default()).expect("not cancelled").pieces
}

/// The pieces of each line as if it were the only one.
fn alone(question: &LineQuestion<'_>, answer: &ExactLines) -> Vec<LinePiece> {
    let each = question.lines.iter().enumerate().flat_map(|(i, line)| {
        let mut one = ExactLines::default();
        one.push_line(answer.line(i).iter().copied());
        reduced(&LineQuestion { lines: std::slice::from_ref(line), ..*question }, &one)
    });
    each.collect()
}

/// The fewest sheets over a point among pieces that run along `direction`
/// there, if there are any.
fn level(pieces: &[LinePiece], point: DVec2, direction: DVec2) -> Option<u32> {
    let along = |piece: &&LinePiece| {
        let other = piece.points[1] - piece.points[0];
        let parallel = direction.perp_dot(other).abs() < NEAR * direction.length() * other.length();
        parallel && distance(point, piece.points) < NEAR
    };
    pieces.iter().filter(along).map(|piece| piece.invisibility).min()
}

/// Points inside a piece, away from where anything may end on it.
fn samples(piece: &LinePiece, others: &[LinePiece]) -> Vec<DVec2> {
    let [from, to] = piece.points;
    let ends = || others.iter().flat_map(|other| other.points);
    (1..12)
        .map(|i| from.lerp(to, f64::from(i) / 12.0))
        .filter(|point| ends().all(|end| end.distance(*point) > 1e-6))
        .collect()
}

#[test]
fn one_line_is_drawn_where_several_coincide() {
    let options = FeatureOptions::default().with_classes(&LineClass::ALL);
    let (mut checked, mut rivals) = (0, 0);
    for seed in 0..rounds(60) {
        for kind in [Kind::Grid, Kind::Pool, Kind::Boxes, Kind::Planes, Kind::Turned] {
            let mut random = Random(seed ^ 0xc01c << 32 ^ (kind as u64) << 56);
            let soups = random_soups(&mut random, kind);
            let view = random_camera(&mut random, &soups);
            let Ok(mesh) = Mesh::new(soups, None) else {
                continue;
            };
            // Points next to a near plane close to the eye are far out in
            // the image, where a fixed nearness says nothing.
            if view.eye.is_perspective() {
                continue;
            }
            let run = Run::default();
            let prepared =
                PreparedView::new::<Exact>(&mesh, &view, &options, &run).expect("a view");
            let question = prepared.question(true);
            let answer = appel::<Exact>(&question, &AppelOptions::default(), &run);
            let answer = answer.expect("not cancelled");
            let (all, single) = (reduced(&question, &answer), alone(&question, &answer));
            for (pieces, others) in [(&all, &single), (&single, &all)] {
                for piece in pieces {
                    let direction = piece.points[1] - piece.points[0];
                    for point in samples(piece, others) {
                        let levels = [&all, &single].map(|list| level(list, point, direction));
                        let what = format!("seed {seed} of {kind:?} at {point} of {piece:?}");
                        assert!(levels[0].is_some() && levels[0] == levels[1], "{what} {levels:?}");
                        checked += 1;
                    }
                }
            }
            assert_disjoint(&all, &format!("seed {seed} of {kind:?}"));
            rivals += assert_nearest(&all, &single, &format!("seed {seed} of {kind:?}"));
        }
    }
    assert!(checked as u64 > 10_000, "{checked}");
    assert!(rivals > 100, "{rivals}");
}

/// Panics if some other line of the same class, as visible, is nearer where
/// a piece is drawn. Returns how many points of two lines were compared.
fn assert_nearest(drawn: &[LinePiece], single: &[LinePiece], what: &str) -> usize {
    let mut compared = 0;
    for piece in drawn {
        let like = |other: &&LinePiece| {
            (other.class, other.invisibility) == (piece.class, piece.invisibility)
                && other.source != piece.source
                && on_one_line(piece, other)
        };
        for other in single.iter().filter(like) {
            let gaps = common_ends(piece, other).map(|point| {
                // How much nearer the other one is, in space units.
                depth_at(piece, point) - depth_at(other, point)
            });
            // Lines that cross in space take turns at being the nearer one.
            let crossing = gaps[0] < -NEAR && NEAR < gaps[1] || gaps[1] < -NEAR && NEAR < gaps[0];
            assert!(crossing || gaps.iter().all(|gap| *gap < NEAR), "{what}: {piece:?} {other:?}");
            compared += 1;
        }
    }
    compared
}

/// Whether the images of two pieces have more than a point in common.
fn on_one_line(piece: &LinePiece, other: &LinePiece) -> bool {
    let [way, across] = [piece, other].map(|piece| piece.points[1] - piece.points[0]);
    let beside = (other.points[0] - piece.points[0]).perp_dot(way);
    let [from, to] = common_ends(piece, other);
    way.perp_dot(across).abs() < NEAR * way.length() * across.length()
        && beside.abs() < NEAR * way.length()
        && 1e-6 < from.distance(to)
        && (to - from).dot(way) > 0.0
}

/// Where the common part of two pieces on one line begins and ends, in the
/// sense of the first.
fn common_ends(piece: &LinePiece, other: &LinePiece) -> [DVec2; 2] {
    let [from, to] = piece.points;
    let way = to - from;
    let along = |point: &DVec2| (*point - from).dot(way) / way.length_squared();
    let [a, b] = [0, 1].map(|end| along(&other.points[end]));
    [a.min(b).max(0.0), a.max(b).min(1.0)].map(|t| from.lerp(to, t))
}

/// The depth of a piece of a parallel view at a point of its image.
fn depth_at(piece: &LinePiece, point: DVec2) -> f64 {
    let way = piece.points[1] - piece.points[0];
    let t = (point - piece.points[0]).dot(way) / way.length_squared();
    piece.depth[0] + (piece.depth[1] - piece.depth[0]) * t
}

/// Panics if two pieces have more than an end in common.
fn assert_disjoint(pieces: &[LinePiece], what: &str) {
    for (i, piece) in pieces.iter().enumerate() {
        let direction = piece.points[1] - piece.points[0];
        for point in samples(piece, pieces) {
            let others = [&pieces[..i], &pieces[i + 1..]];
            let covered = others.iter().find_map(|list| level(list, point, direction));
            assert_eq!(covered, None, "{what}: {point} is drawn twice, once by {piece:?}");
        }
    }
}

/// Collinear lines of a few units in the last place, one within another: their
/// rounded ends fall together, and others between them need not.
#[test]
fn lines_shorter_than_rounding_are_drawn_where_numbers_are() {
    let mut random = Random(1973);
    let mut checked = 0;
    for _ in 0..rounds(400) {
        // Sums of these are exact.
        let base = DVec3::ONE + random.point().abs() / 64.0;
        let step = (random.grid_point(6) - 3.0) * f64::EPSILON;
        let mut place = || base + step * random.below(16) as f64;
        let mut lines: Vec<[DVec3; 2]> = (0..5).map(|_| [place(), place()]).collect();
        lines.push([DVec3::ZERO, DVec3::splat(3.0)]);
        let soups = vec![polygons::<Vec<DVec3>>(&[], &lines)];
        let view = random_camera(&mut random, &soups);
        let Ok(mesh) = Mesh::new(soups, None) else { continue };
        let run = Run::default();
        let prepared = PreparedView::new::<Exact>(&mesh, &view, &FeatureOptions::default(), &run)
            .expect("a view");
        let question = prepared.question(true);
        let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).expect("an answer");
        for piece in reduced(&question, &answer) {
            let numbers = piece.points.iter().flat_map(|point| point.to_array()).chain(piece.depth);
            assert!(numbers.into_iter().all(f64::is_finite), "{piece:?}");
            checked += 1;
        }
    }
    assert!(checked > 400, "{checked}");
}
