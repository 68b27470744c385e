//! File → film.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::operators::{self, Known, LENGTHS, MEANT, TEST, named};
use super::rule::{NODES, Rule, WORDS};
use super::schema::KIND;
use super::spec::{Edge, Field, FilmSpec, Force, Integral, Parameter, Term, Variable};
use crate::diagnostic::{Code, Diagnostics, Located, Source, suggest};
use crate::document::{Document, Table, Value};
use crate::expression::{Graph, Id, Shape};
use crate::formula::{self, Formula, Meaning, Scope};
use crate::kinds::read::{self, Head};
use crate::units::{Dimension, Exponent, Unit};

/// Most bytes of a film file.
const LONGEST: usize = 32 * 1024;
/// Most parameters, and most of what is listed by name elsewhere.
const MOST: usize = 64;

pub(super) fn read(file: &Arc<Source>) -> Result<FilmSpec, Diagnostics> {
    if file.text.len() > LONGEST {
        let message = format!("a film file is at most {LONGEST} bytes long");
        let error = crate::diagnostic::Diagnostic::new(file, Code::LIMIT, None, message);
        return Err(error.into());
    }
    read::spec(file, KIND.shape, |document, root, head| {
        Reader::new(document).spec(file, root, head)
    })
}

struct Reader<'d> {
    document: &'d Document<'d>,
    graph: Graph,
    symbols: BTreeMap<String, Id>,
    meanings: BTreeMap<String, Meaning>,
    /// Where names were declared, of those that formulas should use.
    declared: Vec<Located>,
    used: BTreeSet<String>,
    fields: Vec<String>,
    speed: String,
}

/// A formula with its value and what it measures.
type Lowered = (Formula, Id, Option<Dimension>);

/// Volume per area and time, which the terms of the weak form are.
const FLOW: Dimension = Dimension::SPEED;

impl<'d> Reader<'d> {
    fn new(document: &'d Document<'d>) -> Self {
        Reader {
            document,
            graph: Graph::new(),
            symbols: BTreeMap::new(),
            meanings: BTreeMap::new(),
            declared: Vec::new(),
            used: BTreeSet::new(),
            fields: Vec::new(),
            speed: String::new(),
        }
    }

    fn spec(mut self, file: &Arc<Source>, root: Table<'d>, head: Head) -> Option<FilmSpec> {
        let fine = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
        head.check(
            self.document,
            fine,
            "a film's name is made of letters, digits, `-`, `_` and `.`",
        );
        let nodes = self.cell(&root);
        let [dx, dz] = LENGTHS.map(|name| self.declare(name, Dimension::LENGTH));
        let unknowns = self.variables(&root, "unknowns", 2, None);
        let gap = self.variables(&root, "gap", 1, Some(Dimension::LENGTH));
        let speed = self.variables(&root, "speed", 1, Some(Dimension::SPEED));
        if let Some(Some(speed)) = speed.as_ref().map(|list| list.first()) {
            self.speed.clone_from(&speed.name);
        }
        let fields = unknowns.iter().chain(&gap).flatten();
        self.fields = fields.map(|own| own.name.clone()).collect();
        let parameters = self.parameters(&root);
        self.fields.clone().iter().for_each(|name| self.operators_of(name));
        let nodal = self.nodal(&root);
        let definitions = self.definitions(&root);
        let stored = self.stored(&root, &nodal);
        let test = self.test_function();
        let terms = root.table("residual").map(|table| {
            let list = self.terms(&table, nodes, true, &FLOW);
            table.finish();
            list
        });
        self.forget_test_function();
        let forces = self.forces(&root);
        let edges = self.edges(&root, unknowns.as_deref().unwrap_or_default());
        let outputs = self.outputs(&root, nodes);
        root.finish();
        self.unused();
        if self.document.has_errors() {
            return None;
        }
        let [name, title, reference] = head.texts()?;
        Some(FilmSpec {
            name,
            title,
            reference,
            file: file.clone(),
            nodes: nodes?,
            unknowns: <[Variable; 2]>::try_from(unknowns?).ok()?,
            gap: gap?.into_iter().next()?,
            speed: speed?.into_iter().next()?,
            parameters: parameters?,
            nodal,
            definitions,
            stored: stored?,
            terms: terms?,
            forces,
            edges,
            outputs,
            graph: self.graph,
            lengths: [dx, dz],
            test,
        })
    }

