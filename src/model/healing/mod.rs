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

mod borders;
mod coordinates;
mod near;
mod net;
mod seams;
mod slivers;
mod splits;
mod survey;
mod tolerance;
mod torn;
mod vertices;
mod write_back;

use super::Soup;
use super::soup::take_positions;
use crate::run::{Cancelled, Run};
use borders::{borders, count_closed};
use near::{Near, near};
use net::Net;
use survey::Survey;
use tolerance::{Tolerance, compare, distance, rank};
pub use torn::{TornBorders, torn_borders};
use write_back::Healed;

/// What was done to models.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct HealReport {
    /// Places that are now elsewhere; a place is what vertices of equal
    /// positions have in common.
    pub moved: usize,
    /// How far at most, in the models' unit.
    pub farthest: f64,
    /// Sides of faces that were borders and now have a partner.
    pub closed_borders: usize,
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
    let mut net = Net::new(soups, starts, positions);
    let mut locks = coordinates::locks(&net);
    let Near { first, kept, mut links } = near(&net.places, &locks, tolerance);
    net.now.clone_from(&first);
    net.first = first;
    run.check()?;
    if coordinates::align(&mut net, tolerance, run) {
        locks = coordinates::locks(&net);
        links = net.links(tolerance);
    } else {
        net.now = kept;
        // Those of a place are those of all its vertices.
        for (vertex, &first) in net.first.iter().enumerate() {
            locks[first as usize] |= locks[vertex];
        }
    }
    vertices::merge(&mut net, &links, &locks, tolerance);
    run.check()?;
    let Survey { mut sums, before, thin, collapsed } = Survey::of(&net, tolerance);
    let before = before.as_ref();
    run.check()?;
    let slivers = slivers::collapse(&mut net, thin, tolerance);
    if slivers > 0 {
        sums = survey::sums(&net);
    }
    let mut left = Vec::new();
    let mut bent = 0;
    if !sums.are_closed() {
        left = borders(&net, &sums);
        bent = seams::close(&mut net, &left, tolerance, run);
        run.check()?;
    }
    // A corner may have come to a flat face that is not quite in its plane.
    if !net.changed.is_empty() {
        net.note_joined();
        if coordinates::align(&mut net, tolerance, run) {
            let (links, locks) = (net.links(tolerance), coordinates::locks(&net));
            vertices::merge(&mut net, &links, &locks, tolerance);
        }
        let sums = survey::sums(&net);
        left = if sums.are_closed() { Vec::new() } else { borders(&net, &sums) };
    }
    run.check()?;
    let closed_borders = match before {
        None if net.changed.is_empty() => 0,
        Some(before) => count_closed(&net, before, &left),
        None => count_closed(&net, &survey::old_sums(&net), &left),
    };
    let collapsed_faces = collapsed + slivers + bent;
    let healed = Healed::of(net);
    let HealReport { moved, farthest, .. } = healed.report;
    healed.put_back(soups);
    Ok(HealReport { moved, farthest, closed_borders, collapsed_faces })
}

/// What is held for each vertex and face while an object is healed.
fn bytes_of_net(soup: &Soup) -> u64 {
    (soup.vertices.len() * 64 + soup.faces.len() * 8) as u64
}
