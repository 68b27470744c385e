//! Measures of the motion beside the clearance, and the kinds of laws that work on them.

use super::reader::Reader;
use super::spec::NORMAL;
use super::{
    BORE, BoreMotion, ClearanceSpec, Contact, ContactForce, ContactInput, Coordinate, GEAR, Place,
    SECTION, SENSOR, Taken,
};
use crate::diagnostic::{Code, Located, suggest};
use crate::document::{Document, Table, Value};
use crate::expression::Id;
use crate::kinds::read;
use crate::units::Dimension;

/// A length or an angle that follows from the coordinates.
pub(super) struct Measure {
    name: String,
    value: Id,
    dimension: Dimension,
    /// What laws call its rate.
    rate: String,
    /// What laws call the force that works on it.
    force: Option<String>,
}

impl Measure {
    /// The clearance, with its normal force.
    pub(super) fn clearance(spec: &ClearanceSpec) -> Self {
        Measure {
            name: spec.clearance.clone(),
            value: spec.value,
            dimension: Dimension::LENGTH,
            rate: format!("{}_dot", spec.clearance),
            force: Some("Q".to_owned()),
        }
    }

    pub(super) fn named(self) -> (String, Id) {
        (self.name, self.value)
    }

    fn is_angle(&self) -> bool {
        self.dimension.without_angle() == Dimension::NUMBER
    }
}

/// A kind of law as the file says it.
pub(super) struct LawKind {
    name: Located,
    inputs: Vec<Located>,
    forces: Vec<Located>,
}

impl<'d> Reader<'d> {
    /// The table `measures`.
    pub(super) fn measures(&mut self, root: &Table<'d>) -> Vec<Measure> {
        let Some(table) = root.optional_table("measures") else { return Vec::new() };
        let mut list = Vec::new();
        for key in table.names() {
            let Some(entry) = table.table(key.text()) else { continue };
            let name = self.name(&key);
            let text = entry.string("value");
            let formula = text.as_ref().and_then(|text| self.formula(text));
            let (rate, force) = (entry.optional_string("rate"), entry.optional_string("force"));
            entry.optional_string("title");
            entry.finish();
            rate.iter().for_each(|text| self.must_be_name(text));
            // A force becomes a symbol of the kernels.
            let force = force.map(|text| self.name(&text));
            let (Some(name), Some(text), Some((_, value, dimension))) = (name, text, formula)
            else {
                continue;
            };
            let force = force.flatten();
            let dimension = dimension.unwrap_or(Dimension::NUMBER);
            // Formulas see angles as pure numbers.
            let measures = [Dimension::LENGTH, Dimension::NUMBER];
            if !measures.contains(&dimension.without_angle()) {
                let message = format!("a measure is a length or an angle, `{name}` is {dimension}");
                self.document.push(text.error_here(Code::DIMENSION, message));
            }
            list.push(Measure {
                rate: rate.map_or_else(|| format!("{name}_dot"), |text| text.text().to_owned()),
                force,
                name,
                value,
                dimension,
            });
        }
        table.finish();
        list
    }

    /// The table `laws`.
    pub(super) fn kinds(&mut self, root: &Table<'d>) -> Vec<LawKind> {
        let Some(table) = root.optional_table("laws") else { return Vec::new() };
        let mut list = Vec::new();
        for name in table.names() {
            let Some(entry) = table.table(name.text()) else { continue };
            self.must_be_name(&name);
            if name.text() == NORMAL {
                let message = format!("`{NORMAL}` is the kind of laws of the clearance alone");
                let error = name.error_here(Code::BAD_NAME, message);
                self.document.push(error.help("choose another name"));
            }
            let (inputs, forces) = (self.words(&entry, "inputs"), self.words(&entry, "forces"));
            entry.finish();
            list.push(LawKind { name, inputs, forces });
        }
        table.finish();
        list
    }

    fn words(&self, table: &Table<'d>, key: &str) -> Vec<Located> {
        let items = table.items(key).unwrap_or_default();
        let word = |value: Value| match value {
            Value::String(text) => Some(text),
            other => {
                let message = format!("`{key}` lists names");
                table.error(Code::BAD_VALUE, other.span(), message);
                None
            }
        };
        let words: Vec<Located> = items.iter().filter_map(|item| word(item.value())).collect();
        for (place, text) in words.iter().enumerate() {
            if words[..place].iter().any(|before| before.text() == text.text()) {
                let message = format!("`{}` is listed twice", text.text());
                let error = text.error_here(Code::BAD_VALUE, message);
                self.document.push(error.help("leave one of them out"));
            }
        }
        words
    }

    fn must_be_name(&self, text: &Located) {
        read::name(self.document, text, Ok);
    }
}

/// The kinds of laws with what they take and give; names that mean nothing are noted.
pub(super) fn bind(
    document: &Document,
    spec: &ClearanceSpec,
    measures: &[Measure],
    kinds: &[LawKind],
) -> Vec<Contact> {
    let named = kinds.iter().map(|kind| Binding { document, spec, measures }.contact(kind));
    std::iter::once(normal(spec, &measures[0])).chain(named).collect()
}

