//! The program from outside: what it writes, what it says, how it ends.

#![allow(clippy::unwrap_used)]

mod clip;
mod explaining;
mod field;
mod fixture;
mod heights;
mod outlines;
mod pens;
mod polygons;
mod reading;
mod refusals;
mod restyling;
mod strokes;
mod styles;
mod surfaces;
#[path = "../fill/tiny_font.rs"]
mod tiny_font;

use fixture::Folder;

#[test]
fn every_format_is_drawn_in_one_call() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o a.svg -o a.hpgl -o a.plt -o a.json -o a.png");
    assert!(folder.text("a.svg").starts_with("<svg"));
    assert!(folder.text("a.hpgl").starts_with("IN;"));
    assert_eq!(folder.bytes("a.hpgl"), folder.bytes("a.plt"));
    assert!(folder.text("a.json").starts_with("{\"format\":\"umriss-drawing/1\""));
    assert!(folder.bytes("a.png").starts_with(b"\x89PNG"));
    assert_eq!(folder.names(), ["a.hpgl", "a.json", "a.plt", "a.png", "a.svg", "cube.obj"]);
}

#[test]
fn a_cube_shows_nine_of_its_twelve_edges_and_hides_three() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o seen.json");
    folder.succeeds("draw cube.obj -o all.json --hidden solid");
    let count = |name: &str, word: &str| folder.text(name).matches(word).count();
    assert_eq!(count("seen.json", "\"visible\":true"), 9);
    assert_eq!(count("seen.json", "\"visible\":false"), 0);
    assert_eq!(count("all.json", "\"visible\":true"), 9);
    assert_eq!(count("all.json", "\"visible\":false"), 3);
    assert_eq!(count("all.json", "\"object\":\"cube\""), 12);
}

