//! Progress and cancelling, and the [`Run`] that carries them, counters and
//! limits.

use super::limits::{Cancelled, Holdings, Limits};
use super::{Counters, StageTime};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Hears how far a stage is. Called from many threads.
pub trait Progress: Sync {
    /// A stage of `total` units of work begins.
    fn begin(&self, stage: &'static str, total: u64);
    /// `units` more units of the current stage are done; zero where it goes on
    /// with one that takes long.
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

/// Counters, progress, cancelling and limits of one computation.
pub struct Run<'a> {
    progress: &'a dyn Progress,
    cancel: Option<&'a AtomicBool>,
    holdings: Holdings,
    /// The stages that have begun and not ended, the innermost last.
    stages: Mutex<Vec<&'static str>>,
    counters: Mutex<Counters>,
    times: Mutex<Vec<StageTime>>,
}

impl std::fmt::Debug for Run<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Run").field("holdings", &self.holdings).finish_non_exhaustive()
    }
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
            holdings: Holdings::default(),
            stages: Mutex::default(),
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
        self.holdings = Holdings::within(limits);
        self
    }

    /// Fails once the run has been cancelled or has reached a limit. Stages
    /// ask between pieces of work that take far less than a second.
    ///
    /// # Errors
    ///
    /// What stopped the run; the same from then on.
    #[inline]
    pub fn check(&self) -> Result<(), Cancelled> {
        match self.cancel {
            Some(flag) if flag.load(Ordering::Relaxed) => Err(Cancelled::Asked),
            _ => self.holdings.check(),
        }
    }

    /// Whether [`Run::check`] fails: for loops that cannot return an error,
    /// whose caller asks again.
    #[inline]
    pub fn is_stopped(&self) -> bool {
        self.check().is_err()
    }

    /// Notes that `crossings` more are held in memory.
    ///
    /// # Errors
    ///
    /// If they are more than the limit allows, and then the run is stopped; or
    /// if it was stopped before.
    pub fn hold(&self, crossings: u64) -> Result<(), Cancelled> {
        self.holdings.hold(crossings, || self.stage_name())?;
        self.check()
    }

    /// Notes that arrays of so many bytes are about to be made, or have grown
    /// by so much. What is thrown away again is given back with
    /// [`Run::give_back`], and what belongs to a result never is: a run is for
    /// one drawing.
    ///
    /// # Errors
    ///
    /// If the bytes are more than the limit allows, and then the run is stopped;
    /// or if it was stopped before.
    pub fn take(&self, bytes: u64) -> Result<(), Cancelled> {
        self.holdings.take(bytes, || self.stage_name())?;
        self.check()
    }

    /// Notes that bytes that were taken are free again.
    pub fn give_back(&self, bytes: u64) {
        self.holdings.give_back(bytes);
    }

    /// The innermost stage that has not ended; empty outside of all.
    fn stage_name(&self) -> &'static str {
        let innermost = self.stages.lock().ok().and_then(|stages| stages.last().copied());
        innermost.unwrap_or_default()
    }

    /// Runs `work` as a stage of `total` units and notes its time.
    pub fn stage<T>(&self, stage: &'static str, total: u64, work: impl FnOnce() -> T) -> T {
        self.progress.begin(stage, total);
        if let Ok(mut stages) = self.stages.lock() {
            stages.push(stage);
        }
        let start = Instant::now();
        let result = work();
        let time = start.elapsed();
        if let Ok(mut times) = self.times.lock() {
            times.push(StageTime { stage, time });
        }
        if let Ok(mut stages) = self.stages.lock() {
            stages.pop();
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
        let run = Run::new(&Silent).with_cancel(&flag);
        assert_eq!(run.check(), Ok(()));
        flag.store(true, Ordering::Relaxed);
        assert_eq!(run.check(), Err(Cancelled::Asked));
        let limits = Limits { crossings: Some(5), memory: None };
        let run = Run::default().with_limits(limits);
        assert_eq!(run.hold(5), Ok(()));
        assert_eq!(run.check(), Ok(()));
        let stopped = run.stage("counting", 1, || run.hold(1));
        let expected = Cancelled::TooManyCrossings { limit: 5, stage: "counting" };
        assert_eq!(stopped, Err(expected));
        assert_eq!(run.check(), Err(expected), "a run that was stopped stays so");
    }

    #[test]
    fn memory_is_asked_for_before_it_is_used_and_given_back() {
        let limits = Limits { crossings: None, memory: Some(100) };
        let run = Run::default().with_limits(limits);
        assert_eq!(run.take(80), Ok(()));
        run.give_back(60);
        assert_eq!(run.take(80), Ok(()));
        let stopped = run.stage("filling", 1, || run.take(1));
        let expected = Cancelled::TooMuchMemory { limit: 100, wanted: 101, stage: "filling" };
        assert_eq!(stopped, Err(expected));
        assert!(run.is_stopped());
    }
}
