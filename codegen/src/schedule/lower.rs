//! From the graph to instructions: sums and products of many operands become chains of binary
//! operations, ordered by stage so that what is known early is computed early.

use std::collections::BTreeMap;

use num_traits::{One, Signed as _, ToPrimitive};
use rustc_hash::FxHashMap;

use super::build::{Builder, Signed};
use super::request::{Request, ScheduleError};
use crate::expression::{Function, Graph, Id, Node, Rational, Relation};
use crate::operation::{Operand, Operation, Parity};
use crate::rational::nearest;

/// Instructions in the order of the graph, with the operand of every output and of every named node.
pub(super) struct Lowered<'n> {
    pub(super) operations: Vec<Operation<Operand>>,
    pub(super) stages: Vec<usize>,
    pub(super) outputs: Vec<Operand>,
    pub(super) names: Vec<(Operand, &'n str)>,
}

/// Lowers `outputs` (in place of the request's own expressions, which they equal).
pub(super) fn lower<'n>(
    graph: &Graph,
    request: &Request,
    outputs: &[Id],
    names: &[&'n (Id, String)],
) -> Result<Lowered<'n>, ScheduleError> {
    let reachable = graph.reachable(outputs);
    let inputs = request.inputs.iter().enumerate();
    let mut lowering = Lowering {
        graph,
        builder: Builder::new(&request.stages, request.inputs.iter().map(|input| input.stage)),
        inputs: inputs.map(|(place, input)| (input.symbol, Operand::Input(place))).collect(),
        uses: Uses::of(graph, &reachable, outputs),
        values: Values(vec![None; reachable.last().map_or(0, |last| last.index() + 1)]),
        sums: FxHashMap::default(),
    };
    for id in &reachable {
        if !lowering.uses.written_in_place(graph, *id) {
            let value = lowering.node(*id).map_err(|refusal| refusal.at(graph, request, *id))?;
            lowering.values.0[id.index()] = Some(value);
        }
    }
    let mut operands = Vec::with_capacity(outputs.len());
    for (output, asked) in outputs.iter().zip(&request.outputs) {
        let operand = lowering.builder.plain(lowering.values.of(*output));
        if lowering.builder.stage_of(operand) >= request.stages.len() {
            return Err(ScheduleError::NoStage { output: asked.name.clone() });
        }
        operands.push(operand);
    }
    let named = names.iter().filter_map(|(id, name)| {
        let value = lowering.values.get(*id)?;
        (!value.negative).then_some((value.operand, name.as_str()))
    });
    let names = named.collect();
    let stages = (0..lowering.builder.operations.len())
        .map(|place| lowering.builder.stage_of(Operand::Value(place)))
        .collect();
    Ok(Lowered { operations: lowering.builder.operations, stages, outputs: operands, names })
}

/// Why one node has no instructions.
enum Refusal {
    Unbound(String),
    NotScalar,
}

impl Refusal {
    fn at(self, graph: &Graph, request: &Request, id: Id) -> ScheduleError {
        let user = request.outputs.iter().find(|output| graph.depends(output.expression, id));
        let output = user.map_or_else(String::new, |output| output.name.clone());
        match self {
            Refusal::Unbound(symbol) => ScheduleError::Unbound { symbol, output },
            Refusal::NotScalar => ScheduleError::NotScalar { output },
        }
    }
}

/// What nodes were lowered to, by their places in the graph.
struct Values(Vec<Option<Signed>>);

impl Values {
    fn get(&self, id: Id) -> Option<Signed> {
        self.0.get(id.index()).copied().flatten()
    }

    fn of(&self, id: Id) -> Signed {
        self.get(id).expect("operands come first")
    }
}

/// How often a node is used, and how.
#[derive(Clone, Copy, Default)]
struct Use {
    /// Its users, counting outputs.
    count: usize,
    /// Whether they include a sum that multiplies it by a number other than ±1.
    multiplied: bool,
    /// In how many products it stands in the denominator.
    below: usize,
}

