//! Acceptance tests of the judge.

use super::brute_force::BruteForce;
use super::roberts;
use crate::kernel::predicates::{Cut, Exact, Place};
use crate::model::{Camera, FeatureOptions, LineClass, LineOrigin, Mesh, Soup, View};
use crate::run::Run;
use crate::view::{ExactPiece, PreparedView};
use glam::DVec3;
use std::cmp::Ordering;

fn every_class() -> FeatureOptions {
    FeatureOptions::default().with_classes(&LineClass::ALL)
}

fn from_above() -> View {
    let camera =
        Camera::Orthographic { forward: -DVec3::Z, target: Some(DVec3::ZERO), up: DVec3::Y };
    camera.view((DVec3::ZERO, DVec3::ONE)).expect("a view")
}

/// A soup of polygons given by positions.
fn soup(faces: &[&[[f64; 3]]], lines: &[[[f64; 3]; 2]]) -> Soup {
    let mut soup = Soup::default();
    for face in faces {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend(face.iter().map(|&p| DVec3::from(p)));
        let ring: Vec<u32> = (first..soup.vertices.len() as u32).collect();
        soup.faces.push(&ring, []);
    }
    for line in lines {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend(line.map(DVec3::from));
        soup.lines.push([first, first + 1]);
    }
    soup
}

/// Pieces of the loose lines of a scene.
fn loose_pieces(soups: Vec<Soup>, view: &View) -> Vec<Vec<ExactPiece>> {
    let mesh = Mesh::new(soups, None).expect("a mesh");
    let run = Run::default();
    let view = PreparedView::new::<Exact>(&mesh, view, &every_class(), &run).expect("a view");
    let question = view.question(true);
    let answer = roberts::<Exact>(&question, None, &run).expect("an answer");
    (0..question.lines.len())
        .filter(|&i| matches!(question.lines[i].origin, LineOrigin::Loose(_)))
        .map(|i| answer.line(i).to_vec())
        .collect()
}

fn levels(pieces: &[ExactPiece]) -> Vec<u32> {
    pieces.iter().map(|piece| piece.invisibility).collect()
}

#[test]
fn a_line_exactly_behind_a_diagonal_is_hidden() {
    let square: [&[[f64; 3]]; 2] =
        [&[[0., 0., 1.], [4., 0., 1.], [4., 4., 1.]], &[[0., 0., 1.], [4., 4., 1.], [0., 4., 1.]]];
    let line = [[1., 1., 0.], [3., 3., 0.]];
    let pieces = loose_pieces(vec![soup(&square, &[line])], &from_above());
    assert_eq!(levels(&pieces[0]), [1]);
    assert_eq!((pieces[0][0].from, pieces[0][0].to), (Place::Start, Place::End));
}

#[test]
fn a_line_behind_the_apex_of_a_fan_is_hidden_in_one_piece() {
    let rim = [[4., 0.], [2., 4.], [-2., 4.], [-4., 0.], [-2., -4.], [2., -4.]];
    let fan: Vec<Vec<[f64; 3]>> = (0..6)
        .map(|i| {
            let (a, b) = (rim[i], rim[(i + 1) % 6]);
            vec![[0., 0., 2.], [a[0], a[1], 1.], [b[0], b[1], 1.]]
        })
        .collect();
    let fan: Vec<&[[f64; 3]]> = fan.iter().map(Vec::as_slice).collect();
    // Along two spokes, across the apex alone, and beyond the rim.
    let lines = [
        [[-3., 0., 0.], [3., 0., 0.]],
        [[-1., -3., 0.], [1., 3., 0.]],
        [[-1., -2., 0.], [1., 2., 0.]],
        [[-8., 0., 0.], [8., 0., 0.]],
    ];
    let pieces = loose_pieces(vec![soup(&fan, &lines)], &from_above());
    assert_eq!(levels(&pieces[0]), [1]);
    assert_eq!(levels(&pieces[1]), [1]);
    assert_eq!(levels(&pieces[2]), [1]);
    assert_eq!(levels(&pieces[3]), [0, 1, 0]);
}

#[test]
fn a_stack_of_squares_hides_as_often_as_it_is_high() {
    for height in [0, 1, 2, 3, 8, 31, 64] {
        let squares: Vec<[[f64; 3]; 4]> = (1..=height)
            .map(f64::from)
            .map(|z| [[0., 0., z], [1., 0., z], [1., 1., z], [0., 1., z]])
            .collect();
        let faces: Vec<&[[f64; 3]]> = squares.iter().map(|square| &square[..]).collect();
        let line = [[-1., 0.25, 0.], [2., 0.5, 0.]];
        let pieces = loose_pieces(vec![soup(&faces, &[line])], &from_above());
        let expected: &[u32] = if height == 0 { &[0] } else { &[0, height as u32, 0] };
        assert_eq!(levels(&pieces[0]), expected);
    }
}

