//! Inputs that are hard for predicates: degenerate on purpose, nearly
//! degenerate by rounding, and at the limits of every number type.

use crate::split_mix::split_mix;
use glam::{DVec3, dvec3};
use proptest::prelude::*;
use umriss::kernel::predicates::{Eye, NearPlane};

/// How many vertices a scene has.
pub(crate) const VERTICES: usize = 12;

/// Vertices, an eye and a near plane if the eye is a point.
#[derive(Debug, Clone)]
pub(crate) struct Scene {
    pub(crate) vertices: Vec<DVec3>,
    pub(crate) eye: Eye,
    pub(crate) near: Option<NearPlane>,
}

/// The kinds of inputs; a scene is of one kind throughout.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    /// Any floats in -1..1.
    Random,
    /// Small integers: exact degeneracies of all sorts.
    Grid,
    /// Millimetres in axis-aligned steps of a tenth, which are no exact tenths.
    Millimetres,
    /// The same, rotated and rounded: nearly degenerate.
    RotatedMillimetres,
    /// Points of one plane, rounded, then moved by one unit in the last place.
    NearlyCoplanar,
    /// Random, a million units away.
    Far,
    /// Random times this.
    Scaled(f64),
    /// Single precision, as from STL.
    Single,
    /// Coordinates of this many bits at the most extreme values.
    Limit(i32),
    /// 1e-300 beside 1e300.
    Wide,
    /// A few units of the least float.
    Subnormal,
}

/// All kinds that are tested.
pub(crate) const KINDS: [Kind; 16] = [
    Kind::Random,
    Kind::Grid,
    Kind::Grid,
    Kind::Millimetres,
    Kind::RotatedMillimetres,
    Kind::NearlyCoplanar,
    Kind::Far,
    Kind::Scaled(1e-9),
    Kind::Scaled(1e9),
    Kind::Single,
    Kind::Limit(60),
    Kind::Limit(125),
    Kind::Limit(167),
    Kind::Limit(168),
    Kind::Wide,
    Kind::Subnormal,
];

/// Numbers drawn from a seed.
pub(crate) struct Draw(pub u64);

impl Draw {
    pub(crate) fn bits(&mut self) -> u64 {
        split_mix(&mut self.0)
    }

    /// An integer below `end`.
    pub(crate) fn below(&mut self, end: u64) -> u64 {
        self.bits() % end
    }

    /// An integer from `-limit` to `limit`.
    pub(crate) fn integer(&mut self, limit: u64) -> f64 {
        self.below(2 * limit + 1) as f64 - limit as f64
    }

    /// A float in -1..1 with all its bits.
    pub(crate) fn unit(&mut self) -> f64 {
        self.integer((1 << 53) - 1) / f64::powi(2.0, 53)
    }

    /// Any vertex.
    pub(crate) fn vertex(&mut self) -> u32 {
        self.below(VERTICES as u64) as u32
    }
}

impl Kind {
    fn coordinate(self, draw: &mut Draw) -> f64 {
        match self {
            Kind::Grid => draw.integer(2),
            Kind::Millimetres | Kind::RotatedMillimetres => draw.integer(6) * 0.1,
            Kind::Single => f64::from(draw.unit() as f32),
            Kind::Scaled(factor) => draw.unit() * factor,
            Kind::Limit(bits) => limit_coordinate(bits, draw),
            Kind::Wide => [1e300, 1e-300, 1.0][draw.below(3) as usize] * draw.integer(2),
            Kind::Subnormal => draw.integer(3) * f64::from_bits(1),
            Kind::Random | Kind::NearlyCoplanar | Kind::Far => draw.unit(),
        }
    }

    fn vector(self, draw: &mut Draw) -> DVec3 {
        dvec3(self.coordinate(draw), self.coordinate(draw), self.coordinate(draw))
    }
}

/// Mostly plus or minus the largest float below `2^bits`.
fn limit_coordinate(bits: i32, draw: &mut Draw) -> f64 {
    let largest = f64::powi(2.0, bits) - f64::powi(2.0, bits - 53);
    let sign = draw.integer(1);
    match draw.below(8) {
        0 => draw.integer(1),
        1 => draw.unit().abs().mul_add(largest, 0.0).trunc() * sign,
        _ => sign.signum() * largest,
    }
}

