//! What a decision costs. Every measurement runs a thousand decisions, so
//! microseconds read as nanoseconds a call.
//!
//! The inputs are those of every-day drawings: points in general position,
//! points of one plane after rounding, an axis-aligned grid in millimetres
//! and the same grid turned. `tenths` are multiples of 0.1, which no float
//! is; so even the aligned grid has all its bits in use.

use divan::Bencher;
use glam::{DMat3, DVec3, dvec3};
use std::fmt;
use umriss::kernel::numbers::{
    BigInteger, FixedInteger, Ring, Sign, SmallInteger, determinant3, difference,
};
use umriss::kernel::predicates::{
    Carrier, Cut, Exact, Eye, FilterOnly, Plain, Points, Policy, Predicates,
};

const CALLS: usize = 1000;

fn main() {
    divan::main();
}

/// A kind of input.
#[derive(Clone, Copy)]
enum Input {
    Random,
    Coplanar,
    Aligned,
    Turned,
}

const INPUTS: [Input; 4] = [Input::Random, Input::Coplanar, Input::Aligned, Input::Turned];

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Input::Random => "random",
            Input::Coplanar => "coplanar-rounded",
            Input::Aligned => "aligned-grid",
            Input::Turned => "turned-grid",
        })
    }
}

/// A multiplicative generator (Lehmer 1951, parameters of L'Ecuyer 1999).
struct Draw(u128);

impl Draw {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(0xda94_2042_e4dd_58b5);
        (self.0 >> 64) as u64
    }

    /// A float in 1..2, so that all have their last bits at one place.
    fn float(&mut self) -> f64 {
        1.0 + (self.bits() >> 11) as f64 / f64::powi(2.0, 53)
    }

    /// A multiple of a tenth, from 1 to 8.
    fn tenths(&mut self) -> f64 {
        (self.bits() % 70 + 10) as f64 * 0.1
    }

    fn floats(&mut self) -> DVec3 {
        dvec3(self.float(), self.float(), self.float())
    }
}

/// `CALLS` groups of four points; all groups but the random ones are
/// coplanar before rounding. The first point of all groups is the same, so
/// that it can be the eye.
fn groups(input: Input) -> Vec<[DVec3; 4]> {
    let mut draw = Draw(0x1234_5678_9abc_def1);
    let turn = DMat3::from_rotation_x(0.7) * DMat3::from_rotation_z(0.3);
    let eye = match input {
        Input::Random | Input::Coplanar => draw.floats(),
        Input::Aligned | Input::Turned => dvec3(2.0 * 0.1, 3.0 * 0.1, 4.0 * 0.1),
    };
    let group = |_| match input {
        Input::Random => [eye, draw.floats(), draw.floats(), draw.floats()],
        Input::Coplanar => {
            let (p, q) = (draw.floats(), draw.floats());
            let (s, t) = (draw.float() - 1.0, draw.float() - 1.0);
            [eye, p, q, eye + (p - eye) * (s / 2.0) + (q - eye) * (t / 2.0)]
        }
        Input::Aligned | Input::Turned => {
            let axis = (draw.bits() % 3) as usize;
            let points = [0; 3].map(|_| {
                let mut point = dvec3(draw.tenths(), draw.tenths(), draw.tenths());
                point[axis] = eye[axis];
                point
            });
            let group = [eye, points[0], points[1], points[2]];
            if matches!(input, Input::Turned) {
                // Away from zero, where small numbers would have further bits.
                group.map(|point| turn * point + DVec3::splat(16.0))
            } else {
                group
            }
        }
    };
    (0..CALLS).map(group).collect()
}

/// The points of all groups, and with `wide` one more that stretches the
/// spread to 120 bits without taking part.
fn vertices(input: Input, wide: bool) -> Vec<DVec3> {
    let mut vertices: Vec<DVec3> = groups(input).into_iter().flatten().collect();
    if wide {
        vertices.push(dvec3(f64::powi(2.0, -115), 0.0, 0.0));
    }
    vertices
}

fn perspective(input: Input, wide: bool) -> Points {
    let vertices = vertices(input, wide);
    let points = Points::new(&vertices, Eye::At(vertices[0]), None);
    assert_eq!(points.spread() > 61, wide, "{} {}", input, points.spread());
    points
}

fn run(bencher: Bencher<'_, '_>, mut call: impl FnMut(u32) -> Sign) {
    bencher.bench_local(|| (0..CALLS as u32).map(|i| call(4 * i).to_i32()).sum::<i32>());
}

#[divan::bench(args = INPUTS, types = [Exact, FilterOnly, Plain])]
fn side_in_perspective<P: Policy>(bencher: Bencher<'_, '_>, input: Input) {
    let points = perspective(input, false);
    let predicates = Predicates::<P>::new(&points);
    run(bencher, |i| predicates.side(i + 1, i + 2, i + 3));
}

#[divan::bench(args = INPUTS)]
fn side_in_perspective_of_a_wide_scene(bencher: Bencher<'_, '_>, input: Input) {
    let points = perspective(input, true);
    let predicates = Predicates::<Exact>::new(&points);
    run(bencher, |i| predicates.side(i + 1, i + 2, i + 3));
}

