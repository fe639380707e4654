//! Every predicate against integers of any size on inputs of all kinds,
//! with every sound step of the ladder on the same inputs; and the
//! conventions on cases made by hand. `UMRISS_LONG=1` runs a million cases
//! of each property.

mod conventions;
mod reference;
mod scenes;
#[path = "../support/split_mix.rs"]
mod split_mix;

use dashu_int::IBig;
use proptest::prelude::*;
use reference::{Reference, Row, cross, dot, isqrt, sign};
use scenes::{Draw, Kind, Scene, config, scenes};
use std::cmp::Ordering;
use umriss::kernel::numbers::Sign;
use umriss::kernel::predicates::{
    Carrier, Cut, Exact, Eye, Fold, FoldThreshold, Measured, Piercing, Place, Point, Points,
    Predicates, Thorough,
};

/// A scene on both sides of the comparison, and a way to pick from it.
struct Bench<'p> {
    exact: Predicates<'p, Exact>,
    thorough: Predicates<'p, Thorough>,
    truth: Reference,
    draw: Draw,
}

impl<'p> Bench<'p> {
    fn new(points: &'p Points, scene: &Scene, seed: u64) -> Self {
        Bench {
            exact: Predicates::new(points),
            thorough: Predicates::new(points),
            truth: Reference::new(scene),
            draw: Draw(seed),
        }
    }

    fn vertices<const N: usize>(&mut self) -> [u32; N] {
        std::array::from_fn(|_| self.draw.vertex())
    }

    /// A point: a vertex, or a piercing in its documented direction.
    fn point(&mut self) -> Point {
        for _ in 0..self.draw.below(3) * 8 {
            let (face, [a, b]) = (self.vertices(), self.vertices());
            let (below, above) = (self.truth.plane(face, a), self.truth.plane(face, b));
            if below != above && below != Sign::Positive && above != Sign::Negative {
                return Point::Piercing(Piercing { edge: [a, b], face });
            }
        }
        Point::Vertex(self.draw.vertex())
    }

    fn carrier(&mut self) -> Carrier {
        if self.draw.below(2) == 0 {
            let [a, b] = self.vertices();
            return Carrier::edge(a, b);
        }
        Carrier { ends: [self.point(), self.point()] }
    }

    /// Whether faces have a line in the near plane.
    fn has_near_plane(&self) -> bool {
        let points = self.exact.points();
        points.has_near_plane() && points.is_perspective()
    }

    fn cut(&mut self) -> Cut {
        match self.draw.below(8) {
            0 => Cut::Near,
            1 => Cut::Vertex(self.draw.vertex(), self.draw.below(3) as u8),
            2 if self.has_near_plane() => Cut::NearLine(self.vertices()),
            2..=4 => Cut::Face(self.vertices()),
            _ => Cut::Silhouette(self.vertices()),
        }
    }

    /// The sign of a cut's functional at a point.
    fn true_value(&self, cut: Cut, point: Point) -> Sign {
        sign(&self.truth.functional(cut, &self.truth.point(point)))
    }

    /// A cut whose signs at the ends of the carrier differ.
    fn crossing_cut(&mut self, carrier: Carrier) -> Option<Cut> {
        (0..12).find_map(|_| {
            let cut = self.cut();
            let [first, last] = carrier.ends.map(|end| self.true_value(cut, end));
            (first != last).then_some(cut)
        })
    }

    fn values(&self, carrier: Carrier, cut: Cut) -> [Measured; 2] {
        carrier.ends.map(|end| self.thorough.value(cut, end))
    }

    fn disagreements(&self) -> u64 {
        self.thorough.counters().get("ladder-disagreements")
    }
}

