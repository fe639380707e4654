//! A surface with holes where heights are missing, as points of the world.

use super::{CurveOptions, Heights, SurfaceError};
use crate::model::Soup;
use glam::DVec3;

/// Heights some of which may be missing, and perhaps walls down to a base.
///
/// A cell with all four heights is two triangles, as everywhere; one with
/// three is the triangle of these; all others are holes. So the surface goes
/// as far as the data.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceWithHoles {
    heights: Heights,
    base: Option<f64>,
    /// Which corners of each cell there are.
    cells: Vec<Cell>,
}

/// Corners of a cell that are there: least x and z, greatest x, greatest z,
/// both greatest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Cell([bool; 4]);

/// Sides of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    /// That of least z.
    Far,
    /// That of greatest z.
    Near,
    /// That of least x.
    Left,
    /// That of greatest x.
    Right,
}

impl Cell {
    /// Which corner is missing, if one alone is.
    fn gap(self) -> Option<usize> {
        let mut gaps = (0..4).filter(|&corner| !self.0[corner]);
        gaps.next().filter(|_| gaps.next().is_none())
    }

    fn is_whole(self) -> bool {
        self.0 == [true; 4]
    }

    /// Whether a side borders what of the cell is surface.
    fn has(self, side: Side) -> bool {
        let ends = match side {
            Side::Far => [0, 1],
            Side::Near => [2, 3],
            Side::Left => [0, 2],
            Side::Right => [1, 3],
        };
        (self.is_whole() || self.gap().is_some()) && ends.iter().all(|&corner| self.0[corner])
    }

    /// Triangles, counterclockwise from above.
    fn triangles(self) -> &'static [[usize; 3]] {
        match self.gap() {
            None if self.is_whole() => &[[0, 3, 1], [0, 2, 3]],
            None => &[],
            Some(0) => &[[2, 3, 1]],
            Some(1) => &[[0, 2, 3]],
            Some(2) => &[[0, 3, 1]],
            Some(_) => &[[0, 2, 1]],
        }
    }

    /// The side across, where the cell is one triangle.
    fn across(self) -> Option<[usize; 2]> {
        self.gap().map(|gap| if matches!(gap, 0 | 3) { [1, 2] } else { [0, 3] })
    }
}

impl SurfaceWithHoles {
    /// A surface as far as there are heights; with a base, walls stand under
    /// all its borders, those of holes too. O(n).
    ///
    /// # Errors
    ///
    /// If no cell has three heights, or the base lies among those of the
    /// borders.
    pub fn new(heights: Heights, base: Option<f64>) -> Result<Self, SurfaceError> {
        let (columns, rows) = (heights.xs().len(), heights.zs().len());
        let is_there = |i: usize, j: usize| heights.values()[j * columns + i].is_finite();
        let cell = |i, j| {
            Cell([is_there(i, j), is_there(i + 1, j), is_there(i, j + 1), is_there(i + 1, j + 1)])
        };
        let cells: Vec<Cell> =
            (0..rows - 1).flat_map(|j| (0..columns - 1).map(move |i| cell(i, j))).collect();
        let surface = SurfaceWithHoles { heights, base, cells };
        if surface.cells.iter().all(|cell| cell.triangles().is_empty()) {
            return Err(SurfaceError::NoCells);
        }
        if let Some(base) = base {
            let ends = surface.borders().into_iter().flatten();
            let heights = ends.map(|point| surface.heights.values()[point]);
            let empty = (f64::INFINITY, f64::NEG_INFINITY);
            let (least, greatest) =
                heights.fold(empty, |(a, b), height| (a.min(height), b.max(height)));
            if !base.is_finite() || (least <= base && base <= greatest) {
                return Err(SurfaceError::BaseAmongHeights { base, least, greatest });
            }
        }
        Ok(surface)
    }

