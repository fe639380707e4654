//! Draws the gallery: every picture in `output/`, as SVG and as PNG.
//!
//! `cargo run --release --example gallery` writes the same bytes every time.
//! A drawing is a model, a camera and a few wishes; the command line that
//! makes the same drawing is printed beside it.

#![allow(clippy::print_stdout)]

use glam::DVec3;
use std::error::Error;
use std::path::Path;
use umriss::drawing::{Drawing, DrawingOptions, Hidden, Paper};
use umriss::export::{SvgOptions, to_png, to_svg, write_file};
use umriss::model::{Camera, FeatureOptions, LineClass, Scene, SceneOptions, StandardView, import};
use umriss::run::Run;
use umriss::visibility::visible_lines;

/// One drawing of the gallery.
struct Picture {
    name: &'static str,
    model: &'static str,
    camera: Seen,
    hidden: Hidden,
    /// All edges, not only features.
    all_edges: bool,
    crease: f64,
}

/// Where a model is seen from.
enum Seen {
    Named(&'static str),
    /// Eye, target, field of view.
    From(DVec3, DVec3, f64),
    Along(DVec3),
}

const fn features(name: &'static str, model: &'static str, camera: Seen) -> Picture {
    Picture { name, model, camera, hidden: Hidden::None, all_edges: false, crease: 30.0 }
}

fn gallery() -> Vec<Picture> {
    let dashed = |picture| Picture { hidden: Hidden::Dashed, ..picture };
    let mesh = |picture| Picture { all_edges: true, ..picture };
    let sharp = |crease, picture| Picture { crease, ..picture };
    let at = DVec3::new;
    vec![
        features("teapot", "teapot.obj", Seen::Along(at(-0.35, -0.45, -0.8))),
        sharp(20.0, features("spot", "spot.obj", Seen::Along(at(0.8, -0.35, 0.75)))),
        mesh(features("spot-mesh", "spot.obj", Seen::Along(at(0.9, -0.4, 0.8)))),
        features("wuson", "assimp_wuson.obj", Seen::Along(at(-0.6, -0.2, -0.9))),
        features("spider", "assimp_spider.obj", Seen::Along(at(-0.6, 0.7, -0.8))),
        dashed(features("gear", "gear64.obj", Seen::Named("iso"))),
        features(
            "menger",
            "menger_2.obj",
            Seen::From(at(16.0, -11.0, 13.0), at(4.5, 4.5, 4.2), 45.0),
        ),
        features(
            "city",
            "voxel_city.obj",
            Seen::From(at(-9.0, -13.0, 12.0), at(12.0, 12.0, 1.0), 50.0),
        ),
        mesh(features("torus-mesh", "torus_2k.obj", Seen::Named("iso"))),
        features("bar-heap", "bar_heap.obj", Seen::Named("dimetric")),
        mesh(features("terrain", "terrain_20.obj", Seen::Named("iso-sw"))),
        dashed(features("two-cubes", "two_cubes_interpenetrating.obj", Seen::Named("iso"))),
        dashed(features("plate-with-hole", "plate_hole.json", Seen::Named("cabinet"))),
        features("staircase", "staircase.obj", Seen::Named("cavalier")),
        dashed(features("house", "house_groups.obj", Seen::Named("iso-se"))),
        dashed(features("cube-with-hole", "cube_hole.obj", Seen::Named("iso"))),
    ]
}

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for picture in gallery() {
        let pieces = draw(root, &picture)?;
        println!("{:<16} {pieces:>6} pieces   {}", picture.name, command(&picture));
    }
    Ok(())
}

/// Draws one picture; returns the number of its pieces.
fn draw(root: &Path, picture: &Picture) -> Result<usize, Box<dyn Error>> {
    let model = import::read_file(&root.join("examples/models").join(picture.model), None)?;
    let scene = Scene::new(model.objects, &SceneOptions::default())?;
    let view = camera(&picture.camera)?.view(scene.mesh.bounds())?;
    let mut options = FeatureOptions::default().with_crease_degrees(picture.crease);
    if picture.all_edges {
        options = options.with_classes(&LineClass::ALL);
    }
    let hidden = picture.hidden != Hidden::None;
    let lines = visible_lines(&scene.mesh, &view, &options, hidden, &Run::default())?;
    let options = DrawingOptions {
        paper: Paper::A5,
        landscape: true,
        hidden: picture.hidden,
        visible_width: 0.35,
        hidden_width: 0.18,
        ..DrawingOptions::default()
    };
    let svg = to_svg(&Drawing::new(&lines, &options)?, &SvgOptions::default())?;
    let file = root.join("output").join(picture.name);
    write_file(&file.with_extension("svg"), svg.as_bytes())?;
    write_file(&file.with_extension("png"), &to_png(&svg, 1000)?)?;
    Ok(lines.pieces.len())
}

fn camera(seen: &Seen) -> Result<Camera, Box<dyn Error>> {
    Ok(match *seen {
        Seen::Named(name) => Camera::Standard(StandardView::from_name(name).ok_or("no such view")?),
        Seen::Along(forward) => {
            Camera::Orthographic { forward, target: None, up: upright(forward) }
        }
        Seen::From(eye, target, fov_y_degrees) => Camera::Perspective {
            eye,
            target: Some(target),
            up: DVec3::Z,
            near: None,
            fov_y_degrees,
        },
    })
}

/// y is up in models that were made so; their cameras look along z.
fn upright(forward: DVec3) -> DVec3 {
    if forward.z.abs() > forward.y.abs() { DVec3::Y } else { DVec3::Z }
}

/// The command that makes the same lines.
fn command(picture: &Picture) -> String {
    let list = |v: DVec3| format!("{},{},{}", v.x, v.y, v.z);
    let camera = match picture.camera {
        Seen::Named(name) => format!("--view {name}"),
        Seen::Along(forward) => {
            format!("--direction {} --up {}", list(forward), list(upright(forward)))
        }
        Seen::From(eye, target, fov) => {
            format!("--eye {} --target {} --fov {fov}", list(eye), list(target))
        }
    };
    let mut words = vec![format!("umriss draw examples/models/{} {camera}", picture.model)];
    if picture.hidden == Hidden::Dashed {
        words.push("--hidden dashed".to_owned());
    }
    if picture.all_edges {
        let names: Vec<_> = LineClass::ALL.iter().map(|class| class.name()).collect();
        words.push(format!("--edges {}", names.join(",")));
    }
    if picture.crease != 30.0 {
        words.push(format!("--crease {}", picture.crease));
    }
    words.push(format!("--paper a5 --landscape -o {}.svg", picture.name));
    words.join(" ")
}
