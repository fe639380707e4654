//! What must not matter.
//!
//! The drawing is a function of the geometry: scaling by powers of two,
//! exact shifts, permuted axes, mirrors, rational rotations, the order of
//! faces and vertices and their winding change names and places of pieces
//! in the known way and nothing else. Every soup is drawn twice, and pieces
//! are matched one to one: class, number of sheets, part of the outline or not,
//! object, edge, ends.
//! Pieces of one straight run that differ in nothing are joined first, for
//! the triangulation of a polygon is not part of its geometry.
//!
//! An eye very far away sees what parallel rays see.

use super::scenes::{
    Kind, Random, assert_same_picture, orthographic, random_camera, random_soups, rounds,
};
use glam::{DVec2, DVec3};
use umriss::kernel::predicates::{Exact, Eye};
use umriss::model::{Camera, FeatureOptions, LineClass, Mesh, Soup, View};
use umriss::run::Run;
use umriss::view::{LinePiece, LineSource, OutlineOf, PreparedView, VisibleLines};
use umriss::visibility::{AppelOptions, appel, outlined, reduce};

fn draw(soups: &[Soup], view: &View) -> VisibleLines {
    let mesh = Mesh::new(soups.to_vec(), None).expect("a mesh");
    let options = FeatureOptions::default().with_classes(&LineClass::ALL);
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, view, &options, &run).expect("a view");
    let question = prepared.question(true);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).expect("an answer");
    let answer = outlined::<Exact>(&question, &answer, OutlineOf::Scene, &run).expect("outlines");
    reduce::<Exact>(&question, &answer, &run).expect("lines")
}

/// A piece without what depends on names.
#[derive(Debug, Clone, PartialEq)]
struct Stretch {
    class: LineClass,
    invisibility: u32,
    outline: bool,
    object: u32,
    source: LineSource,
    points: [DVec2; 2],
}

impl Stretch {
    fn new(piece: &LinePiece) -> Self {
        let source = match piece.source {
            LineSource::Edge([a, b]) => LineSource::Edge([a.min(b), a.max(b)]),
            // Several pairs of faces may share a line; which one names it is
            // a tie.
            LineSource::Faces(_) => LineSource::Faces([0, 0]),
        };
        let LinePiece { class, invisibility, outline, object, points, .. } = *piece;
        Stretch { class, invisibility, outline, object, source, points }
    }

    fn is_like(&self, other: &Self) -> bool {
        (self.class, self.invisibility, self.outline, self.object, self.source)
            == (other.class, other.invisibility, other.outline, other.object, other.source)
    }

    fn covers(&self, other: &Self, tolerance: f64) -> bool {
        let near = |a: DVec2, b: DVec2| a.distance(b) <= tolerance;
        let ([a, b], [c, d]) = (self.points, other.points);
        self.is_like(other) && (near(a, c) && near(b, d) || near(a, d) && near(b, c))
    }
}

/// The pieces, those that only a triangulation divides joined.
fn stretches(lines: &VisibleLines) -> Vec<Stretch> {
    joined(lines.pieces.iter().map(|piece| (piece.run, Stretch::new(piece))))
}

/// Joins what follows one another in one run and differs in nothing. What
/// lies between two pieces keeps them apart, even if it is rounded to a
/// point.
fn joined(pieces: impl Iterator<Item = (u32, Stretch)>) -> Vec<Stretch> {
    let all: Vec<(u32, Stretch)> = pieces.collect();
    let is_between = |run: u32, stretch: &Stretch, point: DVec2| {
        all.iter().any(|(other_run, other)| {
            *other_run == run && !stretch.is_like(other) && other.points.contains(&point)
        })
    };
    let joint = |run: u32, stretch: &Stretch, other: &Stretch| {
        let shared = |p: &DVec2| other.points.contains(p) && !is_between(run, stretch, *p);
        stretch.is_like(other).then(|| stretch.points.into_iter().find(shared))?
    };
    let mut groups: Vec<(u32, Stretch)> = Vec::new();
    for (run, mut stretch) in all.iter().cloned() {
        // Joining one neighbour may bring it next to another.
        while let Some((found, joint)) =
            groups.iter().enumerate().find_map(|(found, (other_run, other))| {
                let same_run = (*other_run == run).then_some(other)?;
                Some((found, joint(run, &stretch, same_run)?))
            })
        {
            let (_, other) = groups.swap_remove(found);
            let apart = |points: [DVec2; 2]| if points[0] == joint { points[1] } else { points[0] };
            stretch.points = [apart(stretch.points), apart(other.points)];
        }
        groups.push((run, stretch));
    }
    groups.into_iter().map(|(_, stretch)| stretch).collect()
}

