//! Scenes whose number of cuts is known.

use crate::whole_check::check;
use crate::{above, count, mesh, painted, towards, with_question};
use glam::DVec3;
use umriss::model::{Camera, Mesh, Soup};
use umriss::view::PaintOrder;
use umriss::visibility::{Painter, PainterOptions, painted_image};

/// Cuts and pieces of each way, after the order has been proved.
fn tried(mesh: &Mesh, camera: &Camera) -> Vec<(usize, PaintOrder)> {
    with_question(mesh, camera, |question| {
        let orders = Painter::ALL.map(|painter| {
            let (order, counters) = painted(question, painter);
            check(question, &order);
            assert_eq!(count(&counters, "painter-cuts"), order.cuts as u64);
            (order.cuts, order)
        });
        orders.into()
    })
}

fn cuts(mesh: &Mesh, camera: &Camera) -> Vec<usize> {
    tried(mesh, camera).into_iter().map(|(cuts, _)| cuts).collect()
}

fn three_bars() -> Vec<Vec<[f64; 3]>> {
    vec![
        vec![[0.0, 0.0, 0.0], [10.0, 0.0, 2.0], [10.0, 1.0, 2.0], [0.0, 1.0, 0.0]],
        vec![[9.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 10.0, 2.0], [9.0, 10.0, 2.0]],
        vec![[0.0, 1.0, 2.0], [1.0, 0.0, 2.0], [10.0, 9.0, 0.0], [9.0, 10.0, 0.0]],
    ]
}

#[test]
fn three_bars_each_over_the_next_take_one_cut() {
    let tried = tried(&mesh(&three_bars()), &above());
    assert_eq!((tried[0].0, tried[0].1.pieces.len()), (1, 4));
    assert!(tried.iter().all(|(cuts, order)| *cuts >= 1 && order.pieces.len() == 3 + cuts));
    // From the side nothing is in a cycle.
    assert_eq!(cuts(&mesh(&three_bars()), &towards([1.0, 7.0, 0.0]))[0], 0);
}

fn level(x: [f64; 2], y: [f64; 2], z: f64) -> Vec<[f64; 3]> {
    vec![[x[0], y[0], z], [x[1], y[0], z], [x[1], y[1], z], [x[0], y[1], z]]
}

#[test]
fn crossing_squares_take_exactly_one_cut() {
    let steep = vec![[1.0, 0.0, 0.0], [3.0, 0.0, 4.0], [3.0, 4.0, 4.0], [1.0, 4.0, 0.0]];
    let scene = mesh(&[level([0.0, 4.0], [0.0, 4.0], 2.0), steep]);
    for camera in [above(), towards([1.0, 2.0, -9.0])] {
        for (cuts, order) in tried(&scene, &camera) {
            assert_eq!((cuts, order.pieces.len()), (1, 3));
        }
    }
}

#[test]
fn parallel_squares_are_painted_by_depth_without_a_cut() {
    // Apart in the image, too: those are sorted as well.
    for step in [0.25, 3.0] {
        let square = |i: u32| {
            let x = f64::from(i) * step;
            level([x, x + 2.0], [0.0, 2.0], f64::from(i * 7 % 12))
        };
        let scene = mesh(&(0..12).map(square).collect::<Vec<_>>());
        for (i, (cuts, order)) in tried(&scene, &above()).into_iter().enumerate() {
            assert_eq!(cuts, 0);
            let depths: Vec<u32> = order.pieces.iter().map(|piece| piece.face * 7 % 12).collect();
            assert_eq!(depths, (0..12).collect::<Vec<_>>(), "{:?}", Painter::ALL[i]);
        }
    }
}

/// A square, turned a little, over the next one of a ring of many.
#[test]
fn a_ring_of_slopes_is_opened_by_one_cut() {
    let slope = |[x, y]: [f64; 2], [u, v]: [f64; 2]| -> Vec<[f64; 3]> {
        // Along (u, v), rising; one unit wide.
        let corner = |along: f64, across: f64| {
            [x + along * u - across * v, y + along * v + across * u, along]
        };
        vec![corner(-1.0, 0.0), corner(7.0, 0.0), corner(7.0, 1.0), corner(-1.0, 1.0)]
    };
    let scene = mesh(&[
        slope([0.0, 0.0], [1.0, 0.0]),
        slope([6.0, 0.0], [0.0, 1.0]),
        slope([6.0, 6.0], [-1.0, 0.0]),
        slope([0.0, 6.0], [0.0, -1.0]),
    ]);
    assert_eq!(cuts(&scene, &above())[0], 1);
}

