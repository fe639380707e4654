//! Outputs that cannot be written: clear words, exit code 1, nothing left.

use super::crowds::{folder_with, names};
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

const CUBE: &[u8] = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

const SQUARE: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]}"#;

/// Every command that writes, with each of its formats; the output comes last.
const WRITERS: [(&str, &str); 14] = [
    ("draw cube.obj -o", "svg"),
    ("draw cube.obj -o", "json"),
    ("draw cube.obj -o", "hpgl"),
    ("draw cube.obj -o", "png"),
    ("draw cube.obj --method painter --fill flat -o", "svg"),
    ("draw drawing.json -o", "svg"),
    ("surface sin(x) --nx 9 --nz 9 -o", "svg"),
    ("surface sin(x) --nx 9 --nz 9 -o", "json"),
    ("surface sin(x) --nx 9 --nz 9 -o", "hpgl"),
    ("surface sin(x) --nx 9 --nz 9 -o", "png"),
    ("raster cube.obj --size 9x9 -o", "png"),
    ("clip a.geojson a.geojson --op union -o", "geojson"),
    ("clip a.geojson a.geojson --op union -o", "svg"),
    ("verify cube.obj --picture", "png"),
];

fn folder() -> tempfile::TempDir {
    let folder = folder_with("cube.obj", CUBE);
    std::fs::write(folder.path().join("a.geojson"), SQUARE).unwrap();
    run(folder.path(), "draw cube.obj -o", "drawing.json");
    folder
}

/// Exit code and errors of the program.
fn run(folder: &Path, arguments: &str, output: &str) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_umriss"));
    command.current_dir(folder).args(arguments.split(' ')).arg(output);
    let result = command.stdin(Stdio::null()).output().unwrap();
    (result.status.code(), String::from_utf8(result.stderr).unwrap())
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure_in_every_format() {
    let folder = folder();
    let before = names(folder.path());
    for (command, extension) in WRITERS {
        // A link gives the device that is always full an extension.
        let full = folder.path().join(format!("full.{extension}"));
        std::os::unix::fs::symlink("/dev/full", &full).unwrap();
        let (code, errors) = run(folder.path(), command, &format!("full.{extension}"));
        std::fs::remove_file(&full).unwrap();
        let expected = format!("umriss: full.{extension}: No space left on device (os error 28)\n");
        assert_eq!((code, &*errors), (Some(1), &*expected), "{command}");
        assert_eq!(names(folder.path()), before, "{command}");
    }
    for command in ["draw cube.obj --format svg -o", "clip a.geojson --op union --format svg -o"] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut program = Command::new(env!("CARGO_BIN_EXE_umriss"));
        program.current_dir(folder.path()).args(command.split(' ')).arg("-").stdout(full);
        let result = program.output().unwrap();
        let errors = String::from_utf8(result.stderr).unwrap();
        let expected =
            "umriss: <stdout>: cannot be written: No space left on device (os error 28)\n";
        assert_eq!((result.status.code(), &*errors), (Some(1), expected), "{command}");
    }
}

#[test]
fn folders_that_are_missing_or_in_the_way_are_failures_in_every_format() {
    let folder = folder();
    let before = names(folder.path());
    for (command, extension) in WRITERS {
        let taken = folder.path().join(format!("taken.{extension}"));
        std::fs::create_dir(&taken).unwrap();
        for output in [format!("missing/a.{extension}"), format!("taken.{extension}")] {
            let (code, errors) = run(folder.path(), command, &output);
            assert_eq!(code, Some(1), "{command} {output}");
            assert!(errors.starts_with(&format!("umriss: {output}: ")), "{errors}");
            assert_eq!(errors.lines().count(), 1, "{errors}");
        }
        std::fs::remove_dir(&taken).unwrap();
        assert_eq!(names(folder.path()), before, "{command}");
    }
    // A file where a folder is expected.
    let (code, errors) = run(folder.path(), "draw cube.obj -o", "cube.obj/a.svg");
    assert_eq!(code, Some(1));
    assert!(errors.starts_with("umriss: cube.obj/a.svg: "), "{errors}");
}

/// Permissions stop nobody who may do everything: then this says nothing.
#[cfg(unix)]
#[test]
fn a_folder_that_nobody_may_write_to_is_a_failure_in_every_format() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let locked = folder.path().join("locked");
    std::fs::create_dir(&locked).unwrap();
    let allow = |mode| {
        std::fs::set_permissions(&locked, std::fs::Permissions::from_mode(mode)).unwrap();
    };
    allow(0o555);
    let all_is_allowed = std::fs::write(locked.join("probe"), "").is_ok();
    if !all_is_allowed {
        for (command, extension) in WRITERS {
            let output = format!("locked/a.{extension}");
            let (code, errors) = run(folder.path(), command, &output);
            let expected = format!("umriss: {output}: Permission denied (os error 13)\n");
            assert_eq!((code, errors), (Some(1), expected), "{command}");
        }
        assert!(names(&locked).is_empty());
    }
    allow(0o755);
}

