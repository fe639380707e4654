//! How lines look: gaps, widths, layers of hidden lines, rules, objects.

use super::fixture::{self, Folder, drawn_length};

/// Two bars that cross, one 5 mm in front of the other, seen from above.
const WIRES: &str = "o low\nv -10 0 0\nv 10 0 0\nl 1 2\no high\nv -3 -4 5\nv 3 4 5\nl 3 4\n";

/// Three nested boxes; each but the outermost lies behind one more.
fn nested() -> String {
    let mut text = String::new();
    for (index, half) in [1.0, 2.0, 3.0].into_iter().enumerate() {
        text += &format!("o box{index}\n");
        for corner in 0..8 {
            let at = |bit: i32| if corner >> bit & 1 == 1 { half } else { -half };
            text += &format!("v {} {} {}\n", at(0), at(1), at(2));
        }
        for face in ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"] {
            let corner = |c: &str| (c.parse::<usize>().unwrap() + 8 * index).to_string();
            let face: Vec<String> = face.split(' ').map(corner).collect();
            text += &format!("f {}\n", face.join(" "));
        }
    }
    text
}

fn labels(svg: &str) -> Vec<&str> {
    svg.match_indices("inkscape:label=\"")
        .map(|(at, key)| svg[at + key.len()..].split('"').next().unwrap())
        .collect()
}

#[test]
fn a_styled_drawing_is_restyled_to_the_bytes_that_its_model_gives() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(12));
    folder.write("look.toml", "[visible]\ncolor = \"#123\"\n[class.contour]\nwidth = \"0.7mm\"\n");
    let camera = "--eye 30,-20,18 --target 6,6,0 --fov 40";
    folder.succeeds(&format!("draw wave.obj -o seen.json --halo 0 {camera}"));
    folder.succeeds(&format!("draw wave.obj -o wave.json --hidden solid --halo 0 {camera}"));
    for style in [
        "--halo 0",
        "--halo 1.5mm",
        "--halo 2mm --hidden dashed --frame -0.2,-0.1,0.1,0.2",
        "--halo 1mm --weight 1..0.2mm --hidden solid --layer-by class",
        "--weight 0.5..0.2mm --weight-by class --hidden dashed --hidden-by sheets",
        "--preset sketch",
        "--preset technical --hidden-by solids --style look.toml",
        "--preset plotter",
        "--preset patent --svg web",
    ] {
        let both = |name: &str| format!("-o {name}.svg -o {name}.hpgl");
        folder.succeeds(&format!("draw wave.obj {} {camera} {style}", both("model")));
        let hidden = style.contains("hidden") || style.contains("technical");
        let computed = if hidden { "wave.json" } else { "seen.json" };
        folder.succeeds(&format!("draw {computed} {} {style}", both("json")));
        for format in ["svg", "hpgl"] {
            let [model, json] =
                ["model", "json"].map(|name| folder.text(&format!("{name}.{format}")));
            assert!(model == json, "{style}: {format}");
        }
    }
    folder.succeeds("draw wave.json -o again.json");
    assert_eq!(folder.text("wave.json"), folder.text("again.json"));
}

#[test]
fn a_wire_in_front_interrupts_the_one_behind() {
    let folder = Folder::with_cube();
    folder.write("wires.obj", WIRES);
    let draw = |halo: &str| {
        folder.succeeds(&format!(
            "draw wires.obj -o a.svg --view top --scale 1:1 --precision 9 {halo}"
        ));
        folder.text("a.svg")
    };
    let plain = draw("");
    assert_eq!(draw("--halo 0"), plain);
    // They cross at an angle of sine 0.8.
    let gap = drawn_length(&plain) - drawn_length(&draw("--halo 0.8mm"));
    assert!((gap - 1.0).abs() < 1e-8, "{gap}");
    folder.succeeds("draw wires.obj -o w.json --view top");
    let message = "umriss: the drawing was computed without its crossings: expected no --halo, or \
                   a drawing that was computed with --halo\n";
    folder.fails(2, "draw w.json -o b.svg --halo 1mm", message);
}

