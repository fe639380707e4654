//! The angle at an edge, compared with a threshold exactly.
//!
//! Two faces meet at ab with third vertices c and d. With `e = b - a`, `m =
//! e x (c - a)` and `n = e x (d - a)` the dihedral angle seen from the third
//! vertices has cosine `m.n / (|m| |n|)`; the *fold* is what it lacks to
//! 180 degrees, and needs no orientation. The fold exceeds the threshold
//! exactly if `m.n > -cos |m| |n|`. Squared, this is the sign of
//! `(m.n)^2 - cos^2 m^2 n^2`, a polynomial of degree eight, in which the
//! cosine is an input number like any other.

use super::{Formula, Points, Policy, Predicate, Predicates};
use crate::kernel::numbers::{Ring, Sign, cross, difference, dot};

/// Binary places of a threshold's cosine.
const COSINE_BITS: i32 = 60;

/// The cosine of a fold threshold, as a multiple of `2^-60`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoldThreshold {
    cosine: f64,
}

impl FoldThreshold {
    /// The threshold of `degrees`, from 0 (every fold is a crease) to 180
    /// (none is). The cosine is rounded once, the rational ones not at all;
    /// from there on it is exact.
    pub fn from_degrees(degrees: f64) -> Self {
        let scale = f64::powi(2.0, COSINE_BITS);
        // Radians are rounded, so the cosine of a right angle would not be
        // zero.
        let cosine = match degrees {
            60.0 => 0.5,
            90.0 => 0.0,
            120.0 => -0.5,
            _ => degrees.to_radians().cos(),
        };
        FoldThreshold { cosine: (cosine * scale).round() }
    }
}

/// `m.n`, or with a threshold `(m.n)^2 - cos^2 m^2 n^2` times a square.
enum Part {
    Product,
    Excess(FoldThreshold),
}

struct FoldFormula {
    edge: [u32; 2],
    thirds: [u32; 2],
    part: Part,
}

/// `(m.n)^2 - cos^2 m^2 n^2` times the square of the threshold's unit.
#[inline(always)]
fn excess<R: Ring>(m: [R; 3], n: [R; 3], threshold: FoldThreshold) -> R {
    let one = R::read(f64::powi(2.0, COSINE_BITS), 0);
    let cosine = R::read(threshold.cosine, 0);
    let left = one * dot(m.clone(), n.clone());
    let squares = dot(m.clone(), m) * dot(n.clone(), n);
    left.clone() * left - cosine.clone() * cosine * squares
}

/// The bits of [`excess`] for normals of the second degree.
fn bits_of_excess(degree: u32, spread: u32) -> u32 {
    // Eight more for the sums of three squares each.
    degree * (spread + 2) + 8 + 2 * (COSINE_BITS as u32 + 2)
}

/// [`excess`] of the normals of two faces.
struct PlaneAngle {
    faces: [[u32; 3]; 2],
    threshold: FoldThreshold,
}

impl Formula for PlaneAngle {
    const PREDICATE: Predicate = Predicate::Fold;

    fn degree(&self) -> u32 {
        8
    }

    fn bits(&self, spread: u32) -> u32 {
        bits_of_excess(self.degree(), spread)
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let normal = |[a, b, c]: [u32; 3]| {
            let origin = points.vertex::<R>(a);
            let offset = |vertex| difference(points.vertex(vertex), &origin);
            cross(offset(b), offset(c))
        };
        let [m, n] = self.faces.map(normal);
        excess(m, n, self.threshold)
    }
}

impl Formula for FoldFormula {
    const PREDICATE: Predicate = Predicate::Fold;

    fn degree(&self) -> u32 {
        match self.part {
            Part::Product => 4,
            Part::Excess(_) => 8,
        }
    }

    fn bits(&self, spread: u32) -> u32 {
        bits_of_excess(self.degree(), spread)
    }

    #[inline(always)]
    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let origin = points.vertex::<R>(self.edge[0]);
        let offset = |vertex| difference(points.vertex(vertex), &origin);
        let (edge, c, d) = (offset(self.edge[1]), offset(self.thirds[0]), offset(self.thirds[1]));
        let m = cross(edge.clone(), c);
        let n = cross(edge, d);
        match self.part {
            Part::Product => dot(m, n),
            Part::Excess(threshold) => excess(m, n, threshold),
        }
    }
}

/// What the faces at an edge do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fold {
    /// The fold exceeds the threshold.
    pub exceeds: bool,
}

impl Fold {
    /// Measures the fold at `edge` between faces with these third vertices.
    /// Neither face may have zero area.
    #[inline]
    pub fn measure<P: Policy>(
        predicates: &Predicates<'_, P>,
        edge: [u32; 2],
        thirds: [u32; 2],
        threshold: FoldThreshold,
    ) -> Self {
        let product = predicates.decide(&FoldFormula { edge, thirds, part: Part::Product });
        let wide = threshold.cosine < 0.0;
        // Where m.n and -cos differ in sign no square is needed.
        let exceeds = match (product == Sign::Positive, wide) {
            (true, false) => true,
            (false, true) => false,
            (true, true) | (false, false) => {
                let part = Part::Excess(threshold);
                let excess = predicates.decide(&FoldFormula { edge, thirds, part });
                if wide { excess == Sign::Positive } else { excess == Sign::Negative }
            }
        };
        Fold { exceeds }
    }

    /// Measures the angle, of at most 90 degrees, at which the planes of two
    /// faces cross: of the four folds that they make the two lesser ones.
    pub fn of_planes<P: Policy>(
        predicates: &Predicates<'_, P>,
        faces: [[u32; 3]; 2],
        threshold: FoldThreshold,
    ) -> Self {
        let formula = PlaneAngle { faces, threshold };
        let exceeds = 0.0 < threshold.cosine && predicates.decide(&formula) == Sign::Negative;
        Fold { exceeds }
    }
}
