//! An order of the sides of cells in which every column meets nearer ones
//! first.
//!
//! Rows of cells are taken from the nearest on. Within a row a column goes
//! from cell to cell, away from the eye's foot, and enters each through its
//! nearer side along the row or through its nearer side across. So cells are
//! taken away from the foot too, to both sides, and of each cell first these
//! two sides, then the diagonal. Farther sides come as the nearer ones of the
//! cells behind, those of the rectangle's border last in their row.
//!
//! ```text
//!    . ._____._____._____.       E, the foot of the eye; the cells of the
//!    | 4 | 2 | 1 | 3 | 5 |       nearest row in their order; of cell 3 first
//!    . ._____._____._____.       the side below, then that on its left
//!               E
//! ```
//!
//! For parallel rays the foot lies infinitely far away, on the left or on the
//! right; or straight ahead, and then all sides across are vertical in the
//! image. A side that is vertical in the image comes behind the sides along
//! the row that it touches and before the diagonals.
//!
//! A base adds the near walls before everything, as what every column begins
//! with, and the far walls behind everything. Walls along columns are seen from
//! their edge, and their base comes row by row.

use super::HorizonError;
use crate::kernel::predicates::Eye;
use crate::model::surface::Surface;
use std::ops::Range;

/// What is added to the horizons, one after the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// The side or diagonal of a cell.
    Cell([u32; 2]),
    /// Part of a side of the base: the side, and the place where it begins,
    /// as numbered by [`Surface::place_on_side`].
    Base(usize, u32),
    /// From a corner of the grid to the base.
    BaseCorner(usize),
    /// A row of cells is done.
    RowDone,
}

/// The grid as the eye sees it: rows from near to far, places in a row from
/// left to right.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Order {
    first: i64,
    /// What a step to the right adds to a vertex number.
    right: i64,
    /// What a step away from the eye adds.
    away: i64,
    cells: usize,
    rows: usize,
    /// The cells of a row that are taken together first.
    middle: Range<usize>,
    /// The lines across the rows that are vertical in the image.
    vertical: Range<usize>,
    /// Whether diagonals lead away from the eye to the right.
    diagonals_rise: bool,
    /// The near sides of the rectangle, as numbered by [`Surface::place_on_side`].
    near_sides: Vec<usize>,
    /// The cells along each side, if there is a base.
    base: Option<[u32; 4]>,
    /// The side of the nearest row.
    front: usize,
    /// The sides on the left and on the right.
    flanks: [usize; 2],
    /// Whether places along these sides go away from the eye.
    outward: bool,
}

/// Where columns come from along a row.
enum Foot {
    /// At a coordinate that grows to the right.
    At(f64),
    /// Infinitely far away, on the left or on the right.
    Left,
    Right,
    /// Infinitely far away, straight ahead.
    Ahead,
}

