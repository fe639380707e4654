//! An order of points in which each is near the one before.
//!
//! Along Hilbert's curve (Hilbert 1891) through a grid of cells. Points that
//! are put into a triangulation in this order are found in few steps from the
//! one before, and need few edges turned. Places are rounded to cells: the order
//! costs or saves time and decides nothing else that more than one answer
//! would not leave open.

use glam::DVec2;

/// Cells along each axis: two to the power of this.
const BITS: u32 = 16;

/// The numbers of the points, along the curve; in one cell by number. O(n log n).
pub(super) fn along_hilbert_curve(points: &[DVec2]) -> Vec<u32> {
    let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = points.iter().fold(empty, |(low, high), &p| (low.min(p), high.max(p)));
    // Halves do not overflow.
    let size = (high * 0.5 - low * 0.5).max_element();
    let cells = f64::from((1 << BITS) - 1);
    let cell = |p: DVec2| {
        let place = (p * 0.5 - low * 0.5) / size * cells;
        // Conversions saturate, and make zero of what is no number.
        [place.x as u32, place.y as u32]
    };
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_by_cached_key(|&point| (place_on_curve(cell(points[point as usize])), point));
    order
}

/// How far along the curve a cell is.
fn place_on_curve([mut x, mut y]: [u32; 2]) -> u32 {
    let mut place = 0;
    for bit in (0..BITS).rev() {
        let [right, up] = [x >> bit & 1, y >> bit & 1];
        place = place << 2 | ((3 * right) ^ up);
        // Within each quarter the curve is turned, and in one mirrored.
        if up == 0 {
            if right == 1 {
                (x, y) = (!x, !y);
            }
            (x, y) = (y, x);
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_that_follow_one_another_have_a_side_in_common() {
        let corner = 8_usize;
        let mut cells: Vec<[u32; 2]> = (0..corner * corner)
            .map(|i| [i % corner, i / corner].map(|x| (x as u32) << (BITS - 3)))
            .collect();
        cells.sort_by_key(|&cell| place_on_curve(cell));
        for pair in cells.windows(2) {
            let [dx, dy] = [0, 1].map(|i| pair[0][i].abs_diff(pair[1][i]) >> (BITS - 3));
            assert_eq!(dx + dy, 1, "{pair:?}");
        }
    }

    #[test]
    fn points_of_any_size_have_an_order() {
        for size in [f64::MAX, 1.0, f64::MIN_POSITIVE * 1e-10, 0.0] {
            let points = [[1.0, 1.0], [0.0, 0.0], [0.0, -1.0], [-1.0, 1.0]];
            let points = points.map(|p| DVec2::from(p) * size);
            let mut order = along_hilbert_curve(&points);
            order.sort_unstable();
            assert_eq!(order, [0, 1, 2, 3]);
        }
    }
}
