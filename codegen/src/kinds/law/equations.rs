//! The equations of a law in the units and names of its file: every output and every derivative, piece by
//! piece, differentiated by the generator.
//!
//! Kernels work in SI with all constants folded. Here names of parameters and definitions stay, so that
//! an engineer finds the terms of the file again; derivatives of definitions have names of their own
//! (`doverlap_dh`) and enter by the chain rule.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::{One, ToPrimitive};

use super::{Condition, LawSpec, short};
use crate::diagnostic::Diagnostics;
use crate::expression::{Graph, Id, Rational, display_rounded};
use crate::formula::{Formula, PI, Term, TermKind, lower};

/// An equation of a law.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Equation {
    /// Name of what it gives, such as `Q` or `dQ_dh`.
    pub(super) name: String,
    /// Its unit; nothing where the file does not say.
    pub(super) unit: Option<String>,
    /// Formulas with the conditions under which they apply; `None` for the last.
    pub(super) pieces: Vec<(String, Option<String>)>,
}

/// The equations of a law.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Equations {
    /// Definitions and, after each, its derivatives that are no constants.
    pub(super) definitions: Vec<Equation>,
    /// Outputs and, after each, its derivatives.
    pub(super) outputs: Vec<Equation>,
}

/// Derives the equations of a law.
///
/// # Errors
/// None for a law that was read without errors, unless its formulas grow beyond the bounds of the graph.
pub(super) fn equations(law: &LawSpec) -> Result<Equations, Diagnostics> {
    let mut derivation = Derivation::new(law);
    let definitions = derivation.definitions(law)?;
    let mut outputs = Vec::new();
    for output in &law.outputs {
        let conditions: Vec<Option<String>> =
            output.pieces.iter().map(|piece| condition(law, piece.when.as_ref())).collect();
        let values = output.pieces.iter().map(|piece| derivation.lowered(&piece.value));
        let values: Vec<Id> = values.collect::<Result<_, _>>()?;
        let mut equation = |name: String, unit: String, values: &[Id], graph: &Graph| {
            let texts = values.iter().map(|value| display_rounded(graph, *value));
            let pieces = merged(texts.zip(conditions.iter().cloned()).collect());
            outputs.push(Equation { name, unit: Some(unit), pieces });
        };
        equation(output.name.clone(), output.unit.to_string(), &values, &derivation.graph);
        for (place, input) in law.inputs.iter().enumerate() {
            let slopes: Vec<Id> =
                values.iter().map(|value| derivation.derivative(*value, place)).collect();
            let name = format!("d{}_d{}", output.name, input.name);
            let unit = quotient(output.unit.text(), input.unit.text());
            equation(name, unit, &slopes, &derivation.graph);
        }
    }
    Ok(Equations { definitions, outputs })
}

/// An equation without pieces whose unit the file does not say.
fn plain(name: String, formula: String) -> Equation {
    Equation { name, unit: None, pieces: vec![(formula, None)] }
}

/// A unit per unit.
fn quotient(above: &str, below: &str) -> String {
    if below.contains(['*', '/', ' ']) {
        format!("{above}/({below})")
    } else {
        format!("{above}/{below}")
    }
}

/// Pieces of the same formula under the same last condition are one.
fn merged(mut pieces: Vec<(String, Option<String>)>) -> Vec<(String, Option<String>)> {
    if pieces.iter().all(|(formula, _)| *formula == pieces[0].0) {
        pieces.truncate(1);
        pieces[0].1 = None;
    }
    pieces
}

fn condition(law: &LawSpec, when: Option<&Condition>) -> Option<String> {
    let blended = match when? {
        Condition::Threshold { input, blend: Some(half), .. } => {
            let unit = &law.inputs[*input].unit;
            let half = half.to_f64().unwrap_or(f64::NAN) / unit.factor().to_f64();
            format!(", blended over {} {unit} on both sides", short(half))
        }
        _ => String::new(),
    };
    let plain = match when? {
        Condition::Threshold { input, at, below, inclusive, moved_from: Some(_), text, .. } => {
            let input = &law.inputs[*input];
            let sign = match (below, inclusive) {
                (true, true) => "<=",
                (true, false) => "<",
                (false, true) => ">=",
                (false, false) => ">",
            };
            let at = short(at.to_f64().unwrap_or(f64::NAN) / input.unit.factor().to_f64());
            format!("{} {sign} {at} (the root; the file says {})", input.name, text.text())
        }
        Condition::Threshold { text, .. } => text.text().to_string(),
        Condition::Formula(formula) => formula.text.text().to_string(),
    };
    Some(plain + &blended)
}

/// A graph over the file's own names.
struct Derivation {
    graph: Graph,
    names: BTreeMap<String, Id>,
    inputs: Vec<Id>,
    /// Symbols of definitions with their derivatives by every input.
    chain: Vec<(Id, Vec<Id>)>,
}

