//! What happens when the user, or the system, asks the program to stop.
//!
//! The first signal (Ctrl-C, and SIGTERM and SIGHUP where there are such) sets
//! a flag that every stage of a run asks; the run then ends with an error, and
//! nothing is written. Some work asks nobody: packages that parse or render,
//! one step over a very large array. So after a second the program ends by
//! itself, but never while a file is being written: that is finished, for half
//! a file is worse. A second signal ends the program at once.
//!
//! Signals are the one thing here that belongs to the process and not to a
//! value, so their flag is the one thing that is static.

use crate::failure::{Failure, INTERRUPTED};
use std::io::{Write, stderr};
use std::process::exit;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

/// How long stages have to notice.
const PATIENCE: Duration = Duration::from_secs(1);

static ASKED: AtomicBool = AtomicBool::new(false);

/// Held while a file is written.
static WRITING: Mutex<()> = Mutex::new(());

/// From now on signals are noticed.
pub(crate) fn listen() {
    // Where signals cannot be had, they do what they always do.
    let _ = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::SeqCst) {
            exit(INTERRUPTED.into());
        }
        thread::spawn(|| {
            thread::sleep(PATIENCE);
            // A thread that panicked while it wrote writes no more.
            let _writing = WRITING.lock();
            let _ = writeln!(stderr(), "umriss: {}", Failure::INTERRUPTION);
            exit(INTERRUPTED.into());
        });
    });
}

/// The flag that stops a run.
pub(crate) fn flag() -> &'static AtomicBool {
    &ASKED
}

/// Writes one file, which is not begun once a signal came, and not left
/// unfinished if one comes.
pub(crate) fn writing<T, E>(write: impl FnOnce() -> Result<T, E>) -> Result<T, Failure>
where
    Failure: From<E>,
{
    let _writing = WRITING.lock();
    if ASKED.load(Ordering::SeqCst) {
        return Err(Failure::Interrupted);
    }
    Ok(write()?)
}
