//! Boolean operations against `geo`, in one run.
//!
//! Contenders run in turn, round after round, so that a machine whose speed
//! drifts slows all of them alike; what counts are the ratios. Either takes
//! a `geo::MultiPolygon` and gives one back, valid and in doubles. Tables on
//! standard output:
//!
//! 1. time: stars with 10 to 100 thousand corners each, stars with holes,
//!    long thin spikes;
//! 2. error: the exact area of the symmetric difference between what is
//!    right and what was returned, over the area of the union;
//! 3. what happens to slivers.
//!
//! `cargo bench --bench clipping` (up to 100 thousand corners; another
//! number of thousands as an argument: `-- 10`).

#![allow(clippy::print_stdout)]

use geo::{BooleanOps, Coord, LineString, MultiPolygon, Polygon};
use std::error::Error;
use std::f64::consts::TAU;
use std::time::Instant;
use umriss::polygon::clipping::{Operation, PlaneShape};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Two operands.
type Pair = [MultiPolygon<f64>; 2];

fn main() -> Outcome<()> {
    let thousands = std::env::args().skip(1).find_map(|word| word.parse().ok()).unwrap_or(100);
    times(thousands * 1000)?;
    errors()?;
    slivers()
}

/// A multiplicative generator (Lehmer 1951, parameters of L'Ecuyer 1999).
struct Draw(u128);

impl Draw {
    fn new(seed: u128) -> Self {
        Draw(seed << 64 | 0x9e37_79b9_7f4a_7c15)
    }

    /// A float in 0..1.
    fn float(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(0xda94_2042_e4dd_58b5);
        ((self.0 >> 64) as u64 >> 11) as f64 / f64::powi(2.0, 53)
    }
}

/// A star with `corners` corners, whose distances from the middle are drawn
/// between two bounds.
fn star(corners: usize, low: f64, high: f64, centre: [f64; 2], seed: u128) -> LineString<f64> {
    let mut draw = Draw::new(seed);
    let corner = |i: usize| {
        let angle = TAU * (i as f64 + 0.5) / corners as f64;
        let radius = low + (high - low) * draw.float();
        Coord { x: centre[0] + radius * angle.cos(), y: centre[1] + radius * angle.sin() }
    };
    let mut ring: Vec<_> = (0..corners).map(corner).collect();
    ring.push(ring[0]);
    LineString(ring)
}

/// Stars with seven arms, as rough as their edges are long: more than half
/// of the edges cross one of the other star, wherever they are.
fn stars(corners: usize) -> Pair {
    let one = |seed| {
        let mut draw = Draw::new(seed);
        let step = TAU / corners as f64;
        let corner = |i: usize| {
            let angle = step * (i as f64 + 0.5);
            let radius = 0.8 + 0.2 * (7.0 * angle).sin() + 2.0 * step * draw.float();
            Coord { x: radius * angle.cos(), y: radius * angle.sin() }
        };
        let mut ring: Vec<_> = (0..corners).map(corner).collect();
        ring.push(ring[0]);
        MultiPolygon(vec![Polygon::new(LineString(ring), Vec::new())])
    };
    [one(1), one(2)]
}

/// Stars whose edges are long: from anywhere in a wide band to anywhere.
fn wild_stars(corners: usize) -> Pair {
    let one = |seed| Polygon::new(star(corners, 0.5, 1.0, [0.0, 0.0], seed), Vec::new());
    [MultiPolygon(vec![one(1)]), MultiPolygon(vec![one(2)])]
}

/// Smooth outlines with as many corners in small holes.
fn with_holes(corners: usize) -> Pair {
    let one = |seed: u128, shift: f64| {
        let side = ((corners as f64 / 32.0).sqrt() as usize).max(1);
        let cell = 1.2 / side as f64;
        let hole = |i: usize| {
            let at = |i: usize| -0.6 + shift + cell * (i as f64 + 0.5);
            let centre = [at(i % side), at(i / side)];
            star(16, cell * 0.2, cell * 0.45, centre, seed * 1_000_003 + i as u128)
        };
        let outline = star(corners / 2, 0.95, 1.0, [shift, 0.0], seed);
        Polygon::new(outline, (0..side * side).map(hole).collect())
    };
    [MultiPolygon(vec![one(1, 0.0)]), MultiPolygon(vec![one(2, 0.011)])]
}

