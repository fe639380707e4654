//! The bytes that are hashed are those that the program writes.

use super::Outcome;
use super::check::THREADS;
use super::drawings::{GENERIC, Lines, drawing, eye_of, scene, view_of};
use std::path::Path;
use std::process::Command;
use umriss::model::{Mesh, Scene};

/// The flags that ask for a view.
fn camera(view: &str, mesh: &Mesh) -> [String; 2] {
    let text = |v: glam::DVec3| format!("{},{},{}", v.x, v.y, v.z);
    match view {
        "generic" => ["--direction".to_owned(), text(GENERIC)],
        "eye" => ["--eye".to_owned(), text(eye_of(mesh))],
        name => ["--view".to_owned(), name.to_owned()],
    }
}

/// What the program draws of a model.
fn drawn(
    file: &Path,
    scene: &Scene,
    (view, lines, threads): (&str, Lines, usize),
) -> Outcome<Vec<u8>> {
    let folder = tempfile::tempdir()?;
    let output = folder.path().join("drawing.json");
    let mut command = Command::new(env!("CARGO_BIN_EXE_umriss"));
    command.arg("draw").arg(file).args(camera(view, &scene.mesh));
    command.args(["--threads", &threads.to_string(), "-o"]).arg(&output);
    if lines == Lines::Every {
        let classes = "contour,boundary,non-manifold,crease,intersection,line,mesh";
        command.args(["--hidden", "solid", "--edges", classes]);
    }
    let said = command.output()?;
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    Ok(std::fs::read(&output)?)
}

#[test]
fn the_program_writes_what_is_hashed() -> Outcome<()> {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models");
    for (model, view, lines) in [
        ("two_cubes_interpenetrating.obj", "iso", Lines::Every),
        ("plate_hole.json", "generic", Lines::Visible),
        ("cube_hole.stl", "eye", Lines::Every),
        ("spot.obj", "front", Lines::Visible),
    ] {
        let file = models.join(model);
        let scene = scene(&file)?;
        let (_, expected) = drawing(&scene, &view_of(view, &scene.mesh)?, lines)?;
        for threads in THREADS {
            let bytes = drawn(&file, &scene, (view, lines, threads))?;
            assert!(bytes == expected, "{model} {view} {threads} threads");
        }
    }
    Ok(())
}
