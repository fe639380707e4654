//! The ladder of number types, and the policies that climb it.

use super::formula::{
    AlongImage, Between, Combination, Depth, ImageSide, Located, Order, Orientation, Side, Skew,
    SkewCarriers, Turn, Value,
};
use super::{Carrier, Cut, Formula, Place, Point, Points, Predicate};
use crate::kernel::numbers::{BigInteger, Dyadic, Filtered, FixedInteger, Sign, SmallInteger};
use crate::run::Counters;
use std::cell::Cell;
use std::cmp::Ordering;

/// The value of a functional: its certain sign, and the float with its
/// bound from which further formulas can be filtered.
#[derive(Debug, Clone, Copy)]
pub struct Measured {
    /// The sign, decided by the policy.
    pub sign: Sign,
    /// The float value; meaningful only where floats can hold the formula.
    pub value: Filtered,
}

/// How often the filter failed, and how often only big integers helped.
#[derive(Debug, Clone, Default)]
pub struct Tally {
    failures: [Cell<u64>; Predicate::COUNT],
    big: [Cell<u64>; Predicate::COUNT],
    disagreements: Cell<u64>,
    decisions: Cell<u64>,
    plain_wrong: Cell<u64>,
}

/// How the sign of a formula is found.
pub trait Policy: Copy + Default + Send + Sync + 'static {
    /// The policy's name in tables.
    const NAME: &'static str;
    /// Whether all signs are right, so that none contradict one another.
    const NEVER_ERRS: bool;

    /// The sign of `formula`, given its float value.
    fn resolve<F: Formula>(points: &Points, formula: &F, value: Filtered, tally: &Tally) -> Sign;

    /// The sign of `formula`.
    #[inline(always)]
    fn decide<F: Formula>(points: &Points, formula: &F, tally: &Tally) -> Sign {
        let value = formula.evaluate::<Filtered>(points);
        Self::resolve(points, formula, value, tally)
    }
}

/// The policy of the product: the sign is right, always.
#[derive(Debug, Clone, Copy, Default)]
pub struct Exact;

/// The filter's float where the filter cannot decide: for measurements.
#[derive(Debug, Clone, Copy, Default)]
pub struct FilterOnly;

/// Plain floats without an error bound: for measurements.
#[derive(Debug, Clone, Copy, Default)]
pub struct Plain;

/// Evaluates every step that is sound for the scene, answers with the last
/// and counts under `ladder-disagreements` where one of them differed: for
/// tests, where that counter must stay zero. Slow.
#[derive(Debug, Clone, Copy, Default)]
pub struct Thorough;

/// Answers as [`Exact`] and counts: under `decisions` all of them, under
/// `plain-floats-wrong` those in which [`Plain`] has another sign. For
/// measurements; slower.
#[derive(Debug, Clone, Copy, Default)]
pub struct Audited;

/// Integers from the first decision on, as if there were no filter: for
/// measurements. Right, and slow.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unfiltered;

impl Policy for Exact {
    const NAME: &'static str = "exact";
    const NEVER_ERRS: bool = true;

    #[inline(always)]
    fn resolve<F: Formula>(points: &Points, formula: &F, value: Filtered, tally: &Tally) -> Sign {
        // Floats too small for a value have an infinite bound.
        let sign = match points.is_narrow() {
            true => value.sign(),
            false => wide_sign(points, formula, value),
        };
        sign.unwrap_or_else(|| exact_sign(points, formula, tally))
    }
}

impl Policy for Unfiltered {
    const NAME: &'static str = "unfiltered";
    const NEVER_ERRS: bool = true;

    #[inline(always)]
    fn resolve<F: Formula>(points: &Points, formula: &F, _: Filtered, tally: &Tally) -> Sign {
        exact_sign(points, formula, tally)
    }
}

impl Policy for FilterOnly {
    const NAME: &'static str = "filter-only";
    const NEVER_ERRS: bool = false;

    #[inline(always)]
    fn resolve<F: Formula>(_: &Points, _: &F, value: Filtered, _: &Tally) -> Sign {
        value.sign().unwrap_or_else(|| Sign::of(value.value()))
    }
}

impl Policy for Plain {
    const NAME: &'static str = "plain";
    const NEVER_ERRS: bool = false;

    #[inline(always)]
    fn resolve<F: Formula>(_: &Points, _: &F, value: Filtered, _: &Tally) -> Sign {
        Sign::of(value.value())
    }

