//! Solids whose faces were torn apart come together again.

use super::scenes::{
    Random, farthest, geometry, healed, mapped, prism, seeds, soup_of, topology, torn,
};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn torn_solids_are_closed_again(seed in seeds(), corners in 3_usize..9) {
        let mut random = Random(seed);
        let turn = random.rotation();
        let whole = mapped(&prism(&mut random, corners), |p| turn * p);
        let soups = [soup_of("solid", &torn(&mut random, &whole, 1e-6))];
        prop_assert!(!topology(&soups).is_closed());
        let (after, report) = healed(&soups, 2e-6);
        let found = topology(&after);
        prop_assert!(found.is_closed());
        prop_assert_eq!(found.boundary_edges, 0);
        prop_assert_eq!(found.components, 1);
        prop_assert_eq!(report.closed_borders, 6 * corners);
        prop_assert_eq!(report.collapsed_faces, 0);
        prop_assert!(farthest(&soups, &after) <= 2e-6);
        // Once more changes nothing.
        let (again, report) = healed(&after, 2e-6);
        prop_assert_eq!(&again, &after);
        prop_assert_eq!((report.moved, report.closed_borders, report.collapsed_faces), (0, 0, 0));
    }

    #[test]
    fn a_whole_solid_stays_as_it_is(seed in seeds(), corners in 3_usize..9) {
        let mut random = Random(seed);
        let turn = random.rotation();
        let whole = [soup_of("solid", &mapped(&prism(&mut random, corners), |p| turn * p))];
        let (after, report) = healed(&whole, 1e-6);
        prop_assert_eq!(&after[..], &whole[..]);
        prop_assert_eq!(report, Default::default());
        prop_assert_eq!(geometry(&after), geometry(&whole));
    }
}
