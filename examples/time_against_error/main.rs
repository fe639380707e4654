//! Run time against error, for ways to find visible lines: the table on
//! standard output and the plot `output/time-against-error.svg`.
//!
//! - Appel's method, exact; the same code with float decisions, where the
//!   filter fails (`filter only`) or always (`plain`), which shows what
//!   exactness costs and what goes wrong without it;
//! - Roberts' method, exact;
//! - sampled visibility, as line-art programs have it: rays from points at a
//!   step along each line to the eye ([`sampled`]);
//! - lines looked up in a z-buffer ([`buffers`]).
//!
//! All edges of models, degenerate scenes and random soups are drawn, seen by
//! parallel rays. Error is the length in the image that is drawn wrongly plus
//! the length that is missed, as a share of the length of all lines; what the
//! exact answer says is right, which `umriss verify` proves. Time is from the
//! mesh to visible pieces on all cores, whatever a method has to prepare
//! included. All run in turn, round after round; medians are told.
//!
//! `cargo run --release --example time_against_error`. Times are of one
//! machine.

#![allow(clippy::print_stdout)]

mod buffers;
mod measure;
mod plot;
mod sampled;
mod scenes;

use measure::{Contender, Outcome, Row, measure};
use std::path::Path;
use umriss::export::write_file;

fn main() -> Outcome<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let contenders = Contender::all();
    let mut rows: Vec<Row> = contenders.iter().map(|&contender| Row::new(contender)).collect();
    for scene in scenes::scenes(root)? {
        let found = measure(&scene, &contenders)?;
        println!("\n{}: {} triangles, {} edges\n", scene.name, found.triangles, found.edges);
        println!("| method | ms | drawn wrongly | missed |");
        println!("| --- | ---: | ---: | ---: |");
        for (row, result) in rows.iter_mut().zip(&found.results) {
            let [extra, missed] = result.wrong.map(|share| format!("{:.4} %", 100.0 * share));
            println!("| {} | {:.2} | {extra} | {missed} |", row.contender.name(), result.time);
            row.add(result, found.results[0].time);
        }
    }
    println!("\nAll scenes\n");
    println!("| method | time, of exact | wrong, mean | wrong, worst | scenes with errors |");
    println!("| --- | ---: | ---: | ---: | ---: |");
    for row in &rows {
        println!(
            "| {} | {:.2} | {:.4} % | {:.4} % | {} |",
            row.contender.name(),
            row.time(),
            100.0 * row.mean(),
            100.0 * row.worst(),
            row.scenes_with_errors()
        );
    }
    write_file(&root.join("output/time-against-error.svg"), plot::plot(&rows).as_bytes())?;
    Ok(())
}
