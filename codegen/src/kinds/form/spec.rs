//! Forms as they are read.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::expand::Bilinear;
use super::structure::Structure;
use crate::diagnostic::{Located, Source};
use crate::expression::{Graph, Id};
use crate::kinds::kind::About;
use crate::units::Unit;

/// Forms over one material, ready to be emitted: see [`crate::kinds::form`] for the file.
#[derive(Debug, Clone)]
pub struct FormSpec {
    /// Name.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// Book or paper.
    pub(crate) reference: String,
    /// The file.
    pub file: Arc<Source>,
    /// The graph that holds all expressions.
    pub graph: Graph,
    /// Properties of the material, in the order of the file.
    pub material: Vec<Property>,
    /// Coefficients with their symbols and what these stand for, over the material's symbols.
    pub(crate) coefficients: Vec<Coefficient>,
    /// The forms, in the order of the file.
    pub forms: Vec<Form>,
    /// The stresses, each at the points of the form that gives it.
    pub stresses: Vec<Form>,
}

/// A property of the material.
#[derive(Debug, Clone)]
pub struct Property {
    /// Name in the spec.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// SI unit.
    pub unit: Unit,
    /// Its symbol.
    pub symbol: Id,
}

/// A named coefficient.
#[derive(Debug, Clone)]
pub(crate) struct Coefficient {
    /// Name in the spec.
    pub name: String,
    /// The symbol that stands for it in the forms.
    pub symbol: Id,
    /// Its value over the material's symbols.
    pub value: Id,
    /// The formula.
    pub text: Located,
}

/// A bilinear form.
#[derive(Debug, Clone)]
pub struct Form {
    /// Name, such as `stiffness`.
    pub name: String,
    /// The formula.
    pub text: Located,
    /// Its coefficients, over the symbols of material and coefficients.
    pub(crate) bilinear: Bilinear,
    /// What was found in them.
    pub(crate) structure: Structure,
    /// The stress in it, if there is one.
    pub stress: Option<Stress>,
}

/// Which part of a basis function occurs in a product.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum BasisPart {
    /// N.
    Value,
    /// ∇N.
    Gradient,
}

impl Form {
    /// The parts of test and trial function that are multiplied.
    pub fn products(&self) -> BTreeSet<(BasisPart, BasisPart)> {
        let part = |place: usize| if place == 0 { BasisPart::Value } else { BasisPart::Gradient };
        self.bilinear.keys().map(|place| (part(place.test), part(place.trial))).collect()
    }

    /// The form at whose points, and with whose modes, it is integrated: itself, or the one that gives its stress, so that
    /// stress and load balance.
    pub fn integrated_as(&self) -> &str {
        self.stress.as_ref().map_or(&self.name, |stress| &stress.form)
    }
}

/// The stress in a form.
#[derive(Debug, Clone)]
pub struct Stress {
    /// The form that gives it.
    pub form: String,
    /// Symbols of its components in the form.
    pub(crate) symbols: [[Id; 3]; 3],
    /// Symbols of ∂w_j/∂x_l, `[j][l]`.
    pub(crate) slopes: [[Id; 3]; 3],
    /// σ_ik over those, the material and the coefficients: `[i][k]`, symmetric.
    pub(crate) components: [[Id; 3]; 3],
    /// Coefficients of the scalar matrix by the parts of test and trial function, with these components in them.
    pub(crate) scalar: BTreeMap<(usize, usize), Id>,
    /// Whether the components themselves are wanted at the points, and nothing is integrated.
    pub(crate) at_points: bool,
}

impl FormSpec {
    /// What it says about itself.
    pub(crate) fn about(&self) -> About<'_> {
        let FormSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }

    /// The name of the set of forms, and those of the forms and stresses.
    pub(in crate::kinds) fn names(&self) -> Vec<(&'static str, &str)> {
        let forms = self.kernels().map(|form| ("form", form.name.as_str()));
        std::iter::once(("set of forms", self.name.as_str())).chain(forms).collect()
    }

    /// All that has a kernel of its own: the forms, then the stresses.
    pub(crate) fn kernels(&self) -> impl Iterator<Item = &Form> {
        self.forms.iter().chain(&self.stresses)
    }

    /// Properties that a form uses, in the order of the file.
    pub(crate) fn material_of(&self, form: &Form) -> Vec<&Property> {
        let of_stress = form.stress.iter().flat_map(|stress| stress.components.iter().flatten());
        let ids: Vec<Id> = form.bilinear.values().chain(of_stress).copied().collect();
        let uses = |symbol: Id| {
            ids.iter().any(|id| {
                self.graph.depends(*id, symbol)
                    || self.coefficients.iter().any(|c| {
                        self.graph.depends(*id, c.symbol) && self.graph.depends(c.value, symbol)
                    })
            })
        };
        self.material.iter().filter(|property| uses(property.symbol)).collect()
    }
}
