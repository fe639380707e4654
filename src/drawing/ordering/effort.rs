//! How much work is put into the order of strokes.

use super::super::DrawingError;
use std::str::FromStr;
use std::time::Duration;

/// How much work is put into the order of strokes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Effort {
    /// None: strokes stay as they are.
    #[default]
    Keep,
    /// On to the nearest end, nothing more.
    Greedy,
    /// Improved until eight steps have been taken for each stroke.
    Best,
    /// Improved until so many steps have been taken for all layers together.
    Steps(u64),
    /// Improved for so long. The result depends on the machine.
    Time(Duration),
}

/// The longest time that may be asked for: a day.
const LONGEST: f64 = 86_400.0;

/// Reads `keep`, `greedy`, `best`, steps as in `500000`, and a time as in `2s`.
impl FromStr for Effort {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        let seconds = |text: &str| {
            let seconds = text.strip_suffix('s')?.trim_end().parse::<f64>().ok()?;
            (0.0..=LONGEST).contains(&seconds).then(|| Duration::from_secs_f64(seconds))
        };
        match text {
            "keep" => Ok(Effort::Keep),
            "greedy" => Ok(Effort::Greedy),
            "best" => Ok(Effort::Best),
            _ => match (text.parse(), seconds(text)) {
                (Ok(steps), _) => Ok(Effort::Steps(steps)),
                (_, Some(time)) => Ok(Effort::Time(time)),
                _ => Err(DrawingError::Choice {
                    word: text.to_owned(),
                    expected: "keep, greedy, best, a number of steps, or a time as in 2s",
                }),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_steps_and_times_are_read() {
        assert_eq!("best".parse(), Ok(Effort::Best));
        assert_eq!("500000".parse(), Ok(Effort::Steps(500_000)));
        assert_eq!("1.5s".parse(), Ok(Effort::Time(Duration::from_millis(1500))));
        for text in ["", "s", "-1s", "1e9s", "nans", "quick", "-5", "1.5"] {
            assert!(text.parse::<Effort>().is_err(), "{text}");
        }
    }
}
