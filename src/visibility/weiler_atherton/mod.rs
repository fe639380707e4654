//! Visible regions: what is seen of each face, as exact polygons.
//!
//! The idea is Weiler's and Atherton's: cut polygons in the image by the
//! outlines of polygons in front of them, always by *original* ones, never
//! by fragments. So every corner of a region is a corner of the input or the
//! crossing of two lines of the input, however many clips there were.
//!
//! They go through a list from front to back, cut all that follows by the
//! image of the first, and set right by recursion where the list was wrong.
//! Here each face is a list of its own, because then faces can be worked on
//! side by side and no order has to be right:
//!
//! 1. Find the triangles whose boxes overlap the face's, through the
//!    hierarchy: windows in the image, so that the cost follows what
//!    overlaps ([`hiding`]).
//! 2. Of each of them take what lies in front. Where two triangles pass
//!    through one another, that is what lies on one side of the common line
//!    of their planes, which is a line of the input too: the one is cut by the
//!    whole plane of the other, as the original does before it begins.
//!    Triangles in one plane follow the tie rule.
//! 3. If one of them covers the face, leave. If there is none, the face is
//!    its own region. Else clip: the face minus the union of all that
//!    ([`cover`]).
//! 4. Merge the triangles of a planar polygon, so that what comes out does
//!    not depend on how it was cut into triangles.
//!
//! What is in front of a triangle is decided for convex originals, of which
//! one is in front of the other throughout or the line of their planes
//! divides them; polygons with holes and concave ones come as their
//! triangles. So the case for which the original needs its stack, concave
//! polygons that overlap alternately, does not arise, and cycles are no
//! case at all, for nothing is sorted.
//!
//! Expected O(n log n + k log k) for n triangles and k crossings of their
//! images within visible or hidden faces; independent of the number of threads.
//!
//! Sources: K. Weiler and P. Atherton, "Hidden surface removal using polygon
//! area sorting", 1977.

mod borders;
mod cover;
mod hiding;
mod image;
mod lines;
mod outline;
mod place;
mod sides;

pub use image::image_regions;
pub use lines::region_lines;

use crate::kernel::predicates::{Policy, Predicates};
use crate::model::Mesh;
use crate::polygon::clipping::{Clipper, Corner, FillRule, Operand, Operation, Polygon, Ring};
use crate::run::{Cancelled, Run, map_chunks};
use crate::spatial::{Group, Hierarchy};
use crate::view::{LineQuestion, Region, VisibleRegions};
use cover::Cover;
use glam::DVec3;
use hiding::{Hiding, Sheet, hiding};
use outline::{NearSide, left_of, near_side, outline};
use std::cell::Cell;
use std::ops::Range;

/// Faces per task.
const PART: usize = 128;

/// Why there are no regions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum RegionsError {
    /// The run was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The eye is a point and nothing says what lies in front of it.
    #[error("regions of a perspective view need a near plane")]
    NoNearPlane,
    /// A border ends at a corner whose lines say nothing of the place: not
    /// expected of any scene.
    #[error("a border of a region ends at no line: please report it, and take --method appel")]
    Corner,
}

/// A deliberate mistake, to prove that a check can fail. Never set outside
/// of tests of the tests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RegionFault {
    /// Every face forgets one of the faces in front of it.
    ForgetOccluder,
}

impl RegionFault {
    /// The name of the fault on a command line.
    pub fn name(self) -> &'static str {
        match self {
            RegionFault::ForgetOccluder => "forget-occluder",
        }
    }
}

/// How to run [`visible_regions`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RegionOptions {
    /// A mistake to make.
    pub fault: Option<RegionFault>,
}

