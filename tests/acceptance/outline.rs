//! The outer outline parts the picture from the background.
//!
//! Shapes whose outline everyone can draw; then random soups, as degenerate
//! as they can be made, against two definitions written out: every triangle
//! asked exactly at a point inside every piece, and images of triangles in
//! floats beside the lines of the drawing. Neither knows of effective edges,
//! first counts or hierarchies.

use super::scenes::{
    Kind, Random, cuboid, orthographic, polygons, random_camera, random_soups, rounds,
};
use glam::{DVec2, DVec3, dvec3};
use umriss::kernel::numbers::Sign;
use umriss::kernel::predicates::{Carrier, Cut, Exact, Place, Predicates};
use umriss::model::{FeatureOptions, LineClass, Mesh, Projection, Soup, View};
use umriss::run::Run;
use umriss::view::{
    ExactLines, ExactPiece, LinePiece, LineQuestion, OutlineOf, PreparedView, VisibleLines,
};
use umriss::visibility::{AppelOptions, appel, outlined, reduce};

fn every_class() -> FeatureOptions {
    FeatureOptions::default().with_classes(&LineClass::ALL)
}

/// The drawing of all lines that are no mesh edges.
fn draw(soups: &[Soup], view: &View, of: OutlineOf) -> VisibleLines {
    let mesh = Mesh::new(soups.to_vec(), None).expect("a mesh");
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, view, &FeatureOptions::default(), &run);
    let prepared = prepared.expect("a view");
    let question = prepared.question(false);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).expect("an answer");
    let answer = outlined::<Exact>(&question, &answer, of, &run).expect("an outline");
    reduce::<Exact>(&question, &answer, &run).expect("lines")
}

fn outline(lines: &VisibleLines) -> Vec<&LinePiece> {
    lines.pieces.iter().filter(|piece| piece.outline).collect()
}

fn length<'a>(pieces: impl IntoIterator<Item = &'a LinePiece>) -> f64 {
    pieces.into_iter().map(|piece| piece.points[0].distance(piece.points[1])).sum()
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9 * (1.0 + expected), "{found}, expected {expected}");
}

fn cube(low: [f64; 3], high: [f64; 3]) -> Soup {
    polygons(&cuboid(low.into(), high.into()), &[])
}

fn iso() -> View {
    orthographic(-DVec3::ONE)
}

/// A cube's edge in the isometric image.
fn short() -> f64 {
    (2.0_f64 / 3.0).sqrt()
}

#[test]
fn the_outline_of_a_cube_is_a_hexagon() {
    let lines = draw(&[cube([0.0; 3], [1.0; 3])], &iso(), OutlineOf::Scene);
    assert_eq!((lines.pieces.len(), outline(&lines).len()), (9, 6));
    close(length(outline(&lines)), 6.0 * short());
    // The three edges at the nearest corner, whose image is the origin.
    let inner = lines.pieces.iter().filter(|piece| !piece.outline);
    inner.for_each(|piece| assert!(piece.points.iter().any(|point| point.length() < 1e-12)));
    let front = draw(&[cube([0.0; 3], [1.0; 3])], &orthographic(DVec3::Y), OutlineOf::Scene);
    assert_eq!((front.pieces.len(), outline(&front).len()), (4, 4));
}

#[test]
fn what_lies_behind_is_no_background() {
    // A small cube before the middle of a large plate.
    let plate = polygons(
        &[vec![
            dvec3(-9.0, -9.0, 0.0),
            dvec3(9.0, -9.0, 0.0),
            dvec3(9.0, 9.0, 0.0),
            dvec3(-9.0, 9.0, 0.0),
        ]],
        &[],
    );
    let scene = [plate, cube([-1.0, -1.0, 2.0], [1.0, 1.0, 3.0])];
    let above = orthographic(-DVec3::Z);
    close(length(outline(&draw(&scene, &above, OutlineOf::Scene))), 72.0);
    close(length(outline(&draw(&scene, &above, OutlineOf::Objects))), 72.0 + 8.0);
}

