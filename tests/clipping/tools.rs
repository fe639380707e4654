//! Convexity, membership and cutting into convex parts, on the corners that
//! clipping leaves behind: many of them are crossings.

use super::draw::{Draw, pair};
use super::naive::{Exact as Place, exact, winding};
use glam::{DVec3, dvec2};
use std::collections::BTreeSet;
use umriss::kernel::numbers::{Fraction, Sign};
use umriss::kernel::predicates::{Chart, Exact, Eye, ImagePoint, Points, Predicates};
use umriss::polygon::clipping::{Corner, FillRule, Operation, PlaneShape, Ring};
use umriss::polygon::{Membership, convex_parts, membership, turning};

/// Outlines of random results that have no holes.
fn outlines(seed: u64) -> (PlaneShape, Vec<Ring>) {
    let [first, second] = pair(seed);
    let a = PlaneShape::new(&first, FillRule::EvenOdd).unwrap();
    let b = PlaneShape::new(&second, FillRule::NonZero).unwrap();
    let shape = PlaneShape::operation(Operation::Union, &[&a, &b]).unwrap();
    let plain = shape.polygons().iter().filter(|polygon| polygon.holes().is_empty());
    let rings = plain.map(|polygon| polygon.outline().to_vec()).collect();
    (shape, rings)
}

fn places(points: &Points, ring: &[Corner]) -> Vec<Place> {
    let predicates = Predicates::<Exact>::new(points);
    let chart = Chart::new(points).unwrap();
    let place = |corner: &Corner| {
        let (parts, weight) = predicates.ratio(&chart, corner.point);
        parts.map(|part| {
            let quotient = Fraction::new(part, weight.clone()).unwrap();
            quotient.times_power_of_two(predicates.ratio_exponent())
        })
    };
    ring.iter().map(place).collect()
}

fn area(ring: &[Place]) -> Fraction {
    let cross =
        |(a, b): (&Place, &Place)| a[0].clone() * b[1].clone() - a[1].clone() * b[0].clone();
    let terms: Vec<_> = ring.iter().zip(ring.iter().cycle().skip(1)).map(cross).collect();
    Fraction::sum(&terms)
}

/// A ring that begins at its least corner.
fn from_least(mut ring: Vec<Place>) -> Vec<Place> {
    let least = (0..ring.len()).min_by_key(|&i| ring[i].clone()).unwrap();
    ring.rotate_left(least);
    ring
}

#[test]
fn convex_parts_have_the_area_of_the_whole_and_are_those_of_the_rotation_method() {
    let (mut cut, mut whole) = (0, 0);
    for seed in 0..1_500 {
        let (shape, rings) = outlines(seed);
        let points = shape.points();
        let predicates = Predicates::<Exact>::new(&points);
        let chart = Chart::new(&points).unwrap();
        for ring in rings {
            let parts = convex_parts(&predicates, &chart, &ring);
            for part in &parts {
                let turning = turning(&predicates, &chart, part).unwrap();
                assert!(turning.is_convex() && turning.revolutions == 1, "{seed}");
            }
            let places_of = |ring: &Ring| places(&points, ring);
            let sum: Vec<_> = parts.iter().map(|part| area(&places_of(part))).collect();
            assert_eq!(Fraction::sum(&sum), area(&places_of(&ring)), "{seed}");
            let own: BTreeSet<_> = parts.iter().map(|part| from_least(places_of(part))).collect();
            let twin: BTreeSet<_> =
                rotation_method(places_of(&ring)).into_iter().map(from_least).collect();
            assert_eq!(own, twin, "{seed}");
            if parts.len() > 1 { cut += 1 } else { whole += 1 }
        }
    }
    assert!(cut > 300 && whole > 300, "{cut} cut, {whole} whole");
}

