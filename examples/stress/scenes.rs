//! Scenes that are hard for floats, each with eyes that make them harder.

use glam::{DVec3, dvec3};
use umriss::model::{Camera, Soup};

/// A scene and how it is seen.
pub(crate) struct Scene {
    pub(crate) name: &'static str,
    pub(crate) soup: Soup,
    pub(crate) cameras: Vec<Camera>,
}

/// Columns of a rotation times 9, so that integers stay integers.
const TURN: [DVec3; 3] = [dvec3(1.0, 8.0, 4.0), dvec3(-4.0, 4.0, -7.0), dvec3(-8.0, -1.0, 4.0)];

/// All scenes; the star has so many rays.
pub(crate) fn scenes(rays: i32) -> Vec<Scene> {
    let block = block(3);
    let turned = changed(&block, turn);
    let far = changed(&block, |p| p + DVec3::splat(f64::powi(2.0, 48)));
    let mut random = Random(1967);
    let nudged = changed(&block, |p| DVec3::from(p.to_array().map(|x| random.nudge(x))));
    let turned_nudged = changed(&turned, |p| DVec3::from(p.to_array().map(|x| random.nudge(x))));
    vec![
        scene("cubes, touching", block.clone(), general()),
        scene("the same along edges and faces", block.clone(), along(DVec3::X, DVec3::Y)),
        scene("the same from planes and corners", block.clone(), from_corners(&block)),
        scene("cubes, turned", turned.clone(), general()),
        scene(
            "the same along edges and faces",
            turned.clone(),
            along(turn(DVec3::X), turn(DVec3::Y)),
        ),
        scene("the same from planes and corners", turned.clone(), from_corners(&turned)),
        scene("cubes 2^48 away", far, general()),
        scene("cubes, each corner an ulp off", nudged, general()),
        scene("cubes, turned, an ulp off", turned_nudged, along(turn(DVec3::X), turn(DVec3::Y))),
        scene("coplanar squares, an ulp off", coplanar(&mut random), above()),
        scene("needles of aspect 1e12", needles(), general()),
        scene("sizes from 1e-300 to 1e300", nested(), general()),
        scene("a star of edges through one point", star(rays), above()),
        scene("all corners on a line", collinear(), general()),
    ]
}

fn scene(name: &'static str, soup: Soup, cameras: Vec<Camera>) -> Scene {
    Scene { name, soup, cameras }
}

/// Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % bound
    }

    /// The same number, the next one or the one before; zeros as if they
    /// were ones.
    fn nudge(&mut self, x: f64) -> f64 {
        match self.below(3) {
            0 if x == 0.0 => -f64::EPSILON,
            1 => x,
            _ if x == 0.0 => f64::EPSILON,
            0 => x.next_down(),
            _ => x.next_up(),
        }
    }
}

/// Eight times by [`TURN`].
fn turn(p: DVec3) -> DVec3 {
    (0..8).fold(p, |p, _| TURN[0] * p.x + TURN[1] * p.y + TURN[2] * p.z)
}

fn parallel(forward: DVec3) -> Camera {
    let up = if forward.x == 0.0 && forward.y == 0.0 { DVec3::Y } else { DVec3::Z };
    Camera::Orthographic { forward, target: None, up }
}

fn general() -> Vec<Camera> {
    [dvec3(-1.0, 1.0, -1.0), dvec3(0.3, 0.7, -0.2), dvec3(1.0, 2.0, 3.0)].map(parallel).into()
}

fn above() -> Vec<Camera> {
    vec![parallel(-DVec3::Z)]
}

/// Along an edge, and along the faces between two.
fn along(x: DVec3, y: DVec3) -> Vec<Camera> {
    [x, x + y, x * 2.0 - y].map(parallel).into()
}

/// Eyes in planes of faces, on lines of edges, and exactly in a corner.
fn from_corners(soup: &Soup) -> Vec<Camera> {
    let [a, b, d] = [0, 1, 2].map(|i| soup.vertices[i]);
    let middle = soup.vertices.iter().sum::<DVec3>() / soup.vertices.len() as f64;
    let eyes = [a * 3.0 - b * 2.0, a * 2.0 - b + (a - d), a];
    let camera = |eye: DVec3| Camera::Perspective {
        eye,
        target: Some(middle),
        up: DVec3::Z,
        near: None,
        fov_y_degrees: 60.0,
    };
    eyes.map(camera).into()
}

