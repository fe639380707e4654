//! The classical list: sort, scan, mark, cut.
//!
//! The list is kept in two parts: what is sorted, and in front of it what was
//! moved there, last moved first. Of the sheets that are left, only those can
//! stand in the way of the first whose boxes overlap its own; they are looked
//! up instead of scanned, which changes nothing in what is decided. A marked
//! sheet that is to be moved again shows a cycle; then a sheet is cut, the list
//! is sorted again, and all marks are taken off.
//!
//! Nothing is asked twice. A sheet that may be painted before another may so
//! for all time, and so may its pieces, before all pieces of the other; each
//! sheet therefore has a list of those of which that is not known yet. And
//! what stands in the way of a sheet does so until either of the two is cut.
//! To sort the list again is to put in their places what was moved or cut.

use super::judge::{Judge, Test};
use super::order::farthest_first;
use super::sheets::Sheet;
use super::{Ordered, PainterError};
use crate::kernel::predicates::{Policy, Predicates, sort_by_predicates};
use crate::run::{Growing, Run};
use crate::spatial::Hierarchy;
use crate::view::LineQuestion;

/// Brings sheets into painting order.
pub(super) fn order<P: Policy>(
    question: &LineQuestion<'_>,
    sheets: Vec<Sheet>,
    most_cuts: usize,
    run: &Run<'_>,
) -> Result<Ordered, PainterError> {
    let judge = Judge::<P>::new(Predicates::new(question.points));
    let total = sheets.len() as u64;
    let list = run.stage("painter-list", total, || {
        let mut list = List::new(sheets, &judge, run)?;
        list.paint(most_cuts, run)?;
        Ok::<_, PainterError>(list)
    })?;
    judge.report(run);
    run.count("painter-moves", list.moves);
    let List { mut sheets, order, cuts, .. } = list;
    let mut taken: Vec<Option<Sheet>> = sheets.drain(..).map(Some).collect();
    let sheets = order.into_iter().filter_map(|node| taken[node as usize].take()).collect();
    Ok(Ordered { sheets, cuts })
}

/// What a pair of neighbours takes, in lists that may have room for twice as
/// many: itself, and one entry of each.
const PAIR_BYTES: usize = 2 * size_of::<[u32; 2]>() + 4 * size_of::<u32>();

struct List<'j, 'p, P: Policy> {
    judge: &'j Judge<'p, P>,
    sheets: Vec<Sheet>,
    /// For each sheet those whose boxes overlap its own, as long as one of the
    /// two is not known to be allowed before the other.
    near: Vec<Vec<u32>>,
    /// For each sheet those of them before which it is not known to be allowed,
    /// ascending.
    unsettled: Vec<Vec<u32>>,
    /// What was found to stand in the way of each sheet.
    obstacles: Vec<Option<Obstacle>>,
    /// How often each sheet was cut.
    ages: Vec<u32>,
    /// Nearest first, so that the first of the list is the last here.
    sorted: Vec<u32>,
    moved: Vec<u32>,
    /// Whether a sheet is among those that were moved.
    is_marked: Vec<bool>,
    /// What was marked since the last cut, painted or not.
    marked: Vec<u32>,
    is_painted: Vec<bool>,
    order: Vec<u32>,
    cuts: usize,
    moves: u64,
}

/// A sheet before which another may not be painted.
#[derive(Debug, Clone, Copy)]
struct Obstacle {
    sheet: u32,
    /// How often the one and the other had been cut.
    ages: [u32; 2],
    /// Whether it may be painted before the other.
    may_move: bool,
}

/// What is to be done with the first of the list.
enum Verdict {
    Paint,
    Move(u32),
    /// The sheet that cannot be moved.
    Cut(u32),
}

