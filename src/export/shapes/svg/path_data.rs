//! Path data of SVG (SVG 1.1, section 8.3; arcs: its appendix F.6).

use super::chords::{Arc, Chords};
use glam::{DMat2, DVec2, dvec2};
use std::f64::consts::TAU;

/// Draws path data: a ring for each subpath, closed or not.
pub(super) fn draw(data: &str, chords: &mut Chords) -> Result<(), String> {
    let mut words = Words { rest: data };
    let mut command = None;
    // Where the next smooth curve leaves, if the last one was of its kind.
    let mut last = LastControl::None;
    loop {
        if let Some(letter) = words.command() {
            if command.is_none() && !matches!(letter, 'M' | 'm') {
                return Err(format!("path data begins with `{letter}`, expected M or m"));
            }
            command = Some(letter);
            if matches!(letter, 'Z' | 'z') {
                chords.close();
                last = LastControl::None;
                continue;
            }
        } else if words.is_empty() {
            return Ok(());
        }
        let Some(letter) = command else {
            return Err(format!("path data begins with `{}`, expected M or m", words.next_word()));
        };
        let at = chords.at();
        let origin = if letter.is_ascii_lowercase() { at } else { DVec2::ZERO };
        let kind = letter.to_ascii_uppercase();
        last = match kind {
            'M' => {
                chords.move_to(origin + words.pair()?)?;
                // Further pairs of numbers are lines.
                command = Some(if letter == 'M' { 'L' } else { 'l' });
                LastControl::None
            }
            'L' => line(chords, origin + words.pair()?)?,
            'H' => line(chords, dvec2(origin.x + words.number()?, at.y))?,
            'V' => line(chords, dvec2(at.x, origin.y + words.number()?))?,
            'C' | 'S' => {
                let first = match (kind, last) {
                    ('C', _) => origin + words.pair()?,
                    (_, LastControl::Cubic(control)) => 2.0 * at - control,
                    _ => at,
                };
                let second = origin + words.pair()?;
                chords.cubic_to([first, second], origin + words.pair()?)?;
                LastControl::Cubic(second)
            }
            'Q' | 'T' => {
                let control = match (kind, last) {
                    ('Q', _) => origin + words.pair()?,
                    (_, LastControl::Quadratic(control)) => 2.0 * at - control,
                    _ => at,
                };
                chords.quadratic_to(control, origin + words.pair()?)?;
                LastControl::Quadratic(control)
            }
            'A' => {
                let radii = words.pair()?;
                let turn = words.number()?;
                let (is_large, is_forward) = (words.flag()?, words.flag()?);
                let to = origin + words.pair()?;
                match arc(at, to, radii, turn, is_large, is_forward) {
                    Some(arc) => chords.arc_to(&arc, to)?,
                    None => chords.line_to(to)?,
                }
                LastControl::None
            }
            'Z' => return Err(format!("`{}` after Z, expected a command", words.next_word())),
            _ => {
                return Err(format!(
                    "`{letter}` in path data, expected M, L, H, V, C, S, Q, T, A or Z"
                ));
            }
        };
    }
}

/// The last control point of a curve, for the smooth one after it.
#[derive(Debug, Clone, Copy)]
enum LastControl {
    None,
    Quadratic(DVec2),
    Cubic(DVec2),
}

fn line(chords: &mut Chords, to: DVec2) -> Result<LastControl, String> {
    chords.line_to(to)?;
    Ok(LastControl::None)
}

