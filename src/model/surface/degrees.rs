//! Grids whose places are degrees and whose heights are metres.

use super::Heights;

impl Heights {
    /// What heights in metres have to be multiplied with to look right over
    /// places in degrees, and the latitude it is right for; nothing where
    /// the places are none on earth, or the heights are not out of all
    /// proportion to them. O(n).
    ///
    /// It is the usual z factor: one over the metres of a degree of longitude
    /// at the latitude of the grid's middle (ellipsoid WGS 84, the series of
    /// the American Practical Navigator).
    pub fn z_factor_of_degrees(&self) -> Option<(f64, f64)> {
        let ends = |list: &[f64]| [list[0], list[list.len() - 1]];
        let ([west, east], [north, south]) = (ends(self.xs()), ends(self.zs()));
        let is_on_earth = -180.0 <= west && east <= 360.0 && -90.0 <= north && south <= 90.0;
        let there = self.values().iter().copied().filter(|height| height.is_finite());
        let empty = (f64::INFINITY, f64::NEG_INFINITY);
        let (least, greatest) = there.fold(empty, |(a, b), height| (a.min(height), b.max(height)));
        if !is_on_earth || greatest - least <= (east - west).max(south - north) {
            return None;
        }
        // z is the latitude with its sign changed.
        let latitude = 0.0 - f64::midpoint(north, south);
        let angle = latitude.to_radians();
        let degree =
            111_412.84 * angle.cos() - 93.5 * (3.0 * angle).cos() + 0.118 * (5.0 * angle).cos();
        (degree > 0.0).then(|| (1.0 / degree, latitude))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factor(west: f64, north: f64, step: f64, relief: f64) -> Option<(f64, f64)> {
        let steps = |from: f64| (0..3).map(|i| from + f64::from(i) * step).collect::<Vec<_>>();
        let mut values = vec![0.0; 9];
        values[4] = relief;
        Heights::new(steps(west), steps(-north), values).unwrap().z_factor_of_degrees()
    }

    /// Published z factors: 0.00000898 at the equator, 0.00001171 at 40
    /// degrees, 0.00001792 at 60.
    #[test]
    fn factors_are_the_published_ones() {
        for (latitude, expected) in [(0.0, 0.898e-5), (40.0, 1.171e-5), (-60.0, 1.792e-5)] {
            let (found, at) = factor(7.0, latitude + 0.001, 0.001, 300.0).unwrap();
            assert!((found - expected).abs() < 0.001e-5, "{latitude}: {found}");
            assert!((at - latitude).abs() < 1e-9);
        }
    }

    #[test]
    fn grids_in_metres_are_left_alone() {
        // Places beyond the earth's degrees; heights in proportion.
        assert_eq!(factor(500_000.0, 50.0, 10.0, 300.0), None);
        assert_eq!(factor(0.0, 0.0, 10.0, 3.0), None);
    }
}
