//! Flags that say where the eye is.

use crate::camera_file::read_camera;
use crate::failure::Failure;
use crate::model_flags::parse_distance;
use clap::Args;
use glam::DVec3;
use std::path::PathBuf;
use umriss::model::{Camera, Mesh, StandardView, View};

/// The camera: a named view, a direction, an eye, or a file.
#[derive(Args)]
#[command(next_help_heading = "Camera")]
pub(crate) struct CameraFlags {
    /// A named view: front, back, left, right, top, bottom; iso, iso-ne, iso-nw, iso-sw, iso-se,
    /// each also with -under; dimetric; cavalier, cabinet [default: iso]
    #[arg(long, value_name = "NAME", group = "camera-kind", value_parser = parse_view)]
    view: Option<StandardView>,
    /// Orthographic: the way the eye looks
    #[arg(long, value_name = "X,Y,Z", group = "camera-kind", allow_hyphen_values = true,
          value_parser = parse_vector)]
    direction: Option<DVec3>,
    /// Perspective: where the eye is
    #[arg(long, value_name = "X,Y,Z", group = "camera-kind", allow_hyphen_values = true,
          value_parser = parse_vector)]
    eye: Option<DVec3>,
    /// What the eye looks at [default: the centre of the models]
    #[arg(long, value_name = "X,Y,Z", requires = "eye", allow_hyphen_values = true,
          value_parser = parse_vector)]
    target: Option<DVec3>,
    /// Vertical field of view in degrees: the drawing ends there [default: 45]
    #[arg(long, value_name = "DEG", requires = "eye", value_parser = parse_angle)]
    fov: Option<f64>,
    /// What is up in the picture [default: 0,0,1; for top and bottom 0,1,0]
    #[arg(long, value_name = "X,Y,Z", conflicts_with = "camera", allow_hyphen_values = true,
          value_parser = parse_vector)]
    up: Option<DVec3>,
    /// A camera as JSON: {"kind": "perspective" or "orthographic", "eye": [x, y, z],
    /// "target": [x, y, z], "up": [x, y, z], "fov_y_deg": 45}
    #[arg(long, value_name = "FILE.json", group = "camera-kind")]
    pub(crate) camera: Option<PathBuf>,
    /// Perspective: cut lines this far in front of the eye [default: a thousandth of the distance
    /// of the target]
    #[arg(long, value_name = "D", conflicts_with_all = ["view", "direction"],
          value_parser = parse_distance)]
    near: Option<f64>,
}

impl CameraFlags {
    /// Whether any flag was given.
    pub(crate) fn any(&self) -> bool {
        let vectors = [self.direction, self.eye, self.target, self.up];
        let numbers = [self.fov, self.near];
        self.view.is_some()
            || self.camera.is_some()
            || vectors.iter().any(Option::is_some)
            || numbers.iter().any(Option::is_some)
    }

    /// The view of a mesh.
    pub(crate) fn view(&self, mesh: &Mesh) -> Result<View, Failure> {
        let view = self.camera()?.view(mesh.bounds());
        view.map_err(|error| match &self.camera {
            Some(file) => Failure::failed(format!("{}: {error}", file.display())),
            None => Failure::from(error),
        })
    }

    /// The camera that the flags describe.
    pub(crate) fn camera(&self) -> Result<Camera, Failure> {
        let up = self.up.unwrap_or(DVec3::Z);
        if let Some(file) = &self.camera {
            return read_camera(file, self.near);
        }
        if let Some(eye) = self.eye {
            let fov_y_degrees = self.fov.unwrap_or(DEFAULT_FOV);
            return Ok(Camera::Perspective {
                eye,
                target: self.target,
                up,
                near: self.near,
                fov_y_degrees,
            });
        }
        if self.near.is_some() {
            return Err(Failure::usage("--near needs a perspective camera: --eye or --camera"));
        }
        if let Some(forward) = self.direction {
            return Ok(Camera::Orthographic { forward, target: None, up });
        }
        self.standard().map(Camera::Standard)
    }

    fn standard(&self) -> Result<StandardView, Failure> {
        let Some(view) = self.view.or_else(|| StandardView::from_name("iso")) else {
            return Err(Failure::usage("--view is missing"));
        };
        match self.up {
            Some(_) if view.is_oblique() => {
                let name = view.name();
                Err(Failure::usage(format!("--up cannot be chosen for the oblique view {name}")))
            }
            Some(up) => Ok(view.with_up(up)),
            None => Ok(view),
        }
    }
}

/// Degrees, unless others are given.
pub(crate) const DEFAULT_FOV: f64 = 45.0;

fn parse_view(name: &str) -> Result<StandardView, String> {
    StandardView::from_name(name).ok_or_else(|| {
        let names: Vec<_> = StandardView::ALL.iter().map(StandardView::name).collect();
        format!("expected one of {}", names.join(", "))
    })
}

fn parse_vector(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if [x, y, z].iter().all(|number| number.is_finite()) => {
            Ok(DVec3::new(x, y, z))
        }
        _ => Err("expected three numbers, as in 1,-2,0.5".to_owned()),
    }
}

fn parse_angle(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|&angle: &f64| 0.0 < angle && angle < 180.0);
    number.ok_or_else(|| "expected degrees between 0 and 180".to_owned())
}
