//! The faces of a mesh as convex parts, in the order of the tie rule. No eye
//! comes into it.
//!
//! The tie rule names triangles, and a part may be several. Where two parts in
//! one plane overlap and neither has all the preferred triangles, they are
//! painted as triangles; anywhere else the triangles of a part stay together.

use super::flats::flats;
use crate::kernel::predicates::{Policy, Predicates};
use crate::model::Mesh;
use crate::polygon::{FaceParts, PlanePolygon, face_parts};
use crate::run::{Cancelled, Run, map_chunks};
use crate::spatial::{Bounds, Hierarchy, Rounding};
use crate::view::{LineQuestion, PaintedPiece};
use crate::visibility::ties::ranks;
use glam::DVec3;
use std::ops::Range;

/// Triangles per task.
const PART: usize = 1 << 12;

/// A convex part of a face.
#[derive(Debug, Clone)]
pub(super) struct Face {
    pub(super) polygon: PlanePolygon,
    /// The triangles it is made of.
    pub(super) triangles: Vec<u32>,
    /// Places in the order of the tie rule of its first and last triangle.
    ranks: [u32; 2],
    /// All triangles of its face.
    whole: Range<u32>,
    /// The first triangle of its flat area.
    area: u32,
}

/// All parts, by the rank of their first triangles: of two in one plane that
/// overlap, the one with the lesser number is seen.
#[derive(Debug, Clone, Default)]
pub(super) struct Faces {
    pub(super) list: Vec<Face>,
}

impl Face {
    /// A piece of this part for the picture.
    pub(super) fn painted(
        &self,
        question: &LineQuestion<'_>,
        polygon: PlanePolygon,
    ) -> PaintedPiece {
        let (mesh, triangle) = (question.mesh, self.triangles[0]);
        PaintedPiece {
            face: mesh.face_of(triangle),
            object: mesh.object_of_triangle(triangle),
            area: self.area,
            triangle,
            polygon,
        }
    }

    /// Which flat area of the mesh it is a part of.
    pub(super) fn area(&self) -> u32 {
        self.area
    }
}

/// Finds the convex parts of all faces. Expected O(n log n).
pub(super) fn faces<P: Policy>(
    question: &LineQuestion<'_>,
    run: &Run<'_>,
) -> Result<Faces, Cancelled> {
    let mesh = question.mesh;
    let ranks = ranks(mesh);
    let wholes = wholes(mesh);
    let parts = map_chunks(wholes.len(), PART, |part| {
        run.check()?;
        run.advance(part.len() as u64);
        let predicates = Predicates::<P>::new(question.points);
        let mut found = Vec::with_capacity(part.len());
        for whole in &wholes[part] {
            parts_of(&predicates, mesh, &ranks, whole, &mut found);
        }
        run.merge(&predicates.counters());
        Ok(found)
    });
    let mut list = Vec::new();
    for part in parts {
        list.extend(part?);
    }
    let mut faces = Faces { list };
    faces.untie::<P>(question, &ranks, run);
    run.check()?;
    let areas = flats::<P>(question);
    for face in &mut faces.list {
        face.area = areas[face.triangles[0] as usize];
    }
    faces.list.sort_unstable_by_key(|face| face.ranks);
    run.count("painter-parts", faces.list.len() as u64);
    Ok(faces)
}

/// The triangles of each face.
fn wholes(mesh: &Mesh) -> Vec<Range<u32>> {
    let count = mesh.triangles().len() as u32;
    let mut wholes: Vec<Range<u32>> = Vec::new();
    for triangle in 0..count {
        match wholes.last_mut() {
            Some(last) if mesh.face_of(last.start) == mesh.face_of(triangle) => {
                last.end = triangle + 1;
            }
            _ => wholes.push(triangle..triangle + 1),
        }
    }
    wholes
}

fn parts_of<P: Policy>(
    predicates: &Predicates<'_, P>,
    mesh: &Mesh,
    ranks: &[u32],
    whole: &Range<u32>,
    found: &mut Vec<Face>,
) {
    let triangles = &mesh.triangles()[whole.start as usize..whole.end as usize];
    let plane = triangles[0];
    let is_in = |x: &u32| plane.contains(x) || predicates.plane(plane, *x).is_zero();
    let parts = match triangles.iter().flatten().all(is_in) {
        true => FaceParts::Convex,
        false => FaceParts::Triangles,
    };
    found.extend(cut_up(predicates, triangles, parts, ranks, whole));
}

