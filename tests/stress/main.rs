//! The scenes of the example `stress`: all are drawn without a fault, and in
//! nearly all of them plain floats decide something wrongly.

#[path = "../../examples/stress/proof.rs"]
mod proof;
#[path = "../../examples/stress/scenes.rs"]
mod scenes;

use proof::{Outcome, prove};

#[test]
fn hard_scenes_are_drawn_without_a_fault() -> Outcome<()> {
    let mut harmless = Vec::new();
    for scene in scenes::scenes(60) {
        let proof = prove(&scene)?;
        assert!(proof.faults.is_empty(), "{}: {}", scene.name, proof.faults.join("\n"));
        assert!(proof.decisions > 0, "{}", scene.name);
        if proof.plain_wrong == 0 {
            harmless.push(scene.name);
        }
    }
    assert!(harmless.len() < 5, "floats are right in {harmless:?}, more than expected");
    Ok(())
}