#[test]
fn an_edge_that_reaches_beyond_what_is_behind_it_is_outline_there() {
    // Two cubes, in the image shifted by half an edge.
    let scene = [cube([0.0, 0.0, 0.0], [2.0, 2.0, 1.0]), cube([1.0, 1.0, 2.0], [3.0, 3.0, 3.0])];
    let above = orthographic(-DVec3::Z);
    let lines = draw(&scene, &above, OutlineOf::Scene);
    close(length(outline(&lines)), 12.0);
    let inner: Vec<_> = lines.pieces.iter().filter(|piece| !piece.outline).collect();
    close(length(inner.iter().copied()), 2.0);
    assert!(inner.iter().all(|piece| piece.object == 1));
    let lines = draw(&scene, &above, OutlineOf::Objects);
    assert_eq!(outline(&lines).len(), lines.pieces.len());
    close(length(outline(&lines)), 14.0);
}

#[test]
fn the_rim_of_a_hole_is_outline_where_one_sees_through() {
    let square =
        |r: f64, z: f64| [[-r, -r], [r, -r], [r, r], [-r, r]].map(|[x, y]| dvec3(x, y, z)).to_vec();
    let plate = |floor: bool| {
        let vertices = [square(3.0, 0.0), square(1.0, 0.0)].concat();
        let mut soup = Soup { vertices, ..Soup::default() };
        soup.faces.push(&[0, 1, 2, 3], [&[7_u32, 6, 5, 4][..]]);
        let mut soups = vec![soup];
        soups.extend(floor.then(|| polygons(&[square(2.0, -1.0)], &[])));
        soups
    };
    let above = orthographic(-DVec3::Z);
    close(length(outline(&draw(&plate(false), &above, OutlineOf::Scene))), 24.0 + 8.0);
    close(length(outline(&draw(&plate(true), &above, OutlineOf::Scene))), 24.0);
    close(length(outline(&draw(&plate(true), &above, OutlineOf::Objects))), 24.0 + 8.0);
}

#[test]
fn wires_and_sheets_from_the_edge_have_no_outline() {
    let wire = [dvec3(0.0, 0.0, 0.0), dvec3(4.0, 1.0, 0.0)];
    let sheet = [dvec3(0.0, 5.0, 0.0), dvec3(1.0, 5.0, 0.0), dvec3(1.0, 5.0, 1.0)];
    let soup = polygons(&[sheet.to_vec()], &[wire]);
    let lines = draw(&[soup], &orthographic(-DVec3::Z), OutlineOf::Scene);
    assert_eq!(outline(&lines).len(), 0);
    close(length(&lines.pieces), 17.0_f64.sqrt() + 1.0);
}

/// A torus around z, radii 3 and 1, with `steps` squared quadrilaterals.
fn torus(steps: u32) -> Soup {
    let turn = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(steps);
    let mut soup = Soup::default();
    for i in 0..steps * steps {
        let (u, v) = (turn(i / steps), turn(i % steps));
        let reach = 3.0 + v.cos();
        soup.vertices.push(dvec3(reach * u.cos(), reach * u.sin(), v.sin()));
    }
    for i in 0..steps * steps {
        let (r, c) = (i / steps, i % steps);
        let (s, d) = ((r + 1) % steps * steps, (c + 1) % steps);
        soup.faces.push(&[r * steps + c, s + c, s + d, r * steps + d], []);
    }
    soup
}

