//! A folder with models in it, in which the program is run.

use assert_cmd::Command;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A cube of 10 mm, quadrilaterals.
const CUBE: &str = "\
o cube
v 0 0 0
v 10 0 0
v 10 10 0
v 0 10 0
v 0 0 10
v 10 0 10
v 10 10 10
v 0 10 10
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
";

/// A triangle with legs of length 1 along x and y.
pub(crate) const TRIANGLE_GLTF: &str = r#"{"asset":{"version":"2.0"},"scene":0,
"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
"min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;

/// A hilly surface of `side` by `side` quadrilaterals.
pub(crate) fn wave(side: usize) -> String {
    let mut text = "o wave\n".to_owned();
    for y in 0..=side {
        for x in 0..=side {
            let height = (x as f64 * 0.9).sin() * (y as f64 * 0.7).cos() * 2.0;
            writeln!(text, "v {x} {y} {height}").unwrap();
        }
    }
    for y in 0..side {
        for x in 1..=side {
            let corner = y * (side + 1) + x;
            let above = corner + side + 1;
            writeln!(text, "f {corner} {} {} {above}", corner + 1, above + 1).unwrap();
        }
    }
    text
}

/// A ball of `around` times half as many faces.
pub(crate) fn ball(around: usize) -> String {
    let mut text = "o ball\n".to_owned();
    let rows = around / 2;
    for row in 0..=rows {
        let (height, radius) = (row as f64 / rows as f64 * std::f64::consts::PI).sin_cos();
        for step in 0..around {
            let (y, x) = (step as f64 / around as f64 * std::f64::consts::TAU).sin_cos();
            writeln!(text, "v {} {} {}", height * x, height * y, radius).unwrap();
        }
    }
    for row in 0..rows {
        for step in 0..around {
            let [a, b] = [step, (step + 1) % around].map(|step| row * around + step + 1);
            writeln!(text, "f {a} {} {} {b}", a + around, b + around).unwrap();
        }
    }
    text
}

/// An input of `tests/field`.
pub(crate) fn field(name: &str) -> String {
    fs::read_to_string(format!("{}/tests/field/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

pub(crate) fn assert_near(length: f64, expected: f64, what: &str) {
    assert!((length - expected).abs() < 0.1, "{length} mm, not {expected} mm: {what}");
}

/// The length of all paths of an SVG.
pub(crate) fn drawn_length(svg: &str) -> f64 {
    let mut length = 0.0;
    for line in svg.lines().filter(|line| line.starts_with("<path")) {
        let data = line.split('"').nth(1).unwrap();
        for stroke in data.split('M').skip(1) {
            let closed = stroke.ends_with('Z');
            let mut points: Vec<[f64; 2]> = stroke
                .trim_end_matches('Z')
                .split('L')
                .map(|point| {
                    let (x, y) = point.split_once(' ').unwrap();
                    [x.parse().unwrap(), y.parse().unwrap()]
                })
                .collect();
            points.extend(closed.then_some(points[0]));
            length += points
                .windows(2)
                .map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]))
                .sum::<f64>();
        }
    }
    length
}

/// What the program said.
pub(crate) struct Said {
    pub(crate) output: String,
    pub(crate) errors: String,
}

/// A folder of its own for one test.
pub(crate) struct Folder {
    folder: TempDir,
}

impl Folder {
    /// A folder that holds `cube.obj`.
    pub(crate) fn with_cube() -> Self {
        let folder = Folder { folder: tempfile::tempdir().unwrap() };
        folder.write("cube.obj", CUBE);
        folder
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        self.write_bytes(name, text.as_bytes());
    }

    pub(crate) fn write_bytes(&self, name: &str, bytes: &[u8]) {
        fs::write(self.folder.path().join(name), bytes).unwrap();
    }

    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.folder.path().join(name)).unwrap()
    }

    pub(crate) fn text(&self, name: &str) -> String {
        String::from_utf8(self.bytes(name)).unwrap()
    }

    pub(crate) fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Everything in the folder.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// The program with arguments that are separated by blanks.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_umriss"));
        command.current_dir(self.folder.path()).args(arguments.split_whitespace());
        command
    }

    pub(crate) fn succeeds(&self, arguments: &str) -> Said {
        self.succeeds_with_input(arguments, &[])
    }

    pub(crate) fn succeeds_with_input(&self, arguments: &str, input: &[u8]) -> Said {
        let result = self.command(arguments).write_stdin(input).output().unwrap();
        let said = Said {
            output: String::from_utf8(result.stdout).unwrap(),
            errors: String::from_utf8(result.stderr).unwrap(),
        };
        assert_eq!(result.status.code(), Some(0), "{arguments}: {}", said.errors);
        said
    }

    /// The program ends with this code, says this, and leaves the folder as
    /// it was.
    pub(crate) fn fails(&self, code: i32, arguments: &str, message: &str) {
        let before = self.names();
        let result = self.command(arguments).output().unwrap();
        let errors = String::from_utf8(result.stderr).unwrap();
        assert_eq!(errors, message, "{arguments}");
        assert_eq!(result.status.code(), Some(code), "{arguments}");
        assert!(result.stdout.is_empty(), "{arguments}");
        assert_eq!(self.names(), before, "{arguments}");
    }
}
