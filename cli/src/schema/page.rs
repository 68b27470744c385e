//! Declarations of what a file may say, as a page for people: a table of keys for each table of the file.

use std::fmt::Write;

use whirl_codegen::document::schema::{Key, Need, Range, Shape};

/// Words that are listed at most; longer lists are named by their first ones.
const MOST_WORDS: usize = 12;

/// The page of a kind of file, in Markdown.
pub(super) fn page(name: &str, title: &str, declared: &'static Shape) -> String {
    let mut text = format!(
        "# Keys of a {name}\n\n{}{}. This page is printed by `whirl schema {name} --page`, from the declarations through which \
         files are read: what is not here is refused. Keys marked with * must be there.\n",
        title[..1].to_uppercase(),
        &title[1..]
    );
    let mut sections = Vec::new();
    collect("", declared, &mut sections);
    for (place, shape) in sections {
        let heading = match place.as_str() {
            "" => "Top level".to_owned(),
            own => format!("`{own}`"),
        };
        let _ = write!(text, "\n## {heading}\n\n| Key | Takes | What it says |\n|---|---|---|\n");
        shape.keys().for_each(|key| text.push_str(&row(key)));
    }
    text
}

/// The tables with fixed keys in a shape, with the places at which they are written.
fn collect(place: &str, shape: &'static Shape, all: &mut Vec<(String, &'static Shape)>) {
    let inside = |name: &str| {
        if place.is_empty() { name.to_owned() } else { format!("{place}.{name}") }
    };
    match shape {
        Shape::Table(_) => {
            let heading = if place.is_empty() || place.starts_with('[') {
                place.to_owned()
            } else {
                format!("[{place}]")
            };
            all.push((heading, shape));
            let bare = place.trim_start_matches('[').trim_end_matches(']');
            for key in shape.keys() {
                let place = if bare.is_empty() {
                    key.name.to_owned()
                } else {
                    format!("{bare}.{}", key.name)
                };
                collect(&place, &key.shape, all);
            }
        }
        Shape::Either(shapes) => shapes.iter().for_each(|own| collect(place, own, all)),
        Shape::Named(inner) | Shape::Known(_, inner) => collect(&inside("NAME"), inner, all),
        Shape::List(inner) | Shape::Tuple(inner, _) => collect(&format!("[[{place}]]"), inner, all),
        _ => {}
    }
}

fn row(key: &Key) -> String {
    let star = if key.need == Need::Free { "" } else { " *" };
    let mut takes = takes(&key.shape, key.example.is_empty());
    if !key.example.is_empty() {
        let _ = write!(takes, ", such as `{}`", key.example);
    }
    let cell = |text: &str| text.replace('|', "\\|").replace('\n', " ");
    format!("| `{}`{star} | {} | {} |\n", key.name, cell(&takes), cell(key.about))
}

/// What a key takes; of a quantity with an example, where the key has none of its own.
fn takes(shape: &Shape, with_example: bool) -> String {
    let takes = |inner: &Shape| takes(inner, with_example);
    match shape {
        Shape::Text => "text".to_owned(),
        Shape::Formula => "a formula".to_owned(),
        Shape::Quantity(measure) => {
            let range = match measure.range {
                Range::Any => "",
                Range::Positive => ", above zero",
                Range::NotNegative => ", zero or more",
            };
            let example = match with_example {
                true => format!(", such as `\"{}\"`", measure.example),
                false => String::new(),
            };
            format!("{}{range}{example}", measure.dimension)
        }
        Shape::Number => "a number".to_owned(),
        Shape::Between(low, high) if high.is_finite() => {
            format!("a number between {low} and {high}")
        }
        Shape::Between(low, _) => format!("a number above {low}"),
        Shape::Count(least, most) if *most < usize::MAX => {
            format!("a whole number from {least} to {most}")
        }
        Shape::Count(least, _) => format!("a whole number from {least}"),
        Shape::Flag => "`true` or `false`".to_owned(),
        Shape::Words(_) | Shape::Registered(_) => {
            let words = shape.words();
            let more = if words.len() > MOST_WORDS { ", …" } else { "" };
            let words = words.iter().take(MOST_WORDS).map(|word| format!("`\"{word}\"`"));
            format!("{}{more}", words.collect::<Vec<_>>().join(", "))
        }
        Shape::List(Shape::Table(_)) => "tables".to_owned(),
        Shape::List(inner) => format!("a list; each: {}", takes(inner)),
        Shape::Tuple(inner, length) => format!("a list of {length}; each: {}", takes(inner)),
        Shape::Either(shapes) => {
            let mut all: Vec<String> = shapes.iter().map(&takes).collect();
            all.dedup();
            all.join("; or ")
        }
        Shape::Table(_) => "a table".to_owned(),
        Shape::Named(_) => "tables by names of yours".to_owned(),
        Shape::Known(names, _) => {
            let names = names();
            let more = if names.len() > MOST_WORDS { ", …" } else { "" };
            let names = names.iter().take(MOST_WORDS).map(|(name, _)| format!("`{name}`"));
            format!("a table by {}{more}", names.collect::<Vec<_>>().join(", "))
        }
    }
}
