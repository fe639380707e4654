//! Wright's floating horizon, for surfaces over a rectangle.
//!
//! A *column* is a vertical plane through the eye. What of the surface is
//! nearer than a point is, in the point's column, one connected curve, because
//! the rectangle is convex and has one height everywhere. It covers all that
//! lies between its highest and its lowest point, the upper and the lower
//! *horizon*. Cells are triangles, so these lie on sides of cells, and so:
//!
//! 1. Take the sides of all cells, drawn or not, in an order in which every
//!    column meets nearer ones first ([`order`]).
//! 2. What of a side is above the upper or below the lower horizon is visible;
//!    raise the one and lower the other to it ([`horizon`]).
//!
//! The horizons are exact: piecewise linear, each piece on a side of a cell,
//! ending where a vertex or a crossing of the images of two sides is. Nothing
//! is ever constructed upon a crossing, so the predicates are those of Appel's
//! method: on which side of a line, in which order along a line.
//!
//! ```text
//!    upper      ___/\__        a side ab that is being added: visible from
//!   horizon  __/       \_b     where it leaves the lower horizon below, hidden
//!            ..      _/        between the horizons, visible from its crossing
//!    lower     \__/\/          with the upper one
//!   horizon     a
//! ```
//!
//! Where a side lies on both horizons at once, nothing but a strip seen from
//! its edge is in front, and it is visible. Sides that are vertical in the
//! image change no horizon; they are held against those on their left and on
//! their right, and hidden where they are so on either side.
//!
//! Two things follow from columns alone. All directions but straight up and
//! down have them, so every azimuth is covered. And how the picture is turned
//! or sheared does not matter: the frame of the view is not asked.
//!
//! Sources: T. J. Wright, "A two-space solution to the hidden line problem for
//! plotting functions of two variables", 1973, whose horizons are arrays. The
//! exact horizon and the order cell by cell, which azimuths other than 0 need,
//! are ours.
//!
//! Cost: O(n + k) for n cells and k pieces of horizon met. A search starts
//! where the last one ended.

mod breaks;
mod horizon;
mod order;
mod tracks;
mod walker;

use crate::kernel::predicates::Policy;
use crate::run::{Cancelled, Run};
use crate::view::{ExactLines, SurfaceQuestion};
use order::{Order, Step};
use walker::Walker;

/// Why a floating horizon cannot draw a view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum HorizonError {
    /// There are no columns.
    #[error(
        "the eye looks straight down or up, where a floating horizon has no columns: expected \
         another direction, or a method of `umriss draw` such as --method appel"
    )]
    Vertical,
    /// Columns run both ways from the eye.
    #[error(
        "the eye stands above or below the surface, where a floating horizon has no nearest row: \
         expected an eye beside it, or a method of `umriss draw` such as --method appel"
    )]
    EyeOverDomain,
    /// The run was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Finds the visible pieces of all drawn lines. Hidden ones, where they are
/// wanted, have invisibility 1: how many sheets hide them is not counted.
///
/// # Errors
///
/// If the eye looks along the vertical, or from a point above or below the
/// rectangle; if the run is cancelled.
pub fn floating_horizon<P: Policy>(
    question: &SurfaceQuestion<'_>,
    run: &Run<'_>,
) -> Result<ExactLines, HorizonError> {
    let surface = question.surface;
    let order = Order::new(surface, question.view.eye)?;
    let points = question.surface.heights().values().len() as u64;
    run.stage("floating horizon", points, || {
        let mut walker = Walker::<P>::new(question);
        order.walk(&mut |step| {
            walker.take(step);
            if step == Step::RowDone {
                run.check()?;
                run.advance(order.row_points());
            }
            Ok::<(), Cancelled>(())
        })?;
        Ok(walker.finish(run))
    })
}
