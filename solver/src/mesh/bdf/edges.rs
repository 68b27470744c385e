//! Nodes on edges of quadratic elements where a card has none.

use std::collections::HashMap;

use whirl_specs::Element;

use super::super::raw::{MeshReport, count, list};
use super::cells::{Cells, RawCell};
use super::frame::Point;
use super::nodes::Grids;

/// Puts nodes into the middle of edges that have none, for all elements that share the edge the same one.
pub(super) fn fill(
    cells: &mut Cells,
    grids: &mut Grids,
    positions: &mut Vec<Point>,
    report: &mut MeshReport,
) {
    let lacks = |cell: &RawCell| cell.element.is_some() && cell.nodes.contains(&0);
    let lacking: Vec<usize> =
        (0..cells.list.len()).filter(|&cell| lacks(&cells.list[cell])).collect();
    let Some(&first) = lacking.first() else { return };
    let mut of_elements: Vec<(&'static Element, Edges)> = Vec::new();
    let mut middles: HashMap<[u64; 2], u64> = HashMap::new();
    for cell in &cells.list {
        let Some(element) = cell.element else { continue };
        for &(at, ends) in edges_of(element, &mut of_elements) {
            let node = cell.nodes[at];
            if node > 0 {
                middles.entry(between(cell, ends)).or_insert(node);
            }
        }
    }
    let mut added = 0;
    let mut free = grids.above();
    for &index in &lacking {
        let Some(element) = cells.list[index].element else { continue };
        for &(at, ends) in edges_of(element, &mut of_elements) {
            let cell = &mut cells.list[index];
            if cell.nodes[at] > 0 {
                continue;
            }
            let edge = between(cell, ends);
            let middle = middles.get(&edge).copied().or_else(|| {
                let [a, b] = edge.map(|label| grids.place_of(label));
                // A corner that is not there is an error by itself.
                let [a, b] = [positions[a?], positions[b?]];
                let at: Point = std::array::from_fn(|i| (a[i] + b[i]) / 2.0);
                let label = grids.add(free, at, cell.place);
                free = label.wrapping_add(1);
                positions.push(at);
                middles.insert(edge, label);
                added += 1;
                Some(label)
            });
            match middle {
                Some(middle) => cell.nodes[at] = middle,
                None => cell.element = None,
            }
            if cell.element.is_none() {
                break;
            }
        }
    }
    let labels = list(lacking.iter().map(|&cell| cells.list[cell].label));
    let what = format!(
        "{} without a node on each edge ({labels}): {} added in the middle of edges",
        count(lacking.len(), "quadratic element"),
        count(added, "node"),
    );
    let help = "where the neighbour has none there either, the edge is straight in both";
    report.warn(cells.list[first].place, what, help);
}

fn between(cell: &RawCell, ends: [usize; 2]) -> [u64; 2] {
    let [a, b] = ends.map(|end| cell.nodes[end]);
    [a.min(b), a.max(b)]
}

/// Nodes on edges with the corners beside them, by their places on the card.
type Edges = Vec<(usize, [usize; 2])>;

/// The edges of an element, which are found once.
fn edges_of<'k>(
    element: &'static Element,
    known: &'k mut Vec<(&'static Element, Edges)>,
) -> &'k Edges {
    let at = known.iter().position(|(own, _)| std::ptr::eq(*own, element)).unwrap_or_else(|| {
        known.push((element, edges(element)));
        known.len() - 1
    });
    &known[at].1
}

fn edges(element: &Element) -> Edges {
    let Some((_, order)) = element.nastran else { return Vec::new() };
    let at = |place: usize| element.reference_nodes[order[place]];
    let mut edges = Vec::new();
    for middle in 0..element.nodes {
        let pairs = (0..middle).flat_map(|a| (0..a).map(move |b| [b, a]));
        let is_middle =
            |[a, b]: &[usize; 2]| (0..3).all(|i| at(*a)[i] + at(*b)[i] == 2.0 * at(middle)[i]);
        edges.extend(pairs.filter(is_middle).map(|ends| (middle, ends)).next());
    }
    edges
}
