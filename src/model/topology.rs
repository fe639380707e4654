//! What a mesh is as a surface: open or closed, in how many parts, and what
//! is wrong with it. No eye is needed for any of it.
//!
//! Everything is counted, nothing is repaired. An edge is judged by the
//! number of its triangles; inner edges of one polygon's triangulation are no
//! edges of the model and are passed over. Components are the classes of
//! triangles under "have an edge in common".
//!
//! A *T-junction* is a vertex of a boundary edge strictly inside another
//! boundary edge of the same object: two faces that meet on the screen but
//! have no edge in common. A hierarchy over the boundary edges proposes pairs
//! and exact collinearity decides them.

use super::components::join;
use super::features::is_crease;
use super::world_boxes::WorldBoxes;
use super::{
    CameraError, FeatureOptions, Intersections, Known, Mesh, StandardView, ViewCoordinates,
    triangle_hierarchy,
};
use crate::kernel::predicates::{Exact, Eye, Points, Predicates, are_collinear};
use crate::run::{Cancelled, Run, map_chunks};
use crate::spatial::Hierarchy;
use glam::DVec3;

/// A vertex inside an edge that does not end there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct TJunction {
    /// The vertex; it ends another boundary edge of the same object.
    pub vertex: u32,
    /// The boundary edge in whose inside it lies.
    pub edge: u32,
}

/// Why pairs of faces could not be found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TopologyError {
    /// There is no view of the coordinates.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The run was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The surface that a mesh is.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Topology {
    /// Edges of one triangle.
    pub boundary_edges: usize,
    /// Edges of three triangles or more.
    pub non_manifold_edges: usize,
    /// Edges of two triangles with a fold above the threshold.
    pub crease_edges: usize,
    /// Edges of two triangles with less of a fold.
    pub smooth_edges: usize,
    /// Edges of two triangles that turn against one another: both run along
    /// the edge in the same direction.
    pub inconsistent_edges: usize,
    /// Edges with an odd number of triangles; without them there is an inside.
    pub odd_edges: usize,
    /// Parts of the surface that have no edge in common.
    pub components: usize,
    /// Stretches along which borders of one object lie on one another: they
    /// are no lines of their own kind.
    pub matched_borders: usize,
    /// Stretches of borders that two objects have in common, each once.
    pub seams: usize,
    /// All T-junctions, by vertex and edge.
    pub t_junctions: Vec<TJunction>,
}

/// Edges or vertices that one task looks at.
const PART: usize = 1 << 12;

impl Topology {
    /// Looks at all edges of a mesh; `options` say what fold is a crease.
    /// Expected O(n log n).
    ///
    /// # Errors
    ///
    /// If the run is cancelled.
    pub fn of(mesh: &Mesh, options: &FeatureOptions, run: &Run<'_>) -> Result<Self, Cancelled> {
        let points = Points::new(mesh.vertices(), Eye::Towards(DVec3::Z), None);
        let parts = map_chunks(mesh.edges().len(), PART, |part| {
            let predicates = Predicates::<Exact>::new(&points);
            let mut counted = Topology::default();
            if run.is_stopped() {
                return (counted, predicates.counters());
            }
            run.advance(part.len() as u64);
            for edge in part {
                counted.add_edge(mesh, &predicates, options, edge as u32);
            }
            (counted, predicates.counters())
        });
        let mut topology = Topology::default();
        for (counted, counters) in parts {
            topology.add(&counted);
            run.merge(&counters);
        }
        run.check()?;
        topology.components = count_components(mesh);
        (topology.matched_borders, topology.seams) = count_stretches(mesh);
        topology.t_junctions = find_t_junctions(mesh, run);
        run.check()?;
        Ok(topology)
    }

    /// Whether every edge has an even number of triangles, so that there is
    /// an inside and an outside. A mesh without triangles is not closed.
    pub fn is_closed(&self) -> bool {
        self.components > 0 && self.odd_edges == 0
    }

    fn add_edge(
        &mut self,
        mesh: &Mesh,
        predicates: &Predicates<'_, Exact>,
        options: &FeatureOptions,
        edge: u32,
    ) {
        let triangles = mesh.edges().triangles(edge);
        self.odd_edges += triangles.len() % 2;
        let mut faces = mesh.bordering(edge);
        match (faces.next(), faces.next(), faces.next()) {
            // A polygon is cut there: no edge of the model.
            (None, ..) => {}
            (Some(_), None, _) => self.boundary_edges += 1,
            (Some(first), Some(second), None) => {
                let ends = mesh.edges().ends(edge);
                let same = mesh.runs_along(first, ends) == mesh.runs_along(second, ends);
                self.inconsistent_edges += usize::from(same);
                if is_crease(mesh, predicates, options, edge) {
                    self.crease_edges += 1;
                } else {
                    self.smooth_edges += 1;
                }
            }
            _ => self.non_manifold_edges += 1,
        }
    }

