//! Small scenes in which one can say what is in front.

use super::scenes::{named, obj, perspective};
use glam::{DVec2, DVec3};
use umriss::kernel::predicates::Exact;
use umriss::model::{FeatureOptions, LineClass, Mesh, View};
use umriss::run::Run;
use umriss::verify::{EndCause, Explainer, Explanation, LineThere, Side};
use umriss::view::{LineSource, PreparedView};
use umriss::visibility::{AppelOptions, appel};

/// Asks about the image of a world point.
fn explain(mesh: &Mesh, view: &View, classes: &[LineClass], world: DVec3) -> Explanation {
    let run = Run::default();
    let options = FeatureOptions::default().with_classes(classes);
    let prepared = PreparedView::new::<Exact>(mesh, view, &options, &run).unwrap();
    let question = prepared.question(true);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).unwrap();
    let explainer = Explainer::new(view, &question, &answer, &run).unwrap();
    explainer.at(view.frame.image(world))
}

/// Loose lines alone, from the front, where u is x, v is z and depth y.
fn loose(text: &str, world: [f64; 3]) -> LineThere {
    let mesh = obj(text);
    let view = named("front", &mesh);
    explain(&mesh, &view, &[LineClass::Line], world.into()).line.unwrap()
}

fn faces(there: &LineThere) -> Vec<u32> {
    there.hidden_by.iter().map(|face| face.face).collect()
}

/// A line from x = -1 to x = 9 at y = 9 behind whatever `more` adds; its
/// vertices are 0 and 1.
fn scene(more: &str) -> String {
    format!("v -1 9 0\nv 9 9 0\nl 1 2\n{more}")
}

#[test]
fn walls_one_behind_another_are_named_from_the_eye_on() {
    // Three squares, the last of the file in front.
    let walls = "v 0 5 -1\nv 8 5 -1\nv 8 5 1\nv 0 5 1\nf 3 4 5 6\n\
        v 0 7 -1\nv 8 7 -1\nv 8 7 1\nv 0 7 1\nf 7 8 9 10\n\
        v 2 3 -1\nv 6 3 -1\nv 6 3 1\nv 2 3 1\nf 11 12 13 14\n";
    let there = loose(&scene(walls), [4.5, 9.0, 0.0]);
    assert_eq!(faces(&there), [2, 0, 1]);
    assert_eq!(there.side, Side::Both);
    let depths: Vec<f64> = there.hidden_by.iter().map(|face| face.depth).collect();
    // The origin of the frame is the middle of the box, y = 6.
    assert_eq!(depths, [-3.0, -1.0, 1.0]);
    assert_eq!(there.depth, 3.0);
    let [begins, ends] = there.ends;
    let vertical = |cause| match cause {
        EndCause::Edge { edge, .. } => {
            let mut edge = edge;
            edge.sort_unstable();
            edge
        }
        other => panic!("{other:?}"),
    };
    assert_eq!(vertical(begins.cause), [10, 13]);
    assert_eq!(vertical(ends.cause), [11, 12]);
    assert_eq!([begins.beyond, ends.beyond], [Some(2), Some(2)]);
    let beside = loose(&scene(walls), [-0.5, 9.0, 0.0]);
    assert!(beside.hidden_by.is_empty());
    assert_eq!(beside.ends[0].cause, EndCause::Vertex { object: 0, vertex: 0 });
    assert_eq!([beside.ends[0].beyond, beside.ends[1].beyond], [None, Some(2)]);
}

#[test]
fn planes_that_cross_change_places_in_the_order() {
    // y = x and y = 8 - x.
    let planes = "v 0 0 -1\nv 8 8 -1\nv 8 8 1\nv 0 0 1\nf 3 4 5 6\n\
        v 0 8 -1\nv 8 0 -1\nv 8 0 1\nv 0 8 1\nf 7 8 9 10\n";
    assert_eq!(faces(&loose(&scene(planes), [3.0, 9.0, 0.0])), [0, 1]);
    assert_eq!(faces(&loose(&scene(planes), [5.0, 9.0, 0.0])), [1, 0]);
}

