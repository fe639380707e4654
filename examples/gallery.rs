//! Draws the gallery: every picture in `output/`, as SVG and as PNG.
//!
//! `cargo run --release --example gallery` writes the same bytes every time
//! and prints the command that makes each drawing. The commands are where
//! the drawings come from: their flags are read here as the program reads
//! them. Names after it draw only those pictures.

#![allow(clippy::print_stdout)]

use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;
use std::str::FromStr;
use umriss::drawing::{
    Content, Drawing, DrawingOptions, Effort, Fill, FilledShape, Hatch, Layer, LayerTags,
    LineStyle, Preset, Strokes, Styles, SurfaceOptions, Weight, matches, read_styles,
};
use umriss::exact;
use umriss::export::{SvgOptions, to_png, to_svg, write_file};
use umriss::model::surface::{CurveOptions, Heights, Surface};
use umriss::model::{
    Camera, Color, FeatureOptions, LineClass, Mesh, Scene, SceneOptions, StandardView, View, import,
};
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};
use umriss::run::Run;
use umriss::view::{ImageRegions, LineQuestion, ObjectWish, PreparedSurface};
use umriss::visibility::{
    AppelOptions, PainterFault, PainterOptions, RegionOptions, image_regions, painted_image,
};

/// Name, model and flags of every drawing.
const GALLERY: [(&str, &str, &str); 35] = [
    ("teapot", "teapot.obj", "--direction -0.35,-0.45,-0.8 --up 0,1,0 --style fine.toml"),
    ("spot", "spot.obj", "--direction 0.8,-0.35,0.75 --up 0,1,0 --crease 20 --style fine.toml"),
    ("spot-mesh", "spot.obj", "--direction 0.9,-0.4,0.8 --up 0,1,0 --edges ALL --style fine.toml"),
    ("wuson", "assimp_wuson.obj", "--direction -0.6,-0.2,-0.9 --up 0,1,0 --style fine.toml"),
    ("spider", "assimp_spider.obj", "--direction -0.6,0.7,-0.8 --up 0,1,0 --style fine.toml"),
    ("gear", "gear64.obj", "--view iso --hidden dashed --style fine.toml"),
    ("menger", "menger_2.obj", "--eye 16,-11,13 --target 4.5,4.5,4.2 --fov 45 --style fine.toml"),
    ("city", "voxel_city.obj", "--eye -9,-13,12 --target 12,12,1 --fov 50 --style fine.toml"),
    ("torus-mesh", "torus_2k.obj", "--view iso --edges ALL --style fine.toml"),
    ("bar-heap", "bar_heap.obj", "--view dimetric --style fine.toml"),
    ("terrain", "terrain_20.obj", "--view iso-sw --edges ALL --style fine.toml"),
    ("two-cubes", "two_cubes_interpenetrating.obj", "--view iso --hidden dashed --style fine.toml"),
    ("plate-with-hole", "plate_hole.json", "--view cabinet --hidden dashed --style fine.toml"),
    ("staircase", "staircase.obj", "--view cavalier --style fine.toml"),
    ("house", "house_groups.obj", "--view iso-se --hidden dashed --style fine.toml"),
    ("cube-with-hole", "cube_hole.obj", "--view iso --hidden dashed --style fine.toml"),
    // Lines interrupted behind others, wider in front, told apart by depth.
    (
        "knot-halo",
        "knot_wire.obj",
        "--direction 0.2,0.35,-1 --up 0,1,0 --halo 3mm --weight 1.4..0.25mm",
    ),
    ("woven-halo", "woven.obj", "--direction 0.5,0.7,-0.8 --halo 1.6mm --weight 0.9..0.25mm"),
    ("bar-heap-halo", "bar_heap.obj", "--view dimetric --halo 1.6mm --weight 0.9..0.13mm"),
    (
        "city-weight",
        "voxel_city.obj",
        "--eye -9,-13,12 --target 12,12,1 --fov 50 --weight 1..0.1mm --weight-steps 12 --halo 0.6mm",
    ),
    (
        "menger-weight",
        "menger_2.obj",
        "--eye 16,-11,13 --target 4.5,4.5,4.2 --fov 45 --weight 1..0.1mm --halo 0.7mm",
    ),
    (
        "torus-x-ray",
        "torus_2k.obj",
        "--direction 0.5,0.6,-0.62 --edges ALL --hidden solid --hidden-by sheets --style x-ray.toml",
    ),
    (
        "gear-sheets",
        "gear64.obj",
        "--view iso --hidden dashed --hidden-by sheets --style x-ray.toml --halo 1mm",
    ),
    (
        "house-open",
        "house_groups.obj",
        "--view iso-se --see-through walls,roof --style three-pens.toml --halo 1mm",
    ),
    ("teapot-sketch", "teapot.obj", "--direction -0.35,-0.45,-0.8 --up 0,1,0 --preset sketch"),
    (
        "plotter",
        "cube_hole.stl",
        "--view iso --hidden dashed --halo 1.5mm --order best --style three-pens.toml",
    ),
    (
        "spider-weight",
        "assimp_spider.obj",
        "--direction -0.6,0.7,-0.8 --up 0,1,0 --weight 0.8..0.1mm --halo 0.8mm",
    ),
    // What is seen of the surfaces, filled or hatched.
    (
        "teapot-shaded",
        "teapot.obj",
        "--direction -0.35,-0.45,-0.8 --up 0,1,0 --fill shade --style fine.toml",
    ),
    (
        "city-shaded",
        "voxel_city.obj",
        "--eye -9,-13,12 --target 12,12,1 --fov 50 --fill shade --hatch shade --hatch-spacing 0.8mm --style fine.toml",
    ),
    (
        "gear-hatched",
        "gear64.obj",
        "--view iso --hatch shade --hatch-spacing 0.6mm --style fine.toml",
    ),
    (
        "spot-hatched",
        "spot.obj",
        "--direction 0.8,-0.35,0.75 --up 0,1,0 --crease 60 --hatch shade --hatch-spacing 0.5mm --style fine.toml",
    ),
    (
        "three-bars",
        "three_bars.obj",
        "--view top --fill shade --hatch shade --hatch-spacing 0.8mm --style fine.toml",
    ),
    (
        "plates-with-holes",
        "plates_with_holes.json",
        "--view iso --fill flat --hatch shade --hatch-spacing 0.8mm --style fine.toml",
    ),
    // Painted back to front.
    ("gear-painted", "gear64.obj", "--view iso --method painter --fill shade --style fine.toml"),
    (
        "three-bars-painted",
        "three_bars.obj",
        "--view top --method painter --fill shade --style fine.toml",
    ),
];

