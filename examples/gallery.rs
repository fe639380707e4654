//! Draws the gallery: every picture in `output/`, as SVG and as PNG.
//!
//! `cargo run --release --example gallery` writes the same bytes every time
//! and prints the command that makes each drawing. The commands are where
//! the drawings come from: their flags are read here as the program reads
//! them. Names after it draw only those pictures.

#![allow(clippy::print_stdout)]

use glam::DVec3;
use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;
use std::str::FromStr;
use umriss::drawing::{
    Drawing, DrawingOptions, Effort, Preset, Styles, Weight, matches, read_styles,
};
use umriss::export::{SvgOptions, to_png, to_svg, write_file};
use umriss::kernel::predicates::Exact;
use umriss::model::{
    Camera, FeatureOptions, LineClass, Mesh, Scene, SceneOptions, StandardView, View, import,
};
use umriss::run::Run;
use umriss::view::{ObjectWish, PreparedView};
use umriss::visibility::{AppelOptions, appel, reduce_with_crossings};

/// Name, model and flags of every drawing.
const GALLERY: [(&str, &str, &str); 27] = [
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
    Ok(())
}

/// Draws one picture; returns the number of its pieces.
fn draw(root: &Path, name: &str, model: &str, flags: &Flags) -> Result<usize, Box<dyn Error>> {
    let model = import::read_file(&root.join("examples/models").join(model), None)?;
    let scene = Scene::new(model.objects, &SceneOptions::default())?;
    let (options, run) = (flags.options()?, Run::default());
    let styles = flags.styles(root)?;
    let (view, wishes) = (flags.view(&scene.mesh)?, flags.wishes(&scene.mesh)?);
    let prepared = PreparedView::with_wishes::<Exact>(&scene.mesh, &view, &wishes, &run)?;
    let question = prepared.question(flags.get("hidden").is_some());
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run)?;
    let (lines, crossings) = reduce_with_crossings::<Exact>(&question, &answer, &run)?;
    let mut drawing = Drawing::styled(&lines, &crossings, &options, &styles)?;
    drawing.order(flags.effort()?);
    let svg = to_svg(&drawing, &SvgOptions::default())?;
    let file = root.join("output").join(name);
    write_file(&file.with_extension("svg"), svg.as_bytes())?;
    write_file(&file.with_extension("png"), &to_png(&svg, 1000)?)?;
    Ok(lines.pieces.len())
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
            paper: self.parse("paper", base.paper)?,
            landscape: self.get("landscape").is_some(),
            hidden: self.parse("hidden", base.hidden)?,
            hidden_by: self.parse("hidden-by", base.hidden_by)?,
            halo: self.parse("halo", base.halo)?,
            weight: weight.map(|weight| Weight { steps, ..weight }).or(base.weight),
            ..base
        })
    }

    fn effort(&self) -> Result<Effort, Box<dyn Error>> {
        let preset = self.get("preset").map(str::parse::<Preset>).transpose()?;
        self.parse("order", preset.map(Preset::effort).unwrap_or_default())
    }

    fn styles(&self, root: &Path) -> Result<Styles, Box<dyn Error>> {
        let Some(file) = self.get("style") else { return Ok(Styles::default()) };
        Ok(read_styles(&std::fs::read_to_string(root.join("examples/styles").join(file))?)?)
    }

    fn view(&self, mesh: &Mesh) -> Result<View, Box<dyn Error>> {
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
        Ok(camera.view(mesh.bounds())?)
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
