//! Ties of files: what they join is joined, and nothing else.

mod cards;
mod chosen;
mod faces;
mod means;
mod programs;
mod reduced;
mod rigid;

use std::fmt::Write;

use whirl_solver::assembly::assemble;
use whirl_solver::error::InputErrors;
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::format::{ReadMesh, ReadOptions, read};
use whirl_solver::reduction::Solid;

use crate::elements;

/// Two runs of the iteration that finds modes agree to this part of ω².
pub(crate) const ROUNDING: f64 = 1e-9;

/// A block of cells between two corners.
pub(crate) struct Brick {
    from: [f64; 3],
    to: [f64; 3],
    cells: [usize; 3],
    /// 1 or 2.
    order: usize,
}

/// Nodes and cells of bricks that share none, with labels from 1.
pub(crate) struct Bricks {
    pub(crate) nodes: Vec<[f64; 3]>,
    /// Labels of the nodes of each cell, in the order of Abaqus and of Nastran.
    pub(crate) cells: Vec<Vec<usize>>,
    /// The first cell of each brick, by label.
    pub(crate) first: Vec<usize>,
}

impl Bricks {
    pub(crate) fn new(bricks: &[Brick]) -> Bricks {
        let mut own = Bricks { nodes: Vec::new(), cells: Vec::new(), first: Vec::new() };
        bricks.iter().for_each(|brick| own.add(brick));
        own
    }

    fn add(&mut self, brick: &Brick) {
        let Brick { from, to, cells, order } = brick;
        let steps = cells.map(|count| order * count);
        let mut label = std::collections::BTreeMap::new();
        let mut node = |own: &mut Bricks, at: [usize; 3]| -> usize {
            *label.entry(at).or_insert_with(|| {
                let share = |k: usize| at[k] as f64 / steps[k] as f64;
                let place = |k: usize| from[k] + share(k) * (to[k] - from[k]);
                own.nodes.push([place(0), place(1), place(2)]);
                own.nodes.len()
            })
        };
        self.first.push(self.cells.len() + 1);
        let ring = [[0, 0], [2, 0], [2, 2], [0, 2]];
        for k in 0..cells[2] {
            for j in 0..cells[1] {
                for i in 0..cells[0] {
                    let mut cell = Vec::new();
                    let mut at = |own: &mut Bricks, x: usize, y: usize, z: usize| {
                        let of = |first: usize, half: usize| (2 * first + half) * order / 2;
                        node(own, [of(i, x), of(j, y), of(k, z)])
                    };
                    for z in [0, 2] {
                        ring.iter().for_each(|[x, y]| cell.push(at(self, *x, *y, z)));
                    }
                    if *order == 2 {
                        for z in [0, 2] {
                            [[1, 0], [2, 1], [1, 2], [0, 1]]
                                .iter()
                                .for_each(|[x, y]| cell.push(at(self, *x, *y, z)));
                        }
                        ring.iter().for_each(|[x, y]| cell.push(at(self, *x, *y, 1)));
                    }
                    self.cells.push(cell);
                }
            }
        }
    }

    /// Labels of the nodes of brick `number` for which `is` holds.
    pub(crate) fn at(&self, number: usize, is: impl Fn([f64; 3]) -> bool) -> Vec<usize> {
        let end = self.first.get(number + 1).copied().unwrap_or(self.cells.len() + 1);
        let own: std::collections::BTreeSet<usize> =
            self.cells[self.first[number] - 1..end - 1].iter().flatten().copied().collect();
        own.into_iter().filter(|&label| is(self.nodes[label - 1])).collect()
    }

    /// The input of Abaqus, with these lines in it; `part` is around nodes and cells.
    pub(crate) fn inp(&self, part: [&str; 2], cards: &str) -> String {
        let mut text = format!("{}*NODE, NSET=ALL\n", part[0]);
        for (place, [x, y, z]) in self.nodes.iter().enumerate() {
            writeln!(text, "{}, {x:?}, {y:?}, {z:?}", place + 1).unwrap();
        }
        for (number, &first) in self.first.iter().enumerate() {
            let end = self.first.get(number + 1).copied().unwrap_or(self.cells.len() + 1);
            for label in first..end {
                let nodes = &self.cells[label - 1];
                let kind = if nodes.len() == 20 { "C3D20" } else { "C3D8I" };
                writeln!(text, "*ELEMENT, TYPE={kind}, ELSET=BRICK{number}\n{label},").unwrap();
                for line in nodes.chunks(10) {
                    let own: Vec<String> = line.iter().map(usize::to_string).collect();
                    writeln!(text, "{},", own.join(", ")).unwrap();
                }
            }
        }
        for number in 0..self.first.len() {
            writeln!(text, "*SOLID SECTION, ELSET=BRICK{number}, MATERIAL=STEEL").unwrap();
        }
        text + part[1] + cards + "*MATERIAL, NAME=STEEL\n*ELASTIC\n210e9, 0.3\n*DENSITY\n7800.\n"
    }

