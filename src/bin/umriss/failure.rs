//! Why a command stops, and with which exit code.

use std::process::ExitCode;
use umriss::drawing::DrawingError;
use umriss::export::ExportError;
use umriss::model::import::ImportError;
use umriss::model::surface::SurfaceError;
use umriss::model::{CameraError, MeshError, TopologyError};
use umriss::run::Cancelled;
use umriss::visibility::{HorizonError, PainterError, RegionsError};

/// The end of a command that did not do what it was asked to do.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The command line makes no sense.
    Usage(String),
    /// A command line that clap has words for.
    Clap(Box<clap::Error>),
    /// The command line makes sense, but the work failed.
    Failed(String),
    /// A signal stopped the program.
    Interrupted,
    /// Whoever read standard output has had enough: no failure of ours.
    ReaderGone,
}

/// The exit code of a program that a signal stopped: 128 and the number of
/// SIGINT, as shells have it.
pub(crate) const INTERRUPTED: u8 = 130;

impl Failure {
    /// What is said then.
    pub(crate) const INTERRUPTION: &str = "interrupted before the work was done";

    /// A command line that makes no sense.
    pub(crate) fn usage(message: impl Into<String>) -> Self {
        Failure::Usage(message.into())
    }

    /// Work that failed.
    pub(crate) fn failed(message: impl Into<String>) -> Self {
        Failure::Failed(message.into())
    }

    /// The line for standard error, without its end.
    pub(crate) fn message(&self) -> Option<String> {
        match self {
            Failure::Usage(message) | Failure::Failed(message) => {
                Some(format!("umriss: {message}"))
            }
            Failure::Clap(error) => Some(from_clap(error)),
            Failure::Interrupted => Some(format!("umriss: {}", Failure::INTERRUPTION)),
            Failure::ReaderGone => None,
        }
    }

    /// 1 for failures, 2 for usage, 130 for signals.
    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Failure::ReaderGone => ExitCode::SUCCESS,
            Failure::Failed(_) => ExitCode::from(1),
            Failure::Interrupted => ExitCode::from(INTERRUPTED),
            Failure::Usage(_) | Failure::Clap(_) => ExitCode::from(2),
        }
    }
}

/// The words of clap, opened like all other messages.
fn from_clap(error: &clap::Error) -> String {
    let text = error.render().to_string();
    let text = text.trim_end();
    match text.strip_prefix("error: ") {
        Some(message) => format!("umriss: {message}"),
        None => text.to_owned(),
    }
}

impl From<clap::Error> for Failure {
    fn from(error: clap::Error) -> Self {
        Failure::Clap(Box::new(error))
    }
}

impl From<ImportError> for Failure {
    fn from(error: ImportError) -> Self {
        match error {
            ImportError::Cancelled(error) => Failure::from(error),
            ImportError::Outside { .. } => Failure::failed(format!("{error}, or --allow-outside")),
            _ => Failure::Failed(error.to_string()),
        }
    }
}

impl From<MeshError> for Failure {
    fn from(error: MeshError) -> Self {
        match error {
            MeshError::Cancelled(error) => Failure::from(error),
            _ => Failure::Failed(error.to_string()),
        }
    }
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        Failure::Failed(error.to_string())
    }
}

/// A limit says which it was, what was being made, and what to do.
impl From<Cancelled> for Failure {
    fn from(error: Cancelled) -> Self {
        match error {
            Cancelled::Asked => Failure::Interrupted,
            Cancelled::TooManyCrossings { limit, stage } => Failure::Failed(format!(
                "{stage}: more than {limit} crossings, the limit of --max-crossings; expected a \
                 model of which less passes through or behind one another, or a higher limit"
            )),
            Cancelled::TooMuchMemory { limit, wanted, stage } => Failure::Failed(format!(
                "{stage}: {} MiB of memory wanted, the limit of --max-memory is {} MiB; expected a \
                 smaller model, or a higher limit",
                wanted.div_ceil(1 << 20),
                limit >> 20
            )),
        }
    }
}

impl From<RegionsError> for Failure {
    fn from(error: RegionsError) -> Self {
        match error {
            RegionsError::Cancelled(error) => Failure::from(error),
            _ => Failure::Failed(error.to_string()),
        }
    }
}

impl From<PainterError> for Failure {
    fn from(error: PainterError) -> Self {
        match error {
            PainterError::Cancelled(error) => Failure::from(error),
            _ => Failure::Failed(error.to_string()),
        }
    }
}

impl From<HorizonError> for Failure {
    fn from(error: HorizonError) -> Self {
        match error {
            HorizonError::Cancelled(error) => Failure::from(error),
            _ => Failure::Usage(error.to_string()),
        }
    }
}

/// Ranges and expressions are what was wished for.
impl From<SurfaceError> for Failure {
    fn from(error: SurfaceError) -> Self {
        Failure::Usage(error.to_string())
    }
}

impl From<TopologyError> for Failure {
    fn from(error: TopologyError) -> Self {
        match error {
            TopologyError::Camera(error) => Failure::from(error),
            TopologyError::Cancelled(error) => Failure::from(error),
        }
    }
}

impl From<CameraError> for Failure {
    fn from(error: CameraError) -> Self {
        Failure::Usage(error.to_string())
    }
}

/// Only coordinates are the model's fault, all else was wished for.
impl From<DrawingError> for Failure {
    fn from(error: DrawingError) -> Self {
        match error {
            DrawingError::Cancelled(error) => Failure::from(error),
            DrawingError::NotFinite => Failure::Failed(error.to_string()),
            _ => Failure::Usage(error.to_string()),
        }
    }
}