fn changed(soup: &Soup, mut change: impl FnMut(DVec3) -> DVec3) -> Soup {
    let vertices = soup.vertices.iter().map(|&vertex| change(vertex)).collect();
    Soup { vertices, ..soup.clone() }
}

/// Cubes in a block with some left out. Each has corners of its own.
fn block(side: i32) -> Soup {
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut soup = Soup::default();
    let places =
        (0..side).flat_map(|i| (0..side).flat_map(move |j| (0..side).map(move |k| [i, j, k])));
    for [i, j, k] in places.filter(|[i, j, k]| (i + 2 * j + 3 * k) % 5 < 3) {
        let first = soup.vertices.len() as u32;
        for corner in 0..8 {
            let bit = |axis: i32| f64::from(corner >> axis & 1);
            soup.vertices.push(dvec3(
                f64::from(i) + bit(0),
                f64::from(j) + bit(1),
                f64::from(k) + bit(2),
            ));
        }
        for face in faces {
            soup.faces.push(&face.map(|corner| first + corner), []);
        }
    }
    soup
}

fn triangle(soup: &mut Soup, corners: [DVec3; 3]) {
    let first = soup.vertices.len() as u32;
    soup.vertices.extend(corners);
    soup.faces.push(&[first, first + 1, first + 2], []);
}

/// Squares in one plane that overlap, heights an ulp off.
fn coplanar(random: &mut Random) -> Soup {
    let mut soup = Soup::default();
    for i in 0..24 {
        let (x, y) = (f64::from(i % 6) * 0.7, f64::from(i / 6) * 0.8);
        let mut at = |dx: f64, dy: f64| dvec3(x + dx, y + dy, random.nudge(0.1));
        let corners = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
        triangle(&mut soup, [corners[0], corners[1], corners[2]]);
        triangle(&mut soup, [corners[0], corners[2], corners[3]]);
    }
    soup
}

/// Triangles a million million times as long as they are wide, crossing.
fn needles() -> Soup {
    let mut soup = Soup::default();
    for i in 0..24 {
        let (turn, level) = (f64::from(i % 12), f64::from(i / 12));
        let end = dvec3(1e12 - turn * 1e9, turn * 8e10 - 4e11, level * 0.5);
        triangle(&mut soup, [DVec3::ZERO, end, end + dvec3(0.0, 1.0, 0.25)]);
        triangle(&mut soup, [-end, end, end + dvec3(0.0, 0.0, 1.0)]);
    }
    soup
}

/// Tetrahedra one within the other, each a huge factor larger.
fn nested() -> Soup {
    let mut soup = Soup::default();
    for exponent in [-300, -200, -100, -15, 0, 15, 100, 200, 300] {
        let size = f64::powi(10.0, exponent);
        let corners = [(3.0, 0.0, -1.0), (-1.0, 2.0, -1.0), (-1.0, -3.0, -1.0), (0.5, 0.25, 3.0)]
            .map(|(x, y, z)| dvec3(x, y, z) * size);
        for [a, b, c] in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] {
            triangle(&mut soup, [corners[a], corners[b], corners[c]]);
        }
    }
    soup
}

/// Triangles of which one side passes over the origin, each on its own level.
fn star(count: i32) -> Soup {
    let mut soup = Soup::default();
    for i in 0..count {
        let (x, y) = (f64::from(i % 47) - 23.0, f64::from(i / 47) - 5.0 + 0.5);
        let at = |share: f64, z: f64| dvec3(x * share, y * share, z);
        let level = f64::from(i);
        let ends = [at(-3.0, level), at(5.0, level + 0.125)];
        let side = dvec3(-y, x, 0.0) * 0.01;
        triangle(&mut soup, [ends[0], ends[1], ends[1] + side]);
    }
    soup
}

/// Triangles without an area along one line, behind and before a square.
fn collinear() -> Soup {
    let mut soup = Soup::default();
    let at = |share: f64| dvec3(1.0, 2.0, 3.0) * share;
    for i in 0..40 {
        let share = f64::from(i);
        triangle(&mut soup, [at(share), at(share + 3.0), at(share * 0.5 - 7.0)]);
    }
    let square = [dvec3(-9.0, -9.0, 6.0), dvec3(30.0, -9.0, 6.0), dvec3(30.0, 50.0, 6.0)];
    triangle(&mut soup, square);
    soup
}
