//! Which cells belong together, and which material they have.

use whirl_text::nearest_in_any_case;

use super::{Block, Cell, Material, Mesh, Tie};
use crate::error::Error;

impl Mesh {
    /// Cells of an element set; names are compared without regard to case.
    ///
    /// # Errors
    /// [`Error::MissingSet`] with the nearest name.
    pub fn element_set(&self, name: &str) -> Result<&[Cell], Error> {
        let sets = self.element_sets();
        let found = sets.get(name).or_else(|| {
            sets.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, set)| set)
        });
        found.map(Vec::as_slice).ok_or_else(|| Error::MissingSet {
            origin: self.origin().to_owned(),
            kind: "element",
            name: name.to_owned(),
            nearest: nearest_in_any_case(name, sets.keys().map(String::as_str)).map(str::to_owned),
        })
    }

    /// The mesh with `material` in place of what the `chosen` cells had; materials that no cell has any more
    /// are left out.
    ///
    /// # Errors
    /// As [`Mesh::new`], which a mesh that was right does not meet.
    pub fn with_material(
        &self,
        material: &Material,
        chosen: impl Fn(Cell) -> bool,
    ) -> Result<Mesh, Error> {
        let mut materials = self.materials().to_vec();
        let fresh = materials.iter().position(|known| known == material);
        let fresh = fresh.unwrap_or_else(|| {
            materials.push(material.clone());
            materials.len() - 1
        });
        let mut blocks: Vec<Block> = Vec::new();
        let mut places: Vec<Vec<Cell>> = Vec::with_capacity(self.blocks().len());
        for (number, block) in self.blocks().iter().enumerate() {
            let cells = (0..block.len()).map(|cell| Cell { block: number, cell });
            let taken: Vec<bool> = cells.map(&chosen).collect();
            let mut moved = vec![Cell { block: 0, cell: 0 }; block.len()];
            for (fate, own) in [(false, block.material), (true, fresh)] {
                let mut part = Block {
                    element: block.element,
                    material: own,
                    labels: Vec::new(),
                    connectivity: Vec::new(),
                };
                for (cell, nodes) in block.cells().enumerate().filter(|(c, _)| taken[*c] == fate) {
                    moved[cell] = Cell { block: blocks.len(), cell: part.len() };
                    part.labels.push(block.labels[cell]);
                    part.connectivity.extend(nodes);
                }
                if !part.is_empty() {
                    blocks.push(part);
                }
            }
            places.push(moved);
        }
        let mut kept = Vec::new();
        let mut place = vec![usize::MAX; materials.len()];
        for block in &mut blocks {
            if place[block.material] == usize::MAX {
                place[block.material] = kept.len();
                kept.push(materials[block.material].clone());
            }
            block.material = place[block.material];
        }
        let mut parts = self.parts.clone();
        let cells = parts.element_sets.values_mut().flatten();
        cells.for_each(|cell| *cell = places[cell.block][cell.cell]);
        (parts.blocks, parts.materials) = (blocks, kept);
        Ok(Mesh { places: self.places.clone(), ..Mesh::new(parts)? })
    }

    /// The mesh moved by so much along x and y (m).
    ///
    /// # Errors
    /// As [`Mesh::new`]: positions beyond all numbers.
    pub fn moved(self, by: [f64; 2]) -> Result<Mesh, Error> {
        let (mut parts, mut places) = (self.parts, self.places);
        for node in &mut parts.nodes {
            (node[0], node[1]) = (node[0] + by[0], node[1] + by[1]);
        }
        places.values_mut().for_each(|place| place.selection.moves(by));
        Ok(Mesh { places, ..Mesh::new(parts)? })
    }

    /// The part of each node: nodes of one cell are in one part, and nodes that a tie joins. Parts are counted from 0 in the
    /// order of their first nodes.
    pub fn parts(&self) -> Vec<usize> {
        let cells = self.blocks().iter().flat_map(Block::cells);
        let pairs = cells.flat_map(|cell| cell.windows(2).map(|pair| (pair[0], pair[1])));
        let ties = self.ties().iter().flat_map(Tie::pairs);
        connected(self.nodes().len(), pairs.chain(ties))
    }
}

/// The part of each of `count` things that these pairs join, counted from 0 in the order of their first ones.
pub(crate) fn connected(
    count: usize,
    pairs: impl IntoIterator<Item = (usize, usize)>,
) -> Vec<usize> {
    // Each thing points to an earlier one of its part, or to itself.
    let mut root: Vec<usize> = (0..count).collect();
    fn find(root: &mut [usize], mut thing: usize) -> usize {
        while root[thing] != thing {
            root[thing] = root[root[thing]];
            thing = root[thing];
        }
        thing
    }
    for (a, b) in pairs {
        let (a, b) = (find(&mut root, a), find(&mut root, b));
        root[a.max(b)] = a.min(b);
    }
    let mut part = vec![0; count];
    let mut parts = 0;
    for thing in 0..count {
        let first = find(&mut root, thing);
        if first == thing {
            part[thing] = parts;
            parts += 1;
        } else {
            part[thing] = part[first];
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::connected;

    #[test]
    fn parts_are_counted_in_the_order_of_their_first_things() {
        assert_eq!(connected(7, [(5, 1), (3, 5), (0, 6), (6, 0)]), [0, 1, 2, 1, 3, 1, 0]);
        assert_eq!(connected(0, []), []);
    }
}
