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

#[test]
fn a_plotter_is_named_or_described_in_a_file() {
    let folder = Folder::with_cube();
    folder
        .succeeds("draw cube.obj -o a.hpgl --device HP7475A --margin 16mm --speed 12.5 --relative");
    let text = folder.text("a.hpgl");
    assert!(text.starts_with("IN;\nVS12.5;\nPS4;\nSP1;\nPU") && text.contains("PR;\nPD"), "{text}");
    folder.write(
        "mine.toml",
        "[mine]\nname = \"Mine\"\nunit = 0.1\npens = 1\nvelocity = [1, 5]\ndown = 5\nup = 5\n\
         lift = 1\nchange = 1\npaper = [{ name = \"card\", size = [100, 60], x = [0, 1000], \
         y = [0, 600], origin = [0, 60] }]\n",
    );
    folder.succeeds(
        "draw cube.obj -o b.hpgl -o b.svg --device mine --devices mine.toml --paper 100x60mm \
         --view front --scale 1:1",
    );
    assert!(
        folder.text("b.hpgl").contains("PU450,250;\nPD550,250,550,350,"),
        "{}",
        folder.text("b.hpgl")
    );
    folder.write("bad.toml", "[mine]\nname = 5\n");
    for (flags, code, message) in [
        (
            "--device nope",
            2,
            "--device nope: no such plotter, expected one of generic, dxy, hp7440a, hp7475a, \
             hp7550a",
        ),
        (
            "--devices none.toml",
            1,
            "none.toml: cannot be read: No such file or directory (os error 2)",
        ),
        ("--devices bad.toml", 1, "bad.toml:2: invalid type: integer `5`, expected a string"),
        (
            "--device dxy --speed 70",
            1,
            "HPGL: the Roland DXY-1000 series cannot draw at 70 cm/s; expected 1 to 60",
        ),
        (
            "--device dxy --paper a5",
            1,
            "HPGL: the Roland DXY-1000 series has no sheet for a page of 148 x 210 mm; expected \
             one of A4, A3, ANSI A, ANSI B, standing or lying",
        ),
    ] {
        let command = format!("draw cube.obj -o c.hpgl {flags}");
        folder.fails(code, &command, &format!("umriss: {message}\n"));
    }
}

#[test]
fn a_drawing_out_of_reach_is_refused_with_the_numbers_or_cut() {
    let folder = Folder::with_cube();
    let draw = "draw cube.obj -o a.hpgl --device hp7475a --view front";
    folder.fails(
        1,
        draw,
        "umriss: HPGL: with A4 paper the HP 7475A reaches x 0 to 11040 and y 0 to 7721, that is \
         4.00,10.00 to 196.10,284.68 mm of the page; the drawing needs 10.00,53.50 to \
         200.00,243.50 mm: expected a wider --margin, or --cut\n",
    );
    folder.succeeds(&format!("{draw} --cut -o a.svg"));
    let text = folder.text("a.hpgl");
    assert!(text.contains(",7721") || text.contains(",0;"), "{text}");
    assert!(folder.text("a.svg").contains("M10 243.5"), "the other outputs are not cut");
}

#[test]
fn a_thin_pen_draws_wide_lines_around_and_around() {
    let folder = Folder::with_cube();
    let page = "--paper tight --scale 1:1 --precision 9";
    let length = |flags: &str| {
        folder.succeeds(&format!("draw cube.obj -o a.svg {page} {flags}"));
        (drawn_length(&folder.text("a.svg")), folder.text("a.svg"))
    };
    let (once, _) = length("");
    // Lines of 0.5 mm: two strokes of 0.3 mm. Only the ends are longer.
    let (twice, svg) = length("--pen-width 0.3mm");
    assert!(svg.contains("stroke-width=\"0.3\"") && !svg.contains("stroke-width=\"0.5\""));
    assert!(2.0 * once < twice && twice < 2.0 * once + 8.0, "{once} {twice}");
    assert_eq!(length("--pen-width 0.5mm"), length(""));
    assert_eq!(length("--pen-width 2mm"), length(""));
    folder.fails(
        2,
        "draw cube.obj -o b.svg --pen-width 0mm",
        "umriss: invalid value '0mm' for '--pen-width <L>': expected 0.01 mm to 100 mm\n\n\
         For more information, try '--help'.\n",
    );
}