    /// The box of all of it as (least, greatest) corner. O(n).
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let mut used = vec![false; self.heights.values().len()];
        self.triangles().flatten().for_each(|point| used[point] = true);
        let points = (0..used.len()).filter(|&point| used[point]).map(|point| self.place(point));
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) =
            points.fold(empty, |(low, high), place| (low.min(place), high.max(place)));
        match self.base {
            Some(base) => (low.with_z(low.z.min(base)), high.with_z(high.z.max(base))),
            None => (low, high),
        }
    }

    /// The surface with its curves as loose lines; and, if there is a base,
    /// its walls with the lines they stand on. O(n).
    pub fn soups(&self, name: &str, options: &CurveOptions) -> (Soup, Option<Soup>) {
        let mut surface = Part::new(self, name);
        for triangle in self.triangles() {
            let corners = triangle.map(|point| surface.vertex(point, None));
            surface.soup.faces.push(&corners, []);
        }
        for line in self.lines(options) {
            surface.line(line, None);
        }
        let walls = self.base.map(|base| {
            let mut walls = Part::new(self, name);
            for [from, to] in self.borders() {
                let above = [from, to].map(|point| walls.vertex(point, None));
                let below = [to, from].map(|point| walls.vertex(point, Some(base)));
                walls.soup.faces.push(&[above, below].concat(), []);
                walls.line([from, to], Some(base));
            }
            for corner in self.corners() {
                let ends = [walls.vertex(corner, None), walls.vertex(corner, Some(base))];
                walls.soup.lines.push(ends);
            }
            walls.soup
        });
        (surface.soup, walls)
    }

    /// The place of a point of the grid, in the world: z up.
    fn place(&self, point: usize) -> DVec3 {
        let columns = self.heights.xs().len();
        let (x, z) = (self.heights.xs()[point % columns], self.heights.zs()[point / columns]);
        // Adding zero makes one zero of the two.
        DVec3::new(x, -z, self.heights.values()[point]) + DVec3::ZERO
    }

    fn cell(&self, i: usize, j: usize) -> Option<Cell> {
        let columns = self.heights.xs().len() - 1;
        self.cells.get(j.checked_mul(columns)? + i).copied().filter(|_| i < columns)
    }

    /// The points at the corners of a cell.
    fn corners_of(&self, cell: usize) -> [usize; 4] {
        let columns = self.heights.xs().len();
        let first = cell / (columns - 1) * columns + cell % (columns - 1);
        [first, first + 1, first + columns, first + columns + 1]
    }

    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> {
        self.cells.iter().enumerate().flat_map(|(index, cell)| {
            let corners = self.corners_of(index);
            cell.triangles().iter().map(move |triangle| triangle.map(|corner| corners[corner]))
        })
    }

    /// How many cells have a side of the grid: that from a point along x, or
    /// along z.
    fn cells_beside(&self, i: usize, j: usize, along_x: bool) -> usize {
        let has = |cell: Option<Cell>, side| cell.is_some_and(|cell| cell.has(side));
        let before = |index: usize| index.checked_sub(1);
        let beside = match along_x {
            true => [
                has(before(j).and_then(|j| self.cell(i, j)), Side::Near),
                has(self.cell(i, j), Side::Far),
            ],
            false => [
                has(before(i).and_then(|i| self.cell(i, j)), Side::Right),
                has(self.cell(i, j), Side::Left),
            ],
        };
        beside.into_iter().filter(|&has| has).count()
    }

    /// Sides of the grid that the surface has, which are those along x if
    /// that is asked for, with their row or column and whether they are borders.
    fn sides(&self, along_x: bool) -> impl Iterator<Item = ([usize; 2], usize, bool)> {
        let (columns, rows) = (self.heights.xs().len(), self.heights.zs().len());
        let (lines, places) = if along_x { (rows, columns - 1) } else { (columns, rows - 1) };
        (0..lines).flat_map(move |line| {
            (0..places).filter_map(move |place| {
                let (i, j) = if along_x { (place, line) } else { (line, place) };
                let from = j * columns + i;
                let to = if along_x { from + 1 } else { from + columns };
                match self.cells_beside(i, j, along_x) {
                    0 => None,
                    count => Some(([from, to], line, count == 1)),
                }
            })
        })
    }

    /// Sides across cells that are borders.
    fn sides_across(&self) -> impl Iterator<Item = [usize; 2]> {
        self.cells.iter().enumerate().filter_map(|(index, cell)| {
            let corners = self.corners_of(index);
            cell.across().map(|ends| ends.map(|corner| corners[corner]))
        })
    }

    /// All borders of the surface, those of holes too.
    fn borders(&self) -> Vec<[usize; 2]> {
        let along = [true, false].into_iter().flat_map(|along_x| self.sides(along_x));
        let along = along.filter(|(_, _, is_border)| *is_border).map(|(side, ..)| side);
        along.chain(self.sides_across()).collect()
    }

    /// The sides that are drawn.
    fn lines(&self, options: &CurveOptions) -> Vec<[usize; 2]> {
        let (columns, rows) = (self.heights.xs().len(), self.heights.zs().len());
        let mut lines = Vec::new();
        for (along_x, family, count) in
            [(true, options.constant_z, rows), (false, options.constant_x, columns)]
        {
            let drawn = |&(_, line, is_border): &([usize; 2], usize, bool)| {
                (options.borders && is_border)
                    || options.draws(family, line as u32, count as u32 - 1)
            };
            lines.extend(self.sides(along_x).filter(drawn).map(|(side, ..)| side));
        }
        if options.diagonals {
            let whole = (0..self.cells.len()).filter(|&cell| self.cells[cell].is_whole());
            lines.extend(whole.map(|cell| [0, 3].map(|corner| self.corners_of(cell)[corner])));
        }
        if options.borders || options.diagonals {
            lines.extend(self.sides_across());
        }
        lines
    }

    /// The corners of the rectangle that the surface has.
    fn corners(&self) -> Vec<usize> {
        let (columns, points) = (self.heights.xs().len(), self.heights.values().len());
        let cells = self.cells.len();
        let ends = [
            (0, 0, 0),
            (columns - 1, columns - 2, 1),
            (points - columns, cells + 1 - columns, 2),
            (points - 1, cells - 1, 3),
        ];
        let has = |&(_, cell, corner): &(usize, usize, usize)| {
            self.cells[cell].triangles().iter().flatten().any(|&c| c == corner)
        };
        ends.iter().filter(|end| has(end)).map(|(point, ..)| *point).collect()
    }
}

