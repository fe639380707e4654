//! Interpenetration: where triangles pass through one another, across all
//! objects of a scene.
//!
//! Two triangles that are not coplanar meet in a segment of the common line
//! of their planes. Its ends are piercings, each the point where an edge of
//! one triangle meets the plane of the other *inside* that other. So all
//! there is to find is which edges pierce which triangles: signs of 4 x 4
//! determinants, no construction (Guigue and Devillers 2003 give a shorter
//! test for whether there is such a segment, but not for its ends). Ends
//! stay symbolic.
//!
//! Touching is no crossing: both triangles must have corners strictly on
//! both sides of the other's plane. One case of crossing is not seen pair
//! by pair: a surface that passes through a triangle exactly along one of
//! its own edges. Then the edge itself is the line, clipped to the triangle.
//! Coplanar triangles make no line.

use super::{ConvexParts, Fans, Mesh, ViewCoordinates};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Carrier, Cut, Piercing, Point, Points, Policy, Predicates};
use crate::run::{Cancelled, Growing, Run, sort_by};
use crate::spatial::{Hierarchy, Related};
use std::cmp::Ordering;

/// A segment in which two triangles cross.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IntersectionLine {
    /// The segment; its ends are piercings or vertices.
    pub carrier: Carrier,
    /// The triangles, the smaller number first. For an edge that lies in a
    /// triangle: that triangle, and one at the edge.
    pub triangles: [u32; 2],
}

/// All crossings of a scene's triangles.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Intersections {
    /// The segments, in the order of their triangles.
    pub lines: Vec<IntersectionLine>,
    /// Which edges pierce which triangles.
    pub piercings: EdgePiercings,
    /// Vertices that lie on triangles of which they are no corner, sorted:
    /// all of them where fans were known, not worked out where not.
    pub touching: Vec<u32>,
}

/// The triangles that each edge pierces: its ends lie strictly on both
/// sides of the triangle's plane, and it meets the closed triangle.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct EdgePiercings {
    /// Edge and triangle, sorted.
    pairs: Vec<[u32; 2]>,
}

impl EdgePiercings {
    /// The triangles that `edge` pierces. O(log n).
    pub fn of_edge(&self, edge: u32) -> impl Iterator<Item = u32> + '_ {
        let start = self.pairs.partition_point(|pair| pair[0] < edge);
        self.pairs[start..].iter().take_while(move |pair| pair[0] == edge).map(|pair| pair[1])
    }

    /// The number of piercings.
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Whether no edge pierces a triangle.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }
}

impl Intersections {
    /// Searches all pairs of triangles with overlapping boxes. `hierarchy`
    /// holds boxes of the mesh's triangles; pairs at one of the fans need no
    /// test, nor do those of one convex part. Expected O(n + pairs).
    ///
    /// # Errors
    ///
    /// If the run is cancelled or the crossings are more than it may hold.
    pub fn find<P: Policy>(
        mesh: &Mesh,
        points: &Points,
        hierarchy: &Hierarchy,
        known: Known<'_>,
        run: &Run,
    ) -> Result<Self, Cancelled> {
        let start = || Search::<P>::new(mesh, points, known, run);
        let found = |search: &mut Search<'_, P>, s: u32, t: u32| {
            search.add_pair([s.min(t), s.max(t)]);
        };
        let parts = match known.fans {
            None => hierarchy.overlapping_pairs(run, start, found),
            Some(fans) => {
                // The triangles of a fan meet in what they share.
                let hubs = |triangle: u32| {
                    mesh.triangles()[triangle as usize]
                        .map(|corner| fans.is_fan(corner).then_some(corner))
                };
                let bytes = Related::bytes(mesh.triangles().len()) as u64;
                run.take(bytes)?;
                let related = Related::new(hierarchy, hubs);
                let parts = hierarchy.unrelated_pairs(&related, run, start, found);
                run.give_back(bytes);
                parts
            }
        };
        let mut intersections = Intersections::default();
        let mut tested = 0;
        // Parts are copied into one list each, and only then freed.
        let lines: usize = parts.iter().map(|part| part.lines.len()).sum();
        let piercings: usize = parts.iter().map(|part| part.piercings.len()).sum();
        run.take((lines * LINE_BYTES) as u64)?;
        intersections.lines.reserve_exact(lines);
        intersections.piercings.pairs.reserve_exact(piercings);
        for mut part in parts {
            part.account_for_all()?;
            run.merge(&part.predicates.counters());
            intersections.lines.extend(part.lines);
            intersections.piercings.pairs.extend(part.piercings);
            intersections.touching.extend(part.touching);
            tested += part.tested;
        }
        // What is equal is the same.
        let key = |line: &IntersectionLine| (line.triangles, line.carrier.ends);
        sort_by(&mut intersections.lines, |a, b| key(a).cmp(&key(b)));
        intersections.lines.dedup();
        sort_by(&mut intersections.piercings.pairs, Ord::cmp);
        intersections.piercings.pairs.dedup();
        intersections.touching.sort_unstable();
        intersections.touching.dedup();
        run.count("triangle-pairs-tested", tested);
        run.count("intersection-segments", intersections.lines.len() as u64);
        run.count("edge-piercings", intersections.piercings.len() as u64);
        Ok(intersections)
    }
}

