//! The classical list: sort, scan, mark, cut.
//!
//! The list is kept in two parts: what is sorted, and in front of it what was
//! moved there, last moved first. Of the sheets that are left, only those can
//! stand in the way of the first whose boxes overlap its own; they are looked
//! up instead of scanned, which changes nothing in what is decided. A marked
//! sheet that is to be moved again shows a cycle; then a sheet is cut, the list
//! is sorted again, and all marks are taken off.

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
    run: &Run<'_>,
) -> Result<Ordered, PainterError> {
    let judge = Judge::<P>::new(Predicates::new(question.points));
    let total = sheets.len() as u64;
    let list = run.stage("painter-list", total, || {
        let mut list = List::new(sheets, &judge, run)?;
        list.paint(run)?;
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
    /// For each sheet those whose boxes overlap its own.
    near: Vec<Vec<u32>>,
    /// Nearest first, so that the first of the list is the last here.
    sorted: Vec<u32>,
    moved: Vec<u32>,
    is_marked: Vec<bool>,
    marked: Vec<u32>,
    is_painted: Vec<bool>,
    order: Vec<u32>,
    cuts: usize,
    moves: u64,
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
        let mut list = List {
            judge,
            sheets,
            near,
            sorted: (0..count as u32).collect(),
            moved: Vec::new(),
            is_marked: vec![false; count],
            marked: Vec::new(),
            is_painted: vec![false; count],
            order: Vec::with_capacity(count),
            cuts: 0,
            moves: 0,
        };
        list.sort();
        Ok(list)
    }

    /// Sorts all that is left and takes off all marks.
    fn sort(&mut self) {
        let (predicates, sheets) = (&self.judge.predicates, &self.sheets);
        self.sorted.append(&mut self.moved);
        sort_by_predicates::<P, _>(&mut self.sorted, |&a, &b| {
            farthest_first(predicates, sheets, b, a)
        });
        for sheet in self.marked.drain(..) {
            self.is_marked[sheet as usize] = false;
        }
    }

    fn paint(&mut self, run: &Run<'_>) -> Result<(), PainterError> {
        while let Some(&first) = self.moved.last().or(self.sorted.last()) {
            run.check()?;
            run.advance(0);
            match self.verdict(first) {
                Verdict::Paint => {
                    self.take(first);
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
                    run.take((sheet + 4 * near * size_of::<u32>()) as u64)?;
                    self.cut(first, other)?;
                }
            }
        }
        Ok(())
    }

    /// Takes a sheet off the list.
    fn take(&mut self, sheet: u32) {
        for list in [&mut self.moved, &mut self.sorted] {
            if let Some(place) = list.iter().rposition(|&other| other == sheet) {
                list.remove(place);
                return;
            }
        }
    }

    fn verdict(&self, first: u32) -> Verdict {
        for &other in &self.near[first as usize] {
            if self.is_painted[other as usize] || self.may_precede(first, other) {
                continue;
            }
            let [p, q] = [first, other].map(|i| &self.sheets[i as usize]);
            let exchanged = [Test::ViewerSideExchanged, Test::FarSideExchanged];
            let may_move = match self.judge.are_coplanar(p, q) {
                true => p.face <= q.face,
                false => self.judge.planes_part(q, p, exchanged),
            };
            return if may_move && !self.is_marked[other as usize] {
                Verdict::Move(other)
            } else {
                Verdict::Cut(other)
            };
        }
        Verdict::Paint
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
        let near = self.near[sheet as usize].clone();
        near.iter().for_each(|&other| self.near[other as usize].push(added));
        self.sheets[sheet as usize] = first;
        self.sheets.push(second);
        self.near.push(near);
        self.is_marked.push(false);
        self.is_painted.push(false);
        self.sorted.push(added);
        self.sort();
    }
}
