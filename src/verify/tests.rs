//! Clean answers are found clean, damaged ones are found out.

use super::*;
use crate::kernel::predicates::{Exact, Place};
use crate::model::{Camera, FeatureOptions, LineClass, Mesh, Soup};
use crate::raster::Probe;
use crate::view::PreparedView;
use crate::visibility::roberts;
use glam::DVec3;

/// Knuth's linear congruential generator.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }

    fn soup(&mut self, triangles: u32, grid: u64) -> Soup {
        let mut soup = Soup::default();
        for first in (0..3 * triangles).step_by(3) {
            for _ in 0..3 {
                let point = [0; 3].map(|_| self.below(grid) as f64);
                soup.vertices.push(DVec3::from(point));
            }
            soup.faces.push(&[first, first + 1, first + 2], []);
        }
        soup
    }
}

fn cameras() -> [Camera; 4] {
    let along = |forward: [f64; 3]| Camera::Orthographic {
        forward: DVec3::from(forward),
        target: None,
        up: DVec3::Y,
    };
    let at = |eye: [f64; 3], target: [f64; 3]| Camera::Perspective {
        eye: DVec3::from(eye),
        target: Some(DVec3::from(target)),
        up: DVec3::Y,
        near: Some(0.5),
        fov_y_degrees: 60.0,
    };
    [
        along([0., 0., -1.]),
        along([3., -5., -7.]),
        at([1., 2., 9.], [1., 1., 0.]),
        at([2., 1., 1.], [1., 2., 0.]),
    ]
}

/// Asks `with` about the question of a scene and Roberts' answer to it.
fn with_answer(
    mesh: &Mesh,
    camera: &Camera,
    hidden_wanted: bool,
    with: impl FnOnce(&View, &LineQuestion, &ExactLines),
) {
    let run = Run::default();
    let view = camera.view(mesh.bounds()).expect("a view");
    let options = FeatureOptions::default().with_classes(&LineClass::ALL);
    let prepared = PreparedView::new::<Exact>(mesh, &view, &options, &run).expect("a view");
    let question = prepared.question(hidden_wanted);
    let answer = roberts::<Exact>(&question, None, &run).expect("an answer");
    with(&view, &question, &answer);
}

fn check(view: &View, question: &LineQuestion, answer: &ExactLines, size: u32) -> Report {
    let options = VerifyOptions { image_size: size, ..VerifyOptions::default() };
    verify::<Exact>(view, question, answer, &options, &Run::default()).expect("a report")
}

#[test]
fn the_judge_agrees_with_the_count_and_the_image() {
    let mut pieces = 0;
    for seed in 0..60 {
        let mesh = Mesh::new(vec![Random(seed).soup(8, 4), Random(!seed).soup(3, 4)], None);
        let Ok(mesh) = mesh else { continue };
        for camera in cameras() {
            with_answer(&mesh, &camera, seed % 3 > 0, |view, question, answer| {
                let report = check(view, question, answer, 24);
                assert!(report.is_clean(), "seed {seed} {camera:?}\n{report}");
                let image = report.tally(Check::Image);
                assert_eq!(image.differ, 0, "seed {seed} {camera:?}\n{report}");
                assert_eq!(report.tally(Check::Count).agree as usize, answer.piece_count());
                pieces += answer.piece_count();
            });
        }
    }
    assert!(pieces > 5000, "{pieces}");
}

#[test]
fn an_image_fine_enough_speaks_about_most_pieces() {
    let mesh = Mesh::new(vec![Random(5).soup(6, 50)], None).expect("a mesh");
    with_answer(&mesh, &cameras()[1], true, |view, question, answer| {
        let report = check(view, question, answer, 400);
        assert!(report.is_clean() && report.has_image(), "{report}");
        // Whatever was hidden is now said to be visible, and the reverse.
        let swapped = changed(answer, |_, piece| {
            piece.invisibility = u32::from(piece.invisibility == 0);
        });
        let report = check(view, question, &swapped, 400);
        assert!(report.tally(Check::Image).agree * 20 < report.tally(Check::Image).differ);
    });
}

