//! Surfaces of expressions and of files of heights.

use super::fixture::Folder;

const WAVES: &str = "surface sin(x)*cos(z) --x -6..6 --z -6..6 --nx 40 --nz 30";

const GRID: &str = "1,2,3,2\n2,4,3,1\n1,2,5,2\n0,1,2,1\n";

#[test]
fn a_surface_is_drawn_in_every_format() {
    let folder = Folder::with_cube();
    folder.succeeds(&format!("{WAVES} -o a.svg -o a.hpgl -o a.json -o a.png"));
    assert!(folder.text("a.svg").starts_with("<svg"));
    assert!(folder.text("a.hpgl").starts_with("IN;"));
    assert!(folder.text("a.json").starts_with("{\"format\":\"umriss-drawing/1\""));
    assert!(folder.bytes("a.png").starts_with(b"\x89PNG"));
    folder.succeeds(&format!("{WAVES} -o b.json --threads 1"));
    assert_eq!(folder.bytes("a.json"), folder.bytes("b.json"));
}

#[test]
fn the_horizon_and_appel_draw_the_same_file() {
    let folder = Folder::with_cube();
    for flags in [
        "",
        "--view front",
        "--view cabinet --hidden dashed",
        "--direction 0.3,-1,0.4 --curves z --no-borders",
        "--eye 9,-20,7 --base -3 --hidden dashed --every 3",
        "--view iso-sw-under --base -3 --halo 1mm",
    ] {
        folder.succeeds(&format!("{WAVES} -o horizon.svg {flags}"));
        folder.succeeds(&format!("{WAVES} -o appel.svg {flags} --method appel"));
        assert_eq!(folder.text("horizon.svg"), folder.text("appel.svg"), "{flags}");
    }
}

#[test]
fn a_computed_surface_can_be_put_on_another_page() {
    let folder = Folder::with_cube();
    let flags = "--paper a6 --weight 0.5..0.1mm --halo 0.8mm --hidden dashed";
    folder.succeeds(&format!("{WAVES} -o a.json -o direct.svg {flags}"));
    folder.succeeds(&format!("draw a.json -o restyled.svg {flags}"));
    assert_eq!(folder.text("direct.svg"), folder.text("restyled.svg"));
    assert!(folder.text("direct.svg").contains("hidden"));
}

#[test]
fn families_and_borders_are_chosen() {
    let folder = Folder::with_cube();
    let lines = |flags: &str| {
        folder.succeeds(&format!("surface 0*x --nx 5 --nz 4 --view iso -o a.json {flags} --quiet"));
        folder.text("a.json").matches("\"visible\":true").count()
    };
    assert_eq!(lines(""), 4 * 4 + 5 * 3);
    assert_eq!(lines("--curves z"), 4 * 4 + 2 * 3);
    assert_eq!(lines("--curves x --no-borders"), 5 * 3);
    assert_eq!(lines("--curves z --no-borders --every 2"), 3 * 4);
}

#[test]
fn three_kinds_of_files_give_one_drawing() {
    let folder = Folder::with_cube();
    folder.write("a.csv", GRID);
    let header = "ncols 4\nnrows 4\nxllcenter 0\nyllcenter -3\ncellsize 1\n";
    folder.write("b.asc", &format!("{header}{}", GRID.replace(',', " ")));
    folder.write("c.txt", &GRID.replace(',', ";"));
    folder.succeeds("surface a.csv -o a.svg");
    folder.succeeds("surface b.asc -o b.svg");
    folder.succeeds("surface c.txt -o c.svg");
    assert_eq!(folder.text("a.svg"), folder.text("b.svg"));
    assert_eq!(folder.text("a.svg"), folder.text("c.svg"));
    folder.succeeds("surface a.csv -o twice.svg --z-scale 2 --x 0..6 --z 0..6 --scale fit");
    assert_eq!(folder.text("a.svg"), folder.text("twice.svg"));
}

