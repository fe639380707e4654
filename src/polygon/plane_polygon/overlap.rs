//! Where the image of one polygon lies upon that of another.

use super::{Cut, PlanePolygon};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Plane, Policy, Predicates};

impl PlanePolygon {
    /// The part of the polygon on which all planes have their signs, if that
    /// part has an area: with the planes of [`PlanePolygon::shadow`] what lies
    /// in the image of another polygon. O(product of corners).
    #[must_use]
    pub fn within<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        mut planes: impl Iterator<Item = (Plane, Sign)>,
    ) -> Option<PlanePolygon> {
        planes.try_fold(self.clone(), |polygon, (plane, inside)| {
            match (polygon.cut(predicates, plane), inside) {
                (Cut::Below, Sign::Negative) | (Cut::Above, Sign::Positive) => Some(polygon),
                (Cut::Parted([below, _]), Sign::Negative) => Some(below),
                (Cut::Parted([_, above]), Sign::Positive) => Some(above),
                _ => None,
            }
        })
    }
}