    fn add(&mut self, other: &Self) {
        self.boundary_edges += other.boundary_edges;
        self.non_manifold_edges += other.non_manifold_edges;
        self.crease_edges += other.crease_edges;
        self.smooth_edges += other.smooth_edges;
        self.inconsistent_edges += other.inconsistent_edges;
        self.odd_edges += other.odd_edges;
    }
}

/// Pairs of faces that pass through one another, each pair once, the smaller
/// number first. Expected O(n + pairs of overlapping boxes).
///
/// # Errors
///
/// If the coordinates are too large to be seen from above; if the run is
/// cancelled or the pairs are more than it may hold.
pub fn interpenetrations(mesh: &Mesh, run: &Run<'_>) -> Result<Vec<[u32; 2]>, TopologyError> {
    let (low, high) = mesh.bounds();
    // Whether faces cross does not depend on the eye; boxes are wanted in
    // some view, and the first is as good as any.
    let view = StandardView::ALL[0].view(low * 0.5 + high * 0.5)?;
    let points = Points::new(mesh.vertices(), view.eye, view.near);
    let coordinates = ViewCoordinates::new(&view.frame, mesh.vertices());
    let hierarchy = triangle_hierarchy(mesh, &coordinates, None);
    let found = Intersections::find::<Exact>(mesh, &points, &hierarchy, Known::default(), run)?;
    let faces = |[s, t]: [u32; 2]| {
        let [f, g] = [mesh.face_of(s), mesh.face_of(t)];
        [f.min(g), f.max(g)]
    };
    run.take((found.lines.len() * size_of::<[u32; 2]>()) as u64)?;
    let mut pairs: Vec<_> = found.lines.iter().map(|line| faces(line.triangles)).collect();
    pairs.sort_unstable();
    pairs.dedup();
    Ok(pairs)
}

/// Triangles joined by common edges.
fn count_components(mesh: &Mesh) -> usize {
    let mut parents: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
    let mut components = parents.len();
    for edge in 0..mesh.edges().len() as u32 {
        if let [first, others @ ..] = mesh.edges().triangles(edge) {
            for other in others {
                components -= usize::from(join(&mut parents, [*first, *other]));
            }
        }
    }
    components
}

/// Stretches with several faces of one object, and of two objects.
fn count_stretches(mesh: &Mesh) -> (usize, usize) {
    let borders = mesh.borders();
    let all = || 0..borders.stretches().len() as u32;
    let matched = all().filter(|&stretch| 1 < borders.sides(stretch, false).len()).count();
    // Each seam is a stretch of either object.
    (matched, all().filter(|&stretch| borders.is_seam(stretch)).count() / 2)
}

fn find_t_junctions(mesh: &Mesh, run: &Run<'_>) -> Vec<TJunction> {
    let all = 0..mesh.edges().len() as u32;
    let border: Vec<u32> = all.filter(|&e| mesh.edges().triangles(e).len() == 1).collect();
    let mut vertices: Vec<u32> = border.iter().flat_map(|&e| mesh.edges().ends(e)).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let boxes = WorldBoxes::new(mesh);
    let border_boxes: Vec<_> =
        border.iter().map(|&edge| boxes.around(&mesh.edges().ends(edge))).collect();
    let hierarchy = Hierarchy::new(&border_boxes);
    let parts = map_chunks(vertices.len(), PART, |part| {
        let mut found = Vec::new();
        for &vertex in &vertices[part] {
            if run.is_stopped() {
                break;
            }
            let place = boxes.around(&[vertex]);
            hierarchy.visit(
                |group| group.overlapping(&place),
                |index| {
                    let edge = border[index as usize];
                    if lies_inside(mesh, vertex, edge) {
                        found.push(TJunction { vertex, edge });
                    }
                },
            );
        }
        found
    });
    let mut junctions = parts.concat();
    junctions.sort_unstable();
    junctions
}

/// Whether a vertex lies strictly inside an edge of its own object, exactly.
fn lies_inside(mesh: &Mesh, vertex: u32, edge: u32) -> bool {
    let [a, b] = mesh.edges().ends(edge);
    let [p, from, to] = [vertex, a, b].map(|index| mesh.vertices()[index as usize]);
    // Vertices of one object are welded, so equal positions are equal numbers.
    vertex != a
        && vertex != b
        && from.min(to).cmple(p).all()
        && p.cmple(from.max(to)).all()
        && mesh.object_of_vertex(vertex) == mesh.object_of_vertex(a)
        && are_collinear(from, to, p)
}

#[cfg(test)]
mod tests;
