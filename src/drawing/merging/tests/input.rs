//! What does not matter of the pieces, and what is left as it was.

use super::super::super::chaining::chain;
use super::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// But for the rounding of where a piece is cut, which is measured from
    /// its start.
    #[test]
    fn the_direction_of_pieces_does_not_matter(page in page(), turned in any::<u64>()) {
        let view = view_of(&page);
        let mut other = view.clone();
        for piece in &mut other.pieces {
            if turned >> (piece.run % 64) & 1 == 1 {
                piece.points.reverse();
                piece.depth.reverse();
            }
        }
        let [one, other] = [&view, &other].map(|view| drawn(view, REACH));
        prop_assert_eq!(stroke_count(&one), stroke_count(&other));
        prop_assert!((length(&one) - length(&other)).abs() <= 1e-9);
        let [one, other] = [&one, &other].map(segments);
        let apart = farthest(&one, &other).max(farthest(&other, &one));
        prop_assert!(apart <= 1e-9, "{} mm", apart);
    }

    #[test]
    fn with_a_reach_of_nothing_all_pieces_are_drawn_bit_for_bit(page in page()) {
        let view = view_of(&page);
        let drawing = drawn(&view, 0.0);
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for point in view.pieces.iter().flat_map(|piece| piece.points) {
            (low, high) = (low.min(point), high.max(point));
        }
        let centre = 0.5 * low + 0.5 * high;
        let place = |p: DVec2| DVec2::splat(0.5 * SIDE) + dvec2(p.x - centre.x, centre.y - p.y);
        for hidden in [0, 1] {
            let pieces = || view.pieces.iter().filter(|piece| piece.invisibility == hidden);
            let placed: Vec<_> = pieces().map(|piece| piece.points.map(place)).collect();
            let runs: Vec<_> = pieces().map(|piece| piece.run).collect();
            let layer = drawing.layers.iter().find(|layer| layer.tags.level == hidden);
            let strokes = layer.map(|layer| layer.strokes.clone()).unwrap_or_default();
            prop_assert_eq!(strokes, chain(&placed, &runs, false));
        }
    }
}
