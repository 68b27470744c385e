//! Factoring of sums: Horner's scheme in several variables. The factor whose extraction saves most is
//! taken out first; what it multiplies is then factored in the same way. Factors that leave a sum of
//! earlier stages behind save most, because that sum is hoisted.

use std::collections::BTreeMap;

use num_traits::{One, Signed};

use super::build::{Needs, covers, first_stage};
use super::request::Request;
use crate::expression::{Graph, Id, Node, Rational};

/// Sums of more terms stay as they are: choosing factors takes time quadratic in the terms.
const MOST_TERMS: usize = 1000;
/// Sums of more factors in all their terms stay as they are, too: each is tried against all others.
const MOST_FACTORS: usize = 8000;
/// Factors taken out one after the other; a polynomial of higher degree keeps its lowest part unfactored.
const DEPTH: usize = 200;

/// Rewrites `roots`, operands first; the results are equal to the roots as expressions.
pub(super) fn factor(graph: &mut Graph, request: &Request, roots: &[Id]) -> BTreeMap<Id, Id> {
    let mut horner = Horner {
        graph,
        covers: covers(&request.stages),
        runs: request.stages.iter().map(|stage| stage.runs).collect(),
        needs: request.inputs.iter().map(|input| (input.symbol, 1 << input.stage)).collect(),
    };
    let mut rewritten: BTreeMap<Id, Id> = BTreeMap::new();
    for id in horner.graph.reachable(roots) {
        let new = horner.rewrite(id, &rewritten);
        horner.graph.keep(id, new);
        rewritten.insert(id, new);
    }
    rewritten
}

/// Σ coefficient · Π base^exponent, term by term.
type Term = (BTreeMap<Id, Rational>, Rational);

struct Horner<'a> {
    graph: &'a mut Graph,
    covers: Vec<Needs>,
    runs: Vec<f64>,
    needs: BTreeMap<Id, Needs>,
}

impl Horner<'_> {
    fn rewrite(&mut self, id: Id, of: &BTreeMap<Id, Id>) -> Id {
        let flat = self.graph.rebuild(id, &|operand| of[&operand]);
        if matches!(self.graph.node(id), Node::Sum(_)) { self.sum(flat) } else { flat }
    }

    fn sum(&mut self, id: Id) -> Id {
        let terms = match self.graph.node(id) {
            Node::Sum(terms) if terms.len() > 1 && terms.len() <= MOST_TERMS => terms.clone(),
            _ => return id,
        };
        let monomials = terms.into_iter().map(|(term, c)| (self.monomial(term), c));
        let terms: Vec<Term> = monomials.collect();
        if terms.iter().map(|(monomial, _)| monomial.len()).sum::<usize>() > MOST_FACTORS {
            return id;
        }
        self.horner(terms, 0)
    }

    fn monomial(&self, term: Id) -> BTreeMap<Id, Rational> {
        match self.graph.node(term) {
            Node::Product(factors) => factors.iter().cloned().collect(),
            Node::Number(_) => BTreeMap::new(),
            _ => BTreeMap::from([(term, Rational::one())]),
        }
    }

    /// The factored sum of `terms`. Recursion goes into the cofactors only, at most [`DEPTH`] deep.
    fn horner(&mut self, mut terms: Vec<Term>, depth: usize) -> Id {
        let mut pieces: Vec<(Id, Rational)> = Vec::new();
        while terms.len() > 1 && depth < DEPTH {
            let Some((base, exponent)) = self.best_factor(&terms) else {
                break;
            };
            let has = |term: &Term| term.0.get(&base).is_some_and(|e| divides(&exponent, e));
            let (with, without): (Vec<Term>, Vec<Term>) = terms.into_iter().partition(has);
            let cofactors = with.into_iter().map(|(mut monomial, coefficient)| {
                let left = &monomial[&base] - &exponent;
                monomial.insert(base, left);
                monomial.retain(|_, exponent| *exponent != Rational::default());
                (monomial, coefficient)
            });
            let cofactor = self.horner(cofactors.collect(), depth + 1);
            let power = self.graph.power(base, exponent);
            pieces.push((self.graph.mul(power, cofactor), Rational::one()));
            terms = without;
        }
        for (monomial, coefficient) in terms {
            let factors: Vec<_> = monomial.into_iter().collect();
            pieces.push((self.graph.product(&factors), coefficient));
        }
        self.graph.sum(&pieces)
    }

    /// The power whose extraction saves most, if any saves something; ties go to the older node.
    fn best_factor(&mut self, terms: &[Term]) -> Option<(Id, Rational)> {
        // Positive and negative powers of one base are different factors; the smallest power is common.
        let mut candidates: BTreeMap<(Id, bool), (Rational, Vec<usize>)> = BTreeMap::new();
        for (place, (monomial, _)) in terms.iter().enumerate() {
            for (base, exponent) in monomial {
                let (least, places) = candidates
                    .entry((*base, exponent.is_negative()))
                    .or_insert_with(|| (exponent.clone(), Vec::new()));
                if exponent.abs() < least.abs() {
                    *least = exponent.clone();
                }
                places.push(place);
            }
        }
        let mut best: Option<(f64, Id, Rational)> = None;
        for ((base, _), (exponent, places)) in candidates {
            let saving = self.saving(terms, base, &exponent, &places);
            if saving > best.as_ref().map_or(0.0, |best| best.0) {
                best = Some((saving, base, exponent));
            }
        }
        best.map(|(_, base, exponent)| (base, exponent))
    }

    /// Multiplications saved by taking base^exponent out of the terms at `places`, and the additions and
    /// multiplications of the cofactor that move to an earlier stage; each times how often it runs.
    fn saving(&mut self, terms: &[Term], base: Id, exponent: &Rational, places: &[usize]) -> f64 {
        let mut rest = 0;
        let mut operations = places.len() - 1;
        for &place in places {
            let (monomial, coefficient) = &terms[place];
            let left = monomial.iter().filter(|(other, e)| **other != base || *e != exponent);
            let factors = left.map(|(other, _)| rest |= self.needs(*other)).count();
            operations += (factors + usize::from(!coefficient.abs().is_one())).saturating_sub(1);
        }
        let all = rest | self.needs(base);
        let runs = |needs| first_stage(&self.covers, needs).map_or(1.0, |stage| self.runs[stage]);
        let (here, there) = (runs(all), runs(rest));
        (places.len() - 1) as f64 * here + operations as f64 * (here - there)
    }

    /// Stages on which a node depends. Operands are remembered, so the walk goes no deeper than what is new.
    fn needs(&mut self, id: Id) -> Needs {
        if let Some(needs) = self.needs.get(&id) {
            return *needs;
        }
        let mut open = vec![id];
        while let Some(&next) = open.last() {
            let mut needs = 0;
            let before = open.len();
            self.graph.node(next).operands(|operand| match self.needs.get(&operand) {
                Some(known) => needs |= known,
                None => open.push(operand),
            });
            if open.len() == before {
                self.needs.insert(next, needs);
                open.pop();
            }
        }
        self.needs[&id]
    }
}

/// Whether base^exponent can be taken out of base^of.
fn divides(exponent: &Rational, of: &Rational) -> bool {
    exponent.is_negative() == of.is_negative() && exponent.abs() <= of.abs()
}
