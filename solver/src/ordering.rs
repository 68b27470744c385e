//! Elimination orders that keep the factor of a solid's matrix small.

/// Nodes that share an entry of a matrix: row `i` lists the neighbours of node `i`, sorted, without `i`.
pub(crate) type Neighbours = Vec<Vec<usize>>;

/// Parts of this many nodes are not divided further: their factor is dense anyway.
const LEAF: usize = 24;

/// An order of elimination of the nodes, first to last, by nested dissection: the nodes are halved
/// across the longest side of their bounding box, and the layer of nodes that separates the halves
/// comes after both.
///
/// `coordinates`: m, one a node. For a solid of n nodes the factor then grows as n^{4/3}.
pub(crate) fn nested_dissection(coordinates: &[[f64; 3]], neighbours: &Neighbours) -> Vec<usize> {
    let mut dissection = Dissection {
        coordinates,
        neighbours,
        lower: vec![false; coordinates.len()],
        order: Vec::with_capacity(coordinates.len()),
    };
    dissection.divide((0..coordinates.len()).collect());
    dissection.order
}

struct Dissection<'a> {
    coordinates: &'a [[f64; 3]],
    neighbours: &'a Neighbours,
    /// Whether a node is in the lower half of the part that is being divided.
    lower: Vec<bool>,
    order: Vec<usize>,
}

impl Dissection<'_> {
    fn divide(&mut self, mut part: Vec<usize>) {
        if part.len() <= LEAF {
            self.order.append(&mut part);
            return;
        }
        let axis = self.longest_side(&part);
        let place = |&node: &usize| self.coordinates[node][axis];
        let middle = part.len() / 2;
        let (_, &mut cut, _) =
            part.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
        let cut = self.coordinates[cut][axis];
        // select_nth leaves an order that only the library knows.
        part.sort_unstable();
        let (lower, upper): (Vec<usize>, Vec<usize>) =
            part.into_iter().partition(|&node| self.coordinates[node][axis] < cut);
        for &node in &lower {
            self.lower[node] = true;
        }
        let (separator, upper): (Vec<usize>, Vec<usize>) = upper
            .into_iter()
            .partition(|&node| self.neighbours[node].iter().any(|&other| self.lower[other]));
        for &node in &lower {
            self.lower[node] = false;
        }
        if lower.is_empty() || upper.is_empty() {
            self.order.extend(lower.into_iter().chain(upper).chain(separator));
            return;
        }
        self.divide(lower);
        self.divide(upper);
        self.order.extend(separator);
    }

    fn longest_side(&self, part: &[usize]) -> usize {
        let side = |axis: usize| {
            let (low, high) = part
                .iter()
                .map(|&node| self.coordinates[node][axis])
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                    (low.min(value), high.max(value))
                });
            high - low
        };
        (0..3).max_by(|&a, &b| side(a).total_cmp(&side(b))).unwrap_or(0)
    }
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
        assert_eq!(last, (at(n, 0)..at(n + 1, 0)).collect::<Vec<_>>());
    }
}
