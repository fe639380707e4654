//! The painted page itself: what lies on top at a place of it is what a ray
//! through that place meets first, whatever the frame, the windings, the
//! bends of faces and the near plane.
//!
//! Places beside a border are left out, for the page is rounded.

use crate::soups::{camera, face};
use crate::{above, painted, with_question};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use umriss::drawing::{
    Drawing, DrawingError, DrawingOptions, Fill, Styles, SurfaceOptions, Window,
};
use umriss::kernel::predicates::Exact;
use umriss::model::{Camera, Color, Mesh, Soup};
use umriss::raster::{Samples, ray_cast};
use umriss::run::Run;
use umriss::view::{ImageRegions, LineQuestion};
use umriss::visibility::{Painter, RegionOptions, image_regions, painted_image, visible_regions};

/// How near to a border nothing is asked, millimetres.
const BESIDE: f64 = 1e-6;

/// A colour for each face, of which no two are alike.
fn color(face: u32) -> Color {
    Color([7, (face / 200) as u8, (face % 200) as u8])
}

/// A mesh of faces with corners of their own, each in its own colour; in two
/// objects, so that faces of both may lie in one plane.
fn colored(faces: &[Vec<[f64; 3]>]) -> Option<Mesh> {
    let mut soups = vec![Soup::default(), Soup::default()];
    for (i, face) in faces.iter().enumerate() {
        let soup = &mut soups[i % 2];
        let first = soup.vertices.len() as u32;
        soup.vertices.extend(face.iter().map(|&corner| DVec3::from_array(corner)));
        let ring: Vec<u32> = (first..soup.vertices.len() as u32).collect();
        soup.faces.push(&ring, []);
        soup.colors.get_or_insert_default().push(Some(color(i as u32)));
    }
    soups.retain(|soup| !soup.vertices.is_empty());
    soups.iter_mut().zip(0..).for_each(|(soup, i)| soup.name = format!("o{i}"));
    Mesh::new(soups, None).ok()
}

/// Areas of a page from bottom to top.
struct Page {
    areas: Vec<(Color, Vec<Vec<DVec2>>)>,
    size: DVec2,
    scale: f64,
}

impl Page {
    fn of(drawing: Drawing) -> Self {
        let painted = drawing.painting.into_iter().map(|shape| (shape.color, shape.rings));
        let filled = drawing.fills.into_iter().map(|shape| (shape.color, shape.rings));
        let areas = painted.chain(filled).collect();
        Page { areas, size: drawing.size, scale: drawing.scale }
    }

    /// What lies on top at a place; nothing if that is beside a border.
    fn top(&self, place: DVec2) -> Option<Option<Color>> {
        let mut top = None;
        for (color, rings) in &self.areas {
            let mut turns = 0;
            for ring in rings {
                for (i, &from) in ring.iter().enumerate() {
                    let to = ring[(i + 1) % ring.len()];
                    if distance(place, [from, to]) < BESIDE {
                        return None;
                    }
                    let left = (to - from).perp_dot(place - from);
                    if from.y <= place.y && place.y < to.y && 0.0 < left {
                        turns += 1;
                    } else if to.y <= place.y && place.y < from.y && left < 0.0 {
                        turns -= 1;
                    }
                }
            }
            if turns != 0 {
                top = Some(*color);
            }
        }
        Some(top)
    }
}

fn distance(point: DVec2, [from, to]: [DVec2; 2]) -> f64 {
    let along = to - from;
    let share = (point - from).dot(along) / along.length_squared();
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
    point.distance(from.lerp(to, share))
}

fn options(window: Window) -> DrawingOptions {
    DrawingOptions { window: Some(window), ..DrawingOptions::default() }
}

const FLAT: SurfaceOptions = SurfaceOptions { fill: Fill::Flat, hatch: None, light: None };

/// The page of a painter, or of what is seen of each face if there is none.
fn page(
    question: &LineQuestion<'_>,
    painter: Option<Painter>,
    window: Window,
) -> Result<Drawing, DrawingError> {
    let (options, styles) = (options(window), Styles::default());
    if let Some(painter) = painter {
        let (order, _) = painted(question, painter);
        let (faces, lines) = painted_image(question, &order).unwrap();
        return Drawing::painted(&faces, &lines, &options, &styles, &FLAT);
    }
    let run = Run::default();
    let regions = visible_regions::<Exact>(question, &RegionOptions::default(), &run).unwrap();
    let regions: ImageRegions = image_regions(question, &regions).unwrap();
    let answer = umriss::visibility::appel::<Exact>(question, &Default::default(), &run).unwrap();
    let lines = umriss::visibility::reduce::<Exact>(question, &answer, &run).unwrap();
    Drawing::with_regions(&lines, &regions, &FLAT, &options)
}

