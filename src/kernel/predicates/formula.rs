//! The polynomials behind the predicates, each written once.
//!
//! All of them are built from the bracket `[p, q, r, s]`, evaluated by
//! pivoting on its last row: `[p, q, r, s] = det(p - s, q - s, r - s)` for
//! points, and a row at infinity enters as it is. Implicit points enter
//! by linearity: `f(piercing of ab) = plane(b) f(a) - plane(a) f(b)`,
//! which is `f` at the point times a positive weight. So every formula
//! below is correct for vertices and piercings alike, at a degree that
//! grows by three per piercing.

use super::{Carrier, Cut, Piercing, Place, Point, Points};
use crate::kernel::numbers::{Ring, determinant3, difference, dot, piece};

/// Names of the predicates, for counting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub enum Predicate {
    /// On which side of a projected line lies a vertex?
    Side,
    /// On which side of a plane lies a vertex?
    Orientation,
    /// A plane's functional at an end of a carrier.
    Value,
    /// Two cuts along a carrier.
    Order,
    /// Two places along coincident images.
    AlongImage,
    /// A place before or behind a line with the same image.
    Depth,
    /// Two lines in space.
    Skew,
    /// A vertex beside a carrier's image.
    ImageSide,
    /// The angle at an edge.
    Fold,
    /// A plane's functional inside a carrier.
    Combination,
    /// Which way a closed ring runs.
    Turn,
    /// What a ray through a vertex meets.
    Ray,
    /// A point beside a line of the image.
    Beside,
    /// Which of two lines of the image turns left of the other.
    Bend,
    /// Which of two points of the image is swept first.
    Sweep,
    /// A point in which planes meet, or the eye, beside a plane.
    Above,
    /// Which of two such points is deeper.
    Deeper,
    /// Which of two vertices is further to the left.
    Column,
}

impl Predicate {
    /// How many there are.
    pub const COUNT: usize = 18;

    /// Names of the counters of filter failures and of decisions that
    /// needed big integers.
    pub const COUNTERS: [[&'static str; 2]; Self::COUNT] = [
        ["filter-failures-side", "big-integers-side"],
        ["filter-failures-orientation", "big-integers-orientation"],
        ["filter-failures-value", "big-integers-value"],
        ["filter-failures-order", "big-integers-order"],
        ["filter-failures-along-image", "big-integers-along-image"],
        ["filter-failures-depth", "big-integers-depth"],
        ["filter-failures-skew", "big-integers-skew"],
        ["filter-failures-image-side", "big-integers-image-side"],
        ["filter-failures-fold", "big-integers-fold"],
        ["filter-failures-combination", "big-integers-combination"],
        ["filter-failures-turn", "big-integers-turn"],
        ["filter-failures-ray", "big-integers-ray"],
        ["filter-failures-beside", "big-integers-beside"],
        ["filter-failures-bend", "big-integers-bend"],
        ["filter-failures-sweep", "big-integers-sweep"],
        ["filter-failures-above", "big-integers-above"],
        ["filter-failures-deeper", "big-integers-deeper"],
        ["filter-failures-column", "big-integers-column"],
    ];
}

/// A polynomial in the coordinates of a view.
pub trait Formula {
    /// Under which name failures are counted.
    const PREDICATE: Predicate;

    /// An upper bound of the degree in the coordinates.
    fn degree(&self) -> u32;

    /// An upper bound of the bits of every intermediate value, for integer
    /// coordinates of `spread` bits.
    fn bits(&self, spread: u32) -> u32 {
        // A difference of coordinates has one bit more than they, and each
        // doubling of the degree adds less than two bits for its sums.
        self.degree() * (spread + 2) + 2
    }

