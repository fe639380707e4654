//! A square grid over the page, and which of its cells a segment comes near.
//!
//! Two segments that come within a distance of each other both come within
//! half of it to the point midway, so they have its cell in common. That is
//! all that is asked of the grid (Franklin 1989): it proposes, it never
//! decides.

use glam::DVec2;

/// Cells of one size from one corner on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cells {
    low: DVec2,
    inverse: f64,
    /// The number of columns and of rows.
    pub(super) count: [u32; 2],
}

/// The most cells along one side, so that their numbers are small.
const MOST: f64 = 1e6;

impl Cells {
    /// Cells of at least this size that cover a box.
    pub(super) fn new(low: DVec2, high: DVec2, size: f64) -> Self {
        let extent = (high - low).max_element().max(size);
        let size = size.max(extent / MOST);
        let along = |axis: usize| ((high - low)[axis] / size).floor().clamp(0.0, MOST) as u32 + 1;
        Cells { low, inverse: 1.0 / size, count: [along(0), along(1)] }
    }

    /// Calls `found` with column and row of every cell within `reach` of a
    /// segment, and perhaps of some more. What lies outside of the grid
    /// counts to the cells at its border.
    #[inline]
    pub(super) fn near(&self, [a, b]: [DVec2; 2], reach: f64, mut found: impl FnMut(u32, u32)) {
        let (low, high) = (a.min(b), a.max(b));
        let columns = self.range(0, low.x - reach, high.x + reach);
        let rows = self.range(1, low.y - reach, high.y + reach);
        if columns[0] == columns[1] || rows[0] == rows[1] {
            for row in rows[0]..=rows[1] {
                (columns[0]..=columns[1]).for_each(|column| found(column, row));
            }
            return;
        }
        let slope = (b.y - a.y) / (b.x - a.x);
        // Not a number where the segment is upright: then all of its rows.
        let height = |x: f64| a.y + (x - a.x) * slope;
        for column in columns[0]..=columns[1] {
            let left = self.low.x + f64::from(column) / self.inverse;
            let right = left + 1.0 / self.inverse;
            // What lies beyond the grid is in its first and last columns.
            let left = if column == 0 { low.x } else { (left - reach).clamp(low.x, high.x) };
            let last = column + 1 == self.count[0];
            let right = if last { high.x } else { (right + reach).clamp(low.x, high.x) };
            let (one, other) = (height(left), height(right));
            let (bottom, top) = (one.min(other).max(low.y), one.max(other).min(high.y));
            let [first, last] = if bottom.is_finite() && top.is_finite() && bottom <= top {
                self.range(1, bottom - reach, top + reach)
            } else {
                rows
            };
            (first..=last).for_each(|row| found(column, row));
        }
    }

    /// The corners of a cell.
    pub(super) fn bounds(&self, column: u32, row: u32) -> [DVec2; 2] {
        let corner = |column: u32, row: u32| {
            self.low + DVec2::new(f64::from(column), f64::from(row)) / self.inverse
        };
        [corner(column, row), corner(column + 1, row + 1)]
    }

    /// The cells along an axis in which a range of coordinates lies.
    #[inline]
    fn range(&self, axis: usize, low: f64, high: f64) -> [u32; 2] {
        // `as` saturates, and takes what is not a number for zero.
        let cell = |value: f64| {
            (((value - self.low[axis]) * self.inverse) as u32).min(self.count[axis] - 1)
        };
        [cell(low), cell(high)]
    }
}
