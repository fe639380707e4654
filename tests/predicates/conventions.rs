//! The documented conventions on cases made by hand: what left, behind and
//! before mean, for both kinds of eye.

use glam::{DVec3, dvec3};
use std::cmp::Ordering;
use umriss::kernel::numbers::Sign::{Negative, Positive, Zero};
use umriss::kernel::predicates::{
    Carrier, Cut, Exact, Eye, FilterOnly, Fold, FoldThreshold, NearPlane, Piercing, Place, Plain,
    Point, Points, Policy, Predicates,
};

/// The viewer is high up on the z axis: x runs right and y up.
const ABOVE: Eye = Eye::Towards(DVec3::Z);
const AT: Eye = Eye::At(dvec3(0.0, 0.0, 10.0));

/// A triangle at z = 0, counterclockwise, and points about it.
fn triangle_and_points() -> Vec<DVec3> {
    vec![
        dvec3(-1.0, -1.0, 0.0),
        dvec3(3.0, -1.0, 0.0),
        dvec3(-1.0, 3.0, 0.0),
        dvec3(0.0, 0.0, -1.0),
        dvec3(0.0, 0.0, 1.0),
        dvec3(0.0, 0.0, 20.0),
        dvec3(0.5, 0.5, 0.0),
    ]
}

fn conventions_hold<P: Policy>(eye: Eye) {
    let points = Points::new(&triangle_and_points(), eye, None);
    let predicates = Predicates::<P>::new(&points);
    let face = [0, 1, 2];
    // Left of the edge to the right is up.
    assert_eq!(predicates.side(0, 1, 2), Positive);
    assert_eq!(predicates.side(1, 0, 2), Negative);
    assert_eq!(predicates.side(0, 1, 0), Zero);
    assert_eq!(predicates.facing(face), Positive);
    assert_eq!(predicates.facing([0, 2, 1]), Negative);
    // Behind is where the plane's sign is that of facing, however wound.
    assert_eq!(predicates.plane(face, 3), predicates.facing(face));
    assert_eq!(predicates.plane(face, 4), -predicates.facing(face));
    assert_eq!(predicates.plane([0, 2, 1], 3), predicates.facing([0, 2, 1]));
    assert_eq!(predicates.plane(face, 6), Zero);
    assert_eq!(predicates.value_sign(Cut::Face(face), Point::Vertex(3)), Positive);
    // Inside the image is left of all three edges.
    for [p, q] in [[0, 1], [1, 2], [2, 0]] {
        assert_eq!(predicates.side(p, q, 3), Positive);
        assert_eq!(predicates.value_sign(Cut::Silhouette([p, q]), Point::Vertex(3)), Positive);
    }
}

#[test]
fn left_and_behind_are_what_is_documented() {
    for eye in [ABOVE, AT] {
        conventions_hold::<Exact>(eye);
        conventions_hold::<FilterOnly>(eye);
        conventions_hold::<Plain>(eye);
    }
}

#[test]
fn left_is_a_half_space_for_points_behind_a_perspective_eye() {
    let points = Points::new(
        &[
            dvec3(-1.0, 0.0, 0.0),
            dvec3(1.0, 0.0, 0.0),
            dvec3(0.0, 5.0, 30.0),
            dvec3(0.0, -5.0, 30.0),
        ],
        AT,
        None,
    );
    let predicates = Predicates::<Exact>::new(&points);
    assert_eq!(predicates.side(0, 1, 2), Positive);
    assert_eq!(predicates.side(0, 1, 3), Negative);
}

#[test]
fn shadow_volume_has_no_part_behind_the_eye() {
    // Vertex 5 is behind the eye at z = 10 and on the eye's side of the plane.
    let points = Points::new(&triangle_and_points(), AT, None);
    let predicates = Predicates::<Exact>::new(&points);
    assert_eq!(predicates.plane([0, 1, 2], 5), -predicates.facing([0, 1, 2]));
}

#[test]
fn cuts_are_passed_in_order_even_from_behind_the_eye() {
    // The carrier comes from behind the eye, through the near plane, past
    // the image of an edge and through a face.
    let vertices = [
        dvec3(3.0, 0.0, 20.0),
        dvec3(-3.0, 0.0, -10.0),
        dvec3(-1.0, -1.0, 0.0),
        dvec3(-1.0, 1.0, 0.0),
        dvec3(-9.0, -9.0, -8.0),
        dvec3(9.0, -9.0, -8.0),
        dvec3(0.0, 9.0, -8.0),
    ];
    let near = NearPlane { forward: dvec3(0.0, 0.0, -2.0), distance: 1.0 };
    let points = Points::new(&vertices, AT, Some(near));
    let predicates = Predicates::<Exact>::new(&points);
    let carrier = Carrier::edge(0, 1);
    let cuts = [Cut::Near, Cut::Silhouette([2, 3]), Cut::Face([4, 5, 6])];
    let values = cuts.map(|cut| carrier.ends.map(|end| predicates.value(cut, end)));
    assert_eq!(values[0].map(|value| value.sign), [Negative, Positive]);
    for i in 0..3 {
        for j in 0..3 {
            let order = predicates.order(carrier, (cuts[i], &values[i]), (cuts[j], &values[j]));
            assert_eq!(order, i.cmp(&j), "{:?} {:?}", cuts[i], cuts[j]);
        }
    }
    // z = 9 of 20 .. -10.
    assert_eq!(predicates.parameter(carrier, Cut::Near, &values[0]), 11.0 / 30.0);
    assert_eq!(predicates.parameter(carrier, cuts[2], &values[2]), 28.0 / 30.0);
}

