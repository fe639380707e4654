//! What the fuzz targets feed to the library beside files, and what has to
//! hold then. The seeds are fed to the same functions by ordinary tests.

use glam::{DVec2, DVec3};
use umriss::drawing::{Content, Drawing, DrawingOptions, Styles, SurfaceOptions};
use umriss::export::{
    ShapeFormat, ShapeOptions, SvgOptions, read_drawing_with_notes, to_hpgl, to_json_with_notes,
    to_svg,
};
use umriss::kernel::predicates::{Exact, Thorough};
use umriss::model::import::{HeightFormat, read_heights_bytes};
use umriss::model::surface::{CurveOptions, SurfaceWithHoles};
use umriss::model::{Camera, FeatureOptions, LineClass, Mesh, Soup, View};
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};
use umriss::run::Run;
use umriss::verify::{
    PaintVerifyOptions, RegionVerifyOptions, VerifyOptions, verify, verify_painting, verify_regions,
};
use umriss::view::{Culling, ExactLines, ImageRegions, ObjectWish, PreparedView, Skips};
use umriss::visibility::{AppelOptions, appel, reduce};

/// Triangles beyond this number would be slow, not telling.
const MOST: usize = 24;

/// Bytes as small numbers.
struct Numbers<'b>(std::slice::Iter<'b, u8>);

impl Numbers<'_> {
    /// A number below `bound`, as long as there are bytes.
    fn below(&mut self, bound: u8) -> Option<u8> {
        self.0.next().map(|byte| byte % bound)
    }

    /// A float of eight bytes, if it is finite.
    fn float(&mut self) -> Option<f64> {
        let mut bytes = [0; 8];
        for byte in &mut bytes {
            *byte = *self.0.next()?;
        }
        let number = f64::from_le_bytes(bytes);
        Some(if number.is_finite() { number } else { 0.0 })
    }
}

/// Two shapes of rings on a small grid, which meet in every way: areas of all
/// operations fit together, exactly, and what is rounded is rounded again to
/// itself.
pub(crate) fn clipping(bytes: &[u8]) {
    let mut numbers = Numbers(bytes.iter());
    let mut shape = || {
        let rule = FillRule::ALL[usize::from(numbers.below(5)?)];
        let mut rings = Vec::new();
        for _ in 0..=numbers.below(3)? {
            let mut ring = Vec::new();
            for _ in 0..3 + numbers.below(6)? {
                ring.push(DVec2::new(numbers.below(9)?.into(), numbers.below(9)?.into()));
            }
            rings.push(ring);
        }
        PlaneShape::new(&[rings], rule).ok()
    };
    let (Some(a), Some(b)) = (shape(), shape()) else { return };
    let area = |operation| {
        let result = PlaneShape::operation(operation, &[&a, &b]).expect("few corners");
        let rounded = result.rounded().expect("few corners");
        let again = PlaneShape::new(&rounded.polygons, FillRule::Polygons).expect("finite corners");
        let twice = again.rounded().expect("few corners");
        let corners = |polygons: &[Vec<Vec<DVec2>>]| polygons.iter().flatten().flatten().count();
        assert_eq!(corners(&twice.polygons), corners(&rounded.polygons));
        result.area()
    };
    let [common, either, first, one] = Operation::ALL.map(area);
    let whole = |shape: &PlaneShape| shape.normalized(false).expect("few corners").area();
    assert_eq!(common.clone() + either.clone(), whole(&a) + whole(&b));
    assert_eq!(common.clone() + first, whole(&a));
    assert_eq!(common + one, either);
}

/// Corners beyond this number would be slow, not telling.
const MOST_CORNERS: usize = 4000;

