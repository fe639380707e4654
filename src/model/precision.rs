//! How finely a file tells places, and the distance below which two places
//! may be one that was rounded twice.
//!
//! Coordinates are seldom what was meant: they were rounded when the file was
//! written, to narrow floats or to some decimals. Two corners that were one,
//! or a corner that lay on an edge, are then apart by a few units of the last
//! place. That place is read off the numbers themselves, so that readers need
//! not look at digits: the shortest decimal of a double has the digits that a
//! text file gave it. Formats that know better say so.

use crate::run::map_chunks;
use glam::DVec3;

/// How an object's coordinates were rounded when its file was written.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Precision {
    /// As the numbers say: decimals of a text file; narrow floats where all
    /// of them are; doubles where nothing else shows.
    #[default]
    AsWritten,
    /// To narrow floats (binary STL and PLY).
    Float32,
    /// To multiples of about this step, wherever they were moved afterwards
    /// (glTF).
    Step(f64),
}

/// Units of a float's last place at the largest coordinate: one rounding
/// takes half of one on each axis, and arithmetic in such floats a few.
const FLOAT_UNITS: f64 = 4.0;

/// Units of the last decimal: a corner and the edge on which it lay are half
/// of one off on each axis, either of them.
const DECIMAL_UNITS: f64 = 2.0;

/// With fewer units than this in the largest coordinate, decimals are not
/// what was left by rounding but what was meant.
const LEAST_UNITS: f64 = 1e4;

/// Digits of a decimal from which on narrow floats tell less than it says.
const FLOAT32_DIGITS: u8 = 8;

/// Digits that any double has at most; numbers that have as many were not
/// rounded to decimals.
const ALL_DIGITS: u8 = 16;

/// Vertices that one task looks at.
const PART: usize = 1 << 14;

impl Precision {
    /// The distance within which places of this precision may be one: a few
    /// units of the last place of the largest coordinate. Model units; 0 if
    /// all coordinates are. O(n).
    pub fn resolution(self, vertices: &[DVec3]) -> f64 {
        let largest = largest(vertices);
        match self {
            _ if largest == 0.0 => 0.0,
            Precision::Step(step) => step.max(FLOAT_UNITS * unit_of_double(largest)),
            Precision::Float32 => FLOAT_UNITS * unit_of_float(largest),
            Precision::AsWritten => Digits::of(vertices).resolution(vertices, largest),
        }
    }

    /// What narrow floats become that are enlarged so many times and moved so
    /// far.
    pub fn of_placed(vertices: &[DVec3], scale: f64, distance: f64) -> Self {
        let units = scale * unit_of_float(largest(vertices)) + unit_of_float(distance);
        Precision::Step(FLOAT_UNITS * units)
    }
}

fn largest(vertices: &[DVec3]) -> f64 {
    let parts = map_chunks(vertices.len(), PART, |part| {
        vertices[part].iter().fold(0.0, |most: f64, vertex| most.max(vertex.abs().max_element()))
    });
    parts.into_iter().fold(0.0, f64::max)
}

/// The step from a number to the next double.
fn unit_of_double(number: f64) -> f64 {
    let number = number.abs();
    number.next_up().min(f64::MAX) - number.next_up().min(f64::MAX).next_down()
}

/// The step from a number to the next narrow float.
pub(super) fn unit_of_float(number: f64) -> f64 {
    let number = (number.abs() as f32).min(f32::MAX.next_down());
    f64::from(number.next_up()) - f64::from(number)
}

/// Decades of a double: the least is 1e-324.
const DECADES: usize = 633;
const LEAST_DECADE: i32 = -324;

/// The most digits of numbers by decade, as far as they are known.
struct Digits([u8; DECADES]);