#[test]
fn every_flag_of_the_camera_is_taken() {
    let folder = Folder::with_cube();
    let cameras = [
        "--view front",
        "--view top --up 1,0,0",
        "--view cabinet",
        "--view iso-sw-under",
        "--direction -1,-2,-0.5 --up 0,1,0",
        "--eye 40,-50,30",
        "--eye -40,-50,30 --target 5,5,5 --fov 30 --up 0,0,1 --near 1",
        "--camera eye.json --near 2",
        "--camera parallel.json",
    ];
    folder.write("eye.json", r#"{"kind":"perspective","eye":[40,30,20],"target":[5,5,5]}"#);
    folder.write(
        "parallel.json",
        r#"{"kind":"orthographic","eye":[1,2,3],"target":[0,0,0],"up":[0,1,0]}"#,
    );
    let mut drawings = Vec::new();
    for camera in cameras {
        folder.succeeds(&format!("draw cube.obj -o a.svg {camera}"));
        drawings.push(folder.text("a.svg"));
    }
    drawings.sort();
    drawings.dedup();
    assert_eq!(drawings.len(), cameras.len(), "each camera sees something else");
}

#[test]
fn a_camera_file_and_flags_that_say_the_same_draw_the_same() {
    let folder = Folder::with_cube();
    folder.write(
        "eye.json",
        r#"{"kind":"perspective","eye":[40,30,20],"target":[5,5,5],"up":[0,0,1],"fov_y_deg":60}"#,
    );
    folder.succeeds("draw cube.obj -o file.json --camera eye.json");
    folder.succeeds("draw cube.obj -o flags.json --eye 40,30,20 --target 5,5,5 --fov 60");
    assert_eq!(folder.text("file.json"), folder.text("flags.json"));
}

#[test]
fn every_flag_of_the_page_is_taken() {
    let folder = Folder::with_cube();
    let cube = "draw cube.obj -o a.svg --view front";
    folder.succeeds(&format!("{cube} --paper a3 --landscape"));
    assert!(folder.text("a.svg").contains("viewBox=\"0 0 420 297\""));
    folder.succeeds(&format!("{cube} --paper tight --margin 5mm --scale 2:1"));
    assert!(folder.text("a.svg").contains("viewBox=\"0 0 30 30\""));
    folder.succeeds(&format!("{cube} --paper tight --margin 1cm --scale 0.5 --unit in"));
    assert!(folder.text("a.svg").contains("viewBox=\"0 0 147 147\""));
    folder.succeeds(&format!("{cube} --hidden dashed --layer-by class"));
    assert!(folder.text("a.svg").contains("1-contour"));
    folder.succeeds("draw cube.obj -o a.svg --layer-by object --precision 0");
    let svg = folder.text("a.svg");
    let paths: String = svg.lines().filter(|line| line.starts_with("<path")).collect();
    assert!(svg.contains("1-cube") && !paths.contains('.'));
}

#[test]
fn only_the_classes_asked_for_are_drawn() {
    let folder = Folder::with_cube();
    let count = |flags: &str, class: &str| {
        folder.succeeds(&format!("draw cube.obj -o a.json {flags}"));
        folder.text("a.json").matches(&format!("\"class\":\"{class}\"")).count()
    };
    assert_eq!(count("", "contour"), 6);
    assert_eq!(count("", "crease"), 3);
    assert_eq!(count("--edges contour", "crease"), 0);
    assert_eq!(count("--crease 90", "crease"), 0);
    assert_eq!(count("--crease 90 --edges contour,mesh", "mesh"), 3);
    assert_eq!(count("--method appel", "contour"), 6);
}

#[test]
fn models_in_one_call_are_one_scene() {
    let folder = Folder::with_cube();
    folder.write("wall.off", "OFF\n3 1 0\n90 90 -90\n-90 90 -90\n0 90 200\n3 0 1 2\n");
    folder.succeeds("draw cube.obj wall.off -o both.json --view back --hidden solid");
    let text = folder.text("both.json");
    assert!(text.contains("\"object\":\"cube\""));
    assert!(text.contains("\"object\":\"wall\""), "objects without a name have the file's");
    assert!(
        text.lines()
            .filter(|line| line.contains("\"cube\""))
            .skip(1)
            .all(|line| { line.contains("\"visible\":false") })
    );
}

#[test]
fn units_are_those_of_the_format_unless_said_otherwise() {
    let folder = Folder::with_cube();
    folder.write("triangle.gltf", fixture::TRIANGLE_GLTF);
    folder.succeeds("draw triangle.gltf -o a.svg --view front --paper tight --margin 0");
    assert!(folder.text("a.svg").contains("viewBox=\"0 0 1000 1000\""), "metres, y up");
    folder.succeeds(
        "draw triangle.gltf -o a.svg --view top --paper tight --margin 0 --unit cm --up-axis z",
    );
    assert!(folder.text("a.svg").contains("viewBox=\"0 0 10 10\""));
    folder.fails(
        2,
        "draw cube.obj triangle.gltf -o b.svg",
        "umriss: triangle.gltf: the numbers are in m, but those of the models before in mm; \
         expected --unit to say what all numbers mean\n",
    );
    folder.succeeds("draw cube.obj triangle.gltf -o b.svg --unit mm");
}

#[test]
fn close_vertices_are_merged_on_request_and_it_is_told() {
    let folder = Folder::with_cube();
    folder.write(
        "pair.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1.001 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\n",
    );
    assert_eq!(folder.succeeds("draw pair.obj -o a.svg").errors, "");
    let told = "umriss: --weld moved 1 vertices onto others\n";
    assert_eq!(folder.succeeds("draw pair.obj -o a.svg --weld 0.01").errors, told);
    assert_eq!(folder.succeeds("draw pair.obj -o a.svg --weld 0.01 --quiet").errors, "");
}

#[test]
fn threads_do_not_change_a_byte() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(24));
    let flags = "--hidden dashed --edges contour,boundary,crease,mesh";
    folder.succeeds(&format!("draw wave.obj -o 1.json -o 1.svg -o 1.hpgl {flags} --threads 1"));
    folder.succeeds(&format!("draw wave.obj -o 2.json -o 2.svg -o 2.hpgl {flags} --threads 2"));
    for format in ["json", "svg", "hpgl"] {
        let [one, two] = ["1", "2"].map(|name| folder.bytes(&format!("{name}.{format}")));
        assert!(one == two, "{format}");
        assert!(one.len() > 10_000, "{format}");
    }
}

