//! Visibility by samples: a ray from points at a step along every line.
//!
//! As line-art programs do it: a hierarchy of boxes around triangles, and from
//! each point a ray to the eye that begins a millionth of the model's size off
//! the point, lest it meets the faces that the line bounds. In floats.

use super::measure::{Visible, joined, picture_size};
use glam::DVec3;
use umriss::kernel::predicates::Eye;
use umriss::model::{Mesh, View};
use umriss::run::map_chunks;

/// Lines per task.
const PART: usize = 64;

/// Triangles in a leaf.
const LEAF: usize = 4;

/// How far off a point its ray begins, as a share of the model's size.
const OFF: f64 = 1e-6;

/// Edges as far as samples see them: one sample for each of so many parts of
/// the picture's longer side.
pub(crate) fn by_samples(mesh: &Mesh, view: &View, parts: u32) -> Visible {
    let towards = match view.eye {
        Eye::Towards(direction) => direction.normalize(),
        Eye::At(_) => return vec![Vec::new(); mesh.edges().len()],
    };
    let step = picture_size(mesh, view) / f64::from(parts);
    let (low, high) = mesh.bounds();
    let off = towards * ((high - low).length() * OFF);
    let tree = Tree::new(mesh);
    let found = map_chunks(mesh.edges().len(), PART, |part| {
        let edge = |edge: usize| {
            let ends = mesh.edges().ends(edge as u32).map(|v| mesh.vertices()[v as usize]);
            let [a, b] = ends.map(|end| view.frame.image(end));
            let steps = (a.distance(b) / step).ceil().max(1.0) as u32;
            joined(steps, |share| !tree.meets(ends[0].lerp(ends[1], share) + off, towards))
        };
        part.map(edge).collect::<Vec<_>>()
    });
    found.concat()
}

struct Node {
    low: DVec3,
    high: DVec3,
    /// Of a leaf its first triangle, else the second child; the first follows.
    next: usize,
    /// Zero if it is no leaf.
    count: usize,
}

struct Tree {
    nodes: Vec<Node>,
    triangles: Vec<[DVec3; 3]>,
}

impl Tree {
    fn new(mesh: &Mesh) -> Self {
        let corners = |triangle: &[u32; 3]| triangle.map(|v| mesh.vertices()[v as usize]);
        let triangles = mesh.triangles().iter().map(corners).collect();
        let mut tree = Tree { nodes: Vec::new(), triangles };
        tree.build(0, tree.triangles.len());
        tree
    }

    fn build(&mut self, first: usize, end: usize) {
        let part = &mut self.triangles[first..end];
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) =
            part.iter().flatten().fold(start, |(low, high), p| (low.min(*p), high.max(*p)));
        let node = self.nodes.len();
        let count = if end - first <= LEAF { end - first } else { 0 };
        self.nodes.push(Node { low, high, next: first, count });
        if count == 0 {
            let size = high - low;
            let axis =
                (0..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best });
            let middle = part.len() / 2;
            let place = |t: &[DVec3; 3]| t[0][axis] + t[1][axis] + t[2][axis];
            part.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
            self.build(first, first + middle);
            self.nodes[node].next = self.nodes.len();
            self.build(first + middle, end);
        }
    }

    /// Whether a ray meets a triangle.
    fn meets(&self, from: DVec3, along: DVec3) -> bool {
        let inverse = along.recip();
        let mut open = [0_usize; 64];
        let mut count = usize::from(!self.triangles.is_empty());
        while count > 0 {
            count -= 1;
            let index = open[count];
            let node = &self.nodes[index];
            let (near, far) = ((node.low - from) * inverse, (node.high - from) * inverse);
            let enter = near.min(far).max_element().max(0.0);
            if near.max(far).min_element() < enter {
                continue;
            }
            if node.count > 0 {
                let leaf = &self.triangles[node.next..node.next + node.count];
                if leaf.iter().any(|&triangle| is_met(triangle, from, along)) {
                    return true;
                }
            } else {
                open[count] = node.next;
                open[count + 1] = index + 1;
                count += 2;
            }
        }
        false
    }
}

/// Moller and Trumbore's test (1997).
fn is_met([a, b, c]: [DVec3; 3], from: DVec3, along: DVec3) -> bool {
    let (u, v) = (b - a, c - a);
    let across = along.cross(v);
    let determinant = u.dot(across);
    if determinant == 0.0 {
        return false;
    }
    let offset = from - a;
    let first = offset.dot(across) / determinant;
    let turned = offset.cross(u);
    let second = along.dot(turned) / determinant;
    first >= 0.0 && second >= 0.0 && first + second <= 1.0 && v.dot(turned) / determinant > 0.0
}
