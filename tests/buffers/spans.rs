//! The span buffer: right when repaired, wrong as it is known to be wrong
//! when not, and in need of no depth where the order is known.

use crate::scenes::*;
use glam::DVec3;
use umriss::kernel::predicates::Exact;
use umriss::model::{Camera, View};
use umriss::raster::{
    Compare, ItemBuffer, OrderError, Samples, c_buffer, front_to_back, span_buffer,
    span_buffer_with,
};
use umriss::run::Run;
use umriss::view::LineQuestion;

fn front() -> Camera {
    Camera::Orthographic { forward: DVec3::Y, target: None, up: DVec3::Z }
}

fn spans(view: &View, question: &LineQuestion, samples: &Samples, compare: Compare) -> ItemBuffer {
    span_buffer_with::<Exact>(view, question, samples, compare, &Run::default()).unwrap()
}

#[test]
fn spans_and_rays_agree_at_every_sample() {
    let mut seen = 0;
    for (name, triangles) in scenes() {
        let mesh = mesh(&triangles);
        for (number, camera) in cameras().iter().enumerate() {
            for size in [ON_SAMPLES, 77] {
                ask(&mesh, camera, size, |view, question, samples| {
                    let judge = rays(view, question, samples);
                    let buffer = span_buffer::<Exact>(view, question, samples, &Run::default());
                    let buffer = buffer.unwrap();
                    let wrong = differences(&judge, &buffer);
                    assert_eq!(wrong, 0, "{name}, view {number}, size {size}");
                    seen += samples_of(&judge).filter(|&(c, r)| judge.item(c, r).is_some()).count();
                });
            }
        }
    }
    assert!(seen > 100_000, "{seen}");
}

#[test]
fn random_soups_agree_in_small_pictures() {
    for seed in 0..40 {
        let cells = [None, Some(3.0), Some(6.0)][seed as usize % 3];
        let mesh = mesh(&soup(seed, 30, cells));
        let camera = cameras()[seed as usize % 6];
        ask(&mesh, &camera, 8 + seed as u32, |view, question, samples| {
            let judge = rays(view, question, samples);
            let buffer = spans(view, question, samples, Compare::Crossings);
            assert_eq!(differences(&judge, &buffer), 0, "seed {seed}");
        });
    }
}

/// Two triangles that cross along a vertical line of the picture.
fn crossing() -> Vec<Triangle> {
    let point = DVec3::new;
    vec![
        [point(0.0, 0.0, 0.0), point(8.0, 4.0, 1.0), point(8.0, 4.0, 7.0)],
        [point(8.0, 0.0, 0.0), point(0.0, 4.0, 1.0), point(0.0, 4.0, 7.0)],
    ]
}

#[test]
fn crossing_triangles_fail_without_a_cut_where_they_cross() {
    ask(&mesh(&crossing()), &front(), 64, |view, question, samples| {
        let judge = rays(view, question, samples);
        for compare in [Compare::Start, Compare::Middle] {
            let wrong = differences(&judge, &spans(view, question, samples, compare));
            assert!(wrong > 100, "{compare:?}: {wrong}");
        }
        assert_eq!(differences(&judge, &spans(view, question, samples, Compare::Crossings)), 0);
    })
    .unwrap();
}

#[test]
fn a_pair_that_crosses_is_cut_once_in_each_row() {
    ask(&mesh(&crossing()), &front(), 64, |view, question, samples| {
        let run = Run::default();
        let judge = rays(view, question, samples);
        span_buffer::<Exact>(view, question, samples, &run).unwrap();
        // Rows in which both triangles cover two neighbours that the one and
        // the other owns.
        let alone = [0, 1].map(|triangle: u32| {
            c_buffer::<Exact>(view, question, samples, &[triangle], &run).unwrap()
        });
        let both = |c, r| alone.iter().all(|buffer| buffer.item(c, r).is_some());
        let crosses = |&row: &u32| {
            (1..judge.width()).any(|c| {
                both(c - 1, row) && both(c, row) && judge.item(c - 1, row) != judge.item(c, row)
            })
        };
        let rows = (0..judge.height()).filter(crosses).count();
        assert!(rows > 20);
        assert_eq!(run.counters().get("span-cuts-at-crossings"), rows as u64);
    })
    .unwrap();
}

