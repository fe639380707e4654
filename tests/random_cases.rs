//! Random degenerate decisions and random small scenes, many of them.
//!
//! Corners lie on small grids, some of them an ulp aside, so that planes,
//! lines and images coincide all the time. Decisions are made by every step
//! of the ladder that is sound and must agree with big integers; scenes are
//! drawn by Appel's method with all its shortcuts and proved: covered, counted
//! afresh at one exact point of each piece, judged by Roberts' method.
//!
//! Every test prints its seed; `UMRISS_SEED` sets it. With `UMRISS_LONG=1`
//! there are ten million decisions and a hundred thousand scenes
//! (`cargo test --release --test random_cases`), else a few thousand.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

#[path = "support/split_mix.rs"]
mod split_mix;

use glam::{DVec3, dvec3};
use rayon::prelude::*;
use split_mix::split_mix;
use umriss::kernel::predicates::{Carrier, Cut, Exact, Eye, Point, Points, Predicates, Thorough};
use umriss::model::{Camera, FeatureOptions, LineClass, LineOrigin, Mesh, Soup};
use umriss::run::Run;
use umriss::verify::{VerifyOptions, verify};
use umriss::view::{ExactLines, ExactPiece, LineQuestion, ObjectWish, PreparedView};
use umriss::visibility::{AppelOptions, Culling, Skips, appel};

/// Numbers that look like chance.
struct SplitMix(u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        split_mix(&mut self.0)
    }

    fn below(&mut self, bound: u32) -> u32 {
        (self.next() % u64::from(bound)) as u32
    }

    /// A point of a grid from 0 to `size`, one coordinate perhaps an ulp off.
    fn point(&mut self, size: u32, nudged_of_8: u32) -> DVec3 {
        let mut at = [0; 3].map(|_| f64::from(self.below(size + 1)));
        if self.below(8) < nudged_of_8 {
            let axis = self.below(3) as usize;
            at[axis] = if self.below(2) == 0 { at[axis].next_up() } else { at[axis].next_down() };
        }
        DVec3::from(at)
    }
}

fn seed() -> u64 {
    let given = std::env::var("UMRISS_SEED").ok().and_then(|text| text.parse().ok());
    given.unwrap_or(1967)
}

fn is_long() -> bool {
    std::env::var("UMRISS_LONG").is_ok()
}

/// Decides about `count` random tuples of random vertices; how many steps of
/// the ladder disagree.
fn disagreements(random: &mut SplitMix, count: u32) -> u64 {
    const VERTICES: u32 = 24;
    let (size, nudged) = (1 + random.below(6), random.below(4));
    // A power of two moves all exponents, a large offset eats bits.
    let scale = f64::powi(2.0, random.below(200) as i32 - 100);
    let offset = DVec3::splat(f64::from(random.below(3)) * 1048576.0);
    let place = |point: DVec3| (point + offset) * scale;
    let vertices: Vec<DVec3> = (0..VERTICES).map(|_| place(random.point(size, nudged))).collect();
    let eye = match random.below(2) {
        0 => Eye::Towards(random.point(size, 0) - DVec3::ONE),
        _ => Eye::At(place(random.point(size, nudged) + DVec3::Z * f64::from(size))),
    };
    let points = Points::new(&vertices, eye, None);
    let predicates = Predicates::<Thorough>::new(&points);
    for _ in 0..count {
        let [a, b, c, d, e] = [0; 5].map(|_| random.below(VERTICES));
        let carrier = Carrier::edge(a, b);
        match random.below(5) {
            0 => drop(predicates.side(a, b, c)),
            1 => drop(predicates.plane([a, b, c], d)),
            2 => drop(predicates.skew(carrier, [c, d])),
            3 => drop(predicates.value(Cut::Face([c, d, e]), Point::Vertex(a))),
            _ => {
                let cuts = [Cut::Silhouette([c, d]), Cut::Silhouette([d, e])];
                let values = cuts.map(|cut| carrier.ends.map(|end| predicates.value(cut, end)));
                // An order is defined for cuts that part the ends strictly.
                if values.iter().all(|[p, q]| !p.sign.is_zero() && p.sign.is_opposite(q.sign)) {
                    predicates.order(carrier, (cuts[0], &values[0]), (cuts[1], &values[1]));
                }
            }
        }
    }
    predicates.counters().get("ladder-disagreements")
}

