//! The triangles that may have to do with the lines.
//!
//! Where few lines are drawn of a large mesh, most triangles lie beside all
//! of them in the image, and putting these into a hierarchy takes longer than
//! all questions that are asked of it. So the image is cut into cells, those
//! that a line may touch are marked, and only triangles that may touch a
//! marked cell are put into one. What is left out neither hides nor pierces
//! anything that is asked about.

use crate::model::FeatureLine;
use crate::run::{map_chunks, map_small};
use crate::spatial::{Bounds, Hierarchy};
use crate::view::LineQuestion;
use glam::Vec3A;
use std::borrow::Cow;

/// Cells along each side of the image.
const CELLS: usize = 1024;

/// Meshes of fewer triangles are not worth it,
const LEAST_TRIANGLES: usize = 1 << 14;

/// nor are lines that are more than one for so many triangles.
const TRIANGLES_OF_A_LINE: usize = 64;

/// Boxes over more rows of cells are not looked at.
const MOST_ROWS: usize = 128;

/// Triangles that one task looks at.
const PART: usize = 1 << 14;

/// View boxes of all triangles that matter to the question's lines.
pub(super) fn triangles<'q>(question: &'q LineQuestion<'_>) -> Cow<'q, Hierarchy> {
    let triangles = question.mesh.triangles();
    let few = triangles.len() < LEAST_TRIANGLES
        || triangles.len() / TRIANGLES_OF_A_LINE < question.lines.len();
    if few {
        return Cow::Borrowed(question.hierarchy());
    }
    let Some(cells) = Cells::of(question) else {
        return Cow::Borrowed(question.hierarchy());
    };
    let block = |vertex: usize| Block::of(&question.coordinates.bounds([vertex as u32]));
    let blocks = map_small(question.mesh.vertices().len(), block);
    let parts = map_chunks(triangles.len(), PART, |part| {
        let touching = |&triangle: &usize| {
            let [a, b, c] = triangles[triangle].map(|corner| blocks[corner as usize]);
            cells.touches(a.union(b).union(c))
        };
        part.filter(touching).map(|triangle| triangle as u32).collect::<Vec<_>>()
    });
    let bounds = |triangle: usize| question.coordinates.bounds(triangles[triangle]);
    let place = |triangle: usize| question.coordinates.place(triangles[triangle][0]);
    Cow::Owned(Hierarchy::of_some(parts.concat(), place, bounds))
}

/// Which cells of the image a line may touch, a bit for each.
struct Cells {
    rows: Vec<[u64; CELLS / 64]>,
}

/// Columns and rows of cells, from one to another, both included.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Block {
    low: [u16; 2],
    high: [u16; 2],
}

impl Block {
    /// The cells into which a box reaches. Boxes of a view lie between -1 and
    /// 1; what reaches beyond is taken to reach the outermost cells, and what
    /// may lie behind the eye, whose box is empty or open, reaches all cells.
    fn of(bounds: &Bounds) -> Self {
        let cell = |at: Vec3A, axis: usize| {
            let place = (at[axis] + 1.0) * (0.5 * CELLS as f32);
            // As a cast, what is below zero or no number becomes zero.
            (place as u16).min(CELLS as u16 - 1)
        };
        let ends = [0, 1].map(|axis| [cell(bounds.low, axis), cell(bounds.high, axis)]);
        Block { low: ends.map(|[a, b]| a.min(b)), high: ends.map(|[a, b]| a.max(b)) }
    }