#[test]
fn missing_heights_are_refused_or_cut_off_and_it_is_said_which() {
    let folder = Folder::with_cube();
    folder.write("gap.csv", "1,2,3\n4,5,\n7,8,9\n");
    folder.fails(
        1,
        "surface gap.csv -o a.svg",
        "umriss: gap.csv: 1 of 9 heights are missing, the first at x = 2, z = 1 (column 3, row 2): \
         expected a height everywhere, or --missing cut or hole\n",
    );
    let said = folder.succeeds("surface gap.csv -o a.svg --missing cut");
    assert_eq!(
        said.errors,
        "umriss: gap.csv: 1 of 9 heights are missing: cut to columns 1 to 2, rows 1 to 3\n"
    );
    folder.fails(
        1,
        "surface 1/x --x 0..2 --nx 3 --nz 2 -o a.svg",
        "umriss: '1/x': 2 of 6 heights are missing, the first at x = 0, z = -5 (column 1, row 1): \
         expected a height everywhere, or --missing cut or hole\n",
    );
}

#[test]
fn names_of_columns_and_rows_are_told_and_passed_over() {
    let folder = Folder::with_cube();
    let header = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/field/header_row.csv"));
    folder.write_bytes("header_row.csv", &header.unwrap());
    folder.write("plain.csv", "5,6,7\n6,7,8\n7,8,9\n");
    folder.write("index.txt", "; a; b; c\nr; 5; 6; 7\ns; 6; 7; 8\nt; 7; 8; 9\n");
    folder.succeeds("surface plain.csv -o plain.svg");
    let said = folder.succeeds("surface header_row.csv -o header.svg");
    assert_eq!(said.errors, "umriss: header_row.csv: passed over: a row of names (line 1)\n");
    let said = folder.succeeds("surface index.txt -o index.svg");
    assert_eq!(
        said.errors,
        "umriss: index.txt: passed over: a row of names (line 1)\n\
         umriss: index.txt: passed over: the first column, of names\n"
    );
    assert_eq!(folder.text("plain.svg"), folder.text("header.svg"));
    assert_eq!(folder.text("plain.svg"), folder.text("index.svg"));
}

#[test]
fn grids_in_degrees_are_told_with_the_scale_that_looks_right() {
    let folder = Folder::with_cube();
    let header = "ncols 3\nnrows 3\nxllcorner 7\nyllcorner 39.985\ncellsize 0.01\n";
    folder.write("alps.asc", &format!("{header}100 200 300 400 900 600 700 800 900\n"));
    let said = folder.succeeds("surface alps.asc -o a.svg");
    assert_eq!(
        said.errors,
        "umriss: alps.asc: places look like degrees, heights like metres: --z-scale 1.1710e-5 looks \
         right at latitude 40.0\n"
    );
    let said = folder.succeeds("surface alps.asc -o a.svg --z-scale 1.1710e-5");
    assert_eq!(said.errors, "");
    folder.write("lon.csv", "lat,7,7.5\n60,800,900\n59,100,200\n");
    let said = folder.succeeds("surface lon.csv -o a.svg");
    assert!(
        said.errors.contains("--z-scale 1.7655e-5 looks right at latitude 59.5"),
        "{}",
        said.errors
    );
}

#[test]
fn missing_heights_are_holes_in_any_view() {
    let folder = Folder::with_cube();
    folder.write("hole.csv", "0,0,0,0\n0,,0,0\n0,0,0,0\n0,0,0,0\n");
    let said = folder.succeeds("surface hole.csv -o a.json --missing hole --view top");
    assert_eq!(said.errors, "umriss: hole.csv: 1 of 16 heights are missing: drawn with holes\n");
    // Of 24 sides four go to the missing height, and four are across.
    assert_eq!(folder.text("a.json").matches("\"visible\":true").count(), 24 - 4 + 4);
    let borders = "--every 9 --curves z";
    folder.succeeds(&format!("surface hole.csv -o b.json --missing hole --view top {borders}"));
    assert_eq!(folder.text("b.json").matches("\"visible\":true").count(), 12 + 4);
    folder.succeeds("surface hole.csv -o c.svg --missing hole --base -1 --hidden dashed");
    folder.succeeds("surface 1/(x^2+z^2-4) --missing hole -o d.svg --nx 21 --nz 21 --z-scale 0.1");
    folder.fails(
        2,
        "surface hole.csv -o c.svg --missing hole --method horizon --quiet",
        "umriss: a floating horizon has no holes: expected --missing cut, or no --method horizon\n",
    );
    folder.write("none.csv", "1,\n,1\n");
    folder.fails(
        1,
        "surface none.csv -o c.svg --missing hole --quiet",
        "umriss: none.csv: no cell of the grid has three of its four heights: expected more data\n",
    );
    // Without a hole nothing is different.
    folder.write("a.csv", GRID);
    folder.succeeds("surface a.csv -o e.svg --missing hole");
    folder.succeeds("surface a.csv -o f.svg");
    assert_eq!(folder.text("e.svg"), folder.text("f.svg"));
}

