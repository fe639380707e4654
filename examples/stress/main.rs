//! What plain floats would get wrong: hard scenes, each drawn exactly, with
//! every decision made a second time in plain floats, and proved.
//!
//! A table on standard output: decisions that were made from the mesh to
//! visible lines, all edges of all views of a scene; those of them that plain
//! floats decide otherwise; and whether `verify` finds the drawing, what is
//! seen of faces, and the painter's orders without any fault. No scene is made
//! for our algorithms: contacts, views along faces and eyes in their planes are
//! what technical models are full of.
//!
//! `cargo run --release --example stress`.

#![allow(clippy::print_stdout)]

mod proof;
mod scenes;

use proof::{Outcome, Proof, prove};

fn main() -> Outcome<()> {
    println!("| scene | views | faces | decisions | wrong in floats | share | verify |");
    println!("| --- | ---: | ---: | ---: | ---: | ---: | --- |");
    for scene in scenes::scenes(500) {
        let Proof { decisions, plain_wrong, faults } = prove(&scene)?;
        let share = 100.0 * plain_wrong as f64 / decisions.max(1) as f64;
        let verdict = if faults.is_empty() { "clean".into() } else { faults.join("; ") };
        println!(
            "| {} | {} | {} | {decisions} | {plain_wrong} | {share:.3} % | {verdict} |",
            scene.name,
            scene.cameras.len(),
            scene.soup.faces.len()
        );
    }
    Ok(())
}
