//! Trees of scenes whose order is known, and of random ones.

use super::*;
use crate::kernel::numbers::{Fraction, Sign};
use crate::kernel::predicates::{Exact, Eye, NearPlane, Points};
use glam::{DVec3, dvec3};
use proptest::prelude::*;

fn quad(x: [f64; 2], y: [f64; 2], z: [f64; 2]) -> [DVec3; 4] {
    // Slopes along x.
    [
        dvec3(x[0], y[0], z[0]),
        dvec3(x[1], y[0], z[1]),
        dvec3(x[1], y[1], z[1]),
        dvec3(x[0], y[1], z[0]),
    ]
}

/// A scene of quadrilaterals.
fn scene(quads: &[[DVec3; 4]]) -> (Vec<DVec3>, Vec<PlanePolygon>) {
    let vertices = quads.concat();
    let points = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
    let predicates = Predicates::<Exact>::new(&points);
    let part = |i: usize| {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| 4 * i as u32 + k);
        let triangles = [[a, b, c], [a, c, d]];
        let convex = crate::polygon::FaceParts::Convex;
        let parts = crate::polygon::face_parts(&predicates, &triangles, convex);
        assert_eq!(parts.len(), 1);
        parts[0].polygon.clone()
    };
    let polygons = (0..quads.len()).map(part).collect();
    (vertices, polygons)
}

fn order<'t>(tree: &'t Bsp, predicates: &Predicates<'_, Exact>) -> Vec<&'t Fragment> {
    // `back_to_front` lends fragments for the call only.
    let mut found = Vec::new();
    tree.back_to_front(predicates, |fragment| {
        found.extend(tree.fragments().iter().position(|other| other == fragment));
    });
    found.into_iter().map(|place| &tree.fragments()[place]).collect()
}

/// Whether no fragment hides a later one, decided pair by pair where the
/// images overlap.
fn is_sound(order: &[&Fragment], predicates: &Predicates<'_, Exact>) -> bool {
    let facing = |fragment: &Fragment| predicates.facing(fragment.polygon.face);
    order.iter().enumerate().all(|(i, later)| {
        order[..i].iter().all(|earlier| {
            let shadow = earlier.polygon.shadow(facing(earlier));
            let Some(over) = later.polygon.within(predicates, shadow) else {
                return true;
            };
            let plane = earlier.polygon.plane().into();
            let signs: Vec<Sign> =
                over.corners.iter().map(|c| predicates.above(plane, c.point)).collect();
            match signs.iter().all(|sign| sign.is_zero()) {
                true => later.source < earlier.source,
                false => !signs.contains(&facing(earlier)),
            }
        })
    })
}

fn area(predicates: &Predicates<'_, Exact>, polygons: &[&PlanePolygon]) -> Vec<Fraction> {
    let mut sum = vec![Fraction::zero(), Fraction::zero(), Fraction::zero()];
    for polygon in polygons {
        for (part, more) in sum.iter_mut().zip(polygon.doubled_area(predicates)) {
            *part = part.clone() + more;
        }
    }
    sum
}

fn keeps_areas(tree: &Bsp, polygons: &[PlanePolygon], predicates: &Predicates<'_, Exact>) -> bool {
    polygons.iter().enumerate().all(|(source, polygon)| {
        let own = tree.fragments().iter().filter(|f| f.source == source as u32);
        let pieces: Vec<&PlanePolygon> = own.map(|fragment| &fragment.polygon).collect();
        area(predicates, &pieces) == area(predicates, &[polygon])
    })
}

#[test]
fn crossing_squares_take_one_cut() {
    let flat = quad([0.0, 4.0], [0.0, 4.0], [2.0, 2.0]);
    let steep = quad([1.0, 3.0], [0.0, 4.0], [0.0, 4.0]);
    let (vertices, polygons) = scene(&[flat, steep]);
    let points = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
    let predicates = Predicates::<Exact>::new(&points);
    let tree = Bsp::new(&predicates, polygons.clone(), &Run::default()).unwrap();
    assert_eq!((tree.cuts(), tree.fragments().len()), (1, 3));
    assert!(keeps_areas(&tree, &polygons, &predicates));
    for direction in [DVec3::Z, -DVec3::Z, dvec3(1.0, 2.0, 3.0), dvec3(-5.0, 1.0, 1.0)] {
        let points = Points::new(&vertices, Eye::Towards(direction), None);
        let predicates = Predicates::<Exact>::new(&points);
        let order = order(&tree, &predicates);
        assert_eq!(order.len(), 3);
        assert!(is_sound(&order, &predicates), "{direction}");
    }
}

#[test]
fn three_bars_in_a_cycle() {
    let bar = |corners: [[f64; 3]; 4]| corners.map(DVec3::from_array);
    let a = bar([[0.0, 0.0, 0.0], [10.0, 0.0, 2.0], [10.0, 1.0, 2.0], [0.0, 1.0, 0.0]]);
    let b = bar([[9.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 10.0, 2.0], [9.0, 10.0, 2.0]]);
    let c = bar([[0.0, 1.0, 2.0], [1.0, 0.0, 2.0], [10.0, 9.0, 0.0], [9.0, 10.0, 0.0]]);
    let (vertices, polygons) = scene(&[a, b, c]);
    let points = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
    let predicates = Predicates::<Exact>::new(&points);
    let tree = Bsp::new(&predicates, polygons.clone(), &Run::default()).unwrap();
    assert!(tree.cuts() >= 1);
    assert!(keeps_areas(&tree, &polygons, &predicates));
    assert!(is_sound(&order(&tree, &predicates), &predicates));
}

