//! Repair of what rounding has torn, before there is a mesh.
//!
//! Files hold rounded numbers. Corners that were one are then two, a corner in
//! the middle of an edge lies beside it, what stood on a plane stands a little
//! above it or below. The engine takes coordinates as they are and draws all
//! of that. Healing gives it the model that was meant, as far as this can be
//! told within a tolerance:
//!
//! 1. faces across an axis that touch come into one plane ([`coordinates`]);
//! 2. vertices go to vertices, those of other objects too ([`vertices`]);
//! 3. faces without width are taken out ([`slivers`]);
//! 4. borders are led through the vertices beside them ([`seams`]).
//!
//! What is promised: no vertex moves farther than the tolerance from where
//! the file has it, in all steps together. What is joined is joined exactly:
//! it has equal coordinates and edges in common, and no decision follows that
//! knows of a tolerance. The result depends neither on the order of vertices,
//! faces and objects nor on winding nor on threads. Faces keep their numbers,
//! and vertices theirs. To heal what is healed changes nothing, unless a
//! vertex was held back by the tolerance the first time.
//!
//! What is not promised: that a face stays flat whose corners go different
//! ways, faces across an axis excepted; that a gap wider than the tolerance is
//! closed somewhere else; that surfaces that pass through one another are cut.

mod coordinates;
mod joined;
mod near;
mod net;
mod seams;
mod slivers;
mod splits;
mod survey;
mod tolerance;
mod vertices;
mod write_back;

use super::Soup;
use crate::run::{Cancelled, Run};
use glam::DVec3;
use net::Net;
use survey::Survey;
use tolerance::{Tolerance, compare, distance};
use write_back::Healed;

/// What was done to models.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct HealReport {
    /// Places that are now elsewhere; a place is what vertices of equal
    /// positions have in common.
    pub moved: usize,
    /// How far at most, in the models' unit.
    pub farthest: f64,
    /// Edges at which faces meet that had none in common there.
    pub closed_seams: usize,
    /// Faces that have no area any more.
    pub collapsed_faces: usize,
}

/// Heals the objects of a scene within a tolerance, in the models' unit: one
/// that is not greater than zero changes nothing. Expected O(n log n), and
/// O(n) if little is torn.
///
/// # Errors
///
/// If the run is cancelled or reaches a limit; the objects are of no use then.
pub fn heal(soups: &mut [Soup], tolerance: f64, run: &Run<'_>) -> Result<HealReport, Cancelled> {
    if !(0.0 < tolerance && tolerance.is_finite()) {
        return Ok(HealReport::default());
    }
    let tolerance = Tolerance::new(tolerance);
    run.take(soups.iter().map(bytes_of_net).sum())?;
    let (positions, starts) = take_positions(soups);
    let (mut net, mut links) = Net::new(soups, starts, positions, tolerance);
    run.check()?;
    if coordinates::align(&mut net, tolerance, run) {
        links = net.links(tolerance);
    }
    vertices::merge(&mut net, &links, tolerance);
    run.check()?;
    let mut survey = Survey::of(&net, tolerance);
    let mut collapsed_faces = survey.collapsed;
    run.check()?;
    let thin = std::mem::take(&mut survey.thin);
    let slivers = slivers::collapse(&mut net, thin, tolerance);
    if slivers > 0 {
        collapsed_faces += slivers;
        survey = Survey::of(&net, tolerance);
    }
    if !survey.is_closed() {
        let borders = seams::borders(&net, &survey);
        collapsed_faces += seams::close(&mut net, &borders, tolerance, run);
        run.check()?;
    }
    // A corner may have come to a flat face that is not quite in its plane.
    if !net.changed.is_empty() {
        net.note_joined();
        if coordinates::align(&mut net, tolerance, run) {
            let links = net.links(tolerance);
            vertices::merge(&mut net, &links, tolerance);
        }
    }
    run.check()?;
    let closed_seams = joined::closed_seams(&net);
    let healed = Healed::of(net);
    let HealReport { moved, farthest, .. } = healed.report;
    healed.put_back(soups);
    Ok(HealReport { moved, farthest, closed_seams, collapsed_faces })
}

/// What is held for each vertex and face while an object is healed.
fn bytes_of_net(soup: &Soup) -> u64 {
    (soup.vertices.len() * 64 + soup.faces.len() * 8) as u64
}

/// Takes the positions of all objects, and where those of each begin.
fn take_positions(soups: &mut [Soup]) -> (Vec<DVec3>, Vec<u32>) {
    let (mut positions, mut starts) = (Vec::new(), Vec::with_capacity(soups.len()));
    for soup in soups {
        starts.push(positions.len() as u32);
        if positions.is_empty() {
            positions = std::mem::take(&mut soup.vertices);
        } else {
            positions.append(&mut soup.vertices);
        }
    }
    (positions, starts)
}
