//! Which of the lines of a grid are drawn, and how they are numbered.

use super::Surface;

/// Which lines of a surface are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CurveOptions {
    /// The curves along x, of constant z.
    pub constant_z: bool,
    /// The curves along z, of constant x.
    pub constant_x: bool,
    /// The lines that cut the cells in two.
    pub diagonals: bool,
    /// The curves at the four ends of the rectangle, of whichever family.
    pub borders: bool,
    /// Of each family every so many curves, and the last; 0 is taken as 1.
    pub every: u32,
}

impl Default for CurveOptions {
    fn default() -> Self {
        CurveOptions {
            constant_z: true,
            constant_x: true,
            diagonals: false,
            borders: true,
            every: 1,
        }
    }
}

impl CurveOptions {
    /// Whether a curve is drawn, of a family that is wanted or not, by its
    /// number and that of the last one.
    pub(super) fn draws(&self, family: bool, index: u32, last: u32) -> bool {
        let ends = index == 0 || index == last;
        (ends && self.borders)
            || (family && (index == last || index.is_multiple_of(self.every.max(1))))
    }
}

/// The lines of a surface that are drawn, one for each side of a cell.
///
/// First the curves of constant z, row by row; then those of constant x,
/// column by column; the diagonals, row by row; at last the four sides of
/// the base, place by place, and the four corners of its walls.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Curves {
    columns: u32,
    /// Cells along each side.
    sides: [u32; 4],
    /// The first line of each row, if it is drawn.
    rows: Vec<Option<u32>>,
    /// The first line of each column.
    across: Vec<Option<u32>>,
    /// The first diagonal, if they are drawn.
    diagonals: Option<u32>,
    /// The first line of the base, if there is one.
    base: Option<u32>,
    count: u32,
}

impl Curves {
    /// Numbers the lines. O(rows + columns).
    pub fn new(surface: &Surface, options: &CurveOptions) -> Self {
        let (columns, rows) = (surface.columns(), surface.rows());
        let mut count = 0;
        let mut next = |wanted: bool, lines: u32| {
            wanted.then(|| {
                count += lines;
                count - lines
            })
        };
        let drawn = |family, index, last| options.draws(family, index, last);
        let along = |j| drawn(options.constant_z, j, rows - 1);
        let rows_drawn = (0..rows).map(|j| next(along(j), columns - 1)).collect();
        let along = |i| drawn(options.constant_x, i, columns - 1);
        let across = (0..columns).map(|i| next(along(i), rows - 1)).collect();
        let diagonals = next(options.diagonals, (columns - 1) * (rows - 1));
        let sides = [0, 1, 2, 3].map(|side| surface.length_of_side(side) - 1);
        let base = next(surface.has_base(), sides.iter().sum::<u32>() + 4);
        Curves { columns, sides, rows: rows_drawn, across, diagonals, base, count }
    }

    /// The number of lines.
    pub fn len(&self) -> usize {
        self.count as usize
    }

    /// Whether nothing is drawn.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The line between two vertices of a cell, the lesser first, if it is
    /// drawn.
    pub fn line(&self, [low, high]: [u32; 2]) -> Option<u32> {
        let (i, j) = (low % self.columns, low / self.columns);
        match high - low {
            1 => self.rows[j as usize].map(|first| first + i),
            step if step == self.columns => self.across[i as usize].map(|first| first + j),
            _ => self.diagonals.map(|first| first + j * (self.columns - 1) + i),
        }
    }

    /// The line along a side of the base from a place to the next; sides and
    /// places as in [`Surface::place_on_side`].
    pub fn base_line(&self, side: usize, place: u32) -> Option<u32> {
        self.base.map(|first| first + self.sides[..side].iter().sum::<u32>() + place)
    }

    /// The line from a corner of the grid to the base.
    pub fn base_corner(&self, corner: usize) -> Option<u32> {
        self.base.map(|first| first + self.sides.iter().sum::<u32>() + corner as u32)
    }

    /// The vertices of all lines, in their order. O(n).
    pub fn lines(&self, surface: &Surface) -> Vec<[u32; 2]> {
        let mut lines = Vec::with_capacity(self.len());
        let (columns, rows) = (surface.columns(), surface.rows());
        let at = |i, j| surface.vertex(i, j);
        for j in (0..rows).filter(|&j| self.rows[j as usize].is_some()) {
            lines.extend((0..columns - 1).map(|i| [at(i, j), at(i + 1, j)]));
        }
        for i in (0..columns).filter(|&i| self.across[i as usize].is_some()) {
            lines.extend((0..rows - 1).map(|j| [at(i, j), at(i, j + 1)]));
        }
        if self.diagonals.is_some() {
            for j in 0..rows - 1 {
                lines.extend((0..columns - 1).map(|i| [at(i, j), at(i + 1, j + 1)]));
            }
        }
        if self.base.is_some() {
            let foot = |[i, j]: [u32; 2]| surface.base_vertex(i, j);
            for side in 0..4 {
                let end = |place| foot(surface.place_on_side(side, place));
                lines.extend((0..self.sides[side]).map(|place| [end(place), end(place + 1)]));
            }
            lines.extend((0..4).map(|corner| {
                let [i, j] = surface.corner(corner);
                [at(i, j), foot([i, j])]
            }));
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::super::Heights;
    use super::*;

    fn surface(columns: usize, rows: usize) -> Surface {
        let steps = |count: usize| (0..count).map(|i| i as f64).collect::<Vec<_>>();
        let heights = Heights::new(steps(columns), steps(rows), vec![1.0; columns * rows]);
        Surface::new(heights.unwrap(), Some(0.0)).unwrap()
    }

    #[test]
    fn every_line_is_found_by_its_ends() {
        for (columns, rows) in [(2, 2), (2, 5), (4, 3)] {
            let surface = surface(columns, rows);
            let options = CurveOptions { diagonals: true, ..CurveOptions::default() };
            let curves = Curves::new(&surface, &options);
            let lines = curves.lines(&surface);
            assert_eq!(lines.len(), curves.len());
            let base = curves.base.unwrap() as usize;
            for (index, &line) in lines[..base].iter().enumerate() {
                assert_eq!(curves.line(line), Some(index as u32));
            }
            let last = curves.base_line(3, surface.rows() - 2).unwrap();
            let foot = |row| surface.base_vertex(surface.columns() - 1, row);
            assert_eq!(lines[last as usize], [surface.rows() - 2, surface.rows() - 1].map(foot));
            let corner = curves.base_corner(0).unwrap();
            assert_eq!(lines[corner as usize], [0, surface.base_vertex(0, 0)]);
        }
    }

    #[test]
    fn of_one_family_every_third_curve_and_the_borders() {
        let surface = surface(6, 6);
        let options = CurveOptions { constant_x: false, every: 3, ..CurveOptions::default() };
        let curves = Curves::new(&surface, &options);
        let drawn = |list: &[Option<u32>]| -> Vec<usize> {
            (0..list.len()).filter(|&i| list[i].is_some()).collect()
        };
        assert_eq!(drawn(&curves.rows), [0, 3, 5]);
        assert_eq!(drawn(&curves.across), [0, 5]);
    }
}