#[test]
fn standard_input_and_output_are_called_dash() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o a.svg");
    let piped = folder.succeeds_with_input("draw - -o - --format svg", &folder.bytes("cube.obj"));
    assert_eq!(piped.output, folder.text("a.svg"));
    folder.succeeds("draw cube.obj -o a.json");
    let piped = folder.succeeds_with_input("draw - -o - --format svg", &folder.bytes("a.json"));
    assert_eq!(piped.output, folder.text("a.svg"));
    let told = folder.succeeds_with_input("info - --input-format obj", &folder.bytes("cube.obj"));
    assert!(told.output.contains("closed"));
}

#[test]
fn a_format_is_given_where_there_is_no_extension() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o drawing -o a.svg --format svg");
    assert_eq!(folder.bytes("drawing"), folder.bytes("a.svg"));
    folder.write("model", &folder.text("cube.obj"));
    folder.succeeds("draw model -o b.svg --input-format obj");
    assert_eq!(folder.bytes("b.svg"), folder.bytes("a.svg"));
}

#[test]
fn statistics_go_to_standard_error() {
    let folder = Folder::with_cube();
    let told = folder.succeeds("draw cube.obj -o a.svg --stats").errors;
    for word in ["feature-lines", "pieces", "time: appel", "time: reading"] {
        assert!(told.contains(word), "{word} in {told}");
    }
    assert!(!folder.text("a.svg").contains("time"));
}

#[test]
fn a_model_is_described() {
    let folder = Folder::with_cube();
    let row = |flags: &str, name: &str| {
        let told = folder.succeeds(&format!("info {flags}")).output;
        let line = told.lines().find(|line| line.starts_with(name)).unwrap_or("").to_owned();
        line[name.len()..].split_whitespace().next().unwrap_or("").to_owned()
    };
    for (name, value) in [
        ("objects", "1"),
        ("faces", "6"),
        ("triangles", "12"),
        ("unit", "mm"),
        ("size", "10"),
        ("surface", "closed"),
        ("components", "1"),
        ("crease edges", "12"),
        ("inconsistent edges", "0"),
        ("interpenetrations", "0"),
    ] {
        assert_eq!(row("cube.obj", name), value, "{name}");
    }
    assert_eq!(row("cube.obj --crease 90", "smooth edges"), "12");
    let json = folder.succeeds("info cube.obj --json").output;
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["closed"], true);
    assert_eq!(json["objects"][0]["name"], "cube");
    assert_eq!(json["bounds"][1][2], 10.0);
}

#[test]
fn defects_are_told() {
    let folder = Folder::with_cube();
    folder.write(
        "bad.obj",
        "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 2 0 0\nv 0 -4 0\nv 4 -4 0\nv 0.5 0.5 -1\nv 0.5 0.5 1\n\
         v 1 0.5 1\nv 0 0 0\nf 1 2 3\nf 3 1 2\nf 1 2 2\nf 4 5 6\nf 7 8 9\nf 10 3 2\n",
    );
    let json = folder.succeeds("info bad.obj --json").output;
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["closed"], false);
    assert_eq!(json["welded_vertices"], 1);
    assert_eq!(json["defects"]["degenerate_faces"], 1);
    assert_eq!(json["defects"]["duplicate_faces"], 2);
    assert_eq!(json["defects"]["t_junctions"], 1);
    assert_eq!(json["defects"]["interpenetrations"], 1);
}

#[test]
fn help_has_examples_for_every_command() {
    let folder = Folder::with_cube();
    assert!(folder.succeeds("--help").output.contains("draw"));
    for command in ["draw", "info", "raster", "verify"] {
        let help = folder.succeeds(&format!("{command} --help")).output;
        assert!(help.contains(&format!("Examples:\n  umriss {command}")), "{command}");
    }
    assert!(folder.succeeds("--version").output.starts_with("umriss 0."));
}

