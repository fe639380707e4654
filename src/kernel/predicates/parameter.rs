//! Where a cut divides a carrier, as a float.
//!
//! With the values A and B of the cut's functional at the two ends, each
//! times the weight of the other end, the parameter is `A / (A - B)`. What
//! is the same for all cuts of one carrier is evaluated once: the weights of
//! its ends, and the factors by which a piercing mixes the values at the two
//! vertices of its edge.

use super::formula::{Value, Weighted, beside, cut_at_vertex};
use super::{Carrier, Cut, Formula, Measured, Point, Points, Policy, Predicates};
use crate::kernel::numbers::{Dyadic, SmallInteger};

/// A carrier that is divided by cuts.
#[derive(Debug, Clone)]
pub struct Division<'p> {
    points: &'p Points,
    carrier: Carrier,
    ends: Ends,
}

/// The ends of a carrier, in integers that hold what is made of them.
#[derive(Debug, Clone)]
enum Ends {
    /// For coordinates of at most 60 bits,
    Narrow([End<3>; 2]),
    /// of at most 82,
    Wider([End<4>; 2]),
    /// and of any width.
    Any,
}

/// The bits of coordinates for which three words, and four, hold the
/// difference of two values of degree three, twice as many those of degree six,
/// and so on: see [`Formula::bits`].
const NARROW: u32 = 60;
const WIDER: u32 = 82;

/// What an end adds to values of degree three, in integers of as many words.
#[derive(Debug, Clone, Copy)]
enum End<const N: usize> {
    Vertex(u32),
    /// An edge, the functional of the pierced face at its ends, and the
    /// difference of those.
    Piercing {
        edge: [u32; 2],
        beside: [SmallInteger<N>; 2],
        weight: SmallInteger<N>,
    },
}

impl<const N: usize> End<N> {
    fn of(points: &Points, point: Point) -> Self {
        match point {
            Point::Vertex(vertex) => End::Vertex(vertex),
            Point::Piercing(piercing) => {
                let beside = beside::<SmallInteger<N>>(points, piercing);
                End::Piercing { edge: piercing.edge, beside, weight: beside[1] - beside[0] }
            }
        }
    }

    /// The value of a cut of degree three here, times the weight of this end.
    fn value<const M: usize>(&self, points: &Points, cut: Cut) -> SmallInteger<M> {
        let at = |vertex| cut_at_vertex::<SmallInteger<N>>(points, cut, vertex);
        match self {
            End::Vertex(vertex) => at(*vertex).widened(),
            End::Piercing { edge: [a, b], beside: [below, above], .. } => {
                above.wide_product::<N, M>(&at(*a)) - below.wide_product::<N, M>(&at(*b))
            }
        }
    }

    /// A value times the weight of this end.
    fn weigh<const M: usize, const K: usize>(&self, value: &SmallInteger<M>) -> SmallInteger<K> {
        match self {
            End::Vertex(_) => value.widened(),
            End::Piercing { weight, .. } => value.wide_product(weight),
        }
    }
}

/// The parameter of a cut of degree three. Of N words, M are twice and K three
/// times as many.
fn parameter_between<const N: usize, const M: usize, const K: usize>(
    points: &Points,
    [start, end]: &[End<N>; 2],
    cut: Cut,
) -> f64 {
    if let (End::Vertex(start), End::Vertex(end)) = (start, end) {
        let [a, b] =
            [*start, *end].map(|vertex| cut_at_vertex::<SmallInteger<N>>(points, cut, vertex));
        return SmallInteger::nearest_ratio(&a, &(a - b));
    }
    let a: SmallInteger<K> = end.weigh(&start.value::<M>(points, cut));
    let b: SmallInteger<K> = start.weigh(&end.value::<M>(points, cut));
    SmallInteger::nearest_ratio(&a, &(a - b))
}

impl Division<'_> {
    /// The parameter of a cut, from 0 at the carrier's start to 1 at its
    /// end, correct to 2^-52. The ends count with equal weight.
    pub fn parameter(&self, cut: Cut, values: &[Measured; 2]) -> f64 {
        let [a, b] = values.map(|measured| measured.value);
        let formula = Value(cut, self.carrier.ends[0]);
        let vertices = self.carrier.as_edge().is_some();
        if vertices && self.points.floats_hold(formula.bits(self.points.spread())) {
            let (x, y) = (a.value().abs(), b.value().abs());
            let span = x + y;
            let error = (a.bound() * y + b.bound() * x) / (span * span);
            if error < f64::EPSILON / 4.0 {
                return x / span;
            }
        }
        match (&self.ends, cut) {
            (_, Cut::NearLine(_)) | (Ends::Any, _) => self.by_integers_of_any_width(cut),
            (Ends::Narrow(ends), _) => parameter_between::<3, 6, 9>(self.points, ends, cut),
            (Ends::Wider(ends), _) => parameter_between::<4, 8, 12>(self.points, ends, cut),
        }
    }

    #[cold]
    fn by_integers_of_any_width(&self, cut: Cut) -> f64 {
        let [start, end] = self.carrier.ends;
        let value = |point, other| Weighted { cut, point, other }.evaluate::<Dyadic>(self.points);
        let (a, b) = (value(start, end), value(end, start));
        Dyadic::scaled_ratio(&a, &(a.clone() - b), 0)
    }
}

impl<'p, P: Policy> Predicates<'p, P> {
    /// A carrier, to be divided by many cuts.
    pub fn division(&self, carrier: Carrier) -> Division<'p> {
        let points = self.points();
        let ends = match points.spread() {
            spread if spread <= NARROW => {
                Ends::Narrow(carrier.ends.map(|point| End::of(points, point)))
            }
            spread if spread <= WIDER => {
                Ends::Wider(carrier.ends.map(|point| End::of(points, point)))
            }
            _ => Ends::Any,
        };
        Division { points, carrier, ends }
    }

    /// [`Division::parameter`] for a single cut.
    pub fn parameter(&self, carrier: Carrier, cut: Cut, values: &[Measured; 2]) -> f64 {
        self.division(carrier).parameter(cut, values)
    }
}
