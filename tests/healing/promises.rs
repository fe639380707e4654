//! Promises that hold for any soup.

use super::scenes::{Random, farthest, geometry, healed, seeds, shuffled, soup_of};
use glam::DVec3;
use proptest::prelude::*;
use umriss::model::{Mesh, MeshError, Soup};

/// Polygons with corners near the points of a small lattice, so that all
/// kinds of things nearly coincide.
fn lattice_soup(random: &mut Random, tolerance: f64, noise: f64) -> Vec<Soup> {
    let objects = 1 + random.below(3);
    (0..objects)
        .map(|object| {
            let faces: Vec<Vec<DVec3>> = (0..2 + random.below(8))
                .map(|_| {
                    let corners = 3 + random.below(2);
                    (0..corners)
                        .map(|_| {
                            let cell = [random.below(4), random.below(3), random.below(3)];
                            let at = DVec3::from_array(cell.map(|x| x as f64 * 0.37));
                            let shift = match random.below(3) {
                                0 => DVec3::ZERO,
                                1 => {
                                    DVec3::AXES[random.below(3)] * random.unit() * noise * tolerance
                                }
                                _ => random.in_ball(noise * tolerance),
                            };
                            at + shift
                        })
                        .collect()
                })
                .collect();
            soup_of(&object.to_string(), &faces)
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn nothing_moves_farther_than_the_tolerance(seed in seeds()) {
        let mut random = Random(seed);
        let noise = [0.3, 0.6, 2.0][random.below(3)];
        for tolerance in [1e-9, 1e-5, 1e-2] {
            let soups = lattice_soup(&mut random, tolerance, noise);
            let (after, report) = healed(&soups, tolerance);
            let way = farthest(&soups, &after);
            prop_assert!(way <= tolerance * (1.0 + 1e-12));
            prop_assert!((report.farthest - way).abs() <= 1e-12 * tolerance);
            prop_assert_eq!(report.moved == 0, way == 0.0);
            for (old, new) in soups.iter().zip(&after) {
                prop_assert_eq!(old.faces.len(), new.faces.len());
            }
            // Corners of random faces may lie on one line.
            let made = Mesh::new(after, None);
            prop_assert!(matches!(made, Ok(_) | Err(MeshError::Empty)), "{:?}", made.err());
        }
    }

    #[test]
    fn healing_twice_changes_nothing(seed in seeds()) {
        let mut random = Random(seed);
        for tolerance in [1e-5, 1e-2] {
            let soups = lattice_soup(&mut random, tolerance, 0.3);
            let (after, _) = healed(&soups, tolerance);
            let (again, report) = healed(&after, tolerance);
            prop_assert_eq!(geometry(&again), geometry(&after), "{:?}", report);
        }
    }

    #[test]
    fn the_order_of_a_file_does_not_matter(seed in seeds()) {
        let mut random = Random(seed);
        let noise = [0.3, 0.6, 2.0][random.below(3)];
        for tolerance in [1e-5, 1e-2] {
            let soups = lattice_soup(&mut random, tolerance, noise);
            let (after, report) = healed(&soups, tolerance);
            for _ in 0..3 {
                let (others, again) = healed(&shuffled(&mut random, &soups), tolerance);
                prop_assert_eq!(geometry(&others), geometry(&after));
                prop_assert_eq!(again, report);
            }
        }
    }
}
