//! The view frame: the rounded, orthonormal coordinates in which drawings
//! are written. No decision is ever taken in it.

use glam::{DVec2, DVec3};

/// How points reach the image plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Projection {
    /// Along parallel rays.
    Orthographic,
    /// Through the eye.
    Perspective,
}

/// Image axes in world units. `u` runs along `right`, `v` along `up`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Parallel or central.
    pub projection: Projection,
    /// The target (orthographic) or the eye (perspective), world units.
    pub origin: DVec3,
    /// Unit vector to the right in the image.
    pub right: DVec3,
    /// Unit vector upwards in the image.
    pub up: DVec3,
    /// Unit vector into the image, away from the viewer.
    pub forward: DVec3,
    /// Oblique projections: image displacement per unit of depth
    /// (`u` and `v` grow by this much per unit of depth); zero otherwise.
    pub shear: DVec2,
    /// Perspective: tangent of half the vertical field of view. Drawings are
    /// cut to it, lines are not.
    pub half_height: Option<f64>,
}

impl Frame {
    /// Coordinates along right, up and forward, after the shear of an
    /// oblique view and before the division of a perspective one.
    pub fn coordinates(&self, point: DVec3) -> DVec3 {
        let offset = point - self.origin;
        let depth = self.forward.dot(offset);
        let plane = DVec2::new(self.right.dot(offset), self.up.dot(offset));
        match self.projection {
            Projection::Orthographic => (plane + self.shear * depth).extend(depth),
            Projection::Perspective => plane.extend(depth),
        }
    }

    /// Depth of a world point: signed distance along `forward`, world units.
    pub fn depth(&self, point: DVec3) -> f64 {
        self.forward.dot(point - self.origin)
    }

    /// Image coordinates of a world point: world units (orthographic) or
    /// tangents (perspective, where the depth must be positive).
    pub fn image(&self, point: DVec3) -> DVec2 {
        let point = self.coordinates(point);
        match self.projection {
            Projection::Orthographic => point.truncate(),
            Projection::Perspective => point.truncate() / point.z,
        }
    }
}
