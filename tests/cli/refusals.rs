//! What the program refuses: whole messages, exit codes, nothing left behind.

use super::fixture::Folder;
use std::io::Read;
use std::process::{Command, Stdio};

#[test]
fn command_lines_that_make_no_sense_end_with_two() {
    let folder = Folder::with_cube();
    let ask = "\n\nFor more information, try '--help'.\n";
    for (arguments, message) in [
        (
            "draw cube.obj -o a.svg --direction 0,0,-1",
            "up is parallel to the viewing direction: expected another up vector\n",
        ),
        (
            "draw cube.obj -o a.svg --view top --up 0,0,2",
            "up is parallel to the viewing direction: expected another up vector\n",
        ),
        (
            "draw cube.obj -o a.svg --view cabinet --up 0,1,0",
            "--up cannot be chosen for the oblique view cabinet\n",
        ),
        (
            "draw cube.obj -o a.svg --eye 1,2,3 --target 1,2,3",
            "the eye and the target are the same point: expected two different points\n",
        ),
        (
            "draw cube.obj -o a.svg --near 1",
            "--near needs a perspective camera: --eye or --camera\n",
        ),
        (
            "draw cube.obj -o a.hpgl --method painter --fill flat",
            "--method painter: a pen cannot paint over what it drew, expected an SVG or PNG \
             output, or --method appel\n",
        ),
        (
            "draw cube.obj -o a.svg -o a.json --method painter",
            "--method painter: JSON is for visible lines, and painted ones go on behind other \
             faces, expected an SVG or PNG output, or --method appel\n",
        ),
        (
            "draw cube.obj -o a.svg --method painter --hidden dashed",
            "--method painter: what is painted over is gone, expected --hidden none or --method \
             appel\n",
        ),
        (
            "draw cube.obj -o a.svg --method painter --halo 1mm",
            "--method painter: lines are drawn face by face, expected no flags for --halo, or \
             --method appel\n",
        ),
        ("draw cube.obj -o a.svg --painter list", "--painter needs --method painter\n"),
        (
            "raster cube.obj -o a.svg --show splits",
            "--show splits: z-buffer cuts no windows, expected --method warnock or warnock-vertex\n",
        ),
        (
            "raster cube.obj -o a.png --show coverage",
            "--show coverage: z-buffer sees a pixel's centre only, expected --method a-buffer\n",
        ),
        (
            "raster cube.obj -o a.png --opacity 0.5",
            "--opacity, --pattern: expected --method a-buffer with --show shade\n",
        ),
        ("raster cube.obj -o a.svg", "--output: only splits are drawn as SVG, expected a PNG\n"),
        (
            "raster cube.obj -o a.jpg",
            "--output a.jpg: expected the name of a PNG, or of an SVG for --show splits\n",
        ),
        (
            "raster cube.obj -o a",
            "--output a: expected the name of a PNG, or of an SVG for --show splits\n",
        ),
        ("verify cube.obj --picture a.jpg", "--picture a.jpg: expected the name of a PNG\n"),
        ("draw cube.obj -o a.svg -o a.svg", "--output a.svg is given twice\n"),
        ("draw cube.obj -o -", "--output - needs --format to say what to write\n"),
        ("draw - - -o a.svg", "- is given twice, but standard input can be read only once\n"),
        (
            "draw cube.obj -o a.dxf",
            "--output: the output format `dxf` is not supported yet; expected one of svg, hpgl, plt, json, png\n",
        ),
        (
            "draw cube.obj -o a.gif",
            "--output: `gif` is no output format; expected one of svg, hpgl, plt, json, png\n",
        ),
        (
            "draw cube.obj -o a",
            "--output: a: no extension to tell the output format by; expected one of svg, hpgl, plt, json, png\n",
        ),
        (
            "draw cube.obj -o a.svg --paper a6 --margin 9cm",
            "a margin of 90 mm leaves nothing of a page of 105 x 148 mm\n",
        ),
        (
            "draw cube.obj -o a.svg --eye 50,40,30 --scale 1:2",
            "a perspective view has no ratio of lengths; expected the scale fit, or a factor: the distance in mm from which the page is to be looked at\n",
        ),
    ] {
        folder.fails(2, arguments, &format!("umriss: {message}"));
    }
    for (flag, message) in [
        (
            "--direction 1,2",
            "invalid value '1,2' for '--direction <X,Y,Z>': expected three numbers, as in 1,-2,0.5",
        ),
        (
            "--eye 1,2,nan",
            "invalid value '1,2,nan' for '--eye <X,Y,Z>': expected three numbers, as in 1,-2,0.5",
        ),
        (
            "--crease 181",
            "invalid value '181' for '--crease <DEG>': expected degrees from 0 to 180",
        ),
        ("--weld 0", "invalid value '0' for '--weld <TOL>': expected a number greater than 0"),
        (
            "--edges contour,rim",
            "invalid value 'rim' for '--edges <LIST>': expected some of contour,boundary,non-manifold,crease,intersection,line,mesh",
        ),
        (
            "--margin 10",
            "invalid value '10' for '--margin <L>': `10` is no length; expected a number with mm, cm or in, as in 10mm",
        ),
        (
            "--hidden dotted",
            "invalid value 'dotted' for '--hidden <HOW>': `dotted` is no choice here; expected none, dashed or solid",
        ),
        ("--precision 10", "invalid value '10' for '--precision <N>': 10 is not in 0..=9"),
        ("--threads 0", "invalid value '0' for '--threads <N>': 0 is not in 1..=1024"),
    ] {
        folder.fails(
            2,
            &format!("draw cube.obj -o a.svg {flag}"),
            &format!("umriss: {message}{ask}"),
        );
    }
}

