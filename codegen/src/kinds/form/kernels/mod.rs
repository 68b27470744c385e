//! Kernels of forms: what a form makes of the basis functions of any element, pair by pair. The kernels of elements
//! fill in the functions and call them.

mod block;
mod pairs;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::{Form, FormSpec, Structure};
use crate::diagnostic::Diagnostics;
use crate::emit::{count, documented, identifier};
use crate::kinds::kernel::{text, unscheduled};
use block::Block;
pub(in crate::kinds) use block::{block_name, once_name};
pub(in crate::kinds) use pairs::PAIR;
pub(crate) use pairs::Pairs;

/// What elements need of a set of forms, whose kernels they call.
pub(crate) struct FormKernels<'a> {
    pub(crate) spec: &'a FormSpec,
    /// One each for [`FormSpec::kernels`].
    pub(crate) pairs: Vec<Pairs>,
    /// The module of the kernels.
    pub(crate) text: String,
}

impl<'a> FormKernels<'a> {
    pub(crate) fn new(spec: &'a FormSpec) -> Result<Self, Diagnostics> {
        let pairs = spec.kernels().map(|form| Pairs::new(spec, form));
        let pairs: Result<Vec<_>, _> = pairs.collect();
        let pairs = pairs.map_err(|error| unscheduled(&spec.file, &error))?;
        Ok(FormKernels { spec, text: spec.module(&pairs), pairs })
    }
}

impl FormSpec {
    fn module(&self, pairs: &[Pairs]) -> String {
        let functions: TokenStream = (self.kernels().zip(pairs))
            .filter(|(form, pairs)| !by_values(form, pairs))
            .map(|(form, pairs)| function(self, form, pairs))
            .collect();
        let about = self.about();
        let (name, origin) = (identifier(&self.name), about.origin(&functions));
        let mut heading = about.heading();
        let inline: Vec<String> = (self.forms.iter().zip(pairs))
            .filter(|(form, pairs)| by_values(form, pairs))
            .map(|(form, _)| format!("`{}`", form.name))
            .collect();
        if !inline.is_empty() {
            heading += &format!(
                "\nOf values of the functions only, and written out in the module of each element: {}.\n",
                inline.join(", ")
            );
        }
        let heading = documented(&heading);
        let uses = match functions.is_empty() {
            true => quote!(
                use crate::Origin;
            ),
            false => quote!(
                use crate::{Lane, Matrix, Origin, Register, Shared, cells};
            ),
        };
        text(quote! {
            #heading
            pub mod #name {
                #uses
                #functions
                /// The entry of the registry.
                pub const ENTRY: Origin = #origin;
            }
        })
    }
}

/// Whether only values of the functions occur, in one scalar matrix: few numbers that kernels of elements write out.
pub(in crate::kinds) fn by_values(form: &Form, pairs: &Pairs) -> bool {
    let kronecker = matches!(form.structure, Structure::Kronecker { .. });
    kronecker && pairs.moments.iter().all(|moment| *moment == (0, 0))
}

/// Name of the function of a form, or of a stress.
pub(in crate::kinds) fn pairs_name(form: &Form) -> Ident {
    match form.stress.as_ref().is_some_and(|stress| stress.at_points) {
        true => format_ident!("{}_points_", identifier(&form.name)),
        false => format_ident!("{}_pairs_", identifier(&form.name)),
    }
}

