//! Where faces pass through one another.
//!
//! Solids that interpenetrate must look like their union, which is built
//! here by hand. Touching is not passing through. Pairs of triangles on a
//! grid are checked against the segment computed in whole numbers: the
//! common line of the two planes, cut by both triangles.

use super::scenes::{
    Random, assert_same_picture, cuboid, orthographic, perspective, polygons, rounds,
};
use glam::{DVec3, dvec3};
use std::path::Path;
use umriss::kernel::predicates::{Exact, Piercing, Point};
use umriss::model::{FeatureOptions, LineClass, Mesh, Soup, View, import};
use umriss::run::Run;
use umriss::view::{PreparedView, VisibleLines};
use umriss::visibility::visible_lines;

fn draw(soups: Vec<Soup>, view: &View) -> VisibleLines {
    let mesh = Mesh::new(soups, None).expect("a mesh");
    visible_lines(&mesh, view, &FeatureOptions::default(), true, &Run::default()).expect("lines")
}

/// The point where an edge meets a face's plane, rounded.
fn position(mesh: &Mesh, point: Point) -> DVec3 {
    let vertex = |i: u32| mesh.vertices()[i as usize];
    match point {
        Point::Vertex(i) => vertex(i),
        Point::Piercing(Piercing { edge, face }) => {
            let [a, b] = edge.map(vertex);
            let [x, y, z] = face.map(vertex);
            let normal = (y - x).cross(z - x);
            let (below, above) = (normal.dot(a - x), normal.dot(b - x));
            a + (b - a) * (below / (below - above))
        }
    }
}

/// The intersection lines of a scene: ends, the lesser first, sorted.
fn intersection_lines(soups: Vec<Soup>) -> Vec<[[f64; 3]; 2]> {
    let mesh = Mesh::new(soups, None).expect("a mesh");
    // Which faces cross does not depend on the eye; the boxes do.
    let views = [orthographic(dvec3(1.0, 2.0, -3.0)), orthographic(DVec3::X)];
    let found = views.map(|view| {
        let options = FeatureOptions::default();
        let run = Run::default();
        let prepared = PreparedView::new::<Exact>(&mesh, &view, &options, &run).expect("a view");
        let mut lines: Vec<_> = prepared
            .question(true)
            .intersections
            .iter()
            .map(|line| {
                let [a, b] = line.carrier.ends.map(|end| position(&mesh, end).to_array());
                if a <= b { [a, b] } else { [b, a] }
            })
            .collect();
        lines.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        lines
    });
    assert_eq!(found[0], found[1]);
    found.into_iter().next().expect("two")
}

fn views() -> Vec<(&'static str, View)> {
    vec![
        ("general", orthographic(dvec3(-3.0, -2.0, -1.0))),
        ("another", orthographic(dvec3(2.0, -5.0, 1.5))),
        ("below", orthographic(dvec3(0.3, 0.2, 1.0))),
        ("iso", orthographic(dvec3(-1.0, -1.0, -1.0))),
        ("iso from the other side", orthographic(dvec3(1.0, 1.0, 1.0))),
        ("along a face", orthographic(dvec3(0.0, 1.0, -1.0))),
        ("near", perspective(dvec3(7.0, 6.0, 5.0), dvec3(-6.0, -5.0, -4.0), 0.5)),
        ("far", perspective(dvec3(-70.0, 31.0, 55.0), dvec3(72.0, -30.0, -54.0), 0.5)),
    ]
}

/// A face with its axes turned by one place, `times` times.
fn turned(face: &[[f64; 3]], times: usize) -> Vec<DVec3> {
    face.iter()
        .map(|&p| {
            let mut p = p;
            p.rotate_right(times);
            DVec3::from(p)
        })
        .collect()
}