    fn cell(&self, root: &Table<'d>) -> Option<[usize; 2]> {
        let table = root.table("cell")?;
        let nodes = ["around", "along"].map(|key| {
            let count = table.count(key)?;
            if !(2..=3).contains(&count) {
                let message = format!("a cell has 2 or 3 nodes `{key}` the bore, not {count}");
                table.error(Code::BAD_VALUE, table.place(key), message);
                return None;
            }
            Some(count)
        });
        table.finish();
        let [around, along] = nodes;
        Some([around?, along?])
    }

    /// A free name.
    fn name(&mut self, key: &Located) -> Option<String> {
        let symbols = &self.symbols;
        read::name(self.document, key, |name| match name.as_str() {
            meant if MEANT.contains(&meant) => {
                Err(format!("the name `{name}` has a meaning of its own in films"))
            }
            taken if symbols.contains_key(taken) => Err(format!("the name `{name}` is taken")),
            _ => Ok(name),
        })
    }

    fn declare(&mut self, name: &str, dimension: Dimension) -> Id {
        let symbol = self.graph.scalar(name);
        self.mean(name, symbol, Some(dimension));
        symbol
    }

    fn mean(&mut self, name: &str, id: Id, dimension: Option<Dimension>) {
        self.symbols.insert(name.to_owned(), id);
        if let Some(dimension) = dimension {
            self.meanings.insert(name.to_owned(), Meaning { dimension, value: None });
        }
    }

    /// Slopes and upstream value of a field become names.
    fn operators_of(&mut self, field: &str) {
        let dimension = self.meanings.get(field).map(|meaning| meaning.dimension);
        let slope = dimension.and_then(|own| own.checked_over(&Dimension::LENGTH));
        for (operator, dimension) in [("ddx", slope), ("ddz", slope), ("upstream", dimension)] {
            let name = named(operator, field);
            let symbol = self.graph.scalar(&name);
            self.mean(&name, symbol, dimension);
        }
    }

    fn test_function(&mut self) -> [Id; 3] {
        let v = self.declare(TEST, Dimension::NUMBER);
        let slope = Dimension::LENGTH.power(Exponent::from(-1));
        let [x, z] = ["ddx", "ddz"].map(|operator| self.declare(&named(operator, TEST), slope));
        [v, x, z]
    }

    fn forget_test_function(&mut self) {
        for name in [TEST.to_owned(), named("ddx", TEST), named("ddz", TEST)] {
            self.symbols.remove(&name);
            self.meanings.remove(&name);
        }
    }

    /// An SI unit.
    fn si(&self, entry: &Table<'d>, wanted: Option<&Dimension>) -> Option<(Unit, Located)> {
        let text = entry.string("unit")?;
        let unit = read::unit(self.document, &text)?;
        let fits = wanted.is_none_or(|wanted| unit.dimension().fits(wanted));
        if !fits || !unit.factor().is_one() {
            let expected = wanted.unwrap_or(unit.dimension());
            let message = format!("a film is written in SI: {expected} expected");
            let error = text.error_here(Code::WRONG_UNIT, message);
            self.document.push(error.help(format!("write `unit = \"{}\"`", expected.si_unit())));
            return None;
        }
        Some((unit, text))
    }

    /// So many variables of a table.
    fn variables(
        &mut self,
        root: &Table<'d>,
        table: &str,
        count: usize,
        dimension: Option<Dimension>,
    ) -> Option<Vec<Variable>> {
        let place = table;
        let table = root.table(place)?;
        let keys = table.names();
        if keys.len() != count {
            let s = if count == 1 { "" } else { "s" };
            let message = format!("`{place}` must declare {count} name{s}, not {}", keys.len());
            table.error(Code::BAD_VALUE, table.span(), message);
        }
        let mut list = Vec::new();
        for key in keys.iter().take(count) {
            let Some(entry) = table.table(key.text()) else { continue };
            let name = self.name(key);
            let unit = self.si(&entry, dimension.as_ref());
            let title = entry.optional_string("title");
            entry.finish();
            let (Some(name), Some((unit, _))) = (name, unit) else { continue };
            let symbol = self.declare(&name, *unit.dimension());
            self.declared.push(key.clone());
            let title = title.map_or(String::new(), |title| title.text().to_owned());
            list.push(Variable { name, title, unit: unit.text().to_owned(), symbol });
        }
        table.finish();
        (list.len() == count).then_some(list)
    }

