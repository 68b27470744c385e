//! The stress of a form: what its gradients of v are multiplied with, for a displacement that is given.

use std::array::from_fn;
use std::collections::BTreeMap;

use num_traits::One;

use super::{Bilinear, Form, Place, Stress, Structure};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Located, suggest};
use crate::expression::{Graph, Id, Rational, normal};

/// A stress as it is declared.
pub(super) struct Named {
    /// Its name in forms.
    pub(super) name: String,
    /// The form that gives it.
    pub(super) form: Located,
    /// Symbols of its components.
    pub(super) symbols: [[Id; 3]; 3],
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// Symbols of the components of the stress called `name`.
pub(super) fn symbols(graph: &mut Graph, name: &str) -> [[Id; 3]; 3] {
    from_fn(|i| from_fn(|k| graph.scalar(&format!("{name}_{}{}_", AXES[i.min(k)], AXES[i.max(k)]))))
}

/// Name of the derivative of component j along axis l.
pub(in crate::kinds) fn slope(j: usize, l: usize) -> String {
    format!("w_{}{}_", AXES[j], AXES[l])
}

/// Finds the stresses in the forms, and derives them from the forms that they are of; the stresses at the points.
///
/// # Errors
/// A stress of no form, or of one that has none; a form with two of them, or one that is no scalar matrix of gradients.
pub(super) fn resolve(
    graph: &mut Graph,
    named: &[Named],
    forms: &mut [Form],
) -> Result<Vec<Form>, Diagnostics> {
    let mut errors = Diagnostics::new();
    let mut at_points = Vec::new();
    for stress in named {
        let used: Vec<bool> = forms.iter().map(|form| depends(graph, form, stress)).collect();
        let (slopes, components) = match components(graph, stress, forms, &used) {
            Ok(found) => found,
            Err(error) => {
                errors.push(*error);
                continue;
            }
        };
        let by: BTreeMap<Id, Id> = (0..9)
            .map(|n| (n / 3, n % 3))
            .map(|(i, k)| (stress.symbols[i][k], components[i][k]))
            .collect();
        for (form, _) in forms.iter_mut().zip(used).filter(|(_, used)| *used) {
            let scalar = match &form.structure {
                Structure::Kronecker { scalar, .. }
                    if form.stress.is_none() && scalar.keys().all(|(a, b)| *a > 0 && *b > 0) =>
                {
                    scalar
                }
                _ => {
                    let message = format!(
                        "`{}` has a stress in it: then it must be one scalar matrix of gradients, with no other stress",
                        form.name
                    );
                    let error = form.text.error_here(Code::FORM, message);
                    errors.push(error.help("such as `inner(sigma, transpose(grad(u))*grad(v))`"));
                    continue;
                }
            };
            let scalar =
                scalar.iter().map(|(parts, id)| (*parts, graph.substitute(*id, &by))).collect();
            let of = stress.form.text().to_owned();
            let symbols = stress.symbols;
            form.stress =
                Some(Stress { form: of, symbols, slopes, components, scalar, at_points: false });
        }
        at_points.push(stress.at_points(slopes, components));
    }
    errors.into_result(at_points)
}

impl Named {
    /// The stress itself, as what a form would multiply the products of gradients with.
    fn at_points(&self, slopes: [[Id; 3]; 3], components: [[Id; 3]; 3]) -> Form {
        let places = || (0..9).map(|n| (n / 3, n % 3));
        let by_parts = |of: [[Id; 3]; 3]| -> BTreeMap<(usize, usize), Id> {
            places().map(|(i, k)| ((1 + i, 1 + k), of[i][k])).collect()
        };
        let unit = from_fn(|i| from_fn(|j| Rational::from(i64::from(i == j))));
        let structure =
            Structure::Kronecker { pattern: Box::new(unit), scalar: by_parts(self.symbols) };
        let stress = Stress {
            form: self.form.text().to_owned(),
            symbols: self.symbols,
            slopes,
            components,
            scalar: by_parts(components),
            at_points: true,
        };
        let (name, text) = (self.name.clone(), self.form.clone());
        Form { name, text, bilinear: Bilinear::new(), structure, stress: Some(stress) }
    }
}

fn depends(graph: &Graph, form: &Form, stress: &Named) -> bool {
    let symbols = || stress.symbols.iter().flatten();
    form.bilinear.values().any(|id| symbols().any(|symbol| graph.depends(*id, *symbol)))
}

type Components = ([[Id; 3]; 3], [[Id; 3]; 3]);

/// Symbols of the slopes of w, and σ_ik over them.
fn components(
    graph: &mut Graph,
    stress: &Named,
    forms: &[Form],
    used: &[bool],
) -> Result<Components, Box<Diagnostic>> {
    let error = |message: String| stress.form.error_here(Code::FORM, message);
    let name = stress.form.text();
    let found = forms.iter().zip(used).find(|(form, _)| form.name == name);
    let Some((form, used)) = found else {
        let names: Vec<&str> = forms.iter().map(|form| form.name.as_str()).collect();
        let help = suggest(name, &names);
        return Err(Box::new(error(format!("there is no form `{name}` here")).maybe_help(help)));
    };
    if *used || form.stress.is_some() {
        return Err(Box::new(error(format!("`{name}` has a stress in it itself"))));
    }
    if form.bilinear.keys().any(|place| place.test == 0 || place.trial == 0) {
        let message = format!("`{name}` has no stress: it is not made of gradients alone");
        return Err(Box::new(error(message)));
    }
    let slopes: [[Id; 3]; 3] = from_fn(|j| from_fn(|l| graph.scalar(&slope(j, l))));
    let components: [[Id; 3]; 3] = from_fn(|i| {
        from_fn(|k| {
            let mut terms = vec![(graph.integer(0), Rational::one())];
            for (j, l) in (0..9).map(|n| (n / 3, n % 3)) {
                let place = Place { i, j, test: 1 + k, trial: 1 + l };
                if let Some(coefficient) = form.bilinear.get(&place) {
                    terms.push((graph.mul(*coefficient, slopes[j][l]), Rational::one()));
                }
            }
            graph.sum(&terms)
        })
    });
    let symmetric = |graph: &mut Graph, i: usize, k: usize| {
        normal::equal(graph, components[i][k], components[k][i])
    };
    if !(0..3).all(|i| (0..i).all(|k| symmetric(graph, i, k))) {
        // Else a turn of the body would do work, and the stress would not balance a couple.
        let message = format!("what `{name}` multiplies grad(v) with is not symmetric: no stress");
        return Err(Box::new(error(message)));
    }
    Ok((slopes, components))
}
