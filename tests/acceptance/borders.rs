//! Borders that lie on one another.
//!
//! Small files with known values: faces cut in strips have no line inside,
//! groups of one surface none between them. Then cards on a grid, in one plane
//! or across one another: every unit of every side is counted and measured in
//! whole numbers, by the definition, and the lines must be those and no
//! others.

use super::scenes::{Random, orthographic, polygons, random_card, rounds};
use glam::{DVec3, IVec3};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use umriss::drawing::{Drawing, DrawingOptions, Hidden, Length};
use umriss::kernel::predicates::Exact;
use umriss::model::{
    Camera, FeatureOptions, LineClass, LineOrigin, Mesh, StandardView, Topology, import,
};
use umriss::run::Run;
use umriss::view::{PreparedView, VisibleLines};
use umriss::visibility::visible_lines;

/// A scene of small inputs.
fn scene(name: &str) -> Mesh {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/field").join(name);
    Mesh::new(import::read_file(&file, None).expect("a model").objects, None).expect("a mesh")
}

fn lines(name: &str, view: &str, options: &FeatureOptions, hidden: bool) -> VisibleLines {
    let mesh = scene(name);
    let view = StandardView::from_name(view).expect("a view");
    let view = Camera::Standard(view).view(mesh.bounds()).expect("a view");
    visible_lines(&mesh, &view, options, hidden, &Run::default()).expect("lines")
}

/// Millimetres on a sheet as the program draws it without flags, but for lines
/// beside one another, which are all drawn.
fn millimetres(lines: &VisibleLines, hidden: Hidden) -> f64 {
    let merge = Length::new(0.0).ok();
    let options = DrawingOptions { hidden, merge, ..DrawingOptions::default() };
    let drawing = Drawing::new(lines, &options).expect("a drawing");
    drawing.layers.iter().map(|layer| layer.strokes.length()).sum()
}

fn drawn(name: &str, view: &str) -> f64 {
    millimetres(&lines(name, view, &FeatureOptions::default(), false), Hidden::None)
}

fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 0.05, "{found} mm, not {expected}");
}

#[test]
fn a_flat_face_in_strips_keeps_its_rim_alone() {
    // Two by two on a sheet with 190 mm across.
    assert_near(drawn("tj_flat.obj", "top"), 4.0 * 190.0);
    // Three by two.
    assert_near(drawn("strips.stl", "top"), 2.0 * 190.0 * (1.0 + 2.0 / 3.0));
    let topology = Topology::of(&scene("tj_flat.obj"), &FeatureOptions::default(), &Run::default());
    let topology = topology.expect("not cancelled");
    assert_eq!(topology.t_junctions.len(), 1, "it is told all the same");
    assert_eq!(topology.matched_borders, 2);
}

#[test]
fn a_seam_of_groups_is_a_line_on_request() {
    let expected = drawn("seam_usemtl.obj", "iso");
    assert_near(expected, 1027.1);
    assert_near(drawn("seam_g.obj", "iso"), expected);
    let seams = FeatureOptions::default().with_seams(true);
    let with_seams = lines("seam_g.obj", "iso", &seams, false);
    assert_near(millimetres(&with_seams, Hidden::None), 1405.5);
    assert!(with_seams.pieces.iter().any(|piece| piece.class == LineClass::Boundary));
    // A contour goes on across the seam, under the name of its object.
    let contours = lines("seam_g.obj", "front", &FeatureOptions::default(), false);
    let objects: BTreeSet<u32> = contours.pieces.iter().map(|piece| piece.object).collect();
    assert_eq!(objects.len(), 2);
}

