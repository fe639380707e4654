//! Real models, where `UMRISS_MODELS` names a folder of them. With
//! `UMRISS_LONG=1` all of them up to 100 000 triangles, else a few small ones.

use crate::scenes::*;
use glam::DVec3;
use std::path::PathBuf;
use std::time::Instant;
use umriss::kernel::predicates::Exact;
use umriss::model::{Camera, Mesh, StandardView, import};
use umriss::raster::{a_buffer, span_buffer};
use umriss::run::Run;

/// Models that are read in every run.
const FEW: [&str; 5] =
    ["two_cubes_interpenetrating", "coplanar_quads", "bad_soup", "cube_row_touching", "teapot"];

fn models() -> Option<Vec<PathBuf>> {
    let Some(folder) = std::env::var_os("UMRISS_MODELS") else {
        println!("skipped: UMRISS_MODELS names no folder of models");
        return None;
    };
    let long = std::env::var_os("UMRISS_LONG").is_some();
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "obj"))
        .filter(|path| long || FEW.iter().any(|name| path.file_stem().unwrap() == *name))
        .collect();
    files.sort();
    Some(files)
}

fn views(bounds: (DVec3, DVec3)) -> Vec<Camera> {
    let centre = (bounds.0 + bounds.1) * 0.5;
    let size = (bounds.1 - bounds.0).max_element();
    vec![
        Camera::Standard(StandardView::from_name("iso").unwrap()),
        Camera::Orthographic { forward: DVec3::Y, target: None, up: DVec3::Z },
        Camera::Perspective {
            eye: centre + DVec3::new(0.7, -1.1, 0.6) * size,
            target: Some(centre),
            up: DVec3::Z,
            near: None,
            fov_y_degrees: 45.0,
        },
    ]
}

#[test]
fn models_have_the_same_picture_by_spans_by_masks_and_by_rays() {
    let Some(models) = models() else {
        return;
    };
    for file in models {
        let mesh = Mesh::new(import::read_file(&file, None).unwrap().objects, None).unwrap();
        if mesh.triangles().len() > 100_000 {
            continue;
        }
        for camera in views(mesh.bounds()) {
            for size in [512, 333] {
                ask(&mesh, &camera, size, |view, question, samples| {
                    let start = Instant::now();
                    let judge = rays(view, question, samples);
                    let mut times = vec![start.elapsed()];
                    for method in [span_buffer::<Exact>, a_buffer::<Exact>] {
                        let start = Instant::now();
                        let buffer = method(view, question, samples, &Run::default()).unwrap();
                        times.push(start.elapsed());
                        assert_eq!(differences(&judge, &buffer), 0, "{}", file.display());
                    }
                    println!(
                        "{:28} {:6} triangles, {size:3} pixels: rays {:5.0?}, spans {:5.0?}, masks {:5.0?}",
                        file.file_stem().unwrap().to_string_lossy(),
                        mesh.triangles().len(),
                        times[0],
                        times[1],
                        times[2],
                    );
                });
            }
        }
    }
}
