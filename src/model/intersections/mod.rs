//! Interpenetration: where triangles pass through one another, across all
//! objects of a scene.
//!
//! Two triangles that are not coplanar meet in a segment of the common line
//! of their planes. Its ends are piercings, each the point where an edge of
//! one triangle meets the plane of the other *inside* that other. So all
//! there is to find is which edges pierce which triangles: signs of 4 x 4
//! determinants, no construction (Guigue and Devillers 2003 give a shorter
//! test for whether there is such a segment, but not for its ends). Ends
//! stay symbolic.
//!
//! Touching is no crossing: both triangles must have corners strictly on
//! both sides of the other's plane (`pair`). Two cases of crossing are not seen
//! pair by pair: a surface that passes through a triangle exactly along one of
//! its own edges, and two surfaces that do along edges of both. Then the edge
//! itself is the line, clipped to the triangle or to the other edge (`hinges`).
//! Coplanar triangles make no line.
//!
//! Everything is named, and lines are sorted, by the numbers of vertices, so
//! neither the order of faces nor their winding is to be seen.

mod flat;
mod hinges;
mod pair;

use super::plates::Plates;
use super::{ConvexParts, Fans, FeatureOptions, Hinge, Mesh, ViewCoordinates};
use crate::kernel::predicates::{Carrier, Fold, Points, Policy, Predicates};
use crate::run::{Cancelled, Run, sort_by};
use crate::spatial::{Hierarchy, Related};
use pair::{LINE_BYTES, Search};

/// A segment in which two triangles cross.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IntersectionLine {
    /// The segment; its ends are piercings or vertices.
    pub carrier: Carrier,
    /// The triangles, that with the least vertex first. Where a surface
    /// passes along an edge of its own, one of those that end there.
    pub triangles: [u32; 2],
    /// For each of them that edge, or stretch of a border, if it is so.
    pub along: [Option<Hinge>; 2],
}

impl IntersectionLine {
    /// The triangles of one of the two surfaces that contain the line, each
    /// with its corner off the line if it ends there.
    pub fn faces<'m>(
        &self,
        mesh: &'m Mesh,
        surface: usize,
    ) -> impl Iterator<Item = (u32, Option<u32>)> + 'm {
        let across = self.along[surface].is_none().then_some((self.triangles[surface], None));
        let ending = self.along[surface].into_iter().flat_map(|hinge| mesh.hinge_sides(hinge));
        across.into_iter().chain(ending.map(|(triangle, third)| (triangle, Some(third))))
    }

    /// Whether the surfaces cross at more than the least angle at which that
    /// makes a line: some face of the one and some face of the other.
    pub fn is_fold<P: Policy>(
        &self,
        mesh: &Mesh,
        predicates: &Predicates<'_, P>,
        options: &FeatureOptions,
    ) -> bool {
        let corners = |triangle: u32| mesh.triangles()[triangle as usize];
        self.faces(mesh, 0).any(|(s, _)| {
            self.faces(mesh, 1).any(|(t, _)| {
                let planes = [corners(s), corners(t)];
                Fold::of_planes(predicates, planes, options.intersection_fold()).exceeds
            })
        })
    }
}

/// All crossings of a scene's triangles.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Intersections {
    /// The segments, by the vertices of their triangles.
    pub lines: Vec<IntersectionLine>,
    /// Which edges pierce which triangles.
    pub piercings: EdgePiercings,
    /// Vertices that lie on triangles of which they are no corner, sorted:
    /// all of them, and perhaps others, where fans were known; not worked out
    /// where not.
    pub touching: Vec<u32>,
}

/// The triangles that each edge pierces: its ends lie strictly on both
/// sides of the triangle's plane, and it meets the closed triangle.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct EdgePiercings {
    /// Edge and triangle, sorted.
    pairs: Vec<[u32; 2]>,
}

impl EdgePiercings {
    /// The triangles that `edge` pierces. O(log n).
    pub fn of_edge(&self, edge: u32) -> impl Iterator<Item = u32> + '_ {
        let start = self.pairs.partition_point(|pair| pair[0] < edge);
        self.pairs[start..].iter().take_while(move |pair| pair[0] == edge).map(|pair| pair[1])
    }

    /// The number of piercings.
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Whether no edge pierces a triangle.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }
}