#[test]
fn interpenetrating_cubes_look_like_their_union() {
    let faces: [&[[f64; 3]]; 4] = [
        &[[0., 0., 0.], [0., 2., 0.], [2., 2., 0.], [2., 0., 0.]],
        &[[0., 0., 2.], [2., 0., 2.], [2., 1., 2.], [1., 1., 2.], [1., 2., 2.], [0., 2., 2.]],
        &[[1., 1., 3.], [3., 1., 3.], [3., 3., 3.], [1., 3., 3.]],
        &[[2., 1., 1.], [2., 2., 1.], [1., 2., 1.], [1., 3., 1.], [3., 3., 1.], [3., 1., 1.]],
    ];
    let union: Vec<Vec<DVec3>> =
        (0..3).flat_map(|times| faces.iter().map(move |face| turned(face, times))).collect();
    let cubes =
        [0.0, 1.0].map(|low| polygons(&cuboid(DVec3::splat(low), DVec3::splat(low + 2.0)), &[]));
    for (name, view) in views() {
        let found = draw(cubes.to_vec(), &view);
        let expected = draw(vec![polygons(&union, &[])], &view);
        assert_same_picture(&found, &expected, name);
        // The same for one object that passes through itself.
        let mut all = cuboid(DVec3::ZERO, DVec3::splat(2.0));
        all.extend(cuboid(DVec3::ONE, DVec3::splat(3.0)));
        assert_same_picture(&draw(vec![polygons(&all, &[])], &view), &expected, name);
    }
}

#[test]
fn crossing_boxes_look_like_their_union() {
    let bar = polygons(&cuboid(dvec3(-3., -1., -1.), dvec3(3., 1., 1.)), &[]);
    let slab = polygons(&cuboid(dvec3(-1., -3., -2.), dvec3(1., 3., 2.)), &[]);
    // The slab's two pierced faces are replaced by faces with a hole, the
    // bar by its two stubs without their inner ends.
    let mut union = Soup::default();
    let mut ring = |points: &[[f64; 3]]| -> Vec<u32> {
        let first = union.vertices.len() as u32;
        union.vertices.extend(points.iter().map(|&p| DVec3::from(p)));
        (first..first + points.len() as u32).collect()
    };
    let mut faces: Vec<(Vec<u32>, Vec<u32>)> = Vec::new();
    for x in [-1.0, 1.0] {
        let outer = ring(&[[x, -3., -2.], [x, 3., -2.], [x, 3., 2.], [x, -3., 2.]]);
        let hole = ring(&[[x, -1., -1.], [x, 1., -1.], [x, 1., 1.], [x, -1., 1.]]);
        faces.push((outer, hole));
    }
    let boxes = [
        (cuboid(dvec3(-1., -3., -2.), dvec3(1., 3., 2.)), [-1.0, 1.0]),
        (cuboid(dvec3(1., -1., -1.), dvec3(3., 1., 1.)), [1.0, 1.0]),
        (cuboid(dvec3(-3., -1., -1.), dvec3(-1., 1., 1.)), [-1.0, -1.0]),
    ];
    for (shape, ends) in boxes {
        for face in shape {
            let is_end = ends.iter().any(|&x| face.iter().all(|corner| corner.x == x));
            if !is_end {
                let corners: Vec<[f64; 3]> = face.iter().map(|corner| corner.to_array()).collect();
                faces.push((ring(&corners), Vec::new()));
            }
        }
    }
    for (outer, hole) in &faces {
        let holes = (!hole.is_empty()).then_some(&hole[..]);
        union.faces.push(outer, holes);
    }
    for (name, view) in views() {
        let found = draw(vec![bar.clone(), slab.clone()], &view);
        assert_same_picture(&found, &draw(vec![union.clone()], &view), name);
    }
}

#[test]
fn crossing_squares_share_one_line_and_their_borders_are_cut() {
    let corners =
        |f: fn(f64, f64) -> DVec3| vec![f(-1.0, -1.0), f(1.0, -1.0), f(1.0, 1.0), f(-1.0, 1.0)];
    let floor = polygons(&[corners(|s, t| dvec3(2.0 * s, 2.0 * t, 0.0))], &[]);
    let wall = polygons(&[corners(|s, t| dvec3(0.25 * s, s, t))], &[]);
    let drawn = draw(vec![floor, wall], &orthographic(dvec3(-3.0, -1.0, -2.0)));
    let crossing: Vec<_> =
        drawn.pieces.iter().filter(|piece| piece.class == LineClass::Intersection).collect();
    assert!(crossing.iter().all(|piece| piece.is_visible()));
    assert!(crossing.iter().all(|piece| piece.run == crossing[0].run), "one straight line");
    let length: f64 = crossing.iter().map(|piece| piece.points[0].distance(piece.points[1])).sum();
    let image = |p: DVec3| drawn.frame.image(p);
    let ends = [image(dvec3(-0.25, -1.0, 0.0)), image(dvec3(0.25, 1.0, 0.0))];
    assert!((length - ends[0].distance(ends[1])).abs() < 1e-12);
    // The wall's upright borders are seen down to the floor.
    for end in ends {
        let cuts = drawn.pieces.iter().filter(|piece| {
            let touches = piece.points.iter().any(|point| point.distance(end) < 1e-15);
            touches && piece.class == LineClass::Boundary
        });
        let mut levels: Vec<u32> = cuts.map(|piece| piece.invisibility).collect();
        levels.sort_unstable();
        assert_eq!(levels, [0, 1]);
    }
}

