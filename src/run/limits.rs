//! What a run may use: how many crossings it may hold and how many bytes its
//! arrays may take.
//!
//! Bytes are not measured but added up: whoever makes an array whose size
//! follows from the scene says so before he makes it, or while it grows
//! ([`Growing`]). So the same limit stops the same scene in the same stage on
//! every machine, and nothing is asked of an allocator. What is small beside
//! these arrays is not counted: a process takes somewhat more than its limit.
//!
//! A run that has reached a limit stays stopped. A loop that cannot return an
//! error may therefore just end early, and whoever called it asks.

use super::Run;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// The work was stopped before it was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Cancelled {
    /// Somebody asked for it.
    #[error("cancelled before the work was done")]
    Asked,
    /// The limit on crossings was reached.
    #[error("{stage}: more than {limit} crossings, the limit of this run")]
    TooManyCrossings {
        /// The limit.
        limit: u64,
        /// What was being made.
        stage: &'static str,
    },
    /// The limit on memory was reached.
    #[error("{stage}: {wanted} bytes wanted, the limit of this run is {limit}")]
    TooMuchMemory {
        /// The limit in bytes.
        limit: u64,
        /// What all arrays of the run would have taken.
        wanted: u64,
        /// What was being made.
        stage: &'static str,
    },
}

/// Bounds on what a run may use; `None` is no bound.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Limits {
    /// The largest number of crossings, piercings and intersection
    /// segments together that a run may hold in memory.
    pub crossings: Option<u64>,
    /// The most bytes that the arrays of a run may take, added up where they
    /// are made. The process takes somewhat more.
    pub memory: Option<u64>,
}

/// What a run holds, and whether that has become too much.
#[derive(Debug, Default)]
pub(super) struct Holdings {
    limits: Limits,
    crossings: AtomicU64,
    bytes: AtomicU64,
    is_over: AtomicBool,
    /// The limit that was reached first.
    over: OnceLock<Cancelled>,
}

impl Holdings {
    pub(super) fn within(limits: Limits) -> Self {
        Holdings { limits, ..Holdings::default() }
    }

    #[inline]
    pub(super) fn check(&self) -> Result<(), Cancelled> {
        if !self.is_over.load(Ordering::Relaxed) {
            return Ok(());
        }
        self.over.get().map_or(Ok(()), |&over| Err(over))
    }

    pub(super) fn hold(
        &self,
        crossings: u64,
        stage: impl FnOnce() -> &'static str,
    ) -> Result<(), Cancelled> {
        let all = add(&self.crossings, crossings);
        match self.limits.crossings {
            Some(limit) if limit < all => {
                self.stop(Cancelled::TooManyCrossings { limit, stage: stage() })
            }
            _ => self.check(),
        }
    }

    pub(super) fn take(
        &self,
        bytes: u64,
        stage: impl FnOnce() -> &'static str,
    ) -> Result<(), Cancelled> {
        let wanted = add(&self.bytes, bytes);
        match self.limits.memory {
            Some(limit) if limit < wanted => {
                self.stop(Cancelled::TooMuchMemory { limit, wanted, stage: stage() })
            }
            _ => self.check(),
        }
    }

    pub(super) fn give_back(&self, bytes: u64) {
        let less = |all: u64| Some(all.saturating_sub(bytes));
        // A function that always has an answer cannot fail.
        let _ = self.bytes.fetch_update(Ordering::Relaxed, Ordering::Relaxed, less);
    }

    /// Of several limits that are reached at once the first one stays.
    fn stop(&self, why: Cancelled) -> Result<(), Cancelled> {
        let why = *self.over.get_or_init(|| why);
        self.is_over.store(true, Ordering::Release);
        Err(why)
    }
}

/// Adds to a sum that does not wrap; returns it.
fn add(sum: &AtomicU64, more: u64) -> u64 {
    sum.fetch_add(more, Ordering::Relaxed).saturating_add(more)
}

/// Items that a list may grow by before the run is told.
const UNTOLD: usize = 1 << 12;

/// A worker's list of unknown length: tells the run by how much it has grown,
/// seldom enough to cost nothing, and asks whether to go on.
#[derive(Debug)]
pub struct Growing<'r> {
    run: &'r Run<'r>,
    bytes_each: u64,
    are_crossings: bool,
    told: usize,
}

impl<'r> Growing<'r> {
    /// A list whose items take so many bytes, everything that is made of one
    /// included.
    pub fn new(run: &'r Run<'r>, bytes_each: usize) -> Self {
        Growing { run, bytes_each: bytes_each as u64, are_crossings: false, told: 0 }
    }

    /// The same for items that count as crossings.
    #[must_use]
    pub fn of_crossings(self) -> Self {
        Growing { are_crossings: true, ..self }
    }

    /// Whether to go on, asked before a step of work on a list that is `len`
    /// items long by now. Once false it stays so.
    #[inline]
    pub fn goes_on(&mut self, len: usize) -> bool {
        if self.told + UNTOLD <= len {
            self.tell(len);
        }
        !self.run.is_stopped()
    }

    /// Tells the run of everything; the list is done and stays.
    ///
    /// # Errors
    ///
    /// If the run is stopped.
    pub fn finish(&mut self, len: usize) -> Result<(), Cancelled> {
        self.tell(len);
        self.run.check()
    }

    /// Gives back all that was told; the list is thrown away.
    pub fn throw_away(self) {
        self.run.give_back(self.told as u64 * self.bytes_each);
    }

    fn tell(&mut self, len: usize) {
        let more = len.saturating_sub(self.told) as u64;
        self.told = self.told.max(len);
        self.run.advance(0);
        let crossings = if self.are_crossings { more } else { 0 };
        // Whoever asks next is told why the run has stopped.
        let _ = self.run.hold(crossings).and(self.run.take(more * self.bytes_each));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_that_grows_stops_at_the_limit() {
        let limits = Limits { crossings: Some(10_000), memory: None };
        let run = Run::default().with_limits(limits);
        let mut growing = Growing::new(&run, 8).of_crossings();
        let mut list = Vec::new();
        while growing.goes_on(list.len()) && list.len() < 1_000_000 {
            list.push(0_u64);
        }
        assert!((10_000..20_000).contains(&list.len()), "{}", list.len());
        assert!(run.is_stopped());
    }

    #[test]
    fn a_sum_does_not_wrap() {
        let run = Run::default().with_limits(Limits { crossings: None, memory: Some(10) });
        assert!(run.take(u64::MAX).is_err());
        assert!(run.take(u64::MAX).is_err());
    }
}
