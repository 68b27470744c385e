//! What can be said exactly of an output of one input that is a polynomial between its breaks, be they those
//! of pieces, of `smooth`, of tables or of min, max and abs.

use std::collections::BTreeMap;

use crate::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::region::{Chosen, Neither, Within};
use super::root::Polynomial;
use super::{Condition, LawOutput, LawSpec};
use crate::expression::{Function, Graph, Id, Node};
use crate::formula::{PI, Side, Term, TermKind};
use crate::rational::nearest;

/// Most comparisons that are followed.
const MOST_COMPARISONS: usize = 400;

/// A range of the input in which the output is one polynomial; all SI.
pub(super) struct Region {
    pub(super) low: Rational,
    pub(super) high: Rational,
    polynomial: Polynomial,
}

/// Where two regions meet.
pub(super) struct Meeting {
    pub(super) at: Rational,
    /// Value and slope below and above, SI.
    pub(super) values: [f64; 2],
    pub(super) slopes: [f64; 2],
    /// Bound of what the approximation of an irrational break adds to the value.
    pub(super) rounding: f64,
    /// The piece that ends there, if it is one that does.
    pub(super) piece: Option<usize>,
    /// Whether the value jumps, or the slope.
    pub(super) jumps: bool,
    pub(super) kinks: bool,
}

/// Least and largest value, whether it rises and falls anywhere, and where regions meet.
pub(super) struct Facts {
    pub(super) extent: [f64; 2],
    pub(super) rises: bool,
    pub(super) falls: bool,
    pub(super) meetings: Vec<Meeting>,
}

/// 2⁻⁶⁰: irrational breaks are known to 2⁻¹²⁰, so that what is smaller relative to its parts is zero.
fn negligible() -> Rational {
    Rational::new(BigInt::one(), BigInt::one() << 60)
}

/// The facts over a range (SI), if the output is piecewise polynomial.
pub(super) fn facts(law: &LawSpec, output: &LawOutput, range: [f64; 2]) -> Option<Facts> {
    let [input] = law.inputs.as_slice() else { return None };
    if !is_polynomial(law, output) {
        return None;
    }
    let [low, high] = range.map(Rational::from_float);
    let regions = regions(&law.graph, output.value, input.symbol, low?, high?)?;
    let mut facts = Facts {
        extent: [f64::INFINITY, f64::NEG_INFINITY],
        rises: false,
        falls: false,
        meetings: Vec::new(),
    };
    for region in &regions {
        region.add(&mut facts);
    }
    for pair in regions.windows(2) {
        let meeting = meet(output, &pair[0], &pair[1]);
        facts.rises |= meeting.jumps && meeting.values[1] > meeting.values[0];
        facts.falls |= meeting.jumps && meeting.values[1] < meeting.values[0];
        facts.meetings.push(meeting);
    }
    Some(facts)
}

/// Whether the formulas themselves are polynomials with choices: the graph may cancel what makes them
/// undefined, such as √h·√h.
fn is_polynomial(law: &LawSpec, output: &LawOutput) -> bool {
    let values = output.pieces.iter().map(|piece| &piece.value);
    let conditions = output.pieces.iter().filter_map(|piece| match &piece.when {
        Some(Condition::Formula(formula)) => Some(formula),
        _ => None,
    });
    let definitions = law.definitions.iter().map(|definition| &definition.formula);
    let tables = law.tables.iter().map(|table| &table.input);
    let mut formulas = values.chain(conditions).chain(definitions).chain(tables);
    formulas.all(|formula| is_plain(&formula.root, law))
}

/// Whether a term is a polynomial, with choices, in all that is not constant.
fn is_plain(term: &Term, law: &LawSpec) -> bool {
    let plain = |part: &Term| is_plain(part, law);
    let part = match &term.kind {
        TermKind::Product(parts) => parts.iter().all(|(side, part)| match side {
            Side::With => plain(part),
            Side::Against => is_constant(part, law),
        }),
        TermKind::Power(base, exponent) => plain(base) && is_count(exponent, law),
        TermKind::Call { function, arguments, .. } => {
            matches!(function.as_str(), "min" | "max" | "abs") && arguments.iter().all(plain)
        }
        TermKind::Series { body, .. } => plain(body),
        _ => term.parts().into_iter().all(plain),
    };
    part || is_constant(term, law)
}

/// Whether a term is made of numbers and parameters.
fn is_constant(term: &Term, law: &LawSpec) -> bool {
    let mut constant = true;
    term.visit(&mut |part| {
        if let TermKind::Name(name) = &part.kind {
            constant &= name == PI || law.parameters.iter().any(|p| p.name == *name);
        }
    });
    constant
}

/// Whether a term is 0, 1, 2, …, or a parameter of such a value.
fn is_count(term: &Term, law: &LawSpec) -> bool {
    let value = match &term.kind {
        TermKind::Number(value) => Some(value),
        TermKind::Name(name) => {
            law.parameters.iter().find(|p| p.name == *name).map(|parameter| &parameter.value)
        }
        _ => None,
    };
    value.is_some_and(|value| value.is_integer() && !value.is_negative())
}

impl Region {
    fn add(&self, facts: &mut Facts) {
        let slope = self.polynomial.derivative();
        let mut ends = vec![self.low.clone()];
        ends.extend(slope.roots_between(&self.low, &self.high));
        ends.push(self.high.clone());
        for x in &ends {
            let value = nearest(&self.polynomial.rounded_at(x, &negligible()));
            facts.extent = [facts.extent[0].min(value), facts.extent[1].max(value)];
        }
        for pair in ends.windows(2) {
            let middle = (&pair[0] + &pair[1]) / Rational::from(2);
            let sign = slope.at(&middle);
            facts.rises |= sign.is_positive();
            facts.falls |= sign.is_negative();
        }
    }
}

