//! Every method with exact decisions, under its own name and without a
//! policy: what programs call.
//!
//! The methods of all rooms are generic over how decisions are made, so that
//! one formula serves the product, the filter alone and plain floats, and one
//! can be measured against the other. Whoever calls a generic function
//! compiles it, with all that it calls. The functions here are compiled once,
//! in the library.

use crate::kernel::predicates::Exact;
use crate::model::{FeatureOptions, Mesh, View};
use crate::raster::{
    self, ABufferOptions, Compare, Fragments, ItemBuffer, Method, OrderError, Paint, Samples,
    Subdivision, Window,
};
use crate::run::{Cancelled, Run};
use crate::verify::{
    self, CrossCheck, PaintReport, PaintVerifyOptions, RegionReport, RegionVerifyOptions, Report,
    VerifyOptions,
};
use crate::view::{
    Crossing, ExactLines, LineQuestion, ObjectWish, OutlineOf, PaintOrder, PreparedView, Skips,
    SurfaceQuestion, VisibleLines, VisibleRegions,
};
use crate::visibility::{
    self, AppelOptions, HorizonError, PaintTree, PainterError, PainterOptions, RegionOptions,
    RegionsError,
};

pub use crate::visibility::visible_lines;

/// [`PreparedView::new`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn prepare<'m>(
    mesh: &'m Mesh,
    view: &View,
    options: &FeatureOptions,
    run: &Run,
) -> Result<PreparedView<'m>, Cancelled> {
    PreparedView::new::<Exact>(mesh, view, options, run)
}

/// [`PreparedView::with_wishes`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn prepare_with_wishes<'m>(
    mesh: &'m Mesh,
    view: &View,
    wishes: &[ObjectWish],
    run: &Run,
) -> Result<PreparedView<'m>, Cancelled> {
    PreparedView::with_wishes::<Exact>(mesh, view, wishes, run)
}

/// [`PreparedView::for_visible_lines`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn prepare_for_visible_lines<'m>(
    mesh: &'m Mesh,
    view: &View,
    wishes: &[ObjectWish],
    run: &Run,
) -> Result<PreparedView<'m>, Cancelled> {
    PreparedView::for_visible_lines::<Exact>(mesh, view, wishes, &Skips::default(), run)
}

/// [`visibility::appel`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn appel(
    question: &LineQuestion<'_>,
    options: &AppelOptions,
    run: &Run<'_>,
) -> Result<ExactLines, Cancelled> {
    visibility::appel::<Exact>(question, options, run)
}

/// [`visibility::roberts`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn roberts(
    question: &LineQuestion<'_>,
    selection: Option<&[u32]>,
    run: &Run<'_>,
) -> Result<ExactLines, Cancelled> {
    visibility::roberts::<Exact>(question, selection, run)
}

/// [`visibility::outlined`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn outlined(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    of: OutlineOf,
    run: &Run<'_>,
) -> Result<ExactLines, Cancelled> {
    visibility::outlined::<Exact>(question, answer, of, run)
}

/// [`visibility::reduce`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn reduce(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    run: &Run<'_>,
) -> Result<VisibleLines, Cancelled> {
    visibility::reduce::<Exact>(question, answer, run)
}

/// [`visibility::reduce_with_crossings`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn reduce_with_crossings(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    run: &Run<'_>,
) -> Result<(VisibleLines, Vec<Crossing>), Cancelled> {
    visibility::reduce_with_crossings::<Exact>(question, answer, run)
}

/// [`visibility::visible_regions`].
///
/// # Errors
///
/// As those of the method.
pub fn visible_regions(
    question: &LineQuestion<'_>,
    options: &RegionOptions,
    run: &Run<'_>,
) -> Result<VisibleRegions, RegionsError> {
    visibility::visible_regions::<Exact>(question, options, run)
}

/// [`visibility::region_lines`].
///
/// # Errors
///
/// As those of the method.
pub fn region_lines(
    question: &LineQuestion<'_>,
    regions: &VisibleRegions,
    run: &Run<'_>,
) -> Result<ExactLines, RegionsError> {
    visibility::region_lines::<Exact>(question, regions, run)
}

/// [`visibility::paint_order`].
///
/// # Errors
///
/// As those of the method.
pub fn paint_order(
    question: &LineQuestion<'_>,
    options: &PainterOptions,
    run: &Run<'_>,
) -> Result<PaintOrder, PainterError> {
    visibility::paint_order::<Exact>(question, options, run)
}

