//! The A-buffer: what rays see, bit by bit; masks that add up; the table's
//! distance from the truth; what opacity and priority do to colours.

use crate::scenes::*;
use glam::DVec3;
use umriss::fill::{Pattern, Rgba};
use umriss::kernel::predicates::Exact;
use umriss::model::{Camera, View};
use umriss::raster::{
    ABufferOptions, Division, Fragments, MaskTable, Masks, Paint, Samples, Shading, a_buffer,
    coverage, preview, visible_fragments,
};
use umriss::run::Run;
use umriss::view::LineQuestion;

const DIVISIONS: [Division; 2] = [Division::FourByFour, Division::FourByEight];

fn front() -> Camera {
    Camera::Orthographic { forward: DVec3::Y, target: None, up: DVec3::Z }
}

fn fragments(
    view: &View,
    question: &LineQuestion,
    pixels: &Samples,
    division: Division,
    masks: Masks,
) -> Fragments {
    let options = ABufferOptions { division, masks };
    visible_fragments::<Exact>(view, question, pixels, options, &Run::default()).unwrap()
}

#[test]
fn sub_pixels_hold_what_rays_see() {
    for (name, triangles) in scenes() {
        let mesh = mesh(&triangles);
        for (number, camera) in cameras().iter().enumerate() {
            for size in [ON_SAMPLES, 77] {
                ask(&mesh, camera, size, |view, question, samples| {
                    let buffer = a_buffer::<Exact>(view, question, samples, &Run::default());
                    let wrong = differences(&rays(view, question, samples), &buffer.unwrap());
                    assert_eq!(wrong, 0, "{name}, view {number}, size {size}");
                });
            }
        }
    }
}

#[test]
fn both_divisions_hold_what_rays_see_at_their_centres() {
    for (name, triangles) in scenes() {
        let mesh = mesh(&triangles);
        for camera in &cameras()[1..] {
            for division in DIVISIONS {
                ask(&mesh, camera, 19, |view, question, pixels| {
                    let fine = pixels.divided(division.columns(), division.rows());
                    let judge = rays(view, question, &fine);
                    let image = fragments(view, question, pixels, division, Masks::Direct);
                    for (column, row) in samples_of(&judge) {
                        let [i, j] = [column % division.columns(), row % division.rows()];
                        let bit = j * division.columns() + i;
                        let pixel = image.of(column / division.columns(), row / division.rows());
                        let seen = pixel.iter().find(|fragment| fragment.mask >> bit & 1 == 1);
                        let seen = seen.map(|fragment| fragment.triangle);
                        assert_eq!(seen, judge.item(column, row), "{name}: {column} {row}");
                    }
                });
            }
        }
    }
}

#[test]
fn visible_fragments_and_what_is_free_add_up() {
    for (name, triangles) in scenes() {
        let mesh = mesh(&triangles);
        for masks in [Masks::Direct, Masks::Table] {
            for division in DIVISIONS {
                ask(&mesh, &cameras()[1], 40, |view, question, pixels| {
                    let image = fragments(view, question, pixels, division, masks);
                    for row in 0..image.height() {
                        for column in 0..image.width() {
                            let masks = image.of(column, row).iter().map(|f| f.mask);
                            let sum: u32 = masks.clone().map(u32::count_ones).sum();
                            let covered = masks.fold(0, |all, mask| all | mask);
                            let free = !covered & division.full();
                            assert_eq!(sum + free.count_ones(), division.bits(), "{name}");
                        }
                    }
                });
            }
        }
    }
}

#[test]
fn triangles_side_by_side_are_apart_and_make_up_their_quad() {
    let mut next = random(3);
    for _ in 0..20 {
        let mut number = |low: f64| low + 3.0 * next();
        // A convex quad, cut along either diagonal.
        let corners = [
            DVec3::new(number(0.0), 0.0, number(0.0)),
            DVec3::new(number(5.0), 0.0, number(0.0)),
            DVec3::new(number(5.0), 0.0, number(5.0)),
            DVec3::new(number(0.0), 0.0, number(5.0)),
        ];
        let [a, b, c, d] = corners;
        let covered = |triangles: &[Triangle]| {
            ask(&mesh(triangles), &front(), 25, |view, question, pixels| {
                let image = fragments(view, question, pixels, Division::FourByFour, Masks::Direct);
                let pixel = |i: u32| image.of(i % image.width(), i / image.width());
                (0..image.width() * image.height())
                    .map(|i| {
                        let masks = || pixel(i).iter().map(|fragment| fragment.mask);
                        let all = masks().fold(0, |all, mask| all | mask);
                        let sum: u32 = masks().map(u32::count_ones).sum();
                        assert_eq!(sum, all.count_ones(), "masks are apart");
                        all
                    })
                    .collect::<Vec<u32>>()
            })
            .unwrap()
        };
        assert_eq!(covered(&[[a, b, c], [a, c, d]]), covered(&[[a, b, d], [b, c, d]]));
    }
}