#[test]
fn a_torus_has_an_outline_around_its_hole() {
    // From above the contours are two polygons, through the outermost and
    // the innermost vertices.
    let perimeter = |radius: f64| 2.0 * 48.0 * radius * (std::f64::consts::PI / 48.0).sin();
    let lines = draw(&[torus(48)], &orthographic(-DVec3::Z), OutlineOf::Scene);
    close(length(outline(&lines)), perimeter(4.0) + perimeter(2.0));
    // So much from the side that the hole is closed.
    let lines = draw(&[torus(48)], &orthographic(dvec3(1.0, 0.3, -0.1)), OutlineOf::Scene);
    let contour = || lines.pieces.iter().filter(|piece| piece.class == LineClass::Contour);
    let inner = length(contour().filter(|piece| !piece.outline));
    assert!(1.0 < inner && inner < 0.5 * length(outline(&lines)), "{inner}");
    assert!(outline(&lines).iter().all(|piece| piece.points.iter().all(|p| p.length() > 0.9)));
}

/// Sheets over the two sides of a line beside a point inside a piece, every
/// triangle asked.
fn sheets_beside(
    question: &LineQuestion<'_>,
    predicates: &Predicates<'_, Exact>,
    carrier: Carrier,
    places: [Place; 2],
    counts: impl Fn(u32) -> bool,
) -> [u32; 2] {
    let mut sides = [0; 2];
    for (index, &[a, b, c]) in question.mesh.triangles().iter().enumerate() {
        let facing = question.facing[index];
        if facing.is_zero() || !counts(index as u32) {
            continue;
        }
        let mut covers = [true; 2];
        for [x, y, third] in [[a, b, c], [b, c, a], [c, a, b]] {
            let cut = Cut::Silhouette([x, y]);
            // At the point; a little further on if it is on the edge's image;
            // and beside the line if all of that is.
            let at = predicates.between(carrier, places, cut);
            let onward = predicates.value_sign(cut, carrier.ends[1]);
            let onward = if onward.is_zero() {
                -predicates.value_sign(cut, carrier.ends[0])
            } else {
                onward
            };
            match if at.is_zero() { onward } else { at } {
                Sign::Zero => {
                    let left = predicates.image_side(carrier, third) == Sign::Positive;
                    covers = [covers[0] && left, covers[1] && !left];
                }
                sign if sign != facing => covers = [false; 2],
                _ => {}
            }
        }
        sides = [0, 1].map(|side| sides[side] + u32::from(covers[side]));
    }
    sides
}

/// What an outline may differ from its answer in: cuts of visible pieces.
fn uncut(pieces: &[ExactPiece]) -> Vec<ExactPiece> {
    let mut whole: Vec<ExactPiece> = Vec::new();
    let mut before = None;
    for piece in pieces {
        match whole.last_mut() {
            Some(last) if last.to == piece.from && last.invisibility == piece.invisibility => {
                assert_ne!(before, Some(piece.outline), "pieces are as long as can be");
                last.to = piece.to;
            }
            _ => whole.push(ExactPiece { outline: false, ..*piece }),
        }
        before = Some(piece.outline);
    }
    whole
}

/// Whether the outline of one scene is what the definition says; counts the
/// pieces by what they are.
fn check(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    of: OutlineOf,
    what: &str,
) -> [usize; 3] {
    let found = outlined::<Exact>(question, answer, of, &Run::default()).expect("an outline");
    let predicates = Predicates::<Exact>::new(question.points);
    let mut counts = [0; 3];
    for (index, line) in question.lines.iter().enumerate() {
        assert_eq!(uncut(found.line(index)), uncut(answer.line(index)), "{what}");
        let carrier = question.carrier(line);
        let vertex = line.origin.names(question.mesh).map(|[vertex, _]| vertex);
        let object = vertex.map(|vertex| question.mesh.object_of_vertex(vertex));
        let own = |triangle| object == Some(question.mesh.object_of_triangle(triangle));
        for piece in found.line(index) {
            let places = [piece.from, piece.to];
            let all = of == OutlineOf::Scene;
            let sides = sheets_beside(question, &predicates, carrier, places, |t| all || own(t));
            let expected = piece.invisibility == 0 && (sides[0] == 0) != (sides[1] == 0);
            assert_eq!(piece.outline, expected, "{what}: {line:?} {piece:?} {sides:?}");
            counts[usize::from(piece.outline)] += usize::from(piece.invisibility == 0);
        }
        counts[2] += found.line(index).len() - answer.line(index).len();
    }
    counts
}