/// The answer with every piece changed; the argument counts pieces.
fn changed(answer: &ExactLines, mut change: impl FnMut(usize, &mut ExactPiece)) -> ExactLines {
    let mut count = 0;
    let mut result = ExactLines::default();
    for line in 0..answer.len() {
        let mut pieces = answer.line(line).to_vec();
        for piece in &mut pieces {
            change(count, piece);
            count += 1;
        }
        result.push_line(pieces);
    }
    result
}

#[test]
fn every_single_damage_is_found() {
    let mesh = Mesh::new(vec![Random(11).soup(7, 5)], None).expect("a mesh");
    for camera in [&cameras()[1], &cameras()[2]] {
        with_answer(&mesh, camera, true, |view, question, answer| {
            assert!(check(view, question, answer, 0).is_clean());
            let mut damaged = 0;
            let mut expect_found = |answer: ExactLines, what: &str| {
                let report = check(view, question, &answer, 0);
                assert!(!report.is_clean(), "{what}\n{report}");
                damaged += 1;
                report
            };
            for target in 0..answer.piece_count() {
                let one = |change: &dyn Fn(&mut ExactPiece)| {
                    changed(answer, |index, piece| {
                        if index == target {
                            change(piece);
                        }
                    })
                };
                let more = expect_found(one(&|piece| piece.invisibility += 1), "one sheet more");
                assert_eq!(more.tally(Check::Count).differ, 1);
                assert_eq!(more.tally(Check::Judge).differ, 1);
                expect_found(
                    one(&|piece| piece.invisibility = u32::from(piece.invisibility == 0)),
                    "visible and hidden swapped",
                );
            }
            for line in 0..answer.len() {
                let pieces = answer.line(line);
                for i in 0..pieces.len() {
                    let mut fewer = pieces.to_vec();
                    fewer.remove(i);
                    expect_found(with_line(answer, line, fewer), "a piece dropped");
                }
                for i in 1..pieces.len() {
                    // The cut of another piece, or of another line.
                    let mut moved = pieces.to_vec();
                    let others = pieces.iter().map(|piece| piece.to);
                    for place in others.filter(|&place| place != pieces[i - 1].to) {
                        moved[i - 1].to = place;
                        moved[i].from = place;
                        expect_found(with_line(answer, line, moved.clone()), "a moved end");
                    }
                }
                if let [first, second, ..] = pieces {
                    let cut = first.to;
                    let mut split = pieces.to_vec();
                    split[1].from = cut;
                    split.insert(1, *second);
                    split[1].to = cut;
                    expect_found(with_line(answer, line, split), "a piece without length");
                }
            }
            assert!(damaged > 100, "{damaged}");
        });
    }
}

/// The answer with the pieces of one line replaced.
fn with_line(answer: &ExactLines, line: usize, pieces: Vec<ExactPiece>) -> ExactLines {
    let mut result = ExactLines::default();
    for i in 0..answer.len() {
        if i == line {
            result.push_line(pieces.iter().copied());
        } else {
            result.push_line(answer.line(i).iter().copied());
        }
    }
    result
}

#[test]
fn a_split_at_any_true_crossing_is_found() {
    let mesh = Mesh::new(vec![Random(3).soup(9, 6)], None).expect("a mesh");
    with_answer(&mesh, &cameras()[1], true, |view, question, answer| {
        let places = Places::<Exact>::new(question);
        let mut splits = 0;
        for line in 0..answer.len() {
            for edge in 0..question.mesh.edges().len() as u32 {
                let cut = Place::Cut(crate::kernel::predicates::Cut::Silhouette(
                    question.mesh.edges().ends(edge),
                ));
                let pieces = answer.line(line);
                let within = |piece: &&ExactPiece| {
                    places.is_on(line, cut)
                        && places.order(line, piece.from, cut) == Ordering::Less
                        && places.order(line, cut, piece.to) == Ordering::Less
                };
                let Some(i) = pieces.iter().position(|piece| within(&piece)) else {
                    continue;
                };
                let mut split = pieces.to_vec();
                split.insert(i + 1, split[i]);
                split[i].to = cut;
                split[i + 1].from = cut;
                let report = check(view, question, &with_line(answer, line, split), 0);
                assert_eq!(report.tally(Check::Cover).differ, 1, "{report}");
                assert_eq!(report.tally(Check::Judge).differ, 1, "{report}");
                assert_eq!(report.tally(Check::Count).differ, 0, "{report}");
                splits += 1;
            }
        }
        assert!(splits > 20, "{splits}");
    });
}

