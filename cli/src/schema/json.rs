//! Declarations of what a file may say, as JSON schema.

use serde_json::{Map, Value, json};
use whirl_codegen::document::schema::{Key, Need, Range, Shape};

/// The schema of a kind of file.
pub(super) fn document(title: &str, declared: &Shape) -> Value {
    let mut schema = shape(declared);
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!(format!("whirl: {title}"));
    schema
}

fn shape(declared: &Shape) -> Value {
    match declared {
        Shape::Text | Shape::Formula => json!({ "type": "string" }),
        Shape::Quantity(measure) => json!({ "type": "string", "examples": [measure.example] }),
        Shape::Number => json!({ "type": "number" }),
        Shape::Between(low, high) => json!({
            "type": "number", "exclusiveMinimum": low, "exclusiveMaximum": high,
        }),
        Shape::Count(least, most) => {
            json!({ "type": "integer", "minimum": least, "maximum": most })
        }
        Shape::Flag => json!({ "type": "boolean" }),
        Shape::Words(_) | Shape::Registered(_) => json!({ "enum": declared.words() }),
        Shape::List(item) => json!({ "type": "array", "items": shape(item) }),
        Shape::Tuple(item, length) => json!({
            "type": "array", "items": shape(item), "minItems": length, "maxItems": length,
        }),
        Shape::Either(shapes) => {
            let shapes: Vec<Value> = shapes.iter().map(shape).collect();
            json!({ "anyOf": shapes })
        }
        Shape::Table(_) => table(declared),
        Shape::Named(inner) => json!({ "type": "object", "additionalProperties": shape(inner) }),
        Shape::Known(names, inner) => {
            let entry = |(name, about): (&str, &str)| {
                (name.to_string(), described(shape(inner), about.to_string()))
            };
            json!({
                "type": "object",
                "properties": names().into_iter().map(entry).collect::<Map<_, _>>(),
                "patternProperties": { "[^ -~]": shape(inner) },
                "additionalProperties": false,
            })
        }
    }
}

fn table(declared: &Shape) -> Value {
    let entry = |key: &Key| {
        let mut value = described(shape(&key.shape), about(key));
        // An example is written as in the file; lists are left to the schema of their items.
        if let Some(text) = key.example.strip_prefix('"').and_then(|text| text.strip_suffix('"')) {
            value["examples"] = json!([text]);
        }
        (key.name.to_string(), value)
    };
    let needed = declared.keys().filter(|key| key.need == Need::Always);
    let needed: Vec<&str> = needed.map(|key| key.name).collect();
    let mut table = json!({
        "type": "object",
        "properties": declared.keys().map(entry).collect::<Map<_, _>>(),
        "additionalProperties": false,
    });
    if !needed.is_empty() {
        table["required"] = json!(needed);
    }
    table
}

/// What a key says; of a quantity with what it measures, which text alone does not show.
fn about(key: &Key) -> String {
    let measure = match &key.shape {
        Shape::Quantity(measure) => measure,
        Shape::List(Shape::Quantity(measure)) => measure,
        _ => return key.about.to_string(),
    };
    let range = match measure.range {
        Range::Any => "",
        Range::Positive => " above zero",
        Range::NotNegative => ", zero or above",
    };
    format!("{} ({}{range})", key.about, measure.dimension)
}

fn described(mut schema: Value, about: String) -> Value {
    schema["description"] = json!(about);
    schema
}
