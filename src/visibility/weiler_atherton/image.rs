//! Regions in coordinates of the view frame, rounded once.

use super::RegionsError;
use crate::kernel::predicates::{Chart, Exact, ImagePoint, Predicates};
use crate::model::Object;
use crate::polygon::clipping::{Corner, Polygon, Ring};
use crate::run::map_indexed;
use crate::view::{ImageRegion, ImageRegions, LineQuestion, Projection, VisibleRegions};
use glam::DVec2;

/// Rounds all corners. O(corners).
///
/// # Errors
///
/// If the view is a perspective one without a near plane.
pub fn image_regions(
    question: &LineQuestion<'_>,
    regions: &VisibleRegions,
) -> Result<ImageRegions, RegionsError> {
    let Some(chart) = Chart::new(question.points) else {
        return Err(RegionsError::NoNearPlane);
    };
    let regions = map_indexed(regions.regions().len(), |i| {
        let region = &regions.regions()[i];
        let predicates = Predicates::<Exact>::new(question.points);
        let rounder = Rounder { question, chart: &chart, predicates };
        ImageRegion {
            face: region.face,
            object: region.object,
            normal: region.normal,
            color: question.mesh.color_of(region.face),
            polygons: region.polygons.iter().map(|polygon| rounder.polygon(polygon)).collect(),
        }
    });
    let anchor = |object: &Object| {
        let first = question.coordinates.point(object.vertices.start);
        let place = question.coordinates.project(first).0;
        if place.is_finite() { place } else { DVec2::ZERO }
    };
    let has_vertex = |object: &Object| !object.vertices.is_empty();
    let objects = question.mesh.objects().iter();
    let anchors = objects
        .map(|object| if has_vertex(object) { anchor(object) } else { DVec2::ZERO })
        .collect();
    Ok(ImageRegions { regions, anchors })
}

struct Rounder<'a, 'q> {
    question: &'a LineQuestion<'q>,
    chart: &'a Chart,
    predicates: Predicates<'q, Exact>,
}

impl Rounder<'_, '_> {
    fn polygon(&self, polygon: &Polygon) -> Vec<Vec<DVec2>> {
        let corner = |corner: &Corner| self.point(corner.point);
        let ring = |ring: &Ring| ring.iter().map(corner).collect();
        polygon.rings.iter().map(ring).collect()
    }

    /// The image of a point. That of a vertex is as lines have it.
    fn point(&self, point: ImagePoint) -> DVec2 {
        let coordinates = self.question.coordinates;
        let ImagePoint::Crossing(_) = point else {
            let ImagePoint::Vertex(vertex) = point else { return DVec2::NAN };
            return coordinates.project(coordinates.point(vertex)).0;
        };
        let frame = self.question.frame;
        let offset = self.predicates.offset_of_image(self.chart, point);
        let (u, v) = (frame.right.dot(offset), frame.up.dot(offset));
        let depth = frame.forward.dot(offset);
        match frame.projection {
            Projection::Orthographic => {
                let (origin, _) = coordinates.project(coordinates.point(0));
                origin + DVec2::new(u, v) + frame.shear * depth
            }
            Projection::Perspective => DVec2::new(u, v) / depth,
        }
    }
}
