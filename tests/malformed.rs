//! Malformed files and the whole text of the one error each of them gives, and
//! odd files with what is told of them.
//!
//! `tests/malformed/FORMAT.txt` has a line `NAME<TAB>ERROR` for every file of
//! the folder `tests/malformed/FORMAT`. `tests/tolerated.txt` has a line
//! `NAME<TAB>OBJECTS<TAB>FACES<TAB>WARNINGS` for every file of `tests/tolerated`.

use std::collections::BTreeMap;
use std::path::Path;

use umriss::model::Soup;
use umriss::model::import::{Format, HeightFormat, ImportError, read_bytes, read_heights_bytes};

fn check(name: &str) {
    let format = Format::from_name(name).expect("a format");
    check_with(name, 20, |file, bytes| read_bytes(file, bytes, Some(format)).map(drop));
}

fn check_heights(name: &str) {
    let format = HeightFormat::from_name(name).expect("a format");
    check_with(name, 14, |file, bytes| read_heights_bytes(file, bytes, Some(format)).map(drop));
}

fn check_with(name: &str, least: usize, read: impl Fn(&str, &[u8]) -> Result<(), ImportError>) {
    let folder = Path::new("tests/malformed");
    let table = std::fs::read_to_string(folder.join(name).with_extension("txt")).expect("table");
    let expected: BTreeMap<_, _> =
        table.lines().map(|line| line.split_once('\t').expect("a tab")).collect();
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder.join(name)).expect("folder") {
        let path = entry.expect("entry").path();
        let file = path.file_name().and_then(|file| file.to_str()).expect("name").to_owned();
        let bytes = std::fs::read(&path).expect("file");
        let error = match read(&file, &bytes) {
            Ok(_) => "read without an error".to_owned(),
            Err(error) => error.to_string(),
        };
        found.insert(file, error);
    }
    assert!(least <= found.len(), "only {} files", found.len());
    let mut wrong = String::new();
    for (file, error) in &found {
        if expected.get(&**file) != Some(&&**error) {
            wrong += &format!("{file}\t{error}\n");
        }
    }
    assert!(wrong.is_empty(), "these errors are not in the table:\n{wrong}");
    assert_eq!(expected.len(), found.len(), "the table names files that are not there");
}

#[test]
fn malformed_obj_gives_one_error_with_its_line() {
    check("obj");
}

#[test]
fn malformed_stl_gives_one_error_with_its_line_or_byte() {
    check("stl");
}

#[test]
fn malformed_off_gives_one_error_with_its_line() {
    check("off");
}

#[cfg(feature = "ply")]
#[test]
fn malformed_ply_gives_one_error_with_its_line_or_byte() {
    check("ply");
}

#[cfg(feature = "json")]
#[test]
fn malformed_polygon_scene_gives_one_error_with_its_line() {
    check("json");
}

#[cfg(feature = "gltf")]
#[test]
fn malformed_gltf_gives_one_error_with_its_line_or_byte() {
    check("gltf");
}

#[test]
fn malformed_csv_gives_one_error_with_its_line() {
    check_heights("csv");
}

#[test]
fn malformed_esri_grid_gives_one_error_with_its_line() {
    check_heights("asc");
}

#[cfg(feature = "png")]
#[test]
fn malformed_height_map_gives_one_error() {
    check_heights("png");
}

#[cfg(all(feature = "ply", feature = "gltf"))]
#[test]
fn odd_files_are_read_and_what_is_passed_over_is_told() {
    let table = std::fs::read_to_string("tests/tolerated.txt").expect("table");
    let expected: BTreeMap<_, _> =
        table.lines().map(|line| line.split_once('\t').expect("a tab")).collect();
    let mut wrong = String::new();
    let mut count = 0;
    for entry in std::fs::read_dir("tests/tolerated").expect("folder") {
        let path = entry.expect("entry").path();
        let file = path.file_name().and_then(|file| file.to_str()).expect("name");
        let bytes = std::fs::read(&path).expect("file");
        let found = match read_bytes(file, &bytes, None) {
            Err(error) => error.to_string(),
            Ok(imported) => {
                let faces: Vec<_> =
                    imported.objects.iter().map(|object| object.faces.len()).collect();
                let objects = &imported.objects;
                let warnings = imported.warnings.join(" | ");
                let corner = glam::DVec3::new(1.0, 1.0, 0.0);
                let has_corner = |object: &Soup| object.vertices.contains(&corner);
                assert!(objects.iter().any(has_corner), "{file}: {objects:?}");
                format!("{}\t{}\t{warnings}", objects.len(), faces.iter().sum::<usize>())
            }
        };
        if expected.get(file) != Some(&&*found) {
            wrong += &format!("{file}\t{found}\n");
        }
        count += 1;
    }
    assert!(wrong.is_empty(), "this is not in the table:\n{wrong}");
    assert_eq!(expected.len(), count, "the table names files that are not there");
}

/// Whether the bytes are read as heights, which then are sound.
fn heights_are_read(bytes: &[u8], format: Option<HeightFormat>) -> bool {
    let Ok(found) = read_heights_bytes("seed", bytes, format) else { return false };
    let heights = found.heights;
    assert_eq!(heights.values().len(), heights.xs().len() * heights.zs().len());
    assert!(heights.xs().iter().chain(heights.zs()).all(|place| place.is_finite()));
    assert!(heights.xs().is_sorted() && heights.zs().is_sorted());
    true
}

#[test]
fn truncated_and_mutated_heights_are_read_or_refused() {
    let map = std::fs::read("examples/models/island.png").expect("a height map");
    let grid = b"ncols 3\nnrows 2\nxllcorner 1\nyllcenter -2.5\ncellsize 10\nNODATA_value -1\n\
        1 2 3\n4 -1 6\n";
    let table = b"# a table\n1,-2.5,nan\n4,,6e2\n7,8,9\n";
    let seeds = [
        (HeightFormat::Csv, &table[..]),
        (HeightFormat::Esri, grid),
        #[cfg(feature = "png")]
        (HeightFormat::Png, &map),
    ];
    let mut state = 1973_u64;
    let mut random = |bound: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % bound
    };
    for (format, seed) in seeds {
        assert!(
            heights_are_read(seed, Some(format))
                && heights_are_read(seed, None) != (format == HeightFormat::Csv)
        );
        for _ in 0..200 {
            let mut bytes = seed[..random(seed.len() + 1)].to_vec();
            heights_are_read(&bytes, Some(format));
            bytes = seed.to_vec();
            for _ in 0..=random(3) {
                let at = random(bytes.len());
                bytes[at] = random(256) as u8;
            }
            for format in [None, Some(format)] {
                heights_are_read(&bytes, format);
            }
        }
    }
}
