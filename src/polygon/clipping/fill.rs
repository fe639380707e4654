//! What is inside: fill rules, and the winding numbers they look at.
//!
//! A place in the plane is told from others by how often each ring winds
//! around it. Only few combinations of winding numbers occur, so each gets a
//! number when it is met first (hash consing), and what a step across an
//! edge leads to is remembered. What a combination means for each operand
//! and for the result is worked out once for each.

use rustc_hash::FxHashMap;

/// When a place is inside an operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum FillRule {
    /// All rings together wind around it an odd number of times.
    #[default]
    EvenOdd,
    /// They wind around it, counterclockwise minus clockwise.
    NonZero,
    /// They wind around it more often counterclockwise.
    Positive,
    /// They wind around it more often clockwise.
    Negative,
    /// It is in any of the polygons; and it is in a polygon if it is in the
    /// first ring by even-odd and in none of the others by even-odd. That is
    /// the rule of GeoJSON and of `geo::MultiPolygon`.
    Polygons,
}

impl FillRule {
    /// All rules.
    pub const ALL: [FillRule; 5] = [
        FillRule::EvenOdd,
        FillRule::NonZero,
        FillRule::Positive,
        FillRule::Negative,
        FillRule::Polygons,
    ];

    /// The name in flags.
    pub fn name(self) -> &'static str {
        match self {
            FillRule::EvenOdd => "evenodd",
            FillRule::NonZero => "nonzero",
            FillRule::Positive => "positive",
            FillRule::Negative => "negative",
            FillRule::Polygons => "polygons",
        }
    }

    fn accepts(self, winding: i32) -> bool {
        match self {
            FillRule::EvenOdd | FillRule::Polygons => winding & 1 == 1,
            FillRule::NonZero => winding != 0,
            FillRule::Positive => winding > 0,
            FillRule::Negative => winding < 0,
        }
    }
}

/// A winding number that is kept apart from the others.
#[derive(Debug, Clone, Copy)]
struct Counter {
    operand: u32,
    /// The polygon, where polygons are kept apart.
    polygon: u32,
    is_hole: bool,
}

/// A combination of winding numbers.
pub(super) type State = u32;

/// All combinations of winding numbers met so far.
pub(super) struct States<'l> {
    rules: Vec<FillRule>,
    counters: Vec<Counter>,
    label: &'l dyn Fn(&[bool]) -> u32,
    /// Winding numbers that are not zero, by counter.
    windings: Vec<Vec<(u32, i32)>>,
    numbers: FxHashMap<Vec<(u32, i32)>, State>,
    steps: FxHashMap<(State, u32, i32), State>,
    labels: Vec<u32>,
}

/// Far from everything.
pub(super) const OUTSIDE: State = 0;

impl<'l> States<'l> {
    /// States for operands with these rules; `label` says what a place is
    /// that is inside these operands.
    pub(super) fn new(rules: Vec<FillRule>, label: &'l dyn Fn(&[bool]) -> u32) -> Self {
        let mut states = States {
            rules,
            counters: Vec::new(),
            label,
            windings: Vec::new(),
            numbers: FxHashMap::default(),
            steps: FxHashMap::default(),
            labels: Vec::new(),
        };
        let outside = states.number(Vec::new());
        debug_assert_eq!(outside, OUTSIDE);
        states
    }

    /// A new counter. Those of a polygon must be made one after the other.
    pub(super) fn counter(&mut self, operand: u32, polygon: u32, is_hole: bool) -> u32 {
        self.counters.push(Counter { operand, polygon, is_hole });
        self.counters.len() as u32 - 1
    }

    /// What a place with this state is.
    #[inline]
    pub(super) fn label(&self, state: State) -> u32 {
        self.labels[state as usize]
    }

    /// The state after a step across an edge that adds `delta` to a counter.
    pub(super) fn step(&mut self, from: State, counter: u32, delta: i32) -> State {
        if let Some(&to) = self.steps.get(&(from, counter, delta)) {
            return to;
        }
        let rule = self.rules[self.counters[counter as usize].operand as usize];
        let mut windings = self.windings[from as usize].clone();
        let place = windings.partition_point(|(other, _)| *other < counter);
        let before = match windings.get(place) {
            Some(&(other, winding)) if other == counter => {
                windings.remove(place);
                winding
            }
            _ => 0,
        };
        let after = match rule {
            // Only whether it is odd is of interest.
            FillRule::EvenOdd | FillRule::Polygons => (before + delta) & 1,
            _ => before + delta,
        };
        if after != 0 {
            windings.insert(place, (counter, after));
        }
        let to = self.number(windings);
        self.steps.insert((from, counter, delta), to);
        to
    }

    fn number(&mut self, windings: Vec<(u32, i32)>) -> State {
        if let Some(&state) = self.numbers.get(&windings) {
            return state;
        }
        let state = self.labels.len() as State;
        let label = (self.label)(&self.memberships(&windings));
        self.labels.push(label);
        self.windings.push(windings.clone());
        self.numbers.insert(windings, state);
        state
    }

    /// Which operands a place with these winding numbers is inside of.
    fn memberships(&self, windings: &[(u32, i32)]) -> Vec<bool> {
        let mut inside = vec![false; self.rules.len()];
        let counter = |index: usize| self.counters[windings[index].0 as usize];
        let mut first = 0;
        while first < windings.len() {
            let Counter { operand, polygon, .. } = counter(first);
            let mut end = first + 1;
            let same = |other: Counter| (other.operand, other.polygon) == (operand, polygon);
            while end < windings.len() && same(counter(end)) {
                end += 1;
            }
            // Without a counter for holes there are no holes apart.
            let rule = self.rules[operand as usize];
            let is_in = |i: usize| rule.accepts(windings[i].1);
            inside[operand as usize] |= (first..end).any(|i| is_in(i) && !counter(i).is_hole)
                && !(first..end).any(|i| is_in(i) && counter(i).is_hole);
            first = end;
        }
        inside
    }
}
