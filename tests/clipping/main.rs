//! Clipping against everything that tells right from wrong: winding numbers
//! counted naively, exact areas, other eyes, published cases, `geo`.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod cases;
mod corpus;
mod draw;
mod naive;
mod peers;
mod random;
mod rounding;
mod tools;
mod validity;
mod views;