/// Spikes from near the middle out, each crossing many of the other star.
fn spikes(corners: usize) -> Pair {
    let one = |turn: f64, seed: u128| {
        let mut draw = Draw::new(seed);
        let corner = |i: usize| {
            let angle = TAU * (i as f64 + turn + 0.8 * draw.float()) / corners as f64;
            let radius = if i.is_multiple_of(2) { 0.02 } else { 0.7 + 0.3 * draw.float() };
            Coord { x: turn * 0.3 + radius * angle.cos(), y: radius * angle.sin() }
        };
        let mut ring: Vec<_> = (0..corners).map(corner).collect();
        ring.push(ring[0]);
        MultiPolygon(vec![Polygon::new(LineString(ring), Vec::new())])
    };
    [one(0.0, 1), one(0.5, 2)]
}

fn ours(operation: Operation, [a, b]: &Pair) -> Outcome<MultiPolygon<f64>> {
    let (a, b) = (PlaneShape::from_geo(a)?, PlaneShape::from_geo(b)?);
    Ok(PlaneShape::operation(operation, &[&a, &b])?.rounded()?.to_geo())
}

fn geos(operation: Operation, [a, b]: &Pair) -> MultiPolygon<f64> {
    match operation {
        Operation::Intersection => a.intersection(b),
        Operation::Union => a.union(b),
        Operation::Difference => a.difference(b),
        Operation::Xor => a.xor(b),
    }
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// A family of operands and its name.
type Family = (&'static str, fn(usize) -> Pair, usize);

fn times(most: usize) -> Outcome<()> {
    println!(
        "\nIntersection, milliseconds\n\n| corners each | `geo` | exact, rounded | ratio | growth | exact only |"
    );
    println!("| --- | ---: | ---: | ---: | ---: | ---: |");
    let families: [Family; 4] = [
        ("star", stars, usize::MAX),
        ("star with long edges", wild_stars, 1000),
        ("with holes", with_holes, usize::MAX),
        ("spikes", spikes, 100),
    ];
    for (name, make, limit) in families {
        let mut before = None;
        let mut corners = if limit == usize::MAX { 10 } else { 100 };
        while corners <= most.min(limit) {
            let pair = make(corners);
            let [mut theirs, mut own, mut exact, mut ratios] = [(); 4].map(|()| Vec::new());
            let repeats = (10_000 / corners).clamp(1, if limit < usize::MAX { 4 } else { 1000 });
            for round in 0..=5 {
                let start = Instant::now();
                for _ in 0..repeats {
                    std::hint::black_box(geos(Operation::Intersection, &pair));
                }
                let first = start.elapsed().as_secs_f64();
                let start = Instant::now();
                for _ in 0..repeats {
                    std::hint::black_box(ours(Operation::Intersection, &pair)?);
                }
                let second = start.elapsed().as_secs_f64();
                let start = Instant::now();
                for _ in 0..repeats {
                    let [a, b] = [PlaneShape::from_geo(&pair[0])?, PlaneShape::from_geo(&pair[1])?];
                    std::hint::black_box(PlaneShape::operation(
                        Operation::Intersection,
                        &[&a, &b],
                    )?);
                }
                let third = start.elapsed().as_secs_f64();
                // The first round only warms up.
                if round > 0 {
                    let milli = 1e3 / repeats as f64;
                    theirs.push(first * milli);
                    own.push(second * milli);
                    exact.push(third * milli);
                    ratios.push(second / first);
                }
            }
            let time = median(&mut own);
            let growth =
                before.map_or(String::new(), |before: f64| format!("{:.1}", time / before));
            println!(
                "| {name} {corners} | {:.3} | {time:.3} | {:.2} | {growth} | {:.3} |",
                median(&mut theirs),
                median(&mut ratios),
                median(&mut exact),
            );
            before = Some(time);
            corners *= 10;
        }
    }
    Ok(())
}

/// The exact area of where a result differs from the exact one, and that
/// exact area itself.
fn error(operation: Operation, pair: &Pair, result: &MultiPolygon<f64>) -> Outcome<f64> {
    let [a, b] = [PlaneShape::from_geo(&pair[0])?, PlaneShape::from_geo(&pair[1])?];
    let exact = PlaneShape::operation(operation, &[&a, &b])?;
    let result = PlaneShape::from_geo(result)?;
    let area = |shape: &PlaneShape| shape.areas().iter().map(|area| area.to_f64()).sum::<f64>();
    let wrong = area(&PlaneShape::operation(Operation::Xor, &[&exact, &result])?);
    let whole = area(&PlaneShape::operation(Operation::Union, &[&a, &b])?);
    Ok(if whole > 0.0 { wrong / whole } else { wrong })
}

fn errors() -> Outcome<()> {
    println!(
        "\nError, worst of four operations\n\n| case | `geo` | exact, rounded |\n| --- | ---: | ---: |"
    );
    let shifted = |by: f64| {
        stars(100).map(|polygons| {
            use geo::MapCoords;
            polygons.map_coords(|at| Coord { x: at.x + by, y: at.y + by })
        })
    };
    let [star, _] = stars(1000);
    let turned = {
        use geo::MapCoords;
        let (sin, cos) = 1e-9_f64.sin_cos();
        star.map_coords(|at| Coord { x: at.x * cos - at.y * sin, y: at.x * sin + at.y * cos })
    };
    let cases = [
        ("star 1000", stars(1000)),
        ("with holes 1000", with_holes(1000)),
        ("spikes 200", spikes(200)),
        ("star 1000 and itself", [star.clone(), star.clone()]),
        ("star 1000 and itself, turned by 1e-9", [star, turned]),
        ("stars 100, 1e9 off the origin", shifted(1e9)),
    ];
    for (name, pair) in &cases {
        let (mut theirs, mut own) = (0.0_f64, 0.0_f64);
        for operation in Operation::ALL {
            theirs = theirs.max(error(operation, pair, &geos(operation, pair))?);
            own = own.max(error(operation, pair, &ours(operation, pair)?)?);
        }
        println!("| {name} | {theirs:.0e} | {own:.0e} |");
    }
    Ok(())
}

fn slivers() -> Outcome<()> {
    println!(
        "\nSlivers: polygons of the difference\n\n| case | exact | `geo` | exact, rounded |\n| --- | ---: | ---: | ---: |"
    );
    let ring = |corners: &[[f64; 2]]| {
        let closed = corners.iter().chain(&corners[..1]).map(|&[x, y]| Coord { x, y });
        Polygon::new(LineString(closed.collect()), Vec::new())
    };
    let box_of =
        |low: [f64; 2], high: [f64; 2]| ring(&[low, [high[0], low[1]], high, [low[0], high[1]]]);
    let one = |polygon: Polygon<f64>| MultiPolygon(vec![polygon]);
    let tiny = |i: usize| {
        let at = [(i % 5) as f64 * 1e-3, (i / 5) as f64 * 1e-3];
        box_of(at, [at[0] + 4e-4, at[1] + 4e-4])
    };
    let ulp = 1.0 + f64::EPSILON;
    let [a, _] = stars(1000);
    let moved = {
        use geo::MapCoords;
        a.map_coords(|at| Coord { x: at.x.next_up(), y: at.y })
    };
    let cases: [(&str, Pair); 4] = [
        (
            "a square, one unit in the last place wider than the other",
            [one(box_of([0.0, 0.0], [ulp, 1.0])), one(box_of([0.0, 0.0], [1.0, 1.0]))],
        ),
        (
            "25 squares of 4e-4 beside one of 2e7",
            [MultiPolygon((0..25).map(tiny).collect()), one(box_of([1e7, -1e7], [1.1e7, 1e7]))],
        ),
        (
            "a needle, 1e-12 wide",
            [
                one(ring(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1e-12]])),
                one(box_of([0.25, -1.0], [0.5, 1.0])),
            ],
        ),
        ("star 1000, every corner moved by one unit in the last place", [a, moved]),
    ];
    for (name, pair) in &cases {
        let [a, b] = [PlaneShape::from_geo(&pair[0])?, PlaneShape::from_geo(&pair[1])?];
        let exact = PlaneShape::operation(Operation::Difference, &[&a, &b])?;
        println!(
            "| {name} | {} | {} | {} |",
            exact.polygons().len(),
            geos(Operation::Difference, pair).0.len(),
            ours(Operation::Difference, pair)?.0.len(),
        );
    }
    Ok(())
}