    fn parameters(&mut self, root: &Table<'d>) -> Option<Vec<Parameter>> {
        let table = root.table("parameters")?;
        let keys = table.names();
        self.not_too_many(&table, &keys);
        let mut list = Vec::new();
        for key in &keys {
            let Some(entry) = table.table(key.text()) else { continue };
            let name = self.name(key);
            let value = entry.number("value");
            let title = entry.optional_string("title");
            let unit_place = entry.string("unit");
            let unit = unit_place.as_ref().and_then(|text| read::unit(self.document, text));
            entry.finish();
            let (Some(name), Some((written, _)), Some(unit)) = (name, value, unit) else {
                continue;
            };
            let symbol = self.declare(&name, *unit.dimension());
            self.declared.push(key.clone());
            let title = title.map_or(String::new(), |title| title.text().to_owned());
            list.push(Parameter { name, title, unit, written, place: key.clone(), symbol });
        }
        table.finish();
        Some(list)
    }

    fn not_too_many(&self, table: &Table<'d>, keys: &[Located]) {
        if keys.len() > MOST {
            let message = format!("at most {MOST} names, not {}", keys.len());
            table.error(Code::LIMIT, table.span(), message);
        }
    }

    /// Fields at the nodes: over unknowns, gap and parameters, no slopes.
    fn nodal(&mut self, root: &Table<'d>) -> Vec<Field> {
        let Some(table) = root.optional_table("nodal") else { return Vec::new() };
        let keys = table.names();
        self.not_too_many(&table, &keys);
        // Values at a node by the names of fields before.
        let mut values: BTreeMap<Id, Id> = BTreeMap::new();
        let mut list = Vec::new();
        for key in &keys {
            let name = self.name(key);
            let text = table.string(key.text());
            let lowered = text.and_then(|text| {
                self.formula(&text, &Known { fields: &[], speed: "", test: false })
            });
            let (Some(name), Some((formula, id, dimension))) = (name, lowered) else { continue };
            self.no_cell(&formula);
            let value = self.graph.substitute(id, &values);
            let symbol = self.graph.scalar(&name);
            self.mean(&name, symbol, dimension);
            self.declared.push(key.clone());
            values.insert(symbol, value);
            list.push(Field { name, formula, symbol, value });
        }
        table.finish();
        for field in &list {
            self.fields.push(field.name.clone());
            self.operators_of(&field.name);
        }
        list
    }

    /// A node is in several cells, and moves with none of them.
    fn no_cell(&self, formula: &Formula) {
        let names = formula.names();
        let of_cell = names.iter().find(|(name, _)| LENGTHS.contains(name) || **name == self.speed);
        if let Some((name, span)) = of_cell {
            let message = format!("`{name}` is not known at the nodes");
            let error = formula.text.error(Code::BAD_VALUE, span.clone(), message);
            self.document
                .push(error.help("use it in `definitions`, which are evaluated where they stand"));
        }
    }

    fn definitions(&mut self, root: &Table<'d>) -> Vec<(String, Formula, Id)> {
        let Some(table) = root.optional_table("definitions") else { return Vec::new() };
        let keys = table.names();
        self.not_too_many(&table, &keys);
        let mut list = Vec::new();
        for key in &keys {
            let name = self.name(key);
            let text = table.string(key.text());
            let lowered = text.and_then(|text| self.over_fields(&text, false));
            let (Some(name), Some((formula, id, dimension))) = (name, lowered) else { continue };
            self.mean(&name, id, dimension);
            self.declared.push(key.clone());
            list.push((name, formula, id));
        }
        table.finish();
        list
    }

    /// What a node holds, over unknowns, gap and parameters.
    fn stored(&mut self, root: &Table<'d>, nodal: &[Field]) -> Option<(Formula, Id)> {
        let table = root.table("stored")?;
        let text = table.string("value");
        table.finish();
        let (formula, id, dimension) =
            self.formula(&text?, &Known { fields: &[], speed: "", test: false })?;
        self.no_cell(&formula);
        self.measures(&formula, dimension, &Dimension::LENGTH, "what a node holds per area");
        let values = nodal.iter().map(|field| (field.symbol, field.value)).collect();
        Some((formula, self.graph.substitute(id, &values)))
    }