/// Name, expression or file of heights, and flags of every surface.
const SURFACES: [(&str, &str, &str); 3] = [
    (
        "surface-waves",
        "sin(x)*cos(z)",
        "--x -6..6 --z -6..6 --nx 121 --nz 121 --every 2 --view iso-sw --base -2.5 --style fine.toml",
    ),
    (
        "surface-ridges",
        "4*exp(-(x^2+z^2)/20)*cos(2*sqrt(x^2+z^2))",
        "--x -9..9 --z -9..9 --nx 361 --nz 121 --curves z --no-borders --direction 0,1,-0.7 --style fine.toml",
    ),
    (
        "island",
        "island.png",
        "--z-scale 0.0007 --every 2 --eye 60,-330,190 --fov 35 --style fine.toml",
    ),
];

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    for (name, model, flags) in GALLERY {
        if wanted.is_empty() || wanted.iter().any(|one| one == name) {
            let flags = Flags::read(&format!("{flags} --paper a5 --landscape"))?;
            let pieces = draw(root, name, model, &flags)?;
            println!("{name:<16} {pieces:>6} pieces   {}", flags.command(name, model));
        }
    }
    for (name, source, flags) in SURFACES {
        if wanted.is_empty() || wanted.iter().any(|one| one == name) {
            let flags = Flags::read(&format!("{flags} --paper a5 --landscape"))?;
            let pieces = draw_surface(root, name, source, &flags)?;
            println!("{name:<16} {pieces:>6} pieces   {}", flags.surface_command(name, source));
        }
    }
    for (name, draw) in [("clip", draw_clip as fn(&Path, &str) -> _), ("three-bars-by-depth", bars)]
    {
        if wanted.is_empty() || wanted.iter().any(|one| one == name) {
            draw(root, name)?;
            println!("{name}");
        }
    }
    Ok(())
}