/// Asserts that two drawings have the same pieces.
fn assert_same(
    found: &VisibleLines,
    expected: &VisibleLines,
    change: impl Fn(&mut Stretch),
    what: &str,
) {
    let mut expected = stretches(expected);
    expected.iter_mut().for_each(change);
    assert_matched(stretches(found), expected, 1e-9, what);
}

/// The same, but where lines coincide another one of them may be drawn: the
/// one with the least coordinates is, and the axes have changed.
fn assert_same_up_to_ties(
    found: &VisibleLines,
    expected: &VisibleLines,
    scale: f64,
    tolerance: f64,
    what: &str,
) {
    let [found, mut expected] = [found, expected].map(|lines| {
        let pieces = lines.pieces.iter().map(|piece| {
            let stretch = Stretch::new(piece);
            (piece.run, Stretch { object: 0, source: LineSource::Faces([0, 0]), ..stretch })
        });
        joined(pieces)
    });
    for stretch in &mut expected {
        stretch.points = stretch.points.map(|point| point * scale);
    }
    assert_matched(found, expected, tolerance, what);
}

fn assert_matched(mut left: Vec<Stretch>, expected: Vec<Stretch>, tolerance: f64, what: &str) {
    for stretch in expected {
        let size = stretch.points.iter().map(|point| point.length()).fold(0.0, f64::max);
        let place = left.iter().position(|other| stretch.covers(other, tolerance * size));
        match place {
            Some(place) => drop(left.swap_remove(place)),
            None => {
                left.retain(|other| stretch.is_like(other));
                panic!("{what}: no longer {stretch:?}\n  but {left:?}");
            }
        }
    }
    assert!(left.is_empty(), "{what}: new {left:?}");
}

/// Random scenes for one test.
fn scenes(few: u64, kinds: &[Kind], mut test: impl FnMut(&mut Random, Vec<Soup>, View, &str)) {
    for seed in 0..rounds(few) {
        for &kind in kinds {
            let mut random = Random(seed ^ 0x5eed << 32 ^ (kind as u64) << 56);
            let soups = random_soups(&mut random, kind);
            let view = random_camera(&mut random, &soups);
            if Mesh::new(soups.clone(), None).is_ok() {
                test(&mut random, soups, view, &format!("seed {seed} of {kind:?}"));
            }
        }
    }
}

/// Kinds without bent quadrilaterals, whose triangles depend on which corner
/// is the first.
const FLAT: [Kind; 7] =
    [Kind::General, Kind::Grid, Kind::Pool, Kind::Boxes, Kind::Planes, Kind::Turned, Kind::Cards];

/// Kinds that bear shifts and rotations without rounding.
const INTEGERS: [Kind; 6] =
    [Kind::Grid, Kind::Pool, Kind::Boxes, Kind::Planes, Kind::Turned, Kind::Cards];

fn map_points(soups: &[Soup], map: impl Fn(DVec3) -> DVec3) -> Vec<Soup> {
    let mut soups = soups.to_vec();
    soups.iter_mut().flat_map(|soup| &mut soup.vertices).for_each(|point| *point = map(*point));
    soups
}

