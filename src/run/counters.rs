//! Counters: how much of each kind of work a run did.
//!
//! Counters are sums over independent pieces of work, so they do not
//! depend on the number of threads. Times are kept apart from them, because
//! counters are part of a JSON drawing and times must not be.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::time::Duration;

/// Named sums, sorted by name. Adding is commutative.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Counters {
    sums: BTreeMap<Cow<'static, str>, u64>,
}

impl Counters {
    /// Adds `amount` to the counter `name`; a counter starts at zero. Names
    /// are written in the code, or read from a drawing.
    pub fn add(&mut self, name: impl Into<Cow<'static, str>>, amount: u64) {
        let sum = self.sums.entry(name.into()).or_insert(0);
        *sum = sum.saturating_add(amount);
    }

    /// Adds every counter of `other`.
    pub fn merge(&mut self, other: &Self) {
        for (name, amount) in &other.sums {
            self.add(name.clone(), *amount);
        }
    }

    /// The counter `name`, zero if nothing was counted under it.
    pub fn get(&self, name: &str) -> u64 {
        self.sums.get(name).copied().unwrap_or(0)
    }

    /// All counters in the order of their names.
    pub fn iter(&self) -> impl Iterator<Item = (&str, u64)> + '_ {
        self.sums.iter().map(|(name, amount)| (&**name, *amount))
    }

    /// Whether nothing was counted.
    pub fn is_empty(&self) -> bool {
        self.sums.is_empty()
    }
}

/// How long one stage of a run took, for the terminal only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StageTime {
    /// The stage, as in `"features"`.
    pub stage: &'static str,
    /// Wall-clock time of the stage.
    pub time: Duration,
}
