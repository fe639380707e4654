//! Whole outputs against files that are kept. With UMRISS_BLESS set, the
//! files are written anew instead; look at the difference before keeping it.

use crate::fixture::cube;
use std::path::PathBuf;
use umriss::drawing::{Drawing, DrawingOptions, Hidden, LayerBy, Paper};
use umriss::export::{SvgOptions, to_hpgl, to_json, to_svg};

fn compare(name: &str, bytes: &[u8]) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/export/golden").join(name);
    if std::env::var_os("UMRISS_BLESS").is_some() {
        std::fs::write(&path, bytes).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap();
    assert_eq!(String::from_utf8_lossy(bytes), kept, "{name}");
}

fn draw(layer_by: LayerBy) -> Drawing {
    let options = DrawingOptions {
        paper: Paper::Tight,
        hidden: Hidden::Dashed,
        layer_by,
        ..DrawingOptions::default()
    };
    Drawing::new(&cube(), &options).unwrap()
}

#[test]
fn svg_by_visibility() {
    let options = SvgOptions {
        command: Some("umriss draw a&b.obj -o <c>.svg".into()),
        ..SvgOptions::default()
    };
    compare("visibility.svg", to_svg(&draw(LayerBy::Visibility), &options).unwrap().as_bytes());
}

#[test]
fn svg_by_object() {
    let options = SvgOptions { precision: 1, ..SvgOptions::default() };
    compare("object.svg", to_svg(&draw(LayerBy::Object), &options).unwrap().as_bytes());
}

#[test]
fn hpgl_by_class() {
    compare("class.hpgl", to_hpgl(&draw(LayerBy::Class)).unwrap().as_bytes());
}

#[test]
fn json() {
    compare("cube.json", &to_json(&cube()).unwrap());
}