/// The mask of a half-plane by its sub-pixels' centres.
fn direct(division: Division, gradient: [f64; 2], value: f64) -> u32 {
    (0..division.bits()).fold(0, |mask, bit| {
        let x = (f64::from(bit % division.columns()) + 0.5) / f64::from(division.columns()) - 0.5;
        let y = (f64::from(bit / division.columns()) + 0.5) / f64::from(division.rows()) - 0.5;
        mask | u32::from(gradient[0] * x + gradient[1] * y + value >= 0.0) << bit
    })
}

#[test]
fn the_table_is_as_near_to_the_direct_masks_as_promised() {
    for division in DIVISIONS {
        let table = MaskTable::new(division);
        let mut next = random(9);
        let (mut most, mut bits, mut count, mut equal) = (0, 0_u32, 0_u32, 0_u32);
        for i in 0..200_000 {
            let turn = if i % 8 == 0 { (next() * 16.0).floor() / 16.0 } else { next() };
            let (sine, cosine) = (turn * std::f64::consts::TAU).sin_cos();
            let value = (next() - 0.5) * 1.5;
            let mask = table.half_plane([cosine * 7.0, sine * 7.0], value * 7.0);
            let truth = direct(division, [cosine, sine], value);
            most = most.max(mask.count_ones().abs_diff(truth.count_ones()));
            bits += (mask ^ truth).count_ones();
            equal += u32::from(mask == truth);
            count += 1;
        }
        let share = f64::from(bits) / f64::from(count);
        println!(
            "{division:?}: {most} bits at most, {share:.3} on average, {equal} of {count} equal"
        );
        assert!(most <= MaskTable::bound(division), "{division:?}: {most}");
        assert!(share < f64::from(division.bits()) / 16.0, "{division:?}: {share}");
        assert!(equal > count / 3, "{division:?}: {equal}");
    }
}

#[test]
fn half_planes_from_either_side_of_an_edge_share_no_bit() {
    for division in DIVISIONS {
        let table = MaskTable::new(division);
        let mut next = random(5);
        let mut shared = 0;
        for _ in 0..100_000 {
            let gradient = [next() - 0.5, next() - 0.5];
            let value = (next() - 0.5) * gradient[0].hypot(gradient[1]);
            let one = table.half_plane(gradient, value);
            let other = table.half_plane(gradient.map(|x| -x), -value);
            shared += u32::from(one ^ other != division.full());
        }
        // Only where rounding puts the two sides into different classes.
        assert!(shared < 10, "{division:?}: {shared}");
    }
}

#[test]
fn coverage_by_table_is_nearer_to_the_area() {
    // A thin wedge, whose area in each pixel is known by a fine division.
    let wedge = [DVec3::new(0.0, 0.0, 0.0), DVec3::new(30.0, 0.0, 1.3), DVec3::new(30.0, 0.0, 3.1)];
    ask(&mesh(&[wedge]), &front(), 34, |view, question, pixels| {
        let fine = rays(view, question, &pixels.divided(32, 32));
        let error = |masks| {
            let image = fragments(view, question, pixels, Division::FourByFour, masks);
            let mut sum = 0.0;
            for row in 0..image.height() {
                for column in 0..image.width() {
                    let bits: u32 = image.of(column, row).iter().map(|f| f.mask.count_ones()).sum();
                    let inside = (0..1024)
                        .filter(|i| fine.item(column * 32 + i % 32, row * 32 + i / 32).is_some());
                    sum += (f64::from(bits) / 16.0 - inside.count() as f64 / 1024.0).abs();
                }
            }
            sum
        };
        let errors = [error(Masks::Direct), error(Masks::Table)];
        println!("sum of errors of coverage: direct {:.3}, table {:.3}", errors[0], errors[1]);
        assert!(errors[1] < errors[0]);
    })
    .unwrap();
}

