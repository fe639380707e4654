//! Camera files as the program takes them (`--camera`), for tests over a
//! folder of models and their cameras.

use glam::DVec3;
use std::error::Error;
use std::path::{Path, PathBuf};
use umriss::model::Camera;

/// The camera files of a model, with the name of each view: those called
/// `cameras/MODEL_VIEW.json`, in the order of [`VIEWS`].
pub(crate) fn camera_files(model: &Path) -> Vec<(&'static str, PathBuf)> {
    let folder = model.with_file_name("cameras");
    let stem = model.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
    let file = |view| (view, folder.join(format!("{stem}_{view}.json")));
    VIEWS.into_iter().map(file).filter(|(_, path)| path.exists()).collect()
}

/// The views for which there may be a camera.
const VIEWS: [&str; 6] = ["front", "gen", "iso", "near", "persp", "top"];

/// Reads a camera.
pub(crate) fn read_camera(path: &Path) -> Result<Camera, Box<dyn Error>> {
    let value: serde_json::Value = serde_json::from_slice(&std::fs::read(path)?)?;
    let vector = |key: &str| {
        let number = |i: usize| value[key][i].as_f64().ok_or("a camera without a number");
        Ok::<_, &str>(DVec3::new(number(0)?, number(1)?, number(2)?))
    };
    let (eye, target, up) = (vector("eye")?, vector("target")?, vector("up")?);
    Ok(if value["kind"] == "perspective" {
        let fov_y_degrees = value["fov_y_deg"].as_f64().unwrap_or(45.0);
        Camera::Perspective { eye, target: Some(target), up, near: None, fov_y_degrees }
    } else {
        Camera::Orthographic { forward: target - eye, target: Some(target), up }
    })
}
