//! What each shortcut buys, where, and that it changes nothing.
//!
//! Named scenes are drawn with all shortcuts, and again with one of them
//! turned off; the pieces must be the same, or the example fails. Told is
//! how many times longer it takes without, from the mesh to exact pieces.
//! Below 1 the shortcut loses.
//!
//! - `culling`: lines behind what is certainly covered are not walked;
//! - `convex parts`: they are not searched for crossings with themselves, and
//!   their edges at the back are not walked;
//! - `early`: a line that stays hidden whatever the order of its events is
//!   left before they are put in order;
//! - `carry`: counts go from line to line, few lines are counted afresh;
//! - `filter`: floats decide first; without it, integers decide all;
//! - `features only`: inner edges of surfaces are no lines;
//! - `no interpenetration`: surfaces that pass through one another are not
//!   looked for.
//!
//! The last two are wishes rather than shortcuts; what they leave is the same
//! as what it is among more lines, and that is compared.
//!
//! Lines outside of the frame are not walked either: the middle ninth of some
//! pictures is drawn beside the whole.
//!
//! `cargo run --release --example skips` (and a number, for scenes so many
//! times smaller). Times are of one machine.

#![allow(clippy::print_stdout)]

mod measure;
mod scenes;

use measure::{Skipped, median_times};
use scenes::Scene;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Rounds of which medians are told.
const ROUNDS: usize = 3;

fn main() -> Outcome<()> {
    let scale = std::env::args().nth(1).map_or(Ok(1), |text| text.parse())?;
    let surface = scenes::surface(scale)?;
    let cubes = scenes::cubes(scale)?;
    let sheets = [4, 256].map(|count| scenes::sheets(count, scale));
    let [few, many] = sheets;
    let (few, many) = (few?, many?);
    let (fine, huge) = (scenes::fine(scale)?, scenes::fine_in_huge(scale)?);
    let town = scenes::town_behind_a_wall(scale)?;
    table(&[&surface, &cubes, &few, &many, &fine, &huge, &town])?;
    println!("\n| scene | against | time | of its time |");
    println!("| --- | --- | ---: | ---: |");
    against(&many, &few)?;
    against(&cubes, &surface)?;
    against(&huge, &fine)?;
    println!("\n| scene | the middle ninth | the whole | lines with pieces left out |");
    println!("| --- | ---: | ---: | ---: |");
    for scene in [&surface, &cubes, &town] {
        let ([part, whole], left_out) = measure::part_and_whole(scene, ROUNDS)?;
        println!("| {} | {part:.0} ms | {whole:.0} ms | {left_out} |", scene.name);
    }
    Ok(())
}

/// One line for each scene.
fn table(scenes: &[&Scene]) -> Outcome<()> {
    let without = Skipped::ALL.map(|skipped| format!("without {}", skipped.name()));
    println!("| scene | triangles | lines | ms | {} |", without.join(" | "));
    println!("| --- | ---: | ---: | ---: | {} |", ["---:"; Skipped::ALL.len()].join(" | "));
    for scene in scenes {
        let found = measure::measure(scene, ROUNDS)?;
        let factors: Vec<String> =
            found.factors.iter().map(|factor| format!("{factor:.2}")).collect();
        println!(
            "| {} | {} | {} | {:.0} | {} |",
            scene.name,
            scene.mesh.triangles().len(),
            found.lines,
            found.time,
            factors.join(" | ")
        );
    }
    Ok(())
}

/// How much longer one scene takes than another, all edges, visible lines.
fn against(scene: &Scene, other: &Scene) -> Outcome<()> {
    let [own, others] = median_times([scene, other], ROUNDS)?;
    println!("| {} | {} | {own:.0} ms | {:.2} |", scene.name, other.name, own / others);
    Ok(())
}
