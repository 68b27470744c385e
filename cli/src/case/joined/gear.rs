//! Gears: their sizes, stiffness, damping and backlash; and whether they fit the bodies on which they are.

use std::f64::consts::{FRAC_PI_4, TAU};

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::units::Quantity;
use whirl_solver::bodies::Rotation;

use super::bushing;
use super::parts::Parts;
use crate::case::gears::Gears;
use crate::case::joined_machine::JoinedMachine;
use crate::case::joint::{Joint, JointKind};
use crate::case::named_body::NamedBody;
use crate::case::parameters::SetParameter;

/// Most teeth of a gear.
const MOST_TEETH: f64 = 1e5;
/// Share by which axes may be apart by another distance than the pitch radii say: what is left of a tooth's play.
const DISTANCE: f64 = 1e-3;
/// Share by which teeth and pitch radii may have different ratios.
const RATIO: f64 = 1e-6;
/// Share by which speeds may miss the ratio: of prescribed ones, the error grows with the angle.
const SPEED: f64 = 1e-9;
/// Pressure angle where none is given (rad).
const PRESSURE_ANGLE: f64 = 20.0 / 360.0 * TAU;

pub(super) fn read(table: &Table) -> Option<Parts> {
    let before = table.errors();
    let given: Vec<f64> = table.positive_numbers("teeth");
    let teeth = pair(table, "teeth", &given, |own| own.fract() == 0.0 && *own <= MOST_TEETH);
    let radii = table.quantity_pair("pitch_radii");
    let internal = table.optional_boolean("internal").unwrap_or(false);
    let pressure_angle = table.quantity("pressure_angle").unwrap_or(PRESSURE_ANGLE);
    let given = |key: &str| {
        let value = table.exact_quantity(key);
        if key != "backlash" {
            bushing::limited(table, (table, key), key, value.as_ref());
        }
        value
    };
    let [stiffness, damping, backlash] = ["mesh_stiffness", "mesh_damping", "backlash"].map(given);
    if !table.has("mesh_stiffness") {
        table.absent(
            "mesh_stiffness",
            "add `mesh_stiffness = \"2e8 N/m\"`, along the line of action",
        );
    }
    let sizes = ["teeth", "pitch_radii"].into_iter().find(|key| table.has(key));
    if sizes.is_none() {
        let help = "add `teeth = [20, 40]`, of the first and the second gear; or `pitch_radii = [\"40 mm\", \"80 mm\"]`";
        table.absent("teeth", help);
    }
    if !(pressure_angle.abs() < FRAC_PI_4) {
        let message = "the teeth are inclined by less than 45° to both sides";
        let help = "write `pressure_angle = \"20 deg\"`; or `\"-20 deg\"` where the first gear pushes the second from y to x";
        let at = table.written("pressure_angle");
        table.push(at.error_here(Code::BAD_VALUE, message).help(help));
    }
    if let (Some(teeth), Some(radii)) = (teeth, radii) {
        let [teeth, radii] = [teeth, radii].map(|[first, second]| first / second);
        if (teeth / radii - 1.0).abs() > RATIO {
            let message = format!(
                "the ratio of the pitch radii is {radii:.7}, and that of the teeth {teeth:.7}"
            );
            let help =
                "leave `pitch_radii` out: they follow from the teeth and the distance of the axes";
            let at = table.written("pitch_radii");
            table.push(at.error_here(Code::BAD_VALUE, message).help(help));
        }
    }
    let alike = teeth.or(radii).is_some_and(|[first, second]| first == second);
    if internal && alike {
        let message = "an internal gear is larger than the one that turns in it";
        let at = table.written(sizes.unwrap_or("teeth"));
        table.push(at.error_here(Code::BAD_VALUE, message).help("give them different sizes"));
    }
    if table.errors() > before {
        return None;
    }
    let mut set = Vec::with_capacity(3);
    let values = [("k", "mesh_stiffness", stiffness), ("c", "mesh_damping", damping)];
    let values = values.into_iter().chain([("b", "backlash", backlash.clone())]);
    for (name, key, value) in values.filter(|own| own.0 != "b" || own.2.is_some()) {
        let value = value.map_or_else(|| Quantity::parse("0 N*s/m"), Ok).ok()?;
        set.push(SetParameter::new(name, &table.written(key), value));
    }
    let backlash = backlash.is_some();
    let law = bushing::shipped(table, if backlash { "gear-flank" } else { "gear-mesh" })?;
    let place = table.written(sizes?);
    let gears = Gears { teeth, radii, internal, pressure_angle, backlash, place };
    Some(Parts { gears: Some(gears), ..Parts::of_law(law, set) })
}

/// Two values of a key.
fn pair(table: &Table, key: &str, values: &[f64], fits: impl Fn(&f64) -> bool) -> Option<[f64; 2]> {
    if !table.gives(key) {
        return None;
    }
    if let ([first, second], true) = (values, values.iter().all(fits)) {
        return Some([*first, *second]);
    }
    let message = format!("`{key}` are two whole numbers");
    let help = format!("write `{key} = [20, 40]`, of the first and the second gear");
    table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
    None
}

