//! Triangulation of a polygon with holes, using its own corners only.
//!
//! A face of a model is a list of rings in space: the outer one first, then
//! its holes. It is cut into triangles along the axis in which it shows the
//! largest area, and every decision is an exact sign of that projection:
//!
//! 1. Newell's normal orders the three axes; the first in whose projection
//!    the outer ring has a signed area that is exactly not zero is taken.
//! 2. One ring that is star-shaped from its first corner becomes a fan:
//!    all triangles of a convex face, by far the most frequent case.
//! 3. Anything else becomes a constrained Delaunay triangulation (Chew
//!    1989; Bowyer 1981 and Watson 1981 for the insertions, in `spade`),
//!    whose triangles are kept where an odd number of ring edges separates
//!    them from the outside.
//!
//! Corners in the middle of an edge are corners of triangles too, so that
//! neighbours that use these corners fit without T-junctions. Nothing is
//! rounded: coordinates reach `spade` times a power of two, and its
//! decisions are exact in its range.

use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Eye, Points, Predicates};
use glam::DVec3;
use rustc_hash::FxHashMap;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::ops::Range;

/// What a polygon was cut into.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Triangles {
    /// Corner numbers, running over all rings in their order. All triangles
    /// turn the way the outer ring turns in the projection. Where rings
    /// touch in a corner, the least of its numbers stands for it.
    pub corners: Vec<[u32; 3]>,
    /// Whether all corners lie in one plane, exactly.
    pub is_planar: bool,
}

/// Why a polygon could not be cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TriangulationError {
    /// There is no ring, or the ring of this number has fewer than three corners.
    #[error("ring {0} has fewer than three corners")]
    TooFewCorners(usize),
    /// The ring of this number has a coordinate that is infinite or not a number.
    #[error("ring {0} has a coordinate that is not finite")]
    NotFinite(usize),
    /// The signed area of the outer ring is zero in each of the three projections.
    #[error("the outer ring encloses no area")]
    ZeroArea,
    /// The ring of this number visits a position twice.
    #[error("ring {0} visits a position twice")]
    RepeatedCorner(usize),
    /// An edge of the ring of this number crosses another edge, or runs
    /// along another edge of its own ring.
    #[error("an edge of ring {0} crosses another edge")]
    Crossing(usize),
    /// The coordinates span more binary orders than can be cut (about 340).
    #[error("the coordinates span too many orders of magnitude")]
    TooWide,
}

/// Cuts the polygon with these rings, the outer one first, into triangles
/// of its corners. Rings are not closed by a repeated corner, may turn
/// either way and may touch; the polygon is what an odd number of rings
/// enclose in the projection. O(n log n) as a rule, O(n) for convex faces.
///
/// # Errors
///
/// Where the rings enclose nothing or are not rings: [`TriangulationError`].
/// No input panics.
///
/// ```
/// use glam::dvec3;
/// use umriss::polygon::triangulate;
///
/// let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
/// let rings = [square.map(|(x, y)| dvec3(x, y, 7.0)).to_vec()];
/// let triangles = triangulate(&rings)?;
/// assert_eq!(triangles.corners, [[0, 1, 2], [0, 2, 3]]);
/// assert!(triangles.is_planar);
/// # Ok::<(), umriss::polygon::TriangulationError>(())
/// ```
pub fn triangulate(rings: &[Vec<DVec3>]) -> Result<Triangles, TriangulationError> {
    check(rings)?;
    let corners: Vec<DVec3> = rings.iter().flatten().copied().collect();
    let outer = 0..rings[0].len() as u32;
    for axis in axes_by_area(&rings[0]) {
        let points = Points::new(&corners, Eye::Towards(DVec3::AXES[axis]), None);
        let predicates = Predicates::new(&points);
        if let ([_], Some(fan)) = (rings, fan(&predicates, outer.clone())) {
            let is_planar = is_planar(&predicates, fan[0]);
            return Ok(Triangles { corners: fan, is_planar });
        }
        let turn = predicates.turn(outer.clone());
        if turn.is_zero() {
            continue;
        }
        let plane = Plane::new(&corners, axis)?;
        let triangles = plane.triangulate(rings, turn)?;
        let first = triangles.first().ok_or(TriangulationError::ZeroArea)?;
        let is_planar = is_planar(&predicates, *first);
        return Ok(Triangles { corners: triangles, is_planar });
    }
    Err(TriangulationError::ZeroArea)
}

