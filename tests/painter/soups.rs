//! Random scenes on a small grid, where everything coincides that can: what
//! is on top is what integers say is nearest, and the order is proved whole.

use crate::oracle::{Topmost, seen};
use crate::whole_check::check;
use crate::{mesh, painted, towards, with_question};
use glam::DVec3;
use proptest::prelude::*;
use umriss::model::Camera;
use umriss::visibility::Painter;

fn coordinate() -> impl Strategy<Value = [i32; 3]> {
    (-2..3_i32, -2..3_i32, -2..3_i32).prop_map(|(x, y, z)| [x, y, z])
}

/// Corners of a face as sums of steps u and v from a place: a triangle, a
/// parallelogram, an L or a U.
const SHAPES: [&[[i32; 2]]; 4] = [
    &[[0, 0], [1, 0], [0, 1]],
    &[[0, 0], [1, 0], [1, 1], [0, 1]],
    &[[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]],
    &[[0, 0], [3, 0], [3, 2], [2, 2], [2, 1], [1, 1], [1, 2], [0, 2]],
];

pub(crate) fn face() -> impl Strategy<Value = Vec<[f64; 3]>> {
    (0..SHAPES.len(), coordinate(), coordinate(), coordinate()).prop_map(|(shape, p, u, v)| {
        let corner = |&[i, j]: &[i32; 2]| {
            [0, 1, 2].map(|axis| f64::from(p[axis] + i * u[axis] + j * v[axis]))
        };
        SHAPES[shape].iter().map(corner).collect()
    })
}

/// Parallel rays along any direction of the grid, or an eye above the scene
/// or within it, with a near plane that cuts faces.
pub(crate) fn camera() -> impl Strategy<Value = Camera> {
    let parallel = coordinate().prop_map(|forward| {
        let forward = if forward == [0; 3] { [0, 0, -1] } else { forward };
        towards(forward.map(f64::from))
    });
    let central = (coordinate(), 0..2_i32, 1..5_i32).prop_map(|([x, y, z], height, near)| {
        let eye = DVec3::new(f64::from(x) + 0.25, f64::from(y) - 0.125, f64::from(z + 7 * height));
        Camera::Perspective {
            eye,
            target: Some(eye - DVec3::Z),
            up: DVec3::Y,
            near: Some(f64::from(near) * 0.25),
            fov_y_degrees: 60.0,
        }
    });
    prop_oneof![parallel, central]
}

/// Samples on a grid as fine as the oracle's, well in front of any eye.
fn samples() -> impl Strategy<Value = Vec<DVec3>> {
    let one = (-255..256_i32, -255..256_i32, -255..256_i32)
        .prop_map(|(x, y, z)| DVec3::new(x.into(), y.into(), z.into()) / 64.0);
    prop::collection::vec(one, 40)
}

fn painter() -> impl Strategy<Value = Painter> {
    prop::sample::select(Painter::ALL.to_vec())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn the_topmost_face_is_the_nearest(
        faces in prop::collection::vec(face(), 1..9),
        camera in camera(),
        samples in samples(),
        painter in painter(),
    ) {
        let soup = std::panic::catch_unwind(|| mesh(&faces));
        let Ok(mesh) = soup else { return Ok(()) };
        let view = camera.view(mesh.bounds()).unwrap();
        // In perspective any sample in front of the eye does; below it all are.
        let samples: Vec<DVec3> = match camera {
            Camera::Perspective { eye, .. } => {
                samples.iter().map(|s| DVec3::new(eye.x + s.x, eye.y + s.y, eye.z - 1.0)).collect()
            }
            _ => samples,
        };
        with_question(&mesh, &camera, |question| {
            let (order, _) = painted(question, painter);
            check(question, &order);
            let topmost = Topmost::new(&mesh, &view, &samples);
            for (i, &sample) in samples.iter().enumerate() {
                if let Some(seen) = seen(&mesh, &view, sample) {
                    let seen = seen.map(|triangle| mesh.face_of(triangle));
                    assert_eq!(topmost.face(&order, i), seen, "{painter:?} at {sample}");
                }
            }
        });
    }
}
