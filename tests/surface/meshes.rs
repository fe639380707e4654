//! The floating horizon against Appel's method and Roberts' on the same
//! surface, as a mesh of triangles with the same lines.

use glam::{DVec2, DVec3, dvec3};
use proptest::prelude::*;
use std::cmp::Ordering;
use umriss::kernel::numbers::Sign;
use umriss::kernel::predicates::{Carrier, Cut, Exact, Eye, Place, Point, Points, Predicates};
use umriss::model::surface::{CurveOptions, Curves, Heights, Surface};
use umriss::model::{Camera, FeatureOptions, LineClass, LineOrigin, Mesh, View};
use umriss::run::Run;
use umriss::view::{ExactLines, PreparedSurface, PreparedView};
use umriss::visibility::{AppelOptions, HorizonError, appel, floating_horizon, reduce, roberts};

const ALL: CurveOptions =
    CurveOptions { constant_z: true, constant_x: true, diagonals: true, borders: true, every: 1 };

fn surface(columns: usize, heights: &[f64], base: Option<f64>) -> Surface {
    let steps = |count: usize| (0..count).map(|i| i as f64).collect::<Vec<_>>();
    let rows = heights.len() / columns;
    let heights = Heights::new(steps(columns), steps(rows), heights.to_vec()).expect("heights");
    Surface::new(heights, base).expect("a surface")
}

/// The view of a surface, unless the eye is in its middle.
fn view(surface: &Surface, eye: Eye) -> Option<View> {
    let vertices = surface.vertices();
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let bounds = vertices.iter().fold(empty, |(a, b), &p| (a.min(p), b.max(p)));
    let camera = |up| match eye {
        Eye::Towards(towards) => Camera::Orthographic { forward: -towards, target: None, up },
        Eye::At(eye) => {
            Camera::Perspective { eye, target: None, up, near: Some(0.25), fov_y_degrees: 60.0 }
        }
    };
    // What is up in the picture does not matter.
    [DVec3::Z, DVec3::Y].into_iter().find_map(|up| camera(up).view(bounds).ok())
}

fn view_of(surface: &Surface, eye: Eye) -> View {
    view(surface, eye).expect("a view")
}

fn by_horizon(surface: &Surface, view: &View, hidden: bool) -> Result<ExactLines, HorizonError> {
    let run = Run::default();
    let prepared = PreparedSurface::new("surface", surface, view, &ALL, &run).expect("lines");
    floating_horizon::<Exact>(&prepared.question(hidden), &run)
}

/// What a method of meshes finds, by lines of the surface.
fn by_mesh(surface: &Surface, view: &View, hidden: bool, judge: bool) -> ExactLines {
    let run = Run::default();
    let curves = Curves::new(surface, &ALL);
    let mesh = Mesh::new(vec![surface.soup("surface", &curves)], None).expect("a mesh");
    let options = FeatureOptions::default().with_classes(&[LineClass::Line]);
    let prepared = PreparedView::new::<Exact>(&mesh, view, &options, &run).expect("a view");
    let question = prepared.question(hidden);
    let answer = if judge {
        roberts::<Exact>(&question, None, &run).expect("an answer")
    } else {
        appel::<Exact>(&question, &AppelOptions::default(), &run).expect("an answer")
    };
    let mut found = ExactLines::default();
    let mut expected = 0;
    for (index, line) in question.lines.iter().enumerate() {
        assert_eq!(line.origin, LineOrigin::Loose(expected), "lines in their order");
        expected += 1;
        found.push_line(answer.line(index).iter().copied());
    }
    assert_eq!(expected as usize, curves.len());
    found
}

/// Whether two places are the same point of a line, exactly.
fn same(predicates: &Predicates<'_>, carrier: Carrier, first: Place, second: Place) -> bool {
    let values = |cut: Cut| carrier.ends.map(|end| predicates.value(cut, end));
    match (first, second) {
        (Place::Cut(first), Place::Cut(second)) => {
            let order =
                predicates.order(carrier, (first, &values(first)), (second, &values(second)));
            order == Ordering::Equal
        }
        _ => first == second,
    }
}

/// Pieces of a line as ends and whether they are hidden, maximal.
fn pieces(lines: &ExactLines, line: usize) -> Vec<([Place; 2], bool)> {
    let mut found: Vec<([Place; 2], bool)> = Vec::new();
    for piece in lines.line(line) {
        let hidden = piece.invisibility > 0;
        match found.last_mut() {
            Some((ends, last)) if *last == hidden && ends[1] == piece.from => ends[1] = piece.to,
            _ => found.push(([piece.from, piece.to], hidden)),
        }
    }
    found
}

