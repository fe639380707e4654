//! PLY (Greg Turk, Stanford, 1994): a header that declares elements and
//! their properties, then the elements, as text or in binary of either order.
//!
//! Taken are the position of `vertex`, the vertex list and the colour of
//! `face`, and both ends of `edge`; everything else is skipped as declared.
//!
//! There is a good crate, ply-rs-bw, and the tests hold this reader against
//! it. It does not stand here itself because a property or an element that is
//! declared twice replaces the first there, so that all data after it are
//! read askew; because errors in binary data have no position, and those in
//! text are three lines long; and because each row becomes an object of its
//! own, which costs more than all the rest.
//!
//! Rows are appended one by one as long as there are bytes, so a count that
//! lies ends in an error, not in an allocation.

mod header;
mod rows;

use glam::DVec3;

use self::header::{Element, Header, Role};
use self::rows::Rows;
use super::super::{Color, Soup};
use super::Found;
use super::error::Read;
use crate::run::Run;

/// Rows between two questions whether to go on.
const ROWS: u64 = 1 << 12;

/// Reads a PLY file of any encoding.
pub(super) fn read(bytes: &[u8], run: &Run<'_>) -> Read<Found> {
    let Header { encoding, elements, vertex_count, payload } = header::read(bytes)?;
    let mut rows = Rows::new(encoding, payload, bytes);
    let mut found = Found::default();
    let mut reader = Reader { vertex_count, ..Reader::default() };
    for element in &elements {
        // A row of no properties has no bytes, and its count no meaning.
        if element.properties.is_empty() {
            continue;
        }
        for number in 0..element.count {
            // Whatever is left out, the caller asks the run first.
            if number % ROWS == 0 {
                run.advance(0);
                if run.is_stopped() {
                    break;
                }
            }
            rows.begin(element, number)?;
            match element.name {
                b"vertex" => reader.vertex(element, &mut rows)?,
                b"face" => reader.face(element, number, &mut rows)?,
                b"edge" => reader.edge(element, &mut rows)?,
                _ => reader.row(element, &mut rows)?,
            }
            rows.end()?;
        }
        if 0 < element.count && !matches!(element.name, b"vertex" | b"face" | b"edge") {
            let name = String::from_utf8_lossy(element.name);
            found.warnings.push(format!("elements '{}' are ignored", name.escape_default()));
        }
    }
    rows.finish()?;
    let Reader { mut soup, colors, .. } = reader;
    soup.precision = header::precision(encoding, &elements);
    if colors.iter().any(Option::is_some) {
        soup.colors = Some(colors);
    }
    found.objects.push(soup);
    Ok(found)
}

#[derive(Default)]
struct Reader {
    vertex_count: u64,
    soup: Soup,
    colors: Vec<Option<Color>>,
    /// The row at hand: the value of each role, and the corners of a face.
    values: [f64; Role::COUNT],
    corners: Vec<u32>,
}

impl Reader {
    fn vertex(&mut self, element: &Element<'_>, rows: &mut Rows<'_>) -> Read<()> {
        self.row(element, rows)?;
        let [x, y, z] = [Role::X, Role::Y, Role::Z].map(|role| self.values[role as usize]);
        self.soup.vertices.push(DVec3::new(x, y, z));
        Ok(())
    }

    fn face(&mut self, element: &Element<'_>, number: u64, rows: &mut Rows<'_>) -> Read<()> {
        self.corners.clear();
        self.row(element, rows)?;
        if self.corners.len() < 3 {
            let count = self.corners.len();
            let message = format!("face {number} has {count} corners, expected 3 at least");
            return Err(rows.fault_of_row(message));
        }
        self.soup.faces.push(&self.corners, []);
        let channels = [Role::Red, Role::Green, Role::Blue];
        let color = element.has_color.then(|| {
            Color(channels.map(|role| self.values[role as usize].round().clamp(0.0, 255.0) as u8))
        });
        self.colors.push(color);
        Ok(())
    }

    fn edge(&mut self, element: &Element<'_>, rows: &mut Rows<'_>) -> Read<()> {
        self.row(element, rows)?;
        let [a, b] = [Role::Start, Role::End].map(|role| self.values[role as usize] as u32);
        self.soup.lines.push([a, b]);
        Ok(())
    }

    /// Reads the properties of one row.
    fn row(&mut self, element: &Element<'_>, rows: &mut Rows<'_>) -> Read<()> {
        for property in &element.properties {
            let Some(count_kind) = property.count_kind else {
                let value = match property.role {
                    Role::Skipped => rows.skip(property.kind)?,
                    Role::X | Role::Y | Role::Z => rows.finite(property.kind)?,
                    Role::Start | Role::End => {
                        f64::from(rows.vertex(property.kind, self.vertex_count)?)
                    }
                    _ => rows.value(property.kind)? * property.kind.color_scale(),
                };
                self.values[property.role as usize] = value;
                continue;
            };
            for _ in 0..rows.count(count_kind)? {
                if property.role == Role::Corners {
                    self.corners.push(rows.vertex(property.kind, self.vertex_count)?);
                } else {
                    rows.skip(property.kind)?;
                }
            }
        }
        Ok(())
    }
}
