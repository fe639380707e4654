//! Draws the gallery: every picture in `output/`, as SVG and as PNG.
//!
//! `cargo run --release --example gallery` writes the same bytes every time.
//! A drawing is a model, a camera and a few wishes; the command line that
//! makes the same drawing is printed beside it.

#![allow(clippy::print_stdout)]

use glam::{DVec2, DVec3};
use std::error::Error;
use std::path::Path;
use umriss::drawing::{
    Drawing, DrawingOptions, Fill, FilledShape, Hatch, Hidden, Layer, Length, LineStyle, Paper,
    Strokes, SurfaceOptions,
};
use umriss::export::{SvgOptions, to_png, to_svg, write_file};
use umriss::kernel::predicates::Exact;
use umriss::model::{
    Camera, Color, FeatureOptions, LineClass, Scene, SceneOptions, StandardView, import,
};
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};
use umriss::run::Run;
use umriss::view::{ImageRegions, PreparedView};
use umriss::visibility::{
    AppelOptions, RegionOptions, appel, image_regions, reduce, visible_regions,
};

/// One drawing of the gallery.
struct Picture {
    name: &'static str,
    model: &'static str,
    camera: Seen,
    hidden: Hidden,
    /// All edges, not only features.
    all_edges: bool,
    crease: f64,
    fill: Fill,
    /// Millimetres between the lines of a hatch by shade; none if zero.
    hatch: f64,
}

/// Where a model is seen from.
enum Seen {
    Named(&'static str),
    /// Eye, target, field of view.
    From(DVec3, DVec3, f64),
    Along(DVec3),
}

const fn features(name: &'static str, model: &'static str, camera: Seen) -> Picture {
    Picture {
        name,
        model,
        camera,
        hidden: Hidden::None,
        all_edges: false,
        crease: 30.0,
        fill: Fill::None,
        hatch: 0.0,
    }
}

fn gallery() -> Vec<Picture> {
    let dashed = |picture| Picture { hidden: Hidden::Dashed, ..picture };
    let mesh = |picture| Picture { all_edges: true, ..picture };
    let sharp = |crease, picture| Picture { crease, ..picture };
    let shaded = |picture| Picture { fill: Fill::Shade, ..picture };
    let flat = |picture| Picture { fill: Fill::Flat, ..picture };
    let hatched = |hatch, picture| Picture { hatch, ..picture };
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
        shaded(features("teapot-shaded", "teapot.obj", Seen::Along(at(-0.35, -0.45, -0.8)))),
        shaded(hatched(
            0.8,
            features(
                "city-shaded",
                "voxel_city.obj",
                Seen::From(at(-9.0, -13.0, 12.0), at(12.0, 12.0, 1.0), 50.0),
            ),
        )),
        hatched(0.6, features("gear-hatched", "gear64.obj", Seen::Named("iso"))),
        hatched(
            0.5,
            sharp(60.0, features("spot-hatched", "spot.obj", Seen::Along(at(0.8, -0.35, 0.75)))),
        ),
        shaded(hatched(0.8, features("three-bars", "three_bars.obj", Seen::Named("top")))),
        flat(hatched(
            0.8,
            features("plates-with-holes", "plates_with_holes.json", Seen::Named("iso")),
        )),
    ]
}

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for picture in gallery() {
        let pieces = draw(root, &picture)?;
        println!("{:<16} {pieces:>6} pieces   {}", picture.name, command(&picture));
    }
    draw_clip(root)?;
    println!("{:<16}", "clip");
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
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&scene.mesh, &view, &options, &run)?;
    let question = prepared.question(hidden);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run)?;
    let lines = reduce::<Exact>(&question, &answer, &run)?;
    let surfaces = SurfaceOptions { fill: picture.fill, hatch: hatch(picture), light: None };
    let regions = match surfaces == SurfaceOptions::default() {
        true => ImageRegions::default(),
        false => {
            let regions = visible_regions::<Exact>(&question, &RegionOptions::default(), &run)?;
            image_regions(&question, &regions)?
        }
    };
    let options = DrawingOptions {
        paper: Paper::A5,
        landscape: true,
        hidden: picture.hidden,
        visible_width: 0.35,
        hidden_width: 0.18,
        ..DrawingOptions::default()
    };
    let drawing = Drawing::with_regions(&lines, &regions, &surfaces, &options)?;
    write(root, picture.name, &drawing)?;
    Ok(lines.pieces.len())
}

