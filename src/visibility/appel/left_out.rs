//! Lines that have no part in the answer, told without walking them: at the
//! back of a convex part, or beside the part of the image that is wanted.

use crate::model::{FeatureLine, LineOrigin};
use crate::spatial::Placed;
use crate::view::LineQuestion;
use glam::DVec2;

/// Whether a line is an edge that a convex part of its own hides.
pub(super) fn is_at_back(question: &LineQuestion<'_>, line: &FeatureLine) -> bool {
    match (question.convex, line.origin) {
        (Some(parts), LineOrigin::Edge(edge)) => {
            parts.hide_own_edge(question.mesh, question.facing, edge)
        }
        _ => false,
    }
}

/// Whether a line lies wholly outside of the part of the image that is wanted.
pub(super) fn is_outside(question: &LineQuestion<'_>, line: &FeatureLine) -> bool {
    let Some(window) = question.window else { return false };
    let outside = |vertices: &[u32]| {
        let placed = vertices.iter().map(|&vertex| question.coordinates.placed(vertex));
        image_box(placed)
            .is_some_and(|[low, high]| high.cmplt(window[0]).any() || window[1].cmplt(low).any())
    };
    match line.origin {
        LineOrigin::Intersection(index) => {
            let triangles = question.intersections[index as usize].triangles;
            triangles.iter().any(|&triangle| outside(&question.mesh.triangles()[triangle as usize]))
        }
        _ => line.origin.vertices(question.mesh).is_some_and(|ends| outside(&ends)),
    }
}

/// Two corners around the images of points, and around every point between
/// them as a drawing rounds it; nothing if one of them has no image.
fn image_box(points: impl Iterator<Item = Option<Placed>>) -> Option<[DVec2; 2]> {
    /// A point between others is off by at most four times as much as they
    /// are, and twice that is allowed.
    const SLACKS: f64 = 8.0;
    let (mut low, mut high, mut slack) = (DVec2::INFINITY, DVec2::NEG_INFINITY, 0.0);
    for point in points {
        let Placed { at, image_slack, .. } = point?;
        low = low.min(at.truncate());
        high = high.max(at.truncate());
        slack = image_slack.max(slack);
    }
    Some([low - SLACKS * slack, high + SLACKS * slack])
}
