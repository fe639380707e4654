//! The complete check of a painting order: no point is asked, all are.
//!
//! Pieces of a face share no inside and have together the area of the face, so
//! each face is painted whole; and of each two pieces whose images have an
//! area in common, the later one is the nearer throughout that area, or lies in
//! one plane with the other and is preferred by the tie rule. Then the topmost
//! piece is the nearest face wherever one looks, but on borders.

use umriss::kernel::numbers::{Fraction, Sign};
use umriss::kernel::predicates::{Exact, Predicates};
use umriss::model::Mesh;
use umriss::view::{LineQuestion, PaintOrder, PaintedPiece};

/// Fails with what is wrong about an order.
pub(crate) fn check(question: &LineQuestion<'_>, order: &PaintOrder) {
    let predicates = Predicates::<Exact>::new(question.points);
    if !question.points.has_near_plane() {
        check_areas(question, &predicates, order);
    }
    for (i, later) in order.pieces.iter().enumerate() {
        for earlier in &order.pieces[..i] {
            check_pair(question.mesh, &predicates, earlier, later);
        }
    }
}

/// The order of a scene that is small enough, and its pieces without pairs.
pub(crate) fn check_areas(
    question: &LineQuestion<'_>,
    predicates: &Predicates<'_, Exact>,
    order: &PaintOrder,
) {
    let mesh = question.mesh;
    let mut faces: Vec<u32> = Vec::new();
    for triangle in 0..mesh.triangles().len() as u32 {
        if !question.facing[triangle as usize].is_zero() {
            faces.push(mesh.face_of(triangle));
        }
    }
    faces.dedup();
    for &face in &faces {
        let own = order.pieces.iter().filter(|piece| piece.face == face);
        let painted: Vec<_> = own.map(|piece| piece.polygon.doubled_area(predicates)).collect();
        let all = (0..mesh.triangles().len() as u32)
            .filter(|&t| mesh.face_of(t) == face && !question.facing[t as usize].is_zero());
        let whole: Vec<_> = all
            .map(|t| umriss::polygon::PlanePolygon::triangle(mesh.triangles()[t as usize]))
            .map(|polygon| polygon.doubled_area(predicates))
            .collect();
        assert_eq!(sum(&painted), sum(&whole), "the area of face {face}");
    }
    assert!(order.pieces.iter().all(|piece| faces.contains(&piece.face)));
}

fn sum(areas: &[[Fraction; 3]]) -> [Fraction; 3] {
    [0, 1, 2].map(|i| areas.iter().fold(Fraction::zero(), |sum, area| sum + area[i].clone()))
}

fn check_pair(
    mesh: &Mesh,
    predicates: &Predicates<'_, Exact>,
    earlier: &PaintedPiece,
    later: &PaintedPiece,
) {
    let facing = predicates.facing(earlier.polygon.face);
    let over = later.polygon.within(predicates, earlier.polygon.shadow(facing));
    let Some(over) = over else { return };
    let plane = earlier.polygon.plane().into();
    let signs: Vec<Sign> = over.corners.iter().map(|c| predicates.above(plane, c.point)).collect();
    if signs.iter().all(|sign| sign.is_zero()) {
        assert_ne!(earlier.face, later.face, "pieces of one face overlap");
        check_tie(mesh, predicates, earlier, later);
    } else {
        // Beyond a plane its functional has the sign of the facing.
        assert!(!signs.contains(&facing), "{later:?} is painted over {earlier:?}");
    }
}

/// Wherever two triangles of pieces in one plane overlap, that of the later
/// piece has the lesser corners or the lesser name.
fn check_tie(
    mesh: &Mesh,
    predicates: &Predicates<'_, Exact>,
    earlier: &PaintedPiece,
    later: &PaintedPiece,
) {
    let of_face =
        |face: u32| (0..mesh.triangles().len() as u32).filter(move |&t| mesh.face_of(t) == face);
    for a in of_face(earlier.face) {
        for b in of_face(later.face) {
            let [first, second] = [a, b].map(|t| {
                let corners = mesh.triangles()[t as usize];
                let triangle = umriss::polygon::PlanePolygon::triangle(corners);
                (triangle, predicates.facing(corners))
            });
            let common = earlier
                .polygon
                .within(predicates, first.0.shadow(first.1))
                .and_then(|common| common.within(predicates, second.0.shadow(second.1)))
                .and_then(|common| {
                    let facing = predicates.facing(later.polygon.face);
                    common.within(predicates, later.polygon.shadow(facing))
                });
            assert!(common.is_none() || !precedes(mesh, a, b), "triangle {b} is seen upon {a}");
        }
    }
}

/// The tie rule.
pub(crate) fn precedes(mesh: &Mesh, a: u32, b: u32) -> bool {
    let key = |triangle: u32| {
        let at = |vertex: u32| mesh.vertices()[vertex as usize].to_array();
        let mut corners = mesh.triangles()[triangle as usize].map(at);
        corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
        let name = &mesh.objects()[mesh.object_of_triangle(triangle) as usize].name;
        (corners, name, triangle)
    };
    key(a) < key(b)
}
