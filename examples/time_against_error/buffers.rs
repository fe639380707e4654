//! Lines looked up in a z-buffer.
//!
//! At steps of a pixel a point is hidden if its pixel and the eight around it
//! all see something that is nearer by more than a quarter of a pixel.

use super::measure::{Outcome, Visible, joined};
use super::scenes::Scene;
use umriss::kernel::predicates::Exact;
use umriss::raster::{ItemBuffer, Samples, z_buffer};
use umriss::run::{Run, map_chunks};
use umriss::view::LineQuestion;

/// Lines per task.
const PART: usize = 64;

/// Edges as far as an image sees them.
pub(crate) fn by_buffer(
    scene: &Scene,
    question: &LineQuestion<'_>,
    size: u32,
    run: &Run<'_>,
) -> Outcome<Visible> {
    let (mesh, view) = (&scene.mesh, &scene.view);
    let count = mesh.vertices().len() as u32;
    let samples = Samples::around(&view.frame, question.coordinates, count, size)
        .ok_or("a scene has an image")?;
    let buffer = z_buffer::<Exact>(view, question, &samples, run)?;
    let found = map_chunks(mesh.edges().len(), PART, |part| {
        let edge = |edge: usize| {
            let ends = mesh.edges().ends(edge as u32).map(|v| mesh.vertices()[v as usize]);
            let [a, b] = ends.map(|end| view.frame.image(end));
            let depths = ends.map(|end| view.frame.depth(end));
            let steps = (a.distance(b) / samples.pixel()).ceil().max(1.0) as u32;
            joined(steps, |share| {
                let depth = depths[0] + (depths[1] - depths[0]) * share;
                let pixel = samples.pixel_of(a.lerp(b, share));
                !pixel.is_some_and(|pixel| {
                    farthest_around(&buffer, &samples, pixel) < depth - 0.25 * samples.pixel()
                })
            })
        };
        part.map(edge).collect::<Vec<_>>()
    });
    Ok(found.concat())
}

/// The greatest depth of a pixel and its neighbours.
fn farthest_around(buffer: &ItemBuffer, samples: &Samples, [column, row]: [u32; 2]) -> f64 {
    let near = |at: u32, size: u32| at.saturating_sub(1)..(at + 2).min(size);
    let rows = near(row, samples.height());
    let pixels = rows.flat_map(|r| near(column, samples.width()).map(move |c| (c, r)));
    pixels.map(|(c, r)| buffer.depth(c, r)).fold(f64::NEG_INFINITY, f64::max)
}
