//! A surface without holes, with or without a base, as points of the world.

use super::{Curves, Heights, SurfaceError};
use crate::model::{Mesh, MeshError, Soup};
use glam::DVec3;

/// Heights everywhere on a grid, and perhaps walls down to a base.
///
/// Vertices are numbered row by row, each from least x; behind them come the
/// four corners of the base, at least and greatest x of the first row, then
/// of the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    heights: Heights,
    base: Option<f64>,
}

impl Surface {
    /// A surface; with a base, walls stand under its four borders.
    ///
    /// # Errors
    ///
    /// If heights are missing, or the base lies among those of the borders.
    pub fn new(heights: Heights, base: Option<f64>) -> Result<Self, SurfaceError> {
        heights.check_complete()?;
        let surface = Surface { heights, base };
        if let Some(base) = base {
            let border = surface.border().map(|vertex| surface.heights.values()[vertex as usize]);
            let empty = (f64::INFINITY, f64::NEG_INFINITY);
            let (least, greatest) = border
                .fold(empty, |(least, greatest), h| (f64::min(least, h), f64::max(greatest, h)));
            if !base.is_finite() || (least <= base && base <= greatest) {
                return Err(SurfaceError::BaseAmongHeights { base, least, greatest });
            }
        }
        Ok(surface)
    }

    /// The heights.
    pub fn heights(&self) -> &Heights {
        &self.heights
    }

    /// The number of points along x.
    pub fn columns(&self) -> u32 {
        self.heights.xs().len() as u32
    }

    /// The number of points along z.
    pub fn rows(&self) -> u32 {
        self.heights.zs().len() as u32
    }

    /// Whether walls stand under the borders.
    pub fn has_base(&self) -> bool {
        self.base.is_some()
    }

    /// The vertex in a column and a row.
    pub fn vertex(&self, column: u32, row: u32) -> u32 {
        row * self.columns() + column
    }

    /// The corners of the grid: least and greatest x of the first row, then
    /// of the last.
    pub fn corners(&self) -> [u32; 4] {
        let (right, far) = (self.columns() - 1, self.rows() - 1);
        [[0, 0], [right, 0], [0, far], [right, far]].map(|[i, j]| self.vertex(i, j))
    }

    /// The corner of the base below a corner of the grid.
    pub fn base_corner(&self, corner: usize) -> u32 {
        self.columns() * self.rows() + corner as u32
    }

    /// All vertices, in the world: z up.
    pub fn vertices(&self) -> Vec<DVec3> {
        let (xs, zs) = (self.heights.xs(), self.heights.zs());
        let rows = zs.iter().zip(self.heights.values().chunks(xs.len()));
        let mut vertices = Vec::with_capacity(self.heights.values().len() + 4);
        for (&z, row) in rows {
            // Adding zero makes one zero of the two.
            vertices.extend(xs.iter().zip(row).map(|(&x, &y)| DVec3::new(x, -z, y) + DVec3::ZERO));
        }
        if let Some(base) = self.base {
            for corner in self.corners() {
                vertices.push(vertices[corner as usize].with_z(base));
            }
        }
        vertices
    }

    /// The box of all vertices as (least, greatest) corner. O(n).
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let (xs, zs) = (self.heights.xs(), self.heights.zs());
        let heights = self.heights.values().iter().copied().chain(self.base);
        let empty = (f64::INFINITY, f64::NEG_INFINITY);
        let (least, greatest) =
            heights.fold(empty, |(least, greatest), h| (least.min(h), greatest.max(h)));
        let (right, near) = (xs[xs.len() - 1], zs[zs.len() - 1]);
        (DVec3::new(xs[0], -near, least), DVec3::new(right, -zs[0], greatest))
    }

    /// The cells as triangles, walls as polygons, and `curves` as loose
    /// lines: a model for any method.
    pub fn soup(&self, name: &str, curves: &Curves) -> Soup {
        let mut soup = Soup {
            name: name.to_owned(),
            vertices: self.vertices(),
            lines: curves.lines(self),
            ..Soup::default()
        };
        for j in 0..self.rows() - 1 {
            for i in 0..self.columns() - 1 {
                let [a, b] = [self.vertex(i, j), self.vertex(i + 1, j)];
                let [c, d] = [self.vertex(i, j + 1), self.vertex(i + 1, j + 1)];
                soup.faces.push(&[a, d, b], []);
                soup.faces.push(&[a, c, d], []);
            }
        }
        if self.has_base() {
            for (side, border) in self.sides().into_iter().enumerate() {
                let [first, last] = self.side_corners(side).map(|corner| self.base_corner(corner));
                let wall: Vec<u32> = border.into_iter().chain([last, first]).collect();
                soup.faces.push(&wall, []);
            }
        }
        soup
    }

    /// A mesh of the vertices and the curves alone, without faces.
    ///
    /// # Errors
    ///
    /// If there is no curve.
    pub fn mesh_of_curves(&self, name: &str, curves: &Curves) -> Result<Mesh, MeshError> {
        Mesh::of_lines(name, self.vertices(), curves.lines(self))
    }

    /// The corners from and to which a border goes: those of the first and
    /// the last row, then of least and greatest x.
    pub fn side_corners(&self, side: usize) -> [usize; 2] {
        [[0, 1], [2, 3], [0, 2], [1, 3]][side]
    }

    /// The vertices of the four borders. O(rows + columns).
    pub fn sides(&self) -> [Vec<u32>; 4] {
        let (right, far) = (self.columns() - 1, self.rows() - 1);
        let row = |j| (0..=right).map(|i| self.vertex(i, j)).collect::<Vec<_>>();
        let column = |i| (0..=far).map(|j| self.vertex(i, j)).collect::<Vec<_>>();
        [row(0), row(far), column(0), column(right)]
    }

    fn border(&self) -> impl Iterator<Item = u32> {
        self.sides().into_iter().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::super::CurveOptions;
    use super::*;

    fn hill() -> Heights {
        let steps = |count: usize| (0..count).map(|i| i as f64).collect::<Vec<_>>();
        let values = vec![1.0, 2.0, 1.0, 2.0, 5.0, 2.0, 1.0, 2.0, 3.0];
        Heights::new(steps(3), steps(3), values).unwrap()
    }

    #[test]
    fn a_surface_on_a_base_has_walls_all_around() {
        let surface = Surface::new(hill(), Some(0.0)).unwrap();
        let curves = Curves::new(&surface, &CurveOptions::default());
        let mesh = Mesh::new(vec![surface.soup("hill", &curves)], None).unwrap();
        assert_eq!(mesh.face_count(), 8 + 4);
        assert_eq!(mesh.report().nonplanar_faces, 0);
        let borders = (0..mesh.edges().len() as u32)
            .filter(|&edge| mesh.edges().triangles(edge).len() == 1)
            .count();
        // Only the bottom is open.
        assert_eq!(borders, 4);
        assert_eq!(mesh.vertices().len(), 13);
        assert_eq!(mesh.vertices()[5], DVec3::new(2.0, -1.0, 2.0));
        assert_eq!(mesh.bounds(), surface.bounds());
    }

    #[test]
    fn a_base_among_the_heights_of_the_border_is_refused() {
        let error = Surface::new(hill(), Some(3.0)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the base 3 lies among the heights of the border, 1 to 3: expected one below or above \
             them"
        );
        assert!(Surface::new(hill(), Some(3.5)).is_ok());
    }
}