/// Cuts concave rings the other way: a corner is moved to the origin and the
/// corner before it onto the negative x axis (scaled, so that all numbers
/// stay rational); it is reflex if the corner after it is below the axis. The
/// ring is cut along the positive axis, up to where that first meets it.
fn rotation_method(ring: Vec<Place>) -> Vec<Vec<Place>> {
    let (mut open, mut parts) = (vec![ring], Vec::new());
    while let Some(ring) = open.pop() {
        let count = ring.len();
        let straight = |i: &usize| {
            let frame = Frame::new(&ring, *i);
            frame.y(&ring[(i + 1) % count]).sign() != Sign::Zero
        };
        let ring: Vec<Place> = (0..count).filter(straight).map(|i| ring[i].clone()).collect();
        let count = ring.len();
        let reflex =
            |&i: &usize| Frame::new(&ring, i).y(&ring[(i + 1) % count]).sign() == Sign::Negative;
        let Some(corner) = (0..count).find(reflex) else {
            parts.push(ring);
            continue;
        };
        let frame = Frame::new(&ring, corner);
        let mut nearest: Option<(Fraction, Place, usize)> = None;
        for edge in 0..count {
            let (a, b) = (&ring[edge], &ring[(edge + 1) % count]);
            let (ya, yb) = (frame.y(a), frame.y(b));
            let place = if edge != corner && ya.sign().is_zero() {
                a.clone()
            } else if ya.sign().is_opposite(yb.sign()) {
                [0, 1].map(|i| {
                    let above = a[i].clone() * yb.clone() - b[i].clone() * ya.clone();
                    above * inverse(yb.clone() - ya.clone())
                })
            } else {
                continue;
            };
            let x = frame.x(&place);
            if x.sign() == Sign::Positive && nearest.as_ref().is_none_or(|(old, ..)| x < *old) {
                nearest = Some((x, place, edge));
            }
        }
        let (_, place, edge) = nearest.unwrap();
        let steps = (edge + count - corner) % count;
        let around: Vec<Place> = (0..count).map(|i| ring[(corner + i) % count].clone()).collect();
        let mut near = around[..=steps].to_vec();
        if near[steps] != place {
            near.push(place.clone());
        }
        let mut far = vec![place];
        far.extend_from_slice(&around[steps + 1..]);
        open.extend([near, far]);
    }
    parts
}

fn inverse(value: Fraction) -> Fraction {
    value.inverse().unwrap()
}

/// The frame of a corner: it is the origin, the way to it the x axis.
struct Frame {
    origin: Place,
    axis: Place,
}

impl Frame {
    fn new(ring: &[Place], corner: usize) -> Self {
        let before = &ring[(corner + ring.len() - 1) % ring.len()];
        let origin = ring[corner].clone();
        let axis = [0, 1].map(|i| origin[i].clone() - before[i].clone());
        Frame { origin, axis }
    }

    fn x(&self, place: &Place) -> Fraction {
        let [x, y] = [0, 1].map(|i| place[i].clone() - self.origin[i].clone());
        x * self.axis[0].clone() + y * self.axis[1].clone()
    }

    fn y(&self, place: &Place) -> Fraction {
        let [x, y] = [0, 1].map(|i| place[i].clone() - self.origin[i].clone());
        y * self.axis[0].clone() - x * self.axis[1].clone()
    }
}

#[test]
fn membership_is_what_winding_numbers_say() {
    for seed in 0..500 {
        let [rings, _] = pair(seed);
        let mut draw = Draw::new(seed ^ 0x77);
        let mut vertices: Vec<DVec3> = Vec::new();
        let polygons: Vec<_> = rings
            .iter()
            .map(|rings| {
                let numbers = rings.iter().map(|ring| {
                    let first = vertices.len() as u32;
                    vertices.extend(ring.iter().map(|corner| corner.extend(0.0)));
                    (first..vertices.len() as u32).collect::<Vec<_>>()
                });
                umriss::polygon::clipping::Polygon::of_vertices(numbers)
            })
            .collect();
        let first_probe = vertices.len();
        let probes: Vec<_> = (0..10)
            .map(|_| match draw.below(3) {
                // Straight above and below corners, or on them.
                0 => {
                    let corner = rings[0][0][draw.below(rings[0][0].len())];
                    dvec2(corner.x, [corner.y, draw.float() * 8.0 - 4.0][draw.below(2)])
                }
                _ => dvec2(draw.float() * 10.0 - 5.0, draw.float() * 10.0 - 5.0),
            })
            .collect();
        vertices.extend(probes.iter().map(|probe| probe.extend(0.0)));
        let points = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
        let predicates = Predicates::<Exact>::new(&points);
        let chart = Chart::new(&points).unwrap();
        for (i, &probe) in probes.iter().enumerate() {
            let all = polygons.iter().flat_map(|polygon| &polygon.rings).map(Vec::as_slice);
            let point = ImagePoint::Vertex((first_probe + i) as u32);
            let on_edge = rings.iter().flatten().any(|ring| {
                (0..ring.len()).any(|i| {
                    let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
                    let [a3, b3, p3] = [a, b, probe].map(|p| p.extend(0.0));
                    umriss::kernel::predicates::are_collinear(a3, b3, p3)
                        && probe == probe.clamp(a.min(b), a.max(b))
                })
            });
            match membership(&predicates, &chart, all, point) {
                Membership::Border => assert!(on_edge, "{seed}: {probe}"),
                Membership::Away { winding: number, crossings } => {
                    assert!(!on_edge, "{seed}: {probe}");
                    let place = exact(probe);
                    let of = |ring: &Vec<glam::DVec2>| {
                        let ring: Vec<_> = ring.iter().map(|&corner| exact(corner)).collect();
                        winding(&ring, &place)
                    };
                    assert_eq!(number, rings.iter().flatten().map(of).sum::<i32>(), "{seed}");
                    assert_eq!(crossings as i32 & 1, number & 1, "{seed}");
                }
            }
        }
    }
}
