//! Crossings ahead of the sweep line, the first on top of a binary heap.
//!
//! A heap of its own, for the standard library's cannot ask predicates.

use crate::kernel::predicates::Approximation;

/// Two neighbours that will cross.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting {
    pub(super) approximation: Approximation,
    /// Their edges, the lower one first.
    pub(super) edges: [u32; 2],
    pub(super) slots: [u32; 2],
    /// The pieces that were in the slots then: if others are now, something
    /// happened in between and the meeting is void.
    pub(super) pieces: [u32; 2],
}

/// A heap of meetings.
#[derive(Debug, Default)]
pub(super) struct Queue {
    heap: Vec<Meeting>,
}

impl Queue {
    pub(super) fn first(&self) -> Option<&Meeting> {
        self.heap.first()
    }

    pub(super) fn push(
        &mut self,
        meeting: Meeting,
        mut before: impl FnMut(&Meeting, &Meeting) -> bool,
    ) {
        self.heap.push(meeting);
        let mut child = self.heap.len() - 1;
        while child > 0 {
            let parent = (child - 1) / 2;
            if !before(&self.heap[child], &self.heap[parent]) {
                break;
            }
            self.heap.swap(child, parent);
            child = parent;
        }
    }

    pub(super) fn pop(
        &mut self,
        mut before: impl FnMut(&Meeting, &Meeting) -> bool,
    ) -> Option<Meeting> {
        if self.heap.is_empty() {
            return None;
        }
        let top = self.heap.swap_remove(0);
        let mut parent = 0;
        loop {
            let mut least = parent;
            for child in [2 * parent + 1, 2 * parent + 2] {
                if child < self.heap.len() && before(&self.heap[child], &self.heap[least]) {
                    least = child;
                }
            }
            if least == parent {
                return Some(top);
            }
            self.heap.swap(parent, least);
            parent = least;
        }
    }
}
