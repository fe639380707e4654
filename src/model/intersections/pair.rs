//! What two triangles have in common: the ends of a segment, edges that
//! pierce, and vertices that touch.

use super::{IntersectionLine, Known, sorted_corners};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Carrier, Piercing, Point, Points, Policy, Predicates};
use crate::model::{Hinge, Mesh};
use crate::run::{Cancelled, Growing, Run};

/// One worker's share of the search.
pub(super) struct Search<'p, P: Policy> {
    pub(super) mesh: &'p Mesh,
    pub(super) predicates: Predicates<'p, P>,
    pub(super) known: Known<'p>,
    pub(super) lines: Vec<IntersectionLine>,
    pub(super) piercings: Vec<[u32; 2]>,
    pub(super) touching: Vec<u32>,
    pub(super) tested: u64,
    growing: Growing<'p>,
}

/// What one crossing takes: a segment and its two piercings, in lists that may
/// have room for twice as many.
pub(super) const LINE_BYTES: usize = size_of::<IntersectionLine>() + 2 * size_of::<[u32; 2]>();

/// The signs of the corners of `triangle` against the plane of `against`:
/// zero by identity for common corners.
fn corner_signs<P: Policy>(
    predicates: &Predicates<'_, P>,
    triangle: [u32; 3],
    against: [u32; 3],
) -> [Sign; 3] {
    let sign = |corner| {
        if against.contains(&corner) { Sign::Zero } else { predicates.plane(against, corner) }
    };
    [sign(triangle[0]), sign(triangle[1]), sign(triangle[2])]
}

/// Whether there are corners strictly on both sides.
#[inline]
pub(super) fn straddles(signs: [Sign; 3]) -> bool {
    signs.contains(&Sign::Positive) && signs.contains(&Sign::Negative)
}

/// Whether the corners lie strictly on one side, but for `shared` common
/// ones: then the triangles have nothing in common but those.
fn is_aside(signs: [Sign; 3], shared: usize) -> bool {
    !straddles(signs) && signs.iter().filter(|sign| sign.is_zero()).count() == shared
}

/// An end of the segment that a triangle shares with the plane of another.
#[derive(Debug, Clone, Copy)]
struct End {
    /// The edge that meets the plane, from its non-positive corner to its
    /// non-negative one; where the end is a corner, an edge that leaves the
    /// plane there.
    edge: [u32; 2],
    point: Point,
}

/// The two ends of a triangle that straddles a plane.
fn ends(triangle: [u32; 3], signs: [Sign; 3], plane: [u32; 3]) -> [End; 2] {
    let mut found = Vec::with_capacity(2);
    for i in 0..3 {
        let j = (i + 1) % 3;
        let (a, b) = (triangle[i], triangle[j]);
        if signs[i].is_zero() {
            // A straddling triangle has at most one corner on the plane.
            found.push(End { edge: [a, b], point: Point::Vertex(a) });
        } else if signs[i].is_opposite(signs[j]) {
            let edge = if signs[i] == Sign::Negative { [a, b] } else { [b, a] };
            let piercing = Piercing { edge, face: plane }.canonical();
            found.push(End { edge, point: Point::Piercing(piercing) });
        }
    }
    [found[0], found[1]]
}

/// Whether the line of `edge` passes through the closed `triangle`, whose
/// plane it crosses. Common vertices give zeros by identity.
fn passes_through<P: Policy>(
    predicates: &Predicates<'_, P>,
    edge: [u32; 2],
    [a, b, c]: [u32; 3],
) -> bool {
    let signs = [[a, b], [b, c], [c, a]].map(|side| skew(predicates, edge, side));
    !(signs.contains(&Sign::Positive) && signs.contains(&Sign::Negative))
}

fn skew<P: Policy>(predicates: &Predicates<'_, P>, [p, q]: [u32; 2], side: [u32; 2]) -> Sign {
    if side.contains(&p) || side.contains(&q) {
        Sign::Zero
    } else {
        predicates.skew(Carrier::edge(p, q), side)
    }
}

/// One of two triangles, against the plane of the other.
struct Side {
    signs: [Sign; 3],
    /// The ends of its common segment with the other's plane that lie in
    /// the other triangle; none unless it straddles that plane.
    inside: Vec<End>,
}

impl Side {
    pub(super) fn straddles(&self) -> bool {
        straddles(self.signs)
    }
}

impl<'p, P: Policy> Search<'p, P> {
    pub(super) fn new(
        mesh: &'p Mesh,
        points: &'p Points,
        known: Known<'p>,
        run: &'p Run<'p>,
    ) -> Self {
        Search {
            mesh,
            predicates: Predicates::new(points),
            known,
            lines: Vec::new(),
            piercings: Vec::new(),
            touching: Vec::new(),
            tested: 0,
            growing: Growing::new(run, LINE_BYTES).of_crossings(),
        }
    }

    /// Crossings and piercings so far.
    fn held(&self) -> usize {
        self.lines.len() + self.piercings.len()
    }

