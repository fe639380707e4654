//! Flags that say how lines look: widths, gaps, types of line.

use crate::failure::Failure;
use crate::input::read_settings_text;
use clap::Args;
use std::path::PathBuf;
use std::str::FromStr;
use umriss::drawing::{
    DrawingError, DrawingOptions, HiddenBy, LayerBy, Length, LineRule, Preset, Styles, Weight,
    WeightBy, read_styles,
};
use umriss::export::{SvgOptions, SvgProfile};
use umriss::view::OutlineOf;

/// Looks of lines.
#[derive(Args)]
#[command(next_help_heading = "Style")]
pub(crate) struct StyleFlags {
    /// A way to draw, which other flags change: technical, sketch, plotter, patent
    #[arg(long, value_name = "NAME", value_parser = parse::<Preset>)]
    pub(crate) preset: Option<Preset>,
    /// Rules for widths, colours, pens and types of line, and for objects
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) style: Option<PathBuf>,
    /// Interrupt lines where others pass in front of them; the gap measured across those.
    /// A JSON drawing has what it takes only if --halo was given when it was computed, 0 will do
    #[arg(long, value_name = "L", value_parser = parse::<Length>)]
    halo: Option<Length>,
    /// Widths from the nearest visible lines to the farthest, as in 0.7..0.18mm, in steps that
    /// have layers of their own
    #[arg(long, value_name = "RANGE", value_parser = parse::<Weight>)]
    weight: Option<Weight>,
    /// What widths follow: depth, or class (outlines, then folds and other lines, then mesh
    /// edges) [default: depth]
    #[arg(long, value_name = "BY", requires = "weight", value_parser = parse::<WeightBy>)]
    weight_by: Option<WeightBy>,
    /// Number of widths by depth [default: as few as keep widths within 0.05 mm]
    #[arg(long, value_name = "N", requires = "weight",
          value_parser = clap::value_parser!(u32).range(1..=64))]
    weight_steps: Option<u32>,
    /// Width of the outer outline: of visible lines where they part the picture from the empty
    /// background. A JSON drawing has what it takes only if --outline was given when it was
    /// computed, 0 will do
    #[arg(long, value_name = "L", value_parser = parse::<Length>)]
    outline: Option<Length>,
    /// Whose outline it is: that of the scene, or of all objects, in front of others too
    /// [default: scene]
    #[arg(long, value_name = "OF", value_parser = parse_outline_of)]
    pub(crate) outline_of: Option<OutlineOf>,
    /// Tell hidden lines apart, in layers and types of line, by how many are in front: sheets
    /// (surfaces), solids (two surfaces each), or together [default: together]
    #[arg(long, value_name = "BY", value_parser = parse::<HiddenBy>)]
    hidden_by: Option<HiddenBy>,
    /// Whom SVG is for: plot (styles on groups, nothing else) or web (classes and ids on them,
    /// and layers by part unless others are asked for) [default: plot]
    #[arg(long, value_name = "FOR", value_parser = parse_profile)]
    svg: Option<SvgProfile>,
}

impl StyleFlags {
    /// Where all other flags begin.
    pub(crate) fn base(&self) -> DrawingOptions {
        let base = self.preset.map_or_else(DrawingOptions::default, Preset::options);
        match self.svg {
            Some(SvgProfile::Web) => DrawingOptions { layer_by: LayerBy::Part, ..base },
            _ => base,
        }
    }

    /// The first flag that asks for what only lines on paper of their own have.
    pub(crate) fn of_lines_only(&self) -> Option<&'static str> {
        let flags = [
            ("--halo", self.halo.is_some()),
            ("--weight", self.weight.is_some()),
            ("--outline", self.outline.is_some()),
            ("--outline-of", self.outline_of.is_some()),
            ("--hidden-by", self.hidden_by.is_some()),
        ];
        flags.into_iter().find(|(_, given)| *given).map(|(flag, _)| flag)
    }

    /// How SVG is written.
    pub(crate) fn svg(&self, precision: u8) -> SvgOptions {
        SvgOptions { precision, command: None, profile: self.svg.unwrap_or_default() }
    }

    /// The options with these wishes in them.
    pub(crate) fn apply(&self, options: DrawingOptions) -> DrawingOptions {
        let weight = self.weight.map(|weight| Weight {
            by: self.weight_by.unwrap_or(weight.by),
            steps: self.weight_steps,
            ..weight
        });
        DrawingOptions {
            halo: self.halo.unwrap_or(options.halo),
            weight: weight.or(options.weight),
            outline: self.outline.unwrap_or(options.outline),
            hidden_by: self.hidden_by.unwrap_or(options.hidden_by),
            ..options
        }
    }

    /// Whether crossings are to be found: a halo of nothing finds them too.
    pub(crate) fn crossings_wanted(&self) -> bool {
        self.halo.is_some() || 0.0 < self.base().halo.millimetres()
    }

    /// Whose outline is to be found, if one is: a width of nothing and rules
    /// for it find it too.
    pub(crate) fn outline_wanted(&self, styles: &Styles) -> Option<OutlineOf> {
        let wanted = self.outline.is_some()
            || self.outline_of.is_some()
            || styles.outline != LineRule::default();
        wanted.then(|| self.outline_of.unwrap_or_default())
    }

    /// The rules.
    pub(crate) fn styles(&self) -> Result<Styles, Failure> {
        let Some(file) = &self.style else {
            return Ok(Styles::default());
        };
        let name = file.display();
        let text = read_settings_text(file)
            .map_err(|error| Failure::failed(format!("{name}: cannot be read: {error}")))?;
        read_styles(&text).map_err(|error| match error {
            DrawingError::Styles { line, message } => {
                Failure::failed(format!("{name}:{line}: {message}"))
            }
            other => Failure::failed(format!("{name}: {other}")),
        })
    }
}

fn parse<T: FromStr<Err = DrawingError>>(text: &str) -> Result<T, DrawingError> {
    text.parse()
}

fn parse_outline_of(name: &str) -> Result<OutlineOf, String> {
    OutlineOf::from_name(name).ok_or_else(|| "expected scene or objects".to_owned())
}

fn parse_profile(name: &str) -> Result<SvgProfile, String> {
    SvgProfile::from_name(name).ok_or_else(|| "expected plot or web".to_owned())
}
