//! Flags that say which plotter HPGL is written for.

use crate::failure::Failure;
use crate::input::read_settings_text;
use clap::Args;
use std::path::PathBuf;
use umriss::drawing::Drawing;
use umriss::export::{Device, ExportError, HpglOptions, devices, plotter_window, to_hpgl_with};

/// The plotter.
#[derive(Args)]
#[command(next_help_heading = "Plotter (HPGL)")]
pub(crate) struct PlotterFlags {
    /// The plotter: generic, hp7475a, hp7550a, hp7440a, dxy, or one of --devices
    /// [default: generic]
    #[arg(long, value_name = "NAME")]
    device: Option<String>,
    /// A table of more plotters, in the form of the file devices.toml of Umriss
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) devices: Option<PathBuf>,
    /// Speed to draw with, cm/s [default: the plotter's own]
    #[arg(long, value_name = "V", value_parser = crate::model_flags::parse_distance)]
    speed: Option<f64>,
    /// Write differences, which are shorter, instead of places
    #[arg(long)]
    relative: bool,
    /// Cut off what the plotter does not reach, instead of refusing it
    #[arg(long)]
    cut: bool,
}

/// A plotter and how to write for it.
pub(crate) struct Plotter {
    pub(crate) options: HpglOptions,
    cut: bool,
}

impl PlotterFlags {
    /// Finds the plotter.
    pub(crate) fn plotter(&self) -> Result<Plotter, Failure> {
        let known = match &self.devices {
            Some(file) => {
                let name = file.display();
                let text = read_settings_text(file)
                    .map_err(|error| Failure::failed(format!("{name}: cannot be read: {error}")))?;
                devices([text.as_str()]).map_err(|error| match error {
                    ExportError::DeviceTable { line, message } => {
                        Failure::failed(format!("{name}:{line}: {message}"))
                    }
                    other => Failure::failed(format!("{name}: {other}")),
                })?
            }
            None => devices([])?,
        };
        let options = HpglOptions {
            device: self.find(known)?,
            relative: self.relative,
            velocity: self.speed,
        };
        Ok(Plotter { options, cut: self.cut })
    }

    fn find(&self, known: Vec<Device>) -> Result<Device, Failure> {
        let Some(name) = &self.device else {
            return Ok(Device::generic());
        };
        let names: Vec<_> = known.iter().map(|device| device.id.clone()).collect();
        known.into_iter().find(|device| device.id.eq_ignore_ascii_case(name)).ok_or_else(|| {
            let names = names.join(", ");
            Failure::usage(format!("--device {name}: no such plotter, expected one of {names}"))
        })
    }
}

impl Plotter {
    /// The drawing as HPGL.
    pub(crate) fn hpgl(&self, drawing: &Drawing) -> Result<String, Failure> {
        if self.cut
            && let Some(window) = plotter_window(&self.options.device, drawing.size)
        {
            let mut drawing = drawing.clone();
            drawing.cut(&window);
            return Ok(to_hpgl_with(&drawing, &self.options)?);
        }
        to_hpgl_with(drawing, &self.options).map_err(|error| match error {
            ExportError::PlotterLimits(_) => {
                Failure::failed(format!("{error}: expected a wider --margin, or --cut"))
            }
            other => Failure::from(other),
        })
    }

    /// How fast it draws.
    pub(crate) fn speeds(&self) -> umriss::drawing::Speeds {
        let own = self.options.device.speeds;
        umriss::drawing::Speeds {
            down: self.options.velocity.map_or(own.down, |v| 10.0 * v),
            ..own
        }
    }
}
