//! What is skipped changes nothing: the pieces of every line are the same,
//! symbol by symbol, whichever shortcuts are taken.

#![allow(clippy::unwrap_used)]

use glam::{DVec2, DVec3, dvec3};
use proptest::prelude::*;
use umriss::kernel::predicates::Exact;
use umriss::model::{Camera, FeatureOptions, LineClass, LineOrigin, Mesh, Soup, import};
use umriss::run::Run;
use umriss::view::{ExactPiece, LineQuestion, ObjectWish, PreparedView};
use umriss::visibility::{AppelOptions, Culling, Skips, appel};

/// All combinations that are worth it; the first takes no shortcut.
fn combinations() -> Vec<Skips> {
    let none = Skips { culling: Culling::Never, early: false, carry: false, convex: false };
    vec![
        none,
        Skips { early: true, ..none },
        Skips { carry: true, ..none },
        Skips { culling: Culling::Always, ..none },
        Skips { convex: true, ..none },
        Skips { culling: Culling::Always, ..Skips::default() },
        Skips::default(),
    ]
}

/// What was left out on the way.
#[derive(Debug, Default)]
struct LeftOut {
    /// Lines, by views that were prepared for all lines.
    covered: u64,
    /// Lines, by views that were prepared for visible ones.
    early: u64,
    triangles: u64,
    at_back: u64,
}

/// The visible pieces of the lines that have some, by what the lines are.
type Answer = Vec<(String, Vec<ExactPiece>)>;

fn answer(question: &LineQuestion<'_>, skips: Skips, run: &Run) -> Answer {
    let options = AppelOptions { skips, ..AppelOptions::default() };
    let answer = appel::<Exact>(question, &options, run).unwrap();
    let lines = question.lines.iter().enumerate().filter_map(|(index, line)| {
        let name = match line.origin {
            LineOrigin::Intersection(index) => {
                format!("{:?}", question.intersections[index as usize])
            }
            own => format!("{own:?}"),
        };
        let pieces = answer.line(index).to_vec();
        (!pieces.is_empty()).then_some((name, pieces))
    });
    lines.collect()
}

/// The visible pieces with each combination, and what was left out.
fn answers(mesh: &Mesh, camera: &Camera) -> (Vec<Answer>, LeftOut) {
    let view = camera.view(mesh.bounds()).unwrap();
    let wish = ObjectWish {
        features: FeatureOptions::default().with_classes(&LineClass::ALL),
        see_through: false,
    };
    let wishes = vec![wish; mesh.objects().len()];
    let run = Run::default();
    let prepare =
        |skips| PreparedView::with_skips::<Exact>(mesh, &view, &wishes, &skips, &run).unwrap();
    let prepared = [false, true].map(|convex| prepare(Skips { convex, ..Skips::default() }));
    let [searched, question] = [0, 1].map(|i| prepared[i].question(false));
    assert_eq!(searched.lines, question.lines);
    assert_eq!(searched.intersections, question.intersections);
    assert_eq!(searched.piercings, question.piercings);
    assert_eq!(searched.contacts.unwrap().touching, question.contacts.unwrap().touching);
    let mut left_out = LeftOut::default();
    let combinations = combinations();
    let mut answers = vec![answer(&searched, combinations[0], &run)];
    for &skips in &combinations {
        let run = Run::default();
        answers.push(answer(&question, skips, &run));
        left_out.covered += run.counters().get("lines-covered");
        left_out.at_back += run.counters().get("lines-at-back");
        let run = Run::default();
        let alone =
            PreparedView::for_visible_lines::<Exact>(mesh, &view, &wishes, &skips, &run).unwrap();
        answers.push(answer(&alone.question(false), skips, &run));
        left_out.early += run.counters().get("lines-covered");
        left_out.triangles += run.counters().get("triangles-covered");
    }
    (answers, left_out)
}

fn all_same(answers: &[Answer]) -> bool {
    answers.iter().all(|answer| *answer == answers[0])
}

fn parallel(forward: DVec3) -> Camera {
    Camera::Orthographic { forward, target: None, up: DVec3::new(0.1, 0.2, 1.0) }
}

