//! Quantities: text with a unit, read to SI.

use whirl_codegen::diagnostic::Code;
use whirl_codegen::spec::schema::{Measure, Range, Shape};
use whirl_codegen::units::Quantity;

use super::{Node, Reader, Value};

impl Reader<'_> {
    fn quantity_of(&self, key: &str, node: &Node, kind: &Measure) -> Option<Quantity> {
        let text = match &node.value {
            Value::Text(text) => text,
            Value::Integer(_) | Value::Number(_) => {
                self.note(
                    &node.place,
                    Code::WRONG_UNIT,
                    format!("`{key}` is {} and needs its unit", kind.dimension),
                    Some(format!(
                        "write it as text with a unit, such as `{key} = \"{}\"`",
                        kind.example
                    )),
                );
                return None;
            }
            _ => {
                let wanted = kind.dimension.to_string();
                self.wrong(key, node, &wanted, &format!("\"{}\"", kind.example));
                return None;
            }
        };
        let quantity = Quantity::parse(text)
            .and_then(|quantity| quantity.expect(&kind.dimension).and(Ok(quantity)));
        match quantity {
            Ok(quantity) => self.in_range(key, node, kind, quantity.si()).map(|_| quantity),
            Err(error) => {
                let start = node.place.span.start + OPENING_QUOTE;
                let mut diagnostic = error.at(&node.place.source, start);
                diagnostic.message = format!("`{key}`: {}", diagnostic.message);
                diagnostic.help = Some(format!("such as `{key} = \"{}\"`", kind.example));
                self.push(diagnostic);
                None
            }
        }
    }

    fn in_range(&self, key: &str, node: &Node, kind: &Measure, value: f64) -> Option<f64> {
        let fault = match kind.range {
            Range::Any => None,
            Range::Positive if value > 0.0 => None,
            Range::Positive => Some("greater than zero"),
            Range::NotNegative if value >= 0.0 => None,
            Range::NotNegative => Some("zero or greater"),
        };
        let Some(wanted) = fault else {
            return Some(value);
        };
        self.note(
            &node.place,
            Code::BAD_VALUE,
            format!("`{key}` must be {wanted}"),
            Some(format!("such as `{key} = \"{}\"`", kind.example)),
        );
        None
    }

    /// A quantity, if given; SI.
    pub(crate) fn quantity(&self, key: &'static str) -> Option<f64> {
        self.exact(key).map(|quantity| quantity.si())
    }

    /// A quantity as it is written, if given.
    pub(crate) fn exact(&self, key: &'static str) -> Option<Quantity> {
        match self.get(key, |shape| matches!(shape, Shape::Quantity(_)))? {
            (node, Shape::Quantity(measure)) => self.quantity_of(key, node, measure),
            _ => None,
        }
    }

    /// A quantity in SI, or one.
    pub(crate) fn quantity_or_one(&self, key: &'static str) -> f64 {
        self.quantity(key).unwrap_or(1.0)
    }

    /// A list of quantities; SI.
    pub(crate) fn quantities(&self, key: &'static str) -> Vec<f64> {
        let is_list = |shape: &Shape| matches!(shape, Shape::List(Shape::Quantity(_)));
        let Some((node, Shape::List(Shape::Quantity(measure)))) = self.get(key, is_list) else {
            return Vec::new();
        };
        let Value::List(list) = &node.value else {
            self.wrong(key, node, "a list of quantities", &self.example(key));
            return Vec::new();
        };
        let quantity = |item| self.quantity_of(key, item, measure).map(|quantity| quantity.si());
        list.iter().filter_map(quantity).collect()
    }
}

/// Bytes before the text of a string.
const OPENING_QUOTE: usize = 1;
