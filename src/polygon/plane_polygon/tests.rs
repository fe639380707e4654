//! Cuts, parts and their areas.

use super::*;
use crate::kernel::numbers::Fraction;
use crate::kernel::predicates::{Exact, Eye, NearPlane, Points};
use glam::{DVec3, dvec3};
use proptest::prelude::*;

fn from_above(vertices: &[DVec3]) -> Points {
    Points::new(vertices, Eye::Towards(DVec3::Z), None)
}

fn is_inside(predicates: &Predicates<'_, Exact>, polygon: &PlanePolygon) -> bool {
    polygon.walls(predicates).all(|(plane, inside)| {
        let signs: Vec<Sign> =
            polygon.corners.iter().map(|c| predicates.above(plane, c.point) * inside).collect();
        !signs.contains(&Sign::Negative) && signs.contains(&Sign::Positive)
    })
}

fn added(a: [Fraction; 3], b: [Fraction; 3]) -> [Fraction; 3] {
    let ([a, b, c], [x, y, z]) = (a, b);
    [a + x, b + y, c + z]
}

fn total(predicates: &Predicates<'_, Exact>, pieces: &[PlanePolygon]) -> [Fraction; 3] {
    let areas = pieces.iter().map(|piece| piece.doubled_area(predicates));
    areas.fold(std::array::from_fn(|_| Fraction::zero()), added)
}

/// The triangle 0 1 2 and many planes through the rest.
fn cut_often(predicates: &Predicates<'_, Exact>, planes: &[Plane]) -> Vec<PlanePolygon> {
    let mut pieces = vec![PlanePolygon::triangle([0, 1, 2])];
    for &plane in planes {
        let mut next = Vec::new();
        for piece in pieces {
            match piece.cut(predicates, plane) {
                Cut::Parted(parts) => next.extend(parts),
                _ => next.push(piece),
            }
        }
        pieces = next;
    }
    pieces
}

fn coordinates() -> impl Strategy<Value = DVec3> {
    (-4..5_i32, -4..5_i32, -4..5_i32).prop_map(|(x, y, z)| dvec3(x.into(), y.into(), z.into()))
}

fn planes(perspective: bool) -> Vec<Plane> {
    let mut planes: Vec<Plane> = vec![
        InputPlane::Face([3, 4, 5]).into(),
        InputPlane::Face([6, 7, 8]).into(),
        InputPlane::Across(3, 0).into(),
        InputPlane::Face([0, 5, 7]).into(),
        InputPlane::Wall([4, 8], 2).into(),
        InputPlane::Face([3, 6, 7]).into(),
        Plane::Silhouette([5, 6]),
        Plane::Shadow([0, 1, 2], InputPlane::Face([4, 5, 8])),
    ];
    if perspective {
        planes.push(InputPlane::Near.into());
    }
    planes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn pieces_of_pieces_have_the_area_of_the_whole(
        vertices in prop::collection::vec(coordinates(), 9),
        perspective in any::<bool>(),
    ) {
        let near = NearPlane { forward: -DVec3::Z, distance: 5.0 };
        let points = if perspective {
            Points::new(&vertices, Eye::At(dvec3(0.0, 1.0, 5.0)), Some(near))
        } else {
            Points::new(&vertices, Eye::Towards(dvec3(1.0, -2.0, 3.0)), None)
        };
        let predicates = Predicates::<Exact>::new(&points);
        let whole = PlanePolygon::triangle([0, 1, 2]);
        prop_assume!(!whole.axis(&predicates).1.is_zero());
        prop_assume!(!predicates.facing([0, 1, 2]).is_zero());
        let pieces = cut_often(&predicates, &planes(perspective));
        prop_assert_eq!(total(&predicates, &pieces), whole.doubled_area(&predicates));
        for (i, piece) in pieces.iter().enumerate() {
            prop_assert!(piece.corners.len() >= 3);
            prop_assert!(is_inside(&predicates, piece), "{:?}", piece);
            let areas = piece.doubled_area(&predicates);
            prop_assert!(areas.iter().any(|part| !part.sign().is_zero()));
            for other in &pieces[..i] {
                let facing = predicates.facing([0, 1, 2]);
                let [sides, others] = [piece, other].map(|p| p.shadow(facing));
                let pair = [piece, other];
                prop_assert!(PlanePolygon::are_apart(&predicates, pair, sides, others));
                let walls = pair.map(|p| p.walls(&predicates));
                let [sides, others] = walls;
                prop_assert!(PlanePolygon::are_apart(&predicates, pair, sides, others));
                prop_assert!(piece.within(&predicates, other.shadow(facing)).is_none());
            }
            let own = piece.within(&predicates, piece.shadow(predicates.facing([0, 1, 2])));
            prop_assert_eq!(own.as_ref(), Some(piece));
        }
    }
}

