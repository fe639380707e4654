//! Where a line passes in front of another, the farther one is interrupted.
//!
//! Appel, Rohlf and Stein (1979) drew wireframes this way: nothing is hidden,
//! yet one sees what is in front. The gap is the farther line less the
//! stadium of the nearer one, all points nearer to it than half the halo:
//!
//! ```text
//!                |  near                       sin w = 1: halo wide
//!   ---------    |    ---------  far           else: halo / sin w
//!                |
//! ```
//!
//! 1. Crossings come with the lines, found once and exactly; any width is
//!    drawn from them (Franklin and Akman 1987). Lines that meet in space
//!    have none, and so no gap.
//! 2. From a crossing the far line is followed both ways, from piece to piece
//!    of its chain, as long as it stays in the stadium of some piece of the
//!    near chain (`chains`) and behind its nearest point (`stadium`). Chains
//!    are followed because those of smooth surfaces consist of pieces much
//!    shorter than a halo is wide.
//! 3. A chain that comes back to itself within two halo widths makes no gap
//!    in itself: contours of meshes zigzag. One that passes in front of itself
//!    farther on does; a knot is one chain.
//! 4. What is in no gap remains.
//!
//! Every gap is found by itself from what is drawn, and gaps are united: the
//! order of pieces and crossings does not matter. O(n + k) for n pieces
//! and k crossings, if haloes are no wider than a few pieces.

mod chains;
mod stadium;

use super::piece_part::part_of;
use crate::run::{Cancelled, Run, concat_map, map_chunks, sort_by};
use crate::view::{Crossing, LinePiece, Projection, VisibleLines};
use chains::Chains;
use glam::DVec2;
use stadium::{Profile, Stadium};

/// How much longer than half the halo a gap may be before the near chain is
/// no longer followed: lines crossing at less than four degrees.
const LONGEST: f64 = 16.0;

/// A chain makes no gap in itself within this many half halos of way.
const OWN: f64 = 4.0;

/// The most pieces that a gap may run over, so that it ends.
const MOST: usize = 4096;

/// Crossings that one task works out.
const PART: usize = 256;

/// Pieces that one task leaves gaps in.
const PIECES: usize = 1 << 13;

/// Where along a piece nothing is drawn, from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Gap {
    piece: u32,
    range: [f64; 2],
}

/// The lines less the gaps of haloes that reach `radius` to either side, in
/// units of the view frame. Pieces that are not `drawn` neither make nor get
/// gaps.
pub(super) fn interrupt(
    lines: &VisibleLines,
    crossings: &[Crossing],
    drawn: &[bool],
    radius: f64,
    run: &Run<'_>,
) -> Result<VisibleLines, Cancelled> {
    let chains = Chains::new(&lines.pieces, drawn);
    let projection = lines.frame.projection;
    let halo = Halo { pieces: &lines.pieces, chains, projection, radius };
    let mut gaps = map_chunks(crossings.len(), PART, |part| {
        let mut gaps = Vec::new();
        run.advance(0);
        for crossing in crossings[part].iter().take_while(|_| !run.is_stopped()) {
            if drawn[crossing.near as usize] && drawn[crossing.far as usize] {
                halo.find(crossing, &mut gaps);
            }
        }
        gaps
    })
    .concat();
    run.check()?;
    // Gaps that are equal in all this are equal.
    sort_by(&mut gaps, |a, b| {
        let by = |end: usize| a.range[end].total_cmp(&b.range[end]);
        a.piece.cmp(&b.piece).then_with(|| by(0)).then_with(|| by(1))
    });
    let remains = map_chunks(lines.pieces.len(), PIECES, |part| {
        let mut pieces = Vec::with_capacity(part.len());
        let mut rest = &gaps[gaps.partition_point(|gap| (gap.piece as usize) < part.start)..];
        for index in part {
            let count = rest.iter().take_while(|gap| gap.piece as usize == index).count();
            let (own, others) = rest.split_at(count);
            halo.remains(&lines.pieces[index], own, &mut pieces);
            rest = others;
        }
        pieces
    });
    run.check()?;
    let remains: Vec<&[LinePiece]> = remains.iter().map(Vec::as_slice).collect();
    let pieces = concat_map(&remains, |_, piece| *piece);
    let (objects, counters) = (lines.objects.clone(), lines.counters.clone());
    Ok(VisibleLines { frame: lines.frame, objects, pieces, counters })
}

/// What gaps are made with.
struct Halo<'a> {
    pieces: &'a [LinePiece],
    chains: Chains,
    projection: Projection,
    radius: f64,
}

