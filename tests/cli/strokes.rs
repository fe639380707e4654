//! Strokes on request: joined by class, without tiny ones, simpler, curved.

use super::fixture::{self, Folder, drawn_length};

#[test]
fn curves_and_fewer_points_keep_to_the_tolerance_in_every_format() {
    let folder = Folder::with_cube();
    folder.write("ball.obj", &fixture::ball(64));
    let draw = |flags: &str| {
        folder.succeeds(&format!(
            "draw ball.obj -o a.svg -o a.hpgl -o a.png --hidden dashed --order best {flags}"
        ));
        (folder.text("a.svg"), folder.text("a.hpgl"))
    };
    let (plain, _) = draw("");
    let (simple, hpgl) = draw("--simplify 0.1mm");
    assert!(simple.len() < plain.len() && !simple.contains('C'));
    let [before, after] = [&plain, &simple].map(|svg| drawn_length(svg));
    assert!((before - after).abs() < 0.01 * before, "{before} {after}");
    let (curved, plotted) = draw("--fit 0.1mm");
    assert!(curved.lines().any(|line| line.starts_with("<path") && line.contains('C')));
    assert!(curved.len() < plain.len(), "{} of {}", curved.len(), plain.len());
    assert!(hpgl.starts_with("IN;") && plotted.starts_with("IN;"));
    assert_eq!(draw("--fit 0").0, plain);
    assert!(draw("--min-length 90cm").0.len() < 1000);
    let errors =
        folder.command("draw ball.obj -o b.svg --fit 1mm --simplify 1mm").output().unwrap();
    assert_eq!(errors.status.code(), Some(2));
}

#[test]
fn contours_are_joined_with_contours_alone() {
    let folder = Folder::with_cube();
    let count = |flags: &str| {
        folder.succeeds(&format!("draw cube.obj -o a.svg {flags}"));
        folder.text("a.svg").matches('M').count()
    };
    // The hexagon of the outline is closed; three creases meet in a corner.
    assert_eq!(count("--join class"), 3);
    assert!(count("--join all") <= 3);
}
