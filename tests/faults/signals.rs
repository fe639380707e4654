//! Signals: the program ends, says so, and leaves nothing.

use super::crowds::{folder_with, names, stl, through_one_another};
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// Starts the program on work that would take hours.
fn start(folder: &Path, arguments: &str) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_umriss"));
    command.current_dir(folder).args(arguments.split(' '));
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

fn signal(child: &Child, name: &str) {
    let mut kill = Command::new("kill");
    assert!(kill.args([name, &child.id().to_string()]).status().unwrap().success());
}

/// Waits until the program has told something, which it does before it computes.
fn wait_for_a_note(child: &mut Child) -> BufReader<std::process::ChildStderr> {
    let mut errors = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    errors.read_line(&mut line).unwrap();
    assert!(line.contains("--weld"), "{line}");
    errors
}

#[test]
fn a_signal_ends_the_program_and_leaves_nothing() {
    let folder = folder_with("crowd.stl", &stl(&through_one_another(40_000)));
    for name in ["-INT", "-TERM", "-HUP"] {
        let arguments = "draw crowd.stl -o a.svg -o a.json --weld 1e-9 --max-memory none";
        let mut child = start(folder.path(), arguments);
        let mut errors = wait_for_a_note(&mut child);
        signal(&child, name);
        let mut told = String::new();
        errors.read_to_string(&mut told).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(130), "{name}");
        assert_eq!(told, "umriss: interrupted before the work was done\n", "{name}");
        assert_eq!(names(folder.path()), ["crowd.stl"], "{name}");
    }
}

#[test]
fn a_program_that_waits_for_its_input_ends_too() {
    let folder = folder_with("crowd.stl", b"");
    // Nobody ever writes to its standard input. Whether the signal is awaited
    // already cannot be seen from outside, so it comes until one is noticed.
    let mut child = start(folder.path(), "draw - -o a.svg");
    while child.try_wait().unwrap().is_none() {
        signal(&child, "-INT");
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    // None is the signal itself, where it came before the program listened.
    assert!(matches!(child.wait().unwrap().code(), Some(130) | None));
    assert_eq!(names(folder.path()), ["crowd.stl"]);
}

#[test]
fn a_second_signal_ends_the_program_at_once() {
    let folder = folder_with("crowd.stl", &stl(&through_one_another(40_000)));
    let mut child = start(folder.path(), "draw crowd.stl -o a.svg --weld 1e-9 --max-memory none");
    let _errors = wait_for_a_note(&mut child);
    signal(&child, "-INT");
    signal(&child, "-INT");
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(names(folder.path()), ["crowd.stl"]);
}
