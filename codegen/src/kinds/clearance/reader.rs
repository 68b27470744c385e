//! Keys, names, units and formulas of a clearance file.

use std::collections::BTreeMap;

use super::{Apart, Coordinate, RINGS};
use crate::diagnostic::{Code, Diagnostics, Located};
use crate::document::{Document, Table, Value};
use crate::expression::{Graph, Id};
use crate::formula::{self, Formula, Meaning, Scope};
use crate::kinds::read;
use crate::units::Dimension;

/// What laws call the force normal to the clearance.
const NORMAL_FORCE: &str = "Q";

pub(super) struct Reader<'d> {
    pub(super) document: &'d Document<'d>,
    pub(super) graph: Graph,
    symbols: BTreeMap<String, Id>,
    meanings: BTreeMap<String, Meaning>,
}

impl<'d> Reader<'d> {
    pub(super) fn new(document: &'d Document<'d>) -> Self {
        Reader {
            document,
            graph: Graph::new(),
            symbols: BTreeMap::new(),
            meanings: BTreeMap::new(),
        }
    }

    /// A name that is free, and that of no normal force, rate or slope.
    pub(super) fn name(&mut self, key: &Located) -> Option<String> {
        read::name(self.document, key, |name| {
            let meant = match name.as_str() {
                NORMAL_FORCE => "the normal force",
                rate if rate.ends_with("_dot") => "a rate",
                slope if slope.starts_with('d') && slope.contains("_d") => "a slope",
                _ if self.symbols.contains_key(&name) => {
                    return Err(format!("the name `{name}` is taken"));
                }
                _ => return Ok(name),
            };
            Err(format!("the name `{name}` is that of {meant}"))
        })
    }

    /// The coordinates of one table: as many as `units`, each of its dimension.
    pub(super) fn coordinates(
        &mut self,
        root: &Table<'d>,
        table: &str,
        units: &[Dimension],
    ) -> Option<Vec<Coordinate>> {
        self.some_coordinates(root, table, units, &[units.len()])
    }

    /// As [`Reader::coordinates`], but as many of the first as one of `counts`.
    pub(super) fn some_coordinates(
        &mut self,
        root: &Table<'d>,
        table: &str,
        units: &[Dimension],
        counts: &[usize],
    ) -> Option<Vec<Coordinate>> {
        let place = table;
        let table = root.table(place)?;
        let keys = table.names();
        if !counts.contains(&keys.len()) {
            let needed = counts.iter().map(usize::to_string).collect::<Vec<_>>().join(" or ");
            let s = if needed == "1" { "" } else { "s" };
            let message = format!("`{place}` must declare {needed} name{s}, not {}", keys.len());
            table.error(Code::BAD_VALUE, table.span(), message);
        }
        let mut list = Vec::new();
        for (key, dimension) in keys.iter().zip(units) {
            let Some(entry) = table.table(key.text()) else { continue };
            let name = self.name(key);
            let unit = entry.string("unit");
            let title = entry.optional_string("title");
            entry.finish();
            let (Some(name), Some(unit)) = (name, unit) else { continue };
            if !self.is_si(&unit, dimension) {
                continue;
            }
            list.push(self.declare(name, title, unit.text(), dimension));
        }
        table.finish();
        Some(list)
    }

    /// As [`Reader::coordinates`]; none where the table is not there.
    pub(super) fn optional_coordinates(
        &mut self,
        root: &Table<'d>,
        table: &str,
        units: &[Dimension],
    ) -> Option<Vec<Coordinate>> {
        if root.has(table) { self.coordinates(root, table, units) } else { Some(Vec::new()) }
    }

    /// The coordinates of an optional table: as many as `part`, or with `more` behind them.
    pub(super) fn whole_or_part(
        &mut self,
        root: &Table<'d>,
        table: &str,
        part: &[Dimension],
        more: &[Dimension],
    ) -> Option<Vec<Coordinate>> {
        let units = [part, more].concat();
        match root.has(table) {
            true => self.some_coordinates(root, table, &units, &[part.len(), units.len()]),
            false => Some(Vec::new()),
        }
    }

    fn declare(
        &mut self,
        name: String,
        title: Option<Located>,
        unit: &str,
        dimension: &Dimension,
    ) -> Coordinate {
        let symbol = self.graph.scalar(&name);
        self.symbols.insert(name.clone(), symbol);
        self.meanings.insert(name.clone(), Meaning { dimension: *dimension, value: None });
        let title = title.map_or(String::new(), |title| title.text().to_owned());
        Coordinate { name, title, unit: unit.to_owned(), symbol }
    }

    fn is_si(&self, text: &Located, dimension: &Dimension) -> bool {
        let Some(unit) = read::unit(self.document, text) else { return false };
        let right = unit.dimension().fits(dimension) && unit.factor().is_one();
        if !right {
            let message = format!("a clearance is written in SI: {dimension} expected");
            let error = text.error_here(Code::WRONG_UNIT, message);
            let si = dimension.si_unit();
            self.document.push(error.help(format!("write `unit = \"{si}\"`")));
        }
        right
    }

