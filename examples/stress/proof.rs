//! One scene drawn, audited and proved.

use super::scenes::Scene;
use std::error::Error;
use umriss::exact;
use umriss::kernel::predicates::Audited;
use umriss::model::{FeatureOptions, LineClass, Mesh, View};
use umriss::run::Run;
use umriss::verify::{PaintVerifyOptions, RegionVerifyOptions, VerifyOptions};
use umriss::view::PreparedView;
use umriss::visibility::{AppelOptions, appel, reduce};

pub(crate) type Outcome<T> = Result<T, Box<dyn Error>>;

/// What was found.
pub(crate) struct Proof {
    /// Decisions from the mesh to visible lines, of all views.
    pub(crate) decisions: u64,
    /// Those that plain floats decide otherwise.
    pub(crate) plain_wrong: u64,
    /// What `verify` says, view by view, if anything.
    pub(crate) faults: Vec<String>,
}

/// Draws all views of a scene with all edges, and checks them.
pub(crate) fn prove(scene: &Scene) -> Outcome<Proof> {
    let mesh = Mesh::new(vec![scene.soup.clone()], None)?;
    let mut proof = Proof { decisions: 0, plain_wrong: 0, faults: Vec::new() };
    for (number, camera) in scene.cameras.iter().enumerate() {
        let view = camera.view(mesh.bounds())?;
        audit(&mesh, &view, &mut proof)?;
        for fault in faults(&mesh, &view)? {
            proof.faults.push(format!("view {number}: {fault}"));
        }
    }
    Ok(proof)
}

fn options() -> FeatureOptions {
    FeatureOptions::default().with_classes(&LineClass::ALL)
}

fn audit(mesh: &Mesh, view: &View, proof: &mut Proof) -> Outcome<()> {
    let run = Run::default();
    let prepared = PreparedView::new::<Audited>(mesh, view, &options(), &run)?;
    let question = prepared.question(true);
    let answer = appel::<Audited>(&question, &AppelOptions::default(), &run)?;
    reduce::<Audited>(&question, &answer, &run)?;
    proof.decisions += run.counters().get("decisions");
    proof.plain_wrong += run.counters().get("plain-floats-wrong");
    Ok(())
}

/// What `verify` says of lines, regions and painting orders.
fn faults(mesh: &Mesh, view: &View) -> Outcome<Vec<String>> {
    let run = Run::default();
    let prepared = exact::prepare(mesh, view, &options(), &run)?;
    let question = prepared.question(true);
    let answer = exact::appel(&question, &AppelOptions::default(), &run)?;
    let mut faults = Vec::new();
    let options = VerifyOptions { image_size: 64, ..VerifyOptions::default() };
    let lines = exact::verify(view, &question, &answer, &options, &run)?;
    if !lines.is_clean() {
        faults.push(format!("lines\n{lines}"));
    }
    let options = RegionVerifyOptions { image_size: 32, ..RegionVerifyOptions::default() };
    let regions = exact::verify_regions(view, &question, &answer, &options, &run)?;
    if !regions.is_clean() {
        faults.push(format!("regions\n{regions}"));
    }
    let options = PaintVerifyOptions { image_size: 32, ..PaintVerifyOptions::default() };
    let painting = exact::verify_painting(view, &question, &options, &run)?;
    if !painting.is_clean() {
        faults.push(format!("painting\n{painting}"));
    }
    Ok(faults)
}
