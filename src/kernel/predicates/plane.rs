//! Planes of the input, and the points in which they meet.
//!
//! A polygon that is cut by planes, again and again, keeps its exactness if
//! nothing is constructed upon what was cut: all its corners are vertices,
//! points in which a plane of the input cuts an edge of the input, or points
//! in which two such planes cut the plane of a face. (Sugihara and Iri 1989;
//! Bernstein and Fussell 2009 for trees of such polygons.) Every question
//! about them is linear in the point, a plane's functional g:
//!
//! ```text
//!   g(vertex)          = g(x)
//!   g(edge ab x p)     = p(b) g(a) - p(a) g(b)                    p(a) < 0 < p(b)
//!   g(face h x p x q)  = g(a) [h,p,q] - q(a) [h,p,g] + p(a) [h,q,g]    [h,p,q] > 0
//! ```
//!
//! where `[h,p,q]` is the determinant of three normals and a a corner of h.
//! The conditions on the right make the weights positive, so signs need no
//! second look. Edges of the input stay pairs of vertices and are not made
//! planes: degrees are 3, 6 and 9, however often was cut.

use super::formula::{near_at_vertex, orientation, side};
use super::{Formula, Points, Policy, Predicate, Predicates};
use crate::kernel::numbers::{BigInteger, Ring, Sign, cross, determinant3, difference, dot, piece};
use glam::DVec3;

/// A plane that is known by input alone, with a side on which it is positive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum InputPlane {
    /// Through three vertices; positive as [`Predicates::plane`].
    Face([u32; 3]),
    /// Through two vertices and parallel to an axis; positive on the left of
    /// the edge, for an eye far up the axis.
    Wall([u32; 2], u8),
    /// Through a vertex and across an axis; positive up the axis.
    Across(u32, u8),
    /// The near plane; positive in front of it. Everything is in front
    /// where there is none.
    Near,
    /// Through a vertex and parallel to the near plane, or across the
    /// direction of an orthographic eye; positive beyond it.
    Level(u32),
}

/// A plane of the input, or one through the eye and a line of the input.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Plane {
    /// It does not depend on where the eye is, but for the near plane.
    Input(InputPlane),
    /// Through the eye and two vertices; positive as [`Predicates::side`].
    Silhouette([u32; 2]),
    /// Through the eye and the line in which a plane cuts that of a face. On
    /// the face it has the sign of the plane times the face's facing.
    Shadow([u32; 3], InputPlane),
}

impl From<InputPlane> for Plane {
    fn from(plane: InputPlane) -> Self {
        Plane::Input(plane)
    }
}

/// A point in which planes of the input meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PlanePoint {
    /// A vertex.
    Vertex(u32),
    /// Where a plane cuts an edge: it is negative at the first end, positive
    /// at the second.
    OnEdge([u32; 2], Plane),
    /// Where two planes cut the plane of a face. The determinant of the
    /// normals of the three, in this order, is positive.
    OnFace([u32; 3], [Plane; 2]),
}

/// Bounds of the bits of a plane: its normal, and its value at a vertex.
#[derive(Debug, Clone, Copy)]
struct PlaneBits {
    normal: u32,
    value: u32,
}

impl PlaneBits {
    fn of_input(plane: InputPlane, spread: u32) -> Self {
        // A product of two differences and the difference of two of them;
        // for a value a third difference, and three terms.
        match plane {
            InputPlane::Face(_) => PlaneBits { normal: 2 * spread + 3, value: 3 * spread + 6 },
            InputPlane::Wall(..) => PlaneBits { normal: spread + 2, value: 2 * spread + 5 },
            InputPlane::Across(..) => PlaneBits { normal: 1, value: spread + 1 },
            // The offset of the near plane has twice the bits of a coordinate.
            InputPlane::Near | InputPlane::Level(_) => {
                PlaneBits { normal: spread, value: 2 * spread + 4 }
            }
        }
    }

    fn of(plane: Plane, spread: u32) -> Self {
        match plane {
            Plane::Input(plane) => Self::of_input(plane, spread),
            Plane::Silhouette(_) => PlaneBits { normal: 2 * spread + 3, value: 3 * spread + 6 },
            Plane::Shadow(_, cut) => {
                let face = PlaneBits { normal: 2 * spread + 3, value: 3 * spread + 6 };
                let cut = Self::of_input(cut, spread);
                // At the eye a functional has the bits of a value.
                PlaneBits {
                    normal: (face.normal + cut.value).max(cut.normal + face.value) + 1,
                    value: face.value + cut.value + 1,
                }
            }
        }
    }
}