/// Draws one picture; returns the number of its pieces.
fn draw(root: &Path, name: &str, model: &str, flags: &Flags) -> Result<usize, Box<dyn Error>> {
    let model = import::read_file(&root.join("examples/models").join(model), None)?;
    let scene = Scene::new(model.objects, &SceneOptions::default())?;
    let (options, run) = (flags.options()?, Run::default());
    let styles = flags.styles(root)?;
    let (view, wishes) = (flags.view(scene.mesh.bounds())?, flags.wishes(&scene.mesh)?);
    let prepared = exact::prepare_with_wishes(&scene.mesh, &view, &wishes, &run)?;
    let question = prepared.question(flags.get("hidden").is_some());
    if flags.get("method") == Some("painter") {
        return paint(root, name, &question, flags, None);
    }
    let answer = exact::appel(&question, &AppelOptions::default(), &run)?;
    let (lines, crossings) = exact::reduce_with_crossings(&question, &answer, &run)?;
    let surfaces = flags.surfaces()?;
    let regions = match surfaces == SurfaceOptions::default() {
        true => ImageRegions::default(),
        false => {
            let regions = exact::visible_regions(&question, &RegionOptions::default(), &run)?;
            image_regions(&question, &regions)?
        }
    };
    let content = Content { lines: &lines, crossings: &crossings, regions: &regions };
    let mut drawing = Drawing::of(&content, &options, &styles, &surfaces)?;
    drawing.order(flags.effort()?);
    write(root, name, &drawing)?;
    Ok(lines.pieces.len())
}

/// Paints one picture back to front; returns the number of its pieces.
fn paint(
    root: &Path,
    name: &str,
    question: &LineQuestion<'_>,
    flags: &Flags,
    fault: Option<PainterFault>,
) -> Result<usize, Box<dyn Error>> {
    let options = PainterOptions { fault, ..PainterOptions::default() };
    let order = exact::paint_order(question, &options, &Run::default())?;
    let (faces, lines) = painted_image(question, &order)?;
    let (styles, surfaces) = (flags.styles(root)?, flags.surfaces()?);
    let drawing = Drawing::painted(&faces, &lines, &flags.options()?, &styles, &surfaces)?;
    write(root, name, &drawing)?;
    Ok(order.pieces.len())
}

/// Three bars, each over the next one, as painters without planes paint them:
/// by depth alone.
fn bars(root: &Path, name: &str) -> Result<(), Box<dyn Error>> {
    let model = import::read_file(&root.join("examples/models/three_bars.obj"), None)?;
    let scene = Scene::new(model.objects, &SceneOptions::default())?;
    let flags = "--view top --fill shade --style fine.toml --paper a5 --landscape";
    let flags = Flags::read(flags)?;
    let view = flags.view(scene.mesh.bounds())?;
    let options = FeatureOptions::default();
    let prepared = exact::prepare(&scene.mesh, &view, &options, &Run::default())?;
    paint(root, name, &prepared.question(false), &flags, Some(PainterFault::DepthOnly))?;
    Ok(())
}