/// An object whose vertices are those that its faces and lines name.
struct Part<'s> {
    surface: &'s SurfaceWithHoles,
    soup: Soup,
    /// The vertex of each point, at its height and at the base.
    numbers: [Vec<u32>; 2],
}

/// No vertex.
const NONE: u32 = u32::MAX;

impl<'s> Part<'s> {
    fn new(surface: &'s SurfaceWithHoles, name: &str) -> Self {
        let none = vec![NONE; surface.heights.values().len()];
        let soup = Soup { name: name.to_owned(), ..Soup::default() };
        Part { surface, soup, numbers: [none.clone(), none] }
    }

    /// The vertex at a point, or at the base under it.
    fn vertex(&mut self, point: usize, base: Option<f64>) -> u32 {
        let number = &mut self.numbers[usize::from(base.is_some())][point];
        if *number == NONE {
            *number = self.soup.vertices.len() as u32;
            let place = self.surface.place(point);
            self.soup.vertices.push(base.map_or(place, |base| place.with_z(base)));
        }
        *number
    }

    fn line(&mut self, ends: [usize; 2], base: Option<f64>) {
        let ends = ends.map(|point| self.vertex(point, base));
        self.soup.lines.push(ends);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Mesh, Soup};

    const GAP: f64 = f64::NAN;

    fn surface(rows: &[&[f64]], base: Option<f64>) -> Result<SurfaceWithHoles, SurfaceError> {
        let steps = |count: usize| (0..count).map(|i| i as f64).collect::<Vec<_>>();
        let heights = Heights::new(steps(rows[0].len()), steps(rows.len()), rows.concat());
        SurfaceWithHoles::new(heights.unwrap(), base)
    }

    fn area(soup: &Soup) -> f64 {
        let corners = soup.faces.corners().chunks(3);
        let area = |triangle: &[u32]| {
            let [a, b, c] = [0, 1, 2].map(|i| soup.vertices[triangle[i] as usize]);
            (b - a).cross(c - a).z / 2.0
        };
        corners.map(area).sum()
    }

    #[test]
    fn cells_of_three_heights_are_one_triangle_each() {
        for gap in 0..4 {
            let mut row = [1.0; 4];
            row[gap] = GAP;
            let surface = surface(&[&row[..2], &row[2..]], None).unwrap();
            let (soup, walls) = surface.soups("a", &CurveOptions::default());
            assert_eq!((soup.faces.len(), soup.vertices.len(), soup.lines.len()), (1, 3, 3));
            assert_eq!(area(&soup), 0.5, "counterclockwise from above");
            assert!(walls.is_none());
        }
    }