/// Any bytes as a file of polygons: refused with words, or read; what is
/// written of it is read again as the same.
pub(crate) fn shapes(bytes: &[u8]) {
    let is_json = bytes.trim_ascii_start().starts_with(b"{");
    let format = if is_json { ShapeFormat::GeoJson } else { ShapeFormat::Svg };
    let options = ShapeOptions { flatness: 0.5, ..ShapeOptions::default() };
    let file = match format.read_with(bytes, &options) {
        Ok(file) => file,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return;
        }
    };
    let corners = file.parts.iter().flat_map(|part| part.polygons.iter().flatten().flatten());
    if MOST_CORNERS < corners.clone().count() || MOST_CORNERS < file.parts.len() * 16 {
        return;
    }
    assert!(corners.into_iter().all(|corner| corner.is_finite()));
    let Ok(rounded) = file.shape(None).and_then(|shape| shape.rounded()) else { return };
    for format in [ShapeFormat::GeoJson, ShapeFormat::Svg] {
        let text = format.write_on(&rounded, file.page).expect("both formats are built in");
        let again = format.read(text.as_bytes()).expect("what was written can be read");
        let same = again.shape(None).and_then(|shape| shape.rounded()).expect("few corners");
        assert_eq!(same.polygons, rounded.polygons, "{text}");
    }
}

/// Any bytes as a grid of heights: refused with a place, or a sound grid, and a
/// sound model of it, whatever is missing.
pub(crate) fn heights(bytes: &[u8]) {
    for format in [None, Some(HeightFormat::Csv), Some(HeightFormat::Esri)] {
        let Ok(found) = read_heights_bytes("seed", bytes, format) else { continue };
        let heights = found.heights;
        assert_eq!(heights.values().len(), heights.xs().len() * heights.zs().len());
        assert!(heights.xs().is_sorted() && heights.zs().is_sorted());
        if let Some((factor, latitude)) = heights.z_factor_of_degrees() {
            assert!(factor > 0.0 && latitude.abs() <= 90.0, "{factor} {latitude}");
        }
        let Ok(surface) = SurfaceWithHoles::new(heights, None) else { continue };
        let (soup, _) = surface.soups("seed", &CurveOptions::default());
        assert!(soup.vertices.iter().all(|vertex| vertex.is_finite()));
        assert!(Mesh::new(vec![soup], None).is_ok());
    }
}

/// Some triangles and an eye, from `number`.
fn scene<'b>(
    numbers: &mut Numbers<'b>,
    number: impl Fn(&mut Numbers<'b>) -> Option<f64>,
) -> Option<(Mesh, Camera)> {
    let is_central = numbers.below(2)? == 1;
    let mut point = || Some(DVec3::new(number(numbers)?, number(numbers)?, number(numbers)?));
    let eye = point()?;
    let mut corners = Vec::new();
    while let Some(corner) = point() {
        corners.push(corner);
    }
    let count = (corners.len() / 3).min(MOST);
    let mut soup = Soup { vertices: corners[..3 * count].to_vec(), ..Soup::default() };
    (0..count as u32).for_each(|i| soup.faces.push(&[3 * i, 3 * i + 1, 3 * i + 2], []));
    let mesh = Mesh::new(vec![soup], None).ok()?;
    let forward = eye - DVec3::splat(4.0);
    let up = if forward.x == 0.0 && forward.y == 0.0 { DVec3::Y } else { DVec3::Z };
    let camera = match is_central {
        false => Camera::Orthographic { forward, target: None, up },
        true => {
            let near = Some(0.25);
            Camera::Perspective { eye, target: None, up: DVec3::Z, near, fov_y_degrees: 60.0 }
        }
    };
    Some((mesh, camera))
}

