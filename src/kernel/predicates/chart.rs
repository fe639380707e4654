//! Points and lines of the image, as triples of polynomials.
//!
//! The image is the projective plane of all lines through the eye. A
//! [`Chart`] gives each of its points three homogeneous coordinates and
//! each of its lines three coefficients, all of them polynomials in the
//! input, so that position in the image is decided by 3 x 3 determinants
//! whatever the eye is:
//!
//! - *Parallel*, with the direction v towards the viewer and its largest
//!   component k: `(d_i v_k - d_k v_i, d_j v_k - d_k v_j, 1)` with the offset
//!   d from the first vertex. For `v = (0, 0, 1)` and points `(x, y, 0)` that
//!   is `(x, y, 1)`: the plane is the simplest of all charts.
//! - *Central*: the offset from the eye, two axes exchanged for the sense of
//!   rotation. Points must lie in front of the eye, which the forward
//!   direction of the near plane tells.
//!
//! A line is known by input too: through two vertices, or the common line of
//! two faces' planes, or where the near plane cuts a face. A point is a
//! vertex, or the crossing of two such lines: the cross product of their
//! coefficients. Nothing is ever constructed upon a crossing, so degrees
//! stay bounded however many clips follow one another.

use super::Points;
use crate::kernel::numbers::{Ring, cross, difference, dot, piece};

/// A directed line of the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ImageLine {
    /// From one vertex to another, whose images differ.
    Edge([u32; 2]),
    /// The common line of the planes of two faces that are not edge-on and
    /// cross in space.
    Planes([[u32; 3]; 2]),
    /// Where the near plane cuts the plane of a face (perspective only).
    Near([u32; 3]),
}

impl ImageLine {
    /// The same line, directed the other way.
    #[must_use]
    pub fn reversed(self) -> Self {
        match self {
            ImageLine::Edge([a, b]) => ImageLine::Edge([b, a]),
            ImageLine::Planes([f, g]) => ImageLine::Planes([g, f]),
            ImageLine::Near([a, b, c]) => ImageLine::Near([b, a, c]),
        }
    }
}

/// A point of the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ImagePoint {
    /// The image of a vertex.
    Vertex(u32),
    /// Where two lines cross, of which the second turns left of the first:
    /// [`super::Predicates::bend`] is positive.
    Crossing([ImageLine; 2]),
}

/// Homogeneous coordinates for the image of some points; see the module.
#[derive(Debug, Clone, Copy)]
pub struct Chart {
    projection: Projection,
    /// Bits of the coordinates of the scene and of its directions.
    spread: u32,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum Projection {
    /// The plane itself: the eye is the direction (0, 0, 1).
    Flat,
    /// Along the axis `axes[2]`, mostly; `mirrored` if against it.
    Parallel { axes: [usize; 3], mirrored: bool },
    /// `axes[2]` is where forward is largest, in exchanged axes.
    Central { axes: [usize; 3], mirrored: bool },
}

/// Bounds of the bits of the first two members of a triple, and the third.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bits {
    pub(super) plane: u32,
    pub(super) weight: u32,
}

impl Bits {
    /// Of the cross product.
    pub(super) fn cross(self, other: Self) -> Self {
        let mixed = (self.plane + other.weight).max(self.weight + other.plane);
        Bits { plane: mixed + 1, weight: self.plane + other.plane + 1 }
    }

    /// Of the scalar product.
    pub(super) fn dot(self, other: Self) -> u32 {
        (self.plane + other.plane + 1).max(self.weight + other.weight) + 1
    }
}

/// The largest component's axis and the two after it, cyclically last.
fn dominant(v: [f64; 3]) -> [usize; 3] {
    let size = v.map(f64::abs);
    let k = (0..3).fold(0, |best, i| if size[i] > size[best] { i } else { best });
    // In a plain front view x and y keep their places.
    let k = if size[2] >= size[k] { 2 } else { k };
    [(k + 1) % 3, (k + 2) % 3, k]
}

