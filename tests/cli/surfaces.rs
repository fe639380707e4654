//! Fills, hatches, and lines from the borders of regions.

use super::fixture::{self, Folder};

#[test]
fn borders_of_regions_are_the_visible_lines() {
    let folder = Folder::with_cube();
    folder.write("wave.obj", &fixture::wave(12));
    for flags in ["", "--edges contour,boundary,crease,mesh", "--eye 30,-40,25 --target 5,5,0"] {
        folder.succeeds(&format!("draw wave.obj -o appel.svg {flags}"));
        folder.succeeds(&format!("draw wave.obj -o regions.svg {flags} --method weiler-atherton"));
        assert_eq!(folder.text("appel.svg"), folder.text("regions.svg"), "{flags}");
    }
    folder.fails(
        2,
        "draw cube.obj -o b.svg --method weiler-atherton --hidden dashed",
        "umriss: --method weiler-atherton: regions know nothing of hidden lines, expected --hidden \
         none or --method appel\n",
    );
}

#[test]
fn a_cube_has_three_shades_and_one_colour() {
    let folder = Folder::with_cube();
    let fills = |flags: &str| {
        folder.succeeds(&format!("draw cube.obj -o a.svg {flags}"));
        let text = folder.text("a.svg");
        let group = text
            .split("id=\"fill\"")
            .nth(1)
            .map_or("", |rest| rest.split("</g>").next().unwrap_or_default());
        group.matches("<path").count()
    };
    assert_eq!(fills(""), 0);
    assert_eq!(fills("--fill flat"), 1);
    assert_eq!(fills("--fill shade"), 3);
    assert_eq!(fills("--fill shade --light 1,1,1"), 1);
}

#[test]
fn a_hatch_has_a_pen_of_its_own() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o a.svg -o a.hpgl --hatch flat --hatch-spacing 2mm");
    let (svg, hpgl) = (folder.text("a.svg"), folder.text("a.hpgl"));
    assert!(svg.contains("3-hatch") && svg.contains("1-visible"));
    assert!(hpgl.contains("SP3;") && hpgl.contains("SP1;"));
    folder.succeeds("draw cube.obj -o b.svg --hatch flat --hatch-spacing 1mm --threads 1");
    let hatch = |svg: &str| svg.split("3-hatch").nth(1).unwrap_or_default().matches('M').count();
    let (coarse, fine) = (hatch(&svg), hatch(&folder.text("b.svg")));
    assert!(coarse * 9 < fine * 5 && fine < coarse * 3, "{coarse} {fine}");
}

#[test]
fn surfaces_need_a_model_and_a_hatch_that_can_be_drawn() {
    let folder = Folder::with_cube();
    folder.succeeds("draw cube.obj -o cube.json");
    folder.fails(
        2,
        "draw cube.json -o a.svg --fill shade",
        "umriss: a computed drawing cannot be computed otherwise: expected a model, or no flags for \
         --fill and --hatch\n",
    );
    folder.fails(
        2,
        "draw cube.obj -o a.svg --hatch flat --hatch-spacing 0.001mm",
        "umriss: hatch lines 0.001 mm apart; expected at least 0.02 mm\n",
    );
}

#[test]
fn a_painted_cube_covers_its_far_faces() {
    let folder = Folder::with_cube();
    for painter in ["graph", "list", "tree"] {
        let flags = format!("--method painter --painter {painter} --fill shade");
        folder.succeeds(&format!("draw cube.obj -o a.svg -o a.png {flags}"));
        let text = folder.text("a.svg");
        let paint = text.split("id=\"paint\"").nth(1).unwrap_or_default();
        // Six faces, each an area and its lines; the three seen come last.
        assert_eq!(paint.matches("<path").count(), 12, "{painter}");
        assert_eq!(paint.matches("fill=\"none\"").count(), 6);
        assert!(!text.contains("1-visible"));
    }
    folder.succeeds("draw cube.obj -o b.svg --method painter --eye 30,-40,25 --target 5,5,5");
    let text = folder.text("b.svg");
    assert!(text.contains("fill=\"#ffffff\""), "paper hides too");
}

#[test]
fn bars_in_a_cycle_are_cut_and_counted() {
    let folder = Folder::with_cube();
    folder.write(
        "bars.obj",
        "v 0 0 0\nv 10 0 2\nv 10 1 2\nv 0 1 0\nv 9 0 0\nv 10 0 0\nv 10 10 2\nv 9 10 2\n\
         v 0 1 2\nv 1 0 2\nv 10 9 0\nv 9 10 0\nf 1 2 3 4\nf 5 6 7 8\nf 9 10 11 12\n",
    );
    let stats = folder.succeeds("draw bars.obj -o a.svg --view top --method painter --stats");
    let line = stats.errors.lines().find(|line| line.trim().starts_with("painter-cuts"));
    assert!(line.is_some_and(|line| line.trim_end().ends_with(" 1")), "{}", stats.errors);
}
