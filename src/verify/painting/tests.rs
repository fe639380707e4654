//! Orders that are right are found right, damaged ones are found out.

use super::*;
use crate::kernel::predicates::Exact;
use crate::model::{Camera, FeatureOptions, Mesh, Soup};
use crate::polygon::Cut;
use crate::view::PreparedView;
use glam::DVec3;

/// Three bars, each over the next one, and a square that passes through one.
fn bars() -> Mesh {
    let bars = [
        [[0.0, 0.0, 0.0], [10.0, 0.0, 2.0], [10.0, 1.0, 2.0], [0.0, 1.0, 0.0]],
        [[9.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 10.0, 2.0], [9.0, 10.0, 2.0]],
        [[0.0, 1.0, 2.0], [1.0, 0.0, 2.0], [10.0, 9.0, 0.0], [9.0, 10.0, 0.0]],
        [[3.0, -1.0, 0.0], [6.0, -1.0, 2.0], [6.0, 3.0, 2.0], [3.0, 3.0, 0.0]],
    ];
    let mut soup = Soup::default();
    for bar in bars {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend(bar.map(DVec3::from_array));
        soup.faces.push(&[0, 1, 2, 3].map(|i| first + i), []);
    }
    Mesh::new(vec![soup], None).expect("a mesh")
}

/// The report about the scene, by one way, after a change of its order.
fn report(near: bool, change: impl FnOnce(&LineQuestion<'_>, &mut PaintOrder)) -> PaintReport {
    let mesh = bars();
    let forward = DVec3::new(0.1, 0.05, -1.0);
    let camera = match near {
        false => Camera::Orthographic { forward, target: None, up: DVec3::Y },
        true => Camera::Perspective {
            eye: DVec3::new(5.0, 4.0, 3.0),
            target: Some(DVec3::new(4.0, 5.0, 0.0)),
            up: DVec3::Y,
            near: Some(1.5),
            fov_y_degrees: 60.0,
        },
    };
    let run = Run::default();
    let view = camera.view(mesh.bounds()).expect("a view");
    let options = FeatureOptions::default();
    let prepared = PreparedView::new::<Exact>(&mesh, &view, &options, &run).expect("a view");
    let question = prepared.question(false);
    let options = PainterOptions::default();
    let mut order = paint_order::<Exact>(&question, &options, &run).expect("an order");
    change(&question, &mut order);
    let faces = Faces::new(&question);
    let mut report = PaintReport::default();
    report.row(options.painter, &order);
    if !near {
        check_areas::<Exact>(&question, &faces, &order, &mut report, &Run::default()).unwrap();
    }
    check_pairs::<Exact>(&view, &question, &faces, &order, &mut report, &run).expect("pairs");
    let count = mesh.vertices().len() as u32;
    let samples = Samples::around(&view.frame, question.coordinates, count, 50).expect("samples");
    let sampled = Sampled::new(&view, &question, &samples);
    let buffer = ray_cast::<Exact>(&view, &question, &samples, &run).expect("an image");
    check_owners::<Exact>(&sampled, &faces, &order, &buffer, &mut report, &run).expect("owners");
    report
}

#[test]
fn orders_are_found_right() {
    for near in [false, true] {
        let report = report(near, |_, _| {});
        assert!(report.is_clean(), "{report}");
        let row = report.rows[0];
        assert!(row.order.agree > 2 && row.owner.agree > 1000, "{report}");
        // What a near plane leaves of faces has no area that is known.
        assert_eq!(row.area.agree, if near { 0 } else { 4 });
        assert!(near || row.cuts >= 2, "{report}");
    }
}

#[test]
fn a_piece_that_is_lost_or_painted_twice_is_found() {
    let lost = report(false, |_, order| {
        order.pieces.pop();
    });
    assert!(lost.rows[0].area.differ == 1 && lost.rows[0].owner.differ > 0, "{lost}");
    let twice = report(false, |_, order| order.pieces.push(order.pieces[0].clone()));
    assert!(twice.rows[0].area.differ == 1 && twice.rows[0].order.differ > 0, "{twice}");
}

#[test]
fn pieces_in_a_wrong_order_are_found() {
    for near in [false, true] {
        let turned = report(near, |_, order| order.pieces.reverse());
        assert!(!turned.is_clean());
        let row = turned.rows[0];
        assert!(row.order.differ > 2 && row.owner.differ > 20 && row.area.differ == 0, "{turned}");
    }
}

#[test]
fn half_a_piece_is_found_by_its_area() {
    let halved = report(false, |question, order| {
        let predicates = Predicates::<Exact>::new(question.points);
        let plane = crate::kernel::predicates::InputPlane::Across(14, 0).into();
        let cut = |piece: &mut PaintedPiece| match piece.polygon.cut(&predicates, plane) {
            Cut::Parted([below, _]) => {
                piece.polygon = below;
                true
            }
            _ => false,
        };
        assert!(order.pieces.iter_mut().any(cut));
    });
    assert_eq!(halved.rows[0].area.differ, 1, "{halved}");
}

#[test]
fn an_order_by_depths_is_found_out() {
    let mesh = bars();
    let run = Run::default();
    let camera = Camera::Orthographic { forward: -DVec3::Z, target: None, up: DVec3::Y };
    let view = camera.view(mesh.bounds()).expect("a view");
    let options = FeatureOptions::default();
    let prepared = PreparedView::new::<Exact>(&mesh, &view, &options, &run).expect("a view");
    let question = prepared.question(false);
    let verified = |fault| {
        let options = PaintVerifyOptions { fault, ..PaintVerifyOptions::default() };
        verify_painting::<Exact>(&view, &question, &options, &run).expect("a report")
    };
    let right = verified(None);
    assert!(right.is_clean() && right.rows.len() == 3, "{right}");
    let wrong = verified(Some(PainterFault::DepthOnly));
    assert!(wrong.rows.iter().all(|row| row.order.differ > 0 && row.owner.differ > 0), "{wrong}");
}