/// What is wrong with a gear on its bodies: where, what, and how to fix it.
pub(super) fn wrong(machine: &JoinedMachine, joint: &Joint) -> Option<(Located, String, String)> {
    let gears = joint.gears.as_ref()?;
    let mut bodies = Vec::with_capacity(2);
    for side in &joint.sides {
        let body = side.body.map(|body| &machine.bodies[body]);
        let Some(body) = body.filter(|own| own.turns()) else {
            let what =
                side.body.map_or("the ground".to_owned(), |_| format!("`{}`", side.place.text()));
            let message = format!("{what} does not turn: both gears are on bodies that do");
            let help = "name a body with `turns = \"free\"` or `turns = \"prescribed\"`";
            return Some((side.place.clone(), message, help.to_owned()));
        };
        bodies.push(body);
    }
    let [first, second] = [bodies[0], bodies[1]];
    distance(gears, joint, [first, second]).or_else(|| speeds(gears, joint, [first, second]))
}

/// Axis of the second body less that of the first (m).
pub(crate) fn axes_apart([first, second]: [&NamedBody; 2]) -> [f64; 2] {
    [0, 1].map(|axis| second.axis[axis] - first.axis[axis])
}

fn distance(
    gears: &Gears,
    joint: &Joint,
    bodies: [&NamedBody; 2],
) -> Option<(Located, String, String)> {
    let [x, y] = axes_apart(bodies);
    let found = x.hypot(y);
    let [first, second] = bodies.map(|own| own.name.text());
    let mm = |own: f64| whirl_text::rounded(1e3 * own, 9);
    if found == 0.0 {
        let message =
            format!("`{first}` and `{second}` turn about one axis, where no gear can join them");
        let at = gears.distance().unwrap_or(0.1);
        let [own_x, own_y] = bodies[0].axis;
        let help = format!(
            "place one of them, such as `axis = [\"{} mm\", \"{} mm\"]` in `[body.{second}]`; or write a `coupling`",
            mm(own_x + at),
            mm(own_y)
        );
        return Some((joint.sides[1].place.clone(), message, help));
    }
    let wanted = gears.distance()?;
    ((found - wanted).abs() > DISTANCE * wanted).then(|| {
        let message = format!(
            "the axes of `{first}` and `{second}` are {} mm apart, and the pitch radii say {} mm",
            mm(found),
            mm(wanted)
        );
        let [along_x, along_y] = [x, y].map(|own| own / found * wanted);
        let [own_x, own_y] = bodies[0].axis;
        let help = format!(
            "write `axis = [\"{} mm\", \"{} mm\"]` in `[body.{second}]`, or correct `pitch_radii`",
            mm(own_x + along_x),
            mm(own_y + along_y)
        );
        (gears.place.clone(), message, help)
    })
}

/// Speeds and accelerations that the case gives both bodies and that are not in the ratio.
fn speeds(
    gears: &Gears,
    joint: &Joint,
    bodies: [&NamedBody; 2],
) -> Option<(Located, String, String)> {
    let times: Vec<f64> = bodies
        .iter()
        .filter_map(|own| own.speeds.as_ref())
        .flat_map(|own| own.rows.iter().map(|row| row[0]))
        .collect();
    let times = if times.is_empty() { vec![0.0, 1.0] } else { times };
    let prescribed = bodies.iter().all(|own| !own.is_free());
    for t in times {
        // A body that turns freely has a speed at the start alone.
        if !prescribed && t != 0.0 {
            continue;
        }
        let [Some(first), Some(second)] = bodies.map(|own| told(own, t)) else { return None };
        let wanted = gears.ratio() * first;
        if (second - wanted).abs() <= SPEED * wanted.abs().max(second.abs()) {
            continue;
        }
        let [a, b] = bodies.map(|own| own.name.text());
        let rpm = |speed: f64| whirl_text::rounded(speed * 60.0 / TAU, 12);
        let when = if t == 0.0 { String::new() } else { format!(" at t = {t} s") };
        let message = format!(
            "`{b}` turns with {} rpm{when} and `{a}` with {} rpm, but the gear `{}` has the ratio {}",
            rpm(second),
            rpm(first),
            joint.name.text(),
            whirl_text::rounded(gears.ratio(), 9)
        );
        let help = match prescribed {
            true => format!(
                "write `turns = \"free\"` in `[body.{b}]` without a speed: its gear turns it; or give it {} rpm{when}",
                rpm(wanted)
            ),
            false => format!(
                "leave the `initial_speed` out of `[body.{b}]`: it starts with {} rpm, as its gear says",
                rpm(wanted)
            ),
        };
        return Some((joint.sides[1].place.clone(), message, help));
    }
    None
}

/// The speed that the case gives a body at a time (rad/s).
fn told(body: &NamedBody, t: f64) -> Option<f64> {
    match body.rotation.as_ref()? {
        Rotation::Free => body.initial_speed,
        Rotation::Prescribed { speed, acceleration } => Some(speed + acceleration * t),
        Rotation::Scheduled(own) => Some(own.at(t)[1]),
        Rotation::Held | Rotation::Spinning { .. } => None,
    }
}

/// Gives bodies that turn freely and have no `initial_speed` the one that their gears say, where the speed of another one is known.
pub(super) fn start(bodies: &mut [NamedBody], joints: &[Joint]) {
    let gears = || joints.iter().filter(|own| own.kind == JointKind::Gear);
    for _ in gears() {
        for joint in gears() {
            let (Some(own), [Some(a), Some(b)]) =
                (&joint.gears, joint.sides.each_ref().map(|side| side.body))
            else {
                continue;
            };
            for (from, to, ratio) in [(a, b, own.ratio()), (b, a, 1.0 / own.ratio())] {
                let known = told(&bodies[from], 0.0);
                let open = bodies[to].is_free() && bodies[to].initial_speed.is_none();
                if let (Some(speed), true) = (known, open) {
                    bodies[to].initial_speed = Some(ratio * speed);
                }
            }
        }
    }
}