#[test]
fn a_pin_in_a_hole_of_its_own_radius_makes_no_lines() {
    let all = |options: &FeatureOptions| {
        let found = lines("pin_half.obj", "front", options, true);
        let is_crossing = |piece: &&umriss::view::LinePiece| piece.class == LineClass::Intersection;
        let crossings = found.pieces.iter().filter(is_crossing).count();
        (crossings, millimetres(&found, Hidden::Solid))
    };
    let same = lines("pin_same.obj", "front", &FeatureOptions::default(), true);
    assert_near(millimetres(&same, Hidden::Solid), 1013.3);
    // Beside the lines of the other, the pin's own contours within the hole's.
    let (crossings, length) = all(&FeatureOptions::default());
    assert_eq!(crossings, 0);
    assert_near(length, 1088.7);
    // Facets meet at half a step of 32.
    assert_eq!(all(&FeatureOptions::default().with_intersection_degrees(5.7)), (crossings, length));
    let (crossings, length) = all(&FeatureOptions::default().with_intersection_degrees(5.6));
    assert!(crossings >= 62, "{crossings}");
    assert_near(length, 3444.7);
    let (crossings, _) = all(&FeatureOptions::default().with_crease_degrees(5.6));
    assert!(crossings >= 62, "the angle of creases counts without another: {crossings}");
}

/// A face of the oracle, its corners in whole numbers.
struct Card {
    object: usize,
    corners: Vec<IVec3>,
}

/// Where a unit of a side lies, and its axis.
type Unit = ([i32; 3], usize);

impl Card {
    /// Sides along axes, as ends with the lesser first.
    fn sides(&self) -> Vec<[IVec3; 2]> {
        let next = self.corners.iter().cycle().skip(1);
        let pairs = self.corners.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)]);
        pairs
            .filter(|[a, b]| (*b - *a).to_array().iter().filter(|x| **x != 0).count() == 1)
            .collect()
    }

    fn normal(&self) -> IVec3 {
        let [a, b, c] = [self.corners[0], self.corners[1], self.corners[2]];
        (b - a).cross(c - a)
    }

    /// From a side towards the inside, across the side.
    fn inward(&self, [from, to]: [IVec3; 2]) -> IVec3 {
        let along = (to - from).signum();
        let off = self.corners.iter().map(|&corner| corner - from);
        let mut across = off.map(|offset| offset - along * offset.dot(along));
        across.find(|offset| *offset != IVec3::ZERO).expect("a corner off the side").signum()
    }
}

/// What a unit of a side is where these faces end, by the definition.
fn class(cards: &[(&Card, [IVec3; 2])], axis: usize, towards_eye: IVec3) -> Option<LineClass> {
    let along = IVec3::AXES[axis];
    match cards {
        [_] => Some(LineClass::Boundary),
        [(one, side), (other, other_side)] => {
            // Left is positive, in the image.
            let inward = [one.inward(*side), other.inward(*other_side)];
            let [a, b] = inward.map(|offset| along.cross(offset).dot(towards_eye).signum());
            let seen = [one, other].map(|card| card.normal().dot(towards_eye) != 0);
            let is_contour = match seen {
                [true, true] => a == b,
                [false, false] => false,
                _ => true,
            };
            if is_contour {
                Some(LineClass::Contour)
            } else {
                // Right angles, and faces that lie on one another.
                (inward[0] != -inward[1]).then_some(LineClass::Crease)
            }
        }
        _ => Some(LineClass::NonManifold),
    }
}

/// Units of lines, how often they are there.
type Units = BTreeMap<(Unit, usize, LineClass), usize>;

/// The lines that there should be: units with objects and classes.
fn expected(cards: &[Card], towards_eye: IVec3) -> Units {
    // By object and whole side first: these are edges.
    let mut edges: BTreeMap<(usize, [[i32; 3]; 2]), Vec<&Card>> = BTreeMap::new();
    for card in cards {
        for side in card.sides() {
            let ends = side.map(|end| end.to_array());
            edges.entry((card.object, ends)).or_default().push(card);
        }
    }
    let mut borders: BTreeMap<Unit, Vec<(&Card, [IVec3; 2])>> = BTreeMap::new();
    let mut found = Units::new();
    let mut add = |unit, object, class: Option<LineClass>| {
        if let Some(class) = class {
            *found.entry((unit, object, class)).or_default() += 1;
        }
    };
    for ((object, ends), faces) in &edges {
        let side @ [from, to] = ends.map(IVec3::from);
        let axis = (0..3).find(|&axis| from[axis] != to[axis]).expect("a side");
        for unit in from[axis]..to[axis] {
            let mut place = from;
            place[axis] = unit;
            let unit = (place.to_array(), axis);
            let faces: Vec<_> = faces.iter().map(|&card| (card, side)).collect();
            match faces[..] {
                [one] => borders.entry(unit).or_default().push(one),
                _ => add(unit, *object, class(&faces, axis, towards_eye)),
            }
        }
    }
    for (unit, faces) in &borders {
        let seam = matches!(faces[..], [(one, _), (other, _)] if one.object != other.object);
        let objects: BTreeSet<usize> = faces.iter().map(|(card, _)| card.object).collect();
        for object in objects {
            let own = faces.iter().filter(|(card, _)| seam || card.object == object);
            let own: Vec<_> = own.copied().collect();
            add(*unit, object, class(&own, unit.1, towards_eye));
        }
    }
    found
}

