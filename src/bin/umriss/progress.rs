//! The progress bar: only on a terminal, and only for work over a second.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;
use umriss::run::Progress;

/// Work that is done sooner needs no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// How often the bar shows that the program is alive.
const TICK: Duration = Duration::from_millis(100);

/// A bar on standard error, invisible for its first second.
pub(crate) struct Bar {
    bar: ProgressBar,
    /// Dropped with the bar: a bar that was never shown stays so.
    _done: Sender<()>,
}

impl Bar {
    /// A bar, if standard error is a terminal.
    pub(crate) fn on_terminal() -> Option<Self> {
        stderr().is_terminal().then(Self::new)
    }

    fn new() -> Self {
        let bar = ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::hidden());
        if let Ok(style) =
            ProgressStyle::with_template("{spinner} {msg:20} {wide_bar} {percent:>3}%")
        {
            bar.set_style(style);
        }
        let (done, waiting) = channel::<()>();
        let shown = bar.clone();
        thread::spawn(move || {
            if waiting.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(TICK);
            }
        });
        Bar { bar, _done: done }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Bar {
    fn begin(&self, stage: &'static str, total: u64) {
        self.bar.set_length(total);
        self.bar.set_position(0);
        self.bar.set_message(stage);
    }

    fn advance(&self, units: u64) {
        self.bar.inc(units);
    }

    fn end(&self) {
        self.bar.set_position(self.bar.length().unwrap_or(0));
    }
}
