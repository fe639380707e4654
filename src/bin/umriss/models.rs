//! Reads what the command line names: models, or one computed drawing.

use crate::crossed_faces;
use crate::failure::Failure;
use crate::input::{STANDARD_INPUT, read_input};
use crate::model_flags::{AxisName, FileFlags, Heal, ModelFlags};
use crate::session::RunFlags;
use serde::Deserialize;
use std::path::{Path, PathBuf};
use umriss::export::{DrawingNotes, ExportError, read_drawing_with_notes};
use umriss::model::import::{
    Format, ImportOptions, Imported, line_of_face, read_bytes_within, read_file_within,
};
use umriss::model::{
    HealReport, MeshError, Scene, SceneOptions, Soup, TornBorders, Unit, torn_borders,
};
use umriss::run::Run;
use umriss::view::VisibleLines;

/// How far into a file the name of our own format is looked for where the
/// rest is no JSON.
const HEADER: usize = 256;

/// What the files are.
pub(crate) enum Subject {
    /// Models, as one scene.
    Scene(Box<Scene>),
    /// The lines of a drawing that was computed before, and its notes.
    Drawing(Box<(VisibleLines, DrawingNotes)>),
}

/// Reads models into one scene, or one JSON drawing.
pub(crate) fn read_subject(
    files: &[PathBuf],
    flags: &ModelFlags,
    select: Select<'_>,
    session: &RunFlags,
    run: &Run<'_>,
) -> Result<Subject, Failure> {
    let mut sources = sources(files, run)?;
    if flags.files.input_format.is_none()
        && let [source] = &mut *sources
        && let Some(drawing) = read_computed(source, run)?
    {
        return Ok(Subject::Drawing(Box::new(drawing)));
    }
    scene_of(&mut sources, flags, select, session, run).map(|scene| Subject::Scene(Box::new(scene)))
}

/// Reads models into one scene.
pub(crate) fn read_scene(
    files: &[PathBuf],
    flags: &ModelFlags,
    session: &RunFlags,
    run: &Run<'_>,
) -> Result<Scene, Failure> {
    read_selected(files, flags, &|_| Ok(()), session, run)
}

/// Reads models into one scene, some of their objects.
pub(crate) fn read_selected(
    files: &[PathBuf],
    flags: &ModelFlags,
    select: Select<'_>,
    session: &RunFlags,
    run: &Run<'_>,
) -> Result<Scene, Failure> {
    scene_of(&mut sources(files, run)?, flags, select, session, run)
}

/// Leaves out objects that are not wanted.
pub(crate) type Select<'a> = &'a dyn Fn(&mut Vec<Soup>) -> Result<(), Failure>;

/// A file of the command line, or standard input.
struct Source<'a> {
    /// Nothing for standard input.
    path: Option<&'a Path>,
    /// What can be read only once: standard input, or a pipe with a name.
    bytes: Option<Vec<u8>>,
}

impl Source<'_> {
    fn name(&self) -> String {
        self.path.map_or(STANDARD_INPUT.to_owned(), |path| path.display().to_string())
    }
}

fn sources<'a>(files: &'a [PathBuf], run: &Run<'_>) -> Result<Vec<Source<'a>>, Failure> {
    if files.iter().filter(|file| file.as_os_str() == "-").count() > 1 {
        return Err(Failure::usage("- is given twice, but standard input can be read only once"));
    }
    files.iter().map(|file| source(file, run)).collect()
}

fn source<'a>(file: &'a Path, run: &Run<'_>) -> Result<Source<'a>, Failure> {
    if file.as_os_str() != "-" {
        return Ok(Source { path: Some(file), bytes: None });
    }
    let bytes = run.stage("reading", 1, || read_input(None, run))?;
    Ok(Source { path: None, bytes: Some(bytes) })
}

