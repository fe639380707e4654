//! Progress, cancelling and limits, and the [`Run`] that carries them.

use super::{Counters, StageTime};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
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

/// The work was stopped from outside before it was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cancelled before the work was done")]
pub struct Cancelled;

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
    /// What the run may use.
    pub limits: Limits,
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

    /// Fails once the run has been cancelled. Stages ask between pieces of work.
    pub fn check(&self) -> Result<(), Cancelled> {
        match self.cancel {
            Some(flag) if flag.load(Ordering::Relaxed) => Err(Cancelled),
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
