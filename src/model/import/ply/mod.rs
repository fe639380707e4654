//! PLY (Greg Turk, Stanford, 1994): a header that declares elements and
//! their properties, then the elements, as text or in binary of either order.
//!
//! Taken are the position of `vertex`, the vertex list and the colour of
//! `face`, both ends of `edge`, and the triangles of `tristrips` (of Turk and
//! Levoy's scans: -1 begins another strip); everything else is skipped as
//! declared. In text, a row may run over several lines, and words that follow
//! the declared values of a row are passed over and told, as is what follows
//! the last row.
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
mod strips;

use glam::DVec3;

use self::header::{Element, Header, Role};
use self::rows::Rows;
use self::strips::add_strips;
use super::super::{Color, FacePlace, Soup};
use super::Found;
use super::error::Read;
use crate::run::Run;

/// Rows between two questions whether to go on.
const ROWS: u64 = 1 << 12;

/// Reads a PLY file of any encoding.
pub(super) fn read(bytes: &[u8], run: &Run<'_>) -> Read<Found> {
    let Header { encoding, elements, vertex_count, warnings, payload } = header::read(bytes)?;
    let mut rows = Rows::new(encoding, payload, bytes);
    let mut found = Found { warnings, ..Found::default() };
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
                b"tristrips" => reader.strips(element, &mut rows)?,
                _ => reader.row(element, &mut rows)?,
            }
            rows.end()?;
        }
        let is_taken = matches!(element.name, b"vertex" | b"face" | b"edge" | b"tristrips");
        if 0 < element.count && !is_taken {
            let name = String::from_utf8_lossy(element.name);
            found.warnings.push(format!("elements '{}' are ignored", name.escape_default()));
        }
    }
    if let Some(face) = reader.first_of_few_corners {
        let warning = format!("faces with fewer than 3 corners are ignored (face {face})");
        found.warnings.push(warning);
    }
    found.warnings.extend(rows.finish());
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
    /// The first face that is passed over.
    first_of_few_corners: Option<u64>,
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
        let place = FacePlace { number, line: rows.line() };
        self.row(element, rows)?;
        let count = self.corners.len();
        // With too few vertices counted, the next one would look like this.
        if count < 3 && rows.has_more() {
            let message = format!("face {number} has {count} corners, expected 3 at least");
            return Err(rows.fault_of_row(message));
        }
        if count < 3 {
            self.first_of_few_corners.get_or_insert(number);
            return Ok(());
        }
        self.soup.places.note(self.soup.faces.len() as u32, place);
        self.soup.faces.push(&self.corners, []);
        let channels = [Role::Red, Role::Green, Role::Blue];
        let color = element.has_color.then(|| {
            Color(channels.map(|role| self.values[role as usize].round().clamp(0.0, 255.0) as u8))
        });
        self.colors.push(color);
        Ok(())
    }

    fn strips(&mut self, element: &Element<'_>, rows: &mut Rows<'_>) -> Read<()> {
        self.corners.clear();
        self.row(element, rows)?;
        let before = self.soup.faces.len();
        add_strips(&mut self.soup.faces, &self.corners);
        self.colors.resize(self.colors.len() + self.soup.faces.len() - before, None);
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
            let is_strip = element.name == b"tristrips";
            for _ in 0..rows.count(count_kind)? {
                if property.role != Role::Corners {
                    rows.skip(property.kind)?;
                } else if is_strip {
                    self.corners.push(rows.vertex_of_strip(property.kind, self.vertex_count)?);
                } else {
                    self.corners.push(rows.vertex(property.kind, self.vertex_count)?);
                }
            }
        }
        Ok(())
    }
}