/// Two U shapes of which each lies over one arm of the other.
fn interlocked() -> Vec<Vec<[f64; 3]>> {
    let outline = [
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 4.0],
        [3.0, 4.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 4.0],
        [0.0, 4.0],
    ];
    let first = outline.map(|[x, y]| [x, y, x]).to_vec();
    let second = outline.map(|[x, y]| [x, 5.0 - y, 3.0 - 0.5 * x]).to_vec();
    vec![first, second]
}

#[test]
fn interlocked_shapes_need_no_cut_but_their_parts() {
    let scene = mesh(&interlocked());
    let tried = tried(&scene, &above());
    assert_eq!(tried[0].0, 0, "the arms are parts of their own");
    with_question(&scene, &above(), |question| {
        let (faces, _) = painted_image(question, &tried[0].1).unwrap();
        // Neither is painted in one go, or the one would cover the other.
        assert!(faces.len() > 2);
    });
}

fn cube([x, y, z]: [f64; 3], size: f64) -> Vec<Vec<[f64; 3]>> {
    let corner = |i: u32| {
        let bit = |k: u32| f64::from(i >> k & 1) * size;
        [x + bit(0), y + bit(1), z + bit(2)]
    };
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    faces.iter().map(|face| face.map(corner).to_vec()).collect()
}

#[test]
fn touching_cubes_need_no_cut() {
    let mut faces = cube([0.0; 3], 2.0);
    faces.extend(cube([2.0, 0.0, 0.0], 2.0));
    faces.extend(cube([1.0, 1.0, 2.0], 1.0));
    let scene = mesh(&faces);
    for forward in [[0.0, 0.0, -1.0], [-1.0, 2.0, -3.0], [1.0, 1.0, -1.0], [1.0, 0.0, 0.0]] {
        assert_eq!(cuts(&scene, &towards(forward))[0], 0, "{forward:?}");
    }
}

#[test]
fn cubes_that_pass_through_one_another_are_cut() {
    let mut faces = cube([0.0; 3], 4.0);
    faces.extend(cube([1.0, 2.0, 3.0], 4.0));
    let cuts = cuts(&mesh(&faces), &towards([-3.0, 2.0, -4.0]));
    assert!(cuts.iter().all(|&cuts| cuts > 0), "{cuts:?}");
}

#[test]
fn coplanar_overlaps_go_by_the_tie_rule() {
    let mut faces = vec![
        level([0.0, 3.0], [0.0, 3.0], 1.0),
        level([1.0, 4.0], [-1.0, 2.0], 1.0),
        level([2.0, 6.0], [1.0, 5.0], 1.0),
        vec![[0.0, 1.0, 1.0], [5.0, 1.0, 1.0], [0.0, 5.0, 1.0]],
    ];
    let first = cuts(&mesh(&faces), &above());
    assert_eq!(first, [0, 0, 0]);
    faces.reverse();
    for face in &mut faces {
        face.reverse();
    }
    assert_eq!(cuts(&mesh(&faces), &above()), [0, 0, 0]);
    assert_eq!(cuts(&mesh(&faces), &towards([1.0, 1.0, 3.0])), [0, 0, 0]);
}

/// A plate with a hole and a concave one, above it a bar that ends over the
/// hole.
fn plates() -> Mesh {
    let at = |places: &[[f64; 2]], z: f64| -> Vec<DVec3> {
        places.iter().map(|[x, y]| DVec3::new(*x, *y, z)).collect()
    };
    let mut soup = Soup::default();
    soup.vertices.extend(at(&[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]], 0.0));
    soup.vertices.extend(at(&[[3.0, 3.0], [3.0, 6.0], [6.0, 6.0], [6.0, 3.0]], 0.0));
    let corner = [[10.0, 0.0], [14.0, 0.0], [14.0, 4.0], [12.0, 4.0], [12.0, 2.0], [10.0, 2.0]];
    soup.vertices.extend(at(&corner, 0.0));
    soup.vertices.extend(at(&[[4.0, 4.0], [11.0, 4.0], [11.0, 5.0], [4.0, 5.0]], 1.0));
    soup.faces.push(&[0, 1, 2, 3], [&[4, 5, 6, 7][..]]);
    soup.faces.push(&[8, 9, 10, 11, 12, 13], []);
    soup.faces.push(&[14, 15, 16, 17], []);
    Mesh::new(vec![soup], None).unwrap()
}

