//! What bodies and joints say together.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_solver::bearing::MotionKind;
use whirl_solver::model::AttachmentKind;
use whirl_specs::Motion;

use super::{fit, gear, sensor};
use crate::case::gravity::Gravity;
use crate::case::ground::GroundMotion;
use crate::case::joined_machine::{Drive, JoinedMachine};
use crate::case::joint::{Joint, JointKind, Side};
use crate::case::machine;
use crate::case::named_body::{Attached, Form, NamedBody};
use crate::case::rotor::Mesh;

/// The motion of all bodies, which is one.
pub(super) fn one_motion(
    file: &Table,
    motions: Vec<(Located, &'static Motion)>,
) -> Option<&'static Motion> {
    let Some((_, first)) = motions.first() else { return machine::default_motion() };
    for (place, motion) in &motions {
        if motion.origin.name != first.origin.name {
            let message = "all bodies of a machine have one `motion`";
            let help =
                format!("write \"{}\" here, too, or another one everywhere", first.origin.name);
            file.push(place.error_here(Code::BAD_VALUE, message).help(help));
        }
    }
    Some(first)
}

/// Notes what does not fit together.
pub(super) fn check(file: &Table, machine: &JoinedMachine, goes_on: bool) {
    let mut checks = Checks { file, machine, goes_on };
    machine.joints.iter().for_each(|joint| checks.joint(joint));
    (0..machine.joints.len()).for_each(|place| checks.twice(place));
    machine.drives.iter().enumerate().for_each(|(place, own)| checks.drive(place, own));
    (0..machine.bodies.len()).for_each(|body| checks.body(body));
}

struct Checks<'a, 'd> {
    file: &'a Table<'d>,
    machine: &'a JoinedMachine,
    /// Whether it has the speeds of another run.
    goes_on: bool,
}

impl Checks<'_, '_> {
    fn note(&mut self, at: &Located, message: String, help: &str) {
        self.file.push(at.error_here(Code::BAD_VALUE, message).help(help));
    }

    fn joint(&mut self, joint: &Joint) {
        for side in &joint.sides {
            self.side(joint, side);
        }
        if let Some((at, message, help)) = fit::axes(self.machine, joint) {
            self.note(&at, message, help);
        }
        if let Some((at, message, help)) = gear::wrong(self.machine, joint) {
            self.note(&at, message, &help);
        }
        if let Some((at, message, help)) = sensor::wrong(self.machine, joint) {
            self.note(&at, message, help);
        }
        self.on_rocking(joint);
        let turns = |side: &Side| side.body.is_some_and(|body| self.machine.bodies[body].turns());
        let [first, second] = joint.sides.each_ref().map(turns);
        let [of_first, of_second] = joint.sides.each_ref().map(|side| side.place.clone());
        if joint.kind == JointKind::Bushing && second {
            let message = format!(
                "the second side of a bushing stands still, but `{}` turns: its stiffness would turn with it",
                of_second.text()
            );
            let help = match first {
                true => "name a body that does not turn, or write a `bearing` between the two",
                false => "swap the two sides",
            };
            self.note(&of_second, message, help);
        }
        if let (Some(table), false) = (&joint.table, first) {
            let message = format!(
                "`{}` does not turn: there is no speed over which a table could be read",
                of_first.text()
            );
            self.note(table, message, "write `stiffness` and `damping` in its place");
        }
        for own in &joint.others {
            if !joint.sides.iter().any(|side| self.machine.side_has(side, own.kind)) {
                let (what, help) = match own.kind {
                    MotionKind::Tilts => (
                        "tilts",
                        "give a rigid body of it a `transverse_inertia`, or leave this out",
                    ),
                    MotionKind::Along => (
                        "moves along z",
                        "write `moves_along_z = true` on a rigid body of it, or leave this out",
                    ),
                };
                let message = format!("neither side of `{}` {what}", joint.name.text());
                self.note(&own.place, message, help);
            }
        }
        if joint.kind == JointKind::Coupling && !first {
            let message =
                format!("`{}` does not turn: a coupling joins rotations", of_first.text());
            let help = match second {
                true => "swap the two sides",
                false => "name a body that turns",
            };
            self.note(&of_first, message, help);
        }
    }

