//! A machine of bodies by name, and of what joins them: the tables `[body.NAME]`, `[joint.NAME]`, `[drives.NAME]` and
//! `[loads.NAME]`.

mod along;
mod attached;
mod bodies;
mod bushing;
mod checks;
mod fit;
mod forces;
mod gear;
mod joints;
mod matrices;
mod over_frequency;
mod parts;
pub(super) mod schema;
mod sensor;

pub(crate) use self::gear::axes_apart;
pub(super) use self::joints::stop;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;

use super::joined_machine::{Drive, InputForm, JoinedMachine, Load};
use super::joint::Joint;
use super::library::FileStore;
use super::machine::Materials;
use super::named_body::NamedBody;
use super::{gravity, ground, law, names};

/// Keys that make a file one of named bodies.
const NAMED: [&str; 4] = ["body", "joint", "drives", "loads"];
/// Keys of one shaft on one support, and of one mass.
const SHORT: [&str; 8] =
    ["shaft", "support", "springs", "bearing", "drive", "load", "mass", "stop"];

impl JoinedMachine {
    /// Whether a file is one of named bodies; none if it has short forms beside them, which has been noted.
    pub(super) fn is_in(file: &Table) -> Option<bool> {
        let named = NAMED.into_iter().find(|key| file.gives(key));
        let short = SHORT.into_iter().find(|key| file.gives(key));
        let (Some(named), Some(short)) = (named, short) else { return Some(named.is_some()) };
        let of_list = matches!(short, "bearing" | "load" | "stop");
        let heading = if of_list { format!("[[{short}]]") } else { format!("[{short}]") };
        let message = format!(
            "`{heading}` is a short form of a machine of its own, and `[{named}.NAME]` names bodies and joints: a file \
             has one form or the other"
        );
        let help = match short {
            "shaft" | "support" | "mass" => "describe it in a table `[body.NAME]`",
            "drive" => "describe it in a table `[drives.NAME]`",
            "load" => "describe it in a table `[loads.NAME]`",
            _ => "describe it in a table `[joint.NAME]`, with the values of `[springs]` in each",
        };
        file.push(file.written(short).error_here(Code::BAD_VALUE, message).help(help));
        // Which of both is meant, is open: neither is read as if it were.
        NAMED.iter().chain(&SHORT).chain(&["material"]).for_each(|key| file.pass_over(key));
        None
    }

    /// The machine, if all of it is right. `goes_on`: it has the speeds of another run.
    pub(super) fn read(store: FileStore, file: &Table, goes_on: bool) -> Option<JoinedMachine> {
        let before = file.errors();
        let materials = Materials::read(file);
        let (mut bodies, mut motions) = (Vec::new(), Vec::new());
        let joints = names::in_order(file, "joint");
        let thrust = joints
            .iter()
            .any(|(_, joint)| bushing::acts_along(joint) || law::acts_along(store, joint));
        for (name, table) in names::in_order(file, "body") {
            let read = table.read(|table| bodies::read(store, table, &name, (&materials, thrust)));
            bodies.push(read.body);
            motions.extend(read.motion);
        }
        if bodies.is_empty() && !file.has("body") {
            file.absent("body", "add a table `[body.NAME]` for each body of the machine");
        }
        let known: Vec<Located> = bodies.iter().map(|(name, _)| name.clone()).collect();
        let bodies: Option<Vec<NamedBody>> = bodies.into_iter().map(|(_, own)| own).collect();
        let turns = |body: usize| bodies.as_ref().map(|all| &all[body]);
        let labels: Vec<Located> = joints.iter().map(|(name, _)| name.clone()).collect();
        names::distinct(file, "body", &known);
        names::distinct(file, "joint", &labels);
        let joints = joints
            .into_iter()
            .map(|(name, table)| table.read(|table| joints::read(store, table, &name, &known)));
        let joints: Vec<Option<Joint>> = joints.collect();
        let drives = names::in_order(file, "drives");
        names::plain(file, "drive", drives.iter().map(|(name, _)| name));
        let drives = drives.into_iter().map(|(name, table)| {
            table.read(|table| forces::drive(store, table, &name, &known, turns, goes_on))
        });
        let drives: Vec<Option<Drive>> = drives.collect();
        let loads = names::in_order(file, "loads");
        names::plain(file, "load", loads.iter().map(|(name, _)| name));
        let loads = loads.into_iter();
        let loads = loads.map(|(name, table)| {
            table.read(|table| forces::load(store, table, &name, &known, turns))
        });
        let loads: Vec<Option<Load>> = loads.collect();
        let gravity = gravity::read(file);
        let ground = ground::read(store, file);
        let motion = checks::one_motion(file, motions);
        if file.errors() > before {
            return None;
        }
        let (mut bodies, joints) = (bodies?, joints.into_iter().collect::<Option<Vec<_>>>()?);
        gear::start(&mut bodies, &joints);
        let mut machine = JoinedMachine {
            bodies,
            joints,
            drives: drives.into_iter().collect::<Option<_>>()?,
            loads: loads.into_iter().collect::<Option<_>>()?,
            motion: motion?,
            gravity,
            ground,
            form: InputForm::Named,
        };
        machine.check(file, goes_on);
        along::place(file, &mut machine);
        Some(machine)
    }

    /// Notes what does not fit together.
    pub(super) fn check(&self, file: &Table, goes_on: bool) {
        checks::check(file, self, goes_on);
    }
}
