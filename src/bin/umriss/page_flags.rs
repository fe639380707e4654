//! Flags that say what the page looks like.

use clap::Args;
use std::str::FromStr;
use umriss::drawing::{
    DrawingError, DrawingOptions, Hidden, LayerBy, Length, Paper, Scale, Window,
};
use umriss::model::Unit;

/// The page and its lines.
#[derive(Args)]
#[command(next_help_heading = "Page")]
pub(crate) struct PageFlags {
    /// Hidden lines: none, dashed or solid. A JSON drawing has hidden lines only if they were
    /// asked for when it was computed [default: none]
    #[arg(long, value_name = "HOW", value_parser = parse::<Hidden>)]
    hidden: Option<Hidden>,
    /// a6 to a0, letter, legal, executive, tabloid, a size as in 200x100mm, or tight
    /// [default: a4]
    #[arg(long, value_name = "PAPER", value_parser = parse::<Paper>)]
    paper: Option<Paper>,
    /// Lay the longer side of the paper
    #[arg(long)]
    landscape: bool,
    /// Border to keep free, in mm, cm or in [default: 10mm]
    #[arg(long, value_name = "L", value_parser = parse::<Length>)]
    margin: Option<Length>,
    /// fit, a ratio as in 1:2, or a factor as in 0.5 [default: fit]
    #[arg(long, value_name = "S", value_parser = parse::<Scale>)]
    scale: Option<Scale>,
    /// Draw only what lies between two corners of the view frame, in the models' unit (of a
    /// perspective view: tangents), and fit that; lines are cut at its border
    #[arg(long, value_name = "U0,V0,U1,V1", allow_hyphen_values = true,
          value_parser = parse::<Window>)]
    frame: Option<Window>,
    /// What has a layer of its own: visibility, class, object or part (class within object)
    /// [default: visibility]
    #[arg(long, value_name = "BY", value_parser = parse::<LayerBy>)]
    layer_by: Option<LayerBy>,
    /// Decimals of a millimetre in SVG
    #[arg(long, value_name = "N", default_value_t = 3,
          value_parser = clap::value_parser!(u8).range(0..=9))]
    pub(crate) precision: u8,
}

impl PageFlags {
    /// `default` with these wishes in it.
    pub(crate) fn options(&self, default: DrawingOptions, unit: Unit) -> DrawingOptions {
        DrawingOptions {
            paper: self.paper.unwrap_or(default.paper),
            landscape: self.landscape || default.landscape,
            margin: self.margin.unwrap_or(default.margin),
            scale: self.scale.unwrap_or(default.scale),
            unit,
            window: self.frame.or(default.window),
            layer_by: self.layer_by.unwrap_or(default.layer_by),
            hidden: self.hidden.unwrap_or(default.hidden),
            ..default
        }
    }
}

fn parse<T: FromStr<Err = DrawingError>>(text: &str) -> Result<T, DrawingError> {
    text.parse()
}