/// The kind of laws Q(h, ḣ).
fn normal(spec: &ClearanceSpec, clearance: &Measure) -> Contact {
    let value = clearance.value;
    let input = |name: &str, unit: &str, taken| ContactInput {
        name: name.to_owned(),
        unit: unit.to_owned(),
        taken,
    };
    Contact {
        name: NORMAL.to_owned(),
        place: Place::Spring,
        bore: vec![(BoreMotion::Radial, spec.radial.clone())],
        inputs: vec![
            input(&clearance.name, "m", Taken::Value(value)),
            input(&clearance.rate, "m/s", Taken::Rate(value)),
        ],
        forces: vec![ContactForce { name: "Q".to_owned(), unit: "N".to_owned(), measure: value }],
    }
}

struct Binding<'a> {
    document: &'a Document<'a>,
    spec: &'a ClearanceSpec,
    measures: &'a [Measure],
}

impl Binding<'_> {
    fn contact(&self, kind: &LawKind) -> Contact {
        let inputs: Vec<ContactInput> =
            kind.inputs.iter().filter_map(|name| self.input(name)).collect();
        let forces: Vec<ContactForce> =
            kind.forces.iter().filter_map(|name| self.force(name)).collect();
        let expressions: Vec<Id> = inputs
            .iter()
            .map(|input| input.taken.expression())
            .chain(forces.iter().map(|force| force.measure))
            .collect();
        let spec = self.spec;
        let uses = |symbol: Id| expressions.iter().any(|id| spec.graph.depends(*id, symbol));
        let of_spring = [Some(&spec.spring), Some(&spec.radial), spec.tangential.as_ref()];
        let each_spring = of_spring.into_iter().flatten().any(|own| uses(own.symbol));
        let bore = motions(spec).filter(|(_, coordinate)| uses(coordinate.symbol));
        let bore: Vec<(BoreMotion, Coordinate)> =
            bore.map(|(motion, coordinate)| (motion, coordinate.clone())).collect();
        let each_joint = bore.iter().any(|(motion, _)| motion.is_of_whole_section());
        if each_spring && each_joint {
            let name = kind.name.text();
            let message = format!("`{name}` has measures of springs and of whole sections");
            let error = kind.name.error_here(Code::BAD_VALUE, message);
            self.document.push(error.help("write a kind of law for each"));
        }
        let place = match (each_spring, each_joint) {
            (true, _) => Place::Spring,
            (false, true) => Place::Joint,
            (false, false) => Place::Ring,
        };
        Contact { name: kind.name.text().to_owned(), place, bore, inputs, forces }
    }

    /// A measure, a rate, a coordinate that all springs share, or the angle of a spring.
    fn input(&self, name: &Located) -> Option<ContactInput> {
        let mut known = Vec::new();
        for measure in self.measures {
            let unit = if measure.is_angle() { "rad" } else { "m" };
            known.push((measure.name.as_str(), unit.to_owned(), Taken::Value(measure.value)));
            let rate = Taken::Rate(measure.value);
            known.push((measure.rate.as_str(), format!("{unit}/s"), rate));
        }
        for own in self.spec.ring.iter().chain([&self.spec.spring]) {
            known.push((own.name.as_str(), own.unit.clone(), Taken::Value(own.symbol)));
        }
        let found = known.iter().find(|(own, ..)| *own == name.text());
        if found.is_none() {
            let names: Vec<&str> = known.iter().map(|(own, ..)| *own).collect();
            self.unknown(name, "no measure, rate or coordinate", &names);
        }
        let (name, unit, taken) = found?.clone();
        Some(ContactInput { name: name.to_owned(), unit, taken })
    }

    fn force(&self, name: &Located) -> Option<ContactForce> {
        let forces = || self.measures.iter().filter_map(|m| Some((m.force.as_deref()?, m)));
        let found = forces().find(|(own, _)| *own == name.text());
        if found.is_none() {
            let names: Vec<&str> = forces().map(|(own, _)| own).collect();
            self.unknown(name, "no force of a measure", &names);
        }
        let (name, measure) = found?;
        let unit = if measure.is_angle() { "N*m" } else { "N" };
        Some(ContactForce { name: name.to_owned(), unit: unit.to_owned(), measure: measure.value })
    }

    fn unknown(&self, name: &Located, what: &str, known: &[&str]) {
        let message = format!("`{}` is {what}", name.text());
        let error = name.error_here(Code::UNKNOWN_NAME, message);
        let help = suggest(name.text(), known);
        let help = help.unwrap_or_else(|| format!("there are {}", known.join(", ")));
        self.document.push(error.help(help));
    }
}

/// The motions of the bore that the spec has, each with its coordinate: those of rings before those of sections.
fn motions(spec: &ClearanceSpec) -> impl Iterator<Item = (BoreMotion, &Coordinate)> {
    let tangential = spec.tangential.iter().map(|own| (BoreMotion::Tangential, own));
    let means = BORE.into_iter().zip(&spec.bore).chain(SECTION.into_iter().zip(&spec.section));
    let means = means.chain(SENSOR.into_iter().zip(&spec.sensor));
    let means = means.chain(GEAR.into_iter().zip(&spec.gear));
    let of_rings = means.clone().filter(|(motion, _)| !motion.is_of_whole_section());
    let of_sections = means.filter(|(motion, _)| motion.is_of_whole_section());
    let radial = std::iter::once((BoreMotion::Radial, &spec.radial));
    radial.chain(tangential).chain(of_rings).chain(of_sections)
}
