//! The tie rule: which of two triangles at the same depth is seen.
//!
//! It is the one with the least sorted corners, then that of the object with
//! the lesser name. So the order of the file decides nothing, but for twins of
//! one name, which look alike anyway.

use crate::model::Mesh;
use crate::run::sort_by;
use std::cmp::Ordering;

/// Whether the first of two triangles at the same depth is seen.
pub(super) fn precedes(mesh: &Mesh, first: u32, second: u32) -> bool {
    order(mesh, (first, &sorted_corners(mesh, first)), (second, &sorted_corners(mesh, second)))
        .is_lt()
}

/// The place of each triangle in the order of the tie rule. O(n log n).
pub(super) fn ranks(mesh: &Mesh) -> Vec<u32> {
    let count = mesh.triangles().len();
    let corners = |triangle: usize| (triangle as u32, sorted_corners(mesh, triangle as u32));
    let mut sorted: Vec<_> = crate::run::map_small(count, corners);
    sort_by(&mut sorted, |a, b| order(mesh, (a.0, &a.1), (b.0, &b.1)));
    let mut ranks = vec![0; count];
    for (rank, (triangle, _)) in (0..).zip(sorted) {
        ranks[triangle as usize] = rank;
    }
    ranks
}

type Corners = [[f64; 3]; 3];

fn sorted_corners(mesh: &Mesh, triangle: u32) -> Corners {
    let at = |vertex: u32| mesh.vertices()[vertex as usize].to_array();
    let mut corners = mesh.triangles()[triangle as usize].map(at);
    corners.sort_unstable_by(compare);
    corners
}

fn order(mesh: &Mesh, first: (u32, &Corners), second: (u32, &Corners)) -> Ordering {
    let name = |triangle| &mesh.objects()[mesh.object_of_triangle(triangle) as usize].name;
    let places = (0..3).map(|i| compare(&first.1[i], &second.1[i])).find(|order| order.is_ne());
    let order = places.unwrap_or_else(|| name(first.0).cmp(name(second.0)));
    order.then(first.0.cmp(&second.0))
}

fn compare(a: &[f64; 3], b: &[f64; 3]) -> Ordering {
    let orders = (0..3).map(|axis| a[axis].total_cmp(&b[axis]));
    orders.fold(Ordering::Equal, Ordering::then)
}
