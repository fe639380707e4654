//! Which line goes on as which where three ends or more meet.
//!
//! A pen should run straight through a crossing, as a draughtsman's would. So
//! the two ends that continue one another best are paired first, then the
//! next two, until at most one is left. "Best" is the least cosine between
//! the two ways of leaving the joint; -1 is perfectly straight. Square roots
//! and products are the same on every machine, and ties go to the ends that
//! come first around the joint, so the pairing depends on geometry alone.
//!
//! Trying all pairs takes d² steps for d ends. Where a great many lines meet
//! (the tip of a finely divided cone), each is paired with the one half way
//! around instead, which is as straight as an even fan allows.

use super::chaining::point;
use glam::DVec2;

/// The largest number of ends of which all pairs are tried.
const ALL_PAIRS: usize = 24;

/// Pairs the ends of one joint after another; the array serves them all.
#[derive(Default)]
pub(super) struct Joints {
    spokes: Vec<Spoke>,
}

/// A segment seen from the joint.
#[derive(Clone, Copy)]
struct Spoke {
    end: u32,
    /// Unit vector away from the joint.
    away: DVec2,
    /// Grows with the angle from -2 to 2, without trigonometry.
    turn: f64,
    /// The other end of the segment.
    far: DVec2,
}

impl Joints {
    /// Pairs `ends`, which all lie in one point, and appends them to `partners`.
    pub(super) fn pair(
        &mut self,
        segments: &[[DVec2; 2]],
        ends: &[u32],
        partners: &mut Vec<[u32; 2]>,
    ) {
        self.spokes.clear();
        self.spokes.extend(ends.iter().map(|end| Spoke::new(segments, *end)));
        self.spokes.sort_unstable_by(Spoke::compare);
        if ALL_PAIRS < ends.len() {
            let half = ends.len() / 2;
            for (one, other) in self.spokes[..half].iter().zip(&self.spokes[half..]) {
                partners.push([one.end, other.end]);
            }
            return;
        }
        // What is left keeps its order around the joint, so that the first of
        // equally good pairs is the same one in any drawing.
        while let Some([one, other]) = self.straightest() {
            partners.push([self.spokes[one].end, self.spokes[other].end]);
            self.spokes.remove(other);
            self.spokes.remove(one);
        }
    }

    /// The two spokes that continue one another best.
    fn straightest(&self) -> Option<[usize; 2]> {
        let mut best = None;
        let mut least = f64::INFINITY;
        for (i, one) in self.spokes.iter().enumerate() {
            for (j, other) in self.spokes.iter().enumerate().skip(i + 1) {
                let cosine = one.away.dot(other.away);
                if cosine < least {
                    (best, least) = (Some([i, j]), cosine);
                }
            }
        }
        best
    }
}

impl Spoke {
    fn new(segments: &[[DVec2; 2]], end: u32) -> Self {
        let far = point(segments, end ^ 1);
        let away = (far - point(segments, end)).normalize_or_zero();
        let share = away.x / (away.x.abs() + away.y.abs());
        let turn = if away.y < 0.0 { share - 1.0 } else { 1.0 - share };
        Spoke { end, away, turn, far }
    }

    /// Around the joint, then outwards; the last resort keeps equal segments
    /// in their order.
    fn compare(&self, other: &Self) -> std::cmp::Ordering {
        self.turn
            .total_cmp(&other.turn)
            .then_with(|| self.far.x.total_cmp(&other.far.x))
            .then_with(|| self.far.y.total_cmp(&other.far.y))
            .then_with(|| self.end.cmp(&other.end))
    }
}
