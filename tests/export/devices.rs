//! HPGL for real plotters, held against the SVG of the same drawing, against
//! hp2xx and against vpype, the latter two where they are installed.

use crate::fixture::{cube, svg_strokes};
use crate::strict_plotter::{Limits, Plot, plot};
use glam::DVec2;
use std::process::Command;
use umriss::drawing::{Drawing, DrawingOptions, Effort, Hidden, LayerBy, Length, Paper};
use umriss::export::{
    Device, DevicePaper, ExportError, HpglOptions, SvgOptions, devices, plotter_window,
    to_hpgl_with, to_svg,
};

fn device(id: &str) -> Device {
    devices([]).unwrap().into_iter().find(|device| device.id == id).unwrap()
}

fn page(width: f64, height: f64) -> Drawing {
    let options = DrawingOptions {
        paper: Paper::Sheet { width, height },
        margin: Length::new(32.0).unwrap(),
        hidden: Hidden::Dashed,
        layer_by: LayerBy::Class,
        ..DrawingOptions::default()
    };
    let mut drawing = Drawing::new(&cube(), &options).unwrap();
    drawing.order(Effort::Best);
    drawing
}

fn limits(device: &Device, paper: &DevicePaper) -> Limits {
    Limits {
        low: [paper.x[0], paper.y[0]].map(i64::from),
        high: [paper.x[1], paper.y[1]].map(i64::from),
        pens: device.pens,
        select: paper.select.map(u32::from),
    }
}

/// Where a point of the page lies in the device: written here once more.
fn units(device: &Device, paper: &DevicePaper, page: DVec2, point: DVec2) -> DVec2 {
    let lies_across = (page.x < page.y) != (paper.size[0] < paper.size[1]);
    let mut at = if lies_across { DVec2::new(point.y, page.x - point.x) } else { point };
    if paper.turned {
        at = DVec2::from(paper.size) - at;
    }
    DVec2::new(at.x - paper.origin[0], paper.origin[1] - at.y) / device.unit
}

/// Every stroke of the SVG is a stroke of the plot, point for point.
fn compare(plot: &Plot, svg: &str, place: impl Fn(DVec2) -> DVec2, worst: f64) {
    let strokes = svg_strokes(svg);
    assert_eq!(plot.len(), strokes.len());
    for ((_, points), stroke) in plot.iter().zip(&strokes) {
        assert_eq!(points.len(), stroke.len());
        for (point, other) in points.iter().zip(stroke) {
            let apart = DVec2::new(point[0] as f64, point[1] as f64) - place(*other);
            assert!(apart.abs().max_element() <= worst, "{point:?} is not {other}");
        }
    }
}

#[test]
fn every_plotter_draws_what_the_svg_shows_within_a_unit() {
    let mut turned = device("hp7475a");
    turned.papers.iter_mut().for_each(|paper| paper.turned = true);
    let all = ["hp7475a", "hp7550a", "hp7440a", "dxy"].map(device);
    for device in all.iter().chain([&turned]) {
        for paper in &device.papers {
            for [width, height] in [paper.size, [paper.size[1], paper.size[0]]] {
                for relative in [false, true] {
                    let drawing = page(width, height);
                    let options =
                        HpglOptions { device: device.clone(), relative, velocity: Some(10.0) };
                    let text = to_hpgl_with(&drawing, &options).unwrap();
                    let plot = plot(&text, limits(device, paper)).unwrap();
                    let svg = to_svg(&drawing, &SvgOptions::default()).unwrap();
                    let place = |point| units(device, paper, drawing.size, point);
                    // Half a unit of rounding here, half a micron there.
                    compare(&plot, &svg, place, 0.55);
                }
            }
        }
    }
}

#[test]
fn what_is_out_of_reach_is_refused_with_the_numbers_or_cut() {
    let device = device("hp7475a");
    let options = DrawingOptions {
        paper: Paper::A4,
        margin: Length::new(2.0).unwrap(),
        ..DrawingOptions::default()
    };
    let mut drawing = Drawing::new(&cube(), &options).unwrap();
    let window = plotter_window(&device, drawing.size).unwrap();
    let options = HpglOptions { device: device.clone(), ..HpglOptions::default() };
    let error = to_hpgl_with(&drawing, &options).unwrap_err();
    let message = error.to_string();
    assert!(matches!(error, ExportError::PlotterLimits(_)));
    for words in ["A4", "HP 7475A", "x 0 to 11040 and y 0 to 7721", "4.00,10.00 to 196.10,284.68"] {
        assert!(message.contains(words), "{words} in {message}");
    }
    drawing.cut(&window);
    let text = to_hpgl_with(&drawing, &options).unwrap();
    let plot = plot(&text, limits(&device, &device.papers[0])).unwrap();
    let farthest = |axis: usize| plot.iter().flat_map(|s| &s.1).map(|p| p[axis]).max();
    assert_eq!(farthest(1), Some(7721), "cut at the limit itself");
}

