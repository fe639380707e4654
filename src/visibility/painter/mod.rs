//! The painter's method: faces from back to front, each painted over those
//! before it, cut where no order exists.
//!
//! Newell, Newell and Sancha (1972) sort polygons by their farthest points and
//! take the first, P, if it may be painted before every other polygon Q of
//! overlapping depth, that is if one of these holds, cheap ones first:
//!
//! 1. P lies deeper than Q.
//!
//!    2a. The boxes around the images do not overlap.
//!    2b. Q lies on the viewer's side of P's plane, or on it.
//!    2c. P lies on the far side of Q's plane, or on it.
//!    2d. The images have no area in common.
//!
//! If none does, 2b and 2c with the roles exchanged ask whether Q may come
//! first; it is then marked and moved to the front. One that is to be moved
//! twice is part of a cycle, and a polygon is cut by the plane of another.
//!
//! The three ways here share these tests, all exact and all counted ([`judge`]):
//!
//! - [`Painter::Graph`], the default ([`graph`]). Marks are a guess at cycles
//!   and cut more than is needed. The graph of all pairs that overlap in area,
//!   with an edge from the one that must be painted first, knows: polygons that
//!   are on no cycle are never cut, whatever their neighbours do. Test 2d comes
//!   first there, for an edge needs it anyway, and one more test is the last:
//!   on the common area itself, is one of both nearer throughout? So the graph
//!   has two edges between polygons only where they pass through one another.
//! - [`Painter::List`], the classical list with its marks ([`list`]).
//! - [`Painter::Tree`], a [`crate::polygon::Bsp`] of all faces, which may be kept
//!   for other eyes: [`PaintTree`].
//!
//! Why there always is a cut: polygons none of whose planes cuts another have
//! a tree without cuts, so an order; on a cycle there is a polygon whose plane
//! cuts another. Why it ends: no plane is ever added, so each cut lowers the
//! number of pairs of a piece and a plane that cuts it.
//!
//! Pieces are bounded by planes of the input ([`PlanePolygon`]), so cuts after
//! cuts lose nothing. Concave faces and faces with holes come as convex parts,
//! whose inner edges are never drawn and vanish where parts of one face, or of
//! one flat area ([`flats`]), follow one another ([`image`]); alternating overlap of concave faces is overlap of
//! convex parts. The near plane is one plane more. Of faces in one plane the
//! one that the tie rule names is painted last. Edge-on faces are not painted.
//!
//! Expected O(n log n + k) for n faces and k pairs of overlapping boxes in the
//! image, as long as there are few cycles.
//!
//! Sources: M. E. Newell, R. G. Newell and T. L. Sancha, "A solution to the
//! hidden surface problem", 1972; H. Fuchs, Z. M. Kedem and B. F. Naylor, "On
//! visible surface generation by a priori tree structures", 1980.
//!
//! [`PlanePolygon`]: crate::polygon::PlanePolygon

mod components;
mod cycles;
mod faces;
mod flats;
mod graph;
mod image;
mod judge;
mod list;
mod order;
mod sheets;
mod tree;

pub use image::painted_image;
pub use tree::PaintTree;

use crate::kernel::predicates::{Policy, Predicates, sort_by_predicates};
use crate::run::{Cancelled, Run};
use crate::view::{LineQuestion, PaintOrder};
use faces::faces;

/// How the order is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Painter {
    /// From the graph of all pairs, cutting on its cycles only.
    #[default]
    Graph,
    /// From the classical list.
    List,
    /// From a tree built for this one view.
    Tree,
}

impl Painter {
    /// All ways.
    pub const ALL: [Painter; 3] = [Painter::Graph, Painter::List, Painter::Tree];

    /// Its name: `graph`, `list`, `tree`.
    pub fn name(self) -> &'static str {
        match self {
            Painter::Graph => "graph",
            Painter::List => "list",
            Painter::Tree => "tree",
        }
    }

    /// The one with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|painter| painter.name() == name)
    }
}

