//! Polygons that touch or cross themselves, and those that are not planar.

use super::fixture::{Folder, assert_near, drawn_length, field};

/// A file with one line of it, the first that begins so, written in all
/// rotations and both directions.
fn all_ways(text: &str, face: &str) -> Vec<String> {
    let line = text.lines().find(|line| line.starts_with(face)).unwrap();
    let mut corners: Vec<&str> = line.split_whitespace().skip(1).collect();
    let mut ways = Vec::new();
    for _ in 0..2 {
        for _ in 0..corners.len() {
            corners.rotate_left(1);
            ways.push(text.replacen(line, &format!("f {}", corners.join(" ")), 1));
        }
        corners.reverse();
    }
    ways
}

/// The length of a drawing from above, in millimetres.
fn length_from_above(folder: &Folder, model: &str) -> f64 {
    folder.succeeds(&format!("draw {model} --view top -o a.svg"));
    drawn_length(&folder.text("a.svg"))
}

/// A square of side 10 with a hole of side 4 takes 190 mm of the paper.
const SCALE: f64 = 19.0;
const KEYHOLE: f64 = (4.0 * 10.0 + 4.0 * 4.0) * SCALE;

const CORNERS: &str = "0 0 0\n10 0 0\n10 10 0\n0 10 0\n3 3 0\n7 3 0\n7 7 0\n3 7 0\n";
const OUTLINE: &str = "0 1 2 3 0 4 7 6 5 4";

#[test]
fn a_keyhole_is_open_and_its_bridge_no_line_in_all_formats() {
    let folder = Folder::with_cube();
    folder.write("keyhole.obj", &field("keyhole.obj"));
    folder.write("keyhole.off", &format!("OFF\n8 1 0\n{CORNERS}10 {OUTLINE}\n"));
    let header = "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\n\
                  property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    folder.write("keyhole.ply", &format!("{header}{CORNERS}10 {OUTLINE}\n"));
    let vertices: Vec<String> =
        CORNERS.lines().map(|line| format!("[{}]", line.replace(' ', ","))).collect();
    let json =
        |face: &str| format!("{{\"vertices\":[{}],\"faces\":[{{{face}}}]}}", vertices.join(","));
    folder.write("keyhole.json", &json(&format!("\"outer\":[{}]", OUTLINE.replace(' ', ","))));
    folder.write("hole.json", &json("\"outer\":[0,1,2,3],\"holes\":[[4,5,6,7]]"));
    for name in ["keyhole.obj", "keyhole.off", "keyhole.ply", "keyhole.json", "hole.json"] {
        assert_near(length_from_above(&folder, name), KEYHOLE, name);
        let said = folder.succeeds(&format!("verify {name} --view top"));
        assert_eq!(said.errors, "", "{name}");
    }
}

#[test]
fn a_keyhole_shows_what_lies_behind_it_wherever_it_begins() {
    let folder = Folder::with_cube();
    // The triangle behind has a side of 2 and two of the root of 5.
    let expected = KEYHOLE + (2.0 + 2.0 * 5_f64.sqrt()) * SCALE;
    for text in all_ways(&field("kh_rot1.obj"), "f 2") {
        folder.write("a.obj", &text);
        assert_near(length_from_above(&folder, "a.obj"), expected, &text);
    }
    folder.succeeds("verify a.obj --view top");
}

#[test]
fn a_hole_that_touches_the_shell_takes_its_side_away() {
    let folder = Folder::with_cube();
    // A notch of 4 by 3 in the lower side, and one that touches in a corner.
    let scene = |hole: &str| {
        format!(
            "{{\"vertices\":[[0,0,0],[10,0,0],[10,10,0],[0,10,0],{hole}],\
             \"faces\":[{{\"outer\":[0,1,2,3],\"holes\":[[4,5,6,7]]}}]}}"
        )
    };
    folder.write("side.json", &scene("[3,0,0],[7,0,0],[7,3,0],[3,3,0]"));
    folder.write("corner.json", &scene("[5,0,0],[7,3,0],[5,6,0],[3,3,0]"));
    assert_near(length_from_above(&folder, "side.json"), 46.0 * SCALE, "side");
    let expected = (40.0 + 4.0 * 13_f64.sqrt()) * SCALE;
    assert_near(length_from_above(&folder, "corner.json"), expected, "corner");
    for name in ["side.json", "corner.json"] {
        folder.succeeds(&format!("verify {name} --view top"));
    }
}