/// Draws one surface; returns the number of its pieces.
fn draw_surface(
    root: &Path,
    name: &str,
    source: &str,
    flags: &Flags,
) -> Result<usize, Box<dyn Error>> {
    let heights = if source.ends_with(".png") {
        import::read_heights(&root.join("examples/models").join(source), None)?.heights
    } else {
        let steps = |axis, range, count| -> Result<Vec<f64>, Box<dyn Error>> {
            let text = flags.get(range).ok_or("a range is missing")?;
            let (from, to) = text.split_once("..").ok_or("expected a range")?;
            Ok(Heights::steps(axis, [from.parse()?, to.parse()?], flags.parse(count, 100)?)?)
        };
        Heights::of_expression(source, steps('x', "x", "nx")?, steps('z', "z", "nz")?)?
    };
    let base = flags.get("base").map(str::parse).transpose()?;
    let surface = Surface::new(heights.scaled(flags.parse("z-scale", 1.0)?)?, base)?;
    let curves = CurveOptions {
        constant_x: flags.get("curves").is_none(),
        borders: flags.get("no-borders").is_none(),
        every: flags.parse("every", 1)?,
        ..CurveOptions::default()
    };
    let (run, view) = (Run::default(), flags.view(surface.bounds())?);
    let prepared = PreparedSurface::new(source, &surface, &view, &curves, &run)?;
    let question = prepared.question(false);
    let answer = exact::floating_horizon(&question, &run)?;
    let lines = exact::reduce(&question.lines, &answer, &run)?;
    let regions = ImageRegions::default();
    let content = Content { lines: &lines, crossings: &[], regions: &regions };
    let styles = flags.styles(root)?;
    let drawing = Drawing::of(&content, &flags.options()?, &styles, &SurfaceOptions::default())?;
    write(root, name, &drawing)?;
    Ok(lines.pieces.len())
}

fn write(root: &Path, name: &str, drawing: &Drawing) -> Result<(), Box<dyn Error>> {
    let svg = to_svg(drawing, &SvgOptions::default())?;
    let file = root.join("output").join(name);
    write_file(&file.with_extension("svg"), svg.as_bytes())?;
    write_file(&file.with_extension("png"), &to_png(&svg, 1000)?)?;
    Ok(())
}

/// Two polygons that meet in every degenerate way, and what they have in
/// common, what either has alone: edges on edges, in the same sense and
/// against it, corners on corners, corners on edges, holes that touch.
fn draw_clip(root: &Path, name: &str) -> Result<(), Box<dyn Error>> {
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
        let style = LineStyle { width, color };
        Layer { number, label: number.to_string(), style, strokes, tags: LayerTags::default() }
    };
    let layers = vec![
        layer(1, &first, 0.9, Color([150, 90, 20])),
        layer(2, &second, 0.35, Color([20, 60, 140])),
    ];
    let size = DVec2::new(150.0, 140.0);
    write(root, name, &Drawing { size, scale: 1.0, layers, fills, painting: Vec::new() })
}

/// The flags of a command by their names.
struct Flags {
    words: String,
    values: BTreeMap<String, String>,
}

impl Flags {
    fn read(words: &str) -> Result<Self, Box<dyn Error>> {
        let all: Vec<_> = LineClass::ALL.iter().map(|class| class.name()).collect();
        let words = words.replace("ALL", &all.join(","));
        let mut values = BTreeMap::new();
        for flag in format!(" {words}").split(" --").skip(1) {
            let (name, value) = flag.split_once(' ').unwrap_or((flag, ""));
            values.insert(name.to_owned(), value.trim().to_owned());
        }
        Ok(Flags { words, values })
    }

    /// The command that makes the same drawing.
    fn command(&self, name: &str, model: &str) -> String {
        let words = self.words.replace("--style ", "--style examples/styles/");
        format!("umriss draw examples/models/{model} -o {name}.svg {words}")
    }

    /// The command that makes the same drawing of a surface.
    fn surface_command(&self, name: &str, source: &str) -> String {
        let words = self.words.replace("--style ", "--style examples/styles/");
        let source = match source.ends_with(".png") {
            true => format!("examples/models/{source}"),
            false => format!("'{source}'"),
        };
        format!("umriss surface {source} -o {name}.svg {words}")
    }

    fn get(&self, name: &str) -> Option<&str> {
        self.values.get(name).map(String::as_str)
    }