/// A deliberate mistake, to prove that a check can fail. Never set outside
/// of tests of the tests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PainterFault {
    /// The order is that of depths, as in painters that know no planes.
    DepthOnly,
}

impl PainterFault {
    /// The name of the fault on a command line.
    pub fn name(self) -> &'static str {
        match self {
            PainterFault::DepthOnly => "depth-only",
        }
    }
}

/// How to run [`paint_order`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PainterOptions {
    /// How the order is found.
    pub painter: Painter,
    /// Give up beyond so many cuts.
    pub most_cuts: Option<usize>,
    /// A mistake to make.
    pub fault: Option<PainterFault>,
}

/// Why there is no order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum PainterError {
    /// The run was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The eye is a point and nothing says what lies in front of it.
    #[error("painting a perspective view needs a near plane")]
    NoNearPlane,
    /// The order takes more cuts than were allowed.
    #[error("the painter's order takes more than {0} cuts, the most that were allowed")]
    TooManyCuts(usize),
    /// Polygons are in a cycle and none cuts another, which cannot be.
    #[error("the painter found a cycle that no plane cuts: this is a mistake of the program")]
    NoCut,
}

/// Finds an order in which all faces of a question, cut where they must be,
/// paint its picture. Counts tests, cuts and pieces.
///
/// # Errors
///
/// If the run is cancelled, the view is a perspective one without a near plane,
/// or the order takes more cuts than allowed.
pub fn paint_order<P: Policy>(
    question: &LineQuestion<'_>,
    options: &PainterOptions,
    run: &Run<'_>,
) -> Result<PaintOrder, PainterError> {
    check_view(question)?;
    let most_cuts = options.most_cuts.unwrap_or(usize::MAX);
    if options.painter == Painter::Tree && options.fault.is_none() {
        let tree = PaintTree::within::<P>(question, most_cuts, run)?;
        return tree.ok_or(PainterError::TooManyCuts(most_cuts))?.order::<P>(question, run);
    }
    let count = question.mesh.triangles().len() as u64;
    let faces = run.stage("painted-faces", count, || faces::<P>(question, run))?;
    run.check()?;
    let sheets = run.stage("sheets", count, || sheets::sheets::<P>(question, &faces, run))?;
    run.check()?;
    let order = match options.painter {
        _ if options.fault.is_some() => by_depth::<P>(question, sheets),
        Painter::Graph => graph::order::<P>(question, &faces, sheets, most_cuts, run)?,
        _ => list::order::<P>(question, sheets, most_cuts, run)?,
    };
    let cuts = order.cuts;
    run.count("painter-cuts", cuts as u64);
    run.count("painted-pieces", order.sheets.len() as u64);
    let pieces = order.sheets.into_iter().map(|sheet| {
        let face = &faces.list[sheet.face as usize];
        face.painted(question, sheet.polygon)
    });
    Ok(PaintOrder { pieces: pieces.collect(), cuts })
}

/// The mistake of [`PainterFault::DepthOnly`].
fn by_depth<P: Policy>(question: &LineQuestion<'_>, sheets: Vec<sheets::Sheet>) -> Ordered {
    let predicates = Predicates::<P>::new(question.points);
    let mut numbers: Vec<u32> = (0..sheets.len() as u32).collect();
    sort_by_predicates::<P, _>(&mut numbers, |&a, &b| {
        order::farthest_first(&predicates, &sheets, a, b)
    });
    let sorted = numbers.into_iter().map(|number| sheets[number as usize].clone());
    Ordered { sheets: sorted.collect(), cuts: 0 }
}

/// A perspective has an image only in front of something.
fn check_view(question: &LineQuestion<'_>) -> Result<(), PainterError> {
    match question.points.is_perspective() && !question.points.has_near_plane() {
        true => Err(PainterError::NoNearPlane),
        false => Ok(()),
    }
}

/// Sheets in painting order.
struct Ordered {
    sheets: Vec<sheets::Sheet>,
    cuts: usize,
}