/// The view with a linear map of determinant one or a mirror, times `scale`.
/// Directions stay as they are in length.
fn map_view(view: &View, map: impl Fn(DVec3) -> DVec3, scale: f64) -> View {
    let mut mapped = *view;
    mapped.eye = match view.eye {
        Eye::At(eye) => Eye::At(map(eye) * scale),
        Eye::Towards(eye) => Eye::Towards(map(eye)),
    };
    if let Some(near) = &mut mapped.near {
        near.forward = map(near.forward);
        near.distance *= scale;
    }
    let frame = &mut mapped.frame;
    frame.origin = map(frame.origin) * scale;
    for axis in [&mut frame.right, &mut frame.up, &mut frame.forward] {
        *axis = map(*axis);
    }
    mapped
}

/// How much larger the image is.
fn image_scale(view: &View, scale: f64) -> f64 {
    if view.eye.is_perspective() { 1.0 } else { scale }
}

#[test]
fn scaling_by_powers_of_two() {
    scenes(8, &Kind::ALL, |_, soups, view, what| {
        // The least float would be rounded away.
        let tiny = |x: f64| x != 0.0 && x.abs() < 1e-200;
        let mut points = soups.iter().flat_map(|soup| &soup.vertices);
        if points.any(|point| point.to_array().into_iter().any(tiny)) {
            return;
        }
        let before = draw(&soups, &view);
        for exponent in [-40, 13, 200] {
            let scale = f64::powi(2.0, exponent);
            let after =
                draw(&map_points(&soups, |point| point * scale), &map_view(&view, |p| p, scale));
            let grow = |stretch: &mut Stretch| {
                stretch.points = stretch.points.map(|point| point * image_scale(&view, scale));
            };
            assert_same(&after, &before, grow, what);
        }
    });
}

#[test]
fn shifts_without_rounding() {
    scenes(8, &INTEGERS, |_, soups, view, what| {
        // Eyes with long mantissas would be rounded.
        let eye = view.eye.coordinates();
        if view.eye.is_perspective() && eye * 1024.0 != (eye * 1024.0).round() {
            return;
        }
        let shift = DVec3::new(1024.0, -77.0, 524_288.0);
        let mut moved = view;
        if let Eye::At(eye) = view.eye {
            moved.eye = Eye::At(eye + shift);
        }
        moved.frame.origin += shift;
        let after = draw(&map_points(&soups, |point| point + shift), &moved);
        assert_same(&after, &draw(&soups, &view), |_| (), what);
    });
}

#[test]
fn order_of_faces_and_vertices_and_winding() {
    scenes(20, &FLAT, |random, soups, view, what| {
        let before = draw(&soups, &view);
        let mut shuffled = Vec::new();
        // Where vertex i of each object went.
        let mut new_of_old: Vec<Vec<u32>> = Vec::new();
        for soup in &soups {
            let (soup, places) = shuffle(random, soup);
            shuffled.push(soup);
            new_of_old.push(places);
        }
        let after = draw(&shuffled, &view);
        // A drawing names the first of equal vertices.
        let first = |soups: &[Soup], object: u32, vertex: u32| {
            let vertices = &soups[object as usize].vertices;
            let position = vertices[vertex as usize];
            vertices.iter().position(|&other| other == position).expect("itself") as u32
        };
        let rename = |stretch: &mut Stretch| {
            if let LineSource::Edge(ends) = stretch.source {
                let [a, b] = ends.map(|vertex| {
                    let place = new_of_old[stretch.object as usize][vertex as usize];
                    first(&shuffled, stretch.object, place)
                });
                stretch.source = LineSource::Edge([a.min(b), a.max(b)]);
            }
        };
        assert_same(&after, &before, rename, what);
    });
}

