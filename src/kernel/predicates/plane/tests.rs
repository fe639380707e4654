//! Signs at points of planes, held against rational arithmetic.

use super::*;
use crate::kernel::numbers::Fraction;
use crate::kernel::predicates::{Exact, Eye, NearPlane, Thorough};
use proptest::prelude::*;

type Rational = [Fraction; 3];

fn rational(v: DVec3) -> Rational {
    v.to_array().map(Fraction::of_float)
}

fn minus(a: &Rational, b: &Rational) -> Rational {
    [0, 1, 2].map(|i| a[i].clone() - b[i].clone())
}

fn times(a: &Rational, b: &Rational) -> Fraction {
    (0..3).fold(Fraction::zero(), |sum, i| sum + a[i].clone() * b[i].clone())
}

fn crossed(a: &Rational, b: &Rational) -> Rational {
    let minor = |i: usize, j: usize| a[i].clone() * b[j].clone() - a[j].clone() * b[i].clone();
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// `normal . x + constant`, written out from the definition of each plane.
fn functional(plane: Plane, vertices: &[DVec3], view: &View) -> (Rational, Fraction) {
    let at = |i: u32| rational(vertices[i as usize]);
    let through = |normal: Rational, x: &Rational| {
        let constant = -times(&normal, x);
        (normal, constant)
    };
    match plane {
        Plane::Input(InputPlane::Face([a, b, c])) => {
            let (u, v) = (minus(&at(b), &at(a)), minus(&at(c), &at(a)));
            through(crossed(&v, &u), &at(a))
        }
        Plane::Input(InputPlane::Wall([a, b], axis)) => {
            through(crossed(&unit(axis), &minus(&at(b), &at(a))), &at(a))
        }
        Plane::Input(InputPlane::Across(a, axis)) => through(unit(axis), &at(a)),
        Plane::Input(InputPlane::Level(a)) => through(rational(view.forward()), &at(a)),
        Plane::Input(InputPlane::Near) => through(rational(view.forward()), &view.near_point()),
        Plane::Silhouette([a, b]) => {
            let eye = rational(view.eye.coordinates());
            let eye = if view.eye.is_perspective() { minus(&eye, &at(a)) } else { eye };
            through(crossed(&eye, &minus(&at(b), &at(a))), &at(a))
        }
        Plane::Shadow(face, cut) => {
            let (h, h0) = functional(InputPlane::Face(face).into(), vertices, view);
            let (p, p0) = functional(cut.into(), vertices, view);
            let eye = rational(view.eye.coordinates());
            let weight = f64::from(u8::from(view.eye.is_perspective()));
            let weight = Fraction::of_float(weight);
            let at_h = times(&h, &eye) + h0.clone() * weight.clone();
            let at_p = times(&p, &eye) + p0.clone() * weight;
            let mixed =
                |a: &Fraction, b: &Fraction| a.clone() * at_p.clone() - b.clone() * at_h.clone();
            ([0, 1, 2].map(|i| mixed(&h[i], &p[i])), mixed(&h0, &p0))
        }
    }
}

fn unit(axis: u8) -> Rational {
    [0, 1, 2].map(|i| Fraction::of_float(if i == axis { 1.0 } else { 0.0 }))
}

#[derive(Debug)]
struct View {
    eye: Eye,
    near: Option<NearPlane>,
}

impl View {
    fn forward(&self) -> DVec3 {
        self.near.map_or(-self.eye.coordinates(), |near| near.forward)
    }

    /// The near planes of these tests look along an axis.
    fn near_point(&self) -> Rational {
        let near = self.near.expect("a near plane");
        rational(self.eye.coordinates() + near.forward * near.distance)
    }
}

fn place(predicates: &Predicates<'_, Exact>, point: PlanePoint) -> Rational {
    let (parts, weight) = predicates.position_ratio(point);
    parts.map(|part| {
        let fraction = Fraction::new(part, weight.clone()).expect("a weight");
        fraction.times_power_of_two(predicates.ratio_exponent())
    })
}

fn value(plane: Plane, x: &Rational, vertices: &[DVec3], view: &View) -> Fraction {
    let (normal, constant) = functional(plane, vertices, view);
    times(&normal, x) + constant
}

fn coordinates(range: std::ops::Range<i32>) -> impl Strategy<Value = DVec3> {
    (range.clone(), range.clone(), range)
        .prop_map(|(x, y, z)| DVec3::new(x.into(), y.into(), z.into()))
}

fn views() -> impl Strategy<Value = View> {
    (coordinates(-3..4), any::<bool>()).prop_map(|(place, perspective)| {
        if perspective {
            let eye = place + DVec3::new(0.0, 0.0, 9.0);
            let near = NearPlane { forward: -DVec3::Z, distance: 1.0 };
            View { eye: Eye::At(eye), near: Some(near) }
        } else {
            let direction = if place == DVec3::ZERO { DVec3::X } else { place };
            View { eye: Eye::Towards(direction), near: None }
        }
    })
}

/// The planes of nine vertices, of every kind.
fn planes(view: &View) -> Vec<Plane> {
    let mut planes: Vec<Plane> = vec![
        InputPlane::Face([3, 4, 5]).into(),
        InputPlane::Face([6, 7, 8]).into(),
        InputPlane::Face([0, 4, 8]).into(),
        InputPlane::Wall([1, 5], 0).into(),
        InputPlane::Wall([2, 6], 2).into(),
        InputPlane::Across(7, 1).into(),
        InputPlane::Level(3).into(),
        Plane::Silhouette([2, 7]),
        Plane::Silhouette([0, 1]),
        Plane::Shadow([0, 1, 2], InputPlane::Face([3, 4, 5])),
        Plane::Shadow([3, 4, 5], InputPlane::Across(1, 0)),
    ];
    if view.near.is_some() {
        planes.push(InputPlane::Near.into());
        planes.push(Plane::Shadow([6, 7, 8], InputPlane::Near));
    }
    planes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn signs_at_points_of_planes_are_those_of_rationals(
        vertices in prop::collection::vec(coordinates(-3..4), 9),
        view in views(),
    ) {
        let points = Points::new(&vertices, view.eye, view.near);
        let predicates = Predicates::<Exact>::new(&points);
        let thorough = Predicates::<Thorough>::new(&points);
        let planes = planes(&view);
        let mut found = vec![PlanePoint::Vertex(4)];
        for (i, &p) in planes.iter().enumerate() {
            let ends = [0, 4].map(|x| predicates.above(p, PlanePoint::Vertex(x)));
            match ends {
                [Sign::Negative, Sign::Positive] => found.push(PlanePoint::OnEdge([0, 4], p)),
                [Sign::Positive, Sign::Negative] => found.push(PlanePoint::OnEdge([4, 0], p)),
                _ => {}
            }
            for &q in &planes[i + 1..] {
                let point = PlanePoint::OnFace([0, 1, 2], [p, q]);
                match predicates.position_ratio(point).1.sign() {
                    Sign::Positive => found.push(point),
                    Sign::Negative => found.push(PlanePoint::OnFace([0, 1, 2], [q, p])),
                    Sign::Zero => {}
                }
            }
        }
        let mut last: Option<(PlanePoint, Fraction)> = None;
        for point in found {
            let x = place(&predicates, point);
            if let PlanePoint::OnFace(face, cuts) = point {
                for plane in [InputPlane::Face(face).into(), cuts[0], cuts[1]] {
                    prop_assert_eq!(value(plane, &x, &vertices, &view).sign(), Sign::Zero);
                }
            }
            for &plane in &planes {
                let expected = value(plane, &x, &vertices, &view).sign();
                prop_assert_eq!(predicates.above(plane, point), expected, "{:?} {:?}", plane, point);
                prop_assert_eq!(thorough.above(plane, point), expected);
            }
            let depth = times(&rational(view.forward()), &x);
            if let Some((other, least)) = &last {
                let expected = (depth.clone() - least.clone()).sign();
                prop_assert_eq!(predicates.deeper(point, *other), expected);
                prop_assert_eq!(thorough.deeper(*other, point), -expected);
            }
            last = Some((point, depth));
        }
        prop_assert!(thorough.counters().iter().all(|(name, _)| name != "ladder-disagreements"));
    }
}
