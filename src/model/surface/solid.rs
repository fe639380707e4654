//! A surface without holes, with or without a base, as points of the world.

use super::{Curves, Heights, SurfaceError};
use crate::model::{Mesh, MeshError, Soup};
use glam::DVec3;

/// Heights everywhere on a grid, and perhaps walls down to a base.
///
/// Vertices are numbered row by row, each from least x. Behind them come those
/// of the base, one under each of the border: under the first row, the last
/// row, and what is between at least and at greatest x.
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

    /// Whether there is a base below the borders; above them it may be too.
    pub fn has_base_below(&self) -> bool {
        self.base.is_some_and(|base| base < self.heights.values()[0])
    }

    /// The vertex in a column and a row.
    pub fn vertex(&self, column: u32, row: u32) -> u32 {
        row * self.columns() + column
    }

    /// The vertex of the base under one of the border.
    pub fn base_vertex(&self, column: u32, row: u32) -> u32 {
        let (columns, rows) = (self.columns(), self.rows());
        let along = if row == 0 {
            column
        } else if row == rows - 1 {
            columns + column
        } else {
            2 * columns + row - 1 + if column == 0 { 0 } else { rows - 2 }
        };
        columns * rows + along
    }

    /// The column and the row of a place along a border; borders are the
    /// first row, the last row, least x and greatest x.
    pub fn place_on_side(&self, side: usize, place: u32) -> [u32; 2] {
        match side {
            0 => [place, 0],
            1 => [place, self.rows() - 1],
            2 => [0, place],
            _ => [self.columns() - 1, place],
        }
    }

    /// The number of places along a border.
    pub fn length_of_side(&self, side: usize) -> u32 {
        if side < 2 { self.columns() } else { self.rows() }
    }

    /// The column and the row of a corner: least and greatest x of the first
    /// row, then of the last.
    pub fn corner(&self, corner: usize) -> [u32; 2] {
        let (right, far) = (self.columns() - 1, self.rows() - 1);
        [[0, 0], [right, 0], [0, far], [right, far]][corner]
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
            let inner = 1..self.rows() - 1;
            let sides =
                [(0, 0..self.columns()), (1, 0..self.columns()), (2, inner.clone()), (3, inner)];
            for (side, places) in sides {
                for place in places {
                    let [i, j] = self.place_on_side(side, place);
                    let above = vertices[self.vertex(i, j) as usize];
                    vertices.push(above.with_z(base));
                }
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

    /// The cells as triangles, walls as quadrilaterals, and `curves` as loose
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
            for side in 0..4 {
                for place in 1..self.length_of_side(side) {
                    let ends = [place - 1, place].map(|place| self.place_on_side(side, place));
                    let [a, b] = ends.map(|[i, j]| self.vertex(i, j));
                    let [c, d] = ends.map(|[i, j]| self.base_vertex(i, j));
                    soup.faces.push(&[a, b, d, c], []);
                }
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

    fn border(&self) -> impl Iterator<Item = u32> {
        (0..4).flat_map(move |side| {
            (0..self.length_of_side(side)).map(move |place| {
                let [i, j] = self.place_on_side(side, place);
                self.vertex(i, j)
            })
        })
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
        assert_eq!(mesh.face_count(), 8 + 8);
        assert_eq!(mesh.report().nonplanar_faces, 0);
        let borders = (0..mesh.edges().len() as u32)
            .filter(|&edge| mesh.edges().triangles(edge).len() == 1)
            .count();
        // Only the bottom is open.
        assert_eq!(borders, 8);
        assert_eq!(mesh.vertices().len(), 9 + 8);
        assert_eq!(mesh.report().welded_vertices, 0);
        assert_eq!(mesh.vertices()[5], DVec3::new(2.0, -1.0, 2.0));
        assert_eq!(mesh.bounds(), surface.bounds());
        for side in 0..4 {
            for place in 0..3 {
                let [i, j] = surface.place_on_side(side, place);
                let [top, foot] = [surface.vertex(i, j), surface.base_vertex(i, j)];
                let at = |vertex: u32| mesh.vertices()[vertex as usize];
                assert_eq!(at(foot), at(top).with_z(0.0));
            }
        }
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
