//! What is skipped changes nothing: the pieces of every line are the same,
//! symbol by symbol, whichever shortcuts are taken.

#![allow(clippy::unwrap_used)]

use glam::{DVec3, dvec3};
use proptest::prelude::*;
use umriss::kernel::predicates::Exact;
use umriss::model::{Camera, FeatureOptions, LineClass, Mesh, Soup, import};
use umriss::run::Run;
use umriss::view::{ExactLines, PreparedView};
use umriss::visibility::{AppelOptions, Culling, Skips, appel};

/// All combinations that are worth it; the first takes no shortcut.
fn combinations() -> Vec<Skips> {
    let none = Skips { culling: Culling::Never, early: false, carry: false };
    vec![
        none,
        Skips { early: true, ..none },
        Skips { carry: true, ..none },
        Skips { culling: Culling::Always, ..none },
        Skips { culling: Culling::Always, early: true, carry: true },
        Skips::default(),
    ]
}

/// The visible pieces with each combination, and how many lines were culled.
fn answers(mesh: &Mesh, camera: &Camera) -> (Vec<ExactLines>, u64) {
    let view = camera.view(mesh.bounds()).unwrap();
    let options = FeatureOptions::default().with_classes(&LineClass::ALL);
    let (run, mut covered) = (Run::default(), 0);
    let prepared = PreparedView::new::<Exact>(mesh, &view, &options, &run).unwrap();
    let question = prepared.question(false);
    let answer = |skips| {
        let run = Run::default();
        let options = AppelOptions { skips, ..AppelOptions::default() };
        let answer = appel::<Exact>(&question, &options, &run).unwrap();
        covered += run.counters().get("lines-covered");
        answer
    };
    (combinations().into_iter().map(answer).collect(), covered)
}

fn all_same(answers: &[ExactLines]) -> bool {
    answers.iter().all(|answer| *answer == answers[0])
}

fn parallel(forward: DVec3) -> Camera {
    Camera::Orthographic { forward, target: None, up: DVec3::new(0.1, 0.2, 1.0) }
}

#[test]
fn models_have_the_same_pieces_whatever_is_skipped() {
    let mut culled = 0;
    let names = [
        "bar_heap",
        "bad_soup",
        "menger_2",
        "voxel_city",
        "staircase",
        "nested_cubes",
        "needle_cone",
        "cube_row_touching",
        "coplanar_quads",
        "torus_2k",
        "terrain_20",
        "gear24_off1e6",
        "woven",
        "cube_1e9",
        "cube_1e-9",
    ];
    for name in names {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/");
        let soups =
            import::read_file(format!("{folder}{name}.obj").as_ref(), None).unwrap().objects;
        let mesh = Mesh::new(soups, None).unwrap();
        let (low, high) = mesh.bounds();
        let (middle, reach) = ((low + high) / 2.0, (high - low).length());
        let eye = middle + dvec3(0.5, -0.3, 0.4) * reach;
        let (target, up) = (Some(middle), DVec3::Z);
        for camera in [
            parallel(dvec3(-1.0, -1.0, -1.0)),
            parallel(DVec3::NEG_Y),
            Camera::Perspective { eye, target, up, near: None, fov_y_degrees: 50.0 },
            Camera::Perspective {
                eye: middle,
                target: Some(eye),
                up,
                near: None,
                fov_y_degrees: 90.0,
            },
        ] {
            let (answers, covered) = answers(&mesh, &camera);
            assert!(all_same(&answers), "{name} {camera:?}");
            culled += covered;
        }
    }
    assert!(culled > 10_000, "only {culled} lines were culled: nothing was tested");
}

/// Squares behind one another, each of two triangles, turned and moved.
fn layers(count: usize, moves: &[(i32, i32, i32)]) -> Mesh {
    let mut soup = Soup::default();
    for (layer, &(x, y, turn)) in (0..count).zip(moves.iter().cycle()) {
        let first = soup.vertices.len() as u32;
        for [u, v] in [[-8, -8], [8, -8], [8, 8], [-8, 8]] {
            let [u, v, w] = [u + x, v + y, 4 * layer as i32 + turn * (u - v) / 8];
            soup.vertices.push(DVec3::from([u, v, w].map(f64::from)));
        }
        soup.faces.push(&[first, first + 1, first + 2], []);
        soup.faces.push(&[first, first + 2, first + 3], []);
    }
    Mesh::new(vec![soup], None).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn layers_have_the_same_pieces_whatever_is_skipped(
        moves in prop::collection::vec((-6..6_i32, -6..6_i32, -1..2_i32), 1..9),
        askew in (-2..3_i32, -2..3_i32),
        near in any::<bool>(),
    ) {
        let mesh = layers(12, &moves);
        let away = dvec3(f64::from(askew.0), f64::from(askew.1), 0.0);
        let (answers, _) = answers(&mesh, &match near {
            false => Camera::Orthographic { forward: away / 16.0 - DVec3::Z, target: None, up: DVec3::Y },
            true => Camera::Perspective {
                eye: away + DVec3::Z * 70.0, target: None, up: DVec3::Y, near: None, fov_y_degrees: 45.0,
            },
        });
        prop_assert!(all_same(&answers));
    }
}

#[test]
fn what_lies_behind_a_triangle_is_culled_and_what_lies_before_it_is_not() {
    let square = |middle: DVec3, half: f64| {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let mut soup = Soup::default();
        soup.vertices.extend(corners.map(|[u, v]| middle + dvec3(u, v, 0.0) * half));
        soup.faces.push(&[0, 1, 2], []);
        soup.faces.push(&[0, 2, 3], []);
        soup
    };
    for (height, culled) in [(-1.0, 4), (0.0, 0), (1.0, 0)] {
        let soups = vec![square(DVec3::ZERO, 8.0), square(dvec3(4.0, -4.0, height), 1.0)];
        let mesh = Mesh::new(soups, None).unwrap();
        let camera = Camera::Orthographic { forward: DVec3::NEG_Z, target: None, up: DVec3::Y };
        let (answers, covered) = answers(&mesh, &camera);
        assert!(all_same(&answers));
        // Two of the combinations cull so few lines; diagonals are lines too.
        assert_eq!(covered, 2 * if culled > 0 { culled + 1 } else { 0 }, "{height}");
    }
}
