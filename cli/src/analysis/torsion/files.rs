//! The tables of a train.

use std::fmt::Write;

use whirl_solver::linear::{Mode, Torque, Torsion};

use super::train::{Own, Train};
use crate::analysis::words;
use crate::errors::Failure;

impl Train<'_> {
    /// Modes over speeds.
    pub(super) fn rows(
        &self,
        torsion: &dyn Fn(&Mode) -> Result<Torsion, whirl_solver::Error>,
    ) -> Result<String, Failure> {
        let mut text = String::from(
            "speed_rpm,mode,frequency_hz,damping_ratio,log_decrement,torsional_share\n",
        );
        for (place, &speed) in self.campbell.speeds.iter().enumerate() {
            for (number, &branch) in self.branches.iter().enumerate() {
                let Some(mode) = &self.campbell.branches[branch][place] else { continue };
                let values = [mode.hertz(), mode.damping_ratio(), mode.log_decrement()];
                let values = values.map(|value| value.to_string()).join(",");
                let share = torsion(mode)?.share;
                writeln!(text, "{},{},{values},{share}", words::rpm(speed), number + 1)
                    .expect("text can be written");
            }
        }
        Ok(text)
    }

    /// Shapes of the modes at the speed of operation.
    pub(super) fn shapes(&self) -> String {
        let mut text = String::from(
            "mode,frequency_hz,damping_ratio,torsional_share,body,twist,share_of_torsion\n",
        );
        for (number, Own { mode, torsion }) in self.modes.iter().enumerate() {
            let values = [mode.hertz(), mode.damping_ratio(), torsion.share];
            let values = values.map(|value| value.to_string()).join(",");
            for (body, own) in self.linear.machine().bodies.iter().enumerate() {
                let twist = torsion.twists[body].map_or(String::new(), |own| own.to_string());
                let share = torsion.bodies[body];
                if own.rotation().is_some() {
                    writeln!(text, "{},{values},{},{twist},{share}", number + 1, own.name())
                        .expect("text can be written");
                }
            }
        }
        text
    }

    pub(super) fn interference(&self) -> String {
        let mut text = String::from(
            "what,excitation,order,mode,frequency_hz,speed_rpm,separation,within_margin\n",
        );
        for (number, excitation, own) in self.criticals() {
            let (order, hertz, rpm) = (excitation.order, own.mode.hertz(), words::rpm(own.speed));
            let margin = self.margin_of(own.speed);
            let close = if margin.abs() < self.margin { "yes" } else { "no" };
            writeln!(
                text,
                "critical speed,{},{order},{},{hertz},{rpm},{margin},{close}",
                excitation.name,
                number + 1
            )
            .expect("text can be written");
        }
        for (number, own) in self.modes.iter().enumerate() {
            for excitation in self.excitations {
                let Some(separation) = self.separation(&own.mode, excitation) else { continue };
                let close = if separation.abs() < self.margin { "yes" } else { "no" };
                let rpm = words::rpm(self.operation[1]);
                writeln!(
                    text,
                    "operation,{},{},{},{},{rpm},{separation},{close}",
                    excitation.name,
                    excitation.order,
                    number + 1,
                    own.mode.hertz()
                )
                .expect("text can be written");
            }
        }
        text
    }

    pub(super) fn torques(&self, all: &[Torque]) -> String {
        let mut text =
            String::from("joint,torque_on_first_Nm,torque_on_second_Nm,force_of_teeth_N\n");
        for own in all {
            let force = own.force.map_or(String::new(), |force| force.to_string());
            let [first, second] = own.torques;
            writeln!(text, "{},{first},{second},{force}", self.joint(own))
                .expect("text can be written");
        }
        text
    }
}
