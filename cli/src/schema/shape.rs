//! What a file may say: keys, and what each takes; written out as JSON schema.

use serde_json::{Map, Value, json};

/// A key of a table.
#[derive(Debug, Clone)]
pub(super) struct Key {
    name: &'static str,
    about: &'static str,
    needed: bool,
    shape: Shape,
}

/// What a key takes.
#[derive(Debug, Clone)]
pub(super) enum Shape {
    /// Text: a name, a title, a path, a unit.
    Text,
    /// A quantity with its unit, such as this one.
    Quantity(&'static str),
    /// A formula, as text.
    Formula,
    /// A number.
    Number,
    /// A whole number from this one up.
    Count(u64),
    /// True or false.
    Flag,
    /// One of these words.
    Words(Vec<&'static str>),
    /// A list, perhaps of a fixed length.
    List(Box<Shape>, Option<usize>),
    /// Any of these.
    Either(Vec<Shape>),
    /// A table with these keys and no others.
    Table(Vec<Key>),
    /// A table whose keys are names that the user chooses.
    Named(Box<Shape>),
    /// A table whose keys are these names, each with what it is, in ASCII or other spelling (`ḣ`).
    Known(Vec<(&'static str, &'static str)>, Box<Shape>),
}

/// A key that may be left out.
pub(super) fn key(name: &'static str, shape: Shape, about: &'static str) -> Key {
    Key { name, about, needed: false, shape }
}

/// A key that must be there.
pub(super) fn needed(name: &'static str, shape: Shape, about: &'static str) -> Key {
    Key { needed: true, ..key(name, shape, about) }
}

/// A list of any length.
pub(super) fn list(shape: Shape) -> Shape {
    Shape::List(Box::new(shape), None)
}

/// A list of this length.
pub(super) fn tuple(shape: Shape, length: usize) -> Shape {
    Shape::List(Box::new(shape), Some(length))
}

/// A table by names of the user.
pub(super) fn named(shape: Shape) -> Shape {
    Shape::Named(Box::new(shape))
}

impl Shape {
    /// The schema of a whole file.
    pub(super) fn document(&self, title: &str) -> Value {
        let mut schema = self.json();
        let head = json!({ "$schema": "http://json-schema.org/draft-07/schema#", "title": title });
        if let (Value::Object(schema), Value::Object(head)) = (&mut schema, head) {
            schema.extend(head);
        }
        schema
    }

    fn json(&self) -> Value {
        match self {
            Shape::Text | Shape::Formula => json!({ "type": "string" }),
            Shape::Quantity(example) => json!({ "type": "string", "examples": [example] }),
            Shape::Number => json!({ "type": "number" }),
            Shape::Count(least) => json!({ "type": "integer", "minimum": least }),
            Shape::Flag => json!({ "type": "boolean" }),
            Shape::Words(words) => json!({ "enum": words }),
            Shape::List(item, None) => json!({ "type": "array", "items": item.json() }),
            Shape::List(item, Some(length)) => json!({
                "type": "array", "items": item.json(), "minItems": length, "maxItems": length,
            }),
            Shape::Either(shapes) => {
                let shapes: Vec<Value> = shapes.iter().map(Shape::json).collect();
                json!({ "anyOf": shapes })
            }
            Shape::Table(keys) => table(keys),
            Shape::Named(shape) => {
                json!({ "type": "object", "additionalProperties": shape.json() })
            }
            Shape::Known(names, shape) => {
                let entry = |(name, about): &(&str, &str)| {
                    ((*name).to_string(), described(shape.json(), about))
                };
                json!({
                    "type": "object",
                    "properties": names.iter().map(entry).collect::<Map<_, _>>(),
                    "patternProperties": { "[^ -~]": shape.json() },
                    "additionalProperties": false,
                })
            }
        }
    }
}

fn table(keys: &[Key]) -> Value {
    let entry = |key: &Key| (key.name.to_string(), described(key.shape.json(), key.about));
    let needed: Vec<&str> = keys.iter().filter(|key| key.needed).map(|key| key.name).collect();
    let mut table = json!({
        "type": "object",
        "properties": keys.iter().map(entry).collect::<Map<_, _>>(),
        "additionalProperties": false,
    });
    if !needed.is_empty() {
        table["required"] = json!(needed);
    }
    table
}

fn described(mut schema: Value, about: &str) -> Value {
    schema["description"] = json!(about);
    schema
}
