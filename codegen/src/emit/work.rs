//! Bodies of kernels as data: what is bound, stored, called and repeated. Their text and the operations that they take
//! follow from the same steps; of a function that a kernel calls both are said where the call is made.

use std::collections::BTreeMap;
use std::ops::{Add, Mul, Sub};

use proc_macro2::TokenStream;
use quote::{ToTokens, TokenStreamExt, format_ident, quote};

use super::{Numbers, count, statements};
use crate::schedule::Program;

/// A bound of a loop.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Size {
    Number(usize),
    /// What the text calls by a name, and how large it is.
    Named(&'static str, usize),
    /// The index of a loop around.
    Index(&'static str),
    /// The place after that.
    After(&'static str),
}

/// Places of the loops around.
type Around = BTreeMap<&'static str, usize>;

impl Size {
    fn within(self, around: &Around) -> usize {
        match self {
            Size::Number(number) | Size::Named(_, number) => number,
            Size::Index(name) => around[name],
            Size::After(name) => around[name] + 1,
        }
    }
}

impl ToTokens for Size {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        match self {
            Size::Number(number) => tokens.append(count(*number)),
            Size::Named(name, _) | Size::Index(name) => tokens.append(format_ident!("{name}")),
            Size::After(name) => {
                let name = format_ident!("{name}");
                tokens.extend(quote!(#name + 1));
            }
        }
    }
}

/// An expression over lanes, and the operations that it takes.
#[derive(Debug, Clone)]
pub(crate) struct Value {
    text: TokenStream,
    operations: usize,
}

impl Value {
    /// What takes no operation: a name, an entry, a number.
    pub(crate) fn free(text: TokenStream) -> Self {
        Value::call(text, 0)
    }

    /// A call of functions that take so many operations.
    pub(crate) fn call(text: TokenStream, operations: usize) -> Self {
        Value { text, operations }
    }

    /// self · factor + addend.
    pub(crate) fn mul_add(self, factor: Value, addend: Value) -> Self {
        let operations = self.operations + factor.operations + addend.operations + 2;
        Value::call(quote!(#self.mul_add(#factor, #addend)), operations)
    }

    /// `[a, b, …]`.
    pub(crate) fn list(entries: &[Value]) -> Self {
        let operations = entries.iter().map(|entry| entry.operations).sum();
        Value::call(quote!([#(#entries),*]), operations)
    }

    /// `{ … }`.
    pub(crate) fn block(work: &Work) -> Self {
        Value::call(quote!({ #work }), work.operations())
    }
}

impl ToTokens for Value {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        self.text.to_tokens(tokens);
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $operator:tt),*) => {$(
        impl $trait for Value {
            type Output = Value;

            fn $method(self, other: Value) -> Value {
                let operations = self.operations + other.operations + 1;
                Value::call(quote!(#self $operator #other), operations)
            }
        }
    )*};
}
operators!(Add add +, Sub sub -, Mul mul *);

/// Steps one after the other.
#[derive(Debug, Clone)]
pub(crate) struct Work(Vec<Step>);

#[derive(Debug, Clone)]
enum Step {
    /// `let pattern = value;`
    Let(TokenStream, Value),
    /// `place = value;`
    Store(TokenStream, Value),
    /// `value;`
    Call(Value),
    /// Straight-line statements, or the value at the end.
    Text(Value),
    Loop(Loop),
    /// Operations of the steps before that no result needs: a compiler leaves them out.
    Unused(usize),
}

/// A loop over the places from one bound to before another.
#[derive(Debug, Clone)]
pub(crate) struct Loop {
    /// What the text calls the place.
    pub(crate) index: &'static str,
    pub(crate) from: Size,
    pub(crate) to: Size,
    pub(crate) head: Head,
    pub(crate) body: Work,
}

/// How a loop is written.
#[derive(Debug, Clone)]
pub(crate) enum Head {
    /// Over a range of numbers.
    Range,
    /// The same, from zero, and kept as a loop: see `cells::looped`.
    Kept,
    /// Over what gives each place: a pattern, and the iterator.
    Over(TokenStream, TokenStream),
    /// Two places at a time, by the work for both, where there are registers for that.
    ByTwos(Option<Work>),
}

impl Work {
    pub(crate) const fn new() -> Self {
        Work(Vec::new())
    }

    /// Binds names to a value.
    pub(crate) fn bind(&mut self, pattern: TokenStream, value: Value) {
        self.0.push(Step::Let(pattern, value));
    }

    /// Binds names to what takes no operation.
    pub(crate) fn name(&mut self, pattern: TokenStream, text: TokenStream) {
        self.bind(pattern, Value::free(text));
    }

    pub(crate) fn store(&mut self, place: TokenStream, value: Value) {
        self.0.push(Step::Store(place, value));
    }

    pub(crate) fn call(&mut self, value: Value) {
        self.0.push(Step::Call(value));
    }

    /// Takes off operations of the steps before whose results are not used.
    pub(crate) fn unused(&mut self, operations: usize) {
        self.0.push(Step::Unused(operations));
    }

    /// What the steps give.
    pub(crate) fn give(&mut self, value: Value) {
        self.0.push(Step::Text(value));
    }

    /// A stage of a schedule.
    pub(crate) fn stage(&mut self, program: &Program, stage: usize, numbers: Numbers) {
        let text = statements(program, stage, numbers).into_iter().collect();
        self.0.push(Step::Text(Value::call(text, program.counts(stage).arithmetic())));
    }

    pub(crate) fn repeat(&mut self, repeated: Loop) {
        self.0.push(Step::Loop(repeated));
    }

    /// `for index in 0..to { body }`.
    pub(crate) fn each(&mut self, index: &'static str, to: usize, body: Work) {
        let (from, to) = (Size::Number(0), Size::Number(to));
        self.repeat(Loop { index, from, to, head: Head::Range, body });
    }

    /// The same, kept as a loop.
    pub(crate) fn kept(&mut self, index: &'static str, to: Size, body: Work) {
        self.repeat(Loop { index, from: Size::Number(0), to, head: Head::Kept, body });
    }

    pub(crate) fn then(&mut self, next: Work) {
        self.0.extend(next.0);
    }

    /// Operations that the results of all steps need: additions, subtractions, multiplications, divisions and functions.
    pub(crate) fn operations(&self) -> usize {
        self.operations_within(&mut Around::new())
    }

    fn operations_within(&self, around: &mut Around) -> usize {
        self.0.iter().fold(0, |sum, step| match step {
            Step::Let(_, value) | Step::Store(_, value) | Step::Call(value) | Step::Text(value) => {
                sum + value.operations
            }
            Step::Unused(operations) => sum - operations,
            Step::Loop(Loop { index, from, to, body, .. }) => {
                let places = from.within(around)..to.within(around);
                let each = places.map(|place| {
                    around.insert(*index, place);
                    body.operations_within(around)
                });
                sum + each.sum::<usize>()
            }
        })
    }
}

impl ToTokens for Work {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        for step in &self.0 {
            tokens.extend(match step {
                Step::Let(pattern, value) => quote!(let #pattern = #value;),
                Step::Store(place, value) => quote!(#place = #value;),
                Step::Call(value) => quote!(#value;),
                Step::Text(value) => quote!(#value),
                Step::Loop(repeated) => repeated.text(),
                Step::Unused(_) => TokenStream::new(),
            });
        }
    }
}

impl Loop {
    fn text(&self) -> TokenStream {
        let Loop { from, to, head, body, .. } = self;
        let index = format_ident!("{}", self.index);
        match head {
            Head::Range => quote!(for #index in #from..#to { #body }),
            Head::Kept => quote!(for #index in #from..cells::looped(#to) { #body }),
            Head::Over(pattern, iterator) => quote!(for #pattern in #iterator { #body }),
            Head::ByTwos(two) => {
                let two = two.as_ref().map(|two| {
                    quote! {
                        while L::MANY && #index + 1 < #to {
                            #two
                            #index += 2;
                        }
                    }
                });
                quote! {
                    let mut #index = #from;
                    #two
                    while #index < #to {
                        #body
                        #index += 1;
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(name: &str) -> Value {
        let name = format_ident!("{name}");
        Value::free(quote!(#name))
    }

    #[test]
    fn text_and_operations_follow_from_the_same_steps() {
        let mut inner = Work::new();
        inner.bind(quote!(c), name("a").mul_add(name("b") * name("b"), name("d") - name("a")));
        inner.store(quote!(out[i][j]), Value::call(quote!(root(c)), 7));
        let (from, to) = (Size::After("i"), Size::Named("n", 4));
        let mut outer = Work::new();
        outer.repeat(Loop { index: "j", from, to, head: Head::Range, body: inner });
        outer.call(Value::call(quote!(sums(n)), 40));
        outer.unused(5);
        let mut work = Work::new();
        work.kept("i", to, outer);
        let expected = quote! {
            for i in 0..cells::looped(n) {
                for j in i + 1..n {
                    let c = a.mul_add(b * b, d - a);
                    out[i][j] = root(c);
                }
                sums(n);
            }
        };
        assert_eq!(quote!(#work).to_string(), expected.to_string());
        let pairs = 3 + 2 + 1;
        assert_eq!(work.operations(), pairs * (4 + 7) + 4 * (40 - 5));
    }
}
