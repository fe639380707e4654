//! Why a line is drawn or hidden: the sets of faces in front of it.
//!
//! `sets` holds every set against the engine's count and against Roberts'
//! rule, one face at a time; `cases` are small scenes in which one can say
//! what is in front.

#![cfg(feature = "json")]
#![allow(clippy::unwrap_used)]

mod cases;
mod scenes;
mod sets;
