//! The header of a PLY file: lines of text up to `end_header`.
//!
//! Programs leave remarks there without the word `comment` before them: lines
//! that begin with no keyword are passed over and told, unless they have the
//! form of a declaration whose keyword is misspelt.

use super::super::super::Precision;
use super::super::error::{Fault, Read, quote};
use super::super::text::{Text, integer};

/// How the rows are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// What the header says.
pub(super) struct Header<'a> {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element<'a>>,
    pub(super) vertex_count: u64,
    pub(super) warnings: Vec<String>,
    /// The cursor behind `end_header`, at the first row.
    pub(super) payload: Text<'a>,
}

/// One kind of row.
pub(super) struct Element<'a> {
    pub(super) name: &'a [u8],
    pub(super) count: u64,
    pub(super) properties: Vec<Property<'a>>,
    /// Whether red, green and blue are all there.
    pub(super) has_color: bool,
    line: u64,
}

/// One value of a row, or a list of them.
pub(super) struct Property<'a> {
    name: &'a [u8],
    pub(super) kind: Kind,
    /// How the length of a list is written; `None` if this is no list.
    pub(super) count_kind: Option<Kind>,
    pub(super) role: Role,
}

/// What a property means to us.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Skipped,
    X,
    Y,
    Z,
    Corners,
    Red,
    Green,
    Blue,
    Start,
    End,
}

impl Role {
    /// How many roles there are.
    pub(super) const COUNT: usize = Role::End as usize + 1;

    fn of(element: &[u8], property: &[u8]) -> Role {
        match (element, property) {
            (b"vertex", b"x") => Role::X,
            (b"vertex", b"y") => Role::Y,
            (b"vertex", b"z") => Role::Z,
            (b"face" | b"tristrips", b"vertex_indices" | b"vertex_index") => Role::Corners,
            (b"face", b"red") => Role::Red,
            (b"face", b"green") => Role::Green,
            (b"face", b"blue") => Role::Blue,
            (b"edge", b"vertex1") => Role::Start,
            (b"edge", b"vertex2") => Role::End,
            _ => Role::Skipped,
        }
    }
}

/// A number's type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn of(name: &[u8]) -> Option<Kind> {
        Some(match name {
            b"char" | b"int8" => Kind::I8,
            b"uchar" | b"uint8" => Kind::U8,
            b"short" | b"int16" => Kind::I16,
            b"ushort" | b"uint16" => Kind::U16,
            b"int" | b"int32" => Kind::I32,
            b"uint" | b"uint32" => Kind::U32,
            b"float" | b"float32" => Kind::F32,
            b"double" | b"float64" => Kind::F64,
            _ => return None,
        })
    }

    fn is_integer(self) -> bool {
        !matches!(self, Kind::F32 | Kind::F64)
    }

    /// What brings a colour channel to 0..255: fractions go to 1.
    pub(super) fn color_scale(self) -> f64 {
        if self.is_integer() { 1.0 } else { 255.0 }
    }
}

