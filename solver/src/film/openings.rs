//! A film as it is described: its grid, its numbers, and where oil comes and goes.

use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::ops::Range;

use whirl_specs::{Film, FilmEdge};

use super::grid::Grid;

/// Nodes of an end, a hole or a groove.
#[derive(Debug, Clone)]
pub struct Opening {
    /// Name in results and messages.
    pub name: String,
    /// What its nodes may be, by the film's spec.
    pub(super) edge: &'static FilmEdge,
    /// Pressure above that of the cavity (Pa).
    pub pressure: f64,
    /// Its nodes, ascending.
    pub(super) nodes: Vec<usize>,
}

/// A film between a journal and a bore.
#[derive(Debug, Clone)]
pub struct OilFilm {
    pub(super) kernel: &'static Film,
    /// The nodes.
    pub grid: Grid,
    /// Lengths of a cell, speed, parameters: as kernels take them.
    pub(super) uniform: Vec<f64>,
    /// Ends first, then the edges of an arc, then holes and grooves.
    pub openings: Vec<Opening>,
    /// Of every node the opening that it belongs to.
    pub(super) opening_of: Vec<Option<usize>>,
    /// Areas of the nodes (m²).
    pub(super) areas: Vec<f64>,
}

/// Where a film begins around the bore (rad), and the angle to where it ends; none of a film that closes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Angle of the first node.
    pub first: f64,
    /// To the last node.
    pub arc: Option<f64>,
}

/// What is wrong with a film, and how to fix it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WrongFilm {
    /// What is wrong.
    pub what: String,
    /// How to fix it.
    pub help: String,
}

fn wrong<T>(what: impl Into<String>, help: impl Into<String>) -> Result<T, WrongFilm> {
    Err(WrongFilm { what: what.into(), help: help.into() })
}

impl OilFilm {
    /// Whether what a node holds depends on its fill, so that oil which leaves must come from somewhere.
    pub fn carries_fill(&self) -> bool {
        // Half full and without pressure, in a gap of 1 m: what it holds, and its slopes by pressure, fill and gap.
        let mut stored = [0.0; 4];
        (self.kernel.stored)(1, &self.uniform, &[0.0, 0.5, 1.0], &[0, 1, 2], &mut stored);
        stored[2] != 0.0
    }

    /// A film of this kind all around with open ends and the parameters of its spec.
    ///
    /// # Errors
    /// A grid that its cells do not fill.
    pub fn new(
        kernel: &'static Film,
        nodes: [usize; 2],
        size: [f64; 2],
        first: f64,
    ) -> Result<Self, WrongFilm> {
        Self::reaching(kernel, nodes, size, Reach { first, arc: None })
    }

