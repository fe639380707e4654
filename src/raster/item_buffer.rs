//! An image whose samples name triangles instead of colours.
//!
//! Every method of this room answers with one, and whichever it is, the
//! answer is the same to the last bit. So what is not a matter of method is
//! laid down here: which of two triangles owns a sample at which they are
//! equally near, and how the depth of a sample is rounded.

use super::Samples;
use crate::kernel::predicates::Eye;
use crate::model::{Mesh, View};
use crate::run::map_chunks;
use glam::DVec3;
use std::cmp::Ordering;

/// Samples per task.
const PART: usize = 1 << 14;

/// The nearest triangle of each sample, row by row from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct ItemBuffer {
    width: u32,
    height: u32,
    items: Vec<Option<u32>>,
    depths: Vec<f64>,
}

impl ItemBuffer {
    /// A buffer of `width` columns with the triangle and depth of each
    /// sample; depth is world units along the view direction, infinite
    /// where there is no triangle. Incomplete rows are left out.
    pub fn new(width: u32, samples: impl IntoIterator<Item = (Option<u32>, f64)>) -> Self {
        let (items, depths): (Vec<_>, Vec<_>) = samples.into_iter().unzip();
        ItemBuffer {
            width,
            height: items.len().checked_div(width as usize).unwrap_or(0) as u32,
            items,
            depths,
        }
    }

    /// A buffer of the triangles that own the samples of a grid, row by row,
    /// with the depths of what the samples see.
    pub fn of_items(view: &View, mesh: &Mesh, samples: &Samples, items: Vec<Option<u32>>) -> Self {
        let width = samples.width();
        let depths = map_chunks(items.len(), PART, |part| {
            let depth = |i: usize| {
                let point = || samples.point(i as u32 % width, i as u32 / width);
                items[i].map_or(f64::INFINITY, |triangle| depth(view, mesh, triangle, point()))
            };
            part.map(depth).collect::<Vec<_>>()
        });
        let depths: Vec<f64> = depths.concat();
        Self::new(width, items.into_iter().zip(depths))
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    fn index(&self, column: u32, row: u32) -> Option<usize> {
        let inside = column < self.width && row < self.height;
        inside.then_some(row as usize * self.width as usize + column as usize)
    }

    /// The nearest triangle at a sample, if there is one.
    pub fn item(&self, column: u32, row: u32) -> Option<u32> {
        self.items[self.index(column, row)?]
    }

    /// The depth at a sample: infinite outside the image and where there is
    /// no triangle.
    pub fn depth(&self, column: u32, row: u32) -> f64 {
        self.index(column, row).map_or(f64::INFINITY, |index| self.depths[index])
    }
}

/// Which of two triangles owns a sample at which they are equally near: the
/// lesser one does, by its sorted corners, then by the name of its object.
/// They are compared by what they are, not by where the file has them.
pub(super) fn tie_order(mesh: &Mesh, s: u32, t: u32) -> Ordering {
    let corners = |triangle: u32| {
        let mut corners = mesh.triangles()[triangle as usize]
            .map(|corner| mesh.vertices()[corner as usize].to_array());
        corners.sort_unstable_by(compare);
        corners
    };
    let name = |triangle| &mesh.objects()[mesh.object_of_triangle(triangle) as usize].name;
    let (a, b) = (corners(s), corners(t));
    let by_corner = a.iter().zip(&b).map(|(a, b)| compare(a, b));
    by_corner
        .fold(Ordering::Equal, Ordering::then)
        .then_with(|| name(s).cmp(name(t)))
        .then(s.cmp(&t))
}

fn compare(a: &[f64; 3], b: &[f64; 3]) -> Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
}

/// Depth of the point of a triangle's plane that sample `x` sees, rounded.
fn depth(view: &View, mesh: &Mesh, triangle: u32, x: DVec3) -> f64 {
    let [a, b, c] = mesh.triangles()[triangle as usize].map(|v| mesh.vertices()[v as usize]);
    let normal = (b - a).cross(c - a);
    let ray = match view.eye {
        Eye::At(eye) => eye - x,
        Eye::Towards(direction) => direction,
    };
    let along = normal.dot(a - x) / normal.dot(ray);
    view.frame.depth(x + ray * along)
}
