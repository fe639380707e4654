//! From a mesh and a camera to a question: everything that all line methods
//! need and none should compute twice.

use super::wishes;
use super::{Contacts, Covered, Culling, LineQuestion, ObjectWish, Skips};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Points, Policy};
use crate::model::{
    ConvexParts, EffectiveEdge, Fans, FeatureLine, FeatureOptions, Features, Intersections, Known,
    LineClass, Mesh, View, ViewCoordinates, facing, triangle_hierarchy,
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
    /// Whether what is certainly hidden was left out.
    culled: bool,
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
        Self::prepare::<P>(mesh, view, wishes, (skips, false), run)
    }

    /// As [`PreparedView::with_skips`], for visible pieces of lines and nothing
    /// else: what certainly lies behind something is left out before crossings
    /// are searched, where that pays. The lines that are left out have no
    /// visible piece; those that stay have the same ones. Faces are not to be
    /// asked for, nor hidden pieces.
    ///
    /// # Errors
    ///
    /// If the run is cancelled or reaches a limit.
    pub fn for_visible_lines<P: Policy>(
        mesh: &'m Mesh,
        view: &View,
        wishes: &[ObjectWish],
        skips: &Skips,
        run: &Run,
    ) -> Result<Self, Cancelled> {
        Self::prepare::<P>(mesh, view, wishes, (skips, true), run)
    }

    fn prepare<P: Policy>(
        mesh: &'m Mesh,
        view: &View,
        wishes: &[ObjectWish],
        (skips, visible_only): (&Skips, bool),
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
        let (facing, features) = run.stage("features", triangles, || {
            let mut facing = facing::<P>(mesh, &points, run);
            let features = wishes::find::<P>(mesh, &points, &mut facing, wishes, run);
            (facing, features)
        });
        run.check()?;
        let mut prepared = PreparedView {
            mesh,
            view: *view,
            points,
            coordinates,
            facing,
            features,
            culled: visible_only,
            convex: None,
            intersections: None,
            hierarchy: OnceLock::new(),
        };
        let covered = match visible_only {
            false => None,
            true => run.stage("culling", triangles, || prepared.cull(skips.culling, run))?,
        };
        // With many lines, finding all piercings at once is cheaper than
        // asking for each line.
        let many = prepared.features.lines.len() > mesh.edges().len() / MANY_LINES;
        let wanted = wishes.iter().any(|wish| wish.features.wants(LineClass::Intersection));
        if wanted || many {
            prepared.find_crossings::<P>(skips, run)?;
        }
        let Features { lines, effective } = &prepared.features;
        let made =
            lines.len() * size_of::<FeatureLine>() + effective.len() * size_of::<EffectiveEdge>();
        run.take(made as u64)?;
        if wanted {
            prepared.add_intersection_lines::<P>(wishes, covered.as_ref(), run);
        }
        run.check()?;
        Ok(prepared)
    }

    /// Leaves out what certainly lies behind something, if that is worth it:
    /// lines, and triangles as if they were edge-on.
    fn cull(&mut self, culling: Culling, run: &Run) -> Result<Option<Covered>, Cancelled> {
        let question = self.question(false);
        let Some(covered) = Covered::find(&question, culling, run)? else { return Ok(None) };
        let shown = covered.shown(&question, question.lines);
        let lines = std::mem::replace(&mut self.features.lines, shown).len();
        run.count("lines-covered", (lines - self.features.lines.len()) as u64);
        let mut others = Vec::new();
        for (triangle, &gone) in covered.triangles().iter().enumerate() {
            if gone {
                self.facing[triangle] = Sign::Zero;
            } else {
                others.push(triangle as u32);
            }
        }
        self.features.effective = EffectiveEdge::find(self.mesh, &self.facing);
        let hierarchy = triangle_hierarchy(self.mesh, &self.coordinates, Some(others));
        self.hierarchy = OnceLock::from(hierarchy);
        run.check()?;
        Ok(Some(covered))
    }

    /// Searches where triangles cross, with what spares looking at all pairs.
    fn find_crossings<P: Policy>(&mut self, skips: &Skips, run: &Run) -> Result<(), Cancelled> {
        let PreparedView { mesh, points, coordinates, facing, features, .. } = &*self;
        let triangles = mesh.triangles().len() as u64;
        let convex = match skips.convex {
            false => None,
            true => run.stage("convex parts", triangles, || {
                ConvexParts::find::<P>(mesh, points, &self.view, facing, run)
            })?,
        };
        let hierarchy = run.stage("hierarchy", triangles, || {
            self.hierarchy.get_or_init(|| triangle_hierarchy(mesh, coordinates, None))
        });
        run.check()?;
        let fans = run.stage("fans", triangles, || {
            Fans::find(mesh, coordinates, facing, &features.effective)
        });
        run.check()?;
        let known = Known { fans: Some(&fans), convex: convex.as_ref() };
        let found = run.stage("intersections", triangles, || {
            Intersections::find::<P>(mesh, points, hierarchy, known, run)
        })?;
        (self.convex, self.intersections) = (convex, Some((fans, found)));
        Ok(())
    }

    /// Makes lines of the crossings that are wished for, but for those that
    /// are hidden all along.
    fn add_intersection_lines<P: Policy>(
        &mut self,
        wishes: &[ObjectWish],
        covered: Option<&Covered>,
        run: &Run,
    ) {
        let question = self.question(false);
        let mut lines = wishes::crossings::<P>(&question, wishes, run);
        if let Some(covered) = covered {
            lines = covered.shown(&question, &lines);
        }
        self.features.lines.extend_from_slice(&lines);
    }

    /// The question which parts of the lines are visible. A view that was
    /// prepared for visible lines alone has no hidden ones to ask for.
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
            hidden_wanted: hidden_wanted && !self.culled,
            culled: self.culled,
            window: None,
        }
    }

    /// The view.
    pub fn view(&self) -> &View {
        &self.view
    }
}
