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
use umriss::kernel::numbers::{BigInteger, FixedInteger, Ring, Sign, determinant3, difference};
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

/// Two cuts along the edge from point 1 to 2: the plane of a face and the
/// image of an edge, both through point 3, whose values are known.
#[divan::bench(args = INPUTS, types = [Exact, FilterOnly, Plain])]
fn order_of_cuts<P: Policy>(bencher: Bencher<'_, '_>, input: Input) {
    order::<P>(bencher, input, false);
}

#[divan::bench(args = INPUTS)]
fn order_of_cuts_of_a_wide_scene(bencher: Bencher<'_, '_>, input: Input) {
    order::<Exact>(bencher, input, true);
}

fn order<P: Policy>(bencher: Bencher<'_, '_>, input: Input, wide: bool) {
    let vertices = vertices(input, wide);
    let points = Points::new(&vertices, Eye::Towards(dvec3(0.3, -0.4, 0.8)), None);
    let predicates = Predicates::<P>::new(&points);
    let cases: Vec<_> = (0..CALLS as u32)
        .map(|i| {
            let (k, other) = (4 * i, 4 * ((i + 1) % CALLS as u32));
            let carrier = Carrier::edge(k + 1, k + 2);
            // Three lines through one image point wherever input is planar.
            let cuts = [Cut::Silhouette([k + 3, other]), Cut::Silhouette([k + 3, other + 1])];
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
        let [a, b, c, d] = groups[i as usize / 4].map(|p| p.map(|x| R::read(x, 0)));
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
fn integers_of_any_size(bencher: Bencher<'_, '_>, input: Input) {
    integers::<BigInteger>(bencher, input, BigInteger::sign);
}
