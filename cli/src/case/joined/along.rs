//! What stands at a z of a body made from sections, as node sets of its mesh: sides of joints, sensors and loads. Layers of its cells
//! end there, and of a body that nothing holds along z one of these sections is held.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_solver::bearing::MotionKind;
use whirl_solver::mesh::Selection;
use whirl_solver::mesh::sections::SectionTable;

use crate::case::dimensions::Dimensions;
use crate::case::joined_machine::JoinedMachine;
use crate::case::joint::{Joint, JointKind};
use crate::case::loads::Spread;
use crate::case::named_body::{Form, MeshedBody, NamedBody};
use crate::case::rotor::Mesh;
use crate::case::selections::NamedSelection;

/// Nodes stand in a plane to this part of the body's length, as cells are longer.
const FLAT: f64 = 1e-7;

/// Gives everything that the case places by a z on a body made from sections its node set; z that are not on their body are
/// noted.
pub(super) fn place(file: &Table, machine: &mut JoinedMachine) {
    for (body, z) in wanted(machine) {
        if let Some(table) = table_of(&mut machine.bodies[body]) {
            table.planes.push(z);
        }
    }
    let JoinedMachine { bodies, joints, loads, .. } = machine;
    for joint in joints {
        for side in 0..2 {
            let own = &joint.sides[side];
            let (Some(body), true) = (own.body, own.sets.is_empty()) else { continue };
            // A side without a place is noted where it is checked, and stands at the left end for further checks.
            let Some(z) = own.z.or_else(|| left_end(&mut bodies[body])) else { continue };
            let bore = side == 1 && matches!(joint.kind, JointKind::Bearing | JointKind::Stop);
            if let Some((set, z)) = set(file, &mut bodies[body], (&own.place, z, bore)) {
                name(joint, side, &set, z);
            }
        }
        let Some(sensor) = &mut joint.sensor else { continue };
        for (side, own) in sensor.sides.iter_mut().enumerate() {
            let (Some(body), true) = (own.body, own.sets.is_empty()) else { continue };
            let found =
                own.z.and_then(|z| set(file, &mut bodies[body], (&sensor.place, z, side == 1)));
            // Without a place of its own it stands on the bore.
            let of_joint = || joint.sides[1].sets.get(joint.sides[1].sets.len() / 2).cloned();
            let set = found.map(|own| own.0).or_else(|| if side == 1 { of_joint() } else { None });
            own.sets.extend(set);
        }
    }
    for load in loads {
        let (Some(z), true) = (load.z, load.load.sets.is_empty()) else { continue };
        if let Some((set, _)) = set(file, &mut bodies[load.body], (&load.name, z, false)) {
            load.load.sets = vec![set];
            load.load.spread = Spread::Mean;
        }
    }
    (0..machine.bodies.len()).for_each(|body| restrain(machine, body));
}

/// The bodies on which sides and loads stand without a set, and where (m).
fn wanted(machine: &JoinedMachine) -> Vec<(usize, f64)> {
    let sensors = machine.joints.iter().filter_map(|joint| joint.sensor.as_ref());
    let sides = machine.joints.iter().flat_map(|joint| &joint.sides);
    let sides = sides.chain(sensors.flat_map(|own| &own.sides));
    let sides =
        sides.filter(|side| side.sets.is_empty()).filter_map(|side| Some((side.body?, side.z?)));
    let loads = machine.loads.iter().filter(|load| load.load.sets.is_empty());
    sides.chain(loads.filter_map(|load| Some((load.body, load.z?)))).collect()
}

/// The table of sections of a body, if it is made from one.
fn table_of(body: &mut NamedBody) -> Option<&mut SectionTable> {
    let Form::Meshed(own) = &mut body.form else { return None };
    let Mesh::Generated(made) = &mut own.body.mesh else { return None };
    match &mut made.dimensions {
        Dimensions::Sections(own) => Some(&mut own.table),
        _ => None,
    }
}

/// z of the left end of a body that is made from sections (m).
fn left_end(body: &mut NamedBody) -> Option<f64> {
    table_of(body)?.rows.iter().map(|row| row.z[0]).reduce(f64::min)
}

/// The set of the nodes in the section nearest to z (m), or of its bore, and the z of it; none on another body. A z beyond the
/// body is noted.
fn set(
    file: &Table,
    body: &mut NamedBody,
    (place, z, bore): (&Located, f64, bool),
) -> Option<(Located, f64)> {
    let table = table_of(body)?;
    // Rows that cannot be are noted when the mesh is made.
    let planes = table.planes_of_cells().unwrap_or_else(|| vec![z]);
    let (first, last) = (*planes.first()?, *planes.last()?);
    let flat = FLAT * (last - first);
    if z < first - flat || z > last + flat {
        let length = |z: f64| format!("{} mm", whirl_text::rounded(1e3 * z, 9));
        let message = format!("`{}` is not at z = {}", body.name.text(), length(z));
        let help = format!("it reaches from z = {} to {}", length(first), length(last));
        file.push(place.error_here(Code::BAD_VALUE, message).help(help));
    }
    let at = planes.into_iter().min_by(|a, b| (a - z).abs().total_cmp(&(b - z).abs()))?;
    let what = if bore { "bore at z" } else { "z" };
    let text = format!("{what} = {} mm", whirl_text::rounded(1e3 * at, 9));
    let name = Located::new(place.source(), place.span(), text);
    let Form::Meshed(own) = &mut body.form else { return None };
    let known = &mut own.body.selections;
    if !known.iter().any(|own| own.name.text() == name.text()) {
        let selection = Selection::Section { at, within: flat, innermost: bore };
        let name = name.clone();
        known.push(NamedSelection { name, selection, about_axis: false, within_given: true });
    }
    Some((name, at))
}

/// Lets a side of a joint stand at a set.
fn name(joint: &mut Joint, side: usize, set: &Located, z: f64) {
    joint.sides[side].sets = vec![set.clone()];
    joint.sides[side].z = Some(z);
    let of_bearing = [&mut joint.bearing.journal, &mut joint.bearing.bore];
    for (place, sets) in of_bearing.into_iter().enumerate() {
        if place == side {
            *sets = vec![set.clone(); 3];
        }
    }
}

/// Holds a section of a body that turns along z, where neither the case nor a joint does: at its first joint, or its left
/// end.
fn restrain(machine: &mut JoinedMachine, body: usize) {
    let joints = || {
        machine.joints.iter().filter(|joint| joint.sides.iter().any(|own| own.body == Some(body)))
    };
    let pushed = joints().any(|joint| joint.acts_on(MotionKind::Along));
    let across =
        joints().filter(|joint| matches!(joint.kind, JointKind::Bearing | JointKind::Bushing));
    let mut sides = across.flat_map(|joint| &joint.sides).filter(|own| own.body == Some(body));
    let at_joint = sides.find_map(|own| own.sets.get(own.sets.len() / 2)).cloned();
    let own = &mut machine.bodies[body];
    if !own.turns() || pushed || table_of(own).is_none() {
        return;
    }
    let left = own.name.clone();
    let left = Located::new(left.source(), left.span(), "LEFT_END".to_owned());
    let Form::Meshed(meshed) = &mut own.form else { return };
    if is_open_along_z(meshed) {
        meshed.axial_restraint = Some(at_joint.unwrap_or(left));
    }
}

/// Whether the case holds nothing of a body along z.
fn is_open_along_z(own: &MeshedBody) -> bool {
    !own.rigid && own.axial_restraint.is_none() && own.held.is_empty()
}
