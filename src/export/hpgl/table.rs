//! The table of plotters, a file that users can add to.

use super::{Device, DevicePaper};
use crate::drawing::Speeds;
use crate::export::ExportError;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The plotters that are known without a file.
const BUILT_IN: &str = include_str!("devices.toml");

/// The largest plotter unit of any device: 24 bits with sign.
const LARGEST: i32 = 8_388_607;

/// All plotters: the generic one, those that are built in, and those of
/// `files`, which take the place of earlier ones of the same name.
///
/// # Errors
///
/// If a file is no table of plotters: says where, and what is wrong.
pub fn devices<'a>(files: impl IntoIterator<Item = &'a str>) -> Result<Vec<Device>, ExportError> {
    let mut all = vec![Device::generic()];
    for file in [BUILT_IN].into_iter().chain(files) {
        for device in read(file)? {
            all.retain(|known| known.id != device.id);
            all.push(device);
        }
    }
    Ok(all)
}

/// The plotters of one file.
fn read(text: &str) -> Result<Vec<Device>, ExportError> {
    let table: BTreeMap<String, DeviceText> =
        toml::from_str(text).map_err(|error| broken(text, &error))?;
    table.into_iter().map(|(id, device)| device.check(id)).collect()
}

fn broken(text: &str, error: &toml::de::Error) -> ExportError {
    let at = error.span().map_or(0, |span| span.start).min(text.len());
    let before = text.get(..at).unwrap_or_default();
    let line = before.matches('\n').count() + 1;
    ExportError::DeviceTable { line, message: error.message().to_owned() }
}

/// A plotter as it stands in the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DeviceText {
    name: String,
    unit: f64,
    pens: u32,
    velocity: [f64; 2],
    down: f64,
    up: f64,
    lift: f64,
    change: f64,
    paper: Vec<PaperText>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PaperText {
    name: String,
    size: [f64; 2],
    x: [i32; 2],
    y: [i32; 2],
    origin: [f64; 2],
    #[serde(default)]
    turned: bool,
    select: Option<u8>,
}

impl DeviceText {
    fn check(self, id: String) -> Result<Device, ExportError> {
        let refuse = |message| Err(ExportError::Device { id: id.clone(), message });
        let above_zero = |number: f64| number.is_finite() && 0.0 < number;
        let DeviceText { unit, velocity, down, up, lift, change, .. } = self;
        if !(above_zero(unit) && (1..=64).contains(&self.pens)) {
            return refuse("expected a unit above 0 and 1 to 64 pens");
        }
        let speeds = [velocity[0], velocity[1], down, up];
        if !speeds.iter().all(|speed| above_zero(*speed)) || velocity[1] < velocity[0] {
            return refuse("expected speeds above 0, the slowest first");
        }
        if ![lift, change].iter().all(|time| time.is_finite() && 0.0 <= *time) {
            return refuse("expected times of 0 or more");
        }
        for PaperText { size, x, y, origin, .. } in &self.paper {
            let mut limits = [x, y].into_iter();
            let limits =
                limits.all(|[low, high]| low < high && -LARGEST <= *low && *high <= LARGEST);
            let sides = size.iter().all(|side| above_zero(*side));
            let places = origin.iter().all(|place| place.is_finite());
            if !(limits && sides && places) {
                return refuse("expected sheets with sizes above 0 and limits from low to high");
            }
        }
        if self.paper.is_empty() {
            return refuse("expected at least one sheet");
        }
        // Centimetres in the file, as the instruction VS has them.
        let speeds = Speeds { down: 10.0 * down, up: 10.0 * up, lift, change };
        let papers = self.paper.into_iter().map(PaperText::paper).collect();
        let DeviceText { name, pens, .. } = self;
        Ok(Device { id, name, unit, pens, velocity: Some(velocity), speeds, papers })
    }
}

impl PaperText {
    fn paper(self) -> DevicePaper {
        let PaperText { name, size, x, y, origin, turned, select } = self;
        DevicePaper { name, size, x, y, origin, turned, select }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn the_built_in_plotters_are_read() {
        let all = devices([]).unwrap();
        let ids: Vec<_> = all.iter().map(|device| device.id.as_str()).collect();
        assert_eq!(ids, ["generic", "dxy", "hp7440a", "hp7475a", "hp7550a"]);
        assert_eq!(all[3].papers[0].x, [0, 11040]);
    }

    #[test]
    fn a_file_adds_plotters_and_changes_known_ones() {
        let own = BUILT_IN.replace("[dxy]", "[mine]").replace("pens = 6", "pens = 3");
        let all = devices([own.as_str()]).unwrap();
        assert_eq!(all.len(), 6);
        assert_eq!(all.iter().find(|device| device.id == "hp7475a").unwrap().pens, 3);
    }

    #[test]
    fn mistakes_are_told_with_their_place() {
        let message = |from: &str, to: &str| {
            let text = BUILT_IN.replacen(from, to, 1);
            assert_ne!(text, BUILT_IN);
            devices([text.as_str()]).unwrap_err().to_string()
        };
        assert!(message("pens = 6", "pens = six").starts_with("line 2"), "line of pens");
        assert!(message("pens = 6", "pns = 6").contains("pns"));
        assert!(message("unit = 0.02488", "unit = 0").contains("hp7475a"));
        assert!(message("x = [0, 11040]", "x = [11040, 0]").contains("limits"));
        assert!(message("velocity = [0.38, 38.1]", "velocity = [38.1, 0.38]").contains("speeds"));
    }
}
