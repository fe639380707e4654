//! The program `umriss`: reads flags, runs the library, writes files.
//!
//! One file per command; what commands share stands beside them: flags
//! ([`grid_flags`], [`model_flags`], [`object_flags`], [`camera_flags`], [`line_flags`], [`page_flags`],
//! [`pen_flags`], [`plotter_flags`], [`stroke_flags`], [`style_flags`], [`surface_flags`]), reading
//! ([`models`], [`input`]), writing ([`outputs`], [`overwriting`]) and the frame of a run ([`session`], [`limit_flags`]).
//! Only the public interface of the library is used, and no geometry is done
//! here.
//!
//! Nothing is printed but what was asked for: results go to standard output
//! or into files, everything else to standard error, one line each. The exit
//! code is 0 if all went well, 1 if something failed, 2 if the command line
//! makes no sense, 130 if a signal stopped the program ([`interrupt`]).

mod camera_file;
mod camera_flags;
mod clip;
mod crossed_faces;
mod draw;
mod explain;
mod explanation;
mod failure;
#[cfg(feature = "png")]
mod finish;
mod grid_flags;
mod heal;
mod info;
mod input;
mod interrupt;
mod limit_flags;
mod line_flags;
mod model_flags;
mod models;
mod object_flags;
mod outputs;
mod overwriting;
mod page_flags;
mod paint;
mod pen_flags;
#[cfg(feature = "png")]
mod picture;
mod plotter_flags;
mod progress;
#[cfg(feature = "png")]
mod raster;
mod sample_grid;
mod session;
mod stroke_flags;
mod style_flags;
mod surface;
mod surface_flags;
mod verify;

use clap::{Parser, Subcommand};
use failure::Failure;
use std::io::{Write, stderr, stdout};
use std::process::ExitCode;

/// Arrays of all triangles come and go with each stage. This allocator keeps
/// their memory for the next stage and asks for large pages; the system's
/// gives it back and takes it anew, page by page.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Exact hidden-line drawings of 3D models.
///
/// Reads OBJ, STL, PLY, OFF, glTF and JSON polygon scenes, expressions and grids of heights; draws SVG, HPGL,
/// JSON and PNG. Whether a line is hidden is decided exactly, never by a
/// tolerance.
#[derive(Parser)]
#[command(name = "umriss", version, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Clip(Box<clip::Clip>),
    Draw(Box<draw::Draw>),
    Explain(Box<explain::Explain>),
    Heal(Box<heal::Heal>),
    Info(Box<info::Info>),
    #[cfg(feature = "png")]
    Raster(Box<raster::Raster>),
    Surface(Box<surface::SurfaceCommand>),
    Verify(Box<verify::Verify>),
}

fn main() -> ExitCode {
    interrupt::listen();
    let outcome = match Cli::try_parse() {
        Ok(cli) => match cli.command {
            Command::Clip(clip) => clip.run(),
            Command::Draw(draw) => draw.run(),
            Command::Explain(explain) => explain.run(),
            Command::Heal(heal) => heal.run(),
            Command::Info(info) => info.run(),
            #[cfg(feature = "png")]
            Command::Raster(raster) => raster.run(),
            Command::Surface(surface) => surface.run(),
            Command::Verify(verify) => verify.run(),
        },
        Err(error) if !error.use_stderr() => print_help(&error),
        Err(error) => Err(Failure::from(error)),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => report(&failure),
    }
}

/// Help and version are what was asked for, so they go to standard output.
fn print_help(help: &clap::Error) -> Result<(), Failure> {
    outputs::print(help.render().to_string().as_bytes())
}

fn report(failure: &Failure) -> ExitCode {
    if let Some(message) = failure.message() {
        // Where standard error is closed too, nobody is left to be told.
        let _ = writeln!(stderr(), "{message}");
    }
    let _ = stdout().flush();
    failure.exit_code()
}
