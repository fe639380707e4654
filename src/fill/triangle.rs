//! Triangles by edge functions (Pineda 1988), and polygons made of them.
//!
//! `e(x, y) = (bx - ax)(y - ay) - (by - ay)(x - ax)` is affine: one addition
//! takes it to the next pixel. Inside all three have the sign of the area.
//! Where one is zero, the centre lies on an edge and belongs to the triangle
//! if that is a left or a level top edge: the same rule as that of spans.
//!
//! For a polygon, any point A and all edges PQ: a point is in an odd number
//! of the triangles APQ if it is inside by the even-odd rule. So inverting
//! one triangle after the other fills the polygon, in any order and with no
//! list at all.

use super::polygon::{Contours, SUBPIXELS};
use std::ops::Range;

/// Calls `pixel` with column and row of each pixel in a triangle given in
/// subpixels, y downwards, and in a window. Exact; neighbours share none.
pub fn fill_triangle(
    corners: [[i64; 2]; 3],
    window: [Range<i64>; 2],
    mut pixel: impl FnMut(i64, i64),
) {
    let [a, b, c] = corners;
    let area = edge_function(a, b, c);
    if area == 0 {
        return;
    }
    // Turned so that the functions are positive inside.
    let [a, b, c] = if area > 0 { [a, b, c] } else { [a, c, b] };
    let edges = [(a, b), (b, c), (c, a)];
    // With y downwards, a left edge of such a triangle runs up, and a level
    // top edge runs to the right. Where an edge does not own its centres,
    // its function has to be one at least.
    let least = edges.map(|(p, q)| {
        let owns = q[1] < p[1] || (q[1] == p[1] && p[0] < q[0]);
        i64::from(!owns)
    });
    let range = |axis: usize| {
        let coordinates = [a, b, c].map(|p| p[axis]);
        let [mut low, mut high] = [coordinates[0]; 2];
        for x in coordinates {
            (low, high) = (low.min(x), high.max(x));
        }
        let limits = &window[axis];
        low.div_euclid(SUBPIXELS).max(limits.start)
            ..(high.div_euclid(SUBPIXELS) + 1).min(limits.end)
    };
    let (columns, rows) = (range(0), range(1));
    for row in rows {
        let centre = |column: i64| [column, row].map(|i| i * SUBPIXELS + SUBPIXELS / 2);
        let mut values = edges.map(|(p, q)| edge_function(p, q, centre(columns.start)));
        for column in columns.clone() {
            if (0..3).all(|k| values[k] >= least[k]) {
                pixel(column, row);
            }
            for (value, (p, q)) in values.iter_mut().zip(edges) {
                *value -= (q[1] - p[1]) * SUBPIXELS;
            }
        }
    }
}

/// Twice the area of a triangle: positive where it turns clockwise on the
/// page, for y points down.
fn edge_function(a: [i64; 2], b: [i64; 2], p: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// Whether each pixel of a window of `width` x `height` pixels is inside
/// contours by the even-odd rule, row by row: one inverted triangle for
/// each edge. O(edges x pixels).
pub fn xor_fill(contours: &Contours, width: u32, height: u32) -> Vec<bool> {
    let mut inside = vec![false; width as usize * height as usize];
    let Some([anchor, _]) = contours.edges().next() else {
        return inside;
    };
    let window = [0..i64::from(width), 0..i64::from(height)];
    for [p, q] in contours.edges() {
        fill_triangle([anchor, p, q], window.clone(), |column, row| {
            inside[row as usize * width as usize + column as usize] ^= true;
        });
    }
    inside
}