    /// Notes a bearing that is an earlier one once more: the same sets, and the same law.
    fn twice(&mut self, place: usize) {
        let joint = &self.machine.joints[place];
        let alike = |own: &Side, other: &Side| {
            let mut sets = own.sets.iter().zip(&other.sets);
            own.body == other.body
                && own.sets.len() == other.sets.len()
                && sets.all(|(own, other)| own.text().eq_ignore_ascii_case(other.text()))
        };
        let same = |other: &&Joint| {
            let [own, first] = [joint, other].map(|joint| &joint.bearing);
            let apart = !own.stations.is_empty()
                && !first.stations.is_empty()
                && !own.stations.iter().any(|z| first.stations.contains(z));
            joint.kind == JointKind::Bearing
                && other.kind == JointKind::Bearing
                // Bearings of a rigid body may share a plane, and their load.
                && !joint.sides[0].sets.is_empty()
                && joint.sides.iter().zip(&other.sides).all(|(own, other)| alike(own, other))
                && own.law.source.name() == first.law.source.name()
                && !apart
        };
        let Some(first) = self.machine.joints[..place].iter().find(same) else { return };
        let [own, other] = [joint, first].map(|joint| match self.machine.is_named() {
            true => format!("`{}`", joint.name.text()),
            false => format!("bearing {}", joint.name.text()),
        });
        let message = format!(
            "{own} stands where {other} does, and has the same law `{}`: its forces would act twice",
            joint.bearing.law.name.text()
        );
        let help = "take one of them out, or correct the sets of this one";
        self.note(&joint.name, message, help);
    }

    /// Whether a side says where it is as its body needs it.
    fn side(&mut self, joint: &Joint, side: &Side) {
        let Some(body) = side.body else { return };
        let (name, coupling) = (side.place.text(), joint.kind == JointKind::Coupling);
        let by_z = self.machine.bodies[body].has_sections();
        match self.machine.bodies[body].form {
            Form::Meshed(_) if by_z && side.z.is_some() && !side.sets.is_empty() => {
                let message = format!("a side on `{name}` has both a `z` and node sets");
                self.note(&side.place, message, "keep one of them");
            }
            Form::Meshed(_) if by_z && side.z.is_none() && side.sets.is_empty() && !coupling => {
                let message = format!("a side on `{name}` does not say where it stands");
                self.note(
                    &side.place,
                    message,
                    "add `z = \"100 mm\"`, or `sets = [\"…\"]`, beside `body`",
                );
            }
            Form::Meshed(_) if by_z => {}
            Form::Meshed(_) if side.z.is_some() => {
                let message = format!("`{name}` has a mesh: a side on it is named by node sets");
                self.note(&side.place, message, "write `sets = [\"…\"]` in place of `z`");
            }
            Form::Meshed(_) if side.sets.is_empty() && !coupling => {
                let message = format!("a side on `{name}`, which has a mesh, names its node sets");
                self.note(&side.place, message, "add `sets = [\"…\"]` beside `body`");
            }
            Form::Rigid(_) if !side.sets.is_empty() => {
                let message = format!("`{name}` is rigid and has no node sets");
                self.note(&side.place, message, "write `z = \"…\"` in place of `sets`");
            }
            _ => {}
        }
    }

    fn drive(&mut self, place: usize, drive: &Drive) {
        let mut earlier = self.machine.drives[..place].iter();
        if let Some(first) = earlier.find(|own| own.body == drive.body) {
            let message = format!(
                "`{}` is driven already, by `{}`: a rotation has one drive",
                drive.place.text(),
                first.name.text()
            );
            self.note(&drive.place, message, "take one of them out, or add up their torques");
        }
    }