/// Finds what is seen of every face.
///
/// # Errors
///
/// If the run is cancelled, or the view is a perspective one without a near
/// plane.
pub fn visible_regions<P: Policy>(
    question: &LineQuestion<'_>,
    options: &RegionOptions,
    run: &Run<'_>,
) -> Result<VisibleRegions, RegionsError> {
    let mesh = question.mesh;
    let (sides, groups) = run.stage("planar-faces", mesh.triangles().len() as u64, || {
        (near_sides::<P>(question), planar_faces::<P>(question))
    });
    run.check()?;
    let triangles = question.hierarchy();
    let parts = run.stage("regions", groups.len() as u64, || {
        map_chunks(groups.len(), PART, |part| {
            run.check()?;
            let predicates = Predicates::<P>::new(question.points);
            let Some(clipper) = Clipper::new(&predicates) else {
                return Err(RegionsError::NoNearPlane);
            };
            let clipper = clipper.within(run);
            let mut worker = Worker {
                question,
                triangles,
                options,
                sides: &sides,
                predicates: &predicates,
                clipper,
                cover: Cover::default(),
                clips: 0,
                run,
            };
            let mut regions = Vec::new();
            for group in &groups[part] {
                if let Some(region) = worker.region(group.clone()) {
                    run.take(bytes_of(&region))?;
                    regions.push(region);
                }
                run.advance(1);
                run.check()?;
            }
            run.count("faces-clipped", worker.clips);
            run.merge(&predicates.counters());
            Ok(regions)
        })
    });
    let mut regions = Vec::new();
    for part in parts {
        regions.extend(part?);
    }
    run.count("visible-regions", regions.len() as u64);
    Ok(VisibleRegions::new(regions))
}

/// How each triangle lies to the near plane.
fn near_sides<P: Policy>(question: &LineQuestion<'_>) -> Vec<NearSide> {
    let triangles = question.mesh.triangles();
    if !question.points.has_near_plane() {
        return vec![NearSide::Front; triangles.len()];
    }
    let parts = map_chunks(triangles.len(), 1 << 12, |part| {
        let predicates = Predicates::<P>::new(question.points);
        let side = |triangle: &[u32; 3]| near_side(&predicates, *triangle);
        triangles[part].iter().map(side).collect::<Vec<_>>()
    });
    parts.concat()
}

/// The triangles of each face, if they lie in one plane; else each alone.
fn planar_faces<P: Policy>(question: &LineQuestion<'_>) -> Vec<Range<u32>> {
    let (mesh, predicates) = (question.mesh, Predicates::<P>::new(question.points));
    let count = mesh.triangles().len() as u32;
    let mut groups = Vec::new();
    let mut first = 0;
    while first < count {
        let face = mesh.face_of(first);
        let more = (first + 1..count).take_while(|&t| mesh.face_of(t) == face).count() as u32;
        let end = first + 1 + more;
        let plane = mesh.triangles()[first as usize];
        let others = &mesh.triangles()[first as usize + 1..end as usize];
        let is_in = |x: &u32| plane.contains(x) || predicates.plane(plane, *x).is_zero();
        if others.iter().flatten().all(is_in) {
            groups.push(first..end);
        } else {
            groups.extend((first..end).map(|triangle| triangle..triangle + 1));
        }
        first = end;
    }
    groups
}

/// Works on the faces of one task.
struct Worker<'a, 'q, P: Policy> {
    question: &'a LineQuestion<'q>,
    /// View boxes of all triangles.
    triangles: &'a Hierarchy,
    options: &'a RegionOptions,
    sides: &'a [NearSide],
    predicates: &'a Predicates<'q, P>,
    clipper: Clipper<'a, 'q, P>,
    cover: Cover,
    clips: u64,
    run: &'a Run<'a>,
}

/// What a region takes.
fn bytes_of(region: &Region) -> u64 {
    let rings = region.polygons.iter().flat_map(|polygon| &polygon.rings);
    let corners: usize = rings.map(Vec::len).sum();
    // Lists of corners may have room for twice as many.
    (size_of::<Region>() + 2 * corners * size_of::<Corner>()) as u64
}

impl<P: Policy> Worker<'_, '_, P> {
    /// What is seen of the triangles of a face.
    fn region(&mut self, triangles: Range<u32>) -> Option<Region> {
        let mut parts = Vec::new();
        for triangle in triangles.clone() {
            parts.extend(self.visible_part(triangle));
        }
        if triangles.len() > 1 && parts.len() > 1 {
            parts = self.clipper.operation(Operation::Union, &[Operand::result(&parts)]);
        }
        if parts.is_empty() {
            return None;
        }
        let (mesh, first) = (self.question.mesh, triangles.start);
        Some(Region {
            face: mesh.face_of(first),
            object: mesh.object_of_triangle(first),
            plane: mesh.triangles()[first as usize],
            normal: seen_normal(mesh, first, self.question.facing[first as usize].to_i32()),
            polygons: parts,
            triangles,
        })
    }

