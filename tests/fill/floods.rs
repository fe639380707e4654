//! Floods and patterns.

use crate::random;
use umriss::fill::{Anchor, Connected, Pattern, flood};

/// The pixels connected with a seed, by looking again and again.
fn slowly(image: &[u8], width: usize, seed: usize, connected: Connected) -> Vec<bool> {
    let mut reached = vec![false; image.len()];
    reached[seed] = true;
    loop {
        let mut grown = false;
        for i in 0..image.len() {
            let (x, y) = ((i % width) as i64, (i / width) as i64);
            let near = (0..image.len()).any(|j| {
                let (dx, dy) = ((j % width) as i64 - x, (j / width) as i64 - y);
                let touches = match connected {
                    Connected::BySides => dx.abs() + dy.abs() == 1,
                    Connected::ByCorners => dx.abs().max(dy.abs()) == 1,
                };
                touches && reached[j]
            });
            if !reached[i] && image[i] == image[seed] && near {
                reached[i] = true;
                grown = true;
            }
        }
        if !grown {
            return reached;
        }
    }
}

#[test]
fn floods_reach_what_is_connected() {
    let mut number = random(4);
    for i in 0..60 {
        let (width, height) = (1 + number(14) as usize, 1 + number(12) as usize);
        let image: Vec<u8> = (0..width * height).map(|_| u8::from(number(5) < 2)).collect();
        let seed = number((width * height) as i64) as usize;
        for connected in [Connected::BySides, Connected::ByCorners] {
            let expected = slowly(&image, width, seed, connected);
            let mut painted = image.clone();
            let at = [(seed % width) as u32, (seed / width) as u32];
            let count = flood(&mut painted, width as u32, at, 9, connected);
            let reached: Vec<bool> = painted.iter().map(|pixel| *pixel == 9).collect();
            assert_eq!(reached, expected, "image {i}, {connected:?}");
            assert_eq!(count, expected.iter().filter(|is| **is).count());
        }
    }
}

#[test]
fn a_diagonal_line_holds_a_flood_by_sides_only() {
    let line: Vec<u8> = (0..64).map(|i| u8::from(i % 8 == i / 8)).collect();
    for (connected, expected) in [(Connected::BySides, 28), (Connected::ByCorners, 56)] {
        assert_eq!(flood(&mut line.clone(), 8, [7, 0], 5, connected), expected);
    }
}

#[test]
fn a_flood_fills_a_large_picture_without_a_deep_stack() {
    let mut image = vec![0_u8; 2000 * 2000];
    assert_eq!(flood(&mut image, 2000, [1000, 1000], 1, Connected::BySides), 4_000_000);
    assert_eq!(flood(&mut image, 2000, [0, 0], 1, Connected::BySides), 0);
    assert_eq!(flood(&mut image, 2000, [2000, 0], 2, Connected::BySides), 0);
}

#[test]
fn patterns_repeat_from_their_anchor() {
    let pattern = Pattern::new(&["#..", ".#."]).unwrap();
    assert_eq!(pattern.size(), [3, 2]);
    for column in -7..7 {
        for row in -7..7 {
            let marked = pattern.is_marked([column, row], Anchor::Page);
            assert_eq!(marked, (column - row.rem_euclid(2)).rem_euclid(3) == 0);
            let moved = pattern.is_marked([column + 5, row - 9], Anchor::Object([5, -9]));
            assert_eq!(marked, moved);
        }
    }
    assert_eq!(Pattern::new(&["#..", ".#"]), None);
    assert_eq!(Pattern::new(&[]), None);
    for name in ["hatch", "cross", "dots", "bricks"] {
        assert!(Pattern::from_name(name).is_some(), "{name}");
    }
}
