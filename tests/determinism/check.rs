//! Draws all models by every number of threads and compares with the tables.

use super::Outcome;
use super::cameras::{camera_files, read_camera};
use super::drawings::{Lines, drawing, models, scene, view_of};
use super::table::{Row, Table, hash};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::path::{Path, PathBuf};
use umriss::model::{Scene, View};

pub(crate) const THREADS: [usize; 3] = [1, 2, 8];

const VIEWS: [&str; 5] = ["front", "top", "iso", "generic", "eye"];

/// Triangles up to which every edge of a model is drawn, and hidden parts.
const SMALL: usize = 3_000;

/// Triangles up to which builds for tests draw a model of the named folder.
const LARGE: usize = 20_000;

fn pools() -> Outcome<Vec<(usize, ThreadPool)>> {
    let pool = |threads| Ok((threads, ThreadPoolBuilder::new().num_threads(threads).build()?));
    THREADS.into_iter().map(pool).collect()
}

/// Draws a model in some views by one number of threads.
fn rows(name: &str, scene: &Scene, views: &[(&'static str, View)]) -> Outcome<Vec<Row>> {
    let small = scene.mesh.triangles().len() <= SMALL;
    let mut rows = Vec::new();
    for (view, camera) in views {
        for lines in [Lines::Visible, Lines::Every] {
            if lines == Lines::Visible || small {
                let (pieces, bytes) = drawing(scene, camera, lines)?;
                let title = format!("{name} {view:<8} {:<8}", lines.name());
                rows.push(Row::of(title, pieces, &bytes)?);
            }
        }
    }
    Ok(rows)
}

/// Draws a model by every number of threads and tells the table.
fn add_model(
    table: &mut Table,
    pools: &[(usize, ThreadPool)],
    name: &str,
    scene: &Scene,
    views: &[(&'static str, View)],
) -> Outcome<()> {
    for (threads, pool) in pools {
        // Errors of other threads must be errors that can be sent.
        let rows = pool.install(|| rows(name, scene, views).map_err(|error| error.to_string()))?;
        table.add(*threads, rows);
    }
    Ok(())
}

/// A file of this test.
fn own_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/determinism").join(name)
}

fn name_of(file: &Path) -> Outcome<&str> {
    Ok(file.file_name().and_then(|name| name.to_str()).ok_or("expected a name")?)
}

/// The models of the repository, against `hashes.txt`.
pub(crate) fn repository() -> Outcome<()> {
    let pools = pools()?;
    let mut table = Table::read(&own_file("hashes.txt"))?;
    for file in models(&Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models"))? {
        let scene = scene(&file)?;
        let view = |name| Ok((name, view_of(name, &scene.mesh)?));
        let views: Vec<_> = VIEWS.into_iter().map(view).collect::<Outcome<_>>()?;
        add_model(&mut table, &pools, &format!("{:<30}", name_of(&file)?), &scene, &views)?;
    }
    table.expect_all_known();
    table.expect_as_kept()
}

/// The models of the folder that `UMRISS_MODELS` names, against
/// `named_folder.txt`.
pub(crate) fn named_folder() -> Outcome<()> {
    let Some(folder) = std::env::var_os("UMRISS_MODELS").map(PathBuf::from) else {
        println!("skipped: UMRISS_MODELS names no folder");
        return Ok(());
    };
    let pools = pools()?;
    let mut table = Table::read(&own_file("named_folder.txt"))?;
    for file in models(&folder)? {
        let scene = scene(&file)?;
        if cfg!(debug_assertions) && scene.mesh.triangles().len() > LARGE {
            println!("skipped: {} is large for a build for tests", file.display());
            continue;
        }
        let camera = |(name, path): (&'static str, PathBuf)| {
            Ok((name, read_camera(&path)?.view(scene.mesh.bounds())?))
        };
        let views: Vec<_> = camera_files(&file).into_iter().map(camera).collect::<Outcome<_>>()?;
        let name = format!("{:<30} {:016x}", name_of(&file)?, hash(&std::fs::read(&file)?));
        add_model(&mut table, &pools, &name, &scene, &views)?;
    }
    table.expect_as_kept()
}
