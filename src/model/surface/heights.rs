//! Heights over the points of a grid, some of which may be missing.

use super::SurfaceError;
use std::ops::Range;

/// Heights at the points of a grid. Rows have one z each; z grows from row
/// to row and x from column to column.
#[derive(Debug, Clone, PartialEq)]
pub struct Heights {
    xs: Vec<f64>,
    zs: Vec<f64>,
    /// Row by row; not a number where there is none.
    values: Vec<f64>,
}

/// A part of a grid: what is left after missing heights were cut off.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rectangle {
    /// The columns, counted from 0.
    pub columns: Range<usize>,
    /// The rows, counted from 0.
    pub rows: Range<usize>,
}

/// The most points of a grid: three lines each have to be numbered.
const MOST: usize = 1_000_000_000;

impl Heights {
    /// A grid; heights that are not finite count as missing.
    ///
    /// # Errors
    ///
    /// If there are fewer than two columns or rows, coordinates that do not
    /// grow, or not as many heights as points.
    pub fn new(xs: Vec<f64>, zs: Vec<f64>, mut values: Vec<f64>) -> Result<Self, SurfaceError> {
        let (columns, rows) = (xs.len(), zs.len());
        check_size(columns, rows)?;
        if values.len() != columns * rows {
            return Err(SurfaceError::WrongCount { columns, rows, found: values.len() });
        }
        check_growing('x', &xs)?;
        check_growing('z', &zs)?;
        for value in &mut values {
            if !value.is_finite() {
                *value = f64::NAN;
            }
        }
        Ok(Heights { xs, zs, values })
    }

    /// `count` coordinates at equal distances from `from` to `to`, each
    /// rounded once.
    ///
    /// # Errors
    ///
    /// If that is fewer than two, or more than there are doubles between.
    pub fn steps(axis: char, [from, to]: [f64; 2], count: usize) -> Result<Vec<f64>, SurfaceError> {
        if count < 2 {
            return Err(SurfaceError::TooSmall { columns: count, rows: count });
        }
        let last = (count - 1) as f64;
        let at = |i: usize| {
            let share = i as f64 / last;
            if i + 1 == count { to } else { from + (to - from) * share }
        };
        let steps: Vec<f64> = (0..count).map(at).collect();
        match steps.windows(2).all(|pair| pair[0] < pair[1]) {
            true => Ok(steps),
            false => Err(SurfaceError::TooFine { axis, from, to, count }),
        }
    }

    /// x of the columns.
    pub fn xs(&self) -> &[f64] {
        &self.xs
    }

    /// z of the rows.
    pub fn zs(&self) -> &[f64] {
        &self.zs
    }

    /// All heights, row by row; not a number where there is none.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The same heights over other places.
    ///
    /// # Errors
    ///
    /// As [`Heights::new`].
    pub fn moved(self, xs: Vec<f64>, zs: Vec<f64>) -> Result<Self, SurfaceError> {
        Heights::new(xs, zs, self.values)
    }

    /// All heights times a factor, each rounded once.
    ///
    /// # Errors
    ///
    /// If one becomes infinite.
    pub fn scaled(mut self, scale: f64) -> Result<Self, SurfaceError> {
        for value in &mut self.values {
            let height = *value;
            *value *= scale;
            if height.is_finite() && !value.is_finite() {
                return Err(SurfaceError::Overflow { height, scale });
            }
        }
        Ok(self)
    }

    /// The number of missing heights.
    pub fn missing(&self) -> usize {
        self.values.iter().filter(|value| value.is_nan()).count()
    }

    /// Refuses a grid with missing heights. O(n).
    ///
    /// # Errors
    ///
    /// If one is missing; the error names the first.
    pub fn check_complete(&self) -> Result<(), SurfaceError> {
        let Some(first) = self.values.iter().position(|value| value.is_nan()) else {
            return Ok(());
        };
        let (row, column) = (first / self.xs.len(), first % self.xs.len());
        Err(SurfaceError::Missing {
            missing: self.missing(),
            points: self.values.len(),
            x: self.xs[column],
            z: self.zs[row],
            column: column + 1,
            row: row + 1,
        })
    }

    /// The largest rectangle of the grid without missing heights, and which
    /// it is; of equally large ones that which ends first. O(n).
    ///
    /// # Errors
    ///
    /// If not even 2 x 2 points are left.
    pub fn cut_to_complete(self) -> Result<(Self, Rectangle), SurfaceError> {
        let columns = self.xs.len();
        // Above each point of a row, how many rows are complete: the
        // largest rectangle under that histogram ends in this row.
        let mut above = vec![0_usize; columns];
        let mut best: Option<(usize, Rectangle)> = None;
        for row in 0..self.zs.len() {
            for (column, run) in above.iter_mut().enumerate() {
                *run = if self.values[row * columns + column].is_nan() { 0 } else { *run + 1 };
            }
            for (columns, height) in rectangles_under(&above) {
                let area = columns.len() * height;
                let wide = columns.len() >= 2 && height >= 2;
                if wide && best.as_ref().is_none_or(|(most, _)| *most < area) {
                    best = Some((area, Rectangle { columns, rows: row + 1 - height..row + 1 }));
                }
            }
        }
        let Some((_, cut)) = best else {
            return Err(SurfaceError::NothingLeft);
        };
        let row = |row: usize| &self.values[row * columns..][cut.columns.clone()];
        let values = cut.rows.clone().flat_map(|j| row(j).iter().copied()).collect();
        let xs = self.xs[cut.columns.clone()].to_vec();
        Ok((Heights::new(xs, self.zs[cut.rows.clone()].to_vec(), values)?, cut))
    }
}

