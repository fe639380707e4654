//! Masks of half-planes by the angle and the distance of their edge.
//!
//! `E(x, y) = (dY (x - xa) - dX (y - ya)) / sqrt(dX^2 + dY^2)` is the signed
//! distance of a point from an edge in pixels. At the middle of a pixel it
//! and the direction in which it grows say how the half-plane lies in the
//! pixel. Both are rounded to classes; the mask of a class has
//! `round(bits x covered area)` bits, those of the sub-pixels that lie
//! deepest in the half-plane. The mask of the opposite half-plane is made
//! of the other bits, so triangles side by side leave nothing out.
//!
//! **How far a mask is from the direct one.** Let the edge cross the pixel,
//! with a chord of length `c <= sqrt 2`.
//!
//! 1. Rounding the angle turns the edge by at most `pi / ANGLES`; an area
//!    changes by at most `c^2 / 2` times that, so by `1 / ANGLES * pi`.
//! 2. Rounding the distance moves it by at most half a class, `sqrt(1/2) /
//!    DISTANCES`, and the area by c times that, at most `1 / DISTANCES`.
//! 3. The count of centres inside differs from the area in bits by at most
//!    [`MaskTable::lattice_error`]. A line parallel to a side passes all centres of
//!    a column (8 at most, in 4 x 8) at once, half of them early at worst: 4
//!    bits, or 2 of 16. For other directions the columns' errors, each at
//!    most half a bit and the two that the edge enters or leaves through a
//!    level side included, are no larger in sum.
//! 4. Rounding to whole bits: a half.
//!
//! With 256 angles and 128 distances 1 and 2 are less than 0.33 bits of 16
//! and 0.65 of 32, so a half-plane's mask has at most 2 bits of 16, or 5 of
//! 32, more or fewer than the direct one. Where counts agree bits may still
//! be others, for deepest is meant against the class's direction: the tests
//! measure both.

use super::{ABufferOptions, Division, Masks};
use std::f64::consts::{SQRT_2, TAU};

/// Classes of angles in a full turn.
const ANGLES: usize = 256;

/// Classes of distances, from half a diagonal before the middle to as much
/// behind it.
const DISTANCES: usize = 128;

/// Masks of half-planes.
#[derive(Debug, Clone)]
pub struct MaskTable {
    division: Division,
    /// By angle, then by distance.
    masks: Vec<u32>,
}

impl MaskTable {
    /// The table for a division. O(classes x bits).
    pub fn new(division: Division) -> Self {
        let half_turn = ANGLES / 2;
        let mut masks = vec![0; ANGLES * DISTANCES];
        for angle in 0..half_turn {
            for class in 0..DISTANCES {
                let mask = class_mask(division, angle, class);
                masks[angle * DISTANCES + class] = mask;
                let opposite = (angle + half_turn) * DISTANCES + DISTANCES - 1 - class;
                masks[opposite] = !mask & division.full();
            }
        }
        MaskTable { division, masks }
    }

    /// The table that options ask for, if they do.
    pub(super) fn of(options: ABufferOptions) -> Option<Self> {
        (options.masks == Masks::Table).then(|| Self::new(options.division))
    }

    /// How a pixel is divided.
    pub fn division(&self) -> Division {
        self.division
    }

    /// Bits by which a count of centres may differ from the covered area.
    pub fn lattice_error(division: Division) -> u32 {
        division.rows() / 2
    }

    /// Bits by which the size of a half-plane's mask may differ from that of
    /// the direct mask: see above.
    pub fn bound(division: Division) -> u32 {
        let bits = f64::from(division.bits());
        let classes = bits * (TAU / 2.0 / ANGLES as f64 + 1.0 / DISTANCES as f64);
        (f64::from(Self::lattice_error(division)) + classes + 0.5).floor() as u32
    }

    /// The mask of the half-plane `value + gradient . (x - middle) >= 0` of
    /// a pixel of side one, y downwards.
    pub fn half_plane(&self, gradient: [f64; 2], value: f64) -> u32 {
        let length = gradient[0].hypot(gradient[1]);
        let distance = value / length;
        let place = (distance / (SQRT_2 / 2.0) + 1.0) / 2.0 * DISTANCES as f64;
        if place < 0.0 {
            return 0;
        }
        if place.is_nan() || DISTANCES as f64 <= place {
            // Wholly inside; or no edge at all, which cuts off nothing.
            return self.division.full();
        }
        let turn = gradient[1].atan2(gradient[0]) / TAU * ANGLES as f64;
        let angle = (turn.round() as i64).rem_euclid(ANGLES as i64) as usize;
        self.masks[angle * DISTANCES + place as usize]
    }
}

/// The mask of one class.
fn class_mask(division: Division, angle: usize, class: usize) -> u32 {
    let (sine, cosine) = (angle as f64 / ANGLES as f64 * TAU).sin_cos();
    let distance = ((class as f64 + 0.5) / DISTANCES as f64 * 2.0 - 1.0) * SQRT_2 / 2.0;
    let area = covered_area([cosine, sine], distance);
    let count = (f64::from(division.bits()) * area).round() as usize;
    let depth = |bit: u32| {
        let x = (f64::from(bit % division.columns()) + 0.5) / f64::from(division.columns()) - 0.5;
        let y = (f64::from(bit / division.columns()) + 0.5) / f64::from(division.rows()) - 0.5;
        cosine * x + sine * y
    };
    let mut order: Vec<u32> = (0..division.bits()).collect();
    order.sort_by(|&a, &b| depth(b).total_cmp(&depth(a)).then(a.cmp(&b)));
    order.iter().take(count).fold(0, |mask, bit| mask | 1 << bit)
}

/// The area of the part of a unit square around the origin where
/// `normal . x + distance >= 0`, for a unit normal.
fn covered_area(normal: [f64; 2], distance: f64) -> f64 {
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    let value = |p: [f64; 2]| normal[0] * p[0] + normal[1] * p[1] + distance;
    let mut kept: Vec<[f64; 2]> = Vec::with_capacity(6);
    for (i, &p) in corners.iter().enumerate() {
        let q = corners[(i + 1) % 4];
        let (a, b) = (value(p), value(q));
        if a >= 0.0 {
            kept.push(p);
        }
        if (a < 0.0) != (b < 0.0) {
            let t = a / (a - b);
            kept.push([p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t]);
        }
    }
    let next = kept.iter().cycle().skip(1);
    let twice: f64 = kept.iter().zip(next).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum();
    (twice / 2.0).clamp(0.0, 1.0)
}
