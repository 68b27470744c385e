//! What `whirl check` says of drives, loads and unbalance.

use std::fmt::Write;

use whirl_solver::model::{AttachmentKind, LoadAction};
use whirl_text::rounded;

use crate::case::{Gravity, GroundMotion, JoinedMachine, Spread};

/// Drives, loads, unbalance, gravity and the motion of the ground.
pub(super) fn say(text: &mut String, joined: &JoinedMachine) {
    let all = all(joined);
    if !all.is_empty() {
        line!(text, "\nLoads\n{}", all.join("\n"));
    }
}

/// The same, a line each.
pub(super) fn all(joined: &JoinedMachine) -> Vec<String> {
    [drives(joined), loads(joined), unbalance(joined), gravity(joined), ground(joined)].concat()
}

fn drives(joined: &JoinedMachine) -> Vec<String> {
    let acting = joined.drives.iter().filter(|drive| drive.couple.acts);
    let all = acting.map(|drive| {
        let name =
            if joined.is_named() { format!("{} ", drive.name.text()) } else { String::new() };
        format!("drive {name}on {}: {}", drive.place.text(), drive.couple.described())
    });
    all.collect()
}

fn loads(joined: &JoinedMachine) -> Vec<String> {
    let name = |body: usize| joined.bodies[body].name.text();
    let all = joined.loads.iter().map(|own| {
        let sets: Vec<&str> = own.load.sets.iter().map(|set| set.text()).collect();
        let each = match (&own.load.acting, own.load.spread) {
            (LoadAction::Force(_), Spread::Each) => "each node of ",
            _ => "the mean of ",
        };
        let place = match sets.is_empty() {
            true => String::new(),
            false => format!(" at {each}{}", sets.join(", ")),
        };
        let of = own.load.followed().filter(|_| joined.is_named());
        let described = own.load.described("", of.map(name));
        format!("load {} on {}{place}: {described}", own.name.text(), name(own.body))
    });
    all.collect()
}

fn unbalance(joined: &JoinedMachine) -> Vec<String> {
    let mut all = Vec::new();
    for body in &joined.bodies {
        for own in &body.attached {
            let AttachmentKind::Unbalance([x, y]) = own.what else { continue };
            all.push(format!(
                "unbalance {} on {}: {} g mm at {}°, z = {} mm",
                own.name.text(),
                body.name.text(),
                rounded(1e6 * x.hypot(y), 6),
                rounded(y.atan2(x).to_degrees(), 6),
                rounded(1e3 * own.z, 6)
            ));
        }
    }
    all
}

fn gravity(joined: &JoinedMachine) -> Vec<String> {
    let of = |gravity: &Gravity| {
        let parts = gravity.acceleration.map(|part| part.to_string());
        format!("gravity: {} m/s² along x, y, z", parts.join(", "))
    };
    joined.gravity.iter().map(of).collect()
}

/// The motion of the ground, if there is one.
pub(super) fn ground(joined: &JoinedMachine) -> Vec<String> {
    let of = |own: &GroundMotion| {
        let axes = ["x", "y", "z"].into_iter().zip(&own.axes).zip(own.largest);
        let there = axes.filter(|((_, curve), _)| curve.is_some());
        let parts =
            there.map(|((axis, _), most)| format!("{} m/s² along {axis}", rounded(most, 4)));
        let parts = parts.collect::<Vec<_>>().join(", ");
        format!("ground motion by table `{}`: up to {parts}", own.name.text())
    };
    joined.ground.iter().map(of).collect()
}