/// Holds the page against rays; returns how many places were compared.
fn compare(mesh: &Mesh, camera: &Camera, window: Window, painter: Option<Painter>) -> usize {
    let view = camera.view(mesh.bounds()).unwrap();
    with_question(mesh, camera, |question| {
        let extent = window.high() - window.low();
        let centre = (window.low() + window.high()) * 0.5;
        let pixel = extent.max_element() / 23.5;
        let samples = Samples::about(&view.frame, centre, pixel, [24, 24], 1.0);
        let rays = ray_cast::<Exact>(&view, question, &samples, &Run::default()).unwrap();
        let page = match page(question, painter, window) {
            Ok(drawing) => Page::of(drawing),
            // Nothing on it, so nothing has to be seen.
            Err(DrawingError::EmptyWindow { .. }) => {
                Page { areas: Vec::new(), size: DVec2::ONE, scale: 1.0 }
            }
            Err(other) => panic!("{other}"),
        };
        let mut compared = 0;
        for (column, row) in (0..24).flat_map(|row| (0..24).map(move |column| (column, row))) {
            let sample = question.frame.coordinates(samples.point(column, row));
            let place = question.coordinates.project(sample).0;
            let inside = (place - window.low()).min(window.high() - place).min_element();
            if inside * page.scale < BESIDE {
                continue;
            }
            let offset = (place - centre) * page.scale;
            let place = page.size * 0.5 + DVec2::new(offset.x, -offset.y);
            let Some(top) = page.top(place) else { continue };
            let seen = rays.item(column, row).and_then(|t| mesh.color_of(mesh.face_of(t)));
            assert_eq!(top, seen, "{painter:?} at column {column}, row {row} of {window:?}");
            compared += 1;
        }
        compared
    })
}

/// Faces of all kinds: those of the other soups, turned around, and bent ones,
/// of which a corner is lifted off the plane.
fn any_face() -> impl Strategy<Value = Vec<[f64; 3]>> {
    (face(), any::<bool>(), prop::option::of((0..8_usize, prop::sample::select(vec![-1.0, 1.0]))))
        .prop_map(|(mut face, turned, lifted)| {
            if let Some((corner, by)) = lifted {
                let [a, b, c] = [face[0], face[1], face[face.len() - 1]].map(DVec3::from_array);
                let (corner, up) = (corner % face.len(), (b - a).cross(c - a) * by * 0.0625);
                face[corner] = (DVec3::from_array(face[corner]) + up).to_array();
            }
            if turned {
                face.reverse();
            }
            face
        })
}

/// A part of the picture on a grid that the scenes do not have, or all of it.
fn window() -> impl Strategy<Value = Window> {
    let window = |low: [f64; 2], extent: [f64; 2]| {
        let low = DVec2::from_array(low);
        Window::new(low, low + DVec2::from_array(extent)).unwrap()
    };
    let part = (-50..40_i32, -50..40_i32, 1..50_i32, 1..50_i32).prop_map(move |(x, y, w, h)| {
        window([x, y].map(|x| f64::from(x) * 0.1), [w, h].map(|w| f64::from(w) * 0.1))
    });
    prop_oneof![3 => part, 1 => Just(window([-9.0, -9.0], [18.0, 18.0]))]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn the_page_shows_what_rays_meet_first(
        faces in prop::collection::vec(any_face(), 1..9),
        camera in camera(),
        window in window(),
    ) {
        let Some(mesh) = colored(&faces) else { return Ok(()) };
        for painter in Painter::ALL.map(Some).into_iter().chain([None]) {
            compare(&mesh, &camera, window, painter);
        }
    }
}

fn square(half: f64, height: f64) -> Vec<[f64; 3]> {
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
        .map(|[x, y]| [x * half, y * half, height])
        .into()
}

#[test]
fn a_frame_within_a_face_is_filled_whatever_its_winding() {
    let mut turned = square(1.0, 0.0);
    turned.reverse();
    let window = Window::new(DVec2::splat(-0.5), DVec2::splat(0.5)).unwrap();
    for face in [square(1.0, 0.0), turned] {
        let mesh = colored(&[face]).unwrap();
        for painter in Painter::ALL.map(Some).into_iter().chain([None]) {
            assert_eq!(compare(&mesh, &above(), window, painter), 24 * 24, "{painter:?}");
        }
    }
}

#[test]
fn a_frame_beside_everything_is_refused() {
    let mesh = colored(&[square(1.0, 0.0)]).unwrap();
    let window = Window::new(DVec2::splat(2.0), DVec2::splat(3.0)).unwrap();
    let refused = DrawingError::EmptyWindow { low: [-1.0; 2], high: [1.0; 2] };
    for painter in Painter::ALL.map(Some).into_iter().chain([None]) {
        let page = with_question(&mesh, &above(), |question| page(question, painter, window));
        assert_eq!(page.err(), Some(refused.clone()), "{painter:?}");
    }
}