#[test]
fn all_steps_agree_about_random_degenerate_decisions() {
    let decisions = if is_long() { 10_000_000 } else { 100_000 };
    println!("seed {}, {decisions} decisions", seed());
    let mut random = SplitMix(seed());
    for batch in 0..decisions / 1000 {
        assert_eq!(disagreements(&mut random, 1000), 0, "seed {}, batch {batch}", seed());
    }
}

/// A few triangles and squares on a small grid, and a camera that looks along
/// the grid or from one of its points.
fn scene(random: &mut SplitMix) -> Option<(Mesh, Camera)> {
    let (size, nudged) = (2 + random.below(4), random.below(3));
    let mut soup = Soup::default();
    for _ in 0..1 + random.below(9) {
        let first = soup.vertices.len() as u32;
        let [a, b, c] = [0; 3].map(|_| random.point(size, nudged));
        soup.vertices.extend([a, b, c]);
        soup.faces.push(&[first, first + 1, first + 2], []);
        if random.below(3) == 0 {
            // A neighbour at one edge: folds, creases, coplanar pairs.
            soup.vertices.push(random.point(size, nudged));
            soup.faces.push(&[first + 1, first, first + 3], []);
        }
    }
    // Nothing is left where all faces are points or segments.
    let mesh = Mesh::new(vec![soup], None).ok()?;
    let towards = random.point(2, 0) - DVec3::ONE;
    let towards = if towards == DVec3::ZERO { dvec3(-1.0, -2.0, -1.0) } else { towards };
    let up = if towards.x == 0.0 && towards.y == 0.0 { DVec3::Y } else { DVec3::Z };
    let camera = if random.below(2) == 0 {
        Camera::Orthographic { forward: towards, target: None, up }
    } else {
        let eye = random.point(size, 0) - towards * f64::from(random.below(4));
        let near = Some(f64::from(1 + random.below(8)) / 8.0);
        let target = Some(eye + towards);
        Camera::Perspective { eye, target, up, near, fov_y_degrees: 60.0 }
    };
    Some((mesh, camera))
}

/// The visible pieces of the lines that have some, by what the lines are.
fn shown(question: &LineQuestion<'_>, answer: &ExactLines) -> Vec<(String, Vec<ExactPiece>)> {
    let lines = question.lines.iter().enumerate().filter_map(|(index, line)| {
        let visible = answer.line(index).iter().filter(|piece| piece.invisibility == 0);
        let visible: Vec<ExactPiece> = visible.copied().collect();
        let name = match line.origin {
            LineOrigin::Intersection(index) => {
                format!("{:?}", question.intersections[index as usize])
            }
            own => format!("{own:?}"),
        };
        (!visible.is_empty()).then_some((name, visible))
    });
    lines.collect()
}

/// Draws and proves one scene; what is wrong with it.
fn faults(seed: u64) -> Option<String> {
    let (mesh, camera) = scene(&mut SplitMix(seed))?;
    let view = camera.view(mesh.bounds()).ok()?;
    let options = FeatureOptions::default().with_classes(&LineClass::ALL);
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, &view, &options, &run).unwrap();
    let question = prepared.question(true);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).unwrap();
    let verify_options = VerifyOptions { image_size: 0, ..VerifyOptions::default() };
    let report = verify::<Exact>(&view, &question, &answer, &verify_options, &run).unwrap();
    if !report.is_clean() {
        return Some(format!("{report}"));
    }
    // What shows is the same if only that is wanted, and all is culled that can be.
    let skips = Skips { culling: Culling::Always, ..Skips::default() };
    let wishes = vec![ObjectWish { features: options, see_through: false }];
    let alone =
        PreparedView::for_visible_lines::<Exact>(&mesh, &view, &wishes, &skips, &run).unwrap();
    let all = shown(&question, &answer);
    let same = [prepared.question(false), alone.question(false)]
        .map(|question| {
            let options = AppelOptions { skips, ..AppelOptions::default() };
            shown(&question, &appel::<Exact>(&question, &options, &run).unwrap())
        })
        .iter()
        .all(|visible| *visible == all);
    (!same).then(|| "visible lines differ without hidden ones".to_owned())
}

#[test]
fn random_small_scenes_are_drawn_right() {
    let scenes = if is_long() { 100_000 } else { 1000 };
    println!("seeds from {}, {scenes} scenes", seed());
    let wrong = (seed()..seed() + scenes)
        .into_par_iter()
        .find_map_first(|seed| faults(seed).map(|wrong| format!("seed {seed}: {wrong}")));
    assert!(wrong.is_none(), "{}", wrong.unwrap_or_default());
}