    pub(super) fn account_for_all(&mut self) -> Result<(), Cancelled> {
        self.growing.finish(self.held())
    }

    /// Adds what two triangles with overlapping boxes make.
    pub(super) fn add_pair(&mut self, pair: [u32; 2]) {
        if !self.growing.goes_on(self.held()) {
            return;
        }
        if self.known.convex.is_some_and(|parts| parts.are_together(pair)) {
            return;
        }
        let triangles = self.mesh.triangles();
        let (s, t) = (triangles[pair[0] as usize], triangles[pair[1] as usize]);
        let shared = s.iter().filter(|corner| t.contains(corner)).count();
        if shared >= 2 {
            return self.add_fold(s, t);
        }
        self.tested += 1;
        let signs_s = corner_signs(&self.predicates, s, t);
        if is_aside(signs_s, shared) {
            return;
        }
        let signs_t = corner_signs(&self.predicates, t, s);
        if is_aside(signs_t, shared) {
            return;
        }
        self.add_touching(s, signs_s, t);
        self.add_touching(t, signs_t, s);
        let first = self.side(pair[0], pair[1], signs_s);
        let second = self.side(pair[1], pair[0], signs_t);
        match (first.straddles(), second.straddles()) {
            (true, true) => self.lines.extend(self.crossing(pair, &first, &second)),
            // An edge inside the other triangle makes that straddle the
            // plane of its own.
            (true, false) => self.add_hinges_within([pair[1], pair[0]], signs_t),
            (false, true) => self.add_hinges_within(pair, signs_s),
            (false, false) => self.add_common_hinges(pair, [signs_s, signs_t]),
        }
    }

    /// Notes touching corners of two triangles with a common edge: there are
    /// some only where one lies folded onto the other.
    fn add_fold(&mut self, s: [u32; 3], t: [u32; 3]) {
        if self.known.fans.is_some() {
            let signs = corner_signs(&self.predicates, s, t);
            if signs == [Sign::Zero; 3] {
                self.add_touching(s, signs, t);
                self.add_touching(t, signs, s);
            }
        }
    }

    /// Notes the corners of a triangle that lie on another one, of which
    /// they are no corners, and which is not edge-on. `signs` are those of
    /// the corners against the other's plane.
    fn add_touching(&mut self, triangle: [u32; 3], signs: [Sign; 3], other: [u32; 3]) {
        if self.known.fans.is_none() {
            return;
        }
        let [a, b, c] = other;
        for (corner, sign) in triangle.into_iter().zip(signs) {
            if !sign.is_zero() || other.contains(&corner) {
                continue;
            }
            let facing = self.predicates.side(a, b, c);
            let outside = |[x, y]: [u32; 2]| {
                facing.is_zero() || self.predicates.side(x, y, corner).is_opposite(facing)
            };
            if ![[a, b], [b, c], [c, a]].into_iter().any(outside) {
                self.touching.push(corner);
            }
        }
    }

    /// One triangle of a pair; notes the edges with which it pierces the
    /// other.
    fn side(&mut self, own: u32, other: u32, signs: [Sign; 3]) -> Side {
        let [corners, plane] = [own, other].map(|i| self.mesh.triangles()[i as usize]);
        let mut inside = Vec::new();
        if straddles(signs) {
            for end in ends(corners, signs, plane) {
                if passes_through(&self.predicates, end.edge, plane) {
                    inside.push(end);
                    if let Point::Piercing(Piercing { edge: [a, b], .. }) = end.point {
                        let edge = self.mesh.edges().find(a, b);
                        self.piercings.extend(edge.map(|edge| [edge, other]));
                    }
                }
            }
        }
        Side { signs, inside }
    }

    /// The segment in which two triangles cross that straddle one another's
    /// planes, if they meet at all.
    fn crossing(&self, pair: [u32; 2], first: &Side, second: &Side) -> Option<IntersectionLine> {
        let mut found = first.inside.clone();
        for &end in &second.inside {
            // Ends of the two triangles coincide exactly if their edges meet.
            let is_same = |other: &&mut End| {
                other.point == end.point || skew(&self.predicates, end.edge, other.edge).is_zero()
            };
            let own = found.len().min(first.inside.len());
            match found[..own].iter_mut().find(is_same) {
                Some(same) => same.point = same.point.min(end.point),
                None => found.push(end),
            }
        }
        let [first, second] = found[..] else { return None };
        let ends = [first.point.min(second.point), first.point.max(second.point)];
        Some(self.line(Carrier { ends }, pair, [None; 2]))
    }

    /// A line of two triangles, that with the lesser vertices first.
    pub(super) fn line(
        &self,
        carrier: Carrier,
        pair @ [s, t]: [u32; 2],
        along @ [first, second]: [Option<Hinge>; 2],
    ) -> IntersectionLine {
        let key = |triangle: u32| (sorted_corners(self.mesh, triangle), triangle);
        if key(s) < key(t) {
            IntersectionLine { carrier, triangles: pair, along }
        } else {
            IntersectionLine { carrier, triangles: [t, s], along: [second, first] }
        }
    }
}
