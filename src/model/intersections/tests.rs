//! What plates spare changes nothing: against all pairs, each looked at.

use super::*;
use crate::kernel::predicates::Exact;
use crate::model::{EffectiveEdge, Faces, Soup, StandardView, facing};
use glam::{DVec3, IVec3};
use proptest::prelude::*;

/// A plane: an origin and two directions, in thousands.
type Plane = [[i32; 3]; 3];

/// A fan or a strip of this many corners, with walls on its rim if wished.
#[derive(Debug, Clone, Copy)]
struct Disc {
    plane: Plane,
    corners: usize,
    strip: bool,
    walls: bool,
    first: usize,
}

impl Disc {
    fn soup(&self) -> Soup {
        let [origin, u, v] = self.plane.map(|p| IVec3::from(p).as_dvec3());
        let corner = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / self.corners as f64;
            let [x, y] = [angle.cos(), angle.sin()].map(|x| (1000.0 * x).round());
            origin * 1000.0 + u * x + v * y
        };
        let mut points: Vec<DVec3> =
            (0..self.corners).map(|i| corner((i + self.first) % self.corners)).collect();
        points.dedup();
        let count = points.len() as u32;
        let mut faces = Faces::default();
        let (mut low, mut high) = (0, count - 1);
        while low + 1 < high {
            if self.strip {
                faces.push(&[low, low + 1, high], []);
                high -= 1;
                faces.push(&[low + 1, high, high + 1], []);
                low += 1;
            } else {
                faces.push(&[0, low + 1, low + 2], []);
                low += 1;
                high = count - 1;
            }
        }
        if self.walls {
            let up = u.cross(v) * 400.0;
            points.extend(points.clone().into_iter().map(|point| point + up));
            for i in 0..count {
                let j = (i + 1) % count;
                faces.push(&[i, j, count + j], []);
                faces.push(&[i, count + j, count + i], []);
            }
        }
        Soup { vertices: points, faces, ..Soup::default() }
    }
}

/// What is found of a scene, and what all pairs have.
fn both(soups: Vec<Soup>) -> [Intersections; 2] {
    let mesh = Mesh::new(soups, None).unwrap();
    let view = StandardView::ALL[0].view(DVec3::ZERO).unwrap();
    let points = Points::new(mesh.vertices(), view.eye, view.near);
    let coordinates = ViewCoordinates::new(&view.frame, mesh.vertices());
    let run = Run::default();
    let facing = facing::<Exact>(&mesh, &points, &run);
    let effective = EffectiveEdge::find(&mesh, &facing);
    let fans = Fans::find(&mesh, &coordinates, &facing, &effective);
    let hierarchy = triangle_hierarchy(&mesh, &coordinates, None);
    let known = Known { fans: Some(&fans), convex: None };
    let found = Intersections::find::<Exact>(&mesh, &points, &hierarchy, known, &run).unwrap();
    let mut all = Search::<Exact>::new(&mesh, &points, known, &run);
    let count = mesh.triangles().len() as u32;
    for t in 0..count {
        (0..t).for_each(|s| all.add_pair([s, t]));
    }
    let all = Intersections::gather(&mesh, vec![all], &run).unwrap();
    let plates = Plates::find(&mesh, &Predicates::<Exact>::new(&points), hierarchy.items(), &run);
    assert!(plates.is_some_and(|plates| !plates.all().is_empty()), "no plate");
    [found, all]
}

fn assert_same(discs: &[Disc]) {
    let [found, all] = both(discs.iter().map(Disc::soup).collect());
    assert_eq!(found.lines, all.lines);
    let of = |list: &EdgePiercings, other: &EdgePiercings| {
        let pairs = list.pairs.iter().filter(|pair| !other.pairs.contains(pair));
        pairs.copied().collect::<Vec<_>>()
    };
    let [missing, new] =
        [of(&all.piercings, &found.piercings), of(&found.piercings, &all.piercings)];
    assert!(missing.is_empty() && new.is_empty(), "no {missing:?}, but {new:?}");
    let missing: Vec<_> = all.touching.iter().filter(|it| !found.touching.contains(it)).collect();
    assert!(missing.is_empty(), "touching, but not told: {missing:?}");
}

const FLOOR: Plane = [[0, 0, 0], [1, 0, 0], [0, 1, 0]];

fn fan(plane: Plane) -> Disc {
    Disc { plane, corners: 400, strip: false, walls: false, first: 0 }
}

#[test]
fn plates_through_one_another_cross_where_pairs_do() {
    let askew = [[0, 0, 0], [1, 2, 0], [1, 0, 1]];
    assert_same(&[fan(FLOOR), fan(askew)]);
    assert_same(&[fan(FLOOR), Disc { strip: true, walls: true, ..fan(askew) }]);
    // The common line through hubs, and along rims of the one.
    assert_same(&[fan(FLOOR), fan([[1, 0, 0], [0, 0, 1], [0, 1, 0]])]);
    assert_same(&[Disc { walls: true, ..fan(FLOOR) }, fan([[0, 1, 0], [1, 0, 0], [0, 0, 1]])]);
}

#[test]
fn plates_on_one_another_touch() {
    let turned = Disc { first: 100, ..fan(FLOOR) };
    assert_same(&[fan(FLOOR), turned]);
    assert_same(&[Disc { walls: true, ..fan(FLOOR) }, Disc { strip: true, ..turned }]);
    assert_same(&[fan(FLOOR), fan([[1, 0, 0], [1, 0, 0], [0, 1, 0]])]);
    // One stands on the other.
    assert_same(&[fan(FLOOR), fan([[0, 0, 1], [1, 0, 0], [0, 0, 1]])]);
}

fn any_disc() -> impl Strategy<Value = Disc> {
    let number = -1..2_i32;
    let vector = prop::array::uniform3(number);
    let plane = prop::array::uniform3(vector)
        .prop_filter("a plane", |[_, u, v]| IVec3::from(*u).cross(IVec3::from(*v)) != IVec3::ZERO);
    (plane, any::<bool>(), any::<bool>(), 0..4_usize).prop_map(|(plane, strip, walls, quarter)| {
        Disc { plane, corners: 320, strip, walls, first: 80 * quarter }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn plates_in_any_degenerate_position(discs in prop::collection::vec(any_disc(), 2..4)) {
        // At least one with plates.
        let mut discs = discs;
        discs.push(fan(FLOOR));
        assert_same(&discs);
    }
}