#[test]
fn near_plane_far_beyond_the_scene_is_still_exact() {
    let vertices = [dvec3(0.0, 0.0, 0.0), dvec3(0.1, 0.0, -2e200), dvec3(0.0, 0.3, -0.5e200)];
    let forward = dvec3(0.0, 0.0, -1e-200);
    let near = NearPlane { forward, distance: 1e200 };
    let points = Points::new(&vertices, AT, Some(near));
    let predicates = Predicates::<Exact>::new(&points);
    let signs = [0, 1, 2].map(|i| predicates.value_sign(Cut::Near, Point::Vertex(i)));
    assert_eq!(signs, [Negative, Positive, Negative]);

    // A scene of one bit with a long direction: the offset alone is wide.
    let vertices = [dvec3(0.0, 0.0, 0.0), dvec3(0.0, 0.0, -2.0), dvec3(0.0, 0.0, -4.0)];
    let forward = dvec3(0.0, 0.0, -f64::powi(2.0, 100) - f64::powi(2.0, 60));
    for (distance, expected) in [(13.0, Positive), (14.0, Zero), (1e60, Negative)] {
        let points = Points::new(&vertices, AT, Some(NearPlane { forward, distance }));
        let predicates = Predicates::<Exact>::new(&points);
        assert_eq!(predicates.value_sign(Cut::Near, Point::Vertex(2)), expected);
    }
}

#[test]
fn near_plane_with_more_bits_than_one_word_pair_holds() {
    // Spreads of about a hundred bits for points and direction: the offset
    // has two hundred.
    let small = f64::powi(2.0, -50);
    let big = f64::powi(2.0, 50);
    let vertices = [dvec3(small, 0.0, 0.0), dvec3(big, 0.0, 0.0), dvec3(big / 2.0, small, 0.0)];
    let near = NearPlane { forward: dvec3(big, 0.0, 0.0), distance: big / 2.0 };
    let tilted = NearPlane { forward: dvec3(big, small, 0.0), ..near };
    for near in [near, tilted] {
        let points = Points::new(&vertices, Eye::At(DVec3::ZERO), Some(near));
        let predicates = Predicates::<Exact>::new(&points);
        let signs = [0, 1].map(|i| predicates.value_sign(Cut::Near, Point::Vertex(i)));
        assert_eq!(signs, [Negative, Positive]);
    }
    let points = Points::new(&vertices, Eye::At(DVec3::ZERO), Some(near));
    assert_eq!(Predicates::<Exact>::new(&points).value_sign(Cut::Near, Point::Vertex(2)), Zero);
}

#[test]
fn order_along_an_image_compares_different_depths() {
    // Two edges over one another, seen from above.
    let vertices =
        [dvec3(0.0, 0.0, 0.0), dvec3(4.0, 0.0, 0.0), dvec3(3.0, 0.0, -5.0), dvec3(1.0, 0.0, -2.0)];
    let points = Points::new(&vertices, ABOVE, None);
    let predicates = Predicates::<Exact>::new(&points);
    let (upper, lower) = (Carrier::edge(0, 1), Carrier::edge(2, 3));
    let axis = predicates.axis_across(upper).expect("an edge seen from the side");
    assert_ne!(axis, 0);
    let compare = |first, second| predicates.order_along_image(upper, axis, first, second);
    assert_eq!(compare((upper, Place::Start), (lower, Place::End)), Ordering::Less);
    assert_eq!(compare((lower, Place::Start), (lower, Place::End)), Ordering::Greater);
    assert_eq!(compare((lower, Place::Start), (upper, Place::End)), Ordering::Less);
    let passing = Place::Cut(Cut::Vertex(2, 1));
    assert_eq!(compare((upper, passing), (lower, Place::Start)), Ordering::Equal);
    assert_eq!(predicates.nearer_than(upper, axis, (lower, Place::Start)), Negative);
    assert_eq!(predicates.nearer_than(lower, axis, (upper, passing)), Positive);
    assert_eq!(predicates.nearer_than(upper, axis, (upper, passing)), Zero);
    assert_eq!(predicates.axis_across(Carrier::edge(1, 1)), None);
}

