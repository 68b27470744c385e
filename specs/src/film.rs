//! Kernels of oil films: what they take and give, and the loop over nodes or cells.

use std::marker::PhantomData;

use crate::Lane;
use crate::origin::{Origin, Variable};
use crate::registers::{Register, Registers, Task};

/// Evaluates a kernel of a film for `count` nodes or cells side by side.
///
/// `uniform`: lengths dx and dz of a cell (m), the mean speed of the surfaces (m/s), the parameters. Input i of place j is
/// `inputs[offsets[i] + j]`; output o of place j is `outputs[o · count + j]`. All SI.
pub type FilmFunction =
    fn(count: usize, uniform: &[f64], inputs: &[f64], offsets: &[usize], outputs: &mut [f64]);

/// An oil film: flows between cells of the developed bore, what nodes hold, and forces on the surfaces.
#[derive(Debug, Clone, Copy)]
pub struct Film {
    /// Where it comes from.
    pub origin: Origin,
    /// Nodes of a cell around and along; the nodes of a cell are counted around first.
    pub nodes: [usize; 2],
    /// The pair of unknowns of a node, both at least zero and one of them zero; the pressure first.
    pub unknowns: [Variable; 2],
    /// The gap.
    pub gap: Variable,
    /// Mean speed of both surfaces around the bore, in the bore's frame.
    pub speed: Variable,
    /// Numbers of a film, in kernel order.
    pub parameters: &'static [FilmParameter],
    /// Names of the fields that follow at a node.
    pub nodal: &'static [&'static str],
    /// Fields at nodes from both unknowns and the gap, in the order of `nodal`: each with its slopes by these three.
    pub at_nodes: FilmFunction,
    /// What a node holds per area (m), with its slopes by both unknowns and the gap.
    pub stored: FilmFunction,
    /// What flows into the nodes of a cell from it (m³/s), with a minus: the residual of the balance but for what nodes hold.
    pub flow: FilmValues,
    /// Forces per area.
    pub forces: &'static [FilmForce],
    /// Integrals over the bore.
    pub outputs: &'static [Variable],
    /// Force by force what a cell adds at its nodes (N); then what it adds to every output.
    pub surface: FilmValues,
    /// What nodes on edges and openings may be.
    pub edges: &'static [FilmEdge],
}

impl Film {
    /// What nodes on an edge of this name may be.
    pub fn edge(&self, name: &str) -> Option<&'static FilmEdge> {
        self.edges.iter().find(|edge| edge.name == name)
    }
}

/// Values over cells.
#[derive(Debug, Clone, Copy)]
pub struct FilmValues {
    /// Fields that the kernel takes: of each the values at all nodes of a cell are inputs, field by field.
    pub fields: &'static [FilmField],
    /// Row of every value among the outputs.
    pub rows: &'static [usize],
    /// Slopes that are not zero.
    pub slopes: &'static [FilmSlope],
    /// Slopes by the speed that are not zero: row among the outputs, and place of the value.
    pub by_speed: &'static [(usize, usize)],
    /// Rows of outputs.
    pub count: usize,
    /// The kernel.
    pub evaluate: FilmFunction,
}

/// A field of the nodes.
#[derive(Debug, Clone, Copy)]
pub struct FilmField {
    /// Name.
    pub name: &'static str,
    /// Where its values come from.
    pub kind: FilmFieldKind,
}

/// Where the values of a field come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilmFieldKind {
    /// The first or the second unknown.
    Unknown(usize),
    /// The gap.
    Gap,
    /// One of [`Film::nodal`].
    Nodal(usize),
}

/// A slope of a value of a cell by a field at one of its nodes.
#[derive(Debug, Clone, Copy)]
pub struct FilmSlope {
    /// Row among the outputs.
    pub row: usize,
    /// Place of the value.
    pub value: usize,
    /// Place of the field in [`FilmValues::fields`].
    pub field: usize,
    /// The node of the cell.
    pub node: usize,
}