#[test]
fn parallel_squares_stay_whole_and_stand_in_order() {
    let level = |i: u32| {
        let (x, z) = (f64::from(i) * 0.25, f64::from(i * 7 % 12));
        quad([x, x + 2.0], [0.0, 2.0], [z, z])
    };
    let (vertices, polygons) = scene(&(0..12).map(level).collect::<Vec<_>>());
    let points = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
    let predicates = Predicates::<Exact>::new(&points);
    let tree = Bsp::new(&predicates, polygons, &Run::default()).unwrap();
    assert_eq!(tree.cuts(), 0);
    let sources: Vec<u32> = order(&tree, &predicates).iter().map(|f| f.source * 7 % 12).collect();
    assert_eq!(sources, (0..12).collect::<Vec<u32>>());
    let mut reversed = Vec::new();
    tree.front_to_back(&predicates, |fragment| reversed.push(fragment.source * 7 % 12));
    assert_eq!(reversed, (0..12).rev().collect::<Vec<u32>>());
}

#[test]
fn coplanar_squares_go_by_number_and_edge_on_ones_are_not_painted() {
    let squares = [0.0, 1.0, 2.0].map(|x| quad([x, x + 2.0], [0.0, 2.0], [0.0, 0.0]));
    let wall = [[0.0, 1.0, -1.0], [4.0, 1.0, -1.0], [4.0, 1.0, 1.0], [0.0, 1.0, 1.0]];
    let all = [squares[0], squares[1], squares[2], wall.map(DVec3::from_array)];
    let (vertices, polygons) = scene(&all);
    for direction in [DVec3::Z, -DVec3::Z] {
        let points = Points::new(&vertices, Eye::Towards(direction), None);
        let predicates = Predicates::<Exact>::new(&points);
        let tree = Bsp::new(&predicates, polygons.clone(), &Run::default()).unwrap();
        let order = order(&tree, &predicates);
        assert!(order.iter().all(|fragment| fragment.source < 3));
        assert!(is_sound(&order, &predicates));
    }
}

/// A grid of triangles on a bowl: all of it lies on one side of each.
fn bowl(size: u32) -> (Vec<DVec3>, Vec<PlanePolygon>) {
    let at = |x: u32, y: u32| {
        let (x, y) = (f64::from(x), f64::from(y));
        dvec3(x, y, x * x + y * y)
    };
    let mut vertices = Vec::new();
    let mut polygons = Vec::new();
    for (x, y) in (0..size).flat_map(|x| (0..size).map(move |y| (x, y))) {
        for corners in [[(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 1), (0, 1)]] {
            let first = vertices.len() as u32;
            vertices.extend(corners.map(|(i, j)| at(x + i, y + j)));
            polygons.push(PlanePolygon::triangle([first, first + 1, first + 2]));
        }
    }
    (vertices, polygons)
}

#[test]
fn a_convex_surface_does_not_become_a_chain() {
    let (vertices, polygons) = bowl(20);
    let points = Points::new(&vertices, Eye::Towards(dvec3(3.0, 1.0, -7.0)), None);
    let predicates = Predicates::<Exact>::new(&points);
    let tree = Bsp::new(&predicates, polygons.clone(), &Run::default()).unwrap();
    let is_across = |node: &Node| matches!(node.plane, InputPlane::Across(..));
    assert!(is_across(&tree.nodes[0]));
    assert!(tree.cuts() < polygons.len() / 8, "{}", tree.cuts());
    let mut painted = 0;
    tree.back_to_front(&predicates, |_| painted += 1);
    assert_eq!(painted, tree.fragments().len());
}

fn coordinates() -> impl Strategy<Value = DVec3> {
    (-2..3_i32, -2..3_i32, -2..3_i32).prop_map(|(x, y, z)| dvec3(x.into(), y.into(), z.into()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn one_tree_is_in_order_for_every_eye(
        vertices in prop::collection::vec(coordinates(), 24),
        eyes in prop::collection::vec(coordinates(), 4),
    ) {
        let points = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
        let predicates = Predicates::<Exact>::new(&points);
        let triangles = (0..8).map(|i| PlanePolygon::triangle([3 * i, 3 * i + 1, 3 * i + 2]));
        let polygons: Vec<PlanePolygon> =
            triangles.filter(|polygon| !polygon.axis(&predicates).1.is_zero()).collect();
        let tree = Bsp::new(&predicates, polygons.clone(), &Run::default()).unwrap();
        prop_assert!(keeps_areas(&tree, &polygons, &predicates));
        for (i, eye) in eyes.into_iter().enumerate() {
            let points = if i % 2 == 0 {
                // In front of everything.
                let near = NearPlane { forward: -DVec3::Z, distance: 0.5 };
                Points::new(&vertices, Eye::At(eye + DVec3::Z * 5.0), Some(near))
            } else {
                let direction = if eye == DVec3::ZERO { DVec3::Y } else { eye };
                Points::new(&vertices, Eye::Towards(direction), None)
            };
            let predicates = Predicates::<Exact>::new(&points);
            prop_assert!(is_sound(&order(&tree, &predicates), &predicates));
        }
    }
}