    pub(super) fn definitions(&mut self, root: &Table<'d>) -> Option<Vec<(String, Id)>> {
        let Some(table) = root.optional_table("definitions") else {
            return Some(Vec::new());
        };
        let mut list = Vec::new();
        for key in table.names() {
            let name = self.name(&key);
            let value = table.string(key.text()).and_then(|text| self.formula(&text));
            let (Some(name), Some((_, id, dimension))) = (name, value) else { continue };
            self.symbols.insert(name.clone(), id);
            if let Some(dimension) = dimension {
                self.meanings.insert(name.clone(), Meaning { dimension, value: None });
            }
            list.push((name, id));
        }
        table.finish();
        Some(list)
    }

    pub(super) fn clearance(&mut self, root: &Table<'d>) -> Option<(String, Formula, Id)> {
        let table = root.table("clearance")?;
        let keys = table.names();
        let [key] = keys.as_slice() else {
            let message = "`clearance` holds one formula, such as `h = 'c - …'`".to_owned();
            table.error(Code::BAD_VALUE, table.span(), message);
            return None;
        };
        let name = self.name(key);
        let text = table.string(key.text())?;
        let (formula, id, dimension) = self.formula(&text)?;
        table.finish();
        if dimension.is_some_and(|dimension| !dimension.fits(&Dimension::LENGTH)) {
            let message = "a clearance is a length".to_owned();
            self.document.push(text.error_here(Code::DIMENSION, message));
        }
        Some((name?, formula, id))
    }

    pub(super) fn axial(&mut self, root: &Table<'d>) -> Option<(Coordinate, [Id; RINGS])> {
        let table = root.table("axial")?;
        let keys = table.names();
        let [key] = keys.as_slice() else {
            let message = "`axial` holds one list of functions, such as `s = ['…', …]`".to_owned();
            table.error(Code::BAD_VALUE, table.span(), message);
            return None;
        };
        let name = self.name(key)?;
        let items = table.items(key.text())?;
        // The functions are of this variable alone.
        let others = (std::mem::take(&mut self.symbols), std::mem::take(&mut self.meanings));
        let variable = self.declare(name, None, "1", &Dimension::NUMBER);
        let mut functions = Vec::new();
        for item in &items {
            match item.value() {
                Value::String(text) => functions.extend(self.formula(&text).map(|(_, id, _)| id)),
                other => {
                    let message = "an axial function is a formula in a string".to_owned();
                    table.error(Code::BAD_VALUE, other.span(), message);
                }
            }
        }
        (self.symbols, self.meanings) = others;
        if items.len() != RINGS {
            let message = format!("{} axial functions, but {RINGS} are needed", items.len());
            table.error(Code::BAD_VALUE, table.span(), message);
        }
        table.finish();
        Some((variable, <[Id; RINGS]>::try_from(functions).ok()?))
    }

    /// The angle, the two distances, and what they add, each by the name of the distance along its axis.
    pub(super) fn apart(&mut self, root: &Table<'d>) -> Option<Apart> {
        let table = root.table("apart")?;
        let keys = table.names();
        let [angle] = keys.as_slice() else {
            let message = "`apart` names one angle, such as `phi = { D_x = '…', D_y = '…' }`";
            table.error(Code::BAD_VALUE, table.span(), message.to_owned());
            return None;
        };
        let values = table.table(angle.text())?;
        let (angle, names) = (self.name(angle), values.names());
        let [x, y] = names.as_slice() else {
            let message = format!("two distances are needed, along x and y, not {}", names.len());
            values.error(Code::BAD_VALUE, values.span(), message);
            return None;
        };
        let distances = [self.name(x)?, self.name(y)?];
        // The formulas are of these alone.
        let others = (std::mem::take(&mut self.symbols), std::mem::take(&mut self.meanings));
        let angle = angle.map(|name| self.declare(name, None, "rad", &Dimension::ANGLE));
        let distances = distances.map(|name| self.declare(name, None, "m", &Dimension::LENGTH));
        let formulas = [x, y].map(|key| {
            let text = values.string(key.text())?;
            let (_, value, dimension) = self.formula(&text)?;
            if dimension.is_some_and(|own| !own.fits(&Dimension::LENGTH)) {
                let message = "a displacement is a length".to_owned();
                self.document.push(text.error_here(Code::DIMENSION, message));
            }
            Some(value)
        });
        (self.symbols, self.meanings) = others;
        values.finish();
        table.finish();
        let [x, y] = formulas;
        Some(Apart { angle: angle?, distances, values: [x?, y?] })
    }

    /// Parses, checks and lowers a formula of scalars.
    pub(super) fn formula(&mut self, text: &Located) -> Option<(Formula, Id, Option<Dimension>)> {
        let document = self.document;
        let refuse = |errors: Diagnostics| document.append(errors);
        let formula = formula::parse(text).map_err(refuse).ok()?;
        let graph = &self.graph;
        let scope: Scope =
            self.symbols.iter().map(|(name, id)| (name.clone(), graph.shape(*id))).collect();
        formula::check(&formula, &scope).map_err(refuse).ok()?;
        let dimension = formula::dimension(&formula, &self.meanings).map_err(refuse).ok()?;
        let id = formula::lower(&formula, &mut self.graph, &self.symbols).map_err(refuse).ok()?;
        if self.graph.shape(id) != crate::expression::Shape::Scalar {
            let message = "a number is expected here, not a condition";
            document.push(text.error_here(Code::SHAPE, message));
            return None;
        }
        Some((formula, id, dimension))
    }
}
