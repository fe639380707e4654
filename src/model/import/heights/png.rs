//! Images as heights (PNG, third edition, W3C 2025).
//!
//! A grey pixel's value, from 0 to 65535 in images of 16 bits, is the height
//! at its place. Of a coloured pixel it is the luminance of ITU-R BT.709,
//! whose primaries are those of PNG: 0.2126 of red, 0.7152 of green, 0.0722
//! of blue. It is taken of the values as they are stored, without their
//! gamma, so a grey image that is stored as colours has the same heights. A
//! palette's colours are of 8 bits. A fully transparent pixel is a missing
//! height; other transparency does not matter.

use super::super::error::{Fault, Read};
use super::{ImportedHeights, on_columns_and_rows};
use crate::run::Run;
use png::{BitDepth, ColorType, Decoder, DecodingError, Transformations};
use std::io::Cursor;

/// How every PNG image begins.
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// More pixels than this are not believed.
const MOST: usize = 1 << 28;

/// Reads an image.
pub(super) fn read(bytes: &[u8], run: &Run<'_>) -> Read<ImportedHeights> {
    if !bytes.starts_with(SIGNATURE) {
        return Err(Fault::file("the file does not begin like an image, expected PNG"));
    }
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::IDENTITY);
    let header = decoder.read_header_info().map_err(damage)?;
    let stored = header.color_type;
    let whole_bytes = matches!(header.bit_depth, BitDepth::Eight | BitDepth::Sixteen);
    let plain = stored == ColorType::Grayscale && whole_bytes;
    if !plain {
        // Palettes become colours, and fewer bits than eight are spread over
        // eight.
        decoder.set_transformations(Transformations::EXPAND);
    }
    let mut reader = decoder.read_info().map_err(damage)?;
    let (color, depth) = reader.output_color_type();
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    let Some(size) = reader
        .output_buffer_size()
        .filter(|_| width.checked_mul(height).is_some_and(|pixels| pixels <= MOST))
    else {
        let message = format!("an image of {width} x {height} pixels, expected {MOST} at most");
        return Err(Fault::file(message));
    };
    // The header says how much it will be, before a pixel is unpacked: the
    // samples, the heights and the list that these are kept in.
    let wanted = (size + 16 * width * height) as u64;
    if run.take(wanted).is_err() {
        return Err(Fault::file("the image takes too much memory, expected a smaller one"));
    }
    let mut samples = vec![0; size];
    reader.next_frame(&mut samples).map_err(damage)?;
    run.give_back(wanted);
    let values = heights(&samples, color, depth == BitDepth::Sixteen);
    let heights = on_columns_and_rows(width, values)?;
    let mut warnings = Vec::new();
    if matches!(color, ColorType::Rgb | ColorType::Rgba) {
        warnings.push(format!(
            "heights are the luminance of {}: 0.2126 red + 0.7152 green + 0.0722 blue",
            if stored == ColorType::Indexed { "a palette" } else { "colours" },
        ));
    }
    if heights.missing() > 0 {
        warnings.push(format!("heights of {} transparent pixels are missing", heights.missing()));
    }
    Ok(ImportedHeights { heights, warnings, has_places: false })
}

/// The heights of pixels, whose channels are of one byte or of two.
fn heights(samples: &[u8], color: ColorType, is_wide: bool) -> Vec<f64> {
    let channels = color.samples();
    let sample = |pixel: &[u8], channel: usize| match is_wide {
        true => f64::from(u16::from_be_bytes([pixel[2 * channel], pixel[2 * channel + 1]])),
        false => f64::from(pixel[channel]),
    };
    let has_alpha = matches!(color, ColorType::GrayscaleAlpha | ColorType::Rgba);
    let height = |pixel: &[u8]| match channels {
        _ if has_alpha && sample(pixel, channels - 1) == 0.0 => f64::NAN,
        1 | 2 => sample(pixel, 0),
        // Whole numbers, so that equal channels give their value.
        _ => {
            let [red, green, blue] = [0, 1, 2].map(|channel| sample(pixel, channel));
            (2126.0 * red + 7152.0 * green + 722.0 * blue) / 10000.0
        }
    };
    samples.chunks_exact(channels * if is_wide { 2 } else { 1 }).map(height).collect()
}