#[test]
fn the_base_circle_of_a_cylinder_on_a_plate_is_not_broken() {
    let circle: Vec<[f64; 2]> = (0..32)
        .map(|i| {
            let angle = f64::from(i) * std::f64::consts::TAU / 32.0;
            [angle.cos(), angle.sin()]
        })
        .collect();
    let ring = |z: f64| circle.iter().map(|&[x, y]| [x, y, z]).collect::<Vec<_>>();
    let (base, top) = (ring(1.0), ring(3.0));
    let walls: Vec<[[f64; 3]; 4]> = (0..32)
        .map(|i| (i, (i + 1) % 32))
        .map(|(i, j)| [base[i], base[j], top[j], top[i]])
        .collect();
    let mut cylinder: Vec<&[[f64; 3]]> = vec![&base, &top];
    cylinder.extend(walls.iter().map(|wall| &wall[..]));
    let plate: &[[f64; 3]] = &[[-3., -3., 1.], [3., -3., 1.], [3., 3., 1.], [-3., 3., 1.]];
    let camera =
        Camera::Orthographic { forward: DVec3::new(0.0, 1.0, -1.0), target: None, up: DVec3::Z };
    let view = camera.view((DVec3::ZERO, DVec3::ONE)).expect("a view");
    // Weld the cylinder's corners by position: Mesh does that per object.
    let mesh = Mesh::new(vec![soup(&cylinder, &[]), soup(&[plate], &[])], None).expect("a mesh");
    let run = Run::default();
    let view = PreparedView::new::<Exact>(&mesh, &view, &every_class(), &run).expect("a view");
    let question = view.question(true);
    let answer = roberts::<Exact>(&question, None, &run).expect("an answer");
    let mut seen = 0;
    for (i, line) in question.lines.iter().enumerate() {
        let LineOrigin::Edge(edge) = line.origin else {
            continue;
        };
        let ends = mesh.edges().ends(edge).map(|v| mesh.vertices()[v as usize]);
        let on_base = ends.iter().all(|p| p.z == 1.0 && p.truncate().length() < 2.0);
        if on_base && !mesh.is_inner(edge) {
            // The near half is in front of the cylinder, the far half behind.
            let near = ends[0].y + ends[1].y < 0.0;
            let expected: &[u32] = if near { &[0] } else { &[1] };
            let found = levels(answer.line(i));
            if near {
                assert_eq!(found, expected, "{ends:?}");
                seen += 1;
            } else {
                assert!(found.iter().all(|&level| level > 0), "{ends:?} {found:?}");
            }
        }
    }
    assert_eq!(seen, 16);
}

/// A generator of test scenes (Knuth's multiplier and increment).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }

    fn grid_point(&mut self) -> [f64; 3] {
        [0; 3].map(|_| self.below(4) as f64)
    }
}

fn random_soups(random: &mut Random, objects: u64) -> Vec<Soup> {
    (0..objects)
        .map(|_| {
            let count = 2 + random.below(6);
            let faces: Vec<[[f64; 3]; 3]> =
                (0..count).map(|_| [0; 3].map(|_| random.grid_point())).collect();
            let faces: Vec<&[[f64; 3]]> = faces.iter().map(|face| &face[..]).collect();
            let lines = [0; 2].map(|_| [0; 2].map(|_| random.grid_point()));
            soup(&faces, &lines)
        })
        .collect()
}

