//! Enhanced modes whose gradients at all points lie along one vector: their products with other functions are
//! sums of single numbers times that vector.

use proc_macro2::TokenStream;
use quote::quote;

use super::table::{Tables, row};
use crate::emit::count;
use crate::kinds::element::{ElementSpec, ModeJacobian, Table};
use crate::kinds::form::kernels::Pairs;

/// The modes of a form, each with one direction.
pub(super) struct Aligned {
    nodes: usize,
    points: usize,
    /// modes: which of ξ, η, ζ a mode's reference gradient is along.
    directions: Vec<usize>,
    /// points × modes: that component.
    factors: Vec<Vec<f64>>,
}

impl Aligned {
    /// The modes, if every one of them has such a direction and the form uses gradients only.
    pub(super) fn of(
        element: &ElementSpec,
        form: &str,
        pairs: &Pairs,
        table: &Table,
    ) -> Option<Self> {
        let enhanced = element.enhanced_in(form)?;
        let gradients_only = pairs.moments.iter().all(|(test, trial)| *test > 0 && *trial > 0);
        if enhanced.jacobian != ModeJacobian::Centre || !gradients_only {
            return None;
        }
        let direction = |m: usize| {
            let only = |k: usize| {
                let others = |i: usize| i == k || table.mode_slopes.iter().all(|s| s[m][i] == 0.0);
                (0..3).all(others)
            };
            (0..3).find(|k| only(*k))
        };
        let directions: Option<Vec<usize>> = (0..enhanced.modes.len()).map(direction).collect();
        let directions = directions?;
        let along = |slopes: &Vec<[f64; 3]>| {
            directions.iter().zip(slopes).map(|(k, slope)| slope[*k]).collect()
        };
        let factors = table.mode_slopes.iter().map(along).collect();
        let nodes = element.nodes.len();
        Some(Aligned { nodes, points: table.weights.len(), directions, factors })
    }

    fn modes(&self) -> usize {
        self.directions.len()
    }

    /// The memory that the coupling with the nodes takes.
    pub(super) fn workspace(&self) -> TokenStream {
        let (size, parameters) = (count(3 * self.nodes), count(3 * self.modes()));
        quote!([[L; #parameters]; #size])
    }

    /// Operations: factors and sums, products, components, apart from the condensation.
    pub(super) fn flops(&self, pairs: &Pairs) -> usize {
        let (nodes, points, modes) = (self.nodes, self.points, self.modes());
        let products = pairs.moments.len() + pairs.flops();
        points * modes
            + nodes * modes * (6 * points + products)
            + modes * (modes + 1) / 2 * (2 * points + 3 + products)
    }

    /// Statements before the loop over points, and in it with the scale of the modes.
    pub(super) fn fill(
        &self,
        tables: &mut Tables,
        form: &str,
        scale: &TokenStream,
    ) -> [TokenStream; 2] {
        let name = tables.named("MODE_FACTORS", form);
        let (points, modes) = (count(self.points), count(self.modes()));
        let rows = self.factors.iter().map(|factors| row(factors));
        tables.add(
            &name,
            "The component of ∂M_m/∂(ξ, η, ζ) at the points that is not zero.",
            quote!([[f64; #modes]; #points]),
            quote!([#(#rows),*]),
        );
        let directions = self.directions.iter().map(|k| count(*k));
        [
            quote! {
                let directions = [#(centre.cofactors[#directions]),*];
                let mut factors = [[L::splat(0.0); #modes]; #points];
            },
            quote! {
                for m in 0..#modes {
                    factors[q][m] = #scale * #name[q][m];
                }
            },
        ]
    }

    /// Coupling and own matrix of the modes, and their condensation out of `matrix`.
    /// `block`: the form's function of sums.
    pub(super) fn condense(&self, block: &TokenStream) -> TokenStream {
        let modes = count(self.modes());
        let (nodes, parameters) = (count(self.nodes), count(3 * self.modes()));
        quote! {
            let coupling = &mut workspace.whole;
            for a in 0..cells::looped(#nodes) {
                let sums = cells::along_modes(&workspace.basis[a], &factors);
                for m in 0..cells::looped(#modes) {
                    let products = cells::outer(sums[m], directions[m]);
                    cells::store_coupling(coupling, a, m, #block(products, once));
                }
            }
            let mut own = [[L::splat(0.0); #parameters]; #parameters];
            for m in 0..#modes {
                for n in m..#modes {
                    let left = cells::between_modes(&factors, [m, n], &directions[m]);
                    let products = cells::outer(left, directions[n]);
                    cells::store_own(&mut own, m, n, #block(products, once));
                }
            }
            cells::take_off(&mut own, coupling, matrix);
        }
    }
}
