//! Convex parts of a mesh: closed, and bulging everywhere.
//!
//! A convex part needs no search of its own: it does not pass through itself,
//! and an eye outside of it cannot see an edge of it between two faces that
//! are turned away. Scenes of boxes, gems and pebbles are full of them.
//!
//! A part is what hangs together by edges with two triangles, wound alike. It
//! is convex if no such edge is a valley, if one point lies strictly inside of
//! all its faces' planes, and if a ray from that point meets just one face:
//! seen from there, faces lie side by side across each edge, so they cover
//! all directions equally often, and the ray says how often. Then the part
//! lies once around the point, and without a valley it is convex. The point
//! is the rounded mean of the corners: if that is not inside, the part is not
//! called convex, which is always allowed. All signs are exact.
//!
//! Source: K. Mehlhorn, S. Näher, M. Seel, R. Seidel, T. Schilz, S. Schirra
//! and C. Uhrig, "Checking geometric programs or verification of geometric
//! structures", 1999.

use super::components::{join, root};
use super::{Mesh, View};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, Point, Points, Policy, Predicates};
use crate::run::{Cancelled, Run, concat_map, fill_indexed, map_chunks, sample};
use glam::DVec3;

/// The convex parts of a mesh, and which of them hide what lies behind them
/// for the eye of a view.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConvexParts {
    /// The part of each triangle, if it is convex.
    part_of: Vec<u32>,
    parts: Vec<ConvexPart>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct ConvexPart {
    /// On which side of its triangles' planes it lies.
    inside: Sign,
    /// Whether the eye lies outside of it, and nothing of it before the near
    /// plane.
    seen_from_outside: bool,
}

/// No part has this number.
const NONE: u32 = u32::MAX;

/// Edges or triangles that one task looks at.
const PART: usize = 1 << 14;

/// So many edges tell whether convex parts are likely,
const SAMPLE: usize = 1024;

/// and are not if more than one in so many rules one out.
const ODD_ONE_IN: usize = 16;

impl ConvexParts {
    /// Finds them, unless a sample of the edges says that there cannot be
    /// many. `facing` is that of the view. O(n).
    ///
    /// # Errors
    ///
    /// If the run is cancelled or reaches a limit.
    pub fn find<P: Policy>(
        mesh: &Mesh,
        points: &Points,
        view: &View,
        facing: &[Sign],
        run: &Run<'_>,
    ) -> Result<Option<Self>, Cancelled> {
        if !are_likely(mesh, &Predicates::<P>::new(points)) {
            return Ok(None);
        }
        let bytes = bytes_of_search(mesh);
        run.take(bytes)?;
        let folds = folds::<P>(mesh, points, run);
        run.check()?;
        let candidates = Candidates::of(mesh, &folds);
        let found = candidates.verified::<P>(mesh, view, facing, run);
        run.check()?;
        run.give_back(bytes);
        let Some(found) = found else { return Ok(None) };
        run.take((found.part_of.len() * size_of::<u32>()) as u64)?;
        run.count("convex-parts", found.parts.len() as u64);
        Ok(Some(found))
    }

    /// Whether two triangles belong to one convex part.
    #[inline(always)]
    pub fn are_together(&self, [s, t]: [u32; 2]) -> bool {
        let part = self.part_of[s as usize];
        part != NONE && part == self.part_of[t as usize]
    }

    /// Whether a convex part hides an edge of its own all along. `facing` is
    /// that of the view.
    pub fn hide_own_edge(&self, mesh: &Mesh, facing: &[Sign], edge: u32) -> bool {
        let &[s, t] = mesh.edges().triangles(edge) else { return false };
        let part = self.part_of[s as usize];
        if part == NONE || part != self.part_of[t as usize] {
            return false;
        }
        let ConvexPart { inside, seen_from_outside } = self.parts[part as usize];
        // A triangle faces the eye if what is behind it is inside.
        let turned_away = |triangle: u32| facing[triangle as usize].is_opposite(inside);
        seen_from_outside && turned_away(s) && turned_away(t)
    }
}

/// What the search needs for a while.
fn bytes_of_search(mesh: &Mesh) -> u64 {
    let edges = mesh.edges().len() * size_of::<Option<Sign>>();
    let vertices = mesh.vertices().len() * (size_of::<[DVec3; 2]>() + 2 * size_of::<u32>());
    (edges + vertices + mesh.triangles().len()) as u64
}

/// Whether enough edges might belong to convex parts: bulging or flat, and not
/// both bulging and valleys among them.
fn are_likely<P: Policy>(mesh: &Mesh, predicates: &Predicates<'_, P>) -> bool {
    let (mut all, mut counts) = (0, [0; 3]);
    for edge in sample(mesh.edges().len(), SAMPLE) {
        all += 1;
        match fold(mesh, predicates, edge as u32) {
            None => counts[0] += 1,
            Some(Sign::Positive) => counts[1] += 1,
            Some(Sign::Negative) => counts[2] += 1,
            Some(Sign::Zero) => {}
        }
    }
    let [none, positive, negative] = counts;
    all > 0 && (none + positive.min(negative)) * ODD_ONE_IN <= all
}