/// What is wrong with an image, in words that do not change with the decoder.
fn damage(error: DecodingError) -> Fault {
    let what = match error {
        DecodingError::IoError(_) => "the image ends early",
        DecodingError::LimitsExceeded => "the image takes too much memory",
        DecodingError::Format(_) | DecodingError::Parameter(_) => "the image is damaged",
    };
    Fault::file(format!("{what}, expected a sound PNG image"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image with these samples.
    fn image(width: u32, height: u32, color: ColorType, depth: BitDepth, data: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(color);
        encoder.set_depth(depth);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(data).unwrap();
        writer.finish().unwrap();
        bytes
    }

    fn read(bytes: &[u8]) -> Read<ImportedHeights> {
        super::read(bytes, &Run::default())
    }

    #[test]
    fn the_header_is_asked_how_much_it_will_be() {
        use crate::model::import::{ImportError, read_heights_bytes_within};
        use crate::run::{Cancelled, Limits};
        let image = image(1000, 1000, ColorType::Grayscale, BitDepth::Sixteen, &[0; 2_000_000]);
        assert!(image.len() < 10_000, "{} bytes", image.len());
        let read = |memory| {
            let run = Run::default().with_limits(Limits { crossings: None, memory: Some(memory) });
            read_heights_bytes_within("map.png", &image, None, &run).map(drop)
        };
        let stopped = read(17_999_999).unwrap_err();
        let ImportError::Cancelled(Cancelled::TooMuchMemory { wanted, .. }) = stopped else {
            panic!("{stopped}")
        };
        assert_eq!(wanted, 18_000_000);
        assert!(read(18_000_000).is_ok());
    }

    fn refusal(bytes: &[u8]) -> String {
        super::super::read_heights_bytes("map.png", bytes, None).unwrap_err().to_string()
    }

    fn values(bytes: &[u8]) -> (Vec<f64>, Vec<String>) {
        let found = read(bytes).unwrap();
        (found.heights.values().to_vec(), found.warnings)
    }

    #[test]
    fn sixteen_bits_are_read_exactly() {
        let data = [0, 0, 0, 1, 1, 0, 255, 255];
        let found = read(&image(2, 2, ColorType::Grayscale, BitDepth::Sixteen, &data)).unwrap();
        assert_eq!(found.heights.values(), [0.0, 1.0, 256.0, 65535.0]);
        assert_eq!(found.heights.xs(), [0.0, 1.0]);
        assert!(found.warnings.is_empty() && !found.has_places);
        let eight = image(2, 2, ColorType::Grayscale, BitDepth::Eight, &data[..4]);
        assert_eq!(values(&eight), (vec![0.0, 0.0, 0.0, 1.0], vec![]));
    }

    #[test]
    fn colours_count_by_their_luminance() {
        let told = |what| {
            format!("heights are the luminance of {what}: 0.2126 red + 0.7152 green + 0.0722 blue")
        };
        let data = [255, 0, 0, 0, 255, 0, 0, 0, 255, 77, 77, 77];
        let (found, warnings) = values(&image(2, 2, ColorType::Rgb, BitDepth::Eight, &data));
        assert_eq!(found, [54.213, 182.376, 18.411, 77.0]);
        assert_eq!(warnings, [told("colours")]);
        // Every grey of 16 bits is its own luminance.
        let greys: Vec<u8> = (0..=u16::MAX).flat_map(|v| [v.to_be_bytes(); 3].concat()).collect();
        let (found, _) = values(&image(256, 256, ColorType::Rgb, BitDepth::Sixteen, &greys));
        assert!(found.iter().enumerate().all(|(i, value)| *value == i as f64));
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
        encoder.set_color(ColorType::Indexed);
        encoder.set_depth(BitDepth::One);
        encoder.set_palette(vec![9, 9, 9, 0, 100, 0]);
        encoder.set_trns(vec![0]);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&[0b0100_0000, 0b1100_0000]).unwrap();
        writer.finish().unwrap();
        let (found, warnings) = values(&bytes);
        assert!(found[0].is_nan());
        assert_eq!(found[1..], [71.52, 71.52, 71.52]);
        assert_eq!(
            warnings,
            [told("a palette"), "heights of 1 transparent pixels are missing".to_owned()]
        );
    }

    #[test]
    fn few_bits_and_transparency() {
        let bits = image(2, 2, ColorType::Grayscale, BitDepth::One, &[0b0100_0000, 0b1000_0000]);
        assert_eq!(values(&bits).0, [0.0, 255.0, 255.0, 0.0]);
        let data = [5, 255, 6, 1, 7, 0, 8, 128];
        let (found, _) = values(&image(2, 2, ColorType::GrayscaleAlpha, BitDepth::Eight, &data));
        assert_eq!(found[..2], [5.0, 6.0]);
        assert!(found[2].is_nan() && found[3] == 8.0);
    }

    #[test]
    fn what_is_no_height_map_is_refused() {
        let line = image(4, 1, ColorType::Grayscale, BitDepth::Eight, &[7; 4]);
        assert_eq!(
            refusal(&line),
            "map.png: the grid has 4 columns and 1 rows: expected at least 2 of each"
        );
        let whole = image(4, 4, ColorType::Grayscale, BitDepth::Sixteen, &[7; 32]);
        for length in 8..whole.len() - 12 {
            assert!(refusal(&whole[..length]).ends_with("expected a sound PNG image"), "{length}");
        }
    }
}