#[divan::bench(args = INPUTS, types = [Exact, FilterOnly, Plain])]
fn side_along_an_axis<P: Policy>(bencher: Bencher<'_, '_>, input: Input) {
    let points = Points::new(&vertices(input, false), Eye::Towards(DVec3::Z), None);
    let predicates = Predicates::<P>::new(&points);
    run(bencher, |i| predicates.side(i + 1, i + 2, i + 3));
}

#[divan::bench(args = INPUTS, types = [Exact, FilterOnly, Plain])]
fn plane<P: Policy>(bencher: Bencher<'_, '_>, input: Input) {
    let points = perspective(input, false);
    let predicates = Predicates::<P>::new(&points);
    run(bencher, |i| predicates.plane([i, i + 1, i + 2], i + 3));
}

#[divan::bench(args = INPUTS)]
fn plane_of_a_wide_scene(bencher: Bencher<'_, '_>, input: Input) {
    let points = perspective(input, true);
    let predicates = Predicates::<Exact>::new(&points);
    run(bencher, |i| predicates.plane([i, i + 1, i + 2], i + 3));
}

/// Two faces that pierce an edge in its midpoint, as far as that is a
/// float; in general position for random input. Their values are known.
#[divan::bench(args = INPUTS, types = [Exact, FilterOnly, Plain])]
fn order_of_cuts<P: Policy>(bencher: Bencher<'_, '_>, input: Input) {
    order::<P>(bencher, input, false);
}

#[divan::bench(args = INPUTS)]
fn order_of_cuts_of_a_wide_scene(bencher: Bencher<'_, '_>, input: Input) {
    order::<Exact>(bencher, input, true);
}

fn order<P: Policy>(bencher: Bencher<'_, '_>, input: Input, wide: bool) {
    let mut vertices = vertices(input, wide);
    if !matches!(input, Input::Random) {
        for k in (0..4 * CALLS).step_by(4) {
            vertices[k + 3] = (vertices[k + 1] + vertices[k + 2]) / 2.0;
        }
    }
    let points = Points::new(&vertices, Eye::Towards(dvec3(0.25, -0.5, 1.0)), None);
    let predicates = Predicates::<P>::new(&points);
    let cases: Vec<_> = (0..CALLS as u32)
        .map(|i| {
            let other = |step| 4 * ((i + step) % CALLS as u32) + step % 3;
            let carrier = Carrier::edge(4 * i + 1, 4 * i + 2);
            let face = |step| Cut::Face([4 * i + 3, other(step), other(step + 7)]);
            let cuts = [face(1), face(31)];
            let values = cuts.map(|cut| carrier.ends.map(|end| predicates.value(cut, end)));
            (carrier, cuts, values)
        })
        .collect();
    bencher.bench_local(|| {
        let order = |(carrier, cuts, values): &(Carrier, [Cut; 2], [[_; 2]; 2])| {
            predicates.order(*carrier, (cuts[0], &values[0]), (cuts[1], &values[1])) as i32
        };
        cases.iter().map(order).sum::<i32>()
    });
}

#[divan::bench(args = INPUTS)]
fn robust_orient3d(bencher: Bencher<'_, '_>, input: Input) {
    let groups: Vec<_> = groups(input)
        .into_iter()
        .map(|group| group.map(|p| robust::Coord3D { x: p.x, y: p.y, z: p.z }))
        .collect();
    run(bencher, |i| {
        let [a, b, c, d] = groups[i as usize / 4];
        Sign::of(robust::orient3d(a, b, c, d))
    });
}

/// The determinant alone, without a filter, of coordinates that are scaled
/// to integers already.
fn integers<R: Ring>(bencher: Bencher<'_, '_>, input: Input, sign: impl Fn(&R) -> Sign) {
    let scale = f64::powi(2.0, 60);
    let groups: Vec<_> =
        groups(input).iter().map(|group| group.map(|p| (p * scale).to_array())).collect();
    run(bencher, |i| {
        let read = |[x, y, z]: [f64; 3]| [R::read(x, 0), R::read(y, 0), R::read(z, 0)];
        let [a, b, c, d] = groups[i as usize / 4];
        let (a, b, c, d) = (read(a), read(b), read(c), read(d));
        sign(&determinant3(difference(a, &d), difference(b, &d), difference(c, &d)))
    });
}

#[divan::bench(args = INPUTS)]
fn integers_of_three_words(bencher: Bencher<'_, '_>, input: Input) {
    integers::<FixedInteger<3>>(bencher, input, FixedInteger::sign);
}

#[divan::bench(args = INPUTS)]
fn integers_of_six_words(bencher: Bencher<'_, '_>, input: Input) {
    integers::<FixedInteger<6>>(bencher, input, FixedInteger::sign);
}

#[divan::bench(args = INPUTS)]
fn complement_of_three_words(bencher: Bencher<'_, '_>, input: Input) {
    integers::<SmallInteger<3>>(bencher, input, SmallInteger::sign);
}

#[divan::bench(args = INPUTS)]
fn complement_of_six_words(bencher: Bencher<'_, '_>, input: Input) {
    integers::<SmallInteger<6>>(bencher, input, SmallInteger::sign);
}

#[divan::bench(args = INPUTS)]
fn integers_of_any_size(bencher: Bencher<'_, '_>, input: Input) {
    integers::<BigInteger>(bencher, input, BigInteger::sign);
}