/// Runs `check` on picks from a scene; no two steps may ever disagree.
fn on_picks(
    (kind, scene, seed): (Kind, Scene, u64),
    picks: usize,
    mut check: impl FnMut(&mut Bench<'_>) -> Result<(), TestCaseError>,
) -> Result<(), TestCaseError> {
    let points = Points::new(&scene.vertices, scene.eye, scene.near);
    if let Kind::Limit(bits) = kind {
        prop_assert!(points.spread() + 2 > bits as u32, "{} bits", points.spread());
    }
    let mut bench = Bench::new(&points, &scene, seed);
    for _ in 0..picks {
        check(&mut bench)?;
        prop_assert_eq!(bench.disagreements(), 0, "two steps of the ladder disagree");
    }
    Ok(())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn side_and_facing(input in scenes()) {
        on_picks(input, 20, |bench| {
            let [p, q, r] = bench.vertices();
            let truth = bench.truth.side(p, q, r);
            prop_assert_eq!(bench.exact.side(p, q, r), truth);
            prop_assert_eq!(bench.thorough.facing([p, q, r]), truth);
            Ok(())
        })?;
    }

    #[test]
    fn plane(input in scenes()) {
        on_picks(input, 20, |bench| {
            let (face, [x]) = (bench.vertices(), bench.vertices());
            let truth = bench.truth.plane(face, x);
            prop_assert_eq!(bench.exact.plane(face, x), truth);
            prop_assert_eq!(bench.thorough.plane(face, x), truth);
            Ok(())
        })?;
    }

    #[test]
    fn second_opinion_of_robust((kind, scene, seed) in scenes()) {
        // Outside its range robust is silently wrong.
        prop_assume!(!matches!(kind, Kind::Wide | Kind::Subnormal));
        let coordinates = |index: u32| {
            let [x, y, z] = scene.vertices[index as usize].to_array();
            robust::Coord3D { x, y, z }
        };
        on_picks((kind, scene.clone(), seed), 20, |bench| {
            let [a, b, c, x] = bench.vertices();
            let [p, q, r, s] = [a, b, c, x].map(coordinates);
            prop_assert_eq!(bench.exact.plane([a, b, c], x), Sign::of(robust::orient3d(p, q, r, s)));
            if let Eye::At(eye) = scene.eye {
                let eye = robust::Coord3D { x: eye.x, y: eye.y, z: eye.z };
                prop_assert_eq!(bench.exact.side(a, b, c), Sign::of(robust::orient3d(eye, p, q, r)));
            }
            Ok(())
        })?;
    }

    #[test]
    fn value_of_every_cut_at_vertices_and_piercings(input in scenes()) {
        on_picks(input, 12, |bench| {
            let (cut, point) = (bench.cut(), bench.point());
            let truth = bench.true_value(cut, point);
            prop_assert_eq!(bench.exact.value(cut, point).sign, truth, "{:?} {:?}", cut, point);
            prop_assert_eq!(bench.exact.value_sign(cut, point), truth);
            prop_assert_eq!(bench.thorough.value_sign(cut, point), truth);
            Ok(())
        })?;
    }

    #[test]
    fn image_side_and_skew_of_carriers(input in scenes()) {
        on_picks(input, 10, |bench| {
            let (carrier, [a, b]) = (bench.carrier(), bench.vertices());
            let [start, end] = bench.truth.ends(carrier);
            let [row_a, row_b] = [a, b].map(|i| bench.truth.point(Point::Vertex(i)));
            let beside = sign(&reference::bracket([&bench.truth.eye, &start, &end, &row_a]));
            prop_assert_eq!(bench.exact.image_side(carrier, a), beside);
            prop_assert_eq!(bench.thorough.image_side(carrier, a), beside);
            let skew = sign(&reference::bracket([&start, &end, &row_a, &row_b]));
            prop_assert_eq!(bench.exact.skew(carrier, [a, b]), skew);
            prop_assert_eq!(bench.thorough.skew(carrier, [a, b]), skew);
            let other = bench.carrier();
            let [from, to] = bench.truth.ends(other);
            let skew = sign(&reference::bracket([&start, &end, &from, &to]));
            prop_assert_eq!(bench.exact.skew_of_carriers(carrier, other), skew);
            prop_assert_eq!(bench.exact.skew_of_carriers(other, carrier), skew);
            prop_assert_eq!(bench.thorough.skew_of_carriers(carrier, other), skew);
            Ok(())
        })?;
    }

    #[test]
    fn order_of_cuts_along_a_carrier(input in scenes()) {
        on_picks(input, 8, |bench| {
            let carrier = bench.carrier();
            let (Some(first), Some(second)) =
                (bench.crossing_cut(carrier), bench.crossing_cut(carrier)) else { return Ok(()) };
            let [here, there] = [first, second].map(|cut| bench.values(carrier, cut));
            let truth = bench.truth.order(carrier, first, second);
            let order = bench.exact.order(carrier, (first, &here), (second, &there));
            prop_assert_eq!(order, truth, "{:?} {:?} {:?}", carrier, first, second);
            let order = bench.thorough.order(carrier, (first, &here), (second, &there));
            prop_assert_eq!(order, truth);

            // Walked the other way, the order is the other way.
            let reversed = carrier.reversed();
            let [here, there] = [first, second].map(|cut| bench.values(reversed, cut));
            let order = bench.exact.order(reversed, (first, &here), (second, &there));
            prop_assert_eq!(order, truth.reverse());
            Ok(())
        })?;
    }

    #[test]
    fn parameter_is_correct_to_the_last_place(input in scenes()) {
        on_picks(input, 8, |bench| {
            let carrier = bench.carrier();
            let Some(cut) = bench.crossing_cut(carrier) else { return Ok(()) };
            let values = bench.values(carrier, cut);
            let parameter = bench.exact.parameter(carrier, cut, &values);
            prop_assert!((0.0..=1.0).contains(&parameter));
            let [numerator, denominator] = bench.truth.parameter(carrier, cut);
            // |parameter - n/d| <= 2^-52, times d 2^(52 + 1074).
            let places = 1074;
            let ours = reference::integer(parameter, places as i32) * &denominator;
            let error = ours - (numerator << places);
            let error = &error * error.signum();
            prop_assert!((error << 52) <= (denominator << places), "{} {:?}", parameter, cut);
            Ok(())
        })?;
    }

    #[test]
    fn combination_of_the_ends_of_a_carrier(input in scenes()) {
        on_picks(input, 8, |bench| {
            let (carrier, cut) = (bench.carrier(), bench.cut());
            let weights = [0, 1].map(|_| match bench.draw.below(3) {
                0 => 1.0,
                1 => (bench.draw.bits() >> 11) as f64 * 2048.0 + 2048.0,
                _ => (bench.draw.below(9) + 1) as f64,
            }.min(18_446_744_073_709_549_568.0));
            let [start, end] = bench.truth.ends(carrier);
            let part = |weight: f64, at: &Row, other: &Row| {
                IBig::from(weight as u64) * bench.truth.functional(cut, at) * &other[3]
            };
            let sum = part(weights[0], &start, &end) + part(weights[1], &end, &start);
            prop_assert_eq!(bench.exact.combination(carrier, weights, cut), sign(&sum));
            prop_assert_eq!(bench.thorough.combination(carrier, weights, cut), sign(&sum));
            Ok(())
        })?;
    }

    #[test]
    fn turn_is_the_sign_of_the_area(input in scenes()) {
        let (_, scene, _) = &input;
        let perspective = matches!(scene.eye, Eye::At(_));
        on_picks(input, 4, |bench| {
            let first = bench.draw.below(9) as u32;
            let end = first + 3 + bench.draw.below(u64::from(10 - first)) as u32;
            let rows: Vec<Row> =
                (first..end).map(|i| bench.truth.point(Point::Vertex(i))).collect();
            let view = [0, 1, 2].map(|i| bench.truth.eye[i].clone());
            let area = rows.iter().zip(rows.iter().cycle().skip(1)).fold(IBig::ZERO, |sum, (a, b)| {
                let [a, b] = [a, b].map(|row| [0, 1, 2].map(|i| row[i].clone()));
                sum + dot(&view, &cross(&a, &b))
            });
            if !perspective {
                prop_assert_eq!(bench.exact.turn(first..end), sign(&area));
                prop_assert_eq!(bench.thorough.turn(first..end), sign(&area));
            }
            Ok(())
        })?;
    }

    #[test]
    fn fold_against_a_threshold(
        input in scenes(),
        degrees in prop_oneof![0.0..180.0, Just(0.0), Just(45.0), Just(60.0), Just(90.0), Just(180.0)],
    ) {
        let threshold = FoldThreshold::from_degrees(degrees);
        // Radians are rounded; rational cosines are promised to be exact.
        let cosine = match degrees {
            60.0 => 0.5,
            90.0 => 0.0,
            _ => degrees.to_radians().cos(),
        };
        let cosine = IBig::from((cosine * f64::powi(2.0, 60)).round() as i128);
        on_picks(input, 8, |bench| {
            let [a, b, c, d] = bench.vertices();
            let [origin, to_b, to_c, to_d] =
                [a, b, c, d].map(|i| bench.truth.point(Point::Vertex(i)));
            let from_origin = |row: &Row| [0, 1, 2].map(|i| &row[i] - &origin[i]);
            let m = cross(&from_origin(&to_b), &from_origin(&to_c));
            let n = cross(&from_origin(&to_b), &from_origin(&to_d));
            let squares = dot(&m, &m) * dot(&n, &n);
            if squares == IBig::ZERO {
                return Ok(());
            }
            let truth = fold_exceeds(&dot(&m, &n), &squares, &cosine);
            let fold = Fold::measure(&bench.exact, [a, b], [c, d], threshold);
            prop_assert_eq!(fold.exceeds, truth);
            let fold = Fold::measure(&bench.thorough, [b, a], [d, c], threshold);
            prop_assert_eq!(fold.exceeds, truth);
            Ok(())
        })?;
    }

    #[test]
    fn places_on_carriers_with_one_image((kind, seed) in image_lines(), picks: u64) {
        let (scene, perspective) = image_line_scene(kind, seed);
        on_picks((kind, scene, picks), 10, |bench| {
            // Vertices 0..6 lie in one plane with the eye, in front of it;
            // the others anywhere.
            let mut edge = || loop {
                let [a, b] = [0, 1].map(|_| bench.draw.below(6) as u32);
                if bench.truth.image_order_of(a, b, [a, b]) != Ordering::Equal {
                    return Carrier::edge(a, b);
                }
            };
            let (reference, one, two) = (edge(), edge(), edge());
            let mut place = |carrier: Carrier| match bench.draw.below(4) {
                0 => Place::Start,
                1 => Place::End,
                _ => bench.crossing_cut(carrier).map_or(Place::End, Place::Cut),
            };
            let [first, second] = [one, two].map(|carrier| (carrier, place(carrier)));
            let Some(axis) = bench.exact.axis_across(reference) else {
                return Err(TestCaseError::fail("the image is more than a point"));
            };
            let [start, end] = bench.truth.ends(reference);
            let [x, y] = [first, second].map(|(carrier, place)| bench.truth.place(carrier, place));
            let truth = bench.truth.image_order([&start, &end], &x, &y);
            let order = bench.exact.order_along_image(reference, axis, first, second);
            prop_assert_eq!(order, truth, "{:?} {:?} {:?} {}", reference, first, second, perspective);
            let order = bench.thorough.order_along_image(reference, axis, first, second);
            prop_assert_eq!(order, truth);
            let turned = bench.exact.order_along_image(reference.reversed(), axis, first, second);
            prop_assert_eq!(turned, truth.reverse());
            if let Some(truth) = bench.truth.nearer([&start, &end], &x) {
                let nearer = bench.exact.nearer_than(reference, axis, first);
                prop_assert_eq!(nearer, truth, "{:?} {:?} {}", reference, first, perspective);
                let nearer = bench.thorough.nearer_than(reference, axis, first);
                prop_assert_eq!(nearer, truth);
                let turned = bench.exact.nearer_than(reference.reversed(), axis, first);
                prop_assert_eq!(turned, truth);
            }
            Ok(())
        })?;
    }

    #[test]
    fn axis_across_is_found_unless_the_image_is_a_point(input in scenes()) {
        on_picks(input, 10, |bench| {
            let carrier = bench.carrier();
            let [start, end] = bench.truth.ends(carrier);
            let is_point = bench.truth.images_coincide(&start, &end);
            let axis = bench.exact.axis_across(carrier);
            prop_assert_eq!(axis.is_none(), is_point, "{:?}", carrier);
            prop_assert_eq!(bench.thorough.axis_across(carrier), axis);
            if let Some(axis) = axis {
                let direction = reference::direction(axis);
                let across = reference::bracket([&bench.truth.eye, &start, &end, &direction]);
                prop_assert_ne!(sign(&across), Sign::Zero);
            }
            Ok(())
        })?;
    }
}

/// `m.n > -cos |m| |n|` with the cosine times 2^60, by an integer root.
fn fold_exceeds(product: &IBig, squares: &IBig, cosine: &IBig) -> bool {
    use dashu_int::ops::{BitTest, UnsignedAbs};
    // So many places that only an exact tie is within the root's error.
    let places = 200 + 2 * squares.clone().unsigned_abs().bit_len();
    let root = isqrt(&(squares << (2 * places)));
    let excess: IBig = (product << (60 + places)) + cosine * root;
    excess > (IBig::from(1) << 64)
}

/// Kinds in which points in one plane with the eye can be represented.
fn image_lines() -> impl Strategy<Value = (Kind, u64)> {
    let kinds = [Kind::Grid, Kind::Random, Kind::Far, Kind::Limit(60), Kind::Wide];
    (prop::sample::select(kinds.to_vec()), any::<u64>())
}

/// A scene whose first six vertices lie in the plane `x = y + k` with the
/// eye, in front of it.
fn image_line_scene(kind: Kind, seed: u64) -> (Scene, bool) {
    let mut scene = scenes::scene(kind, seed);
    let mut draw = Draw(seed ^ 0x5555);
    let perspective = draw.below(2) == 0;
    let unit = if kind == Kind::Far { 1.0 / 1024.0 } else { 1.0 };
    let offset = if kind == Kind::Far { 1e6 } else { 0.0 };
    for vertex in &mut scene.vertices[..6] {
        let across = offset + draw.integer(6) * unit;
        let depth = -(draw.below(5) as f64 + 1.0) * unit;
        *vertex = glam::dvec3(across, across, depth);
    }
    // Two of them are in different directions whatever was drawn.
    scene.vertices[0] = glam::dvec3(offset, offset, -unit);
    scene.vertices[1] = glam::dvec3(offset + unit, offset + unit, -unit);
    if kind == Kind::Limit(60) {
        scene.vertices[7].x = 1.0;
    }
    scene.eye = if perspective {
        Eye::At(glam::dvec3(offset, offset, unit))
    } else {
        Eye::Towards(glam::dvec3(1.0, 1.0, 4.0))
    };
    scene.near = None;
    (scene, perspective)
}