impl Intersections {
    /// Searches all pairs of triangles with overlapping boxes. `hierarchy`
    /// holds boxes of the mesh's triangles; pairs at one of the fans need no
    /// test, nor do those of one convex part. Flat faces whose triangles boxes
    /// cannot take apart are looked at as a whole (`flat`). Expected
    /// O(n log n + pairs).
    ///
    /// # Errors
    ///
    /// If the run is cancelled or the crossings are more than it may hold.
    pub fn find<P: Policy>(
        mesh: &Mesh,
        points: &Points,
        hierarchy: &Hierarchy,
        known: Known<'_>,
        run: &Run,
    ) -> Result<Self, Cancelled> {
        let start = || Search::<P>::new(mesh, points, known, run);
        let plates = Plates::find(mesh, &Predicates::<P>::new(points), hierarchy.items(), run);
        run.check()?;
        let parts = match &plates {
            None => pairs(mesh, hierarchy, known, start, run)?,
            Some(plates) => {
                let others = hierarchy.items().iter().copied();
                let others = others.filter(|&triangle| !plates.has(triangle)).collect();
                let others = plates.boxes().hierarchy(others);
                let mut parts = pairs(mesh, &others, known, &start, run)?;
                parts.extend(flat::add_plates(mesh, plates, &others, start, run));
                parts
            }
        };
        Intersections::gather(mesh, parts, run)
    }

    /// Joins what workers found.
    fn gather<P: Policy>(
        mesh: &Mesh,
        parts: Vec<Search<'_, P>>,
        run: &Run,
    ) -> Result<Self, Cancelled> {
        let mut intersections = Intersections::default();
        let mut tested = 0;
        // Parts are copied into one list each, and only then freed.
        let lines: usize = parts.iter().map(|part| part.lines.len()).sum();
        let piercings: usize = parts.iter().map(|part| part.piercings.len()).sum();
        run.take((lines * LINE_BYTES) as u64)?;
        intersections.lines.reserve_exact(lines);
        intersections.piercings.pairs.reserve_exact(piercings);
        for mut part in parts {
            part.account_for_all()?;
            run.merge(&part.predicates.counters());
            intersections.lines.extend(part.lines);
            intersections.piercings.pairs.extend(part.piercings);
            intersections.touching.extend(part.touching);
            tested += part.tested;
        }
        // What is equal is the same.
        let key = |line: &IntersectionLine| {
            let corners = line.triangles.map(|triangle| sorted_corners(mesh, triangle));
            (corners, line.carrier.ends, line.triangles)
        };
        sort_by(&mut intersections.lines, |a, b| key(a).cmp(&key(b)));
        intersections.lines.dedup();
        sort_by(&mut intersections.piercings.pairs, Ord::cmp);
        intersections.piercings.pairs.dedup();
        intersections.touching.sort_unstable();
        intersections.touching.dedup();
        run.count("triangle-pairs-tested", tested);
        run.count("intersection-segments", intersections.lines.len() as u64);
        run.count("edge-piercings", intersections.piercings.len() as u64);
        Ok(intersections)
    }
}

/// Looks at all pairs of triangles in a hierarchy with overlapping boxes.
fn pairs<'p, P: Policy>(
    mesh: &Mesh,
    hierarchy: &Hierarchy,
    known: Known<'_>,
    start: impl Fn() -> Search<'p, P> + Sync + Send,
    run: &Run<'_>,
) -> Result<Vec<Search<'p, P>>, Cancelled> {
    let found = |search: &mut Search<'_, P>, s: u32, t: u32| {
        search.add_pair([s.min(t), s.max(t)]);
    };
    let Some(fans) = known.fans else {
        return Ok(hierarchy.overlapping_pairs(run, start, found));
    };
    // The triangles of a fan meet in what they share.
    let hubs = |triangle: u32| {
        mesh.triangles()[triangle as usize].map(|corner| fans.is_fan(corner).then_some(corner))
    };
    let bytes = Related::bytes(mesh.triangles().len()) as u64;
    run.take(bytes)?;
    let related = Related::new(hierarchy, hubs);
    let parts = hierarchy.unrelated_pairs(&related, run, start, found);
    run.give_back(bytes);
    Ok(parts)
}

/// What is known of a mesh and spares tests.
#[derive(Debug, Clone, Copy, Default)]
pub struct Known<'a> {
    /// How triangles lie around their vertices in the image. With it,
    /// vertices that touch triangles are told too.
    pub fans: Option<&'a Fans>,
    /// Parts that do not pass through themselves.
    pub convex: Option<&'a ConvexParts>,
}

/// The vertices of a triangle in ascending order.
fn sorted_corners(mesh: &Mesh, triangle: u32) -> [u32; 3] {
    let mut corners = mesh.triangles()[triangle as usize];
    corners.sort_unstable();
    corners
}

/// View boxes of the triangles of a mesh, of all or of some, in a hierarchy.
pub fn triangle_hierarchy(
    mesh: &Mesh,
    coordinates: &ViewCoordinates,
    some: Option<Vec<u32>>,
) -> Hierarchy {
    let triangles = mesh.triangles();
    let boxes = coordinates.vertex_boxes();
    let place = |i: usize| boxes.place(triangles[i][0]);
    let around = |i: usize| boxes.around(triangles[i]);
    match some {
        Some(some) => Hierarchy::of_some(some, place, around),
        None => Hierarchy::of(triangles.len(), place, around),
    }
}

#[cfg(test)]
mod tests;