#[test]
fn two_faces_on_one_set_of_vertices_are_two_faces() {
    let folder = Folder::with_cube();
    folder.write("a.obj", &field("sameset.obj"));
    let said = folder.succeeds("info a.obj --json");
    assert!(said.output.contains("\n  \"faces\": 2,"), "{}", said.output);
    assert!(said.output.contains("\"duplicate_faces\": 0"), "{}", said.output);
    // The same face again, turned and from another corner on, is none.
    folder.write("a.obj", &(field("sameset.obj") + "f 3 2 1 4\n"));
    let said = folder.succeeds("info a.obj --json");
    assert!(said.output.contains("\"duplicate_faces\": 1"), "{}", said.output);
}

#[test]
fn a_face_that_crosses_itself_is_told_by_its_line_in_all_formats() {
    let folder = Folder::with_cube();
    folder.write("a.obj", &field("bowtie.obj"));
    let corners = "0 0 0\n8 8 0\n8 0 0\n0 8 0\n";
    folder.write("a.off", &format!("OFF\n4 2 0\n{corners}3 0 1 2\n4 0 1 2 3\n"));
    let header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n\
                  property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    folder.write("a.ply", &format!("{header}{corners}4 0 1 2 3\n"));
    folder.write(
        "a.json",
        "{\"vertices\":[[0,0,0],[8,8,0],[8,0,0],[0,8,0]],\n\"faces\":[\n{\"outer\":[0,1,2,3]}]}",
    );
    let told = [("obj", 0, 5), ("off", 1, 8), ("ply", 0, 14), ("json", 0, 3)];
    for (format, face, line) in told {
        let said = folder.succeeds(&format!("verify a.{format} --view top"));
        let expected = format!("umriss: a.{format}: face {face} (line {line}) crosses itself\n");
        assert_eq!(said.errors, expected);
    }
    // Its four edges.
    let expected = (16.0 + 2.0 * 128_f64.sqrt()) * (190.0 / 8.0);
    assert_near(length_from_above(&folder, "a.obj"), expected, "bowtie");
    let said = folder.succeeds("info a.obj --json");
    assert!(said.output.contains("\n  \"faces\": 1,"), "{}", said.output);
    assert!(said.output.contains("\"crossed_faces\": 1"), "{}", said.output);
}

#[test]
fn a_polygon_of_coordinates_of_all_orders_is_its_outline() {
    let folder = Folder::with_cube();
    // A square of side 4 with a notch down to its lower side, 190 mm wide.
    let expected = (12.0 + 2.0 * 20_f64.sqrt()) * (190.0 / 4.0);
    for text in all_ways(&field("wide_concave.obj"), "f ") {
        folder.write("a.obj", &text);
        assert_near(length_from_above(&folder, "a.obj"), expected, &text);
        folder.succeeds("verify a.obj --view top");
    }
}

#[test]
fn the_diagonal_of_a_bent_face_does_not_depend_on_its_corners_order() {
    let folder = Folder::with_cube();
    let mut drawings = Vec::new();
    for text in all_ways(&field("nonplanar.obj"), "f ") {
        folder.write("a.obj", &text);
        folder.succeeds("draw a.obj -o a.svg -o a.json --fill shade --hidden dashed");
        drawings.push(folder.text("a.svg"));
    }
    assert_eq!(drawings.len(), 8);
    drawings.dedup();
    assert_eq!(drawings.len(), 1);
}

#[test]
fn a_crossed_bent_face_and_a_fin_on_a_diagonal_are_verified_from_anywhere() {
    let folder = Folder::with_cube();
    for text in all_ways(&field("crossed_quad.obj"), "f ") {
        folder.write("a.obj", &text);
        for view in ["top", "right", "iso"] {
            let said = folder.succeeds(&format!("verify a.obj --view {view}"));
            assert_eq!(said.errors, "umriss: a.obj: face 0 (line 5) crosses itself\n");
        }
    }
    let fin = field("fin_on_diagonal.obj");
    for text in ["f 1 2", "f 1 3"].iter().flat_map(|face| all_ways(&fin, face)) {
        folder.write("a.obj", &text);
        folder.succeeds("verify a.obj --view bottom");
    }
}