    fn body(&mut self, place: usize) {
        let body = &self.machine.bodies[place];
        let joins = |joint: &&Joint| joint.sides.iter().any(|side| side.body == Some(place));
        let joints: Vec<&Joint> = self.machine.joints.iter().filter(joins).collect();
        let name = body.name.text();
        if joints.is_empty() && !grounded(body) {
            let stiffness = match &body.form {
                Form::Rigid(rigid) => rigid.stiffness,
                Form::Meshed(_) => [0.0; 2],
            };
            let (message, help) = match stiffness.map(|own| own > 0.0) {
                [true, false] => (
                    format!(
                        "nothing holds `{name}` along y: no joint names it, and its `stiffness` is along x only"
                    ),
                    "add `y` to its `stiffness`, or name it in a table `[joint.NAME]`",
                ),
                [false, true] => (
                    format!(
                        "nothing holds `{name}` along x: no joint names it, and its `stiffness` is along y only"
                    ),
                    "add `x` to its `stiffness`, or name it in a table `[joint.NAME]`",
                ),
                _ => (
                    format!("no joint names the body `{name}`: nothing holds it"),
                    "name it in a table `[joint.NAME]`, or take it out",
                ),
            };
            return self.note(&body.name.clone(), message, help);
        }
        let own = |axis: usize| match &body.form {
            Form::Meshed(_) => grounded(body),
            Form::Rigid(rigid) => rigid.stiffness[axis] > 0.0 || rigid.damping[axis] > 0.0,
        };
        for (axis, letter) in ["x", "y"].into_iter().enumerate() {
            if !own(axis) && !joints.iter().any(|joint| acts_along(joint, axis)) {
                let message = format!("nothing acts on the motion of `{name}` along {letter}");
                let help = "add a bearing or a bushing on it, or a stiffness to the ground if it does not turn";
                self.note(&body.name.clone(), message, help);
            }
        }
        self.along_z(body, &joints);
        let (tilts, without) = match &body.form {
            Form::Rigid(rigid) => {
                (rigid.transverse_inertia.is_some(), "leave `transverse_inertia` out, ")
            }
            Form::Meshed(meshed) => (meshed.rigid, ""),
        };
        if tilts && in_one_plane(&joints) {
            let message =
                format!("nothing acts on the tilts of `{name}`: its joints are in one plane");
            let help =
                format!("{without}add a joint at another z, or list `stations` along the joint");
            self.note(&body.name.clone(), message, &help);
        }
        let rocks = matches!(&body.form, Form::Rigid(rigid) if rigid.rocks);
        let aside =
            |joint: &&Joint| joint.kind == JointKind::Bearing || joint.sides[0].at.is_some();
        if rocks && (joints.len() < 2 || !joints.iter().any(aside)) {
            let message = format!("nothing acts on the turn of `{name}` about z");
            let help = "add its pivot, a bushing `at` a place of it, to the bearing that pushes it; or leave `rocks` out";
            self.note(&body.name.clone(), message, help);
        }
        if !body.is_free() {
            return;
        }
        let mut loads = self.machine.loads.iter().filter(|load| load.body == place);
        let driven = self.machine.drives.iter().any(|drive| drive.body == place)
            || loads.any(|own| own.load.turns())
            || self.is_weighed(body);
        let turned = self.goes_on || body.initial_speed.is_some_and(|speed| speed != 0.0);
        if !turned && !driven && !joints.iter().any(|joint| turns(joint)) {
            let message = format!("nothing acts on the rotation of `{name}`");
            let help = "add a drive `[drives.NAME]`, an `initial_speed` or a law with a torque, or write \
                        `turns = \"no\"`";
            self.note(&body.name.clone(), message, help);
        }
    }

    /// Notes a place on a body that does not rock, and one that rocks where it cannot be.
    fn on_rocking(&mut self, joint: &Joint) {
        let rocks = |side: &Side| {
            let form = side.body.map(|body| &self.machine.bodies[body].form);
            matches!(form, Some(Form::Rigid(rigid)) if rigid.rocks)
        };
        let first = &joint.sides[0];
        let runs = matches!(joint.kind, JointKind::Bearing | JointKind::Stop) && rocks(first);
        let (of_first, name) = (first.place.clone(), first.place.text().to_owned());
        let wrong = match &first.at {
            Some((_, at)) if !rocks(first) || joint.kind != JointKind::Bushing => Some((
                at.clone(),
                format!("`at` is of a bushing on a rigid body that rocks, and `{name}` is none"),
                "leave it out, or write `rocks = true` on the body",
            )),
            _ if runs => Some((
                of_first,
                format!("`{name}` rocks, which no journal does"),
                "make it the `bore` of the joint, or leave `rocks` out",
            )),
            _ => None,
        };
        if let Some((at, message, help)) = wrong {
            self.note(&at, message, help);
        }
    }

