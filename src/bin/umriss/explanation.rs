//! What `umriss explain` prints: a table, or the same as JSON.

use glam::DVec2;
use serde::Serialize;
use std::fmt::Write;
use umriss::verify::{CoincidentLine, EndCause, EndThere, Explanation, FaceThere, LineThere, Side};
use umriss::view::{LineSource, VisibleLines};

/// Everything that is told, in the order of the table.
#[derive(Serialize)]
pub(crate) struct Facts {
    at: [f64; 2],
    within: f64,
    /// The nearest line, though it be farther away than `within`.
    line: Option<LineFacts>,
    faces: Vec<FaceFacts>,
}

#[derive(Serialize)]
struct LineFacts {
    #[serde(flatten)]
    name: LineName,
    invisibility: u32,
    distance: f64,
    place: [f64; 2],
    depth: f64,
    begins: EndFacts,
    ends: EndFacts,
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<&'static str>,
    hidden_by: Vec<FaceFacts>,
    coincident: Vec<CoincidentFacts>,
}

/// What a line is.
#[derive(Serialize)]
struct LineName {
    class: &'static str,
    object: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    edge: Option<[u32; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    faces: Option<[u32; 2]>,
    /// The object of the second face.
    #[serde(skip_serializing_if = "Option::is_none")]
    other_object: Option<String>,
}

#[derive(Serialize)]
struct EndFacts {
    point: [f64; 2],
    depth: f64,
    what: String,
    /// Where there is a piece beyond.
    #[serde(skip_serializing_if = "Option::is_none")]
    invisibility_beyond: Option<u32>,
}

#[derive(Serialize)]
struct FaceFacts {
    object: String,
    face: u32,
    vertices: [u32; 3],
    depth: f64,
}

#[derive(Serialize)]
struct CoincidentFacts {
    #[serde(flatten)]
    name: LineName,
    invisibility: u32,
}

impl Facts {
    pub(crate) fn new(
        at: DVec2,
        within: f64,
        lines: &VisibleLines,
        explanation: &Explanation,
    ) -> Self {
        let names = Names(lines);
        Facts {
            at: at.to_array(),
            within,
            line: explanation.line.as_ref().map(|line| names.line(line)),
            faces: names.faces(&explanation.faces),
        }
    }

    pub(crate) fn table(&self) -> String {
        let mut table = Table::default();
        table.row("at", &format!("{} of the view frame", pair(self.at)));
        match &self.line {
            None => table.row("line", "none: the drawing is empty"),
            Some(line) if self.within < line.distance => {
                table.row("line", &format!("none within {}", number(self.within)));
                table.row("nearest line", &line.name.text());
                table.row("distance", &number(line.distance));
                table.row("nearest place", &pair(line.place));
            }
            Some(line) => line.rows(&mut table),
        }
        let faces: Vec<String> = self.faces.iter().map(FaceFacts::text).collect();
        table.list("faces at the point", &faces);
        table.text
    }
}

impl LineFacts {
    fn rows(&self, table: &mut Table) {
        table.row("line", &self.name.text());
        table.row("distance", &number(self.distance));
        table.row("nearest place", &format!("{}, depth {}", pair(self.place), number(self.depth)));
        table.row("invisibility", &hidden(self.invisibility));
        table.row("piece begins", &self.begins.text());
        table.row("piece ends", &self.ends.text());
        let beside = match self.side {
            None | Some("both") => String::new(),
            Some(side) => format!(" ({side})"),
        };
        let faces: Vec<String> = self.hidden_by.iter().map(FaceFacts::text).collect();
        table.list(&format!("hidden by{beside}"), &faces);
        let coincident = self.coincident.iter();
        let lines = coincident.map(|l| format!("{}, {}", l.name.text(), hidden(l.invisibility)));
        table.list("lines under it", &lines.collect::<Vec<_>>());
    }
}

impl LineName {
    fn text(&self) -> String {
        let LineName { class, object, .. } = self;
        match (self.edge, self.faces) {
            (Some([a, b]), _) => format!("{class}, edge {a}-{b} of {object}"),
            (None, Some([f, g])) => {
                let other =
                    self.other_object.as_ref().map_or(String::new(), |o| format!(" of {o}"));
                format!("{class}, face {f} of {object} and face {g}{other}")
            }
            (None, None) => format!("{class} of {object}"),
        }
    }
}

impl EndFacts {
    fn text(&self) -> String {
        let beyond = match self.invisibility_beyond {
            None => String::new(),
            Some(count) => format!("; beyond {}", hidden(count)),
        };
        format!("{}, depth {}, {}{beyond}", pair(self.point), number(self.depth), self.what)
    }
}

impl FaceFacts {
    fn text(&self) -> String {
        let FaceFacts { object, face, vertices: [a, b, c], depth } = self;
        format!("face {face} of {object}, vertices {a} {b} {c}, depth {}", number(*depth))
    }
}

/// Visible, or by how many faces not.
fn hidden(count: u32) -> String {
    match count {
        0 => "visible".to_owned(),
        1 => "hidden by 1 face".to_owned(),
        _ => format!("hidden by {count} faces"),
    }
}

fn pair([u, v]: [f64; 2]) -> String {
    format!("{} {}", number(u), number(v))
}

/// Nine digits are what one looks for; JSON has all of them.
fn number(value: f64) -> String {
    let rounded: f64 = format!("{value:.8e}").parse().unwrap_or(value);
    // Not a negative zero.
    let rounded = rounded + 0.0;
    let size = rounded.abs();
    if size == 0.0 || (1e-6..1e15).contains(&size) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

/// Puts names in the place of numbers of objects.
struct Names<'a>(&'a VisibleLines);

impl Names<'_> {
    fn object(&self, object: u32) -> String {
        self.0.objects.get(object as usize).cloned().unwrap_or_default()
    }

