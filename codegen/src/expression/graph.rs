//! The store of nodes.

use std::hash::BuildHasher;

use num_traits::{One, Zero};
use rustc_hash::{FxBuildHasher, FxHashMap};

use super::node::{Id, Node, Rational, Shape, Symbol, Symmetry};
use super::signature::{Points, Signatures};

/// Most bits of a numerator or denominator, and most nodes: a formula that grows past a bound is refused
/// ([`Graph::exceeded`]) instead of filling the memory.
pub(super) const NUMBER_BITS: u64 = 4096;
const NODES: usize = 500_000;
/// Most operands of all nodes together: derivatives of long products have many long products.
const OPERANDS: usize = 1_000_000;
/// Most work, in operands of sums and products gathered: a power of a sum multiplied out costs far more
/// than what is left of it. An operand takes a microsecond or two.
const WORK: u64 = 500_000;

/// A hash-consed expression graph. Nodes are only added; equal nodes are stored once.
#[derive(Debug, Clone, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    shapes: Vec<Shape>,
    signatures: Signatures,
    /// The first node that a pass put something of another value for.
    changed: Option<Id>,
    /// Nodes by their hashes; one whose hash is taken is under the next that is free.
    index: FxHashMap<u64, Id>,
    operands: usize,
    work: u64,
    exceeded: bool,
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// The node behind an id.
    pub fn node(&self, id: Id) -> &Node {
        &self.nodes[id.index()]
    }

    /// Its shape.
    pub fn shape(&self, id: Id) -> Shape {
        self.shapes[id.index()]
    }

    /// Number of nodes.
    pub fn size(&self) -> usize {
        self.nodes.len()
    }

    /// True once a number or the graph grew past its bounds; what was built since then is meaningless.
    pub fn exceeded(&self) -> bool {
        self.exceeded
    }

    /// Marks the graph as grown past its bounds.
    pub(super) fn overflow(&mut self) {
        self.exceeded = true;
    }

    /// Operands gathered so far: the work that the graph has cost, whatever was kept of it.
    pub fn work(&self) -> u64 {
        self.work
    }

    /// Counts work; past the bound the graph counts as exceeded, and nothing costs work any more.
    pub(super) fn spend(&mut self, work: usize) {
        self.work += work as u64;
        self.exceeded |= self.work > WORK;
    }

    /// The values of a node at fixed points, point by point; passes that keep the meaning keep them.
    #[cfg(test)]
    pub(super) fn signature(&self, id: Id) -> impl Iterator<Item = f64> {
        self.signatures.values(id)
    }

    /// Whether two nodes agree at the fixed points, to rounding.
    pub(crate) fn same_signature(&self, a: Id, b: Id) -> bool {
        self.signatures.agree(a, b)
    }

    /// Whether a scalar has one value at all the fixed points, to rounding.
    pub(crate) fn seems_constant(&self, id: Id) -> bool {
        self.signatures.is_steady(id)
    }

    /// Evaluates all nodes, those to come too, at other points.
    pub(crate) fn evaluate_at(&mut self, points: Points) {
        self.signatures.move_to(points, &self.nodes, &self.shapes);
    }

    /// Number of points at which nodes are evaluated.
    pub fn points(&self) -> usize {
        self.signatures.points()
    }

    /// To be called by a pass for every node that it puts another in the place of: they must agree.
    pub(crate) fn keep(&mut self, old: Id, new: Id) {
        if old != new && !self.exceeded && !self.same_signature(old, new) {
            self.changed.get_or_insert(old);
        }
    }

    /// [`Graph::keep`] of a pass that puts Σ factor·scalar·rest in the place of a node.
    pub(crate) fn keep_sum(&mut self, old: Id, parts: &[(Rational, Id, Id)]) {
        if !self.exceeded && !self.signatures.is_sum(old, self.shape(old), parts) {
            self.changed.get_or_insert(old);
        }
    }

    /// [`Graph::keep`] of a pass that puts factor·(a·b) in the place of a scalar.
    pub(crate) fn keep_dot(&mut self, old: Id, factor: &Rational, vectors: [Id; 2]) {
        if !self.exceeded && !self.signatures.is_dot(old, factor, vectors) {
            self.changed.get_or_insert(old);
        }
    }

    /// The first node whose value a pass changed: a defect of the pass.
    pub(crate) fn changed(&self) -> Option<Id> {
        self.changed
    }

    /// A named quantity. The same name with the same facts is always the same node.
    pub fn symbol(&mut self, name: &str, shape: Shape, symmetry: Symmetry) -> Id {
        self.intern(Node::Symbol(Symbol { name: name.to_string(), shape, symmetry }))
    }

    /// A named scalar.
    pub fn scalar(&mut self, name: &str) -> Id {
        self.symbol(name, Shape::Scalar, Symmetry::None)
    }

    /// A named vector.
    pub fn vector(&mut self, name: &str) -> Id {
        self.symbol(name, Shape::Vector, Symmetry::None)
    }

    /// A named matrix.
    pub fn matrix(&mut self, name: &str, symmetry: Symmetry) -> Id {
        self.symbol(name, Shape::Matrix, symmetry)
    }

    /// An exact number.
    pub fn number(&mut self, value: Rational) -> Id {
        if value.bits() > NUMBER_BITS {
            self.exceeded = true;
            return self.intern(Node::Number(Rational::one()));
        }
        self.intern(Node::Number(value))
    }

    /// A whole number.
    pub(crate) fn integer(&mut self, value: i64) -> Id {
        self.number(Rational::from(value))
    }

    /// Zero of a shape.
    pub(crate) fn zero(&mut self, shape: Shape) -> Id {
        match shape {
            Shape::Scalar => self.number(Rational::zero()),
            Shape::Truth => self.intern(Node::Truth(false)),
            Shape::Vector | Shape::Matrix => self.intern(Node::Zero(shape)),
        }
    }

    /// The unit matrix.
    pub(crate) fn identity(&mut self) -> Id {
        self.intern(Node::Identity)
    }

    /// The number behind an id, if it is one.
    pub(crate) fn as_number(&self, id: Id) -> Option<&Rational> {
        match self.node(id) {
            Node::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Whether the node is a zero of any shape.
    pub(crate) fn is_zero(&self, id: Id) -> bool {
        match self.node(id) {
            Node::Number(value) => value.is_zero(),
            Node::Zero(_) => true,
            _ => false,
        }
    }

    /// Whether the node is the number 1.
    pub(crate) fn is_one(&self, id: Id) -> bool {
        self.as_number(id).is_some_and(One::is_one)
    }

    /// Whether `id` depends on `symbol`.
    pub(crate) fn depends(&self, id: Id, symbol: Id) -> bool {
        let mut seen = vec![false; id.index() + 1];
        let mut stack = vec![id];
        while let Some(next) = stack.pop() {
            if next == symbol {
                return true;
            }
            if next < symbol || std::mem::replace(&mut seen[next.index()], true) {
                continue;
            }
            self.node(next).operands(|operand| stack.push(operand));
        }
        false
    }

    /// All nodes that `roots` need, operands before users.
    pub fn reachable(&self, roots: &[Id]) -> Vec<Id> {
        let Some(last) = roots.iter().max() else {
            return Vec::new();
        };
        let mut needed = vec![false; last.index() + 1];
        roots.iter().for_each(|root| needed[root.index()] = true);
        for place in (0..needed.len()).rev() {
            if needed[place] {
                self.nodes[place].operands(|operand| needed[operand.index()] = true);
            }
        }
        (0..needed.len()).filter(|&place| needed[place]).map(|place| Id(place as u32)).collect()
    }

    /// Stores a node that is already in canonical form.
    pub(super) fn intern(&mut self, node: Node) -> Id {
        let mut hash = FxBuildHasher.hash_one(&node);
        while let Some(id) = self.index.get(&hash) {
            if *self.node(*id) == node {
                return *id;
            }
            hash = hash.wrapping_add(1);
        }
        let operands = match &node {
            Node::Sum(parts) | Node::Product(parts) => parts.len(),
            _ => 0,
        };
        self.exceeded |= self.nodes.len() >= NODES || self.operands + operands > OPERANDS;
        let shape = self.shape_of(&node);
        if self.exceeded && !is_leaf(&node) {
            return self.zero(shape);
        }
        self.operands += operands;
        let id = Id(self.nodes.len() as u32);
        self.signatures.push(&node, shape, |operand| self.shapes[operand.index()]);
        self.shapes.push(shape);
        self.nodes.push(node);
        self.index.insert(hash, id);
        id
    }

    fn shape_of(&self, node: &Node) -> Shape {
        match node {
            Node::Number(_) | Node::Product(_) | Node::Function(..) | Node::Dot(..) => {
                Shape::Scalar
            }
            Node::Zero(shape) => *shape,
            Node::Identity | Node::Transpose(_) | Node::Outer(..) => Shape::Matrix,
            Node::Symbol(symbol) => symbol.shape,
            Node::Sum(terms) => self.shape(terms[0].0),
            Node::Compare(..) | Node::Truth(_) | Node::And(..) | Node::Or(..) | Node::Not(_) => {
                Shape::Truth
            }
            Node::Select(_, a, _) => self.shape(*a),
            Node::Scale(_, x) => self.shape(*x),
            Node::Apply(..) => Shape::Vector,
        }
    }
}

/// Leaves are kept even past the bounds, so that whatever is built then still has its shape.
fn is_leaf(node: &Node) -> bool {
    matches!(
        node,
        Node::Number(_) | Node::Zero(_) | Node::Identity | Node::Symbol(_) | Node::Truth(_)
    )
}