impl Derivation {
    fn new(law: &LawSpec) -> Self {
        let mut graph = Graph::new();
        let mut names = BTreeMap::from([(PI.to_string(), graph.scalar(PI))]);
        let (exponents, bounds) = (names_in_exponents(law), names_in_bounds(law));
        for parameter in &law.parameters {
            // An exponent must be a number for its power to stay one, and so must the bounds of sums.
            let number = [&exponents, &bounds].iter().any(|own| own.contains(&parameter.name));
            let id = match number {
                true => graph.number(parameter.value.clone()),
                false => graph.scalar(&parameter.name),
            };
            names.insert(parameter.name.clone(), id);
        }
        let inputs: Vec<Id> = law.inputs.iter().map(|input| graph.scalar(&input.name)).collect();
        for (input, symbol) in law.inputs.iter().zip(&inputs) {
            names.insert(input.name.clone(), *symbol);
        }
        Derivation { graph, names, inputs, chain: Vec::new() }
    }

    fn lowered(&mut self, formula: &Formula) -> Result<Id, Diagnostics> {
        lower(formula, &mut self.graph, &self.names)
    }

    fn definitions(&mut self, law: &LawSpec) -> Result<Vec<Equation>, Diagnostics> {
        let mut equations = Vec::new();
        self.tables(law, &mut equations)?;
        for definition in &law.definitions {
            let value = self.lowered(&definition.formula)?;
            let slopes = (0..law.inputs.len()).map(|place| self.derivative(value, place)).collect();
            let text = display_rounded(&self.graph, value);
            equations.push(plain(definition.name.clone(), text));
            self.declare(law, &definition.name, slopes, &mut equations);
            self.tables(law, &mut equations)?;
        }
        Ok(equations)
    }

    /// Declares the tables whose inputs are known by now; the slope of a table along its own input is a
    /// symbol, `slope_of_NAME`.
    fn tables(&mut self, law: &LawSpec, equations: &mut Vec<Equation>) -> Result<(), Diagnostics> {
        for table in &law.tables {
            let known = table.input.names().keys().all(|name| self.names.contains_key(*name));
            if self.names.contains_key(&table.name) || !known {
                continue;
            }
            let input = self.lowered(&table.input)?;
            let along = self.graph.scalar(&format!("slope_of_{}", table.name));
            let mut slopes = Vec::new();
            for place in 0..law.inputs.len() {
                let inner = self.derivative(input, place);
                slopes.push(self.graph.mul(along, inner));
            }
            let by = display_rounded(&self.graph, input);
            let unit = Some(table.unit.to_string());
            let text = format!("monotone cubic through {} by {by}", table.path);
            equations.push(Equation { unit, ..plain(table.name.clone(), text) });
            self.declare(law, &table.name, slopes, equations);
        }
        Ok(())
    }

    /// Makes a name a symbol, and its derivatives symbols with equations unless they are numbers.
    fn declare(&mut self, law: &LawSpec, name: &str, slopes: Vec<Id>, to: &mut Vec<Equation>) {
        let mut symbols = Vec::with_capacity(slopes.len());
        for (slope, input) in slopes.into_iter().zip(&law.inputs) {
            if self.graph.as_number(slope).is_some() {
                symbols.push(slope);
                continue;
            }
            let derivative = format!("d{name}_d{}", input.name);
            symbols.push(self.graph.scalar(&derivative));
            to.push(plain(derivative, display_rounded(&self.graph, slope)));
        }
        let symbol = self.graph.scalar(name);
        self.names.insert(name.to_string(), symbol);
        self.chain.push((symbol, symbols));
    }

    /// Total derivative by an input: the explicit part, and that by way of each definition.
    fn derivative(&mut self, value: Id, input: usize) -> Id {
        let mut terms = Vec::new();
        let ways = self.chain.iter().map(|(symbol, slopes)| (*symbol, Some(slopes[input])));
        let ways: Vec<_> = std::iter::once((self.inputs[input], None)).chain(ways).collect();
        for (symbol, slope) in ways {
            let partial = self.graph.differentiate(value, symbol);
            let partial = partial.expect("the law was differentiated when it was read");
            let term = slope.map_or(partial, |slope| self.graph.mul(partial, slope));
            terms.push((term, Rational::one()));
        }
        self.graph.sum(&terms)
    }
}

/// Every formula of the outputs and definitions of a law.
fn formulas(law: &LawSpec) -> impl Iterator<Item = &Formula> {
    let values = law.outputs.iter().flat_map(|output| &output.pieces).map(|piece| &piece.value);
    values.chain(law.definitions.iter().map(|definition| &definition.formula))
}

fn add_names(term: &Term, names: &mut BTreeSet<String>) {
    term.visit(&mut |part| {
        if let TermKind::Name(name) = &part.kind {
            names.insert(name.clone());
        }
    });
}

fn names_in_exponents(law: &LawSpec) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for formula in formulas(law) {
        formula.root.visit(&mut |term| {
            if let TermKind::Power(_, exponent) = &term.kind {
                add_names(exponent, &mut names);
            }
        });
    }
    names
}