    fn line(&self, line: &LineThere) -> LineFacts {
        let piece = &self.0.pieces[line.drawn];
        let mut name = self.name(piece.class.name(), piece.object, piece.source);
        name.other_object = line.faces.map(|[_, other]| self.object(other.object));
        let [begins, ends] = line.ends.each_ref().map(|end| self.end(end));
        LineFacts {
            name,
            invisibility: piece.invisibility,
            distance: line.distance,
            place: line.image.to_array(),
            depth: line.depth,
            begins,
            ends,
            side: (!line.hidden_by.is_empty()).then_some(match line.side {
                Side::Both => "both",
                Side::Left => "left",
                Side::Right => "right",
            }),
            hidden_by: self.faces(&line.hidden_by),
            coincident: line.coincident.iter().map(|other| self.coincident(other)).collect(),
        }
    }

    fn name(&self, class: &'static str, object: u32, source: LineSource) -> LineName {
        let (edge, faces) = match source {
            LineSource::Edge(edge) => (Some(edge), None),
            LineSource::Faces(faces) => (None, Some(faces)),
        };
        LineName { class, object: self.object(object), edge, faces, other_object: None }
    }

    fn coincident(&self, other: &CoincidentLine) -> CoincidentFacts {
        let name = self.name(other.class.name(), other.object, other.source);
        CoincidentFacts { name, invisibility: other.invisibility }
    }

    fn end(&self, end: &EndThere) -> EndFacts {
        EndFacts {
            point: end.image.to_array(),
            depth: end.depth,
            what: self.cause(end.cause),
            invisibility_beyond: end.beyond,
        }
    }

    fn cause(&self, cause: EndCause) -> String {
        match cause {
            EndCause::Vertex { object, vertex } => {
                format!("vertex {vertex} of {}", self.object(object))
            }
            EndCause::Piercing { object, edge: [a, b] } => {
                format!("edge {a}-{b} of {} goes through a face", self.object(object))
            }
            EndCause::Edge { object, edge: [a, b] } => {
                format!("behind edge {a}-{b} of {}", self.object(object))
            }
            EndCause::Face { object, vertices: [a, b, c] } => {
                format!("through the face of {} with vertices {a} {b} {c}", self.object(object))
            }
            EndCause::NearPlane => "the near plane".to_owned(),
        }
    }

    fn faces(&self, faces: &[FaceThere]) -> Vec<FaceFacts> {
        let face = |&FaceThere { object, face, vertices, depth, .. }: &FaceThere| FaceFacts {
            object: self.object(object),
            face,
            vertices,
            depth,
        };
        faces.iter().map(face).collect()
    }
}

/// Two columns.
#[derive(Default)]
struct Table {
    text: String,
}

impl Table {
    fn row(&mut self, name: &str, value: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{name:<20} {value}");
    }

    /// Values below one another, or the word none.
    fn list(&mut self, name: &str, values: &[String]) {
        match values {
            [] => self.row(name, "none"),
            [first, others @ ..] => {
                self.row(name, first);
                others.iter().for_each(|value| self.row("", value));
            }
        }
    }
}
