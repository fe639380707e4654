//! Every image-space method against every other, at every sample.
//!
//! The c-buffer joins in where triangles have an order from front to back.
//! It gives a sample on a common border to the first of several that are
//! equally near, so that it may name another triangle there, if an exact
//! sign says that they are.
//!
//! The models of the repository are always compared. The folder that the
//! environment variable `UMRISS_MODELS` names is compared too where it is
//! set: in the six principal views, isometric, and with the cameras in its
//! folder `cameras`; models up to a size that keeps the test quick and small
//! images, or with `UMRISS_LONG=1` models up to 100 000 triangles and images
//! of 512 and of an odd number of pixels.

#![cfg(feature = "json")]
#![allow(clippy::print_stdout)]

mod cameras;

use cameras::{camera_files, read_camera};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;
use umriss::kernel::predicates::{Exact, Predicates};
use umriss::model::{Camera, FeatureOptions, Mesh, Scene, SceneOptions, StandardView, import};
use umriss::raster::samples::Sampled;
use umriss::raster::{ItemBuffer, Samples, c_buffer, front_to_back, methods};
use umriss::run::Run;
use umriss::view::PreparedView;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// How much of a folder is compared.
struct Extent {
    triangles: usize,
    sizes: &'static [u32],
}

const QUICK: Extent = Extent { triangles: 3_000, sizes: &[64, 37] };
const LONG: Extent = Extent { triangles: 100_000, sizes: &[512, 333] };

const VIEWS: [&str; 7] = ["front", "back", "left", "right", "top", "bottom", "iso"];

#[test]
fn methods_agree_on_the_models_of_the_repository() -> Outcome<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models");
    compare_folder(&folder, &Extent { triangles: usize::MAX, ..QUICK })
}

#[test]
fn methods_agree_on_the_models_of_the_named_folder() -> Outcome<()> {
    let Some(folder) = std::env::var_os("UMRISS_MODELS").map(PathBuf::from) else {
        println!("skipped: UMRISS_MODELS names no folder");
        return Ok(());
    };
    let long = std::env::var_os("UMRISS_LONG").is_some();
    compare_folder(&folder, if long { &LONG } else { &QUICK })
}

fn compare_folder(folder: &Path, extent: &Extent) -> Outcome<()> {
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<Outcome<_>>()?;
    files.sort();
    let is_model = |path: &&PathBuf| {
        let extension = path.extension().and_then(|extension| extension.to_str());
        extension.is_some_and(|text| ["obj", "json", "off", "ply", "glb"].contains(&text))
    };
    let mut sums = Sums::default();
    for file in files.iter().filter(is_model) {
        let model = import::read_file(file, None)?;
        let mesh = Scene::new(model.objects, &SceneOptions::default())?.mesh;
        if mesh.triangles().len() > extent.triangles {
            println!("skipped: {} is large", file.display());
            continue;
        }
        for (name, camera) in cameras(file)? {
            for &size in extent.sizes {
                let what = format!("{} {name} {size}", file.display());
                compare(&mesh, &camera, size, &what, &mut sums)?;
            }
        }
    }
    println!("{} images of {} samples, {} of them hits", sums.images, sums.samples, sums.hits);
    println!("{} of them have an order from front to back", sums.ordered);
    assert!(sums.images > 0, "no models in {}", folder.display());
    assert!(sums.differences.is_empty(), "{:#?}", sums.differences);
    Ok(())
}

#[derive(Default)]
struct Sums {
    images: usize,
    ordered: usize,
    samples: u64,
    hits: u64,
    differences: Vec<String>,
}

fn compare(mesh: &Mesh, camera: &Camera, size: u32, what: &str, sums: &mut Sums) -> Outcome<()> {
    let run = Run::default();
    let view = camera.view(mesh.bounds())?;
    let options = FeatureOptions::default().with_classes(&[]);
    let prepared = PreparedView::new::<Exact>(mesh, &view, &options, &run)?;
    let question = prepared.question(false);
    let count = mesh.vertices().len() as u32;
    let Some(samples) = Samples::around(&view.frame, question.coordinates, count, size) else {
        println!("skipped: {what} shows nothing");
        return Ok(());
    };
    let (mut images, mut times) = (Vec::new(), String::new());
    for (name, method) in methods::<Exact>() {
        let start = Instant::now();
        images.push((name, method(&view, &question, &samples, &run)?));
        times.push_str(&format!(" {name} {:.0?},", start.elapsed()));
    }
    let pixels =
        || (0..samples.height()).flat_map(|row| (0..samples.width()).map(move |c| (c, row)));
    for (i, (one, first)) in images.iter().enumerate() {
        for (other, second) in &images[..i] {
            let differ = pixels().filter(|&(column, row)| {
                first.item(column, row) != second.item(column, row)
                    || first.depth(column, row).to_bits() != second.depth(column, row).to_bits()
            });
            let differ = differ.count();
            if differ > 0 {
                let difference = format!("{what}: {one} and {other} at {differ} samples");
                println!("{difference}");
                sums.differences.push(difference);
            }
        }
    }
    let start = Instant::now();
    if let Ok(order) = front_to_back::<Exact>(&question, &run) {
        let image = c_buffer::<Exact>(&view, &question, &samples, &order, &run)?;
        let sampled = Sampled::new(&view, &question, &samples);
        let differ = pixels().filter(|&at| !is_as_near(&sampled, [&images[0].1, &image], at));
        let differ = differ.count();
        if differ > 0 {
            sums.differences.push(format!("{what}: the c-buffer at {differ} samples"));
        }
        sums.ordered += 1;
    }
    times.push_str(&format!(" c-buffer {:.0?}", start.elapsed()));
    println!("{what}, {} triangles:{times}", mesh.triangles().len());
    sums.images += 1;
    sums.samples += pixels().count() as u64;
    sums.hits += pixels().filter(|&(c, row)| images[0].1.item(c, row).is_some()).count() as u64;
    Ok(())
}

/// Whether two images have at a sample the same triangle, or two that are
/// equally near.
fn is_as_near(sampled: &Sampled, images: [&ItemBuffer; 2], (column, row): (u32, u32)) -> bool {
    match images.map(|image| image.item(column, row)) {
        [Some(first), Some(second)] if first != second => {
            let predicates = Predicates::<Exact>::new(sampled.points());
            let [first, second] = [first, second].map(|triangle| sampled.triangle(triangle));
            let sample = sampled.vertex([column, row]);
            predicates.nearer(sample, first, second).is_zero()
        }
        [first, second] => first == second,
    }
}

/// All cameras of a model, with their names.
fn cameras(file: &Path) -> Outcome<Vec<(String, Camera)>> {
    let mut cameras = Vec::new();
    for name in VIEWS {
        let view = StandardView::from_name(name).ok_or("no such view")?;
        cameras.push((name.to_owned(), Camera::Standard(view)));
    }
    for (name, path) in camera_files(file) {
        cameras.push((format!("camera {name}"), read_camera(&path)?));
    }
    Ok(cameras)
}