    #[test]
    fn a_hole_has_a_border_and_what_is_stray_is_left_out() {
        let rows: Vec<Vec<f64>> = (0..7)
            .map(|j| {
                let missing =
                    |i: usize| (2..4).contains(&i) && (2..4).contains(&j) || j == 6 && i != 0;
                (0..6).map(|i| if missing(i) { GAP } else { (i * j) as f64 }).collect()
            })
            .collect();
        let rows: Vec<&[f64]> = rows.iter().map(|row| &row[..]).collect();
        let surface = surface(&rows, None).unwrap();
        let (soup, _) = surface.soups("a", &CurveOptions::default());
        // Of 5 x 5 cells 9 touch the hole, 4 of them at a corner alone; below
        // them is one triangle.
        assert_eq!(area(&soup), (25 - 9) as f64 + 4.0 * 0.5 + 0.5);
        let borders = surface.borders();
        // Around the rectangle and the triangle, around the hole.
        assert_eq!(borders.len(), (5 + 5 + 5 + 4 + 2) + (4 + 4));
        let mesh = Mesh::new(vec![soup], None).unwrap();
        let edges = 0..mesh.edges().len() as u32;
        let single = edges.filter(|&edge| mesh.edges().triangles(edge).len() == 1).count();
        assert_eq!(single, borders.len());
        let alone =
            CurveOptions { constant_x: false, constant_z: false, ..CurveOptions::default() };
        assert_eq!(surface.lines(&alone).len(), borders.len());
        let (low, high) = surface.bounds();
        assert_eq!((low, high), (DVec3::new(0.0, -6.0, 0.0), DVec3::new(5.0, 0.0, 25.0)));
    }

    #[test]
    fn without_a_gap_it_is_the_whole_surface() {
        use super::super::{Curves, Surface};
        let rows: [&[f64]; 3] =
            [&[1.0, 2.0, 1.0, 3.0], &[2.0, 5.0, 2.0, 1.0], &[1.0, 2.0, 3.0, 4.0]];
        let options = CurveOptions { every: 2, diagonals: true, ..CurveOptions::default() };
        let holey = surface(&rows, None).unwrap();
        let whole = Surface::new(holey.heights.clone(), None).unwrap();
        let sorted = |soup: &Soup| {
            let place = |vertex: u32| soup.vertices[vertex as usize].to_array().map(f64::to_bits);
            let mut lines: Vec<_> = soup.lines.iter().map(|line| line.map(place)).collect();
            let mut faces: Vec<Vec<_>> = soup
                .faces
                .corners()
                .chunks(3)
                .map(|t| t.iter().map(|&v| place(v)).collect())
                .collect();
            lines.sort_unstable();
            faces.sort_unstable();
            (lines, faces)
        };
        let (soup, _) = holey.soups("a", &options);
        assert_eq!(sorted(&soup), sorted(&whole.soup("a", &Curves::new(&whole, &options))));
        assert_eq!(holey.bounds(), whole.bounds());
    }

    #[test]
    fn walls_stand_under_every_border() {
        let rows: [&[f64]; 3] = [&[1.0, 2.0, 1.0], &[2.0, GAP, 2.0], &[1.0, 2.0, 3.0]];
        let surface = surface(&rows, Some(0.0)).unwrap();
        let (_, walls) = surface.soups("a", &CurveOptions::default());
        let walls = walls.unwrap();
        // Eight around, four around the hole; and the lines at four corners.
        assert_eq!((walls.faces.len(), walls.lines.len()), (12, 12 + 4));
        assert_eq!(surface.bounds().0.z, 0.0);
        let error = tests::surface(&rows, Some(2.0)).unwrap_err();
        assert!(matches!(error, SurfaceError::BaseAmongHeights { least: 1.0, greatest: 3.0, .. }));
        let lost = tests::surface(&[&[1.0, GAP], &[GAP, 1.0]], None);
        assert_eq!(lost.unwrap_err(), SurfaceError::NoCells);
    }
}