/// The same object in another order, and where its vertices went.
fn shuffle(random: &mut Random, soup: &Soup) -> (Soup, Vec<u32>) {
    let mut old_of_new: Vec<usize> = (0..soup.vertices.len()).collect();
    random.shuffle(&mut old_of_new);
    let mut new_of_old = vec![0; soup.vertices.len()];
    for (new, &old) in old_of_new.iter().enumerate() {
        new_of_old[old] = new as u32;
    }
    let mut faces: Vec<Vec<u32>> = (0..soup.faces.len())
        .map(|face| soup.faces.rings(face).next().expect("an outer ring").to_vec())
        .collect();
    random.shuffle(&mut faces);
    let mut lines = soup.lines.clone();
    random.shuffle(&mut lines);
    let mut shuffled = Soup {
        vertices: old_of_new.iter().map(|&old| soup.vertices[old]).collect(),
        ..Soup::default()
    };
    for mut face in faces {
        let places = random.below(face.len() as u64) as usize;
        face.rotate_left(places);
        if random.one_in(2) {
            face.reverse();
        }
        face.iter_mut().for_each(|vertex| *vertex = new_of_old[*vertex as usize]);
        shuffled.faces.push(&face, []);
    }
    for mut line in lines {
        if random.one_in(2) {
            line.reverse();
        }
        shuffled.lines.push(line.map(|vertex| new_of_old[vertex as usize]));
    }
    (shuffled, new_of_old)
}

/// The same object with its faces in another order, turned and wound otherwise.
fn with_turned_faces(random: &mut Random, soup: &Soup) -> Soup {
    let mut faces: Vec<Vec<u32>> = (0..soup.faces.len())
        .map(|face| soup.faces.rings(face).next().expect("an outer ring").to_vec())
        .collect();
    random.shuffle(&mut faces);
    let mut turned = Soup { faces: Default::default(), ..soup.clone() };
    for mut face in faces {
        let places = random.below(face.len() as u64) as usize;
        face.rotate_left(places);
        if random.one_in(2) {
            face.reverse();
        }
        turned.faces.push(&face, []);
    }
    turned
}

/// The pieces as they are, to the bit, but for the numbers of faces.
fn without_faces(lines: VisibleLines) -> VisibleLines {
    let mut lines = VisibleLines { counters: Default::default(), ..lines };
    for piece in &mut lines.pieces {
        if let LineSource::Faces(faces) = &mut piece.source {
            *faces = [0, 0];
        }
    }
    lines
}

#[cfg(feature = "svg")]
#[test]
fn bytes_for_any_order_of_faces_and_winding() {
    use umriss::drawing::{Drawing, DrawingOptions, Hidden};
    use umriss::export::{SvgOptions, to_svg};
    let svg = |lines: &VisibleLines| {
        let options = DrawingOptions { hidden: Hidden::Dashed, ..DrawingOptions::default() };
        let drawing = Drawing::new(lines, &options).ok()?;
        Some(to_svg(&drawing, &SvgOptions::default()).expect("an SVG"))
    };
    let mut crossings = 0;
    scenes(60, &FLAT, |random, soups, view, what| {
        let before = without_faces(draw(&soups, &view));
        let is_crossing = |piece: &LinePiece| piece.class == LineClass::Intersection;
        crossings += before.pieces.iter().filter(|piece| is_crossing(piece)).count();
        for _ in 0..3 {
            let turned: Vec<Soup> =
                soups.iter().map(|soup| with_turned_faces(random, soup)).collect();
            let after = without_faces(draw(&turned, &view));
            for (found, expected) in after.pieces.iter().zip(&before.pieces) {
                assert_eq!(found, expected, "{what}");
            }
            assert_eq!(after, before, "{what}");
            assert_eq!(svg(&after), svg(&before), "{what}");
        }
    });
    assert!(crossings > 500, "only {crossings} pieces of intersection lines");
}

