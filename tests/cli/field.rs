//! Models of public reports, whose numbers are rounded, huge or tiny: what a
//! person means by them is what is drawn.

use super::fixture::{Folder, assert_near, drawn_length, field};

/// Puts an input of `tests/field` into a folder.
fn put(folder: &Folder, name: &str) {
    folder.write(name.rsplit('/').next().unwrap(), &field(name));
}

/// The millimetres that `draw` makes of a model, and what it says.
fn drawn(folder: &Folder, arguments: &str) -> (f64, String) {
    let said = folder.succeeds(&format!("draw {arguments} -o a.svg"));
    (drawn_length(&folder.text("a.svg")), said.errors)
}

#[test]
fn faces_that_were_laid_on_one_another_are_drawn_once() {
    let folder = Folder::with_cube();
    for (name, flags, expected) in [
        ("two_pins.obj", "--view iso-sw", 922.1),
        ("ulp_overlap.obj", "--view front", 665.0),
        ("csg_cube_square.obj", "", 1206.7),
        // The rims of what is cut are creases of the other surface.
        ("csg_cube_square.obj", "--edges contour,crease,non-manifold,intersection,line", 1206.7),
    ] {
        put(&folder, name);
        assert_near(drawn(&folder, &format!("{name} {flags}")).0, expected, name);
    }
    // All lines are there still for whoever wants them.
    assert!(drawn(&folder, "two_pins.obj --view iso-sw --merge 0").0 > 1200.0);
}

#[test]
fn dashes_of_twins_do_not_fill_each_others_gaps() {
    let folder = Folder::with_cube();
    let dashes = |name: &str| {
        put(&folder, name);
        drawn(&folder, &format!("{name} --view iso --hidden dashed")).0
    };
    let (rounded, exact) = (dashes("dash_min.obj"), dashes("dash_min_bin.obj"));
    assert!((rounded - exact).abs() < 0.2, "{rounded} and {exact} mm");
}

#[test]
fn torn_borders_are_told_and_closed_by_the_flag_that_is_told() {
    let folder = Folder::with_cube();
    put(&folder, "cracked.obj");
    let told = "umriss: 1104 borders lie together within 1e-4: --weld 1e-4\n";
    let (length, said) = drawn(&folder, "cracked.obj");
    assert_eq!(said, told);
    assert!(length > 4000.0, "nothing is repaired unasked: {length}");
    assert_eq!(folder.succeeds("info cracked.obj").errors, told);
    for flag in ["--weld 1e-4", "--heal 1e-4"] {
        let (length, said) = drawn(&folder, &format!("cracked.obj {flag}"));
        assert!((length - 593.8).abs() < 0.5, "{flag}: {length} mm");
        assert!(!said.contains("lie together"), "{said}");
    }
    // All digits of the doubles are there, so by its digits nothing is near.
    let said = drawn(&folder, "cracked.obj --heal auto").1;
    assert!(said.ends_with("1104 borders lie together within 1e-4: --heal 1e-4\n"), "{said}");
    // What has no borders has nothing to tell.
    assert_eq!(drawn(&folder, "cube.obj").1, "");
}

#[test]
fn a_corner_beside_an_edge_is_told_and_healed() {
    let folder = Folder::with_cube();
    // One long edge against two short ones, whose corner is off by a last digit.
    folder.write(
        "tj.obj",
        "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 2 0\nv 1.0003 2 0\nv 2 2 0\nv 1 1.00001 0\n\
         f 1 2 3 4\nf 4 8 6 5\nf 8 3 7 6\n",
    );
    let (length, said) = drawn(&folder, "tj.obj --view top");
    assert!(length > 765.0, "{length} mm");
    assert_eq!(said, "umriss: a border lies beside others within 1e-4: --heal 1e-4\n");
    let (length, _) = drawn(&folder, "tj.obj --view top --heal 1e-4");
    assert_near(length, 760.0, "the rim alone");
}

#[test]
fn what_was_healed_is_a_model_in_every_format() {
    let folder = Folder::with_cube();
    put(&folder, "cracked.obj");
    for name in ["a.obj", "a.off", "a.ply", "a.stl", "a.json"] {
        let said = folder.succeeds(&format!("heal cracked.obj -o {name} --within 1e-4"));
        assert!(said.errors.contains("1104 borders closed"), "{}", said.errors);
        let (length, said) = drawn(&folder, name);
        assert!((length - 593.8).abs() < 0.5, "{name}: {length} mm");
        assert_eq!(said, "", "{name}");
    }
    let standard = folder.succeeds("heal cracked.obj -o - --format off --within 1e-4").output;
    assert_eq!(standard, folder.text("a.off"));
    let expected = "umriss: glTF is read only: expected obj, off, ply, stl or json\n";
    folder.fails(2, "heal cracked.obj -o a.glb", expected);
    let expected = "umriss: --output cracked.obj would replace cracked.obj, which is read: expected \
                    another file\n";
    folder.fails(2, "heal cracked.obj -o cracked.obj", expected);
}

#[test]
fn regions_of_coplanar_and_self_touching_polygons_agree_with_lines() {
    let folder = Folder::with_cube();
    for name in ["20343.obj", "22150_min.obj", "22419_min.obj", "650_min.obj"] {
        put(&folder, &format!("verify/{name}"));
        folder.succeeds(&format!("verify {name} --view front"));
    }
    // Coordinates an ulp from zero beside ordinary ones.
    put(&folder, "verify_slow_denormal.obj");
    folder.succeeds("verify verify_slow_denormal.obj --view iso");
}

#[test]
fn coordinates_at_the_end_of_the_range_are_answered_or_refused() {
    let folder = Folder::with_cube();
    put(&folder, "verify_panic_1e308.obj");
    folder.succeeds("verify verify_panic_1e308.obj --view top");
    folder.succeeds("draw verify_panic_1e308.obj --view top -o a.svg");
    #[cfg(feature = "png")]
    folder.fails(
        1,
        "raster verify_panic_1e308.obj --view top -o a.png",
        "umriss: no pixels can be laid over this view: expected an image with an extent, and \
         coordinates below 1e307\n",
    );
}

#[test]
fn a_frame_inside_of_a_face_is_filled_whichever_way_the_face_turns() {
    let folder = Folder::with_cube();
    let fills = |name: &str, flags: &str| {
        put(&folder, name);
        folder.succeeds(&format!("draw {name} --view top -o a.svg {flags}"));
        let svg = folder.text("a.svg");
        let paths = svg.lines().filter(|line| line.starts_with("<path") && line.contains("fill="));
        let mut data: Vec<usize> = paths.map(|line| line.matches('L').count()).collect();
        data.sort_unstable();
        data
    };
    for method in ["--method painter --fill flat", "--fill flat"] {
        let flags = format!("--frame=-0.5,-0.5,0.5,0.5 {method}");
        let one = fills("square.obj", &flags);
        assert!(!one.is_empty(), "{method}");
        assert_eq!(one, fills("square_turned.obj", &flags), "{method}");
    }
    let flags = "--method painter --fill flat --frame=-1.5,-1.5,1.5,1.5";
    assert_eq!(fills("two_quads.obj", flags), fills("two_quads_cw.obj", flags));
}
