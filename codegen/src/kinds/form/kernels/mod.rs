//! Kernels of forms: what a form makes of the basis functions of any element, pair by pair. The kernels of elements
//! fill in the functions and call them.

mod block;
mod pairs;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::{Form, FormSpec, Structure};
use crate::diagnostic::Diagnostics;
use crate::emit::{Head, Loop, Size, Value, Work, count, documented, identifier};
use crate::kinds::cells;
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
    match form.at_points() {
        true => format_ident!("{}_points_", identifier(&form.name)),
        false => format_ident!("{}_pairs_", identifier(&form.name)),
    }
}

/// The sums over the points for every pair of basis functions, and the components that the form makes of them.
fn function(spec: &FormSpec, form: &Form, pairs: &Pairs) -> TokenStream {
    let name = pairs_name(form);
    let parts = count(pairs.parts().len());
    let block = Block::new(form, pairs);
    let (both, length, work) =
        (block.functions(spec), count(block.once.len()), work(form, pairs, Sizes::default()));
    if pairs.under_stress {
        let (about, matrix) = match form.at_points() {
            true => (about_points(form, pairs), quote!(mut stresses)),
            false => (about_stress(form, pairs), quote!(matrix)),
        };
        let about = documented(&about);
        return quote! {
            #both
            #about
            #[inline(always)]
            pub fn #name<L: Register, const POINTS: usize>(
                basis: &[[[L; 3]; POINTS]],
                roots: &[L; POINTS],
                displacement: [&[[L; 3]]; 2],
                once: [L; #length],
                #matrix: Matrix<L>,
            ) {
                #work
            }
        };
    }
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
                    #work
                }
            }
            L::shared(Pairs { basis, points, once, matrix })
        }
    }
}

/// How many functions, those of nodes among them, and points there are.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::kinds) struct Sizes {
    pub(in crate::kinds) functions: usize,
    pub(in crate::kinds) nodes: usize,
    pub(in crate::kinds) points: usize,
}

/// What the function of a form does, whose text is that for any sizes.
pub(in crate::kinds) fn work(form: &Form, pairs: &Pairs, sizes: Sizes) -> Work {
    match pairs.under_stress {
        true => under_stress(form, pairs, sizes),
        false => each_function(form, pairs, sizes),
    }
}

/// A loop over the functions a, and in it one over the functions b.
fn each_function(form: &Form, pairs: &Pairs, sizes: Sizes) -> Work {
    let block = block_name(form);
    let (mut work, mut each) = (Work::new(), Work::new());
    let in_rows = |b: TokenStream, sums: TokenStream| quote!(cells::store_block(&mut matrix, rows, #b, #block(#sums, once)));
    let pairs_of_a = match &form.structure {
        Structure::Kronecker { .. } => each_pair(
            pairs,
            sizes,
            Size::Index("a"),
            |b, sums| quote!(cells::store_entry(&mut matrix, functions, a, #b, #block(#sums, once))),
        ),
        Structure::Symmetric => {
            let operations = cells::sums(pairs.different(), sizes.points) + pairs.own_flops();
            each.name(quote!(rows), quote!(cells::upper_rows(3 * functions, a)));
            let own = quote!(#block(cells::own_sums(of_a), once));
            each.bind(quote!(own), Value::call(own, operations));
            each.call(Value::free(quote!(cells::store_diagonal(&mut matrix, rows, a, own))));
            each_pair(pairs, sizes, Size::After("a"), in_rows)
        }
        Structure::Full => {
            each.name(quote!(rows), quote!(cells::full_rows(3 * functions, a)));
            each_pair(pairs, sizes, Size::Number(0), in_rows)
        }
    };
    each.then(pairs_of_a);
    let functions = quote!(basis.chunks_exact(points).enumerate());
    let (from, to) = (Size::Number(0), Size::Named("functions", sizes.functions));
    let head = Head::Over(quote!((a, of_a)), functions);
    work.repeat(Loop { index: "a", from, to, head, body: each });
    work
}

/// A loop over the functions b: two at a time where there are registers for their sums. `store`: of b and its sums.
fn each_pair(
    pairs: &Pairs,
    sizes: Sizes,
    from: Size,
    store: impl Fn(TokenStream, TokenStream) -> TokenStream,
) -> Work {
    let sums = cells::sums(pairs.moments.len(), sizes.points);
    let store = |b, sums| Value::call(store(b, sums), pairs.flops());
    let (mut work, mut one) = (Work::new(), Work::new());
    let of_b = quote!(cells::sums(of_a, [&basis[b * points..]]));
    one.bind(quote!([sums]), Value::call(of_b, sums));
    one.call(store(quote!(b), quote!(sums)));
    // As many sums as registers hold beside the values.
    let two = (pairs.moments.len() <= 9).then(|| {
        let mut two = Work::new();
        let both = quote!((&basis[b * points..], &basis[(b + 1) * points..]));
        two.name(quote!((of_b, of_next)), both);
        let of_both = quote!(cells::sums(of_a, [of_b, of_next]));
        two.bind(quote!([sums, next]), Value::call(of_both, 2 * sums));
        two.call(store(quote!(b), quote!(sums)));
        two.call(store(quote!(b + 1), quote!(next)));
        two
    });
    let to = Size::Named("functions", sizes.functions);
    work.repeat(Loop { index: "b", from, to, head: Head::ByTwos(two), body: one });
    work
}

/// The components at the points by the slopes of a displacement: those of a stress, or the coefficients of sums.
fn under_stress(form: &Form, pairs: &Pairs, sizes: Sizes) -> Work {
    let (block, points) = (block_name(form), Size::Named("POINTS", sizes.points));
    let components = Value::call(
        quote!(#block(cells::slopes(basis, roots, displacement, q), once)),
        cells::slopes(sizes.functions) + pairs.flops(),
    );
    let (mut work, mut point) = (Work::new(), Work::new());
    if form.at_points() {
        point.bind(quote!([[xx, xy, _], [_, yy, yz], [zx, _, zz]]), components);
        let set = quote!(stresses.set(6 * q, &[xx, yy, zz, xy, yz, zx]));
        point.call(Value::free(set));
        work.kept("q", points, point);
    } else {
        work.name(quote!(mut coefficients), quote!([[[L::splat(0.0); 3]; 3]; POINTS]));
        point.store(quote!(coefficients[q]), components);
        work.kept("q", points, point);
        let of_nodes = quote!(&basis[..displacement[0].len()]);
        work.call(Value::call(
            quote!(cells::weighted_sums(#of_nodes, &coefficients, matrix)),
            cells::weighted_sums(sizes.nodes, sizes.points),
        ));
    }
    work
}

impl Form {
    /// Whether it is a stress at the points, and no matrix.
    pub(in crate::kinds) fn at_points(&self) -> bool {
        self.stress.as_ref().is_some_and(|stress| stress.at_points)
    }
}

fn about_points(form: &Form, pairs: &Pairs) -> String {
    let of = form.integrated_as();
    format!(
        "`{}`: the stress of a displacement as `{of}` has it, at the points.\n\nbasis: functions × points × (∂N/∂x, \
         ∂N/∂y, ∂N/∂z), each times √(w det J); roots: √(w det J). displacement: of all functions, those of the nodes and \
         those of modes. once: what [`{}`] gives. stresses: xx, yy, zz, xy, yz, zx at every point.\n\nA point: the slopes \
         of the displacement, then {}.",
        form.name,
        once_name(form),
        pairs.pair_counts(),
    )
}

fn about_stress(form: &Form, pairs: &Pairs) -> String {
    format!(
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
    )
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