fn meet(output: &LawOutput, below: &Region, above: &Region) -> Meeting {
    let at = above.low.clone();
    let sides = [&below.polynomial, &above.polynomial];
    let slopes = sides.map(Polynomial::derivative);
    let scale =
        |polynomials: [&Polynomial; 2]| polynomials[0].size_at(&at) + polynomials[1].size_at(&at);
    let rounding = scale(sides) * negligible();
    let differs = |polynomials: [&Polynomial; 2], bound: &Rational| {
        (polynomials[0].at(&at) - polynomials[1].at(&at)).abs() > *bound
    };
    let slope_sides = [&slopes[0], &slopes[1]];
    let jumps = differs(sides, &rounding);
    let kinks = differs(slope_sides, &(scale(slope_sides) * negligible()));
    let shown = |p: &Polynomial| nearest(&p.rounded_at(&at, &negligible()));
    let piece = output.pieces.iter().position(
        |piece| matches!(&piece.when, Some(Condition::Threshold { at: other, .. }) if *other == at),
    );
    Meeting {
        values: sides.map(shown),
        slopes: slope_sides.map(shown),
        rounding: nearest(&rounding),
        piece,
        jumps,
        kinks,
        at,
    }
}

/// The regions between `low` and `high`.
fn regions(graph: &Graph, value: Id, x: Id, low: Rational, high: Rational) -> Option<Vec<Region>> {
    let two = Rational::from(2);
    let mut breaks = vec![low.clone(), high.clone()];
    let mut count = 0;
    // Operands come first, so that in every region known so far the sides of a comparison are polynomials.
    for id in graph.reachable(&[value]) {
        let [a, b] = match *graph.node(id) {
            Node::Compare(_, a, b) => [Some(a), Some(b)],
            Node::Function(Function::Abs, a) => [Some(a), None],
            _ => continue,
        };
        count += 1;
        if count > MOST_COMPARISONS {
            return None;
        }
        let zero = Polynomial::constant(&Rational::zero());
        let everywhere = |id: Option<Id>| match id {
            Some(id) => Polynomial::of(graph, id, x),
            None => Some(zero.clone()),
        };
        let roots = match (everywhere(a), everywhere(b)) {
            (Some(a), Some(b)) => a.minus(&b).roots_between(&low, &high),
            _ => {
                let mut roots = Vec::new();
                for ends in breaks.windows(2) {
                    let middle = (&ends[0] + &ends[1]) / &two;
                    let mut choice = Choice::new(graph, x, &middle);
                    let mut side = |id: Option<Id>| match id {
                        Some(id) => choice.polynomial(id),
                        None => Some(zero.clone()),
                    };
                    let difference = side(a)?.minus(&side(b)?);
                    roots.extend(difference.roots_between(&ends[0], &ends[1]));
                }
                roots
            }
        };
        breaks.extend(roots);
        breaks.sort();
        breaks.dedup();
        if breaks.len() > MOST_COMPARISONS {
            return None;
        }
    }
    breaks
        .windows(2)
        .map(|ends| {
            let middle = (&ends[0] + &ends[1]) / &two;
            let mut choice = Choice::new(graph, x, &middle);
            let polynomial = choice.polynomial(value)?;
            Some(Region { low: ends[0].clone(), high: ends[1].clone(), polynomial })
        })
        .collect()
}

/// The polynomial that applies in a region. What the choices there leave out need not be a polynomial.
struct Choice<'g> {
    graph: &'g Graph,
    region: Within<'g>,
    known: BTreeMap<Id, Result<Chosen, Neither>>,
}

impl<'g> Choice<'g> {
    fn new(graph: &'g Graph, x: Id, middle: &'g Rational) -> Self {
        Choice { graph, region: Within { x, middle: Some(middle) }, known: BTreeMap::new() }
    }

    fn polynomial(&mut self, id: Id) -> Option<Polynomial> {
        // Without recursion, and every node once: definitions can be long chains.
        let mut open = vec![id];
        while let Some(&next) = open.last() {
            if self.known.contains_key(&next) {
                open.pop();
                continue;
            }
            let before = open.len();
            let found = self.chosen(next, &mut open);
            if open.len() == before {
                self.known.insert(next, found);
                open.pop();
            }
        }
        match self.known.get(&id) {
            Some(Ok(Chosen::Polynomial(polynomial))) => Some(polynomial.clone()),
            _ => None,
        }
    }

    /// What a node is; operands that are not known yet come to `open`, and what is found then is nothing.
    fn chosen(&mut self, id: Id, open: &mut Vec<Id>) -> Result<Chosen, Neither> {
        let (known, before) = (&self.known, open.len());
        let of = |id: Id| known.get(&id).ok_or(Neither)?.as_ref().map_err(|neither| *neither);
        let mut need = |id: Id| open.extend(Some(id).filter(|id| !known.contains_key(id)));
        if let Node::Select(mask, a, b) = *self.graph.node(id) {
            need(mask);
            let chosen = if of(mask)?.truth()? { a } else { b };
            need(chosen);
            return of(chosen).cloned();
        }
        self.graph.node(id).operands(need);
        if open.len() > before {
            return Err(Neither);
        }
        self.graph.step(id, &mut self.region, &of)
    }
}