    fn parse<T: FromStr>(&self, name: &str, default: T) -> Result<T, Box<dyn Error>>
    where
        T::Err: Error + 'static,
    {
        Ok(self.get(name).map(str::parse).transpose()?.unwrap_or(default))
    }

    fn vector(&self, name: &str) -> Result<Option<DVec3>, Box<dyn Error>> {
        let Some(text) = self.get(name) else { return Ok(None) };
        let numbers: Vec<f64> = text.split(',').map(str::parse).collect::<Result<_, _>>()?;
        let numbers: [f64; 3] = numbers.try_into().map_err(|_| "expected three numbers")?;
        Ok(Some(numbers.into()))
    }

    fn options(&self) -> Result<DrawingOptions, Box<dyn Error>> {
        let preset = self.get("preset").map(str::parse::<Preset>).transpose()?;
        let base = preset.map_or_else(DrawingOptions::default, Preset::options);
        let weight = self.get("weight").map(str::parse::<Weight>).transpose()?;
        let steps = self.get("weight-steps").map(str::parse).transpose()?;
        Ok(DrawingOptions {
            junctions: self.effort()? != Effort::Keep,
            paper: self.parse("paper", base.paper)?,
            landscape: self.get("landscape").is_some(),
            hidden: self.parse("hidden", base.hidden)?,
            hidden_by: self.parse("hidden-by", base.hidden_by)?,
            halo: self.parse("halo", base.halo)?,
            weight: weight.map(|weight| Weight { steps, ..weight }).or(base.weight),
            ..base
        })
    }

    fn surfaces(&self) -> Result<SurfaceOptions, Box<dyn Error>> {
        let fill = match self.get("fill") {
            Some("flat") => Fill::Flat,
            Some("shade") => Fill::Shade,
            _ => Fill::None,
        };
        let hatch = match self.get("hatch") {
            None => None,
            Some(_) => Some(Hatch {
                spacing: self.parse("hatch-spacing", Hatch::default().spacing)?,
                ..Hatch::default()
            }),
        };
        Ok(SurfaceOptions { fill, hatch, light: None })
    }

    fn effort(&self) -> Result<Effort, Box<dyn Error>> {
        let preset = self.get("preset").map(str::parse::<Preset>).transpose()?;
        self.parse("order", preset.map(Preset::effort).unwrap_or_default())
    }

    fn styles(&self, root: &Path) -> Result<Styles, Box<dyn Error>> {
        let Some(file) = self.get("style") else { return Ok(Styles::default()) };
        Ok(read_styles(&std::fs::read_to_string(root.join("examples/styles").join(file))?)?)
    }

    fn view(&self, bounds: (DVec3, DVec3)) -> Result<View, Box<dyn Error>> {
        let up = self.vector("up")?.unwrap_or(DVec3::Z);
        let camera = match (self.vector("eye")?, self.vector("direction")?) {
            (Some(eye), _) => Camera::Perspective {
                eye,
                target: self.vector("target")?,
                up,
                near: None,
                fov_y_degrees: self.parse("fov", 45.0)?,
            },
            (None, Some(forward)) => Camera::Orthographic { forward, target: None, up },
            (None, None) => {
                let name = self.get("view").unwrap_or("iso");
                Camera::Standard(StandardView::from_name(name).ok_or("no such view")?)
            }
        };
        Ok(camera.view(bounds)?)
    }

    fn wishes(&self, mesh: &Mesh) -> Result<Vec<ObjectWish>, Box<dyn Error>> {
        let mut features =
            FeatureOptions::default().with_crease_degrees(self.parse("crease", 30.0)?);
        if self.get("edges").is_some() {
            features = features.with_classes(&LineClass::ALL);
        }
        let clear = self.get("see-through").unwrap_or_default();
        let patterns: Vec<_> = clear.split(',').filter(|pattern| !pattern.is_empty()).collect();
        let see_through = |name: &str| patterns.iter().any(|pattern| matches(pattern, name));
        let wish = |name: &str| ObjectWish { features, see_through: see_through(name) };
        Ok(mesh.objects().iter().map(|object| wish(&object.name)).collect())
    }
}
