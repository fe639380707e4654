//! In which order and in which sense a pen draws its strokes.
//!
//! A plotter draws what it is told in the order in which it is told, and
//! between two strokes the pen travels in the air. For each layer, that is for
//! each pen:
//!
//! 1. `trails`: closed strokes are drawn in passing by the stroke that they
//!    touch, so that no set of strokes covers the layer with fewer lifts.
//! 2. `greedy`: always on to the nearest end that is left.
//! 3. `improve`, on a `tour`: 2-opt and Or-opt until nothing gains, then kicks
//!    for as long as the effort asked for allows.
//! 4. Closed strokes begin where the pen passes nearest.
//!
//! Effort is counted in steps, so the order is the same on every machine and
//! for any number of threads. An effort in seconds gives another order on
//! another machine; whoever asks for it is told so.
//!
//! The set of points is not changed by one bit: strokes are reversed, turned
//! around in themselves, joined where they share a point, and permuted.

mod effort;
mod greedy;
mod improve;
mod nearest;
mod tour;
mod trails;

use super::{Drawing, Strokes, is_closed};
use crate::run::{Cancelled, Run, map_indexed};
pub use effort::Effort;
use glam::DVec2;
use improve::Improver;
use std::time::Instant;
use tour::Tour;

/// Steps for each stroke unless others are asked for.
const STEPS_PER_STROKE: u64 = 8;

/// How many steps pass between two looks at the clock.
const STEPS_PER_LOOK: u64 = 256;

impl Drawing {
    /// Puts the strokes of every layer into an order in which the pen
    /// travels little between them. Layers are worked out side by side.
    /// O(n log n) and the effort.
    pub fn order(&mut self, effort: Effort) {
        // A run that nobody stops has no error.
        let _ = self.order_within(effort, &Run::default());
    }

    /// As [`Drawing::order`], asking a run whether to go on.
    ///
    /// # Errors
    ///
    /// If the run is cancelled; the order is then as it was.
    pub fn order_within(&mut self, effort: Effort, run: &Run<'_>) -> Result<(), Cancelled> {
        if effort == Effort::Keep {
            return Ok(());
        }
        let home = DVec2::new(0.0, self.size.y);
        let strokes: usize = self.layers.iter().map(|layer| layer.strokes.len()).sum();
        let ordered = map_indexed(self.layers.len(), |index| {
            let own = &self.layers[index].strokes;
            let share = |of: u64| (u128::from(of) * own.len() as u128 / strokes as u128) as u64;
            let mut budget = match effort {
                Effort::Keep | Effort::Greedy => Budget::Steps(0),
                Effort::Best => Budget::Steps(STEPS_PER_STROKE * own.len() as u64),
                Effort::Steps(steps) => Budget::Steps(share(steps)),
                Effort::Time(time) => Budget::Until(Instant::now() + time, 0),
            };
            order(own, home, &mut budget, run)
        });
        run.check()?;
        for (layer, strokes) in self.layers.iter_mut().zip(ordered) {
            layer.strokes = strokes;
        }
        Ok(())
    }
}

/// What is left of the effort.
enum Budget {
    Steps(u64),
    /// Until then; and how many steps have been taken.
    Until(Instant, u64),
}

impl Budget {
    /// Takes one step, if one is left.
    fn step(&mut self) -> bool {
        match self {
            Budget::Steps(0) => false,
            Budget::Steps(left) => {
                *left -= 1;
                true
            }
            Budget::Until(end, taken) => {
                *taken += 1;
                !taken.is_multiple_of(STEPS_PER_LOOK) || Instant::now() < *end
            }
        }
    }
}

/// How one stroke is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Visit {
    stroke: u32,
    reversed: bool,
    /// The point at which a closed stroke begins.
    start: u32,
}

impl Visit {
    /// Where the pen is put down, and where it is lifted.
    fn ends(self, points: &[DVec2]) -> [DVec2; 2] {
        let ends = [points[self.start as usize], points[points.len() - 1]];
        match (is_closed(points), self.reversed) {
            (true, _) => [ends[0]; 2],
            (false, true) => [ends[1], ends[0]],
            (false, false) => ends,
        }
    }
}