#[test]
fn triangles_with_a_common_left_vertex_fail_when_compared_there() {
    // The vertex lies on a sample, so both spans of that row begin where
    // they are equally near.
    let point = DVec3::new;
    let apex = point(1.125, 1.0, 1.125);
    // The farther one has the lesser corners, so it wins where they tie.
    let near = [apex, point(4.0, 0.0, 0.0), point(4.0, 0.0, 4.0)];
    let far = [apex, point(3.5, 3.0, 0.0), point(3.5, 3.0, 4.0)];
    ask(&mesh(&[near, far, margin()[0]]), &front(), ON_SAMPLES, |view, question, samples| {
        let judge = rays(view, question, samples);
        let on_apex = |(c, r)| (samples.point(c, r) - apex).with_y(0.0) == DVec3::ZERO;
        assert!(samples_of(&judge).any(on_apex), "the vertex lies on a sample");
        let wrong = |compare| differences(&judge, &spans(view, question, samples, compare));
        assert!(wrong(Compare::Start) > 1);
        // At the vertex itself they are equally near: the tie is lost.
        assert_eq!(wrong(Compare::Middle), 1);
        assert_eq!(wrong(Compare::Crossings), 0);
    })
    .unwrap();
}

#[test]
fn the_order_of_triangles_changes_nothing() {
    for (name, triangles) in scenes() {
        let mut other = triangles.clone();
        other.reverse();
        other.rotate_left(triangles.len() / 3);
        other.iter_mut().step_by(2).for_each(|triangle| triangle.rotate_left(1));
        let count = triangles.len() as u32;
        let back = |item: u32| (count - 1) - (item + count / 3) % count;
        for camera in cameras() {
            let see = |triangles: &[Triangle]| {
                let mesh = mesh(triangles);
                (mesh.triangles().len() == count as usize).then_some(())?;
                ask(&mesh, &camera, 40, |view, question, samples| {
                    spans(view, question, samples, Compare::Crossings)
                })
            };
            let (Some(one), Some(two)) = (see(&triangles), see(&other)) else {
                continue;
            };
            for (column, row) in samples_of(&one) {
                let mapped = two.item(column, row).map(back);
                assert_eq!(one.item(column, row), mapped, "{name}: {column} {row}");
            }
        }
    }
}

#[test]
fn a_fan_owns_each_of_its_samples_once() {
    let triangles = fan(48);
    ask(&mesh(&triangles), &front(), ON_SAMPLES, |view, question, samples| {
        let buffer = spans(view, question, samples, Compare::Crossings);
        assert_eq!(differences(&rays(view, question, samples), &buffer), 0);
        let sample = |column, row| samples.point(column, row);
        let is_on = |v: &DVec3, x: DVec3| (v.x, v.z) == (x.x, x.z);
        let on_vertex = samples_of(&buffer).filter(|&(column, row)| {
            triangles.iter().flatten().any(|v| is_on(v, sample(column, row)))
        });
        assert!(on_vertex.count() > 30, "vertices lie on samples");
        // The last triangle is the margin, which nobody sees.
        let slices = &triangles[..48];
        for (column, row) in samples_of(&buffer) {
            let x = sample(column, row);
            let inside = slices.iter().any(|&[a, b, c]| {
                let side =
                    |p: DVec3, q: DVec3| (q.x - p.x) * (x.z - p.z) - (q.z - p.z) * (x.x - p.x);
                let signs = [side(a, b), side(b, c), side(c, a)];
                signs.iter().all(|s| *s >= 0.0) || signs.iter().all(|s| *s <= 0.0)
            });
            assert_eq!(buffer.item(column, row).is_some(), inside, "{column} {row}");
        }
    })
    .unwrap();
}

