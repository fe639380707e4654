//! JSON drawings, written and read.

use crate::fixture::cube;
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use umriss::export::{ExportError, read_drawing, to_json};
use umriss::run::Counters;
use umriss::view::{Frame, LineClass, LinePiece, LineSource, Projection, VisibleLines};

fn text() -> String {
    String::from_utf8(to_json(&cube()).unwrap()).unwrap()
}

fn message(text: &str) -> String {
    read_drawing(text.as_bytes()).unwrap_err().to_string()
}

#[test]
fn unknown_keys_are_passed_over() {
    let text = text().replace("\"frame\":{", "\"halo\":{\"width\":[1]},\"frame\":{\"tilt\":null,");
    let text = text.replace("\"class\":", "\"pen\":7,\"class\":");
    assert_eq!(read_drawing(text.as_bytes()).unwrap(), cube());
}

#[test]
fn a_drawing_of_the_bare_format_is_read() {
    let text = r#"{"format":"umriss-drawing/1","frame":{"kind":"perspective","origin":[0,0,0],
        "right":[1,0,0],"up":[0,0,1],"forward":[0,1,0]},"lines":[
        {"class":"crease","visible":false,"invisibility":2,"points":[[0,0],[1,0.5]],
         "depth":[1,2],"object":"b","edge":[4,7]},
        {"class":"line","visible":true,"invisibility":0,"points":[[0,0],[1,1]],
         "depth":[1,2],"object":"a","faces":[1,0]}]}"#;
    let lines = read_drawing(text.as_bytes()).unwrap();
    assert_eq!(lines.objects, ["b", "a"]);
    assert_eq!(lines.frame.projection, Projection::Perspective);
    assert_eq!((lines.pieces[0].run, lines.pieces[1].run), (0, 1));
    assert_eq!(lines.pieces[0].source, LineSource::Edge([4, 7]));
    assert_eq!(lines.pieces[1].source, LineSource::Faces([1, 0]));
}

#[test]
fn what_is_malformed_is_named() {
    let good = text();
    assert!(message(&good[..100]).starts_with("line 2, column"), "{}", message(&good[..100]));
    assert!(message("[1]").contains("line 1"));
    let other = message(&good.replace("drawing/1", "drawing/2"));
    assert!(other.contains("umriss-drawing/2") && other.contains("umriss-drawing/1"));
    let missing = message(&good.replace("\"depth\"", "\"deep\""));
    assert!(missing.contains("line 5") && missing.contains("depth"), "{missing}");
    let class = message(&good.replacen("\"crease\"", "\"fold\"", 1));
    assert!(class.contains("line 1 of the drawing") && class.contains("contour"), "{class}");
    let kind = message(&good.replace("orthographic", "fisheye"));
    assert!(kind.contains("fisheye"));
    let seen = message(&good.replacen("\"invisibility\":0", "\"invisibility\":3", 1));
    assert!(seen.contains("contradicts"));
    let source = message(&good.replacen("\"faces\":[3,11]", "\"face\":[3,11]", 1));
    assert!(source.contains("either `edge` or `faces`"));
}

#[test]
fn what_is_not_finite_is_refused() {
    let mut lines = cube();
    lines.pieces[3].depth[1] = f64::NAN;
    assert!(matches!(to_json(&lines), Err(ExportError::NotFinite { line: 3 })));
    lines = cube();
    lines.frame.origin.x = f64::INFINITY;
    assert!(matches!(to_json(&lines), Err(ExportError::NotFiniteFrame)));
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO,
        -1e3..1e3f64,
    ]
}

fn any_piece() -> impl Strategy<Value = LinePiece> {
    let source = (any::<bool>(), any::<[u32; 2]>()).prop_map(|(edge, numbers)| {
        if edge { LineSource::Edge(numbers) } else { LineSource::Faces(numbers) }
    });
    let numbers = [number(), number(), number(), number(), number(), number()];
    (0..7usize, 0u32..3, numbers, 0u32..3, source, any::<u32>()).prop_map(
        |(class, invisibility, [a, b, c, d, e, f], object, source, run)| LinePiece {
            class: LineClass::ALL[class],
            invisibility,
            outline: invisibility == 0 && run.is_multiple_of(2),
            points: [DVec2::new(a, b), DVec2::new(c, d)],
            depth: [e, f],
            object,
            source,
            run,
        },
    )
}

proptest! {
    #[test]
    fn every_drawing_reads_back_as_it_was(
        pieces in prop::collection::vec(any_piece(), 0..40),
        frame in [number(), number(), number(), number(), number()],
        perspective in any::<bool>(),
        name in any::<String>(),
        count in any::<u64>(),
    ) {
        let [a, b, c, d, e] = frame;
        let mut counters = Counters::default();
        counters.add(name.clone(), count);
        let lines = VisibleLines {
            frame: Frame {
                projection: if perspective { Projection::Perspective } else { Projection::Orthographic },
                origin: DVec3::new(a, b, c),
                right: DVec3::new(b, c, d),
                up: DVec3::new(c, d, e),
                forward: DVec3::new(d, e, a),
                shear: DVec2::new(e, a),
            half_height: None,
            },
            objects: vec![format!("1{name}"), format!("2{name}"), "\u{0}\"\\".into()],
            pieces,
            counters,
        };
        let text = to_json(&lines).unwrap();
        prop_assert_eq!(read_drawing(&text).unwrap(), lines);
    }
}