fn order(strokes: &Strokes, home: DVec2, budget: &mut Budget, run: &Run<'_>) -> Strokes {
    let strokes = trails::fewest(strokes);
    if run.is_stopped() {
        return strokes;
    }
    let mut visits = greedy::greedy(&strokes, home);
    if !matches!(budget, Budget::Steps(0)) {
        visits = improve(&strokes, visits, budget, run);
        start_near(&strokes, &mut visits, home);
    }
    drawn_so(&strokes, &visits)
}

/// Improves the order `visits`.
fn improve(
    strokes: &Strokes,
    mut visits: Vec<Visit>,
    budget: &mut Budget,
    run: &Run<'_>,
) -> Vec<Visit> {
    let ends: Vec<_> =
        visits.iter().map(|visit| visit.ends(strokes.get(visit.stroke as usize))).collect();
    let mut improver = Improver::new(Tour::new(&ends));
    let mut steps = 0_u64;
    let mut more = || {
        steps += 1;
        if steps.is_multiple_of(STEPS_PER_LOOK) {
            run.advance(0);
        }
        budget.step() && !run.is_stopped()
    };
    if improver.settle(&mut more) {
        turn_loops(strokes, &mut visits, &mut improver);
        improver.settle(&mut more);
        improver.kick(&mut more);
    }
    turn_loops(strokes, &mut visits, &mut improver);
    let order = |stop: u32| {
        let visit = visits[(stop / 2) as usize];
        Visit { reversed: visit.reversed != (stop % 2 == 1), ..visit }
    };
    improver.tour().open().map(order).collect()
}

/// Lets every closed stroke begin where that is the least way from the stroke
/// before it and to the one after it.
fn turn_loops(strokes: &Strokes, visits: &mut [Visit], improver: &mut Improver) {
    for (index, visit) in visits.iter_mut().enumerate() {
        let points = strokes.get(visit.stroke as usize);
        if !is_closed(points) {
            continue;
        }
        let tour = improver.tour();
        let links = [0, 1].map(|side| tour.linked(2 * index as u32 + side));
        let links = links.map(|end| tour.is_somewhere(end).then(|| tour.point(end)));
        let way =
            |point: DVec2| -> f64 { links.iter().flatten().map(|link| link.distance(point)).sum() };
        let mut best = (way(points[visit.start as usize]), visit.start);
        for (start, point) in points.iter().enumerate().skip(1) {
            let length = way(*point);
            if length < best.0 {
                best = (length, start as u32);
            }
        }
        if best.1 != visit.start {
            visit.start = best.1;
            improver.put(index as u32, points[visit.start as usize]);
        }
    }
}

/// Turns the whole order around if the pen then begins nearer to its home.
fn start_near(strokes: &Strokes, visits: &mut [Visit], home: DVec2) {
    let ends = |visit: &Visit| visit.ends(strokes.get(visit.stroke as usize));
    if let (Some(first), Some(last)) = (visits.first().map(ends), visits.last().map(ends))
        && last[1].distance(home) < first[0].distance(home)
    {
        visits.reverse();
        visits.iter_mut().for_each(|visit| visit.reversed = !visit.reversed);
    }
}

/// The strokes as they are visited.
fn drawn_so(strokes: &Strokes, visits: &[Visit]) -> Strokes {
    let mut drawn = Strokes::default();
    for visit in visits {
        let (stroke, start) = (visit.stroke as usize, visit.start as usize);
        let points = strokes.get(stroke);
        let last = points.len() - 1;
        let closed = is_closed(points);
        // The node that comes at each step, forwards.
        let at = |step: usize| if closed { (start + step) % last } else { step };
        drawn.push_curved((0..=last).map(|step| {
            if visit.reversed {
                let after = strokes.bend(stroke, way(at(last - step), closed, last));
                (points[at(last - step)], after.map(|[one, other]| [other, one]))
            } else {
                (
                    points[at(step)],
                    strokes.bend(stroke, if at(step) == 0 { last } else { at(step) }),
                )
            }
        }));
    }
    drawn
}

/// The node to which the way from node `at` leads.
fn way(at: usize, closed: bool, last: usize) -> usize {
    if closed { at % last + 1 } else { at + 1 }
}

#[cfg(test)]
mod tests;