    /// The same around the bore or along an arc of it, whose edges are in oil at the pressure of the cavity.
    ///
    /// # Errors
    /// A grid that its cells do not fill, an arc of nothing or of more than once around.
    pub fn reaching(
        kernel: &'static Film,
        [around, along]: [usize; 2],
        [radius, length]: [f64; 2],
        Reach { first, arc }: Reach,
    ) -> Result<Self, WrongFilm> {
        let cell = kernel.nodes;
        if cell[0] != 2 {
            return wrong(
                format!("cells of `{}` have {} nodes around", kernel.origin.name, cell[0]),
                "films are solved in cells of two nodes around",
            );
        }
        let [x, z] = cell.map(|nodes| nodes - 1);
        if around < 8 || (arc.is_none() && !around.is_multiple_of(x)) {
            return wrong(
                format!("{around} nodes around are too few, or do not close"),
                match x {
                    1 => "take at least 8".to_owned(),
                    _ => format!("take at least 8, a multiple of {x}"),
                },
            );
        }
        if arc.is_some_and(|arc| !(arc > 0.0 && arc < TAU)) {
            return wrong(
                "an arc of a film is more than 0° and less than 360°",
                "leave `arc` out for a film that closes",
            );
        }
        if along <= z || !(along - 1).is_multiple_of(z) {
            return wrong(
                format!("{along} nodes along are not filled by cells of {}", z + 1),
                format!("take a multiple of {z} and one more, such as {}", 3 * z + 1),
            );
        }
        if !(radius > 0.0 && length > 0.0) {
            return wrong("a film needs a radius and a length above zero", "give both");
        }
        let grid = Grid { around, along, radius, length, first, arc, cell };
        let mut uniform = grid.cell_lengths().to_vec();
        uniform.push(0.0);
        uniform.extend(kernel.parameters.iter().map(|own| own.value));
        let areas = grid.areas();
        let opening_of = vec![None; grid.nodes()];
        let mut film = OilFilm { kernel, grid, uniform, openings: Vec::new(), opening_of, areas };
        let last = along - 1;
        for (name, row) in [("end at -z", 0), ("end at +z", last)] {
            let nodes = (row * around..(row + 1) * around).collect();
            film.add(Opening {
                name: name.to_owned(),
                edge: film.edge("open")?,
                pressure: 0.0,
                nodes,
            });
        }
        if arc.is_some() {
            for (name, column) in [("edge at the start", 0), ("edge at the end", around - 1)] {
                let nodes = (0..along).map(|row| row * around + column).collect();
                let edge = film.edge("supply")?;
                film.add(Opening { name: name.to_owned(), edge, pressure: 0.0, nodes });
            }
        }
        Ok(film)
    }

    /// Its ends, and the edges of an arc.
    pub fn sides(&self) -> usize {
        if self.grid.arc.is_some() { 4 } else { 2 }
    }

    /// Whether a side is an edge of an arc that stands in oil.
    pub(super) fn is_edge_in_oil(&self, side: usize) -> bool {
        (2..self.sides()).contains(&side) && self.openings[side].edge.name == "supply"
    }