#[test]
fn a_read_only_output_stays_as_it_is_in_every_format() {
    let folder = folder();
    for (command, extension) in WRITERS {
        let output = format!("kept.{extension}");
        let path = folder.path().join(&output);
        std::fs::write(&path, "kept").unwrap();
        let mut permissions = path.metadata().unwrap().permissions();
        permissions.set_readonly(true);
        std::fs::set_permissions(&path, permissions.clone()).unwrap();
        let before = names(folder.path());
        let (code, errors) = run(folder.path(), command, &output);
        let expected = format!("umriss: {output}: permission denied\n");
        assert_eq!((code, errors), (Some(1), expected), "{command}");
        assert_eq!(std::fs::read(&path).unwrap(), b"kept", "{command}");
        assert_eq!(names(folder.path()), before, "{command}");
        #[cfg(unix)]
        std::os::unix::fs::PermissionsExt::set_mode(&mut permissions, 0o644);
        std::fs::set_permissions(&path, permissions).unwrap();
        std::fs::remove_file(&path).unwrap();
    }
}

/// Links of both kinds, and other ways of writing a path.
#[cfg(unix)]
#[test]
fn an_output_that_is_read_is_refused() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    std::fs::copy(path("cube.obj"), path("cube.svg")).unwrap();
    std::fs::write(path("eye.json"), r#"{"kind":"perspective","eye":[4,3,2],"target":[0,0,0]}"#)
        .unwrap();
    std::fs::write(path("table.csv"), "1,2\n3,5\n").unwrap();
    std::fs::write(path("style.toml"), "").unwrap();
    for (input, links) in [
        ("cube.obj", ["cube-soft.svg", "cube-hard.svg", "cube-soft.png", "cube-hard.png"]),
        ("a.geojson", ["a-soft.svg", "a-hard.svg", "a-soft.geojson", "a-hard.geojson"]),
        ("table.csv", ["table-soft.svg", "table-hard.svg", "table-soft.png", "table-hard.png"]),
        ("style.toml", ["style-soft.svg", "style-hard.svg", "style-soft.png", "style-hard.png"]),
    ] {
        for link in links {
            match link.contains("soft") {
                true => std::os::unix::fs::symlink(input, path(link)).unwrap(),
                false => std::fs::hard_link(path(input), path(link)).unwrap(),
            }
        }
    }
    let contents = || {
        let read = |name: &std::ffi::OsString| std::fs::read(folder.path().join(name)).unwrap();
        let names = names(folder.path());
        names.iter().map(|name| (name.clone(), read(&name.into()))).collect::<Vec<_>>()
    };
    let before = contents();
    for (command, output, input) in [
        ("draw drawing.json -o", "drawing.json", "drawing.json"),
        ("draw drawing.json -o", "./drawing.json", "drawing.json"),
        ("draw cube.obj drawing.json -o", "drawing.json", "drawing.json"),
        ("draw cube.obj -o", "cube-soft.svg", "cube.obj"),
        ("draw ./cube.obj -o b.svg -o", "cube-hard.svg", "./cube.obj"),
        ("draw --input-format obj cube.svg -o", "cube.svg", "cube.svg"),
        ("draw cube.obj --camera eye.json -o", "eye.json", "eye.json"),
        ("draw cube.obj --style style.toml -o", "style-soft.svg", "style.toml"),
        ("surface table.csv -o", "table-hard.svg", "table.csv"),
        ("surface table.csv --camera eye.json -o", "eye.json", "eye.json"),
        ("raster cube.obj -o", "cube-soft.png", "cube.obj"),
        ("raster cube.obj -o", "cube-hard.png", "cube.obj"),
        ("clip a.geojson --op union -o", "a.geojson", "a.geojson"),
        ("clip a.geojson --op union -o", "a-hard.svg", "a.geojson"),
        ("clip a.geojson --op union -o", "a-soft.geojson", "a.geojson"),
        ("verify cube.obj --picture", "cube-hard.png", "cube.obj"),
    ] {
        let flag = if command.ends_with("-o") { "--output" } else { "--picture" };
        let (code, errors) = run(folder.path(), command, output);
        let expected = format!(
            "umriss: {flag} {output} would replace {input}, which is read: expected another file\n"
        );
        assert_eq!((code, errors), (Some(2), expected), "{command}");
        assert_eq!(contents(), before, "{command}");
    }
    // Twice the same, by a link or another way of writing it.
    std::fs::write(path("b.svg"), "").unwrap();
    std::os::unix::fs::symlink("b.svg", path("c.svg")).unwrap();
    for (first, second) in [("b.svg", "c.svg"), ("new.svg", "./new.svg")] {
        let (code, errors) = run(folder.path(), &format!("draw cube.obj -o {first} -o"), second);
        let expected = format!(
            "umriss: --output {second} is the same file as --output {first}: expected another one\n"
        );
        assert_eq!((code, errors), (Some(2), expected));
    }
    // What is beside an input is no input.
    let (code, errors) = run(folder.path(), "draw cube.obj -o", "eye.json");
    assert_eq!((code, &*errors), (Some(0), ""));
}

#[test]
fn a_reader_that_reads_nothing_is_no_failure() {
    let folder = folder();
    for command in [
        "draw cube.obj --format svg -o -",
        "draw cube.obj --format json -o -",
        "draw cube.obj --format hpgl -o -",
        "draw cube.obj --format png -o -",
        "surface sin(x) --format svg -o -",
        "raster cube.obj -o -",
        "clip a.geojson --op union --format svg -o -",
        "info cube.obj",
        "info cube.obj --json",
        "verify cube.obj",
        "draw --help",
    ] {
        let mut program = Command::new(env!("CARGO_BIN_EXE_umriss"));
        program.current_dir(folder.path()).args(command.split(' '));
        let mut child = program.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let mut errors = String::new();
        child.stderr.take().unwrap().read_to_string(&mut errors).unwrap();
        let code = child.wait().unwrap().code();
        assert_eq!((code, &*errors), (Some(0), ""), "{command}");
    }
}
