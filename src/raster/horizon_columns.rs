//! The floating horizon as it was published: two arrays with an entry for
//! each column of pixels (Wright 1973; Rogers, "Procedural Elements for
//! Computer Graphics", section 4-2).
//!
//! A line is looked at in the middle of every column it passes, by linear
//! interpolation where a step goes over more than one, and at its ends. It is
//! visible where it is above the upper entry or below the lower one, or where
//! the column has none; between two looks it changes where the interpolated
//! difference vanishes. Then the entries are moved to it. A line that passes
//! no middle counts in the column where it is.
//!
//! In floats and for parallel rays only: this is what the exact horizon is
//! held against, and a picture of `columns` columns is all that it knows. What
//! is narrower than a column may be lost.
//!
//! O(points + columns passed).

use crate::kernel::predicates::Eye;
use crate::model::surface::Surface;
use crate::run::{Cancelled, Run};
use crate::view::SurfaceQuestion;
use glam::{DVec2, DVec3};

/// Why there is no answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum ColumnsError {
    /// Columns of a central view are not columns of its picture.
    #[error("the view is a perspective: expected parallel rays")]
    Perspective,
    /// Rays along the vertical have no columns.
    #[error("the eye looks straight down or up: expected another direction")]
    Vertical,
    /// The run was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// What the arrays find.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnPieces {
    /// The width of a column, world units.
    pub width: f64,
    /// For each drawn line its visible pieces, from 0 at its first vertex to
    /// 1 at its second.
    pub lines: Vec<Vec<[f64; 2]>>,
}

/// Finds the visible pieces of all drawn lines; bases are not drawn.
///
/// # Errors
///
/// If the rays are not parallel or vertical, or the run is cancelled.
pub fn horizon_columns(
    question: &SurfaceQuestion<'_>,
    columns: u32,
    run: &Run<'_>,
) -> Result<ColumnPieces, ColumnsError> {
    let Eye::Towards(towards) = question.view.eye else {
        return Err(ColumnsError::Perspective);
    };
    let ground = -towards.truncate();
    if ground == DVec2::ZERO {
        return Err(ColumnsError::Vertical);
    }
    let right = DVec3::new(ground.y, -ground.x, 0.0).normalize();
    let up = right.cross(-towards.normalize());
    let place = |p: DVec3| DVec2::new(p.dot(right), p.dot(up));
    let points: Vec<DVec2> = question.surface.vertices().into_iter().map(place).collect();
    let empty = (f64::INFINITY, f64::NEG_INFINITY);
    let (left, end) = points.iter().fold(empty, |(l, r), p| (l.min(p.x), r.max(p.x)));
    let width = (end - left) / f64::from(columns.max(2) - 1);
    let mut arrays = Arrays {
        upper: vec![f64::NEG_INFINITY; columns.max(2) as usize],
        lower: vec![f64::INFINITY; columns.max(2) as usize],
    };
    let mut lines = vec![Vec::new(); question.curves.len()];
    // z of a surface is -y of the world.
    for segment in front_to_back(question.surface, [ground.x, -ground.y]) {
        run.check()?;
        let [a, b] = [segment[0].min(segment[1]), segment[0].max(segment[1])];
        let ends = [a, b].map(|vertex| {
            let point = points[vertex as usize];
            DVec2::new((point.x - left) / width, point.y)
        });
        let pieces = arrays.take(ends);
        if let Some(line) = question.curves.line([a, b]) {
            lines[line as usize] = pieces;
        }
    }
    Ok(ColumnPieces { width, lines })
}

/// Highest and lowest values so far, in the middles of columns.
struct Arrays {
    upper: Vec<f64>,
    lower: Vec<f64>,
}

/// A place of a line: how far along it is, and how far beyond the upper and
/// the lower entries.
#[derive(Clone, Copy)]
struct Look {
    at: f64,
    above: f64,
    below: f64,
}

impl Arrays {
    /// The visible pieces of a line from one place to another, in columns;
    /// then the entries are moved.
    fn take(&mut self, [a, b]: [DVec2; 2]) -> Vec<[f64; 2]> {
        let span = (b.x - a.x).abs();
        let upright = span < 1e-9;
        let (low, high) = (a.x.min(b.x), a.x.max(b.x));
        let mut shares = vec![0.0, 1.0];
        let mut middles = Vec::new();
        if !upright {
            let (first, last) = (low.ceil() as usize, high.floor().max(0.0) as usize);
            for column in first..=last.min(self.upper.len() - 1) {
                if column as f64 >= low {
                    let share = ((column as f64 - a.x) / (b.x - a.x)).clamp(0.0, 1.0);
                    middles.push((column, value(a.y, b.y, share)));
                    shares.push(share);
                }
            }
        }
        shares.sort_by(f64::total_cmp);
        shares.dedup();
        let looks: Vec<Look> = if upright {
            // Its ends, and where the entries are.
            let ends = [a, b].map(|end| self.look(end.x, end.y));
            ends.into_iter().zip([0.0, 1.0]).map(|(look, at)| Look { at, ..look }).collect()
        } else {
            let at = |&at: &f64| Look { at, ..self.look(value(a.x, b.x, at), value(a.y, b.y, at)) };
            shares.iter().map(at).collect()
        };
        let mut pieces = Vec::new();
        for pair in looks.windows(2) {
            between(pair[0], pair[1], &mut pieces);
        }
        if !upright {
            if middles.is_empty() {
                let middle = (a + b) / 2.0;
                middles.push((self.nearest(middle.x), middle.y));
            }
            for (column, height) in middles {
                self.upper[column] = self.upper[column].max(height);
                self.lower[column] = self.lower[column].min(height);
            }
        }
        pieces
    }