#[test]
fn common_line_of_two_faces_is_walked_between_piercings() {
    // The face 012 at z = 0; edges 34 and 56 pierce it at x = 0 and x = 1.
    let mut vertices = triangle_and_points();
    vertices.truncate(3);
    vertices.extend([
        dvec3(0.0, 0.0, 1.0),
        dvec3(0.0, 0.0, -1.0),
        dvec3(1.0, 0.0, 3.0),
        dvec3(1.0, 0.0, -1.0),
        dvec3(0.5, -2.0, 5.0),
        dvec3(0.5, 2.0, 5.0),
    ]);
    let points = Points::new(&vertices, ABOVE, None);
    let predicates = Predicates::<Exact>::new(&points);
    // [0, 1, 2, x] is positive below.
    assert_eq!(predicates.plane([0, 1, 2], 4), Positive);
    let pierce = |a, b| Point::Piercing(Piercing { edge: [a, b], face: [0, 1, 2] });
    let carrier = Carrier { ends: [pierce(3, 4), pierce(5, 6)] };
    assert_eq!(predicates.image_side(carrier, 8), Positive);
    assert_eq!(predicates.image_side(carrier, 7), Negative);
    // The piercings weigh differently; the parameter does not show it.
    let cut = Cut::Silhouette([7, 8]);
    let values = carrier.ends.map(|end| predicates.value(cut, end));
    assert_eq!(values.map(|value| value.sign), [Positive, Negative]);
    assert_eq!(predicates.parameter(carrier, cut, &values), 0.5);
    assert_eq!(predicates.combination(carrier, [1.0, 1.0], cut), Zero);
    assert_eq!(predicates.combination(carrier, [2.0, 1.0], cut), Positive);
    // The edge 78 passes over it: nearer, so the lines do not meet.
    assert_ne!(predicates.skew(carrier, [7, 8]), Zero);
    assert_eq!(predicates.skew(carrier, [3, 4]), Zero);
}

#[test]
fn fold_is_what_lacks_to_a_flat_angle() {
    // Faces at the x axis: one backwards along -y, the other folded up.
    let fold = |y: f64, z: f64, degrees: f64| {
        let vertices = [DVec3::ZERO, DVec3::X, dvec3(0.3, -2.0, 0.0), dvec3(0.7, y, z)];
        let points = Points::new(&vertices, ABOVE, None);
        let predicates = Predicates::<Exact>::new(&points);
        Fold::measure(&predicates, [0, 1], [2, 3], FoldThreshold::from_degrees(degrees)).exceeds
    };
    assert!(!fold(1.0, 0.0, 0.0), "coplanar is no fold");
    assert!(fold(1.0, 1e-9, 0.0), "any fold exceeds zero");
    assert!(fold(1.0, 1.0, 44.0) && !fold(1.0, 1.0, 46.0), "forty-five degrees");
    assert!(fold(0.0, 1.0, 89.0) && !fold(0.0, 1.0, 91.0), "a right angle");
    assert!(fold(-1.0, 1.0, 134.0) && !fold(-1.0, 1.0, 136.0), "a sharp ridge");
    assert!(fold(-1.0, 0.0, 179.0) && !fold(-1.0, 0.0, 180.0), "folded flat onto itself");
}

#[test]
fn planes_cross_at_the_lesser_angle_however_their_faces_are_wound() {
    let angle = |degrees: f64, [y, z]: [f64; 2], turned: bool| {
        let vertices = [DVec3::ZERO, DVec3::X, DVec3::Y, dvec3(9.0, 0.0, 0.0), dvec3(5.0, y, z)];
        let points = Points::new(&vertices, ABOVE, None);
        let predicates = Predicates::<Exact>::new(&points);
        let faces = [if turned { [1, 0, 2] } else { [0, 1, 2] }, [4, 0, 3]];
        Fold::of_planes(&predicates, faces, FoldThreshold::from_degrees(degrees)).exceeds
    };
    for turned in [false, true] {
        // The second face leans towards the first, and away from it.
        for side in [3.0, -3.0] {
            assert!(angle(44.9, [side, 3.0], turned) && !angle(45.1, [side, -3.0], turned));
            assert!(
                angle(26.5, [2.0 * side, 3.0], turned) && !angle(26.6, [2.0 * side, 3.0], turned)
            );
        }
        assert!(angle(89.9, [0.0, 1.0], turned), "a right angle");
        assert!(!angle(90.0, [0.0, 1.0], turned) && !angle(120.0, [0.0, 1.0], turned));
        assert!(angle(0.0, [1.0, 1e-9], turned), "any angle exceeds zero");
        assert!(!angle(0.0, [1.0, 0.0], turned), "one plane");
    }
}

#[test]
fn zeros_of_either_sign_are_one_position() {
    let points = Points::new(&[dvec3(0.0, 1.0, 0.0), dvec3(-0.0, 1.0, -0.0)], ABOVE, None);
    assert!(points.coincide(0, 1));
    assert_eq!(points.compare(0, 1), Ordering::Equal);
}
