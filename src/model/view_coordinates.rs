//! Vertices in the view frame: rounded, for boxes and for output.
//!
//! Every coordinate comes with a bound of its error, so that boxes made of
//! them can be rounded outward. The bound rests on the plainest analysis:
//! a coordinate is a sum of three products after a subtraction, off by a
//! few units in the last place of the largest term.

use super::{Frame, Projection};
use crate::run::{map_chunks, map_small};
use crate::spatial::{Bounds, Placed, Rounding, SegmentProbe};
use glam::{DVec2, DVec3, Vec3A};

/// Relative error of a view coordinate against the largest offset from the
/// frame's origin: ten roundings, and the frame's own, with room to spare.
const RELATIVE_ERROR: f64 = 64.0 * f64::EPSILON;

/// Boxes around vertices, made once for all.
#[derive(Debug, Clone)]
pub struct VertexBoxes<'c> {
    coordinates: &'c ViewCoordinates,
    /// Empty for vertices that may lie on or behind the plane of the eye.
    boxes: Vec<Bounds>,
}

impl VertexBoxes<'_> {
    /// A box like that of [`ViewCoordinates::bounds`].
    #[inline]
    pub fn around<const N: usize>(&self, vertices: [u32; N]) -> Bounds {
        let mut around = Bounds::EMPTY;
        for vertex in vertices {
            let own = &self.boxes[vertex as usize];
            if own.is_empty() {
                return self.coordinates.bounds_across_eye(&vertices);
            }
            around = around.union(own);
        }
        around
    }

    /// About where a vertex lies, as [`ViewCoordinates::place`].
    #[inline]
    pub fn place(&self, vertex: u32) -> Vec3A {
        let own = &self.boxes[vertex as usize];
        match own.is_empty() {
            true => self.coordinates.place(vertex),
            false => own.low * 0.5 + own.high * 0.5,
        }
    }
}

/// A point along right, up and forward, and how far it may be off in each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughPoint {
    at: DVec3,
    error: f64,
}

/// View coordinates of all vertices of a scene.
#[derive(Debug, Clone)]
pub struct ViewCoordinates {
    frame: Frame,
    /// Along right, up and forward, before any division.
    points: Vec<DVec3>,
    /// Bound of the error of each of them.
    error: f64,
    rounding: Rounding,
}

impl ViewCoordinates {
    /// Computes them. O(n).
    pub fn new(frame: &Frame, vertices: &[DVec3]) -> Self {
        let points = map_small(vertices.len(), |i| frame.coordinates(vertices[i]));
        let farthest = map_chunks(vertices.len(), 1 << 16, |part| {
            vertices[part]
                .iter()
                .map(|&p| (p - frame.origin).abs().max_element())
                .fold(0.0, f64::max)
        });
        let farthest = farthest.into_iter().fold(0.0, f64::max);
        let largest = frame.origin.abs().max_element();
        // The subtraction of the origin errs relative to its result; the
        // rest relative to the largest offset.
        let error = RELATIVE_ERROR * farthest.max(f64::MIN_POSITIVE) + f64::MIN_POSITIVE;
        let error = if largest.is_finite() { error } else { f64::INFINITY };
        let mut coordinates = ViewCoordinates {
            frame: *frame,
            points,
            error,
            rounding: Rounding::for_ranges([0.0..0.0, 0.0..0.0, 0.0..0.0]),
        };
        coordinates.rounding = coordinates.range();
        coordinates
    }

    /// A rounding around all vertices in front of the eye.
    fn range(&self) -> Rounding {
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let join = |a: (DVec3, DVec3), b: (DVec3, DVec3)| (a.0.min(b.0), a.1.max(b.1));
        let (low, high) = map_chunks(self.points.len(), 1 << 16, |part| {
            part.filter_map(|i| self.interval(i as u32)).fold(empty, join)
        })
        .into_iter()
        .fold(empty, join);
        if low.x > high.x {
            return Rounding::for_ranges([0.0..0.0, 0.0..0.0, 0.0..0.0]);
        }
        Rounding::for_ranges([low.x..high.x, low.y..high.y, low.z..high.z])
    }

    /// Coordinates along right, up and forward of a vertex.
    pub fn point(&self, vertex: u32) -> DVec3 {
        self.points[vertex as usize]
    }

    /// Image and depth of a point given along right, up and forward.
    pub fn project(&self, point: DVec3) -> (DVec2, f64) {
        let image = match self.frame.projection {
            Projection::Orthographic => point.truncate(),
            Projection::Perspective => point.truncate() / point.z,
        };
        (image, point.z)
    }

