//! Kernels of a law: its outputs with all first derivatives, over one lane and over rows of springs.

use num_traits::ToPrimitive;
use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, quote};

use super::{Condition, LawInput, LawSpec, Validity};
use crate::diagnostic::Diagnostics;
use crate::emit::{Numbers, documented, identifier, operand, statements};
use crate::kinds::kernel::{self, unscheduled, variable};
use crate::kinds::kind::About;
use crate::schedule::Program;

impl LawSpec {
    /// The module of its kernels: the law, and where it may be believed.
    pub(crate) fn module(&self) -> Result<String, Diagnostics> {
        let refused = |error| unscheduled(&self.file, &error);
        let measures = self.measures_program().map_err(refused)?;
        let program = &self.program().map_err(refused)?;
        let about = self.about();
        let measured = measures.as_ref().map(|program| measures_of(self, program));
        let stored = self.stored_program().map_err(refused)?;
        let stored = stored.as_ref().map(|program| stored_of(self, program));
        let functions = functions(self, program);
        let only_forces = &self.forces_of(program);
        let forces = forces_of(self, only_forces);
        let [of_all, of_forces] = [(program, "Skeleton"), (only_forces, "ForcesSkeleton")];
        let (of_all, skeleton) = with_numbers(self, of_all);
        let (of_forces, forces_skeleton) = with_numbers(self, of_forces);
        let functions = quote!(#functions #forces #of_all #of_forces #measured #stored);
        let skeletons = quote!(skeleton: #skeleton, forces_skeleton: #forces_skeleton,);
        let entry = entry(self, &about, &functions, &skeletons);
        let name = identifier(&self.name);
        let heading = documented(&format!("{}{}", about.heading(), pieces(self)));
        let validity = measures.is_some().then(|| quote!(Validity,));
        let has_skeletons = !of_all.is_empty() || !of_forces.is_empty();
        let skeleton =
            has_skeletons.then(|| quote!(LawSkeleton, SkeletonKernel, each_spring_with,));
        let state = (!self.states.is_empty()).then(|| quote!(LawState,));
        let module = quote! {
            #heading
            pub mod #name {
                use crate::{Lane, Law, #skeleton #state Origin, SpringKernel, #validity Variable, each_spring};
                #functions
                #entry
            }
        };
        Ok(kernel::text(module))
    }
}

/// The pieces as the spec gives them.
fn pieces(law: &LawSpec) -> String {
    let units: Vec<String> =
        law.inputs.iter().map(|input| format!("{} in {}", input.name, input.unit)).collect();
    let mut text = String::new();
    for output in &law.outputs {
        text += &format!("\n{} in {}, {}:\n", output.name, output.unit, units.join(", "));
        for piece in &output.pieces {
            let condition = match &piece.when {
                Some(Condition::Threshold { text, at, moved_from: Some(_), .. }) => {
                    let at = at.to_f64().unwrap_or(f64::NAN);
                    format!("where `{}`, moved to the root at {at:e} in SI", text.text())
                }
                Some(Condition::Threshold { text, .. }) => format!("where `{}`", text.text()),
                Some(Condition::Formula(formula)) => format!("where `{}`", formula.text.text()),
                None if output.pieces.len() > 1 => "elsewhere".to_string(),
                None => "everywhere".to_string(),
            };
            text += &format!("* `{}` {condition}\n", piece.value.text.text());
        }
    }
    text
}

fn functions(law: &LawSpec, program: &Program) -> TokenStream {
    let inputs = taken(law, program);
    let from = law
        .inputs
        .iter()
        .map(|input| format!("{} ({})", input.name, input.unit.dimension().si_unit()));
    let from: Vec<String> = from.collect();
    let from = from.join(", ");
    let names: Vec<&str> = program.outputs.iter().map(|output| output.name.as_str()).collect();
    let about_spring =
        documented(&format!("{} of {from}, SI; {}.", names.join(", "), program.total_counts()));
    let about_rows = documented(&format!(
        "Rows of `springs` values, SI: {} from {from}. A spring reads {} bytes and writes {}.",
        names.join(", "),
        8 * inputs.len(),
        8 * names.len()
    ));
    let (kernel, names) = (quote!(Kernel), [quote!(evaluate), quote!(outputs)]);
    rows(program, &inputs, kernel, names, [about_spring, about_rows])
}

/// The outputs without their derivatives.
fn forces_of(law: &LawSpec, program: &Program) -> TokenStream {
    let names: Vec<&str> = program.outputs.iter().map(|output| output.name.as_str()).collect();
    let names = names.join(", ");
    let about_spring = documented(&format!("{names}; {}.", program.total_counts()));
    let about_rows =
        documented(&format!("Rows of `springs` values, SI: {names} alone, to the same bits."));
    let inputs = taken(law, program);
    let (kernel, names) = (quote!(Forces), [quote!(forces), quote!(outputs)]);
    rows(program, &inputs, kernel, names, [about_spring, about_rows])
}

/// A kernel of one spring, and the function that evaluates rows of springs by it, called by the first of `names`; the
/// second is what it writes to.
fn rows(
    program: &Program,
    inputs: &[TokenStream],
    kernel: TokenStream,
    [function, written]: [TokenStream; 2],
    [about_spring, about_rows]: [TokenStream; 2],
) -> TokenStream {
    let (body, one_by_one) = (body(program), one_by_one(program));
    let input_count = Literal::usize_unsuffixed(inputs.len());
    let count = Literal::usize_unsuffixed(program.outputs.len());
    quote! {
        enum #kernel {}

        impl SpringKernel<#input_count, #count> for #kernel {
            #one_by_one
            #about_spring
            #[inline(always)]
            fn spring<L: Lane>([#(#inputs),*]: [L; #input_count]) -> [L; #count] {
                #body
            }
        }

        #about_rows
        pub fn #function(springs: usize, inputs: &[f64], #written: &mut [f64]) {
            each_spring::<#kernel, #input_count, #count>(springs, inputs, #written);
        }
    }
}

/// The kernel of a program with any numbers in the places of its own, and its entry. None where the program has no numbers.
fn with_numbers(law: &LawSpec, (program, kernel): (&Program, &str)) -> (TokenStream, TokenStream) {
    let skeleton = program.skeleton().filter(|(_, numbers)| !numbers.is_empty());
    let Some((skeleton, numbers)) = skeleton else { return (TokenStream::new(), quote!(None)) };
    let (inputs, body) = (taken(law, program), body(&skeleton.program));
    let one_by_one = one_by_one(&skeleton.program);
    let names = skeleton.numbers().map(identifier);
    let about = documented(&format!(
        "The same with numbers that are given: {} takes those of the file, in the order in which they stand there.",
        if kernel == "Skeleton" { "`Kernel`" } else { "`Forces`" }
    ));
    let [input_count, number_count, output_count] =
        [inputs.len(), numbers.len(), program.outputs.len()].map(Literal::usize_unsuffixed);
    let (key, kernel) = (skeleton.key(), identifier(kernel));
    let text = quote! {
        enum #kernel {}

        impl SkeletonKernel<#input_count, #number_count, #output_count> for #kernel {
            #one_by_one
            #about
            #[inline(always)]
            fn spring<L: Lane>(
                [#(#inputs),*]: [L; #input_count],
                [#(#names),*]: [L; #number_count],
            ) -> [L; #output_count] {
                #body
            }
        }
    };
    let entry = quote! {
        Some(LawSkeleton {
            key: #key,
            numbers: #number_count,
            evaluate: each_spring_with::<#kernel, #input_count, #number_count, #output_count>,
        })
    };
    (text, entry)
}

/// What a kernel says of functions that lanes compute one value after the other.
fn one_by_one(program: &Program) -> Option<TokenStream> {
    let is_said = !program.is_side_by_side();
    is_said.then(|| {
        quote!(
            const SIDE_BY_SIDE: bool = false;
        )
    })
}

/// The inputs of a law as a kernel of one spring names them; those that only parameters of zero multiply are not used.
fn taken(law: &LawSpec, program: &Program) -> Vec<TokenStream> {
    let used = program.used_inputs();
    let inputs = law.inputs.iter().map(|input| match used.contains(&input.name) {
        true => identifier(&input.name).to_token_stream(),
        false => quote!(_),
    });
    inputs.collect()
}

/// The measures of the inputs by which the law may be believed or not.
fn measures_of(law: &LawSpec, program: &Program) -> TokenStream {
    let inputs = taken(law, program);
    let names: Vec<&str> = law.valid.iter().map(|own| own.name.as_str()).collect();
    let about = documented(&format!(
        "Rows of `springs` values, SI: where the law may be believed, by {}.",
        names.join(", ")
    ));
    let (kernel, names) = (quote!(Measures), [quote!(measure), quote!(measures)]);
    rows(program, &inputs, kernel, names, [TokenStream::new(), about])
}

/// The energy that the law stores.
fn stored_of(law: &LawSpec, program: &Program) -> TokenStream {
    let inputs = taken(law, program);
    let about = documented("Rows of `springs` values: the energy that is stored (J).");
    let (kernel, names) = (quote!(Energy), [quote!(stored), quote!(energies)]);
    rows(program, &inputs, kernel, names, [TokenStream::new(), about])
}

/// A number that may be negative or infinite.
fn number(value: f64) -> TokenStream {
    let size = match value.abs() {
        size if size.is_infinite() => quote!(f64::INFINITY),
        size => Literal::f64_unsuffixed(size).to_token_stream(),
    };
    if value < 0.0 { quote!(-#size) } else { size }
}

fn validity(own: &Validity) -> TokenStream {
    let Validity { name, title, help, unit, limits: [least, most], .. } = own;
    let (per, unit) = (number(unit.factor().to_f64()), unit.text());
    let (least, most) = (number(*least), number(*most));
    quote! {
        Validity {
            name: #name, title: #title, help: #help,
            unit: #unit, per_unit: #per, limits: [#least, #most],
        }
    }
}

/// The statements of a program of one stage, and its outputs as an array.
fn body(program: &Program) -> TokenStream {
    let statements = statements(program, 0, Numbers::Lanes);
    let outputs =
        program.outputs.iter().map(|output| operand(program, output.operand, Numbers::Lanes));
    quote!(#(#statements)* [#(#outputs),*])
}

fn entry(
    law: &LawSpec,
    about: &About,
    functions: &TokenStream,
    skeletons: &TokenStream,
) -> TokenStream {
    let origin = about.origin(functions);
    let as_variable =
        |input: &LawInput| variable(&input.name, &input.unit.dimension().si_unit(), &input.title);
    let inputs = law.taken().iter().map(as_variable);
    let states = law.remembered().iter().zip(&law.states).map(|(input, state)| {
        let own = as_variable(input);
        let start = match state.start {
            Some(start) => {
                let start = number(start);
                quote!(Some(#start))
            }
            None => quote!(None),
        };
        let range = match input.range {
            Some([low, high]) => {
                let (low, high) = (number(low), number(high));
                quote!(Some([#low, #high]))
            }
            None => quote!(None),
        };
        quote!(LawState { variable: #own, start: #start, range: #range })
    });
    let stored = match law.stores() {
        true => quote!(Some(stored)),
        false => quote!(None),
    };
    let outputs = law
        .given()
        .iter()
        .map(|output| variable(&output.name, &output.unit.dimension().si_unit(), &output.title));
    let valid = law.valid.iter().map(validity);
    let measure = match law.valid.is_empty() {
        true => quote!(measure: |_, _, _| {}),
        false => quote!(measure),
    };
    quote! {
        /// The entry of the registry.
        pub const ENTRY: Law = Law {
            origin: #origin,
            inputs: &[#(#inputs),*],
            outputs: &[#(#outputs),*],
            states: &[#(#states),*],
            evaluate,
            forces: Some(forces),
            #skeletons
            stored: #stored,
            valid: &[#(#valid),*],
            #measure,
        };
    }
}