/// The bits of a determinant of normals.
fn determinant_bits(normals: [u32; 3]) -> u32 {
    normals.iter().sum::<u32>() + 3
}

/// The bits of a plane's functional at a point, weight included.
fn value_bits(plane: PlaneBits, point: PlanePoint, spread: u32) -> u32 {
    match point {
        PlanePoint::Vertex(_) => plane.value,
        PlanePoint::OnEdge(_, cut) => plane.value + PlaneBits::of(cut, spread).value + 1,
        PlanePoint::OnFace(_, cuts) => {
            let [p, q] = cuts.map(|cut| PlaneBits::of(cut, spread));
            let h = 2 * spread + 3;
            let terms = [
                plane.value + determinant_bits([h, p.normal, q.normal]),
                q.value + determinant_bits([h, p.normal, plane.normal]),
                p.value + determinant_bits([h, q.normal, plane.normal]),
            ];
            terms[0].max(terms[1]).max(terms[2]) + 2
        }
    }
}

/// The bits of a point's weight.
fn weight_bits(point: PlanePoint, spread: u32) -> u32 {
    match point {
        PlanePoint::Vertex(_) => 1,
        PlanePoint::OnEdge(_, cut) => PlaneBits::of(cut, spread).value + 1,
        PlanePoint::OnFace(_, cuts) => {
            let [p, q] = cuts.map(|cut| PlaneBits::of(cut, spread).normal);
            determinant_bits([2 * spread + 3, p, q])
        }
    }
}

/// The direction in which depth grows.
fn forward<R: Ring>(points: &Points) -> [R; 3] {
    match points.near::<R>() {
        Some((forward, _)) => forward,
        None => points.eye::<R>().map(|x| -x),
    }
}

/// A unit vector.
fn axis_direction<R: Ring>(axis: u8) -> [R; 3] {
    [0, 1, 2].map(|i| R::read(if i == axis { 1.0 } else { 0.0 }, 0))
}

/// The eye as seen from a vertex, or its direction.
fn towards_eye<R: Ring>(points: &Points, from: u32) -> [R; 3] {
    if points.is_perspective() {
        difference(points.eye(), &points.vertex(from))
    } else {
        points.eye()
    }
}

fn edge<R: Ring>(points: &Points, [a, b]: [u32; 2]) -> [R; 3] {
    difference(points.vertex(b), &points.vertex(a))
}

/// The normal of a plane of the input.
fn input_normal<R: Ring>(points: &Points, plane: InputPlane) -> [R; 3] {
    piece!(
        R,
        match plane {
            InputPlane::Face([a, b, c]) => cross(edge(points, [a, c]), edge(points, [a, b])),
            InputPlane::Wall(ends, axis) => cross(axis_direction(axis), edge(points, ends)),
            InputPlane::Across(_, axis) => axis_direction(axis),
            InputPlane::Near => match points.near::<R>() {
                Some((forward, _)) => forward,
                None => [0.0; 3].map(|zero| R::read(zero, 0)),
            },
            InputPlane::Level(_) => forward(points),
        }
    )
}

/// A plane's functional at a vertex.
#[inline(always)]
fn input_at_vertex<R: Ring>(points: &Points, plane: InputPlane, x: u32) -> R {
    piece!(
        R,
        match plane {
            InputPlane::Face([a, b, c]) => orientation(points, a, b, c, x),
            InputPlane::Wall([a, _], _) | InputPlane::Level(a) => {
                dot(input_normal(points, plane), edge(points, [a, x]))
            }
            InputPlane::Across(vertex, axis) => {
                let axis = usize::from(axis);
                points.vertex::<R>(x)[axis].clone() - points.vertex::<R>(vertex)[axis].clone()
            }
            InputPlane::Near => near_at_vertex(points, x),
        }
    )
}

/// A plane's functional at the eye, point or direction.
fn input_at_eye<R: Ring>(points: &Points, plane: InputPlane) -> R {
    piece!(
        R,
        match plane {
            InputPlane::Face([a, b, c]) => -side::<R>(points, a, b, c),
            InputPlane::Wall([a, _], _) | InputPlane::Level(a) => {
                dot(input_normal(points, plane), towards_eye(points, a))
            }
            InputPlane::Across(vertex, axis) => {
                towards_eye::<R>(points, vertex)[usize::from(axis)].clone()
            }
            InputPlane::Near => match points.near::<R>() {
                Some((_, offset)) if points.is_perspective() => -offset,
                Some((forward, _)) => dot(forward, points.eye()),
                None => R::read(1.0, 0),
            },
        }
    )
}

