//! What every command shares: threads, the progress bar, limits, statistics,
//! notes.

use crate::failure::Failure;
use crate::interrupt::flag;
use crate::limit_flags::LimitFlags;
use crate::progress::Bar;
use clap::Args;
use std::fmt::Write as _;
use std::io::{Write, stderr};
use umriss::run::{Progress, Run, Silent};

/// Flags of every command that computes.
#[derive(Args)]
#[command(next_help_heading = "Run")]
pub(crate) struct RunFlags {
    /// Use this many threads; the result does not depend on it [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Say nothing but errors
    #[arg(long)]
    quiet: bool,
    /// Print counters and the time of every stage to standard error
    #[arg(long)]
    stats: bool,
    #[command(flatten)]
    limits: LimitFlags,
}

impl RunFlags {
    /// Sets up threads and progress, does `work`, prints statistics.
    pub(crate) fn run<T>(
        &self,
        work: impl FnOnce(&Run<'_>) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        self.start_threads()?;
        let bar = if self.quiet { None } else { Bar::on_terminal() };
        let progress: &dyn Progress = bar.as_ref().map_or(&Silent, |bar| bar);
        let run = Run::new(progress).with_cancel(flag()).with_limits(self.limits.limits());
        let result = work(&run)?;
        let statistics = self.stats.then(|| statistics(&run));
        drop(run);
        drop(bar);
        if let Some(text) = statistics {
            let _ = stderr().write_all(text.as_bytes());
        }
        Ok(result)
    }

    /// Tells the user something that is no error.
    pub(crate) fn note(&self, message: &str) {
        if !self.quiet {
            let _ = writeln!(stderr(), "umriss: {message}");
        }
    }

    #[cfg(feature = "parallel")]
    fn start_threads(&self) -> Result<(), Failure> {
        let Some(threads) = self.threads else {
            return Ok(());
        };
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads.into())
            .build_global()
            .map_err(|error| Failure::failed(format!("{threads} threads: {error}")))
    }

    /// This build has one thread, which is as good as any number.
    #[cfg(not(feature = "parallel"))]
    fn start_threads(&self) -> Result<(), Failure> {
        match self.threads {
            None | Some(1) => Ok(()),
            Some(_) => Err(Failure::usage("--threads: this build has one thread, expected 1")),
        }
    }
}

/// Two tables: counters by name, stages in their order.
fn statistics(run: &Run<'_>) -> String {
    let mut text = String::new();
    for (name, amount) in run.counters().iter() {
        let _ = writeln!(text, "{name:<40} {amount:>14}");
    }
    for stage in run.times() {
        let seconds = stage.time.as_secs_f64();
        let _ = writeln!(text, "time: {:<34} {seconds:>12.3} s", stage.stage);
    }
    text
}