    /// The value. Generic over the kind of number, so that there is one
    /// formula and not one per kind.
    fn evaluate<R: Ring>(&self, points: &Points) -> R;
}

/// `[a, b, c, d]` of four vertices.
#[inline(always)]
pub(super) fn orientation<R: Ring>(points: &Points, a: u32, b: u32, c: u32, d: u32) -> R {
    piece!(R, {
        let pivot = points.vertex::<R>(d);
        determinant3(
            difference(points.vertex(a), &pivot),
            difference(points.vertex(b), &pivot),
            difference(points.vertex(c), &pivot),
        )
    })
}

/// The eye's row after pivoting on vertex `pivot`.
#[inline(always)]
fn eye_row<R: Ring>(points: &Points, pivot: &[R; 3]) -> [R; 3] {
    if points.is_perspective() { difference(points.eye(), pivot) } else { points.eye() }
}

/// `[E, p, q, r]` of the eye and three vertices.
#[inline(always)]
pub(super) fn side<R: Ring>(points: &Points, p: u32, q: u32, r: u32) -> R {
    piece!(R, {
        let pivot = points.vertex::<R>(r);
        determinant3(
            eye_row(points, &pivot),
            difference(points.vertex(p), &pivot),
            difference(points.vertex(q), &pivot),
        )
    })
}

/// `[E, p, k, r]` with the axis direction `k` at infinity.
pub(super) fn axis_side<R: Ring>(points: &Points, p: u32, axis: u8, r: u32) -> R {
    piece!(R, {
        let pivot = points.vertex::<R>(r);
        let direction = [0, 1, 2].map(|i| R::read(if i == axis { 1.0 } else { 0.0 }, 0));
        determinant3(eye_row(points, &pivot), difference(points.vertex(p), &pivot), direction)
    })
}

/// `[p, q, k, r]` with the axis direction `k` at infinity.
fn axis_plane<R: Ring>(points: &Points, [p, q]: [u32; 2], axis: u8, r: u32) -> R {
    piece!(R, {
        let pivot = points.vertex::<R>(r);
        let direction = [0, 1, 2].map(|i| R::read(if i == axis { 1.0 } else { 0.0 }, 0));
        determinant3(
            difference(points.vertex(p), &pivot),
            difference(points.vertex(q), &pivot),
            direction,
        )
    })
}

/// The value of the linear functional `f` at `point`, times the positive
/// weight of the point.
#[inline(always)]
fn at_point<R: Ring>(points: &Points, point: Point, f: &dyn Fn(u32) -> R) -> R {
    piece!(
        R,
        match point {
            Point::Vertex(vertex) => f(vertex),
            Point::Piercing(piercing) => {
                let ([a, b], [below, above]) = (piercing.edge, beside::<R>(points, piercing));
                above * f(a) - below * f(b)
            }
        }
    )
}

/// The functional of a piercing's face at the ends of its edge: not above
/// zero, and not below.
#[inline(always)]
pub(super) fn beside<R: Ring>(points: &Points, piercing: Piercing) -> [R; 2] {
    let ([a, b], [x, y, z]) = (piercing.edge, piercing.face);
    [orientation::<R>(points, x, y, z, a), orientation::<R>(points, x, y, z, b)]
}

/// The positive weight of a point: one for a vertex.
pub(super) fn weight<R: Ring>(points: &Points, point: Point) -> R {
    piece!(R, at_point(points, point, &|_| R::read(1.0, 0)))
}

/// How much the degree grows when a formula is applied to `point`.
pub(super) fn weight_degree(point: Point) -> u32 {
    match point {
        Point::Vertex(_) => 0,
        Point::Piercing(_) => 3,
    }
}

/// The functional of a cut at a vertex. Its sign tells the sides of the
/// plane apart; for a face it is `[a, b, c, x]`, for an edge `[E, a, b, x]`.
#[inline(always)]
pub(super) fn cut_at_vertex<R: Ring>(points: &Points, cut: Cut, x: u32) -> R {
    piece!(
        R,
        match cut {
            Cut::Face([a, b, c]) => orientation(points, a, b, c, x),
            Cut::Silhouette([a, b]) => side(points, a, b, x),
            Cut::Vertex(vertex, axis) => axis_side(points, vertex, axis, x),
            Cut::Near => near_at_vertex(points, x),
            Cut::NearLine(face) => near_line_at_vertex(points, face, x),
        }
    )
}

/// The degree of a cut's functional at a vertex.
#[inline(always)]
fn cut_degree(cut: Cut) -> u32 {
    match cut {
        Cut::Face(_) | Cut::Silhouette(_) | Cut::Vertex(..) | Cut::Near => 3,
        Cut::NearLine(_) => 6,
    }
}

/// `n(x) f(E) - f(x) n(E)` for the functionals of the near plane and a face:
/// a plane through their common line, and zero at the eye.
#[inline(never)]
fn near_line_at_vertex<R: Ring>(points: &Points, [a, b, c]: [u32; 3], x: u32) -> R {
    let Some((_, offset)) = points.near::<R>() else {
        return R::read(1.0, 0);
    };
    // [a, b, c, E] = -[E, a, b, c], and n(E) is minus the offset.
    orientation::<R>(points, a, b, c, x) * offset
        - near_at_vertex::<R>(points, x) * side::<R>(points, a, b, c)
}

/// `forward . (x - eye) - offset`; positive in front of the near plane.
pub(super) fn near_at_vertex<R: Ring>(points: &Points, x: u32) -> R {
    let Some((forward, offset)) = points.near::<R>() else {
        // Without a near plane everything is in front of it.
        return R::read(1.0, 0);
    };
    dot(forward, difference(points.vertex(x), &points.eye())) - offset
}

/// The functional of a cut at an end of a carrier.
#[inline(always)]
fn cut_at_point<R: Ring>(points: &Points, cut: Cut, point: Point) -> R {
    piece!(
        R,
        match point {
            Point::Vertex(vertex) => cut_at_vertex(points, cut, vertex),
            Point::Piercing(_) => at_point(points, point, &|x| cut_at_vertex(points, cut, x)),
        }
    )
}

/// `[E, p, q, r]`: on which side of the image of pq lies that of r?
pub(super) struct Side(pub(super) u32, pub(super) u32, pub(super) u32);

impl Formula for Side {
    const PREDICATE: Predicate = Predicate::Side;

