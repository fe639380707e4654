//! What hangs together: union-find with path halving.
//!
//! Source: R. Tarjan and J. van Leeuwen, "Worst-case analysis of set union
//! algorithms", 1984.

/// The representative of an item, the least of its class; paths are halved
/// on the way.
#[inline]
pub(super) fn root(parents: &mut [u32], mut item: u32) -> u32 {
    while parents[item as usize] != item {
        let above = parents[parents[item as usize] as usize];
        parents[item as usize] = above;
        item = above;
    }
    item
}

/// Makes one class of two items' classes; whether they were two.
#[inline]
pub(super) fn join(parents: &mut [u32], [one, other]: [u32; 2]) -> bool {
    let roots = [root(parents, one), root(parents, other)];
    parents[roots[0].max(roots[1]) as usize] = roots[0].min(roots[1]);
    roots[0] != roots[1]
}
