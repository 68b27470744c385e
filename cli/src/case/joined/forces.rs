//! The tables `[drives.NAME]` and `[loads.NAME]`.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_solver::model::LoadAction;

use crate::case::dimensions::Dimensions;
use crate::case::joined_machine::{Drive, Load};
use crate::case::library::FileStore;
use crate::case::named_body::{Form, NamedBody};
use crate::case::rotor::Mesh;
use crate::case::{loads, machine, names};

/// The couple of a table; `body_of` gives the body at a place, if all are right; `goes_on`: bodies have the speeds of another
/// run.
pub(super) fn drive<'a>(
    store: FileStore,
    table: &Table,
    name: &Located,
    known: &[Located],
    body_of: impl Fn(usize) -> Option<&'a NamedBody>,
    goes_on: bool,
) -> Option<Drive> {
    let couple = machine::drive(store, table);
    let place = table.optional_string("body")?;
    let body = names::body(table, &place, known, false)?;
    let own = body_of(body)?;
    if !own.is_free() {
        let message = format!("`{}` does not turn freely: no couple drives it", place.text());
        let help = match own.rotation {
            None => "write `turns = \"free\"` in its table, or name a body that turns",
            Some(_) => "leave the drive out: a prescribed rotation takes the couple that it needs",
        };
        table.push(place.error_here(Code::BAD_VALUE, message).help(help));
    }
    if own.is_free() {
        let start = (!goes_on).then_some(own.initial_speed.unwrap_or(0.0));
        let key = format!("`initial_speed` in `[body.{}]`", place.text());
        machine::leads_to_its_target(table, start, &key);
    }
    match &own.form {
        Form::Meshed(meshed) if has_no_ends(table, &meshed.body.mesh) => table.absent(
            "section",
            "add `section = \"LEFT_END\"`: the set of nodes around the axis on which the couple acts, here the left end",
        ),
        Form::Meshed(_) => machine::needs_a_section(table),
        Form::Rigid(_) => {
            ["top", "bottom", "section"].into_iter().for_each(|key| no_mesh(table, key, own));
        }
    }
    Some(Drive { name: name.clone(), body, place, couple })
}

/// Whether a drive says nothing of where it acts, on a body that has no sets of single nodes for it.
fn has_no_ends(table: &Table, mesh: &Mesh) -> bool {
    let says = ["top", "bottom", "section"].iter().any(|key| table.has(key));
    let of_sections = match mesh {
        Mesh::Generated(own) => matches!(own.dimensions, Dimensions::Sections(..)),
        _ => false,
    };
    of_sections && !says
}

/// The force or the couple of a table.
pub(super) fn load<'a>(
    store: FileStore,
    table: &Table,
    name: &Located,
    known: &[Located],
    body_of: impl Fn(usize) -> Option<&'a NamedBody>,
) -> Option<Load> {
    let mut load = loads::read_one(store, table);
    let z = table.quantity("z");
    let of = table.optional_string("of");
    let place = table.optional_string("body")?;
    let body = names::body(table, &place, known, false)?;
    let own = body_of(body)?;
    match own.form {
        Form::Meshed(_) if own.has_sections() => on_sections(table),
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
    moves(table, &load, own);
    if let Some(followed) = followed(table, &load, of, &place, (body, known), body_of) {
        load.follow(followed);
    }
    Some(Load { name: name.clone(), body, z, load })
}

/// A load on a body made from sections stands at a z, or on sets.
fn on_sections(table: &Table) {
    if table.has("z") && table.has("sets") {
        table.conflict("z", "sets");
    }
    if !table.has("z") {
        table.demand("sets");
    } else if table.has("spread") {
        let message = "`spread` is of node sets: at a `z` the section carries the whole load";
        let help = "leave it out";
        table.push(table.written("spread").error_here(Code::BAD_VALUE, message).help(help));
    }
}

/// The body whose angle a load follows; none if it follows none.
fn followed<'a>(
    table: &Table,
    load: &loads::Load,
    of: Option<Located>,
    own: &Located,
    (body, known): (usize, &[Located]),
    body_of: impl Fn(usize) -> Option<&'a NamedBody>,
) -> Option<usize> {
    if load.followed().is_none() {
        if let Some(of) = of {
            let message = "a load that follows no angle has no use for `of`";
            let help = "leave it out, or add an `order`, or a `table` over an angle";
            table.push(of.error_here(Code::BAD_VALUE, message).help(help));
        }
        return None;
    }
    let (place, body) = match &of {
        Some(of) => (of, names::body(table, of, known, false)?),
        None => (own, body),
    };
    if !body_of(body)?.turns() {
        let message = format!("`{}` does not turn: a load cannot follow its angle", place.text());
        let help = "name a body that turns: `of = \"…\"`";
        table.push(place.error_here(Code::BAD_VALUE, message).help(help));
    }
    Some(body)
}

/// Notes a force or a couple along or about an axis along or about which a rigid body does not move.
fn moves(table: &Table, load: &loads::Load, body: &NamedBody) {
    let (tilts, along, rocks) = match &body.form {
        Form::Rigid(rigid) => (rigid.transverse_inertia.is_some(), rigid.along, rigid.rocks),
        Form::Meshed(meshed) if meshed.rigid => (true, meshed.moves_along_z, false),
        Form::Meshed(_) => return,
    };
    let name = body.name.text();
    let note = |message: String, help: &str| {
        table.push(load.place.error_here(Code::BAD_VALUE, message).help(help));
    };
    match load.acting {
        LoadAction::Force([.., z]) if z != 0.0 && !along => note(
            format!("`{name}` is rigid and does not move along z: a force along z has no effect"),
            "leave its part along z out, or write `moves_along_z = true` on the body",
        ),
        LoadAction::Couple([x, y, _]) if x.hypot(y) != 0.0 && !tilts => {
            note(
                format!("`{name}` does not tilt: a couple about x or y has no effect"),
                "give it a `transverse_inertia`, or leave these parts out",
            );
        }
        LoadAction::Couple([.., z]) if z != 0.0 && !body.turns() && !rocks => note(
            format!("`{name}` does not turn: a couple about z has no effect"),
            "let it turn or rock, or leave this part out",
        ),
        _ => {}
    }
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