#[test]
fn touching_boxes_make_no_intersection_line() {
    let unit = || polygons(&cuboid(DVec3::ZERO, DVec3::ONE), &[]);
    let neighbours = [
        (DVec3::X, dvec3(2.0, 1.0, 1.0)),
        (dvec3(1.0, 0.25, 0.25), dvec3(2.0, 0.75, 0.75)),
        (dvec3(0.5, 1.0, -0.5), dvec3(2.0, 2.0, 0.5)),
        (dvec3(1.0, 1.0, 0.0), dvec3(2.0, 2.0, 1.0)),
        (dvec3(1.0, 1.0, 0.5), dvec3(2.0, 2.0, 3.0)),
        (DVec3::ONE, DVec3::splat(2.0)),
        // One inside the other, sharing a corner, an edge, a face.
        (DVec3::ZERO, DVec3::splat(0.5)),
        (dvec3(0.0, 0.25, 0.0), dvec3(0.5, 0.75, 1.0)),
    ];
    for (low, high) in neighbours {
        let lines = intersection_lines(vec![unit(), polygons(&cuboid(low, high), &[])]);
        assert!(lines.is_empty(), "{low} {high}: {lines:?}");
    }
}

#[test]
fn a_surface_may_pass_through_a_triangle_along_its_own_edge() {
    let floor = polygons(&[[[-4., -4., 0.], [4., -4., 0.], [0., 4., 0.]].map(DVec3::from)], &[]);
    let fold = |from: DVec3, to: DVec3, heights: [f64; 2]| {
        let faces = heights.map(|z| vec![from, to, dvec3(1.0, 9.0, z)]);
        polygons(&faces, &[])
    };
    let inside = [dvec3(-1.0, -1.0, 0.0), dvec3(1.0, -1.0, 0.0)];
    let across = [dvec3(-9.0, 0.0, 0.0), dvec3(9.0, 0.0, 0.0)];
    let ends = |a: DVec3, b: DVec3| vec![[a.to_array(), b.to_array()]];
    let lines = intersection_lines(vec![floor.clone(), fold(inside[0], inside[1], [1.0, -2.0])]);
    assert_eq!(lines, ends(inside[0], inside[1]));
    // Longer than the triangle: clipped.
    let lines = intersection_lines(vec![floor.clone(), fold(across[0], across[1], [1.0, -2.0])]);
    assert_eq!(lines, ends(dvec3(-2.0, 0.0, 0.0), dvec3(2.0, 0.0, 0.0)));
    // Folded to one side it only touches.
    let lines = intersection_lines(vec![floor, fold(inside[0], inside[1], [1.0, 2.0])]);
    assert!(lines.is_empty(), "{lines:?}");
}

/// A small input, and the lines where its faces cross.
fn crossings_of(name: &str) -> (Vec<Soup>, Vec<[[f64; 3]; 2]>) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/field").join(name);
    let soups = import::read_file(&file, None).expect("a model").objects;
    let lines = intersection_lines(soups.clone());
    (soups, lines)
}

#[test]
fn surfaces_may_pass_through_one_another_along_edges_of_both() {
    let (edges, lines) = crossings_of("cross_edges.obj");
    assert_eq!(lines, [[[0.0, -2.0, 0.0], [0.0, 2.0, 0.0]]]);
    let (half, _) = crossings_of("cross_half.obj");
    for (name, view) in views() {
        assert_same_picture(&draw(edges.clone(), &view), &draw(half.clone(), &view), name);
    }
    // The second edge is the diagonal of a quadrilateral.
    let (_, lines) = crossings_of("cross_diag1.obj");
    assert_eq!(lines, [[[0.0, -2.0, -2.0], [0.0, 2.0, 2.0]]]);
}

/// How two faces end in common along a part of the x axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Joint {
    /// At one edge.
    Edge,
    /// At borders that lie on one another in part.
    Borders,
    /// At borders of two objects.
    Seam,
}

