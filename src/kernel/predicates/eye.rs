//! The eye as one homogeneous point, and the near plane.

use glam::DVec3;

/// Where the picture is seen from, exactly as given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Eye {
    /// A viewer infinitely far away in this direction: the vector points
    /// *towards* the viewer and need not be a unit vector.
    Towards(DVec3),
    /// A viewer at this point, world units.
    At(DVec3),
}

impl Eye {
    /// The three coordinates of the point or direction.
    pub fn coordinates(self) -> DVec3 {
        match self {
            Eye::Towards(direction) => direction,
            Eye::At(point) => point,
        }
    }

    /// Whether the eye is a point, not a direction.
    pub fn is_perspective(self) -> bool {
        matches!(self, Eye::At(_))
    }
}

/// The plane in front of a perspective eye at which lines are cut:
/// `forward . (x - eye) = offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearPlane {
    /// The viewing direction, not normalised, exactly as given.
    pub forward: DVec3,
    /// World distance from the eye; made a multiple of the scene's unit
    /// times the length of `forward`, and exact from there on.
    pub distance: f64,
}