/// [`PaintTree::new`].
///
/// # Errors
///
/// As those of the method.
pub fn paint_tree(question: &LineQuestion<'_>, run: &Run<'_>) -> Result<PaintTree, Cancelled> {
    PaintTree::new::<Exact>(question, run)
}

/// [`PaintTree::order`].
///
/// # Errors
///
/// As those of the method.
pub fn paint_order_of_tree(
    tree: &PaintTree,
    question: &LineQuestion<'_>,
    run: &Run<'_>,
) -> Result<PaintOrder, PainterError> {
    tree.order::<Exact>(question, run)
}

/// [`visibility::floating_horizon`].
///
/// # Errors
///
/// As those of the method.
pub fn floating_horizon(
    question: &SurfaceQuestion<'_>,
    run: &Run<'_>,
) -> Result<ExactLines, HorizonError> {
    visibility::floating_horizon::<Exact>(question, run)
}

/// [`raster::methods`]: the image-space references by name.
pub fn image_methods() -> Vec<(&'static str, Method)> {
    raster::methods::<Exact>()
}

/// [`raster::span_buffer_with`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn span_buffer_with(
    view: &View,
    question: &LineQuestion<'_>,
    samples: &Samples,
    compare: Compare,
    run: &Run<'_>,
) -> Result<ItemBuffer, Cancelled> {
    raster::span_buffer_with::<Exact>(view, question, samples, compare, run)
}

/// [`raster::front_to_back`].
///
/// # Errors
///
/// As those of the method.
pub fn front_to_back(question: &LineQuestion<'_>, run: &Run<'_>) -> Result<Vec<u32>, OrderError> {
    raster::front_to_back::<Exact>(question, run)
}

/// [`raster::c_buffer`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn c_buffer(
    view: &View,
    question: &LineQuestion<'_>,
    samples: &Samples,
    order: &[u32],
    run: &Run<'_>,
) -> Result<ItemBuffer, Cancelled> {
    raster::c_buffer::<Exact>(view, question, samples, order, run)
}

/// [`raster::warnock_windows`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn warnock_windows(
    view: &View,
    question: &LineQuestion<'_>,
    samples: &Samples,
    subdivision: Subdivision,
    run: &Run<'_>,
) -> Result<(ItemBuffer, Vec<Window>), Cancelled> {
    raster::warnock_windows::<Exact>(view, question, samples, subdivision, run)
}

/// [`raster::visible_fragments`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn visible_fragments(
    view: &View,
    question: &LineQuestion<'_>,
    pixels: &Samples,
    options: ABufferOptions,
    run: &Run<'_>,
) -> Result<Fragments, Cancelled> {
    raster::visible_fragments::<Exact>(view, question, pixels, options, run)
}

/// [`raster::preview`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn preview(
    view: &View,
    question: &LineQuestion<'_>,
    pixels: &Samples,
    options: ABufferOptions,
    paint: &(dyn Fn(u32, [u32; 2]) -> Paint + Sync),
    run: &Run<'_>,
) -> Result<crate::fill::Canvas, Cancelled> {
    raster::preview::<Exact>(view, question, pixels, options, paint, run)
}

/// [`verify::verify`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn verify(
    view: &View,
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    options: &VerifyOptions,
    run: &Run<'_>,
) -> Result<Report, Cancelled> {
    verify::verify::<Exact>(view, question, answer, options, run)
}

/// [`verify::verify_regions`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn verify_regions(
    view: &View,
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    options: &RegionVerifyOptions,
    run: &Run<'_>,
) -> Result<RegionReport, Cancelled> {
    verify::verify_regions::<Exact>(view, question, answer, options, run)
}

/// [`verify::verify_painting`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn verify_painting(
    view: &View,
    question: &LineQuestion<'_>,
    options: &PaintVerifyOptions,
    run: &Run<'_>,
) -> Result<PaintReport, Cancelled> {
    verify::verify_painting::<Exact>(view, question, options, run)
}

/// [`verify::cross_check`].
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn cross_check(
    view: &View,
    question: &LineQuestion<'_>,
    samples: &Samples,
    run: &Run<'_>,
) -> Result<CrossCheck, Cancelled> {
    verify::cross_check::<Exact>(view, question, samples, run)
}