/// Two faces with this in common, towards two sides, as soups of one object or
/// two, and the ends of what they have in common.
fn joined(
    random: &mut Random,
    joint: Joint,
    sides: [[f64; 2]; 2],
) -> (Vec<Vec<Vec<DVec3>>>, [f64; 2]) {
    let mut ends = || {
        let low = random.below(4) as f64;
        [low, low + 2.0 + random.below(3) as f64]
    };
    let first = ends();
    let second = if joint == Joint::Edge { first } else { ends() };
    let face = |[low, high]: [f64; 2], [y, z]: [f64; 2]| {
        vec![dvec3(low, 0.0, 0.0), dvec3(high, 0.0, 0.0), dvec3(0.5 * (low + high), y, z)]
    };
    let faces = [face(first, sides[0]), face(second, sides[1])];
    let objects = match joint {
        Joint::Seam => faces.map(|face| vec![face]).to_vec(),
        _ => vec![faces.to_vec()],
    };
    (objects, [first[0].max(second[0]), first[1].min(second[1])])
}

#[test]
fn surfaces_cross_where_their_faces_take_turns_around_a_line() {
    let mut directions: Vec<[f64; 2]> = Vec::new();
    for (y, z) in (-2..=2).flat_map(|y| (-2..=2).map(move |z| (y, z))) {
        // Each direction once.
        let (y, z): (i32, i32) = (y, z);
        if y.abs().max(z.abs()) == 2 && (y % 2 != 0 || z % 2 != 0) || y.abs().max(z.abs()) == 1 {
            directions.push([y.into(), z.into()]);
        }
    }
    directions.sort_by(|a, b| a[1].atan2(a[0]).total_cmp(&b[1].atan2(b[0])));
    assert_eq!(directions.len(), 16);
    let joints = [
        [Joint::Edge, Joint::Edge],
        [Joint::Edge, Joint::Borders],
        [Joint::Borders, Joint::Borders],
        [Joint::Seam, Joint::Edge],
        [Joint::Edge, Joint::Seam],
    ];
    let mut found = [0; 2];
    for seed in 0..rounds(600) {
        let mut random = Random(seed);
        let [first, second] = joints[seed as usize % joints.len()];
        let mut sides = || [0, 1].map(|_| random.below(16) as usize);
        let (s, t) = (sides(), sides());
        // Strictly between two directions, one way around.
        let between = |[a, b]: [usize; 2], x: usize| {
            let [x, b] = [x, b].map(|place| (place + 16 - a) % 16);
            0 < x && x < b
        };
        let within = |pair| s.iter().any(|&x| between(pair, x));
        let take_turns = within(t) && within([t[1], t[0]]);
        let (one, [a, b]) = joined(&mut random, first, s.map(|i| directions[i]));
        let (other, [c, d]) = joined(&mut random, second, t.map(|i| directions[i]));
        let [from, to] = [a.max(c), b.min(d)];
        let crosses = take_turns && from < to;
        let soups: Vec<Soup> = one.iter().chain(&other).map(|faces| polygons(faces, &[])).collect();
        let expected: Vec<_> =
            crosses.then_some([[from, 0.0, 0.0], [to, 0.0, 0.0]]).into_iter().collect();
        let what = format!("seed {seed}: {first:?} {s:?} and {second:?} {t:?}");
        assert_eq!(intersection_lines(soups), expected, "{what}");
        found[usize::from(crosses)] += 1;
    }
    assert!(found.iter().all(|&count| count > 60), "{found:?}");
}

#[test]
fn faces_may_cross_at_a_common_vertex() {
    let apex = DVec3::ZERO;
    let faces = [
        vec![apex, dvec3(4.0, -2.0, 0.0), dvec3(4.0, 2.0, 0.0)],
        vec![apex, dvec3(3.0, 0.0, -1.0), dvec3(3.0, 0.0, 1.0)],
    ];
    let expected = vec![[[0.0; 3], [3.0, 0.0, 0.0]]];
    assert_eq!(intersection_lines(vec![polygons(&faces, &[])]), expected);
    // The same as two objects, which share no vertex number.
    let apart = faces.map(|face| polygons(&[face], &[]));
    assert_eq!(intersection_lines(apart.to_vec()), expected);
}

