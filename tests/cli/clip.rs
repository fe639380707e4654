//! `umriss clip`: files in, files out, and what it refuses.

use super::fixture::Folder;

const A: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[2,0],[2,2],[0,2],[0,0]]]}"#;
const B: &str = r#"<svg xmlns="http://www.w3.org/2000/svg"><path d="M1 1H3V3H1z"/></svg>"#;

fn folder() -> Folder {
    let folder = Folder::with_cube();
    folder.write("a.geojson", A);
    folder.write("b.svg", B);
    folder
}

#[test]
fn every_operation_writes_either_format() {
    let folder = folder();
    for (operation, expected) in [
        ("intersection", "[[[[1,1],[2,1],[2,2],[1,2],[1,1]]]]"),
        ("union", "[[[[0,0],[2,0],[2,1],[3,1],[3,3],[1,3],[1,2],[0,2],[0,0]]]]"),
        ("difference", "[[[[0,0],[2,0],[2,1],[1,1],[1,2],[0,2],[0,0]]]]"),
        (
            "xor",
            "[[[[0,0],[2,0],[2,1],[1,1],[1,2],[0,2],[0,0]]],\n\
             [[[1,2],[2,2],[2,1],[3,1],[3,3],[1,3],[1,2]]]]",
        ),
    ] {
        folder.succeeds(&format!("clip a.geojson b.svg --op {operation} -o out.geojson"));
        let text = folder.text("out.geojson");
        assert_eq!(text, format!("{{\"type\":\"MultiPolygon\",\"coordinates\":{expected}}}\n"));
    }
    folder.succeeds("clip a.geojson b.svg --op intersection -o out.svg");
    assert_eq!(
        folder.text("out.svg"),
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"1 1 1 1\">\n\
         <path fill-rule=\"evenodd\" d=\"M1 1L2 1L2 2L1 2Z\"/>\n</svg>\n"
    );
}

#[test]
fn standard_input_and_output_need_their_formats() {
    let folder = folder();
    let said = folder.succeeds_with_input(
        "clip - b.svg --op intersection -o - --format svg --input-format geojson",
        A.as_bytes(),
    );
    assert!(said.output.contains("M1 1L2 1L2 2L1 2Z"), "{}", said.output);
}

#[test]
fn fill_rules_are_those_of_the_file_unless_a_rule_is_given() {
    let folder = folder();
    // Two squares, one within the other, both counterclockwise.
    let path = "M0 0H4V4H0zM1 1H2V2H1z";
    folder.write("plain.svg", &format!("<svg><path d=\"{path}\"/></svg>"));
    folder.write("odd.svg", &format!("<svg fill-rule=\"evenodd\"><path d=\"{path}\"/></svg>"));
    for (file, flags, rings) in [
        ("plain.svg", "", 1),
        ("odd.svg", "", 2),
        ("plain.svg", "--fill evenodd", 2),
        ("odd.svg", "--fill nonzero", 1),
        ("odd.svg", "--fill positive", 1),
        ("odd.svg", "--fill negative", 0),
        ("plain.svg", "--fill polygons", 2),
    ] {
        folder.succeeds(&format!("clip {file} --op union -o out.svg {flags}"));
        assert_eq!(folder.text("out.svg").matches('M').count(), rings, "{file} {flags}");
    }
}

#[test]
fn what_is_wrong_is_said_with_file_and_line() {
    let folder = folder();
    folder.write("point.geojson", "\n{\"type\":\"Point\",\"coordinates\":[1,2]}");
    folder.write("curve.svg", "<svg>\n<path d=\"M0 0C1 1 2 2 3 3\"/></svg>");
    folder.fails(
        1,
        "clip point.geojson --op union -o out.svg",
        "umriss: point.geojson:2: `Point` has no area, expected Polygon, MultiPolygon, Feature, \
         FeatureCollection or GeometryCollection\n",
    );
    folder.fails(
        1,
        "clip a.geojson curve.svg --op union -o out.svg",
        "umriss: curve.svg:2: `C` in path data, expected M, L, H, V or Z\n",
    );
    folder.fails(
        1,
        "clip none.svg --op union -o out.svg",
        "umriss: none.svg: cannot be read: No such file or directory (os error 2)\n",
    );
    folder.fails(
        2,
        "clip a.geojson --op union -o out.dxf",
        "umriss: out.dxf: `dxf` is no format of polygons; expected geojson, json or svg\n",
    );
    folder.fails(
        2,
        "clip cube.obj --op union -o out.svg",
        "umriss: cube.obj: `obj` is no format of polygons; expected geojson, json or svg\n",
    );
    folder.fails(2, "clip - --op union -o out.svg", "umriss: - needs --input-format\n");
    folder.fails(2, "clip a.geojson --op union -o -", "umriss: --output - needs --format\n");
    folder.fails(
        2,
        "clip a.geojson --op minus -o out.svg",
        "umriss: invalid value 'minus' for '--op <OP>': expected one of intersection, union, \
         difference, xor\n\nFor more information, try '--help'.\n",
    );
}