#[test]
fn permuted_axes_and_mirrors() {
    let maps: [fn(DVec3) -> DVec3; 5] = [
        |p| DVec3::new(p.y, p.z, p.x),
        |p| DVec3::new(p.z, p.x, p.y),
        |p| DVec3::new(p.y, p.x, p.z),
        |p| DVec3::new(-p.x, p.y, p.z),
        |p| DVec3::new(p.x, -p.z, -p.y),
    ];
    scenes(8, &FLAT, |_, soups, view, what| {
        let before = draw(&soups, &view);
        for map in maps {
            // Axes of the image go with the scene, so the picture stays.
            let mapped = map_view(&view, map, 1.0);
            let after = draw(&map_points(&soups, map), &mapped);
            assert_same_up_to_ties(&after, &before, 1.0, 1e-9, what);
        }
    });
}

#[test]
fn rational_rotations() {
    // A rotation times seven.
    let rotated = |p: DVec3| {
        DVec3::new(
            2.0 * p.x + 3.0 * p.y + 6.0 * p.z,
            3.0 * p.x - 6.0 * p.y + 2.0 * p.z,
            6.0 * p.x + 2.0 * p.y - 3.0 * p.z,
        )
    };
    scenes(10, &INTEGERS, |_, soups, view, what| {
        let eye = view.eye.coordinates();
        if eye * 1024.0 != (eye * 1024.0).round() {
            return;
        }
        // The near plane keeps 24 bits of its distance, not the same ones.
        let cut = |point: &DVec3| {
            view.near.is_some_and(|near| {
                near.forward.dot(*point - eye) < 2.0 * near.distance * near.forward.length()
            })
        };
        if soups.iter().flat_map(|soup| &soup.vertices).any(cut) {
            return;
        }
        let mut turned = map_view(&view, rotated, 1.0);
        // The near plane's distance counts in lengths, its normal does not.
        if let Some(near) = &mut turned.near {
            near.distance *= 7.0;
        }
        let frame = &mut turned.frame;
        for axis in [&mut frame.right, &mut frame.up, &mut frame.forward] {
            *axis /= 7.0;
        }
        let after = draw(&map_points(&soups, rotated), &turned);
        let before = draw(&soups, &view);
        assert_same_up_to_ties(&after, &before, image_scale(&view, 7.0), 1e-9, what);
    });
}

#[test]
fn a_very_far_eye_sees_what_parallel_rays_see() {
    let options = FeatureOptions::default().with_classes(&LineClass::ALL);
    for seed in 0..rounds(40) {
        let mut random = Random(seed);
        let soups = random_soups(&mut random, Kind::General);
        let mesh = Mesh::new(soups, None).expect("a mesh");
        let towards = DVec3::from([0; 3].map(|_| random.below(2001) as f64 - 1000.0));
        let parallel = orthographic(-towards);
        // The target is the origin, which the sum of eye and direction
        // would miss by rounding.
        let camera = Camera::Perspective {
            eye: towards * f64::powi(2.0, 60),
            target: Some(DVec3::ZERO),
            up: DVec3::Z,
            near: Some(f64::powi(2.0, 50)),
            fov_y_degrees: 1.0,
        };
        let central = camera.view((DVec3::ZERO, DVec3::ONE)).expect("a view");
        let answers = [parallel, central].map(|view| {
            let run = Run::default();
            let prepared =
                PreparedView::new::<Exact>(&mesh, &view, &options, &run).expect("a view");
            let question = prepared.question(true);
            let answer = appel::<Exact>(&question, &AppelOptions::default(), &run);
            (question.lines.to_vec(), answer.expect("not cancelled"))
        });
        assert_eq!(answers[0], answers[1], "seed {seed}");
    }
}

#[test]
fn order_of_objects_changes_names_only() {
    scenes(20, &INTEGERS, |_, soups, view, what| {
        let turned: Vec<Soup> = soups.iter().rev().cloned().collect();
        // Coincident lines of two objects are a tie of names, not of points.
        if !view.eye.is_perspective() {
            assert_same_picture(&draw(&soups, &view), &draw(&turned, &view), what);
        }
    });
}
