//! Models, views and drawings, made as the program makes them.

use super::Outcome;
use glam::DVec3;
use std::path::{Path, PathBuf};
use umriss::export::{DrawingNotes, to_json_with_notes};
use umriss::model::{
    Camera, FeatureOptions, LineClass, Mesh, Scene, SceneOptions, StandardView, View, import,
};
use umriss::run::Run;
use umriss::visibility::visible_lines;

/// Which lines are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Lines {
    /// Visible parts of the lines that are drawn unless others are asked for.
    Visible,
    /// Every edge, hidden parts too.
    Every,
}

impl Lines {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Lines::Visible => "visible",
            Lines::Every => "every",
        }
    }

    fn options(self) -> FeatureOptions {
        match self {
            Lines::Visible => FeatureOptions::default(),
            Lines::Every => FeatureOptions::default().with_classes(&LineClass::ALL),
        }
    }
}

/// The models of a folder, by name.
pub(crate) fn models(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
    let mut files: Vec<PathBuf> = entries.collect::<Outcome<_>>()?;
    files.retain(|path| {
        let extension = path.extension().and_then(|extension| extension.to_str());
        extension.is_some_and(|text| ["obj", "json", "off", "stl"].contains(&text))
    });
    files.sort();
    Ok(files)
}

pub(crate) fn scene(file: &Path) -> Outcome<Scene> {
    let imported = import::read_file(file, None)?;
    let stem = file.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
    let mut soups = imported.objects;
    for soup in &mut soups {
        soup.turn_upright(imported.placement.up);
        if soup.name.is_empty() {
            stem.clone_into(&mut soup.name);
        }
    }
    let options = SceneOptions { unit: imported.placement.unit, ..SceneOptions::default() };
    Ok(Scene::new(soups, &options)?)
}

/// A direction along which nothing is modelled.
pub(crate) const GENERIC: DVec3 = DVec3::new(0.37, 0.71, -0.43);

/// The eye of a perspective view: beside a corner of the models' box.
pub(crate) fn eye_of(mesh: &Mesh) -> DVec3 {
    let (low, high) = mesh.bounds();
    let size = (high - low).max_element();
    high + DVec3::new(0.75, -1.5, 0.25) * size
}

pub(crate) fn view_of(name: &str, mesh: &Mesh) -> Outcome<View> {
    let up = DVec3::Z;
    let camera = match name {
        "generic" => Camera::Orthographic { forward: GENERIC, target: None, up },
        "eye" => Camera::Perspective {
            eye: eye_of(mesh),
            target: None,
            up,
            near: None,
            fov_y_degrees: 45.0,
        },
        _ => Camera::Standard(StandardView::from_name(name).ok_or("no such view")?),
    };
    Ok(camera.view(mesh.bounds())?)
}

/// How many pieces a drawing has, and the file.
pub(crate) fn drawing(scene: &Scene, view: &View, lines: Lines) -> Outcome<(usize, Vec<u8>)> {
    let hidden = lines == Lines::Every;
    let found = visible_lines(&scene.mesh, view, &lines.options(), hidden, &Run::default())?;
    let notes = DrawingNotes {
        unit: Some(scene.unit),
        hidden: Some(hidden),
        outline: None,
        crossings: None,
    };
    Ok((found.pieces.len(), to_json_with_notes(&found, &notes)?))
}
