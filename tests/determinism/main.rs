//! The same drawing, byte by byte: for every number of threads, in debug and
//! in release, today and after the next change.
//!
//! `hashes.txt` has a line for each drawing: the FNV-1a hash of the JSON
//! drawing as `umriss draw -o x.json` writes it, counters and all, for the
//! models in `examples/models` from the front, from the top, isometric, from
//! a direction that is nobody's, and in perspective; for small models every
//! edge and the hidden parts too. Each is drawn by 1, 2 and 8 threads.
//!
//! There is one table for all builds. Rust neither contracts nor reorders
//! operations on floats, and sums whose order matters are made of parts of
//! fixed sizes. What may differ is the mathematical library, which differs
//! between systems, not between builds: `tan` of the field of view, which
//! stands in the frame of a perspective drawing, `cos` of a crease angle,
//! rounded to few bits, and `log2`, of which only the whole part is used.
//! Powers of two by `powi` are exact however they are made.
//!
//! `UMRISS_BLESS=1` writes the table anew; look at what has changed before
//! keeping it: the number of pieces beside each hash tells whether more than
//! digits and counters did. With `UMRISS_MODELS` naming a folder and
//! `UMRISS_LONG=1` all models there of up to 20 000 triangles are drawn too,
//! by 1, 2 and 8 threads, and compared with themselves.

#![allow(clippy::print_stdout, clippy::print_stderr)]

mod drawings;
mod program;

use drawings::{Lines, drawing, models, scene, view_of};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};

type Outcome<T> = Result<T, Box<dyn Error>>;

const THREADS: [usize; 3] = [1, 2, 8];

const VIEWS: [&str; 5] = ["front", "top", "iso", "generic", "eye"];

/// Triangles up to which every edge of a model is drawn, and hidden parts.
const SMALL: usize = 3_000;

/// Triangles up to which a model of the named folder is drawn.
const LARGE: usize = 20_000;

/// FNV-1a, 64 bits (Fowler, Noll and Vo): stable, and short enough to be
/// written out.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

fn pools() -> Outcome<Vec<(usize, ThreadPool)>> {
    let pool = |threads| Ok((threads, ThreadPoolBuilder::new().num_threads(threads).build()?));
    THREADS.into_iter().map(pool).collect()
}

/// The drawings of one model by one number of threads: what each is called,
/// its pieces and its bytes' hash.
fn rows(file: &Path) -> Outcome<Vec<(String, usize, u64)>> {
    let scene = scene(file)?;
    let small = scene.mesh.triangles().len() <= SMALL;
    let name = file.file_name().and_then(|name| name.to_str()).ok_or("a name")?;
    let mut rows = Vec::new();
    for view in VIEWS {
        for lines in [Lines::Visible, Lines::Every] {
            if lines == Lines::Visible || small {
                let (pieces, bytes) = drawing(&scene, &view_of(view, &scene.mesh)?, lines)?;
                let title = format!("{name:<30} {view:<8} {:<8}", lines.name());
                rows.push((title, pieces, hash(&bytes)));
            }
        }
    }
    Ok(rows)
}

#[test]
fn drawings_are_those_of_the_table_for_every_number_of_threads() -> Outcome<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let table = root.join("tests/determinism/hashes.txt");
    let pools = pools()?;
    // What was kept, what is drawn now, and what does not fit.
    let (mut text, mut wrong) = (String::new(), Vec::new());
    let bless = std::env::var_os("UMRISS_BLESS").is_some_and(|value| value == "1");
    let kept = if bless { String::new() } else { std::fs::read_to_string(&table)? };
    let known = |title: &str| kept.lines().find_map(|line| line.strip_prefix(title));
    for file in models(&root.join("examples/models"))? {
        let drawn = pools.iter().map(|(threads, pool)| {
            // Errors of other threads must be errors that can be sent.
            let rows = pool.install(|| rows(&file).map_err(|error| error.to_string()))?;
            Ok((*threads, rows))
        });
        let drawn: Vec<_> = drawn.collect::<Outcome<_>>()?;
        for (title, pieces, hash) in &drawn[0].1 {
            writeln!(text, "{title} {pieces:>6} {hash:016x}")?;
        }
        for (threads, rows) in &drawn {
            for ((title, pieces, hash), (_, _, alone)) in rows.iter().zip(&drawn[0].1) {
                let now = format!(" {pieces:>6} {hash:016x}");
                match known(title) {
                    _ if hash != alone => wrong.push(format!(
                        "{title} {threads} threads: {hash:016x}, but one thread {alone:016x}"
                    )),
                    _ if bless => {}
                    Some(kept) if *kept == now => {}
                    Some(kept) => {
                        wrong.push(format!("{title} {threads} threads:{now}, in the table{kept}"));
                    }
                    None => wrong.push(format!("{title} {threads} threads: not in the table")),
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{} drawings differ:\n{}", wrong.len(), wrong.join("\n"));
    if bless {
        std::fs::write(&table, text)?;
    } else {
        let drawings = text.lines().count();
        assert_eq!(kept.lines().count(), drawings, "the table has lines for other drawings");
    }
    Ok(())
}

#[test]
fn models_of_the_named_folder_are_drawn_alike_by_every_number_of_threads() -> Outcome<()> {
    let folder = std::env::var_os("UMRISS_MODELS").map(PathBuf::from);
    let (Some(folder), Some(_)) = (folder, std::env::var_os("UMRISS_LONG")) else {
        println!("skipped: expected UMRISS_MODELS to name a folder, and UMRISS_LONG=1");
        return Ok(());
    };
    let pools = pools()?;
    let (mut wrong, mut drawn) = (Vec::new(), 0);
    for file in models(&folder)? {
        let scene = scene(&file)?;
        if scene.mesh.triangles().len() > LARGE {
            println!("skipped: {} is large", file.display());
            continue;
        }
        for view in VIEWS {
            let Ok(camera) = view_of(view, &scene.mesh) else {
                continue;
            };
            let by = |pool: &ThreadPool| {
                pool.install(|| {
                    drawing(&scene, &camera, Lines::Every).map_err(|error| error.to_string())
                })
            };
            let all: Vec<_> = pools
                .iter()
                .map(|(threads, pool)| Ok((*threads, by(pool)?)))
                .collect::<Outcome<_>>()?;
            for (threads, bytes) in &all {
                if *bytes != all[0].1 {
                    wrong.push(format!("{} {view} {threads} threads", file.display()));
                }
            }
            drawn += 1;
        }
    }
    assert!(wrong.is_empty(), "differ from one thread:\n{}", wrong.join("\n"));
    assert!(drawn > 0, "no models in {}", folder.display());
    Ok(())
}

#[test]
fn the_hash_is_that_of_its_inventors() {
    assert_eq!(hash(b""), 0xcbf2_9ce4_8422_2325);
    assert_eq!(hash(b"a"), 0xaf63_dc4c_8601_ec8c);
    assert_eq!(hash(b"foobar"), 0x8594_4171_f739_67e8);
}
