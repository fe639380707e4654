//! Why a command stops, and with which exit code.

use std::process::ExitCode;
use umriss::drawing::DrawingError;
use umriss::export::ExportError;
use umriss::model::CameraError;
use umriss::model::import::ImportError;
use umriss::model::surface::SurfaceError;
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
    /// Whoever read standard output has had enough: no failure of ours.
    ReaderGone,
}

impl Failure {
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
            Failure::ReaderGone => None,
        }
    }

    /// 1 for failures, 2 for usage.
    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Failure::ReaderGone => ExitCode::SUCCESS,
            Failure::Failed(_) => ExitCode::from(1),
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
        Failure::Failed(error.to_string())
    }
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        Failure::Failed(error.to_string())
    }
}

impl From<Cancelled> for Failure {
    fn from(error: Cancelled) -> Self {
        Failure::Failed(error.to_string())
    }
}

impl From<RegionsError> for Failure {
    fn from(error: RegionsError) -> Self {
        Failure::Failed(error.to_string())
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

impl From<CameraError> for Failure {
    fn from(error: CameraError) -> Self {
        Failure::Usage(error.to_string())
    }
}

/// Only coordinates are the model's fault, all else was wished for.
impl From<DrawingError> for Failure {
    fn from(error: DrawingError) -> Self {
        match error {
            DrawingError::NotFinite => Failure::Failed(error.to_string()),
            _ => Failure::Usage(error.to_string()),
        }
    }
}