/// The rings of a plane polygon as rings in the plane `z = 0`, without
/// their closing corners.
pub fn rings_of(polygon: &geo::Polygon<f64>) -> Vec<Vec<DVec3>> {
    let open = |ring: &geo::LineString<f64>| -> Vec<DVec3> {
        let corners = ring.0.len() - usize::from(ring.is_closed() && ring.0.len() > 1);
        ring.0[..corners].iter().map(|corner| DVec3::new(corner.x, corner.y, 0.0)).collect()
    };
    std::iter::once(polygon.exterior()).chain(polygon.interiors()).map(open).collect()
}

/// Refuses what has no corners or no position.
fn check(rings: &[Vec<DVec3>]) -> Result<(), TriangulationError> {
    if rings.is_empty() {
        return Err(TriangulationError::TooFewCorners(0));
    }
    for (number, ring) in rings.iter().enumerate() {
        if ring.len() < 3 {
            return Err(TriangulationError::TooFewCorners(number));
        }
        if !ring.iter().all(|corner| corner.is_finite()) {
            return Err(TriangulationError::NotFinite(number));
        }
    }
    Ok(())
}

/// The axes by the size of the ring's projection along them, largest
/// first. Rounded, which is good enough for a preference.
fn axes_by_area(ring: &[DVec3]) -> [usize; 3] {
    let largest = ring.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
    let scale = if largest > 0.0 { largest } else { 1.0 };
    let first = ring[0] / scale;
    let mut normal = DVec3::ZERO;
    for pair in ring.windows(2) {
        normal += (pair[0] / scale - first).cross(pair[1] / scale - first);
    }
    let size = normal.abs().to_array();
    let mut axes = [2, 1, 0];
    axes.sort_by(|&a, &b| size[b].total_cmp(&size[a]));
    axes
}

/// The fan from the first corner, if its triangles all turn one way and
/// together less than half a revolution around that corner.
fn fan(predicates: &Predicates<'_>, ring: Range<u32>) -> Option<Vec<[u32; 3]>> {
    let origin = ring.start;
    let turn = predicates.side(origin, origin + 1, origin + 2);
    let fits = |corner: u32| {
        predicates.side(origin, corner, corner + 1) == turn
            && predicates.side(origin, origin + 1, corner + 1) == turn
    };
    let seconds = origin + 1..ring.end - 1;
    if turn.is_zero() || !seconds.clone().all(fits) {
        return None;
    }
    Some(seconds.map(|corner| [origin, corner, corner + 1]).collect())
}

/// Whether all corners lie in the plane of these three.
fn is_planar(predicates: &Predicates<'_>, face: [u32; 3]) -> bool {
    (0..predicates.points().len() as u32).all(|corner| predicates.plane(face, corner).is_zero())
}

/// The corners in the projection, in the range of `spade`.
struct Plane {
    positions: Vec<Point2<f64>>,
}

/// The exponents between which `spade` decides exactly.
const LEAST_EXPONENT: i32 = -142;
const LARGEST_EXPONENT: i32 = 200;

impl Plane {
    /// Drops the coordinate `axis`; the order of the others keeps the sense
    /// of rotation seen from the positive end of the axis.
    fn new(corners: &[DVec3], axis: usize) -> Result<Self, TriangulationError> {
        let (x, y) = ((axis + 1) % 3, (axis + 2) % 3);
        let values = || corners.iter().flat_map(|corner| [corner[x], corner[y]]);
        let exponents = values().filter(|value| *value != 0.0).map(exponent_of);
        let (least, largest) =
            exponents.fold((i32::MAX, i32::MIN), |(low, high), e| (low.min(e), high.max(e)));
        // As it is where it fits; else as large as it may become.
        let fits = LEAST_EXPONENT <= least && largest <= LARGEST_EXPONENT;
        let shift = if fits || largest < least { 0 } else { LARGEST_EXPONENT - largest };
        if largest >= least && least + shift < LEAST_EXPONENT {
            return Err(TriangulationError::TooWide);
        }
        let half = shift / 2;
        let scale = |value: f64| value * f64::powi(2.0, half) * f64::powi(2.0, shift - half);
        let positions =
            corners.iter().map(|corner| Point2::new(scale(corner[x]), scale(corner[y]))).collect();
        Ok(Plane { positions })
    }