#[test]
fn papers_and_speeds_that_a_plotter_has_not_are_refused() {
    let a5 = page(148.0, 210.0);
    let options = HpglOptions { device: device("hp7440a"), ..HpglOptions::default() };
    let message = to_hpgl_with(&a5, &options).unwrap_err().to_string();
    assert!(message.contains("148 x 210") && message.contains("expected one of A4"), "{message}");
    let fast = HpglOptions { velocity: Some(50.0), ..options };
    let message = to_hpgl_with(&page(210.0, 297.0), &fast).unwrap_err().to_string();
    assert!(message.contains("50 cm/s") && message.contains("1 to 40"), "{message}");
}

#[test]
fn hp2xx_reads_every_instruction() {
    let folder = tempfile::tempdir().unwrap();
    for relative in [false, true] {
        let options = HpglOptions { device: device("hp7550a"), relative, velocity: None };
        let text = to_hpgl_with(&page(420.0, 297.0), &options).unwrap();
        let file = folder.path().join("drawing.hpgl");
        std::fs::write(&file, &text).unwrap();
        let mut command = Command::new("hp2xx");
        command.args(["-N", "-t", "-m", "svg", "-f"]).arg(folder.path().join("out.svg")).arg(&file);
        let Ok(output) = command.output() else {
            println!("skipped: hp2xx is not installed");
            return;
        };
        let log = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{log}");
        let number = |name: &str| {
            let line = log.lines().find(|line| line.contains(name)).unwrap_or("");
            line.split_whitespace().last().and_then(|word| word.parse::<u32>().ok())
        };
        assert_eq!(number("HPGL command(s) ignored"), Some(0), "{log}");
        assert_eq!(number("Unexpected event"), Some(0), "{log}");
        let instructions = text.lines().count() as u32;
        assert!(number("HPGL commands read").is_some_and(|read| read <= instructions), "{log}");
    }
}

#[test]
fn vpype_makes_the_same_plot_of_the_svg() {
    let folder = tempfile::tempdir().unwrap();
    let [svg, hpgl] = ["a.svg", "a.hpgl"].map(|name| folder.path().join(name));
    let program = std::env::var("UMRISS_VPYPE").unwrap_or_else(|_| "vpype".to_owned());
    for (name, landscape) in [("hp7475a", true), ("hp7475a", false), ("dxy", true)] {
        let device = device(name);
        let (width, height) = if landscape { (297.0, 210.0) } else { (210.0, 297.0) };
        let drawing = page(width, height);
        std::fs::write(&svg, to_svg(&drawing, &SvgOptions::default()).unwrap()).unwrap();
        let mut command = Command::new(&program);
        command.arg("read").arg(&svg).args(["write", "-q", "--absolute", "-d", name, "-p", "a4"]);
        command.args(landscape.then_some("-l")).arg(&hpgl);
        let Ok(output) = command.output() else {
            println!("skipped: vpype is not installed");
            return;
        };
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let theirs = std::fs::read_to_string(&hpgl).unwrap();
        let mut theirs: Vec<Vec<[i64; 2]>> = theirs
            .split("PU")
            .filter_map(|stroke| stroke.split_once(";PD"))
            .map(|(start, rest)| {
                let numbers = format!("{start},{}", rest.split(';').next().unwrap());
                let numbers: Vec<i64> = numbers.split(',').map(|n| n.parse().unwrap()).collect();
                numbers.chunks(2).map(|pair| [pair[0], pair[1]]).collect()
            })
            .collect();
        let options = HpglOptions { device: device.clone(), ..HpglOptions::default() };
        let text = to_hpgl_with(&drawing, &options).unwrap();
        let ours = plot(&text, limits(&device, &device.papers[0])).unwrap();
        // vpype draws its layers in the order of their numbers.
        let mut ours: Vec<_> = ours.into_iter().map(|stroke| stroke.1).collect();
        ours.sort();
        theirs.sort();
        assert_eq!(ours.len(), theirs.len());
        let apart = |a: &[i64; 2], b: &[i64; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
        for (one, other) in ours.iter().zip(&theirs) {
            assert_eq!(one.len(), other.len());
            assert!(one.iter().zip(other).all(|(a, b)| apart(a, b) <= 1), "{one:?} {other:?}");
        }
    }
}
