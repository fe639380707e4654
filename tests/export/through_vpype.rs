//! Through vpype and back: layers, colours, widths and geometry.
//!
//! vpype is the program that pen plotter users know (MIT, from PyPI). It is
//! looked for as `vpype`, or as what UMRISS_VPYPE names; where there is none the
//! test says so.

use glam::DVec2;
use std::process::Command;
use umriss::drawing::{Drawing, DrawingOptions, Hidden, LineRule, Paper, Styles, Weight, WeightBy};
use umriss::export::{SvgOptions, to_svg};
use umriss::model::{Camera, Color, FeatureOptions, Scene, SceneOptions, StandardView, import};
use umriss::run::Run;
use umriss::visibility::visible_lines;

/// Pixels of vpype's files in a millimetre.
const PIXELS: f64 = 96.0 / 25.4;

fn house() -> Drawing {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/house_groups.obj");
    let model = import::read_file(file.as_ref(), None).unwrap();
    let scene = Scene::new(model.objects, &SceneOptions::default()).unwrap();
    let camera = Camera::Standard(StandardView::from_name("iso-se").unwrap());
    let view = camera.view(scene.mesh.bounds()).unwrap();
    let features = FeatureOptions::default();
    let lines = visible_lines(&scene.mesh, &view, &features, true, &Run::default()).unwrap();
    let weight = Weight { near: 0.7, far: 0.3, by: WeightBy::Depth, steps: Some(3) };
    let options = DrawingOptions {
        paper: Paper::A5,
        hidden: Hidden::Dashed,
        weight: Some(weight),
        ..DrawingOptions::default()
    };
    let blue = LineRule { color: Some(Color([34, 85, 204])), ..LineRule::default() };
    let styles = Styles { hidden: vec![blue], ..Styles::default() };
    Drawing::styled(&lines, &[], &options, &styles).unwrap()
}

/// Layer by number: colour, width in mm, points in mm.
fn layers(svg: &str) -> Vec<(u32, String, f64, Vec<DVec2>)> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let label = ("http://www.inkscape.org/namespaces/inkscape", "label");
    let mut layers = Vec::new();
    for group in document
        .root_element()
        .children()
        .filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "g")))
    {
        let name = group.attribute(label).or(group.attribute("id")).unwrap();
        let digits: String = name
            .chars()
            .skip_while(|c| !c.is_ascii_digit())
            .take_while(char::is_ascii_digit)
            .collect();
        let inherited = |key: &str| {
            group.descendants().find_map(|node| node.attribute(key)).unwrap().to_owned()
        };
        let width: f64 = inherited("stroke-width").trim_end_matches("px").parse().unwrap();
        let mut points = Vec::new();
        for node in group.descendants() {
            let values: Vec<f64> = match node.tag_name().name() {
                "polyline" | "polygon" => numbers(node.attribute("points").unwrap()),
                "line" => ["x1", "y1", "x2", "y2"]
                    .map(|k| node.attribute(k).unwrap().parse().unwrap())
                    .to_vec(),
                "path" => numbers(node.attribute("d").unwrap()),
                _ => continue,
            };
            points.extend(values.chunks(2).map(|p| DVec2::new(p[0], p[1]) / PIXELS));
        }
        layers.push((digits.parse().unwrap(), inherited("stroke"), width / PIXELS, points));
    }
    layers.sort_by_key(|layer| layer.0);
    layers
}

fn numbers(text: &str) -> Vec<f64> {
    text.split(|c: char| !(c.is_ascii_digit() || ".-e".contains(c)))
        .filter_map(|word| word.parse().ok())
        .collect()
}

#[test]
fn vpype_finds_layers_colours_widths_and_the_same_geometry() {
    let program = std::env::var("UMRISS_VPYPE").unwrap_or("vpype".into());
    if Command::new(&program).arg("--version").output().is_err() {
        println!("skipped: there is no {program}; `pip install vpype`, or set UMRISS_VPYPE");
        return;
    }
    let (drawing, folder) = (house(), tempfile::tempdir().unwrap());
    let [ours, theirs] = ["ours.svg", "theirs.svg"].map(|name| folder.path().join(name));
    std::fs::write(&ours, to_svg(&drawing, &SvgOptions::default()).unwrap()).unwrap();
    let done = Command::new(&program)
        .args(["read", "-q", "0.01mm"])
        .arg(&ours)
        .arg("write")
        .arg(&theirs)
        .output()
        .unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let found = layers(&std::fs::read_to_string(&theirs).unwrap());
    let mut expected: Vec<_> = drawing.layers.iter().collect();
    expected.sort_by_key(|layer| layer.number);
    assert!(3 < expected.len());
    assert_eq!(found.len(), expected.len());
    for ((number, color, width, points), layer) in found.iter().zip(expected) {
        let [red, green, blue] = layer.style.color.0;
        assert_eq!(*number, layer.number);
        let hex = format!("#{red:02x}{green:02x}{blue:02x}");
        let short = if hex == "#000000" { "black" } else { "#25c" };
        assert!([&*hex, short].contains(&&**color), "{color} {hex}");
        assert!((width - layer.style.width).abs() < 1e-3, "{width} {}", layer.style.width);
        // Both ways: no point far from one of the others.
        let own: Vec<DVec2> = layer.strokes.iter().flatten().copied().collect();
        let near = |p: &DVec2, all: &[DVec2]| all.iter().any(|q| p.distance(*q) < 2e-3);
        assert!(own.iter().all(|p| near(p, points)), "layer {number}");
        assert!(points.iter().all(|p| near(p, &own)), "layer {number}");
    }
}
