//! The header of a PLY file: lines of text up to `end_header`.

use super::super::super::Precision;
use super::super::error::{Fault, Read, quote};
use super::super::text::Text;

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
            (b"face", b"vertex_indices" | b"vertex_index") => Role::Corners,
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
            word => {
                let message = format!("{} stands here, expected a header line", quote(word));
                return Err(text.fault(message));
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
    text.next_line();
    Ok(Header { encoding, elements, vertex_count, payload: text })
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
        b"face" => &[(Role::Corners, "vertex_indices")],
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
