//! Boxes in world axes, rounded outward: for what does not depend on the eye.

use super::Mesh;
use crate::spatial::{Bounds, Hierarchy, Rounding};
use glam::Vec3A;

/// Boxes around vertices of a mesh.
#[derive(Debug, Clone)]
pub(super) struct WorldBoxes<'m> {
    mesh: &'m Mesh,
    rounding: Rounding,
}

impl<'m> WorldBoxes<'m> {
    pub(super) fn new(mesh: &'m Mesh) -> Self {
        let (low, high) = mesh.bounds();
        let ranges = [low.x..high.x, low.y..high.y, low.z..high.z];
        WorldBoxes { mesh, rounding: Rounding::for_ranges(ranges) }
    }

    pub(super) fn around(&self, vertices: &[u32]) -> Bounds {
        vertices.iter().fold(Bounds::EMPTY, |bounds, &vertex| {
            let point = self.mesh.vertices()[vertex as usize];
            bounds.union(&self.rounding.around(point, point))
        })
    }

    /// About where a vertex lies.
    fn place(&self, vertex: u32) -> Vec3A {
        let point = self.mesh.vertices()[vertex as usize];
        Vec3A::from_array([0, 1, 2].map(|axis| self.rounding.nearest(axis, point[axis])))
    }

    /// Some triangles in a hierarchy.
    pub(super) fn hierarchy(&self, triangles: Vec<u32>) -> Hierarchy {
        let corners = |triangle: usize| self.mesh.triangles()[triangle];
        let place = |triangle: usize| self.place(corners(triangle)[0]);
        Hierarchy::of_some(triangles, place, |triangle| self.around(&corners(triangle)))
    }
}
