//! Numbers of four hundred digits: rounded as the standard library rounds
//! them, or refused where they are beyond all doubles.

use super::{Kind, read};
use umriss::model::import::{Format, HeightFormat, read_bytes, read_heights_bytes};

/// Long decimals, and the doubles next to them.
fn numbers() -> Vec<(String, f64)> {
    let digits = "123456789".repeat(45);
    let (zeros, nines) = ("0".repeat(400), "9".repeat(400));
    let texts = [
        format!("0.{digits}"),
        format!("-{}.{digits}", &digits[..300]),
        format!("1{zeros}e-400"),
        format!("0.{zeros}1e400"),
        format!("0.{zeros}{digits}"),
        // Half way between 1 and the next double, and a little more.
        format!("1.00000000000000011102230246251565404236316680908203125{zeros}"),
        format!("1.00000000000000011102230246251565404236316680908203125{zeros}1"),
        format!("0.{nines}"),
        format!("-0.{zeros}"),
    ];
    let value = |text: &String| text.parse::<f64>().unwrap();
    texts.iter().map(|text| (text.clone(), value(text))).collect()
}

/// One point of a file in each text format.
fn files(x: &str) -> Vec<(Kind, String)> {
    let model = Kind::Model;
    let mut files = vec![
        (model(Format::Obj), format!("v {x} 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")),
        (model(Format::Off), format!("OFF\n3 1 0\n{x} 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")),
        (
            model(Format::Stl),
            format!(
                "solid s\nfacet normal 0 0 1\nouter loop\nvertex {x} 0 0\nvertex 1 0 0\nvertex 0 \
                 1 0\nendloop\nendfacet\nendsolid s\n"
            ),
        ),
        (Kind::Heights(HeightFormat::Csv), format!("{x},1\n2,3\n")),
        (
            Kind::Heights(HeightFormat::Esri),
            format!("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n{x} 1\n2 3\n"),
        ),
    ];
    #[cfg(feature = "ply")]
    files.push((
        model(Format::Ply),
        format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double \
             y\nproperty double z\nelement face 1\nproperty list uchar int \
             vertex_indices\nend_header\n{x} 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
        ),
    ));
    #[cfg(feature = "json")]
    files.push((
        model(Format::PolygonScene),
        format!("{{\"vertices\":[[{x},0,0],[1,0,0],[0,1,0]],\"faces\":[{{\"outer\":[0,1,2]}}]}}"),
    ));
    files
}

/// The number that was read for the point.
fn number_in(kind: Kind, text: &str) -> f64 {
    match kind {
        Kind::Model(format) => {
            let imported = read_bytes("file", text.as_bytes(), Some(format)).unwrap();
            imported.objects[0].vertices[0].x
        }
        Kind::Heights(format) => {
            let found = read_heights_bytes("file", text.as_bytes(), Some(format)).unwrap();
            let heights = found.heights;
            // Rows are kept in the order of z, whichever that is in the file.
            let corners = [heights.values()[0], heights.values()[2]];
            corners.into_iter().find(|&value| value != 2.0).unwrap()
        }
        #[cfg(feature = "json")]
        Kind::Drawing => unreachable!("no point of a drawing is asked for"),
    }
}

#[test]
fn four_hundred_digits_are_rounded_correctly() {
    for (text, expected) in numbers() {
        for (kind, file) in files(&text) {
            let found = number_in(kind, &file);
            assert_eq!(found, expected, "{kind:?}: {text}");
        }
    }
}

#[test]
fn numbers_beyond_all_doubles_are_refused() {
    for text in ["9".repeat(400), format!("-{}", "1".repeat(310)), "1e400".to_owned()] {
        for (kind, file) in files(&text) {
            let error = read(kind, file.as_bytes()).expect_err("an infinite number");
            let line = error.strip_prefix("file:").and_then(|rest| rest.split(':').next());
            assert!(line.is_some_and(|line| line.parse::<u32>().is_ok()), "{error}");
        }
    }
}