/// The two axes exchanged that make a determinant of offsets from the eye
/// positive where the images turn left.
fn exchanged<T>([x, y, z]: [T; 3]) -> [T; 3] {
    [y, x, z]
}

impl Chart {
    /// The chart of a view; none for a perspective without a near plane,
    /// whose image has no front.
    pub fn new(points: &Points) -> Option<Self> {
        let projection = if points.is_perspective() {
            let (forward, _) = points.near::<f64>()?;
            let forward = exchanged(forward);
            let axes = dominant(forward);
            Projection::Central { axes, mirrored: forward[axes[2]] < 0.0 }
        } else {
            let towards = points.eye::<f64>();
            let axes = dominant(towards);
            if towards == [0.0, 0.0, 1.0] {
                Projection::Flat
            } else {
                Projection::Parallel { axes, mirrored: towards[axes[2]] < 0.0 }
            }
        };
        Some(Chart { projection, spread: points.spread() })
    }

    /// The same chart of a scene whose coordinates have so many bits.
    pub(super) fn of_spread(&self, spread: u32) -> Self {
        Chart { spread, ..*self }
    }

    /// Whether the chart is the plane of x and y itself.
    pub fn is_flat(&self) -> bool {
        matches!(self.projection, Projection::Flat)
    }

    /// Whether the eye is a point.
    pub(super) fn is_central(&self) -> bool {
        matches!(self.projection, Projection::Central { .. })
    }

    /// How points get their coordinates.
    pub(super) fn projection(&self) -> Projection {
        self.projection
    }

    /// The axes of the chart's first two coordinates in a parallel view.
    pub(super) fn plane_axes(&self, axes: [usize; 3], mirrored: bool) -> [usize; 2] {
        if mirrored { [axes[1], axes[0]] } else { [axes[0], axes[1]] }
    }

    /// A displacement in space as one in the image: the third is its weight.
    #[inline(always)]
    fn displacement<R: Ring>(&self, points: &Points, d: [R; 3]) -> [R; 3] {
        piece!(
            R,
            match self.projection {
                Projection::Flat => {
                    let [x, y, _] = d;
                    [x, y, R::read(0.0, 0)]
                }
                Projection::Parallel { axes, mirrored } => {
                    let [i, j] = self.plane_axes(axes, mirrored);
                    let (k, v) = (axes[2], points.eye::<R>());
                    let along =
                        |i: usize| d[i].clone() * v[k].clone() - d[k].clone() * v[i].clone();
                    [along(i), along(j), R::read(0.0, 0)]
                }
                Projection::Central { .. } => exchanged(d),
            }
        )
    }

    /// The coordinates of a vertex.
    #[inline(always)]
    pub(super) fn vertex<R: Ring>(&self, points: &Points, vertex: u32) -> [R; 3] {
        piece!(R, {
            let position = points.vertex::<R>(vertex);
            if let Projection::Central { .. } = self.projection {
                return exchanged(difference(position, &points.eye()));
            }
            let offset = difference(position, &points.vertex(0));
            let [x, y, _] = self.displacement(points, offset);
            [x, y, R::read(1.0, 0)]
        })
    }

    /// The coordinates of a point, with a positive weight.
    #[inline(always)]
    pub(super) fn point<R: Ring>(&self, points: &Points, point: ImagePoint) -> [R; 3] {
        piece!(
            R,
            match point {
                ImagePoint::Vertex(vertex) => self.vertex(points, vertex),
                ImagePoint::Crossing([a, b]) => cross(self.line(points, a), self.line(points, b)),
            }
        )
    }

