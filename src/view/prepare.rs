//! From a mesh and a camera to a question: everything that all line methods
//! need and none should compute twice.

use super::wishes;
use super::{Contacts, LineQuestion, ObjectWish, Skips};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Points, Policy};
use crate::model::{
    ConvexParts, EffectiveEdge, Fans, FeatureLine, FeatureOptions, Features, Intersections, Known,
    LineClass, LineOrigin, Mesh, View, ViewCoordinates, facing, triangle_hierarchy,
};
use crate::run::{Cancelled, Run};
use crate::spatial::Hierarchy;
use std::sync::OnceLock;

/// One line in this many edges makes it worth finding all piercings.
const MANY_LINES: usize = 8;

/// What a view takes beside its mesh: places and boxes of vertices and of
/// triangles.
fn bytes_of_view(mesh: &Mesh) -> u64 {
    let vertices = mesh.vertices().len() * (size_of::<[f64; 3]>() + size_of::<[f32; 8]>());
    let triangles = mesh.triangles().len() * (size_of::<[f32; 6]>() + 2 * size_of::<u32>());
    (vertices + triangles) as u64
}

/// A mesh as one eye sees it.
#[derive(Debug, Clone)]
pub struct PreparedView<'m> {
    mesh: &'m Mesh,
    view: View,
    points: Points,
    coordinates: ViewCoordinates,
    facing: Vec<Sign>,
    features: Features,
    convex: Option<ConvexParts>,
    intersections: Option<(Fans, Intersections)>,
    /// Made when it is asked for.
    hierarchy: OnceLock<Hierarchy>,
}

impl<'m> PreparedView<'m> {
    /// Scales the coordinates, classifies the edges and, if intersection
    /// lines are wanted, searches them. Expected O(n log n).
    ///
    /// # Errors
    ///
    /// If the run is cancelled or reaches a limit.
    pub fn new<P: Policy>(
        mesh: &'m Mesh,
        view: &View,
        options: &FeatureOptions,
        run: &Run,
    ) -> Result<Self, Cancelled> {
        let wish = ObjectWish { features: *options, see_through: false };
        Self::with_wishes::<P>(mesh, view, &vec![wish; mesh.objects().len()], run)
    }

    /// As [`PreparedView::new`], with a wish for each object of the mesh.
    ///
    /// # Errors
    ///
    /// If the run is cancelled or reaches a limit.
    pub fn with_wishes<P: Policy>(
        mesh: &'m Mesh,
        view: &View,
        wishes: &[ObjectWish],
        run: &Run,
    ) -> Result<Self, Cancelled> {
        Self::with_skips::<P>(mesh, view, wishes, &Skips::default(), run)
    }

    /// As [`PreparedView::with_wishes`], with or without shortcuts.
    ///
    /// # Errors
    ///
    /// If the run is cancelled or reaches a limit.
    pub fn with_skips<P: Policy>(
        mesh: &'m Mesh,
        view: &View,
        wishes: &[ObjectWish],
        skips: &Skips,
        run: &Run,
    ) -> Result<Self, Cancelled> {
        let triangles = mesh.triangles().len() as u64;
        run.take(bytes_of_view(mesh))?;
        let (points, coordinates) = run.stage("coordinates", triangles, || {
            (
                Points::new(mesh.vertices(), view.eye, view.near),
                ViewCoordinates::new(&view.frame, mesh.vertices()),
            )
        });
        run.check()?;
        let (facing, mut features) = run.stage("features", triangles, || {
            let mut facing = facing::<P>(mesh, &points, run);
            let features = wishes::find::<P>(mesh, &points, &mut facing, wishes, run);
            (facing, features)
        });
        run.check()?;
        // With many lines, finding all piercings at once is cheaper than
        // asking for each line.
        let many = features.lines.len() > mesh.edges().len() / MANY_LINES;
        let wanted = wishes.iter().any(|wish| wish.features.wants(LineClass::Intersection));
        let convex = match (wanted || many) && skips.convex {
            false => None,
            true => run.stage("convex parts", triangles, || {
                ConvexParts::find::<P>(mesh, &points, view, &facing, run)
            })?,
        };
        let hierarchy = OnceLock::new();
        let intersections = match wanted || many {
            false => None,
            true => {
                let hierarchy = run.stage("hierarchy", triangles, || {
                    hierarchy.get_or_init(|| triangle_hierarchy(mesh, &coordinates))
                });
                run.check()?;
                let fans = run.stage("fans", triangles, || {
                    Fans::find(mesh, &coordinates, &facing, &features.effective)
                });
                run.check()?;
                let known = Known { fans: Some(&fans), convex: convex.as_ref() };
                let found = run.stage("intersections", triangles, || {
                    Intersections::find::<P>(mesh, &points, hierarchy, known, run)
                })?;
                Some((fans, found))
            }
        };
        let made = features.lines.len() * size_of::<FeatureLine>()
            + features.effective.len() * size_of::<EffectiveEdge>();
        run.take(made as u64)?;
        if wanted && let Some((_, found)) = &intersections {
            let all = 0..found.lines.len() as u32;
            features.lines.extend(all.map(|index| FeatureLine {
                origin: LineOrigin::Intersection(index),
                class: LineClass::Intersection,
            }));
        }
        run.check()?;
        Ok(PreparedView {
            mesh,
            view: *view,
            points,
            coordinates,
            facing,
            features,
            convex,
            intersections,
            hierarchy,
        })
    }

    /// The question which parts of the lines are visible.
    pub fn question(&self, hidden_wanted: bool) -> LineQuestion<'_> {
        LineQuestion {
            mesh: self.mesh,
            points: &self.points,
            frame: &self.view.frame,
            coordinates: &self.coordinates,
            facing: &self.facing,
            lines: &self.features.lines,
            effective: &self.features.effective,
            intersections: self.intersections.as_ref().map_or(&[], |(_, found)| &found.lines),
            piercings: self.intersections.as_ref().map(|(_, found)| &found.piercings),
            contacts: self
                .intersections
                .as_ref()
                .map(|(fans, found)| Contacts { fans, touching: &found.touching }),
            convex: self.convex.as_ref(),
            hierarchy: &self.hierarchy,
            hidden_wanted,
            window: None,
        }
    }

    /// The view.
    pub fn view(&self) -> &View {
        &self.view
    }
}
