//! Polylines, and curves among them, in flat arrays.

use crate::run::concat_map;
use glam::DVec2;
use kurbo::{CubicBez, ParamCurve, Point};
use std::borrow::Cow;

/// Strokes on a page, mm, y downwards, origin in the upper left corner.
///
/// A stroke has at least two nodes. A closed stroke repeats its first node
/// as its last, bit for bit. From node to node it is straight, or, where
/// curves were fitted, a cubic with two control points.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Strokes {
    points: Vec<DVec2>,
    /// End of each stroke in `points`.
    ends: Vec<usize>,
    /// For each node the controls of the curve that leads to it. Empty if
    /// there is no curve at all.
    bends: Vec<Option<[DVec2; 2]>>,
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

    /// The nodes of stroke `index`, which must be less than `len`.
    pub fn get(&self, index: usize) -> &[DVec2] {
        &self.points[self.range(index)]
    }

    /// For each node of stroke `index` the controls of the curve that leads to
    /// it, nothing where the way is straight; an empty slice if there are no
    /// curves.
    pub fn bends(&self, index: usize) -> &[Option<[DVec2; 2]>] {
        if self.bends.is_empty() { &[] } else { &self.bends[self.range(index)] }
    }

    fn range(&self, index: usize) -> std::ops::Range<usize> {
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        start..self.ends[index]
    }

    /// The controls of the curve that leads to node `node` of stroke `index`.
    pub(super) fn bend(&self, index: usize, node: usize) -> Option<[DVec2; 2]> {
        self.bends(index).get(node).copied().flatten()
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
        if !self.bends.is_empty() {
            self.bends.resize(self.points.len(), None);
        }
    }

    /// Appends a stroke of nodes and, for each, the controls of the curve that
    /// leads to it.
    pub fn push_curved(&mut self, nodes: impl IntoIterator<Item = (DVec2, Option<[DVec2; 2]>)>) {
        let (start, first) = (self.points.len(), self.ends.len());
        let (points, bends): (Vec<_>, Vec<_>) = nodes.into_iter().unzip();
        let curved = bends.iter().skip(1).any(Option::is_some);
        self.push(points);
        if curved && first < self.ends.len() {
            self.bends.resize(self.points.len(), None);
            self.bends[start + 1..].copy_from_slice(&bends[1..]);
        }
    }

    /// The strokes of all parts, none of which has curves, one part after the
    /// other.
    pub(super) fn concat(parts: &[Self]) -> Self {
        let mut first = Vec::with_capacity(parts.len());
        let mut sum = 0;
        for part in parts {
            first.push(sum);
            sum += part.points.len();
        }
        let points: Vec<&[DVec2]> = parts.iter().map(|part| &part.points[..]).collect();
        let ends: Vec<&[usize]> = parts.iter().map(|part| &part.ends[..]).collect();
        Strokes {
            points: concat_map(&points, |_, point| *point),
            ends: concat_map(&ends, |part, end| end + first[part]),
            bends: Vec::new(),
        }
    }

    /// Leaves out strokes, none of which has curves, that are shorter than
    /// `length`.
    pub(super) fn retain_longer(&mut self, length: f64) {
        if 0.0 < length {
            let own = |points: &[DVec2]| -> f64 {
                points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
            };
            let mut longer = Strokes::default();
            let strokes = self.iter().filter(|points| length <= own(points));
            strokes.for_each(|points| longer.push(points.iter().copied()));
            *self = longer;
        }
    }

    /// The strokes as polylines that are nowhere farther than `flatness`
    /// millimetres from the curves.
    pub fn flat(&self, flatness: f64) -> Cow<'_, Strokes> {
        if self.bends.is_empty() {
            return Cow::Borrowed(self);
        }
        let mut all = Strokes::default();
        for index in 0..self.len() {
            let nodes = self.get(index);
            let mut points = vec![nodes[0]];
            for (node, pair) in nodes.windows(2).enumerate() {
                if let Some(controls) = self.bend(index, node + 1) {
                    flatten([pair[0], controls[0], controls[1]], pair[1], flatness, &mut points);
                }
                points.push(pair[1]);
            }
            all.push(points);
        }
        Cow::Owned(all)
    }

    /// The length of all strokes together, mm; of curves to within a
    /// thousandth of a millimetre of height of their arcs.
    pub fn length(&self) -> f64 {
        let stroke = |points: &[DVec2]| -> f64 {
            points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
        };
        self.flat(FLATNESS).iter().map(stroke).sum()
    }

    /// The length of the ways from each stroke to the next, mm.
    pub fn pen_up_length(&self) -> f64 {
        let pairs = (1..self.len()).map(|next| (self.get(next - 1), self.get(next)));
        pairs.fold(0.0, |sum, (one, other)| sum + one[one.len() - 1].distance(other[0]))
    }
}

/// How far polylines may be from the curves that they are measured for, mm.
const FLATNESS: f64 = 1e-3;

/// Appends points of a cubic between its ends. The second derivative bounds
/// the height of the arcs.
pub(super) fn flatten([a, b, c]: [DVec2; 3], d: DVec2, flatness: f64, points: &mut Vec<DVec2>) {
    let bend = 6.0 * (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
    let parts = (bend / 8.0 / flatness).sqrt().ceil().clamp(1.0, 4096.0);
    let [p0, p1, p2, p3] = [a, b, c, d].map(|p| Point::new(p.x, p.y));
    let curve = CubicBez::new(p0, p1, p2, p3);
    for part in 1..parts as u32 {
        let point = curve.eval(f64::from(part) / parts);
        points.push(DVec2::new(point.x, point.y) + DVec2::ZERO);
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
    fn a_curve_is_flattened_within_the_flatness() {
        let quarter = 0.552_284_749_8;
        let mut strokes = Strokes::default();
        strokes.push([DVec2::ZERO, DVec2::X]);
        let controls = [DVec2::new(1.0, quarter), DVec2::new(quarter, 1.0)];
        strokes.push_curved([(DVec2::X, None), (DVec2::Y, Some(controls))]);
        let flat = strokes.flat(1e-3);
        assert_eq!(flat.get(0), strokes.get(0));
        assert!(flat.get(1).iter().all(|p| (p.length() - 1.0).abs() < 2e-3));
        assert!((strokes.length() - 1.0 - std::f64::consts::FRAC_PI_2).abs() < 3e-3);
        assert_eq!((flat.get(1)[0], flat.get(1).last()), (DVec2::X, Some(&DVec2::Y)));
    }

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
