//! `umriss heal`: models to a model whose borders meet.

use crate::failure::Failure;
use crate::interrupt::writing;
use crate::model_flags::{FileFlags, Heal as Reach, parse_heal};
use crate::models::read_healed;
use crate::outputs::print;
use crate::overwriting;
use crate::session::RunFlags;
use clap::Args;
use std::path::PathBuf;
use umriss::export::{write_file, write_model};
use umriss::model::Unit;
use umriss::model::import::Format;

const EXAMPLES: &str = "\
Examples:
  umriss heal part.stl -o part.obj
  umriss heal house.obj trees.obj -o scene.json --within 1e-4
  cat part.off | umriss heal - -o - --format ply > part.ply";

const WRITTEN: &str = "expected obj, off, ply, stl or json";

/// Repair what rounding has torn, and write the model.
///
/// Vertices go to vertices, to edges of their object and to planes that they
/// nearly lie on; none moves farther than told. All models are one scene.
/// Coordinates are written with all their digits, z up; STL rounds them to
/// narrow floats.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Heal {
    /// Models; - is standard input
    #[arg(value_name = "MODEL", required = true)]
    models: Vec<PathBuf>,
    /// Write the model here; the extension tells the format: obj, off, ply, stl, json. With
    /// --format, - is standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Format of an output whose name does not tell it: obj, off, ply, stl, json
    #[arg(long, value_name = "F", value_parser = parse_written)]
    format: Option<Format>,
    /// Repair what is nearer than this, in the models' unit, or, with auto, than their files tell
    #[arg(long, value_name = "TOL|auto", default_value = "auto", value_parser = parse_heal)]
    within: Reach,
    #[command(flatten)]
    files: FileFlags,
    #[command(flatten)]
    session: RunFlags,
}

impl Heal {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let format = self.output_format()?;
        let inputs = self.models.iter().map(PathBuf::as_path);
        overwriting::refuse("--output", [&*self.output], inputs)?;
        let file = self.session.run(|run| {
            let (objects, unit) =
                read_healed(&self.models, &self.files, self.within, &self.session, run)?;
            if unit != Unit::default() {
                self.session.note(&format!("the numbers are in {0}: --unit {0}", unit.name()));
            }
            let written = run.stage("writing", 1, || write_model(&objects, format));
            Ok::<_, Failure>(written?)
        })?;
        if !file.left_out.is_empty() {
            let left_out = file.left_out.join(" and ");
            self.session.note(&format!("{} has no place for {left_out}", format.name()));
        }
        if self.output.as_os_str() == "-" {
            return print(&file.bytes);
        }
        writing(|| write_file(&self.output, &file.bytes))
    }

    fn output_format(&self) -> Result<Format, Failure> {
        let expected = |what: &str| Failure::usage(format!("{what}: {WRITTEN}"));
        if self.output.as_os_str() == "-" {
            return self.format.ok_or_else(|| Failure::usage("--output - needs --format"));
        }
        match Format::from_extension(&self.output).or(self.format) {
            Some(Format::Gltf) => Err(expected("glTF is read only")),
            Some(format) => Ok(format),
            None => Err(expected(&format!("{}: no format of models", self.output.display()))),
        }
    }
}

fn parse_written(name: &str) -> Result<Format, String> {
    Format::from_name(name)
        .filter(|&format| format != Format::Gltf)
        .ok_or_else(|| WRITTEN.to_owned())
}