    /// A bound of the error of an image coordinate of a point on a line
    /// between vertices, given along right, up and forward.
    pub fn image_slack(&self, point: DVec3) -> f64 {
        // A point on a line errs like its ends, and by the rounding of its
        // parameter and of the interpolation.
        let error = 4.0 * self.error;
        match self.frame.projection {
            Projection::Orthographic => error,
            Projection::Perspective => {
                let largest = point.truncate().abs().max_element() / point.z;
                error * (1.0 + largest) / (point.z - error).max(f64::MIN_POSITIVE)
                    + largest * f64::EPSILON
            }
        }
    }

    /// Low and high coordinates (u, v, depth) of a vertex; nothing if it may
    /// lie on or behind the plane of a perspective eye.
    #[inline]
    fn interval(&self, vertex: u32) -> Option<(DVec3, DVec3)> {
        self.interval_of(self.rough_vertex(vertex))
    }

    /// The same for any point.
    #[inline(always)]
    fn interval_of(&self, RoughPoint { at: point, error }: RoughPoint) -> Option<(DVec3, DVec3)> {
        match self.frame.projection {
            Projection::Orthographic => {
                let slack = DVec3::splat(error);
                Some((point - slack, point + slack))
            }
            Projection::Perspective => {
                if point.z <= error * 4096.0 {
                    return None;
                }
                let (image, depth) = self.project(point);
                // d(x / z) <= (dx + |x / z| dz) / (z - dz), and one rounding.
                let scale = 1.001 * error / point.z;
                let slack = (DVec2::ONE + image.abs()) * scale + image.abs() * f64::EPSILON;
                let slack = slack.extend(error);
                let middle = image.extend(depth);
                Some((middle - slack, middle + slack))
            }
        }
    }

    /// A vertex in the image, with a depth that is linear along the images of
    /// lines and planes: for a perspective eye, what is far away is near 0, and
    /// all else below. Nothing if it may lie on or behind the eye's plane.
    #[inline]
    pub fn placed(&self, vertex: u32) -> Option<Placed> {
        let (low, high) = self.interval(vertex)?;
        let slack = high - low;
        let point = self.points[vertex as usize];
        let (image, depth) = self.project(point);
        let image_slack = slack.truncate().max_element();
        Some(match self.frame.projection {
            Projection::Orthographic => {
                Placed { at: image.extend(depth), image_slack, depth_slack: slack.z }
            }
            Projection::Perspective => {
                // d(1 / z) <= dz / (z (z - dz)), and one rounding.
                let depth_slack = (1.001 * self.error / depth + f64::EPSILON) / depth;
                Placed { at: image.extend(-1.0 / depth), image_slack, depth_slack }
            }
        })
    }

    /// The range of a vertex's place along an axis of the image that no
    /// model is likely to be aligned with.
    #[inline]
    fn across(&self, vertex: u32) -> Option<[f64; 2]> {
        /// A direction one radian from the horizontal.
        const AXIS: DVec2 = DVec2::new(0.540_302_305_868_139_8, 0.841_470_984_807_896_5);
        let (low, high) = self.interval(vertex)?;
        let (low, high) = (low.truncate(), high.truncate());
        // Three roundings, each relative to one of the products.
        let slack = 4.0 * f64::EPSILON * low.abs().max(high.abs()).element_sum();
        Some([low.dot(AXIS) - slack, high.dot(AXIS) + slack])
    }

    /// Which of three vertices lies between the other two in a sweep across
    /// the image; nothing if rounded coordinates do not tell, or one of them
    /// may lie behind the eye.
    #[inline]
    pub fn middle_across(&self, vertices: [u32; 3]) -> Option<u32> {
        let [a, b, c] = vertices;
        let [at_a, at_b, at_c] = [self.across(a)?, self.across(b)?, self.across(c)?];
        let between = |low: [f64; 2], middle: [f64; 2], high: [f64; 2]| {
            (low[1] < middle[0] && middle[1] < high[0])
                || (high[1] < middle[0] && middle[1] < low[0])
        };
        if between(at_a, at_b, at_c) {
            Some(b)
        } else if between(at_b, at_a, at_c) {
            Some(a)
        } else {
            between(at_a, at_c, at_b).then_some(c)
        }
    }

    /// Whether a vertex lies behind a perspective eye for certain.
    fn is_behind(&self, vertex: u32) -> bool {
        self.frame.projection == Projection::Perspective
            && self.points[vertex as usize].z < -self.error
    }

