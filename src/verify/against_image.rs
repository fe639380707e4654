//! The middles of pieces against an image of nearest triangles.
//!
//! The pixel of a middle names the triangle nearest at the pixel's centre.
//! If that triangle covers the middle too and its plane lies in front of
//! it, the middle is hidden for certain. If it covers the middle and does
//! not lie in front, or if there is no triangle, the middle is visible
//! unless something begins between the centre and the middle: then the
//! answer is only given where no effective edge and no intersection line
//! passes nearby. If the triangle does not cover the middle, an edge lies
//! between, and there is no answer.

use super::places::Places;
use crate::kernel::predicates::Policy;
use crate::model::{FeatureLine, LineClass, LineOrigin, Mesh, View};
use crate::raster::{BoxTree, Probe, Samples, SheetCounter, ray_cast_at};
use crate::run::{Cancelled, Run};
use crate::spatial::Bounds;
use crate::view::LineQuestion;
use glam::{DVec2, DVec3};

/// Pixels that must lie between a middle and an edge.
const BAND: f64 = 1.5;

/// What the image says about a middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    /// A triangle lies in front of it.
    Hidden,
    /// None does.
    Visible,
    /// The image is too coarse to tell.
    Skipped,
}

/// Pixels of an image and the edges at which it may change between two samples.
#[derive(Debug)]
pub(super) struct ImageCheck {
    samples: Samples,
    /// Pixels, sorted, and the nearest triangle at each.
    pixels: Vec<[u32; 2]>,
    nearest: Vec<Option<u32>>,
    edges: Vec<(LineOrigin, [DVec2; 2])>,
    tree: BoxTree,
}

impl ImageCheck {
    /// Casts a ray for each pixel in which one of the points lies that will
    /// be asked about, and no other.
    pub(super) fn new<P: Policy>(
        view: &View,
        question: &LineQuestion<'_>,
        samples: Samples,
        points: impl Iterator<Item = DVec2>,
        run: &Run<'_>,
    ) -> Result<Self, Cancelled> {
        let pixels = points.filter_map(|point| samples.pixel_of(point));
        let mut pixels: Vec<[u32; 2]> = pixels.collect();
        pixels.sort_unstable();
        pixels.dedup();
        let nearest = ray_cast_at::<P>(view, question, &samples, &pixels, run)?;
        let places = Places::<P>::new(question);
        let coordinates = question.coordinates;
        let effective = question.effective.iter().map(|effective| {
            let ends = question.mesh.edges().ends(effective.edge);
            let ends = ends.map(|vertex| coordinates.point(vertex));
            (LineOrigin::Edge(effective.edge), ends)
        });
        let intersections = (0..question.intersections.len() as u32).map(|index| {
            let origin = LineOrigin::Intersection(index);
            let class = LineClass::Intersection;
            (origin, places.ends_of(&FeatureLine { origin, class }))
        });
        let in_front = |(origin, ends)| {
            let ends = in_front(question, ends)?;
            let image = ends.map(|end| coordinates.project(end).0);
            Some((origin, image))
        };
        let edges: Vec<_> = effective.chain(intersections).filter_map(in_front).collect();
        let boxes = edges.iter().map(|(_, [a, b])| image_box(a.min(*b), a.max(*b)));
        let tree = BoxTree::new(boxes.collect());
        Ok(ImageCheck { samples, pixels, nearest, tree, edges })
    }

    /// What the image says about the point `probe` of a line, whose image
    /// is about `point`.
    pub(super) fn verdict<P: Policy>(
        &self,
        counter: &SheetCounter<'_, '_, P>,
        question: &LineQuestion,
        line: &FeatureLine,
        probe: Probe,
        point: DVec2,
    ) -> Verdict {
        let pixel = self.samples.pixel_of(point);
        let Some(Ok(pixel)) = pixel.map(|pixel| self.pixels.binary_search(&pixel)) else {
            return Verdict::Skipped;
        };
        let carrier = question.carrier(line);
        if let Some(triangle) = self.nearest[pixel] {
            if counter.hides(carrier, probe, triangle).contains(&true) {
                return Verdict::Hidden;
            }
            if !counter.covers(carrier, probe, triangle).contains(&true) {
                return Verdict::Skipped;
            }
        }
        if self.is_near_edge(question.mesh, line, point) {
            Verdict::Skipped
        } else {
            Verdict::Visible
        }
    }

    /// Whether the image may change near a point of a line.
    fn is_near_edge(&self, mesh: &Mesh, line: &FeatureLine, point: DVec2) -> bool {
        let own = |origin: LineOrigin| match (line.origin, origin) {
            (LineOrigin::Stretch(index), LineOrigin::Edge(edge)) => {
                mesh.borders().sides(index, true).iter().any(|side| side.edge == edge)
            }
            (own, origin) => own == origin,
        };
        let reach = DVec2::splat(BAND * self.samples.pixel());
        let mut near = false;
        self.tree.in_front(&image_box(point - reach, point + reach), |index| {
            let (origin, [a, b]) = self.edges[index as usize];
            near |= !own(origin) && distance(point, a, b) < reach.x;
        });
        near
    }
}

/// The part of a segment in front of the eye.
fn in_front(question: &LineQuestion, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
    if !question.points.is_perspective() {
        return Some([a, b]);
    }
    let least = 1e-9 * a.abs().max(b.abs()).max_element();
    let clip = |inner: DVec3, outer: DVec3| {
        if inner.z > least {
            inner
        } else {
            inner.lerp(outer, (least - inner.z) / (outer.z - inner.z))
        }
    };
    (a.z > least || b.z > least).then(|| [clip(a, b), clip(b, a)])
}

/// A box in the image, at all depths, with room for rounding.
fn image_box(low: DVec2, high: DVec2) -> Bounds {
    let (low, high) = (low.as_vec2(), high.as_vec2());
    Bounds {
        low: [low.x.next_down(), low.y.next_down(), f32::NEG_INFINITY].into(),
        high: [high.x.next_up(), high.y.next_up(), f32::INFINITY].into(),
    }
}

/// The distance of a point from a segment.
fn distance(point: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let share = if length > 0.0 { ((point - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    point.distance(a + along * share)
}