    /// The constrained Delaunay triangles inside, turning as `turn` says.
    fn triangulate(
        &self,
        rings: &[Vec<DVec3>],
        turn: Sign,
    ) -> Result<Vec<[u32; 3]>, TriangulationError> {
        let mut net = Net::default();
        let mut first = 0;
        let mut handles = Vec::with_capacity(self.positions.len());
        for (number, ring) in rings.iter().enumerate() {
            let end = first + ring.len();
            for corner in first..end {
                handles.push(net.insert(self.positions[corner], corner as u32, number)?);
            }
            first = end;
        }
        first = 0;
        for (number, ring) in rings.iter().enumerate() {
            net.constrain(&handles[first..first + ring.len()], number)?;
            first += ring.len();
        }
        let mut triangles = net.inside();
        if turn == Sign::Negative {
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        Ok(triangles)
    }
}

/// The exponent of the highest bit of a number that is not zero.
fn exponent_of(value: f64) -> i32 {
    let bits = value.to_bits() & !(1 << 63);
    let field = (bits >> 52) as i32;
    if field == 0 { -1011 - bits.leading_zeros() as i32 } else { field - 1023 }
}

/// The triangulation of the plane under construction.
#[derive(Default)]
struct Net {
    triangulation: ConstrainedDelaunayTriangulation<Point2<f64>>,
    /// The first corner at each vertex, and the last ring that visited it.
    visits: Vec<(u32, usize)>,
    /// How often rings run along a constraint, and the last that did.
    borders: FxHashMap<[FixedVertexHandle; 2], (u32, usize)>,
}

impl Net {
    /// Adds a corner of a ring.
    fn insert(
        &mut self,
        position: Point2<f64>,
        corner: u32,
        ring: usize,
    ) -> Result<FixedVertexHandle, TriangulationError> {
        let vertex =
            self.triangulation.insert(position).map_err(|_| TriangulationError::TooWide)?;
        match self.visits.get_mut(vertex.index()) {
            None => self.visits.push((corner, ring)),
            Some((_, last)) if *last == ring => {
                return Err(TriangulationError::RepeatedCorner(ring));
            }
            Some((_, last)) => *last = ring,
        }
        Ok(vertex)
    }

    /// Adds the edges of a ring. An edge through another corner becomes
    /// several.
    fn constrain(
        &mut self,
        ring: &[FixedVertexHandle],
        number: usize,
    ) -> Result<(), TriangulationError> {
        let next = ring.iter().cycle().skip(1);
        for (&from, &to) in ring.iter().zip(next) {
            let edges = self.triangulation.try_add_constraint(from, to);
            if edges.is_empty() {
                return Err(TriangulationError::Crossing(number));
            }
            for edge in edges {
                let ends = self.triangulation.directed_edge(edge).vertices();
                let key = unordered(ends.map(|vertex| vertex.fix()));
                let (count, last) = self.borders.entry(key).or_insert((0, usize::MAX));
                if *last == number {
                    return Err(TriangulationError::Crossing(number));
                }
                (*count, *last) = (*count + 1, number);
            }
        }
        Ok(())
    }

    /// The triangles that an odd number of borders separates from the
    /// outside, counterclockwise, each beginning with its least corner, in
    /// the order of their corners.
    fn inside(&self) -> Vec<[u32; 3]> {
        let outside = self.triangulation.outer_face().fix();
        let mut parity = vec![None; self.triangulation.num_all_faces()];
        parity[outside.index()] = Some(false);
        let mut waiting: Vec<_> = self.triangulation.convex_hull().map(|edge| edge.fix()).collect();
        // Each entry is an edge whose left face is known; its twin's is next.
        while let Some(fixed) = waiting.pop() {
            let edge = self.triangulation.directed_edge(fixed);
            let twin = edge.rev();
            let Some(known) = parity[edge.face().fix().index()] else {
                continue;
            };
            if twin.face().is_outer() || parity[twin.face().fix().index()].is_some() {
                continue;
            }
            let key = unordered(edge.vertices().map(|vertex| vertex.fix()));
            let borders = self.borders.get(&key).map_or(0, |border| border.0);
            parity[twin.face().fix().index()] = Some(known != (borders % 2 == 1));
            waiting.extend([twin.next().fix(), twin.prev().fix()]);
        }
        let mut triangles: Vec<[u32; 3]> = self
            .triangulation
            .inner_faces()
            .filter(|face| parity[face.fix().index()] == Some(true))
            .map(|face| {
                let corners = face.vertices().map(|vertex| self.visits[vertex.index()].0);
                least_first(corners)
            })
            .collect();
        triangles.sort_unstable();
        triangles
    }
}

/// The ends of an edge without its direction.
fn unordered([a, b]: [FixedVertexHandle; 2]) -> [FixedVertexHandle; 2] {
    if a <= b { [a, b] } else { [b, a] }
}

/// The same cycle, beginning with its least number.
fn least_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