    /// A box around the image and depths of the convex hull of vertices, as
    /// far as it lies in front of the eye. Rounded outward.
    #[inline]
    pub fn bounds<const N: usize>(&self, vertices: [u32; N]) -> Bounds {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for vertex in vertices {
            let Some(own) = self.interval(vertex) else {
                return self.bounds_across_eye(&vertices);
            };
            low = low.min(own.0);
            high = high.max(own.1);
        }
        self.rounding.around(low, high)
    }

    /// The boxes of all vertices, for many questions. O(n).
    pub fn vertex_boxes(&self) -> VertexBoxes<'_> {
        let boxes = map_small(self.points.len(), |vertex| {
            let interval = self.interval(vertex as u32);
            interval.map_or(Bounds::EMPTY, |(low, high)| self.rounding.around(low, high))
        });
        VertexBoxes { coordinates: self, boxes }
    }

    /// The box of something that reaches the plane of the eye: its image
    /// may be anywhere, its depth is bounded from above.
    fn bounds_across_eye(&self, vertices: &[u32]) -> Bounds {
        if vertices.iter().all(|&vertex| self.is_behind(vertex)) {
            return Bounds::EMPTY;
        }
        let deepest = vertices.iter().map(|&v| self.points[v as usize].z).fold(0.0, f64::max);
        let mut bounds = Bounds::ALL;
        bounds.high[2] = self.rounding.up(2, deepest, self.error);
        bounds
    }

    /// About where a vertex lies, in the coordinates of boxes; anywhere, if
    /// it has no image.
    pub fn place(&self, vertex: u32) -> Vec3A {
        let (image, depth) = self.project(self.points[vertex as usize]);
        let nearest = |axis, value| self.rounding.nearest(axis, value);
        Vec3A::new(nearest(0, image.x), nearest(1, image.y), nearest(2, depth))
    }

    /// A probe for the segment between two points given along right, up and
    /// forward, which are off by at most `slack` more than vertices are.
    pub fn probe(&self, ends: [u32; 2]) -> SegmentProbe {
        let bounds = self.bounds(ends);
        let [start, end] = ends.map(|vertex| {
            let (image, _) = self.project(self.points[vertex as usize]);
            [self.rounding.nearest(0, image.x), self.rounding.nearest(1, image.y)]
        });
        if bounds.low[0] == f32::NEG_INFINITY {
            // Crosses the plane of the eye: its ends have no images.
            return SegmentProbe::new(bounds, [f32::NAN; 2], [f32::NAN; 2]);
        }
        SegmentProbe::new(bounds, start, end)
    }

    /// A vertex.
    #[inline(always)]
    pub fn rough_vertex(&self, vertex: u32) -> RoughPoint {
        RoughPoint { at: self.points[vertex as usize], error: self.error }
    }

    /// The point at a share of the way from one vertex to another, a number
    /// from 0 to 1 that may be off by some of that.
    pub fn rough_between(&self, [from, to]: [u32; 2], share: f64, off: f64) -> RoughPoint {
        let from = self.points[from as usize];
        let way = self.points[to as usize] - from;
        // The way rounds, is multiplied and added.
        let error = 4.0 * self.error + 1.001 * off * way.abs().max_element();
        RoughPoint { at: from + way * share, error }
    }

    /// A probe for the segment between two points, and the boxes around its
    /// ends; nothing where one of them may lie on or behind the plane of the
    /// eye.
    pub fn rough_probe(&self, ends: [RoughPoint; 2]) -> Option<(SegmentProbe, [Bounds; 2])> {
        /// A probe allows its ends to be off by so much, in a picture of size two.
        const MOST: f32 = 2e-7;
        let [start, end] = [self.interval_of(ends[0])?, self.interval_of(ends[1])?];
        let boxes = [start, end].map(|(low, high)| self.rounding.around(low, high));
        let images = ends.map(|end| {
            let (image, _) = self.project(end.at);
            [self.rounding.nearest(0, image.x), self.rounding.nearest(1, image.y)]
        });
        let is_near = |own: &Bounds| {
            let size = own.high - own.low;
            size.x.max(size.y) < MOST
        };
        let around = boxes[0].union(&boxes[1]);
        let [from, to] = if boxes.iter().all(is_near) { images } else { [[f32::NAN; 2]; 2] };
        Some((SegmentProbe::new(around, from, to), boxes))
    }
}
