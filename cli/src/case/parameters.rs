//! Parameters of laws: what the bearing says of them, and what the case sets by name.

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, suggest};
use whirl_codegen::document::Table;
use whirl_codegen::formula;
use whirl_codegen::kinds::law::{BearingValue, Given, Parameter};
use whirl_codegen::rational::{Rational, nearest};
use whirl_codegen::units::{Exponent, Quantity, Unit};

use super::law::{LawSource, NamedLaw};
use super::values::written;

/// A parameter that a case sets by name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SetParameter {
    /// As the law calls it.
    name: String,
    /// Where the case names it.
    key: Located,
    /// Where its value stands.
    place: Located,
    value: Quantity,
}

impl SetParameter {
    /// One that another key of the case sets, at its place.
    pub(super) fn new(name: &str, place: &Located, value: Quantity) -> SetParameter {
        SetParameter { name: name.to_owned(), key: place.clone(), place: place.clone(), value }
    }

    /// Its name in the law.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// SI.
    pub(crate) fn value(&self) -> f64 {
        self.value.si()
    }

    /// Whether this coefficient of a bushing, such as `k_xy`, gives a force along an axis.
    pub(super) fn acts_along(&self, axis: &str) -> bool {
        let direction = self.name.split_once('_').map_or("", |(_, direction)| direction);
        direction.starts_with(axis) && self.value.si() != 0.0
    }
}

/// What is known of a bearing or a stop that laws can take from it: exactly, SI.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct BearingFacts {
    /// c in m.
    pub(crate) radial_clearance: Option<Rational>,
    /// R in m.
    pub(crate) journal_radius: Option<Rational>,
    /// R + c in m, where it is not to be had from the two.
    pub(crate) bore_radius: Option<Rational>,
    /// L in m.
    pub(crate) length: Option<Rational>,
    /// Springs in all rings.
    pub(crate) springs: Option<usize>,
}

impl NamedLaw {
    /// The law as a bearing uses it: with what the case sets, and with what is known of the bearing.
    ///
    /// # Errors
    /// Whatever is wrong with the law once it has these values.
    pub(crate) fn used(
        &self,
        set: &[SetParameter],
        facts: &BearingFacts,
    ) -> Result<LawSource, Diagnostics> {
        self.source.with(given(&self.source.parameters(), set, facts))
    }

    /// Parameters that the law takes from its bearing, of which neither the case nor a mesh gives a value; `place` is where
    /// to say it.
    pub(crate) fn lacking(
        &self,
        set: &[SetParameter],
        facts: &BearingFacts,
        place: &str,
    ) -> Vec<Diagnostic> {
        let mut errors = Vec::new();
        for parameter in self.source.parameters() {
            let Some(of) = parameter.bearing else { continue };
            if facts.value(of).is_some() || set.iter().any(|set| set.name == parameter.name) {
                continue;
            }
            let (name, key) = (&parameter.name, Keys { clearance: "radial_clearance" }.of(of));
            let message = format!(
                "the law `{}` takes `{name}` from its bearing, but nothing gives the {} of the bearing",
                self.name.text(),
                of.word().replace('_', " ")
            );
            let help = format!("add `{key} = \"…\"` to {place}");
            errors.push(self.name.error_here(Code::MISSING_KEY, message).help(help));
        }
        errors
    }
}

/// What the keys of a bearing are called of which a parameter can be one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Keys {
    /// `radial_clearance`, or `gap`.
    pub(super) clearance: &'static str,
}

/// The parameters that a table sets.
pub(super) fn read(table: &Table) -> Vec<SetParameter> {
    let mut set = Vec::new();
    for (key, place) in table.named_values("parameters") {
        let name = formula::name(key.text()).unwrap_or_else(|_| key.text().to_string());
        match Quantity::parse(place.text()) {
            Ok(value) => set.push(SetParameter { name, key, place, value }),
            Err(error) => {
                let message = format!("`{name}`: {}", error.message);
                table.push(place.error_here(error.code, message).maybe_help(error.help));
            }
        }
    }
    set
}

/// Both, of which the first hold where both say the same parameter.
pub(super) fn over(own: &[SetParameter], shared: &[SetParameter]) -> Vec<SetParameter> {
    let not_set = |other: &&SetParameter| own.iter().all(|set| set.name != other.name);
    own.iter().chain(shared.iter().filter(not_set)).cloned().collect()
}

