//! Reads what the command line names: models, or one computed drawing.

use crate::failure::Failure;
use crate::model_flags::{AxisName, Heal, ModelFlags};
use crate::session::RunFlags;
use serde::Deserialize;
use std::io::{Read, stdin};
use std::path::{Path, PathBuf};
use umriss::export::{DrawingNotes, ExportError, read_drawing_with_notes};
use umriss::model::import::{Imported, read_bytes_within, read_file_within};
use umriss::model::{HealReport, MeshError, Scene, SceneOptions, Soup, Unit};
use umriss::run::Run;
use umriss::view::VisibleLines;

/// The name under which standard input goes in messages.
const STANDARD_INPUT: &str = "<stdin>";

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
    let sources = sources(files)?;
    if flags.input_format.is_none()
        && let [source] = &*sources
        && let Some(drawing) = read_computed(source)?
    {
        return Ok(Subject::Drawing(Box::new(drawing)));
    }
    scene_of(&sources, flags, select, session, run).map(|scene| Subject::Scene(Box::new(scene)))
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
    scene_of(&sources(files)?, flags, select, session, run)
}

/// Leaves out objects that are not wanted.
pub(crate) type Select<'a> = &'a dyn Fn(&mut Vec<Soup>) -> Result<(), Failure>;

/// A file of the command line, or standard input.
struct Source<'a> {
    /// Nothing for standard input.
    path: Option<&'a Path>,
    /// Standard input can be read only once.
    bytes: Vec<u8>,
}

impl Source<'_> {
    fn name(&self) -> String {
        self.path.map_or(STANDARD_INPUT.to_owned(), |path| path.display().to_string())
    }
}

fn sources(files: &[PathBuf]) -> Result<Vec<Source<'_>>, Failure> {
    if files.iter().filter(|file| file.as_os_str() == "-").count() > 1 {
        return Err(Failure::usage("- is given twice, but standard input can be read only once"));
    }
    files.iter().map(|file| source(file)).collect()
}

fn source(file: &Path) -> Result<Source<'_>, Failure> {
    if file.as_os_str() != "-" {
        return Ok(Source { path: Some(file), bytes: Vec::new() });
    }
    let mut bytes = Vec::new();
    match stdin().lock().read_to_end(&mut bytes) {
        Ok(_) => Ok(Source { path: None, bytes }),
        Err(error) => Err(Failure::failed(format!("{STANDARD_INPUT}: cannot be read: {error}"))),
    }
}

/// The drawing in a source, if it is one.
fn read_computed(source: &Source<'_>) -> Result<Option<(VisibleLines, DrawingNotes)>, Failure> {
    let read;
    let bytes = match source.path {
        None => &source.bytes,
        Some(path) if path.extension().is_some_and(|word| word.eq_ignore_ascii_case("json")) => {
            let name = path.display();
            read = std::fs::read(path)
                .map_err(|error| Failure::failed(format!("{name}: cannot be read: {error}")))?;
            &read
        }
        Some(_) => return Ok(None),
    };
    if !is_drawing(bytes) {
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
    sources: &[Source<'_>],
    flags: &ModelFlags,
    select: Select<'_>,
    session: &RunFlags,
    run: &Run<'_>,
) -> Result<Scene, Failure> {
    let (mut unit, mut resolution) = (None, 0.0_f64);
    let mut soups = Vec::new();
    run.stage("reading", sources.len() as u64, || {
        for source in sources {
            let imported = import(source, flags, run)?;
            for warning in &imported.warnings {
                session.note(&format!("{}: {warning}", source.name()));
            }
            resolution = resolution.max(match flags.heal {
                Some(Heal::Auto) => imported.resolution(),
                _ => 0.0,
            });
            unit = Some(common_unit(unit, imported.placement.unit, flags, source)?);
            soups.extend(upright_soups(imported, flags, source));
            run.advance(1);
        }
        Ok::<(), Failure>(())
    })?;
    select(&mut soups)?;
    if let Some(heal) = flags.heal {
        let tolerance = heal.tolerance(resolution);
        let report = run.stage("healing", soups.len() as u64, || {
            umriss::model::heal(&mut soups, tolerance, run)
        })?;
        session.note(&told(tolerance, &report));
    }
    let options = SceneOptions { weld: flags.weld, unit: unit.unwrap_or_default() };
    let made = run.stage("mesh", soups.len() as u64, || Scene::within(soups, &options, run));
    let scene = made.map_err(|error| match sources {
        _ if matches!(error, MeshError::Cancelled(_)) => Failure::from(error),
        [source] => Failure::failed(format!("{}: {error}", source.name())),
        _ => Failure::failed(error.to_string()),
    })?;
    let merged = scene.mesh.report().merged_vertices;
    if flags.weld.is_some() {
        session.note(&format!("--weld moved {merged} vertices onto others"));
    }
    Ok(scene)
}

/// What healing did, in one line.
fn told(tolerance: f64, report: &HealReport) -> String {
    let HealReport { moved, farthest, closed_borders, collapsed_faces } = report;
    format!(
        "--heal {tolerance:.2e}: {moved} places moved, by {farthest:.2e} at most; {closed_borders} \
         borders closed; {collapsed_faces} faces collapsed"
    )
}

fn import(source: &Source<'_>, flags: &ModelFlags, run: &Run<'_>) -> Result<Imported, Failure> {
    let imported = match source.path {
        Some(path) => read_file_within(path, flags.input_format, run),
        None => read_bytes_within(STANDARD_INPUT, &source.bytes, flags.input_format, run),
    };
    Ok(imported?)
}

/// The unit of the scene after one more file.
fn common_unit(
    so_far: Option<Unit>,
    own: Unit,
    flags: &ModelFlags,
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
fn upright_soups(imported: Imported, flags: &ModelFlags, source: &Source<'_>) -> Vec<Soup> {
    let up = flags.up_axis.map_or(imported.placement.up, AxisName::axis);
    let stem = source.path.and_then(Path::file_stem);
    let stem = stem.map_or("stdin".to_owned(), |stem| stem.to_string_lossy().into_owned());
    let mut soups = imported.objects;
    for soup in &mut soups {
        soup.turn_upright(up);
        if soup.name.is_empty() {
            soup.name.clone_from(&stem);
        }
    }
    soups
}