/// The sums over the points for every pair of basis functions, and the components that the form makes of them.
fn function(spec: &FormSpec, form: &Form, pairs: &Pairs) -> TokenStream {
    let name = pairs_name(form);
    let parts = count(pairs.parts().len());
    let block_of_form = Block::new(form, pairs);
    let (block, both, length) =
        (block_name(form), block_of_form.functions(spec), count(block_of_form.once.len()));
    if pairs.under_stress {
        let function = match form.stress.as_ref().is_some_and(|stress| stress.at_points) {
            true => at_points(form, pairs, &length),
            false => under_stress(form, pairs, &length),
        };
        return quote!(#both #function);
    }
    let loops = match &form.structure {
        Structure::Kronecker { .. } => each_pair(
            pairs,
            &quote!(a),
            |b, sums| quote!(cells::store_entry(&mut matrix, functions, a, #b, #block(#sums, once));),
        ),
        Structure::Symmetric => {
            let each = each_pair(
                pairs,
                &quote!(a + 1),
                |b, sums| quote!(cells::store_block(&mut matrix, rows, #b, #block(#sums, once));),
            );
            quote! {
                let rows = cells::upper_rows(3 * functions, a);
                let own = #block(cells::own_sums(of_a), once);
                cells::store_diagonal(&mut matrix, rows, a, own);
                #each
            }
        }
        Structure::Full => {
            let each = each_pair(
                pairs,
                &quote!(0),
                |b, sums| quote!(cells::store_block(&mut matrix, rows, #b, #block(#sums, once));),
            );
            quote! {
                let rows = cells::full_rows(3 * functions, a);
                #each
            }
        }
    };
    let about = documented(&header(form, pairs));
    quote! {
        #both
        #about
        pub fn #name<L: Register>(
            basis: &[[L; #parts]],
            points: usize,
            once: [L; #length],
            matrix: Matrix<L>,
        ) {
            struct Pairs<'a, L> {
                basis: &'a [[L; #parts]],
                points: usize,
                once: [L; #length],
                matrix: Matrix<'a, L>,
            }
            impl<L: Register> Shared<L> for Pairs<'_, L> {
                type Output = ();

                #[inline(always)]
                fn run(self) {
                    let Pairs { basis, points, once, mut matrix } = self;
                    let functions = basis.len() / points;
                    for (a, of_a) in basis.chunks_exact(points).enumerate() {
                        #loops
                    }
                }
            }
            L::shared(Pairs { basis, points, once, matrix })
        }
    }
}

/// The components of a stress at the points.
fn at_points(form: &Form, pairs: &Pairs, length: &impl quote::ToTokens) -> TokenStream {
    let (name, block) = (pairs_name(form), block_name(form));
    let of = form.integrated_as();
    let about = documented(&format!(
        "`{}`: the stress of a displacement as `{of}` has it, at the points.\n\nbasis: functions × points × (∂N/∂x, \
         ∂N/∂y, ∂N/∂z), each times √(w det J); roots: √(w det J). displacement: of all functions, those of the nodes and \
         those of modes. once: what [`{}`] gives. stresses: xx, yy, zz, xy, yz, zx at every point.\n\nA point: the slopes \
         of the displacement, then {}.",
        form.name,
        once_name(form),
        pairs.pair_counts(),
    ));
    quote! {
        #about
        #[inline(always)]
        pub fn #name<L: Register, const POINTS: usize>(
            basis: &[[[L; 3]; POINTS]],
            roots: &[L; POINTS],
            displacement: [&[[L; 3]]; 2],
            once: [L; #length],
            mut stresses: Matrix<L>,
        ) {
            for q in 0..cells::looped(POINTS) {
                let [[xx, xy, _], [_, yy, yz], [zx, _, zz]] =
                    #block(cells::slopes(basis, roots, displacement, q), once);
                stresses.set(6 * q, &[xx, yy, zz, xy, yz, zx]);
            }
        }
    }
}

/// The same of a form under a stress, which differs from point to point.
fn under_stress(form: &Form, pairs: &Pairs, length: &impl quote::ToTokens) -> TokenStream {
    let (name, block) = (pairs_name(form), block_name(form));
    let about = documented(&format!(
        "`{}`: ∫ `{}` dV, rows from v, columns from u, for every pair of the first basis functions of a cell, under the \
         stress of a displacement.\n\nbasis: functions × points × (∂N/∂x, ∂N/∂y, ∂N/∂z), each times √(w det J); roots: \
         √(w det J). displacement: of all functions, those of the nodes and those of modes; the functions of the nodes \
         have a row in the matrix. once: what [`{}`] gives. matrix: a symmetric matrix with one row a node, times a \
         constant 3 × 3 pattern: upper triangle by rows.\n\nA point: the slopes of the displacement, then {}. A pair: \
         sums over the points.",
        form.name,
        form.text.text(),
        once_name(form),
        pairs.pair_counts(),
    ));
    quote! {
        #about
        #[inline(always)]
        pub fn #name<L: Register, const POINTS: usize>(
            basis: &[[[L; 3]; POINTS]],
            roots: &[L; POINTS],
            displacement: [&[[L; 3]]; 2],
            once: [L; #length],
            matrix: Matrix<L>,
        ) {
            let mut coefficients = [[[L::splat(0.0); 3]; 3]; POINTS];
            for q in 0..cells::looped(POINTS) {
                coefficients[q] = #block(cells::slopes(basis, roots, displacement, q), once);
            }
            cells::weighted_sums(&basis[..displacement[0].len()], &coefficients, matrix);
        }
    }
}

/// A loop over the functions b from `first` on: two at a time where there are registers for their sums.
fn each_pair(
    pairs: &Pairs,
    first: &TokenStream,
    store: impl Fn(TokenStream, TokenStream) -> TokenStream,
) -> TokenStream {
    let one = store(quote!(b), quote!(sums));
    // As many sums as registers hold beside the values.
    let two = (pairs.moments.len() <= 9).then(|| {
        let other = store(quote!(b + 1), quote!(next));
        quote! {
            while L::MANY && b + 1 < functions {
                let (of_b, of_next) = (&basis[b * points..], &basis[(b + 1) * points..]);
                let [sums, next] = cells::sums(of_a, [of_b, of_next]);
                #one
                #other
                b += 2;
            }
        }
    });
    quote! {
        let mut b = #first;
        #two
        while b < functions {
            let [sums] = cells::sums(of_a, [&basis[b * points..]]);
            #one
            b += 1;
        }
    }
}

fn header(form: &Form, pairs: &Pairs) -> String {
    let matrix = match form.structure {
        Structure::Symmetric => "symmetric, three rows a function, upper triangle by rows",
        Structure::Full => "three rows a function, by rows",
        Structure::Kronecker { .. } => {
            "a symmetric matrix with one row a function, times a constant 3 × 3 pattern: upper triangle by rows"
        }
    };
    let parts = pairs.parts().iter().map(|part| ["N", "∂N/∂x", "∂N/∂y", "∂N/∂z"][*part]);
    format!(
        "`{}`: ∫ `{}` dV, rows from v, columns from u, for every pair of basis functions of a cell.\n\nbasis: \
         functions × points × ({}), each times √(w det J). once: what [`{}`] gives. matrix: {matrix}.\n\nA pair: the \
         sums of {} products over the points, then {}.",
        form.name,
        form.text.text(),
        parts.collect::<Vec<_>>().join(", "),
        once_name(form),
        pairs.moments.len(),
        pairs.pair_counts(),
    )
}
