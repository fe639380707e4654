//! The same questions in integers of any size, written apart from the
//! crate: constructed points with coordinates that are quotients, and
//! determinants as sums over all permutations.

use super::scenes::Scene;
use dashu_int::{IBig, Sign as IntegerSign};
use glam::DVec3;
use std::cmp::Ordering;
use umriss::kernel::numbers::Sign;
use umriss::kernel::predicates::{Carrier, Cut, Eye, Piercing, Place, Point};

/// A homogeneous point: `x/w, y/w, z/w` with `w > 0`, or a direction.
pub(crate) type Row = [IBig; 4];

/// A scene in integers: every float times one power of two.
pub(crate) struct Reference {
    vertices: Vec<Row>,
    pub(crate) eye: Row,
    near: Option<([IBig; 3], IBig)>,
}

/// `value * 2^places`, which must be an integer.
pub(crate) fn integer(value: f64, places: i32) -> IBig {
    let bits = value.to_bits();
    let field = (bits >> 52 & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let (mantissa, exponent) =
        if field == 0 { (fraction, -1074) } else { (fraction + (1 << 52), field - 1075) };
    let shift = exponent + places;
    let magnitude = if shift >= 0 {
        IBig::from(mantissa) << shift as usize
    } else {
        let divisor = IBig::from(1) << (-shift) as usize;
        let quotient = IBig::from(mantissa) / &divisor;
        assert_eq!(&quotient * divisor, IBig::from(mantissa), "{value} has more places");
        quotient
    };
    if bits >> 63 == 1 { -magnitude } else { magnitude }
}

/// How many binary places these numbers need.
fn places(values: impl IntoIterator<Item = f64>) -> i32 {
    let of = |value: f64| {
        let bits = value.abs().to_bits();
        let mantissa = if bits >> 52 == 0 { bits } else { bits & ((1 << 52) - 1) | 1 << 52 };
        let exponent = ((bits >> 52) as i32).max(1) - 1075;
        -(exponent + mantissa.trailing_zeros() as i32)
    };
    values.into_iter().filter(|value| *value != 0.0).map(of).max().unwrap_or(0)
}

fn row(point: DVec3, places: i32, w: i64) -> Row {
    let [x, y, z] = point.to_array().map(|value| integer(value, places));
    [x, y, z, IBig::from(w)]
}

pub(crate) fn sign(value: &IBig) -> Sign {
    value.cmp(&IBig::ZERO).into()
}

impl Reference {
    /// The scene in integers.
    pub(crate) fn new(scene: &Scene) -> Self {
        let coordinates = scene.vertices.iter().flat_map(|vertex| vertex.to_array());
        let eye = scene.eye.coordinates();
        let perspective = matches!(scene.eye, Eye::At(_));
        let places = places(coordinates.chain(eye.to_array().into_iter().filter(|_| perspective)));
        let eye = if perspective {
            row(eye, places, 1)
        } else {
            row(eye, self::places(eye.to_array()), 0)
        };
        Reference {
            vertices: scene.vertices.iter().map(|vertex| row(*vertex, places, 1)).collect(),
            eye,
            near: scene.near.map(|near| near_plane(near.forward, near.distance, places)),
        }
    }

    fn vertex(&self, index: u32) -> Row {
        self.vertices[index as usize].clone()
    }

    /// `[E, p, q, r]`.
    pub(crate) fn side(&self, p: u32, q: u32, r: u32) -> Sign {
        sign(&bracket([&self.eye, &self.vertex(p), &self.vertex(q), &self.vertex(r)]))
    }

    /// `[t0, t1, t2, x]`.
    pub(crate) fn plane(&self, [a, b, c]: [u32; 3], x: u32) -> Sign {
        sign(&bracket([&self.vertex(a), &self.vertex(b), &self.vertex(c), &self.vertex(x)]))
    }

    /// The point, constructed.
    pub(crate) fn point(&self, point: Point) -> Row {
        match point {
            Point::Vertex(vertex) => self.vertex(vertex),
            Point::Piercing(Piercing { edge: [a, b], face }) => {
                let [a, b] = [a, b].map(|i| self.vertex(i));
                let [heights_a, heights_b] =
                    [&a, &b].map(|end| self.functional(Cut::Face(face), end));
                between(&a, &b, &heights_a, &heights_b)
            }
        }
    }

    /// The functional of a cut at a constructed point, times its `w`.
    pub(crate) fn functional(&self, cut: Cut, x: &Row) -> IBig {
        match cut {
            Cut::Face(face) => {
                let [a, b, c] = face.map(|i| self.vertex(i));
                bracket([&a, &b, &c, x])
            }
            Cut::Silhouette([a, b]) => bracket([&self.eye, &self.vertex(a), &self.vertex(b), x]),
            Cut::Vertex(vertex, axis) => {
                bracket([&self.eye, &self.vertex(vertex), &direction(axis), x])
            }
            Cut::NearLine([a, b, c]) => {
                let [a, b, c] = [a, b, c].map(|i| self.vertex(i));
                let face = |x: &Row| bracket([&a, &b, &c, x]);
                self.functional(Cut::Near, x) * face(&self.eye)
                    - face(x) * self.functional(Cut::Near, &self.eye)
            }
            Cut::Near => match &self.near {
                None => IBig::from(1),
                Some((forward, offset)) => {
                    let along: IBig = (0..3)
                        .map(|i| &forward[i] * (&x[i] - &self.eye[i] * &x[3]))
                        .fold(IBig::ZERO, |sum, term| sum + term);
                    along - offset * &x[3]
                }
            },
        }
    }

    /// The ends of a carrier.
    pub(crate) fn ends(&self, carrier: Carrier) -> [Row; 2] {
        carrier.ends.map(|end| self.point(end))
    }

    /// The parameter of a cut as a quotient with a positive denominator.
    pub(crate) fn parameter(&self, carrier: Carrier, cut: Cut) -> [IBig; 2] {
        let [start, end] = self.ends(carrier);
        // Values of affine points, over the common denominator.
        let first = self.functional(cut, &start) * &end[3];
        let last = self.functional(cut, &end) * &start[3];
        let span = &first - last;
        if span.sign() == IntegerSign::Negative { [-first, -span] } else { [first, span] }
    }

    /// The order of two cuts along a carrier.
    pub(crate) fn order(&self, carrier: Carrier, first: Cut, second: Cut) -> Ordering {
        let [[a, b], [c, d]] = [first, second].map(|cut| self.parameter(carrier, cut));
        (a * d).cmp(&(c * b))
    }

    /// A place on a carrier, constructed.
    pub(crate) fn place(&self, carrier: Carrier, place: Place) -> Row {
        let [start, end] = self.ends(carrier);
        match place {
            Place::Start => start,
            Place::End => end,
            Place::Cut(cut) => {
                let first = self.functional(cut, &start) * &end[3];
                let last = self.functional(cut, &end) * &start[3];
                between(&affine(&start, &end[3]), &affine(&end, &start[3]), &first, &last)
            }
        }
    }

    /// The direction in which `x` lies, seen from the eye, or its place on
    /// a plane across the view.
    fn ray(&self, x: &Row) -> [IBig; 3] {
        let [ex, ey, ez, ew] = &self.eye;
        [(0, ex), (1, ey), (2, ez)]
            .map(|(i, e)| if ew == &IBig::ZERO { x[i].clone() } else { &x[i] - e * &x[3] })
    }

    /// Whether two points lie on one line with the eye.
    pub(crate) fn images_coincide(&self, x: &Row, y: &Row) -> bool {
        (0..3).all(|axis| bracket([&self.eye, x, y, &direction(axis)]) == IBig::ZERO)
    }

    /// [`Self::image_order`] of vertices.
    pub(crate) fn image_order_of(&self, x: u32, y: u32, reference: [u32; 2]) -> Ordering {
        let [start, end] = reference.map(|i| self.vertex(i));
        self.image_order([&start, &end], &self.vertex(x), &self.vertex(y))
    }

    /// The order of the images of two points along the image of start to
    /// end, all on one image line and in front of the eye.
    pub(crate) fn image_order(&self, reference: [&Row; 2], x: &Row, y: &Row) -> Ordering {
        if self.eye[3] != IBig::ZERO {
            // The turn from one ray to the other, in the plane of them all.
            let [start, end, x, y] = [reference[0], reference[1], x, y].map(|p| self.ray(p));
            let normal = cross(&start, &end);
            return dot(&normal, &cross(&y, &x)).cmp(&IBig::ZERO);
        }
        // The way of the image: what is across the direction of view.
        let view = [0, 1, 2].map(|i| self.eye[i].clone());
        let across = |from: &Row, to: &Row| {
            let way = [0, 1, 2].map(|i| &to[i] * &from[3] - &from[i] * &to[3]);
            cross(&view, &way)
        };
        dot(&across(reference[0], reference[1]), &across(y, x)).cmp(&IBig::ZERO)
    }

    /// Whether `y` is nearer to the eye than the point of the line pq that it
    /// covers: nothing if it covers none in front of the eye.
    pub(crate) fn nearer(&self, [p, q]: [&Row; 2], y: &Row) -> Option<Sign> {
        let across = (0..3).map(direction).find(|k| bracket([&self.eye, p, q, k]) != IBig::ZERO)?;
        // The line's point in the plane of the eye, y and the way across.
        let [at_p, at_q] = [p, q].map(|end| bracket([&self.eye, y, &across, end]));
        let mut x = [0, 1, 2, 3].map(|i| &p[i] * &at_q - &q[i] * &at_p);
        if x[3] < IBig::ZERO {
            x = x.map(|value| -value);
        }
        if x[3] == IBig::ZERO {
            return None;
        }
        if self.eye[3] == IBig::ZERO {
            let way = [0, 1, 2].map(|i| &y[i] * &x[3] - &x[i] * &y[3]);
            let eye = [0, 1, 2].map(|i| self.eye[i].clone());
            return Some(sign(&dot(&way, &eye)));
        }
        let (to_x, to_y) = (self.ray(&x), self.ray(y));
        let product = dot(&to_x, &to_y);
        let longer = &product * &y[3] - dot(&to_y, &to_y) * &x[3];
        (IBig::ZERO < product).then(|| sign(&longer))
    }
}

/// Forward direction and offset. The distance is zero or the direction an
/// axis times a power of two: then nothing is rounded.
fn near_plane(forward: DVec3, distance: f64, scene_places: i32) -> ([IBig; 3], IBig) {
    let forward_places = places(forward.to_array());
    let whole = forward.to_array().map(|x| integer(x, forward_places));
    let length = if whole[0] == IBig::ZERO && whole[1] == IBig::ZERO {
        &whole[2] * whole[2].signum()
    } else {
        &whole[0] * whole[0].signum() + &whole[1] * whole[1].signum()
    };
    (whole, length * integer(distance, scene_places))
}

/// The integer root.
pub(crate) fn isqrt(value: &IBig) -> IBig {
    use dashu_int::ops::{SquareRoot, UnsignedAbs};
    IBig::from(value.clone().unsigned_abs().sqrt())
}

/// The point of the line through `a` and `b` at which a functional with
/// these values is zero.
fn between(a: &Row, b: &Row, at_a: &IBig, at_b: &IBig) -> Row {
    let flip = if at_a < at_b { IBig::from(-1) } else { IBig::from(1) };
    [0, 1, 2, 3].map(|i| &flip * (at_a * &b[i] - at_b * &a[i]))
}

fn affine(row: &Row, factor: &IBig) -> Row {
    [0, 1, 2, 3].map(|i| &row[i] * factor)
}

pub(crate) fn direction(axis: u8) -> Row {
    [0, 1, 2, 3].map(|i| IBig::from(u8::from(i == axis)))
}

pub(crate) fn cross(a: &[IBig; 3], b: &[IBig; 3]) -> [IBig; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &a[i] * &b[j] - &a[j] * &b[i])
}

pub(crate) fn dot(a: &[IBig; 3], b: &[IBig; 3]) -> IBig {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

/// The determinant of four rows as the sum over all permutations.
pub(crate) fn bracket(rows: [&Row; 4]) -> IBig {
    let mut sum = IBig::ZERO;
    for code in 0..256_usize {
        let columns = [0, 2, 4, 6].map(|shift| code >> shift & 3);
        let mut inversions = 0;
        let mut repeated = false;
        for i in 0..4 {
            for j in i + 1..4 {
                repeated |= columns[i] == columns[j];
                inversions += u32::from(columns[i] > columns[j]);
            }
        }
        if repeated {
            continue;
        }
        let term = (0..4).fold(IBig::from(1), |product, i| product * &rows[i][columns[i]]);
        sum += if inversions % 2 == 0 { term } else { -term };
    }
    sum
}
