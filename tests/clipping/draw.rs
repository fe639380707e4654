//! Polygons drawn at random, with coincidences on purpose.

use glam::{DVec2, dvec2};

pub(crate) type Rings = Vec<Vec<DVec2>>;

/// A multiplicative generator (Lehmer 1951, parameters of L'Ecuyer 1999).
pub(crate) struct Draw(u128);

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        Draw(u128::from(seed) << 64 | 0x9e37_79b9_7f4a_7c15)
    }

    /// Below `end`.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(0xda94_2042_e4dd_58b5);
        ((self.0 >> 64) as u64 % end as u64) as usize
    }

    /// In 0..1.
    pub(crate) fn float(&mut self) -> f64 {
        self.below(1 << 53) as f64 / f64::powi(2.0, 53)
    }
}

/// Corners in general position, or on a coarse grid.
pub(crate) fn ring(draw: &mut Draw, corners: usize, grid: Option<i32>) -> Vec<DVec2> {
    let mut coordinate = || match grid {
        Some(size) => f64::from(draw.below(2 * size as usize + 1) as i32 - size),
        None => draw.float() * 8.0 - 4.0,
    };
    (0..corners).map(|_| dvec2(coordinate(), coordinate())).collect()
}

/// A pair of operands. The second borrows corners and edges of the first,
/// points on its edges (exact and rounded) and corners one unit in the last
/// place off.
pub(crate) fn pair(seed: u64) -> [Vec<Rings>; 2] {
    let mut draw = Draw::new(seed);
    let grid = [None, Some(2), Some(5), None][draw.below(4)];
    let operand = |draw: &mut Draw| -> Vec<Rings> {
        let polygons = 1 + draw.below(2);
        let rings = |draw: &mut Draw| {
            let count = 1 + draw.below(2);
            let corners = 3 + draw.below(6);
            (0..count).map(|_| ring(draw, corners, grid)).collect()
        };
        (0..polygons).map(|_| rings(draw)).collect()
    };
    let first = operand(&mut draw);
    let mut second = operand(&mut draw);
    for corner in second.iter_mut().flatten().flatten() {
        let ring = &first[draw.below(first.len())][0];
        let at = draw.below(ring.len());
        let (a, b) = (ring[at], ring[(at + 1) % ring.len()]);
        match draw.below(8) {
            0 | 1 => *corner = a,
            2 => *corner = (a + b) * 0.5,
            3 => *corner = a + (b - a) * draw.float(),
            4 => *corner = dvec2(a.x.next_up(), a.y),
            _ => {}
        }
    }
    // Whole edges in common, now and then.
    if draw.below(3) == 0 {
        let shared = first[0][0].clone();
        let ring = &mut second[0][0];
        let count = 2 + draw.below(shared.len() - 1);
        ring.splice(0..1, shared.into_iter().take(count));
    }
    [first, second]
}
