//! The same bytes for every number of threads.
//!
//! Parallel parts are of fixed sizes and are joined in their order, so what
//! a drawing or its numbers contain cannot depend on who worked it out. The
//! scene is large enough for many parts of every stage.

use super::scenes::{Random, cuboid, orthographic, polygons};
use glam::DVec3;
use umriss::drawing::{Drawing, DrawingOptions, Hidden};
use umriss::export::{SvgOptions, to_json, to_svg};
use umriss::model::{FeatureOptions, LineClass, Mesh, Soup};
use umriss::run::Run;
use umriss::visibility::visible_lines;

#[test]
fn bytes_do_not_depend_on_threads() {
    let mut random = Random(5);
    let boxes: Vec<Soup> = (0..150)
        .map(|_| {
            let low = random.grid_point(12);
            polygons(&cuboid(low, low + DVec3::ONE + random.grid_point(3)), &[])
        })
        .collect();
    let view = orthographic(DVec3::new(-3.0, 5.0, -4.0));
    let written = [1, 2, 8].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let mesh = Mesh::new(boxes.clone(), None).expect("a mesh");
            let options = FeatureOptions::default().with_classes(&LineClass::ALL);
            let lines = visible_lines(&mesh, &view, &options, true, &Run::default());
            let lines = lines.expect("lines");
            let options = DrawingOptions { hidden: Hidden::Dashed, ..DrawingOptions::default() };
            let drawing = Drawing::new(&lines, &options).expect("a drawing");
            let svg = to_svg(&drawing, &SvgOptions::default()).expect("an SVG");
            (to_json(&lines).expect("JSON"), svg)
        })
    });
    assert!(written[0].1.len() > 10_000);
    assert!(written[0] == written[1] && written[0] == written[2]);
}