/// Names by which the bounds of sums are written.
fn names_in_bounds(law: &LawSpec) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for formula in formulas(law) {
        formula.root.visit(&mut |term| {
            if let TermKind::Series { ends, .. } = &term.kind {
                ends.iter().for_each(|end| add_names(end, &mut names));
            }
        });
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::{Located, Source};
    use crate::formula::{Value, evaluate, parse};

    fn law(body: &str) -> LawSpec {
        let head = "kind = \"law\"\nname = \"t\"\ntitle = \"t\"\nsource = \"s\"\n";
        LawSpec::read(&Source::new("law.toml", format!("{head}{body}")))
            .unwrap_or_else(|e| panic!("{e}"))
    }

    fn hertz() -> LawSpec {
        law("[inputs.h]\nunit = \"mm\"\nrange = [-0.1, 0.1]\n[inputs.h_dot]\nunit = \"mm/s\"\n\
             [parameters]\nk = { value = 40, unit = \"N/um^1.5\" }\nn = { value = 1.5, unit = \"1\" }\n\
             a = { value = 2, unit = \"s/m\" }\n\
             [definitions]\noverlap = 'k*(-h)^n'\n\
             [outputs.Q]\nunit = \"N\"\n\
             pieces = [{ when = 'h < 0', value = 'overlap*(1 - a*h_dot)' }, { value = '0' }]\n")
    }

    #[test]
    fn derivatives_keep_the_names_of_the_file() {
        let equations = equations(&hertz()).unwrap();
        let texts = |list: &[Equation]| -> Vec<String> {
            list.iter().map(|e| format!("{} = {}", e.name, e.pieces[0].0)).collect()
        };
        assert_eq!(
            texts(&equations.definitions),
            ["overlap = k*(-h)^(3/2)", "doverlap_dh = -1.5*k*sqrt(-h)"]
        );
        assert_eq!(
            texts(&equations.outputs),
            [
                "Q = overlap*(1 - a*h_dot)",
                "dQ_dh = doverlap_dh*(1 - a*h_dot)",
                "dQ_dh_dot = -a*overlap"
            ]
        );
        assert_eq!(equations.outputs[2].unit.as_deref(), Some("N/(mm/s)"));
        assert_eq!(equations.outputs[2].pieces[1], ("0".to_string(), None));
    }

    /// A sum whose bounds are parameters.
    #[test]
    fn sums_up_to_a_parameter_are_written_out() {
        let law = law("[inputs.h]\nunit = \"mm\"\nrange = [-0.1, 0.1]\n\
             [parameters]\nZ = { value = 4, unit = \"1\" }\nk = { value = 2, unit = \"N/mm\" }\n\
             [outputs.Q]\nunit = \"N\"\nvalue = '-k*sum(j, 1, Z, j*h)'\n");
        let equations = equations(&law).unwrap();
        let texts: Vec<String> =
            equations.outputs.iter().map(|e| format!("{} = {}", e.name, e.pieces[0].0)).collect();
        assert_eq!(texts.len(), 2);
        assert_eq!(texts[1], "dQ_dh = -10*k");
    }

    /// The printed equations, read again as formulas, give the numbers of the law's own graph by a tape.
    #[test]
    fn equations_read_back_give_the_numbers_of_the_kernel() {
        let law = hertz();
        let equations = equations(&law).unwrap();
        let tape = crate::tape::Tape::new(&law.program().unwrap());
        for (h, h_dot) in [(-0.07, 3.0), (-0.01, -40.0), (0.02, 5.0)] {
            let mut names = BTreeMap::from([
                ("h".to_string(), Value::Scalar(h)),
                ("h_dot".to_string(), Value::Scalar(h_dot)),
            ]);
            for parameter in &law.parameters {
                names.insert(
                    parameter.name.clone(),
                    Value::Scalar(parameter.value.to_f64().unwrap()),
                );
            }
            let value = |text: &str, names: &BTreeMap<String, Value<f64>>| {
                let formula = parse(&Located::alone("f", text)).unwrap();
                evaluate(&formula, names).unwrap()
            };
            let piece = usize::from(h >= 0.0);
            for equation in &equations.definitions {
                let found = value(&equation.pieces[0].0, &names);
                names.insert(equation.name.clone(), found);
            }
            let mut rows = [0.0; 3];
            tape.evaluate(
                1,
                &[1e-3 * h, 1e-3 * h_dot],
                &mut rows,
                &mut vec![0.0; tape.workspace()],
            );
            for ((equation, si), scale) in equations.outputs.iter().zip(rows).zip([1.0, 1e-3, 1e-3])
            {
                let Value::Scalar(found) = value(&equation.pieces[piece].0, &names) else {
                    panic!()
                };
                // The few roundings of either way, and the 9 digits that are printed.
                assert!((found - scale * si).abs() <= 1e-8 * found.abs(), "{}", equation.name);
            }
        }
    }
}
