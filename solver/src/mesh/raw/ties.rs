//! Equations of a file between dofs of its nodes, and what of them is left for the nodes of cells.
//!
//! Nodes beside the cells, such as the reference nodes of spiders, and turns of nodes have no stiffness: each is what the
//! equations make it, so that it is eliminated, and what is left joins nodes of cells.

use std::collections::{BTreeMap, BTreeSet};

use super::super::Tie;
use super::super::regions::connected;
use super::report::{LinePosition, MeshReport};
use crate::sparse::Row;

/// What is left of a coefficient after elimination counts as zero below this part of the largest: nodes on a line are so by
/// the digits of a file.
const ROUNDING: f64 = 1e-9;
/// An equation resists a motion of the body as a whole if it leaves more than this part of it: coefficients of a file may
/// have four digits.
const RESISTS: f64 = 1e-3;

/// A dof in an equation of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum FileDof {
    /// Of a node of cells, 3·node + component.
    Cell(usize),
    /// Of a node beside the cells, or a turn: its node, and its component, where 3, 4, 5 are turns.
    Other(u64, usize),
}

/// Σ cᵢ uᵢ = 0.
pub(crate) type FileRow = Vec<(FileDof, f64)>;

/// The equations of a card.
#[derive(Debug, Clone)]
pub(crate) struct RawTie {
    /// How messages call it.
    pub(crate) name: String,
    pub(crate) rows: Vec<FileRow>,
}

/// A row with the place of its tie.
type Numbered = (usize, BTreeMap<FileDof, f64>);

/// What the equations say of nodes of cells; and of each card whether it joins none of them, by itself or with others.
pub(crate) fn eliminate(raw: Vec<RawTie>) -> (Vec<Tie>, Vec<bool>) {
    let group = groups(&raw);
    let mut ties: Vec<Tie> =
        raw.iter().map(|tie| Tie { name: tie.name.clone(), rows: Vec::new() }).collect();
    let mut open: Vec<Numbered> = Vec::new();
    for (index, tie) in raw.into_iter().enumerate() {
        for row in tie.rows {
            if row.iter().all(|(dof, _)| matches!(dof, FileDof::Cell(_))) {
                ties[index].rows.extend(of_cells(&row));
                continue;
            }
            let mut own = BTreeMap::new();
            row.into_iter().for_each(|(dof, c)| *own.entry(dof).or_insert(0.0) += c);
            open.push((index, own));
        }
    }
    let left = without_others(open);
    // A dof that only one row has is what that row says of it.
    let mut rows_of: BTreeMap<FileDof, usize> = BTreeMap::new();
    left.iter()
        .flat_map(|(_, row)| row.keys())
        .for_each(|dof| *rows_of.entry(*dof).or_insert(0) += 1);
    for (index, row) in left {
        let mut row: FileRow = row.into_iter().collect();
        row.sort_by(|(a, by_a), (b, by_b)| {
            rows_of[a].cmp(&rows_of[b]).then(by_b.abs().total_cmp(&by_a.abs())).then(a.cmp(b))
        });
        ties[index].rows.extend(of_cells(&row));
    }
    let joins: BTreeSet<usize> = ties
        .iter()
        .zip(&group)
        .filter(|(tie, _)| !tie.rows.is_empty())
        .map(|(_, own)| *own)
        .collect();
    ties.retain(|tie| !tie.rows.is_empty());
    (ties, group.iter().map(|own| !joins.contains(own)).collect())
}

/// Cards with the same number hang together by dofs beside the cells.
fn groups(raw: &[RawTie]) -> Vec<usize> {
    let mut first: BTreeMap<FileDof, usize> = BTreeMap::new();
    let mut pairs = Vec::new();
    for (index, tie) in raw.iter().enumerate() {
        for (dof, _) in tie.rows.iter().flatten() {
            if matches!(dof, FileDof::Other(..)) {
                pairs.push((*first.entry(*dof).or_insert(index), index));
            }
        }
    }
    connected(raw.len(), pairs)
}

