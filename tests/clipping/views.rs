//! One code path for every eye: polygons of the plane are moved along their
//! rays, which changes nothing in the image, and clipped there.

use super::draw::{Draw, Rings};
use glam::{DVec3, dvec2, dvec3};
use std::collections::BTreeSet;
use umriss::kernel::numbers::Fraction;
use umriss::kernel::predicates::{
    Exact, Eye, ImageLine, NearPlane, Points, Policy, Predicates, Thorough,
};
use umriss::polygon::clipping::{Clipper, Corner, FillRule, Operand, Operation, Polygon};

const HEIGHT: f64 = 64.0;

/// A view in which a point of the plane can be moved along its ray.
#[derive(Debug, Clone, Copy)]
enum View {
    Above,
    Oblique,
    Steep,
    Central,
    CentralAskew,
}

const VIEWS: [View; 5] =
    [View::Above, View::Oblique, View::Steep, View::Central, View::CentralAskew];

impl View {
    fn eye(self) -> Eye {
        match self {
            View::Above => Eye::Towards(DVec3::Z),
            View::Oblique => Eye::Towards(dvec3(0.25, -0.5, 1.0)),
            View::Steep => Eye::Towards(dvec3(-3.0, 2.0, 1.0)),
            View::Central | View::CentralAskew => Eye::At(dvec3(0.0, 0.0, HEIGHT)),
        }
    }

    fn near(self) -> Option<NearPlane> {
        match self {
            View::Central => Some(NearPlane { forward: -DVec3::Z, distance: 1.0 }),
            View::CentralAskew => {
                Some(NearPlane { forward: dvec3(0.25, 0.125, -1.0), distance: 0.25 })
            }
            _ => None,
        }
    }

    /// The point moved along its ray, exactly.
    fn lift(self, point: DVec3, steps: i32) -> DVec3 {
        match self.eye() {
            Eye::Towards(towards) => point + towards * f64::from(steps),
            Eye::At(eye) => eye + (point - eye) * f64::powi(2.0, -steps),
        }
    }
}

/// Rings on a grid, as numbers of vertices.
fn operands(seed: u64) -> ([Vec<Polygon>; 2], Vec<DVec3>) {
    let mut draw = Draw::new(seed);
    let mut vertices = Vec::new();
    let operand = |draw: &mut Draw, vertices: &mut Vec<DVec3>| {
        let rings: Rings = (0..2)
            .map(|_| {
                let corners = 3 + draw.below(5);
                let mut coordinate = || draw.below(9) as f64 - 4.0;
                (0..corners).map(|_| dvec2(coordinate(), coordinate())).collect()
            })
            .collect();
        let polygon = |ring: Vec<glam::DVec2>| {
            let first = vertices.len() as u32;
            vertices.extend(ring.iter().map(|corner| corner.extend(0.0)));
            Polygon::of_vertices([(first..vertices.len() as u32).collect::<Vec<_>>()])
        };
        rings.into_iter().map(polygon).collect::<Vec<_>>()
    };
    let first = operand(&mut draw, &mut vertices);
    let second = operand(&mut draw, &mut vertices);
    ([first, second], vertices)
}

/// Rings as sets of corners' places in the plane, with their order; which
/// corner is the first depends on the view.
type Places = BTreeSet<Vec<[Fraction; 2]>>;

fn places(polygons: &[Polygon], plane: &Points) -> Places {
    let predicates = Predicates::<Exact>::new(plane);
    let clipper = Clipper::new(&predicates).unwrap();
    let place = |corner: &Corner| {
        let (parts, weight) = predicates.ratio(clipper.chart(), corner.point);
        parts.map(|part| Fraction::new(part, weight.clone()).unwrap())
    };
    let ring = |ring: &Vec<Corner>| {
        let mut places: Vec<_> = ring.iter().map(place).collect();
        let least = (0..places.len()).min_by_key(|&i| places[i].clone()).unwrap();
        places.rotate_left(least);
        places
    };
    polygons.iter().flat_map(|polygon| &polygon.rings).map(ring).collect()
}

fn split<P: Policy>(
    points: &Points,
    operands: &[Vec<Polygon>; 2],
    rule: FillRule,
) -> [Vec<Polygon>; 3] {
    let predicates = Predicates::<P>::new(points);
    let clipper = Clipper::new(&predicates).unwrap();
    let [a, b] = [&operands[0], &operands[1]].map(|polygons| Operand::new(polygons, rule));
    let split = clipper.split(a, b);
    let union = clipper.operation(Operation::Union, &[a, b]);
    assert_eq!(predicates.counters().get("ladder-disagreements"), 0);
    [split.inside, split.outside, union]
}

#[test]
fn every_eye_sees_the_same_regions() {
    for seed in 0..400 {
        let (operands, vertices) = operands(seed);
        let plane = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
        let rule = FillRule::ALL[seed as usize % 5];
        let expected = split::<Exact>(&plane, &operands, rule).map(|part| places(&part, &plane));
        for view in VIEWS {
            let mut draw = Draw::new(seed + 1);
            let lifted: Vec<DVec3> =
                vertices.iter().map(|&p| view.lift(p, draw.below(4) as i32)).collect();
            let points = Points::new(&lifted, view.eye(), view.near());
            let found = split::<Exact>(&points, &operands, rule);
            assert_eq!(found.map(|part| places(&part, &plane)), expected, "{seed}, {view:?}");
            if seed % 20 == 0 {
                let found = split::<Thorough>(&points, &operands, rule);
                assert_eq!(found.map(|part| places(&part, &plane)), expected, "{seed}, {view:?}");
            }
        }
    }
}

