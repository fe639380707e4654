//! Flag fill (Ackland and Weste 1981): a flag at the pixel right of each
//! crossing, then one sweep along each row that is inside after an odd
//! number of flags. Two flags at one pixel cancel each other. There is no
//! table and no order of edges.

use super::edges::SpanStarts;
use super::polygon::Contours;

/// Whether each pixel of a window of `width` x `height` pixels is inside
/// contours by the even-odd rule, row by row. O(edges' rows + pixels).
pub fn flag_fill(contours: &Contours, width: u32, height: u32) -> Vec<bool> {
    let (columns, rows) = (width as usize, i64::from(height));
    // One more column for crossings right of the window.
    let mut flags = vec![false; (columns + 1) * height as usize];
    for [a, b] in contours.edges() {
        let Some(mut starts) = SpanStarts::new(a, b) else {
            continue;
        };
        loop {
            let row = starts.rows().start;
            if (0..rows).contains(&row) {
                let column = starts.column().clamp(0, i64::from(width)) as usize;
                flags[row as usize * (columns + 1) + column] ^= true;
            }
            if !starts.step() {
                break;
            }
        }
    }
    let mut inside = Vec::with_capacity(columns * height as usize);
    for row in flags.chunks_exact(columns + 1) {
        let mut is_inside = false;
        inside.extend(row[..columns].iter().map(|flag| {
            is_inside ^= flag;
            is_inside
        }));
    }
    inside
}
