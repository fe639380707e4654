//! Counts that promise what the file does not have: they are believed as far
//! as there are bytes.

use super::{Kind, read};
use umriss::model::import::{Format, HeightFormat};

fn refused(kind: Kind, bytes: &[u8], expected: &str) {
    let error = read(kind, bytes).expect_err(expected);
    assert!(error.contains(expected), "{error}\nexpected to say: {expected}");
}

#[test]
fn facets_of_an_stl() {
    let mut bytes = vec![0; 80];
    bytes.extend(u32::MAX.to_le_bytes());
    bytes.extend([0; 50]);
    refused(Kind::Model(Format::Stl), &bytes, "expected 214748364834 bytes for 4294967295 facets");
}

#[test]
fn elements_and_lists_of_a_ply() {
    let lies = [
        (
            "ascii",
            "element vertex 1152921504606846976\nproperty float x\nproperty float y\nproperty float z",
            &b""[..],
        ),
        (
            "binary_little_endian",
            "element vertex 1152921504606846976\nproperty float x\nproperty float y\nproperty float z",
            &[0; 24],
        ),
        (
            "binary_big_endian",
            "element vertex 999999999999999999\nproperty double x\nproperty double y\nproperty double z",
            &[0; 24],
        ),
        // Rows without bytes, and lists that are longer than the file.
        (
            "binary_little_endian",
            "element vertex 0\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uint int vertex_indices",
            &[255; 8],
        ),
        (
            "ascii",
            "element vertex 0\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uint int vertex_indices",
            b"4294967295 0 0 0\n",
        ),
        (
            "binary_big_endian",
            "element other 999999999999999999\nproperty list uchar int rows\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z",
            &[0; 64],
        ),
    ];
    for (encoding, header, payload) in lies {
        let mut bytes = format!("ply\nformat {encoding} 1.0\n{header}\nend_header\n").into_bytes();
        bytes.extend(payload);
        refused(Kind::Model(Format::Ply), &bytes, "expected");
    }
    let empty = b"ply\nformat ascii 1.0\nelement nothing 999999999999999999\nelement vertex 0\n\
        property float x\nproperty float y\nproperty float z\nend_header\n";
    assert_eq!(read(Kind::Model(Format::Ply), empty), Ok(()), "rows of nothing are nothing");
}

#[test]
fn counts_and_corners_of_an_off() {
    for text in [
        "OFF\n4000000000 4000000000 0\n0 0 0\n",
        "OFF\n999999999999999999 0 0\n",
        "OFF\n3 999999999999999999 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n",
    ] {
        refused(Kind::Model(Format::Off), text.as_bytes(), "expected");
    }
}

/// A document of one triangle, with some of its text replaced.
fn gltf(from: &str, to: &str) -> Vec<u8> {
    let text = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
        "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"byteOffset":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36,"byteStride":12}],
        "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;
    assert!(text.contains(from), "{from}");
    text.replace(from, to).into_bytes()
}

#[test]
fn accessors_views_and_buffers_of_a_gltf() {
    assert_eq!(read(Kind::Model(Format::Gltf), &gltf("\"count\":3", "\"count\":3")), Ok(()));
    for (from, to) in [
        ("\"count\":3", "\"count\":4000000000"),
        ("\"count\":3", "\"count\":18446744073709551615"),
        (
            "\"bufferView\":0,\"byteOffset\":0,\"componentType\":5126,\"count\":3",
            "\"componentType\":5126,\"count\":4000000000",
        ),
        ("\"byteOffset\":0", "\"byteOffset\":18446744073709551615"),
        ("\"byteLength\":36,\"byteStride\"", "\"byteLength\":4000000000000,\"byteStride\""),
        ("\"byteStride\":12", "\"byteStride\":252"),
        ("\"buffers\":[{\"byteLength\":36", "\"buffers\":[{\"byteLength\":4000000000000"),
        (
            "\"type\":\"VEC3\"",
            "\"type\":\"VEC3\",\"sparse\":{\"count\":4000000000,\"indices\":{\"bufferView\":0,\"componentType\":5125},\"values\":{\"bufferView\":0}}",
        ),
    ] {
        refused(Kind::Model(Format::Gltf), &gltf(from, to), "expected");
    }
}

#[test]
fn lengths_of_a_glb() {
    let sound = std::fs::read("fuzz/corpus/gltf/lines.glb").unwrap();
    let json = u32::from_le_bytes(sound[12..16].try_into().unwrap()) as usize;
    // That of the whole changes nothing: it is told, and what is there is read.
    let mut longer = sound.clone();
    longer[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    let imported = umriss::model::import::read_bytes("file", &longer, None).unwrap();
    let told = format!("the file has {} bytes, though its header says 4294967295", sound.len());
    assert_eq!(imported.warnings, [told]);
    // The first chunk, the second one.
    for (place, value) in [
        (12, u32::MAX),
        (12, u32::MAX - 3),
        (20 + json, u32::MAX),
        (20 + json, u32::MAX - 3),
        (20 + json, 4),
    ] {
        let mut bytes = sound.clone();
        bytes[place..place + 4].copy_from_slice(&value.to_le_bytes());
        refused(Kind::Model(Format::Gltf), &bytes, "expected");
    }
}

#[test]
fn meshes_that_many_nodes_share() {
    // Half a kilobyte for each node, a copy of the mesh for each: within
    // bounds as long as the mesh is small.
    let nodes: Vec<_> = (0..2000).map(|i: u32| i.to_string()).collect();
    let list = format!("\"nodes\":[{}]}}],", nodes.join(","));
    let many = vec!["{\"mesh\":0}"; 2000].join(",");
    let bytes = gltf("\"nodes\":[0]}],", &list);
    let text = String::from_utf8(bytes).unwrap();
    let text = text.replace("\"nodes\":[{\"mesh\":0}]", &format!("\"nodes\":[{many}]"));
    assert_eq!(read(Kind::Model(Format::Gltf), text.as_bytes()), Ok(()));
}

#[test]
fn sizes_of_grids_of_heights() {
    for text in [
        "ncols 1000000\nnrows 1000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n",
        "ncols 999999999999999999\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n",
        "ncols 2\nnrows 500000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n",
    ] {
        refused(Kind::Heights(HeightFormat::Esri), text.as_bytes(), "expected");
    }
}

#[test]
fn pixels_of_a_height_map() {
    for [width, height] in [[0x4000_u32, 0x4000], [0x7fff_ffff, 1], [2, 0x0800_0000]] {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Sixteen);
        // The header, and none of the pixels it promises.
        drop(encoder.write_header().unwrap());
        refused(Kind::Heights(HeightFormat::Png), &bytes, "file:");
    }
}
