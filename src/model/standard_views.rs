//! The named views: six principal ones, isometrics, dimetric, obliques.
//!
//! Principal and isometric directions are exact small integers. z is up; y
//! points north, away from the viewer of the front view.

use super::camera::frame;
use super::{CameraError, Projection, View};
use crate::kernel::predicates::Eye;
use glam::{DVec2, DVec3};

/// A named view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandardView {
    name: &'static str,
    /// Towards the viewer.
    towards: [f64; 3],
    /// What is up in the picture.
    up: [f64; 3],
    /// Obliques: how far the image moves right and up per unit of depth.
    recession: f64,
}

/// Half the square root of two, rounded: a receding axis at 45 degrees.
const DIAGONAL: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Seen from (1, -sqrt 7, 1), x and z keep their length and y is halved:
/// the engineer's dimetric with axes at 7 and 42 degrees.
const SQRT_7: f64 = 2.645_751_311_064_590_7;

const Z: [f64; 3] = [0.0, 0.0, 1.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];

const fn parallel(name: &'static str, towards: [f64; 3], up: [f64; 3]) -> StandardView {
    StandardView { name, towards, up, recession: 0.0 }
}

const fn oblique(name: &'static str, recession: f64) -> StandardView {
    StandardView { name, towards: [recession, -1.0, recession], up: Z, recession }
}

impl StandardView {
    /// All named views.
    pub const ALL: [StandardView; 19] = [
        parallel("front", [0.0, -1.0, 0.0], Z),
        parallel("back", [0.0, 1.0, 0.0], Z),
        parallel("left", [-1.0, 0.0, 0.0], Z),
        parallel("right", [1.0, 0.0, 0.0], Z),
        parallel("top", [0.0, 0.0, 1.0], Y),
        parallel("bottom", [0.0, 0.0, -1.0], Y),
        parallel("iso", [1.0, 1.0, 1.0], Z),
        parallel("iso-ne", [1.0, 1.0, 1.0], Z),
        parallel("iso-nw", [-1.0, 1.0, 1.0], Z),
        parallel("iso-sw", [-1.0, -1.0, 1.0], Z),
        parallel("iso-se", [1.0, -1.0, 1.0], Z),
        parallel("iso-under", [1.0, 1.0, -1.0], Z),
        parallel("iso-ne-under", [1.0, 1.0, -1.0], Z),
        parallel("iso-nw-under", [-1.0, 1.0, -1.0], Z),
        parallel("iso-sw-under", [-1.0, -1.0, -1.0], Z),
        parallel("iso-se-under", [1.0, -1.0, -1.0], Z),
        parallel("dimetric", [1.0, -SQRT_7, 1.0], Z),
        oblique("cavalier", DIAGONAL),
        oblique("cabinet", DIAGONAL / 2.0),
    ];

    /// The view called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|view| view.name == name)
    }

    /// The name, as in `--view`.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The same view with another up vector.
    #[must_use]
    pub fn with_up(self, up: DVec3) -> Self {
        StandardView { up: up.to_array(), ..self }
    }

    /// Whether the view has rays oblique to its picture plane; its up
    /// vector cannot be chosen.
    pub fn is_oblique(&self) -> bool {
        self.recession != 0.0
    }

    /// The view with the frame's origin at `target`.
    pub(super) fn view(&self, target: DVec3) -> Result<View, CameraError> {
        let towards = DVec3::from(self.towards);
        let forward = if self.is_oblique() { DVec3::Y } else { -towards };
        let shear = DVec2::splat(self.recession);
        let frame = frame(Projection::Orthographic, target, forward, DVec3::from(self.up), shear)?;
        Ok(View { eye: Eye::Towards(towards), near: None, frame })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_view_makes_a_frame_whose_rays_go_to_points() -> Result<(), CameraError> {
        for named in StandardView::ALL {
            let view = named.view(DVec3::new(1.0, 2.0, 3.0))?;
            let start = DVec3::new(0.25, -1.5, 0.75);
            let moved = start + view.eye.coordinates() * 2.0;
            let shift = view.frame.image(moved) - view.frame.image(start);
            assert!(shift.length() < 1e-14, "{}: {shift}", named.name());
            assert!(view.frame.depth(moved) < view.frame.depth(start), "{}", named.name());
        }
        Ok(())
    }
}
