//! What is seen at a point, by integers and brute force.
//!
//! Nothing here comes from the library but the mesh: rays are followed and
//! depths compared in 128-bit integers, for scenes on a small grid.

use crate::whole_check::precedes;
use umriss::kernel::numbers::Sign;
use umriss::kernel::predicates::{Exact, Eye, NearPlane, PlanePoint, Points, Predicates};
use umriss::model::{Mesh, View};
use umriss::view::PaintOrder;

type Vector = [i128; 3];

/// How much finer than the scene's the grid of eyes and samples is.
const FINE: i32 = 64;

fn fine(v: glam::DVec3) -> Vector {
    v.to_array().map(|x| {
        let scaled = x * f64::from(FINE);
        assert_eq!(scaled, scaled.round(), "not on the grid");
        scaled as i128
    })
}

fn minus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn dot(a: Vector, b: Vector) -> i128 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A ray from the eye, away from it.
#[derive(Clone, Copy)]
struct Ray {
    through: Vector,
    along: Vector,
    /// `along` times the forward direction, times the parameter at which the
    /// ray leaves the near plane, if there is one: a fraction.
    near: Option<[i128; 2]>,
}

impl Ray {
    fn new(view: &View, sample: glam::DVec3) -> Self {
        let through = fine(sample);
        match (view.eye, view.near) {
            (Eye::Towards(direction), _) => {
                let along = fine(-direction);
                Ray { through, along, near: None }
            }
            (Eye::At(eye), near) => {
                let eye = fine(eye);
                let along = minus(through, eye);
                let near = near.map(|NearPlane { forward, distance }| {
                    // forward is a unit vector: through + t along lies in the
                    // plane if forward . along (1 + t) is the distance.
                    assert_eq!(forward.length(), 1.0);
                    let speed = dot(forward.to_array().map(|x| x as i128), along);
                    assert!(0 < speed, "a sample in front of the eye");
                    [fine(glam::DVec3::X * distance)[0] - speed, speed]
                });
                Ray { through, along, near }
            }
        }
    }
}

/// Where a ray meets a triangle.
enum Hit {
    None,
    /// On its border, seen in the image.
    Border,
    /// The parameter as a fraction with a positive denominator.
    At([i128; 2]),
}

fn hit(ray: &Ray, [a, b, c]: [Vector; 3]) -> Hit {
    let normal = cross(minus(b, a), minus(c, a));
    let speed = dot(normal, ray.along);
    if speed == 0 {
        return Hit::None;
    }
    // Signed volumes of the ray's direction and two corners.
    let beside = |p: Vector, q: Vector| {
        dot(ray.along, cross(minus(p, ray.through), minus(q, ray.through))).signum()
    };
    let signs = [beside(a, b), beside(b, c), beside(c, a)];
    if signs.contains(&1) && signs.contains(&-1) {
        return Hit::None;
    }
    let distance = dot(normal, minus(a, ray.through));
    let at = [distance * speed.signum(), speed.abs()];
    if ray.near.is_some_and(|near| at[0] * near[1] <= near[0] * at[1]) {
        // Border enough if the hit is the near plane's very own.
        let touches = ray.near.is_some_and(|near| at[0] * near[1] == near[0] * at[1]);
        return if touches { Hit::Border } else { Hit::None };
    }
    if signs.contains(&0) { Hit::Border } else { Hit::At(at) }
}

/// The triangle seen at a sample. None if a border is hit there, or a point
/// that two planes have in common, of which a picture says nothing.
pub(crate) fn seen(mesh: &Mesh, view: &View, sample: glam::DVec3) -> Option<Option<u32>> {
    let ray = Ray::new(view, sample);
    let mut best: Option<(u32, [i128; 2])> = None;
    let mut crossing = false;
    let corners = |triangle: u32| {
        mesh.triangles()[triangle as usize].map(|v| fine(mesh.vertices()[v as usize]))
    };
    for triangle in 0..mesh.triangles().len() as u32 {
        let at = match hit(&ray, corners(triangle)) {
            Hit::None => continue,
            Hit::Border => return None,
            Hit::At(at) => at,
        };
        let Some((other, least)) = best else {
            best = Some((triangle, at));
            continue;
        };
        let order = (at[0] * least[1]).cmp(&(least[0] * at[1]));
        if order.is_eq() {
            crossing |= !are_parallel(corners(triangle), corners(other));
        } else if order.is_lt() {
            crossing = false;
        }
        if order.is_lt() || (order.is_eq() && precedes(mesh, triangle, other)) {
            best = Some((triangle, at));
        }
    }
    (!crossing).then(|| best.map(|(triangle, _)| triangle))
}

fn are_parallel(first: [Vector; 3], second: [Vector; 3]) -> bool {
    let normal = |[a, b, c]: [Vector; 3]| cross(minus(b, a), minus(c, a));
    cross(normal(first), normal(second)) == [0; 3]
}

/// Asks a painting order what is on top at samples.
pub(crate) struct Topmost {
    points: Points,
    first: u32,
}

impl Topmost {
    pub(crate) fn new(mesh: &Mesh, view: &View, samples: &[glam::DVec3]) -> Self {
        let vertices = [mesh.vertices(), samples].concat();
        let points = Points::new(&vertices, view.eye, view.near);
        Topmost { points, first: mesh.vertices().len() as u32 }
    }

    /// The face that is painted last at a sample.
    pub(crate) fn face(&self, order: &PaintOrder, sample: usize) -> Option<u32> {
        let predicates = Predicates::<Exact>::new(&self.points);
        let point = PlanePoint::Vertex(self.first + sample as u32);
        let covers = |polygon: &umriss::polygon::PlanePolygon| {
            let facing = predicates.facing(polygon.face);
            polygon
                .shadow(facing)
                .all(|(plane, inside)| predicates.above(plane, point) * inside != Sign::Negative)
        };
        order.pieces.iter().rev().find(|piece| covers(&piece.polygon)).map(|piece| piece.face)
    }
}