    #[inline(always)]
    fn degree(&self) -> u32 {
        3
    }

    #[inline(always)]
    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        side(points, self.0, self.1, self.2)
    }
}

/// `[a, b, c, d]`: on which side of the plane abc lies d?
pub(super) struct Orientation(pub(super) [u32; 3], pub(super) u32);

impl Formula for Orientation {
    const PREDICATE: Predicate = Predicate::Orientation;

    #[inline(always)]
    fn degree(&self) -> u32 {
        3
    }

    #[inline(always)]
    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [a, b, c] = self.0;
        orientation(points, a, b, c, self.1)
    }
}

/// The sum of `[E, first, p, q]` over the edges pq of a closed ring of
/// consecutive vertices: twice the signed area of its image from an
/// orthographic eye, times the length of the eye's direction.
pub(super) struct Turn(pub(super) std::ops::Range<u32>);

impl Formula for Turn {
    const PREDICATE: Predicate = Predicate::Turn;

    fn degree(&self) -> u32 {
        3
    }

    fn bits(&self, spread: u32) -> u32 {
        // As many terms as the ring has corners.
        self.degree() * (spread + 2) + 2 + u32::BITS - (self.0.len() as u32).leading_zeros()
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let first = self.0.start;
        let pairs = (first + 1)..self.0.end.max(first + 2) - 1;
        pairs.fold(R::read(0.0, 0), |sum, p| sum + side(points, first, p, p + 1))
    }
}

/// On which side of a cutting plane lies a point?
pub(super) struct Value(pub(super) Cut, pub(super) Point);

impl Formula for Value {
    const PREDICATE: Predicate = Predicate::Value;

    #[inline(always)]
    fn degree(&self) -> u32 {
        cut_degree(self.0) + weight_degree(self.1)
    }

    #[inline(always)]
    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        cut_at_point(points, self.0, self.1)
    }
}

/// A plane's functional at one end of a carrier, times the weights of both
/// ends: so both ends count alike.
pub(super) struct Weighted {
    pub(super) cut: Cut,
    pub(super) point: Point,
    pub(super) other: Point,
}