impl Halo<'_> {
    /// Appends what the near piece of a crossing cuts out of the far chain.
    fn find(&self, crossing: &Crossing, gaps: &mut Vec<Gap>) {
        let [near, far] =
            [crossing.near, crossing.far].map(|index| self.pieces[index as usize].points);
        let (along, across) = (far[1] - far[0], near[1] - near[0]);
        let turn = across.perp_dot(along);
        if turn == 0.0 {
            return;
        }
        let place = (across.perp_dot(near[0] - far[0]) / turn).clamp(0.0, 1.0);
        let meeting = far[0].lerp(far[1], place);
        if self.is_own(crossing, place) {
            return;
        }
        let sine = turn.abs() / (along.length() * across.length());
        let reach = self.radius * (1.0 + (1.0 / sine).min(LONGEST));
        let (nears, mut stadiums) = self.near_chain(crossing, meeting, reach);
        // The order at the crossing is exact; rounded depths must not
        // contradict it.
        let here = self.profile(crossing.far, [0, 1]).depth(place);
        if let Some(own) = stadiums.first() {
            let lift = (here - own.depth_beside(meeting)).min(0.0) - 1e-12 * here.abs();
            stadiums.iter_mut().for_each(|stadium| stadium.lift(lift));
        }
        for end in [0, 1] {
            self.follow(2 * crossing.far + end, place, (&nears, &stadiums), gaps);
        }
    }

    /// Cuts the chain of a piece from `place` on it towards `end`.
    fn follow(
        &self,
        mut end: u32,
        place: f64,
        (nears, stadiums): (&[u32], &[Stadium]),
        gaps: &mut Vec<Gap>,
    ) {
        let first = end;
        let mut from = if end % 2 == 1 { place } else { 1.0 - place };
        // Both ways from the crossing begin there, bit for bit.
        let mut begin = place;
        for _ in 0..MOST {
            let ends = if end % 2 == 1 { [0, 1] } else { [1, 0] };
            let profile = self.profile(end / 2, ends);
            let to = covered(&profile, from, stadiums, self.radius);
            if from < to {
                let range = if end % 2 == 1 { [begin, to] } else { [1.0 - to, begin] };
                gaps.push(Gap { piece: end / 2, range });
            }
            match self.chains.partner(end) {
                Some(next) if 1.0 <= to && next ^ 1 != first && !nears.contains(&(next / 2)) => {
                    (end, from) = (next ^ 1, 0.0);
                    begin = if end % 2 == 1 { 0.0 } else { 1.0 };
                }
                _ => break,
            }
        }
    }

    /// The near piece and its chain as far as it matters, and the stadiums.
    fn near_chain(
        &self,
        crossing: &Crossing,
        meeting: DVec2,
        reach: f64,
    ) -> (Vec<u32>, Vec<Stadium>) {
        let Crossing { near, far } = *crossing;
        let mut nears = vec![near];
        for end in [2 * near, 2 * near + 1] {
            let mut way = meeting.distance(self.point(end));
            let mut end = end;
            for _ in 0..MOST {
                match self.chains.partner(end) {
                    Some(next) if way < reach && next / 2 != near && next / 2 != far => {
                        nears.push(next / 2);
                        way += self.length(next / 2);
                        end = next ^ 1;
                    }
                    _ => break,
                }
            }
        }
        let stadium = |piece: &u32| Stadium::new(self.profile(*piece, [0, 1]), self.radius);
        let stadiums = nears.iter().map(stadium).collect();
        (nears, stadiums)
    }

    /// Whether the far chain comes to the near piece within a short way.
    fn is_own(&self, crossing: &Crossing, place: f64) -> bool {
        let most = OWN * self.radius;
        let length = self.length(crossing.far);
        [0, 1].into_iter().any(|side| {
            let mut way = if side == 1 { (1.0 - place) * length } else { place * length };
            let mut end = 2 * crossing.far + side;
            for _ in 0..MOST {
                match self.chains.partner(end) {
                    Some(next) if way < most && next / 2 != crossing.far => {
                        if next / 2 == crossing.near {
                            return true;
                        }
                        way += self.length(next / 2);
                        end = next ^ 1;
                    }
                    _ => break,
                }
            }
            false
        })
    }

    fn length(&self, piece: u32) -> f64 {
        let [from, to] = self.pieces[piece as usize].points;
        from.distance(to)
    }

    fn point(&self, end: u32) -> DVec2 {
        self.pieces[(end / 2) as usize].points[(end % 2) as usize]
    }

    /// A piece from one of its ends to the other, with what is linear along
    /// its image and grows with depth.
    fn profile(&self, piece: u32, ends: [usize; 2]) -> Profile {
        let piece = &self.pieces[piece as usize];
        let depth = |end: usize| {
            let depth = piece.depth[end];
            if self.projection == Projection::Perspective { -depth.recip() } else { depth }
        };
        Profile { points: ends.map(|end| piece.points[end]), depths: ends.map(depth) }
    }

    /// Appends what gaps, sorted by their beginning, leave of a piece.
    fn remains(&self, piece: &LinePiece, gaps: &[Gap], pieces: &mut Vec<LinePiece>) {
        if gaps.is_empty() {
            pieces.push(*piece);
            return;
        }
        let mut from = 0.0;
        for gap in gaps {
            let [begin, end] = gap.range;
            if from < begin {
                pieces.push(part_of(piece, [from, begin], self.projection));
            }
            from = end.max(from);
        }
        if from < 1.0 {
            pieces.push(part_of(piece, [from, 1.0], self.projection));
        }
    }
}

/// How far along `profile`, from `from` on without a break, some stadium
/// covers it; `from` if none does.
fn covered(profile: &Profile, from: f64, stadiums: &[Stadium], radius: f64) -> f64 {
    /// What rounding may tear open between two stadiums, in half halos.
    const SEAM: f64 = 1e-9;
    let length = profile.points[0].distance(profile.points[1]);
    let seam = if length > 0.0 { SEAM * radius / length } else { 1.0 };
    let mut ranges: Vec<[f64; 2]> =
        stadiums.iter().flat_map(|stadium| stadium.over(profile)).collect();
    ranges.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    let mut to = from;
    for [begin, end] in ranges {
        if to + seam < begin {
            break;
        }
        to = end.max(to);
    }
    if 1.0 - seam <= to { 1.0 } else { to }
}

#[cfg(test)]
mod tests;
