//! A law file as it was written: keys, names and units checked, formulas parsed.

mod output;
mod state;
mod valid;
mod variable;

pub(super) use output::{Jumps, Output};
pub(super) use valid::{Limit, ValidityDraft};
pub(super) use variable::Variable;

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use crate::rational::Rational;

use super::acts::{Acts, Quantity as Known};
use super::limits::Limits;
use super::table::{self, TableDraft};
use super::{BearingValue, Given, KIND};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source};
use crate::document::{Document, Table};
use crate::formula::Formula;
use crate::kinds::read::FindFile;
use crate::kinds::read::{self, Head};
use crate::units::Unit;
use variable::{parse, variable};

/// Most bytes of a law file.
const LONGEST: usize = 32 * 1024;

/// A law file as it was written.
pub(super) struct Draft {
    pub(super) file: Arc<Source>,
    pub(super) name: String,
    pub(super) title: String,
    pub(super) reference: String,
    pub(super) acts: Acts,
    /// The inputs, then the states.
    pub(super) inputs: Vec<Variable>,
    pub(super) parameters: Vec<Constant>,
    pub(super) tables: Vec<TableDraft>,
    pub(super) definitions: Vec<(Located, String, Formula)>,
    /// The outputs, then the rates of the states.
    pub(super) outputs: Vec<Output>,
    /// By states the values at which they begin; none where their rates are zero.
    pub(super) starts: Vec<Option<Rational>>,
    /// What is stored (J), if the file says so.
    pub(super) stored: Option<Formula>,
    pub(super) valid: Vec<ValidityDraft>,
}

pub(super) struct Constant {
    pub(super) key: Located,
    pub(super) name: String,
    pub(super) title: String,
    pub(super) unit: Unit,
    pub(super) value: Rational,
    pub(super) bearing: Option<BearingValue>,
    /// Values that it may have, in the unit of the file.
    pub(super) limits: Limits,
    pub(super) file_unit: Unit,
}

impl Draft {
    /// Puts these values in the place of those of the file.
    ///
    /// # Errors
    /// A name that is none of its parameters, or a value that one may not have.
    pub(super) fn give(&mut self, given: &[Given]) -> Result<(), Diagnostics> {
        let mut errors = Diagnostics::new();
        for Given { name, value, unit } in given {
            match self.parameters.iter_mut().find(|parameter| parameter.name == *name) {
                Some(parameter) => {
                    let of = &parameter.file_unit;
                    if let Some(words) = parameter.limits.refuse(value, unit, of) {
                        let message = format!("`{name}` has to be {words}");
                        errors.push(parameter.key.error_here(Code::BAD_VALUE, message));
                    }
                    (parameter.value, parameter.unit) = (value.clone(), unit.clone());
                }
                None => {
                    let message = format!("this law has no parameter `{name}`");
                    errors.push(Diagnostic::new(&self.file, Code::UNKNOWN_NAME, None, message));
                }
            }
        }
        errors.into_result(())
    }
}

/// Reads the file; formulas are parsed but their names are not looked up yet.
pub(super) fn read(file: &Arc<Source>, beside: &FindFile<'_>) -> Result<Draft, Diagnostics> {
    if file.text.len() > LONGEST {
        let message = format!("a law file is at most {LONGEST} bytes long");
        return Err(Diagnostic::new(file, Code::LIMIT, None, message).into());
    }
    read::spec(file, KIND.shape, |document, root, head| draft(document, file, root, head, beside))
}

fn draft<'d>(
    document: &'d Document<'d>,
    file: &Arc<Source>,
    root: Table<'d>,
    head: Head,
    beside: &FindFile<'_>,
) -> Option<Draft> {
    let fine = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    head.check(document, fine, "a law's name is made of letters, digits, `-`, `_` and `.`");
    let mut names = Names { taken: BTreeMap::new(), document };
    let inputs = names.named(root.table("inputs"), |entry, key, name| {
        variable(entry, key, name, Acts::inputs, "an input")
    });
    let table_of_states = root.optional_table("states");
    let declared: Vec<String> = table_of_states.as_ref().map_or(Vec::new(), |table| {
        let keys = table.names().into_iter();
        keys.filter_map(|key| crate::formula::name(key.text()).ok()).collect()
    });
    let states = names.named(table_of_states, state::read);
    let parameters = names.named(root.optional_table("parameters"), parameter);
    let tables = names.all(root.optional_table("tables"), |entry, key, name| {
        let table = table::read(&entry, key, name, beside);
        entry.finish();
        table
    });
    let mut definitions = Vec::new();
    if let Some(table) = root.optional_table("definitions") {
        for key in table.names() {
            let name = names.take(&key);
            let formula = table.string(key.text()).and_then(|text| parse(document, &text));
            if let (Some(name), Some(formula)) = (name, formula) {
                definitions.push((key, name, formula));
            }
        }
        table.finish();
    }
    let table_of_outputs = root.table("outputs");
    if let Some(table) = table_of_outputs.as_ref().filter(|table| table.names().is_empty()) {
        let message = "a law has at least one output, such as `Q`".to_owned();
        table.error(Code::MISSING_KEY, table.span(), message);
    }
    let mut outputs = names.named(table_of_outputs, output::read);
    let acts = acts(document, &inputs, &outputs);
    let is_free = |name: &str| !names.taken.contains_key(name);
    outputs.extend(state::rates(
        root.optional_table("rates"),
        (&states, &declared),
        is_free,
        &root,
    ));
    let stored = root.optional_string("stored").and_then(|text| parse(document, &text));
    // Nothing refers to measures, so that one may have the name of an input. The ends of tables are measures, too.
    let taken = tables.iter().map(|table: &TableDraft| (table.name.clone(), table.key.span()));
    let mut names = Names { taken: taken.collect(), document };
    let valid = names.all(root.optional_table("valid"), |entry, key, name| {
        let measure = valid::read(&entry, key, name);
        entry.finish();
        measure
    });
    root.finish();
    let [name, title, reference] = head.texts()?;
    let mut inputs = inputs;
    let starts = states.iter().map(|own| own.start.clone()).collect();
    inputs.extend(states.into_iter().map(|own| own.variable));
    Some(Draft {
        file: file.clone(),
        name,
        title,
        reference,
        acts,
        inputs,
        parameters,
        tables,
        definitions,
        outputs,
        starts,
        stored,
        valid,
    })
}

