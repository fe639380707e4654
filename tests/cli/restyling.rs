//! A computed drawing on another page: the files that its models would give.

use super::fixture::{self, Folder};

#[test]
fn a_computed_drawing_is_restyled_to_the_bytes_that_its_model_gives() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(12));
    folder.succeeds("draw wave.obj -o wave.json --hidden solid --view iso-sw");
    let styles = [
        "",
        "--hidden dashed",
        "--hidden solid --layer-by class --paper tight --scale 1:2 --unit cm",
        "--hidden dashed --layer-by object --paper 80x60mm --margin 2mm --landscape --precision 1",
    ];
    for style in styles {
        folder.succeeds(&format!("draw wave.obj -o model.svg --view iso-sw {style}"));
        folder.succeeds(&format!("draw wave.json -o json.svg {style}"));
        assert_eq!(folder.text("model.svg"), folder.text("json.svg"), "{style}");
    }
    folder.succeeds("draw wave.json -o again.json");
    assert_eq!(folder.text("wave.json"), folder.text("again.json"));
}

#[test]
fn what_a_drawing_has_settled_is_not_asked_again() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o cube.json");
    for (flags, name) in [
        ("--view top", "the camera"),
        ("--edges contour", "--crease, --intersections, --seams and --edges"),
        ("--method appel", "--method"),
        ("--weld 1", "--weld and --heal"),
        ("--heal auto", "--weld and --heal"),
        ("--up-axis y", "--up-axis"),
    ] {
        let message = format!(
            "umriss: a computed drawing cannot be computed otherwise: expected a model, or no \
             flags for {name}\n"
        );
        folder.fails(2, &format!("draw cube.json -o a.svg {flags}"), &message);
    }
    assert_eq!(folder.names(), ["cube.json", "cube.obj"]);
}

#[test]
fn a_page_of_a_computed_drawing_is_the_page_of_its_models_in_every_format() {
    let folder = Folder::with_cube();
    folder.write("triangle.gltf", fixture::TRIANGLE_GLTF);
    let cases = [
        ("cube.obj", "--eye 40,-50,30 --fov 12", "--hidden dashed --paper a5 --landscape"),
        ("triangle.gltf", "--view front", "--hidden solid --paper tight --scale 1:10"),
        ("cube.obj", "--view cabinet --unit in", "--hidden dashed --scale 1:2 --layer-by class"),
        ("cube.obj", "--view iso", "--hidden dashed --frame -9,-4,2.5,7 --scale 3:1"),
    ];
    for (model, view, style) in cases {
        folder.succeeds(&format!("draw {model} -o c.json {view} --hidden solid"));
        let all = |name: &str| format!("-o {name}.svg -o {name}.hpgl -o {name}.json -o {name}.png");
        folder.succeeds(&format!("draw {model} {} {view} {style}", all("model")));
        folder.succeeds(&format!("draw c.json {} {style}", all("json")));
        for format in ["svg", "hpgl", "json", "png"] {
            let [model, json] =
                ["model", "json"].map(|name| folder.bytes(&format!("{name}.{format}")));
            assert!(model == json, "{view} {style}: {format}");
        }
    }
}

#[test]
fn hidden_lines_that_were_not_looked_for_are_not_silently_missing() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o cube.json");
    folder.fails(
        2,
        "draw cube.json -o a.svg --hidden dashed",
        "umriss: the drawing was computed without its hidden lines: expected --hidden none, or a \
         drawing that was computed with --hidden\n",
    );
    folder.write("unit.json", &folder.text("cube.json").replace("\"mm\"", "\"furlong\""));
    folder.fails(
        1,
        "draw unit.json -o a.svg",
        "umriss: unit.json: the unit is `furlong`; expected mm, cm, m or in\n",
    );
}

#[test]
fn a_frame_cuts_the_picture_and_is_fitted() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o cube.json --view front");
    let frame = "draw cube.json -o a.svg --frame -3,-20,20,2 --paper tight --margin 0";
    folder.succeeds(frame);
    let svg = folder.text("a.svg");
    assert!(svg.contains("viewBox=\"0 0 23 22\""), "{svg}");
    // The front of the cube, -5 to 5, without its left side and its top.
    assert!(svg.contains("d=\"M0 7L8 7L8 0\""), "{svg}");
    folder.succeeds(&format!("{frame} --scale 2:1"));
    assert!(folder.text("a.svg").contains("d=\"M0 14L16 14L16 0\""));
    folder.fails(
        2,
        "draw cube.json -o b.svg --frame 6,6,7,8",
        "umriss: nothing is drawn in this frame; the lines reach from -5,-5 to 5,5\n",
    );
}

