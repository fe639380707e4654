//! The definition of hidden, written out in homogeneous integers for small
//! integer scenes: a second opinion that shares nothing with the kernel.
//!
//! A point in the middle of a piece is moved first by an infinitesimal step
//! along the line and then by one of higher order to the side, away from
//! the plane of the line and the eye. Depth does not take part in the
//! second step.

use crate::kernel::predicates::{Carrier, Cut, Eye, Piercing, Place, Point};
use crate::model::View;
use crate::view::LineQuestion;
use glam::DVec3;
use std::cmp::Ordering;

/// Homogeneous coordinates; the weight is not negative.
pub(super) type Row = [i128; 4];

/// The scene in integers.
pub(super) struct BruteForce<'a> {
    question: &'a LineQuestion<'a>,
    eye: Row,
    /// The functional that is positive in front of the near plane.
    near: Option<Row>,
}

fn integers(v: DVec3) -> [i128; 3] {
    v.to_array().map(|x| {
        assert_eq!(x, x.round(), "brute force works on integers");
        x as i128
    })
}

fn det3(m: [[i128; 3]; 3]) -> i128 {
    let [a, b, c] = m;
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// The 4 x 4 determinant, expanded along the last row.
fn det4(p: Row, q: Row, r: Row, s: Row) -> i128 {
    (0..4)
        .map(|column| {
            let others: Vec<usize> = (0..4).filter(|&k| k != column).collect();
            let minor = det3([p, q, r].map(|row| [0, 1, 2].map(|k| row[others[k]])));
            let sign = if column % 2 == 1 { 1 } else { -1 };
            sign * s[column] * minor
        })
        .sum()
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

/// `x a + y b`, shortened.
fn mix(x: i128, a: Row, y: i128, b: Row) -> Row {
    let sum = [0, 1, 2, 3].map(|k| x * a[k] + y * b[k]);
    let common = sum.iter().fold(0, |g, &value| gcd(g, value)).max(1);
    sum.map(|value| value / common)
}

impl<'a> BruteForce<'a> {
    pub(super) fn new(question: &'a LineQuestion<'a>, view: &View) -> Self {
        let [x, y, z] = integers(view.eye.coordinates());
        let weight = i128::from(view.eye.is_perspective());
        let near = view.near.map(|plane| {
            let [a, b, c] = integers(plane.forward);
            let offset = plane.distance * plane.forward.length();
            assert_eq!(offset, offset.round(), "choose a near plane in integers");
            [a, b, c, -(a * x + b * y + c * z) - offset as i128]
        });
        assert!(near.is_none() || matches!(view.eye, Eye::At(_)));
        BruteForce { question, eye: [x, y, z, weight], near }
    }

    fn vertex(&self, vertex: u32) -> Row {
        let [x, y, z] = integers(self.question.mesh.vertices()[vertex as usize]);
        [x, y, z, 1]
    }

    fn plane(&self, face: [u32; 3], x: Row) -> i128 {
        let [a, b, c] = face.map(|v| self.vertex(v));
        det4(a, b, c, x)
    }

    fn point(&self, point: Point) -> Row {
        match point {
            Point::Vertex(vertex) => self.vertex(vertex),
            Point::Piercing(Piercing { edge: [a, b], face }) => {
                let [a, b] = [self.vertex(a), self.vertex(b)];
                let (below, above) = (self.plane(face, a), self.plane(face, b));
                assert!(below <= 0 && above >= 0 && below < above);
                mix(above, a, -below, b)
            }
        }
    }

    pub(super) fn ends(&self, carrier: Carrier) -> [Row; 2] {
        carrier.ends.map(|end| self.point(end))
    }

    fn cut(&self, cut: Cut, x: Row) -> i128 {
        match cut {
            Cut::Face(face) => self.plane(face, x),
            Cut::Silhouette([a, b]) => det4(self.eye, self.vertex(a), self.vertex(b), x),
            Cut::Near => self.in_front(x),
            Cut::Vertex(..) | Cut::NearLine(_) => unreachable!("borders of regions only"),
        }
    }

    /// Positive in front of the near plane.
    pub(super) fn in_front(&self, x: Row) -> i128 {
        self.near.map_or(1, |plane| (0..4).map(|k| plane[k] * x[k]).sum())
    }

    /// Whether the eye sees the carrier end on.
    pub(super) fn is_end_on(&self, carrier: Carrier) -> bool {
        let [p, q] = self.ends(carrier);
        // Rank below three: all 3 x 3 minors of the rows vanish.
        (0..4).all(|left_out| {
            let kept: Vec<usize> = (0..4).filter(|&k| k != left_out).collect();
            det3([self.eye, p, q].map(|row| [0, 1, 2].map(|k| row[kept[k]]))) == 0
        })
    }

    /// The point of a place on a carrier.
    pub(super) fn place(&self, carrier: Carrier, place: Place) -> Row {
        let [p, q] = self.ends(carrier);
        match place {
            Place::Start => p,
            Place::End => q,
            Place::Cut(cut) => {
                let (a, b) = (self.cut(cut, p), self.cut(cut, q));
                assert!(a.signum() * b.signum() < 0, "a cut lies between the ends");
                if a > 0 { mix(a, q, -b, p) } else { mix(-a, q, b, p) }
            }
        }
    }

    /// Compares two points of a carrier along it.
    pub(super) fn compare(&self, carrier: Carrier, x: Row, y: Row) -> Ordering {
        let [p, q] = self.ends(carrier);
        let along = mix(p[3], q, -q[3], p);
        assert_eq!(along[3], 0);
        let project = |row: Row| (0..3).map(|k| along[k] * row[k]).sum::<i128>();
        (project(x) * y[3]).cmp(&(project(y) * x[3]))
    }

    pub(super) fn middle(&self, x: Row, y: Row) -> Row {
        mix(y[3], x, x[3], y)
    }

    /// Sheets in front of the middle of a piece: on its left, on its right.
    pub(super) fn sheets(&self, carrier: Carrier, middle: Row) -> [u32; 2] {
        let [p, q] = self.ends(carrier);
        let along = mix(p[3], q, -q[3], p);
        // The functional [E, p, q, .] grows along its own coefficients.
        let unit = |k: usize| [0, 1, 2, 3].map(|i| i128::from(i == k));
        let across = [0, 1, 2].map(|k| det4(self.eye, p, q, unit(k)));
        [1, -1].map(|side| {
            let aside = [across[0] * side, across[1] * side, across[2] * side, 0];
            let first_of = |signs: [i128; 3]| signs.into_iter().find(|&s| s != 0).unwrap_or(0);
            let covers = |corners: &[u32; 3]| {
                let [a, b, c] = corners.map(|v| self.vertex(v));
                let facing = det4(self.eye, a, b, c).signum();
                let behind = first_of([det4(a, b, c, middle), det4(a, b, c, along), 0]);
                facing != 0
                    && behind.signum() == facing
                    && [(a, b), (b, c), (c, a)].into_iter().all(|(a, b)| {
                        let inside =
                            first_of([middle, along, aside].map(|x| det4(self.eye, a, b, x)));
                        inside.signum() == facing
                    })
            };
            let triangles = self.question.mesh.triangles();
            triangles.iter().filter(|corners| covers(corners)).count() as u32
        })
    }
}