/// Checks every piece of every line; returns how many there were.
fn check_scene(mesh: &Mesh, view: &View, seed: u64) -> usize {
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(mesh, view, &every_class(), &run).expect("a view");
    let question = prepared.question(true);
    let answer = roberts::<Exact>(&question, None, &run).expect("an answer");
    let brute = BruteForce::new(&question, view);
    assert_eq!(answer.len(), question.lines.len());
    for (i, line) in question.lines.iter().enumerate() {
        let carrier = question.carrier(line);
        let pieces = answer.line(i);
        let [start, end] = brute.ends(carrier).map(|point| brute.in_front(point));
        if brute.is_end_on(carrier) || (start <= 0 && end <= 0) {
            assert!(pieces.is_empty(), "seed {seed} line {i}");
            continue;
        }
        let near = Place::Cut(Cut::Near);
        let first = if start < 0 { near } else { Place::Start };
        let last = if end < 0 { near } else { Place::End };
        assert_eq!(pieces.first().map(|piece| piece.from), Some(first), "seed {seed} line {i}");
        assert_eq!(pieces.last().map(|piece| piece.to), Some(last), "seed {seed} line {i}");
        for (k, piece) in pieces.iter().enumerate() {
            let [from, to] = [piece.from, piece.to].map(|place| brute.place(carrier, place));
            assert_eq!(brute.compare(carrier, from, to), Ordering::Less, "seed {seed} line {i}");
            if let Some(next) = pieces.get(k + 1) {
                let next_from = brute.place(carrier, next.from);
                assert_eq!(brute.compare(carrier, to, next_from), Ordering::Equal);
                assert_ne!(piece.invisibility, next.invisibility, "seed {seed} line {i}");
            }
            // Where the same count holds on both sides of a missed cut the
            // middle alone would not tell: two more points, near the ends.
            let middle = brute.middle(from, to);
            let points = [middle, brute.middle(from, middle), brute.middle(middle, to)];
            for point in points {
                let [left, right] = brute.sheets(carrier, point);
                assert_eq!(
                    piece.invisibility,
                    left.max(right),
                    "seed {seed} line {i} {line:?} piece {k} of {pieces:?}: {left} | {right}"
                );
            }
        }
    }
    answer.piece_count()
}

fn orthographic(forward: [f64; 3], up: DVec3) -> Camera {
    Camera::Orthographic { forward: DVec3::from(forward), target: None, up }
}

fn perspective(eye: [f64; 3], forward: [f64; 3], up: DVec3, near: f64) -> Camera {
    let eye = DVec3::from(eye);
    Camera::Perspective {
        eye,
        target: Some(eye + DVec3::from(forward)),
        up,
        near: Some(near),
        fov_y_degrees: 90.0,
    }
}

#[test]
fn random_grid_soups_agree_with_the_definition() {
    let cameras = [
        orthographic([0., 0., -1.], DVec3::Y),
        orthographic([-1., -1., -1.], DVec3::Z),
        orthographic([2., -1., 0.], DVec3::Z),
        orthographic([3., 5., -7.], DVec3::Z),
        // Outside, inside the soup off and on its grid planes, near planes
        // through grid points.
        perspective([1., -5., 2.], [0., 1., 0.], DVec3::Z, 1.0),
        perspective([1., 1., 1.], [1., 0., 0.], DVec3::Z, 1.0),
        perspective([2., 1., 2.], [0., 0., -1.], DVec3::Y, 1.0),
        perspective([7., 6., 5.], [-3., -4., 0.], DVec3::Z, 1.0),
        perspective([1., 3., 0.], [0., -3., 4.], DVec3::Z, 1.0),
    ];
    let mut pieces = 0;
    for seed in 0..200 {
        let mut random = Random(seed);
        let objects = 1 + random.below(2);
        let Ok(mesh) = Mesh::new(random_soups(&mut random, objects), None) else {
            continue;
        };
        for camera in [&cameras[seed as usize % cameras.len()], &cameras[random.below(9) as usize]]
        {
            let view = camera.view((DVec3::ZERO, DVec3::ONE)).expect("a view");
            pieces += check_scene(&mesh, &view, seed);
        }
    }
    assert!(pieces > 10_000, "{pieces}");
}

#[test]
fn selections_and_visible_only_are_parts_of_the_whole() {
    let mut random = Random(77);
    let mesh = Mesh::new(random_soups(&mut random, 2), None).expect("a mesh");
    let view = orthographic([-1., -2., -3.], DVec3::Z).view(mesh.bounds()).expect("a view");
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, &view, &every_class(), &run).expect("a view");
    let all = roberts::<Exact>(&prepared.question(true), None, &run).expect("an answer");
    let visible = roberts::<Exact>(&prepared.question(false), None, &run).expect("an answer");
    let chosen = roberts::<Exact>(&prepared.question(true), Some(&[7, 2]), &run).expect("two");
    assert_eq!(chosen.len(), 2);
    assert_eq!(chosen.line(0), all.line(7));
    assert_eq!(chosen.line(1), all.line(2));
    for i in 0..all.len() {
        let shown = all.line(i).iter().filter(|piece| piece.invisibility == 0);
        assert!(shown.eq(visible.line(i)));
    }
}
