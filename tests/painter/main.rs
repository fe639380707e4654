//! The painter's order, three ways, against brute force that knows none.
//!
//! `oracle` asks integers what is seen at a point; `pictures` asks rays what
//! the page shows; `whole_check` proves an
//! order pair by pair, without a point; `scenes` builds the scenes whose
//! number of cuts is known.

#![allow(clippy::unwrap_used)]

mod oracle;
mod pictures;
mod scenes;
mod soups;
mod views;
mod whole_check;

use umriss::kernel::predicates::Exact;
use umriss::model::{Camera, FeatureOptions, Mesh, Soup};
use umriss::run::{Counters, Run};
use umriss::view::{LineQuestion, PaintOrder, PreparedView};
use umriss::visibility::{Painter, PainterOptions, paint_order};

/// Asks about a mesh from a camera.
pub(crate) fn with_question<T>(
    mesh: &Mesh,
    camera: &Camera,
    ask: impl FnOnce(&LineQuestion<'_>) -> T,
) -> T {
    let view = camera.view(mesh.bounds()).unwrap();
    let options = FeatureOptions::default();
    let prepared = PreparedView::new::<Exact>(mesh, &view, &options, &Run::default()).unwrap();
    ask(&prepared.question(false))
}

/// The order by one of the ways, and what was counted.
pub(crate) fn painted(question: &LineQuestion<'_>, painter: Painter) -> (PaintOrder, Counters) {
    let run = Run::default();
    let options = PainterOptions { painter, ..PainterOptions::default() };
    let order = paint_order::<Exact>(question, &options, &run).unwrap();
    (order, run.counters())
}

/// A mesh of one object with these faces, each with corners of its own.
pub(crate) fn mesh(faces: &[Vec<[f64; 3]>]) -> Mesh {
    let mut soup = Soup::default();
    for face in faces {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend(face.iter().map(|&corner| glam::DVec3::from_array(corner)));
        let ring: Vec<u32> = (first..soup.vertices.len() as u32).collect();
        soup.faces.push(&ring, []);
    }
    Mesh::new(vec![soup], None).unwrap()
}

/// From above, with x to the right and y upwards.
pub(crate) fn above() -> Camera {
    towards([0.0, 0.0, -1.0])
}

/// Parallel rays along a direction.
pub(crate) fn towards(forward: [f64; 3]) -> Camera {
    let forward = glam::DVec3::from_array(forward);
    let up = if forward.x == 0.0 && forward.z == 0.0 { glam::DVec3::Z } else { glam::DVec3::Y };
    Camera::Orthographic { forward, target: Some(glam::DVec3::ZERO), up }
}

/// Counts of one name.
pub(crate) fn count(counters: &Counters, name: &str) -> u64 {
    counters.iter().find(|(other, _)| *other == name).map_or(0, |(_, amount)| amount)
}