/// The lines that there are along axes: their units.
fn found(mesh: &Mesh, forward: DVec3) -> Units {
    let view = orthographic(forward);
    let (options, run) = (FeatureOptions::default(), Run::default());
    let prepared = PreparedView::new::<Exact>(mesh, &view, &options, &run).expect("a view");
    let question = prepared.question(true);
    let mut found = Units::new();
    for line in question.lines {
        if matches!(line.origin, LineOrigin::Intersection(_)) {
            continue;
        }
        let ends = line.origin.vertices(mesh).expect("vertices");
        let [a, b] = ends.map(|vertex| mesh.vertices()[vertex as usize].as_ivec3());
        let apart = (b - a).to_array();
        let (Some(axis), 1) =
            (apart.iter().position(|x| *x != 0), apart.iter().filter(|x| **x != 0).count())
        else {
            continue;
        };
        let object = question.source(line).0 as usize;
        for unit in a[axis].min(b[axis])..a[axis].max(b[axis]) {
            let mut place = a;
            place[axis] = unit;
            let entry = ((place.to_array(), axis), object, line.class);
            *found.entry(entry).or_default() += 1;
        }
    }
    found
}

#[test]
fn cards_on_a_grid_have_the_lines_of_the_definition() {
    let (mut seams, mut divided) = (0, 0);
    for seed in 0..rounds(1500) {
        let mut random = Random(seed);
        let mut cards: Vec<Card> = Vec::new();
        for object in 0..1 + random.below(3) as usize {
            let own = cards.len();
            for _ in 0..1 + random.below(6) {
                let corners: Vec<IVec3> =
                    random_card(&mut random).into_iter().map(|corner| corner.as_ivec3()).collect();
                // Of equal faces of an object there is one.
                let sorted = |corners: &[IVec3]| {
                    let mut corners: Vec<_> = corners.iter().map(|it| it.to_array()).collect();
                    corners.sort_unstable();
                    corners
                };
                let is_new = cards[own..].iter().all(|it| sorted(&it.corners) != sorted(&corners));
                if is_new {
                    cards.push(Card { object, corners });
                }
            }
        }
        let objects = 1 + cards.iter().map(|card| card.object).max().expect("cards");
        let soup = |object| {
            let own = cards.iter().filter(|card| card.object == object);
            let faces: Vec<Vec<DVec3>> =
                own.map(|card| card.corners.iter().map(|it| it.as_dvec3()).collect()).collect();
            polygons(&faces, &[])
        };
        let mesh = Mesh::new((0..objects).map(soup).collect(), None).expect("a mesh");
        divided += mesh.borders().stretches().len();
        seams += (0..mesh.borders().stretches().len() as u32)
            .filter(|&stretch| mesh.borders().is_seam(stretch))
            .count();
        for forward in
            [IVec3::new(-3, -2, -1), IVec3::new(1, -4, 2), -IVec3::X, IVec3::new(0, 1, -1)]
        {
            let what = format!("seed {seed} along {forward}");
            let found = found(&mesh, forward.as_dvec3());
            let expected = expected(&cards, -forward);
            for (unit, count) in expected.iter().chain(&found) {
                let counts = [&found, &expected].map(|units| units.get(unit));
                assert_eq!(counts, [Some(count); 2], "{what}: {unit:?}, found and expected");
            }
        }
    }
    assert!(divided > 1000 && seams > 300, "{divided} stretches, {seams} of seams");
}