fn normal<R: Ring>(points: &Points, plane: Plane) -> [R; 3] {
    piece!(
        R,
        match plane {
            Plane::Input(plane) => input_normal(points, plane),
            Plane::Silhouette([a, b]) => cross(towards_eye(points, a), edge(points, [a, b])),
            Plane::Shadow(face, cut) => {
                let face = InputPlane::Face(face);
                let [h, p] = [face, cut].map(|plane| input_normal::<R>(points, plane));
                let [at_h, at_p] = [face, cut].map(|plane| input_at_eye::<R>(points, plane));
                [0, 1, 2].map(|i| h[i].clone() * at_p.clone() - p[i].clone() * at_h.clone())
            }
        }
    )
}

#[inline(always)]
fn at_vertex<R: Ring>(points: &Points, plane: Plane, x: u32) -> R {
    piece!(
        R,
        match plane {
            Plane::Input(plane) => input_at_vertex(points, plane, x),
            Plane::Silhouette([a, b]) => side(points, a, b, x),
            Plane::Shadow(face, cut) => {
                let face = InputPlane::Face(face);
                let at = |plane| input_at_vertex::<R>(points, plane, x);
                at(face) * input_at_eye(points, cut) - at(cut) * input_at_eye(points, face)
            }
        }
    )
}

/// A plane's functional at a point, times the point's positive weight.
#[inline(always)]
fn at_point<R: Ring>(points: &Points, plane: Plane, point: PlanePoint) -> R {
    piece!(
        R,
        match point {
            PlanePoint::Vertex(vertex) => at_vertex(points, plane, vertex),
            PlanePoint::OnEdge(ends, cut) => {
                let [below, above] = ends.map(|end| at_vertex::<R>(points, cut, end));
                above * at_vertex(points, plane, ends[0])
                    - below * at_vertex(points, plane, ends[1])
            }
            PlanePoint::OnFace(face, cuts) => on_face(points, plane, face, cuts),
        }
    )
}

/// The third formula of the module.
#[inline(never)]
fn on_face<R: Ring>(points: &Points, plane: Plane, face: [u32; 3], [p, q]: [Plane; 2]) -> R {
    let h = input_normal::<R>(points, InputPlane::Face(face));
    let (n, m) = (normal::<R>(points, p), normal::<R>(points, q));
    let g = normal::<R>(points, plane);
    let at = |plane| at_vertex::<R>(points, plane, face[0]);
    let along_p = cross(h.clone(), n);
    let along_q = cross(h, m.clone());
    at(plane) * dot(along_p.clone(), m) - at(q) * dot(along_p, g.clone()) + at(p) * dot(along_q, g)
}

/// A point's weight.
fn weight<R: Ring>(points: &Points, point: PlanePoint) -> R {
    piece!(
        R,
        match point {
            PlanePoint::Vertex(_) => R::read(1.0, 0),
            PlanePoint::OnEdge([a, b], cut) => {
                at_vertex::<R>(points, cut, b) - at_vertex(points, cut, a)
            }
            PlanePoint::OnFace(face, [p, q]) => determinant3(
                input_normal(points, InputPlane::Face(face)),
                normal(points, p),
                normal(points, q),
            ),
        }
    )
}

/// On which side of a plane lies a point?
struct Above(Plane, PlanePoint);

impl Formula for Above {
    const PREDICATE: Predicate = Predicate::Above;

    fn degree(&self) -> u32 {
        9
    }

    #[inline(always)]
    fn bits(&self, spread: u32) -> u32 {
        value_bits(PlaneBits::of(self.0, spread), self.1, spread)
    }

    #[inline(always)]
    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        at_point(points, self.0, self.1)
    }
}

/// On which side of a plane lies the eye?
struct EyeAbove(InputPlane);

impl Formula for EyeAbove {
    const PREDICATE: Predicate = Predicate::Above;

    fn degree(&self) -> u32 {
        3
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        input_at_eye(points, self.0)
    }
}

/// `f(x) w(y) - f(y) w(x)` for the depth f beyond the first vertex and the
/// weights w: which of two points is deeper?
struct Deeper([PlanePoint; 2]);

impl Formula for Deeper {
    const PREDICATE: Predicate = Predicate::Deeper;

    fn degree(&self) -> u32 {
        17
    }

