//! The floors of the house: every room imports only rooms below its own.
//!
//! The table is the one in `ARCHITECTURE.md`. Every path in `src/` that begins
//! with `crate` or `super` is held against it. The program is a crate of its
//! own, so the compiler sees to it that it uses only what is public, unless
//! it takes files of the library as its own, which is looked for.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};

/// Rooms, ground floor first. A room may use the rooms before it.
const ROOMS: [&str; 13] = [
    "run",
    "kernel",
    "spatial",
    "polygon",
    "fill",
    "model",
    "view",
    "visibility",
    "raster",
    "drawing",
    "export",
    "verify",
    "exact",
];

/// Rooms on one floor: neither may know the other.
const STRANGERS: [&str; 2] = ["visibility", "raster"];

/// Parts of one room, in their order: a part may use the parts before it.
/// Parts that stand on one floor are siblings and do not know each other.
const PARTS: [(&str, &[&[&str]]); 3] = [
    ("kernel", &[&["numbers"], &["predicates"]]),
    (
        "visibility",
        &[
            &["ties"],
            &["appel", "floating_horizon", "painter", "roberts", "weiler_atherton"],
            &["reduce"],
            &["visible_lines"],
        ],
    ),
    (
        "raster",
        &[
            &["box_tree", "item_buffer"],
            &["samples"],
            // No image-space method knows another.
            &[
                "ray_cast",
                "z_buffer",
                "a_buffer",
                "scanline",
                "span_buffer",
                "warnock",
                "sheets",
                "horizon_columns",
            ],
            &["methods", "picture"],
        ],
    ),
];

/// All that readers of files may know of the room around them.
const SOUPS: [&str; 11] = [
    "import",
    "surface",
    "Color",
    "FacePlace",
    "FacePlaces",
    "Faces",
    "Placement",
    "Precision",
    "Soup",
    "Unit",
    "UpAxis",
];

/// The path `path` used in line `line` of the file `file`.
#[derive(Debug, PartialEq, Eq)]
struct Use {
    file: String,
    line: usize,
    path: Vec<String>,
}

#[test]
fn every_path_in_the_library_leads_downwards() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut violations = Vec::new();
    let mut paths = 0;
    for file in sources(&root) {
        if file.starts_with(root.join("bin")) {
            continue;
        }
        let name = file.strip_prefix(&root).unwrap().to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(&file).unwrap();
        let found = paths_in(&name, &text);
        paths += found.len();
        violations.extend(found.iter().filter_map(violation));
    }
    assert!(paths > 100, "only {paths} paths found: they are not read right");
    assert!(violations.is_empty(), "\n{}", violations.join("\n"));
}

#[test]
fn every_room_is_in_the_table() {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lib.rs"));
    let text = text.unwrap();
    let mut rooms: Vec<_> =
        text.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')).collect();
    let mut table = ROOMS.to_vec();
    rooms.sort_unstable();
    table.sort_unstable();
    assert_eq!(rooms, table);
}

#[test]
fn no_file_is_a_module_in_two_places() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for file in sources(&root) {
        let text = fs::read_to_string(&file).unwrap();
        for trick in ["#[path", "include!("] {
            assert!(!text.contains(trick), "{}: {trick}", file.display());
        }
    }
}

#[test]
fn a_made_up_violation_is_found() {
    let upwards = [
        ("model/mesh.rs", "use crate::view::LineQuestion;\n"),
        ("run/mod.rs", "fn f() { crate::kernel::numbers::sign() }\n"),
        ("raster/ray_cast.rs", "use crate::{\n    model::Mesh,\n    visibility::{appel},\n};\n"),
        ("drawing/page.rs", "use crate::export::to_svg;\n"),
        ("model/import/gltf/mod.rs", "use super::super::super::model::Mesh;\n"),
        ("model/import/obj.rs", "use crate::model::{Mesh, Soup};\n"),
        ("kernel/numbers/big.rs", "use crate::kernel::predicates::Exact;\n"),
        ("kernel/numbers/big.rs", "use super::super::predicates::Exact;\n"),
        ("visibility/appel/walker.rs", "use super::super::roberts::roberts;\n"),
        ("visibility/roberts.rs", "use super::appel::AppelOptions;\n"),
        ("visibility/appel/mod.rs", "use crate::visibility::reduce;\n"),
        ("raster/z_buffer.rs", "use super::ray_cast;\n"),
        ("raster/z_buffer.rs", "use super::Compare;\n"),
        ("raster/span_buffer/resolve.rs", "use crate::raster::z_buffer;\n"),
        ("raster/a_buffer/mod.rs", "use super::span_buffer::span_buffer;\n"),
        ("raster/samples/face.rs", "use crate::raster::a_buffer;\n"),
        ("fill/polygon.rs", "use crate::raster::ItemBuffer;\n"),
        ("raster/scanline/edges.rs", "use super::super::warnock::warnock;\n"),
        ("raster/z_buffer.rs", "use super::spanning;\n"),
        ("raster/warnock/window.rs", "use crate::raster::SheetCounter;\n"),
        ("raster/samples/face.rs", "use crate::raster::methods;\n"),
        ("raster/a_buffer/mod.rs", "use crate::visibility::VisibleLines;\n"),
        ("visibility/reduce/mod.rs", "use crate::raster::Samples;\n"),
        ("visibility/floating_horizon/walker.rs", "use crate::visibility::appel;\n"),
        ("raster/horizon_columns.rs", "use crate::visibility::floating_horizon;\n"),
    ];
    for (file, text) in upwards {
        let found: Vec<_> = paths_in(file, text).iter().filter_map(violation).collect();
        assert_eq!(found.len(), 1, "{file}: {text}: {found:?}");
    }
    let downwards = [
        ("model/mesh.rs", "use crate::run::Run;\n// use crate::view::LineQuestion;\n"),
        ("kernel/predicates/mod.rs", "use crate::kernel::numbers::Sign;\nuse super::Points;\n"),
        ("verify/mod.rs", "use crate::{\n    visibility::appel,\n    raster::ray_cast,\n};\n"),
        ("visibility/appel/walker.rs", "use super::count::Count;\n"),
        ("raster/scanline/spanning.rs", "use super::Scene;\nuse crate::raster::ItemBuffer;\n"),
        ("raster/z_buffer.rs", "use super::samples::Face;\nuse super::Samples;\n"),
        ("model/import/gltf/mod.rs", "use super::super::{Soup, Unit};\nuse super::error::Fault;\n"),
    ];
    for (file, text) in downwards {
        let found: Vec<_> = paths_in(file, text).iter().filter_map(violation).collect();
        assert_eq!(found, [""; 0], "{file}: {text}");
    }
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// All paths that begin with `crate` or `super`, made absolute.
fn paths_in(file: &str, text: &str) -> Vec<Use> {
    // Comments may say what code may not.
    let code: String = text
        .lines()
        .map(|line| line.split_once("//").map_or(line, |(code, _)| code).to_owned() + "\n")
        .collect();
    let mut found = Vec::new();
    for start in ["crate::", "super::"] {
        for (at, _) in code.match_indices(start) {
            let before = code[..at].chars().next_back();
            if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':' || c == '$') {
                continue;
            }
            let line = code[..at].matches('\n').count() + 1;
            let base = Vec::new();
            for path in expand(&code[at..], &base).0 {
                if let Some(path) = absolute(file, path) {
                    found.push(Use { file: file.to_owned(), line, path });
                }
            }
        }
    }
    found
}