    /// Parts of a weak form or an integral, per area of this dimension.
    fn terms(
        &mut self,
        table: &Table<'d>,
        nodes: Option<[usize; 2]>,
        test: bool,
        wanted: &Dimension,
    ) -> Vec<Term> {
        let keys = table.names();
        self.not_too_many(table, &keys);
        if keys.is_empty() {
            table.error(Code::MISSING_KEY, table.span(), "at least one term is needed".to_owned());
        }
        let mut list = Vec::new();
        for key in &keys {
            let Some(entry) = table.table(key.text()) else { continue };
            let name = read::name(self.document, key, Ok);
            let text = entry.string("value");
            let lowered = text.and_then(|text| self.over_fields(&text, test));
            let rules = self.points(&entry, nodes);
            entry.finish();
            let (Some(name), Some((formula, value, dimension)), Some(rules)) =
                (name, lowered, rules)
            else {
                continue;
            };
            let what =
                if test { "a term of the weak form" } else { "a term of this integral, per area," };
            self.measures(&formula, dimension, wanted, what);
            list.push(Term { name, formula, value, rules });
        }
        list
    }

    fn points(&self, entry: &Table<'d>, nodes: Option<[usize; 2]>) -> Option<[Rule; 2]> {
        entry.demand("points");
        let refuse = |span| {
            let message = format!("`points` is \"{NODES}\", or a rule around and one along");
            entry.error(Code::BAD_VALUE, span, message);
        };
        match entry.value("points")? {
            Value::String(text) if text.text() == NODES => {
                nodes.map(|nodes| nodes.map(Rule::nodes))
            }
            Value::Array(items, span) => {
                let rules: Option<Vec<Rule>> = items
                    .iter()
                    .map(|item| match item.value() {
                        Value::String(text) => Rule::called(text.text()),
                        _ => None,
                    })
                    .collect();
                let rules = rules.and_then(|rules| <[Rule; 2]>::try_from(rules).ok());
                if rules.is_none() {
                    let words = WORDS.join("`, `");
                    let message = format!("`points` is \"{NODES}\", or two rules out of `{words}`");
                    entry.error(Code::BAD_VALUE, span, message);
                }
                rules
            }
            other => {
                refuse(other.span());
                None
            }
        }
    }

    fn forces(&mut self, root: &Table<'d>) -> Vec<Force> {
        let Some(table) = root.table("forces") else { return Vec::new() };
        let mut list: Vec<Force> = Vec::new();
        for key in &table.names() {
            let Some(entry) = table.table(key.text()) else { continue };
            let name = read::name(self.document, key, Ok);
            let on = entry.string("on");
            let text = entry.string("value");
            let lowered = text.and_then(|text| self.over_fields(&text, false));
            entry.finish();
            let (Some(name), Some(on), Some((formula, value, dimension))) = (name, on, lowered)
            else {
                continue;
            };
            self.measures(&formula, dimension, &Dimension::PRESSURE, "a force per area");
            list.push(Force { name, on, formula, value, unit: "Pa".to_owned() });
        }
        table.finish();
        list
    }

    fn edges(&mut self, root: &Table<'d>, unknowns: &[Variable]) -> Vec<Edge> {
        let Some(table) = root.table("edges") else { return Vec::new() };
        let mut list = Vec::new();
        let names: Vec<&str> = unknowns.iter().map(|own| own.name.as_str()).collect();
        for key in &table.names() {
            let Some(entry) = table.table(key.text()) else { continue };
            let name = read::name(self.document, key, Ok);
            let mut given = [false; 2];
            for text in entry.texts("given") {
                match names.iter().position(|own| *own == text.text()) {
                    Some(place) => given[place] = true,
                    None => {
                        let message = format!("`{}` is no unknown", text.text());
                        let error = text.error_here(Code::UNKNOWN_NAME, message);
                        self.document.push(error.maybe_help(suggest(text.text(), &names)));
                    }
                }
            }
            entry.demand("given");
            let pair = entry.texts("complementary");
            entry.finish();
            let out = !pair.is_empty();
            let second = names.get(1).copied().unwrap_or_default();
            let fits = match out {
                true => {
                    let is_pair = matches!(pair.as_slice(), [a, b] if a.text() == "out" && b.text() == second);
                    is_pair && given == [true, false]
                }
                false => given == [true, true],
            };
            if !fits && !self.document.has_errors() {
                let message = "an edge gives the first unknown, and the second or how it takes turns with what leaves";
                let error = key.error_here(Code::BAD_VALUE, message);
                let all = names.join("\", \"");
                let first = names.first().copied().unwrap_or_default();
                self.document.push(error.help(format!(
                    "write `given = [\"{all}\"]`, or `given = [\"{first}\"]` and `complementary = [\"out\", \"{second}\"]`"
                )));
            }
            list.extend(name.map(|name| Edge { name, given, out }));
        }
        table.finish();
        list
    }