#[test]
fn a_planar_polygon_is_one_face_however_it_is_cut() {
    let polygon = "v 0 5 -2\nv 4 5 -3\nv 8 5 -2\nv 8 5 2\nv 4 5 3\nv 0 5 2\nf 3 4 5 6 7 8\n";
    for x in [1.0, 2.0, 3.0, 4.0, 5.5, 7.0] {
        assert_eq!(faces(&loose(&scene(polygon), [x, 9.0, 0.0])), [0], "{x}");
    }
}

#[test]
fn a_folded_quadrilateral_may_be_two_faces() {
    // Corners that are not in one plane, seen so that its triangles overlap.
    let folded = "v 0 4 -1\nv 8 5 3\nv 0 6 1\nv 1 5 3\nf 3 4 5 6\n";
    let mut counts = Vec::new();
    for x in [0.125, 0.25, 0.5, 1.0, 2.0] {
        let there = loose(&scene(folded), [x, 9.0, 0.0]);
        assert!(there.hidden_by.iter().all(|face| face.face == 0));
        counts.push(there.hidden_by.len());
    }
    assert!(counts.contains(&1), "{counts:?}");
}

#[test]
fn faces_in_one_plane_are_a_member_each() {
    let walls = "v 0 5 -1\nv 8 5 -1\nv 8 5 1\nv 0 5 1\nf 3 4 5 6\n\
        v 1 5 -2\nv 7 5 -2\nv 7 5 2\nv 1 5 2\nf 7 8 9 10\n";
    assert_eq!(faces(&loose(&scene(walls), [4.5, 9.0, 0.0])), [0, 1]);
    assert_eq!(faces(&loose(&scene(walls), [0.5, 9.0, 0.0])), [0]);
}

#[test]
fn faces_that_the_line_lies_in_or_touches_hide_nothing() {
    // In the line's plane, edge-on, behind it, and one that ends on it.
    let around = "v 0 9 -1\nv 8 9 -1\nv 8 9 1\nv 0 9 1\nf 3 4 5 6\n\
        v 0 0 0\nv 8 0 0\nv 8 8 0\nv 0 8 0\nf 7 8 9 10\n\
        v 0 10 -1\nv 8 10 -1\nv 8 10 1\nf 11 12 13\n\
        v 0 9 0\nv 8 9 0\nv 4 12 3\nf 14 15 16\n";
    let there = loose(&scene(around), [4.5, 9.0, 0.0]);
    assert_eq!(faces(&there), [0; 0]);
}

#[test]
fn behind_an_edge_the_side_with_more_faces_counts() {
    // Exactly behind the line where two walls meet; one more on the right,
    // which is below for a line that runs to the right.
    let walls = "v 0 5 0\nv 8 5 0\nv 8 5 1\nv 0 5 1\nf 3 4 5 6\n\
        v 8 5 -1\nv 0 5 -1\nf 4 3 8 7\n";
    let there = loose(&scene(walls), [4.5, 9.0, 0.0]);
    assert_eq!((faces(&there), there.side), (vec![0], Side::Left));
    let more = format!("{walls}v 0 3 -1\nv 8 3 -1\nv 8 3 0\nv 0 3 0\nf 9 10 11 12\n");
    let there = loose(&scene(&more), [4.5, 9.0, 0.0]);
    assert_eq!((faces(&there), there.side), (vec![2, 1], Side::Right));
}

#[test]
fn lines_under_a_line_are_those_at_that_place() {
    // Three lines with one image; the nearest is the shortest.
    let text = "v 0 1 0\nv 4 1 0\nv 8 5 0\nv 2 5 0\nv 3 9 0\nv 12 9 0\n\
        v 0 0 7\nl 1 2\nl 3 4\nl 5 6\nl 6 7\n";
    let under = |x: f64| {
        let there = loose(text, [x, 0.0, 0.0]);
        let sources = there.coincident.iter().map(|line| line.source).collect::<Vec<_>>();
        (there.line, sources)
    };
    let [near, middle, far] = [[0, 1], [2, 3], [4, 5]].map(LineSource::Edge);
    assert_eq!(under(1.0), (0, vec![]));
    assert_eq!(under(2.5), (0, vec![middle]));
    assert_eq!(under(3.5), (0, vec![middle, far]));
    assert_eq!(under(5.0), (1, vec![far]));
    assert_eq!(under(10.0), (2, vec![]));
    let _ = near;
}