impl Order {
    /// The order for an eye.
    pub(super) fn new(surface: &Surface, eye: Eye) -> Result<Self, HorizonError> {
        let (xs, zs) = (surface.heights().xs(), surface.heights().zs());
        // On the ground of the surface: z of it is -y of the world.
        let [ex, ez] = [eye.coordinates().x, -eye.coordinates().y];
        let ends = |list: &[f64]| [list[0], list[list.len() - 1]];
        // Whether rows are those of constant z, and whether the nearest one
        // is the last of the grid.
        let (constant_z, from_last) = match eye {
            Eye::Towards(_) if ez != 0.0 => (true, ez > 0.0),
            Eye::Towards(_) if ex != 0.0 => (false, ex > 0.0),
            Eye::Towards(_) => return Err(HorizonError::Vertical),
            Eye::At(_) if ez < ends(zs)[0] || ends(zs)[1] < ez => (true, ends(zs)[1] < ez),
            Eye::At(_) if ex < ends(xs)[0] || ends(xs)[1] < ex => (false, ends(xs)[1] < ex),
            Eye::At(_) => return Err(HorizonError::EyeOverDomain),
        };
        // Seen from the last row of constant z, x grows to the right; seen
        // from the last column, z grows to the left.
        let rightwards = constant_z == from_last;
        let (along, list) = if constant_z { (ex, xs) } else { (ez, zs) };
        let foot = match eye {
            Eye::At(_) => Foot::At(along),
            Eye::Towards(_) if along == 0.0 => Foot::Ahead,
            Eye::Towards(_) if (along > 0.0) == rightwards => Foot::Right,
            Eye::Towards(_) => Foot::Left,
        };
        let columns = i64::from(surface.columns());
        let (step, deep) = if constant_z { (1, columns) } else { (columns, 1) };
        let lines = if constant_z { zs.len() } else { xs.len() } as i64;
        let far = if from_last { (lines - 1) * deep } else { 0 };
        let left = if rightwards { 0 } else { (list.len() as i64 - 1) * step };
        let (middle, vertical) = middle_of(list, rightwards, foot);
        Ok(Order {
            first: far + left,
            right: if rightwards { step } else { -step },
            away: if from_last { -deep } else { deep },
            cells: list.len() - 1,
            rows: lines as usize - 1,
            diagonals_rise: rightwards != from_last,
            near_sides: near_sides(eye, [ex, ez], ends(xs), ends(zs)),
            base: surface.has_base().then(|| [0, 1, 2, 3].map(|s| surface.length_of_side(s) - 1)),
            front: if constant_z { 0 } else { 2 } + usize::from(from_last),
            flanks: match (constant_z, rightwards) {
                (true, true) => [2, 3],
                (true, false) => [3, 2],
                (false, true) => [0, 1],
                (false, false) => [1, 0],
            },
            outward: !from_last,
            middle,
            vertical,
        })
    }

    /// Visits all steps in order. O(n).
    pub(super) fn walk<E>(&self, visit: &mut impl FnMut(Step) -> Result<(), E>) -> Result<(), E> {
        let near_corners = self.near_corners();
        if let Some(lengths) = self.base {
            // Away from the front's corners, so that each piece touches the
            // horizon.
            (0..lengths[self.front]).try_for_each(|place| visit(Step::Base(self.front, place)))?;
            for &side in self.near_sides.iter().filter(|side| **side != self.front) {
                let last = lengths[side] - 1;
                let place = |step| if self.outward { step } else { last - step };
                (0..=last).try_for_each(|step| visit(Step::Base(side, place(step))))?;
            }
            for corner in (0..4).filter(|&corner| near_corners[corner]) {
                visit(Step::BaseCorner(corner))?;
            }
        }
        for row in 0..self.rows {
            self.walk_row(row, visit)?;
            visit(Step::RowDone)?;
        }
        for cell in 0..self.cells {
            visit(self.along(cell, self.rows))?;
        }
        if let Some(lengths) = self.base {
            // A wall hides nothing of its own border.
            for corner in (0..4).filter(|&corner| !near_corners[corner]) {
                visit(Step::BaseCorner(corner))?;
            }
            let upright = [0, 1].map(|end| self.is_edge_on(end).then_some(self.flanks[end]));
            let far =
                |side: &usize| !self.near_sides.contains(side) && !upright.contains(&Some(*side));
            for side in (0..4).filter(far) {
                (0..lengths[side]).try_for_each(|place| visit(Step::Base(side, place)))?;
            }
        }
        Ok(())
    }

    /// Whether the left or the right wall is seen from its edge.
    fn is_edge_on(&self, end: usize) -> bool {
        self.vertical.contains(&[0, self.cells][end])
    }

    /// The points of a row.
    pub(super) fn row_points(&self) -> u64 {
        self.cells as u64 + 1
    }

