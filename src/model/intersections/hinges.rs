//! Where a surface passes through another exactly along edges of its own.
//!
//! A *hinge* is an edge, or a stretch of borders that lie on one another, with
//! all triangles that end there. Its line is a crossing of surfaces where
//! these lie strictly on both sides of what it runs through: of a triangle, in
//! whose plane and inside it lies; or of the triangles at a hinge of the
//! other surface, if both lie on one line. Around a common line surfaces
//! cross if their triangles take turns; those that lie on one another are
//! none of the other's sides.
//!
//! Many triangles meet there, and each hinge is to be a line once, so the pair
//! of triangles with the least third corners of those that can tell reports it.

use super::pair::Search;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Carrier, Cut, Piercing, Point, Policy, Predicates};
use crate::model::Hinge;
use std::cmp::Ordering;

impl<P: Policy> Search<'_, P> {
    /// Adds the hinges at the first triangle that lie in the plane of the
    /// second, reach into its inside, and have triangles strictly on both sides
    /// of it. `signs` are those of the first's corners.
    pub(super) fn add_hinges_within(&mut self, [s, t]: [u32; 2], signs: [Sign; 3]) {
        let Some(side) = side_within(signs) else { return };
        let plane = self.mesh.triangles()[t as usize];
        for hinge in self.hinges_at(s, side) {
            let ends = self.mesh.hinge_ends(hinge);
            let mut sides = [false; 2];
            let mut least: Option<(u32, u32)> = None;
            for (triangle, third) in self.mesh.hinge_sides(hinge) {
                match self.predicates.plane(plane, third) {
                    Sign::Negative => sides[0] = true,
                    Sign::Positive => sides[1] = true,
                    Sign::Zero => continue,
                }
                let entry = (third, triangle);
                least = Some(least.map_or(entry, |least| least.min(entry)));
            }
            if let (true, Some((third, first))) = (sides == [true; 2], least)
                && first == s
                && let Some(carrier) = self.clipped(ends, (s, third), plane)
            {
                let line = self.line(carrier, [s, t], [Some(hinge), None]);
                self.lines.push(line);
            }
        }
    }

    /// The part of an edge at one triangle, whose corner off the edge is given
    /// too, that lies inside another triangle, in whose plane the edge is.
    fn clipped(&self, edge: [u32; 2], (own, apex): (u32, u32), other: [u32; 3]) -> Option<Carrier> {
        let sides = clip_to_triangle(&self.predicates, edge, apex, other)?;
        let face = self.mesh.triangles()[own as usize];
        let point = |end: usize| {
            // The edge ends inside, or where a side pierces its own triangle.
            let Some([x, y]) = sides[end] else { return Point::Vertex(edge[end]) };
            match [x, y].map(|vertex| self.side_of(face, vertex)) {
                [Sign::Zero, _] => Point::Vertex(x),
                [_, Sign::Zero] => Point::Vertex(y),
                [Sign::Negative, _] => piercing([x, y], face),
                [Sign::Positive, _] => piercing([y, x], face),
            }
        };
        Some(Carrier { ends: [point(0), point(1)] })
    }

    /// On which side of a triangle's plane a vertex lies; its corners by name.
    fn side_of(&self, face: [u32; 3], vertex: u32) -> Sign {
        if face.contains(&vertex) { Sign::Zero } else { self.predicates.plane(face, vertex) }
    }

    /// Adds what hinges at one triangle and hinges at another have in common
    /// where the surfaces cross there; neither triangle straddles the plane of
    /// the other. `signs` are those of their corners against it.
    pub(super) fn add_common_hinges(&mut self, [s, t]: [u32; 2], signs: [[Sign; 3]; 2]) {
        let [Some(of_s), Some(of_t)] = signs.map(side_within) else { return };
        let [of_s, of_t] = [self.hinges_at(s, of_s), self.hinges_at(t, of_t)];
        for &first in &of_s {
            for &second in &of_t {
                if let Some(carrier) = self.common_part([first, second])
                    && self.reports([first, second], [s, t], carrier)
                    && self.take_turns([first, second], carrier)
                {
                    let line = self.line(carrier, [s, t], [Some(first), Some(second)]);
                    self.lines.push(line);
                }
            }
        }
    }

    /// The hinges along a side of a triangle, which begins at its corner of this
    /// number. Those of many borders are lines already, whatever crosses there.
    fn hinges_at(&self, triangle: u32, side: usize) -> Vec<Hinge> {
        let mesh = self.mesh;
        let corners = mesh.triangles()[triangle as usize];
        let Some(edge) = mesh.edges().find(corners[side], corners[(side + 1) % 3]) else {
            return Vec::new();
        };
        if 1 < mesh.edges().triangles(edge).len() {
            return vec![Hinge::Edge(edge)];
        }
        let is_hinge = |&stretch: &u32| mesh.borders().sides(stretch, true).len() == 2;
        mesh.borders().of_edge(edge).filter(is_hinge).map(Hinge::Stretch).collect()
    }

    /// What two hinges on one line have in common, between vertices.
    fn common_part(&self, hinges: [Hinge; 2]) -> Option<Carrier> {
        let points = self.predicates.points();
        // Along a line vertices are in the order of their coordinates.
        let ends = hinges.map(|hinge| {
            let [a, b] = self.mesh.hinge_ends(hinge);
            if points.compare(a, b).is_lt() { [a, b] } else { [b, a] }
        });
        // Of two vertices at one place, which are of two objects, the first.
        let chosen = |a: u32, b: u32, order: Ordering| match points.compare(a, b) {
            Ordering::Equal => a.min(b),
            found if found == order => a,
            _ => b,
        };
        let [[a, b], [c, d]] = ends;
        let from = chosen(a, c, Ordering::Greater);
        let to = chosen(b, d, Ordering::Less);
        points.compare(from, to).is_lt().then(|| Carrier::edge(from.min(to), from.max(to)))
    }

    /// Whether a pair of triangles at two hinges with a common part is the one
    /// that reports them: of those in different planes the first.
    fn reports(&self, hinges: [Hinge; 2], [s, t]: [u32; 2], common: Carrier) -> bool {
        let sides = hinges.map(|hinge| {
            let mut sides: Vec<_> = self.mesh.hinge_sides(hinge).map(|(t, x)| (x, t)).collect();
            sides.sort_unstable();
            sides
        });
        let mut pairs = sides[0].iter().flat_map(|&a| sides[1].iter().map(move |&b| (a, b)));
        let first = pairs.find(|&((x, _), (y, _))| !self.turn(common, x, y).is_zero());
        first.is_some_and(|((_, a), (_, b))| [a, b] == [s, t])
    }

    /// Which way the half-plane through a vertex turns from that through
    /// another one, around a common line: zero if they are one plane.
    fn turn(&self, line: Carrier, from: u32, to: u32) -> Sign {
        let Some([a, b]) = line.as_edge() else { return Sign::Zero };
        if from == to { Sign::Zero } else { self.predicates.plane([a, b, from], to) }
    }

    /// Whether, going around the common line of two hinges, one meets
    /// triangles of the one, of the other, of the one and of the other again.
    fn take_turns(&self, hinges: [Hinge; 2], common: Carrier) -> bool {
        let [first, second] = hinges
            .map(|hinge| self.mesh.hinge_sides(hinge).map(|(_, third)| third).collect::<Vec<_>>());
        let pairs = (0..second.len()).flat_map(|i| (0..i).map(move |j| [i, j]));
        let mut pairs = pairs.map(|pair| pair.map(|i| second[i]));
        pairs.any(|[a, b]| {
            let within =
                |[a, b]: [u32; 2]| first.iter().any(|&x| self.is_between(common, [a, b], x));
            within([a, b]) && within([b, a])
        })
    }

    /// Whether one comes strictly past the half-plane through `x` on the way
    /// around a line from that through `a` to that through `b`.
    fn is_between(&self, line: Carrier, [a, b]: [u32; 2], x: u32) -> bool {
        let [to_x, onward] = [self.turn(line, a, x), self.turn(line, x, b)];
        match self.turn(line, a, b) {
            Sign::Positive => [to_x, onward] == [Sign::Positive; 2],
            // More than half way around: all but what lies on the way back.
            Sign::Negative => to_x == Sign::Positive || onward == Sign::Positive,
            // Half way around, or one on the other.
            Sign::Zero => [to_x, onward] == [Sign::Positive; 2],
        }
    }
}

