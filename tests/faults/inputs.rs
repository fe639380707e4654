//! Inputs that have no end, or can be read only once.

use super::crowds::{folder_with, names};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const SCENE: &str = r#"{"vertices":[[0,0,0],[1,0,0],[0,1,0]],"faces":[{"outer":[0,1,2]}]}"#;

fn program(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_umriss"));
    command.current_dir(folder).args(arguments.split(' '));
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Runs the program with `bytes` coming through a pipe, over and over again as
/// long as it reads if that is wanted.
fn through_a_pipe(folder: &Path, arguments: &str, bytes: &[u8], without_end: bool) -> Output {
    let mut child = program(folder, arguments).stdin(Stdio::piped()).spawn().unwrap();
    let mut pipe = child.stdin.take().unwrap();
    // Whoever has read enough closes the pipe.
    while pipe.write_all(bytes).is_ok() && without_end {}
    drop(pipe);
    child.wait_with_output().unwrap()
}

fn assert_stopped(folder: &Path, arguments: &str, output: &Output, stage: &str) {
    let errors = String::from_utf8_lossy(&output.stderr);
    let limit = "MiB of memory wanted, the limit of --max-memory is 20 MiB; expected ";
    let stage = format!("umriss: {stage}: ");
    assert!(errors.starts_with(&stage) && errors.contains(limit), "{arguments}: {errors}");
    assert_eq!(output.status.code(), Some(1), "{arguments}");
    assert_eq!(errors.lines().count(), 1, "{arguments}: {errors}");
    assert!(!names(folder).iter().any(|name| name.starts_with("out")), "{arguments}");
}

#[test]
fn a_pipe_that_never_ends_reaches_the_limit() {
    let folder = folder_with("scene.json", SCENE.as_bytes());
    let folder = folder.path();
    let line = "v 0 0 0\n".repeat(1 << 13);
    for (arguments, stage) in [
        ("draw - -o out.svg", "reading"),
        ("info -", "reading"),
        ("surface - --input-format csv -o out.svg", "heights"),
        ("clip - --input-format geojson --op union -o out.svg", "reading"),
    ] {
        let arguments = format!("{arguments} --max-memory 20M");
        let output = through_a_pipe(folder, &arguments, line.as_bytes(), true);
        assert_stopped(folder, &arguments, &output, stage);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_without_end_reaches_the_limit() {
    let folder = folder_with("scene.json", SCENE.as_bytes());
    let folder = folder.path();
    for name in ["zero.obj", "zero.json", "zero.stl", "zero.csv", "zero.svg"] {
        std::os::unix::fs::symlink("/dev/zero", folder.join(name)).unwrap();
    }
    for (arguments, stage) in [
        ("draw /dev/zero -o out.svg", "reading"),
        ("draw zero.obj -o out.svg", "reading"),
        ("draw zero.json -o out.svg", "reading"),
        ("verify zero.stl", "reading"),
        ("surface zero.csv -o out.svg", "heights"),
        ("clip zero.svg --op union -o out.svg", "reading"),
    ] {
        let arguments = format!("{arguments} --max-memory 20M");
        let output = program(folder, &arguments).stdin(Stdio::null()).output().unwrap();
        assert_stopped(folder, &arguments, &output, stage);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_pipe_with_a_name_is_read_once() {
    let folder = folder_with("scene.json", SCENE.as_bytes());
    let folder = folder.path();
    std::os::unix::fs::symlink("/dev/stdin", folder.join("pipe.json")).unwrap();
    std::os::unix::fs::symlink("/dev/stdin", folder.join("pipe.obj")).unwrap();
    let draw = |from: &str, bytes: &[u8]| {
        let arguments = format!("draw {from} -o out.json");
        let output = through_a_pipe(folder, &arguments, bytes, false);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let drawing = std::fs::read_to_string(folder.join("out.json")).unwrap();
        drawing.replace("pipe", "scene")
    };
    let expected = draw("scene.json", b"");
    assert_eq!(draw("pipe.json", SCENE.as_bytes()), expected);
    assert_eq!(draw("pipe.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), expected);
    // A drawing too.
    assert_eq!(draw("pipe.json", expected.as_bytes()), expected);
}

#[cfg(target_os = "linux")]
#[test]
fn settings_without_end_are_too_large() {
    let folder = folder_with("scene.json", SCENE.as_bytes());
    for arguments in [
        "draw scene.json --camera /dev/zero -o out.svg",
        "draw scene.json --style /dev/zero -o out.svg",
        "draw scene.json --devices /dev/zero -o out.svg",
        "raster scene.json --size 9x9 --caption a --font /dev/zero -o out.png",
    ] {
        let output = program(folder.path(), arguments).stdin(Stdio::null()).output().unwrap();
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(errors.starts_with("umriss: /dev/zero: "), "{arguments}: {errors}");
        assert!(errors.ends_with("file too large\n"), "{arguments}: {errors}");
        assert_eq!(output.status.code(), Some(1), "{arguments}");
    }
}