#[test]
fn hidden_lines_are_told_apart_by_what_is_in_front() {
    let folder = Folder::with_cube();
    folder.write("nested.obj", &nested());
    let draw = |flags: &str| {
        folder.succeeds(&format!("draw nested.obj -o a.svg --hidden dashed {flags}"));
        labels(&folder.text("a.svg")).join(" ")
    };
    assert_eq!(draw(""), "2-hidden 1-visible");
    // The innermost box lies behind two sheets on its near side, behind
    // three on its far side.
    assert_eq!(draw("--hidden-by sheets"), "4-hidden-3 3-hidden-2 2-hidden-1 1-visible");
    folder.write("two.toml", "[[hidden]]\nwidth = \"0.3mm\"\n[[hidden]]\n[[hidden]]\npen = 9\n");
    let labelled = draw("--hidden-by sheets --style two.toml");
    assert!(labelled.starts_with("9-hidden-3 "), "{labelled}");
    assert_eq!(draw("--hidden-by solids"), "3-hidden-2 2-hidden-1 1-visible");
}

#[test]
fn objects_are_left_out_or_looked_through() {
    let folder = Folder::with_cube();
    folder.write("nested.obj", &nested());
    let objects = |flags: &str| {
        folder.succeeds(&format!("draw nested.obj -o a.svg --layer-by object {flags}"));
        labels(&folder.text("a.svg")).join(" ")
    };
    assert_eq!(objects(""), "1-box2");
    assert_eq!(objects("--exclude box2"), "1-box1");
    assert_eq!(objects("--include box0,box1 --exclude *1"), "1-box0");
    assert_eq!(objects("--see-through box2"), "1-box1 2-box2");
    assert_eq!(objects("--see-through box*"), "1-box0 2-box1 3-box2");
    folder.write(
        "o.toml",
        "[object.box2]\nexclude = true\n[object.box1]\nsee-through = true\npen = 7\n",
    );
    assert_eq!(objects("--style o.toml"), "1-box0 7-box1");
    // With creases of more than 90 degrees the outline is all there is.
    folder.write("smooth.toml", "[object.box2]\ncrease = 120\n");
    folder.succeeds("draw nested.obj -o all.json");
    folder.succeeds("draw nested.obj -o outline.json --style smooth.toml");
    let count = |name: &str| folder.text(name).matches("\"class\"").count();
    assert_eq!((count("all.json"), count("outline.json")), (9, 6));
    folder.fails(
        2,
        "draw nested.obj -o b.svg --exclude lid",
        "umriss: lid: no object has this name, expected some of box0, box1, box2\n",
    );
    folder.fails(2, "draw nested.obj -o b.svg --exclude *", "umriss: no object is left to draw\n");
}

#[test]
fn the_web_profile_says_what_lines_are() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o a.svg --svg web --hidden dashed");
    let svg = folder.text("a.svg");
    for part in [
        "class=\"visible contour\"",
        "id=\"cube.contour.visible\"",
        "data-object=\"cube\"",
        "id=\"cube.crease.hidden\"",
    ] {
        assert!(svg.contains(part), "{part}: {svg}");
    }
    folder.succeeds("draw cube.obj -o b.svg --hidden dashed");
    let svg = folder.text("b.svg");
    assert!(!svg.contains("class=") && !svg.contains("data-"));
}

#[test]
fn widths_follow_the_depth_in_layers_of_their_own() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o a.svg --weight 0.7..0.18mm --scale 1:1 --precision 9");
    let svg = folder.text("a.svg");
    let widths: Vec<f64> = svg
        .match_indices("stroke-width=\"")
        .map(|(at, key)| svg[at + key.len()..].split('"').next().unwrap().parse().unwrap())
        .collect();
    assert_eq!(widths.len(), 6);
    assert!(widths.is_sorted_by(|a, b| a > b), "{widths:?}");
    folder.succeeds("draw cube.obj -o b.svg --scale 1:1 --precision 9");
    let (one, all) = (drawn_length(&folder.text("b.svg")), drawn_length(&svg));
    assert!((one - all).abs() < 1e-6, "{one} {all}");
}
