//! Elimination orders that keep the factor of a solid's matrix small.

/// Nodes that share an entry of a matrix: row `i` lists the neighbours of node `i`, sorted, without `i`.
pub(crate) type Neighbours = Vec<Vec<usize>>;

/// Parts of this many nodes are not divided further: their factor is dense anyway.
const LEAF: usize = 24;

/// Where a part may be cut: so much of its nodes are in the lower half.
const CUTS: [f64; 5] = [0.5, 0.46, 0.54, 0.42, 0.58];

/// An order of elimination of the nodes, first to last, by nested dissection: the nodes are halved across x, y or z, where
/// the fewest of them have neighbours beyond the cut, and the fewest nodes that separate the halves come after both.
///
/// `coordinates`: m, one a node. For a solid of n nodes the factor then grows as n^{4/3}.
pub(crate) fn nested_dissection(coordinates: &[[f64; 3]], neighbours: &Neighbours) -> Vec<usize> {
    let mut dissection = Dissection {
        coordinates,
        neighbours,
        side: vec![Side::Outside; coordinates.len()],
        order: Vec::with_capacity(coordinates.len()),
    };
    dissection.divide((0..coordinates.len()).collect());
    dissection.order
}

/// Where a node is while a part is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Outside,
    Lower,
    Upper,
}

struct Dissection<'a> {
    coordinates: &'a [[f64; 3]],
    neighbours: &'a Neighbours,
    side: Vec<Side>,
    order: Vec<usize>,
}

impl Dissection<'_> {
    fn divide(&mut self, mut part: Vec<usize>) {
        if part.len() <= LEAF {
            self.order.append(&mut part);
            return;
        }
        let Some((axis, cut)) = self.best_cut(&part) else {
            // All nodes at one place.
            self.order.append(&mut part);
            return;
        };
        self.halve(&part, axis, cut);
        let separator = self.separator(&part);
        let mut rest = part;
        rest.retain(|node| separator.binary_search(node).is_err());
        let (lower, upper): (Vec<usize>, Vec<usize>) =
            rest.into_iter().partition(|&node| self.side[node] == Side::Lower);
        for &node in lower.iter().chain(&upper).chain(&separator) {
            self.side[node] = Side::Outside;
        }
        if lower.is_empty() || upper.is_empty() {
            self.order.extend(lower.into_iter().chain(upper).chain(separator));
            return;
        }
        self.divide(lower);
        self.divide(upper);
        self.order.extend(separator);
    }

    /// Puts the nodes below a place on an axis into the lower half, the others into the upper one.
    fn halve(&mut self, part: &[usize], axis: usize, cut: f64) {
        for &node in part {
            let below = self.coordinates[node][axis] < cut;
            self.side[node] = if below { Side::Lower } else { Side::Upper };
        }
    }

    /// The axis and the place on it where the fewest nodes of one half have neighbours in the other.
    fn best_cut(&mut self, part: &[usize]) -> Option<(usize, f64)> {
        let mut best: Option<(usize, (usize, f64))> = None;
        for axis in 0..3 {
            let mut places: Vec<f64> =
                part.iter().map(|&node| self.coordinates[node][axis]).collect();
            places.sort_unstable_by(f64::total_cmp);
            let mut last = None;
            for share in CUTS {
                let cut = places[(share * part.len() as f64) as usize];
                // The lower half would be empty, or the cut is one that was tried.
                if cut == places[0] || last == Some(cut) {
                    continue;
                }
                last = Some(cut);
                self.halve(part, axis, cut);
                let touches = |node: usize, other: Side| {
                    self.neighbours[node].iter().any(|&near| self.side[near] == other)
                };
                let mut counts = [0, 0];
                for &node in part {
                    match self.side[node] {
                        Side::Lower => counts[0] += usize::from(touches(node, Side::Upper)),
                        _ => counts[1] += usize::from(touches(node, Side::Lower)),
                    }
                }
                let count = counts[0].min(counts[1]);
                if best.is_none_or(|(least, _)| count < least) {
                    best = Some((count, (axis, cut)));
                }
            }
        }
        for &node in part {
            self.side[node] = Side::Outside;
        }
        best.map(|(_, cut)| cut)
    }

    /// The fewest nodes without which no node of the lower half has a neighbour in the upper one, ascending: a cover of the
    /// edges between both, by the largest matching of them (König).
    fn separator(&self, part: &[usize]) -> Vec<usize> {
        let beyond = |node: usize, other: Side| -> Vec<usize> {
            let near = self.neighbours[node].iter().copied();
            near.filter(|&near| self.side[near] == other).collect()
        };
        let lower = part.iter().filter(|&&node| self.side[node] == Side::Lower);
        let lower: Vec<usize> =
            lower.copied().filter(|&node| !beyond(node, Side::Upper).is_empty()).collect();
        let mut upper: Vec<usize> =
            lower.iter().flat_map(|&node| beyond(node, Side::Upper)).collect();
        upper.sort_unstable();
        upper.dedup();
        let place = |node: usize| upper.binary_search(&node).expect("a neighbour");
        let edges: Vec<Vec<usize>> = lower
            .iter()
            .map(|&node| beyond(node, Side::Upper).into_iter().map(place).collect())
            .collect();
        let cover = cover(&edges, upper.len());
        let of_lower = lower.iter().zip(&cover.0).filter(|(_, own)| **own).map(|(node, _)| *node);
        let of_upper = upper.iter().zip(&cover.1).filter(|(_, own)| **own).map(|(node, _)| *node);
        let mut separator: Vec<usize> = of_lower.chain(of_upper).collect();
        separator.sort_unstable();
        separator
    }
}

