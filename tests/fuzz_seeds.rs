//! The seeds of the fuzz targets as ordinary tests: every seed, every
//! truncation of it and 200 mutations of it are read or refused, without a
//! panic, and what is read is sound.

#[path = "../fuzz/src/targets.rs"]
#[cfg(all(feature = "json", feature = "svg"))]
mod targets;

#[path = "support/split_mix.rs"]
mod split_mix;

use std::path::{Path, PathBuf};

use split_mix::split_mix;
use umriss::model::Soup;
use umriss::model::import::{Format, read_bytes};

fn assert_sound(soup: &Soup) {
    assert!(soup.vertices.iter().all(|vertex| vertex.is_finite()));
    let count = soup.vertices.len();
    let in_range = |number: &u32| (*number as usize) < count;
    assert!(soup.faces.corners().iter().all(in_range));
    assert!(soup.lines.as_flattened().iter().all(in_range));
    if let Some(colors) = &soup.colors {
        assert_eq!(colors.len(), soup.faces.len());
    }
    if let Some(numbers) = &soup.vertex_numbers {
        assert_eq!(numbers.len(), count);
    }
    let corners: usize =
        (0..soup.faces.len()).flat_map(|face| soup.faces.rings(face)).map(<[u32]>::len).sum();
    assert_eq!(corners, soup.faces.corners().len());
}

/// Whether the bytes are read.
fn feed(bytes: &[u8], format: Option<Format>) -> bool {
    let Ok(imported) = read_bytes("seed", bytes, format) else { return false };
    imported.objects.iter().for_each(assert_sound);
    true
}

/// Numbers that look like chance.
struct SplitMix(u64);

impl SplitMix {
    fn below(&mut self, bound: usize) -> usize {
        (split_mix(&mut self.0) % bound as u64) as usize
    }
}

/// Up to four bytes replaced, a piece cut out, or a piece repeated.
fn mutate(seed: &[u8], random: &mut SplitMix) -> Vec<u8> {
    const TELLING: [u8; 10] = [0, 1, 0x7f, 0x80, 0xff, b'-', b'9', b'\n', b' ', b'{'];
    let mut bytes = seed.to_vec();
    let start = random.below(bytes.len());
    let end = (start + 1 + random.below(16)).min(bytes.len());
    match random.below(4) {
        0 => drop(bytes.drain(start..end)),
        1 => bytes.extend_from_within(start..end),
        _ => {
            for _ in 0..=random.below(4) {
                let at = random.below(bytes.len());
                bytes[at] = match random.below(2) {
                    0 => TELLING[random.below(TELLING.len())],
                    _ => random.below(256) as u8,
                };
            }
        }
    }
    bytes
}

/// The files of a corpus, in order.
fn seeds_of(target: &str) -> Vec<PathBuf> {
    let corpus = Path::new("fuzz/corpus").join(target);
    let files = std::fs::read_dir(corpus).expect("corpus");
    let mut seeds: Vec<_> = files.map(|entry| entry.expect("entry").path()).collect();
    seeds.sort();
    assert!(!seeds.is_empty());
    seeds
}

/// Feeds the seeds of a target to it, their truncations and mutations.
#[cfg(all(feature = "json", feature = "svg"))]
fn feed_all(target: &str, mutations: usize, feed: fn(&[u8])) {
    let mut random = SplitMix(43);
    for seed in seeds_of(target) {
        let bytes = std::fs::read(&seed).expect("seed");
        feed(&bytes);
        for part in 1..8 {
            feed(&bytes[..bytes.len() * part / 8]);
        }
        for _ in 0..mutations {
            feed(&mutate(&bytes, &mut random));
        }
    }
}

fn run(target: &str) {
    let format = Format::from_name(target).expect("a format");
    let seeds = seeds_of(target);
    let mut random = SplitMix(42);
    let mut read = 0;
    for seed in seeds {
        let bytes = std::fs::read(&seed).expect("seed");
        assert!(feed(&bytes, Some(format)), "{} is a sound file", seed.display());
        feed(&bytes, None);
        if bytes.len() <= 4096 {
            for length in 0..bytes.len() {
                feed(&bytes[..length], Some(format));
            }
        }
        for _ in 0..200 {
            let mutant = mutate(&bytes, &mut random);
            read += usize::from(feed(&mutant, Some(format)));
            feed(&mutant, None);
        }
    }
    // Mutations that are never read, or always, would test little.
    assert!(0 < read);
}

#[test]
fn obj_seeds_and_their_mutations() {
    run("obj");
}

#[test]
fn stl_seeds_and_their_mutations() {
    run("stl");
}

#[test]
fn off_seeds_and_their_mutations() {
    run("off");
}

#[cfg(feature = "ply")]
#[test]
fn ply_seeds_and_their_mutations() {
    run("ply");
}

#[cfg(feature = "json")]
#[test]
fn polygon_scene_seeds_and_their_mutations() {
    run("json");
}

#[cfg(feature = "gltf")]
#[test]
fn gltf_seeds_and_their_mutations() {
    run("gltf");
}

#[cfg(all(feature = "json", feature = "svg"))]
#[test]
fn clipping_seeds_and_their_mutations() {
    feed_all("clipping", 200, targets::clipping);
}

#[cfg(all(feature = "json", feature = "svg"))]
#[test]
fn shape_seeds_and_their_mutations() {
    feed_all("shapes", 200, targets::shapes);
}

#[cfg(all(feature = "json", feature = "svg"))]
#[test]
fn height_seeds_and_their_mutations() {
    feed_all("heights", 200, targets::heights);
}

#[cfg(all(feature = "json", feature = "svg"))]
#[test]
fn visibility_seeds_and_their_mutations() {
    feed_all("visibility", 40, targets::visibility);
}

#[cfg(all(feature = "json", feature = "svg"))]
#[test]
fn predicate_seeds_and_their_mutations() {
    feed_all("predicates", 40, targets::predicates);
}

#[cfg(all(feature = "json", feature = "svg"))]
#[test]
fn restyle_seeds_and_their_mutations() {
    feed_all("restyle", 400, targets::restyle);
}
