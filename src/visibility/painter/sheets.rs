//! Faces as one eye sees them: convex, not edge-on, in front of the near
//! plane.

use super::faces::{Face, Faces};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{InputPlane, PlanePoint, Policy, Predicates};
use crate::polygon::{Cut, PlanePolygon};
use crate::run::{Cancelled, Run, map_chunks};
use crate::spatial::Bounds;
use crate::view::LineQuestion;

/// Faces per task.
const PART: usize = 1 << 12;

/// A polygon to be painted.
#[derive(Debug, Clone)]
pub(super) struct Sheet {
    pub(super) polygon: PlanePolygon,
    /// The number of the face: of two in one plane that overlap, the one with
    /// the lesser is seen.
    pub(super) face: u32,
    /// Never zero.
    pub(super) facing: Sign,
    /// A box around the image, flat. That of the whole face does for pieces.
    pub(super) bounds: Bounds,
    /// The corner that is least deep.
    pub(super) nearest: PlanePoint,
    /// The deepest corner.
    pub(super) farthest: PlanePoint,
}

impl Sheet {
    /// The same with another polygon, which is a piece of this one.
    fn piece<P: Policy>(&self, predicates: &Predicates<'_, P>, polygon: PlanePolygon) -> Self {
        let [nearest, farthest] = depths(predicates, &polygon);
        Sheet { polygon, nearest, farthest, ..self.clone() }
    }

    /// The pieces into which the plane of another sheet cuts this one, if it
    /// does: first what lies beyond, so that windings decide nothing.
    pub(super) fn cut_by<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        other: &Sheet,
    ) -> Option<[Sheet; 2]> {
        let Cut::Parted(parts) = self.polygon.cut(predicates, other.polygon.plane().into()) else {
            return None;
        };
        // Beyond a plane its functional has the sign of the facing.
        let [below, above] = parts.map(|part| self.piece(predicates, part));
        Some(if other.facing == Sign::Negative { [below, above] } else { [above, below] })
    }

    /// What it takes in memory.
    pub(super) fn bytes(&self) -> usize {
        size_of::<Self>() + self.polygon.heap_bytes()
    }

    /// The planes through the eye and its sides.
    pub(super) fn shadow(
        &self,
    ) -> impl Iterator<Item = (crate::kernel::predicates::Plane, Sign)> + '_ {
        self.polygon.shadow(self.facing)
    }
}

/// All faces that have an image, in the order of their numbers. O(n).
pub(super) fn sheets<P: Policy>(
    question: &LineQuestion<'_>,
    faces: &Faces,
    run: &Run<'_>,
) -> Result<Vec<Sheet>, Cancelled> {
    let parts = map_chunks(faces.list.len(), PART, |part| {
        run.check()?;
        run.advance(part.len() as u64);
        let predicates = Predicates::<P>::new(question.points);
        let sheet = |i| sheet(question, &predicates, i as u32, &faces.list[i]);
        let sheets: Vec<Sheet> = part.filter_map(sheet).collect();
        run.merge(&predicates.counters());
        Ok(sheets)
    });
    let mut sheets = Vec::new();
    for part in parts {
        let part = part?;
        run.take(part.iter().map(|sheet: &Sheet| sheet.bytes() as u64).sum())?;
        sheets.extend(part);
    }
    Ok(sheets)
}

fn sheet<P: Policy>(
    question: &LineQuestion<'_>,
    predicates: &Predicates<'_, P>,
    number: u32,
    face: &Face,
) -> Option<Sheet> {
    let facing = predicates.facing(face.polygon.face);
    if facing.is_zero() {
        return None;
    }
    let polygon = in_front(predicates, face.polygon.clone())?;
    let [nearest, farthest] = depths(predicates, &polygon);
    let bounds = bounds(question, &face.polygon);
    Some(Sheet { polygon, face: number, facing, bounds, nearest, farthest })
}

/// What of a polygon lies in front of the near plane.
pub(super) fn in_front<P: Policy>(
    predicates: &Predicates<'_, P>,
    polygon: PlanePolygon,
) -> Option<PlanePolygon> {
    if !predicates.points().has_near_plane() {
        return Some(polygon);
    }
    match polygon.cut(predicates, InputPlane::Near.into()) {
        Cut::Above => Some(polygon),
        Cut::Parted([_, above]) => Some(above),
        Cut::Below | Cut::Within => None,
    }
}

/// The box around the image of a face whose corners are vertices. A fan of
/// triangles, for some corners may lie behind the eye.
fn bounds(question: &LineQuestion<'_>, polygon: &PlanePolygon) -> Bounds {
    let vertex = |i: usize| match polygon.corners[i].point {
        PlanePoint::Vertex(vertex) => vertex,
        _ => polygon.face[0],
    };
    let fan = (1..polygon.corners.len() - 1).map(|i| [vertex(0), vertex(i), vertex(i + 1)]);
    let boxes = fan.map(|triangle| question.coordinates.bounds(triangle));
    let mut all = boxes.fold(Bounds::EMPTY, |all, bounds| all.union(&bounds));
    (all.low.z, all.high.z) = (0.0, 0.0);
    all
}

/// The nearest and the farthest corner.
fn depths<P: Policy>(predicates: &Predicates<'_, P>, polygon: &PlanePolygon) -> [PlanePoint; 2] {
    let mut found = [polygon.corners[0].point; 2];
    for corner in &polygon.corners[1..] {
        let point = corner.point;
        if predicates.deeper(found[0], point) == Sign::Positive {
            found[0] = point;
        } else if predicates.deeper(point, found[1]) == Sign::Positive {
            found[1] = point;
        }
    }
    found
}
