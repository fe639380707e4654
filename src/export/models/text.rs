//! OBJ and OFF: lists of numbers, written with all their digits.

use super::Model;
use glam::DVec3;
use std::fmt::Write;

/// OBJ: objects, polygons, loose lines.
pub(super) fn obj(model: &Model<'_>) -> Vec<u8> {
    let mut text = String::new();
    for &vertex in &model.vertices {
        text.push_str("v ");
        push_place(&mut text, vertex);
    }
    let mut start = 0;
    for (object, (end, lines)) in model.objects.iter().zip(&model.parts) {
        if !object.name.is_empty() {
            // A name is one word to many readers, and never more than a line.
            let name: String =
                object.name.chars().map(|c| if c.is_whitespace() { '_' } else { c }).collect();
            text.push_str("o ");
            text.push_str(&name);
            text.push('\n');
        }
        for face in &model.faces[start..*end] {
            push_numbers(&mut text, "f", face.rings[0].iter().map(|corner| corner + 1));
        }
        for line in lines {
            push_numbers(&mut text, "l", line.iter().map(|end| end + 1));
        }
        start = *end;
    }
    text.into_bytes()
}

/// OFF: polygons.
pub(super) fn off(model: &Model<'_>) -> Vec<u8> {
    let mut text = format!("OFF\n{} {} 0\n", model.vertices.len(), model.faces.len());
    model.vertices.iter().for_each(|&vertex| push_place(&mut text, vertex));
    for face in &model.faces {
        let count = face.rings[0].len().to_string();
        push_numbers(&mut text, &count, face.rings[0].iter().copied());
    }
    text.into_bytes()
}

fn push_numbers(text: &mut String, first: &str, numbers: impl Iterator<Item = u32>) {
    text.push_str(first);
    for number in numbers {
        // Writing to a string cannot fail.
        let _ = write!(text, " {number}");
    }
    text.push('\n');
}

/// A place on a line of its own.
fn push_place(text: &mut String, place: DVec3) {
    for (axis, number) in place.to_array().into_iter().enumerate() {
        text.push_str(if axis == 0 { "" } else { " " });
        let plain = number == 0.0 || (1e-5..1e15).contains(&number.abs());
        // Both have the digits that tell the double from its neighbours.
        let _ = if plain { write!(text, "{number}") } else { write!(text, "{number:e}") };
    }
    text.push('\n');
}