    /// The coefficients of a line: positive on its left.
    #[inline(always)]
    pub(super) fn line<R: Ring>(&self, points: &Points, line: ImageLine) -> [R; 3] {
        piece!(R, {
            match line {
                ImageLine::Edge([a, b]) => {
                    let start = self.vertex::<R>(points, a);
                    // The difference of two vertices rounds less than that of
                    // two offsets.
                    let ahead = difference(points.vertex(b), &points.vertex(a));
                    let [dx, dy, dw] = self.displacement(points, ahead);
                    if let Projection::Central { .. } = self.projection {
                        return cross(start, [dx, dy, dw]);
                    }
                    let [x, y, _] = start;
                    let constant = x * dy.clone() - y * dx.clone();
                    [-dy, dx, constant]
                }
                ImageLine::Planes(faces) => self.common_line(points, faces),
                ImageLine::Near(face) => self.near_line(points, face),
            }
        })
    }

    /// `f(x) g(E) - g(x) f(E)` for the functionals of two planes.
    fn common_line<R: Ring>(&self, points: &Points, faces: [[u32; 3]; 2]) -> [R; 3] {
        let [f, g] = faces.map(|face| Plane::<R>::of(points, face));
        let (at_f, at_g) = (f.at_eye(points), g.at_eye(points));
        let normal = combined(&f.normal, &at_g, &g.normal, &at_f);
        let constant = f.constant * at_g - g.constant * at_f;
        self.coefficients(points, normal, constant)
    }

    /// The same for the near plane and a face.
    fn near_line<R: Ring>(&self, points: &Points, face: [u32; 3]) -> [R; 3] {
        let Some((forward, offset)) = points.near::<R>() else {
            return [0.0; 3].map(|zero| R::read(zero, 0));
        };
        let face = Plane::<R>::of(points, face);
        // At the eye the functional of the near plane is minus its offset.
        let normal = combined(&forward, &face.at_eye(points), &face.normal, &-offset);
        self.coefficients(points, normal, R::read(0.0, 0))
    }

    /// The line on which `normal . d + constant` vanishes, for the offset d
    /// of a point, where that is the same along each ray from the eye.
    fn coefficients<R: Ring>(&self, points: &Points, normal: [R; 3], constant: R) -> [R; 3] {
        match self.projection {
            Projection::Flat => {
                let [x, y, _] = normal;
                [x, y, constant]
            }
            Projection::Parallel { axes, mirrored } => {
                let [i, j] = self.plane_axes(axes, mirrored);
                let scale = points.eye::<R>()[axes[2]].clone();
                let line = [normal[i].clone(), normal[j].clone(), scale * constant];
                if mirrored { line.map(|x| -x) } else { line }
            }
            Projection::Central { .. } => exchanged(normal),
        }
    }

    /// The functional that is positive on all points: their weight.
    #[inline(always)]
    pub(super) fn front<R: Ring>(&self, points: &Points) -> [R; 3] {
        match (self.projection, points.near::<R>()) {
            (Projection::Central { .. }, Some((forward, _))) => exchanged(forward),
            _ => [0.0, 0.0, 1.0].map(|value| R::read(value, 0)),
        }
    }

    /// The image directions right and up, points of weight zero.
    #[inline(always)]
    fn directions<R: Ring>(&self, points: &Points) -> [[R; 3]; 2] {
        let read = |direction: [f64; 3]| direction.map(|value| R::read(value, 0));
        let (Projection::Central { axes, mirrored }, Some((forward, _))) =
            (self.projection, points.near::<R>())
        else {
            return [read([1.0, 0.0, 0.0]), read([0.0, 1.0, 0.0])];
        };
        let [i, j, k] = axes;
        let forward = exchanged(forward);
        let across = |i: usize| {
            let mut direction = read([0.0; 3]);
            direction[i] = forward[k].clone();
            direction[k] = -forward[i].clone();
            direction
        };
        if mirrored { [across(j), across(i)] } else { [across(i), across(j)] }
    }