/// Holds the answers against each other, line by line.
fn compare(surface: &Surface, eye: Eye, hidden: bool, judge: bool) -> Result<usize, String> {
    let Some(view) = view(surface, eye) else {
        return Ok(0);
    };
    let horizon = by_horizon(surface, &view, hidden).map_err(|error| error.to_string())?;
    let mesh = by_mesh(surface, &view, hidden, judge);
    let vertices = surface.vertices();
    let points = Points::new(&vertices, view.eye, view.near);
    let predicates = Predicates::<Exact>::new(&points);
    let lines = Curves::new(surface, &ALL).lines(surface);
    let mut cut = 0;
    for (index, &[a, b]) in lines.iter().enumerate() {
        let carrier = Carrier::edge(a, b);
        let (left, right) = (pieces(&horizon, index), pieces(&mesh, index));
        let equal = left.len() == right.len()
            && left.iter().zip(&right).all(|((p, hidden), (q, other))| {
                hidden == other && (0..2).all(|i| same(&predicates, carrier, p[i], q[i]))
            });
        if !equal {
            let [a, b] = [a, b].map(|v| vertices[v as usize]);
            return Err(format!("{eye:?}: line {index} {a} {b}: {left:?} instead of {right:?}"));
        }
        cut += usize::from(left.len() > 1);
    }
    Ok(cut)
}

fn eyes() -> impl Strategy<Value = Eye> {
    let small = |range: std::ops::RangeInclusive<i32>| range.prop_map(f64::from);
    let towards = (small(-3..=3), small(-3..=3), small(-2..=2))
        .prop_filter("columns", |&(x, y, _)| x != 0.0 || y != 0.0)
        .prop_map(|(x, y, z)| Eye::Towards(dvec3(x, y, z)));
    let at = (small(-6..=12), small(-12..=6), small(-6..=8), 1..=2)
        .prop_map(|(x, y, z, d)| Eye::At(dvec3(x, y, z) / f64::from(d)));
    prop_oneof![towards, at]
}

/// Few heights, so that much is flat, collinear or seen from its edge.
fn heights() -> impl Strategy<Value = (usize, Vec<f64>)> {
    (2..=6_usize, 2..=6_usize, 0..=3_i32).prop_flat_map(|(columns, rows, most)| {
        let height = (-most..=most).prop_map(f64::from);
        (Just(columns), prop::collection::vec(height, columns * rows))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, ..ProptestConfig::default() })]

    #[test]
    fn equals_appel_on_random_grids((columns, heights) in heights(), eye in eyes(), hidden: bool) {
        let surface = surface(columns, &heights, None);
        // Views beyond its reach are refused, and that is another test.
        if let Err(difference) = compare(&surface, eye, hidden, false) {
            prop_assert!(difference.contains("expected an eye beside it"), "{}", difference);
        }
    }

    #[test]
    fn equals_appel_on_a_base((columns, heights) in heights(), eye in eyes(), hidden: bool) {
        let surface = surface(columns, &heights, Some(-4.0));
        if let Err(difference) = compare(&surface, eye, hidden, false) {
            prop_assert!(difference.contains("expected an eye beside it"), "{}", difference);
        }
    }

    #[test]
    fn equals_roberts_on_random_grids((columns, heights) in heights(), eye in eyes()) {
        let surface = surface(columns, &heights, None);
        if let Err(difference) = compare(&surface, eye, true, true) {
            prop_assert!(difference.contains("expected an eye beside it"), "{}", difference);
        }
    }

    #[test]
    fn equals_appel_where_nothing_is_round(
        values in prop::collection::vec(-1.0..1.0_f64, 30), x in -1.0..1.0_f64, y in -1.0..1.0_f64,
        z in -1.0..1.0_f64,
    ) {
        let surface = surface(6, &values, None);
        compare(&surface, Eye::Towards(dvec3(x, y, z)), true, false).map_err(TestCaseError::fail)?;
    }
}

#[test]
fn additive_surfaces_are_drawn_alike_at_every_azimuth() {
    // f = g(x) + h(z): all cells are flat, and their diagonals change nothing.
    let (g, h) = ([0.0, 2.0, 1.0, 3.0, 0.0], [1.0, 0.0, 2.0, -1.0]);
    let heights: Vec<f64> = h.iter().flat_map(|h| g.map(|g| g + h)).collect();
    let surface = surface(5, &heights, None);
    let mut cut = 0;
    for (x, y) in [(0, -1), (1, -3), (1, -1), (3, -1), (1, 0), (2, 1), (0, 1), (-1, 1), (-1, -2)] {
        for z in [-1.0, 0.0, 0.5, 3.0] {
            let eye = Eye::Towards(dvec3(f64::from(x), f64::from(y), z));
            cut += compare(&surface, eye, true, false).unwrap();
        }
    }
    for at in [dvec3(2.0, -9.0, 4.0), dvec3(1.5, 3.0, 2.0), dvec3(-5.0, -2.0, -3.0)] {
        cut += compare(&surface, Eye::At(at), true, false).unwrap();
    }
    assert!(cut > 100, "only {cut} lines are partly hidden");
}

