//! Progress, cancelling and limits, and the [`Run`] that carries them.

use super::{Counters, StageTime};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Instant;

/// Hears how far a stage is. Called from many threads.
pub trait Progress: Sync {
    /// A stage of `total` units of work begins.
    fn begin(&self, stage: &'static str, total: u64);
    /// `units` more units of the current stage are done.
    fn advance(&self, units: u64);
    /// The current stage is over.
    fn end(&self);
}

/// A [`Progress`] that tells nobody.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {
    fn begin(&self, _: &'static str, _: u64) {}
    fn advance(&self, _: u64) {}
    fn end(&self) {}
}

/// The work was stopped before it was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Cancelled {
    /// Somebody asked for it.
    #[error("cancelled before the work was done")]
    Asked,
    /// A limit of the run was reached.
    #[error("stopped at {0} crossings, the limit of this run")]
    TooManyCrossings(u64),
}

/// Bounds on what a run may use; `None` is no bound.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Limits {
    /// The largest number of crossings, piercings and intersection
    /// segments together that a run may hold in memory.
    pub crossings: Option<u64>,
}

/// Counters, progress, cancelling and limits of one computation.
pub struct Run<'a> {
    progress: &'a dyn Progress,
    cancel: Option<&'a AtomicBool>,
    limits: Limits,
    crossings: AtomicU64,
    counters: Mutex<Counters>,
    times: Mutex<Vec<StageTime>>,
}

impl Default for Run<'_> {
    fn default() -> Self {
        Self::new(&Silent)
    }
}

impl<'a> Run<'a> {
    /// A run that reports to `progress`, cannot be cancelled, has no limits.
    pub fn new(progress: &'a dyn Progress) -> Self {
        Run {
            progress,
            cancel: None,
            limits: Limits::default(),
            crossings: AtomicU64::new(0),
            counters: Mutex::default(),
            times: Mutex::default(),
        }
    }

    /// The same run, stopped as soon as `cancel` becomes true.
    #[must_use]
    pub fn with_cancel(mut self, cancel: &'a AtomicBool) -> Self {
        self.cancel = Some(cancel);
        self
    }

    /// The same run with bounds on what it uses.
    #[must_use]
    pub fn with_limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// Fails once the run has been cancelled. Stages ask between pieces of work.
    pub fn check(&self) -> Result<(), Cancelled> {
        match self.cancel {
            Some(flag) if flag.load(Ordering::Relaxed) => Err(Cancelled::Asked),
            _ => Ok(()),
        }
    }

    /// Notes that `crossings` more are held in memory.
    ///
    /// # Errors
    ///
    /// If they are more than the limit allows.
    pub fn hold(&self, crossings: u64) -> Result<(), Cancelled> {
        let all = self.crossings.fetch_add(crossings, Ordering::Relaxed) + crossings;
        match self.limits.crossings {
            Some(limit) if limit < all => Err(Cancelled::TooManyCrossings(limit)),
            _ => Ok(()),
        }
    }

    /// Runs `work` as a stage of `total` units and notes its time.
    pub fn stage<T>(&self, stage: &'static str, total: u64, work: impl FnOnce() -> T) -> T {
        self.progress.begin(stage, total);
        let start = Instant::now();
        let result = work();
        let time = start.elapsed();
        if let Ok(mut times) = self.times.lock() {
            times.push(StageTime { stage, time });
        }
        self.progress.end();
        result
    }

    /// Tells that `units` of the current stage are done.
    pub fn advance(&self, units: u64) {
        self.progress.advance(units);
    }

    /// Adds to one counter.
    pub fn count(&self, name: &'static str, amount: u64) {
        if let Ok(mut counters) = self.counters.lock() {
            counters.add(name, amount);
        }
    }

    /// Adds all of `counters`.
    pub fn merge(&self, counters: &Counters) {
        if let Ok(mut own) = self.counters.lock() {
            own.merge(counters);
        }
    }

    /// A copy of the counters so far.
    pub fn counters(&self) -> Counters {
        self.counters.lock().map(|own| own.clone()).unwrap_or_default()
    }

    /// The stages so far, in the order in which they ended.
    pub fn times(&self) -> Vec<StageTime> {
        self.times.lock().map(|times| times.clone()).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_stops_when_asked_and_at_its_limit() {
        let flag = AtomicBool::new(false);
        let limits = Limits { crossings: Some(5) };
        let run = Run::new(&Silent).with_cancel(&flag).with_limits(limits);
        assert_eq!(run.check(), Ok(()));
        assert_eq!(run.hold(5), Ok(()));
        assert_eq!(run.hold(1), Err(Cancelled::TooManyCrossings(5)));
        flag.store(true, Ordering::Relaxed);
        assert_eq!(run.check(), Err(Cancelled::Asked));
    }
}
