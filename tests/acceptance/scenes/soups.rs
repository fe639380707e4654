//! Random soups of one kind each, from general position to scenes in which
//! nearly every determinant is zero.

use super::{Random, cuboid, polygons};
use glam::DVec3;
use umriss::model::Soup;

/// How a soup is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Any triangles: general position, most of them interpenetrating.
    General,
    /// Triangles and quadrilaterals on a 4 x 4 x 4 grid: edge-on, coplanar,
    /// collinear, duplicate, touching in every way.
    Grid,
    /// Few grid points and many triangles between them: fans, non-manifold
    /// edges, faces that pass through one another at a common vertex.
    Pool,
    /// Boxes on the grid that touch, overlap and contain one another.
    Boxes,
    /// A few planes, askew and all over one another.
    Planes,
    /// Grid triangles turned by a rational rotation and scaled to integers:
    /// the grid's degeneracies without its axes.
    Turned,
    /// Grid triangles far from the origin, moved by single bits.
    Nearly,
    /// Rectangles and halves of them along the lines of the grid: sides that lie
    /// on one another in part, faces that cross along their sides.
    Cards,
}

impl Kind {
    pub(crate) const ALL: [Kind; 8] = [
        Kind::General,
        Kind::Grid,
        Kind::Pool,
        Kind::Boxes,
        Kind::Planes,
        Kind::Turned,
        Kind::Nearly,
        Kind::Cards,
    ];
}

/// One or two objects with faces and loose lines.
pub(crate) fn random_soups(random: &mut Random, kind: Kind) -> Vec<Soup> {
    let mut pool: Vec<DVec3> = (0..7).map(|_| random.grid_point(4)).collect();
    pool.sort_by(|a, b| a.to_array().partial_cmp(&b.to_array()).expect("finite"));
    pool.dedup();
    let objects = 1 + random.below(2);
    (0..objects)
        .map(|_| {
            let faces = match kind {
                Kind::Boxes => random_boxes(random),
                Kind::Cards => random_cards(random),
                _ => random_faces(random, kind, &pool),
            };
            let lines: Vec<[DVec3; 2]> = (0..random.below(4))
                .map(|_| [0; 2].map(|_| random_point(random, kind, &pool)))
                .collect();
            let mut soup = polygons(&faces, &lines);
            for vertex in &mut soup.vertices {
                *vertex = displaced(random, kind, *vertex);
            }
            soup
        })
        .collect()
}

fn random_faces(random: &mut Random, kind: Kind, pool: &[DVec3]) -> Vec<Vec<DVec3>> {
    let mut faces: Vec<Vec<DVec3>> = Vec::new();
    for _ in 0..2 + random.below(7) {
        let face = if !faces.is_empty() && random.one_in(6) {
            repeated(random, &faces)
        } else if random.one_in(5) && kind != Kind::General {
            parallelogram(random)
        } else {
            (0..3).map(|_| random_point(random, kind, pool)).collect()
        };
        faces.push(face);
    }
    faces
}

/// An earlier face again: the same, turned around, or a neighbour.
fn repeated(random: &mut Random, faces: &[Vec<DVec3>]) -> Vec<DVec3> {
    let mut face = faces[random.below(faces.len() as u64) as usize].clone();
    match random.below(3) {
        0 => face.reverse(),
        1 => face.rotate_left(1),
        _ => {
            let [a, b, c] = [face[0], face[1], face[2]];
            face = vec![b, a, a + b - c];
        }
    }
    face
}

fn parallelogram(random: &mut Random) -> Vec<DVec3> {
    let [corner, a, b] = [0; 3].map(|_| random.grid_point(3));
    vec![corner, corner + a, corner + a + b, corner + b]
}

/// Faces between lines of the grid in a few planes across the axes.
fn random_cards(random: &mut Random) -> Vec<Vec<DVec3>> {
    (0..2 + random.below(8)).map(|_| random_card(random)).collect()
}

/// A rectangle across an axis, or half of it.
pub(crate) fn random_card(random: &mut Random) -> Vec<DVec3> {
    let axis = random.below(3) as usize;
    let mut range = || {
        let [a, b] = [random.below(4), random.below(4)];
        let high = if a == b { b + 1 } else { b.max(a) };
        [a.min(b) as f64, high as f64]
    };
    let [[left, right], [bottom, top]] = [range(), range()];
    let height = random.below(3) as f64;
    let corner = |x: f64, y: f64| {
        let mut place = [x, y, height];
        place.rotate_right(axis);
        DVec3::from(place)
    };
    let mut card =
        vec![corner(left, bottom), corner(right, bottom), corner(right, top), corner(left, top)];
    let turns = random.below(4) as usize;
    card.rotate_left(turns);
    if random.one_in(4) {
        card.pop();
    }
    if random.one_in(2) {
        card.reverse();
    }
    card
}

fn random_boxes(random: &mut Random) -> Vec<Vec<DVec3>> {
    let mut faces = Vec::new();
    for _ in 0..1 + random.below(2) {
        let low = random.grid_point(3);
        faces.extend(cuboid(low, low + DVec3::ONE + random.grid_point(2)));
    }
    faces
}

fn random_point(random: &mut Random, kind: Kind, pool: &[DVec3]) -> DVec3 {
    match kind {
        Kind::General => random.point() * 2.0 + DVec3::splat(1.5),
        Kind::Pool => random.choose(pool),
        Kind::Planes => {
            let point = random.grid_point(4);
            // Planes x + y + z = 4, x = z and z = 1.
            match random.below(3) {
                0 => point.with_z(4.0 - point.x - point.y),
                1 => point.with_x(point.z),
                _ => point.with_z(1.0),
            }
        }
        Kind::Grid | Kind::Boxes | Kind::Turned | Kind::Nearly | Kind::Cards => {
            random.grid_point(4)
        }
    }
}

fn displaced(random: &mut Random, kind: Kind, point: DVec3) -> DVec3 {
    match kind {
        // Rows of length 3: a rotation times three.
        Kind::Turned => DVec3::new(
            2.0 * point.x - point.y + 2.0 * point.z,
            2.0 * point.x + 2.0 * point.y - point.z,
            -point.x + 2.0 * point.y + 2.0 * point.z,
        ),
        Kind::Nearly => DVec3::from(point.to_array().map(|x| match random.below(6) {
            0 => (x / 10.0 + 0.1).next_up(),
            1 => (x / 10.0 + 0.1).next_down(),
            _ => x / 10.0 + 0.1,
        })),
        _ => point,
    }
}