#[test]
fn models_have_the_same_pieces_whatever_is_skipped() {
    let (mut culled, mut early, mut at_back) = (0, 0, 0);
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
            let (answers, left_out) = answers(&mesh, &camera);
            assert!(all_same(&answers), "{name} {camera:?}");
            culled += left_out.covered;
            early += left_out.early;
            at_back += left_out.at_back;
        }
    }
    assert!(culled > 10_000, "only {culled} lines were culled: nothing was tested");
    assert!(early > 10_000, "only {early} lines were culled early: nothing was tested");
    assert!(at_back > 1000, "only {at_back} lines were at the back: nothing was tested");
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
        let (answers, left_out) = answers(&mesh, &camera);
        assert!(all_same(&answers));
        // Two of the combinations cull so few lines; diagonals are lines too.
        let lines = 2 * if culled > 0 { culled + 1 } else { 0 };
        assert_eq!([left_out.covered, left_out.early], [lines; 2], "{height}");
        assert_eq!(left_out.triangles, if culled > 0 { 2 * 2 } else { 0 }, "{height}");
    }
}

/// A box with its corners moved, at a place: convex or not.
type Gem = ((i32, i32, i32), Vec<i32>);

/// Gems that may pass through one another, each an object or all one.
fn gems(gems: &[Gem], apart: bool) -> Mesh {
    const QUADS: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut soups = vec![Soup::default()];
    for ((x, y, z), moves) in gems {
        if apart {
            soups.push(Soup::default());
        }
        let soup = soups.last_mut().unwrap();
        let first = soup.vertices.len() as u32;
        for corner in 0..8_i32 {
            let bit = |axis: i32| 6 * (corner >> axis & 1) + moves[(3 * corner + axis) as usize];
            let corner = [x + bit(0), y + bit(1), z + bit(2)];
            soup.vertices.push(DVec3::from(corner.map(f64::from)));
        }
        for [a, b, c, d] in QUADS.map(|quad| quad.map(|corner| first + corner)) {
            soup.faces.push(&[a, b, c], []);
            soup.faces.push(&[a, c, d], []);
        }
    }
    Mesh::new(soups, None).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]
    #[test]
    fn gems_have_the_same_pieces_whatever_is_skipped(
        some in prop::collection::vec(
            ((-8..9_i32, -8..9_i32, -8..9_i32), prop::collection::vec(-1..2_i32, 24)),
            1..9,
        ),
        moved in any::<bool>(),
        apart in any::<bool>(),
        eye in (-30..31_i32, -30..31_i32, -30..31_i32),
        parallel_rays in any::<bool>(),
        near in prop::option::of(1..20_i32),
    ) {
        let mut some = some;
        if !moved {
            some.iter_mut().for_each(|(_, moves)| moves.fill(0));
        }
        let mesh = gems(&some, apart);
        let eye = dvec3(f64::from(eye.0), f64::from(eye.1), f64::from(eye.2)) / 4.0 + 0.125;
        let camera = match parallel_rays {
            true => parallel(-eye),
            false => Camera::Perspective {
                eye,
                target: Some(DVec3::ZERO),
                up: dvec3(0.1, 0.2, 1.0),
                near: near.map(f64::from),
                fov_y_degrees: 60.0,
            },
        };
        let (answers, _) = answers(&mesh, &camera);
        prop_assert!(all_same(&answers));
    }

    #[test]
    fn what_lies_in_the_window_has_the_same_pieces(
        some in prop::collection::vec(
            ((-8..9_i32, -8..9_i32, -8..9_i32), prop::collection::vec(-1..2_i32, 24)),
            1..9,
        ),
        corner in (-8..8_i32, -8..8_i32),
        size in (1..9_i32, 1..9_i32),
        parallel_rays in any::<bool>(),
    ) {
        let mesh = gems(&some, false);
        let camera = match parallel_rays {
            // Images of corners have whole coordinates and meet the border.
            true => Camera::Orthographic {
                forward: DVec3::NEG_Z, target: Some(DVec3::ZERO), up: DVec3::Y,
            },
            false => Camera::Perspective {
                eye: DVec3::new(0.0, 0.0, 9.5), target: Some(DVec3::ZERO), up: DVec3::Y,
                near: None, fov_y_degrees: 60.0,
            },
        };
        let view = camera.view(mesh.bounds()).unwrap();
        let classes = FeatureOptions::default().with_classes(&LineClass::ALL);
        let run = Run::default();
        let prepared = PreparedView::new::<Exact>(&mesh, &view, &classes, &run).unwrap();
        let unit = if parallel_rays { 1.0 } else { 0.125 };
        let low = DVec2::new(f64::from(corner.0), f64::from(corner.1)) * unit;
        let high = low + DVec2::new(f64::from(size.0), f64::from(size.1)) * unit;
        for hidden in [false, true] {
            let whole = prepared.question(hidden);
            let part = whole.within(low, high);
            let run = Run::default();
            let options = AppelOptions::default();
            let [all, some] = [&whole, &part].map(|question| {
                appel::<Exact>(question, &options, &run).unwrap()
            });
            let mut left_out = 0;
            for (line, feature) in whole.lines.iter().enumerate() {
                if some.line(line) == all.line(line) {
                    continue;
                }
                prop_assert!(some.line(line).is_empty());
                prop_assert!(is_outside(&whole, feature.origin, low, high));
                left_out += 1;
            }
            prop_assert!(left_out <= run.counters().get("lines-outside"));
        }
    }
}