#[test]
fn every_piece_is_outline_iff_one_of_its_sides_is_empty() {
    let mut sums = [[0; 3]; 2];
    for seed in 0..rounds(60) {
        for kind in Kind::ALL {
            let mut random = Random(seed * 77 + kind as u64);
            let soups = random_soups(&mut random, kind);
            let view = random_camera(&mut random, &soups);
            let Ok(mesh) = Mesh::new(soups, None) else {
                continue;
            };
            let run = Run::default();
            let prepared = PreparedView::new::<Exact>(&mesh, &view, &every_class(), &run);
            let prepared = prepared.expect("a view");
            let question = prepared.question(true);
            let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).expect("lines");
            for (of, sum) in OutlineOf::ALL.into_iter().zip(&mut sums) {
                let what = format!("{kind:?} {seed} {of:?} {:?}", view.eye);
                let counts = check(&question, &answer, of, &what);
                *sum = [0, 1, 2].map(|i| sum[i] + counts[i]);
            }
        }
    }
    // Inner pieces, outlines and cuts, in good numbers.
    assert!(sums.as_flattened().iter().all(|&count| count > 100), "{sums:?}");
}

/// How many triangles' images hold a point, by floats; nothing if a border
/// is too near to tell.
fn covered(triangles: &[[DVec2; 3]], point: DVec2) -> Option<usize> {
    let mut count = 0;
    for corners in triangles {
        let [a, b, c] = *corners;
        let sides = [[a, b], [b, c], [c, a]].map(|[from, to]| (to - from).perp_dot(point - from));
        let inside = sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0);
        let near = super::scenes::distance;
        if [[a, b], [b, c], [c, a]].into_iter().any(|side| near(point, side) < 1e-9) {
            return None;
        }
        count += usize::from(inside);
    }
    Some(count)
}

#[test]
fn the_drawing_agrees_with_images_of_triangles_beside_its_lines() {
    let mut seen = [0; 2];
    for seed in 0..rounds(60) {
        for kind in [Kind::General, Kind::Grid, Kind::Boxes, Kind::Turned] {
            let mut random = Random(seed * 13 + kind as u64);
            let soups = random_soups(&mut random, kind);
            let view = random_camera(&mut random, &soups);
            if view.frame.projection == Projection::Perspective {
                continue;
            }
            let Ok(mesh) = Mesh::new(soups.clone(), None) else {
                continue;
            };
            let lines = draw(&soups, &view, OutlineOf::Scene);
            let image = |v: u32| {
                let offset = mesh.vertices()[v as usize] - view.frame.origin;
                DVec2::new(view.frame.right.dot(offset), view.frame.up.dot(offset))
            };
            let triangles: Vec<_> = mesh.triangles().iter().map(|t| t.map(image)).collect();
            for piece in lines.pieces.iter().filter(|piece| piece.is_visible()) {
                let [from, to] = piece.points;
                let aside = 1e-7 * (to - from).perp().normalize_or_zero();
                // At no place where a corner on the empty side may touch the line.
                for part in [0.213_7, 0.487_1, 0.829_3] {
                    let point = from.lerp(to, part);
                    let [Some(left), Some(right)] =
                        [point + aside, point - aside].map(|p| covered(&triangles, p))
                    else {
                        continue;
                    };
                    let expected = (left == 0) != (right == 0);
                    assert_eq!(piece.outline, expected, "{kind:?} {seed} {piece:?} {left} {right}");
                    seen[usize::from(expected)] += 1;
                }
            }
        }
    }
    assert!(seen.iter().all(|&count| count > 300), "{seen:?}");
}
