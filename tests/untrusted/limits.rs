//! Small files that would be large: the limit of a run holds before they are.

use super::{ALLOCATOR, MOST};
use umriss::model::import::{
    Format, HeightFormat, ImportError, read_bytes_within, read_heights_bytes_within,
};
use umriss::run::{Cancelled, Limits, Run};

fn limited(memory: u64) -> Run<'static> {
    Run::default().with_limits(Limits { crossings: None, memory: Some(memory) })
}

fn assert_stopped<T: std::fmt::Debug>(outcome: Result<T, ImportError>, at_least: u64) {
    match outcome.unwrap_err() {
        ImportError::Cancelled(Cancelled::TooMuchMemory { wanted, .. }) => {
            assert!(at_least <= wanted, "{wanted}");
        }
        other => panic!("{other}"),
    }
    assert!(ALLOCATOR.max_allocated() < MOST, "{} bytes", ALLOCATOR.max_allocated());
}

#[test]
fn an_image_that_is_all_black() {
    // A gigabyte and more of heights from a hundred kilobytes.
    let (width, height) = (16_384_u32, 8_192_u32);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().unwrap();
    let mut stream = writer.stream_writer_with_size(1 << 16).unwrap();
    for _ in 0..height {
        std::io::Write::write_all(&mut stream, &vec![0; width as usize]).unwrap();
    }
    stream.finish().unwrap();
    drop(writer);
    assert!(bytes.len() < 1 << 20, "{}", bytes.len());
    let run = limited(64 << 20);
    let read = read_heights_bytes_within("map.png", &bytes, Some(HeightFormat::Png), &run);
    assert_stopped(read.map(drop), 1 << 31);
}

#[test]
fn a_mesh_that_stands_everywhere() {
    // A triangle and a hundred thousand places for it.
    let count = 100_000;
    let text = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"mesh":0,"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":1}}}}}}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{{"componentType":5126,"count":300,"type":"VEC3"}},
        {{"componentType":5126,"count":{count},"type":"VEC3"}}]}}"#
    );
    let run = limited(8 << 20);
    let read = read_bytes_within("a.gltf", text.as_bytes(), Some(Format::Gltf), &run);
    assert_stopped(read.map(drop), 8 << 20);
}