#[test]
fn a_drawing_is_proved_and_the_differences_of_a_broken_one_are_shown() {
    let folder = Folder::with_cube();
    let told = folder.succeeds("verify cube.obj --eye 40,-50,30 --picture clean.png").output;
    assert!(told.lines().any(|line| line.starts_with("judge") && line.contains("12")));
    let mut broken = folder.command("verify cube.obj --break start-visible --picture broken.png");
    let result = broken.output().unwrap();
    let errors = String::from_utf8(result.stderr).unwrap();
    assert_eq!(errors, "umriss: the checks differ: expected no difference\n");
    assert_eq!(result.status.code(), Some(1));
    assert!(told.lines().any(|line| line.starts_with("border ") && line.ends_with(" 0")));
    let mut forgetful = folder.command("verify cube.obj --break forget-occluder");
    let forgetful = forgetful.output().unwrap();
    assert_eq!(forgetful.status.code(), Some(1));
    assert!(String::from_utf8(forgetful.stdout).unwrap().contains("\narea: ["));
    let pictures = ["clean.png", "broken.png"].map(|name| folder.bytes(name));
    assert!(pictures.iter().all(|bytes| bytes.starts_with(b"\x89PNG")));
    assert!(pictures[0] != pictures[1]);
}

#[test]
fn every_method_makes_the_same_image() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(12));
    let methods = umriss::raster::methods::<umriss::kernel::predicates::Exact>();
    for show in ["face", "depth", "shade"] {
        let images: Vec<_> = methods
            .iter()
            // Its shade is anti-aliased.
            .filter(|(method, _)| show != "shade" || *method != "a-buffer")
            .map(|(method, _)| {
                let flags = format!("--method {method} --show {show} --size 65x48 -o a.png");
                folder.succeeds(&format!("raster wave.obj cube.obj {flags}"));
                folder.bytes("a.png")
            })
            .collect();
        assert!(images[0].starts_with(b"\x89PNG"));
        // Width and height of the image, as PNG has them.
        assert_eq!(images[0][16..24], [0, 0, 0, 65, 0, 0, 0, 48]);
        assert!(images.iter().all(|image| *image == images[0]), "{show}");
    }
}

#[test]
fn the_a_buffer_shows_coverage_and_a_smooth_preview() {
    let folder = Folder::with_cube();
    let image = |flags: &str| {
        folder
            .succeeds(&format!("raster cube.obj --method a-buffer --size 40x40 {flags} -o a.png"));
        let bytes = folder.bytes("a.png");
        assert_eq!(bytes[16..24], [0, 0, 0, 40, 0, 0, 0, 40]);
        bytes
    };
    let images = [
        "--show coverage",
        "--show shade",
        "--opacity 0.5",
        "--pattern hatch",
        "--pattern hatch --opacity 0.5",
        "--pattern hatch --pattern-anchor object",
        "--show face",
    ]
    .map(image);
    for (i, image) in images.iter().enumerate() {
        assert!(!images[..i].contains(image), "{i}");
    }
    assert_eq!(images[1], image("--opacity 1"));
}

#[test]
fn the_ordered_span_buffer_draws_what_has_an_order() {
    let folder = Folder::with_cube();
    let image = |flags: &str| {
        folder.succeeds(&format!("raster cube.obj {flags} --size 48x48 -o a.png"));
        folder.bytes("a.png")
    };
    assert_eq!(image("--method c-buffer"), image("--method z-buffer"));
    let cross = "v 0 0 0\nv 2 0 0\nv 1 0 2\nv 1 -1 0.5\nv 1 1 0.5\nv 1 0 1.5\nf 1 2 3\nf 4 5 6\n";
    folder.write("cross.obj", cross);
    let message = "umriss: c-buffer: triangles 0 and 1 are each in front of the other \
                   somewhere, expected another method\n";
    folder.fails(1, "raster cross.obj --method c-buffer -o b.png", message);
    let compared = |at: &str| {
        let flags = format!("--method span-buffer --compare {at} --show face");
        folder.succeeds(&format!("raster cross.obj {flags} --size 64x64 -o a.png"));
        folder.bytes("a.png")
    };
    // The known failure, and its repair.
    assert_ne!(compared("middle"), compared("crossings"));
}