/// What is known of a mesh and spares tests.
#[derive(Debug, Clone, Copy, Default)]
pub struct Known<'a> {
    /// How triangles lie around their vertices in the image. With it,
    /// vertices that touch triangles are told too.
    pub fans: Option<&'a Fans>,
    /// Parts that do not pass through themselves.
    pub convex: Option<&'a ConvexParts>,
}

/// One worker's share of the search.
struct Search<'p, P: Policy> {
    mesh: &'p Mesh,
    predicates: Predicates<'p, P>,
    known: Known<'p>,
    lines: Vec<IntersectionLine>,
    piercings: Vec<[u32; 2]>,
    touching: Vec<u32>,
    tested: u64,
    growing: Growing<'p>,
}

/// What one crossing takes: a segment and its two piercings, in lists that may
/// have room for twice as many.
const LINE_BYTES: usize = size_of::<IntersectionLine>() + 2 * size_of::<[u32; 2]>();

/// View boxes of the triangles of a mesh, of all or of some, in a hierarchy.
pub fn triangle_hierarchy(
    mesh: &Mesh,
    coordinates: &ViewCoordinates,
    some: Option<Vec<u32>>,
) -> Hierarchy {
    let triangles = mesh.triangles();
    let boxes = coordinates.vertex_boxes();
    let place = |i: usize| boxes.place(triangles[i][0]);
    let around = |i: usize| boxes.around(triangles[i]);
    match some {
        Some(some) => Hierarchy::of_some(some, place, around),
        None => Hierarchy::of(triangles.len(), place, around),
    }
}

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
fn straddles(signs: [Sign; 3]) -> bool {
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
            found.push(End { edge, point: Point::Piercing(Piercing { edge, face: plane }) });
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
    fn straddles(&self) -> bool {
        straddles(self.signs)
    }
}

impl<'p, P: Policy> Search<'p, P> {
    fn new(mesh: &'p Mesh, points: &'p Points, known: Known<'p>, run: &'p Run<'p>) -> Self {
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

    fn account_for_all(&mut self) -> Result<(), Cancelled> {
        self.growing.finish(self.held())
    }

    /// Adds what two triangles with overlapping boxes make.
    fn add_pair(&mut self, pair: [u32; 2]) {
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
            (true, false) => self.add_edges_within([pair[1], pair[0]], signs_t),
            // An edge of t inside s would make s straddle the plane of t,
            // so only edges of s are left to look at.
            (false, _) => self.add_edges_within(pair, signs_s),
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
            let known = |other: &End| {
                other.point == end.point || skew(&self.predicates, end.edge, other.edge).is_zero()
            };
            if !first.inside.iter().any(known) {
                found.push(end);
            }
        }
        match found[..] {
            [first, second] => {
                let carrier = Carrier { ends: [first.point, second.point] };
                Some(IntersectionLine { carrier, triangles: pair })
            }
            _ => None,
        }
    }

    /// Adds the edges of the first triangle that lie in the plane of the
    /// second, reach into its inside, and have faces strictly on both sides of
    /// it. `signs` are those of the first's corners.
    fn add_edges_within(&mut self, [s, t]: [u32; 2], signs: [Sign; 3]) {
        let (mesh, predicates) = (self.mesh, &self.predicates);
        if signs.iter().filter(|sign| sign.is_zero()).count() != 2 {
            return;
        }
        let (corners, plane) = (mesh.triangles()[s as usize], mesh.triangles()[t as usize]);
        for i in 0..3 {
            let (a, b, c) = (corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]);
            if !(signs[i].is_zero() && signs[(i + 1) % 3].is_zero()) {
                continue;
            }
            let Some(edge) = mesh.edges().find(a, b) else {
                continue;
            };
            let triangles = mesh.edges().triangles(edge);
            // Each edge is reported by the first of its triangles.
            let mut others = [false; 2];
            for &triangle in triangles {
                let third = mesh.third(triangle, [a, b]);
                match predicates.plane(plane, third) {
                    Sign::Negative => others[0] = true,
                    Sign::Positive => others[1] = true,
                    Sign::Zero => {}
                }
            }
            let off_plane = |&&triangle: &&u32| {
                !predicates.plane(plane, mesh.third(triangle, [a, b])).is_zero()
            };
            if others == [true, true]
                && triangles.iter().find(off_plane) == Some(&s)
                && let Some(carrier) = clip_to_triangle(predicates, [a.min(b), a.max(b)], c, plane)
            {
                self.lines.push(IntersectionLine { carrier, triangles: [s.min(t), s.max(t)] });
            }
        }
    }
}

/// The part of an edge in a triangle's plane that lies inside the triangle;
/// `apex` is any vertex off the plane. Nothing if the edge only touches it
/// or runs along its border.
fn clip_to_triangle<P: Policy>(
    predicates: &Predicates<'_, P>,
    edge: [u32; 2],
    apex: u32,
    plane: [u32; 3],
) -> Option<Carrier> {
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
    let point = |cut: Option<Cut>, vertex| match cut {
        Some(Cut::Face(face)) => {
            let edge = match predicates.plane(face, edge[0]) {
                Sign::Negative => edge,
                _ => [edge[1], edge[0]],
            };
            Point::Piercing(Piercing { edge, face })
        }
        _ => Point::Vertex(vertex),
    };
    Some(Carrier { ends: [point(start, edge[0]), point(end, edge[1])] })
}