/// On which side of the one triangle at an edge the other one lies, if there
/// are two, wound alike.
#[inline]
fn fold<P: Policy>(mesh: &Mesh, predicates: &Predicates<'_, P>, edge: u32) -> Option<Sign> {
    let &[s, t] = mesh.edges().triangles(edge) else { return None };
    let ends = mesh.edges().ends(edge);
    if mesh.runs_along(s, ends) == mesh.runs_along(t, ends) {
        return None;
    }
    Some(predicates.plane(mesh.triangles()[s as usize], mesh.third(t, ends)))
}

/// The fold of each edge.
fn folds<P: Policy>(mesh: &Mesh, points: &Points, run: &Run<'_>) -> Vec<Option<Sign>> {
    let parts = map_chunks(mesh.edges().len(), PART, |part| {
        let predicates = Predicates::<P>::new(points);
        if run.is_stopped() {
            return (Vec::new(), predicates.counters());
        }
        let folds: Vec<_> = part.map(|edge| fold(mesh, &predicates, edge as u32)).collect();
        (folds, predicates.counters())
    });
    parts.iter().for_each(|(_, counters)| run.merge(counters));
    let folds: Vec<&[Option<Sign>]> = parts.iter().map(|(folds, _)| &folds[..]).collect();
    concat_map(&folds, |_, &fold| fold)
}

/// Parts that may be convex.
struct Candidates {
    /// The candidate of each vertex; none where the part is ruled out.
    of_vertex: Vec<u32>,
    /// On which side of its triangles' planes each candidate lies.
    inside: Vec<Sign>,
    /// A point of each, and a point of one of its faces.
    probes: Vec<[DVec3; 2]>,
}

/// What the edges say of the part of a vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Bulge {
    Flat,
    Towards(Sign),
    RuledOut,
}

impl Bulge {
    /// Adds what one edge says.
    fn add(&mut self, fold: Option<Sign>) {
        self.join(match fold {
            None => Bulge::RuledOut,
            Some(Sign::Zero) => Bulge::Flat,
            Some(sign) => Bulge::Towards(sign),
        });
    }

    /// Adds what other edges say.
    fn join(&mut self, other: Self) {
        *self = match (*self, other) {
            (Bulge::Flat, other) => other,
            (own, Bulge::Flat) => own,
            (own, other) if own == other => own,
            _ => Bulge::RuledOut,
        };
    }
}

impl Candidates {
    /// Parts without a valley.
    fn of(mesh: &Mesh, folds: &[Option<Sign>]) -> Self {
        let mut parents: Vec<u32> = (0..mesh.vertices().len() as u32).collect();
        let mut bulges = vec![Bulge::Flat; parents.len()];
        for (edge, &fold) in folds.iter().enumerate() {
            let ends = mesh.edges().ends(edge as u32);
            if fold.is_some() {
                join(&mut parents, ends);
            }
            // The ends of an edge that rules out may belong to two parts.
            for end in ends {
                bulges[end as usize].add(fold);
            }
        }
        for vertex in 0..parents.len() {
            let part = root(&mut parents, vertex as u32) as usize;
            let own = bulges[vertex];
            bulges[part].join(own);
        }
        let mut candidates = Candidates {
            of_vertex: vec![NONE; parents.len()],
            inside: Vec::new(),
            probes: Vec::new(),
        };
        let mut counts = Vec::new();
        // A root is the least of its part, and all know theirs by now.
        for (vertex, &part) in parents.iter().enumerate() {
            let part = part as usize;
            let Bulge::Towards(inside) = bulges[part] else { continue };
            if part == vertex {
                candidates.of_vertex[vertex] = candidates.inside.len() as u32;
                candidates.inside.push(inside);
                candidates.probes.push([DVec3::ZERO; 2]);
                counts.push(0.0);
            }
            let number = candidates.of_vertex[part];
            candidates.of_vertex[vertex] = number;
            candidates.probes[number as usize][0] += mesh.vertices()[vertex];
            counts[number as usize] += 1.0;
        }
        for (probe, count) in candidates.probes.iter_mut().zip(&counts) {
            probe[0] /= *count;
        }
        candidates.put_probes_on_faces(mesh);
        candidates.rule_out_infinite_probes();
        candidates
    }

    /// The second probe of each candidate: the middle of its first triangle.
    fn put_probes_on_faces(&mut self, mesh: &Mesh) {
        let mut has_face = vec![false; self.probes.len()];
        for corners in mesh.triangles() {
            let number = self.of_vertex[corners[0] as usize];
            if number != NONE && !std::mem::replace(&mut has_face[number as usize], true) {
                let [a, b, c] = corners.map(|corner| mesh.vertices()[corner as usize]);
                self.probes[number as usize][1] = a / 3.0 + b / 3.0 + c / 3.0;
            }
        }
    }

