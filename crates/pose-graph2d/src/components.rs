//! Which nodes hang together, and by what alone.

/// The groups of `nodes` nodes that `edges` join, each in ascending order, in the order of their
/// first nodes.
pub(crate) fn groups(nodes: usize, edges: impl Iterator<Item = (usize, usize)>) -> Vec<Vec<usize>> {
    let mut leader: Vec<usize> = (0..nodes).collect();
    for (a, b) in edges {
        let (a, b) = (find(&mut leader, a), find(&mut leader, b));
        leader[a.max(b)] = a.min(b);
    }
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let mut group_of = vec![usize::MAX; nodes];
    for node in 0..nodes {
        let first = find(&mut leader, node);
        if first == node {
            group_of[node] = groups.len();
            groups.push(Vec::new());
        }
        groups[group_of[first]].push(node);
    }
    groups
}

fn find(leader: &mut [usize], mut node: usize) -> usize {
    while leader[node] != node {
        leader[node] = leader[leader[node]];
        node = leader[node];
    }
    node
}

/// Whether each of `edges` is on no loop: without it two parts fall apart. Several edges between
/// the same nodes are a loop.
///
/// Depth-first, by Tarjan, *A Note on Finding the Bridges of a Graph* (1974).
pub(crate) fn bridges(nodes: usize, edges: &[(usize, usize)]) -> Vec<bool> {
    let mut at_node = vec![Vec::new(); nodes];
    for (index, &(a, b)) in edges.iter().enumerate() {
        at_node[a].push((b, index));
        at_node[b].push((a, index));
    }
    let mut is_bridge = vec![false; edges.len()];
    let mut order = vec![usize::MAX; nodes];
    let mut lowest = vec![usize::MAX; nodes];
    let mut next = vec![0; nodes];
    let mut visited = 0;
    for root in 0..nodes {
        if order[root] != usize::MAX {
            continue;
        }
        let mut path = vec![(root, usize::MAX)];
        (order[root], lowest[root]) = (visited, visited);
        visited += 1;
        while let Some(&(node, by)) = path.last() {
            if let Some(&(other, edge)) = at_node[node].get(next[node]) {
                next[node] += 1;
                if edge == by {
                    continue;
                }
                if order[other] == usize::MAX {
                    (order[other], lowest[other]) = (visited, visited);
                    visited += 1;
                    path.push((other, edge));
                } else {
                    lowest[node] = lowest[node].min(order[other]);
                }
            } else {
                path.pop();
                if let Some(&(parent, _)) = path.last() {
                    lowest[parent] = lowest[parent].min(lowest[node]);
                    is_bridge[by] = lowest[node] > order[parent];
                }
            }
        }
    }
    is_bridge
}

#[cfg(test)]
mod tests {
    use super::{bridges, groups};
    use proptest::prelude::{prop_assert_eq, proptest};

    proptest! {
        #[test]
        fn a_bridge_is_what_two_parts_fall_apart_without(
            edges in proptest::collection::vec((0_usize..9, 0_usize..9), 0..16),
        ) {
            let edges: Vec<_> = edges.into_iter().filter(|(a, b)| a != b).collect();
            let whole = groups(9, edges.iter().copied()).len();
            for (index, is_bridge) in bridges(9, &edges).into_iter().enumerate() {
                let mut others = edges.clone();
                others.remove(index);
                prop_assert_eq!(is_bridge, groups(9, others.into_iter()).len() > whole);
            }
        }
    }
}
