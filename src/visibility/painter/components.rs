//! Strongly connected components of a graph (Tarjan 1972), without recursion.

/// Not yet met.
const NEW: u32 = u32::MAX;

/// The components with more than one node of the graph on `nodes`, ascending
/// each. `next` gives the i-th node to which an edge leads from a node, until
/// there is none, and must stay within `nodes`. `scratch` is as long as the
/// numbers of nodes are high. O(nodes + edges).
pub(super) fn components(
    nodes: impl Iterator<Item = u32>,
    scratch: &mut Scratch,
    next: impl Fn(u32, usize) -> Option<u32>,
) -> Vec<Vec<u32>> {
    let mut search = Search { scratch, open: Vec::new(), path: Vec::new(), met: 0 };
    let mut found = Vec::new();
    for root in nodes {
        if search.scratch.index[root as usize] == NEW {
            search.from(root, &next, &mut found);
        }
    }
    for node in std::mem::take(&mut search.scratch.touched) {
        search.scratch.index[node as usize] = NEW;
        search.scratch.is_open[node as usize] = false;
    }
    found
}

/// What is known of nodes; kept so that small graphs cost little.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    /// When a node was met.
    index: Vec<u32>,
    /// The earliest node known to be reached from it.
    low: Vec<u32>,
    /// Whether its component is not closed yet.
    is_open: Vec<bool>,
    touched: Vec<u32>,
}

impl Scratch {
    /// Makes room for nodes up to `count`.
    pub(super) fn grow(&mut self, count: usize) {
        self.index.resize(count, NEW);
        self.low.resize(count, NEW);
        self.is_open.resize(count, false);
    }
}

struct Search<'s> {
    scratch: &'s mut Scratch,
    open: Vec<u32>,
    /// Nodes from the root to where the search is, with the edges done.
    path: Vec<(u32, usize)>,
    met: u32,
}

impl Search<'_> {
    fn meet(&mut self, node: u32) {
        let place = node as usize;
        self.scratch.index[place] = self.met;
        self.scratch.low[place] = self.met;
        self.scratch.is_open[place] = true;
        self.scratch.touched.push(node);
        self.met += 1;
        self.open.push(node);
        self.path.push((node, 0));
    }

    fn from(
        &mut self,
        root: u32,
        next: &impl Fn(u32, usize) -> Option<u32>,
        found: &mut Vec<Vec<u32>>,
    ) {
        self.meet(root);
        while let Some((node, done)) = self.path.last_mut() {
            let own = *node as usize;
            let Some(to) = next(*node, *done) else {
                self.leave(own, found);
                continue;
            };
            *done += 1;
            if self.scratch.index[to as usize] == NEW {
                self.meet(to);
            } else if self.scratch.is_open[to as usize] {
                let reached = self.scratch.index[to as usize];
                self.scratch.low[own] = self.scratch.low[own].min(reached);
            }
        }
    }

    /// All edges of the last node of the path are done.
    fn leave(&mut self, own: usize, found: &mut Vec<Vec<u32>>) {
        self.path.pop();
        let low = self.scratch.low[own];
        if let Some((before, _)) = self.path.last() {
            let before = *before as usize;
            self.scratch.low[before] = self.scratch.low[before].min(low);
        }
        if low != self.scratch.index[own] {
            return;
        }
        let start = self.open.iter().rposition(|&node| node as usize == own).unwrap_or(0);
        let mut component = self.open.split_off(start);
        component.iter().for_each(|&node| self.scratch.is_open[node as usize] = false);
        if component.len() > 1 {
            component.sort_unstable();
            found.push(component);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(count: u32, edges: &[[u32; 2]]) -> Vec<Vec<u32>> {
        let mut scratch = Scratch::default();
        scratch.grow(count as usize);
        let next = |node: u32, i: usize| {
            edges.iter().filter(|edge| edge[0] == node).nth(i).map(|edge| edge[1])
        };
        let first = components(0..count, &mut scratch, next);
        assert_eq!(first, components(0..count, &mut scratch, next), "scratch is left clean");
        first
    }

    #[test]
    fn components_are_sets_of_nodes_that_reach_one_another() {
        assert_eq!(found(4, &[[0, 1], [1, 2], [2, 3], [0, 3]]), Vec::<Vec<u32>>::new());
        let two = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [4, 3], [5, 0]];
        assert_eq!(found(6, &two), [vec![3, 4], vec![0, 1, 2]]);
        let eight = [[0, 1], [1, 0], [1, 2], [2, 3], [3, 1]];
        assert_eq!(found(4, &eight), [vec![0, 1, 2, 3]]);
    }
}