/// Every rectangle under a histogram that cannot be made wider, as its
/// columns and its height.
fn rectangles_under(histogram: &[usize]) -> Vec<(Range<usize>, usize)> {
    let mut found = Vec::new();
    // Rising steps: where each began, and its height.
    let mut steps: Vec<(usize, usize)> = Vec::new();
    for column in 0..=histogram.len() {
        let height = histogram.get(column).copied().unwrap_or(0);
        let mut start = column;
        while let Some(&(begin, high)) = steps.last()
            && height <= high
        {
            steps.pop();
            found.push((begin..column, high));
            start = begin;
        }
        steps.push((start, height));
    }
    found
}

fn check_size(columns: usize, rows: usize) -> Result<(), SurfaceError> {
    if columns < 2 || rows < 2 {
        return Err(SurfaceError::TooSmall { columns, rows });
    }
    match columns.checked_mul(rows) {
        Some(points) if points <= MOST => Ok(()),
        _ => Err(SurfaceError::TooLarge { columns, rows }),
    }
}

fn check_growing(axis: char, list: &[f64]) -> Result<(), SurfaceError> {
    let grows = |pair: &&[f64]| !(pair[0] < pair[1] && pair[0].is_finite() && pair[1].is_finite());
    match list.windows(2).find(grows) {
        Some(pair) => Err(SurfaceError::NotGrowing { axis, before: pair[0], next: pair[1] }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn grid(rows: &[&[f64]]) -> Heights {
        let steps = |count: usize| (0..count).map(|i| i as f64).collect::<Vec<_>>();
        Heights::new(steps(rows[0].len()), steps(rows.len()), rows.concat()).unwrap()
    }

    const GAP: f64 = f64::NAN;

    #[test]
    fn the_first_missing_height_is_named() {
        let grid = grid(&[&[1.0, 2.0, 3.0], &[4.0, f64::INFINITY, GAP]]);
        assert_eq!(
            grid.check_complete().unwrap_err().to_string(),
            "2 of 6 heights are missing, the first at x = 1, z = 1 (column 2, row 2): expected a \
             height everywhere"
        );
    }

    #[test]
    fn missing_heights_are_cut_off_with_as_little_as_can_be() {
        let whole = grid(&[
            &[GAP, 1.0, 2.0, 3.0],
            &[4.0, 5.0, 6.0, 7.0],
            &[8.0, 9.0, 10.0, 11.0],
            &[12.0, 13.0, 14.0, GAP],
        ]);
        let (left, cut) = whole.cut_to_complete().unwrap();
        assert_eq!(cut, Rectangle { columns: 1..4, rows: 0..3 });
        assert_eq!(left.values(), [1.0, 2.0, 3.0, 5.0, 6.0, 7.0, 9.0, 10.0, 11.0]);
        assert_eq!((left.xs(), left.zs()), (&[1.0, 2.0, 3.0][..], &[0.0, 1.0, 2.0][..]));
        let lost = grid(&[&[1.0, GAP], &[GAP, 1.0]]);
        assert_eq!(lost.cut_to_complete(), Err(SurfaceError::NothingLeft));
    }

    #[test]
    fn coordinates_that_do_not_grow_are_refused() {
        let found = Heights::new(vec![0.0, 1.0, 1.0], vec![0.0, 1.0], vec![0.0; 6]);
        let expected = "x is 1 after 1: expected growing finite coordinates";
        assert_eq!(found.unwrap_err().to_string(), expected);
        let found = Heights::steps('z', [1.0, 1.0 + f64::EPSILON], 3);
        assert!(matches!(found, Err(SurfaceError::TooFine { count: 3, .. })));
        assert_eq!(Heights::steps('x', [-1.0, 1.0], 3).unwrap(), [-1.0, 0.0, 1.0]);
    }

    proptest! {
        #[test]
        fn no_larger_rectangle_is_complete(
            gaps in prop::collection::vec(prop::bool::weighted(0.2), 35),
        ) {
            let values: Vec<f64> = gaps.iter().map(|&gap| if gap { GAP } else { 1.0 }).collect();
            let rows: Vec<&[f64]> = values.chunks(7).collect();
            let mut best = 0;
            for (a, b) in (0..7).flat_map(|a| (a + 2..=7).map(move |b| (a, b))) {
                for (c, d) in (0..5).flat_map(|c| (c + 2..=5).map(move |d| (c, d))) {
                    if rows[c..d].iter().all(|row| row[a..b].iter().all(|v| v.is_finite())) {
                        best = best.max((b - a) * (d - c));
                    }
                }
            }
            match grid(&rows).cut_to_complete() {
                Ok((left, _)) => {
                    prop_assert_eq!(left.values().len(), best);
                    prop_assert_eq!(left.missing(), 0);
                }
                Err(_) => prop_assert_eq!(best, 0),
            }
        }
    }
}