/// Whether a line lies wholly to one side of a window.
fn is_outside(question: &LineQuestion<'_>, line: LineOrigin, low: DVec2, high: DVec2) -> bool {
    let beside = |vertices: &[u32]| {
        let images = vertices
            .iter()
            .map(|&vertex| question.coordinates.project(question.coordinates.point(vertex)).0);
        (0..2).any(|axis| {
            images.clone().all(|image| image[axis] < low[axis])
                || images.clone().all(|image| high[axis] < image[axis])
        })
    };
    match line {
        LineOrigin::Intersection(index) => question.intersections[index as usize]
            .triangles
            .iter()
            .any(|&triangle| beside(&question.mesh.triangles()[triangle as usize])),
        _ => line.vertices(question.mesh).is_some_and(|ends| beside(&ends)),
    }
}

/// A torus of a hundred thousand triangles, with huge ones in front of it,
/// behind it and through it.
fn torus_among_huge_triangles() -> Mesh {
    let (around, tube) = (400, 125);
    let mut soup = Soup::default();
    for i in 0..around {
        for j in 0..tube {
            let [u, v] = [(i, around), (j, tube)]
                .map(|(i, count)| std::f64::consts::TAU * f64::from(i) / f64::from(count));
            let radius = 1.0 + 0.4 * v.cos();
            soup.vertices.push(dvec3(radius * u.cos(), radius * u.sin(), 0.4 * v.sin()));
        }
    }
    for i in 0..around {
        for j in 0..tube {
            let at = |i: i32, j: i32| ((i % around) * tube + j % tube) as u32;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            soup.faces.push(&[a, b, c], []);
            soup.faces.push(&[a, c, d], []);
        }
    }
    for corners in [
        [dvec3(-9.0, -9.0, -20.0), dvec3(9.0, -8.0, -30.0), dvec3(0.0, 9.0, -25.0)],
        [dvec3(3.0, -9.0, -9.0), dvec3(4.0, 0.3, 9.0), dvec3(3.0, 0.1, -9.0)],
        [dvec3(-9.0, -9.0, 0.2), dvec3(9.0, -8.0, 0.3), dvec3(0.0, 9.0, -0.1)],
    ] {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend(corners);
        soup.faces.push(&[first, first + 1, first + 2], []);
    }
    Mesh::new(vec![soup], None).unwrap()
}

#[test]
fn few_lines_have_the_same_pieces_whichever_triangles_are_looked_at() {
    let mesh = torus_among_huge_triangles();
    let up = dvec3(0.1, 0.2, 1.0);
    let from = |eye, fov_y_degrees| Camera::Perspective {
        eye,
        target: Some(dvec3(0.1, 0.9, 0.1)),
        up,
        near: None,
        fov_y_degrees,
    };
    let classes = [LineClass::Contour, LineClass::Boundary, LineClass::Crease];
    let features = FeatureOptions::default().with_classes(&classes);
    let mut spared = 0;
    for camera in [
        parallel(dvec3(-1.0, -0.8, -0.6)),
        parallel(dvec3(0.0, 1.0, 0.05)),
        from(dvec3(6.0, -5.0, 4.0), 40.0),
        // From the inside of the tube.
        from(dvec3(1.0, 0.0, 0.1), 90.0),
    ] {
        let view = camera.view(mesh.bounds()).unwrap();
        for hidden in [false, true] {
            let run = Run::default();
            let prepared = PreparedView::new::<Exact>(&mesh, &view, &features, &run).unwrap();
            let question = prepared.question(hidden);
            assert!(!question.has_hierarchy());
            let options = AppelOptions::default();
            let some = appel::<Exact>(&question, &options, &run).unwrap();
            spared += u32::from(!question.has_hierarchy());
            question.hierarchy();
            let all = appel::<Exact>(&question, &options, &run).unwrap();
            assert!(some == all, "{camera:?}");
            assert!(all.piece_count() > 0, "{camera:?}");
        }
    }
    assert!(spared >= 4, "all triangles were looked at");
}