impl Formula for Weighted {
    const PREDICATE: Predicate = Predicate::Value;

    fn degree(&self) -> u32 {
        cut_degree(self.cut) + weight_degree(self.point) + weight_degree(self.other)
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let value = cut_at_point::<R>(points, self.cut, self.point);
        match self.other {
            Point::Vertex(_) => value,
            Point::Piercing(_) => value * weight(points, self.other),
        }
    }
}

/// `[E, start, end, x]`: on which side of a carrier's image lies a point?
pub(super) struct ImageSide(pub(super) Carrier, pub(super) Point);

impl Formula for ImageSide {
    const PREDICATE: Predicate = Predicate::ImageSide;

    fn degree(&self) -> u32 {
        3 + self.0.ends.map(weight_degree).iter().sum::<u32>() + weight_degree(self.1)
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [start, end] = self.0.ends;
        at_point(points, self.1, &|x| {
            at_point(points, start, &|p| at_point(points, end, &|q| side(points, p, q, x)))
        })
    }
}

/// `[start, end, k, x]` of a carrier, an axis direction `k` and a place in
/// the plane of the carrier and the eye: on which side of the carrier's line
/// the place lies in that plane, up to the sense of the line.
pub(super) struct Depth {
    pub(super) carrier: Carrier,
    pub(super) place: Located,
    pub(super) axis: u8,
}

impl Formula for Depth {
    const PREDICATE: Predicate = Predicate::Depth;

    fn degree(&self) -> u32 {
        3 + self.carrier.ends.map(weight_degree).iter().sum::<u32>() + self.place.degree()
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [start, end] = self.carrier.ends;
        self.place.apply(points, &|x| {
            apply(points, start, &|p| {
                apply(points, end, &|q| axis_plane(points, [p, q], self.axis, x))
            })
        })
    }
}

/// `[start, end, a, b]`: how does a carrier pass the edge ab in space?
pub(super) struct Skew(pub(super) Carrier, pub(super) [u32; 2]);

impl Formula for Skew {
    const PREDICATE: Predicate = Predicate::Skew;

    #[inline(always)]
    fn degree(&self) -> u32 {
        3 + self.0.ends.map(weight_degree).iter().sum::<u32>()
    }

    #[inline(always)]
    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [a, b] = self.1;
        if let Some([p, q]) = self.0.as_edge() {
            return orientation(points, p, q, a, b);
        }
        let [start, end] = self.0.ends;
        at_point(points, start, &|p| at_point(points, end, &|q| orientation(points, p, q, a, b)))
    }
}

/// `[start, end, start', end']` of two carriers.
pub(super) struct SkewCarriers(pub(super) [Carrier; 2]);

impl Formula for SkewCarriers {
    const PREDICATE: Predicate = Predicate::Skew;

    fn degree(&self) -> u32 {
        3 + self.0.iter().flat_map(|carrier| carrier.ends).map(weight_degree).sum::<u32>()
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [[p, q], [r, s]] = self.0.map(|carrier| carrier.ends);
        apply(points, p, &|p| {
            apply(points, q, &|q| {
                apply(points, r, &|r| apply(points, s, &|s| orientation(points, p, q, r, s)))
            })
        })
    }
}

/// [`at_point`] as one function: four of them within one another would be
/// a great deal of code.
#[inline(never)]
pub(super) fn apply<R: Ring>(points: &Points, point: Point, f: &dyn Fn(u32) -> R) -> R {
    at_point(points, point, f)
}

/// `A2 B1 - A1 B2` for two cuts with values A at the start of the carrier
/// and B at its end. Its sign, times those of `A1 - B1` and `A2 - B2`, is
/// the sign of the difference of the parameters `A / (A - B)`.
pub(super) struct Order {
    pub(super) carrier: Carrier,
    pub(super) first: Cut,
    pub(super) second: Cut,
}

impl Formula for Order {
    const PREDICATE: Predicate = Predicate::Order;