    fn nearest(&self, place: f64) -> usize {
        (place.round().max(0.0) as usize).min(self.upper.len() - 1)
    }

    /// How far a height is beyond the entries at a place, interpolated.
    fn look(&self, place: f64, height: f64) -> Look {
        let share = place - place.floor();
        let left = (place.floor().max(0.0) as usize).min(self.upper.len() - 1);
        let right = (left + 1).min(self.upper.len() - 1);
        let entry = |list: &[f64]| match (list[left], list[right]) {
            (known, other) if share == 0.0 || !other.is_finite() => known,
            (other, known) if !other.is_finite() => known,
            (from, to) => value(from, to, share),
        };
        Look { at: 0.0, above: height - entry(&self.upper), below: entry(&self.lower) - height }
    }
}

/// Between two values.
fn value(from: f64, to: f64, share: f64) -> f64 {
    if share == 1.0 { to } else { from + (to - from) * share }
}

/// Appends what is visible between two looks.
fn between(from: Look, to: Look, pieces: &mut Vec<[f64; 2]>) {
    let along = |share: f64| value(from.at, to.at, share);
    let mut found: Vec<[f64; 2]> = Vec::new();
    for [a, b] in [[from.above, to.above], [from.below, to.below]] {
        // Where a column has no entry the difference is infinite, and the
        // change is taken to be half way.
        let zero = if a.is_finite() && b.is_finite() { a / (a - b) } else { 0.5 };
        match (a >= 0.0, b >= 0.0) {
            (true, true) => found.push([from.at, to.at]),
            (true, false) => found.push([from.at, along(zero)]),
            (false, true) => found.push([along(zero), to.at]),
            (false, false) => {}
        }
    }
    found.sort_by(|a, b| a[0].total_cmp(&b[0]));
    for [start, end] in found {
        match pieces.last_mut() {
            Some(last) if start <= last[1] => last[1] = last[1].max(end),
            _ if start < end => pieces.push([start, end]),
            _ => {}
        }
    }
}

/// The sides and diagonals of all cells, for rays that run along `ground`:
/// nearer ones first in every column.
fn front_to_back(surface: &Surface, [dx, dz]: [f64; 2]) -> Vec<[u32; 2]> {
    // Rows are those that rays cross.
    let by_z = dz != 0.0;
    let (deep, wide) = if by_z { (dz, dx) } else { (dx, 0.0) };
    let (columns, rows) = (surface.columns(), surface.rows());
    let (lines, places) = if by_z { (rows, columns) } else { (columns, rows) };
    let place = |i: u32| if wide < 0.0 { places - 1 - i } else { i };
    let line = |j: u32| if deep < 0.0 { lines - 1 - j } else { j };
    let vertex = |i, j| {
        let (i, j) = (place(i), line(j));
        if by_z { surface.vertex(i, j) } else { surface.vertex(j, i) }
    };
    let same_way = (wide < 0.0) == (deep < 0.0);
    let diagonal = |i, j| {
        if same_way {
            [vertex(i, j), vertex(i + 1, j + 1)]
        } else {
            [vertex(i + 1, j), vertex(i, j + 1)]
        }
    };
    let mut order = Vec::new();
    for j in 0..lines - 1 {
        if wide == 0.0 {
            order.extend((0..places - 1).map(|i| [vertex(i, j), vertex(i + 1, j)]));
            order.extend((0..places).map(|i| [vertex(i, j), vertex(i, j + 1)]));
            order.extend((0..places - 1).map(|i| diagonal(i, j)));
        } else {
            for i in 0..places - 1 {
                order.push([vertex(i, j), vertex(i + 1, j)]);
                order.push([vertex(i, j), vertex(i, j + 1)]);
                order.push(diagonal(i, j));
            }
            order.push([vertex(places - 1, j), vertex(places - 1, j + 1)]);
        }
    }
    order.extend((0..places - 1).map(|i| [vertex(i, lines - 1), vertex(i + 1, lines - 1)]));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_over_many_columns_is_interpolated() {
        let mut arrays =
            Arrays { upper: vec![f64::NEG_INFINITY; 9], lower: vec![f64::INFINITY; 9] };
        assert_eq!(arrays.take([DVec2::ZERO, DVec2::new(8.0, 4.0)]), [[0.0, 1.0]]);
        assert_eq!(arrays.upper[3], 1.5);
        // Falls from above to below the first: visible but for a point.
        let pieces = arrays.take([DVec2::new(0.0, 4.0), DVec2::new(8.0, 0.0)]);
        assert_eq!(pieces, [[0.0, 1.0]]);
        // Now there is a bow tie, and what lies in it is hidden.
        let pieces = arrays.take([DVec2::new(0.0, 2.0), DVec2::new(8.0, 2.0)]);
        assert_eq!(pieces, [[0.0; 2]; 0]);
        let pieces = arrays.take([DVec2::new(0.0, 3.0), DVec2::new(8.0, 3.0)]);
        assert_eq!(pieces, [[0.25, 0.75]]);
    }
}