/// The drawing in a source, if it is one.
fn read_computed(
    source: &mut Source<'_>,
    run: &Run<'_>,
) -> Result<Option<(VisibleLines, DrawingNotes)>, Failure> {
    if let Some(path) = source.path {
        if !path.extension().is_some_and(|word| word.eq_ignore_ascii_case("json")) {
            return Ok(None);
        }
        source.bytes = Some(run.stage("reading", 1, || read_input(Some(path), run))?);
    }
    let Some(bytes) = &source.bytes else { return Ok(None) };
    if !is_drawing(bytes) {
        // A file may be opened again, and knows what lies beside it.
        if source.path.is_some_and(Path::is_file) {
            run.give_back(bytes.capacity() as u64);
            source.bytes = None;
        }
        return Ok(None);
    }
    let name = source.name();
    read_drawing_with_notes(bytes).map(Some).map_err(|error| match error {
        ExportError::Json { line, column, message } => {
            Failure::failed(format!("{name}:{line}: column {column}: {message}"))
        }
        other => Failure::failed(format!("{name}: {other}")),
    })
}

/// Whether the bytes are meant as a drawing of ours, sound or not.
fn is_drawing(bytes: &[u8]) -> bool {
    #[derive(Deserialize)]
    struct Header<'a> {
        format: Option<&'a str>,
    }
    const NAME: &str = "umriss-drawing/";
    if !bytes.trim_ascii_start().starts_with(b"{") {
        return false;
    }
    match serde_json::from_slice::<Header>(bytes) {
        Ok(header) => header.format.is_some_and(|format| format.starts_with(NAME)),
        Err(_) => {
            let start = &bytes[..bytes.len().min(HEADER)];
            start.windows(NAME.len()).any(|window| window == NAME.as_bytes())
        }
    }
}

