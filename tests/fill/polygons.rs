//! Starts of spans, polygons and triangles.

use crate::random;
use glam::DVec2;
use umriss::fill::{
    Canvas, Contours, Rule, SUBPIXELS, SpanStarts, fill_polygon, fill_triangle, flag_fill, xor_fill,
};

const WIDTH: u32 = 40;
const HEIGHT: u32 = 30;

/// How often each pixel of the window is filled.
fn filled(contours: &Contours, rule: Rule) -> Vec<u32> {
    let mut counts = vec![0; (WIDTH * HEIGHT) as usize];
    fill_polygon(contours, rule, |row, columns| {
        for column in columns {
            if (0..i64::from(WIDTH)).contains(&column) && (0..i64::from(HEIGHT)).contains(&row) {
                counts[(row * i64::from(WIDTH) + column) as usize] += 1;
            }
        }
    });
    counts
}

fn contours(rings: &[&[[f64; 2]]]) -> Contours {
    let mut contours = Contours::default();
    for ring in rings {
        contours.push(ring.iter().map(|&[x, y]| DVec2::new(x, y)));
    }
    contours
}

#[test]
fn starts_of_spans_are_those_of_the_formula() {
    let mut number = random(1);
    let mut rows = 0_u64;
    for i in 0..100_000_i64 {
        // Whole pixels, whole centres and anything in between.
        let grain = [1, SUBPIXELS, SUBPIXELS / 2][i as usize % 3];
        let mut point = || [0, 0].map(|_| (number(12_000) - 6_000).div_euclid(grain) * grain);
        let (a, b) = (point(), point());
        let (top, bottom) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        let crossed: Vec<i64> = (-30..30)
            .filter(|row| {
                let y = row * SUBPIXELS + SUBPIXELS / 2;
                top[1] <= y && y < bottom[1]
            })
            .collect();
        let Some(mut starts) = SpanStarts::new(a, b) else {
            assert!(crossed.is_empty());
            continue;
        };
        assert_eq!(starts.rows(), crossed[0]..crossed[crossed.len() - 1] + 1);
        for row in crossed {
            // The first column whose centre is not left of the edge.
            let (dx, dy) = (bottom[0] - top[0], bottom[1] - top[1]);
            let y = row * SUBPIXELS + SUBPIXELS / 2;
            let is_right = |column: i64| {
                let x = column * SUBPIXELS + SUBPIXELS / 2;
                (x - top[0]) * dy >= (y - top[1]) * dx
            };
            assert!(is_right(starts.column()) && !is_right(starts.column() - 1));
            starts.step();
            rows += 1;
        }
    }
    assert!(rows > 1_000_000, "{rows}");
}

#[test]
fn a_fan_of_a_thousand_triangles_fills_each_centre_once() {
    // Around a centre, with vertices on centres and beside them.
    for middle in [[20 * SUBPIXELS + 128, 15 * SUBPIXELS + 128], [5000, 3777]] {
        let rim = |i: i64| {
            let angle = (i % 1000) as f64 / 1000.0 * std::f64::consts::TAU;
            let place = [angle.cos() * 2800.0, angle.sin() * 2800.0].map(|x| x.round() as i64);
            // A third of the rim's vertices lie on centres.
            let snap = |x: i64| if i % 3 == 0 { x.div_euclid(256) * 256 } else { x };
            [0, 1].map(|k| middle[k] + snap(place[k]))
        };
        let mut counts = vec![0_u32; (WIDTH * HEIGHT) as usize];
        let mut ring = Vec::new();
        for i in 0..1000 {
            let window = [0..i64::from(WIDTH), 0..i64::from(HEIGHT)];
            fill_triangle([middle, rim(i), rim(i + 1)], window, |column, row| {
                counts[(row * i64::from(WIDTH) + column) as usize] += 1;
            });
            ring.push(rim(i).map(|x| x as f64 / SUBPIXELS as f64));
        }
        // Slices may fold back where the rim was snapped; all turn one way
        // or their overlap is even-odd's business.
        let polygon = filled(&contours(&[&ring]), Rule::EvenOdd);
        for (count, inside) in counts.iter().zip(polygon) {
            assert_eq!(count % 2, inside);
        }
        assert!(counts.iter().filter(|count| **count % 2 == 1).count() > 200);
    }
}

#[test]
fn the_fan_of_a_regular_rim_overlaps_nowhere() {
    let middle = [20 * SUBPIXELS + 128, 15 * SUBPIXELS + 128];
    let rim = |i: i64| {
        let angle = (i % 1000) as f64 / 1000.0 * std::f64::consts::TAU;
        let place = [angle.cos() * 60_000.0, angle.sin() * 60_000.0].map(|x| x.round() as i64);
        [0, 1].map(|k| middle[k] + place[k])
    };
    let mut counts = vec![0_u32; (WIDTH * HEIGHT) as usize];
    for i in 0..1000 {
        let window = [0..i64::from(WIDTH), 0..i64::from(HEIGHT)];
        fill_triangle([middle, rim(i), rim(i + 1)], window, |column, row| {
            counts[(row * i64::from(WIDTH) + column) as usize] += 1;
        });
    }
    assert!(counts.iter().all(|count| *count == 1));
}

