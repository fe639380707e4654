//! Affine functions on the samples, as floats with one bound for all.
//!
//! A bracket that is linear in the sample's point is affine in column and
//! row, because the samples are an exact lattice. So three of its values
//! give all others, by additions alone (Pineda 1988 steps through edge
//! functions in this way). The three are estimates; what is added up from
//! them proposes a sign, and where the bound does not settle it, the
//! predicate itself is asked at the sample.
//!
//! The bound. Let the estimates at the corners `(0, 0)`, `(n, 0)` and
//! `(0, m)` of a footprint be off by at most `b0, b1, b2`, let `V` be the
//! largest of their absolute values and `u = 2^-53`. For a sample `(i, j)`
//! of the footprint the function is `(1 - s - t) f0 + s f1 + t f2` with
//! `s = i / n` and `t = j / m` from 0 to 1, so weights are at most 1 in
//! size and errors of the estimates contribute at most `b0 + b1 + b2`.
//! Rounding: a step is a difference of at most `2V` and a quotient, off by
//! less than `5uV / n`, and taken at most `n` times, so by `5uV` in all;
//! the same downwards. A sum along the way is at most `5V` in size and off
//! by another `6uV` for each addition; there are at most `n + 2` of them,
//! products included. Together less than
//! `b0 + b1 + b2 + (32 + 8n) u V`, and products and sums of the bound itself
//! are covered by the last factor.

use crate::kernel::predicates::Estimate;

/// A box of samples: first and last column, first and last row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Footprint {
    /// First and last column.
    pub columns: [u32; 2],
    /// First and last row.
    pub rows: [u32; 2],
}

impl Footprint {
    /// The samples in both boxes.
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        let both = |[a, b]: [u32; 2], [c, d]: [u32; 2]| [a.max(c), b.min(d)];
        let columns = both(self.columns, other.columns);
        let rows = both(self.rows, other.rows);
        (columns[0] <= columns[1] && rows[0] <= rows[1]).then_some(Footprint { columns, rows })
    }

    /// Whether all samples of `other` are in this box.
    pub fn contains(&self, other: &Self) -> bool {
        self.intersection(other) == Some(*other)
    }

    /// The four corners, as column and row.
    pub fn corners(&self) -> [[u32; 2]; 4] {
        let ([a, b], [c, d]) = (self.columns, self.rows);
        [[a, c], [b, c], [a, d], [b, d]]
    }
}

/// An affine function on the samples of a footprint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Form {
    origin: [u32; 2],
    start: f64,
    right: f64,
    down: f64,
    bound: f64,
}

/// Half the distance from 1 to the next float.
const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

impl Form {
    /// One everywhere, without any error.
    pub const ONE: Form = Form { origin: [0, 0], start: 1.0, right: 0.0, down: 0.0, bound: 0.0 };

    /// The function through estimates at samples given as column and row.
    pub fn through(footprint: &Footprint, at: impl Fn([u32; 2]) -> Estimate) -> Form {
        let ([c0, c1], [r0, r1]) = (footprint.columns, footprint.rows);
        let origin = at([c0, r0]);
        let (n, m) = (f64::from(c1 - c0), f64::from(r1 - r0));
        let side = |steps: f64, corner: [u32; 2]| if steps > 0.0 { at(corner) } else { origin };
        let (across, below) = (side(n, [c1, r0]), side(m, [c0, r1]));
        let largest = origin.value.abs().max(across.value.abs()).max(below.value.abs());
        let bounds = origin.bound + across.bound + below.bound;
        let rounding = (32.0 + 8.0 * n) * UNIT_ROUNDOFF * largest;
        Form {
            origin: [c0, r0],
            start: origin.value,
            right: (across.value - origin.value) / n.max(1.0),
            down: (below.value - origin.value) / m.max(1.0),
            // What is no number decides nothing.
            bound: if largest.is_finite() && !bounds.is_nan() {
                (bounds + rounding) * (1.0 + 1e-9)
            } else {
                f64::INFINITY
            },
        }
    }

    /// The proposal at a sample of the footprint.
    #[inline(always)]
    pub fn at(&self, [column, row]: [u32; 2]) -> f64 {
        let [c, r] = self.origin;
        self.start + f64::from(row - r) * self.down + f64::from(column - c) * self.right
    }

    /// What a step to the right adds; may be done all along a row.
    #[inline(always)]
    pub fn right(&self) -> f64 {
        self.right
    }

    /// What a step down adds.
    pub fn down(&self) -> f64 {
        self.down
    }

    /// No proposal in the footprint is farther off than this.
    #[inline(always)]
    pub fn bound(&self) -> f64 {
        self.bound
    }
}