fn cut_up<'a, P: Policy>(
    predicates: &Predicates<'_, P>,
    triangles: &[[u32; 3]],
    parts: FaceParts,
    ranks: &'a [u32],
    whole: &'a Range<u32>,
) -> impl Iterator<Item = Face> + 'a {
    face_parts(predicates, triangles, parts).into_iter().map(move |part| {
        let triangles: Vec<u32> = part.triangles.iter().map(|t| t + whole.start).collect();
        let rank = |triangle: &u32| ranks[*triangle as usize];
        let least = triangles.iter().map(rank).min().unwrap_or(0);
        let most = triangles.iter().map(rank).max().unwrap_or(0);
        let whole = whole.clone();
        Face { polygon: part.polygon, triangles, ranks: [least, most], area: whole.start, whole }
    })
}

impl Faces {
    /// Makes triangles of parts for which the tie rule has no one answer.
    fn untie<P: Policy>(&mut self, question: &LineQuestion<'_>, ranks: &[u32], run: &Run<'_>) {
        if self.list.iter().all(|face| face.triangles.len() == 1) {
            return;
        }
        let tied = self.tied::<P>(question, run);
        if !tied.contains(&true) {
            return;
        }
        let predicates = Predicates::<P>::new(question.points);
        let mut untied = Vec::with_capacity(self.list.len());
        for (face, tied) in std::mem::take(&mut self.list).into_iter().zip(tied) {
            if !tied || face.triangles.len() == 1 {
                untied.push(face);
                continue;
            }
            let range = face.whole.start as usize..face.whole.end as usize;
            let triangles = &question.mesh.triangles()[range];
            let all = cut_up(&predicates, triangles, FaceParts::Triangles, ranks, &face.whole);
            untied.extend(all.filter(|one| face.triangles.contains(&one.triangles[0])));
        }
        self.list = untied;
    }

    /// Which parts overlap one in their plane without all of either's
    /// triangles being preferred.
    fn tied<P: Policy>(&self, question: &LineQuestion<'_>, run: &Run<'_>) -> Vec<bool> {
        let (low, high) = question.mesh.bounds();
        let range = |axis: usize| low[axis]..high[axis];
        let rounding = Rounding::for_ranges([range(0), range(1), range(2)]);
        let bounds = |i: usize| bounds(question.mesh, &rounding, &self.list[i]);
        let boxes: Vec<Bounds> = (0..self.list.len()).map(bounds).collect();
        let hierarchy = Hierarchy::new(&boxes);
        let start = || (Predicates::<P>::new(question.points), Vec::new());
        let found = hierarchy.overlapping_pairs(run, start, |(predicates, found), a, b| {
            if run.is_stopped() {
                return;
            }
            let pair = [a, b].map(|i| &self.list[i as usize]);
            if are_tied(predicates, pair) {
                found.extend([a, b]);
            }
        });
        let mut tied = vec![false; self.list.len()];
        for (_, found) in found {
            found.into_iter().for_each(|i| tied[i as usize] = true);
        }
        tied
    }
}

fn bounds(mesh: &Mesh, rounding: &Rounding, face: &Face) -> Bounds {
    let corners = face.triangles.iter().flat_map(|&t| mesh.triangles()[t as usize]);
    let places = corners.map(|vertex| mesh.vertices()[vertex as usize]);
    let (low, high) = places.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), place| {
        (low.min(place), high.max(place))
    });
    rounding.around(low, high)
}

fn are_tied<P: Policy>(predicates: &Predicates<'_, P>, [first, second]: [&Face; 2]) -> bool {
    let apart = first.ranks[1] < second.ranks[0] || second.ranks[1] < first.ranks[0];
    if apart || first.whole == second.whole {
        return false;
    }
    let plane = first.polygon.plane().into();
    second.polygon.sides_of(predicates, plane) == [false; 2]
        && !PlanePolygon::are_apart(
            predicates,
            [&first.polygon, &second.polygon],
            first.polygon.walls(predicates),
            second.polygon.walls(predicates),
        )
}