#[test]
fn cameras_exclude_one_another() {
    let folder = Folder::with_cube();
    for (flags, first, second) in [
        ("--view top --direction 1,0,0", "--view <NAME>", "--direction <X,Y,Z>"),
        ("--direction 1,0,0 --eye 1,0,0", "--direction <X,Y,Z>", "--eye <X,Y,Z>"),
        ("--eye 1,0,0 --camera a.json", "--eye <X,Y,Z>", "--camera <FILE.json>"),
        ("--camera a.json --up 0,1,0", "--camera <FILE.json>", "--up <X,Y,Z>"),
        ("--view top --near 1", "--view <NAME>", "--near <D>"),
    ] {
        let result = folder.command(&format!("draw cube.obj -o a.svg {flags}")).output().unwrap();
        let errors = String::from_utf8(result.stderr).unwrap();
        assert_eq!(result.status.code(), Some(2), "{flags}: {errors}");
        assert!(errors.starts_with("umriss: the argument '"), "{errors}");
        assert!(errors.contains(first) && errors.contains(second), "{errors}");
    }
    assert_eq!(folder.names(), ["cube.obj"]);
}

#[test]
fn bad_models_are_named_with_their_line() {
    let folder = Folder::with_cube();
    folder.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n");
    folder.write("points.obj", "v 0 0 0\nv 1 0 0\n");
    for command in ["draw cube.obj bad.obj -o a.svg -o a.png", "info bad.obj", "verify bad.obj"] {
        let result = folder.command(command).output().unwrap();
        let errors = String::from_utf8(result.stderr).unwrap();
        assert!(errors.starts_with("umriss: bad.obj:4: "), "{command}: {errors}");
        assert_eq!(errors.lines().count(), 1, "{command}");
        assert_eq!(result.status.code(), Some(1), "{command}");
    }
    folder.fails(
        1,
        "draw missing.obj -o a.svg",
        "umriss: missing.obj: cannot be read: No such file or directory (os error 2)\n",
    );
    folder.fails(
        1,
        "draw points.obj -o a.svg",
        "umriss: points.obj: the model is empty: expected at least one face or line\n",
    );
}

#[test]
fn bad_drawings_are_named_with_their_line() {
    let folder = Folder::with_cube();
    folder.write("cut.json", "{\"format\":\"umriss-drawing/1\",\n\"frame\":");
    folder.write("later.json", "{\"format\":\"umriss-drawing/2\"}");
    folder.fails(
        1,
        "draw cut.json -o a.svg",
        "umriss: cut.json:2: column 8: the text ends here, expected a value\n",
    );
    folder.fails(
        1,
        "draw later.json -o a.svg",
        "umriss: later.json: the format is `umriss-drawing/2`; expected `umriss-drawing/1`\n",
    );
}

#[test]
fn bad_camera_files_are_named_with_their_line() {
    let folder = Folder::with_cube();
    folder.write("kind.json", "{\n\"kind\": \"fisheye\"}");
    folder.write("up.json", r#"{"kind":"perspective","eye":[0,0,9],"target":[0,0,0]}"#);
    folder.write("far.json", r#"{"kind":"orthographic","eye":[0,9,9],"target":[0,0,0]}"#);
    folder.fails(
        1,
        "draw cube.obj -o a.svg --camera kind.json",
        "umriss: kind.json:2: column 17: the word 'fisheye' is not known, expected \
         'orthographic' or 'perspective'\n",
    );
    folder.fails(
        1,
        "draw cube.obj -o a.svg --camera up.json",
        "umriss: up.json: up is parallel to the viewing direction: expected another up vector\n",
    );
    folder.fails(
        2,
        "draw cube.obj -o a.svg --camera far.json --near 1",
        "umriss: --near needs a perspective camera, but far.json has none\n",
    );
}

#[test]
fn nothing_is_written_if_one_of_several_outputs_cannot_be_rendered() {
    let folder = Folder::with_cube();
    folder.fails(
        1,
        "draw cube.obj -o a.svg -o a.hpgl --paper a0",
        "umriss: HPGL: the page of 841 x 1189 mm has 47560 plotter units of 0.025 mm along a \
         side; expected at most 32767, that is 819 mm\n",
    );
}

#[test]
fn a_folder_that_is_not_there_is_a_failure() {
    let folder = Folder::with_cube();
    folder.fails(
        1,
        "draw cube.obj -o missing/a.svg",
        "umriss: missing/a.svg: No such file or directory (os error 2)\n",
    );
}

#[test]
fn an_existing_file_survives_a_failure() {
    let folder = Folder::with_cube();
    folder.write("a.svg", "kept");
    folder.fails(
        1,
        "draw missing.obj -o a.svg",
        "umriss: missing.obj: cannot be read: No such file or directory (os error 2)\n",
    );
    assert_eq!(folder.text("a.svg"), "kept");
}

#[test]
fn a_reader_that_leaves_early_is_no_failure() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &super::fixture::wave(60));
    let mut child = Command::new(env!("CARGO_BIN_EXE_umriss"))
        .current_dir(folder.path())
        .args(["draw", "wave.obj", "--edges", "mesh", "-o", "-", "--format", "json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut start = [0; 10];
    // The pipe closes at the end of this statement, long before the end of
    // the drawing.
    child.stdout.take().unwrap().read_exact(&mut start).unwrap();
    let result = child.wait_with_output().unwrap();
    assert_eq!(String::from_utf8(result.stderr).unwrap(), "");
    assert_eq!(result.status.code(), Some(0));
}
