//! Triangulation of a polygon with holes, using its own corners only.
//!
//! A face of a model is a list of rings in space: the outer one first, then
//! its holes. It is cut into triangles as it shows along one direction, and
//! every decision is an exact sign in that projection:
//!
//! 1. The [`axis`] along which the outer ring is largest is taken. (A polygon
//!    that is not planar, and has corners fall together or edges cross there,
//!    is looked at along its own normal.)
//! 2. A quadrilateral is cut along a diagonal; one ring that is star-shaped
//!    from its least corner becomes a fan: all triangles of a convex face, by
//!    far the most frequent case.
//! 3. Of anything else only what bounds is kept, its [`Outline`]: an edge
//!    that is walked both ways, such as the bridge to a hole, bounds nothing.
//!    It becomes a constrained Delaunay triangulation ([`delaunay`], in
//!    `spade`) or, where coordinates span more orders than that decides
//!    exactly, or edges seem to cross, one by sweeping ([`sweep`]). Triangles
//!    inside are kept.
//!
//! So rings may touch themselves and one another in corners and along edges,
//! and may run out and back. What lies inside is what the outer ring goes
//! around an odd number of times and no hole goes around: a hole that lies
//! outside or within another takes nothing away. Edges that cross are refused;
//! [`super::uncross`] makes corners of their crossings.
//!
//! Corners in the middle of an edge are corners of triangles too, so that
//! neighbours that use these corners fit without T-junctions. Nothing is
//! rounded.
//!
//! What comes out depends on where the corners are, and on nothing else: not
//! on the corner at which a ring begins, on its direction or on the order of
//! holes. Where more than one answer is as good, coordinates decide.

mod axis;
mod curve;
mod delaunay;
mod fan;
mod outline;
mod projection;
mod sweep;

pub(super) use outline::Outline;
pub(super) use projection::Projection;

use crate::kernel::numbers::Sign;
use glam::DVec3;

/// What a polygon was cut into.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Triangles {
    /// Corner numbers, running over all rings in their order. All triangles
    /// turn the way the outer ring turns in the projection. Where rings
    /// touch in a corner, the least of its numbers stands for it.
    pub corners: Vec<[u32; 3]>,
    /// Whether all corners lie in one plane, exactly.
    pub is_planar: bool,
}

/// Why a polygon could not be cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TriangulationError {
    /// There is no ring, or the ring of this number has fewer than three corners.
    #[error("ring {0} has fewer than three corners")]
    TooFewCorners(usize),
    /// The ring of this number has a coordinate that is infinite or not a number.
    #[error("ring {0} has a coordinate that is not finite")]
    NotFinite(usize),
    /// Nothing lies inside.
    #[error("the rings enclose no area")]
    ZeroArea,
    /// An edge of the ring of this number crosses another edge.
    #[error("an edge of ring {0} crosses another edge")]
    Crossing(usize),
    /// Corners in different places fall together in all projections.
    #[error("corners fall together however the polygon is looked at")]
    Coincident,
}

/// Cuts the polygon with these rings, the outer one first, into triangles
/// of its corners. Rings are not closed by a repeated corner, may turn either
/// way, and may touch themselves and one another; inside is what the outer
/// ring goes around an odd number of times and no other ring goes around.
/// O(n log n) as a rule, O(n) for convex faces.
///
/// # Errors
///
/// Where the rings enclose nothing, cross, or are not rings:
/// [`TriangulationError`]. No input panics.
///
/// ```
/// use glam::dvec3;
/// use umriss::polygon::triangulate;
///
/// let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
/// let triangles = triangulate(&[square.map(|(x, y)| dvec3(x, y, 7.0))])?;
/// assert_eq!(triangles.corners, [[0, 1, 2], [0, 2, 3]]);
/// assert!(triangles.is_planar);
/// # Ok::<(), umriss::polygon::TriangulationError>(())
/// ```
pub fn triangulate<R: AsRef<[DVec3]>>(rings: &[R]) -> Result<Triangles, TriangulationError> {
    check(rings)?;
    if let [ring] = rings
        && let Some(triangles) = fan::triangulate(ring.as_ref())
    {
        return Ok(triangles);
    }
    let corners = corners_of(rings);
    let outer = rings[0].as_ref().len();
    let (projection, _) =
        Projection::along_best_axis(&corners, outer).ok_or(TriangulationError::ZeroArea)?;
    let is_planar = projection.is_planar(&corners);
    let mut found = cut(rings, &corners, &projection);
    if found.is_err()
        && !is_planar
        && let Some(other) = Projection::along_normal(&corners, outer)
        && let Ok(triangles) = cut(rings, &corners, &other)
    {
        found = Ok(triangles);
    }
    Ok(Triangles { corners: found?, is_planar })
}

