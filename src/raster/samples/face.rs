//! A triangle as the samples see it: half-planes and a depth, all affine.
//!
//! The samples that see a triangle are those inside its three silhouette
//! planes, borders included, where the ray meets it in front of the near
//! plane. These are three closed half-planes of the image and an open one
//! that is seldom needed. Along a ray, `k = S(x) / F` of
//! `kernel::predicates::ray` grows towards the eye; it is affine in the
//! sample for parallel and central rays alike (the reciprocal depth of
//! other z-buffers).
//!
//! The tie rule is part of what a sample sees: of triangles equally near,
//! the one with the least sorted corner coordinates, then of the object
//! with the lesser name.

use super::{Footprint, Form, Sampled};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, Estimate, Point, Policy, Predicates};
use crate::run::Counters;

/// What a half-plane of the image comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Origin {
    /// The silhouette plane of an edge.
    Edge(u32, u32),
    /// The near plane: not closed.
    Near,
}

/// A half-plane of the image: a form that is positive inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Border {
    /// Proposes on which side a sample lies: positive is inside.
    pub form: Form,
    origin: Origin,
}

/// A triangle that some sample may see.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// Its number in the mesh.
    pub triangle: u32,
    /// Its corners.
    pub corners: [u32; 3],
    /// Which way it faces; not zero.
    pub facing: Sign,
    /// Samples around its image.
    pub footprint: Footprint,
    /// Proposes how near it is: greater is nearer.
    pub depth: Form,
    borders: [Border; 4],
    count: u8,
}

impl Face {
    /// The half-planes whose common samples see the triangle: three, or
    /// four where the near plane cuts it.
    #[inline(always)]
    pub fn borders(&self) -> &[Border] {
        &self.borders[..usize::from(self.count)]
    }
}

/// Decides about faces at samples. One per worker.
#[derive(Debug)]
pub struct Judge<'s, P: Policy> {
    sampled: &'s Sampled<'s>,
    predicates: Predicates<'s, P>,
}

impl<'s, P: Policy> Judge<'s, P> {
    /// A judge over what the samples see.
    pub fn new(sampled: &'s Sampled<'s>) -> Self {
        Judge { sampled, predicates: Predicates::new(sampled.points()) }
    }

    /// What the predicates counted so far.
    pub fn counters(&self) -> Counters {
        self.predicates.counters()
    }

    /// A triangle with its forms; nothing if no sample can see it.
    pub fn face(&self, triangle: u32) -> Option<Face> {
        let (corners, facing) = self.sampled.triangle(triangle);
        if facing.is_zero() {
            return None;
        }
        let cut = self.near_side(corners)?;
        let footprint = self.sampled.footprint(corners)?;
        let [a, b, c] = corners;
        let towards = f64::from(facing.to_i32());
        let border = |origin| Border {
            form: Form::through(&footprint, |at| {
                let x = self.sampled.vertex(at);
                let estimate = match origin {
                    Origin::Edge(p, q) => self.predicates.side_estimate(p, q, x),
                    Origin::Near => self.predicates.in_front_estimate(x, corners),
                };
                Estimate { value: estimate.value * towards, ..estimate }
            }),
            origin,
        };
        let edges = [(a, b), (b, c), (c, a)].map(|(p, q)| border(Origin::Edge(p, q)));
        let near = if cut {
            border(Origin::Near)
        } else {
            Border { form: Form::ONE, origin: Origin::Near }
        };
        let facing_value = self.predicates.side_estimate(a, b, c);
        let depth = Form::through(&footprint, |at| {
            let plane = self.predicates.plane_estimate(corners, self.sampled.vertex(at));
            quotient(plane, facing_value)
        });
        let [first, second, third] = edges;
        let borders = [first, second, third, near];
        let count = if cut { 4 } else { 3 };
        Some(Face { triangle, corners, facing, footprint, depth, borders, count })
    }