    /// Whether its weight, or the motion of the ground, may turn a body: its centre of mass may be beside its axis.
    fn is_weighed(&self, body: &NamedBody) -> bool {
        let across = |gravity: &Gravity| gravity.acceleration[..2].iter().any(|own| *own != 0.0);
        let beside = |own: &Attached| match own.what {
            AttachmentKind::Mass { mass, offset } => mass > 0.0 && offset != [0.0; 2],
            AttachmentKind::Unbalance(moment) => moment != [0.0; 2],
            AttachmentKind::Disc { .. } => false,
        };
        let shaken = self.machine.ground.as_ref().is_some_and(GroundMotion::is_across);
        let acts = shaken || self.machine.gravity.as_ref().is_some_and(across);
        acts && body.attached.iter().any(beside)
    }

    /// Notes a body that nothing holds along z.
    fn along_z(&mut self, body: &NamedBody, joints: &[&Joint]) {
        let name = body.name.text();
        if joints.iter().any(|joint| joint.acts_on(MotionKind::Along)) {
            return;
        }
        let moves = match &body.form {
            Form::Rigid(own) => own.along,
            Form::Meshed(own) => own.moves_along_z,
        };
        if moves {
            let message = format!("nothing acts on the motion of `{name}` along z");
            let help = "add a bushing with `axial_stiffness` on it or a bearing whose law gives F_z, or leave `moves_along_z` out";
            self.note(&body.name.clone(), message, help);
        }
        let Form::Meshed(own) = &body.form else { return };
        // Whether matrices have dofs along z is known once they are read.
        let stored = matches!(own.body.mesh, Mesh::Matrices(_));
        // Of what is made from sections, one at a joint is held.
        let held = stored
            || own.rigid
            || body.has_sections()
            || own.axial_restraint.is_some()
            || !own.held.is_empty();
        if body.turns() && !held {
            let message =
                format!("`[body.{name}]` has no `axial_restraint`: nothing holds it along z");
            let help = "add `axial_restraint = \"…\"`, a node set that is held along z; or a bushing with \
                        `axial_stiffness` on it, or a bearing whose law gives F_z";
            self.file.push(body.name.error_here(Code::MISSING_KEY, message).help(help));
        }
    }
}

/// Whether a body stands on the ground by itself.
fn grounded(body: &NamedBody) -> bool {
    match &body.form {
        Form::Meshed(meshed) => !meshed.held.is_empty() || !meshed.ground_springs.is_empty(),
        Form::Rigid(rigid) => rigid.stiffness.iter().all(|stiffness| *stiffness > 0.0),
    }
}

/// Whether a joint acts on motions along x or y.
fn acts_along(joint: &Joint, axis: usize) -> bool {
    match joint.kind {
        JointKind::Bearing => true,
        JointKind::Stop => joint.angle.is_none() || axis == 0,
        // Teeth push along their line of action alone, and hold no shaft.
        JointKind::Coupling | JointKind::Gear => false,
        JointKind::Bushing => {
            let letter = ["x", "y"][axis];
            joint.table.is_some()
                || joint.bearing.parameters.iter().any(|set| set.acts_along(letter))
        }
    }
}

/// Whether joints are in one plane as far as the case says where they are.
fn in_one_plane(joints: &[&Joint]) -> bool {
    let across = || {
        joints.iter().filter(|joint| !matches!(joint.kind, JointKind::Coupling | JointKind::Gear))
    };
    if across().any(|joint| long(joint)) {
        return false;
    }
    // Sets stand where their mesh has them.
    let unknown = |joint: &&&Joint| joint.sides.iter().any(|side| !side.sets.is_empty());
    let z = |joint: &&Joint| {
        let given = joint.sides.iter().find_map(|side| side.z);
        given.or(joint.bearing.stations.first().copied()).unwrap_or(0.0)
    };
    let mut known = across().filter(|joint| !unknown(joint)).map(z);
    let apart = known.next().is_some_and(|first| known.any(|other| (other - first).abs() > 1e-6));
    !apart && across().filter(unknown).count() + usize::from(across().any(|own| !unknown(&own))) < 2
}

/// Whether a joint acts on tilts by itself.
fn long(joint: &Joint) -> bool {
    joint.acts_on(MotionKind::Tilts)
        || joint.bearing.stations.len() > 1
        || joint.bearing.stations.is_empty() && joint.sides.iter().any(|side| side.sets.len() == 3)
}

/// Whether a joint turns or brakes what it joins.
fn turns(joint: &Joint) -> bool {
    joint.bearing.law.source.gives_torque()
}