fn scene_of(
    sources: &mut [Source<'_>],
    flags: &ModelFlags,
    select: Select<'_>,
    session: &RunFlags,
    run: &Run<'_>,
) -> Result<Scene, Failure> {
    let Objects { mut soups, unit, formats } = read_objects(sources, &flags.files, session, run)?;
    // Files tell how fine they are, whatever is selected of them.
    let tolerance = flags.heal.map(|heal| heal.tolerance(&soups));
    select(&mut soups)?;
    if let Some(tolerance) = tolerance {
        healed(&mut soups, tolerance, session, run)?;
    }
    let options = SceneOptions { weld: flags.weld, unit };
    let made = run.stage("mesh", soups.len() as u64, || Scene::within(soups, &options, run));
    let scene = made.map_err(|error| match sources {
        _ if matches!(error, MeshError::Cancelled(_)) => Failure::from(error),
        [source] => Failure::failed(format!("{}: {error}", source.name())),
        _ => Failure::failed(error.to_string()),
    })?;
    crossed_faces::tell(&scene.mesh, session, |file, place| {
        let named = sources.iter().zip(&formats).find(|(source, _)| source.name() == file);
        named.and_then(|(source, &format)| line_in(source, format, place.number))
    });
    if flags.weld.is_some() {
        let merged = scene.mesh.report().merged_vertices;
        session.note(&format!("--weld moved {merged} vertices onto others"));
    } else if !matches!(flags.heal, Some(Heal::Within(_)))
        && let Some(torn) = torn_borders(&scene.mesh, run)?
    {
        session.note(&hint(&torn, flags.heal.is_some()));
    }
    Ok(scene)
}

/// Reads models and heals them: their objects, and the meaning of their numbers.
pub(crate) fn read_healed(
    files: &[PathBuf],
    flags: &FileFlags,
    heal: Heal,
    session: &RunFlags,
    run: &Run<'_>,
) -> Result<(Vec<Soup>, Unit), Failure> {
    let Objects { mut soups, unit, .. } =
        read_objects(&mut sources(files, run)?, flags, session, run)?;
    let tolerance = heal.tolerance(&soups);
    healed(&mut soups, tolerance, session, run)?;
    Ok((soups, unit))
}

/// What is in files.
struct Objects {
    soups: Vec<Soup>,
    unit: Unit,
    /// Of each file.
    formats: Vec<Format>,
}

fn read_objects(
    sources: &mut [Source<'_>],
    flags: &FileFlags,
    session: &RunFlags,
    run: &Run<'_>,
) -> Result<Objects, Failure> {
    let (mut unit, mut soups, mut formats) = (None, Vec::new(), Vec::new());
    run.stage("reading", sources.len() as u64, || {
        for source in &mut *sources {
            let imported = import(source, flags, run)?;
            for warning in &imported.warnings {
                session.note(&format!("{}: {warning}", source.name()));
            }
            formats.push(imported.format);
            unit = Some(common_unit(unit, imported.placement.unit, flags, source)?);
            soups.extend(upright_soups(imported, flags, source));
            run.advance(1);
        }
        Ok::<(), Failure>(())
    })?;
    Ok(Objects { soups, unit: unit.unwrap_or_default(), formats })
}

/// Heals objects, and tells what that did.
fn healed(
    soups: &mut [Soup],
    tolerance: f64,
    session: &RunFlags,
    run: &Run<'_>,
) -> Result<(), Failure> {
    let report =
        run.stage("healing", soups.len() as u64, || umriss::model::heal(soups, tolerance, run))?;
    session.note(&told(tolerance, &report));
    Ok(())
}

/// Where lines come from that nobody meant, in one line.
fn hint(torn: &TornBorders, heals: bool) -> String {
    let TornBorders { borders, within, at_ends } = torn;
    let flag = if *at_ends && !heals { "--weld" } else { "--heal" };
    let what = match borders {
        1 => "a border lies beside others".to_owned(),
        _ => format!("{borders} borders lie together"),
    };
    format!("{what} within {within:e}: {flag} {within:e}")
}

/// What healing did, in one line.
fn told(tolerance: f64, report: &HealReport) -> String {
    let HealReport { moved, farthest, closed_borders, collapsed_faces } = report;
    format!(
        "--heal {tolerance:.2e}: {moved} places moved, by {farthest:.2e} at most; {closed_borders} \
         borders closed; {collapsed_faces} faces collapsed"
    )
}

fn import(source: &mut Source<'_>, flags: &FileFlags, run: &Run<'_>) -> Result<Imported, Failure> {
    let (format, allow_outside) = (flags.input_format, flags.allow_outside);
    match (source.bytes.take(), source.path) {
        (None, Some(path)) => {
            Ok(read_file_within(path, ImportOptions { format, allow_outside }, run)?)
        }
        (bytes, _) => {
            let bytes = bytes.unwrap_or_default();
            let imported = read_bytes_within(&source.name(), &bytes, format, run);
            run.give_back(bytes.capacity() as u64);
            Ok(imported?)
        }
    }
}

/// The line of a face in a file that can be read twice.
fn line_in(source: &Source<'_>, format: Format, face: u64) -> Option<u64> {
    let path = source.path.filter(|path| format == Format::PolygonScene && path.is_file())?;
    line_of_face(&std::fs::read(path).ok()?, format, face)
}

/// The unit of the scene after one more file.
fn common_unit(
    so_far: Option<Unit>,
    own: Unit,
    flags: &FileFlags,
    source: &Source<'_>,
) -> Result<Unit, Failure> {
    if let Some(name) = flags.unit {
        return Ok(name.unit());
    }
    match so_far {
        Some(unit) if unit != own => Err(Failure::usage(format!(
            "{}: the numbers are in {}, but those of the models before in {}; expected --unit to \
             say what all numbers mean",
            source.name(),
            own.name(),
            unit.name()
        ))),
        _ => Ok(own),
    }
}

/// The objects of a file, z up; those without a name are called like it.
fn upright_soups(imported: Imported, flags: &FileFlags, source: &Source<'_>) -> Vec<Soup> {
    let up = flags.up_axis.map_or(imported.placement.up, AxisName::axis);
    let stem = source.path.and_then(Path::file_stem);
    let stem = stem.map_or("stdin".to_owned(), |stem| stem.to_string_lossy().into_owned());
    let mut soups = imported.objects;
    for soup in &mut soups {
        soup.turn_upright(up);
        soup.places.file = source.name();
        if soup.name.is_empty() {
            soup.name.clone_from(&stem);
        }
    }
    soups
}
