//! How a machine begins: the table `[start]`.

use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::units::Dimension;
use whirl_specs::Motion;

use super::joined_machine::{Drive, JoinedMachine};
use super::machine;

/// How a machine begins.
#[derive(Debug, Clone)]
pub(crate) enum Start {
    /// Undeformed and at rest, but for speeds of rotation that are given.
    Rest,
    /// In equilibrium at these speeds.
    Equilibrium,
    /// As another run ended: its folder of results.
    State(Located),
    /// As a run before it ended: its state as it is kept. No file says so; points of a sweep go on from each other.
    After(Arc<[u8]>),
}

/// The table, with where it says what.
#[derive(Debug)]
pub(super) struct StartDraft {
    pub(super) start: Start,
    /// Speed of the shaft at t = 0 (rad/s), where the table gives it.
    pub(super) speed: Option<f64>,
    kind: Located,
    speed_place: Located,
}

impl StartDraft {
    /// Whether the machine goes on from a state.
    pub(super) fn goes_on(&self) -> bool {
        matches!(self.start, Start::State(_))
    }
}

/// Nothing where there is no table.
pub(super) fn read(file: &Table) -> Option<StartDraft> {
    file.in_table("start", read_start)
}

fn read_start(table: &Table) -> StartDraft {
    let kind = table.optional_word("kind");
    let from = table.optional_string("from");
    let speed = machine::speed(table, "speed");
    let start = match (kind, from) {
        (Some("state") | None, Some(from)) => {
            if table.has("speed") {
                table.conflict("speed", "from");
            }
            Start::State(from)
        }
        (Some(_), Some(_)) => {
            let message = "a start `from` a run has its state, and no other kind";
            let place = table.written("kind");
            let help = "leave out `kind`, or `from`";
            table.push(place.error_here(Code::BAD_VALUE, message).help(help));
            Start::Rest
        }
        (Some("state"), None) => {
            table.absent("from", "add `from = \"results/NAME\"`, the folder of results of a run");
            Start::Rest
        }
        (Some("equilibrium"), None) => Start::Equilibrium,
        _ => Start::Rest,
    };
    StartDraft { start, speed, kind: table.written("kind"), speed_place: table.written("speed") }
}

/// Notes what does not fit the machine.
pub(super) fn check(file: &Table, draft: &StartDraft, machine: &JoinedMachine) {
    if machine.is_mass() {
        let message = "`[start]` is of a machine that turns; a mass begins as its table says";
        let help = "write `displacement` and `velocity` in `[mass]`";
        file.push(file.written("start").error_here(Code::BAD_VALUE, message).help(help));
        return;
    }
    if draft.speed.is_some() && machine.is_named() {
        let name =
            machine.bodies.iter().find(|own| own.is_free()).map_or("NAME", |own| own.name.text());
        let message = "`speed` is of the one shaft of a machine in short form";
        let help = format!("write `initial_speed` in `[body.{name}]`, or in another that turns");
        file.push(draft.speed_place.error_here(Code::BAD_VALUE, message).help(help));
    }
    if !matches!(draft.start, Start::Equilibrium) {
        return;
    }
    if !machine.is_named() && draft.speed.is_none() {
        let message = "an equilibrium is one at a speed";
        let help = "add `speed = \"4500 rpm\"` to `[start]`, with the speed of the shaft";
        file.push(draft.kind.error_here(Code::BAD_VALUE, message).help(help));
    }
    check_motion(file, draft, machine.motion);
    if !machine.is_named() {
        return;
    }
    // Of a couple over the speed the speed is found at which it is balanced.
    let over_speed = |drive: &&Drive| {
        let table = drive.couple.table.as_ref();
        table.is_some_and(|own| own.measures[0] == Dimension::ANGULAR_SPEED)
    };
    let driven = machine.drives.iter().filter(|drive| drive.couple.acts && !over_speed(drive));
    for drive in driven {
        let body = &machine.bodies[drive.body];
        if body.is_free() && body.initial_speed.is_none() {
            let name = body.name.text();
            let message = format!("`{name}` is driven, and its speed in equilibrium is not given");
            let help = format!("add `initial_speed = \"4500 rpm\"` to `[body.{name}]`");
            file.push(body.name.error_here(Code::BAD_VALUE, message).help(help));
        }
    }
}

/// Notes a motion in which nothing that is bent stands still in space.
fn check_motion(file: &Table, draft: &StartDraft, motion: &Motion) {
    if motion.origin.name == "hu2003" {
        let message = "the motion `hu2003` counts the centrifugal force twice: a bent shaft that turns has no \
                       equilibrium in space";
        let help = "leave out `motion`, or start at rest";
        file.push(draft.kind.error_here(Code::BAD_VALUE, message).help(help));
    }
}
