//! The way of the pen, and what is told about it.

use super::fixture::{self, Folder, drawn_length};

/// A counter that `--stats` prints.
fn told(errors: &str, name: &str) -> u64 {
    let line = errors.lines().find(|line| line.starts_with(name)).unwrap_or("");
    line.split_whitespace().nth(1).unwrap_or_else(|| panic!("{name} in {errors}")).parse().unwrap()
}

#[test]
fn an_order_draws_the_same_with_fewer_and_shorter_ways() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(24));
    folder.succeeds("draw wave.obj -o w.json --hidden solid --edges contour,boundary,crease,mesh");
    let draw = |order: &str| {
        let said = folder.succeeds(&format!(
            "draw w.json -o a.svg --hidden dashed --order {order} --stats --precision 9"
        ));
        (told(&said.errors, "pen-up-mm"), told(&said.errors, "pen-strokes"), folder.text("a.svg"))
    };
    let [keep, greedy, best] = ["keep", "greedy", "best"].map(draw);
    assert!(greedy.0 < keep.0 && best.0 < greedy.0, "{} {} {}", keep.0, greedy.0, best.0);
    assert!(best.1 <= keep.1);
    let [before, after] = [&keep.2, &best.2].map(|svg| drawn_length(svg));
    assert!((before - after).abs() < 1e-6 * before, "{before} {after}");
    assert_eq!(draw("best").2, best.2);
    assert_ne!(draw("9000").2, greedy.2);
}

#[test]
fn an_order_in_seconds_says_that_it_depends_on_the_machine() {
    let folder = Folder::with_cube();
    let errors = folder.succeeds("draw cube.obj -o a.svg --order 0.01s").errors;
    assert!(errors.contains("depends on the machine"), "{errors}");
    assert_eq!(folder.succeeds("draw cube.obj -o a.svg --order best").errors, "");
    folder.fails(
        2,
        "draw cube.obj -o b.svg --order fast",
        "umriss: invalid value 'fast' for '--order <HOW>': `fast` is no choice here; expected \
         keep, greedy, best, a number of steps, or a time as in 2s\n\n\
         For more information, try '--help'.\n",
    );
}

#[test]
fn an_order_does_not_depend_on_the_number_of_threads() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(30));
    for threads in ["1", "2"] {
        folder.succeeds(&format!(
            "draw wave.obj -o {threads}.hpgl --hidden dashed --order best --threads {threads}"
        ));
    }
    assert!(folder.bytes("1.hpgl") == folder.bytes("2.hpgl"));
}