#[test]
fn an_intersection_line_names_both_faces_and_ends_at_a_piercing() {
    let mesh = obj("o wall\nv -8 0 -8\nv 16 0 -8\nv 4 0 16\nf 1 2 3\n\
        o blade\nv 2 -3 0\nv 6 -3 0\nv 4 3 0\nf 4 5 6\n");
    let view = named("iso", &mesh);
    let there = explain(&mesh, &view, &[LineClass::Intersection], DVec3::new(4.5, 0.0, 0.0));
    let there = there.line.unwrap();
    let objects = there.faces.unwrap().map(|face| face.object);
    assert!(objects == [0, 1] || objects == [1, 0]);
    let pierced = |end: EndCause| matches!(end, EndCause::Piercing { object: 1, .. });
    assert!(there.ends.iter().all(|end| pierced(end.cause)), "{there:?}");
}

#[test]
fn a_line_that_goes_through_a_face_ends_a_piece_there_and_the_near_plane_another() {
    let mesh = obj("v -4 -1 0\nv 0 11 0\nv -9 5 -9\nv 9 5 -9\nv 0 5 9\nl 1 2\nf 3 4 5\n");
    let eye = DVec3::new(-2.0, 0.0, 0.0);
    let view = perspective(eye, DVec3::new(-2.0, 5.0, 0.0), &mesh);
    let place = DVec3::new(-4.0 + 4.0 * 0.75, 8.0, 0.0);
    let there = explain(&mesh, &view, &[LineClass::Line], place).line.unwrap();
    assert_eq!(faces(&there), [0]);
    assert_eq!(there.ends[0].cause, EndCause::Face { object: 0, vertices: [2, 3, 4] });
    assert_eq!(there.ends[0].beyond, Some(0));
    let seen = explain(&mesh, &view, &[LineClass::Line], DVec3::new(-3.0, 2.0, 0.0));
    let there = seen.line.unwrap();
    assert_eq!(faces(&there), [0; 0]);
    assert_eq!(there.ends[0].cause, EndCause::NearPlane);
    assert_eq!(there.ends[0].beyond, None);
}

#[test]
fn faces_at_a_point_are_named_from_the_eye_on() {
    let mesh = obj("v 0 5 0\nv 4 5 0\nv 0 5 4\nf 1 2 3\nv 0 3 0\nv 4 3 0\nv 0 3 4\nf 4 5 6\n\
        v 0 0 -9\nv 4 9 -9\nv 0 0 -5\nf 7 8 9\n");
    for view in [
        named("front", &mesh),
        perspective(DVec3::new(1.0, -20.0, 1.0), DVec3::new(1.0, 0.0, 1.0), &mesh),
    ] {
        let at = |world: DVec3| {
            let found = explain(&mesh, &view, &[LineClass::Line], world);
            assert_eq!(found.line, None);
            let faces = found.faces.iter();
            faces.map(|face| (face.face, face.vertices)).collect::<Vec<_>>()
        };
        assert_eq!(at(DVec3::new(1.0, 3.0, 1.0)), [(1, [3, 4, 5]), (0, [0, 1, 2])]);
        assert_eq!(at(DVec3::new(3.0, 3.0, 3.0)), []);
    }
    // The border belongs to the face, and its point is exact here.
    let view = named("front", &mesh);
    let corner = explain(&mesh, &view, &[LineClass::Line], DVec3::new(0.0, 0.0, 2.0));
    assert_eq!(corner.faces.len(), 2);
    assert_eq!(corner.faces[0].depth + 2.0, corner.faces[1].depth);
    let run = Run::default();
    let prepared =
        PreparedView::new::<Exact>(&mesh, &view, &FeatureOptions::default(), &run).unwrap();
    let question = prepared.question(true);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).unwrap();
    let explainer = Explainer::new(&view, &question, &answer, &run).unwrap();
    assert!(explainer.faces_at(DVec2::new(f64::NAN, 0.0)).is_empty());
}
