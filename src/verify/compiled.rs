//! All methods, compiled for the policy of the product.
//!
//! Methods are generic over how decisions are made, so a crate that calls one
//! compiles it. Where the compiler lets crates share that work, as in builds
//! for tests, it is done once, here, and not again for every file of `tests`.

use crate::kernel::predicates::Exact;
use crate::view::{PreparedSurface, PreparedView};
use crate::{raster, verify, visibility};

/// What is to be compiled; nobody calls it.
#[used]
static COMPILED: fn() -> [*const (); 24] = || {
    [
        PreparedView::new::<Exact> as *const (),
        PreparedView::with_wishes::<Exact> as *const (),
        PreparedSurface::new as *const (),
        visibility::appel::<Exact> as *const (),
        visibility::roberts::<Exact> as *const (),
        visibility::outlined::<Exact> as *const (),
        visibility::reduce::<Exact> as *const (),
        visibility::reduce_with_crossings::<Exact> as *const (),
        visibility::visible_regions::<Exact> as *const (),
        visibility::region_lines::<Exact> as *const (),
        visibility::paint_order::<Exact> as *const (),
        visibility::PaintTree::new::<Exact> as *const (),
        visibility::PaintTree::order::<Exact> as *const (),
        visibility::floating_horizon::<Exact> as *const (),
        raster::methods::<Exact> as *const (),
        raster::c_buffer::<Exact> as *const (),
        raster::front_to_back::<Exact> as *const (),
        raster::span_buffer_with::<Exact> as *const (),
        raster::warnock_windows::<Exact> as *const (),
        verify::verify::<Exact> as *const (),
        verify::verify_regions::<Exact> as *const (),
        verify::verify_painting::<Exact> as *const (),
        verify::cross_check::<Exact> as *const (),
        raster::ray_hits::<Exact> as *const (),
    ]
};
