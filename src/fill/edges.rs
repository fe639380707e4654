//! Where the spans of an edge begin, row after row, without a division
//! (Swanson and Thayer 1986).
//!
//! An edge from (xa, ya) down to (xe, ye) crosses the centre line of row j,
//! at `y = 256 j + 128`, at `x = xa + (y - ya) dx / dy`. The first pixel
//! whose centre is at or right of that is
//!
//! ```text
//!   c = ceil((x - 128) / 256) = ceil(A / B),   A = (xa - 128) dy + (y - ya) dx
//!                                              B = 256 dy
//! ```
//!
//! From row to row A grows by `256 dx = q B + r`, `0 <= r < B`. Kept are c
//! and how much A falls short of `c B`: c grows by q and the shortfall
//! shrinks by r, which costs c one more where it would become negative.
//! Floor division keeps this right for edges that run to the left.

use super::polygon::SUBPIXELS;
use std::ops::Range;

/// Half a pixel: where the centres are.
const HALF: i64 = SUBPIXELS / 2;

/// The rows that a downward edge crosses and the first column right of it
/// in each. Half-open: an end exactly on a centre line counts at the upper
/// end of an edge and not at the lower one.
#[derive(Debug, Clone)]
pub struct SpanStarts {
    rows: Range<i64>,
    column: i64,
    shortfall: i64,
    whole: i64,
    rest: i64,
    divisor: i64,
}

impl SpanStarts {
    /// The starts of the edge between two points, in subpixels; nothing if
    /// it crosses no centre line. Coordinates below 2^27.
    pub fn new(a: [i64; 2], b: [i64; 2]) -> Option<Self> {
        let ([xa, ya], [xe, ye]) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        let row = |y: i64| (y + HALF - 1).div_euclid(SUBPIXELS);
        let rows = row(ya)..row(ye);
        if rows.is_empty() {
            return None;
        }
        let (dx, dy) = (xe - xa, ye - ya);
        let divisor = SUBPIXELS * dy;
        let y = SUBPIXELS * rows.start + HALF;
        let place = (xa - HALF) * dy + (y - ya) * dx;
        let column = -(-place).div_euclid(divisor);
        Some(SpanStarts {
            rows,
            column,
            shortfall: column * divisor - place,
            whole: (SUBPIXELS * dx).div_euclid(divisor),
            rest: (SUBPIXELS * dx).rem_euclid(divisor),
            divisor,
        })
    }

    /// The rows that are left.
    pub fn rows(&self) -> Range<i64> {
        self.rows.clone()
    }

    /// The first column at or right of the edge in the current row.
    pub fn column(&self) -> i64 {
        self.column
    }

    /// Goes on to the next row; false if there is none.
    pub fn step(&mut self) -> bool {
        self.rows.start += 1;
        self.column += self.whole;
        self.shortfall -= self.rest;
        if self.shortfall < 0 {
            self.shortfall += self.divisor;
            self.column += 1;
        }
        !self.rows.is_empty()
    }
}