#[test]
fn details_side_by_side_have_the_length_of_the_whole() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(16));
    folder.succeeds("draw wave.obj -o wave.json --edges contour,boundary,crease,mesh");
    let length = |frame: &str| {
        folder.succeeds(&format!(
            "draw wave.json -o a.svg --paper tight --scale 1:1 --precision 9 --merge 0 {frame}"
        ));
        fixture::drawn_length(&folder.text("a.svg"))
    };
    let whole = length("");
    let corners = ["-99,-99", "-99,99", "99,-99", "99,99"];
    let parts: f64 = corners.iter().map(|c| length(&format!("--frame {c},1.25,0.5"))).sum();
    assert!((parts - whole).abs() < 1e-6 * whole, "{parts} of {whole}");
}

/// Boxes that touch and cover one another in rows, most of whose lines lie on
/// others.
fn heap() -> String {
    let mut text = String::new();
    let boxes = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 1], [0, 0, 1], [3, 1, 1]];
    for (index, low) in boxes.into_iter().enumerate() {
        text += &format!("o box{index}\n");
        for corner in 0..8 {
            let at = |axis: usize| low[axis] + (corner >> axis & 1);
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

#[test]
fn a_drawing_without_its_hidden_lines_is_the_one_that_never_had_any() {
    let folder = Folder::with_cube();
    folder.write("heap.obj", &heap());
    folder.write("wave.obj", &fixture::wave(9));
    let cameras = ["--view iso", "--view top", "--view cabinet", "--eye 9,-7,5 --target 1,1,0"];
    for model in ["heap.obj", "wave.obj heap.obj"] {
        for camera in cameras {
            let camera = format!("{camera} --edges contour,boundary,crease,mesh,intersection");
            folder.succeeds(&format!("draw {model} -o a.json {camera} --hidden solid --halo 0"));
            for style in [
                "",
                "--layer-by object",
                "--halo 1mm --order greedy",
                "--weight 1..0.2mm",
                "--frame -0.31,-0.4,0.5,0.27",
                "--frame -0.31,-0.4,0.5,0.27 --weight 1..0.2mm --layer-by class",
            ] {
                let both = |name: &str| format!("-o {name}.svg -o {name}.hpgl --precision 9");
                folder.succeeds(&format!("draw {model} {camera} {} {style}", both("model")));
                folder.succeeds(&format!("draw a.json {} {style}", both("json")));
                for format in ["svg", "hpgl"] {
                    let [model, json] =
                        ["model", "json"].map(|name| folder.text(&format!("{name}.{format}")));
                    assert!(model == json, "{camera} {style}: {format}");
                }
            }
        }
    }
}

#[test]
fn lines_outside_of_the_frame_are_not_looked_at() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(16));
    let draw = "draw wave.obj --edges mesh --stats -o";
    let left_out = |arguments: &str| {
        let said = folder.succeeds(&format!("{draw} {arguments}"));
        let line = said.errors.lines().find(|line| line.starts_with("lines-outside"));
        line.unwrap().split_whitespace().last().unwrap().parse::<u32>().unwrap()
    };
    assert_eq!(left_out("a.svg"), 0);
    assert!(left_out("a.svg --frame 0,0,1,1") > 100);
    // All lines are wanted in a drawing that is kept.
    assert_eq!(left_out("a.json --frame 0,0,1,1"), 0);
    folder.succeeds("draw wave.obj --edges mesh -o a.json");
    let nowhere = ["wave.obj --edges mesh", "a.json"].map(|from| {
        let output = folder.command(&format!("draw {from} -o b.svg --frame 60,60,70,80")).output();
        let output = output.unwrap();
        assert_eq!(output.status.code(), Some(2));
        String::from_utf8(output.stderr).unwrap()
    });
    assert!(nowhere[0].contains("the lines reach from"), "{}", nowhere[0]);
    assert_eq!(nowhere[0], nowhere[1]);
}
