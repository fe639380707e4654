//! The coordinates of a view: vertices and eye, scaled to integers.
//!
//! One pass measures the *spread*: the number of binary orders between the
//! highest set bit and the lowest set bit of any coordinate. Where it is at
//! most 167, everything is multiplied by one power of two, so that all
//! coordinates are integers below `2^spread` held in floats: products then
//! cannot underflow, they overflow only beyond a known degree, and integer
//! arithmetic of fixed width reads the very same array. The direction of an
//! orthographic eye and the forward direction are scaled on their own, for
//! a determinant is linear in each row. Wider scenes (1e-60 beside 1) stay as
//! they are: floats decide what is certain beyond all that underflow may do,
//! and integers with exponents of their own the rest.

use super::{Eye, Formula, NearPlane};
use crate::kernel::numbers::{Ring, Significand, scale_by_power_of_two};
use crate::run::{fill_indexed, map_chunks};
use glam::DVec3;

/// The largest spread of scenes that are scaled to integers: floats still
/// hold the formulas of degree 6, and so whatever a filter or a proposal is
/// made of. Formulas of more bits than a fixed width has, or a float, are
/// passed on one by one, by their own count of bits. Such scenes are no
/// rarity: coordinates of 1e-20 or so, left where a modeller turned a part by
/// a right angle, make 120 bits and more beside those of the part itself.
const NARROW: u32 = 167;

/// Bits of the largest float exponent, with room for the sums of a formula.
const FLOAT_BITS: u32 = 1020;

/// Lowest and highest exponent of the bits in use, if there is any bit.
#[derive(Debug, Clone, Copy)]
struct BitRange {
    lowest: i32,
    above: i32,
}

impl BitRange {
    const EMPTY: Self = BitRange { lowest: i32::MAX, above: i32::MIN };

    fn include(&mut self, value: f64) {
        if value == 0.0 {
            return;
        }
        let Significand { whole, exponent } = Significand::of(value);
        self.lowest = self.lowest.min(exponent + whole.trailing_zeros() as i32);
        self.above = self.above.max(exponent + 64 - whole.leading_zeros() as i32);
    }

    fn of(values: impl IntoIterator<Item = DVec3>) -> Self {
        let mut range = Self::EMPTY;
        for vector in values {
            vector.to_array().into_iter().for_each(|x| range.include(x));
        }
        range
    }

    fn union(self, other: Self) -> Self {
        BitRange { lowest: self.lowest.min(other.lowest), above: self.above.max(other.above) }
    }

    fn width(self) -> u32 {
        if self.lowest == i32::MAX { 0 } else { (self.above - self.lowest).unsigned_abs() }
    }

    /// The exponent of the unit: zero where there is no bit at all.
    fn unit(self) -> i32 {
        if self.lowest == i32::MAX { 0 } else { self.lowest }
    }
}

/// `2^-unit` as two factors: one power of two may be out of range; two halves
/// never are.
fn reciprocal_of_unit(unit: i32) -> [f64; 2] {
    let half = -unit / 2;
    [half, -unit - half].map(|exponent| f64::powi(2.0, exponent))
}

/// `distance * |forward|` as a float times a power of two: forward is
/// brought near one first, so that its length is in range, whatever it is.
fn near_offset(plane: NearPlane, forward_above: i32) -> (f64, i64) {
    if forward_above == i32::MIN {
        return (0.0, 0);
    }
    let exponent = forward_above - 1;
    let [one, other] = reciprocal_of_unit(exponent);
    let forward = plane.forward.to_array().map(|x| x * one * other);
    (plane.distance * DVec3::from(forward).length(), i64::from(exponent))
}

/// The bits of `value * 2^exponent` above the place `2^unit`.
fn bits_above((value, exponent): (f64, i64), unit: i32) -> u32 {
    let above = BitRange::of([DVec3::splat(value)]).above;
    (i64::from(above) + exponent - i64::from(unit)).max(0) as u32
}

/// A value cut off below the place `2^unit`, if it is that small.
fn whole_units(value: f64, unit: i32) -> f64 {
    let Significand { whole, exponent } = Significand::of(value);
    let below = (i64::from(unit) - i64::from(exponent)).clamp(0, 63) as u32;
    let cut = (whole >> below << below) as f64;
    scale_by_power_of_two(cut.copysign(value), exponent.into())
}

/// Binary places that the offset of a near plane keeps at least.
const OFFSET_BITS: i64 = 24;

/// The range of a forward direction. The offset of the near plane is a
/// multiple of the scene's unit times that of the direction, so that of the
/// direction is made small enough for it: on a coarse grid a near plane
/// would fall on the eye otherwise.
fn forward_range(plane: NearPlane, unit: i32) -> BitRange {
    let mut forward = BitRange::of([plane.forward]);
    if forward.width() > 0 && plane.distance > 0.0 {
        let (value, exponent) = near_offset(plane, forward.above);
        let above = i64::from(BitRange::of([DVec3::splat(value)]).above) + exponent;
        let needed = above - OFFSET_BITS - i64::from(unit);
        forward.lowest = i64::from(forward.lowest).min(needed) as i32;
    }
    forward
}