#[test]
fn concave_faces_and_holes_are_printed_whole() {
    let scene = plates();
    for (cuts, order) in tried(&scene, &above()).into_iter().take(1) {
        assert_eq!(cuts, 0);
        assert!(order.pieces.len() > 3, "they are several convex parts");
        with_question(&scene, &above(), |question| {
            let (faces, lines) = painted_image(question, &order).unwrap();
            let mut shapes: Vec<(u32, Vec<usize>)> = faces
                .iter()
                .map(|face| {
                    let rings = face.region.polygons.iter().flatten();
                    (face.region.face, rings.map(Vec::len).collect())
                })
                .collect();
            shapes.sort();
            assert_eq!(shapes, [(0, vec![4, 4]), (1, vec![6]), (2, vec![4])]);
            // All edges are boundaries, and no inner one is among them.
            assert_eq!(lines.pieces.len(), 8 + 6 + 4);
            assert_eq!(faces.iter().map(|face| face.lines.len()).sum::<usize>(), 18);
        });
    }
}

#[test]
fn sides_that_cuts_made_are_not_drawn() {
    let scene = mesh(&three_bars());
    with_question(&scene, &above(), |question| {
        let (order, _) = painted(question, Painter::Graph);
        let (faces, lines) = painted_image(question, &order).unwrap();
        assert_eq!(faces.len(), 4);
        // Each cut parts two sides and adds none.
        assert_eq!(lines.pieces.len(), 12 + 2 * order.cuts);
    });
}

#[test]
fn faces_end_at_the_near_plane() {
    let floor = level([-9.0, 9.0], [-9.0, 9.0], 0.0);
    let wall = vec![[-1.0, 4.0, 0.0], [1.0, 4.0, 0.0], [1.0, 4.0, 2.0], [-1.0, 4.0, 2.0]];
    let scene = mesh(&[floor, wall]);
    let camera = Camera::Perspective {
        eye: DVec3::new(0.0, 0.0, 1.0),
        target: Some(DVec3::new(0.0, 1.0, 1.0)),
        up: DVec3::Z,
        near: Some(0.5),
        fov_y_degrees: 60.0,
    };
    for (cuts, order) in tried(&scene, &camera) {
        assert_eq!(cuts, order.pieces.len() - 2);
        with_question(&scene, &camera, |question| {
            let (faces, _) = painted_image(question, &order).unwrap();
            let places = faces.iter().filter(|face| face.region.face == 0);
            let places = places.flat_map(|face| face.region.polygons.iter().flatten().flatten());
            // One below the eye, half in front of it.
            assert_eq!(places.map(|place| place.y).fold(0.0, f64::min), -2.0);
        });
    }
}

#[test]
fn a_perspective_without_a_near_plane_is_refused() {
    let scene = mesh(&three_bars());
    let camera = Camera::Perspective {
        eye: DVec3::new(3.0, 4.0, 50.0),
        target: None,
        up: DVec3::Y,
        near: None,
        fov_y_degrees: 60.0,
    };
    let mut view = camera.view(scene.bounds()).unwrap();
    view.near = None;
    let run = umriss::run::Run::default();
    let options = umriss::model::FeatureOptions::default();
    let prepared = umriss::view::PreparedView::new::<umriss::kernel::predicates::Exact>(
        &scene, &view, &options, &run,
    );
    for painter in Painter::ALL {
        let found = umriss::visibility::paint_order::<umriss::kernel::predicates::Exact>(
            &prepared.as_ref().unwrap().question(false),
            &PainterOptions { painter, ..PainterOptions::default() },
            &run,
        );
        assert_eq!(found, Err(umriss::visibility::PainterError::NoNearPlane));
    }
}

#[test]
fn tests_grow_with_the_faces_where_images_do_not_overlap() {
    let tests = |size: u32| {
        // A terrain: all depths overlap, no images do.
        let height = |x: u32, y: u32| f64::from(x * 7 % 5 + y * 3 % 4);
        let at = |x: u32, y: u32| [f64::from(x), f64::from(y), height(x, y)];
        let cells = (0..size).flat_map(|x| (0..size).map(move |y| (x, y)));
        let faces = cells.flat_map(|(x, y)| {
            let corners = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
            [vec![corners[0], corners[1], corners[2]], vec![corners[0], corners[2], corners[3]]]
        });
        let scene = mesh(&faces.collect::<Vec<_>>());
        with_question(&scene, &above(), |question| {
            let (order, counters) = painted(question, Painter::Graph);
            assert_eq!(order.cuts, 0);
            count(&counters, "painter-tests-2d-images")
        })
    };
    let (small, large) = (tests(20), tests(80));
    assert!(large < 20 * small, "{small} and {large} for sixteen times as many faces");
}