    fn edge(&self, name: &str) -> Result<&'static FilmEdge, WrongFilm> {
        let known: Vec<&str> = self.kernel.edges.iter().map(|edge| edge.name).collect();
        match self.kernel.edge(name) {
            Some(edge) => Ok(edge),
            None => wrong(
                format!("the film `{}` knows no edge `{name}`", self.kernel.origin.name),
                format!("its spec has {}", known.join(", ")),
            ),
        }
    }

    /// Sets a parameter (SI) by its name in the spec.
    ///
    /// # Errors
    /// A name that is none of its parameters.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), WrongFilm> {
        let parameters = self.kernel.parameters;
        match parameters.iter().position(|own| own.name == name) {
            Some(place) => {
                self.uniform[3 + place] = value;
                Ok(())
            }
            None => {
                let known: Vec<&str> = parameters.iter().map(|own| own.name).collect();
                wrong(
                    format!("the film `{}` has no parameter `{name}`", self.kernel.origin.name),
                    format!("it has {}", known.join(", ")),
                )
            }
        }
    }

    /// Floods a side with a pressure above that of the cavity (Pa): 0 the end at −z, 1 that at +z; 2 and 3 the edges at the start
    /// and the end of an arc.
    ///
    /// # Errors
    /// A film whose spec has no supply.
    pub fn flood(&mut self, side: usize, pressure: f64) -> Result<(), WrongFilm> {
        let edge = self.edge("supply")?;
        let opening = &mut self.openings[side];
        (opening.edge, opening.pressure) = (edge, pressure);
        Ok(())
    }

    /// Opens a side to air at the pressure of the cavity: oil leaves, none comes back.
    ///
    /// # Errors
    /// A film whose spec has no open edges.
    pub fn open(&mut self, side: usize) -> Result<(), WrongFilm> {
        let edge = self.edge("open")?;
        let opening = &mut self.openings[side];
        (opening.edge, opening.pressure) = (edge, 0.0);
        Ok(())
    }

    /// Closes a side. Nothing leaves there, as in a plane of symmetry.
    pub fn close(&mut self, side: usize) {
        for node in std::mem::take(&mut self.openings[side].nodes) {
            self.opening_of[node] = None;
        }
    }

    /// A hole or a groove in the bore: a rectangle over angles (rad) and z from the middle (m), with its pressure above that of
    /// the cavity (Pa). Nodes in it are supplied; its edge is half a distance of nodes beyond the last of them.
    ///
    /// # Errors
    /// A rectangle in which no node lies, or that another opening has a part of.
    pub fn supply(
        &mut self,
        name: &str,
        angle: Range<f64>,
        z: Range<f64>,
        pressure: f64,
    ) -> Result<(), WrongFilm> {
        let edge = self.edge("supply")?;
        let [dx, dz] = self.grid.spacing();
        let half = self.grid.length / 2.0;
        if z.start < -half * (1.0 + 1e-9) || z.end > half * (1.0 + 1e-9) {
            return wrong(
                format!(
                    "the opening `{name}` reaches beyond the film, which is {} mm long",
                    1e3 * self.grid.length
                ),
                "shorten it, or move it",
            );
        }
        if !self.grid.has(&angle) {
            let [from, to] = [0.0, self.grid.span()]
                .map(|own| (self.grid.first + own).to_degrees().rem_euclid(360.0));
            return wrong(
                format!(
                    "the opening `{name}` reaches beyond the arc of the film, which goes from {}° to {}°",
                    whirl_text::rounded(from, 5),
                    whirl_text::rounded(to, 5)
                ),
                "make it narrower, or move it; edges of an arc have pressures of their own",
            );
        }
        let nodes = self.grid.within(angle.clone(), z.clone());
        if nodes.is_empty() {
            let width = 1e3 * self.grid.radius * (angle.end - angle.start);
            return wrong(
                format!(
                    "the opening `{name}` of {width:.3} mm around and {:.3} mm along lies between the nodes of the film, which \
                     are {:.3} mm and {:.3} mm apart",
                    1e3 * (z.end - z.start),
                    1e3 * dx,
                    1e3 * dz
                ),
                "give the film more nodes, or the opening the size of one distance at least",
            );
        }
        let sides = self.sides();
        if let Some(other) =
            nodes.iter().find_map(|node| self.opening_of[*node].filter(|own| *own >= sides))
        {
            let other = self.openings[other].name.clone();
            return wrong(
                format!("the openings `{name}` and `{other}` share nodes of the film"),
                "move them apart, join them, or give the film more nodes",
            );
        }
        self.add(Opening { name: name.to_owned(), edge, pressure, nodes });
        Ok(())
    }

    /// Takes nodes from what had them before: an opening that reaches an end has its nodes there, and an edge of an arc its
    /// corners.
    fn add(&mut self, opening: Opening) {
        let place = self.openings.len();
        for node in &opening.nodes {
            if let Some(before) = self.opening_of[*node].replace(place) {
                self.openings[before].nodes.retain(|own| own != node);
            }
        }
        self.openings.push(opening);
    }

    /// Name of its spec.
    pub fn name(&self) -> &'static str {
        self.kernel.origin.name
    }

    /// Number of the integrals of its spec.
    pub fn outputs(&self) -> usize {
        self.kernel.outputs.len()
    }

    /// How many nodes an opening has around and along, and what it covers by them (m).
    pub fn covered(&self, opening: usize) -> ([usize; 2], [f64; 2]) {
        let nodes = &self.openings[opening].nodes;
        let around = self.grid.around;
        let distinct = |place: fn(usize, usize) -> usize| {
            let all: BTreeSet<usize> = nodes.iter().map(|node| place(*node, around)).collect();
            all.len()
        };
        let count =
            [distinct(|node, around| node % around), distinct(|node, around| node / around)];
        let width = count[0] as f64 * self.grid.spacing()[0];
        (count, [width, self.area(opening) / width])
    }

    /// Part of the developed bore that an opening covers by its nodes (m²).
    pub fn area(&self, opening: usize) -> f64 {
        self.openings[opening].nodes.iter().map(|node| self.areas[*node]).sum()
    }
}