/// The forward direction and offset of a near plane, scaled.
#[derive(Debug, Clone, Copy)]
struct ScaledNear {
    forward: [f64; 3],
    forward_unit: i32,
    offset: f64,
    offset_unit: i32,
}

/// A view's coordinates, ready for predicates. Vertices are named by
/// their index.
#[derive(Debug, Clone)]
pub struct Points {
    vertices: Vec<[f64; 3]>,
    unit: i32,
    /// The exponent of the unit in which vertices are integers.
    exponent: i32,
    eye: [f64; 3],
    eye_unit: i32,
    perspective: bool,
    near: Option<ScaledNear>,
    spread: u32,
    /// Bits above one of the largest number, where they are not scaled.
    largest: u32,
}

impl Points {
    /// Measures and scales the vertices, the eye and the near plane of a
    /// view. All numbers must be finite. O(n).
    pub fn new(vertices: &[DVec3], eye: Eye, near: Option<NearPlane>) -> Self {
        let ranges = map_chunks(vertices.len(), 1 << 16, |part| {
            BitRange::of(vertices[part].iter().copied())
        });
        let mut points = ranges.into_iter().fold(BitRange::EMPTY, BitRange::union);
        let eye_range = BitRange::of([eye.coordinates()]);
        let mut directions = BitRange::EMPTY;
        if eye.is_perspective() {
            points = points.union(eye_range);
        } else {
            directions = eye_range;
        }
        let forward_range =
            near.map_or(BitRange::EMPTY, |plane| forward_range(plane, points.unit()));
        // The near plane's offset counts whole units of forward times whole
        // units of the scene; a formula allows it twice the bits of either.
        let both = points.unit() + forward_range.unit();
        let offset = near.map_or((0.0, 0), |plane| near_offset(plane, forward_range.above));
        let spread = points
            .width()
            .max(directions.width())
            .max(forward_range.width())
            .max(bits_above(offset, both).div_ceil(2));
        let narrow = spread <= NARROW;
        // Adding zero makes one zero of the two, so that order by
        // coordinates agrees with equality.
        let by = |unit: i32| if narrow { reciprocal_of_unit(unit) } else { [1.0; 2] };
        let times = |v: DVec3, [one, other]: [f64; 2]| v.to_array().map(|x| x * one * other + 0.0);
        let shift3 = |v: DVec3, unit: i32| times(v, by(unit));
        let kept_unit = |unit: i32| if narrow { 0 } else { unit };

        let mut scaled = vec![[0.0; 3]; vertices.len()];
        let factors = by(points.unit());
        fill_indexed(&mut scaled, |i| times(vertices[i], factors));
        let eye_range = if eye.is_perspective() { points } else { directions };
        let aboves = [points.above, eye_range.above, forward_range.above];
        let largest = aboves.into_iter().fold(bits_above(offset, 0).max(1), |most, above| {
            most.max(above.max(0).unsigned_abs())
        });
        Points {
            vertices: scaled,
            unit: kept_unit(points.unit()),
            exponent: points.unit(),
            eye: shift3(eye.coordinates(), eye_range.unit()),
            eye_unit: kept_unit(eye_range.unit()),
            perspective: eye.is_perspective(),
            near: near.map(|plane| {
                let forward_unit = forward_range.unit();
                let (value, exponent) = offset;
                ScaledNear {
                    forward: shift3(plane.forward, forward_unit),
                    forward_unit: kept_unit(forward_unit),
                    offset: if narrow {
                        scale_by_power_of_two(value, exponent - i64::from(both)).floor()
                    } else {
                        whole_units(scale_by_power_of_two(value, exponent), both)
                    },
                    offset_unit: kept_unit(both),
                }
            }),
            spread,
            largest,
        }
    }

    /// The number of vertices.
    pub fn len(&self) -> usize {
        self.vertices.len()
    }

    /// Whether there is no vertex.
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// The number of binary orders that the coordinates span.
    pub fn spread(&self) -> u32 {
        self.spread
    }

    /// Whether the eye is a point, not a direction.
    pub fn is_perspective(&self) -> bool {
        self.perspective
    }

    /// Whether lines are cut at a near plane.
    pub fn has_near_plane(&self) -> bool {
        self.near.is_some()
    }

    /// Whether coordinates are integers of at most 167 bits.
    pub(super) fn is_narrow(&self) -> bool {
        self.spread <= NARROW
    }

    /// Whether floats can evaluate a formula whose value has `bits` bits.
    #[inline(always)]
    pub(super) fn floats_hold(&self, bits: u32) -> bool {
        self.spread <= NARROW && bits <= FLOAT_BITS
    }

