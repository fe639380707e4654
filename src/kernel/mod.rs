//! The kernel: numbers, points and the exact predicates that everything
//! else stands on. Position is decided here and nowhere else.

pub mod numbers;
pub mod predicates;
