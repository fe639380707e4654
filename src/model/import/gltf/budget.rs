//! How large a model a document may become: nodes, primitives and instances
//! share arrays, so a small file can be a model without end.

use crate::run::Run;

/// The most vertices, corners and primitives that all objects may have
/// together.
const MOST: u64 = 1 << 26;

/// Bytes that one of them takes, at least.
const BYTES: u64 = 8;

/// What may still be made.
pub(super) struct Budget<'a> {
    left: u64,
    run: &'a Run<'a>,
}

impl<'a> Budget<'a> {
    pub(super) fn within(run: &'a Run<'a>) -> Self {
        Budget { left: MOST, run }
    }

    /// Spends on so many vertices, corners or primitives.
    ///
    /// # Errors
    ///
    /// What is wrong, if that is too much; or if the run is stopped, and then
    /// whoever reads the document asks the run first.
    pub(super) fn spend(&mut self, cost: u64) -> Result<(), String> {
        let left = self.left.checked_sub(cost).filter(|_| self.run.take(BYTES * cost).is_ok());
        self.run.advance(0);
        match left {
            Some(left) => {
                self.left = left;
                Ok(())
            }
            None => Err(format!("too many vertices and corners, expected {MOST} in all")),
        }
    }
}

impl Drop for Budget<'_> {
    /// What objects take is counted by whoever keeps them.
    fn drop(&mut self) {
        self.run.give_back(BYTES * (MOST - self.left));
    }
}
