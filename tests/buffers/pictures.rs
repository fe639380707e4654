//! Previews to look at: written to the folder that `UMRISS_PICTURES` names,
//! with a caption where `UMRISS_FONT` names a font. In every run they are
//! looked at by counting.

use crate::scenes::*;
use resvg::tiny_skia::{IntSize, Pixmap};
use umriss::fill::{Canvas, Pattern};
use umriss::kernel::predicates::Exact;
use umriss::model::{Camera, StandardView};
use umriss::raster::{ABufferOptions, Division, Masks, Shading, preview};
use umriss::run::Run;

/// Writes a picture, if pictures are wanted.
fn keep(name: &str, canvas: &Canvas) {
    if let Some(folder) = std::env::var_os("UMRISS_PICTURES") {
        let size = IntSize::from_wh(canvas.width(), canvas.height()).unwrap();
        let picture = Pixmap::from_vec(canvas.bytes(), size).unwrap();
        picture.save_png(std::path::Path::new(&folder).join(name)).unwrap();
    }
}

#[cfg(feature = "text")]
fn caption(canvas: &mut Canvas, text: &str) {
    use glam::DVec2;
    if let Some(file) = std::env::var_os("UMRISS_FONT") {
        let bytes = std::fs::read(file).unwrap();
        let font = umriss::fill::Font::new(&bytes).unwrap();
        font.write(canvas, text, 14.0, DVec2::new(8.0, 20.0), [40, 40, 40, 255]);
    }
}

#[cfg(not(feature = "text"))]
fn caption(_: &mut Canvas, _: &str) {}

/// A scene's preview on white paper.
fn picture(scene: &str, masks: Masks, opacity: f32, pattern: Option<&str>) -> Canvas {
    let triangles = scenes().into_iter().find(|(name, _)| *name == scene).unwrap().1;
    let camera = Camera::Standard(StandardView::from_name("iso").unwrap());
    ask(&mesh(&triangles), &camera, 240, |view, question, pixels| {
        let mut shading = Shading::new(view, question).with_opacity(opacity);
        if let Some(name) = pattern {
            shading = shading.with_pattern_of_objects(Pattern::from_name(name).unwrap(), pixels);
        }
        let paint = |triangle, at| shading.paint(triangle, at);
        let options = ABufferOptions { division: Division::FourByEight, masks };
        let run = Run::default();
        let canvas = preview::<Exact>(view, question, pixels, options, &paint, &run).unwrap();
        let mut canvas = canvas.on([255; 3]);
        caption(&mut canvas, scene);
        canvas
    })
    .unwrap()
}

/// Shades of grey in a picture.
fn shades(canvas: &Canvas) -> usize {
    let mut seen: Vec<u8> = canvas.pixels().iter().map(|pixel| pixel[0]).collect();
    seen.sort_unstable();
    seen.dedup();
    seen.len()
}

#[test]
fn previews_have_soft_edges_and_what_was_wished() {
    let cubes = "cubes through one another";
    let plain = picture(cubes, Masks::Direct, 1.0, None);
    let table = picture(cubes, Masks::Table, 1.0, None);
    let glass = picture(cubes, Masks::Direct, 0.5, None);
    let hatched = picture(cubes, Masks::Direct, 1.0, Some("hatch"));
    let pictures = [("plain", &plain), ("table", &table), ("glass", &glass), ("hatch", &hatched)];
    for (name, canvas) in pictures {
        keep(&format!("{name}.png"), canvas);
        assert!(shades(canvas) > 8, "{name}: edges are mixed of both sides");
    }
    let differ = |a: &Canvas, b: &Canvas| {
        a.pixels().iter().zip(b.pixels()).filter(|(a, b)| a[0].abs_diff(b[0]) > 24).count()
    };
    let all = plain.pixels().len();
    assert!(differ(&plain, &table) < all / 200, "{}", differ(&plain, &table));
    assert!(differ(&plain, &glass) > all / 4);
    assert!(differ(&plain, &hatched) > all / 25);
    keep("soup.png", &picture("a soup", Masks::Direct, 0.7, None));
    keep("fan.png", &picture("a fan", Masks::Direct, 1.0, Some("bricks")));
}
