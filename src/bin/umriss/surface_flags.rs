//! Flags that say what is drawn of surfaces.

use clap::Args;
use glam::DVec3;
use std::str::FromStr;
use umriss::drawing::{DrawingError, Fill, Hatch, HatchAnchor, HatchTone, Length, SurfaceOptions};

/// Fills and hatches.
#[derive(Args)]
#[command(next_help_heading = "Surfaces")]
pub(crate) struct SurfaceFlags {
    /// Fill what is seen of each face: none, flat (in its colour), shade (as bright as the light
    /// makes it) [default: none]
    #[arg(long, value_name = "HOW", value_parser = parse::<Fill>)]
    fill: Option<Fill>,
    /// Hatch what is seen of each face, in a layer of its own: shade (the darker, the denser,
    /// and crossed) or flat (all alike)
    #[arg(long, value_name = "HOW", value_parser = parse::<HatchTone>)]
    hatch: Option<HatchTone>,
    /// From line to line where a hatch is densest [default: 1mm]
    #[arg(long, value_name = "L", requires = "hatch", value_parser = parse::<Length>)]
    hatch_spacing: Option<Length>,
    /// Which way hatch lines rise, degrees counterclockwise [default: 45]
    #[arg(long, value_name = "DEG", requires = "hatch", allow_hyphen_values = true,
          value_parser = parse_angle)]
    hatch_angle: Option<f64>,
    /// What a hatch stays with: page or object [default: page]
    #[arg(long, value_name = "WHAT", requires = "hatch", value_parser = parse::<HatchAnchor>)]
    hatch_anchor: Option<HatchAnchor>,
    /// The direction towards the light [default: over the viewer's left shoulder]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = parse_light)]
    light: Option<DVec3>,
}

impl SurfaceFlags {
    /// Whether surfaces are hatched.
    pub(crate) fn hatches(&self) -> bool {
        self.hatch.is_some()
    }

    /// Whether anything is drawn of surfaces.
    pub(crate) fn any(&self) -> bool {
        self.hatch.is_some() || !matches!(self.fill, None | Some(Fill::None))
    }

    /// What the library is asked for.
    pub(crate) fn options(&self) -> SurfaceOptions {
        let usual = Hatch::default();
        let hatch = self.hatch.map(|tone| Hatch {
            tone,
            spacing: self.hatch_spacing.unwrap_or(usual.spacing),
            degrees: self.hatch_angle.unwrap_or(usual.degrees),
            anchor: self.hatch_anchor.unwrap_or(usual.anchor),
        });
        SurfaceOptions { fill: self.fill.unwrap_or_default(), hatch, light: self.light }
    }
}

fn parse<T: FromStr<Err = DrawingError>>(text: &str) -> Result<T, DrawingError> {
    text.parse()
}

fn parse_angle(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|angle: &f64| angle.is_finite());
    number.ok_or_else(|| "expected degrees".to_owned())
}

fn parse_light(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if DVec3::new(x, y, z).is_finite() && DVec3::new(x, y, z) != DVec3::ZERO => {
            Ok(DVec3::new(x, y, z))
        }
        _ => Err("expected a direction X,Y,Z".to_owned()),
    }
}