#[test]
fn a_plane_through_a_corner_and_an_edge_makes_no_new_corner_there() {
    let vertices =
        [(0, 0), (4, 0), (4, 4), (0, 4), (2, 0)].map(|(x, y)| dvec3(x.into(), y.into(), 0.0));
    let points = from_above(&vertices);
    let predicates = Predicates::<Exact>::new(&points);
    let square = PlanePolygon::of_ring([0, 1, 2], &[0, 1, 2, 3], |_| false);
    let diagonal = InputPlane::Wall([0, 2], 2).into();
    let Cut::Parted([below, above]) = square.cut(&predicates, diagonal) else {
        panic!("the diagonal parts the square");
    };
    let names = |polygon: &PlanePolygon| -> Vec<PlanePoint> {
        polygon.corners.iter().map(|corner| corner.point).collect()
    };
    assert_eq!(names(&below), [0, 1, 2].map(PlanePoint::Vertex));
    assert_eq!(names(&above), [0, 2, 3].map(PlanePoint::Vertex));
    assert_eq!(below.corners[2].side, Side::Cut(diagonal, Sign::Negative));
    assert_eq!(square.cut(&predicates, InputPlane::Across(0, 0).into()), Cut::Above);
    assert_eq!(square.cut(&predicates, InputPlane::Across(2, 1).into()), Cut::Below);
    assert_eq!(square.cut(&predicates, InputPlane::Face([1, 4, 3]).into()), Cut::Within);
    assert_eq!(square.cut(&predicates, InputPlane::Face([2, 1, 0]).into()), Cut::Within);
}

/// A face of these rings as the parts of its triangles.
fn parts_of(vertices: &[DVec3], rings: &[usize]) -> (Vec<Part>, bool) {
    let starts = [0].iter().chain(rings);
    let ring = |(&start, &end): (&usize, &usize)| vertices[start..end].to_vec();
    let positions: Vec<Vec<DVec3>> = starts.zip(rings).map(ring).collect();
    let faces = crate::polygon::triangulate(&positions).expect("a face");
    let points = from_above(vertices);
    let predicates = Predicates::<Exact>::new(&points);
    let parts = convex_parts(&predicates, &faces.corners, FaceParts::Convex);
    let whole: Vec<PlanePolygon> =
        faces.corners.iter().map(|&triangle| PlanePolygon::triangle(triangle)).collect();
    let polygons: Vec<PlanePolygon> = parts.iter().map(|part| part.polygon.clone()).collect();
    let same_area = total(&predicates, &polygons) == total(&predicates, &whole);
    let convex = polygons.iter().all(|polygon| is_inside(&predicates, polygon));
    (parts, same_area && convex && faces.is_planar)
}

fn flat(places: &[(i32, i32)]) -> Vec<DVec3> {
    places.iter().map(|&(x, y)| dvec3(x.into(), y.into(), 0.0)).collect()
}

#[test]
fn a_convex_face_is_one_part_without_inner_edges() {
    let hexagon = flat(&[(2, 0), (4, 1), (4, 3), (2, 4), (0, 3), (0, 1)]);
    let (parts, sound) = parts_of(&hexagon, &[6]);
    assert!(sound);
    assert_eq!(parts.len(), 1);
    assert_eq!(parts[0].triangles, [0, 1, 2, 3]);
    let is_inner =
        |corner: &PlaneCorner| !matches!(corner.side, Side::Edge { is_inner: false, .. });
    assert!(!parts[0].polygon.corners.iter().any(is_inner));
}

#[test]
fn concave_faces_and_holes_are_parted_along_marked_edges() {
    let corner = flat(&[(0, 0), (4, 0), (4, 4), (2, 4), (2, 2), (0, 2)]);
    let (parts, sound) = parts_of(&corner, &[6]);
    assert!(sound);
    assert!((2..=3).contains(&parts.len()), "{}", parts.len());
    let ring = flat(&[(0, 0), (9, 0), (9, 9), (0, 9), (3, 3), (3, 6), (6, 6), (6, 3)]);
    let (parts, sound) = parts_of(&ring, &[4, 8]);
    assert!(sound);
    assert!((4..=6).contains(&parts.len()), "{}", parts.len());
    let inner = |part: &Part| {
        let sides = part.polygon.corners.iter().map(|corner| corner.side);
        sides.filter(|side| matches!(side, Side::Edge { is_inner: true, .. })).count()
    };
    // Each inner edge bounds two parts; eight edges bound the face.
    let all: usize = parts.iter().map(|part| part.polygon.corners.len()).sum();
    assert_eq!(all - parts.iter().map(inner).sum::<usize>(), 8);
    let mut triangles: Vec<u32> = parts.into_iter().flat_map(|part| part.triangles).collect();
    triangles.sort_unstable();
    assert_eq!(triangles, [0, 1, 2, 3, 4, 5, 6, 7]);
}
