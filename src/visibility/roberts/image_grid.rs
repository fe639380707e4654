//! Which triangles might hide a line: boxes in a uniform grid over the
//! image. It only leaves out triangles whose boxes do not meet the line's,
//! and shares nothing with the search of any other method.

use crate::model::LineOrigin;
use crate::run::map_indexed;
use crate::spatial::Bounds;
use crate::view::LineQuestion;

/// Most cells along an axis.
const MOST_CELLS: usize = 256;

/// Triangles whose boxes cover more cells than this are kept apart.
const WIDE: usize = 64;

/// Boxes of all triangles that are not edge-on, by cells of the image.
#[derive(Debug)]
pub(super) struct ImageGrid {
    boxes: Vec<Bounds>,
    low: [f32; 2],
    /// Cells per unit.
    scale: [f32; 2],
    /// Cells along an axis.
    size: usize,
    cells: Vec<Vec<u32>>,
    wide: Vec<u32>,
}

impl ImageGrid {
    /// Sorts the triangles of a question into cells. O(n).
    pub(super) fn new(question: &LineQuestion) -> Self {
        let triangles = question.mesh.triangles();
        let boxes = map_indexed(triangles.len(), |i| {
            if question.facing[i].is_zero() {
                Bounds::EMPTY
            } else {
                question.coordinates.bounds(triangles[i])
            }
        });
        let bounded = |bounds: &&Bounds| {
            !bounds.is_empty() && (0..2).all(|i| (bounds.high[i] - bounds.low[i]).is_finite())
        };
        let whole = boxes.iter().filter(bounded).fold(Bounds::EMPTY, |sum, one| sum.union(one));
        let size = (boxes.len() as f64).sqrt().ceil() as usize;
        let size = size.clamp(1, MOST_CELLS);
        let scale = [0, 1].map(|i| {
            let scale = size as f32 / (whole.high[i] - whole.low[i]);
            if scale.is_finite() && scale > 0.0 { scale } else { 0.0 }
        });
        let mut grid = ImageGrid {
            boxes,
            low: [whole.low[0], whole.low[1]].map(|x| if x.is_finite() { x } else { 0.0 }),
            scale,
            size,
            cells: vec![Vec::new(); size * size],
            wide: Vec::new(),
        };
        for triangle in 0..triangles.len() {
            grid.insert(triangle);
        }
        grid
    }

    fn insert(&mut self, triangle: usize) {
        let bounds = self.boxes[triangle];
        if bounds.is_empty() {
            return;
        }
        let [[left, right], [bottom, top]] = [0, 1].map(|axis| self.range(&bounds, axis));
        if (right - left + 1) * (top - bottom + 1) > WIDE {
            self.wide.push(triangle as u32);
            return;
        }
        for row in bottom..=top {
            for column in left..=right {
                self.cells[row * self.size + column].push(triangle as u32);
            }
        }
    }

    /// The first and last cell of a box along an axis. The map from a
    /// coordinate to its cell never falls, so boxes with a common point
    /// have a common cell, however it rounds.
    fn range(&self, bounds: &Bounds, axis: usize) -> [usize; 2] {
        [bounds.low[axis], bounds.high[axis]].map(|x| {
            // A cast of a float saturates; a product of infinity and zero
            // is not a number and becomes cell 0 at both ends.
            let cell = ((x - self.low[axis]) * self.scale[axis]) as usize;
            cell.min(self.size - 1)
        })
    }

    /// Appends the triangles whose boxes meet that of a line and reach in
    /// front of its farthest point, in ascending order.
    pub(super) fn candidates(&self, question: &LineQuestion, line: usize, found: &mut Vec<u32>) {
        let bounds = line_bounds(question, line);
        if bounds.is_empty() {
            return;
        }
        let [[left, right], [bottom, top]] = [0, 1].map(|axis| self.range(&bounds, axis));
        let cells = (bottom..=top)
            .flat_map(|row| &self.cells[row * self.size + left..=row * self.size + right]);
        let may_hide = |&&triangle: &&u32| {
            let triangle = &self.boxes[triangle as usize];
            (0..2).all(|i| triangle.low[i] <= bounds.high[i] && bounds.low[i] <= triangle.high[i])
                && triangle.low[2] <= bounds.high[2]
        };
        found.extend(cells.flatten().chain(&self.wide).filter(may_hide));
        found.sort_unstable();
        found.dedup();
    }
}

/// A box around a line.
fn line_bounds(question: &LineQuestion, line: usize) -> Bounds {
    let coordinates = question.coordinates;
    let line = &question.lines[line];
    if let LineOrigin::Intersection(index) = line.origin {
        // The line lies in both of its triangles.
        let [s, t] = question.intersections[index as usize]
            .triangles
            .map(|triangle| coordinates.bounds(question.mesh.triangles()[triangle as usize]));
        return s.intersection(&t);
    }
    match question.carrier(line).as_edge() {
        Some(vertices) => coordinates.bounds(vertices),
        None => Bounds::ALL,
    }
}
