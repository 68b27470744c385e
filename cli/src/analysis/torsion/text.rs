//! A train in words.

use std::fmt::Write;

use whirl_solver::linear::{Node, Torque, Torsion};
use whirl_text::{rounded, shown};

use super::train::{Own, Train};
use crate::analysis::words;
use crate::report::table;

impl Train<'_> {
    pub(super) fn text(&self, torques: &[Torque]) -> String {
        let mut text = format!("{}: {}\n", self.case.name, self.case.title);
        let range = match self.operation {
            [first, last] if first == last => format!("{} rpm", words::speed(last)),
            [first, last] => format!("{} to {} rpm", words::speed(first), words::speed(last)),
        };
        let _ = writeln!(text, "torsion over the speed of {}; in operation {range}\n", self.body());
        let head = ["mode", "frequency (Hz)", "damping ratio", "torsion", "turns", "nodes in"];
        let mut rows = vec![head.map(str::to_owned).to_vec()];
        for (number, Own { mode, torsion }) in self.modes.iter().enumerate() {
            rows.push(vec![
                (number + 1).to_string(),
                words::hertz(mode),
                words::damping(mode),
                format!("{} %", rounded(100.0 * torsion.share, 3)),
                words::most(self.linear, &torsion.bodies),
                self.nodes(torsion),
            ]);
        }
        match self.modes.is_empty() {
            true => text.push_str(
                "no mode of torsion among those that were looked for: its bodies turn as one. Join bodies that turn by couplings or \
                 gears with a stiffness about the axis, give them meshes or tables of sections that twist, or raise `count`\n",
            ),
            false => text.push_str(&table(&rows)),
        }
        text.push('\n');
        let criticals = self.criticals();
        if criticals.is_empty() {
            text.push_str("no torsional critical speed in this range\n");
        } else {
            let head =
                ["critical speed (rpm)", "excitation", "mode", "frequency (Hz)", "margin", ""];
            let mut rows = vec![head.map(str::to_owned).to_vec()];
            for (number, excitation, own) in criticals {
                let margin = self.margin_of(own.speed);
                rows.push(vec![
                    words::speed(own.speed),
                    excitation.name.clone(),
                    (number + 1).to_string(),
                    words::hertz(&own.mode),
                    format!("{} %", rounded(100.0 * margin, 3)),
                    if margin.abs() < self.margin { "CLOSE" } else { "" }.to_owned(),
                ]);
            }
            text.push_str(&table(&rows));
        }
        text.push('\n');
        let percent = rounded(100.0 * self.margin, 6);
        for (number, excitation, separation) in self.close() {
            let _ = writeln!(
                text,
                "CLOSE: mode {} is {} % from {} in operation, less than {percent} %",
                number + 1,
                rounded(100.0 * separation.abs(), 3),
                excitation.name
            );
        }
        if self.close().is_empty() {
            let _ = writeln!(
                text,
                "all modes are {percent} % and more from all excitations in operation"
            );
        }
        if !torques.is_empty() {
            let head = ["static torque", "on the first (N·m)", "on the second (N·m)", "teeth (N)"];
            let mut rows = vec![head.map(str::to_owned).to_vec()];
            let value =
                |own: f64| if own.abs() < 1e-9 { "0".to_owned() } else { shown(own, 6, 1e-3..1e7) };
            for own in torques {
                let force = own.force.map_or(String::new(), value);
                rows.push(vec![
                    self.joint(own).to_owned(),
                    value(own.torques[0]),
                    value(own.torques[1]),
                    force,
                ]);
            }
            text.push('\n');
            text.push_str(&table(&rows));
        }
        // Without backlash one line of action carries both ways: the one that the sign names pushes for a force of that sign.
        let pulls = torques.iter().filter(|own| {
            let gears = self.gears(own);
            let alpha = gears.filter(|own| !own.backlash).map(|own| own.pressure_angle);
            alpha.zip(own.force).is_some_and(|(alpha, force)| force * alpha.signum() < -1e-6)
        });
        for own in pulls {
            let _ = writeln!(
                text,
                "note: the teeth of {} would pull: the torque is carried by their other flank, along another line; change the sign of its \
                 `pressure_angle`",
                self.joint(own)
            );
        }
        text
    }

    fn nodes(&self, torsion: &Torsion) -> String {
        let name = |node: &Node| match node {
            Node::Joint(place) => self.case.machine.joints[*place].name.text(),
            Node::Body(place) => self.linear.machine().bodies[*place].name(),
        };
        let names: Vec<&str> = torsion.nodes.iter().map(name).collect();
        names.join(", ")
    }
}
