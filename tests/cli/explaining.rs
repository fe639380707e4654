//! `umriss explain`: which line is at a place, and what hides it.

use super::fixture::Folder;

/// A post behind a wall, and a bar that stands out on both sides of it.
const SCENE: &str = "\
o wall
v 0 0 0
v 10 0 0
v 10 0 10
v 0 0 10
f 1 2 3 4
o bar
v -5 4 5
v 15 4 5
l 5 6
";

fn folder() -> Folder {
    let folder = Folder::with_cube();
    folder.write("scene.obj", SCENE);
    folder
}

#[test]
fn a_hidden_line_is_told_with_the_face_in_front_of_it() {
    let said = folder().succeeds("explain scene.obj --view front --at 0.5,0.01");
    assert_eq!(
        said.output,
        "\
at                   0.5 0.01 of the view frame
line                 line, edge 4-5 of bar
distance             0.01
nearest place        0.5 0, depth 2
invisibility         hidden by 1 face
piece begins         -5 0, depth 2, behind edge 0-3 of wall; beyond visible
piece ends           5 0, depth 2, behind edge 1-2 of wall; beyond visible
hidden by            face 0 of wall, vertices 0 1 2, depth -2
lines under it       none
faces at the point   face 0 of wall, vertices 0 1 2, depth -2
"
    );
    assert_eq!(said.errors, "");
}

#[test]
fn the_same_is_told_as_json() {
    let said = folder().succeeds("explain scene.obj --view front --at 0.5,0.01 --json");
    let told: serde_json::Value = serde_json::from_str(&said.output).unwrap();
    assert_eq!(told["line"]["class"], "line");
    assert_eq!(told["line"]["object"], "bar");
    assert_eq!(told["line"]["edge"], serde_json::json!([4, 5]));
    assert_eq!(told["line"]["invisibility"], 1);
    assert_eq!(told["line"]["hidden_by"].as_array().unwrap().len(), 1);
    assert_eq!(told["line"]["hidden_by"][0]["object"], "wall");
    assert_eq!(told["faces"][0]["face"], 0);
}

#[test]
fn far_from_all_lines_the_nearest_is_named() {
    let folder = folder();
    let said = folder.succeeds("explain scene.obj --view front --at 5,1000");
    assert_eq!(
        said.output,
        "\
at                   5 1000 of the view frame
line                 none within 0.2
nearest line         boundary, edge 1-2 of wall
distance             995
nearest place        5 5
faces at the point   none
"
    );
    let said = folder.succeeds("explain scene.obj --view front --at 1,2 --within 0.5");
    assert!(said.output.contains("line                 none within 0.5\n"), "{}", said.output);
    assert!(said.output.ends_with("depth -2\n"), "{}", said.output);
    let said = folder.succeeds("explain scene.obj --view front --at 0,0 --edges crease");
    assert!(said.output.contains("line                 none: the drawing is empty\n"));
}

#[test]
fn objects_cameras_and_classes_are_those_of_draw() {
    let folder = folder();
    let invisibility = |flags: &str| {
        let said = folder.succeeds(&format!("explain scene.obj {flags} --json"));
        let told: serde_json::Value = serde_json::from_str(&said.output).unwrap();
        (told["line"]["object"].clone(), told["line"]["invisibility"].clone())
    };
    let front = "--view front --at 0.5,0.01";
    assert_eq!(invisibility(front), ("bar".into(), 1.into()));
    assert_eq!(invisibility(&format!("{front} --see-through wall")), ("bar".into(), 0.into()));
    assert_eq!(invisibility(&format!("{front} --edges boundary")).0, "wall");
    assert_eq!(invisibility("--view back --at 0.5,0.01"), ("bar".into(), 0.into()));
    let eye = "--eye 5,-20,5 --target 5,0,5 --at 0.01,0";
    assert_eq!(invisibility(eye), ("bar".into(), 1.into()));
    let said = folder.succeeds("explain scene.obj --exclude wall --view front --at 0,0");
    assert!(said.output.contains("invisibility         visible\n"), "{}", said.output);
}

#[test]
fn what_cannot_be_explained_is_refused() {
    let folder = folder();
    let help = "\n\nFor more information, try '--help'.\n";
    for (code, arguments, message) in [
        (
            2,
            "explain scene.obj --at 1",
            format!(
                "umriss: invalid value '1' for '--at <U,V>': expected two numbers, as in 12.5,-3{help}"
            ),
        ),
        (
            2,
            "explain scene.obj --at 1,nan",
            format!(
                "umriss: invalid value '1,nan' for '--at <U,V>': expected two numbers, as in 12.5,-3{help}"
            ),
        ),
        (
            2,
            "explain scene.obj --at 1,2 --near 3",
            "umriss: --near needs a perspective camera: --eye or --camera\n".to_owned(),
        ),
        (
            2,
            "explain scene.obj --at 1,2 --exclude roof",
            "umriss: roof: no object has this name, expected some of wall, bar\n".to_owned(),
        ),
        (
            2,
            "explain scene.obj --at 1,2 --within 0",
            format!(
                "umriss: invalid value '0' for '--within <D>': expected a number greater than 0{help}"
            ),
        ),
        (
            1,
            "explain none.obj --at 1,2",
            "umriss: none.obj: cannot be read: No such file or directory (os error 2)\n".to_owned(),
        ),
    ] {
        folder.fails(code, arguments, &message);
    }
    for arguments in ["explain scene.obj", "explain --at 1,2"] {
        let said = folder.command(arguments).output().unwrap();
        assert_eq!(said.status.code(), Some(2), "{arguments}");
        assert!(
            String::from_utf8(said.stderr).unwrap().starts_with("umriss: the following required")
        );
    }
}
