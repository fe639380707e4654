//! The constrained Delaunay triangulation inside of an outline, by `spade`.
//!
//! (Chew 1989 for the triangulation; Bowyer 1981 and Watson 1981 for the
//! insertions.) Points go in along a curve and edges by their ends, so where
//! four points lie on one circle the answer depends on where they lie and on
//! nothing else. From the outside inwards each triangle learns what goes around
//! it from a neighbour and the edge between them.
//!
//! `spade` decides exactly while exponents are within a range. Points reach it
//! as they are, or times a power of two if they do not fit as they are.

use super::Outline;
use super::curve::along_hilbert_curve;
use super::outline::Insideness;
use glam::DVec2;
use rustc_hash::FxHashMap;
use spade::handles::{DirectedEdgeHandle, FixedVertexHandle};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

/// The exponents between which `spade` decides exactly.
const LEAST_EXPONENT: i32 = -142;
const LARGEST_EXPONENT: i32 = 200;

/// A point of the outline.
struct Vertex {
    position: Point2<f64>,
    number: u32,
}

impl HasPosition for Vertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// Two edges of an outline cross, and there is no point where they do.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgesCross;

type Net = ConstrainedDelaunayTriangulation<Vertex>;

/// The triangles inside of an outline, by its points, counterclockwise.
/// Nothing if its coordinates span more orders than are decided exactly.
pub(super) fn triangulate(outline: &Outline) -> Option<Result<Vec<[u32; 3]>, EdgesCross>> {
    let scale = Scale::of(&outline.points)?;
    let mut net = Net::with_capacity(
        outline.points.len(),
        3 * outline.points.len(),
        2 * outline.points.len(),
    );
    let mut handles = vec![FixedVertexHandle::from_index(0); outline.points.len()];
    for number in along_hilbert_curve(&outline.points) {
        let p = outline.points[number as usize];
        let position = Point2::new(scale.times(p.x), scale.times(p.y));
        handles[number as usize] = net.insert(Vertex { position, number }).ok()?;
    }
    Some(Borders::insert(net, &handles, outline).map(|borders| borders.triangles_inside()))
}

/// A power of two, in two factors: it may be out of range as one.
struct Scale([f64; 2]);

impl Scale {
    /// One where the points fit, else what makes them as large as they may be.
    fn of(points: &[DVec2]) -> Option<Self> {
        let values = points.iter().flat_map(|p| [p.x, p.y]);
        let exponents = values.filter(|value| *value != 0.0).map(exponent_of);
        let (least, largest) =
            exponents.fold((i32::MAX, i32::MIN), |(low, high), e| (low.min(e), high.max(e)));
        let fits = LEAST_EXPONENT <= least && largest <= LARGEST_EXPONENT;
        let shift = if fits || largest < least { 0 } else { LARGEST_EXPONENT - largest };
        let is_wide = largest >= least && least + shift < LEAST_EXPONENT;
        let half = shift / 2;
        (!is_wide).then(|| Scale([half, shift - half].map(|exponent| f64::powi(2.0, exponent))))
    }

    fn times(&self, value: f64) -> f64 {
        value * self.0[0] * self.0[1]
    }
}

/// The exponent of the highest bit of a number that is not zero.
fn exponent_of(value: f64) -> i32 {
    let bits = value.to_bits() & !(1 << 63);
    let field = (bits >> 52) as i32;
    if field == 0 { -1011 - bits.leading_zeros() as i32 } else { field - 1023 }
}

/// A triangulation that has all edges of an outline, whole or in parts.
struct Borders {
    net: Net,
    /// What changes from the right to the left of an edge, its lesser end first.
    changes: FxHashMap<[u32; 2], Insideness>,
}

impl Borders {
    /// Adds the edges. One through other points becomes several; parts that
    /// lie on one another become one.
    fn insert(
        mut net: Net,
        handles: &[FixedVertexHandle],
        outline: &Outline,
    ) -> Result<Self, EdgesCross> {
        let mut changes = FxHashMap::default();
        for edge in &outline.edges {
            let [from, to] = edge.ends.map(|point| handles[point as usize]);
            let parts = net.try_add_constraint(from, to);
            if parts.is_empty() {
                return Err(EdgesCross);
            }
            for part in parts {
                // Points are numbered along every line, so parts run upwards.
                let ends = net.directed_edge(part).vertices().map(|vertex| vertex.data().number);
                let change = changes.entry(ends).or_insert(Insideness::default());
                *change = change.plus(edge.change);
            }
        }
        Ok(Borders { net, changes })
    }

    /// What changes for one who crosses an edge from its left to its right.
    fn change<D, U, F>(&self, edge: DirectedEdgeHandle<'_, Vertex, D, U, F>) -> Insideness {
        let [from, to] = edge.vertices().map(|vertex| vertex.data().number);
        let change = self.changes.get(&[from.min(to), from.max(to)]).copied().unwrap_or_default();
        if from < to { change.reversed() } else { change }
    }

    fn triangles_inside(&self) -> Vec<[u32; 3]> {
        let mut known = vec![None; self.net.num_all_faces()];
        known[self.net.outer_face().index()] = Some(Insideness::default());
        // Edges whose left face is known; their twins' is next.
        let mut waiting: Vec<_> = self.net.convex_hull().map(|edge| edge.fix()).collect();
        while let Some(edge) = waiting.pop() {
            let edge = self.net.directed_edge(edge);
            let (here, beyond) = (edge.face().index(), edge.rev().face().index());
            if let (Some(insideness), None) = (known[here], known[beyond]) {
                known[beyond] = Some(insideness.plus(self.change(edge)));
                waiting.extend([edge.rev().next().fix(), edge.rev().prev().fix()]);
            }
        }
        self.net
            .inner_faces()
            .filter(|face| known[face.index()].is_some_and(Insideness::is_inside))
            .map(|face| face.vertices().map(|vertex| vertex.data().number))
            .collect()
    }
}