    /// Bulk data of Nastran, with these lines before and in it.
    pub(crate) fn bdf(&self, control: &str, cards: &str) -> String {
        let mut text = control.to_owned();
        for (place, [x, y, z]) in self.nodes.iter().enumerate() {
            writeln!(text, "GRID,{},,{x:?},{y:?},{z:?}", place + 1).unwrap();
        }
        for (place, nodes) in self.cells.iter().enumerate() {
            let own: Vec<String> = nodes.iter().map(usize::to_string).collect();
            let (first, rest) = own.split_at(6);
            writeln!(text, "CHEXA,{},1,{}\n,{}", place + 1, first.join(","), rest.join(","))
                .unwrap();
        }
        text + "PSOLID,1,1\nMAT1,1,210.+9,,.3,7800.\n" + cards + "ENDDATA\n"
    }
}

pub(crate) fn tried(text: &str, path: &str, merge: Option<f64>) -> Result<ReadMesh, InputErrors> {
    let elements = elements();
    let options = ReadOptions { merge, ..ReadOptions::new(&elements) };
    read(text.as_bytes().to_vec(), path, &options)
}

/// A mesh that is read without a warning.
pub(crate) fn clean(text: &str, path: &str) -> Mesh {
    let read = tried(text, path, None).unwrap_or_else(|errors| panic!("{errors}"));
    assert!(read.warnings.is_empty(), "{:?}", read.warnings);
    read.mesh
}

/// Makes something of a body with its ties, in so many bytes.
pub(crate) fn of_body<T>(mesh: &Mesh, memory: usize, make: impl FnOnce(&Solid) -> T) -> T {
    let [stiffness, mass] = ["stiffness", "mass"].map(|form| assemble(mesh, form).unwrap());
    make(&Solid {
        stiffness: &stiffness,
        mass: &mass,
        coordinates: mesh.nodes(),
        slots: &[],
        ties: &mesh.tie_rows(),
        memory,
    })
}

/// ω² of the lowest modes of the free body with its ties; 6 of a body in one piece are zero.
pub(crate) fn free(mesh: &Mesh, count: usize) -> Vec<f64> {
    of_body(mesh, usize::MAX, |solid| solid.free_modes(count).unwrap().eigenvalues)
}

/// The free body has six motions that cost nothing, and these are all.
pub(crate) fn six_of(squares: &[f64]) {
    let elastic = squares[6];
    assert!(elastic > 1e6, "{squares:?}");
    assert!(squares[..6].iter().all(|own| own.abs() < ROUNDING * elastic), "{squares:?}");
}

pub(crate) fn alike(own: &[f64], known: &[f64]) {
    assert_eq!(own.len(), known.len());
    for (own, known) in own.iter().zip(known).skip(6) {
        assert!((own / known - 1.0).abs() < ROUNDING, "{own} {known}");
    }
}

/// A bar of two halves along z, of 2 × 2 × 3 cells each, which share no nodes.
pub(crate) fn halves() -> Bricks {
    let brick = |from: f64, to: f64| Brick {
        from: [0.0, 0.0, from],
        to: [0.02, 0.03, to],
        cells: [2, 2, 3],
        order: 1,
    };
    Bricks::new(&[brick(0.0, 0.1), brick(0.1, 0.2)])
}

/// Pairs of nodes of the two halves at one place, by label.
pub(crate) fn pairs(bricks: &Bricks) -> Vec<(usize, usize)> {
    let seam = |at: [f64; 3]| (at[2] - 0.1).abs() < 1e-9;
    let (first, second) = (bricks.at(0, seam), bricks.at(1, seam));
    let partner = |own: usize| {
        let other = second.iter().find(|&&other| {
            (0..3).all(|k| (bricks.nodes[own - 1][k] - bricks.nodes[other - 1][k]).abs() < 1e-9)
        });
        (own, *other.unwrap())
    };
    first.into_iter().map(partner).collect()
}
