//! Names of bodies, joints and outputs.

use whirl_codegen::diagnostic::{Code, Located, suggest};
use whirl_codegen::document::Table;

/// What a side calls the ground.
pub(super) const GROUND: &str = "ground";

/// The tables below a key with their names, in the order of the file.
pub(super) fn in_order<'d>(file: &Table<'d>, key: &str) -> Vec<(Located, Table<'d>)> {
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

/// Notes names with other characters than those of bodies and joints.
pub(super) fn plain<'a>(table: &Table, key: &str, names: impl Iterator<Item = &'a Located>) {
    for name in names.filter(|name| !is_plain(name.text())) {
        let article = if key.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
        let called = if key == "added" { "added mass" } else { key };
        let message = format!("`{}` cannot be the name of {article} {called}", name.text());
        let help = "use letters, digits, `_` and `-`, as in all names";
        table.push(name.error_here(Code::BAD_VALUE, message).help(help));
    }
}

fn is_plain(text: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    !text.is_empty() && text.chars().all(plain)
}

/// Notes names that cannot stand in columns, and those that differ in nothing but case.
pub(super) fn distinct(file: &Table, key: &str, names: &[Located]) {
    for (place, name) in names.iter().enumerate() {
        let text = name.text();
        if !is_plain(text) {
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

/// Notes text in the place of a table; `like` makes of it what is meant.
pub(super) fn is_text(table: &Table, key: &str, like: impl Fn(&str) -> String) -> bool {
    let written = table.written(key);
    let text = written.text();
    if !table.gives(key) || !text.starts_with(['"', '\'']) || text.contains('\n') {
        return false;
    }
    table.pass_over(key);
    let message = format!("`{key}` takes a table, not text");
    let help = format!("write `{key} = {}`", like(text));
    table.push(written.error_here(Code::BAD_VALUE, message).help(help));
    true
}

/// The body that is called so, by its place; what is wrong is noted.
pub(super) fn body(
    table: &Table,
    name: &Located,
    known: &[Located],
    ground: bool,
) -> Option<usize> {
    let mut names: Vec<&str> = known.iter().map(Located::text).collect();
    names.extend(ground.then_some(GROUND));
    let message = format!("there is no body `{}`", name.text());
    place(table, name, &names, message, || {
        format!("describe it in a table `[body.{}]`", name.text())
    })
}

/// The place of a name among those that are known; another one is noted with this `message`, and with `help` where it is like none
/// of them.
pub(super) fn place(
    table: &Table,
    name: &Located,
    known: &[&str],
    message: String,
    help: impl FnOnce() -> String,
) -> Option<usize> {
    let found = known.iter().position(|own| *own == name.text());
    if found.is_none() {
        let help = suggest(name.text(), known).unwrap_or_else(help);
        table.push(name.error_here(Code::BAD_VALUE, message).help(help));
    }
    found
}
