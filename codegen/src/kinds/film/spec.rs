//! A film as it is read.

use std::sync::Arc;

use super::operators::LENGTHS;
use super::rule::Rule;
use crate::diagnostic::{Located, Source};
use crate::expression::{Graph, Id};
use crate::formula::Formula;
use crate::kinds::kind::About;
use crate::rational::Rational;
use crate::units::Unit;

/// A film, ready to be differentiated and scheduled.
#[derive(Debug, Clone)]
pub struct FilmSpec {
    /// Name by which cases refer to it.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// Paper and equation.
    pub(crate) reference: String,
    /// The file.
    pub file: Arc<Source>,
    /// Nodes of a cell around and along.
    pub nodes: [usize; 2],
    /// The pressure, then the other of the pair.
    pub unknowns: [Variable; 2],
    /// The gap between the surfaces.
    pub gap: Variable,
    /// Mean speed of the surfaces.
    pub speed: Variable,
    /// Numbers of a film, in the order of the file.
    pub parameters: Vec<Parameter>,
    /// Fields at the nodes beside unknowns and gap, in the order of the file: each over what stands before it.
    pub nodal: Vec<Field>,
    /// Definitions in the order of the file, with their values.
    pub definitions: Vec<(String, Formula, Id)>,
    /// What a node holds per area.
    pub stored: (Formula, Id),
    /// The weak form.
    pub terms: Vec<Term>,
    /// Forces per area at the nodes.
    pub forces: Vec<Force>,
    /// What nodes on an edge may be.
    pub edges: Vec<Edge>,
    /// Integrals over the bore.
    pub outputs: Vec<Integral>,
    /// Symbols and values, all SI. A field of the nodes stands for its value at a point, with the slopes `ddx_NAME_` and
    /// `ddz_NAME_`, and what is upstream `upstream_NAME_`.
    pub graph: Graph,
    /// Lengths of a cell.
    pub(crate) lengths: [Id; 2],
    /// v, ∂v/∂x, ∂v/∂z.
    pub(crate) test: [Id; 3],
}

/// A quantity with its symbol.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Symbol, such as `p`.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// SI unit.
    pub unit: String,
    /// The symbol in the graph.
    pub symbol: Id,
}

/// A number of a film.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Symbol.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// Unit in which the file gives it.
    pub unit: Unit,
    /// Value in that unit.
    pub written: Rational,
    /// Where that stands.
    pub(crate) place: Located,
    /// The symbol in the graph, SI.
    pub symbol: Id,
}

/// A field of the nodes that follows from others.
#[derive(Debug, Clone)]
pub struct Field {
    /// Symbol.
    pub name: String,
    /// What it is made of.
    pub formula: Formula,
    /// The symbol of its value at a point.
    pub symbol: Id,
    /// Its value at a node over unknowns, gap and parameters.
    pub value: Id,
}

/// Where the value of a field at a node comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldKind {
    /// The first or second unknown.
    Unknown(usize),
    /// The gap.
    Gap,
    /// One of [`FilmSpec::nodal`], by its place.
    Nodal(usize),
}

/// A part of the weak form or of an integral.
#[derive(Debug, Clone)]
pub struct Term {
    /// Name.
    pub name: String,
    /// The formula.
    pub formula: Formula,
    /// Its value in the graph.
    pub(crate) value: Id,
    /// Where it is evaluated, around and along.
    pub(crate) rules: [Rule; 2],
}

/// A force per area.
#[derive(Debug, Clone)]
pub struct Force {
    /// Name, such as `Q`.
    pub name: String,
    /// The measure on which it works.
    pub on: Located,
    /// The formula.
    pub formula: Formula,
    /// Its value in the graph.
    pub(crate) value: Id,
    /// SI unit.
    pub unit: String,
}

/// What the nodes of an edge or an opening may be.
#[derive(Debug, Clone)]
pub struct Edge {
    /// Name, such as `open`.
    pub name: String,
    /// Which unknowns are given.
    pub given: [bool; 2],
    /// Whether what leaves at the node takes the place of the first unknown, and is zero where the second is not.
    pub out: bool,
}

/// An integral over the bore.
#[derive(Debug, Clone)]
pub struct Integral {
    /// Name.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// SI unit.
    pub unit: String,
    /// What is added up.
    pub terms: Vec<Term>,
}

impl FilmSpec {
    /// What it says about itself.
    pub(crate) fn about(&self) -> About<'_> {
        let FilmSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }

    /// All fields of the nodes: unknowns, gap, then what follows from them.
    pub fn fields(&self) -> Vec<(FieldKind, &str, Id)> {
        let unknowns = self.unknowns.iter().enumerate();
        let unknowns =
            unknowns.map(|(i, own)| (FieldKind::Unknown(i), own.name.as_str(), own.symbol));
        let gap = (FieldKind::Gap, self.gap.name.as_str(), self.gap.symbol);
        let nodal = self.nodal.iter().enumerate();
        let nodal = nodal.map(|(i, own)| (FieldKind::Nodal(i), own.name.as_str(), own.symbol));
        unknowns.chain([gap]).chain(nodal).collect()
    }

    /// What is the same all over a film, in kernel order: lengths of a cell, speed, parameters.
    pub fn uniform(&self) -> Vec<(&str, Id)> {
        let own = [(LENGTHS[0], self.lengths[0]), (LENGTHS[1], self.lengths[1])];
        let speed = (self.speed.name.as_str(), self.speed.symbol);
        let parameters = self.parameters.iter().map(|own| (own.name.as_str(), own.symbol));
        own.into_iter().chain([speed]).chain(parameters).collect()
    }
}
