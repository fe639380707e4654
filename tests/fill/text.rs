//! Curves and letters. The letter is a font's of our own making; where
//! `UMRISS_FONT` names a font file, all of its glyphs are filled too.

use crate::tiny_font::tiny_font;
use glam::DVec2;
use umriss::fill::{Canvas, Contours, Font, Outline, Rule, fill_polygon, flag_fill};

/// The distance of a point from a closed polygon's border.
fn distance(point: DVec2, ring: &[DVec2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .map(|(&a, &b)| {
            let along = b - a;
            let length = along.length_squared();
            let t = if length > 0.0 { (point - a).dot(along) / length } else { 0.0 };
            point.distance(a + along * t.clamp(0.0, 1.0))
        })
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn flattened_curves_keep_within_their_tolerance() {
    let p = DVec2::new;
    let cubics = [
        [p(0.0, 0.0), p(0.0, 50.0), p(100.0, 50.0), p(100.0, 0.0)],
        // A loop, a cusp, a straight line run back and forth.
        [p(0.0, 0.0), p(120.0, 80.0), p(-20.0, 80.0), p(100.0, 0.0)],
        [p(0.0, 0.0), p(100.0, 100.0), p(0.0, 100.0), p(100.0, 0.0)],
        [p(0.0, 0.0), p(150.0, 0.0), p(-50.0, 0.0), p(100.0, 0.0)],
    ];
    for tolerance in [1.0, 0.1, 0.01] {
        for curve in cubics {
            let mut outline = Outline::new(tolerance);
            outline.move_to(curve[0]);
            outline.cubic_to(curve[1], curve[2], curve[3]);
            let ring = outline.contours().next().unwrap();
            let mut farthest: f64 = 0.0;
            for i in 0..=1000 {
                let t = f64::from(i) / 1000.0;
                let s = 1.0 - t;
                let point = curve[0] * s.powi(3)
                    + curve[1] * (3.0 * s * s * t)
                    + curve[2] * (3.0 * s * t * t)
                    + curve[3] * t.powi(3);
                farthest = farthest.max(distance(point, ring));
            }
            assert!(farthest <= tolerance, "{farthest} {tolerance}");
            assert!(ring.len() < 400, "{}", ring.len());
        }
        let mut outline = Outline::new(tolerance);
        outline.move_to(p(0.0, 0.0));
        outline.quadratic_to(p(50.0, 90.0), p(100.0, 0.0));
        let ring = outline.contours().next().unwrap();
        for i in 0..=1000 {
            let t = f64::from(i) / 1000.0;
            let point = p(100.0 * t, 180.0 * t * (1.0 - t));
            assert!(distance(point, ring) <= tolerance);
        }
    }
}

#[test]
fn a_caption_is_filled_with_its_holes() {
    let bytes = tiny_font();
    let font = Font::new(&bytes).unwrap();
    let mut canvas = Canvas::new(220, 120, [255; 4]);
    let end = font.write(&mut canvas, "oo", 100.0, DVec2::new(10.0, 100.0), [0, 0, 0, 255]);
    assert_eq!(end, DVec2::new(210.0, 100.0));
    let grey = |x, y| canvas.pixel(x, y).unwrap()[0];
    for letter in [0, 100] {
        assert_eq!(grey(letter + 23, 95), 0, "the ring");
        assert_eq!(grey(letter + 60, 60), 255, "the hole");
        assert_eq!(grey(letter + 15, 60), 255, "left of it");
        assert_eq!(grey(letter + 60, 15), 255, "above it");
    }
    // The square without the hole: its control points are 32.5 away from
    // the middle, so the curves are about 30 away.
    let ink: f64 = canvas.pixels().iter().map(|p| 1.0 - f64::from(p[0]) / 255.0).sum();
    let hole = std::f64::consts::PI * 30.07 * 30.07;
    assert!((ink - 2.0 * (6400.0 - hole)).abs() < 12.0, "{ink}");
    assert!(Font::new(b"no font").is_err());
}

#[test]
fn flags_fill_glyphs_as_edge_tables_do() {
    let own = tiny_font();
    let named = std::env::var_os("UMRISS_FONT").map(|file| std::fs::read(file).unwrap());
    if named.is_none() {
        println!("only our own font: UMRISS_FONT names no other");
    }
    for bytes in std::iter::once(own).chain(named) {
        let font = Font::new(&bytes).unwrap();
        let mut glyphs = 0;
        for outline in font.glyphs(40.0, 0.1) {
            let mut contours = Contours::default();
            for contour in outline.contours() {
                contours.push(contour.iter().map(|p| *p + DVec2::new(20.0, 10.0)));
            }
            let mut table = vec![false; 100 * 80];
            fill_polygon(&contours, Rule::EvenOdd, |row, columns| {
                for column in columns.start.max(0)..columns.end.min(100) {
                    if (0..80).contains(&row) {
                        table[(row * 100 + column) as usize] = true;
                    }
                }
            });
            assert_eq!(table, flag_fill(&contours, 100, 80), "glyph {glyphs}");
            glyphs += 1;
        }
        println!("{glyphs} glyphs");
    }
}