    fn rule_out_infinite_probes(&mut self) {
        for number in &mut self.of_vertex {
            let probes = self.probes.get(*number as usize);
            if probes.is_some_and(|probes| !probes.iter().all(|probe| probe.is_finite())) {
                *number = NONE;
            }
        }
        for probe in self.probes.iter_mut().flatten() {
            if !probe.is_finite() {
                *probe = DVec3::ZERO;
            }
        }
    }

    /// The candidates that are convex, if any is.
    fn verified<P: Policy>(
        &self,
        mesh: &Mesh,
        view: &View,
        facing: &[Sign],
        run: &Run<'_>,
    ) -> Option<ConvexParts> {
        if self.inside.is_empty() {
            return None;
        }
        let probes = self.probes.iter().flatten();
        let all: Vec<DVec3> = mesh.vertices().iter().chain(probes).copied().collect();
        let points = Points::new(&all, view.eye, view.near);
        let reports = self.reports::<P>(mesh, facing, &points, run);
        let mut tallies = vec![Tally::default(); self.inside.len()];
        for (corners, report) in mesh.triangles().iter().zip(reports) {
            let number = self.of_vertex[corners[0] as usize];
            if number != NONE {
                tallies[number as usize].add(report);
            }
        }
        let mut parts = Vec::new();
        let mut number_of = vec![NONE; tallies.len()];
        for (candidate, tally) in tallies.iter().enumerate() {
            if tally.is_convex() {
                number_of[candidate] = parts.len() as u32;
                parts.push(ConvexPart {
                    inside: self.inside[candidate],
                    seen_from_outside: tally.towards_eye && !tally.before_near_plane,
                });
            }
        }
        if parts.is_empty() {
            return None;
        }
        let mut part_of = vec![NONE; mesh.triangles().len()];
        fill_indexed(&mut part_of, |triangle| {
            let candidate = self.of_vertex[mesh.triangles()[triangle][0] as usize];
            if candidate == NONE { NONE } else { number_of[candidate as usize] }
        });
        Some(ConvexParts { part_of, parts })
    }

    /// What each triangle of a candidate says of it.
    fn reports<P: Policy>(
        &self,
        mesh: &Mesh,
        facing: &[Sign],
        points: &Points,
        run: &Run<'_>,
    ) -> Vec<Report> {
        let parts = map_chunks(mesh.triangles().len(), PART, |part| {
            let predicates = Predicates::<P>::new(points);
            let look = |triangle: usize| {
                let corners = mesh.triangles()[triangle];
                match self.of_vertex[corners[0] as usize] {
                    NONE => Report::default(),
                    number => self.look(mesh, &predicates, number, corners, facing[triangle]),
                }
            };
            let on = part.take_while(|_| !run.is_stopped());
            (on.map(look).collect::<Vec<_>>(), predicates.counters())
        });
        parts.iter().for_each(|(_, counters)| run.merge(counters));
        let reports: Vec<&[Report]> = parts.iter().map(|(reports, _)| &reports[..]).collect();
        concat_map(&reports, |_, &report| report)
    }

    fn look<P: Policy>(
        &self,
        mesh: &Mesh,
        predicates: &Predicates<'_, P>,
        number: u32,
        corners @ [a, b, c]: [u32; 3],
        facing: Sign,
    ) -> Report {
        let inside = self.inside[number as usize];
        let middle = mesh.vertices().len() as u32 + 2 * number;
        // [m, a, b, c] is the opposite of [a, b, c, m].
        // A ray through an edge meets two triangles, which rules the part out.
        let within = |[x, y]: [u32; 2]| predicates.plane([middle, x, y], middle + 1) != inside;
        let before_near_plane = |&corner: &u32| {
            predicates.value_sign(Cut::Near, Point::Vertex(corner)) != Sign::Positive
        };
        Report {
            around_middle: predicates.plane(corners, middle) == inside,
            meets_ray: [[a, b], [b, c], [c, a]].into_iter().all(within),
            towards_eye: facing == inside,
            before_near_plane: predicates.points().has_near_plane()
                && corners.iter().any(before_near_plane),
        }
    }
}

/// What a triangle says of its part.
#[derive(Debug, Clone, Copy, Default)]
struct Report {
    /// Whether the middle lies strictly on its inner side.
    around_middle: bool,
    /// Whether the ray from the middle meets it, its border included.
    meets_ray: bool,
    /// Whether it is seen from outside.
    towards_eye: bool,
    /// Whether not all of it lies beyond the near plane.
    before_near_plane: bool,
}

/// What the triangles of a part say together.
#[derive(Debug, Clone, Copy, Default)]
struct Tally {
    not_around_middle: bool,
    met: u32,
    towards_eye: bool,
    before_near_plane: bool,
}

impl Tally {
    fn add(&mut self, report: Report) {
        self.not_around_middle |= !report.around_middle;
        self.met += u32::from(report.meets_ray);
        self.towards_eye |= report.towards_eye;
        self.before_near_plane |= report.before_near_plane;
    }

    fn is_convex(&self) -> bool {
        !self.not_around_middle && self.met == 1
    }
}

#[cfg(test)]
mod tests;