    fn outputs(&mut self, root: &Table<'d>, nodes: Option<[usize; 2]>) -> Vec<Integral> {
        let Some(table) = root.optional_table("outputs") else { return Vec::new() };
        let mut list = Vec::new();
        for key in &table.names() {
            let Some(entry) = table.table(key.text()) else { continue };
            let name = read::name(self.document, key, Ok);
            let unit = self.si(&entry, None);
            let title = entry.optional_string("title");
            let per_area =
                unit.as_ref().and_then(|(unit, _)| unit.dimension().checked_over(&Dimension::AREA));
            let per_area = per_area.unwrap_or(Dimension::NUMBER);
            let terms = entry.table("terms").map(|terms| {
                let list = self.terms(&terms, nodes, false, &per_area);
                terms.finish();
                list
            });
            entry.finish();
            let (Some(name), Some((unit, _)), Some(terms)) = (name, unit, terms) else { continue };
            let title = title.map_or(String::new(), |title| title.text().to_owned());
            list.push(Integral { name, title, unit: unit.text().to_owned(), terms });
        }
        table.finish();
        list
    }

    /// A formula over fields and their slopes.
    fn over_fields(&mut self, text: &Located, test: bool) -> Option<Lowered> {
        let (fields, speed) = (self.fields.clone(), self.speed.clone());
        let fields: Vec<&str> = fields.iter().map(String::as_str).collect();
        self.formula(text, &Known { fields: &fields, speed: &speed, test })
    }

    /// Parses, checks and lowers a formula.
    fn formula(&mut self, text: &Located, known: &Known<'_>) -> Option<Lowered> {
        let document = self.document;
        let refuse = |errors: Diagnostics| document.append(errors);
        let formula = formula::parse(text).map_err(refuse).ok()?;
        let formula = operators::rewrite(formula, known);
        let formula = formula.map_err(|error| document.push(*error)).ok()?;
        self.used.extend(formula.names().into_keys().map(str::to_owned));
        let graph = &self.graph;
        let scope: Scope =
            self.symbols.iter().map(|(name, id)| (name.clone(), graph.shape(*id))).collect();
        formula::check(&formula, &scope).map_err(refuse).ok()?;
        let dimension =
            formula::dimension_of_pure(&formula, &self.meanings).map_err(refuse).ok()?;
        let id = formula::lower(&formula, &mut self.graph, &self.symbols).map_err(refuse).ok()?;
        if self.graph.shape(id) != Shape::Scalar {
            let message = "a number is expected here, not a condition";
            document.push(text.error_here(Code::SHAPE, message));
            return None;
        }
        Some((formula, id, dimension))
    }

    fn measures(
        &self,
        formula: &Formula,
        found: Option<Dimension>,
        wanted: &Dimension,
        what: &str,
    ) {
        let Some(found) = found.filter(|found| *found != wanted.without_angle()) else { return };
        let message = format!("{what} is in {}, this is {found}", wanted.si_unit());
        self.document.push(formula.text.error_here(Code::DIMENSION, message));
    }

    /// A name that nothing uses is most likely a slip of the pen.
    fn unused(&self) {
        if self.document.has_errors() {
            return;
        }
        for key in &self.declared {
            let Ok(name) = formula::name(key.text()) else { continue };
            let made = ["ddx", "ddz", "upstream"].map(|operator| named(operator, &name));
            if !self.used.contains(&name) && !made.iter().any(|made| self.used.contains(made)) {
                let message = format!("`{name}` is not used by any formula");
                self.document.push(key.error_here(Code::UNUSED, message).help("leave it out"));
            }
        }
    }
}