    fn walk_row<E>(
        &self,
        row: usize,
        visit: &mut impl FnMut(Step) -> Result<(), E>,
    ) -> Result<(), E> {
        for cell in self.middle.clone() {
            visit(self.along(cell, row))?;
        }
        for line in self.vertical.clone() {
            visit(self.across(line, row))?;
        }
        if self.base.is_some() {
            let place = if self.outward { row } else { self.rows - 1 - row };
            for end in (0..2).filter(|&end| self.is_edge_on(end)) {
                visit(Step::Base(self.flanks[end], place as u32))?;
            }
        }
        for cell in self.middle.clone() {
            visit(self.diagonal(cell, row))?;
        }
        for cell in self.middle.end..self.cells {
            visit(self.along(cell, row))?;
            visit(self.across(cell, row))?;
            visit(self.diagonal(cell, row))?;
        }
        for cell in (0..self.middle.start).rev() {
            visit(self.along(cell, row))?;
            visit(self.across(cell + 1, row))?;
            visit(self.diagonal(cell, row))?;
        }
        // The borders, where they were not the nearer side of a cell.
        for (end, outermost) in [(self.middle.start, 0), (self.middle.end, self.cells)] {
            let nearer = self.middle.is_empty() && end == outermost;
            if !nearer && !self.vertical.contains(&outermost) {
                visit(self.across(outermost, row))?;
            }
        }
        Ok(())
    }

    fn vertex(&self, place: usize, row: usize) -> u32 {
        (self.first + self.right * place as i64 + self.away * row as i64) as u32
    }

    /// The nearer side along the row.
    fn along(&self, cell: usize, row: usize) -> Step {
        Step::Cell([self.vertex(cell, row), self.vertex(cell + 1, row)])
    }

    fn across(&self, line: usize, row: usize) -> Step {
        Step::Cell([self.vertex(line, row), self.vertex(line, row + 1)])
    }

    fn diagonal(&self, cell: usize, row: usize) -> Step {
        let (near, far) = if self.diagonals_rise { (cell, cell + 1) } else { (cell + 1, cell) };
        Step::Cell([self.vertex(near, row), self.vertex(far, row + 1)])
    }

    /// Which corners are ends of near sides.
    fn near_corners(&self) -> [bool; 4] {
        let ends = [[0, 1], [2, 3], [0, 2], [1, 3]];
        let near = |corner| self.near_sides.iter().any(|&side| ends[side].contains(&corner));
        [0, 1, 2, 3].map(near)
    }
}

/// The cells that are taken first, and the lines across that are vertical.
fn middle_of(list: &[f64], rightwards: bool, foot: Foot) -> (Range<usize>, Range<usize>) {
    let cells = list.len() - 1;
    let place = |index: usize| if rightwards { list[index] } else { -list[cells - index] };
    match foot {
        Foot::Left => (0..0, 0..0),
        Foot::Right => (cells..cells, 0..0),
        Foot::Ahead => (0..cells, 0..cells + 1),
        Foot::At(at) => {
            let at = if rightwards { at } else { -at };
            // Lines strictly on the left of the foot, and not on its right.
            let left = (0..=cells).take_while(|&line| place(line) < at).count();
            if left <= cells && place(left) == at {
                (left.saturating_sub(1)..(left + 1).min(cells), left..left + 1)
            } else if left == 0 {
                (0..0, 0..0)
            } else if cells < left {
                (cells..cells, 0..0)
            } else {
                (left - 1..left, 0..0)
            }
        }
    }
}

