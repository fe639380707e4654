//! Time against error, both logarithmic. What has no error stands on the
//! lowest line.

use super::measure::{Contender, Row};
use std::fmt::Write;

const SIZE: [f64; 2] = [760.0, 470.0];
/// Left, top, right and bottom of the plot.
const PLOT: [f64; 4] = [98.0, 20.0, 560.0, 400.0];
/// Powers of ten of the axes: ratios of times, shares in percent. Below the
/// least share is none.
const TIMES: [i32; 2] = [-1, 3];
const SHARES: [i32; 2] = [-6, 2];

fn place(row: &Row) -> [f64; 2] {
    let [left, top, right, bottom] = PLOT;
    let share = |value: f64, [low, high]: [i32; 2]| {
        ((value.log10() - f64::from(low)) / f64::from(high - low)).clamp(0.0, 1.0)
    };
    let time = share(row.time(), TIMES);
    let wrong = if row.scenes_with_errors() == 0 { 0.0 } else { share(100.0 * row.mean(), SHARES) };
    [left + time * (right - left), bottom + wrong * (top - bottom)]
}

/// The plot as SVG.
pub(crate) fn plot(rows: &[Row]) -> String {
    let [left, top, right, bottom] = PLOT;
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    axes(&mut svg);
    let is_sampled = |row: &&Row| matches!(row.contender, Contender::Sampled(_));
    let is_buffer = |row: &&Row| matches!(row.contender, Contender::Buffer(_));
    let sampled: Vec<&Row> = rows.iter().filter(is_sampled).collect();
    let buffers: Vec<&Row> = rows.iter().filter(is_buffer).collect();
    let mut line = 0;
    for (name, color, series) in [
        ("rays at 1/64 to 1/16384", "#c1440e", sampled),
        ("z-buffers of 128 to 2048", "#1b6ca8", buffers),
    ] {
        let places: Vec<_> = series.iter().map(|row| place(row)).collect();
        let path: Vec<_> = places.iter().map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
        // Writing to a string cannot fail.
        let _ = write!(
            svg,
            "<path d=\"M{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\"/>",
            path.join("L")
        );
        places.into_iter().for_each(|at| dot(&mut svg, at, color));
        legend(&mut svg, &mut line, color, name);
    }
    let single = rows.iter().filter(|row| !is_sampled(row) && !is_buffer(row));
    for (row, color) in single.zip(["#000000", "#2e8b57", "#b8860b", "#8e44ad"]) {
        dot(&mut svg, place(row), color);
        legend(&mut svg, &mut line, color, &row.contender.name());
    }
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">time, as a multiple of exact Appel; \
         geometric mean of all scenes</text>",
        (left + right) / 2.0,
        bottom + 42.0
    );
    let _ = writeln!(
        svg,
        "<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">length that is \
         drawn wrongly or missed, mean</text>",
        (top + bottom) / 2.0
    );
    svg.push_str("</svg>\n");
    svg
}

fn axes(svg: &mut String) {
    let [left, top, right, bottom] = PLOT;
    for decade in TIMES[0]..=TIMES[1] {
        let share = f64::from(decade - TIMES[0]) / f64::from(TIMES[1] - TIMES[0]);
        let x = left + share * (right - left);
        let _ = writeln!(
            svg,
            "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"#dddddd\"/>\
             <text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            bottom + 18.0,
            f64::powi(10.0, decade)
        );
    }
    for decade in SHARES[0]..=SHARES[1] {
        let share = f64::from(decade - SHARES[0]) / f64::from(SHARES[1] - SHARES[0]);
        let y = bottom + share * (top - bottom);
        let label = match decade == SHARES[0] {
            true => "none".to_owned(),
            false => format!("{} %", f64::powi(10.0, decade)),
        };
        let _ = writeln!(
            svg,
            "<path d=\"M{left} {y:.1}H{right}\" stroke=\"#dddddd\"/>\
             <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
            left - 6.0,
            y + 4.0
        );
    }
}

fn dot(svg: &mut String, [x, y]: [f64; 2], color: &str) {
    let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{color}\"/>");
}

fn legend(svg: &mut String, line: &mut u32, color: &str, name: &str) {
    let (x, y) = (PLOT[2] + 16.0, PLOT[1] + 10.0 + 20.0 * f64::from(*line));
    *line += 1;
    dot(svg, [x + 6.0, y], color);
    let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\">{name}</text>", x + 18.0, y + 4.0);
}
