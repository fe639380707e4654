//! A scene: the objects of all files in one mesh, and what their numbers mean.

use super::{Mesh, MeshError, Soup, Unit, UpAxis};
use crate::run::Run;
use glam::DVec3;

/// How files become a scene.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SceneOptions {
    /// Merge vertices of one object that are closer than this, world units.
    pub weld: Option<f64>,
    /// The meaning of the numbers.
    pub unit: Unit,
}

/// Objects with a unit.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// All objects.
    pub mesh: Mesh,
    /// What one world unit is on paper.
    pub unit: Unit,
}

impl Scene {
    /// Makes one scene of objects, which may come from several files.
    ///
    /// # Errors
    ///
    /// If there is nothing to draw or too much to number.
    pub fn new(soups: Vec<Soup>, options: &SceneOptions) -> Result<Self, MeshError> {
        Self::within(soups, options, &Run::default())
    }

    /// As [`Scene::new`], within the limits of a run.
    ///
    /// # Errors
    ///
    /// As [`Scene::new`]; and if the run is cancelled or reaches a limit.
    pub fn within(
        soups: Vec<Soup>,
        options: &SceneOptions,
        run: &Run<'_>,
    ) -> Result<Self, MeshError> {
        Ok(Scene { mesh: Mesh::within(soups, options.weld, run)?, unit: options.unit })
    }
}

impl Soup {
    /// Turns the object so that z is up: (x, y, z) becomes (x, -z, y) if y
    /// was. Exact.
    pub fn turn_upright(&mut self, up: UpAxis) {
        if up == UpAxis::Y {
            for p in &mut self.vertices {
                *p = DVec3::new(p.x, -p.z, p.y);
            }
        }
    }
}