/// Reads the header.
pub(super) fn read(bytes: &[u8]) -> Read<Header<'_>> {
    let mut text = Text::new(bytes);
    if text.word() != Some(b"ply") || text.has_word() {
        return Err(text.fault("the first line is not 'ply', expected a PLY file"));
    }
    let ends_in_cr = text.line_ends_in_cr();
    let mut warnings = Vec::new();
    let mut encoding = None;
    let mut elements: Vec<Element<'_>> = Vec::new();
    loop {
        if !text.next_full_line() {
            return Err(text.fault("the file ends in its header, expected end_header"));
        }
        match text.word().unwrap_or_default() {
            b"comment" | b"obj_info" => continue,
            b"format" => encoding = Some(format(&mut text)?),
            b"element" => {
                let element = element(&mut text)?;
                if elements.iter().any(|other| other.name == element.name) {
                    let name = quote(element.name);
                    return Err(text.fault(format!("a second element {name}, expected one")));
                }
                elements.push(element);
            }
            b"property" => match elements.last_mut() {
                Some(element) => property(&mut text, element)?,
                None => return Err(text.fault("a property of nothing, expected an element")),
            },
            b"end_header" => break,
            word if resembles_a_declaration(word, text.clone()) => {
                let message = format!("{} stands here, expected a header line", quote(word));
                return Err(text.fault(message));
            }
            word => {
                remark(&mut warnings, word, text.line());
                continue;
            }
        }
        if let Some(word) = text.word() {
            let message = format!("{} stands here, expected the end of the line", quote(word));
            return Err(text.fault(message));
        }
    }
    let Some(encoding) = encoding else {
        return Err(text.fault("the header ends without a format, expected a format line"));
    };
    for element in &mut elements {
        check(element)?;
    }
    let Some(vertices) = elements.iter().find(|element| element.name == b"vertex") else {
        return Err(text.fault("the header ends without vertices, expected an element vertex"));
    };
    let vertex_count = vertices.count;
    match encoding {
        // A byte of data may look like the second byte of a line's end.
        Encoding::LittleEndian | Encoding::BigEndian if ends_in_cr => text.pass_cr(),
        _ => drop(text.next_line()),
    }
    Ok(Header { encoding, elements, vertex_count, warnings, payload: text })
}

/// Whether a line may be a declaration whose keyword is misspelt: data would be
/// read askew without it. `rest` stands behind the keyword.
fn resembles_a_declaration(keyword: &[u8], mut rest: Text<'_>) -> bool {
    const TYPING_ERRORS: usize = 2;
    let words: Vec<_> = std::iter::from_fn(|| rest.word()).take(5).collect();
    let meant = match words[..] {
        [_, count] if integer(count).is_some() => &b"element"[..],
        [kind, _] if Kind::of(kind).is_some() => b"property",
        [b"list", count, item, _] if Kind::of(count).is_some() && Kind::of(item).is_some() => {
            b"property"
        }
        _ => return false,
    };
    edit_distance(keyword, meant) <= TYPING_ERRORS
}

/// How many letters have to be put in, left out or replaced to make one word of
/// another (Wagner and Fischer, 1974).
fn edit_distance(one: &[u8], other: &[u8]) -> usize {
    let mut row: Vec<usize> = (0..=other.len()).collect();
    for (i, a) in one.iter().enumerate() {
        let mut before = std::mem::replace(&mut row[0], i + 1);
        for (j, b) in other.iter().enumerate() {
            let replaced = before + usize::from(a != b);
            before = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(before + 1);
        }
    }
    row[other.len()]
}

/// Tells of a line that is no header line.
fn remark(warnings: &mut Vec<String>, word: &[u8], line: u64) {
    const MOST: usize = 20;
    if warnings.len() < MOST {
        let word = quote(word);
        warnings.push(format!("the header line {word} is ignored (line {line})"));
    }
}

/// How positions are rounded by the types that the header gives them.
pub(super) fn precision(encoding: Encoding, elements: &[Element<'_>]) -> Precision {
    let is_coordinate = |role| matches!(role, Role::X | Role::Y | Role::Z);
    let mut properties = elements.iter().flat_map(|element| &element.properties);
    let is_narrow =
        properties.any(|property| is_coordinate(property.role) && property.kind == Kind::F32);
    match encoding {
        // Text has the decimals that it has.
        Encoding::LittleEndian | Encoding::BigEndian if is_narrow => Precision::Float32,
        _ => Precision::AsWritten,
    }
}

fn format(text: &mut Text<'_>) -> Read<Encoding> {
    const EXPECTED: &str = "ascii, binary_little_endian or binary_big_endian";
    let encoding = match text.word() {
        Some(b"ascii") => Encoding::Text,
        Some(b"binary_little_endian") => Encoding::LittleEndian,
        Some(b"binary_big_endian") => Encoding::BigEndian,
        Some(word) => {
            return Err(text.fault(format!("the format {}, expected {EXPECTED}", quote(word))));
        }
        None => return Err(text.fault(format!("the line ends here, expected {EXPECTED}"))),
    };
    match text.word() {
        Some(b"1.0") => Ok(encoding),
        Some(word) => Err(text.fault(format!("the version {}, expected 1.0", quote(word)))),
        None => Err(text.fault("the line ends here, expected the version 1.0")),
    }
}

fn element<'a>(text: &mut Text<'a>) -> Read<Element<'a>> {
    let Some(name) = text.word() else {
        return Err(text.fault("the line ends here, expected the name of an element"));
    };
    let count = text.natural("the number of elements")?;
    Ok(Element { name, count, properties: Vec::new(), has_color: false, line: text.line() })
}