/// Notes in `table` parameters that the law does not have, of another dimension, or that contradict the
/// bearing; what they say of the bearing holds for it from now on.
pub(super) fn check(
    table: &Table,
    law: &NamedLaw,
    set: &[SetParameter],
    keys: Keys,
    facts: &mut BearingFacts,
) {
    let known = law.source.parameters();
    for own in set {
        let Some(parameter) = known.iter().find(|parameter| parameter.name == own.name) else {
            table.push(unknown(law, own, &known));
            continue;
        };
        if own.value.expect(parameter.unit.dimension()).is_err() {
            table.push(wrong_unit(law, own, parameter));
            continue;
        }
        let (limits, unit) = (&parameter.limits, &parameter.unit);
        if let Some(words) = limits.refuse(own.value.value(), own.value.unit(), unit) {
            let name = &parameter.name;
            let message = format!(
                "`{name}` of the law `{}` has to be {words}, not {}",
                law.name.text(),
                own.place.text()
            );
            table.push(own.place.error_here(Code::BAD_VALUE, message));
            continue;
        }
        if let Some(of) = parameter.bearing {
            let value = exactly(&own.value);
            match facts.value(of) {
                Some(given) if !alike(of, &given, &value) => {
                    table.push(contradicts(own, of, &given, keys));
                }
                Some(_) => {}
                None => facts.take(of, value),
            }
        }
    }
}

fn unknown(law: &NamedLaw, own: &SetParameter, known: &[Parameter]) -> Diagnostic {
    let names: Vec<&str> = known.iter().map(|parameter| parameter.name.as_str()).collect();
    let message = format!("the law `{}` has no parameter `{}`", law.name.text(), own.key.text());
    let help = match names.as_slice() {
        [] => Some("it has none at all: leave it out".to_string()),
        names => suggest(&own.name, names),
    };
    own.key.error_here(Code::UNKNOWN_NAME, message).maybe_help(help)
}

fn wrong_unit(law: &NamedLaw, own: &SetParameter, parameter: &Parameter) -> Diagnostic {
    let (name, unit) = (&parameter.name, &parameter.unit);
    let wanted = unit.dimension();
    let found = own.value.dimension();
    let message = format!(
        "`{name}` of the law `{}` is {wanted}, but `{}` is {found}",
        law.name.text(),
        own.place.text()
    );
    let written = written(&parameter.written);
    let example = match unit.text() {
        "1" => written,
        unit => format!("\"{written} {unit}\""),
    };
    let help = format!("write for example `{name} = {example}`");
    own.place.error_here(Code::WRONG_UNIT, message).help(help)
}

fn contradicts(own: &SetParameter, of: BearingValue, given: &Rational, keys: Keys) -> Diagnostic {
    let name = &own.name;
    let key = keys.of(of);
    let unit = own.value.unit();
    let given = unit.rational().map_or_else(|| given.clone(), |factor| given / factor);
    let message = format!(
        "`{name}` is the {} of the bearing, {} {unit} by its `{key}`, not {}",
        of.word().replace('_', " "),
        written(&given),
        own.place.text()
    );
    let help = format!("leave `{name}` out: the law takes it from the bearing; or change `{key}`");
    own.place.error_here(Code::BAD_VALUE, message).help(help)
}

impl Keys {
    /// The key by which a case says a value of the bearing.
    fn of(self, value: BearingValue) -> &'static str {
        match value {
            BearingValue::RadialClearance | BearingValue::DiametralClearance => self.clearance,
            BearingValue::JournalRadius
            | BearingValue::JournalDiameter
            | BearingValue::BoreRadius
            | BearingValue::BoreDiameter => "journal_radius",
            BearingValue::Length | BearingValue::SpringArea => "length",
        }
    }
}

/// Whether two values are the same. π is in areas, so that nobody can write them exactly.
fn alike(of: BearingValue, a: &Rational, b: &Rational) -> bool {
    const NEAR: f64 = 1e-3;
    let (x, y) = (nearest(a), nearest(b));
    a == b || of == BearingValue::SpringArea && (x - y).abs() <= NEAR * x.abs()
}

