//! The proof on real and degenerate models: `verify` in every view.
//!
//! The small models of the repository are always checked. The folder that
//! the environment variable `UMRISS_MODELS` names is checked too where it
//! is set: all models up to a size that keeps the test quick, in the six
//! principal views, isometric, with the cameras in its folder `cameras`, and
//! from an eye that lies exactly in the plane of a face. `UMRISS_LONG=1`
//! takes all models, however large.

#![cfg(feature = "json")]
#![allow(clippy::print_stdout)]

mod cameras;

use cameras::{camera_files, read_camera};
use glam::DVec3;
use std::error::Error;
use std::path::{Path, PathBuf};
use umriss::kernel::numbers::Sign;
use umriss::kernel::predicates::{Exact, Eye, Points, Predicates};
use umriss::model::{
    Camera, FeatureOptions, LineClass, Mesh, Scene, SceneOptions, StandardView, View, import,
};
use umriss::run::Run;
use umriss::verify::{
    PaintVerifyOptions, RegionVerifyOptions, VerifyOptions, verify, verify_painting, verify_regions,
};
use umriss::view::PreparedView;
use umriss::visibility::{AppelOptions, appel};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Triangles up to which a model is checked in the quick run.
const QUICK: usize = 3_000;

/// Triangles up to which regions and painting orders of a model are checked in
/// the quick run.
const QUICK_FACES: usize = 400;

const VIEWS: [&str; 7] = ["front", "back", "left", "right", "top", "bottom", "iso"];

#[test]
fn models_of_the_repository_verify_in_all_views() -> Outcome<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models");
    let checked = check_folder(&folder, usize::MAX)?;
    assert!(checked > 0, "no models in {}", folder.display());
    Ok(())
}

#[test]
fn models_of_the_named_folder_verify_in_all_views() -> Outcome<()> {
    let Some(folder) = std::env::var_os("UMRISS_MODELS").map(PathBuf::from) else {
        println!("skipped: UMRISS_MODELS names no folder");
        return Ok(());
    };
    let largest = if is_long() { usize::MAX } else { QUICK };
    let checked = check_folder(&folder, largest)?;
    assert!(checked > 0, "no models in {}", folder.display());
    Ok(())
}

/// Checks the models of a folder; returns how many views of them.
fn check_folder(folder: &Path, largest: usize) -> Outcome<usize> {
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<Outcome<_>>()?;
    files.sort();
    let is_model = |path: &&PathBuf| {
        let extension = path.extension().and_then(|extension| extension.to_str());
        extension.is_some_and(|text| ["obj", "json", "off", "ply", "glb"].contains(&text))
    };
    let mut checked = 0;
    let mut failed = Vec::new();
    for file in files.iter().filter(is_model) {
        let model = import::read_file(file, None)?;
        let scene = Scene::new(model.objects, &SceneOptions::default())?;
        if scene.mesh.triangles().len() > largest {
            println!("skipped: {} is large", file.display());
            continue;
        }
        scene.mesh.sanity_check()?;
        for (name, camera) in cameras(file, &scene.mesh)? {
            let view = camera.view(scene.mesh.bounds())?;
            let run = Run::default();
            let options = FeatureOptions::default();
            let prepared = PreparedView::new::<Exact>(&scene.mesh, &view, &options, &run)?;
            let question = prepared.question(true);
            let answer = appel::<Exact>(&question, &AppelOptions::default(), &run)?;
            let options = VerifyOptions { image_size: 256, ..VerifyOptions::default() };
            let report = verify::<Exact>(&view, &question, &answer, &options, &run)?;
            if !report.is_clean() {
                println!("{} {name}:\n{report}", file.display());
                failed.push(format!("{} {name}", file.display()));
            }
            if scene.mesh.triangles().len() <= QUICK_FACES || is_long() {
                failed.extend(faults_of_regions(&scene.mesh, &view, file, &name)?);
                failed.extend(faults_of_painting(&scene.mesh, &view, file, &name)?);
            }
            checked += 1;
        }
    }
    assert!(failed.is_empty(), "differences: {failed:#?}");
    Ok(checked)
}

/// Whether all models are checked wholly.
fn is_long() -> bool {
    std::env::var_os("UMRISS_LONG").is_some()
}

/// The model and view, if a check of its visible regions finds differences.
fn faults_of_regions(mesh: &Mesh, view: &View, file: &Path, name: &str) -> Outcome<Option<String>> {
    let run = Run::default();
    // Borders of regions are all edges, smooth ones too.
    let options = FeatureOptions::default().with_classes(&LineClass::ALL);
    let prepared = PreparedView::new::<Exact>(mesh, view, &options, &run)?;
    let question = prepared.question(false);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run)?;
    let options = RegionVerifyOptions { image_size: 64, ..RegionVerifyOptions::default() };
    let regions = verify_regions::<Exact>(view, &question, &answer, &options, &run)?;
    if regions.is_clean() {
        return Ok(None);
    }
    println!("{} {name}:\n{regions}", file.display());
    Ok(Some(format!("regions of {} {name}", file.display())))
}

/// The model and view, if a check of its painting orders finds differences.
fn faults_of_painting(
    mesh: &Mesh,
    view: &View,
    file: &Path,
    name: &str,
) -> Outcome<Option<String>> {
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(mesh, view, &FeatureOptions::default(), &run)?;
    let options =
        PaintVerifyOptions { image_size: 64, most_cuts: None, ..PaintVerifyOptions::default() };
    let report = verify_painting::<Exact>(view, &prepared.question(false), &options, &run)?;
    if report.is_clean() && (report.rows.len() == 3 || report.skipped.is_some()) {
        return Ok(None);
    }
    println!("{} {name}:\n{report}", file.display());
    Ok(Some(format!("painting of {} {name}", file.display())))
}

/// All cameras of a model, with their names.
fn cameras(file: &Path, mesh: &Mesh) -> Outcome<Vec<(String, Camera)>> {
    let mut cameras = Vec::new();
    for name in VIEWS {
        let view = StandardView::from_name(name).ok_or("no such view")?;
        cameras.push((name.to_owned(), Camera::Standard(view)));
    }
    for (name, path) in camera_files(file) {
        cameras.push((format!("camera {name}"), read_camera(&path)?));
    }
    if let Some(eye) = eye_in_a_face_plane(mesh) {
        let target = (mesh.bounds().0 + mesh.bounds().1) * 0.5;
        let up = if (target - eye).truncate() == glam::DVec2::ZERO { DVec3::Y } else { DVec3::Z };
        let camera =
            Camera::Perspective { eye, target: Some(target), up, near: None, fov_y_degrees: 45.0 };
        cameras.push(("eye in a face".to_owned(), camera));
    }
    Ok(cameras)
}

/// A point outside of a triangle, exactly in its plane.
fn eye_in_a_face_plane(mesh: &Mesh) -> Option<DVec3> {
    mesh.triangles().iter().find_map(|triangle| {
        let [a, b, c] = triangle.map(|vertex| mesh.vertices()[vertex as usize]);
        [b * 2.0 - a, b + c - a, b * 4.0 - a * 3.0].into_iter().find(|&eye| {
            let points = Points::new(&[a, b, c, eye], Eye::At(DVec3::ZERO), None);
            Predicates::<Exact>::new(&points).plane([0, 1, 2], 3) == Sign::Zero
        })
    })
}
