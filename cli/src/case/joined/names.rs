//! Names of bodies and joints.

use whirl_codegen::diagnostic::{Code, Located, suggest};
use whirl_codegen::document::Table;

/// What a side calls the ground.
pub(super) const GROUND: &str = "ground";

/// The tables below a key with their names, in the order of the file.
pub(in crate::case) fn in_order<'d>(file: &Table<'d>, key: &str) -> Vec<(Located, Table<'d>)> {
    let mut tables: Vec<(Located, Table<'d>)> = file
        .named_tables(key)
        .into_iter()
        .map(|(name, table)| (table.heading().text(&name), table))
        .collect();
    // Those of included files come after those of the file itself.
    let own = file.source().path.clone();
    let order = |name: &Located| {
        let path = name.source().path.clone();
        (path != own, path, name.span().start)
    };
    tables.sort_by_key(|(name, _)| order(name));
    tables
}

/// Notes names that cannot stand in columns, and those that differ in nothing but case.
pub(in crate::case) fn distinct(file: &Table, key: &str, names: &[Located]) {
    for (place, name) in names.iter().enumerate() {
        let text = name.text();
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if text.is_empty() || !text.chars().all(plain) {
            let article = if key.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
            let message = format!("`{text}` cannot be the name of {article} {key}");
            let help = "use letters, digits, `_` and `-`: names stand in columns of history.csv";
            file.push(name.error_here(Code::BAD_VALUE, message).help(help));
        }
        if text.eq_ignore_ascii_case(GROUND) && key == "body" {
            let message = "`ground` is what does not move, and no body";
            let help = "give the body another name";
            file.push(name.error_here(Code::BAD_VALUE, message).help(help));
        }
        let same = names[..place].iter().find(|own| own.text().eq_ignore_ascii_case(text));
        if let Some(first) = same {
            let message =
                format!("the names `{text}` and `{}` differ in capitals only", first.text());
            let help = format!("give this {key} another name");
            file.push(name.error_here(Code::BAD_VALUE, message).help(help));
        }
    }
}

/// The body that is called so, by its place; what is wrong is noted.
pub(super) fn body(
    table: &Table,
    name: &Located,
    known: &[Located],
    ground: bool,
) -> Option<usize> {
    let found = known.iter().position(|own| own.text() == name.text());
    if found.is_none() {
        let mut names: Vec<&str> = known.iter().map(Located::text).collect();
        if ground {
            names.push(GROUND);
        }
        let message = format!("there is no body `{}`", name.text());
        let help = suggest(name.text(), &names)
            .unwrap_or_else(|| format!("describe it in a table `[body.{}]`", name.text()));
        table.push(name.error_here(Code::BAD_VALUE, message).help(help));
    }
    found
}
