//! The outcome of a predicate: negative, zero or positive, and nothing else.

use std::cmp::Ordering;
use std::ops::{Mul, Neg};

/// A sign. Predicates return this and never a number, so that nobody can
/// compare it with a tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(i8)]
pub enum Sign {
    /// Below zero.
    Negative = -1,
    /// Exactly zero.
    Zero = 0,
    /// Above zero.
    Positive = 1,
}

impl Sign {
    /// The sign of a float that is not NaN (NaN counts as zero: only the
    /// measuring policies can meet one).
    #[inline(always)]
    pub fn of(value: f64) -> Self {
        if value > 0.0 {
            Sign::Positive
        } else if value < 0.0 {
            Sign::Negative
        } else {
            Sign::Zero
        }
    }

    /// Whether this is exactly zero.
    #[inline(always)]
    pub fn is_zero(self) -> bool {
        self == Sign::Zero
    }

    /// Whether both are non-zero and differ.
    #[inline(always)]
    pub fn is_opposite(self, other: Sign) -> bool {
        (self as i8) * (other as i8) < 0
    }

    /// This sign, or `other` where this one is zero: the germ rule.
    #[inline(always)]
    pub fn or(self, other: Sign) -> Sign {
        if self.is_zero() { other } else { self }
    }

    /// -1, 0 or 1.
    #[inline(always)]
    pub fn to_i32(self) -> i32 {
        self as i8 as i32
    }
}

impl Neg for Sign {
    type Output = Sign;

    #[inline(always)]
    fn neg(self) -> Sign {
        match self {
            Sign::Negative => Sign::Positive,
            Sign::Zero => Sign::Zero,
            Sign::Positive => Sign::Negative,
        }
    }
}

impl Mul for Sign {
    type Output = Sign;

    #[inline(always)]
    fn mul(self, other: Sign) -> Sign {
        match (self as i8) * (other as i8) {
            1 => Sign::Positive,
            -1 => Sign::Negative,
            _ => Sign::Zero,
        }
    }
}

impl From<Ordering> for Sign {
    fn from(ordering: Ordering) -> Sign {
        match ordering {
            Ordering::Less => Sign::Negative,
            Ordering::Equal => Sign::Zero,
            Ordering::Greater => Sign::Positive,
        }
    }
}

impl From<Sign> for Ordering {
    fn from(sign: Sign) -> Ordering {
        match sign {
            Sign::Negative => Ordering::Less,
            Sign::Zero => Ordering::Equal,
            Sign::Positive => Ordering::Greater,
        }
    }
}