    #[inline(always)]
    fn decide<F: Formula>(points: &Points, formula: &F, _: &Tally) -> Sign {
        Sign::of(formula.evaluate::<f64>(points))
    }
}

impl Policy for Thorough {
    const NAME: &'static str = "thorough";
    const NEVER_ERRS: bool = true;

    fn resolve<F: Formula>(points: &Points, formula: &F, value: Filtered, tally: &Tally) -> Sign {
        let truth = formula.evaluate::<BigInteger>(points).sign();
        let bits = formula.bits(points.spread());
        let filtered = match points.is_narrow() {
            true => value.sign(),
            false => wide_sign(points, formula, value),
        };
        let mut agree = filtered.is_none_or(|sign| sign == truth);
        agree &= formula.evaluate::<Dyadic>(points).sign() == truth;
        if points.is_narrow() {
            let holds = |width: u32| bits <= width;
            agree &= !holds(191) || formula.evaluate::<SmallInteger<3>>(points).sign() == truth;
            agree &= !holds(383) || formula.evaluate::<SmallInteger<6>>(points).sign() == truth;
            agree &= !holds(192) || formula.evaluate::<FixedInteger<3>>(points).sign() == truth;
            agree &= !holds(384) || formula.evaluate::<FixedInteger<6>>(points).sign() == truth;
            agree &= !holds(768) || formula.evaluate::<FixedInteger<12>>(points).sign() == truth;
            agree &= !holds(1792) || formula.evaluate::<FixedInteger<28>>(points).sign() == truth;
        }
        tally.disagreements.set(tally.disagreements.get() + u64::from(!agree));
        truth
    }
}

impl Policy for Audited {
    const NAME: &'static str = "audited";
    const NEVER_ERRS: bool = true;

    fn resolve<F: Formula>(points: &Points, formula: &F, value: Filtered, tally: &Tally) -> Sign {
        let truth = Exact::resolve(points, formula, value, tally);
        let plain = Sign::of(formula.evaluate::<f64>(points));
        tally.decisions.set(tally.decisions.get() + 1);
        tally.plain_wrong.set(tally.plain_wrong.get() + u64::from(plain != truth));
        truth
    }
}

/// What `$done` makes of the value of a formula in the narrowest integers of
/// fixed width that hold it; nothing if none does.
macro_rules! in_narrowest {
    ($formula:expr, $points:expr, |$value:ident| $done:expr) => {
        in_narrowest!($formula, $points, |$value| $done,
            191 => SmallInteger<3>, 383 => SmallInteger<6>,
            768 => FixedInteger<12>, 1792 => FixedInteger<28>)
    };
    ($formula:expr, $points:expr, |$value:ident| $done:expr, $($most:literal => $integer:ty),*) => {
        match $formula.bits($points.spread()) {
            _ if !$points.is_narrow() => None,
            $(0..=$most => {
                let $value = $formula.evaluate::<$integer>($points);
                Some($done)
            })*
            _ => None,
        }
    };
}

/// The steps behind the filter.
#[cold]
#[inline(never)]
fn exact_sign<F: Formula>(points: &Points, formula: &F, tally: &Tally) -> Sign {
    let name = F::PREDICATE as usize;
    tally.failures[name].set(tally.failures[name].get() + 1);
    in_narrowest!(formula, points, |value| value.sign()).unwrap_or_else(|| {
        tally.big[name].set(tally.big[name].get() + 1);
        formula.evaluate::<Dyadic>(points).sign()
    })
}

/// The sign of a float, if it is certain in a scene whose coordinates are no
/// integers.
#[cold]
#[inline(never)]
fn wide_sign<F: Formula>(points: &Points, formula: &F, value: Filtered) -> Option<Sign> {
    value.sign_beyond(points.underflow(formula)?)
}

/// A view's points under a policy: what algorithms ask. One per worker,
/// because it counts without locks.
#[derive(Debug, Clone)]
pub struct Predicates<'p, P: Policy = Exact> {
    points: &'p Points,
    tally: Tally,
    policy: std::marker::PhantomData<P>,
}

impl<'p, P: Policy> Predicates<'p, P> {
    /// Predicates on `points`.
    pub fn new(points: &'p Points) -> Self {
        Predicates { points, tally: Tally::default(), policy: std::marker::PhantomData }
    }