#[test]
fn colours_are_poured_over_what_is_connected() {
    let folder = Folder::with_cube();
    let image = |flags: &str| {
        folder.succeeds(&format!("raster cube.obj --show face --size 32x32 {flags} -o a.png"));
        folder.bytes("a.png")
    };
    let plain = image("");
    let poured = image("--flood 0,0,#102030");
    assert_ne!(plain, poured);
    // From anywhere in the same area.
    assert_eq!(poured, image("--flood 31,0,#102030"));
    assert_eq!(plain, image("--flood 0,0,#102030 --flood 0,0,#ffffff"));
    let message = "umriss: --flood 40,2: expected a pixel of an image of 32 x 32\n";
    folder.fails(2, "raster cube.obj --flood 40,2,#102030 --size 32x32 -o b.png", message);
}

#[test]
fn a_caption_is_written_in_the_font_of_a_file() {
    let folder = Folder::with_cube();
    let image = |flags: &str| {
        folder.succeeds(&format!("raster cube.obj --size 64x64 {flags} -o a.png"));
        folder.bytes("a.png")
    };
    std::fs::write(folder.path().join("tiny.ttf"), tiny_font::tiny_font()).unwrap();
    let captions = ["", "--caption o --font tiny.ttf", "--caption oo --font tiny.ttf"].map(image);
    assert!(captions[0] != captions[1] && captions[1] != captions[2]);
    let large = image("--caption o --font tiny.ttf --caption-size 30");
    assert!(large != captions[1]);
    folder.write("no.ttf", "no font");
    let message = "umriss: no.ttf: the font cannot be read: unknown magic\n";
    folder.fails(1, "raster cube.obj --caption cube --font no.ttf -o b.png", message);
}

#[test]
fn the_windows_of_both_subdivisions_are_drawn() {
    let folder = Folder::with_cube();
    for method in ["warnock", "warnock-vertex"] {
        let flags = format!("--method {method} --show splits --size 64x64");
        folder.succeeds(&format!("raster cube.obj {flags} -o {method}.svg"));
        folder.succeeds(&format!("raster cube.obj {flags} -o {method}.png"));
        let svg = folder.text(&format!("{method}.svg"));
        // Boxes of the sizes of windows fill the image exactly.
        let boxes = svg.split("d=\"").skip(1).flat_map(|path| {
            let path = path.split('"').next().unwrap();
            path.split('M').skip(1).map(|part| {
                let number = |from: char, to: char| -> u32 {
                    let part = part.split(from).nth(1).unwrap();
                    part.split(to).next().unwrap().parse().unwrap()
                };
                number('h', 'v') * number('v', 'h')
            })
        });
        assert_eq!(boxes.sum::<u32>(), 64 * 64, "{method}");
        assert!(folder.bytes(&format!("{method}.png")).starts_with(b"\x89PNG"));
    }
    assert!(folder.text("warnock.svg") != folder.text("warnock-vertex.svg"));
}

#[test]
fn every_pair_of_methods_is_compared_at_every_sample() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(12));
    let flags = "--all --size 33x32 --picture clean.png";
    let told = folder.succeeds(&format!("verify wave.obj cube.obj {flags}")).output;
    let row = "ray-cast        z-buffer              1056          0";
    assert!(told.lines().any(|line| line == row), "{told}");
    let pairs = told.lines().filter(|line| line.ends_with("      1056          0"));
    assert!(pairs.count() >= 15, "{told}");
}

#[test]
fn both_methods_draw_the_same_lines() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(12));
    folder.succeeds("draw wave.obj -o appel.svg --hidden dashed");
    folder.succeeds("draw wave.obj -o roberts.svg --hidden dashed --method roberts");
    assert_eq!(folder.text("appel.svg"), folder.text("roberts.svg"));
}