/// Reads a parameter.
fn parameter(entry: &Table<'_>, key: &Located, name: String) -> Option<Constant> {
    let document = entry.document();
    let value = entry.number("value");
    let title = entry.optional_string("title").map_or(String::new(), |t| t.text().into());
    let unit_place = entry.string("unit");
    let unit = unit_place.as_ref().and_then(|text| read::unit(document, text));
    let bearing = entry.optional_word("bearing").and_then(BearingValue::called);
    if let (Some(bearing), Some(unit), Some(place)) = (bearing, &unit, &unit_place) {
        fits(document, &name, bearing, unit, place);
    }
    let limits = Limits::read(entry);
    let (unit, (value, place)) = (unit?, value?);
    if let Some(words) = limits.refuse(&value, &unit, &unit) {
        entry.error(Code::BAD_VALUE, place, format!("`{name}` has to be {words}"));
        return None;
    }
    let (key, file_unit) = (key.clone(), unit.clone());
    Some(Constant { key, name, title, unit, value, bearing, limits, file_unit })
}

/// Notes a parameter that cannot be what it says it is of the bearing.
fn fits(document: &Document<'_>, name: &str, bearing: BearingValue, unit: &Unit, place: &Located) {
    let wanted = bearing.dimension();
    if !unit.dimension().fits(&wanted) {
        let (word, found) = (bearing.word(), unit.dimension());
        let message =
            format!("`{name}` is the `{word}`, {wanted}, but `{unit}` is the unit of {found}");
        let error = place.error_here(Code::WRONG_UNIT, message);
        document.push(error.help(format!("write for example `unit = \"{}\"`", wanted.si_unit())));
    }
}

/// What the law acts on: the kind of which all names are known.
fn acts(document: &Document<'_>, inputs: &[Variable], outputs: &[Output]) -> Acts {
    let variables = || inputs.iter().chain(outputs.iter().map(|output| &output.variable));
    let telling = || variables().filter_map(|v| v.only.map(|acts| (v, acts)));
    let Some((first, acts)) = telling().next() else { return Acts::Spring };
    // A name of joints makes a law of a joint of one that has else those of rings.
    let acts = telling()
        .map(|(_, own)| own)
        .find(|own| own.has_all_of(acts) && *own != acts)
        .unwrap_or(acts);
    let listed = |quantities: &[Known]| {
        let names: Vec<String> = quantities.iter().map(|q| format!("`{}`", q.name)).collect();
        names.join(", ")
    };
    let mut mixed = false;
    for (other, kind) in telling().filter(|(_, kind)| !acts.has_all_of(*kind)) {
        let message = format!(
            "`{}` belongs to {}, but `{}` to {}",
            other.name,
            kind.called(),
            first.name,
            acts.called()
        );
        let (inputs, outputs) = (listed(acts.inputs()), listed(acts.outputs()));
        let help = format!("{} takes {inputs} and gives {outputs}", acts.called());
        document.push(other.key.error_here(Code::UNKNOWN_NAME, message).help(help));
        mixed = true;
    }
    // Outputs that could not be read are not missing.
    for needed in acts.needed() {
        let found = outputs.iter().any(|output| output.variable.name == *needed);
        if !found && !mixed && !outputs.is_empty() && !document.has_errors() {
            let place = &outputs[0].variable.key;
            let message = format!("{} must give `{needed}` too", acts.called());
            let error = place.error_here(Code::MISSING_KEY, message);
            document.push(error.help(format!("write a section `[outputs.{needed}]`")));
        }
    }
    acts
}

/// The names declared so far.
struct Names<'d> {
    taken: BTreeMap<String, Range<usize>>,
    document: &'d Document<'d>,
}

impl<'d> Names<'d> {
    /// What `read` makes of the tables in a table, each with its name if that is free.
    fn all<T>(
        &mut self,
        table: Option<Table<'d>>,
        mut read: impl FnMut(Table<'d>, &Located, Option<String>) -> Option<T>,
    ) -> Vec<T> {
        let Some(table) = table else { return Vec::new() };
        let mut all = Vec::new();
        for key in table.names() {
            let entry = table.table(key.text());
            let name = self.take(&key);
            all.extend(entry.and_then(|entry| read(entry, &key, name)));
        }
        table.finish();
        all
    }

    /// The same for those that have a name.
    fn named<T>(
        &mut self,
        table: Option<Table<'d>>,
        mut read: impl FnMut(&Table<'d>, &Located, String) -> Option<T>,
    ) -> Vec<T> {
        self.all(table, |entry, key, name| {
            let made = read(&entry, key, name?);
            entry.finish();
            made
        })
    }

    fn take(&mut self, key: &Located) -> Option<String> {
        let name = read::name(self.document, key, |name| match self.taken.get(&name) {
            Some(first) => {
                let (line, _) = key.source().line_column(first.start);
                Err(format!("the name `{name}` is taken since line {line}"))
            }
            None => Ok(name),
        })?;
        self.taken.insert(name.clone(), key.span());
        Some(name)
    }
}
