//! Cameras: from what a user says to the exact eye and the rounded frame.
//!
//! The exact part is the eye (a direction or a point) and the near plane.
//! `target - eye` is subtracted once in f64 and is the input from there on.
//! The frame is normalised and rounded; only drawings are written in it.

use super::{Frame, Projection, StandardView};
use crate::kernel::predicates::{Eye, NearPlane, are_collinear};
use glam::{DVec2, DVec3};

/// What is looked at, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Camera {
    /// One of the named views; the target is the centre of the model's box.
    Standard(StandardView),
    /// Parallel rays along `forward`.
    Orthographic {
        /// The way the eye looks; any length.
        forward: DVec3,
        /// The origin of the view frame; the centre of the box if absent.
        target: Option<DVec3>,
        /// What is up in the picture.
        up: DVec3,
    },
    /// A viewer at `eye`.
    Perspective {
        /// Where the viewer is, world units.
        eye: DVec3,
        /// What is in the middle of the picture; the centre of the box if absent.
        target: Option<DVec3>,
        /// What is up in the picture.
        up: DVec3,
        /// Distance of the near plane, world units; a thousandth of the
        /// distance of the target if absent.
        near: Option<f64>,
        /// Vertical field of view in degrees.
        fov_y_degrees: f64,
    },
}

/// A camera that cannot be used.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CameraError {
    /// The viewing direction has no length.
    #[error("the eye and the target are the same point: expected two different points")]
    NoDirection,
    /// The up vector does not say what is up.
    #[error("up is parallel to the viewing direction: expected another up vector")]
    UpAlongDirection,
    /// The near plane must lie in front of the eye.
    #[error("near is {0}: expected a distance greater than 0")]
    BadNear(f64),
    /// The field of view is an angle between 0 and 180 degrees.
    #[error("fov is {0}: expected degrees between 0 and 180")]
    BadFieldOfView(f64),
    /// A number is infinite or not a number.
    #[error("the camera has a number that is not finite")]
    NotFinite,
}

/// A camera applied to a model: exact eye, near plane and rounded frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// The eye, exactly.
    pub eye: Eye,
    /// The near plane (perspective only).
    pub near: Option<NearPlane>,
    /// The frame of the drawing.
    pub frame: Frame,
}

impl Camera {
    /// The view of a model whose box runs from `bounds.0` to `bounds.1`.
    ///
    /// # Errors
    ///
    /// If the direction or the up vector say nothing, or a number is out of
    /// its range.
    pub fn view(&self, bounds: (DVec3, DVec3)) -> Result<View, CameraError> {
        let centre = bounds.0 * 0.5 + bounds.1 * 0.5;
        match *self {
            Camera::Standard(view) => view.view(centre),
            Camera::Orthographic { forward, target, up } => {
                let target = target.unwrap_or(centre);
                let frame = frame(Projection::Orthographic, target, forward, up, DVec2::ZERO)?;
                Ok(View { eye: Eye::Towards(-forward), near: None, frame })
            }
            Camera::Perspective { eye, target, up, near, fov_y_degrees } => {
                let forward = target.unwrap_or(centre) - eye;
                let frame = frame(Projection::Perspective, eye, forward, up, DVec2::ZERO)?;
                let distance = near.unwrap_or(forward.length() / 1000.0);
                if !(distance > 0.0 && distance.is_finite()) {
                    return Err(CameraError::BadNear(distance));
                }
                if !(fov_y_degrees > 0.0 && fov_y_degrees < 180.0) {
                    return Err(CameraError::BadFieldOfView(fov_y_degrees));
                }
                Ok(View {
                    eye: Eye::At(eye),
                    near: Some(NearPlane { forward, distance }),
                    frame: Frame {
                        half_height: Some((fov_y_degrees.to_radians() / 2.0).tan()),
                        ..frame
                    },
                })
            }
        }
    }
}

/// The rounded frame for a direction and an up vector.
pub(super) fn frame(
    projection: Projection,
    origin: DVec3,
    forward: DVec3,
    up: DVec3,
    shear: DVec2,
) -> Result<Frame, CameraError> {
    if !(forward.is_finite() && up.is_finite() && origin.is_finite()) {
        return Err(CameraError::NotFinite);
    }
    if forward == DVec3::ZERO {
        return Err(CameraError::NoDirection);
    }
    if are_collinear(DVec3::ZERO, forward, up) {
        return Err(CameraError::UpAlongDirection);
    }
    let forward = unit(forward);
    let right = unit(forward.cross(unit(up)));
    Ok(Frame {
        projection,
        origin,
        right,
        up: right.cross(forward),
        forward,
        shear,
        half_height: None,
    })
}

/// The vector at length one, whatever its length was; exact for axes.
fn unit(vector: DVec3) -> DVec3 {
    // Dividing by a power of two near the largest component keeps squares
    // in range.
    let scale = f64::powi(2.0, -vector.abs().max_element().log2().floor() as i32 / 2);
    (vector * scale * scale).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: (DVec3, DVec3) = (DVec3::ZERO, DVec3::ONE);

    #[test]
    fn front_view_has_the_exact_axes() -> Result<(), CameraError> {
        let camera = Camera::Orthographic { forward: DVec3::Y * 7.0, target: None, up: DVec3::Z };
        let view = camera.view(BOX)?;
        assert_eq!(view.frame.right, DVec3::X);
        assert_eq!(view.frame.up, DVec3::Z);
        assert_eq!(view.frame.origin, DVec3::splat(0.5));
        assert_eq!(view.eye, Eye::Towards(-DVec3::Y * 7.0));
        Ok(())
    }

    #[test]
    fn up_along_the_direction_is_refused() {
        let camera = Camera::Orthographic { forward: -DVec3::Z, target: None, up: DVec3::Z };
        assert_eq!(camera.view(BOX), Err(CameraError::UpAlongDirection));
    }

    #[test]
    fn tiny_and_huge_vectors_are_normalised() {
        for size in [1e-300, 1.0, 1e300] {
            assert!((unit(DVec3::new(3.0, 0.0, 4.0) * size).length() - 1.0).abs() < 1e-15);
        }
    }
}
