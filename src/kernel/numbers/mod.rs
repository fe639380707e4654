//! Numbers on which a formula can be evaluated: plain floats, floats with
//! a proven error bound, integers of fixed width and big integers.
//!
//! A predicate is the sign of a polynomial in the input coordinates. The
//! polynomial is written once, generic over [`Ring`], and evaluated with
//! one number type after the other until the sign is certain: first
//! [`Filtered`], then a [`SmallInteger`] or [`FixedInteger`] that is wide
//! enough, then [`Dyadic`]. All rounding analysis of the crate is in [`Filtered`].

mod big;
mod dyadic;
mod filtered;
mod fixed;
mod fraction;
mod quotient;
mod residue;
mod sign;
mod significand;
mod small;

pub use big::BigInteger;
pub(crate) use big::scale_by_power_of_two;
pub use dyadic::Dyadic;
pub use filtered::Filtered;
pub use fixed::FixedInteger;
pub use fraction::Fraction;
pub(crate) use residue::Residue;
pub use sign::Sign;
pub(crate) use significand::Significand;
pub use small::SmallInteger;

use std::ops::{Add, Mul, Neg, Sub};

/// A commutative ring in which the scene's coordinates can be read.
///
/// Coordinates are integers once the scene is scaled by a power of two.
/// Scenes whose coordinates span too many binary orders are not scaled;
/// then a coordinate is an integer times `2^unit`, and only
/// [`Dyadic`] and [`BigInteger`] read it exactly.
pub trait Ring:
    Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// The number `value / 2^unit`, which is an integer.
    fn read(value: f64, unit: i32) -> Self;

    /// Whether pieces of formulas are written out where they are used.
    const IN_PLACE: bool;

    /// Does work in a function of its own.
    #[inline(never)]
    fn apart<T>(work: impl FnOnce() -> T) -> T {
        work()
    }
}

/// The value of a piece that many formulas have. Floats compute it in its
/// place, where a call would cost more than the work; integers call it, for
/// their code is long and would stand again wherever the piece does.
macro_rules! piece {
    ($ring:ty, $work:expr) => {
        if <$ring as $crate::kernel::numbers::Ring>::IN_PLACE {
            $work
        } else {
            <$ring as $crate::kernel::numbers::Ring>::apart(|| $work)
        }
    };
}
pub(crate) use piece;

impl Ring for f64 {
    const IN_PLACE: bool = true;

    #[inline(always)]
    fn read(value: f64, _unit: i32) -> Self {
        value
    }
}

/// `a . (b x c)`: the determinant of three rows.
#[inline(always)]
pub fn determinant3<R: Ring>(a: [R; 3], b: [R; 3], c: [R; 3]) -> R {
    let [ax, ay, az] = a;
    let [bx, by, bz] = b;
    let [cx, cy, cz] = c;
    let x = by.clone() * cz.clone() - bz.clone() * cy.clone();
    let y = bz * cx.clone() - bx.clone() * cz;
    let z = bx * cy - by * cx;
    ax * x + ay * y + az * z
}

/// `a - b`, component by component.
#[inline(always)]
pub fn difference<R: Ring>(a: [R; 3], b: &[R; 3]) -> [R; 3] {
    let [ax, ay, az] = a;
    [ax - b[0].clone(), ay - b[1].clone(), az - b[2].clone()]
}

/// `a . b`.
#[inline(always)]
pub fn dot<R: Ring>(a: [R; 3], b: [R; 3]) -> R {
    let [ax, ay, az] = a;
    let [bx, by, bz] = b;
    ax * bx + ay * by + az * bz
}

/// `a x b`.
#[inline(always)]
pub fn cross<R: Ring>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    let [ax, ay, az] = a;
    let [bx, by, bz] = b;
    [
        ay.clone() * bz.clone() - az.clone() * by.clone(),
        az * bx.clone() - ax.clone() * bz,
        ax * by - ay * bx,
    ]
}