/// The paths of a use tree, and what of the text is behind it.
fn expand<'t>(text: &'t str, base: &[String]) -> (Vec<Vec<String>>, &'t str) {
    let mut path = base.to_vec();
    let mut rest = text.trim_start();
    loop {
        if let Some(mut inner) = rest.strip_prefix('{') {
            let mut paths = Vec::new();
            loop {
                let (more, behind) = expand(inner, &path);
                paths.extend(more);
                let behind = behind.trim_start();
                match behind.strip_prefix(',') {
                    Some(next) if !next.trim_start().starts_with('}') => inner = next,
                    Some(next) => return (paths, next.trim_start().trim_start_matches('}')),
                    None => return (paths, behind.strip_prefix('}').unwrap_or("")),
                }
            }
        }
        let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        if end == 0 {
            return (vec![path], rest);
        }
        path.push(rest[..end].to_owned());
        match rest[end..].strip_prefix("::") {
            Some(next) => rest = next,
            None => return (vec![path], &rest[end..]),
        }
    }
}

/// The path from the root of the crate; nothing for paths within one file.
fn absolute(file: &str, path: Vec<String>) -> Option<Vec<String>> {
    if path[0] == "crate" {
        return Some(path[1..].to_vec());
    }
    let mut module: Vec<String> =
        file.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    if module.last().is_some_and(|last| last == "mod") {
        module.pop();
    }
    let ups = path.iter().take_while(|word| *word == "super").count();
    // `super` in a module within a file leads to the file itself.
    let depth = module.len().checked_sub(ups)?;
    module.truncate(depth);
    module.extend_from_slice(&path[ups..]);
    Some(module)
}

/// What is wrong with a path, if anything is.
fn violation(used: &Use) -> Option<String> {
    let Use { file, line, path } = used;
    let own: Vec<&str> = file.trim_end_matches(".rs").split('/').collect();
    let target = path.first()?;
    let floor = |room: &str| ROOMS.iter().position(|other| *other == room);
    let wrong = match (floor(own[0]), floor(target)) {
        (Some(from), Some(to)) if from != to => {
            to > from || [own[0], target.as_str()].iter().all(|room| STRANGERS.contains(room))
        }
        (Some(_), Some(_)) => {
            let inner = own.get(1).copied().unwrap_or_default();
            // Readers of files are told by name what they may know.
            path.get(1).is_some_and(|name| {
                part_is_above(own[0], inner, name)
                    || (inner != "import" && part_is_above(own[0], inner, &part_of(own[0], name)))
            })
        }
        _ => false,
    };
    wrong.then(|| format!("{file}:{line}: {} may not use {}", own.join("/"), path.join("::")))
}

/// The part of a room that a name behind its door comes from; the name
/// itself if the door does not say.
fn part_of(room: &str, name: &str) -> String {
    let door = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(room).join("mod.rs");
    let text = fs::read_to_string(door).unwrap_or_default();
    let part = text.split(';').find_map(|statement| {
        let (part, names) = statement.trim().strip_prefix("pub use ")?.split_once("::")?;
        let mut words = names.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        words.any(|word| word == name).then(|| part.to_owned())
    });
    part.unwrap_or_else(|| name.to_owned())
}

/// Whether, within a room, `target` is a part that `own` may not use.
fn part_is_above(room: &str, own: &str, target: &str) -> bool {
    if (room, own) == ("model", "import") {
        return !SOUPS.contains(&target);
    }
    let Some((_, floors)) = PARTS.iter().find(|(name, _)| *name == room) else {
        return false;
    };
    let floor = |part: &str| floors.iter().position(|parts| parts.contains(&part));
    match (floor(own), floor(target)) {
        (Some(from), Some(to)) => own != target && to >= from,
        _ => false,
    }
}