    fn degree(&self) -> u32 {
        let weights = self.carrier.ends.map(weight_degree).iter().sum::<u32>();
        cut_degree(self.first) + cut_degree(self.second) + weights
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [start, end] = self.carrier.ends;
        let value = |cut, point| cut_at_point::<R>(points, cut, point);
        value(self.second, start) * value(self.first, end)
            - value(self.first, start) * value(self.second, end)
    }
}

/// The value of a plane's functional at the point of a carrier that
/// divides it in the ratio `weights[1] : weights[0]`, weights being
/// positive integers held in floats.
pub(super) struct Combination {
    pub(super) carrier: Carrier,
    pub(super) weights: [f64; 2],
    pub(super) cut: Cut,
}

impl Formula for Combination {
    const PREDICATE: Predicate = Predicate::Combination;

    fn degree(&self) -> u32 {
        cut_degree(self.cut) + self.carrier.ends.map(weight_degree).iter().sum::<u32>()
    }

    fn bits(&self, spread: u32) -> u32 {
        // Weights have at most 64 bits, twice that for the ends' own weights.
        self.degree() * (spread + 2) + 2 + 130
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [start, end] = self.carrier.ends;
        // The ends' own positive weights must be equal before adding up:
        // each side is multiplied with the weight of the other.
        let one =
            |point, other| weight::<R>(points, other) * cut_at_point::<R>(points, self.cut, point);
        R::read(self.weights[0], 0) * one(start, end)
            + R::read(self.weights[1], 0) * one(end, start)
    }
}

/// The value of a plane's functional at a point of a carrier strictly
/// between two of its places: the sum of its values there, each times a
/// positive weight. However short the piece, this is inside it.
pub(super) struct Between {
    pub(super) places: [Located; 2],
    pub(super) cut: Cut,
}

impl Formula for Between {
    const PREDICATE: Predicate = Predicate::Combination;

    fn degree(&self) -> u32 {
        let [first, second] = self.places.map(|located| located.degree());
        cut_degree(self.cut) + first.max(second)
    }

    fn bits(&self, spread: u32) -> u32 {
        // One more for the sum of two places.
        self.degree() * (spread + 2) + 3
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [first, second] = self
            .places
            .map(|located| located.apply(points, &|x| cut_at_vertex::<R>(points, self.cut, x)));
        first + second
    }
}

/// A place on a carrier, for comparing places on different carriers whose
/// images coincide.
#[derive(Clone, Copy)]
pub(super) struct Located {
    pub(super) carrier: Carrier,
    pub(super) place: Place,
    /// The sign of a cut's functional at the start of the carrier.
    pub(super) positive_start: bool,
}

impl Located {
    pub(super) fn degree(&self) -> u32 {
        let [start, end] = self.carrier.ends.map(weight_degree);
        match self.place {
            Place::Start => start,
            Place::End => end,
            Place::Cut(cut) => cut_degree(cut) + start + end,
        }
    }

    /// The functional `f` at the place, times a positive weight.
    pub(super) fn apply<R: Ring>(&self, points: &Points, f: &dyn Fn(u32) -> R) -> R {
        let [start, end] = self.carrier.ends;
        match self.place {
            Place::Start => at_point(points, start, f),
            Place::End => at_point(points, end, f),
            Place::Cut(cut) => {
                let first = cut_at_point::<R>(points, cut, start);
                let last = cut_at_point::<R>(points, cut, end);
                let sum = first * at_point(points, end, f) - last * at_point(points, start, f);
                if self.positive_start { sum } else { -sum }
            }
        }
    }
}

/// `[E, x, y, k]` of two places and an axis direction `k`: the order of
/// their images on a common image line, up to the sense of that line.
pub(super) struct AlongImage {
    pub(super) first: Located,
    pub(super) second: Located,
    pub(super) axis: u8,
}

impl Formula for AlongImage {
    const PREDICATE: Predicate = Predicate::AlongImage;

    fn degree(&self) -> u32 {
        3 + self.first.degree() + self.second.degree()
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        self.first.apply(points, &|x| {
            // [E, x, y, k] = -[E, x, k, y].
            -self.second.apply(points, &|y| axis_side(points, x, self.axis, y))
        })
    }
}
