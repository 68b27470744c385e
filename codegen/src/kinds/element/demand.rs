//! What a form asks of a rule: exact integrals where the Jacobian is constant, and consistency by the
//! algebra of the patch test.

use std::array::from_fn;
use std::collections::{BTreeMap, BTreeSet};

use super::ElementSpec;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::element::polynomial::{Exponents, Polynomial};
use crate::element::quadrature::{Failure, Integrals, Quadrature};
use crate::kinds::form::BasisPart;

/// Powers of the cell's variables that occur in some functions, each with a function that has it.
type Powers = BTreeMap<Exponents, String>;

/// Proves that the rule of a form integrates the products in it exactly over cells with a constant Jacobian
/// (unless the rule is declared `reduced`), and that cells of any shape (or affine ones, where the rule says
/// so) pass the patch test if gradients are multiplied.
///
/// With J = Σ x_b ⊗ ∇N_b, the force of a constant stress on node a is a sum over det(∇N_a, ∇N_b, ∇N_c) times
/// coordinates: where the rule integrates every monomial of such products exactly, the forces are the exact
/// integrals over the surface, which cancel between cells.
///
/// `forms`: names with the products in them.
///
/// # Errors
/// The first integral that fails, with the nodes it comes from.
pub(crate) fn prove<'f>(
    element: &ElementSpec,
    forms: impl IntoIterator<Item = (&'f str, BTreeSet<(BasisPart, BasisPart)>)>,
) -> Result<(), Diagnostics> {
    // Forms with one rule ask for many of the same integrals.
    let mut integrals: Vec<(&Quadrature, Integrals)> = Vec::new();
    for (form, products) in forms {
        let rule = element.rule(form);
        let known = integrals.iter().position(|(other, _)| std::ptr::eq(*other, rule));
        let place = known.unwrap_or_else(|| {
            integrals.push((rule, Integrals::new(rule, element.cell)));
            integrals.len() - 1
        });
        let integrals = &mut integrals[place].1;
        let demand = Demand { element, form, rule };
        if !rule.reduced {
            demand.products(&products, integrals)?;
        }
        if products.contains(&(BasisPart::Gradient, BasisPart::Gradient)) {
            demand.patch_test(integrals)?;
        }
    }
    Ok(())
}

struct Demand<'a> {
    element: &'a ElementSpec,
    form: &'a str,
    rule: &'a Quadrature,
}

impl Demand<'_> {
    fn powers<'p>(&self, of: impl Fn(usize) -> Vec<&'p Polynomial>) -> Powers {
        let mut powers = Powers::new();
        for place in 0..self.element.nodes.len() {
            for polynomial in of(place) {
                for (exponents, _) in polynomial.terms() {
                    powers.entry(*exponents).or_insert_with(|| format!("node {}", place + 1));
                }
            }
        }
        powers
    }

    fn products(
        &self,
        products: &BTreeSet<(BasisPart, BasisPart)>,
        integrals: &mut Integrals,
    ) -> Result<(), Diagnostics> {
        let shape = &self.element.shape;
        let values = self.powers(|a| vec![&shape[a].polynomial]);
        let mut gradients = self.powers(|a| shape[a].slopes.iter().collect());
        if let Some(enhanced) = self.element.enhanced_in(self.form) {
            for (m, mode) in enhanced.modes.iter().enumerate() {
                for (exponents, _) in mode.slopes.iter().flat_map(Polynomial::terms) {
                    gradients.entry(*exponents).or_insert_with(|| format!("mode {}", m + 1));
                }
            }
        }
        let of = |part: BasisPart| match part {
            BasisPart::Value => (&values, "function"),
            BasisPart::Gradient => (&gradients, "gradient"),
        };
        for (test, trial) in products {
            let ((left, first), (right, second)) = (of(*test), of(*trial));
            for (powers, [a, b]) in sums([left, right]) {
                let Err(failure) = integrals.exact(powers) else { continue };
                let message = format!(
                    "{}, which occurs in `{}` in the product of the {first} of {a} and the {second} of {b}",
                    self.says(&failure),
                    self.form
                );
                let error = self.error(Code::QUADRATURE, message);
                return Err(error
                    .help("take more points, or write `reduced = true` where less is meant")
                    .into());
            }
        }
        Ok(())
    }

    fn patch_test(&self, integrals: &mut Integrals) -> Result<(), Diagnostics> {
        let shape = &self.element.shape;
        let slopes: [Powers; 3] = from_fn(|axis| self.powers(|a| vec![&shape[a].slopes[axis]]));
        for (powers, node) in slopes.iter().flatten() {
            let Err(failure) = integrals.exact(*powers) else { continue };
            let message = format!(
                "{}, which occurs in the gradient of the function of {node}: a patch of cells fails under \
                 constant strain",
                self.says(&failure)
            );
            return Err(self.error(Code::PATCH_TEST, message).help("take more points").into());
        }
        if self.rule.affine {
            return Ok(());
        }
        for (powers, [a, b, c]) in sums(slopes.each_ref()) {
            let Err(failure) = integrals.exact(powers) else { continue };
            let message = format!(
                "{}, which occurs in the determinant of the gradients of {a}, {b} and {c}: a patch of \
                 distorted cells fails under constant strain",
                self.says(&failure)
            );
            let help = "take more points, or write `patch_test = \"affine\"` if it is enough that affine \
                        images of the reference cell pass";
            return Err(self.error(Code::PATCH_TEST, message).help(help).into());
        }
        Ok(())
    }

    fn says(&self, failure: &Failure) -> String {
        format!(
            "the rule gives {} for the integral of {} over the {}, not {}",
            failure.found,
            self.element.cell.power(failure.powers),
            self.element.cell.name(),
            failure.exact
        )
    }

    fn error(&self, code: Code, message: String) -> Diagnostic {
        Diagnostic::new(&self.element.file, code, self.rule.place.clone(), message)
    }
}

/// All sums of one exponent from each of several sets, with where each comes from.
fn sums<const N: usize>(sets: [&Powers; N]) -> BTreeMap<Exponents, [String; N]> {
    let mut sums: BTreeMap<Exponents, Vec<&String>> = BTreeMap::from([([0; 3], Vec::new())]);
    for set in sets {
        let mut next = BTreeMap::new();
        for (before, names) in &sums {
            for (powers, name) in set {
                let sum: Exponents = from_fn(|axis| before[axis] + powers[axis]);
                let names = || names.iter().copied().chain([name]).collect();
                next.entry(sum).or_insert_with(names);
            }
        }
        sums = next;
    }
    let named =
        |(sum, names): (Exponents, Vec<&String>)| (sum, from_fn(|place| names[place].clone()));
    sums.into_iter().map(named).collect()
}