impl BearingFacts {
    /// A value of the bearing in SI, if enough is known of it.
    pub(crate) fn value(&self, of: BearingValue) -> Option<Rational> {
        let two = || Rational::from(2);
        let clearance = || self.radial_clearance.clone();
        let radius = || self.journal_radius.clone();
        let bore = || match (radius(), clearance()) {
            (Some(radius), Some(clearance)) => Some(radius + clearance),
            _ => self.bore_radius.clone(),
        };
        match of {
            BearingValue::RadialClearance => clearance(),
            BearingValue::DiametralClearance => Some(clearance()? * two()),
            BearingValue::JournalRadius => radius(),
            BearingValue::JournalDiameter => Some(radius()? * two()),
            BearingValue::BoreRadius => bore(),
            BearingValue::BoreDiameter => Some(bore()? * two()),
            BearingValue::Length => self.length.clone(),
            BearingValue::SpringArea => {
                let around = std::f64::consts::TAU * nearest(&bore()?);
                rounded(around * nearest(self.length.as_ref()?) / self.springs? as f64)
            }
        }
    }

    /// Takes what a parameter says of the bearing, where the bearing itself says nothing.
    fn take(&mut self, of: BearingValue, value: Rational) {
        let half = || &value / Rational::from(2);
        match of {
            BearingValue::RadialClearance => self.radial_clearance = Some(value),
            BearingValue::DiametralClearance => self.radial_clearance = Some(half()),
            BearingValue::JournalRadius => self.journal_radius = Some(value),
            BearingValue::JournalDiameter => self.journal_radius = Some(half()),
            BearingValue::BoreRadius => self.take_bore(value),
            BearingValue::BoreDiameter => self.take_bore(half()),
            BearingValue::Length => self.length = Some(value),
            // It is no value of the bearing as a whole.
            BearingValue::SpringArea => {}
        }
    }

    fn take_bore(&mut self, radius: Rational) {
        if let (None, Some(clearance)) = (&self.journal_radius, &self.radial_clearance) {
            self.journal_radius = Some(&radius - clearance);
        }
        self.bore_radius = Some(radius);
    }
}

/// The values with which the law is used where they are not those in its file, in the units of the file: those
/// that the case sets, and those of the bearing.
fn given(parameters: &[Parameter], set: &[SetParameter], facts: &BearingFacts) -> Vec<Given> {
    let mut given = Vec::new();
    for parameter in parameters {
        let Parameter { name, unit, written, bearing, .. } = parameter;
        let own = set.iter().find(|set| set.name == *name);
        let value = match (own, bearing.and_then(|of| facts.value(of))) {
            (Some(own), _) => {
                let inverse = unit.factor().checked_power(Exponent::from_integer(-1));
                let per =
                    inverse.and_then(|inverse| own.value.unit().factor().checked_times(&inverse));
                match per.and_then(|per| per.to_rational()) {
                    Some(per) => (own.value.value() * per, unit.clone()),
                    None => (own.value.value().clone(), own.value.unit().clone()),
                }
            }
            (None, Some(value)) => match unit.rational() {
                Some(factor) => (value / factor, unit.clone()),
                // Such as mm^0.5*m^0.5.
                None => (value, si_of(unit)),
            },
            (None, None) => continue,
        };
        if value != (written.clone(), unit.clone()) {
            given.push(Given { name: name.clone(), value: value.0, unit: value.1 });
        }
    }
    given
}

/// A length or an area in SI, exactly.
fn in_si(quantity: &Quantity) -> Option<Rational> {
    Some(quantity.value() * quantity.unit().rational()?)
}

/// A length in SI, exactly unless its unit is one such as mm^0.5*m^0.5.
pub(super) fn exactly(quantity: &Quantity) -> Rational {
    let inexact = || Rational::from_float(quantity.si()).expect("a quantity is finite");
    in_si(quantity).unwrap_or_else(inexact)
}

fn si_of(unit: &Unit) -> Unit {
    Unit::parse(&unit.dimension().si_unit()).expect("the unit of a dimension is one")
}

/// What is measured or computed, to twelve digits: without those that rounding adds.
pub(crate) fn rounded(value: f64) -> Option<Rational> {
    Quantity::parse(&format!("{value:.11e}")).ok().map(|quantity| quantity.value().clone())
}
