//! What `whirl check` says of a case, as parts of a page.

use super::{bodies, joints, loads, made, marched, mass, outputs};
use crate::case::Case;
use crate::errors::Failure;
use crate::machine::JoinedPlan;
use crate::page::Section;

/// Bodies, speeds, joints, loads, outputs and time; those that there are.
///
/// # Errors
/// Of linear algebra.
pub(crate) fn words(case: &Case, plan: &JoinedPlan) -> Result<Vec<Section>, Failure> {
    let machine = &*case.machine;
    let of_lines = |title: &str, lines: Vec<String>| Section {
        title: title.to_owned(),
        lines,
        ..Section::default()
    };
    let mut all = Vec::new();
    if machine.is_mass() {
        let mut text = String::new();
        mass::say(&mut text, machine, plan);
        all.push(of_lines("The mass", text.trim().lines().map(str::to_owned).collect()));
    } else {
        let lines = [made::lines(machine, plan), bodies::carried(machine)].concat();
        let table = bodies::masses(machine, plan)?;
        all.push(Section { title: "Bodies".to_owned(), table, lines });
        all.extend(made::sections(machine));
        all.push(of_lines("Speeds", bodies::speeds(machine, case)));
        let joints = joints::all(machine, plan).into_iter();
        let joints = joints.map(|(first, more)| [vec![first], more].concat().join("; "));
        all.push(of_lines("Joints", joints.collect()));
        all.push(of_lines("Loads", loads::all(machine)));
        all.push(of_lines("Outputs", outputs::all(case)));
    }
    all.extend(case.march.as_ref().map(|own| of_lines("Time", marched::lines(own))));
    all.retain(|own| !own.table.is_empty() || !own.lines.is_empty());
    Ok(all)
}
