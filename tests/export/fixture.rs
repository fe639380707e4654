//! A small view made by hand: the visible outline of a box and its hidden
//! edges, one line of another object, one common line of two faces.

use glam::{DVec2, DVec3};
use umriss::run::Counters;
use umriss::view::{Frame, LineClass, LinePiece, LineSource, Projection, VisibleLines};

/// The drawing of a cube of 20 mm seen from above in an oblique view.
pub(crate) fn cube() -> VisibleLines {
    let front = [(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0)];
    let back = front.map(|(u, v)| (u + 8.0, v + 5.5));
    let mut pieces = Vec::new();
    for i in 0..4 {
        let next = (i + 1) % 4;
        add(&mut pieces, LineClass::Contour, 0, front[i], front[next]);
        // The lower left corner of the back is behind the front.
        let hidden = u32::from(i == 0 || i == 3);
        add(&mut pieces, LineClass::Crease, hidden, back[i], back[next]);
        add(&mut pieces, LineClass::Crease, u32::from(i == 0), front[i], back[i]);
    }
    let label = &mut pieces[0];
    label.class = LineClass::Intersection;
    label.source = LineSource::Faces([3, 11]);
    let mut counters = Counters::default();
    counters.add("crossings", 12);
    counters.add("edges", 12);
    VisibleLines {
        frame: Frame {
            projection: Projection::Orthographic,
            origin: DVec3::new(0.0, -0.0, 0.1),
            right: DVec3::X,
            up: DVec3::Z,
            forward: DVec3::Y,
            shear: DVec2::new(0.4, 0.275),
            half_height: None,
        },
        objects: vec!["cube & <box>".into(), "unused".into()],
        pieces,
        counters,
    }
}

fn add(
    pieces: &mut Vec<LinePiece>,
    class: LineClass,
    invisibility: u32,
    from: (f64, f64),
    to: (f64, f64),
) {
    let run = pieces.len() as u32;
    pieces.push(LinePiece {
        class,
        invisibility,
        outline: false,
        points: [DVec2::from(from), DVec2::from(to)],
        depth: [0.0, 1.0 / 3.0],
        object: 0,
        source: LineSource::Edge([run, run + 1]),
        run,
    });
}

/// All strokes of an SVG, as its paths have them.
#[cfg(feature = "svg")]
pub(crate) fn svg_strokes(svg: &str) -> Vec<Vec<DVec2>> {
    let mut strokes = Vec::new();
    for line in svg.lines().filter(|line| line.starts_with("<path")) {
        for stroke in line.split('"').nth(1).unwrap().split('M').skip(1) {
            let point = |text: &str| {
                let (x, y) = text.split_once(' ').unwrap();
                DVec2::new(x.parse().unwrap(), y.parse().unwrap())
            };
            let mut points: Vec<_> = stroke.trim_end_matches('Z').split('L').map(point).collect();
            points.extend(stroke.ends_with('Z').then_some(points[0]));
            strokes.push(points);
        }
    }
    strokes
}