    /// The points.
    pub fn points(&self) -> &'p Points {
        self.points
    }

    /// Filter failures so far, by predicate.
    pub fn counters(&self) -> Counters {
        let mut counters = Counters::default();
        let counts = [
            ("ladder-disagreements", &self.tally.disagreements),
            ("decisions", &self.tally.decisions),
            ("plain-floats-wrong", &self.tally.plain_wrong),
        ];
        for (name, cell) in counts {
            if cell.get() > 0 {
                counters.add(name, cell.get());
            }
        }
        for (i, [failures, big]) in Predicate::COUNTERS.iter().enumerate() {
            for (name, cell) in [(failures, &self.tally.failures[i]), (big, &self.tally.big[i])] {
                if cell.get() > 0 {
                    counters.add(*name, cell.get());
                }
            }
        }
        counters
    }

    /// The sign of a formula.
    #[inline(always)]
    pub fn decide<F: Formula>(&self, formula: &F) -> Sign {
        P::decide(self.points, formula, &self.tally)
    }

    /// On which side of the image of pq does that of r lie? Positive is
    /// left. Degree 3.
    #[inline(always)]
    pub fn side(&self, p: u32, q: u32, r: u32) -> Sign {
        self.decide(&Side(p, q, r))
    }

    /// Which way a triangle's corners turn in the image; zero is edge-on.
    #[inline(always)]
    pub fn facing(&self, [a, b, c]: [u32; 3]) -> Sign {
        self.side(a, b, c)
    }

    /// Which way the image of a closed ring of consecutive vertices turns,
    /// by its signed area: positive is counterclockwise. For orthographic
    /// eyes; the ring need not be simple. O(n).
    pub fn turn(&self, ring: std::ops::Range<u32>) -> Sign {
        self.decide(&Turn(ring))
    }

    /// On which side of a triangle's plane does vertex `x` lie? Positive is
    /// where abc and x have a positive `[a, b, c, x]`; a point is behind the
    /// triangle where this equals [`Self::facing`]. Degree 3.
    #[inline(always)]
    pub fn plane(&self, face: [u32; 3], x: u32) -> Sign {
        self.decide(&Orientation(face, x))
    }

    /// The functional of a cutting plane at an end of a carrier.
    #[inline(always)]
    pub fn value(&self, cut: Cut, point: Point) -> Measured {
        let formula = Value(cut, point);
        let value = formula.evaluate::<Filtered>(self.points);
        Measured { sign: P::resolve(self.points, &formula, value, &self.tally), value }
    }

    /// The sign of [`Self::value`].
    #[inline(always)]
    pub fn value_sign(&self, cut: Cut, point: Point) -> Sign {
        self.decide(&Value(cut, point))
    }

    /// On which side of a carrier's image does vertex `x` lie?
    #[inline(always)]
    pub fn image_side(&self, carrier: Carrier, x: u32) -> Sign {
        match carrier.as_edge() {
            Some([p, q]) => self.side(p, q, x),
            None => self.decide(&ImageSide(carrier, Point::Vertex(x))),
        }
    }

    /// On which side of a carrier's image does a point lie?
    pub fn image_side_of_point(&self, carrier: Carrier, point: Point) -> Sign {
        match point {
            Point::Vertex(vertex) => self.image_side(carrier, vertex),
            Point::Piercing(_) => self.decide(&ImageSide(carrier, point)),
        }
    }

    /// The sign of `[start, end, a, b]`: zero if the carrier's line meets
    /// the line ab in space.
    #[inline(always)]
    pub fn skew(&self, carrier: Carrier, edge: [u32; 2]) -> Sign {
        self.decide(&Skew(carrier, edge))
    }

    /// The sign of the bracket of the ends of two carriers: zero if their
    /// lines meet in space. Which of them comes first does not matter.
    pub fn skew_of_carriers(&self, first: Carrier, second: Carrier) -> Sign {
        match (first.as_edge(), second.as_edge()) {
            (_, Some(edge)) => self.skew(first, edge),
            (Some(edge), None) => self.skew(second, edge),
            (None, None) => self.decide(&SkewCarriers([first, second])),
        }
    }

    /// The sign of a cut's functional at the point that divides the carrier
    /// in the ratio `weights[1] : weights[0]`; weights are positive integers
    /// below 2^64 held in floats.
    pub fn combination(&self, carrier: Carrier, weights: [f64; 2], cut: Cut) -> Sign {
        self.decide(&Combination { carrier, weights, cut })
    }

    /// The sign of a cut's functional at some point of the carrier strictly
    /// between two of its places, always the same one for the same places.
    pub fn between(&self, carrier: Carrier, places: [Place; 2], cut: Cut) -> Sign {
        let places = places.map(|place| self.locate(carrier, place));
        self.decide(&Between { places, cut })
    }

    /// Compares the places of two cuts along a carrier. `first` and
    /// `second` carry the values at its start and end; each cut's signs must
    /// differ (one of them may be zero).
    #[inline]
    pub fn order(
        &self,
        carrier: Carrier,
        first: (Cut, &[Measured; 2]),
        second: (Cut, &[Measured; 2]),
    ) -> Ordering {
        if first.0 == second.0 {
            return Ordering::Equal;
        }
        let ([a1, b1], [a2, b2]) = (first.1, second.1);
        let formula = Order { carrier, first: first.0, second: second.0 };
        let value = a2.value * b1.value - a1.value * b2.value;
        let sign = P::resolve(self.points, &formula, value, &self.tally);
        (sign * span_sign(first.1) * span_sign(second.1)).into()
    }

    /// Compares two places on carriers whose images lie on one line, by
    /// their order along the image of `reference`, whose image runs across
    /// `axis`: see [`Self::axis_across`].
    pub fn order_along_image(
        &self,
        reference: Carrier,
        axis: u8,
        first: (Carrier, Place),
        second: (Carrier, Place),
    ) -> Ordering {
        self.order_across(axis, self.sense_across(reference, axis), first, second)
    }

    /// Which way the image of a carrier runs across an axis.
    pub fn sense_across(&self, carrier: Carrier, axis: u8) -> Sign {
        let [first, second] = [Place::Start, Place::End].map(|place| Located {
            carrier,
            place,
            positive_start: true,
        });
        self.decide(&AlongImage { first, second, axis })
    }

    /// [`Self::order_along_image`] for a reference that runs across `axis` in
    /// this sense: see [`Self::sense_across`].
    pub fn order_across(
        &self,
        axis: u8,
        sense: Sign,
        first: (Carrier, Place),
        second: (Carrier, Place),
    ) -> Ordering {
        if is_one_image(first, second) {
            return Ordering::Equal;
        }
        let [first, second] = [first, second].map(|(carrier, place)| self.locate(carrier, place));
        (-(self.decide(&AlongImage { first, second, axis }) * sense)).into()
    }

    /// Whether a place on a carrier, whose image lies on that of `line`, is
    /// nearer to the eye than the point of `line` that it covers: positive if
    /// it is, zero if it is that very point. The images run across `axis`:
    /// see [`Self::axis_across`].
    pub fn nearer_than(&self, line: Carrier, axis: u8, (other, place): (Carrier, Place)) -> Sign {
        let behind = self.sense_across(line, axis);
        let place = self.locate(other, place);
        -(self.decide(&Depth { carrier: line, place, axis }) * behind)
    }

    /// A place with the sign that makes its weight positive.
    pub(super) fn locate(&self, carrier: Carrier, place: Place) -> Located {
        Located {
            carrier,
            place,
            positive_start: match place {
                Place::Cut(cut) => {
                    self.value_sign(cut, carrier.ends[0]) == Sign::Positive
                        || self.value_sign(cut, carrier.ends[1]) == Sign::Negative
                }
                Place::Start | Place::End => true,
            },
        }
    }

    /// An axis direction that does not lie in the plane of the carrier and
    /// the eye, if the carrier's image is more than a point.
    pub fn axis_across(&self, carrier: Carrier) -> Option<u8> {
        (0..3).find(|&axis| !self.sense_across(carrier, axis).is_zero())
    }
}

/// Whether two places on one image line are named as one: as the same point,
/// or where the same plane through the eye meets it.
fn is_one_image(first: (Carrier, Place), second: (Carrier, Place)) -> bool {
    let point = |(carrier, place): (Carrier, Place)| match place {
        Place::Start => Some(carrier.ends[0]),
        Place::End => Some(carrier.ends[1]),
        Place::Cut(_) => None,
    };
    match (first.1, second.1) {
        (Place::Cut(one), Place::Cut(other)) => {
            one == other && !matches!(one, Cut::Face(_) | Cut::Near)
        }
        _ => point(first).is_some_and(|one| point(second) == Some(one)),
    }
}

/// The sign of `A - B` for values of differing signs.
#[inline(always)]
fn span_sign(values: &[Measured; 2]) -> Sign {
    values[0].sign.or(-values[1].sign)
}
