//! A question as the samples see it: their points beside the mesh's, the
//! tie rule, and the depth of what was found.

use super::{Face, Footprint, Judge, Samples};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Eye, Points, Policy};
use crate::model::View;
use crate::raster::ItemBuffer;
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::LineQuestion;
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// Triangles or samples per task.
const PART: usize = 4096;

/// A scene, a view and a grid of samples. In its points, samples are
/// vertices behind those of the mesh.
#[derive(Debug)]
pub struct Sampled<'a> {
    question: &'a LineQuestion<'a>,
    view: &'a View,
    samples: &'a Samples,
    points: Points,
}

impl<'a> Sampled<'a> {
    /// Scales the points of mesh and samples together. O(n + samples).
    pub fn new(view: &'a View, question: &'a LineQuestion<'a>, samples: &'a Samples) -> Self {
        let (width, height) = (samples.width(), samples.height());
        let cells = (0..height).flat_map(|row| (0..width).map(move |column| [column, row]));
        Self::of_some(view, question, samples, cells)
    }

    /// The same with some of the samples only, which are vertices in the order
    /// in which they are named: [`Sampled::vertex`] is about all of a grid.
    pub(in crate::raster) fn of_some(
        view: &'a View,
        question: &'a LineQuestion<'a>,
        samples: &'a Samples,
        cells: impl Iterator<Item = [u32; 2]>,
    ) -> Self {
        let mut vertices = question.mesh.vertices().to_vec();
        vertices.extend(cells.map(|[column, row]| samples.point(column, row)));
        let points = Points::new(&vertices, view.eye, view.near);
        Sampled { question, view, samples, points }
    }

    /// The points of predicates.
    pub fn points(&self) -> &Points {
        &self.points
    }

    /// The grid.
    pub fn samples(&self) -> &'a Samples {
        self.samples
    }

    /// The vertex that a sample is.
    #[inline(always)]
    pub fn vertex(&self, [column, row]: [u32; 2]) -> u32 {
        self.question.mesh.vertices().len() as u32 + row * self.samples.width() + column
    }

    /// Corners and facing of a triangle of the mesh.
    #[inline(always)]
    pub fn triangle(&self, triangle: u32) -> ([u32; 3], Sign) {
        let corners = self.question.mesh.triangles()[triangle as usize];
        (corners, self.question.facing[triangle as usize])
    }

    /// The face of a triangle.
    pub fn face_of(&self, triangle: u32) -> u32 {
        self.question.mesh.face_of(triangle)
    }

    /// First and last column and row of all samples that may see one of some
    /// triangles, given by their corners. Rounded outward.
    pub fn reach(&self, triangles: impl Iterator<Item = [u32; 3]>) -> Option<[[u32; 2]; 2]> {
        let both = |[a, b]: [u32; 2], [c, d]: [u32; 2]| [a.min(c), b.max(d)];
        let all = triangles.filter_map(|corners| self.footprint(corners));
        let boxes = all.map(|found| [found.columns, found.rows]);
        boxes.reduce(|[columns, rows], [more, other]| [both(columns, more), both(rows, other)])
    }

    /// Samples around the image of a triangle, see [`Samples::footprint`].
    pub(in crate::raster) fn footprint(&self, corners: [u32; 3]) -> Option<Footprint> {
        self.samples.footprint(self.question.coordinates, corners)
    }

    /// Rows that each border of a face may bound, rounded outward; for
    /// edges see [`Samples::edge_rows`].
    pub(in crate::raster) fn border_rows(&self, face: &Face) -> [Option<[u32; 2]>; 4] {
        let all = Some(face.footprint.rows);
        if face.borders().len() > 3 {
            return [all; 4];
        }
        let coordinates = self.question.coordinates;
        let [a, b, c] = self.samples.edge_rows(coordinates, face.corners);
        [a, b, c, None]
    }

    /// About where the images of a face's corners lie, in columns and rows;
    /// nothing if one of them has none.
    pub(in crate::raster) fn places(&self, face: &Face) -> Option<[DVec2; 3]> {
        let (places, _) = self.samples.places(self.question.coordinates, face.corners)?;
        Some(places)
    }

    /// All triangles that some sample may see, in the order of the mesh.
    ///
    /// # Errors
    ///
    /// If the run is cancelled.
    pub fn faces<P: Policy>(&self, run: &Run) -> Result<Vec<Face>, Cancelled> {
        run.check()?;
        let count = self.question.mesh.triangles().len();
        let parts = run.stage("faces", count as u64, || {
            map_chunks(count, PART, |part| {
                run.check()?;
                run.advance(part.len() as u64);
                let judge = Judge::<P>::new(self);
                let faces: Vec<Face> = part.filter_map(|i| judge.face(i as u32)).collect();
                run.merge(&judge.counters());
                Ok(faces)
            })
        });
        let mut faces = Vec::new();
        for part in parts {
            faces.extend(part?);
        }
        Ok(faces)
    }

    /// The tie rule: whether of two equally near triangles the first is
    /// seen. Compares what they are, not where the file has them.
    pub fn precedes(&self, first: u32, second: u32) -> bool {
        let mesh = self.question.mesh;
        let corners = |triangle: u32| {
            let mut corners = mesh.triangles()[triangle as usize]
                .map(|corner| mesh.vertices()[corner as usize].to_array());
            corners.sort_unstable_by(compare);
            corners
        };
        let name = |triangle| &mesh.objects()[mesh.object_of_triangle(triangle) as usize].name;
        let (a, b) = (corners(first), corners(second));
        let by_corner = a.iter().zip(&b).map(|(a, b)| compare(a, b));
        let order = by_corner
            .fold(Ordering::Equal, Ordering::then)
            .then_with(|| name(first).cmp(name(second)))
            .then(first.cmp(&second));
        order == Ordering::Less
    }

    /// The image of the nearest triangles, given row by row, with depths.
    pub fn buffer(&self, items: Vec<Option<u32>>) -> ItemBuffer {
        let width = self.samples.width();
        let depths = map_chunks(items.len(), PART, |part| {
            let at = |i: usize| [i as u32 % width, i as u32 / width];
            let depth =
                |i: usize| items[i].map_or(f64::INFINITY, |triangle| self.depth(at(i), triangle));
            part.map(depth).collect::<Vec<f64>>()
        });
        let depths: Vec<f64> = depths.concat();
        ItemBuffer::new(width, items.into_iter().zip(depths))
    }

    /// Depth of the point of a triangle's plane that a sample sees, rounded.
    pub(in crate::raster) fn depth(&self, [column, row]: [u32; 2], triangle: u32) -> f64 {
        let vertices = self.question.mesh.vertices();
        let corners = self.triangle(triangle).0.map(|v| vertices[v as usize]);
        depth_on_ray(self.view, corners, self.samples.point(column, row))
    }
}

/// Depth of the point in which the ray from the eye through `x` meets the
/// plane of a triangle that is not edge-on, world units, rounded.
pub fn depth_on_ray(view: &View, [a, b, c]: [DVec3; 3], x: DVec3) -> f64 {
    let normal = (b - a).cross(c - a);
    let ray = match view.eye {
        Eye::At(eye) => eye - x,
        Eye::Towards(direction) => direction,
    };
    let along = normal.dot(a - x) / normal.dot(ray);
    view.frame.depth(x + ray * along)
}

fn compare(a: &[f64; 3], b: &[f64; 3]) -> Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
}
