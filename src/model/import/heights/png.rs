//! Grey images as heights (PNG, third edition, W3C 2025): a pixel's value,
//! from 0 to 65535 in images of 16 bits, is the height at its place.

use super::super::error::{Fault, Read};
use super::on_columns_and_rows;
use crate::model::surface::Heights;
use crate::run::Run;
use png::{BitDepth, ColorType, Decoder, DecodingError, Transformations};
use std::io::Cursor;

/// How every PNG image begins.
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// More pixels than this are not believed.
const MOST: usize = 1 << 28;

/// Reads an image.
pub(super) fn read(bytes: &[u8], run: &Run<'_>) -> Read<Heights> {
    if !bytes.starts_with(SIGNATURE) {
        return Err(Fault::file("the file does not begin like an image, expected PNG"));
    }
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(damage)?;
    let (color, depth) = reader.output_color_type();
    if color != ColorType::Grayscale || !matches!(depth, BitDepth::Eight | BitDepth::Sixteen) {
        let found = name_of(color);
        let bits = depth as u8;
        return Err(Fault::file(format!(
            "an image of {bits}-bit {found}, expected grey of 16 bits, or of 8"
        )));
    }
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
    let values = match depth {
        BitDepth::Sixteen => samples
            .chunks_exact(2)
            .map(|pair| f64::from(u16::from_be_bytes([pair[0], pair[1]])))
            .collect(),
        _ => samples.into_iter().map(f64::from).collect(),
    };
    on_columns_and_rows(width, values)
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

fn name_of(color: ColorType) -> &'static str {
    match color {
        ColorType::Grayscale => "grey",
        ColorType::GrayscaleAlpha => "grey with transparency",
        ColorType::Indexed => "palette",
        ColorType::Rgb => "colour",
        ColorType::Rgba => "colour with transparency",
    }
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

    fn read(bytes: &[u8]) -> Read<Heights> {
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

    #[test]
    fn sixteen_bits_are_read_exactly() {
        let data = [0, 0, 0, 1, 1, 0, 255, 255];
        let heights = read(&image(2, 2, ColorType::Grayscale, BitDepth::Sixteen, &data)).unwrap();
        assert_eq!(heights.values(), [0.0, 1.0, 256.0, 65535.0]);
        assert_eq!((heights.xs(), heights.zs()), (&[0.0, 1.0][..], &[0.0, 1.0][..]));
        let heights = read(&image(2, 2, ColorType::Grayscale, BitDepth::Eight, &data[..4]));
        assert_eq!(heights.unwrap().values(), [0.0, 0.0, 0.0, 1.0]);
    }

    #[test]
    fn what_is_no_height_map_is_refused() {
        let color = image(2, 2, ColorType::Rgb, BitDepth::Eight, &[7; 12]);
        assert_eq!(
            refusal(&color),
            "map.png: an image of 8-bit colour, expected grey of 16 bits, or of 8"
        );
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