/// As [`triangulate`], for an axis that is known to be a good one to look
/// along: 0, 1 or 2.
///
/// # Errors
///
/// As [`triangulate`].
pub fn triangulate_along<R: AsRef<[DVec3]>>(
    axis: usize,
    rings: &[R],
) -> Result<Triangles, TriangulationError> {
    check(rings)?;
    let corners = corners_of(rings);
    let projection = Projection::along_axis(&corners, rings[0].as_ref().len(), axis)
        .ok_or(TriangulationError::ZeroArea)?;
    let is_planar = projection.is_planar(&corners);
    Ok(Triangles { corners: cut(rings, &corners, &projection)?, is_planar })
}

fn corners_of<R: AsRef<[DVec3]>>(rings: &[R]) -> Vec<DVec3> {
    rings.iter().flat_map(|ring| ring.as_ref()).copied().collect()
}

/// The triangles of a polygon in a projection.
fn cut<R: AsRef<[DVec3]>>(
    rings: &[R],
    corners: &[DVec3],
    projection: &Projection,
) -> Result<Vec<[u32; 3]>, TriangulationError> {
    let outline = Outline::new(rings, corners, projection)?;
    // Edges may cross where they lie on others and bound nothing together with
    // them, which the sweep alone can tell.
    let triangles = match delaunay::triangulate(&outline) {
        Some(Ok(triangles)) => triangles,
        None | Some(Err(_)) => sweep::triangulate(&outline)?,
    };
    if triangles.is_empty() {
        return Err(TriangulationError::ZeroArea);
    }
    let is_clockwise = projection.turn == Sign::Negative;
    let corners_of = |[a, b, c]: [u32; 3]| {
        let corners = [a, b, c].map(|point| outline.corners[point as usize]);
        let [a, b, c] = least_first(corners);
        if is_clockwise { [a, c, b] } else { [a, b, c] }
    };
    let mut triangles: Vec<[u32; 3]> = triangles.into_iter().map(corners_of).collect();
    triangles.sort_unstable();
    Ok(triangles)
}

/// The rings of a plane polygon as rings in the plane `z = 0`, without
/// their closing corners.
pub fn rings_of(polygon: &geo::Polygon<f64>) -> Vec<Vec<DVec3>> {
    let open = |ring: &geo::LineString<f64>| -> Vec<DVec3> {
        let corners = ring.0.len() - usize::from(ring.is_closed() && ring.0.len() > 1);
        ring.0[..corners].iter().map(|corner| DVec3::new(corner.x, corner.y, 0.0)).collect()
    };
    std::iter::once(polygon.exterior()).chain(polygon.interiors()).map(open).collect()
}

/// Refuses what has no corners or no position.
fn check<R: AsRef<[DVec3]>>(rings: &[R]) -> Result<(), TriangulationError> {
    if rings.is_empty() {
        return Err(TriangulationError::TooFewCorners(0));
    }
    for (number, ring) in rings.iter().map(AsRef::as_ref).enumerate() {
        if ring.len() < 3 {
            return Err(TriangulationError::TooFewCorners(number));
        }
        if !ring.iter().all(|corner| corner.is_finite()) {
            return Err(TriangulationError::NotFinite(number));
        }
    }
    Ok(())
}

/// The same cycle, beginning with its least number.
fn least_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

#[cfg(test)]
mod tests;