fn property<'a>(text: &mut Text<'a>, element: &mut Element<'a>) -> Read<()> {
    let is_list = text.clone().word() == Some(b"list");
    let mut count_kind = None;
    if is_list {
        text.word();
        let kind = kind(text)?;
        if !kind.is_integer() {
            return Err(text.fault("a list counted in fractions, expected an integer type"));
        }
        count_kind = Some(kind);
    }
    let kind = kind(text)?;
    let Some(name) = text.word() else {
        return Err(text.fault("the line ends here, expected the name of a property"));
    };
    if element.properties.iter().any(|other| other.name == name) {
        return Err(text.fault(format!("a second property {}, expected one", quote(name))));
    }
    let role = Role::of(element.name, name);
    if role != Role::Skipped && is_list != (role == Role::Corners) {
        let expected = if is_list { "a single number" } else { "a list" };
        return Err(text.fault(format!("{} of the wrong shape, expected {expected}", quote(name))));
    }
    if matches!(role, Role::Corners | Role::Start | Role::End) && !kind.is_integer() {
        return Err(text.fault("vertices numbered in fractions, expected an integer type"));
    }
    element.properties.push(Property { name, kind, count_kind, role });
    Ok(())
}

fn kind(text: &mut Text<'_>) -> Read<Kind> {
    match text.word() {
        Some(word) => Kind::of(word).ok_or_else(|| {
            text.fault(format!("the type {}, expected char, int, float ...", quote(word)))
        }),
        None => Err(text.fault("the line ends here, expected a type")),
    }
}

/// Whether the element has all that its name promises.
fn check(element: &mut Element<'_>) -> Read<()> {
    let has = |role| element.properties.iter().any(|property| property.role == role);
    let needed: &[(Role, &str)] = match element.name {
        b"vertex" => &[(Role::X, "x"), (Role::Y, "y"), (Role::Z, "z")],
        b"face" | b"tristrips" => &[(Role::Corners, "vertex_indices")],
        b"edge" => &[(Role::Start, "vertex1"), (Role::End, "vertex2")],
        _ => &[],
    };
    if let Some((_, name)) = needed.iter().find(|(role, _)| !has(*role)) {
        let element_name = quote(element.name);
        let message = format!("element {element_name} lacks a property, expected '{name}'");
        return Err(Fault::line(element.line, message));
    }
    element.has_color = [Role::Red, Role::Green, Role::Blue].into_iter().all(has);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typing_errors_are_told_from_remarks() {
        let resembles = |line: &[u8]| {
            let mut text = Text::new(line);
            let keyword = text.word().unwrap();
            resembles_a_declaration(keyword, text)
        };
        for line in [
            &b"elment face 2"[..],
            b"Element face 2",
            b"proprety float x",
            b"propertie list uchar int vertex_indices",
        ] {
            assert!(resembles(line), "{}", line.escape_ascii());
        }
        for line in [
            &b"author someone, 2019"[..],
            b"saved double precision",
            b"elment",
            b"properties of float x",
            b"Created by a program",
        ] {
            assert!(!resembles(line), "{}", line.escape_ascii());
        }
        assert_eq!(edit_distance(b"kitten", b"sitting"), 3);
        assert_eq!(edit_distance(b"", b"ab"), 2);
    }
}