/// The sides through which columns enter the rectangle.
fn near_sides(eye: Eye, [ex, ez]: [f64; 2], x: [f64; 2], z: [f64; 2]) -> Vec<usize> {
    let enters = match eye {
        Eye::Towards(_) => [ez < 0.0, ez > 0.0, ex < 0.0, ex > 0.0],
        Eye::At(_) => [ez < z[0], z[1] < ez, ex < x[0], x[1] < ex],
    };
    (0..4).filter(|&side| enters[side]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::surface::{CurveOptions, Curves, Heights};
    use glam::{DVec2, DVec3, dvec2, dvec3};
    use std::convert::Infallible;

    fn flat(columns: usize, rows: usize) -> Surface {
        let steps = |count: usize| (0..count).map(|i| i as f64).collect::<Vec<_>>();
        let heights = Heights::new(steps(columns), steps(rows), vec![0.0; columns * rows]);
        Surface::new(heights.unwrap(), None).unwrap()
    }

    fn eyes() -> Vec<Eye> {
        let mut eyes = Vec::new();
        for (x, y) in [(0, -1), (0, 1), (1, 0), (-1, 0), (1, 1), (-1, 3), (2, -1), (-3, -1)] {
            eyes.push(Eye::Towards(dvec3(f64::from(x), f64::from(y), 0.5)));
        }
        for x in [-2.0, 0.0, 0.5, 2.0, 3.25, 4.0, 7.0] {
            for y in [-9.0, -2.5, -1.0, 0.5, 6.0] {
                eyes.push(Eye::At(dvec3(x, y, 1.0)));
            }
        }
        eyes
    }

    /// Where the ray to `towards` on the ground meets a segment, as its
    /// distance in units of that ray; nothing near the ends.
    fn met(eye: Eye, towards: DVec2, [a, b]: [DVec2; 2]) -> Option<f64> {
        let along = match eye {
            Eye::Towards(direction) => -direction.truncate(),
            Eye::At(place) => towards - place.truncate(),
        };
        let (start, edge) = (towards, b - a);
        let turn = along.perp_dot(edge);
        let share = (a - start).perp_dot(along) / turn;
        let distance = (a - start).perp_dot(edge) / turn;
        (1e-9 < share && share < 1.0 - 1e-9 && turn != 0.0).then_some(distance)
    }

    #[test]
    fn every_column_meets_nearer_sides_first_and_every_side_comes_once() {
        for (columns, rows) in [(5, 4), (2, 2), (2, 5)] {
            let surface = flat(columns, rows);
            let options = CurveOptions { diagonals: true, ..CurveOptions::default() };
            let mut all = Curves::new(&surface, &options).lines(&surface);
            all.sort_unstable();
            let place: Vec<DVec2> = surface.vertices().iter().map(|p| p.truncate()).collect();
            for eye in eyes() {
                let Ok(order) = Order::new(&surface, eye) else {
                    continue;
                };
                let mut steps = Vec::new();
                let _ = order.walk(&mut |step| {
                    if let Step::Cell(side) = step {
                        steps.push(side);
                    }
                    Ok::<(), Infallible>(())
                });
                let mut seen: Vec<_> = steps.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
                seen.sort_unstable();
                assert_eq!(seen, all, "{eye:?}");
                for i in 0..200 {
                    // Through points spread over the rectangle.
                    let share = dvec2(f64::from(i) * 0.618_034, f64::from(i) * 0.414_214);
                    let towards = share.fract() * dvec2(columns as f64 - 1.0, 1.0 - rows as f64);
                    let on_way = steps.iter().filter_map(|side| {
                        met(eye, towards, side.map(|vertex| place[vertex as usize]))
                    });
                    let on_way: Vec<f64> = on_way.collect();
                    assert!(on_way.is_sorted_by(|a, b| *a <= *b + 1e-9), "{eye:?} {on_way:?}");
                }
            }
        }
    }

    #[test]
    fn eyes_without_columns_are_refused() {
        let surface = flat(3, 3);
        let order = |eye| Order::new(&surface, eye);
        assert_eq!(order(Eye::Towards(DVec3::Z)), Err(HorizonError::Vertical));
        let over = dvec3(1.0, -1.0, 9.0);
        assert_eq!(order(Eye::At(over)), Err(HorizonError::EyeOverDomain));
        // Straight above a border there is no nearest row either.
        assert_eq!(order(Eye::At(dvec3(0.0, 0.0, 9.0))), Err(HorizonError::EyeOverDomain));
        assert!(order(Eye::At(dvec3(0.0, 0.5, 9.0))).is_ok());
    }
}
