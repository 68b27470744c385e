//! The tables `[drives.NAME]` and `[loads.NAME]`.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;

use super::names;
use super::{Drive, Form, Load, NamedBody, Turning};
use crate::case::{loads, machine};

/// The couple of a table; `body_of` gives the body at a place, if all are right.
pub(super) fn drive<'a>(
    table: &Table,
    name: &Located,
    known: &[Located],
    body_of: impl Fn(usize) -> Option<&'a NamedBody>,
) -> Option<Drive> {
    let couple = machine::drive(table);
    let place = table.optional_string("body")?;
    let body = names::body(table, &place, known, false)?;
    let own = body_of(body)?;
    if !matches!(own.turning, Some(Turning::Free { .. })) {
        let message = format!("`{}` does not turn freely: no couple drives it", place.text());
        let help = match own.turning {
            None => "write `turns = \"free\"` in its table, or name a body that turns",
            Some(_) => "leave the drive out: a prescribed rotation takes the couple that it needs",
        };
        table.push(place.error_here(Code::BAD_VALUE, message).help(help));
    }
    match own.form {
        Form::Meshed(_) => ["top", "bottom"].iter().for_each(|key| table.demand(key)),
        Form::Rigid(_) => ["top", "bottom"].into_iter().for_each(|key| no_mesh(table, key, own)),
    }
    Some(Drive { name: name.clone(), body, place, couple })
}

/// The force of a table.
pub(super) fn load<'a>(
    table: &Table,
    name: &Located,
    known: &[Located],
    body_of: impl Fn(usize) -> Option<&'a NamedBody>,
) -> Option<Load> {
    let load = loads::read_one(table);
    let z = table.quantity("z");
    let place = table.optional_string("body")?;
    let body = names::body(table, &place, known, false)?;
    let own = body_of(body)?;
    match own.form {
        Form::Meshed(_) => {
            table.demand("sets");
            if table.has("z") {
                let message =
                    format!("`{}` has a mesh: its loaded nodes are named by sets", place.text());
                let help = "write `sets = [\"…\"]` in place of `z`";
                table.push(table.written("z").error_here(Code::BAD_VALUE, message).help(help));
            }
        }
        Form::Rigid(_) => no_mesh(table, "sets", own),
    }
    Some(Load { name: name.clone(), body, z, load })
}

/// Notes a node set of a body that has no mesh.
pub(super) fn no_mesh(table: &Table, key: &str, body: &NamedBody) {
    if table.has(key) {
        let message = format!("`{}` is rigid and has no node sets", body.name.text());
        let help = match key {
            "sets" => "write `z = \"…\"` in place of `sets`",
            _ => "leave it out: the couple acts on the rotation of the body",
        };
        table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
    }
}