impl<'j, 'p, P: Policy> List<'j, 'p, P> {
    fn new(
        sheets: Vec<Sheet>,
        judge: &'j Judge<'p, P>,
        run: &Run<'_>,
    ) -> Result<Self, PainterError> {
        let boxes: Vec<_> = sheets.iter().map(|sheet| sheet.bounds).collect();
        let mut near: Vec<Vec<u32>> = vec![Vec::new(); sheets.len()];
        let start = || (Vec::new(), Growing::new(run, PAIR_BYTES));
        let pairs = Hierarchy::new(&boxes).overlapping_pairs(run, start, |found, a, b| {
            let (found, growing) = found;
            if growing.goes_on(found.len()) {
                found.push([a, b]);
            }
        });
        for (pairs, mut growing) in pairs {
            growing.finish(pairs.len())?;
            for [a, b] in pairs {
                near[a as usize].push(b);
                near[b as usize].push(a);
            }
        }
        near.iter_mut().for_each(|list| list.sort_unstable());
        let count = sheets.len();
        let mut sorted: Vec<u32> = (0..count as u32).collect();
        sort_by_predicates::<P, _>(&mut sorted, |&a, &b| {
            farthest_first(&judge.predicates, &sheets, b, a)
        });
        Ok(List {
            judge,
            sheets,
            unsettled: near.clone(),
            near,
            obstacles: vec![None; count],
            ages: vec![0; count],
            sorted,
            moved: Vec::new(),
            is_marked: vec![false; count],
            marked: Vec::new(),
            is_painted: vec![false; count],
            order: Vec::with_capacity(count),
            cuts: 0,
            moves: 0,
        })
    }

    fn paint(&mut self, most_cuts: usize, run: &Run<'_>) -> Result<(), PainterError> {
        while let Some(&first) = self.moved.last().or(self.sorted.last()) {
            run.check()?;
            run.advance(0);
            match self.verdict(first) {
                Verdict::Paint => {
                    self.moved.pop().or_else(|| self.sorted.pop());
                    self.is_painted[first as usize] = true;
                    self.order.push(first);
                    run.advance(1);
                }
                Verdict::Move(other) => {
                    self.moves += 1;
                    self.take(other);
                    self.moved.push(other);
                    self.is_marked[other as usize] = true;
                    self.marked.push(other);
                }
                Verdict::Cut(other) => {
                    let near = self.near[first as usize].len().max(self.near[other as usize].len());
                    let sheet = self.sheets[first as usize].bytes();
                    run.take((sheet + 8 * near * size_of::<u32>()) as u64)?;
                    self.cut(first, other)?;
                    if most_cuts < self.cuts {
                        return Err(PainterError::TooManyCuts(most_cuts));
                    }
                }
            }
        }
        Ok(())
    }

    /// Takes a sheet off the list.
    fn take(&mut self, sheet: u32) {
        if self.is_marked[sheet as usize] {
            self.moved.retain(|&other| other != sheet);
            return;
        }
        let expected = self.place_of(sheet);
        // Signs that floats get wrong may have it elsewhere.
        let place = match self.sorted.get(expected) == Some(&sheet) {
            true => Some(expected),
            false => self.sorted.iter().position(|&other| other == sheet),
        };
        place.map(|place| self.sorted.remove(place));
    }

    /// Puts a sheet in its place.
    fn put(&mut self, sheet: u32) {
        self.sorted.insert(self.place_of(sheet), sheet);
    }

    /// Where a sheet belongs among those that are sorted.
    fn place_of(&self, sheet: u32) -> usize {
        let (predicates, sheets) = (&self.judge.predicates, &self.sheets);
        self.sorted
            .partition_point(|&other| farthest_first(predicates, sheets, sheet, other).is_lt())
    }

    fn verdict(&mut self, first: u32) -> Verdict {
        match self.obstacle(first) {
            None => Verdict::Paint,
            Some(Obstacle { sheet, may_move, .. }) => {
                if may_move && !self.is_marked[sheet as usize] {
                    Verdict::Move(sheet)
                } else {
                    Verdict::Cut(sheet)
                }
            }
        }
    }

    /// The first sheet that is left before which another may not be painted.
    fn obstacle(&mut self, first: u32) -> Option<Obstacle> {
        let ages = |list: &Self, other: u32| [first, other].map(|i| list.ages[i as usize]);
        let known = self.obstacles[first as usize];
        let stands = |known: &Obstacle| {
            known.ages == ages(self, known.sheet) && !self.is_painted[known.sheet as usize]
        };
        if known.as_ref().is_some_and(stands) {
            return known;
        }
        let mut unsettled = std::mem::take(&mut self.unsettled[first as usize]);
        let is_settled =
            |&other: &u32| self.is_painted[other as usize] || self.may_precede(first, other);
        let settled = unsettled.iter().take_while(|other| is_settled(other)).count();
        unsettled.drain(..settled);
        let found = unsettled.first().map(|&other| Obstacle {
            sheet: other,
            ages: ages(self, other),
            may_move: self.may_move_before(other, first),
        });
        self.unsettled[first as usize] = unsettled;
        self.obstacles[first as usize] = found;
        found
    }

