//! Cameras from JSON files.

use crate::camera_flags::DEFAULT_FOV;
use crate::failure::Failure;
use crate::input::read_settings;
use glam::DVec3;
use serde::Deserialize;
use std::path::Path;
use umriss::model::Camera;
use umriss::model::import::json_message;

/// A camera as it stands in a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraText {
    kind: Kind,
    eye: [f64; 3],
    target: [f64; 3],
    #[serde(default = "z")]
    up: [f64; 3],
    fov_y_deg: Option<f64>,
}

#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Orthographic,
    Perspective,
}

fn z() -> [f64; 3] {
    DVec3::Z.to_array()
}

/// Reads a camera; `near` is the near plane asked for on the command line.
pub(crate) fn read_camera(file: &Path, near: Option<f64>) -> Result<Camera, Failure> {
    let name = file.display();
    let bytes = read_settings(file)
        .map_err(|error| Failure::failed(format!("{name}: cannot be read: {error}")))?;
    let text: CameraText = serde_json::from_slice(&bytes).map_err(|error| {
        let message = json_message(&error, "a camera");
        Failure::failed(format!("{name}:{}: column {}: {message}", error.line(), error.column()))
    })?;
    let [eye, target, up] = [text.eye, text.target, text.up].map(DVec3::from_array);
    match text.kind {
        Kind::Perspective => {
            let fov_y_degrees = text.fov_y_deg.unwrap_or(DEFAULT_FOV);
            Ok(Camera::Perspective { eye, target: Some(target), up, near, fov_y_degrees })
        }
        Kind::Orthographic if near.is_some() => {
            Err(Failure::usage(format!("--near needs a perspective camera, but {name} has none")))
        }
        Kind::Orthographic => {
            Ok(Camera::Orthographic { forward: target - eye, target: Some(target), up })
        }
    }
}
