//! Names for what the engine numbers in its own way: those of the file.

use super::EndCause;
use crate::kernel::predicates::{Carrier, Cut, Place, Point};
use crate::model::Mesh;

/// What is at a place of a line.
pub(super) fn cause(mesh: &Mesh, carrier: Carrier, place: Place) -> EndCause {
    match place {
        Place::Start => end(mesh, carrier.ends[0]),
        Place::End => end(mesh, carrier.ends[1]),
        Place::Cut(Cut::Face(corners)) => EndCause::Face {
            object: mesh.object_of_vertex(corners[0]),
            vertices: corners.map(|vertex| mesh.vertex_number(vertex)),
        },
        Place::Cut(Cut::Silhouette(edge)) => {
            let (object, edge) = edge_name(mesh, edge);
            EndCause::Edge { object, edge }
        }
        // Borders of regions end at images of vertices too.
        Place::Cut(Cut::Vertex(vertex, _)) => end(mesh, Point::Vertex(vertex)),
        Place::Cut(Cut::Near | Cut::NearLine(_)) => EndCause::NearPlane,
    }
}

fn end(mesh: &Mesh, point: Point) -> EndCause {
    match point {
        Point::Vertex(vertex) => EndCause::Vertex {
            object: mesh.object_of_vertex(vertex),
            vertex: mesh.vertex_number(vertex),
        },
        Point::Piercing(piercing) => {
            let (object, edge) = edge_name(mesh, piercing.edge);
            EndCause::Piercing { object, edge }
        }
    }
}

/// The object of an edge and its vertices, in the order of the mesh: that of
/// the edge of a piercing is another.
fn edge_name(mesh: &Mesh, [a, b]: [u32; 2]) -> (u32, [u32; 2]) {
    let edge = [a.min(b), a.max(b)];
    (mesh.object_of_vertex(edge[0]), edge.map(|vertex| mesh.vertex_number(vertex)))
}