/// The uses of nodes by their places in the graph.
struct Uses(Vec<Use>);

impl Uses {
    fn of(graph: &Graph, reachable: &[Id], outputs: &[Id]) -> Self {
        let count = reachable.last().map_or(0, |last| last.index() + 1);
        let mut uses = vec![Use::default(); count];
        outputs.iter().for_each(|output| uses[output.index()].count += 1);
        for id in reachable {
            graph.node(*id).operands(|operand| uses[operand.index()].count += 1);
            match graph.node(*id) {
                Node::Sum(terms) => {
                    for (term, _) in terms.iter().filter(|(_, c)| !c.abs().is_one()) {
                        uses[term.index()].multiplied = true;
                    }
                }
                Node::Product(factors) => {
                    for (base, _) in factors.iter().filter(|(_, e)| e.is_negative()) {
                        uses[base.index()].below += 1;
                    }
                }
                _ => {}
            }
        }
        Uses(uses)
    }

    /// Whether the node is a product that only one sum uses, with a coefficient: the coefficient then
    /// goes into the factors that are known first.
    fn written_in_place(&self, graph: &Graph, id: Id) -> bool {
        let Use { count, multiplied, .. } = self.0[id.index()];
        matches!(graph.node(id), Node::Product(_)) && count == 1 && multiplied
    }
}

struct Lowering<'a> {
    graph: &'a Graph,
    builder: Builder,
    inputs: BTreeMap<Id, Operand>,
    uses: Uses,
    values: Values,
    /// The sums so far by their first term and their length, to find the negative of one.
    sums: FxHashMap<(Id, usize), Vec<Id>>,
}

