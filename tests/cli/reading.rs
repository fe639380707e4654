//! What is told of models that are read: once, by name, and in words of users.

use super::fixture::Folder;
use std::path::Path;

/// A folder with one file of the field.
fn with_field(name: &str) -> Folder {
    let folder = Folder::with_cube();
    std::fs::copy(Path::new("tests/field").join(name), folder.path().join(name)).unwrap();
    folder
}

#[test]
fn a_vertex_that_nothing_uses_is_no_part_of_the_picture() {
    let folder = with_field("stray_vertex.obj");
    let told = folder.succeeds("info stray_vertex.obj").output;
    assert!(told.contains("size                 2 2 2\n"), "{told}");
    let text = folder.text("stray_vertex.obj");
    folder.write("pyramid.obj", &text.replace("v 1000 0 0\n", ""));
    for camera in ["--eye 10,-10,5", "--view iso", "--view front --frame=-1,-1,1,1"] {
        let draw = |name: &str| {
            let said = folder.succeeds(&format!("draw {name}.obj -o {name}.json {camera}"));
            assert_eq!(said.errors, "");
            folder.text(&format!("{name}.json")).replace(name, "pyramid")
        };
        let drawing = draw("stray_vertex");
        assert!(drawing.contains("\"visible\":true"), "{camera}");
        assert_eq!(drawing, draw("pyramid"), "{camera}");
    }
}

#[test]
fn instances_are_drawn_each_with_its_name() {
    let folder = with_field("inst.gltf");
    folder.succeeds("draw inst.gltf -o a.json --include *#2,*#3");
    let drawing = folder.text("a.json");
    let named = |name: &str| drawing.matches(&format!("\"object\":\"{name}\"")).count();
    assert_eq!((named("mesh 0 #1"), named("mesh 0 #2"), named("mesh 0 #3")), (0, 9, 9));
}

#[test]
fn what_is_passed_over_is_told_once_by_name() {
    let folder = with_field("gltf_techniques_required.gltf");
    let said = folder.succeeds("draw gltf_techniques_required.gltf -o a.svg");
    assert_eq!(
        said.errors,
        "umriss: gltf_techniques_required.gltf: the required extension 'KHR_techniques_webgl' is \
         ignored\n"
    );
    let said = folder.succeeds("draw gltf_techniques_required.gltf -o a.svg --quiet");
    assert_eq!(said.errors, "");
}

#[test]
fn a_drawing_without_a_line_says_so() {
    let folder = Folder::with_cube();
    let told = |arguments: &str| {
        let said = folder.succeeds(arguments);
        assert_eq!(folder.succeeds(&format!("{arguments} --quiet")).errors, "");
        said.errors
    };
    let empty = "umriss: nothing is drawn: no line is in the picture\n";
    // The eye looks away from the cube.
    assert_eq!(told("draw cube.obj -o a.svg --eye 50,0,0 --target 90,0,0"), empty);
    assert!(folder.text("a.svg").starts_with("<svg"));
    assert_eq!(told("draw cube.obj -o a.json --edges boundary"), empty);
    assert_eq!(told("surface 0*x -o a.svg --eye 0,-90,9 --target 0,-99,9 --method appel"), empty);
    let away = told("draw cube.obj -o a.svg --eye 50,0,0 --target 90,0,0 --method painter");
    assert_eq!(away, empty);
    let beside = told("draw cube.obj -o a.svg --eye 50,5,5 --target 50,90,90 --fov 1");
    assert!(beside.starts_with("umriss: nothing is drawn"), "{beside}");
    let short = told("draw cube.obj -o a.svg --view front --min-length 1000mm");
    let reach = "umriss: nothing is drawn on the page; the lines reach from -5.0,-5.0 to 5.0,5.0\n";
    assert_eq!(short, reach);
    // What is painted is something.
    assert_eq!(told("draw cube.obj -o a.svg --method painter --fill flat --edges boundary"), "");
}

#[test]
fn models_too_small_for_any_scale_say_so() {
    let folder = Folder::with_cube();
    folder.write("small.obj", "v 0 0 0\nv 1e-307 0 0\nv 0 0 2e-307\nf 1 2 3\n");
    let said = folder.succeeds("draw small.obj -o a.svg --view front");
    assert_eq!(
        said.errors,
        "umriss: nothing is drawn on the page; the lines reach from -5e-308,-1e-307 to \
         5e-308,1e-307\n"
    );
    // A little larger, and it is drawn as large as the page.
    folder.write("larger.obj", "v 0 0 0\nv 1e-305 0 0\nv 0 0 2e-305\nf 1 2 3\n");
    assert_eq!(folder.succeeds("draw larger.obj -o a.svg --view front").errors, "");
    assert!(folder.text("a.svg").contains("<path"));
}

#[test]
fn files_outside_of_the_models_folder_need_a_flag() {
    let folder = Folder::with_cube();
    let numbers: [f32; 9] = [0., 0., 0., 1., 0., 0., 0., 1., 0.];
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    std::fs::write(folder.path().join("x.bin"), bytes).unwrap();
    std::fs::create_dir(folder.path().join("model")).unwrap();
    let text = super::fixture::TRIANGLE_GLTF;
    let data = text.find("data:").unwrap();
    let end = data + text[data..].find('"').unwrap();
    folder.write("model/a.gltf", &format!("{}../x.bin{}", &text[..data], &text[end..]));
    folder.fails(
        1,
        "draw model/a.gltf -o a.svg",
        "umriss: model/a.gltf:7: the file '../x.bin' is not below the model's folder, expected one \
         that is, or --allow-outside\n",
    );
    folder.succeeds("draw model/a.gltf -o a.svg --allow-outside");
    assert!(folder.text("a.svg").contains("<path"));
}

/// A reader of JSON each: scenes, glTF, drawings, cameras, polygons.
#[test]
fn json_is_refused_in_words_of_users() {
    let folder = Folder::with_cube();
    let frame = r#""frame":{"kind":"orthographic","origin":[0,0,0],"right":[1,0,0],"up":[0,0,1],"forward":[0,1,0]}"#;
    folder.write("scene.json", "{\"vertices\":\n7,\"faces\":[]}");
    folder.write("model.gltf", "{\"asset\":{\"version\":\"2.0\"},\n\"nodes\":[{\"mesh\":\"a\"}]}");
    folder.write(
        "drawing.json",
        &format!("{{\"format\":\"umriss-drawing/1\",{frame},\n\"lines\":{{}}}}"),
    );
    folder.write("eye.json", "{\"kind\":\"fish\",\"eye\":[1,2,3],\"target\":[0,0,0]}");
    for (arguments, message) in [
        ("draw scene.json -o a.svg", "scene.json:2: '7' stands here, expected an array"),
        ("draw model.gltf -o a.svg", "model.gltf:2: 'a' stands here, expected a natural number"),
        (
            "draw drawing.json -o a.svg",
            "drawing.json:2: column 8: an object stands here, expected an array",
        ),
        (
            "draw cube.obj -o a.svg --camera eye.json",
            "eye.json:1: column 14: the word 'fish' is not known, expected 'orthographic' or \
             'perspective'",
        ),
    ] {
        folder.fails(1, arguments, &format!("umriss: {message}\n"));
    }
}
