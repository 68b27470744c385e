//! Quadrature rules of an element: named ones, or points of the file.

use std::collections::BTreeMap;
use std::ops::Range;

use num_traits::ToPrimitive;

use super::super::schema::HIGHEST_DEGREE;
use super::reader::Reader;
use crate::diagnostic::{Code, Diagnostic, Located, suggest};
use crate::document::{Item, Table};
use crate::element::algebraic::{Algebraic, Field, ReadError};
use crate::element::quadrature::Factor;
use crate::element::{Cell, Quadrature, rules};

impl Reader<'_> {
    pub(super) fn rule(&mut self, table: &Table<'_>, cell: Cell) -> Option<Quadrature> {
        let degree = table.count("degree");
        if let Some(degree) = degree.filter(|degree| *degree > HIGHEST_DEGREE) {
            let message = format!("a degree is at most {HIGHEST_DEGREE}, not {degree}");
            self.error(Code::BAD_VALUE, table.place("degree"), message);
            return None;
        }
        let degree = degree.and_then(|degree| degree.to_u32());
        let reduced = table.optional_boolean("reduced").unwrap_or(false);
        let affine = table.optional_word("patch_test") == Some("affine");
        let mut field = Field::default();
        let (title, factors, place) = if table.has("points") {
            let items = self.bounded(table, "points", table.items("points")?)?;
            let place = table.place("points");
            let points = self.points(&items, &mut field)?;
            (format!("{} points", items.len()), vec![Factor { axes: 0..3, points }], place)
        } else {
            let place = table.place("rule");
            let names = self.texts(&table.items("rule")?, "a rule such as \"gauss(2)\"")?;
            let factors = self.product(&names, cell, place.clone(), &mut field)?;
            let names: Vec<&str> = names.iter().map(Located::text).collect();
            (names.join(" × "), factors, place)
        };
        let mut rule = Quadrature::new(title, field, factors, degree?, place)?;
        (rule.reduced, rule.affine) = (reduced, affine);
        Some(rule)
    }

    fn points(
        &mut self,
        items: &[Item<'_>],
        field: &mut Field,
    ) -> Option<Vec<(Vec<Algebraic>, Algebraic)>> {
        let mut points = Vec::with_capacity(items.len());
        for item in items {
            let values = self.array(item, 4, "three coordinates and a weight")?;
            let mut numbers = Vec::with_capacity(4);
            for value in &values {
                let id = self.constant(value)?;
                let number = field.read(&self.graph, id).map_err(|error| {
                    let (code, message, help) = match error {
                        ReadError::Roots => (
                            Code::QUADRATURE,
                            "expected a number made of rational numbers and a few square roots",
                            "such as '1/sqrt(3)' or '(5 + 3*sqrt(5))/20'",
                        ),
                        ReadError::Size => (
                            Code::LIMIT,
                            "multiplied out, this number has too many digits or square roots",
                            "write it as a fraction or a decimal, or with few roots, such as '1/sqrt(3)'",
                        ),
                    };
                    let source = self.document.source;
                    let error = Diagnostic::new(source, code, value.span(), message.to_owned());
                    self.document.push(error.help(help));
                });
                numbers.push(number.ok()?);
            }
            let weight = numbers.pop()?;
            points.push((numbers, weight));
        }
        Some(points)
    }

    fn product(
        &mut self,
        names: &[Located],
        cell: Cell,
        place: Range<usize>,
        field: &mut Field,
    ) -> Option<Vec<Factor>> {
        let known = rules::names();
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let mut families = Vec::new();
        for name in names {
            match rules::family(name.text()) {
                Some(family) => families.push(family),
                None => {
                    let message = format!("there is no rule `{}`", name.text());
                    let error = name.error_here(Code::QUADRATURE, message);
                    self.document.push(error.maybe_help(suggest(name.text(), &known)));
                }
            }
        }
        if families.len() < names.len() {
            return None;
        }
        if families != cell.families() {
            let wanted: Vec<String> =
                cell.families().iter().map(|f| format!("\"{f}(…)\"")).collect();
            let message = format!("this is no rule of a {}", cell.name());
            let error = Diagnostic::new(self.document.source, Code::QUADRATURE, place, message);
            let wanted = wanted.join(", ");
            let help =
                format!("write `rule = [{wanted}]`, with numbers of points between the brackets");
            self.document.push(error.help(help));
            return None;
        }
        let names: Vec<&str> = names.iter().map(Located::text).collect();
        rules::factors(field, &names)
    }

    pub(super) fn rules(&mut self, table: &Table<'_>, cell: Cell) -> BTreeMap<String, Quadrature> {
        let mut rules = BTreeMap::new();
        let Some(forms) = table.optional_table("forms") else { return rules };
        for form in forms.names() {
            let Some(entry) = forms.table(form.text()) else { continue };
            if let Some(rule) = self.rule(&entry, cell) {
                rules.insert(form.text().to_owned(), rule);
            }
            entry.finish();
        }
        forms.finish();
        rules
    }
}
