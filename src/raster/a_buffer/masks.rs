//! Masks of triangles, pixel after pixel.

use super::MaskTable;
use super::block::{Block, bits};
use super::fragments::Gathered;
use crate::kernel::predicates::Policy;
use crate::raster::samples::{Border, Face, Judge};
use crate::run::{Cancelled, Run};

/// Finds the mask of every face in every pixel and hands it to `insert`.
pub(super) fn gather<'s, P: Policy>(
    gathered: &mut Gathered<'s, P>,
    table: Option<&MaskTable>,
    mut insert: impl FnMut(&mut Gathered<'s, P>, [u32; 2], u32, u32),
    run: &Run,
) -> Result<(), Cancelled> {
    let faces = gathered.sampled().faces::<P>(run)?;
    let division = gathered.division();
    let count = faces.len() as u32;
    gathered.set_faces(faces);
    for index in 0..count {
        let face = gathered.face(index);
        let [columns, rows] = [
            face.footprint.columns.map(|column| column / division.columns()),
            face.footprint.rows.map(|row| row / division.rows()),
        ];
        for row in rows[0]..=rows[1] {
            for column in columns[0]..=columns[1] {
                let pixel = [column, row];
                let block = Block::new(pixel, division, &gathered.face(index).footprint);
                let judge = gathered.judge();
                let mask = match table {
                    None => direct(judge, gathered.face(index), &block),
                    Some(table) => tabulated(judge, gathered.face(index), &block, table),
                };
                if mask != 0 {
                    insert(gathered, pixel, index, mask);
                }
            }
        }
    }
    Ok(())
}

/// The sub-pixels of a block that see a face.
pub(super) fn direct<P: Policy>(judge: &Judge<'_, P>, face: &Face, block: &Block) -> u32 {
    let mut mask = block.bits;
    if mask == 0 {
        return 0;
    }
    for (k, border) in face.borders().iter().enumerate() {
        match side(border, block) {
            Side::Inside => {}
            Side::Outside => return 0,
            Side::Across => mask = inside(judge, face, k, block, mask),
        }
        if mask == 0 {
            return 0;
        }
    }
    mask
}

/// The bits of a mask whose samples lie in a half-plane of a face.
fn inside<P: Policy>(
    judge: &Judge<'_, P>,
    face: &Face,
    border: usize,
    block: &Block,
    mask: u32,
) -> u32 {
    let holds = |bit: &u32| judge.holds(face, border, block.sample(*bit));
    bits(mask).filter(holds).fold(0, |inside, bit| inside | 1 << bit)
}

/// Where a block lies against a border.
enum Side {
    Inside,
    Outside,
    Across,
}

/// Decides about all samples of a block, which are a box, by two of its
/// corners: the form grows towards the one and is least at the other.
#[inline(always)]
fn side(border: &Border, block: &Block) -> Side {
    let form = &border.form;
    let (low, high) = (block.bits.trailing_zeros(), 31 - block.bits.leading_zeros());
    let [column, row] = block.first;
    let columns = [column + (low & 3), column + (high & 3)];
    let rows = [row + (low >> 2), row + (high >> 2)];
    let (right, down) = (usize::from(form.right() > 0.0), usize::from(form.down() > 0.0));
    let most = form.at([columns[right], rows[down]]);
    let least = form.at([columns[1 - right], rows[1 - down]]);
    // Proposals grow with the form's own steps, rounding or not, so those
    // between lie between.
    if least > form.bound() {
        Side::Inside
    } else if most < -form.bound() {
        Side::Outside
    } else {
        Side::Across
    }
}

/// A mask by table: the masks of the half-planes, cut off one by one. The
/// near plane is no edge, and taken as it is.
fn tabulated<P: Policy>(
    judge: &Judge<'_, P>,
    face: &Face,
    block: &Block,
    table: &MaskTable,
) -> u32 {
    let mut mask = block.bits;
    let Some(any) = bits(mask).next() else {
        return 0;
    };
    let base = block.sample(any);
    for (k, border) in face.borders().iter().enumerate() {
        if 2 < k {
            mask = inside(judge, face, k, block, mask);
            continue;
        }
        let form = &border.form;
        let division = table.division();
        let [columns, rows] = [division.columns(), division.rows()].map(f64::from);
        // From the sample at hand to the middle of the pixel.
        let back = [f64::from(any & 3), f64::from(any >> 2)];
        let middle = form.at(base)
            + form.right() * ((columns - 1.0) / 2.0 - back[0])
            + form.down() * ((rows - 1.0) / 2.0 - back[1]);
        mask &= table.half_plane([form.right() * columns, form.down() * rows], middle);
    }
    mask
}
