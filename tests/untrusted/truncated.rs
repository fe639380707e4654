//! One small file of every format, cut off at every byte.

use super::{Kind, read};
use umriss::model::import::{Format, HeightFormat, read_bytes};

/// A grey height map of 3 x 2 pixels, 16 bits each.
fn height_map() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 3, 2);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]).unwrap();
    writer.finish().unwrap();
    bytes
}

/// Whether something in a file that can be read is passed over.
fn is_told_of(format: Format, bytes: &[u8]) -> bool {
    read_bytes("file", bytes, Some(format)).is_ok_and(|imported| !imported.warnings.is_empty())
}

#[test]
fn every_beginning_of_a_file_is_read_or_refused() {
    let corpus = |name: &str| std::fs::read(format!("fuzz/corpus/{name}")).unwrap();
    let table = b"# a table\n1,-2.5,nan\n4,5,6e2\n7,8,9\n".to_vec();
    let grid = b"ncols 3\nnrows 2\nxllcorner 1\nyllcenter -2.5\ncellsize 10\nNODATA_value -1\n\
        1 2 3\n4 -1 6\n";
    let seeds = [
        (Kind::Model(Format::Obj), corpus("obj/square.obj")),
        (Kind::Model(Format::Stl), corpus("stl/text.stl")),
        (Kind::Model(Format::Stl), corpus("stl/binary.stl")),
        (Kind::Model(Format::Ply), corpus("ply/text.ply")),
        (Kind::Model(Format::Ply), corpus("ply/binary_little_endian.ply")),
        (Kind::Model(Format::Ply), corpus("ply/binary_big_endian.ply")),
        (Kind::Model(Format::Off), corpus("off/colours.off")),
        (Kind::Model(Format::Gltf), corpus("gltf/data-uri.gltf")),
        (Kind::Model(Format::Gltf), corpus("gltf/lines.glb")),
        (Kind::Model(Format::PolygonScene), corpus("json/holes.json")),
        (Kind::Drawing, corpus("restyle/cube.json")),
        (Kind::Heights(HeightFormat::Csv), table),
        (Kind::Heights(HeightFormat::Esri), grid.to_vec()),
        (Kind::Heights(HeightFormat::Png), height_map()),
    ];
    for (kind, seed) in seeds {
        assert_eq!(read(kind, &seed), Ok(()), "{kind:?} is sound as a whole");
        let is_noticed = |bytes: &[u8]| match kind {
            Kind::Model(format) => read(kind, bytes).is_err() || is_told_of(format, bytes),
            _ => read(kind, bytes).is_err(),
        };
        let noticed = (0..seed.len()).filter(|&end| is_noticed(&seed[..end])).count();
        // A text may lose its last line and still be one; most of it is needed.
        assert!(seed.len() < 2 * noticed, "{kind:?}: {noticed} of {} are noticed", seed.len());
    }
}
