//! Scenes that break floating-point programs, drawn and compared whole.
//!
//! Boxes that touch, faces on top of one another, a cylinder standing on a
//! plate, T-junctions, interpenetration, a billionth and a billion of a
//! unit, a million units away: each model in `examples/models` that is
//! degenerate by design, from the front, from the top and isometric. The
//! drawings in `tests/golden` were looked at one by one.
//!
//! `UMRISS_BLESS=1` writes them anew. `UMRISS_PICTURES=folder` writes PNG
//! files to look at.

use std::path::Path;
use umriss::drawing::{Drawing, DrawingOptions, Hidden, LayerBy, Paper};
use umriss::export::{SvgOptions, to_png, to_svg};
use umriss::model::{Camera, FeatureOptions, Mesh, StandardView, import};
use umriss::run::Run;
use umriss::visibility::visible_lines;

const MODELS: [&str; 16] = [
    "bad_soup.obj",
    "coplanar_quads.obj",
    "cube_1e-9.obj",
    "cube_1e9.obj",
    "cube_row_touching.obj",
    "cylinder_on_plate.obj",
    "gear24_off1e6.obj",
    "house_groups.obj",
    "needle_cone.obj",
    "nested_cubes.obj",
    "ngon_L.obj",
    "plate_hole.json",
    "slab_tjunction.obj",
    "stair_boxes_touching.obj",
    "two_cubes_interpenetrating.obj",
    "two_tris_cross.obj",
];

const VIEWS: [&str; 3] = ["front", "top", "iso"];

/// The drawing of a model, a layer for each class of lines.
fn draw(model: &Path, view: &str) -> String {
    let model = import::read_file(model, None).expect("a model");
    let mesh = Mesh::new(model.objects, None).expect("a mesh");
    let view = StandardView::from_name(view).expect("a view");
    let view = Camera::Standard(view).view(mesh.bounds()).expect("a view");
    let lines = visible_lines(&mesh, &view, &FeatureOptions::default(), true, &Run::default());
    let options = DrawingOptions {
        paper: Paper::Sheet { width: 100.0, height: 100.0 },
        hidden: Hidden::Dashed,
        layer_by: LayerBy::Class,
        ..DrawingOptions::default()
    };
    let drawing = Drawing::new(&lines.expect("lines"), &options).expect("a drawing");
    let options = SvgOptions { precision: 2, ..SvgOptions::default() };
    to_svg(&drawing, &options).expect("an SVG")
}

#[test]
fn drawings_are_those_that_were_looked_at() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let bless = std::env::var_os("UMRISS_BLESS").is_some_and(|value| value == "1");
    let mut changed = Vec::new();
    for model in MODELS {
        for view in VIEWS {
            let svg = draw(&root.join("examples/models").join(model), view);
            let stem = model.split_once(".obj").or(model.split_once(".json")).expect("a name").0;
            let golden = root.join(format!("tests/golden/{stem}_{view}.svg"));
            if let Some(folder) = std::env::var_os("UMRISS_PICTURES") {
                let png = to_png(&svg, 400).expect("a picture");
                let path = Path::new(&folder).join(format!("{stem}_{view}.png"));
                std::fs::write(path, png).expect("written");
            }
            if bless {
                std::fs::write(&golden, &svg).expect("written");
            } else if std::fs::read_to_string(&golden).ok().as_ref() != Some(&svg) {
                changed.push(format!("{stem}_{view}"));
            }
        }
    }
    assert!(changed.is_empty(), "no longer as in tests/golden: {changed:?}");
}
