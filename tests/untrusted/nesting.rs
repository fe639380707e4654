//! Brackets in brackets, and nodes below nodes: no reader is as deep as its
//! file.

#[cfg(any(feature = "json", feature = "gltf"))]
use super::{Kind, read};
#[cfg(any(feature = "json", feature = "gltf"))]
use umriss::model::import::Format;

/// A value inside of so many arrays.
#[cfg(any(feature = "json", feature = "gltf"))]
fn nested(depth: usize) -> String {
    format!("{}0{}", "[".repeat(depth), "]".repeat(depth))
}

#[cfg(feature = "json")]
#[test]
fn a_hundred_thousand_brackets_of_json() {
    let deep = nested(100_000);
    let scene = format!("{{\"vertices\":[[0,0,0]],\"faces\":[],\"note\":{deep}}}");
    for text in [&deep, &scene, &scene.replace("\"note\":", "\"vertices\":")] {
        let _ = read(Kind::Model(Format::PolygonScene), text.as_bytes());
        assert!(read(Kind::Drawing, text.as_bytes()).is_err());
    }
    let open = "[".repeat(100_000);
    assert!(read(Kind::Model(Format::PolygonScene), open.as_bytes()).is_err());
    let drawing = format!("{{\"format\":\"umriss-drawing/1\",\"frame\":{deep},\"lines\":[]}}");
    assert!(read(Kind::Drawing, drawing.as_bytes()).is_err());
    let shape = format!("{{\"type\":\"Polygon\",\"coordinates\":{deep}}}");
    assert!(umriss::export::ShapeFormat::GeoJson.read(shape.as_bytes()).is_err());
}

#[cfg(feature = "gltf")]
#[test]
fn a_hundred_thousand_brackets_and_nodes_of_gltf() {
    let deep = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"extras\":{}}}", nested(100_000));
    let _ = read(Kind::Model(Format::Gltf), deep.as_bytes());
    let document = |nodes: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{nodes}]}}"#
        )
    };
    let chain: Vec<_> = (1..10_000).map(|node| format!("{{\"children\":[{node}]}}")).collect();
    let chain = chain.join(",");
    let ends = document(&format!("{chain},{{}}"));
    let error = read(Kind::Model(Format::Gltf), ends.as_bytes());
    assert!(error.is_ok() || !error.unwrap_err().contains("ancestor"));
    let cycle = document(&format!("{chain},{{\"children\":[5]}}"));
    assert!(read(Kind::Model(Format::Gltf), cycle.as_bytes()).is_err());
}
