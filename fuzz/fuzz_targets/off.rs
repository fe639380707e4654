//! Any bytes as a off file: read or refused, never a panic.

#![no_main]

use libfuzzer_sys::fuzz_target;
use umriss::model::import::{Format, read_bytes};

fuzz_target!(|bytes: &[u8]| {
    let Ok(imported) = read_bytes("fuzz", bytes, Some(Format::Off)) else { return };
    for object in &imported.objects {
        assert!(object.vertices.iter().all(|vertex| vertex.is_finite()));
        let corners = object.faces.corners().iter().chain(object.lines.as_flattened());
        assert!(corners.into_iter().all(|&corner| (corner as usize) < object.vertices.len()));
    }
});