    /// The two functionals by which points are swept: the second counts
    /// where the first is equal. `key . (p x q)` is positive if p comes first.
    #[inline(always)]
    pub(super) fn sweep_keys<R: Ring>(&self, points: &Points) -> [[R; 3]; 2] {
        let [right, up] = self.directions(points);
        [up, right.map(|x| -x)]
    }

    /// The functionals right and up, to be divided by [`Self::front`]; what
    /// the chart of the plane leaves out is added by [`Self::origin`].
    pub(super) fn coordinates<R: Ring>(&self, points: &Points) -> [[R; 3]; 2] {
        let [right, up] = self.directions(points);
        match self.projection {
            Projection::Central { .. } => {
                let front = self.front::<R>(points);
                [cross(up, front.clone()), cross(front, right)]
            }
            _ => [right, up],
        }
    }

    /// What is to be added to quotients of coordinates: in the plane they
    /// are those of the points.
    pub(super) fn origin(&self, points: &Points) -> [f64; 2] {
        if self.is_flat() && !points.is_empty() {
            let [x, y, _] = points.floats(0);
            return [x, y];
        }
        [0.0; 2]
    }

    /// The bits of a point.
    pub(super) fn point_bits(&self, point: ImagePoint) -> Bits {
        match point {
            ImagePoint::Vertex(_) => self.vertex_bits(),
            ImagePoint::Crossing([a, b]) => self.line_bits(a).cross(self.line_bits(b)),
        }
    }

    fn vertex_bits(&self) -> Bits {
        let offset = self.spread + 1;
        match self.projection {
            Projection::Flat => Bits { plane: offset, weight: 1 },
            Projection::Parallel { .. } => Bits { plane: offset + self.spread + 1, weight: 1 },
            Projection::Central { .. } => Bits { plane: offset, weight: offset },
        }
    }

    /// The bits of a line.
    pub(super) fn line_bits(&self, line: ImageLine) -> Bits {
        let vertex = self.vertex_bits();
        let spread = self.spread;
        match line {
            ImageLine::Edge(_) => match self.projection {
                Projection::Central { .. } => vertex.cross(vertex),
                _ => Bits { plane: vertex.plane, weight: 2 * vertex.plane + 1 },
            },
            ImageLine::Planes(_) | ImageLine::Near(_) => {
                // A normal has two offsets, the value at the eye three; the
                // offset of the near plane as much as two coordinates.
                let normal = 2 * (spread + 1) + 1;
                let value = normal + spread + 3;
                Bits { plane: normal + value + 1, weight: 2 * value + spread + 1 }
            }
        }
    }

    /// The bits of the functionals of this chart.
    pub(super) fn key_bits(&self) -> Bits {
        match self.projection {
            Projection::Central { .. } => Bits { plane: self.spread, weight: self.spread },
            _ => Bits { plane: 1, weight: 1 },
        }
    }
}

/// `a x - b y`.
fn combined<R: Ring>(a: &[R; 3], x: &R, b: &[R; 3], y: &R) -> [R; 3] {
    [0, 1, 2].map(|i| a[i].clone() * x.clone() - b[i].clone() * y.clone())
}

/// The plane of a face: `normal . d + constant` for the offset d from the
/// eye, or from the first vertex where the eye is a direction.
struct Plane<R> {
    normal: [R; 3],
    constant: R,
}

impl<R: Ring> Plane<R> {
    fn of(points: &Points, [a, b, c]: [u32; 3]) -> Self {
        let corner = points.vertex::<R>(a);
        let normal =
            cross(difference(points.vertex(b), &corner), difference(points.vertex(c), &corner));
        let origin = if points.is_perspective() { points.eye() } else { points.vertex(0) };
        let constant = dot(normal.clone(), difference(origin, &corner));
        Plane { normal, constant }
    }

    /// The functional at the eye, point or direction.
    fn at_eye(&self, points: &Points) -> R {
        if points.is_perspective() {
            self.constant.clone()
        } else {
            dot(self.normal.clone(), points.eye())
        }
    }
}
