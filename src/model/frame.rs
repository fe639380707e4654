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

/// Coordinates in the image that are a smaller share of the depth than this
/// have lost too many digits.
const FAR: f64 = 1.0 / 1_048_576.0;

impl Frame {
    /// The plane of x and y, seen from above: lines that come from no model
    /// can be drawn in it.
    pub const PLANE: Frame = Frame {
        projection: Projection::Orthographic,
        origin: DVec3::ZERO,
        right: DVec3::X,
        up: DVec3::Y,
        forward: DVec3::NEG_Z,
        shear: DVec2::ZERO,
        half_height: None,
    };

    /// Coordinates along right, up and forward, after the shear of an
    /// oblique view and before the division of a perspective one.
    pub fn coordinates(&self, point: DVec3) -> DVec3 {
        let offset = point - self.origin;
        let depth = self.forward.dot(offset);
        let mut plane = DVec2::new(self.right.dot(offset), self.up.dot(offset));
        if self.projection == Projection::Perspective
            && plane.abs().max_element() < FAR * depth.abs()
        {
            plane = self.far_plane(point);
        }
        match self.projection {
            Projection::Orthographic => (plane + self.shear * depth).extend(depth),
            Projection::Perspective => plane.extend(depth),
        }
    }

    /// Right and up coordinates of a point that is far away in comparison with
    /// them. Sums of terms as long as the way to the eye would leave few digits
    /// of them.
    #[cold]
    fn far_plane(&self, point: DVec3) -> DVec2 {
        let across = |axis| offset_along(axis, point, self.origin);
        DVec2::new(across(self.right), across(self.up))
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

/// `axis . (point - origin)` as if in twice the digits (the algorithm Dot2 of
/// Ogita, Rump and Oishi, 2005, on differences with their errors).
fn offset_along(axis: DVec3, point: DVec3, origin: DVec3) -> f64 {
    let (mut sum, mut rest) = (0.0, 0.0);
    for i in 0..3 {
        let (offset, lost) = sum_and_error(point[i], -origin[i]);
        let product = axis[i] * offset;
        let error = axis[i].mul_add(offset, -product);
        let (next, rounded) = sum_and_error(sum, product);
        sum = next;
        rest += rounded + error + axis[i] * lost;
    }
    sum + rest
}

/// A sum and what it is off by (Knuth 1969).
fn sum_and_error(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_a = sum - b;
    (sum, (a - of_a) + (b - (sum - of_a)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Camera;
    use glam::dvec3;

    /// From ever farther away a perspective picture becomes a parallel one, and
    /// keeps its digits.
    #[test]
    fn a_far_eye_sees_as_well_as_a_near_one() {
        let way = dvec3(1.0, -2.0, 1.5);
        let bounds = (DVec3::ZERO, DVec3::ONE);
        let places = [dvec3(0.1, 0.7, 0.3), dvec3(0.9, 0.2, 0.8), dvec3(0.4, 0.4, 0.6)];
        let image = |distance: f64| {
            let eye = way * distance;
            let camera = Camera::Perspective {
                eye,
                target: Some(DVec3::ZERO),
                up: DVec3::Z,
                near: None,
                fov_y_degrees: 40.0,
            };
            let frame = camera.view(bounds).unwrap().frame;
            // Apart from where the picture lies.
            let [a, b, c] = places.map(|place| frame.image(place) * eye.length());
            [b - a, c - a]
        };
        let near = image(1e9);
        for exponent in 10..16 {
            for (far, near) in image(10_f64.powi(exponent)).into_iter().zip(near) {
                assert!(far.distance(near) < 1e-8, "1e{exponent}: {far} {near}");
            }
        }
    }
}