    fn union(self, other: Self) -> Self {
        Block {
            low: [0, 1].map(|axis| self.low[axis].min(other.low[axis])),
            high: [0, 1].map(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    /// From the first to the last along an axis.
    fn along(self, axis: usize) -> [usize; 2] {
        [self.low[axis].into(), self.high[axis].into()]
    }
}

impl Cells {
    /// The cells of the question's lines; none if a line may reach the eye.
    fn of(question: &LineQuestion<'_>) -> Option<Self> {
        let mut cells = Cells { rows: vec![[0; CELLS / 64]; CELLS] };
        for line in question.lines {
            cells.mark_line(question, line)?;
        }
        Some(cells)
    }

    fn mark_line(&mut self, question: &LineQuestion<'_>, line: &FeatureLine) -> Option<()> {
        let ends = line.origin.vertices(question.mesh)?;
        let [start, end] = ends.map(|vertex| question.coordinates.bounds([vertex]));
        let around = start.union(&end);
        if !(around.low.is_finite() && around.high.is_finite()) {
            return None;
        }
        self.mark_between(&start, &end);
        Some(())
    }

    /// Marks what lies between two boxes: piece by piece, so that a long line
    /// does not mark all cells of the box around it. Boxes of points between
    /// others lie between the boxes of those; a cell more on each side is far
    /// more than their rounding.
    fn mark_between(&mut self, start: &Bounds, end: &Bounds) {
        let blocks = [Block::of(start), Block::of(end)];
        let apart = |axis: usize| usize::from(blocks[0].low[axis].abs_diff(blocks[1].low[axis]));
        let pieces = apart(0).max(apart(1)) + 1;
        let at = |i: usize| {
            let share = i as f32 / pieces as f32;
            Bounds { low: start.low.lerp(end.low, share), high: start.high.lerp(end.high, share) }
        };
        for i in 0..pieces {
            self.mark(&at(i).union(&at(i + 1)));
        }
    }

    fn mark(&mut self, bounds: &Bounds) {
        let block = Block::of(bounds);
        let [columns, rows] = [0, 1].map(|axis| {
            let [first, last] = block.along(axis);
            first.saturating_sub(1)..(last + 2).min(CELLS)
        });
        for row in rows {
            for column in columns.clone() {
                self.rows[row][column / 64] |= 1 << (column % 64);
            }
        }
    }

    /// Whether one of some cells is marked, or they are so many rows that
    /// looking would take long.
    fn touches(&self, block: Block) -> bool {
        let [columns, rows] = [block.along(0), block.along(1)];
        if rows[1] - rows[0] > MOST_ROWS {
            return true;
        }
        let [first, last] = columns.map(|column| column / 64);
        // What is to the left of the first column, and up to the last.
        let before = (1_u64 << (columns[0] % 64)) - 1;
        let up_to = u64::MAX >> (63 - columns[1] % 64);
        self.rows[rows[0]..=rows[1]].iter().any(|row| {
            let words = &row[first..=last];
            words.iter().enumerate().any(|(i, &word)| {
                let word = if i == 0 { word & !before } else { word };
                let word = if first + i == last { word & up_to } else { word };
                word != 0
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(x: f32, y: f32) -> Bounds {
        let at = Vec3A::new(x, y, 0.0);
        Bounds { low: at, high: at }
    }

    proptest! {
        #[test]
        fn boxes_around_points_of_a_line_touch_its_cells(
            ends in prop::array::uniform4(-1.0..1.0_f32),
            share in 0.0..1.0_f32,
            size in (0.0..0.2_f32, 0.0..0.2_f32),
        ) {
            let mut cells = Cells { rows: vec![[0; CELLS / 64]; CELLS] };
            let [x0, y0, x1, y1] = ends;
            cells.mark_between(&point(x0, y0), &point(x1, y1));
            let at = Vec3A::new(x0 + (x1 - x0) * share, y0 + (y1 - y0) * share, 0.0);
            let (low, high) = (at - Vec3A::new(size.0, 0.0, 0.0), at + Vec3A::new(0.0, size.1, 0.0));
            prop_assert!(cells.touches(Block::of(&Bounds { low, high })), "not touched");
        }

        #[test]
        fn boxes_away_from_a_line_touch_none(
            ends in prop::array::uniform4(-1.0..1.0_f32),
            share in 0.0..1.0_f32,
            aside in prop::bool::ANY,
        ) {
            let mut cells = Cells { rows: vec![[0; CELLS / 64]; CELLS] };
            let [x0, y0, x1, y1] = ends;
            cells.mark_between(&point(x0, y0), &point(x1, y1));
            // Six cells to one side of the line.
            let along = Vec3A::new(x1 - x0, y1 - y0, 0.0).normalize_or_zero();
            let across = Vec3A::new(-along.y, along.x, 0.0) * (12.0 / CELLS as f32);
            let at = Vec3A::new(x0 + (x1 - x0) * share, y0 + (y1 - y0) * share, 0.0);
            let at = if aside { at + across } else { at - across };
            prop_assume!(along != Vec3A::ZERO && at.abs().max_element() < 1.0);
            prop_assert!(!cells.touches(Block::of(&point(at.x, at.y))));
        }
    }

    #[test]
    fn a_box_of_several_words_is_looked_at_wholly_and_no_farther() {
        let mut cells = Cells { rows: vec![[0; CELLS / 64]; CELLS] };
        cells.rows[500][300 / 64] |= 1 << (300 % 64);
        let at = |cell: usize| (cell as f32 + 0.5) / (0.5 * CELLS as f32) - 1.0;
        let reaches = |columns: [usize; 2], rows: [usize; 2]| {
            cells.touches(Block::of(&Bounds {
                low: Vec3A::new(at(columns[0]), at(rows[0]), 0.0),
                high: Vec3A::new(at(columns[1]), at(rows[1]), 0.0),
            }))
        };
        assert!(reaches([300, 300], [500, 500]));
        assert!(reaches([10, 1000], [499, 501]));
        assert!(reaches([300, 700], [500, 500]));
        assert!(reaches([100, 300], [500, 500]));
        assert!(!reaches([301, 700], [500, 500]));
        assert!(!reaches([100, 299], [500, 500]));
        assert!(!reaches([10, 1000], [501, 600]));
        assert!(reaches([10, 11], [600, 900]), "too many rows to look at");
        assert_eq!(Block::of(&Bounds::EMPTY), Block::of(&Bounds::ALL));
        assert_eq!(Block::of(&Bounds::ALL), Block { low: [0; 2], high: [1023; 2] });
    }
}