impl Digits {
    fn of(vertices: &[DVec3]) -> Self {
        let parts = map_chunks(vertices.len(), PART, |part| {
            let mut digits = Digits([0; DECADES]);
            for &coordinate in vertices[part].iter().flat_map(AsRef::<[f64; 3]>::as_ref) {
                digits.note(coordinate.abs());
            }
            digits
        });
        let mut all = Digits([0; DECADES]);
        for part in parts {
            all.0.iter_mut().zip(part.0).for_each(|(most, digits)| *most = digits.max(*most));
        }
        all
    }

    /// Takes a number into account; one that shows nothing new costs a
    /// division.
    fn note(&mut self, number: f64) {
        if number == 0.0 {
            return;
        }
        let decade = decade_of(number);
        let known = self.0[(decade - LEAST_DECADE) as usize];
        if ALL_DIGITS <= known || (0 < known && has_decimals(number, decimals(known, decade))) {
            return;
        }
        let (digits, decade) = digits_of(number);
        let most = &mut self.0[(decade - LEAST_DECADE) as usize];
        *most = digits.max(*most);
    }

    /// The decades that occur, each with its digits.
    fn decades(&self) -> impl Iterator<Item = (i32, u8)> + '_ {
        let all = (LEAST_DECADE..).zip(self.0);
        all.filter(|(_, digits)| 0 < *digits)
    }

    fn resolution(&self, vertices: &[DVec3], largest: f64) -> f64 {
        let most = self.decades().map(|(_, digits)| digits).max().unwrap_or(0);
        if FLOAT32_DIGITS <= most && are_narrow(vertices, most) {
            return FLOAT_UNITS * unit_of_float(largest);
        }
        let exact = FLOAT_UNITS * unit_of_double(largest);
        let unit = self.unit(most, decade_of(largest));
        let is_rounded = most < ALL_DIGITS && unit < 1.0 && LEAST_UNITS * unit <= largest;
        if is_rounded { exact.max(DECIMAL_UNITS * unit) } else { exact }
    }

    /// The unit of the last place: that of the decimals of all numbers, unless
    /// numbers of several decades have equally many digits, which were then
    /// written with so many and not with so many decimals.
    fn unit(&self, most: u8, largest: i32) -> f64 {
        let full = self.decades().filter(|&(_, digits)| digits == most).count();
        let finest = self.decades().map(|(decade, digits)| decimals(digits, decade)).max();
        let places = if full < 2 { finest.unwrap_or(0) } else { decimals(most, largest) };
        power_of_ten(-places)
    }
}

/// The decimals of a number of a decade with so many digits.
fn decimals(digits: u8, decade: i32) -> i32 {
    i32::from(digits) - 1 - decade
}

fn power_of_ten(exponent: i32) -> f64 {
    // The standard library's powers are not those of decimals for all.
    format!("1e{exponent}").parse().unwrap_or(0.0)
}

/// The decade of a positive number, or the one above.
fn decade_of(number: f64) -> i32 {
    (number.log10().floor() as i32).max(LEAST_DECADE)
}

/// Whether a number is the double next to one with so many decimals; no if
/// floats cannot tell.
fn has_decimals(number: f64, decimals: i32) -> bool {
    /// Powers of ten up to this are doubles, so that the division rounds once.
    const EXACT_POWERS: i32 = 22;
    const EXACT_INTEGERS: f64 = (1_u64 << 53) as f64;
    if !(0..=EXACT_POWERS).contains(&decimals) {
        return false;
    }
    let power = 10_f64.powi(decimals);
    let whole = (number * power).round();
    whole < EXACT_INTEGERS && whole / power == number
}