/// Every edge is named as the common line of two faces that share it, or as
/// where the near plane cuts a face.
#[test]
fn lines_of_planes_are_as_good_as_edges() {
    for seed in 0..200 {
        let (operands, vertices) = operands(seed);
        let plane = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
        let expected =
            split::<Exact>(&plane, &operands, FillRule::EvenOdd).map(|part| places(&part, &plane));
        for view in VIEWS {
            for on_near in [false, true] {
                let mut draw = Draw::new(seed + 7);
                // Where the near plane is to name edges they lie on it.
                let near = NearPlane { forward: -DVec3::Z, distance: HEIGHT / 2.0 };
                if on_near && !matches!(view, View::Central) {
                    continue;
                }
                let steps = |draw: &mut Draw| if on_near { 1 } else { draw.below(4) as i32 };
                let mut lifted: Vec<DVec3> =
                    vertices.iter().map(|&p| view.lift(p, steps(&mut draw))).collect();
                let beside = lifted.len() as u32;
                lifted.extend([dvec3(17.0, 3.0, -5.0), dvec3(-2.0, 31.0, -9.0)]);
                lifted.extend([dvec3(-23.0, 29.0, -11.0), dvec3(5.0, -37.0, -3.0)]);
                let near = if on_near { Some(near) } else { view.near() };
                let points = Points::new(&lifted, view.eye(), near);
                let predicates = Predicates::<Exact>::new(&points);
                let clipper = Clipper::new(&predicates).unwrap();
                let rename = |line: ImageLine| {
                    let ImageLine::Edge([a, b]) = line else { return line };
                    // Two faces at the edge, neither edge-on nor in one plane.
                    let faces: Vec<[u32; 3]> = (beside..beside + 4)
                        .map(|c| [a, b, c])
                        .filter(|&face| !predicates.facing(face).is_zero())
                        .collect();
                    let mut pairs = faces.iter().flat_map(|&f| faces.iter().map(move |&g| (f, g)));
                    let pair = pairs.find(|(f, g)| !predicates.plane(*f, g[2]).is_zero());
                    let (Some((f, g)), false) = (pair, points.coincide(a, b)) else { return line };
                    let named =
                        if on_near { ImageLine::Near(f) } else { ImageLine::Planes([f, g]) };
                    let chart = clipper.chart();
                    let way = |line| predicates.runs_forward(chart, line);
                    if way(named) == way(line) { named } else { named.reversed() }
                };
                let renamed = operands.clone().map(|mut polygons| {
                    let corners = polygons.iter_mut().flat_map(|p| &mut p.rings).flatten();
                    corners.for_each(|corner| corner.line = rename(corner.line));
                    polygons
                });
                let found = split::<Exact>(&points, &renamed, FillRule::EvenOdd);
                // Read in a plane that has the places of all vertices, by the
                // names they had.
                let back = found.map(|polygons| names_of_edges(polygons, &operands, &renamed));
                let back = back.map(|part| places(&part, &plane));
                assert_eq!(back, expected, "{seed}, {view:?}, near plane {on_near}");
            }
        }
    }
}

/// Lines of planes under the names of the edges they stand for.
fn names_of_edges(
    mut polygons: Vec<Polygon>,
    operands: &[Vec<Polygon>; 2],
    renamed: &[Vec<Polygon>; 2],
) -> Vec<Polygon> {
    use umriss::kernel::predicates::ImagePoint;
    let lines = |polygons: &[Vec<Polygon>; 2]| -> Vec<ImageLine> {
        let corners = polygons.iter().flatten().flat_map(|p| &p.rings).flatten();
        corners.map(|corner| corner.line).collect()
    };
    let (old, new) = (lines(operands), lines(renamed));
    let name = |line: ImageLine| -> ImageLine {
        let at = new.iter().position(|&other| other == line || other == line.reversed()).unwrap();
        if new[at] == line { old[at] } else { old[at].reversed() }
    };
    for corner in polygons.iter_mut().flat_map(|p| &mut p.rings).flatten() {
        corner.line = name(corner.line);
        if let ImagePoint::Crossing(lines) = &mut corner.point {
            *lines = lines.map(name);
        }
    }
    polygons
}

#[test]
fn results_are_operands_again_in_every_view() {
    for seed in 0..200 {
        let (operands, vertices) = operands(seed);
        for view in VIEWS {
            let mut draw = Draw::new(seed + 3);
            let lifted: Vec<DVec3> =
                vertices.iter().map(|&p| view.lift(p, draw.below(4) as i32)).collect();
            let points = Points::new(&lifted, view.eye(), view.near());
            let predicates = Predicates::<Exact>::new(&points);
            let clipper = Clipper::new(&predicates).unwrap();
            let [a, b] = [&operands[0], &operands[1]]
                .map(|polygons| Operand::new(polygons, FillRule::EvenOdd));
            let parts = clipper.split(a, b);
            let [inside, outside] = [&parts.inside, &parts.outside].map(|p| Operand::result(p));
            assert!(clipper.operation(Operation::Intersection, &[inside, outside]).is_empty());
            let again = clipper.operation(Operation::Union, &[inside, outside]);
            let whole = clipper.operation(Operation::Union, &[a]);
            let plane = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
            assert_eq!(places(&again, &plane), places(&whole, &plane), "{seed}, {view:?}");
        }
    }
}