/// A number of a film.
#[derive(Debug, Clone, Copy)]
pub struct FilmParameter {
    /// Name in the spec.
    pub name: &'static str,
    /// Unit for people.
    pub unit: &'static str,
    /// What it is.
    pub title: &'static str,
    /// Value in the spec, SI.
    pub value: f64,
    /// One of its unit in SI.
    pub per_unit: f64,
}

/// A force per area.
#[derive(Debug, Clone, Copy)]
pub struct FilmForce {
    /// Name.
    pub name: &'static str,
    /// Measure of the clearance on which it works.
    pub on: &'static str,
}

/// What nodes on an edge or an opening may be.
#[derive(Debug, Clone, Copy)]
pub struct FilmEdge {
    /// Name, such as `open`.
    pub name: &'static str,
    /// Which unknowns have given values.
    pub given: [bool; 2],
    /// Whether what leaves takes the place of the first unknown: at least zero, and zero where the second is not.
    pub out: bool,
}

/// What is computed for one node or cell, over any lane type and without fused operations.
pub trait FilmKernel<const UNIFORM: usize, const INPUTS: usize, const OUTPUTS: usize> {
    /// Outputs of one lane of them. To be `#[inline(always)]`.
    fn one<L: Lane>(uniform: [L; UNIFORM], inputs: [L; INPUTS]) -> [L; OUTPUTS];
}

/// Evaluates a kernel: see [`FilmFunction`].
///
/// # Panics
/// If there are fewer values than that.
pub fn each_of_film<K: FilmKernel<U, I, O>, const U: usize, const I: usize, const O: usize>(
    count: usize,
    uniform: &[f64],
    inputs: &[f64],
    offsets: &[usize],
    outputs: &mut [f64],
) {
    let uniform: &[f64; U] = uniform[..U].try_into().expect("a value each");
    let offsets: &[usize; I] = offsets[..I].try_into().expect("one an input");
    let furthest = offsets.iter().max().map_or(0, |offset| offset + count);
    assert!(furthest <= inputs.len() && outputs.len() >= O * count, "values of all places");
    let all = EachOfFilm { count, uniform, inputs, offsets, outputs, kernel: PhantomData::<K> };
    Registers::current().run(Outputs::<_, O>(all));
}

struct EachOfFilm<'a, K, const U: usize, const I: usize> {
    count: usize,
    uniform: &'a [f64; U],
    inputs: &'a [f64],
    offsets: &'a [usize; I],
    outputs: &'a mut [f64],
    kernel: PhantomData<K>,
}

impl<K, const U: usize, const I: usize> EachOfFilm<'_, K, U, I> {
    /// Places from `first` on one by one: without fused operations the bits are the same.
    #[inline(never)]
    fn rest<const O: usize>(&mut self, first: usize)
    where
        K: FilmKernel<U, I, O>,
    {
        for place in first..self.count {
            let mut values = [0.0; I];
            for (value, offset) in values.iter_mut().zip(self.offsets) {
                *value = self.inputs[offset + place];
            }
            for (o, value) in K::one(*self.uniform, values).iter().enumerate() {
                self.outputs[o * self.count + place] = *value;
            }
        }
    }
}

/// A task knows how many outputs there are.
struct Outputs<T, const O: usize>(T);

impl<K: FilmKernel<U, I, O>, const U: usize, const I: usize, const O: usize> Task
    for Outputs<EachOfFilm<'_, K, U, I>, O>
{
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let mut own = self.0;
        let count = own.count;
        let whole = if L::WIDTH > 1 { count / L::WIDTH } else { 0 };
        let uniform = own.uniform.map(L::splat);
        for k in 0..whole {
            let place = k * L::WIDTH;
            let mut values = [L::splat(0.0); I];
            for (value, offset) in values.iter_mut().zip(own.offsets) {
                *value = L::load(&L::chunks(&own.inputs[offset + place..][..L::WIDTH])[0]);
            }
            for (o, value) in K::one(uniform, values).into_iter().enumerate() {
                let row = &mut own.outputs[o * count + place..][..L::WIDTH];
                value.store(&mut L::chunks_mut(row)[0]);
            }
        }
        let first = whole * L::WIDTH;
        if first < count {
            own.rest::<O>(first);
        }
    }
}