/// The arc of an ellipse between two points; nothing where it is a straight
/// line. Radii that are too small to reach grow until they do.
fn arc(
    from: DVec2,
    to: DVec2,
    radii: DVec2,
    turn: f64,
    is_large: bool,
    is_forward: bool,
) -> Option<Arc> {
    let radii = radii.abs();
    if from == to || radii.x == 0.0 || radii.y == 0.0 {
        return None;
    }
    let turned = DMat2::from_angle(turn.to_radians());
    // In a system where the ellipse is the unit circle.
    let to_circle = |way: DVec2| (turned.transpose() * way) / radii;
    let half = to_circle((from - to) / 2.0);
    let reach = half.length();
    let grown = radii * reach.max(1.0);
    let half = half / reach.max(1.0);
    let height = (1.0 / half.length_squared() - 1.0).max(0.0).sqrt();
    let side = if is_large == is_forward { -1.0 } else { 1.0 };
    let center = side * height * dvec2(half.y, -half.x);
    let (start, end) = (half - center, -half - center);
    let (start, end) = (start.y.atan2(start.x), end.y.atan2(end.x));
    let sweep = match (end - start).rem_euclid(TAU) {
        forward if is_forward => forward,
        forward => forward - TAU,
    };
    let axes = turned * DMat2::from_diagonal(grown);
    let arc = Arc { center: from.midpoint(to) + axes * center, axes, start, sweep };
    // Radii so small or so large that they leave the range of numbers.
    (arc.center.is_finite() && sweep.is_finite()).then_some(arc)
}

/// Draws the points of a polygon: numbers in pairs.
pub(super) fn draw_points(data: &str, chords: &mut Chords) -> Result<(), String> {
    let mut words = Words { rest: data };
    let mut is_first = true;
    while !words.is_empty() {
        let point = words.pair()?;
        match std::mem::take(&mut is_first) {
            true => chords.move_to(point)?,
            false => chords.line_to(point)?,
        }
    }
    Ok(())
}

struct Words<'d> {
    rest: &'d str,
}

impl<'d> Words<'d> {
    fn skip_space(&mut self) {
        self.rest = self.rest.trim_start_matches([' ', '\t', '\n', '\r', '\x0c', ',']);
    }

    fn is_empty(&mut self) -> bool {
        self.skip_space();
        self.rest.is_empty()
    }

    /// A letter, if one is next.
    fn command(&mut self) -> Option<char> {
        self.skip_space();
        let letter = self.rest.chars().next().filter(char::is_ascii_alphabetic)?;
        self.rest = &self.rest[1..];
        Some(letter)
    }

    /// What is next, for messages.
    fn next_word(&mut self) -> &'d str {
        self.skip_space();
        self.rest.split([' ', ',', '\n', '\t']).next().unwrap_or(self.rest)
    }

    fn pair(&mut self) -> Result<DVec2, String> {
        let x = self.number()?;
        Ok(dvec2(x, self.number()?))
    }

    /// A digit that is 0 or 1; what follows it needs no space.
    fn flag(&mut self) -> Result<bool, String> {
        self.skip_space();
        let flag = match self.rest.as_bytes().first() {
            Some(b'0') => false,
            Some(b'1') => true,
            _ => return Err(format!("`{}`, expected 0 or 1 in an arc", self.next_word())),
        };
        self.rest = &self.rest[1..];
        Ok(flag)
    }

    /// A number. Two may follow one another without space: `1-2`, `.5.5`.
    fn number(&mut self) -> Result<f64, String> {
        self.skip_space();
        let bytes = self.rest.as_bytes();
        let digits = |mut at: usize| {
            while bytes.get(at).is_some_and(u8::is_ascii_digit) {
                at += 1;
            }
            at
        };
        let is_sign = |at: usize| matches!(bytes.get(at), Some(b'+' | b'-'));
        let mut end = digits(usize::from(is_sign(0)));
        if bytes.get(end) == Some(&b'.') {
            end = digits(end + 1);
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let first = end + 1 + usize::from(is_sign(end + 1));
            if digits(first) > first {
                end = digits(first);
            }
        }
        let text = &self.rest[..end];
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => {
                self.rest = &self.rest[end..];
                Ok(value)
            }
            Ok(_) => Err(format!("`{text}` is beyond the range of numbers")),
            Err(_) if self.rest.is_empty() => Err("the end, expected a number".to_owned()),
            Err(_) => Err(format!("`{}`, expected a number", self.next_word())),
        }
    }
}