#[test]
fn undersides_of_a_deep_valley_are_drawn() {
    // f = -|x| seen from below: without the lower horizon nothing behind
    // the first row would be seen.
    let xs = [-3.0_f64, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0];
    let heights: Vec<f64> = (0..5).flat_map(|_| xs.map(|x| -x.abs())).collect();
    let surface = surface(7, &heights, None);
    let eye = Eye::Towards(dvec3(0.0, -3.0, -1.0));
    compare(&surface, eye, true, false).unwrap();
    let found = by_horizon(&surface, &view_of(&surface, eye), false).unwrap();
    let curves = Curves::new(&surface, &ALL).lines(&surface);
    let seen = |line: usize| !found.line(line).is_empty();
    // Seen from below all of it is seen, but for nothing.
    assert!((0..curves.len()).all(seen));
    // Seen level, from in front, every row is behind the first one.
    let level = Eye::Towards(dvec3(0.0, -1.0, 0.0));
    compare(&surface, level, true, false).unwrap();
    // And from above a valley |x| shows both its sides' undersides not.
    let above = Eye::Towards(dvec3(3.0, -1.0, 1.0));
    let cut = compare(&surface, above, true, false).unwrap();
    assert!(cut > 0);
}

#[test]
fn a_strip_seen_from_its_edge_is_drawn_once() {
    // A plane that contains the direction of the rays.
    let heights: Vec<f64> = (0..4).flat_map(|j| [f64::from(-j); 4]).collect();
    let surface = surface(4, &heights, None);
    let view = view_of(&surface, Eye::Towards(dvec3(0.0, -1.0, 1.0)));
    // Rows rise towards the viewer: z grows to him, heights fall with it.
    let view_on_edge = view_of(&surface, Eye::Towards(dvec3(0.0, -1.0, -1.0)));
    for view in [view, view_on_edge] {
        let run = Run::default();
        let prepared = PreparedSurface::new("plane", &surface, &view, &ALL, &run).unwrap();
        let question = prepared.question(false);
        let answer = floating_horizon::<Exact>(&question, &run).unwrap();
        let drawn = reduce::<Exact>(&question.lines, &answer, &run).unwrap();
        let curves = Curves::new(&surface, &ALL);
        let mesh = Mesh::new(vec![surface.soup("plane", &curves)], None).unwrap();
        let options = FeatureOptions::default().with_classes(&[LineClass::Line]);
        let prepared = PreparedView::new::<Exact>(&mesh, &view, &options, &run).unwrap();
        let question = prepared.question(false);
        let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).unwrap();
        let other = reduce::<Exact>(&question, &answer, &run).unwrap();
        let images = |lines: &umriss::view::VisibleLines| -> Vec<[DVec2; 2]> {
            lines.pieces.iter().map(|piece| piece.points).collect()
        };
        assert_eq!(images(&drawn), images(&other));
    }
}

#[test]
fn the_border_hides_the_base_of_a_wall_that_is_seen_from_its_edge() {
    // The eye stands in the plane of the left wall and looks over the near one.
    let eye = Eye::At(dvec3(0.0, 1.0, 1.0));
    for (sign, eye_below) in [(1.0, false), (-1.0, true)] {
        let heights = [-2.0 * sign, 0.0, 0.0, 0.0];
        let eye = match eye {
            Eye::At(place) if eye_below => Eye::At(place.with_z(-place.z)),
            eye => eye,
        };
        let surface = surface(2, &heights, Some(-4.0 * sign));
        for hidden in [false, true] {
            compare(&surface, eye, hidden, false).unwrap();
            compare(&surface, eye, hidden, true).unwrap();
        }
    }
}

#[test]
fn what_is_beyond_its_reach_is_refused_with_advice() {
    let surface = surface(3, &[0.0; 9], None);
    let refused = |eye| by_horizon(&surface, &view_of(&surface, eye), false).unwrap_err();
    let over = refused(Eye::At(dvec3(1.0, -1.5, 8.0)));
    assert_eq!(over, HorizonError::EyeOverDomain);
    assert!(over.to_string().ends_with("or a method of `umriss draw` such as --method appel"));
    let camera = Camera::Orthographic { forward: -DVec3::Z, target: None, up: DVec3::Y };
    let view = camera.view((DVec3::ZERO, DVec3::ONE)).unwrap();
    assert_eq!(by_horizon(&surface, &view, false), Err(HorizonError::Vertical));
}

#[test]
fn lines_end_at_the_near_plane() {
    let surface = surface(9, &[0.0; 81], None);
    let view = view_of(&surface, Eye::At(dvec3(4.5, 0.125, 0.5)));
    let points = Points::new(&surface.vertices(), view.eye, view.near);
    let predicates = Predicates::<Exact>::new(&points);
    let found = by_horizon(&surface, &view, false).unwrap();
    let cut = Place::Cut(Cut::Near);
    let ends = (0..found.len()).flat_map(|line| found.line(line)).flat_map(|p| [p.from, p.to]);
    assert!(ends.filter(|&end| end == cut).count() > 0);
    let behind = |v: u32| predicates.value_sign(Cut::Near, Point::Vertex(v)) == Sign::Negative;
    let lines = Curves::new(&surface, &ALL).lines(&surface);
    for (index, line) in lines.iter().enumerate() {
        if line.iter().all(|&vertex| behind(vertex)) {
            assert!(found.line(index).is_empty());
        }
    }
    compare(&surface, Eye::At(dvec3(4.5, 0.125, 0.5)), true, false).unwrap();
}