/// A wall of two triangles that fills the picture, and more.
fn wall(left: f64, right: f64) -> [Triangle; 2] {
    let corner = |x: f64, z: f64| DVec3::new(x, left + (right - left) * x / 8.0, z);
    let [a, b, c, d] = [corner(0.0, 0.0), corner(8.0, 0.0), corner(8.0, 8.0), corner(0.0, 8.0)];
    [[a, b, c], [a, c, d]]
}

#[test]
fn opacity_mixes_layers_from_front_to_back_where_they_cross_too() {
    let red = Paint { colour: [1.0, 0.0, 0.0], opacity: 0.5 };
    let blue = Paint { colour: [0.0, 0.0, 1.0], opacity: 0.5 };
    let paint = |triangle: u32, _: [u32; 2]| if triangle < 2 { red } else { blue };
    let (red_first, blue_first): (Rgba, Rgba) = ([170, 0, 85, 191], [85, 0, 170, 191]);
    for (other, left, right) in [
        (wall(1.0, 1.0), red_first, red_first),
        (wall(-1.0, -1.0), blue_first, blue_first),
        // Through the first wall along the middle of the picture.
        (wall(1.0, -1.0), red_first, blue_first),
    ] {
        let triangles = [wall(0.0, 0.0), other].concat();
        ask(&mesh(&triangles), &front(), 35, |view, question, pixels| {
            let options = ABufferOptions::default();
            let canvas =
                preview::<Exact>(view, question, pixels, options, &paint, &Run::default()).unwrap();
            let (width, row) = (canvas.width(), canvas.height() / 3);
            for column in 2..width - 2 {
                let middle = width / 2;
                let expected = if column < middle { left } else { right };
                if column != middle {
                    assert_eq!(canvas.pixel(column, row), Some(expected), "{column}");
                }
            }
            assert!(canvas.pixel(0, 0).unwrap()[3] < 191);
        })
        .unwrap();
    }
}

#[test]
fn a_preview_of_opaque_triangles_is_as_opaque_as_they_cover() {
    let triangles = fan(24);
    ask(&mesh(&triangles), &front(), 50, |view, question, pixels| {
        let shading = Shading::new(view, question);
        let options = ABufferOptions { division: Division::FourByEight, ..Default::default() };
        let paint = |triangle, at| shading.paint(triangle, at);
        let run = Run::default();
        let canvas = preview::<Exact>(view, question, pixels, options, &paint, &run).unwrap();
        let image = fragments(view, question, pixels, Division::FourByEight, Masks::Direct);
        let grey = coverage(&image);
        assert_eq!([canvas.width(), canvas.height()], [pixels.width(), pixels.height()]);
        for row in 0..canvas.height() {
            for column in 0..canvas.width() {
                let opacity = canvas.pixel(column, row).unwrap()[3];
                let black = 255 - grey.pixel(column, row).unwrap()[0];
                assert!(opacity.abs_diff(black) <= 1, "{column} {row}: {opacity} {black}");
            }
        }
    })
    .unwrap();
}

#[test]
fn a_pattern_of_the_page_stays_and_one_of_an_object_moves_with_it() {
    let marks = |shift: f64, of_object: bool| {
        let shift = DVec3::new(shift, 0.0, 0.0);
        let moved = wall(0.0, 0.0).map(|triangle| triangle.map(|p| p * 0.25 + shift));
        let triangles: Vec<Triangle> = moved.into_iter().chain(margin()).collect();
        ask(&mesh(&triangles), &front(), ON_SAMPLES, |view, question, pixels| {
            let shading = Shading::new(view, question);
            let pattern = Pattern::from_name("hatch").unwrap();
            let shading = if of_object {
                shading.with_pattern_of_objects(pattern, pixels)
            } else {
                shading.with_pattern(pattern)
            };
            let paint = |triangle, at| shading.paint(triangle, at);
            let options = ABufferOptions::default();
            let canvas =
                preview::<Exact>(view, question, pixels, options, &paint, &Run::default()).unwrap();
            // The row through the middle of the wall, from its left side.
            let row = 33 - 4;
            let left = 1 + (shift.x * 4.0) as u32;
            (0..8).map(|i| canvas.pixel(left + i, row).unwrap()[0]).collect::<Vec<u8>>()
        })
        .unwrap()
    };
    // A pixel is a quarter, so a half moves by two pixels of a tile of six.
    assert_ne!(marks(0.0, false), marks(0.5, false));
    assert_eq!(marks(0.0, true), marks(0.5, true));
    assert_eq!(marks(0.0, false)[2..], marks(0.5, false)[..6]);
}
