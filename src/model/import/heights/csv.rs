//! Tables of heights (RFC 4180, as far as numbers go): a row to a line,
//! separated by semicolons, tabs, commas or white space, whichever of these
//! the first row has.
//!
//! A field that is empty or says `nan` or `na` is a missing height. What
//! follows `#` is a comment. Numbers have a decimal point; no field is quoted.

use super::super::error::{Fault, Read, quote};
use super::super::text::Text;
use super::on_columns_and_rows;
use crate::model::surface::Heights;

/// Reads a table.
pub(super) fn read(bytes: &[u8]) -> Read<Heights> {
    let mut text = Text::new(bytes);
    let mut values = Vec::new();
    let mut first: Option<(Separator, usize, u64)> = None;
    loop {
        let line = text.rest_of_line();
        let line = line.split(|&byte| byte == b'#').next().unwrap_or_default().trim_ascii();
        if !line.is_empty() {
            let separator = first.map_or_else(|| Separator::of(line), |(separator, ..)| separator);
            let before = values.len();
            separator.fields(line, |field| {
                values.push(height(&text, field)?);
                Ok(())
            })?;
            let found = values.len() - before;
            match first {
                None => first = Some((separator, found, text.line())),
                Some((_, expected, line)) if expected != found => {
                    return Err(text.fault(format!(
                        "a row of {found} heights, expected {expected} as in line {line}"
                    )));
                }
                Some(_) => {}
            }
        }
        if !text.next_line() {
            break;
        }
    }
    let Some((_, columns, _)) = first else {
        return Err(Fault::line(1, "the file has no rows, expected heights"));
    };
    on_columns_and_rows(columns, values)
}

/// What stands between fields.
#[derive(Debug, Clone, Copy)]
enum Separator {
    Byte(u8),
    Space,
}

impl Separator {
    fn of(line: &[u8]) -> Self {
        let found = [b';', b'\t', b','].into_iter().find(|byte| line.contains(byte));
        found.map_or(Separator::Space, Separator::Byte)
    }

    fn fields(self, line: &[u8], mut take: impl FnMut(&[u8]) -> Read<()>) -> Read<()> {
        match self {
            Separator::Byte(byte) => {
                line.split(|&other| other == byte).try_for_each(|field| take(field.trim_ascii()))
            }
            Separator::Space => {
                let words = line.split(u8::is_ascii_whitespace);
                words.filter(|word| !word.is_empty()).try_for_each(take)
            }
        }
    }
}

/// A field's height.
fn height(text: &Text<'_>, field: &[u8]) -> Read<f64> {
    if field.is_empty() || field.eq_ignore_ascii_case(b"nan") || field.eq_ignore_ascii_case(b"na") {
        return Ok(f64::NAN);
    }
    if field.starts_with(b"\"") {
        let message = format!("{} is quoted, expected a plain number", quote(field));
        return Err(text.fault(message));
    }
    text.number_in(field, "a height")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> (usize, Vec<String>) {
        let heights = read(text.as_bytes()).unwrap();
        let values = heights.values().iter().map(f64::to_string).collect();
        (heights.xs().len(), values)
    }

    #[test]
    fn four_separators_and_missing_heights() {
        let expected = (3, ["1", "-2.5", "NaN", "4", "NaN", "600"].map(str::to_owned).to_vec());
        for table in [
            "1,-2.5,nan\n4,,6e2\n",
            "# heights\n\n1;-2.5;\r\n4; NA ;600",
            "1\t-2.5\tNaN\n4\t\t600\n",
            "  1   -2.5 nan # first\n4 na  600\n",
        ] {
            assert_eq!(values(table), expected, "{table:?}");
        }
    }
}
