//! ESRI ASCII grids ("ESRI ASCII raster format", ArcGIS documentation).
//!
//! A header of keys and values, then heights from north to south and from
//! west to east. x is the easting; z the northing with its sign changed, for
//! north is far. `xllcorner` is the corner of a cell and `xllcenter` its
//! middle, where the height is. `NODATA_value` marks missing heights; it is
//! -9999 unless the header says otherwise.

use super::super::error::{Fault, Read, quote};
use super::super::text::Text;
use super::ImportedHeights;
use crate::model::surface::Heights;

/// Keys of the header.
const KEYS: [&[u8]; 10] = [
    b"ncols",
    b"nrows",
    b"xllcorner",
    b"xllcenter",
    b"yllcorner",
    b"yllcenter",
    b"cellsize",
    b"dx",
    b"dy",
    b"nodata_value",
];

/// Whether a word is a key of the header.
pub(super) fn is_key(word: &[u8]) -> bool {
    KEYS.iter().any(|key| word.eq_ignore_ascii_case(key))
}

/// What the header says.
#[derive(Debug, Default)]
struct Header {
    values: [Option<f64>; KEYS.len()],
    counts: [Option<u64>; 2],
}

impl Header {
    fn value(&self, key: &str) -> Option<f64> {
        KEYS.iter().position(|name| *name == key.as_bytes()).and_then(|index| self.values[index])
    }

    /// A count, checked.
    fn count(&self, text: &Text<'_>, index: usize) -> Read<usize> {
        let name = String::from_utf8_lossy(KEYS[index]);
        let Some(count) = self.counts[index] else {
            return Err(text.fault(format!("the header ends here, expected {name}")));
        };
        match usize::try_from(count) {
            Ok(count) if count >= 2 => Ok(count),
            _ => Err(text.fault(format!("{name} is {count}, expected 2 at least"))),
        }
    }

    /// The distance of cells, checked.
    fn step(&self, text: &Text<'_>, key: &str) -> Read<f64> {
        match self.value(key).or(self.value("cellsize")) {
            Some(step) if step > 0.0 => Ok(step),
            Some(step) => Err(text.fault(format!("cells of {step}, expected more than 0"))),
            None => Err(text.fault("the header ends here, expected cellsize")),
        }
    }

    /// Where the middle of the first cell is along an axis.
    fn origin(&self, text: &Text<'_>, axis: char, step: f64) -> Read<f64> {
        let corner = self.value(&format!("{axis}llcorner")).map(|corner| corner + step / 2.0);
        corner.or(self.value(&format!("{axis}llcenter"))).ok_or_else(|| {
            text.fault(format!("the header ends here, expected {axis}llcorner or {axis}llcenter"))
        })
    }
}

/// Reads a grid.
pub(super) fn read(bytes: &[u8]) -> Read<ImportedHeights> {
    let mut text = Text::new(bytes);
    let header = header(&mut text)?;
    let (columns, rows) = (header.count(&text, 0)?, header.count(&text, 1)?);
    let (dx, dz) = (header.step(&text, "dx")?, header.step(&text, "dy")?);
    let (west, south) = (header.origin(&text, 'x', dx)?, header.origin(&text, 'y', dz)?);
    let nodata = header.value("nodata_value").unwrap_or(-9999.0);
    let Some(count) = columns.checked_mul(rows).filter(|count| *count <= bytes.len()) else {
        let message = format!("{columns} x {rows} heights, expected as many as the file can hold");
        return Err(text.fault(message));
    };
    let mut values = Vec::with_capacity(count);
    while values.len() < count {
        let Some(word) = text.word_across_lines() else {
            let found = values.len();
            return Err(text.fault(format!(
                "the file ends after {found} heights, expected {columns} x {rows}"
            )));
        };
        let height = text.number_in(word, "a height")?;
        values.push(if height == nodata { f64::NAN } else { height });
    }
    if let Some(word) = text.word_across_lines() {
        let message = format!("{} follows the last height, expected the end", quote(word));
        return Err(text.fault(message));
    }
    let xs = (0..columns).map(|i| west + i as f64 * dx).collect();
    let zs = (0..rows).map(|j| -(south + (rows - 1 - j) as f64 * dz)).collect();
    let heights = Heights::new(xs, zs, values).map_err(|error| Fault::file(error.to_string()))?;
    Ok(ImportedHeights { heights, warnings: Vec::new(), has_places: true })
}

/// The keys and their values, up to the first word that is a number.
fn header(text: &mut Text<'_>) -> Read<Header> {
    let mut header = Header::default();
    loop {
        let mut ahead = text.clone();
        let Some(word) = ahead.word_across_lines() else {
            return Err(ahead.fault("the file ends here, expected heights"));
        };
        let Some(index) = KEYS.iter().position(|key| word.eq_ignore_ascii_case(key)) else {
            if word.first().is_some_and(u8::is_ascii_alphabetic) && text.offset() == 0 {
                return Err(ahead.fault(format!("{} stands here, expected ncols", quote(word))));
            }
            if word.first().is_some_and(u8::is_ascii_alphabetic) {
                let message = format!("{} is no key of the header", quote(word));
                return Err(ahead.fault(format!("{message}, expected one of them or a height")));
            }
            return Ok(header);
        };
        *text = ahead;
        let name = String::from_utf8_lossy(KEYS[index]);
        if header.values[index].is_some() {
            return Err(text.fault(format!("{name} stands here again, expected it once")));
        }
        if index < 2 {
            let count = text.natural(&name)?;
            (header.counts[index], header.values[index]) = (Some(count), Some(count as f64));
        } else {
            header.values[index] = Some(text.number(&name)?);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn north_is_far_and_heights_lie_in_the_middle_of_cells() {
        let grid = b"NCOLS 3\nNROWS 2\nXLLCORNER 100\nYLLCENTER 7\nCELLSIZE 2\nNODATA_VALUE -1\n\
            1 2 3\n4 -1\n6\n";
        let heights = read(grid).unwrap().heights;
        assert_eq!(heights.xs(), [101.0, 103.0, 105.0]);
        assert_eq!(heights.zs(), [-9.0, -7.0]);
        assert_eq!(heights.values()[..4], [1.0, 2.0, 3.0, 4.0]);
        assert!(heights.values()[4].is_nan());
        assert_eq!(heights.missing(), 1);
    }
}