#[test]
fn several_surfaces_are_objects_of_one_picture() {
    let folder = Folder::with_cube();
    folder.write("a.csv", GRID);
    let flags = "--nx 4 --nz 4 --view iso --layer-by object";
    let said = folder.succeeds(&format!("surface a.csv 0.5*x 9+0*x -o a.svg -o a.json {flags}"));
    assert_eq!(said.errors, "");
    let svg = folder.text("a.svg");
    for label in ["1-a", "2-0.5*x", "3-9+0*x"] {
        assert!(svg.contains(&format!("inkscape:label=\"{label}\"")), "{label}\n{svg}");
    }
    // The plane and the hills pass through one another in a line; the plane
    // above touches nothing.
    let crossing = folder.text("a.json").matches("\"class\":\"intersection\"").count();
    assert!(crossing > 2, "{crossing}");
    folder.succeeds(&format!("surface a.csv 9+0*x -o b.json {flags}"));
    assert!(!folder.text("b.json").contains("\"class\":\"intersection\""));
    // What is in front hides: a wall before a flat.
    folder
        .succeeds("surface 0*x -o flat.json --x 0..1 --z 0..1 --nx 2 --nz 2 --view front --quiet");
    folder.fails(
        2,
        "surface x z -o a.svg --method horizon",
        "umriss: a floating horizon draws one surface: expected one, or no --method horizon\n",
    );
    folder.fails(
        2,
        "surface - - -o a.svg",
        "umriss: - is given twice, but standard input can be read only once\n",
    );
    folder.succeeds("surface x a.csv -o c.svg --nx 7 --view iso");
}

#[test]
fn what_makes_no_sense_is_a_usage_error() {
    let folder = Folder::with_cube();
    folder.write("a.csv", GRID);
    for (command, message) in [
        (
            "surface x*t -o a.svg",
            "umriss: 'x*t': 't' is no variable, expected an expression of x and z as in \
             sin(x)*cos(z)\n",
        ),
        (
            "surface x -o a.svg --view top",
            "umriss: the eye looks straight down or up, where a floating horizon has no columns: \
             expected another direction, or a method of `umriss draw` such as --method appel\n",
        ),
        (
            "surface x -o a.svg --eye 1,1,20",
            "umriss: the eye stands above or below the surface, where a floating horizon has no \
             nearest row: expected an eye beside it, or a method of `umriss draw` such as --method \
             appel\n",
        ),
        (
            "surface x -o a.svg --outline 1mm",
            "umriss: a floating horizon does not tell the outline: expected no --outline and no rule \
             for it, or --method appel\n",
        ),
        (
            "surface x -o a.svg --hidden dashed --hidden-by sheets",
            "umriss: a floating horizon does not count what hides a line: expected no --hidden-by, or \
             --method appel\n",
        ),
        (
            "surface a.csv -o a.svg --nx 7",
            "umriss: --nx and --nz: a file has its own points, expected an expression or neither\n",
        ),
        (
            "surface x -o a.svg --base 0",
            "umriss: the base 0 lies among the heights of the border, -5 to 5: expected one below or \
             above them\n",
        ),
    ] {
        folder.fails(2, command, message);
    }
    folder.fails(
        1,
        "surface none.csv -o a.svg",
        "umriss: none.csv: cannot be read: No such file or directory (os error 2)\n",
    );
    folder.succeeds("surface x -o a.svg --view top --method appel");
}
