//! A plotter that forgives nothing: it reads HPGL, or says what is wrong.

/// What a plotter would draw: pen and points of each stroke, plotter units.
pub(crate) type Plot = Vec<(u32, Vec<[i64; 2]>)>;

/// What the plotter has and reaches.
#[derive(Clone, Copy)]
pub(crate) struct Limits {
    pub(crate) low: [i64; 2],
    pub(crate) high: [i64; 2],
    pub(crate) pens: u32,
    /// The number that `PS` must have, where it must be sent.
    pub(crate) select: Option<u32>,
}

/// Where the pen is.
struct Pen {
    number: Option<u32>,
    at: Option<[i64; 2]>,
    down: bool,
    relative: bool,
}

/// Reads plotter instructions, or says what a strict plotter would mind.
pub(crate) fn plot(text: &str, limits: Limits) -> Result<Plot, String> {
    let mut strokes: Plot = Vec::new();
    let mut pen = Pen { number: None, at: None, down: false, relative: false };
    let mut selected = None;
    let body = text.strip_prefix("IN;\n").ok_or("does not begin with IN")?;
    let body = body.strip_suffix("PU;\nSP0;\n").ok_or("does not end with PU and SP0")?;
    for line in body.lines() {
        if 240 < line.len() {
            return Err(format!("an instruction of {} characters", line.len()));
        }
        let refuse = |why: &str| format!("{line}: {why}");
        let whole = line.strip_suffix(';').ok_or("no semicolon")?;
        let (mnemonic, numbers) = whole.split_at_checked(2).ok_or("too short")?;
        if mnemonic == "VS" {
            let speed: f64 = numbers.parse().map_err(|_| refuse("no speed"))?;
            if pen.number.is_some() || !(0.0..=100.0).contains(&speed) {
                return Err(refuse("not a speed before the first pen"));
            }
            continue;
        }
        let integers: Vec<i64> = match numbers {
            "" => vec![],
            _ => numbers.split(',').map(integer).collect::<Result<_, _>>()?,
        };
        match (mnemonic, &*integers) {
            ("PS", [number]) if pen.number.is_none() => selected = Some(*number as u32),
            ("SP", [number]) if !pen.down && (1..=i64::from(limits.pens)).contains(number) => {
                pen.number = Some(*number as u32);
            }
            ("PU", []) => pen.down = false,
            ("PA", []) => pen.relative = false,
            ("PR", []) if pen.at.is_some() => pen.relative = true,
            ("PU", [x, y]) if !pen.relative => {
                let number = pen.number.ok_or("no pen")?;
                (pen.at, pen.down) = (Some([*x, *y]), false);
                strokes.push((number, vec![[*x, *y]]));
            }
            ("PD", [_, ..]) if integers.len().is_multiple_of(2) => {
                let stroke = &mut strokes.last_mut().ok_or("no stroke")?.1;
                let mut at = pen.at.ok_or("from nowhere")?;
                for pair in integers.chunks(2) {
                    let origin = if pen.relative { at } else { [0, 0] };
                    let to = [origin[0] + pair[0], origin[1] + pair[1]];
                    if to == at {
                        return Err(refuse("a move of no length"));
                    }
                    stroke.push(to);
                    at = to;
                }
                (pen.at, pen.down) = (Some(at), true);
            }
            _ => return Err(refuse("not expected here")),
        }
    }
    if pen.relative || selected != limits.select {
        return Err(format!("left relative, or paper {selected:?}"));
    }
    let inside = |p: &[i64; 2]| (0..2).all(|i| (limits.low[i]..=limits.high[i]).contains(&p[i]));
    match strokes.iter().flat_map(|stroke| &stroke.1).find(|point| !inside(point)) {
        Some(point) => Err(format!("{point:?} is out of reach")),
        None => Ok(strokes),
    }
}

fn integer(text: &str) -> Result<i64, String> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let plain = text == "0" || (!digits.starts_with('0') && !digits.is_empty());
    let plain = plain && digits.bytes().all(|byte| byte.is_ascii_digit());
    let number = text.parse().ok().filter(|number: &i64| plain && number.abs() <= 32767);
    number.ok_or_else(|| format!("{text}: no 16-bit integer"))
}