/// Takes out the dofs of others, one after the other: by the row that has most of it, which is then used up.
fn without_others(mut rows: Vec<Numbered>) -> Vec<Numbered> {
    let mut rows_of: BTreeMap<FileDof, Vec<usize>> = BTreeMap::new();
    let mut scale: BTreeMap<FileDof, f64> = BTreeMap::new();
    for (place, (_, row)) in rows.iter().enumerate() {
        for (&dof, c) in row.iter().filter(|(dof, _)| matches!(dof, FileDof::Other(..))) {
            rows_of.entry(dof).or_default().push(place);
            let most = scale.entry(dof).or_insert(0.0);
            *most = most.max(c.abs());
        }
    }
    let mut used = vec![false; rows.len()];
    let others: Vec<FileDof> = rows_of.keys().copied().collect();
    for dof in others {
        let mut own = rows_of.remove(&dof).unwrap_or_default();
        own.sort_unstable();
        own.dedup();
        own.retain(|&place| !used[place] && rows[place].1.contains_key(&dof));
        let by = |place: usize| rows[place].1[&dof].abs();
        // Of equal ones the shortest, so that few dofs come together.
        let better = |a: &usize, b: &usize| {
            by(*a).total_cmp(&by(*b)).then(rows[*b].1.len().cmp(&rows[*a].1.len())).then(b.cmp(a))
        };
        let Some(pivot) = own.iter().copied().max_by(better) else { continue };
        if by(pivot) <= ROUNDING * scale[&dof] {
            for place in own {
                rows[place].1.remove(&dof);
            }
            continue;
        }
        used[pivot] = true;
        let row = std::mem::take(&mut rows[pivot].1);
        let leading = row[&dof];
        for place in own.into_iter().filter(|&place| place != pivot) {
            let factor = rows[place].1.remove(&dof).unwrap_or(0.0) / leading;
            for (&other, c) in row.iter().filter(|(other, _)| **other != dof) {
                let value = rows[place].1.entry(other).or_insert_with(|| {
                    if let Some(list) = rows_of.get_mut(&other) {
                        list.push(place);
                    }
                    0.0
                });
                *value -= factor * c;
            }
        }
    }
    let mut used = used.into_iter();
    rows.retain(|_| !used.next().unwrap_or(false));
    rows
}

/// The row over dofs of cells; none where nothing but rounding is left of it.
fn of_cells(row: &[(FileDof, f64)]) -> Option<Row> {
    let mut own: Row = Vec::with_capacity(row.len());
    for &(dof, c) in row {
        let FileDof::Cell(dof) = dof else { continue };
        match own.iter_mut().find(|(known, _)| *known == dof) {
            Some((_, sum)) => *sum += c,
            None => own.push((dof, c)),
        }
    }
    let most = row.iter().fold(0.0, |most: f64, (_, c)| most.max(c.abs()));
    // Half of the digits of a turn's arm may be gone.
    own.retain(|(_, c)| c.abs() > 1e-3 * ROUNDING * most);
    (!own.is_empty()).then_some(own)
}

/// Warns of ties that hold the body as a whole.
pub(super) fn warn_of_resisting(ties: &[Tie], positions: &[[f64; 3]], report: &mut MeshReport) {
    let size = super::grid::extent(positions).max(f64::MIN_POSITIVE);
    let Some(&middle) = positions.first().filter(|_| !ties.is_empty()) else { return };
    let motion = |dof: usize, own: usize| -> f64 {
        let (node, i) = (dof / 3, dof % 3);
        let at: [f64; 3] = std::array::from_fn(|k| (positions[node][k] - middle[k]) / size);
        match own {
            0..3 => f64::from(i == own),
            // e_axis × at.
            _ => {
                let axis = own - 3;
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                if i == j {
                    -at[k]
                } else if i == k {
                    at[j]
                } else {
                    0.0
                }
            }
        }
    };
    for tie in ties {
        let left = |own: usize| -> f64 {
            let of_row = |row: &Row| -> f64 {
                let (sum, scale) = row.iter().fold((0.0, 0.0), |(sum, scale), &(dof, c)| {
                    (sum + c * motion(dof, own), f64::max(scale, c.abs()))
                });
                f64::abs(sum) / scale
            };
            tie.rows.iter().map(of_row).fold(0.0, f64::max)
        };
        let most = (0..6)
            .map(|own| (own, left(own)))
            .fold((0, 0.0), |most, own| if own.1 > most.1 { own } else { most });
        if most.1 > RESISTS {
            let motion = if most.0 < 3 { "shifts along" } else { "turns about" };
            let axis = ["x", "y", "z"][most.0 % 3];
            let what = format!(
                "{} resists {motion} {axis} of the body as a whole, as if it held it",
                tie.name
            );
            let help = "if it stands for a support, take it out and hold nodes in the case; else look at its coefficients \
                        and at the places of its nodes";
            report.warn(LinePosition::default(), what, help);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nodes 0 and 1 move as node 9, which is beside the cells, along x; a chain of two such nodes.
    #[test]
    fn what_is_beside_the_cells_is_eliminated() {
        let other = |node| FileDof::Other(node, 0);
        let row = |own: usize, node: u64| vec![(FileDof::Cell(3 * own), 1.0), (other(node), -1.0)];
        let tie = |name: &str, rows| RawTie { name: name.to_owned(), rows };
        let (ties, idle) = eliminate(vec![
            tie("A", vec![row(0, 9), row(1, 9)]),
            tie("B", vec![vec![(other(9), 1.0), (other(8), -2.0)]]),
            tie("C", vec![row(2, 8)]),
            tie("D", vec![row(4, 7)]),
        ]);
        let rows: Vec<Row> = ties.iter().flat_map(|tie| tie.rows.clone()).collect();
        assert_eq!(rows.len(), 2);
        // u₀ = u₁ = 2 u₂.
        let u = [2.0, 2.0, 1.0];
        for row in &rows {
            assert_eq!(row.iter().map(|&(dof, c)| c * u[dof / 3]).sum::<f64>(), 0.0, "{row:?}");
        }
        assert_eq!(idle, [false, false, false, true]);
    }
}