/// Which of the first and of the `count` second nodes cover all edges between both, the fewest there are.
fn cover(edges: &[Vec<usize>], count: usize) -> (Vec<bool>, Vec<bool>) {
    let (mut of_first, mut of_second) = (vec![None; edges.len()], vec![None; count]);
    for (first, seconds) in edges.iter().enumerate() {
        if let Some(&second) = seconds.iter().find(|&&second| of_second[second].is_none()) {
            (of_first[first], of_second[second]) = (Some(second), Some(first));
        }
    }
    // From each that is left, a path to a free second one over edges in and out of the matching by turns.
    let mut seen = vec![usize::MAX; count];
    for start in 0..edges.len() {
        if of_first[start].is_some() {
            continue;
        }
        let mut queue = vec![start];
        let mut reached: Vec<(usize, usize)> = Vec::new();
        let mut at = 0;
        let mut end = None;
        'search: while at < queue.len() {
            let first = queue[at];
            at += 1;
            for &second in &edges[first] {
                if seen[second] == start {
                    continue;
                }
                seen[second] = start;
                reached.push((second, first));
                match of_second[second] {
                    Some(next) => queue.push(next),
                    None => {
                        end = Some(second);
                        break 'search;
                    }
                }
            }
        }
        // Back along the path: what was matched is not, what was not is.
        while let Some(second) = end {
            let &(_, first) =
                reached.iter().find(|(own, _)| *own == second).expect("it was reached");
            let before = of_first[first];
            (of_first[first], of_second[second]) = (Some(second), Some(first));
            end = if first == start { None } else { before };
        }
    }
    // What alternating paths from first ones without a match reach.
    let mut firsts: Vec<bool> = of_first.iter().map(Option::is_none).collect();
    let mut seconds = vec![false; count];
    let mut queue: Vec<usize> = (0..edges.len()).filter(|&first| firsts[first]).collect();
    while let Some(first) = queue.pop() {
        for &second in &edges[first] {
            if !seconds[second] {
                seconds[second] = true;
                if let Some(next) = of_second[second].filter(|&next: &usize| !firsts[next]) {
                    firsts[next] = true;
                    queue.push(next);
                }
            }
        }
    }
    (firsts.into_iter().map(|reached| !reached).collect(), seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_every_node_once_and_separators_last() {
        let n = 10;
        let at = |i: usize, j: usize| i * n + j;
        let coordinates: Vec<[f64; 3]> =
            (0..2 * n * n).map(|node| [(node / n) as f64, (node % n) as f64, 0.0]).collect();
        let mut neighbours = vec![Vec::new(); coordinates.len()];
        for i in 0..2 * n {
            for j in 0..n {
                for (di, dj) in [(1, 0), (0, 1), (1, 1)] {
                    if i + di < 2 * n && j + dj < n {
                        neighbours[at(i, j)].push(at(i + di, j + dj));
                        neighbours[at(i + di, j + dj)].push(at(i, j));
                    }
                }
            }
        }
        let order = nested_dissection(&coordinates, &neighbours);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..2 * n * n).collect::<Vec<_>>());
        let mut last = order[order.len() - n..].to_vec();
        last.sort_unstable();
        // A column of the grid, which parts it.
        assert_eq!(last, (last[0]..last[0] + n).collect::<Vec<_>>());
        assert!(
            last[0].is_multiple_of(n) && (n / 2..3 * n / 2).contains(&(last[0] / n)),
            "{last:?}"
        );
    }

    #[test]
    fn covers_are_the_smallest_there_are() {
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 33) as usize
        };
        for _ in 0..200 {
            let (n, m) = (1 + random() % 6, 1 + random() % 6);
            let edges: Vec<Vec<usize>> =
                (0..n).map(|_| (0..m).filter(|_| random() % 3 == 0).collect()).collect();
            let (firsts, seconds) = cover(&edges, m);
            let covers = |firsts: &dyn Fn(usize) -> bool, seconds: &dyn Fn(usize) -> bool| {
                let covered = |first: usize| {
                    edges[first].iter().all(|&second| firsts(first) || seconds(second))
                };
                (0..n).all(covered)
            };
            assert!(covers(&|i| firsts[i], &|j| seconds[j]), "{edges:?}");
            let size = firsts.iter().chain(&seconds).filter(|own| **own).count();
            let least = (0..1_usize << (n + m))
                .filter(|set| covers(&|i| set >> i & 1 == 1, &|j| set >> (n + j) & 1 == 1))
                .map(usize::count_ones)
                .min();
            assert_eq!(Some(size as u32), least, "{edges:?}");
        }
    }
}
