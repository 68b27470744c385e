//! The sensor of a bearing, whose law reads it apart from where it acts.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::kinds::law::Acts;

use crate::case::joined_machine::JoinedMachine;
use crate::case::joint::{Joint, Sensor, Side};
use crate::case::named_body::Form;

/// The key `sensor` as it is written.
pub(super) struct Keys {
    place: Located,
    z: Option<f64>,
    set: Option<Located>,
    base: Option<Located>,
}

pub(super) fn read(table: &Table) -> Option<Keys> {
    let place = table.gives("sensor").then(|| table.written("sensor"));
    table.optional_table("sensor")?.read(|own| {
        let (z, set) = (own.quantity("z"), own.optional_string("set"));
        Some(Keys { place: place?, z, set, base: own.optional_string("base") })
    })
}

/// The sensor of a bearing, by its sides and what its law acts on.
pub(super) fn placed(
    table: &Table,
    keys: Option<Keys>,
    acts: Acts,
    [journal, bore]: [&Side; 2],
) -> Option<Sensor> {
    if acts == Acts::Sensor {
        table.demand("sensor");
    }
    let Keys { place, z, set, base } = keys?;
    if acts != Acts::Sensor {
        let message = "the law of this bearing reads no sensor";
        let help = "leave `sensor` out, or take a law with the inputs y_x and y_y";
        table.push(place.error_here(Code::BAD_VALUE, message).help(help));
    }
    let of = |side: &Side, set: Option<Located>| Side {
        z,
        ..Side::of(side.body, side.place.clone(), set.into_iter().collect())
    };
    Some(Sensor { place, sides: [of(journal, set), of(bore, base)] })
}

/// What is wrong with where the sensor of a joint is: place, message and help.
pub(super) fn wrong(
    machine: &JoinedMachine,
    joint: &Joint,
) -> Option<(Located, String, &'static str)> {
    let sensor = joint.sensor.as_ref()?;
    let [seen, base] = &sensor.sides;
    let at = || sensor.place.clone();
    let body = |side: &Side| side.body.map(|body| &machine.bodies[body]);
    let (first, second) = (body(seen)?, body(base));
    let is_mesh = |form: &Form| matches!(form, Form::Meshed(_));
    // A z of a body of sections becomes a set of its mesh.
    let by_z = first.has_sections() || !is_mesh(&first.form);
    if seen.sets.is_empty() && (seen.z.is_none() || !by_z) {
        let message = format!("the sensor has no place on `{}`", first.name.text());
        let help = match by_z {
            true => "write `z`, where it looks at the body",
            false => "write `set`, the name of a node set of its mesh around the axis",
        };
        return Some((at(), message, help));
    }
    if !is_mesh(&first.form) && !seen.sets.is_empty() {
        let message = format!("`{}` has no mesh, and no node sets", first.name.text());
        return Some((seen.sets[0].clone(), message, "write `z` in place of `set`"));
    }
    match second {
        None if !base.sets.is_empty() => Some((
            base.sets[0].clone(),
            "the bore is on the ground, on which this sensor stands, too".to_owned(),
            "leave `base` out",
        )),
        Some(second) if !is_mesh(&second.form) && !base.sets.is_empty() => Some((
            base.sets[0].clone(),
            format!("`{}` has no mesh, and no node sets", second.name.text()),
            "leave `base` out: the sensor stands where it looks at the journal",
        )),
        Some(second) if !is_mesh(&second.form) && base.z.is_none() => Some((
            at(),
            format!("it is open where on `{}` the sensor stands", second.name.text()),
            "write `z` beside `set`",
        )),
        Some(second) if second.turns() && second.axis != first.axis => Some((
            at(),
            format!(
                "a sensor on `{}` cannot see `{}`, whose axis is another one",
                second.name.text(),
                first.name.text()
            ),
            "give both bodies the same `axis`, or let the bore be on a body that does not turn",
        )),
        _ => None,
    }
}