fn write(root: &Path, name: &str, drawing: &Drawing) -> Result<(), Box<dyn Error>> {
    let svg = to_svg(drawing, &SvgOptions::default())?;
    let file = root.join("output").join(name);
    write_file(&file.with_extension("svg"), svg.as_bytes())?;
    write_file(&file.with_extension("png"), &to_png(&svg, 1000)?)?;
    Ok(())
}

fn hatch(picture: &Picture) -> Option<Hatch> {
    let spacing: Length = format!("{}mm", picture.hatch).parse().ok()?;
    (picture.hatch > 0.0).then(|| Hatch { spacing, ..Hatch::default() })
}

/// Two polygons that meet in every degenerate way, and what they have in
/// common, what either has alone: edges on edges, in the same sense and
/// against it, corners on corners, corners on edges, holes that touch.
fn draw_clip(root: &Path) -> Result<(), Box<dyn Error>> {
    let ring = |corners: &[[i32; 2]]| -> Vec<DVec2> {
        corners.iter().map(|[x, y]| DVec2::new(f64::from(*x), f64::from(*y))).collect()
    };
    let first = [
        ring(&[[0, 0], [16, 0], [16, 8], [20, 12], [16, 16], [8, 16], [8, 20], [0, 20]]),
        ring(&[[2, 2], [6, 2], [6, 6], [2, 6]]),
        ring(&[[10, 4], [14, 4], [12, 8]]),
    ];
    let second = [
        ring(&[[4, 4], [12, 4], [16, 4], [24, 4], [24, 8], [16, 8], [24, 16], [8, 16], [4, 20]]),
        // A hole on an edge of the first's hole, and one on its corner.
        ring(&[[6, 6], [6, 9], [9, 9], [9, 6]]),
        ring(&[[12, 8], [11, 11], [13, 11]]),
    ];
    let shape = |rings: &[Vec<DVec2>]| PlaneShape::new(&[rings.to_vec()], FillRule::EvenOdd);
    let (one, other) = (shape(&first)?, shape(&second)?);
    let place = |point: DVec2| DVec2::new(20.0 + 4.6 * point.x, 120.0 - 4.6 * point.y);
    let placed = |ring: &Vec<DVec2>| -> Vec<DVec2> { ring.iter().map(|&p| place(p)).collect() };
    let area = |operation, shapes: &[&PlaneShape], color| -> Result<FilledShape, Box<dyn Error>> {
        let rounded = PlaneShape::operation(operation, shapes)?.rounded()?;
        Ok(FilledShape { color, rings: rounded.polygons.iter().flatten().map(placed).collect() })
    };
    let fills = vec![
        area(Operation::Difference, &[&one, &other], Color([222, 196, 140]))?,
        area(Operation::Difference, &[&other, &one], Color([150, 184, 214]))?,
        area(Operation::Intersection, &[&one, &other], Color([122, 160, 110]))?,
    ];
    let layer = |number: u32, rings: &[Vec<DVec2>], width, color| {
        let mut strokes = Strokes::default();
        rings.iter().map(placed).for_each(|ring| {
            strokes.push(ring.iter().chain(ring.first()).copied());
        });
        Layer { number, label: number.to_string(), style: LineStyle { width, color }, strokes }
    };
    let layers = vec![
        layer(1, &first, 0.9, Color([150, 90, 20])),
        layer(2, &second, 0.35, Color([20, 60, 140])),
    ];
    write(root, "clip", &Drawing { size: DVec2::new(150.0, 140.0), scale: 1.0, layers, fills })
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
    match picture.fill {
        Fill::None => {}
        Fill::Flat => words.push("--fill flat".to_owned()),
        Fill::Shade => words.push("--fill shade".to_owned()),
    }
    if picture.hatch > 0.0 {
        words.push(format!("--hatch shade --hatch-spacing {}mm", picture.hatch));
    }
    words.push(format!("--paper a5 --landscape -o {}.svg", picture.name));
    words.join(" ")
}
