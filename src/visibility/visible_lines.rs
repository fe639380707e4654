//! The whole way from a mesh and a view to the lines of a drawing.

use super::{AppelOptions, appel, reduce};
use crate::kernel::predicates::Exact;
use crate::model::{FeatureOptions, Mesh, View};
use crate::run::{Cancelled, Run};
use crate::view::{ObjectWish, PreparedView, Skips, VisibleLines};

/// Finds the lines of a mesh and which parts of them are visible, by
/// Appel's method with exact decisions; hidden parts too if wanted.
///
/// Expected O(n log n) for n triangles, lines and crossings together.
///
/// # Errors
///
/// If the run is cancelled.
///
/// ```
/// use umriss::model::{Camera, FeatureOptions, Scene, SceneOptions, StandardView, import};
/// use umriss::{run::Run, visibility::visible_lines};
///
/// let tetrahedron = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n\
///     f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
/// let model = import::read_bytes("tetrahedron.obj", tetrahedron, None)?;
/// let scene = Scene::new(model.objects, &SceneOptions::default())?;
/// let iso = StandardView::from_name("iso").ok_or("no such view")?;
/// let view = Camera::Standard(iso).view(scene.mesh.bounds())?;
///
/// let lines =
///     visible_lines(&scene.mesh, &view, &FeatureOptions::default(), false, &Run::default())?;
/// // The origin lies behind the face opposite to it, and so do its edges.
/// assert_eq!(lines.pieces.len(), 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn visible_lines(
    mesh: &Mesh,
    view: &View,
    options: &FeatureOptions,
    hidden_wanted: bool,
    run: &Run<'_>,
) -> Result<VisibleLines, Cancelled> {
    let wishes = vec![ObjectWish { features: *options, see_through: false }; mesh.objects().len()];
    let prepared = match hidden_wanted {
        true => PreparedView::with_wishes::<Exact>(mesh, view, &wishes, run)?,
        false => {
            let skips = Skips::default();
            PreparedView::for_visible_lines::<Exact>(mesh, view, &wishes, &skips, run)?
        }
    };
    let question = prepared.question(hidden_wanted);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), run)?;
    reduce::<Exact>(&question, &answer, run)
}
