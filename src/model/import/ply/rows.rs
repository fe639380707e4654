//! The rows of a PLY file, value by value, in any encoding.

use super::super::error::{Fault, Read, quote};
use super::super::text::Text;
use super::super::text_row::Row;
use super::header::{Element, Encoding, Kind};
use super::strips::RESTART;

/// A position among the rows.
pub(super) struct Rows<'a> {
    encoding: Encoding,
    /// The cursor of the text encoding, and the row at hand there.
    text: Text<'a>,
    row: Row,
    /// The first line with words behind the declared values.
    surplus: Option<String>,
    /// The whole file, and the cursor of the binary encodings.
    bytes: &'a [u8],
    at: usize,
    /// Where the value last read begins.
    value_start: usize,
    /// The row at hand, for messages.
    name: &'a [u8],
    number: u64,
    row_count: u64,
}

impl<'a> Rows<'a> {
    /// Starts at the first row; `payload` stands behind the header of `bytes`.
    pub(super) fn new(encoding: Encoding, payload: Text<'a>, bytes: &'a [u8]) -> Self {
        let at = payload.offset();
        Rows {
            encoding,
            text: payload,
            row: Row::default(),
            surplus: None,
            bytes,
            at,
            value_start: at,
            name: b"",
            number: 0,
            row_count: 0,
        }
    }

    /// Begins the next row: in text, the next line that is not empty.
    pub(super) fn begin(&mut self, element: &Element<'a>, number: u64) -> Read<()> {
        (self.name, self.number, self.row_count) = (element.name, number, element.count);
        if self.encoding == Encoding::Text && !self.text.has_word() && !self.text.next_full_line() {
            return Err(self.text.fault(self.ending()));
        }
        Ok(())
    }

    /// The line of the row at hand, in text.
    pub(super) fn line(&self) -> Option<u64> {
        (self.encoding == Encoding::Text).then(|| self.text.line())
    }

    /// Ends the row: in text, its line.
    pub(super) fn end(&mut self) -> Read<()> {
        if self.encoding != Encoding::Text {
            return Ok(());
        }
        self.row.end(&self.text)?;
        if let Some(word) = self.text.word()
            && self.surplus.is_none()
        {
            let (name, word, line) = (quote(self.name), quote(word), self.text.line());
            self.surplus = Some(format!(
                "values after those declared for {name} are ignored ({word} in line {line})"
            ));
        }
        self.text.next_line();
        Ok(())
    }

    /// Whether more stands in the line than was declared.
    pub(super) fn has_more(&self) -> bool {
        self.encoding == Encoding::Text && self.text.has_word()
    }

    /// A problem of the row at hand, which is in text.
    pub(super) fn fault_of_row(&self, message: String) -> Fault {
        self.text.fault(message)
    }

    /// What was passed over; nothing but white space should follow the last row.
    pub(super) fn finish(mut self) -> Vec<String> {
        let mut warnings: Vec<String> = self.surplus.take().into_iter().collect();
        if self.encoding == Encoding::Text {
            if self.text.has_word() || self.text.next_full_line() {
                let line = self.text.line();
                warnings.push(format!("what follows the last element is ignored (line {line})"));
            }
        } else if !self.bytes[self.at..].trim_ascii().is_empty() {
            let surplus = self.bytes.len() - self.at;
            warnings.push(format!("{surplus} bytes after the last element are ignored"));
        }
        warnings
    }

    /// Any number.
    pub(super) fn value(&mut self, kind: Kind) -> Read<f64> {
        match self.encoding {
            // The decimals as they stand, whatever type they are meant for.
            Encoding::Text => self.row.number(&mut self.text, "a number"),
            Encoding::LittleEndian => self.binary_value(kind, false),
            Encoding::BigEndian => self.binary_value(kind, true),
        }
    }

    /// Passes over a number; in text, over any word.
    pub(super) fn skip(&mut self, kind: Kind) -> Read<f64> {
        if self.encoding != Encoding::Text {
            return self.value(kind);
        }
        self.row.word(&mut self.text, "another property").map(|_| 0.0)
    }

    /// A coordinate.
    pub(super) fn finite(&mut self, kind: Kind) -> Read<f64> {
        let value = self.value(kind)?;
        if !value.is_finite() {
            return Err(self.fault("a coordinate is not finite, expected a finite number".into()));
        }
        Ok(value)
    }

    /// The length of a list.
    pub(super) fn count(&mut self, kind: Kind) -> Read<u64> {
        let value = self.value(kind)?;
        if value < 0.0 || value.fract() != 0.0 {
            return Err(self.fault(format!("a list of {value} items, expected a natural number")));
        }
        Ok(value as u64)
    }

    /// The number of a vertex.
    #[inline]
    pub(super) fn vertex(&mut self, kind: Kind, count: u64) -> Read<u32> {
        let value = self.value(kind)?;
        self.vertex_of(value, count)
    }

    fn vertex_of(&mut self, value: f64, count: u64) -> Read<u32> {
        if value.fract() != 0.0 || !(0.0..count as f64).contains(&value) {
            let message = format!("vertex {value} does not exist, expected less than {count}");
            return Err(self.fault(message));
        }
        Ok(value as u32)
    }

    /// The number of a vertex of a strip, or what begins another strip.
    pub(super) fn vertex_of_strip(&mut self, kind: Kind, count: u64) -> Read<u32> {
        let value = self.value(kind)?;
        // All bits set, in types with a sign and without.
        let is_restart = value == -1.0 || kind == Kind::U32 && value == f64::from(u32::MAX);
        if is_restart { Ok(RESTART) } else { self.vertex_of(value, count) }
    }

    fn binary_value(&mut self, kind: Kind, big: bool) -> Read<f64> {
        Ok(match kind {
            Kind::I8 => f64::from(i8::from_le_bytes(self.take(big)?)),
            Kind::U8 => f64::from(u8::from_le_bytes(self.take(big)?)),
            Kind::I16 => f64::from(i16::from_le_bytes(self.take(big)?)),
            Kind::U16 => f64::from(u16::from_le_bytes(self.take(big)?)),
            Kind::I32 => f64::from(i32::from_le_bytes(self.take(big)?)),
            Kind::U32 => f64::from(u32::from_le_bytes(self.take(big)?)),
            Kind::F32 => f64::from(f32::from_le_bytes(self.take(big)?)),
            Kind::F64 => f64::from_le_bytes(self.take(big)?),
        })
    }

    /// The next bytes, the least significant first.
    fn take<const N: usize>(&mut self, big: bool) -> Read<[u8; N]> {
        let Some(&found) = self.bytes[self.at..].first_chunk::<N>() else {
            return Err(Fault::byte(self.bytes.len(), self.ending()));
        };
        let mut found = found;
        if big {
            found.reverse();
        }
        self.value_start = self.at;
        self.at += N;
        Ok(found)
    }

    fn fault(&mut self, message: String) -> Fault {
        match self.encoding {
            Encoding::Text => self.row.blame(self.text.fault(message)),
            _ => Fault::byte(self.value_start, message),
        }
    }

    fn ending(&self) -> String {
        let (name, number, count) = (quote(self.name), self.number, self.row_count);
        format!("the file ends after {number} elements {name}, expected {count}")
    }
}
