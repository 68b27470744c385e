//! Values of the names of a law.

use rustc_hash::FxHashMap;

use super::{Definition, LawInput, LawTable, Parameter};
use crate::formula::{Names, Value};

/// Places of the names of a law in the order in which their values become known.
#[derive(Debug, Clone)]
pub(super) struct Places(FxHashMap<String, usize>);

/// Values of the names of a law, by their places.
pub(super) struct Named<'l, N> {
    places: &'l Places,
    values: Vec<Value<N>>,
}

/// A name that gets its value after those of the inputs and parameters.
pub(super) enum Made<'l> {
    Table(&'l LawTable),
    Definition(&'l Definition),
}

/// Definitions in their order, each table after as many of them as it says.
pub(super) fn made<'l>(
    tables: &'l [LawTable],
    definitions: &'l [Definition],
) -> impl Iterator<Item = Made<'l>> {
    (0..=definitions.len()).flat_map(move |place| {
        let tables = tables.iter().filter(move |table| table.after == place);
        tables.map(Made::Table).chain(definitions.get(place).map(Made::Definition))
    })
}

impl Places {
    pub(super) fn new(
        inputs: &[LawInput],
        parameters: &[Parameter],
        tables: &[LawTable],
        definitions: &[Definition],
    ) -> Self {
        let made = made(tables, definitions).map(|made| match made {
            Made::Table(table) => &table.name,
            Made::Definition(definition) => &definition.name,
        });
        let given = inputs.iter().map(|input| &input.name);
        let given = given.chain(parameters.iter().map(|parameter| &parameter.name));
        Places(given.chain(made).enumerate().map(|(place, name)| (name.clone(), place)).collect())
    }

    /// No values yet.
    pub(super) fn named<N>(&self) -> Named<'_, N> {
        Named { places: self, values: Vec::with_capacity(self.0.len()) }
    }
}

impl<N> Named<'_, N> {
    /// Adds the value of the next name.
    pub(super) fn push(&mut self, value: Value<N>) {
        self.values.push(value);
    }
}

impl<N> Names<N> for Named<'_, N> {
    fn named(&self, name: &str) -> Option<&Value<N>> {
        self.values.get(*self.places.0.get(name)?)
    }
}