/// Where an edge pierces a face.
fn piercing(edge: [u32; 2], face: [u32; 3]) -> Point {
    Point::Piercing(Piercing { edge, face }.canonical())
}

/// The side of a triangle that lies in a plane, by the number of the corner
/// where it begins, if just one does.
fn side_within(signs: [Sign; 3]) -> Option<usize> {
    let within = |i: usize| signs[i].is_zero() && signs[(i + 1) % 3].is_zero();
    let is_one = signs.iter().filter(|sign| sign.is_zero()).count() == 2;
    (0..3).find(|&i| is_one && within(i))
}

/// The part of an edge in a triangle's plane that lies inside the triangle, as
/// the sides of the triangle where it begins and ends, if it does so there;
/// `apex` is any vertex off the plane. Nothing if the edge only touches the
/// triangle or runs along its border.
fn clip_to_triangle<P: Policy>(
    predicates: &Predicates<'_, P>,
    edge: [u32; 2],
    apex: u32,
    plane: [u32; 3],
) -> Option<[Option<[u32; 2]>; 2]> {
    let carrier = Carrier::edge(edge[0], edge[1]);
    let mut start: Option<Cut> = None;
    let mut end: Option<Cut> = None;
    let measure = |cut| carrier.ends.map(|point| predicates.value(cut, point));
    for i in 0..3 {
        let (x, y, z) = (plane[i], plane[(i + 1) % 3], plane[(i + 2) % 3]);
        let wall = [x, y, apex];
        let inner = predicates.plane(wall, z);
        let sides = edge.map(|v| {
            if wall.contains(&v) { Sign::Zero } else { predicates.plane(wall, v) * inner }
        });
        let cut = Cut::Face(wall);
        match sides {
            [Sign::Positive, Sign::Positive | Sign::Zero] | [Sign::Zero, Sign::Positive] => {}
            [Sign::Negative, Sign::Positive] => {
                let later = |old| {
                    predicates.order(carrier, (old, &measure(old)), (cut, &measure(cut)))
                        == Ordering::Less
                };
                if start.is_none_or(later) {
                    start = Some(cut);
                }
            }
            [Sign::Positive, Sign::Negative] => {
                let earlier = |old| {
                    predicates.order(carrier, (cut, &measure(cut)), (old, &measure(old)))
                        == Ordering::Less
                };
                if end.is_none_or(earlier) {
                    end = Some(cut);
                }
            }
            _ => return None,
        }
    }
    if let (Some(first), Some(last)) = (start, end)
        && predicates.order(carrier, (first, &measure(first)), (last, &measure(last)))
            != Ordering::Less
    {
        return None;
    }
    let side = |cut| match cut {
        Some(Cut::Face([x, y, _])) => Some([x, y]),
        _ => None,
    };
    Some([side(start), side(end)])
}
