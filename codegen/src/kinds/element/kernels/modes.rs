//! Enhanced modes whose gradients at all points lie along one vector: their products with other functions are
//! sums of single numbers times that vector.

use proc_macro2::TokenStream;
use quote::quote;

use super::table::{Tables, row};
use crate::emit::{Head, Loop, Size, Value, Work, count};
use crate::kinds::cells;
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

    /// Whether a mode is along the coordinate k.
    pub(super) fn along(&self, k: usize) -> bool {
        self.directions.contains(&k)
    }

    /// What is done before the loop over points, and in it with the scale of the modes.
    pub(super) fn fill(&self, tables: &mut Tables, form: &str, scale: &TokenStream) -> [Work; 2] {
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
        let [mut before, mut factor, mut at_point] = [const { Work::new() }; 3];
        before.name(quote!(directions), quote!([#(centre.cofactors[#directions]),*]));
        before.name(quote!(mut factors), quote!([[L::splat(0.0); #modes]; #points]));
        let [scale, component] = [scale.clone(), quote!(#name[q][m])].map(Value::free);
        factor.store(quote!(factors[q][m]), scale * component);
        at_point.each("m", self.modes(), factor);
        [before, at_point]
    }

    /// Coupling and own matrix of the modes, and their condensation out of `matrix`.
    /// `block`: the form's function of sums.
    pub(super) fn condense(&self, block: &TokenStream, pairs: &Pairs) -> Work {
        let (nodes, points, modes) = (self.nodes, self.points, self.modes());
        let parameters = count(3 * modes);
        let outer = |a: TokenStream, b: TokenStream| {
            Value::call(quote!(cells::outer(#a, #b)), cells::OUTER)
        };
        let [mut work, mut node, mut mode, mut pair, mut first] = [const { Work::new() }; 5];
        work.name(quote!(coupling), quote!(&mut workspace.whole));
        let sums = quote!(cells::along_modes(&workspace.basis[a], &factors));
        node.bind(quote!(sums), Value::call(sums, cells::along_modes(points, modes)));
        mode.bind(quote!(products), outer(quote!(sums[m]), quote!(directions[m])));
        let store = quote!(cells::store_coupling(coupling, a, m, #block(products, once)));
        mode.call(Value::call(store, pairs.flops()));
        node.kept("m", Size::Number(modes), mode);
        work.kept("a", Size::Number(nodes), node);
        work.name(quote!(mut own), quote!([[L::splat(0.0); #parameters]; #parameters]));
        let left = quote!(cells::between_modes(&factors, [m, n], &directions[m]));
        pair.bind(quote!(left), Value::call(left, cells::between_modes(points)));
        pair.bind(quote!(products), outer(quote!(left), quote!(directions[n])));
        let store = quote!(cells::store_own(&mut own, m, n, #block(products, once)));
        pair.call(Value::call(store, pairs.flops()));
        let (from, to) = (Size::Index("m"), Size::Number(modes));
        first.repeat(Loop { index: "n", from, to, head: Head::Range, body: pair });
        // On the diagonal a triangle is used.
        first.unused(pairs.flops() - pairs.own_flops());
        work.each("m", modes, first);
        let take_off = quote!(cells::take_off(&mut own, coupling, matrix));
        work.call(Value::call(take_off, cells::take_off(3 * nodes, 3 * modes)));
        work
    }
}
