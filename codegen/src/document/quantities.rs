//! Quantities: text with a unit, read to SI.

use super::Table;
use super::schema::{Measure, Range, Shape};
use super::tree::{Content, Node};
use crate::diagnostic::Code;
use crate::units::{Dimension, Quantity};

/// Bytes before the text of a string.
const OPENING_QUOTE: usize = 1;

impl Table<'_> {
    /// A quantity, if given; SI.
    pub fn quantity(&self, key: &str) -> Option<f64> {
        self.exact_quantity(key).map(|quantity| quantity.si())
    }

    /// A quantity as it is written, if given.
    pub fn exact_quantity(&self, key: &str) -> Option<Quantity> {
        let (node, shape) = self.entry(key, |shape| matches!(shape, Shape::Quantity(_)))?;
        let measure = shape.alternatives().iter().find_map(|shape| match shape {
            Shape::Quantity(measure) => Some(measure),
            _ => None,
        })?;
        self.quantity_of(key, node, measure)
    }

    /// A quantity in SI, or one.
    pub fn quantity_or_one(&self, key: &str) -> f64 {
        self.quantity(key).unwrap_or(1.0)
    }

    /// A list of quantities; SI.
    pub fn quantities(&self, key: &str) -> Vec<f64> {
        let is_list = |shape: &Shape| matches!(shape, Shape::List(Shape::Quantity(_)));
        let Some((node, Shape::List(Shape::Quantity(measure)))) = self.entry(key, is_list) else {
            return Vec::new();
        };
        let Content::List(list) = &node.content else {
            self.wrong(key, node, "a list of quantities", &self.example(key));
            return Vec::new();
        };
        let quantity = |item| self.quantity_of(key, item, measure).map(|quantity| quantity.si());
        list.iter().filter_map(quantity).collect()
    }

    /// Whether a key is given as a list.
    pub fn gives_list(&self, key: &str) -> bool {
        self.tree.entries.get(key).is_some_and(|(_, node)| node.is_list())
    }

    /// Whether a key is given as text.
    pub fn gives_text(&self, key: &str) -> bool {
        self.tree.entries.get(key).is_some_and(|(_, node)| node.is_text())
    }

    /// Three quantities along x, y and z, if given; SI.
    pub fn quantity_triple(&self, key: &str) -> Option<[f64; 3]> {
        fn of_three(shape: &Shape) -> Option<&'static Measure> {
            match shape {
                Shape::Tuple(Shape::Quantity(measure), 3) => Some(measure),
                _ => None,
            }
        }
        let (node, shape) = self.entry(key, |shape| of_three(shape).is_some())?;
        let measure = shape.alternatives().iter().find_map(of_three)?;
        match &node.content {
            Content::List(list) if list.len() == 3 => {
                let parts = [0, 1, 2].map(|place| self.quantity_of(key, &list[place], measure));
                let [x, y, z] = parts;
                Some([x?.si(), y?.si(), z?.si()])
            }
            _ => {
                let example = format!("[\"{0}\", \"{0}\", \"{0}\"]", measure.example);
                self.wrong(key, node, "three quantities, along x, y and z", &example);
                None
            }
        }
    }

    /// Two quantities, such as x and y, if given; SI.
    pub fn quantity_pair(&self, key: &str) -> Option<[f64; 2]> {
        let is_pair = |shape: &Shape| matches!(shape, Shape::Tuple(Shape::Quantity(_), 2));
        match self.entry(key, is_pair)? {
            (node, Shape::Tuple(Shape::Quantity(measure), 2)) => self.pair_of(key, node, measure),
            _ => None,
        }
    }

    /// Pairs of quantities in a list, or one alone; SI. None if the key is not given or a value is wrong.
    pub fn quantity_pairs(&self, key: &str) -> Option<Vec<[f64; 2]>> {
        let is_list = |shape: &Shape| matches!(shape, Shape::List(Shape::Either(_)));
        let (node, shape) = self.entry(key, is_list)?;
        let measure = shape.of_items()?.alternatives().iter().find_map(|shape| match shape {
            Shape::Quantity(measure) => Some(measure),
            _ => None,
        })?;
        match &node.content {
            Content::List(list) if list.iter().all(|item| item.is_list()) && !list.is_empty() => {
                list.iter().map(|item| self.pair_of(key, item, measure)).collect()
            }
            _ => Some(vec![self.pair_of(key, node, measure)?]),
        }
    }

    fn pair_of(&self, key: &str, node: &Node, measure: &Measure) -> Option<[f64; 2]> {
        match &node.content {
            Content::List(list) if list.len() == 2 => {
                let [first, second] =
                    [0, 1].map(|place| self.quantity_of(key, &list[place], measure));
                Some([first?.si(), second?.si()])
            }
            _ => {
                let twice = format!("[\"{0}\", \"{0}\"]", measure.example);
                let (what, example) = match measure.dimension {
                    own if own == Dimension::ANGLE => ("two angles, from and to", twice),
                    own if own == Dimension::TEMPERATURE => {
                        ("two temperatures", "[\"178.15 K\", \"797.7 K\"]".to_owned())
                    }
                    _ => ("two quantities, along x and y", twice),
                };
                self.wrong(key, node, what, &example);
                None
            }
        }
    }

    fn quantity_of(&self, key: &str, node: &Node, measure: &Measure) -> Option<Quantity> {
        let Measure { dimension, example, .. } = measure;
        let text = match &node.content {
            Content::Text(text) => text,
            Content::Number(_) => {
                let message = format!("`{key}` is {dimension} and needs its unit");
                let help = format!("write it as text with a unit, such as `{key} = \"{example}\"`");
                self.push(node.place.error(Code::WRONG_UNIT, message).help(help));
                return None;
            }
            _ => {
                self.wrong(key, node, &dimension.to_string(), &format!("\"{example}\""));
                return None;
            }
        };
        let such_as = format!("such as `{key} = \"{example}\"`");
        let quantity =
            Quantity::parse(text).and_then(|quantity| quantity.expect(dimension).and(Ok(quantity)));
        let quantity = quantity.map_err(|error| {
            let start = node.place.span.start + OPENING_QUOTE;
            let mut found = error.at(&node.place.source, start);
            found.message = format!("`{key}`: {}", found.message);
            self.push(found.help(&such_as));
        });
        let quantity = quantity.ok()?;
        let wanted = match measure.range {
            Range::Positive if quantity.si() <= 0.0 => "greater than zero",
            Range::NotNegative if quantity.si() < 0.0 => "zero or greater",
            _ => return Some(quantity),
        };
        let message = format!("`{key}` must be {wanted}");
        self.push(node.place.error(Code::BAD_VALUE, message).help(such_as));
        None
    }
}