#[test]
fn the_textbook_polygon_has_its_spans() {
    // A(2,1) B(3,5) C(6,6) D(3,8) E(0,4), with scan lines at whole y: moved
    // by half a pixel, for here they are at the centres. The exact pairs are
    // 1: 2, 2; 2: 4/3, 9/4; 3: 2/3, 5/2; 4: 0, 11/4; 5: 3/4, 3; 6: 3/2, 6;
    // 7: 9/4, 9/2; a span holds the whole x from the first on, before the last.
    let ring: &[[f64; 2]] = &[[2.5, 1.5], [3.5, 5.5], [6.5, 6.5], [3.5, 8.5], [0.5, 4.5]];
    let mut spans = Vec::new();
    fill_polygon(&contours(&[ring]), Rule::EvenOdd, |row, columns| spans.push((row, columns)));
    let expected =
        [(2, 2..3), (3, 1..3), (4, 0..3), (5, 1..3), (6, 2..6), (7, 3..5)].map(|(y, x)| (y, x));
    assert_eq!(spans, expected);
}

#[test]
fn three_fills_agree_on_random_polygons() {
    let mut number = random(77);
    for i in 0..400 {
        let mut shape = Contours::default();
        for _ in 0..1 + i % 3 {
            let grain = [1.0, 256.0, 128.0][i % 3];
            let corners = 3 + number(9);
            shape.push((0..corners).map(|_| {
                let [x, y] = [14_000, 11_000].map(|limit| number(limit) as f64 - 2_000.0);
                DVec2::new((x / grain).round() * grain, (y / grain).round() * grain) / 256.0
            }));
        }
        let table: Vec<bool> = filled(&shape, Rule::EvenOdd).iter().map(|n| *n == 1).collect();
        assert!(filled(&shape, Rule::Winding).iter().all(|count| *count <= 1));
        assert_eq!(table, flag_fill(&shape, WIDTH, HEIGHT), "flags, polygon {i}");
        assert_eq!(table, xor_fill(&shape, WIDTH, HEIGHT), "triangles, polygon {i}");
    }
}

#[test]
fn the_middle_of_a_pentagram_is_inside_by_winding_only() {
    let point = |i: usize| {
        let angle = (i * 2) as f64 / 5.0 * std::f64::consts::TAU;
        [20.0 + 14.0 * angle.sin(), 15.0 - 14.0 * angle.cos()]
    };
    let star: Vec<[f64; 2]> = (0..5).map(point).collect();
    let star = contours(&[&star]);
    let at = |column: u32, row: u32| (row * WIDTH + column) as usize;
    let (odd, wound) = (filled(&star, Rule::EvenOdd), filled(&star, Rule::Winding));
    assert_eq!([odd[at(20, 15)], wound[at(20, 15)]], [0, 1]);
    assert_eq!([odd[at(20, 4)], wound[at(20, 4)]], [1, 1]);
    assert!(odd.iter().sum::<u32>() < wound.iter().sum());
}

#[test]
fn holes_are_holes_by_even_odd_and_by_sense() {
    let outer: &[[f64; 2]] = &[[2.0, 2.0], [30.0, 2.0], [30.0, 20.0], [2.0, 20.0]];
    let same: &[[f64; 2]] = &[[8.0, 8.0], [20.0, 8.0], [20.0, 12.0], [8.0, 12.0]];
    let against: Vec<[f64; 2]> = same.iter().rev().copied().collect();
    let area = |shape: &Contours, rule| filled(shape, rule).iter().sum::<u32>();
    let (ring, block) = (28 * 18 - 12 * 4, 28 * 18);
    for hole in [same, &against] {
        assert_eq!(area(&contours(&[outer, hole]), Rule::EvenOdd), ring);
    }
    assert_eq!(area(&contours(&[outer, same]), Rule::Winding), block);
    assert_eq!(area(&contours(&[outer, &against]), Rule::Winding), ring);
}

#[test]
fn painted_coverage_is_the_area() {
    let mut canvas = Canvas::new(WIDTH, HEIGHT, [255; 4]);
    let ring = [[3.3, 4.1], [35.2, 9.6], [12.4, 27.9]].map(DVec2::from);
    let twice = (ring[1] - ring[0]).perp_dot(ring[2] - ring[0]);
    canvas.paint([&ring[..]], Rule::Winding, [0, 0, 0, 255]);
    let sum: f64 = canvas.pixels().iter().map(|p| 1.0 - f64::from(p[0]) / 255.0).sum();
    assert!((sum - twice / 2.0).abs() < 1.0, "{sum} {twice}");
    let half = Canvas::new(1, 1, [10, 20, 30, 128]).on([255, 255, 255]);
    assert_eq!(half.pixel(0, 0), Some([132, 137, 142, 255]));
}
