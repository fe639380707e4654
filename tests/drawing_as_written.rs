//! The drawing as it was written: the SVG, rendered by another program,
//! against an image of nearest triangles on the same grid.
//!
//! The page is rendered to pixels, and rays are cast through the very same
//! pixels. Then three things must hold.
//!
//! 1. Where there is ink, the image has an edge: two different triangles, or
//!    a triangle and none, within two pixels.
//! 2. Where the image has an edge that has to be drawn, there is ink: an
//!    outline, a gap in depth, or a fold well above the crease angle.
//! 3. Along every visible line the image is not nearer than the line, and
//!    there is ink; along every hidden one it is nearer.
//!
//! So an exporter that turns the page over, moves a layer, rounds too much
//! or loses a stroke is found, and mistakes of that kind are made here on
//! purpose to see them found.

#![cfg(feature = "png")]
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use glam::{DVec2, DVec3};
use resvg::tiny_skia::Pixmap;
use umriss::drawing::{Drawing, DrawingOptions, Length, Paper};
use umriss::export::{SvgOptions, to_png, to_svg};
use umriss::kernel::predicates::{Exact, Eye};
use umriss::model::{Camera, FeatureOptions, Mesh, StandardView, View, import};
use umriss::raster::{ItemBuffer, Samples, ray_cast};
use umriss::run::Run;
use umriss::view::{LineQuestion, PreparedView, VisibleLines};
use umriss::visibility::{AppelOptions, appel, reduce};

/// Pixels along the square page, and per millimetre.
const PIXELS: u32 = 480;
const PER_MILLIMETRE: f64 = 4.0;

/// Angles between planes that must be drawn; the crease angle is 30 degrees.
const FOLD: f64 = 40.0;

/// A scene, its drawing and the image on the drawing's pixels.
struct Seen {
    mesh: Mesh,
    view: View,
    samples: Samples,
    buffer: ItemBuffer,
    lines: VisibleLines,
    /// Of the view frame, in the centre of the page.
    centre: DVec2,
    pixel: f64,
    svg: String,
}

/// Disagreements of the three kinds.
#[derive(Debug, PartialEq, Eq, Default)]
struct Wrong {
    ink_without_edge: usize,
    edge_without_ink: usize,
    depth: usize,
}

fn see(model: &str, camera: &Camera) -> Seen {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/");
    let file = format!("{folder}{model}.obj");
    let soups = import::read_file(file.as_ref(), None).unwrap().objects;
    let mesh = Mesh::new(soups, None).unwrap();
    let run = Run::default();
    let view = camera.view(mesh.bounds()).unwrap();
    let prepared =
        PreparedView::new::<Exact>(&mesh, &view, &FeatureOptions::default(), &run).unwrap();
    let question = prepared.question(true);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).unwrap();
    let lines = reduce::<Exact>(&question, &answer, &run).unwrap();
    let side = f64::from(PIXELS) / PER_MILLIMETRE;
    let options = DrawingOptions {
        paper: Paper::Sheet { width: side, height: side },
        margin: Length::new(5.0).unwrap(),
        visible_width: 1.0 / PER_MILLIMETRE,
        ..DrawingOptions::default()
    };
    let drawing = Drawing::new(&lines, &options).unwrap();
    let svg = to_svg(&drawing, &SvgOptions::default()).unwrap();
    let points = lines.pieces.iter().filter(|piece| piece.is_visible()).flat_map(|p| p.points);
    let far = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = points.fold(far, |(low, high), p| (low.min(p), high.max(p)));
    let (centre, pixel) = ((low + high) / 2.0, 1.0 / (drawing.scale * PER_MILLIMETRE));
    let deepest = depths(&question, &mesh).fold(0.0, f64::max);
    let samples = Samples::about(&view.frame, centre, pixel, [PIXELS; 2], deepest);
    let buffer = ray_cast::<Exact>(&view, &question, &samples, &run).unwrap();
    Seen { view, samples, buffer, lines, centre, pixel, svg, mesh: mesh.clone() }
}

fn depths(question: &LineQuestion, mesh: &Mesh) -> impl Iterator<Item = f64> {
    let depths: Vec<f64> =
        (0..mesh.vertices().len() as u32).map(|v| question.coordinates.point(v).z).collect();
    depths.into_iter()
}