    /// How far underflow may take the float value of a formula from the truth
    /// beyond what rounding does, in scenes that are not scaled; nothing where
    /// numbers are so large that this says little.
    ///
    /// What underflows is off by half the least float. That is multiplied with
    /// other factors, which together are less than what `bits` says of the
    /// largest number, and happens less often than 2^20 times.
    pub(super) fn underflow<F: Formula>(&self, formula: &F) -> Option<f64> {
        let bits = formula.bits(self.largest);
        // Not below the least normal number: powers there are made by division
        // by an overflow, and come out as zero.
        let exponent = (bits as i32 + 20 - 1074).max(-1022);
        (bits < FLOAT_BITS - 100).then(|| f64::powi(2.0, exponent))
    }

    /// The coordinates of a vertex, in units.
    #[inline(always)]
    pub(super) fn vertex<R: Ring>(&self, index: u32) -> [R; 3] {
        // Written out, for `map` is not inlined everywhere.
        let [x, y, z] = self.vertices[index as usize];
        [R::read(x, self.unit), R::read(y, self.unit), R::read(z, self.unit)]
    }

    /// The coordinates of a vertex as floats: in units, or as they are
    /// where they span too many binary orders.
    #[inline(always)]
    pub(super) fn floats(&self, index: u32) -> [f64; 3] {
        self.vertices[index as usize]
    }

    /// The exponent of the power of two by which integers read from
    /// vertices are to be multiplied.
    pub(super) fn integer_exponent(&self) -> i32 {
        self.exponent
    }

    /// The direction or position of the eye, in its own unit.
    #[inline(always)]
    pub(super) fn eye<R: Ring>(&self) -> [R; 3] {
        let [x, y, z] = self.eye;
        [R::read(x, self.eye_unit), R::read(y, self.eye_unit), R::read(z, self.eye_unit)]
    }

    /// Forward direction and offset of the near plane, if there is one.
    pub(super) fn near<R: Ring>(&self) -> Option<([R; 3], R)> {
        self.near.map(|plane| {
            let forward = plane.forward.map(|x| R::read(x, plane.forward_unit));
            (forward, R::read(plane.offset, plane.offset_unit))
        })
    }

    /// Whether two vertices have the same position.
    #[inline(always)]
    pub fn coincide(&self, a: u32, b: u32) -> bool {
        a == b || self.vertices[a as usize] == self.vertices[b as usize]
    }

    /// Orders two vertices by their coordinates, x first.
    pub fn compare(&self, a: u32, b: u32) -> std::cmp::Ordering {
        let (a, b) = (&self.vertices[a as usize], &self.vertices[b as usize]);
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Cut, Exact, Point, Predicates};
    use super::*;
    use crate::kernel::numbers::Sign;

    #[test]
    fn a_near_plane_lies_in_front_of_the_eye_on_a_coarse_grid_too() {
        for (distance, spread) in [(0.5, 64.0), (0.001, 64.0), (0.001, 1e9)] {
            // Even coordinates: the scene's unit is two.
            let depths = [0.0, distance * 0.99, distance * 1.01, 2.0];
            for size in [1.0, f64::powi(2.0, -80), f64::powi(2.0, 80)] {
                let eye = DVec3::new(2.0, 4.0, 6.0) * size;
                let mut vertices = vec![eye, eye + DVec3::splat(spread * size)];
                let coarse = NearPlane { forward: -DVec3::Z * size, distance: distance * size };
                let signs: Vec<Sign> = depths
                    .iter()
                    .map(|depth| {
                        // A vertex far off and one at this depth: the sign
                        // at the latter shows where the plane is.
                        vertices.truncate(2);
                        let offset = -DVec3::Z * (depth * size);
                        vertices.push(eye + offset);
                        let points = Points::new(&vertices, Eye::At(eye), Some(coarse));
                        Predicates::<Exact>::new(&points).value_sign(Cut::Near, Point::Vertex(2))
                    })
                    .collect();
                use Sign::{Negative, Positive};
                assert_eq!(signs, [Negative, Negative, Positive, Positive]);
                let points = Points::new(&vertices[..2], Eye::At(eye), Some(coarse));
                let at_eye =
                    Predicates::<Exact>::new(&points).value_sign(Cut::Near, Point::Vertex(0));
                assert_eq!(at_eye, Negative, "the eye lies behind its near plane");
            }
        }
    }

    #[test]
    fn a_near_plane_far_beyond_the_scene_hides_all_of_it() {
        let near = |distance| NearPlane { forward: DVec3::new(0.1, 0.2, -0.3), distance };
        let vertices = [DVec3::new(3.0, 5.0, -7.0), DVec3::new(0.1, 0.7, 1e-9)];
        for distance in [1e3, 1e30, 1e200, 1e308] {
            let points = Points::new(&vertices, Eye::At(DVec3::ONE), Some(near(distance)));
            let predicates = Predicates::<Exact>::new(&points);
            for vertex in [0, 1] {
                let sign = predicates.value_sign(Cut::Near, Point::Vertex(vertex));
                assert_eq!(sign, Sign::Negative);
            }
        }
    }
}