    /// A triangle that has an image with an area.
    fn sheet(&self, triangle: u32) -> Option<Sheet> {
        let facing = self.question.facing[triangle as usize];
        let side = self.sides[triangle as usize];
        let corners = self.question.mesh.triangles()[triangle as usize];
        let seen = !facing.is_zero() && side != NearSide::Behind;
        seen.then_some(Sheet { triangle, corners, facing, side })
    }

    fn outline(&self, sheet: &Sheet) -> Ring {
        let Sheet { corners, facing, side, .. } = *sheet;
        outline(self.predicates, self.clipper.chart(), corners, facing, side)
    }

    /// What is seen of one triangle.
    fn visible_part(&mut self, triangle: u32) -> Vec<Polygon> {
        let Some(subject) = self.sheet(triangle) else {
            return Vec::new();
        };
        let mut cover = std::mem::take(&mut self.cover);
        cover.clear();
        let is_hidden = !self.collect(&subject, &mut cover);
        let polygons = if is_hidden {
            Vec::new()
        } else if cover.is_empty() {
            vec![self.alone(&subject)]
        } else {
            let outline = [Polygon { rings: vec![self.outline(&subject)] }];
            let covering = [cover.polygon()];
            self.clips += 1;
            let subject = Operand::new(&outline, FillRule::Positive);
            let clip = Operand::new(&covering, FillRule::Positive);
            self.clipper.operation(Operation::Difference, &[subject, clip])
        };
        self.cover = cover;
        polygons
    }

    /// A whole triangle as clipping would return it: leftmost corner first.
    fn alone(&self, sheet: &Sheet) -> Polygon {
        let mut ring = self.outline(sheet);
        let before = |a: &usize, b: &usize| {
            self.predicates.sweep(self.clipper.chart(), ring[*a].point, ring[*b].point)
        };
        let first = (0..ring.len()).min_by(before).unwrap_or(0);
        ring.rotate_left(first);
        Polygon { rings: vec![ring] }
    }

    /// Collects what lies in front of a triangle; false if one of these
    /// covers it all.
    fn collect(&self, subject: &Sheet, cover: &mut Cover) -> bool {
        let LineQuestion { mesh, coordinates, .. } = *self.question;
        let bounds = coordinates.bounds(subject.corners);
        let is_hidden = Cell::new(false);
        let mut forget = self.options.fault == Some(RegionFault::ForgetOccluder);
        let over = || is_hidden.get() || self.run.is_stopped();
        let may = |group: &Group| if over() { 0 } else { group.hiding(&bounds) };
        self.triangles.visit(may, |other| {
            if other == subject.triangle || over() {
                return;
            }
            let Some(other) = self.sheet(other) else {
                return;
            };
            let hiding = hiding(self.predicates, mesh, subject, &other);
            if hiding != Hiding::Nothing && std::mem::take(&mut forget) {
                return;
            }
            match hiding {
                Hiding::Nothing => {}
                Hiding::Everything => is_hidden.set(true),
                Hiding::Whole => cover.push(self.outline(&other)),
                Hiding::LeftOf(line) => {
                    let whole = self.outline(&other);
                    let part = left_of(self.predicates, self.clipper.chart(), &whole, line);
                    if !part.is_empty() {
                        cover.push(part);
                    }
                }
            }
        });
        !is_hidden.get()
    }
}

/// The normal of a triangle on the side that is seen.
fn seen_normal(mesh: &Mesh, triangle: u32, facing: i32) -> DVec3 {
    let at = |vertex: u32| mesh.vertices()[vertex as usize];
    let [a, b, c] = mesh.triangles()[triangle as usize].map(at);
    // Scaled first, so that products neither vanish nor overflow.
    let (u, v) = (b - a, c - a);
    let [u, v] = [u, v].map(|edge| edge / edge.abs().max_element());
    u.cross(v).normalize_or_zero() * f64::from(facing)
}

#[cfg(test)]
mod tests;