    fn bits(&self, spread: u32) -> u32 {
        let level = PlaneBits::of_input(InputPlane::Level(0), spread);
        let bits = |x, y| value_bits(level, x, spread) + weight_bits(y, spread);
        let [x, y] = self.0;
        bits(x, y).max(bits(y, x)) + 1
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let depth = |point| at_point::<R>(points, InputPlane::Level(0).into(), point);
        let [x, y] = self.0;
        depth(x) * weight(points, y) - depth(y) * weight(points, x)
    }
}

/// `[k, a, b, c]` for an axis k: which way a triangle turns for an eye far up
/// that axis.
struct TurnAlong([u32; 3], u8);

impl Formula for TurnAlong {
    const PREDICATE: Predicate = Predicate::Above;

    fn degree(&self) -> u32 {
        2
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [a, b, c] = self.0;
        input_at_vertex(points, InputPlane::Wall([a, b], self.1), c)
    }
}

impl<P: Policy> Predicates<'_, P> {
    /// On which side of a plane does a point lie? Points that are named as
    /// lying on the plane cost nothing. Degree 3 for vertices, 6 on edges, 9
    /// on faces; more where the plane or those of the point go through the eye.
    #[inline]
    pub fn above(&self, plane: Plane, point: PlanePoint) -> Sign {
        if is_on(plane, point) { Sign::Zero } else { self.decide(&Above(plane, point)) }
    }

    /// On which side of a plane does the eye lie? For a direction: which
    /// way it points.
    pub fn eye_above(&self, plane: InputPlane) -> Sign {
        match plane {
            InputPlane::Face(corners) => -self.facing(corners),
            _ => self.decide(&EyeAbove(plane)),
        }
    }

    /// Positive if the first point is deeper in the direction of view than
    /// the second.
    pub fn deeper(&self, first: PlanePoint, second: PlanePoint) -> Sign {
        match (first, second) {
            _ if first == second => Sign::Zero,
            (_, PlanePoint::Vertex(vertex)) => self.above(InputPlane::Level(vertex).into(), first),
            (PlanePoint::Vertex(vertex), _) => {
                -self.above(InputPlane::Level(vertex).into(), second)
            }
            _ => self.decide(&Deeper([first, second])),
        }
    }

    /// Which way a triangle turns for an eye far up an axis: positive is
    /// counterclockwise, zero if its plane is parallel to the axis.
    pub fn turn_along(&self, triangle: [u32; 3], axis: u8) -> Sign {
        self.decide(&TurnAlong(triangle, axis))
    }

    /// The coordinates of a point as numerators and their common positive
    /// denominator, exactly; times the power of two of
    /// [`Predicates::ratio_exponent`].
    pub fn position_ratio(&self, point: PlanePoint) -> ([BigInteger; 3], BigInteger) {
        let points = self.points();
        let along = |axis: u8| {
            // What a point has of an axis is what it lies above the plane
            // through the first vertex, and that vertex.
            at_point::<BigInteger>(points, InputPlane::Across(0, axis).into(), point)
        };
        let weight = weight::<BigInteger>(points, point);
        let origin = points.vertex::<BigInteger>(0);
        let parts = [0_u8, 1, 2]
            .map(|axis| along(axis) + origin[usize::from(axis)].clone() * weight.clone());
        (parts, weight)
    }

    /// The position of a point in world coordinates: each off by less than
    /// one unit in its last place, and exact where a float has the value.
    pub fn position(&self, point: PlanePoint) -> DVec3 {
        let (parts, weight) = self.position_ratio(point);
        let exponent = self.ratio_exponent();
        let part = |part: &BigInteger| BigInteger::scaled_ratio(part, &weight, exponent);
        DVec3::from(parts.each_ref().map(part))
    }
}

/// Whether the names say that a point lies on a plane.
#[inline(always)]
fn is_on(plane: Plane, point: PlanePoint) -> bool {
    let holds = |vertex: u32| match plane {
        Plane::Input(InputPlane::Face(corners)) => corners.contains(&vertex),
        Plane::Silhouette(ends) | Plane::Input(InputPlane::Wall(ends, _)) => ends.contains(&vertex),
        Plane::Input(InputPlane::Across(at, _) | InputPlane::Level(at)) => at == vertex,
        Plane::Input(InputPlane::Near) | Plane::Shadow(..) => false,
    };
    match point {
        PlanePoint::Vertex(vertex) => holds(vertex),
        PlanePoint::OnEdge([a, b], cut) => cut == plane || (holds(a) && holds(b)),
        PlanePoint::OnFace(face, cuts) => {
            cuts.contains(&plane) || plane == Plane::Input(InputPlane::Face(face))
        }
    }
}

#[cfg(test)]
mod tests;