    /// Tests 1 and 2: whether one sheet may be painted before another.
    fn may_precede(&self, first: u32, other: u32) -> bool {
        let (judge, [p, q]) = (self.judge, [first, other].map(|i| &self.sheets[i as usize]));
        if judge.is_deeper(p, q) || judge.extents_are_apart(p, q) {
            return true;
        }
        let by_plane = match judge.are_coplanar(p, q) {
            true => p.face >= q.face,
            false => judge.planes_part(p, q, [Test::ViewerSide, Test::FarSide]),
        };
        by_plane || judge.images_are_apart(p, q)
    }

    /// Test 2 with the roles exchanged: whether the plane of one allows that
    /// what stands in the way of the first of the list is painted before it.
    fn may_move_before(&self, other: u32, first: u32) -> bool {
        let [p, q] = [first, other].map(|i| &self.sheets[i as usize]);
        let exchanged = [Test::ViewerSideExchanged, Test::FarSideExchanged];
        match self.judge.are_coplanar(p, q) {
            true => p.face <= q.face,
            false => self.judge.planes_part(q, p, exchanged),
        }
    }

    /// Cuts the first of the list by the plane of the other, or the other by
    /// that of the first, or else one marked sheet by another.
    fn cut(&mut self, first: u32, other: u32) -> Result<(), PainterError> {
        // A marked sheet may have been painted since.
        let left = self.marked.iter().copied().filter(|&sheet| !self.is_painted[sheet as usize]);
        let mut marked: Vec<u32> = left.chain([first, other]).collect();
        marked.sort_unstable();
        marked.dedup();
        let pairs = marked.iter().flat_map(|&x| marked.iter().map(move |&y| [x, y]));
        let pairs = [[first, other], [other, first]].into_iter().chain(pairs);
        for [sheet, by] in pairs {
            let [whole, other] = [sheet, by].map(|i| &self.sheets[i as usize]);
            if let Some(pieces) = whole.cut_by(&self.judge.predicates, other) {
                self.replace(sheet, pieces);
                return Ok(());
            }
        }
        Err(PainterError::NoCut)
    }

    fn replace(&mut self, sheet: u32, [first, second]: [Sheet; 2]) {
        self.cuts += 1;
        let added = self.sheets.len() as u32;
        self.take(sheet);
        self.divide_neighbours(sheet, added);
        self.sheets[sheet as usize] = first;
        self.sheets.push(second);
        self.ages[sheet as usize] += 1;
        self.ages.push(0);
        self.obstacles.push(None);
        self.is_marked.push(false);
        self.is_painted.push(false);
        for marked in self.marked.drain(..) {
            self.is_marked[marked as usize] = false;
        }
        let moved = std::mem::take(&mut self.moved);
        [sheet, added].into_iter().chain(moved).for_each(|sheet| self.put(sheet));
    }

    /// What holds between a sheet and others holds for both of its pieces.
    fn divide_neighbours(&mut self, sheet: u32, added: u32) {
        let has = |list: &[u32], one: u32| list.binary_search(&one).is_ok();
        let own = std::mem::take(&mut self.unsettled[sheet as usize]);
        let mut near = std::mem::take(&mut self.near[sheet as usize]);
        near.retain(|&other| {
            let unsettled = &mut self.unsettled[other as usize];
            let stands_before = has(unsettled, sheet);
            let matters = !self.is_painted[other as usize] && (stands_before || has(&own, other));
            if matters {
                self.near[other as usize].push(added);
            }
            if matters && stands_before {
                unsettled.push(added);
            }
            matters
        });
        self.near[sheet as usize] = near.clone();
        self.near.push(near);
        self.unsettled[sheet as usize] = own.clone();
        self.unsettled.push(own);
    }
}
