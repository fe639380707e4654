//! One tree for all views of a mesh.

use super::faces::{Faces, faces};
use super::sheets::in_front;
use super::{PainterError, check_view};
use crate::kernel::predicates::{Policy, Predicates};
use crate::polygon::Bsp;
use crate::run::{Cancelled, Run};
use crate::view::{LineQuestion, PaintOrder};

/// The faces of a mesh in a tree. Building it takes most of the time; the
/// order for one more eye takes linear time, so a turntable builds it once.
#[derive(Debug, Clone, Default)]
pub struct PaintTree {
    faces: Faces,
    tree: Bsp,
}

impl PaintTree {
    /// Builds the tree of the mesh of a question. The question's eye does not
    /// matter. Expected O(n log n).
    ///
    /// # Errors
    ///
    /// If the run is cancelled.
    pub fn new<P: Policy>(question: &LineQuestion<'_>, run: &Run<'_>) -> Result<Self, Cancelled> {
        Ok(Self::within::<P>(question, usize::MAX, run)?.unwrap_or_default())
    }

    /// The same; nothing if that takes more than `most_cuts` cuts.
    pub(super) fn within<P: Policy>(
        question: &LineQuestion<'_>,
        most_cuts: usize,
        run: &Run<'_>,
    ) -> Result<Option<Self>, Cancelled> {
        let count = question.mesh.triangles().len() as u64;
        let faces = run.stage("painted-faces", count, || faces::<P>(question, run))?;
        run.check()?;
        let predicates = Predicates::<P>::new(question.points);
        let polygons = faces.list.iter().map(|face| face.polygon.clone());
        let build = || Bsp::within(&predicates, polygons, most_cuts, run);
        let tree = run.stage("painter-tree", count, build)?;
        run.merge(&predicates.counters());
        let Some(tree) = tree else { return Ok(None) };
        run.count("painter-cuts", tree.cuts() as u64);
        run.count("painter-tree-nodes", tree.node_count() as u64);
        Ok(Some(PaintTree { faces, tree }))
    }

    /// How many cuts the tree took.
    pub fn cuts(&self) -> usize {
        self.tree.cuts()
    }

    /// The painting order for the eye of a question about the same mesh. O(n).
    ///
    /// # Errors
    ///
    /// If the view is a perspective one without a near plane.
    pub fn order<P: Policy>(
        &self,
        question: &LineQuestion<'_>,
        run: &Run<'_>,
    ) -> Result<PaintOrder, PainterError> {
        check_view(question)?;
        let predicates = Predicates::<P>::new(question.points);
        let mut pieces = Vec::with_capacity(self.tree.fragments().len());
        run.stage("painter-order", self.tree.fragments().len() as u64, || {
            self.tree.back_to_front(&predicates, |fragment| {
                let face = &self.faces.list[fragment.source as usize];
                let polygon = in_front(&predicates, fragment.polygon.clone());
                pieces.extend(polygon.map(|polygon| face.painted(question, polygon)));
            });
        });
        run.merge(&predicates.counters());
        run.count("painted-pieces", pieces.len() as u64);
        Ok(PaintOrder { pieces, cuts: self.tree.cuts() })
    }
}
