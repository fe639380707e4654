//! What a document may reach: files of its own folder and below, whatever
//! paths, escapes and links say.

use std::path::{Path, PathBuf};
use umriss::model::import::{ImportError, ImportOptions, read_file_within};
use umriss::run::Run;

/// The positions of one triangle.
const NUMBERS: [f32; 9] = [0., 0., 0., 1., 0., 0., 0., 1., 0.];

struct Folder {
    root: tempfile::TempDir,
}

impl Folder {
    /// `secret.bin`, and beside it a folder `model` with `in/a.bin`.
    fn new() -> Self {
        let root = tempfile::tempdir().unwrap();
        let bytes: Vec<u8> = NUMBERS.iter().flat_map(|number| number.to_le_bytes()).collect();
        std::fs::create_dir_all(root.path().join("model/in")).unwrap();
        std::fs::write(root.path().join("secret.bin"), &bytes).unwrap();
        std::fs::write(root.path().join("model/in/a.bin"), &bytes).unwrap();
        std::fs::write(root.path().join("model/a:b.bin"), &bytes).unwrap();
        Folder { root }
    }

    fn model(&self) -> PathBuf {
        self.root.path().join("model/model.gltf")
    }

    /// Reads a model whose buffer is at `uri`: whether it can be, and if it
    /// cannot, whether that is for being out of bounds, and why.
    fn read(&self, uri: &str, allow_outside: bool) -> Result<(), (bool, String)> {
        let text = format!(
            r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}}],
            "buffers":[{{"byteLength":36,"uri":"{uri}"}}]}}"#
        );
        std::fs::write(self.model(), text).unwrap();
        let options = ImportOptions { allow_outside, ..ImportOptions::default() };
        let imported = read_file_within(&self.model(), options, &Run::default());
        match imported {
            Ok(imported) => {
                let found = imported.objects[0].vertices.iter().flat_map(|point| point.to_array());
                assert!(found.eq(NUMBERS.map(f64::from)));
                Ok(())
            }
            Err(error) => {
                let text = error.to_string();
                let start = format!("{}:5: the ", self.model().display());
                assert!(text.starts_with(&start), "{text}");
                let is_outside = matches!(error, ImportError::Outside { .. });
                Err((is_outside, text[start.len()..].to_owned()))
            }
        }
    }
}

fn outside(uri: &str) -> Result<(), (bool, String)> {
    Err((true, format!("file '{uri}' is not below the model's folder, expected one that is")))
}

fn unreadable(message: &str) -> Result<(), (bool, String)> {
    Err((false, message.to_owned()))
}

#[test]
fn files_outside_of_the_folder_are_read_only_if_that_is_allowed() {
    let folder = Folder::new();
    let secret = folder.root.path().join("secret.bin");
    let secret = secret.to_str().unwrap();
    let mut uris = vec!["../secret.bin".to_owned(), "%2e%2E/secret.bin".to_owned()];
    uris.extend(["in/../../secret.bin".to_owned(), "..%2fsecret.bin".to_owned()]);
    if cfg!(unix) {
        uris.extend([secret.to_owned(), format!("file://{secret}"), format!("file:{secret}")]);
        uris.push(format!("FILE://localhost{secret}"));
        uris.push(format!("%2F{}", &secret[1..]));
    }
    for uri in &uris {
        // Long ones are not told whole.
        let shown = if uri.len() <= 40 { uri.clone() } else { format!("{}...", &uri[..40]) };
        assert_eq!(folder.read(uri, false), outside(&shown), "{uri}");
        assert_eq!(folder.read(uri, true), Ok(()), "{uri}");
    }
}

#[cfg(unix)]
#[test]
fn links_lead_where_they_lead() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new();
    let model = folder.root.path().join("model");
    symlink("../secret.bin", model.join("link.bin")).unwrap();
    symlink("..", model.join("up")).unwrap();
    symlink("in", model.join("inner")).unwrap();
    for uri in ["link.bin", "up/secret.bin"] {
        assert_eq!(folder.read(uri, false), outside(uri));
        assert_eq!(folder.read(uri, true), Ok(()), "{uri}");
    }
    for uri in ["inner/a.bin", "up/model/in/a.bin"] {
        assert_eq!(folder.read(uri, false), Ok(()), "{uri}");
    }
    // The folder is where the document is said to be, not where it is kept.
    let elsewhere = folder.root.path().join("kept.gltf");
    assert_eq!(folder.read("in/a.bin", false), Ok(()));
    std::fs::rename(folder.model(), &elsewhere).unwrap();
    symlink(&elsewhere, folder.model()).unwrap();
    let read = |path: &Path| umriss::model::import::read_file(path, None).is_ok();
    assert!(read(&folder.model()));
    assert!(!read(&elsewhere));
}

#[test]
fn files_of_the_folder_are_read() {
    let folder = Folder::new();
    for uri in ["in/a.bin", "./in/a.bin", "in/../in/a.bin", "../model/in/a.bin", "in%2Fa.bin"] {
        assert_eq!(folder.read(uri, false), Ok(()), "{uri}");
    }
    if cfg!(unix) {
        assert_eq!(folder.read("a%3Ab.bin", false), Ok(()));
    }
}

#[test]
fn whether_there_is_a_file_outside_is_not_told() {
    let folder = Folder::new();
    assert_eq!(folder.read("../missing.bin", false), outside("../missing.bin"));
    let missing = unreadable("file '../missing.bin' does not exist, expected a buffer");
    assert_eq!(folder.read("../missing.bin", true), missing);
    let missing = unreadable("file 'missing.bin' does not exist, expected a buffer");
    assert_eq!(folder.read("missing.bin", false), missing);
}

#[test]
fn what_is_no_file_is_not_read() {
    let folder = Folder::new();
    for allow_outside in [false, true] {
        let no_file = unreadable("file 'in' is no file, expected a buffer");
        assert_eq!(folder.read("in", allow_outside), no_file);
        for uri in ["https://example.com/a.bin", "smb://host/a.bin", "a%00.bin", "a%zz.bin"] {
            let message = format!("uri '{uri}' is not read, expected the path of a file");
            assert_eq!(folder.read(uri, allow_outside), unreadable(&message));
        }
    }
    if cfg!(unix) {
        let no_file = unreadable("file '/dev/zero' is no file, expected a buffer");
        assert_eq!(folder.read("/dev/zero", true), no_file);
    }
}
