//! Samples of an image made by casting rays: what is painted last at each?

use super::{Faces, PART, PaintReport, shadows};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{PlanePoint, Policy, Predicates};
use crate::raster::ItemBuffer;
use crate::raster::samples::Sampled;
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::PaintOrder;

/// What lies on top at a sample.
#[derive(Clone, Copy)]
enum Top {
    Paper,
    Face(u32),
    /// The border of a piece, of which a picture says nothing.
    Border,
}

/// Samples of an image against what is painted there.
pub(super) fn check_owners<P: Policy>(
    sampled: &Sampled<'_>,
    faces: &Faces,
    order: &PaintOrder,
    buffer: &ItemBuffer,
    report: &mut PaintReport,
    run: &Run<'_>,
) -> Result<(), Cancelled> {
    let (width, height) = (sampled.samples().width(), sampled.samples().height());
    let shadows = shadows(&Predicates::<P>::new(sampled.points()), order);
    // Rows are painted apart from one another.
    let rows = run.stage("verify-paint-owners", u64::from(height), || {
        map_chunks(height as usize, PART.div_ceil(8), |rows| {
            run.check()?;
            let predicates = Predicates::<P>::new(sampled.points());
            let mut tops = vec![Top::Paper; rows.len() * width as usize];
            for (piece, shadow) in order.pieces.iter().zip(&shadows) {
                run.check()?;
                run.advance(0);
                let triangles = faces.triangles(piece).map(|t| sampled.triangle(t).0);
                let Some([columns, reached]) = sampled.reach(triangles) else { continue };
                let first = reached[0].max(rows.start as u32);
                for row in first..(reached[1] + 1).min(rows.end as u32) {
                    for column in columns[0]..=columns[1] {
                        let sample = PlanePoint::Vertex(sampled.vertex([column, row]));
                        let signs = shadow
                            .iter()
                            .map(|&(plane, inside)| predicates.above(plane, sample) * inside);
                        let least = least(signs);
                        let place = (row as usize - rows.start) * width as usize + column as usize;
                        match least {
                            Sign::Negative => {}
                            Sign::Zero => tops[place] = Top::Border,
                            Sign::Positive => tops[place] = Top::Face(piece.face),
                        }
                    }
                }
            }
            run.merge(&predicates.counters());
            Ok(tops)
        })
    });
    let mut place = 0..;
    for tops in rows {
        for (top, place) in tops?.into_iter().zip(&mut place) {
            let [column, row] = [place % width, place / width];
            let seen = buffer.item(column, row).map(|triangle| sampled.face_of(triangle));
            let same = match top {
                Top::Border => {
                    report.last().owner.skipped += 1;
                    continue;
                }
                Top::Paper => seen.is_none(),
                Top::Face(face) => seen == Some(face),
            };
            if same {
                report.last().owner.agree += 1;
            } else {
                report.last().owner.differ += 1;
                let found = if let Top::Face(face) = top { Some(face) } else { None };
                report.describe(format!(
                    "owner: sample {column} {row} sees face {seen:?}, painted last is {found:?}"
                ));
            }
        }
    }
    Ok(())
}

fn least(signs: impl Iterator<Item = Sign>) -> Sign {
    let mut least = Sign::Positive;
    for sign in signs {
        match sign {
            Sign::Negative => return sign,
            Sign::Zero => least = sign,
            Sign::Positive => {}
        }
    }
    least
}