impl Lowering<'_> {
    fn node(&mut self, id: Id) -> Result<Signed, Refusal> {
        let graph = self.graph;
        let of = |values: &Values, id: &Id| values.of(*id);
        Ok(match graph.node(id) {
            Node::Number(value) => Signed::constant(nearest(value)),
            Node::Truth(value) => Signed::constant(f64::from(*value)),
            Node::Symbol(symbol) => match self.inputs.get(&id) {
                Some(operand) => Signed::plus(*operand),
                None => return Err(Refusal::Unbound(symbol.name.clone())),
            },
            Node::Sum(terms) => match self.opposite(terms) {
                Some(value) => value.negated_if(true),
                None => {
                    self.sums.entry((terms[0].0, terms.len())).or_default().push(id);
                    self.sum(terms)
                }
            },
            Node::Product(factors) => self.product(factors, 1.0),
            Node::Function(function, a) => self.function(*function, of(&self.values, a)),
            Node::Compare(relation, a, b) => {
                self.compare(*relation, of(&self.values, a), of(&self.values, b))
            }
            Node::And(a, b) => {
                let (a, b) = (of(&self.values, a), of(&self.values, b));
                Signed::plus(self.builder.emit(Operation::And(a.operand, b.operand)))
            }
            Node::Or(a, b) => {
                let (a, b) = (of(&self.values, a), of(&self.values, b));
                Signed::plus(self.builder.emit(Operation::Or(a.operand, b.operand)))
            }
            Node::Not(a) => {
                let a = of(&self.values, a);
                Signed::plus(self.builder.emit(Operation::Not(a.operand)))
            }
            Node::Select(mask, a, b) => {
                let mask = of(&self.values, mask).operand;
                self.select(mask, of(&self.values, a), of(&self.values, b))
            }
            Node::Zero(_)
            | Node::Identity
            | Node::Scale(..)
            | Node::Dot(..)
            | Node::Apply(..)
            | Node::Transpose(_)
            | Node::Outer(..) => return Err(Refusal::NotScalar),
        })
    }

    /// The value of −Σ c·term, if that sum is already there.
    fn opposite(&self, terms: &[(Id, Rational)]) -> Option<Signed> {
        let negative = |sum: &&Id| match self.graph.node(**sum) {
            Node::Sum(other) => terms.iter().zip(other).all(|(a, b)| a.0 == b.0 && a.1 == -&b.1),
            _ => false,
        };
        let sums = self.sums.get(&(terms.first()?.0, terms.len()))?;
        sums.iter().find(negative).map(|sum| self.values.of(*sum))
    }

    /// Σ c·term. Terms of one stage are added among themselves first, earlier stages before later ones;
    /// within a stage, terms with one |c| ≠ 1 are added before they are multiplied.
    fn sum(&mut self, terms: &[(Id, Rational)]) -> Signed {
        let mut groups: BTreeMap<usize, Vec<&(Id, Rational)>> = BTreeMap::new();
        for term in terms {
            groups.entry(self.stage_of_term(term.0)).or_default().push(term);
        }
        let mut total: Option<Signed> = None;
        for group in groups.values() {
            let part = self.sum_in_stage(group);
            total = Some(match total {
                Some(total) => self.builder.add(total, part),
                None => part,
            });
        }
        total.expect("a sum has terms")
    }

    fn sum_in_stage(&mut self, terms: &[&(Id, Rational)]) -> Signed {
        let mut parts: Vec<Signed> = Vec::with_capacity(terms.len());
        let mut done = vec![false; terms.len()];
        for place in 0..terms.len() {
            if done[place] {
                continue;
            }
            let size = terms[place].1.abs();
            let alike: Vec<usize> = match size.is_one() || self.is_number(terms[place].0) {
                true => Vec::new(),
                false => (place..terms.len())
                    .filter(|&i| terms[i].1.abs() == size && !self.is_number(terms[i].0))
                    .collect(),
            };
            if alike.len() < 2 {
                parts.push(self.term(terms[place].0, &terms[place].1));
                continue;
            }
            let members: Vec<Signed> = alike
                .iter()
                .map(|&other| {
                    done[other] = true;
                    let sign = terms[other].1.signum();
                    self.term(terms[other].0, &sign)
                })
                .collect();
            let inner = self.chain(&members);
            parts.push(self.builder.mul(inner, Signed::constant(nearest(&size))));
        }
        self.chain(&parts)
    }

    /// a ± b ± …, beginning with a term that is not subtracted where there is one.
    fn chain(&mut self, parts: &[Signed]) -> Signed {
        let head = parts.iter().position(|part| !part.negative).unwrap_or(0);
        let rest = parts.iter().enumerate().filter(|(place, _)| *place != head);
        rest.fold(parts[head], |total, (_, part)| self.builder.add(total, *part))
    }

    /// coefficient · term.
    fn term(&mut self, term: Id, coefficient: &Rational) -> Signed {
        let graph = self.graph;
        if let Node::Number(value) = graph.node(term) {
            return Signed::constant(nearest(&(value * coefficient)));
        }
        let negative = coefficient.is_negative();
        let size = nearest(&coefficient.abs());
        let value = match (self.values.get(term), graph.node(term)) {
            (Some(value), _) => self.builder.mul(value, Signed::constant(size)),
            (None, Node::Product(factors)) => self.product(factors, size),
            (None, _) => unreachable!("only products are written in place"),
        };
        value.negated_if(negative)
    }

    /// coefficient · Π base^exponent. Factors of one stage are multiplied among themselves first; the
    /// coefficient joins the earliest.
    fn product(&mut self, factors: &[(Id, Rational)], coefficient: f64) -> Signed {
        // Stage, whether it divides, and value.
        let mut parts: Vec<(usize, bool, Signed)> = Vec::with_capacity(factors.len());
        for (base, exponent) in factors {
            let value = self.values.of(*base);
            let stage = self.builder.stage_of(value.operand);
            let shared = self.uses.0[base.index()].below > 1;
            let builder = &mut self.builder;
            parts.push(if !exponent.is_negative() || is_real_power(exponent) {
                (stage, false, power(builder, value, exponent))
            } else if shared {
                // Several products divide by this base: one reciprocal serves them all.
                let inverse = builder.div(Signed::constant(1.0), value);
                (stage, false, power(builder, inverse, &-exponent))
            } else {
                (stage, true, power(builder, value, &-exponent))
            });
        }
        parts.sort_by_key(|(stage, ..)| *stage);
        let last = parts.last().map(|(stage, ..)| *stage);
        let mut total = Signed::constant(coefficient);
        for group in parts.chunk_by(|a, b| a.0 == b.0) {
            let (stage, builder) = (group[0].0, &mut self.builder);
            let [above, below] = [false, true].map(|divides| {
                let parts = group.iter().filter(|part| part.1 == divides).map(|part| part.2);
                parts.reduce(|a, b| builder.mul(a, b))
            });
            let early = matches!(total.operand, Operand::Constant(_));
            // A quotient known before the whole product is computed there, not with the product.
            total = match (above, below) {
                (Some(above), Some(below)) if !early && Some(stage) != last => {
                    let quotient = builder.div(above, below);
                    builder.mul(total, quotient)
                }
                (None, Some(below)) if !early && Some(stage) != last => {
                    let inverse = builder.div(Signed::constant(1.0), below);
                    builder.mul(total, inverse)
                }
                (above, below) => {
                    let above = above.map_or(total, |above| builder.mul(above, total));
                    below.map_or(above, |below| builder.div(above, below))
                }
            };
        }
        total
    }

    fn function(&mut self, function: Function, a: Signed) -> Signed {
        let (operand, negative) = match function.parity() {
            Parity::Odd => (a.operand, a.negative),
            Parity::Even => (a.operand, false),
            Parity::None => (self.builder.plain(a), false),
        };
        Signed::plus(self.builder.emit(Operation::Function(function, operand))).negated_if(negative)
    }

    fn compare(&mut self, relation: Relation, a: Signed, b: Signed) -> Signed {
        let (a, b) = match (a.negative, b.negative, a.operand, b.operand) {
            (true, true, a, b) => (b, a),
            (true, false, a, Operand::Constant(b)) => (Operand::Constant(-b), a),
            (false, true, Operand::Constant(a), b) => (b, Operand::Constant(-a)),
            _ => (self.builder.plain(a), self.builder.plain(b)),
        };
        Signed::plus(self.builder.emit(Operation::Compare(relation, a, b)))
    }

    fn select(&mut self, mask: Operand, a: Signed, b: Signed) -> Signed {
        let negative = a.negative && b.negative;
        let (a, b) = (a.negated_if(negative), b.negated_if(negative));
        let (a, b) = (self.builder.plain(a), self.builder.plain(b));
        Signed::plus(self.builder.emit(Operation::Select(mask, a, b))).negated_if(negative)
    }

    fn is_number(&self, id: Id) -> bool {
        self.graph.as_number(id).is_some()
    }

    fn stage_of_term(&self, term: Id) -> usize {
        match (self.values.get(term), self.graph.node(term)) {
            (Some(value), _) => self.builder.stage_of(value.operand),
            (None, node) => {
                let mut needs = 0;
                node.operands(|base| needs |= self.builder.needs(self.values.of(base).operand));
                self.builder.stage(needs)
            }
        }
    }
}

/// Whether the exponent is neither whole nor half, or past all sense.
fn is_real_power(exponent: &Rational) -> bool {
    let twice = exponent * Rational::from(2);
    !twice.is_integer() || twice.to_i64().is_none()
}

/// value^exponent; the exponent is positive unless it is a real power.
fn power(builder: &mut Builder, value: Signed, exponent: &Rational) -> Signed {
    if is_real_power(exponent) {
        let base = builder.plain(value);
        let exponent = Operand::Constant(nearest(exponent));
        return Signed::plus(builder.emit(Operation::Power(base, exponent)));
    }
    let whole = exponent.to_u64().expect("checked above");
    if exponent.is_integer() {
        return builder.whole_power(value, whole);
    }
    let base = builder.plain(value);
    let root = Signed::plus(builder.emit(Operation::Sqrt(base)));
    if whole == 0 {
        return root;
    }
    let power = builder.whole_power(Signed::plus(base), whole);
    builder.mul(power, root)
}
