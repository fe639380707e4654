//! `umriss clip`: files in, files out, and what it refuses.

use super::fixture::Folder;

const A: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[2,0],[2,2],[0,2],[0,0]]]}"#;
const B: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="4mm" height="3mm" viewBox="0 0 4 3"><path d="M1 1H3V3H1z"/></svg>"#;

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
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"4mm\" height=\"3mm\" \
         viewBox=\"0 0 4 3\">\n\
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
fn an_svg_is_read_as_it_is_displayed_and_what_changes_is_told() {
    let folder = folder();
    folder.write(
        "all.svg",
        "<svg xmlns='http://www.w3.org/2000/svg' width='100' height='100'>\n<circle r='20'/>\
         <text>A</text></svg>",
    );
    let said = folder.succeeds("clip all.svg --op union -o out.svg");
    assert_eq!(
        said.errors,
        "umriss: all.svg: passed over: <text>, it has no outline here (line 2)\n\
         umriss: all.svg: what lies off the page of 26.458 x 26.458 mm is left out; --off-page \
         takes it\n\
         umriss: all.svg: curves are lines within 0.005 mm of them (--flatness)\n\
         umriss: all.svg: places are rounded to 0.00001 mm (--snap)\n"
    );
    let corners = folder.text("out.svg").matches('L').count();
    let quiet = folder.succeeds("clip all.svg --op union -o few.svg --flatness 0.1mm --quiet");
    assert_eq!(quiet.errors, "");
    assert!(folder.text("few.svg").matches('L').count() * 3 < corners);
    assert!(folder.text("few.svg").contains("width=\"26.45833mm\""), "{}", folder.text("few.svg"));
    folder.succeeds("clip all.svg --op union -o whole.svg --off-page");
    let whole = folder.text("whole.svg");
    assert!(whole.contains("viewBox=\"-5.29167 -5.29167 31.75 31.75\""), "{whole}");
    let said = folder.succeeds("clip whole.svg whole.svg --op xor -o - --format geojson");
    assert_eq!(said.output, "{\"type\":\"MultiPolygon\",\"coordinates\":[]}\n");
    assert_eq!(said.errors, "");
    folder.fails(
        2,
        "clip all.svg --op union -o out.svg --flatness 0mm",
        "umriss: invalid value '0mm' for '--flatness <L>': expected a length of more than 0\n\n\
         For more information, try '--help'.\n",
    );
    folder.write_bytes("packed.svg", b"\x1f\x8b\x08");
    folder.fails(
        1,
        "clip packed.svg --op union -o out.svg",
        "umriss: packed.svg:1: the file is compressed (svgz), expected the SVG itself, as gunzip \
         writes it\n",
    );
    for command in ["clip a.svgz --op union -o out.svg", "clip all.svg --op union -o a.svgz"] {
        folder.fails(
            2,
            command,
            "umriss: a.svgz: compressed SVG is neither read nor written, expected svg, as gunzip \
             makes it\n",
        );
    }
}

#[test]
fn a_result_has_the_page_of_what_was_read() {
    let folder = folder();
    folder.write("a4.svg", "<svg width='210mm' height='297mm' viewBox='0 0 210 297'><rect width='9' height='9'/></svg>");
    folder.succeeds("clip a4.svg b.svg --op union -o out.svg");
    assert!(
        folder.text("out.svg").contains("width=\"210mm\" height=\"297mm\" viewBox=\"0 0 210 297\"")
    );
    // Places of the other file lie beyond the page.
    folder.succeeds("clip b.svg a4.svg a.geojson --op difference -o out.svg");
    folder.write("far.geojson", &A.replace("[0,0]", "[-5,0]"));
    folder.succeeds("clip b.svg far.geojson --op union -o out.svg");
    assert!(folder.text("out.svg").contains("viewBox=\"-5 0 9 3\" data-origin=\"coordinates\""));
    let said = folder.succeeds("clip out.svg b.svg --op intersection -o - --format geojson");
    assert!(said.output.contains("[1,1]") && said.output.contains("[3,3]"), "{}", said.output);
}

#[test]
fn points_and_lines_beside_polygons_are_passed_over() {
    let folder = folder();
    folder.write(
        "mixed.geojson",
        &format!(
            "{{\"type\":\"GeometryCollection\",\"geometries\":[{A},\
             {{\"type\":\"Point\",\"coordinates\":[1,2]}},\
             {{\"type\":\"LineString\",\"coordinates\":[[1,2],[3,4]]}},\
             {{\"type\":\"Point\",\"coordinates\":[1,2]}}]}}"
        ),
    );
    let said = folder.succeeds("clip mixed.geojson --op union -o - --format geojson");
    assert_eq!(
        said.errors,
        "umriss: mixed.geojson: passed over: LineString, it has no area (1)\n\
         umriss: mixed.geojson: passed over: Point, it has no area (2)\n"
    );
    folder.succeeds("clip a.geojson mixed.geojson --op xor -o out.geojson --quiet");
    assert_eq!(folder.text("out.geojson"), "{\"type\":\"MultiPolygon\",\"coordinates\":[]}\n");
}

#[test]
fn what_is_wrong_is_said_with_file_and_line() {
    let folder = folder();
    folder.write("point.geojson", "\n{\"type\":\"Point\",\"coordinates\":[1,2]}");
    folder.write("curve.svg", "<svg>\n<path d=\"M0 0J1 1\"/></svg>");
    folder.fails(
        1,
        "clip point.geojson --op union -o out.svg",
        "umriss: point.geojson:2: `Point` has no area, expected Polygon, MultiPolygon, Feature, \
         FeatureCollection or GeometryCollection\n",
    );
    folder.fails(
        1,
        "clip a.geojson curve.svg --op union -o out.svg",
        "umriss: curve.svg:2: `J` in path data, expected M, L, H, V, C, S, Q, T, A or Z\n",
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
