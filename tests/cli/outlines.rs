//! The outer outline: its width, its rules, and drawings that know it.

use super::fixture::{self, Folder, drawn_length};

/// The label, width and length of the strokes of each layer of an SVG.
fn layers(svg: &str) -> Vec<(String, f64, f64)> {
    let value = |text: &str, key: &str| {
        let rest = &text[text.find(key).unwrap() + key.len()..];
        rest.split('"').next().unwrap().to_owned()
    };
    let groups = svg.split("<g ").skip(1);
    let layer = |group: &str| {
        let width = value(group, "stroke-width=\"").parse().unwrap();
        (value(group, "inkscape:label=\""), width, drawn_length(group))
    };
    groups.map(layer).collect()
}

#[test]
fn the_outline_is_as_wide_as_asked_and_a_layer_of_its_own() {
    let folder = Folder::with_cube();
    let page = "--paper tight --scale 1:1 --precision 9";
    folder.succeeds(&format!("draw cube.obj -o a.svg --outline 0.7mm {page}"));
    let found = layers(&folder.text("a.svg"));
    let [(outline, wide, length), (inner, narrow, rest)] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!((outline.as_str(), inner.as_str()), ("1-visible-0.7mm", "2-visible-0.5mm"));
    assert_eq!((*wide, *narrow), (0.7, 0.5));
    // Of the nine visible edges six are the hexagon.
    let edge = 10.0 * (2.0_f64 / 3.0).sqrt();
    assert!((length - 6.0 * edge).abs() < 1e-6 && (rest - 3.0 * edge).abs() < 1e-6, "{found:?}");
}

#[test]
fn rules_for_the_outline_go_before_those_of_classes_and_after_those_of_objects() {
    let folder = Folder::with_cube();
    folder.write(
        "look.toml",
        "[class.contour]\nwidth = \"0.35mm\"\n[outline]\nwidth = \"1mm\"\npen = 7\n",
    );
    folder.succeeds("draw cube.obj -o a.svg --style look.toml");
    let labels: Vec<String> = layers(&folder.text("a.svg")).into_iter().map(|l| l.0).collect();
    assert_eq!(labels, ["7-visible-1mm", "2-visible-0.5mm"]);
    folder.write("object.toml", "[outline]\nwidth = \"1mm\"\n[object.cube]\nwidth = \"0.2mm\"\n");
    folder.succeeds("draw cube.obj -o a.svg --style object.toml");
    let widths: Vec<f64> = layers(&folder.text("a.svg")).into_iter().map(|l| l.1).collect();
    assert_eq!(widths, [0.2]);
}

#[test]
fn outlines_of_objects_are_drawn_in_front_of_others() {
    let folder = Folder::with_cube();
    let floor = "o floor\nv -90 -90 -1\nv 90 -90 -1\nv 90 90 -1\nv -90 90 -1\nf 1 2 3 4\n";
    folder.write("floor.obj", floor);
    let outline = |flags: &str| {
        let page = "--view top --paper tight --scale 1:1 --precision 9";
        folder.succeeds(&format!("draw floor.obj cube.obj -o a.svg --outline 1mm {page} {flags}"));
        layers(&folder.text("a.svg"))[0].2
    };
    assert!((outline("") - 720.0).abs() < 1e-6);
    assert!((outline("--outline-of objects") - 760.0).abs() < 1e-6);
}

#[test]
fn a_computed_outline_is_restyled_to_the_bytes_that_its_model_gives() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(12));
    folder.write("look.toml", "[outline]\ncolor = \"#00f\"\n");
    let camera = "--eye 30,-20,18 --target 6,6,0 --fov 40";
    let models = "cube.obj wave.obj";
    folder.succeeds(&format!("draw {models} -o all.json --hidden solid --outline 0 {camera}"));
    assert!(folder.text("all.json").contains("\"outline\":\"scene\""));
    for style in [
        "--outline 0.7mm",
        "--outline 0.7mm --hidden dashed --layer-by object",
        "--outline 1mm --weight 0.6..0.2mm",
        "--style look.toml --hidden solid",
        "--outline 0.4mm --order best --simplify 0.1mm",
        // Nothing is left of it where it is not asked for.
        "",
        "--hidden dashed --weight 0.6..0.2mm",
    ] {
        folder.succeeds(&format!("draw {models} -o model.svg -o model.hpgl {camera} {style}"));
        folder.succeeds(&format!("draw all.json -o json.svg -o json.hpgl {style}"));
        for format in ["svg", "hpgl"] {
            let [model, json] =
                ["model", "json"].map(|name| folder.text(&format!("{name}.{format}")));
            assert!(model == json, "{style}: {format}");
        }
    }
    folder.succeeds("draw all.json -o again.json");
    assert_eq!(folder.text("all.json"), folder.text("again.json"));
}

#[test]
fn a_drawing_without_its_outline_says_so() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o cube.json");
    let message = "umriss: the drawing was computed without its outline: expected no --outline \
                   and no rule for it, or a drawing that was computed with --outline\n";
    folder.fails(2, "draw cube.json -o a.svg --outline 0.7mm", message);
    let message = "umriss: a computed drawing cannot be computed otherwise: expected a model, or \
                   no flags for --outline-of\n";
    folder.fails(2, "draw cube.json -o a.svg --outline-of objects", message);
    let message = "umriss: a line of 200 mm cannot be drawn; expected 0.01 mm to 100 mm\n";
    folder.fails(2, "draw cube.obj -o a.svg --outline 20cm", message);
}