/// Triangles on a small grid, where nearly everything is degenerate: Appel's
/// answer is Roberts', regions are the images, painting orders are right.
pub(crate) fn visibility(bytes: &[u8]) {
    let mut numbers = Numbers(bytes.iter());
    let Some((mesh, camera)) = scene(&mut numbers, |numbers| Some(numbers.below(9)?.into())) else {
        return;
    };
    let Ok(view) = camera.view(mesh.bounds()) else { return };
    let (run, options) = (Run::default(), FeatureOptions::default().with_classes(&LineClass::ALL));
    let prepared = PreparedView::new::<Exact>(&mesh, &view, &options, &run).expect("not cancelled");
    let question = prepared.question(true);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).expect("not cancelled");
    let visible = visible_alone(&mesh, &view, options, &run);
    let pieces = (0..answer.len()).flat_map(|line| answer.line(line));
    let shown = pieces.filter(|piece| piece.invisibility == 0);
    assert!(shown.eq((0..visible.len()).flat_map(|line| visible.line(line))), "culled otherwise");
    let options = VerifyOptions { image_size: 16, ..VerifyOptions::default() };
    let lines = verify::<Exact>(&view, &question, &answer, &options, &run).expect("a report");
    assert!(lines.is_clean(), "{lines}");
    let options = RegionVerifyOptions { image_size: 16, ..RegionVerifyOptions::default() };
    let regions = verify_regions::<Exact>(&view, &question, &answer, &options, &run);
    let regions = regions.expect("a report");
    assert!(regions.is_clean(), "{regions}");
    let options = PaintVerifyOptions { image_size: 16, ..PaintVerifyOptions::default() };
    let painting = verify_painting::<Exact>(&view, &question, &options, &run).expect("a report");
    assert!(painting.is_clean(), "{painting}");
}

/// The visible pieces, with everything left out that may be.
fn visible_alone(mesh: &Mesh, view: &View, features: FeatureOptions, run: &Run) -> ExactLines {
    let wishes = vec![ObjectWish { features, see_through: false }; mesh.objects().len()];
    let skips = Skips { culling: Culling::Always, ..Skips::default() };
    let prepared = PreparedView::for_visible_lines::<Exact>(mesh, view, &wishes, &skips, run)
        .expect("not cancelled");
    let options = AppelOptions { skips, ..AppelOptions::default() };
    appel::<Exact>(&prepared.question(false), &options, run).expect("not cancelled")
}

/// Triangles with any numbers as coordinates: all steps of the ladder that are
/// sound agree about every decision of a drawing.
pub(crate) fn predicates(bytes: &[u8]) {
    let mut numbers = Numbers(bytes.iter());
    let Some((mesh, camera)) = scene(&mut numbers, Numbers::float) else { return };
    let Ok(view) = camera.view(mesh.bounds()) else { return };
    let (run, options) = (Run::default(), FeatureOptions::default().with_classes(&LineClass::ALL));
    let prepared =
        PreparedView::new::<Thorough>(&mesh, &view, &options, &run).expect("not cancelled");
    let question = prepared.question(true);
    let answer =
        appel::<Thorough>(&question, &AppelOptions::default(), &run).expect("not cancelled");
    reduce::<Thorough>(&question, &answer, &run).expect("not cancelled");
    assert_eq!(run.counters().get("ladder-disagreements"), 0);
}

/// Any bytes as a JSON drawing: refused, or drawn again, and what is written
/// is read again as the same.
pub(crate) fn restyle(bytes: &[u8]) {
    let Ok((lines, notes)) = read_drawing_with_notes(bytes) else { return };
    let written = to_json_with_notes(&lines, &notes).expect("what was read can be written");
    let (again, same) = read_drawing_with_notes(&written).expect("what was written can be read");
    assert_eq!((&again.pieces, &same), (&lines.pieces, &notes));
    let regions = ImageRegions::default();
    let crossings = notes.crossings.as_deref().unwrap_or_default();
    let content = Content { lines: &lines, crossings, regions: &regions };
    let halo = "1mm".parse().expect("a length");
    let options = DrawingOptions { halo, ..DrawingOptions::default() };
    let drawing = Drawing::of(&content, &options, &Styles::default(), &SurfaceOptions::default());
    let Ok(drawing) = drawing else { return };
    for text in [to_svg(&drawing, &SvgOptions::default()), to_hpgl(&drawing)].into_iter().flatten()
    {
        assert!(!text.contains("NaN") && !text.contains("inf"), "a number that is none");
    }
}
