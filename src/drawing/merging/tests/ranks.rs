//! Which of two lines is drawn, and what becomes of the rest of the other.

use super::*;

/// What makes one line rank before another.
#[derive(Debug, Clone, Copy)]
enum Before {
    Visible,
    Outline,
    Class,
    Nearer,
}

fn before() -> impl Strategy<Value = Before> {
    prop::sample::select(vec![Before::Visible, Before::Outline, Before::Class, Before::Nearer])
}

/// The part of a drawing that is visible.
fn visible(drawing: &Drawing) -> Vec<[DVec2; 2]> {
    let mut drawing = drawing.clone();
    drawing.layers.retain(|layer| layer.tags.level == 0);
    segments(&drawing)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn of_twins_the_first_in_rank_is_drawn_bit_for_bit(
        aside in -0.9..0.9,
        before in before(),
        last in any::<bool>(),
        turned in any::<[bool; 2]>(),
    ) {
        let line = [dvec2(0.0, 0.0), dvec2(60.0, 0.0)];
        let twin = line.map(|end| end + dvec2(0.0, aside * REACH));
        let mut pieces = [piece(0, line, true), piece(1, twin, true)];
        for (piece, turned) in pieces.iter_mut().zip(turned) {
            if turned {
                piece.points.reverse();
            }
        }
        let [first, second] = &mut pieces;
        match before {
            Before::Visible => second.invisibility = 1,
            Before::Outline => first.outline = true,
            Before::Class => first.class = LineClass::Contour,
            Before::Nearer => second.depth = [1.0, 1.0],
        }
        if last {
            pieces.reverse();
        }
        let view = lines(pieces.to_vec());
        let all = drawn(&view, 0.0);
        let merged = ink(&drawn(&view, REACH));
        prop_assert_eq!(merged.len(), 1);
        // The first is the lower one, if its twin is above; y runs down.
        let mut both = segments(&all);
        both.sort_by(|a, b| a[0].y.total_cmp(&b[0].y));
        let wanted = both[if aside < 0.0 { 0 } else { both.len() - 1 }];
        prop_assert_eq!(merged[0][0][1], wanted[0].y.to_bits());
        prop_assert!(ink(&all).contains(&merged[0]));
    }

    /// No visible line is left out for a hidden one.
    #[test]
    fn what_is_visible_is_drawn_visible(page in page()) {
        let view = view_of(&page);
        let [all, merged] = [0.0, REACH].map(|reach| visible(&drawn(&view, reach)));
        let lost = farthest(&all, &merged);
        prop_assert!(lost <= REACH + 1e-9, "{} mm away from all that is visible", lost);
        let added = farthest(&merged, &all);
        prop_assert!(added <= REACH + 1e-9, "{} mm away from all that was", added);
    }

    /// A line, and another one beside it that begins in the midst of it and
    /// goes on beyond its end, perhaps with a bend.
    #[test]
    fn what_goes_on_beyond_its_twin_is_one_stroke_with_it(
        aside in -0.9..0.9,
        from in -20.0..50.0,
        beyond in 1.0..40.0,
        bend in prop::option::of(-1.5..1.5),
        turned in any::<[bool; 3]>(),
        last in any::<bool>(),
    ) {
        let at = |x: f64| dvec2(x, aside * REACH);
        let mut all = vec![[dvec2(0.0, 0.0), dvec2(60.0, 0.0)]];
        let (joint, end) = match bend {
            None => (at(60.0 + beyond), at(60.0 + beyond)),
            Some(angle) => (at(62.0), at(62.0) + DVec2::from_angle(angle) * beyond),
        };
        all.push([at(from), joint]);
        if bend.is_some() {
            all.push([joint, end]);
        }
        for (line, turned) in all.iter_mut().zip(turned) {
            if turned {
                line.reverse();
            }
        }
        if last {
            all.reverse();
        }
        let page: Vec<_> = all.into_iter().map(|line| (line, true)).collect();
        let drawing = drawn(&view_of(&page), REACH);
        prop_assert_eq!(stroke_count(&drawing), 1);
        let whole = joint.x - f64::min(0.0, from) + joint.distance(end);
        prop_assert!((length(&drawing) - whole).abs() <= REACH, "{} of {}", length(&drawing), whole);
        let before = segments(&drawn(&view_of(&page), 0.0));
        let lost = farthest(&before, &segments(&drawing));
        prop_assert!(lost <= REACH + 1e-9, "{} mm away from all that is drawn", lost);
    }
}