/// A rendered page: how dark each pixel is.
struct Ink(Vec<u8>);

impl Ink {
    fn of(svg: &str) -> Self {
        let png = to_png(svg, PIXELS).unwrap();
        let picture = Pixmap::decode_png(&png).unwrap();
        assert_eq!([picture.width(), picture.height()], [PIXELS; 2]);
        Ink(picture.pixels().iter().map(|pixel| 255 - pixel.red()).collect())
    }

    fn at(&self, [column, row]: [i64; 2]) -> u8 {
        let size = i64::from(PIXELS);
        let inside = (0..size).contains(&column) && (0..size).contains(&row);
        if inside { self.0[(row * size + column) as usize] } else { 0 }
    }

    /// The darkest pixel around another.
    fn near(&self, at: [i64; 2], reach: i64) -> u8 {
        around(at, reach).map(|at| self.at(at)).max().unwrap()
    }
}

/// The pixels of a square around one.
fn around([column, row]: [i64; 2], reach: i64) -> impl Iterator<Item = [i64; 2]> {
    let range = move || -reach..=reach;
    range().flat_map(move |y| range().map(move |x| [column + x, row + y]))
}

impl Seen {
    fn item(&self, [column, row]: [i64; 2]) -> Option<u32> {
        let inside = |x: i64| u32::try_from(x).ok();
        self.buffer.item(inside(column)?, inside(row)?)
    }

    fn depth(&self, [column, row]: [i64; 2]) -> f64 {
        match (u32::try_from(column), u32::try_from(row)) {
            (Ok(column), Ok(row)) => self.buffer.depth(column, row),
            _ => f64::INFINITY,
        }
    }

    fn normal(&self, triangle: u32) -> DVec3 {
        let [a, b, c] =
            self.mesh.triangles()[triangle as usize].map(|v| self.mesh.vertices()[v as usize]);
        (b - a).cross(c - a).normalize()
    }

    /// Depth at which the ray of a pixel meets the plane of a triangle.
    fn plane_depth(&self, triangle: u32, [column, row]: [i64; 2]) -> f64 {
        let a = self.mesh.vertices()[self.mesh.triangles()[triangle as usize][0] as usize];
        let x = self.samples.point(column as u32, row as u32);
        let ray = match self.view.eye {
            Eye::At(eye) => eye - x,
            Eye::Towards(direction) => direction,
        };
        let normal = self.normal(triangle);
        let along = normal.dot(a - x) / normal.dot(ray);
        self.view.frame.depth(x + ray * along)
    }

    /// World length of a pixel at a depth.
    fn step(&self, depth: f64) -> f64 {
        if self.view.eye.is_perspective() { self.pixel * depth } else { self.pixel }
    }

    /// Whether the border between two neighbours has to be drawn.
    fn must_be_drawn(&self, one: [i64; 2], other: [i64; 2]) -> bool {
        let (a, b) = match (self.item(one), self.item(other)) {
            (Some(a), Some(b)) => (a, b),
            (a, b) => return a != b,
        };
        if a == b {
            return false;
        }
        let corners = |triangle: u32| self.mesh.triangles()[triangle as usize];
        let common = corners(a).iter().filter(|v| corners(b).contains(v)).count();
        let fold = self.normal(a).dot(self.normal(b)).abs() < FOLD.to_radians().cos();
        let gap = (self.plane_depth(a, other) - self.depth(other)).abs();
        let apart = common < 2 && gap > 8.0 * self.step(self.depth(other));
        // Folds of neighbours: unoriented, so only those that both show.
        (fold && (common == 2 || gap < self.step(self.depth(other)))) || apart
    }

    fn check(&self, svg: &str) -> Wrong {
        let ink = Ink::of(svg);
        let mut wrong = Wrong::default();
        let size = i64::from(PIXELS);
        for at in (0..size).flat_map(|row| (0..size).map(move |column| [column, row])) {
            if ink.at(at) > 128 {
                let changes = around(at, 2).any(|near| self.item(near) != self.item(at));
                wrong.ink_without_edge += usize::from(!changes);
            }
            for next in [[at[0] + 1, at[1]], [at[0], at[1] + 1]] {
                let inside = next[0] < size && next[1] < size;
                if inside && self.must_be_drawn(at, next) && ink.near(at, 2) < 64 {
                    wrong.edge_without_ink += 1;
                }
            }
        }
        wrong.depth = self.lines.pieces.iter().map(|piece| self.along(piece, &ink)).sum();
        wrong
    }

