//! From a point of the image back into space, rounded once.
//!
//! A drawing is written in the coordinates of the view frame, which charts
//! know nothing of. So a point of the image becomes a displacement in space
//! that has it as its image, exact but for one rounding of each component.

use super::chart::Projection;
use super::{Chart, ImagePoint, Points, Policy, Predicates};
use crate::kernel::numbers::{Dyadic, Ring, SmallInteger, dot, scale_by_power_of_two};
use glam::DVec3;

impl<P: Policy> Predicates<'_, P> {
    /// A displacement whose image is a point: in parallel views from the
    /// first vertex, in world units; in central ones from the eye, of some
    /// length. Each component is off by a few units in its last place.
    pub fn offset_of_image(&self, chart: &Chart, point: ImagePoint) -> DVec3 {
        let points = self.points();
        let bits = chart.point_bits(point).dot(chart.key_bits()) + 2 * points.spread() + 4;
        let exponent = if chart.is_central() { 0 } else { points.integer_exponent() };
        let width = if points.is_narrow() { bits } else { u32::MAX };
        let offset = match width {
            0..=255 => quotients::<4>(chart, points, point),
            256..=383 => quotients::<6>(chart, points, point),
            384..=511 => quotients::<8>(chart, points, point),
            _ => {
                let (parts, weight) = offset::<Dyadic>(chart, points, point);
                let part = |part: &Dyadic| Dyadic::scaled_ratio(part, &weight, exponent);
                return DVec3::from(parts.each_ref().map(part));
            }
        };
        DVec3::from(offset.map(|part| scale_by_power_of_two(part, exponent.into())))
    }
}

fn quotients<const N: usize>(chart: &Chart, points: &Points, point: ImagePoint) -> [f64; 3] {
    let (parts, weight) = offset::<SmallInteger<N>>(chart, points, point);
    parts.map(|part| SmallInteger::ratio(&part, &weight))
}

/// Numerators and their common denominator.
fn offset<R: Ring>(chart: &Chart, points: &Points, point: ImagePoint) -> ([R; 3], R) {
    let [x, y, w] = chart.point::<R>(points, point);
    let zero = || R::read(0.0, 0);
    match chart.projection() {
        Projection::Flat => ([x, y, zero()], w),
        Projection::Parallel { axes, mirrored } => {
            // Of all displacements the one across the largest axis.
            let [i, j] = chart.plane_axes(axes, mirrored);
            let scale = points.eye::<R>()[axes[2]].clone();
            let mut parts = [zero(), zero(), zero()];
            (parts[i], parts[j]) = (x, y);
            (parts, w * scale)
        }
        Projection::Central { .. } => {
            let front = chart.front::<R>(points);
            let weight = dot(front, [x.clone(), y.clone(), w.clone()]);
            // The chart exchanges two axes.
            ([y, x, w], weight)
        }
    }
}
