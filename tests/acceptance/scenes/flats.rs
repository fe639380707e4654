//! Scenes in which nearly everything lies in one plane: faces of several
//! objects upon one another, the same face again, faces that touch
//! themselves, walls that stand on them, lines that lie on them.

use super::{Random, polygons};
use glam::{DVec2, DVec3};
use umriss::model::Soup;

/// Outlines on a grid. The later ones touch themselves in a corner, along a
/// side, or go to a hole and back.
const OUTLINES: [&[[f64; 2]]; 9] = [
    &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
    &[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]],
    &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0]],
    &[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]],
    &[
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ],
    &[
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [2.0, 1.0],
        [2.0, 2.0],
        [1.0, 2.0],
        [1.0, 1.0],
        [0.0, 1.0],
    ],
    &[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]],
    &[
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 3.0],
        [0.0, 3.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [1.0, 1.0],
    ],
    &[
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 2.0],
        [0.0, 2.0],
        [0.0, 1.0],
        [1.0, 1.0],
        [2.0, 1.5],
        [2.0, 0.5],
        [1.0, 1.0],
        [0.0, 1.0],
    ],
];

/// Two steps in a plane, and one off it; in whole numbers.
const PLANES: [[[f64; 3]; 3]; 5] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    [[1.0, 1.0, 0.0], [0.0, 1.0, -1.0], [0.0, 0.0, 1.0]],
    [[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]],
    [[3.0, 1.0, 0.0], [-1.0, 0.0, 1.0], [0.0, 1.0, 1.0]],
];

/// A place of the grid in the plane, off it by whole steps.
struct Frame {
    steps: [DVec3; 3],
    origin: DVec3,
    /// Factors for the coordinates.
    scale: DVec3,
}

impl Frame {
    fn random(random: &mut Random) -> Self {
        let steps = random.choose(&PLANES).map(DVec3::from_array);
        let origin = random.choose(&[DVec3::ZERO, DVec3::new(1.0, -7.0, 3.0), DVec3::splat(1e12)]);
        let one = DVec3::ONE;
        let scale = random.choose(&[one, one, DVec3::splat(1.0 / 3.0), DVec3::new(1e9, 1.0, 1.0)]);
        Frame { steps, origin, scale }
    }

    fn place(&self, at: DVec2, off: f64) -> DVec3 {
        let [u, v, w] = self.steps;
        (self.origin + u * at.x + v * at.y + w * off) * self.scale
    }
}

/// One to three objects.
pub(crate) fn flat_scene(random: &mut Random) -> Vec<Soup> {
    let frame = Frame::random(random);
    let count = 1 + random.below(3);
    let mut faces: Vec<Vec<DVec3>> = Vec::new();
    let mut soups = Vec::new();
    for object in 0..count {
        let mut own = Vec::new();
        for _ in 0..1 + random.below(4) {
            let face = face(random, &frame, &faces);
            faces.push(face.clone());
            own.push(face);
        }
        let grid = |random: &mut Random| DVec2::new(random.below(5) as f64, random.below(5) as f64);
        let lines: Vec<[DVec3; 2]> = (0..random.below(3))
            .map(|_| {
                let off = random.choose(&[0.0, 0.0, 0.0, 1.0, -1.0]);
                [frame.place(grid(random), 0.0), frame.place(grid(random), off)]
            })
            .collect();
        let mut soup = polygons(&own, &lines);
        soup.name = format!("o{object}");
        soups.push(soup);
    }
    soups
}

fn face(random: &mut Random, frame: &Frame, others: &[Vec<DVec3>]) -> Vec<DVec3> {
    if !others.is_empty() && random.one_in(5) {
        let mut face = others[random.below(others.len() as u64) as usize].clone();
        match random.below(3) {
            0 => face.reverse(),
            1 => face.rotate_left(1),
            _ => {}
        }
        return face;
    }
    let outline = random.choose(&OUTLINES);
    let corner = DVec2::new(random.below(4) as f64, random.below(4) as f64);
    let turn = random.below(4);
    let flip = random.one_in(2);
    let turned = |[x, y]: [f64; 2]| {
        let y = if flip { -y } else { y };
        corner
            + match turn {
                0 => DVec2::new(x, y),
                1 => DVec2::new(-y, x),
                2 => DVec2::new(-x, -y),
                _ => DVec2::new(y, -x),
            }
    };
    // Most lie in the plane, some in a parallel one, some stand on either.
    let kind = random.below(8);
    let place = |&point: &[f64; 2]| {
        let at = turned(point);
        match kind {
            0 => frame.place(at, 1.0),
            1 => frame.place(DVec2::new(at.x, corner.y), at.y - corner.y),
            2 => frame.place(DVec2::new(at.x, corner.y), at.y - corner.y - 1.0),
            _ => frame.place(at, 0.0),
        }
    };
    outline.iter().map(place).collect()
}

/// A direction to look along: straight onto the plane, along it, along the
/// grid, or any.
pub(crate) fn look_at(random: &mut Random) -> DVec3 {
    let steps = random.choose(&PLANES).map(DVec3::from_array);
    let forward = match random.below(5) {
        0 => steps[0].cross(steps[1]),
        1 => steps[0] + steps[1] * (random.below(3) as f64 - 1.0),
        2 => random.choose(&[DVec3::X, DVec3::Y, DVec3::Z]),
        3 => random.grid_point(5) - DVec3::splat(2.0),
        _ => random.point(),
    };
    if forward == DVec3::ZERO { DVec3::Y } else { forward * random.choose(&[1.0, -1.0]) }
}