    /// Points of a line at which the image or the ink contradicts it.
    fn along(&self, piece: &umriss::view::LinePiece, ink: &Ink) -> usize {
        let place = |point: DVec2| {
            (point - self.centre) / self.pixel * DVec2::new(1.0, -1.0) + f64::from(PIXELS) / 2.0
        };
        let [start, end] = piece.points.map(place);
        let length = start.distance(end);
        let steps = (length - 6.0).max(0.0) as u32;
        let mut wrong = 0;
        for i in 0..steps {
            // Not within three pixels of an end, where other lines are.
            let t = (3.0 + f64::from(i)) / length;
            let point = start.lerp(end, t);
            let at = [point.x.floor() as i64, point.y.floor() as i64];
            let [near, far] = piece.depth;
            // Of points along an image line the reciprocals are linear.
            let depth = if self.view.eye.is_perspective() {
                1.0 / ((1.0 - t) / near + t / far)
            } else {
                near + (far - near) * t
            };
            let slack = 8.0 * self.step(depth);
            let deepest = around(at, 1).map(|p| self.depth(p)).fold(0.0, f64::max);
            let nearest = around(at, 1).map(|p| self.depth(p)).fold(f64::INFINITY, f64::min);
            wrong += usize::from(if piece.is_visible() {
                deepest < depth - slack || ink.near(at, 1) < 64
            } else {
                nearest > depth + slack
            });
        }
        wrong
    }
}

fn iso() -> Camera {
    Camera::Standard(StandardView::from_name("iso").unwrap())
}

fn from(eye: DVec3, target: DVec3) -> Camera {
    let target = Some(target);
    Camera::Perspective { eye, target, up: DVec3::Z, near: None, fov_y_degrees: 60.0 }
}

#[test]
fn drawings_show_what_rays_see() {
    let at = DVec3::new;
    let along = |forward| Camera::Orthographic { forward, target: None, up: DVec3::Z };
    let views = [
        ("two_cubes_interpenetrating", iso()),
        ("two_cubes_interpenetrating", along(at(-0.3, 1.0, -0.45))),
        ("house_groups", iso()),
        ("staircase", along(at(-0.5, 0.9, -0.7))),
        ("gear64", iso()),
        ("cube_hole", along(at(-0.8, 0.6, -0.5))),
        ("menger_2", from(at(16.0, -11.0, 13.0), at(4.5, 4.5, 4.2))),
        ("stair_boxes_touching", along(at(0.4, 0.9, -0.6))),
    ];
    for (model, camera) in views {
        let seen = see(model, &camera);
        let wrong = seen.check(&seen.svg);
        println!("{model}: {} pieces, {wrong:?}", seen.lines.pieces.len());
        if let Some(folder) = std::env::var_os("UMRISS_PICTURES") {
            let file = std::path::Path::new(&folder).join(format!("{model}.png"));
            std::fs::write(file, to_png(&seen.svg, PIXELS).unwrap()).unwrap();
        }
        assert_eq!(wrong, Wrong::default(), "{model}");
    }
}

#[test]
fn mistakes_of_an_exporter_are_found() {
    let seen = see("two_cubes_interpenetrating", &iso());
    let page = f64::from(PIXELS) / PER_MILLIMETRE;
    let turned =
        seen.svg.replace("<path ", &format!("<path transform='translate(0 {page}) scale(1 -1)' "));
    let moved = seen.svg.replace("<path ", "<path transform='translate(1.5 0)' ");
    let start = seen.svg.find(" d=\"").unwrap() + 4;
    let end = start + seen.svg[start..].find('"').unwrap();
    let strokes = &seen.svg[start..end];
    let second = strokes[1..].find('M').unwrap() + 1;
    let lost = seen.svg.replace(strokes, &strokes[second..]);
    let added = seen.svg.replace(strokes, &format!("{strokes}M40 60L80 62"));
    for (name, svg) in [("turned", turned), ("moved", moved), ("lost", lost), ("added", added)] {
        let wrong = seen.check(&svg);
        println!("{name}: {wrong:?}");
        assert!(wrong != Wrong::default(), "{name}");
    }
}
