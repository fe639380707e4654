//! Flags that say what strokes are made of.

use clap::Args;
use std::str::FromStr;
use umriss::drawing::{DrawingError, DrawingOptions, Join, Length};

/// Joining, simplifying, fitting.
#[derive(Args)]
#[command(next_help_heading = "Strokes")]
pub(crate) struct StrokeFlags {
    /// Draw lines that run within this distance of one another once; 0 draws all of them
    /// [default: 0.02 mm or a tenth of the pen, whichever is more]
    #[arg(long, value_name = "L", value_parser = parse::<Length>)]
    merge: Option<Length>,
    /// What may be joined to one stroke: all lines of a layer, or those of one class
    /// [default: all]
    #[arg(long, value_name = "WHAT", value_parser = parse::<Join>)]
    join: Option<Join>,
    /// Leave out points, staying within this distance of what was found, both ways
    #[arg(long, value_name = "L", conflicts_with = "fit", value_parser = parse::<Length>)]
    simplify: Option<Length>,
    /// Fit curves within this distance, both ways; junctions and corners stay where they are
    #[arg(long, value_name = "L", value_parser = parse::<Length>)]
    fit: Option<Length>,
    /// Leave out strokes shorter than this
    #[arg(long, value_name = "L", value_parser = parse::<Length>)]
    min_length: Option<Length>,
}

impl StrokeFlags {
    /// Whether any flag was given.
    pub(crate) fn any(&self) -> bool {
        self.merge.is_some()
            || self.join.is_some()
            || self.simplify.is_some()
            || self.fit.is_some()
            || self.min_length.is_some()
    }

    /// The options with these wishes in them.
    pub(crate) fn apply(&self, options: DrawingOptions) -> DrawingOptions {
        DrawingOptions {
            merge: self.merge.or(options.merge),
            join: self.join.unwrap_or(options.join),
            simplify: self.simplify.unwrap_or(options.simplify),
            fit: self.fit.unwrap_or(options.fit),
            min_length: self.min_length.unwrap_or(options.min_length),
            ..options
        }
    }
}

fn parse<T: FromStr<Err = DrawingError>>(text: &str) -> Result<T, DrawingError> {
    text.parse()
}