/// The scene of a kind and a seed.
pub(crate) fn scene(kind: Kind, seed: u64) -> Scene {
    let mut draw = Draw(seed);
    let mut vertices: Vec<DVec3> = (0..VERTICES).map(|_| kind.vector(&mut draw)).collect();
    match kind {
        Kind::NearlyCoplanar => flatten(&mut vertices, &mut draw),
        Kind::RotatedMillimetres => rotate(&mut vertices),
        Kind::Far => vertices.iter_mut().for_each(|vertex| *vertex += dvec3(1e6, -1e6, 1e6)),
        // The lowest bit, so that the spread is what the kind says.
        Kind::Limit(_) => vertices[0].x = 1.0,
        _ => {}
    }
    let eye = match (draw.below(5), kind) {
        (0, _) => Eye::Towards(DVec3::AXES[draw.below(3) as usize]),
        (1, Kind::Grid) => Eye::Towards(dvec3(1.0, -1.0, 1.0)),
        (1 | 2, _) => Eye::Towards(not_zero(kind.vector(&mut draw))),
        // A point among the vertices: some of them are behind it.
        (3, _) => Eye::At(kind.vector(&mut draw)),
        _ => Eye::At(kind.vector(&mut draw) * if draw.below(2) == 0 { 1.0 } else { 4.0 }),
    };
    let eye = match (eye, kind) {
        (Eye::At(point), Kind::Far) => Eye::At(point + dvec3(1e6, -1e6, 1e6)),
        (Eye::At(_), Kind::NearlyCoplanar) if draw.below(2) == 0 => Eye::At(vertices[1]),
        _ => eye,
    };
    let near = matches!(eye, Eye::At(_)).then(|| near_plane(kind, &vertices, &mut draw));
    Scene { vertices, eye, near }
}

/// A near plane whose distance needs no rounding: a multiple of the
/// scene's unit times a length that is a power of two, or zero.
fn near_plane(kind: Kind, vertices: &[DVec3], draw: &mut Draw) -> NearPlane {
    if draw.below(2) == 0 {
        return NearPlane { forward: not_zero(kind.vector(draw)), distance: 0.0 };
    }
    let sign = [1.0, -0.25][draw.below(2) as usize];
    let forward = DVec3::AXES[draw.below(3) as usize] * sign;
    NearPlane { forward, distance: vertices[draw.vertex() as usize].x.abs() }
}

fn not_zero(vector: DVec3) -> DVec3 {
    if vector == DVec3::ZERO { DVec3::Z } else { vector }
}

/// Moves all vertices into one plane, rounded, and some by one step.
fn flatten(vertices: &mut [DVec3], draw: &mut Draw) {
    let [origin, right, up] = [0, 1, 2].map(|_| dvec3(draw.unit(), draw.unit(), draw.unit()));
    for vertex in vertices {
        let steps = [draw.integer(4) / 4.0, draw.unit()];
        *vertex = origin + right * steps[0] + up * steps[draw.below(2) as usize];
        if draw.below(3) == 0 {
            vertex.z = if draw.below(2) == 0 { vertex.z.next_up() } else { vertex.z.next_down() };
        }
    }
}

/// Turns by an angle about each of two axes.
fn rotate(vertices: &mut [DVec3]) {
    let turn = glam::DMat3::from_rotation_x(0.7) * glam::DMat3::from_rotation_z(0.3);
    vertices.iter_mut().for_each(|vertex| *vertex = turn * *vertex);
}

/// Scenes of all kinds, with a seed for picking among their vertices.
pub(crate) fn scenes() -> impl Strategy<Value = (Kind, Scene, u64)> {
    (prop::sample::select(KINDS.to_vec()), any::<u64>(), any::<u64>())
        .prop_map(|(kind, seed, picks)| (kind, scene(kind, seed), picks))
}

/// Few cases by default, a million each for a long run.
pub(crate) fn config() -> ProptestConfig {
    let long = std::env::var_os("UMRISS_LONG").is_some_and(|value| value == "1");
    ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(if long { 1_000_000 } else { 400 })
    }
}
