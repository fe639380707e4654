//! Polylines in two flat arrays.

use glam::DVec2;

/// Polylines on a page, mm, y downwards, origin in the upper left corner.
///
/// A stroke has at least two points. A closed stroke repeats its first point
/// as its last, bit for bit.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Strokes {
    points: Vec<DVec2>,
    /// End of each stroke in `points`.
    ends: Vec<usize>,
}

impl Strokes {
    /// The number of strokes.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is no stroke.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The number of points of all strokes together.
    pub fn point_count(&self) -> usize {
        self.points.len()
    }

    /// The points of stroke `index`, which must be less than `len`.
    pub fn get(&self, index: usize) -> &[DVec2] {
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        &self.points[start..self.ends[index]]
    }

    /// All strokes in the order in which they are drawn.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[DVec2]> + '_ {
        (0..self.len()).map(|index| self.get(index))
    }

    /// Appends a stroke. One of fewer than two points is no stroke and is
    /// left out.
    pub fn push(&mut self, points: impl IntoIterator<Item = DVec2>) {
        let start = self.points.len();
        self.points.extend(points);
        if self.points.len() < start + 2 {
            self.points.truncate(start);
        } else {
            self.ends.push(self.points.len());
        }
    }

    /// The length of all strokes together, mm.
    pub fn length(&self) -> f64 {
        let stroke = |points: &[DVec2]| -> f64 {
            points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
        };
        self.iter().map(stroke).sum()
    }

    /// The length of the ways from each stroke to the next, mm.
    pub fn pen_up_length(&self) -> f64 {
        let pairs = (1..self.len()).map(|next| (self.get(next - 1), self.get(next)));
        pairs.fold(0.0, |sum, (one, other)| sum + one[one.len() - 1].distance(other[0]))
    }
}

/// Whether a stroke ends where it begins.
pub fn is_closed(stroke: &[DVec2]) -> bool {
    2 < stroke.len() && stroke.first() == stroke.last()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lone_point_is_no_stroke() {
        let mut strokes = Strokes::default();
        strokes.push([DVec2::ZERO]);
        strokes.push([DVec2::ZERO, DVec2::X, DVec2::ONE]);
        strokes.push([]);
        assert_eq!((strokes.len(), strokes.point_count()), (1, 3));
        assert_eq!(strokes.length(), 2.0);
        assert!(!is_closed(strokes.get(0)));
    }
}