#[test]
fn a_piece_too_short_for_floats_is_counted() {
    // Two walls whose near borders are a unit in the last place apart: the
    // line passes behind one of them alone for 2^-54 of its length.
    let mut soup = Soup::default();
    for (border, z) in [(1.0, 1.0), (1.0_f64.next_up(), 2.0)] {
        let first = soup.vertices.len() as u32;
        for [x, y] in [[border, -4.0], [9.0, -4.0], [9.0, 4.0], [border, 4.0]] {
            soup.vertices.push(DVec3::new(x, y, z));
        }
        soup.faces.push(&[first, first + 1, first + 2, first + 3], []);
    }
    soup.vertices.extend([DVec3::ZERO, DVec3::new(5.0, 0.0, 0.0)]);
    soup.lines.push([8, 9]);
    let mesh = Mesh::new(vec![soup], None).expect("a mesh");
    with_answer(&mesh, &cameras()[0], true, |view, question, answer| {
        let last = answer.len() - 1;
        let levels: Vec<u32> = answer.line(last).iter().map(|p| p.invisibility).collect();
        assert_eq!(levels, [0, 1, 2]);
        let tree = SheetCounter::<Exact>::tree(question);
        let counter = SheetCounter::<Exact>::new(question, &tree);
        let (line, short) = (&question.lines[last], answer.line(last)[1]);
        let carrier = question.carrier(line);
        let probe = counter.probe(carrier, [short.from, short.to], 0.5);
        assert!(matches!(probe, Probe::Between(_)));
        assert_eq!(counter.count(line, probe), [1, 1]);
        assert!(check(view, question, answer, 0).is_clean());
    });
}

#[test]
fn any_point_of_a_piece_has_its_count() {
    for seed in 0..30 {
        let mesh = Mesh::new(vec![Random(seed).soup(8, 4)], None).expect("a mesh");
        with_answer(&mesh, &cameras()[seed as usize % 4], true, |_, question, answer| {
            let tree = SheetCounter::<Exact>::tree(question);
            let counter = SheetCounter::<Exact>::new(question, &tree);
            for (i, line) in question.lines.iter().enumerate() {
                let carrier = question.carrier(line);
                for piece in answer.line(i) {
                    let places = [piece.from, piece.to];
                    let shares = [0.001, 0.25, 0.5, 0.8, 0.999];
                    let mut probes = shares.map(|s| counter.probe(carrier, places, s)).to_vec();
                    probes.push(Probe::Between(places));
                    for probe in probes {
                        let [left, right] = counter.count(line, probe);
                        assert_eq!(left.max(right), piece.invisibility, "seed {seed} line {i}");
                    }
                }
            }
        });
    }
}

#[test]
fn a_few_lines_are_judged_if_there_are_too_many_triangles() {
    let mesh = Mesh::new(vec![Random(2).soup(10, 9)], None).expect("a mesh");
    with_answer(&mesh, &cameras()[1], true, |view, question, answer| {
        let options = VerifyOptions {
            judge_all_up_to: 3,
            judged_lines: 5,
            image_size: 0,
            ..VerifyOptions::default()
        };
        let report =
            verify::<Exact>(view, question, answer, &options, &Run::default()).expect("a report");
        let text = report.to_string();
        let expected = format!("judge: 5 of {} lines, chosen by seed 1963", question.lines.len());
        assert!(text.contains(&expected), "{text}");
        assert!(text.contains("image: not run"), "{text}");
    });
}
