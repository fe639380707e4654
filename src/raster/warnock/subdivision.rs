//! Where a window is cut.
//!
//! Cuts run between samples, so every window is a box of whole samples.
//! Where they run decides how many windows there are, and nothing about
//! what is seen: floats may choose.

use crate::raster::samples::Footprint;
use glam::DVec2;

/// How windows are cut into smaller ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subdivision {
    /// In the middle.
    Regular,
    /// Beside the corner of a polygon that is nearest to the middle; in the
    /// middle where no corner lies inside.
    Vertex,
}

/// The parts of a window, cut in the middle.
pub(super) fn in_the_middle(window: &Footprint) -> Vec<Footprint> {
    let middle = |[first, last]: [u32; 2]| first + (last - first).div_ceil(2);
    cut(window, [middle(window.columns), middle(window.rows)])
}

/// The parts of a window, cut beside the corner nearest to the middle;
/// nothing if none lies inside. Corners are given in columns and rows.
pub(super) fn at_a_corner(
    window: &Footprint,
    corners: impl Iterator<Item = DVec2>,
) -> Option<Vec<Footprint>> {
    let [first, last] =
        [0, 1].map(|i| DVec2::new(f64::from(window.columns[i]), f64::from(window.rows[i])));
    let middle = (first + last) * 0.5;
    let inside =
        corners.map(DVec2::ceil).filter(|at| first.cmplt(*at).all() && at.cmple(last).all());
    let nearest = inside.min_by(|a, b| {
        let distance = |at: &DVec2| at.distance_squared(middle);
        distance(a).total_cmp(&distance(b)).then(a.x.total_cmp(&b.x)).then(a.y.total_cmp(&b.y))
    })?;
    Some(cut(window, [nearest.x as u32, nearest.y as u32]))
}

/// Cuts before a column and before a row; a cut at the first does nothing.
fn cut(window: &Footprint, before: [u32; 2]) -> Vec<Footprint> {
    let halves = |[first, last]: [u32; 2], before: u32| {
        if before == first {
            vec![[first, last]]
        } else {
            vec![[first, before - 1], [before, last]]
        }
    };
    let columns = halves(window.columns, before[0]);
    let rows = halves(window.rows, before[1]);
    rows.iter()
        .flat_map(|&rows| columns.iter().map(move |&columns| Footprint { columns, rows }))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn window(columns: [u32; 2], rows: [u32; 2]) -> Footprint {
        Footprint { columns, rows }
    }

    #[test]
    fn parts_of_a_window_have_each_sample_once() {
        for (columns, rows) in [([3, 9], [5, 6]), ([0, 1], [4, 4]), ([7, 7], [0, 12])] {
            let whole = window(columns, rows);
            let parts = in_the_middle(&whole);
            let size =
                |w: &Footprint| (w.columns[1] - w.columns[0] + 1) * (w.rows[1] - w.rows[0] + 1);
            assert!(parts.len() > 1);
            assert_eq!(parts.iter().map(size).sum::<u32>(), size(&whole));
            for (i, part) in parts.iter().enumerate() {
                assert!(whole.contains(part));
                assert!(parts[..i].iter().all(|other| other.intersection(part).is_none()));
            }
        }
    }

    #[test]
    fn a_corner_inside_draws_the_cut_beside_it() {
        let corners = [DVec2::new(-3.0, 2.0), DVec2::new(2.4, 5.5), DVec2::new(1.1, 0.4)];
        let parts = at_a_corner(&window([0, 7], [0, 7]), corners.into_iter());
        let parts = parts.expect("a corner lies inside");
        assert_eq!(parts[0], window([0, 2], [0, 5]));
        assert_eq!(parts[3], window([3, 7], [6, 7]));
        assert_eq!(at_a_corner(&window([3, 7], [6, 7]), corners.into_iter()), None);
    }
}
