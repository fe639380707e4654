//! What the floating horizon is asked: lines of a surface over a grid.

use super::LineQuestion;
use crate::kernel::predicates::Points;
use crate::model::surface::{CurveOptions, Curves, Surface};
use crate::model::{FeatureLine, LineClass, LineOrigin, Mesh, MeshError, View, ViewCoordinates};
use crate::run::Run;
use crate::spatial::Hierarchy;
use std::sync::OnceLock;

/// Which parts of the lines of a surface are visible?
#[derive(Debug, Clone, Copy)]
pub struct SurfaceQuestion<'a> {
    /// The surface.
    pub surface: &'a Surface,
    /// Which of its lines are drawn.
    pub curves: &'a Curves,
    /// The eye: its exact part is in the points of `lines` too.
    pub view: &'a View,
    /// The drawn lines, as loose lines without a face.
    pub lines: LineQuestion<'a>,
}

/// A surface as one eye sees it.
#[derive(Debug, Clone)]
pub struct PreparedSurface<'s> {
    surface: &'s Surface,
    curves: Curves,
    view: View,
    mesh: Mesh,
    points: Points,
    coordinates: ViewCoordinates,
    lines: Vec<FeatureLine>,
    hierarchy: OnceLock<Hierarchy>,
}

/// What a point takes: itself and its number, its place and its box, two lines
/// in mesh and question.
const POINT_BYTES: usize = 24 + 4 + 24 + 32 + 2 * (8 + size_of::<FeatureLine>());

impl<'s> PreparedSurface<'s> {
    /// Scales the coordinates and numbers the lines. O(n).
    ///
    /// # Errors
    ///
    /// If nothing is to be drawn, or the run reaches a limit.
    pub fn new(
        name: &str,
        surface: &'s Surface,
        view: &View,
        options: &CurveOptions,
        run: &Run<'_>,
    ) -> Result<Self, MeshError> {
        run.take((surface.heights().values().len() * POINT_BYTES) as u64)?;
        let curves = Curves::new(surface, options);
        let mesh = surface.mesh_of_curves(name, &curves)?;
        let vertices = mesh.vertices();
        let (points, coordinates) = run.stage("coordinates", vertices.len() as u64, || {
            (
                Points::new(vertices, view.eye, view.near),
                ViewCoordinates::new(&view.frame, vertices),
            )
        });
        let line = |index| FeatureLine { origin: LineOrigin::Loose(index), class: LineClass::Line };
        Ok(PreparedSurface {
            surface,
            view: *view,
            points,
            coordinates,
            lines: (0..curves.len() as u32).map(line).collect(),
            hierarchy: OnceLock::new(),
            curves,
            mesh,
        })
    }

    /// The question which parts of the lines are visible.
    pub fn question(&self, hidden_wanted: bool) -> SurfaceQuestion<'_> {
        SurfaceQuestion {
            surface: self.surface,
            curves: &self.curves,
            view: &self.view,
            lines: LineQuestion {
                mesh: &self.mesh,
                points: &self.points,
                frame: &self.view.frame,
                coordinates: &self.coordinates,
                facing: &[],
                lines: &self.lines,
                effective: &[],
                intersections: &[],
                piercings: None,
                contacts: None,
                convex: None,
                hierarchy: &self.hierarchy,
                hidden_wanted,
                culled: false,
                window: None,
            },
        }
    }
}