#[test]
fn duplicates_of_a_crossing_face_draw_the_line_once() {
    let floor = || polygons(&[[[-4., -4., 0.], [4., -4., 0.], [0., 4., 0.]].map(DVec3::from)], &[]);
    let blade =
        || polygons(&[[[-1., -2., -1.], [1., -2., -1.], [0., 0., 1.]].map(DVec3::from)], &[]);
    let view = orthographic(dvec3(0.5, 1.0, -2.0));
    let once = draw(vec![floor(), blade()], &view);
    let twice = draw(vec![floor(), blade(), blade(), floor()], &view);
    assert_same_picture(&once, &twice, "duplicates");
}

/// What an intersection of two triangles is in whole numbers: the range of
/// each triangle along the common line, as fractions with positive
/// denominators.
mod in_integers {
    type Row = [i128; 3];

    fn minus(a: Row, b: Row) -> Row {
        [0, 1, 2].map(|i| a[i] - b[i])
    }

    fn cross(a: Row, b: Row) -> Row {
        [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
    }

    fn dot(a: Row, b: Row) -> i128 {
        (0..3).map(|i| a[i] * b[i]).sum()
    }

    /// Where the triangle's edges meet the other's plane: (numerator,
    /// denominator) of the coordinate along `line`; none unless it has
    /// corners strictly on both sides.
    fn range(own: [Row; 3], signs: [i128; 3], line: Row) -> Option<[(i128, i128); 2]> {
        if !(signs.iter().any(|&s| s > 0) && signs.iter().any(|&s| s < 0)) {
            return None;
        }
        let mut found: Vec<(i128, i128)> = Vec::new();
        for i in 0..3 {
            let j = (i + 1) % 3;
            let [a, b] = [own[i], own[j]].map(|p| dot(p, line));
            let (x, y) = (signs[i], signs[j]);
            if x == 0 {
                found.push((a, 1));
            } else if x.signum() * y.signum() < 0 {
                let (numerator, denominator) = (a * y - b * x, y - x);
                found.push((numerator * denominator.signum(), denominator.abs()));
            }
        }
        assert_eq!(found.len(), 2);
        found.sort_by(|p, q| (p.0 * q.1).cmp(&(q.0 * p.1)));
        Some([found[0], found[1]])
    }

    /// The length of the common segment along the common line's direction,
    /// if both triangles straddle one another's plane and it is positive.
    pub(super) fn crossing(s: [Row; 3], t: [Row; 3]) -> Option<f64> {
        let [m, n] = [s, t].map(|[a, b, c]| cross(minus(b, a), minus(c, a)));
        let line = cross(m, n);
        let [of_s, of_t] = [(s, t[0], n), (t, s[0], m)]
            .map(|(own, origin, normal)| own.map(|p| dot(minus(p, origin), normal)));
        let (a, b) = (range(s, of_s, line)?, range(t, of_t, line)?);
        let less = |p: (i128, i128), q: (i128, i128)| p.0 * q.1 < q.0 * p.1;
        let low = if less(a[0], b[0]) { b[0] } else { a[0] };
        let high = if less(a[1], b[1]) { a[1] } else { b[1] };
        let value = |p: (i128, i128)| p.0 as f64 / p.1 as f64;
        let unit = (dot(line, line) as f64).sqrt();
        less(low, high).then(|| (value(high) - value(low)) / unit)
    }
}

#[test]
fn pairs_of_grid_triangles_cross_where_integers_say() {
    let (mut crossed, mut seed) = (0, 0);
    while seed < rounds(2000) {
        let mut random = Random(seed);
        seed += 1;
        let triangles = [0; 2].map(|_| [0; 3].map(|_| random.grid_point(5)));
        let [s, t] = triangles;
        let flat = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a) == DVec3::ZERO;
        if flat(s) || flat(t) {
            continue;
        }
        let rows = triangles.map(|triangle| triangle.map(|p| p.to_array().map(|x| x as i128)));
        let expected = in_integers::crossing(rows[0], rows[1]);
        let found = intersection_lines(triangles.map(|face| polygons(&[face], &[])).to_vec());
        match (expected, &found[..]) {
            (None, []) => {}
            (Some(length), [[a, b]]) => {
                let gap = DVec3::from(*a).distance(DVec3::from(*b)) - length;
                assert!(gap.abs() < 1e-12, "seed {seed}: {found:?} {length}");
                crossed += 1;
            }
            _ => panic!("seed {seed}: {triangles:?} found {found:?} expected {expected:?}"),
        }
    }
    assert!(crossed > 100, "{crossed}");
}
