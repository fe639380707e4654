//! Images by their size in pixels.

use crate::failure::Failure;
use umriss::raster::Samples;
use umriss::view::LineQuestion;

/// A grid of samples around the model that is asked about.
pub(crate) fn samples(question: &LineQuestion<'_>, size: [u32; 2]) -> Result<Samples, Failure> {
    let count = question.mesh.vertices().len() as u32;
    Samples::fitting(question.frame, question.coordinates, count, size).ok_or_else(|| {
        Failure::failed(
            "no pixels can be laid over this view: expected an image with an extent, and \
             coordinates below 1e307",
        )
    })
}

/// Pixels as in 640x480.
pub(crate) fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let number = |word: &str| word.parse().ok().filter(|pixels| (3..=8192).contains(pixels));
    let size = text.split_once('x').and_then(|(w, h)| Some([number(w)?, number(h)?]));
    size.ok_or_else(|| "expected width x height from 3 to 8192 each, as in 640x480".to_owned())
}