    /// Whether the near plane cuts a triangle; nothing if it lies behind.
    fn near_side(&self, corners: [u32; 3]) -> Option<bool> {
        if !self.sampled.points().has_near_plane() {
            return Some(false);
        }
        let is_front =
            |x| self.predicates.value_sign(Cut::Near, Point::Vertex(x)) == Sign::Positive;
        match corners.map(is_front) {
            [false, false, false] => None,
            [true, true, true] => Some(false),
            _ => Some(true),
        }
    }

    /// Whether a sample lies in a half-plane of a face, proposed by `value`,
    /// which is the border's form there.
    #[inline(always)]
    pub fn is_in(&self, face: &Face, border: usize, at: [u32; 2], value: f64) -> bool {
        let bound = face.borders[border].form.bound();
        if value > bound {
            return true;
        }
        if value < -bound {
            return false;
        }
        self.is_exactly_in(face, border, at)
    }

    /// [`Self::is_in`] by the predicate.
    #[cold]
    fn is_exactly_in(&self, face: &Face, border: usize, at: [u32; 2]) -> bool {
        let x = self.sampled.vertex(at);
        match face.borders[border].origin {
            Origin::Edge(p, q) => self.predicates.side(p, q, x) != -face.facing,
            Origin::Near => self.predicates.meets_in_front(x, face.corners, face.facing),
        }
    }

    /// The same, with the proposal taken from the form.
    #[inline(always)]
    pub fn holds(&self, face: &Face, border: usize, at: [u32; 2]) -> bool {
        self.is_in(face, border, at, face.borders[border].form.at(at))
    }

    /// Whether a sample of its footprint sees a face.
    pub fn covers(&self, face: &Face, at: [u32; 2]) -> bool {
        (0..face.borders().len()).all(|border| self.holds(face, border, at))
    }

    /// Whether a face wins a sample of both footprints against another one,
    /// wherever their planes are seen there: it is nearer, or as near and
    /// first by the tie rule. Proposed by the values of the depth forms.
    #[inline(always)]
    pub fn wins(&self, first: (&Face, f64), second: (&Face, f64), at: [u32; 2]) -> bool {
        let difference = first.1 - second.1;
        // The sum of the bounds rounds by less than their last factors allow.
        let bound = first.0.depth.bound() + second.0.depth.bound();
        if difference > bound {
            return true;
        }
        if difference < -bound {
            return false;
        }
        self.exactly_wins(first.0, second.0, at)
    }

    /// [`Self::wins`] by the predicate.
    #[cold]
    fn exactly_wins(&self, first: &Face, second: &Face, at: [u32; 2]) -> bool {
        let with = |face: &Face| (face.corners, face.facing);
        let x = self.sampled.vertex(at);
        match self.predicates.nearer(x, with(first), with(second)) {
            Sign::Positive => true,
            Sign::Negative => false,
            Sign::Zero => self.sampled.precedes(first.triangle, second.triangle),
        }
    }

    /// The same, with the proposals taken from the forms.
    pub fn beats(&self, first: &Face, second: &Face, at: [u32; 2]) -> bool {
        self.wins((first, first.depth.at(at)), (second, second.depth.at(at)), at)
    }

    /// On which side of a face's plane a vertex lies: positive is behind it.
    pub fn behind(&self, face: &Face, vertex: u32) -> Sign {
        self.predicates.plane(face.corners, vertex) * face.facing
    }
}

/// `plane / facing` with its bound: off by the errors of both, relative to
/// the least that the divisor can be, and by one rounding.
fn quotient(plane: Estimate, facing: Estimate) -> Estimate {
    let least = facing.value.abs() - facing.bound;
    if least <= 0.0 || least.is_nan() {
        return Estimate { value: 0.0, bound: f64::INFINITY };
    }
    let value = plane.value / facing.value;
    let error = (plane.bound + value.abs() * facing.bound) / least;
    Estimate { value, bound: (error + value.abs() * f64::EPSILON) * (1.0 + 1e-9) }
}
