//! Polygons by edge table and active edge table.
//!
//! The global edge table holds each edge under the first row that it
//! crosses. Rows are walked from the top: edges that begin are taken into
//! the active ones, edges that end leave them, the rest move on by their
//! increments; sorted by column they bound the spans. Level edges cross no
//! centre line and are never entered. What lies between two active edges is
//! inside by the number of edges to the left (even-odd) or by their sense
//! (winding).
//!
//! O(edges log edges + rows x active edges).

use super::edges::SpanStarts;
use glam::DVec2;
use std::ops::Range;

/// Steps of a coordinate in a pixel.
pub const SUBPIXELS: i64 = 256;

/// Coordinates beyond are cut off, in subpixels: 2^26.
const FARTHEST: f64 = 67_108_864.0;

/// What of a polygon that overlaps itself is inside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// What an odd number of edges divides from the outside.
    EvenOdd,
    /// What the edges go round.
    Winding,
}

/// Closed contours in subpixels, y downwards.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Contours {
    points: Vec<[i64; 2]>,
    ends: Vec<usize>,
}

impl Contours {
    /// Appends a contour given in pixels, snapped to subpixels.
    pub fn push(&mut self, points: impl IntoIterator<Item = DVec2>) {
        let snap = |x: f64| (x * SUBPIXELS as f64).round().clamp(-FARTHEST, FARTHEST) as i64;
        self.points.extend(points.into_iter().map(|p| [snap(p.x), snap(p.y)]));
        self.ends.push(self.points.len());
    }

    /// All edges, each from its beginning to its end.
    pub fn edges(&self) -> impl Iterator<Item = [[i64; 2]; 2]> + '_ {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).flat_map(|(start, &end)| {
            let ring = &self.points[start..end];
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|(&a, &b)| [a, b])
        })
    }
}

/// An edge that the current row crosses.
struct Active {
    starts: SpanStarts,
    /// +1 downwards, -1 upwards.
    sense: i32,
}

/// Calls `span` with the row and the columns of every span inside the
/// contours, rows from the top, spans from the left. Each pixel once.
pub fn fill_polygon(contours: &Contours, rule: Rule, mut span: impl FnMut(i64, Range<i64>)) {
    let mut table: Vec<Active> = contours
        .edges()
        .filter_map(|[a, b]| {
            let starts = SpanStarts::new(a, b)?;
            Some(Active { starts, sense: if a[1] < b[1] { 1 } else { -1 } })
        })
        .collect();
    // Taken from the end, so the first row comes last.
    table.sort_by_key(|edge| std::cmp::Reverse(edge.starts.rows().start));
    let mut active: Vec<Active> = Vec::new();
    let Some(mut row) = table.last().map(|edge| edge.starts.rows().start) else {
        return;
    };
    while !active.is_empty() || !table.is_empty() {
        if let (true, Some(next)) = (active.is_empty(), table.last()) {
            row = next.starts.rows().start;
        }
        while let Some(edge) = table.pop_if(|edge| edge.starts.rows().start == row) {
            active.push(edge);
        }
        // Nearly sorted already: from row to row few edges change places.
        active.sort_by_key(|edge| edge.starts.column());
        spans_of_row(&active, rule, |columns| span(row, columns));
        active.retain_mut(|edge| edge.starts.step());
        row += 1;
    }
}

/// The spans between the sorted edges of a row.
fn spans_of_row(active: &[Active], rule: Rule, mut span: impl FnMut(Range<i64>)) {
    let mut count = 0;
    let mut start = None;
    for edge in active {
        count += match rule {
            Rule::EvenOdd => 1,
            Rule::Winding => edge.sense,
        };
        let inside = match rule {
            Rule::EvenOdd => count % 2 == 1,
            Rule::Winding => count != 0,
        };
        let column = edge.starts.column();
        match (inside, start) {
            (true, None) => start = Some(column),
            (false, Some(first)) => {
                if first < column {
                    span(first..column);
                }
                start = None;
            }
            _ => {}
        }
    }
}