/// The digits of the shortest decimal that gives a positive number back, and
/// its decade.
fn digits_of(number: f64) -> (u8, i32) {
    let text = format!("{number:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let count = digits.bytes().filter(u8::is_ascii_digit).count();
    (count as u8, exponent.parse().unwrap_or(0))
}

/// Whether all coordinates are narrow floats; with no more digits than these
/// need, also whether they are the shortest decimals of such.
fn are_narrow(vertices: &[DVec3], digits: u8) -> bool {
    const SHORTEST: u8 = 9;
    let is_shortest = |x: f64| digits <= SHORTEST && format!("{}", x as f32).parse() == Ok(x);
    let is_narrow = |&x: &f64| f64::from(x as f32) == x || is_shortest(x);
    let parts = map_chunks(vertices.len(), PART, |part| {
        vertices[part].iter().flat_map(AsRef::<[f64; 3]>::as_ref).all(is_narrow)
    });
    parts.into_iter().all(|narrow| narrow)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn resolution(numbers: &[f64]) -> f64 {
        let vertices: Vec<DVec3> = numbers.iter().map(|&x| DVec3::new(x, 0.0, -x)).collect();
        Precision::AsWritten.resolution(&vertices)
    }

    /// Numbers as a file would have them.
    fn written(format: impl Fn(f64) -> String) -> Vec<f64> {
        let numbers = (1..400).map(|i| (f64::from(i) * 0.7).sin() * 20.0);
        numbers.map(|x| format(x).parse().unwrap()).collect()
    }

    #[test]
    fn decimals_are_told_whatever_zeros_were_left_out() {
        let mut numbers = written(|x| format!("{x:.6}"));
        assert_eq!(resolution(&numbers), 2e-6);
        // Dimensions that were meant are no sign of coarser numbers.
        numbers.extend([1000.0, 250.5, 0.25]);
        assert_eq!(resolution(&numbers), 2e-6);
    }

    #[test]
    fn a_fixed_number_of_digits_is_told_from_decimals() {
        // 19.8765 and 0.00123456 are of one file.
        let numbers = written(|x| format!("{x:.5e}"));
        assert_eq!(resolution(&numbers), 2e-4);
        let small: Vec<f64> = numbers
            .iter()
            .map(|x| format!("{:.5e}", x * 1e-9))
            .map(|text| text.parse().unwrap())
            .collect();
        assert!((resolution(&small) / 2e-13 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn narrow_floats_are_told_however_they_are_written() {
        let unit = FLOAT_UNITS * f64::from(16_f32.next_up() - 16.0);
        assert_eq!(resolution(&written(|x| format!("{}", f64::from(x as f32)))), unit);
        assert_eq!(resolution(&written(|x| format!("{}", x as f32))), unit);
        // What is left of a sine of pi is no decimal of the file.
        let mut numbers = written(|x| format!("{}", f64::from(x as f32)));
        numbers.push(f64::from(2.4e-18_f32));
        assert_eq!(resolution(&numbers), unit);
    }

    #[test]
    fn doubles_and_what_was_meant_have_the_resolution_of_doubles() {
        let unit = FLOAT_UNITS * f64::EPSILON * 16.0;
        assert_eq!(resolution(&written(|x| format!("{x}"))), unit);
        assert_eq!(resolution(&[0.0, 1.0, 2.0, 20.0]), unit);
        assert_eq!(resolution(&[0.25, 2.54, 20.0]), unit);
        assert_eq!(resolution(&[12_000.0, 8_001.0]), FLOAT_UNITS * f64::EPSILON * 8192.0);
        assert_eq!(resolution(&[0.3, 0.300_000_000_000_000_04]), f64::EPSILON);
        assert_eq!(resolution(&[0.0]), 0.0);
    }

    #[test]
    fn the_ends_of_the_doubles_have_a_resolution() {
        for number in [f64::MAX, f64::MIN_POSITIVE, 5e-324] {
            let found = resolution(&[number]);
            assert!(found.is_finite() && found > 0.0, "{number}: {found}");
            let found = Precision::Float32.resolution(&[DVec3::splat(number)]);
            assert!(found.is_finite() && found > 0.0, "{number}: {found}");
        }
    }

    #[test]
    fn the_digits_do_not_depend_on_the_order_of_numbers() {
        let mut numbers = written(|x| format!("{x:.3}"));
        numbers.extend(written(|x| format!("{:.5}", x * 1e-3)));
        let found = resolution(&numbers);
        numbers.reverse();
        assert_eq!(resolution(&numbers), found);
    }
}
