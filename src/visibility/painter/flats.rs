//! Flat areas: the triangles of a face, and of its neighbours in one plane
//! across edges that are no lines.
//!
//! Where nothing must come in between, all of an area is painted in one go and
//! printed as one shape, so that an edge which nobody draws leaves no trace.

use crate::kernel::predicates::{Policy, Predicates};
use crate::model::{LineOrigin, Mesh};
use crate::view::LineQuestion;

/// For each triangle the first triangle of its area. O(n).
pub(super) fn flats<P: Policy>(question: &LineQuestion<'_>) -> Vec<u32> {
    let mesh = question.mesh;
    let predicates = Predicates::<P>::new(question.points);
    let mut is_line = vec![false; mesh.edges().len()];
    for line in question.lines {
        if let LineOrigin::Edge(edge) = line.origin {
            is_line[edge as usize] = true;
        }
    }
    let mut areas = Areas((0..mesh.triangles().len() as u32).collect());
    for triangle in 1..mesh.triangles().len() as u32 {
        if mesh.face_of(triangle) == mesh.face_of(triangle - 1) {
            areas.join(triangle - 1, triangle);
        }
    }
    for edge in (0..mesh.edges().len() as u32).filter(|&edge| !is_line[edge as usize]) {
        if let &[first, second] = mesh.edges().triangles(edge)
            && are_flat(&predicates, mesh, edge, [first, second])
        {
            areas.join(first, second);
        }
    }
    (0..mesh.triangles().len() as u32).map(|triangle| areas.first(triangle)).collect()
}

/// Whether two triangles at an edge lie in one plane, turn the same way and
/// look alike.
fn are_flat<P: Policy>(
    predicates: &Predicates<'_, P>,
    mesh: &Mesh,
    edge: u32,
    pair @ [first, second]: [u32; 2],
) -> bool {
    let ends = mesh.edges().ends(edge);
    let [one, other] = pair.map(|triangle| mesh.runs_along(triangle, ends));
    let [color, same] = pair.map(|triangle| mesh.color_of(mesh.face_of(triangle)));
    let plane = mesh.triangles()[first as usize];
    one != other && color == same && predicates.plane(plane, mesh.third(second, ends)).is_zero()
}

/// Triangles by the first of their area, found on the way (Tarjan 1975).
struct Areas(Vec<u32>);

impl Areas {
    fn first(&mut self, mut triangle: u32) -> u32 {
        while self.0[triangle as usize] != triangle {
            let next = self.0[self.0[triangle as usize] as usize];
            self.0[triangle as usize] = next;
            triangle = next;
        }
        triangle
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
