//! What the sweep line crosses just now, from bottom to top.
//!
//! Slots stand in blocks of a few dozen, the blocks in a list: a place is
//! found by halving the list of blocks and then a block, a slot is put in by
//! moving at most a block. (One level of a B-tree, Bayer and McCreight 1972.
//! With n slots a step costs O(log n), moving the list when a block is split
//! costs O(n) memory moves once in dozens of steps; no sweep is wide enough
//! for a second level to pay.) Neighbours are linked, so they cost nothing.

use crate::kernel::numbers::Sign;

/// No slot.
pub(super) const NONE: u32 = u32::MAX;

/// Slots in a block before it is split.
const BLOCK: usize = 48;

/// The order of slots along the sweep line.
#[derive(Debug, Default)]
pub(super) struct Status {
    blocks: Vec<Vec<u32>>,
    /// Blocks from bottom to top.
    order: Vec<u32>,
    /// Blocks not in use.
    free: Vec<u32>,
    links: Vec<Link>,
    lowest: Option<u32>,
}

#[derive(Debug, Clone, Copy)]
struct Link {
    below: u32,
    above: u32,
    block: u32,
}

impl Status {
    /// The slot below, or [`NONE`].
    #[inline]
    pub(super) fn below(&self, slot: u32) -> u32 {
        self.links[slot as usize].below
    }

    /// The slot above; of [`NONE`] the lowest of all.
    #[inline]
    pub(super) fn above(&self, slot: u32) -> u32 {
        if slot == NONE {
            return self.lowest.unwrap_or(NONE);
        }
        self.links[slot as usize].above
    }

    /// Puts `slot` above `below`, or lowest where that is [`NONE`].
    pub(super) fn insert_above(&mut self, below: u32, slot: u32) {
        let above = self.above(below);
        if self.links.len() <= slot as usize {
            let unused = Link { below: NONE, above: NONE, block: NONE };
            self.links.resize(slot as usize + 1, unused);
        }
        let (block, place) = if below != NONE {
            let block = self.links[below as usize].block;
            (block, self.place_in(block, below) + 1)
        } else if let Some(&lowest) = self.order.first() {
            (lowest, 0)
        } else {
            let block = self.new_block();
            self.order.push(block);
            (block, 0)
        };
        self.blocks[block as usize].insert(place, slot);
        self.links[slot as usize] = Link { below, above, block };
        match below {
            NONE => self.lowest = Some(slot),
            _ => self.links[below as usize].above = slot,
        }
        if above != NONE {
            self.links[above as usize].below = slot;
        }
        if self.blocks[block as usize].len() > BLOCK {
            self.split(block);
        }
    }

    /// Takes a slot out.
    pub(super) fn remove(&mut self, slot: u32) {
        let Link { below, above, block } = self.links[slot as usize];
        let place = self.place_in(block, slot);
        self.blocks[block as usize].remove(place);
        if self.blocks[block as usize].is_empty() {
            self.order.retain(|&other| other != block);
            self.free.push(block);
        }
        match below {
            NONE => self.lowest = (above != NONE).then_some(above),
            _ => self.links[below as usize].above = above,
        }
        if above != NONE {
            self.links[above as usize].below = below;
        }
    }

    /// Finds a place by where it lies beside each slot: `Ok` of a slot on
    /// which it lies, or `Err` of the slot below it, which may be [`NONE`].
    pub(super) fn locate(&self, mut beside: impl FnMut(u32) -> Sign) -> Result<u32, u32> {
        let block = self
            .order
            .partition_point(|&block| beside(self.blocks[block as usize][0]) == Sign::Positive);
        // The first slots of all blocks before this one are below.
        let mut found = match self.order.get(block) {
            Some(&block) => self.blocks[block as usize][0],
            None => NONE,
        };
        if block > 0 {
            let slots = &self.blocks[self.order[block - 1] as usize];
            let place = slots.partition_point(|&slot| beside(slot) == Sign::Positive);
            if let Some(&slot) = slots.get(place) {
                found = slot;
            } else if found == NONE {
                return Err(slots[slots.len() - 1]);
            }
        }
        if found == NONE {
            return Err(NONE);
        }
        if beside(found).is_zero() { Ok(found) } else { Err(self.below(found)) }
    }

    fn place_in(&self, block: u32, slot: u32) -> usize {
        let slots = &self.blocks[block as usize];
        slots.iter().position(|&other| other == slot).unwrap_or(slots.len())
    }

    fn new_block(&mut self) -> u32 {
        self.free.pop().unwrap_or_else(|| {
            self.blocks.push(Vec::with_capacity(BLOCK + 1));
            self.blocks.len() as u32 - 1
        })
    }

    fn split(&mut self, block: u32) {
        let upper = self.new_block();
        let mut moved = std::mem::take(&mut self.blocks[upper as usize]);
        moved.extend(self.blocks[block as usize].drain(BLOCK / 2..));
        for &slot in &moved {
            self.links[slot as usize].block = upper;
        }
        self.blocks[upper as usize] = moved;
        let place = self.order.iter().position(|&other| other == block);
        self.order.insert(place.map_or(self.order.len(), |place| place + 1), upper);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A generator of numbers (Lehmer 1951).
    fn draw(seed: &mut u64) -> u64 {
        *seed =
            seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *seed >> 33
    }

    #[test]
    fn slots_keep_the_order_of_a_sorted_list() {
        let mut seed = 7;
        let mut status = Status::default();
        // Slot i stands at height[i].
        let mut height: Vec<u64> = Vec::new();
        let mut sorted: Vec<(u64, u32)> = Vec::new();
        for round in 0..4000_u32 {
            if round % 3 == 2 {
                let (_, slot) = sorted.remove(draw(&mut seed) as usize % sorted.len());
                status.remove(slot);
            }
            let new = draw(&mut seed) << 13 | u64::from(round);
            let place = sorted.partition_point(|(other, _)| *other < new);
            let beside = |slot: u32| Sign::from(new.cmp(&height[slot as usize]));
            let below = if place == 0 { NONE } else { sorted[place - 1].1 };
            assert_eq!(status.locate(beside), Err(below));
            let slot = height.len() as u32;
            height.push(new);
            status.insert_above(below, slot);
            sorted.insert(place, (new, slot));
            let beside = |slot: u32| Sign::from(new.cmp(&height[slot as usize]));
            assert_eq!(status.locate(beside), Ok(slot));
        }
        let mut slot = status.above(NONE);
        for (_, expected) in &sorted {
            assert_eq!(slot, *expected);
            slot = status.above(slot);
        }
        assert_eq!(slot, NONE);
        sorted.iter().for_each(|(_, slot)| status.remove(*slot));
        assert_eq!(status.above(NONE), NONE);
        assert_eq!(status.locate(|_| Sign::Zero), Err(NONE));
    }
}