/// Parallel walls with random triangles in them, nearest first.
fn walls() -> Vec<Triangle> {
    let mut next = random(4);
    (0..60)
        .map(|i| {
            let y = f64::from(i) * 0.5;
            [0; 3].map(|_| DVec3::new(next() * 9.0, y, next() * 9.0))
        })
        .collect()
}

#[test]
fn a_known_order_needs_no_depths() {
    let triangles = walls();
    ask(&mesh(&triangles), &front(), 65, |view, question, samples| {
        let judge = rays(view, question, samples);
        let draw = |order: &[u32]| {
            c_buffer::<Exact>(view, question, samples, order, &Run::default()).unwrap()
        };
        let order: Vec<u32> = (0..triangles.len() as u32).collect();
        assert_eq!(differences(&judge, &draw(&order)), 0);
        let backwards: Vec<u32> = order.iter().rev().copied().collect();
        assert!(differences(&judge, &draw(&backwards)) > 500, "the order is believed");
        let some = draw(&order[..1]);
        assert!(samples_of(&some).all(|(c, r)| some.item(c, r).is_none_or(|item| item == 0)));
    })
    .unwrap();
}

#[test]
fn an_order_is_found_where_there_is_one() {
    let mut ordered = 0;
    for seed in 0..400 {
        let count = 2 + seed as usize % 9;
        let triangles = soup(seed, count, (seed % 2 == 0).then_some(5.0));
        let _ = ask(&mesh(&triangles), &front(), 33, |view, question, samples| {
            let judge = rays(view, question, samples);
            match front_to_back::<Exact>(question, &Run::default()) {
                Ok(order) => {
                    let run = Run::default();
                    let image = c_buffer::<Exact>(view, question, samples, &order, &run).unwrap();
                    // Of two that are equally near at a sample, the order has
                    // the one first that is nearer beside it.
                    for (c, r) in samples_of(&judge) {
                        let [own, other] = [&image, &judge].map(|image| image.depth(c, r));
                        let same = image.item(c, r) == judge.item(c, r);
                        assert!(same || (own - other).abs() < 1e-14, "seed {seed}: {c}, {r}");
                    }
                    ordered += 1;
                }
                Err(OrderError::Crossing(..) | OrderError::Cycle(_)) => {}
                Err(OrderError::Cancelled(_)) => panic!("seed {seed} was not cancelled"),
            }
        });
    }
    assert!((50..350).contains(&ordered), "{ordered}");
}

#[test]
fn bars_in_a_ring_have_no_order() {
    let bar = |a: DVec3, b: DVec3, across: DVec3| [[a, b, b + across], [a, b + across, a + across]];
    let p = DVec3::new;
    // Each begins behind the one before it and ends in front of the next.
    let bars = [
        bar(p(0.0, 2.0, 0.0), p(10.0, 0.0, 0.0), p(0.0, 0.0, 1.0)),
        bar(p(9.0, 2.0, 0.0), p(9.0, 0.0, 10.0), p(1.0, 0.0, 0.0)),
        bar(p(10.0, 2.0, 9.0), p(0.0, 0.0, 9.0), p(0.0, 0.0, 1.0)),
        bar(p(0.0, 2.0, 10.0), p(0.0, 0.0, 0.0), p(1.0, 0.0, 0.0)),
    ];
    let order = |bars: &[[Triangle; 2]]| {
        ask(&mesh(&bars.concat()), &front(), 33, |_, question, _| {
            front_to_back::<Exact>(question, &Run::default())
        })
        .unwrap()
    };
    assert!(matches!(order(&bars), Err(OrderError::Cycle(_))), "{:?}", order(&bars));
    assert_eq!(order(&bars[..3]).map(|order| order.len()), Ok(6));
    let crossing = order(&[[crossing()[0], crossing()[1]]]);
    assert_eq!(crossing, Err(OrderError::Crossing(0, 1)));
}
