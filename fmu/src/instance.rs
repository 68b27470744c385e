//! An instance of a unit: what is set, what it computes, where it stands. Nothing of C is here.

use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use whirl_cli::fmu::{Made, Role, Unit};
use whirl_solver::cache::{Key, pack, unpack};
use whirl_solver::dynamics::Checkpoint;

use crate::inputs::{LoadInput, SpeedInput};
use crate::running::Running;

/// Layout of states.
const LAYOUT: &str = "whirl unit state 2";

/// What is said of other bytes.
pub(crate) const NO_STATE: &str = "these bytes are no state of this unit";

/// Where an instance is in its life.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Phase {
    /// It can be set up.
    Instantiated,
    /// Its start is computed.
    Initializing,
    /// It takes steps.
    Stepping,
    /// A step could not be solved: what there is can be read.
    Failed,
    /// It is at its end.
    Terminated,
}

/// All that is set, and all that was computed.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Values {
    phase: Phase,
    /// Times of the start and of the end (s), as they are set up.
    begins: Option<f64>,
    ends: Option<f64>,
    /// Of parameters, in their order and units.
    parameters: Vec<f64>,
    loads: Vec<LoadInput>,
    speeds: Vec<SpeedInput>,
    /// Of the history, at the communication point.
    row: Vec<f64>,
}

/// An instance.
pub(crate) struct Instance {
    unit: Unit,
    /// The machine with the values of parameters with which it was made.
    made: (Vec<f64>, Arc<Made>),
    values: Values,
    running: Option<Running>,
    /// What there was to warn of, until it is told.
    pub(crate) warnings: Vec<String>,
}

/// Most time steps of a communication step.
const MOST_STEPS: f64 = 1e7;
/// How far a communication step may be from whole time steps, and a point from where the march is (time steps).
const NEAR: f64 = 1e-6;
const NEAR_POINT: f64 = 1e-3;

impl Instance {
    /// An instance of the unit in a folder of resources, of which the description has this token.
    ///
    /// # Errors
    /// Why it is none, in words.
    pub(crate) fn new(resources: &Path, token: &str) -> Result<Instance, String> {
        let unit = Unit::open(resources).map_err(|failure| failure.to_string())?;
        if unit.token() != token {
            return Err("the GUID is that of another unit than the one in this folder".to_owned());
        }
        let mut warnings = Vec::new();
        let parameters = unit.parameter_values();
        let made = unit.make(&parameters, &mut warnings).map_err(|own| own.to_string())?;
        let values = Values::new(&made, parameters.clone());
        let made = (parameters, Arc::new(made));
        Ok(Instance { unit, made, values, running: None, warnings })
    }

    pub(crate) fn phase(&self) -> Phase {
        self.values.phase
    }

    /// Time of the march (s).
    pub(crate) fn time(&self) -> f64 {
        self.running.as_ref().map_or(0.0, |own| own.march().time())
    }

    fn role(&self, reference: u32) -> Result<Role, String> {
        let all = self.made.1.variables();
        let own = all.get(reference as usize).map(|own| own.role);
        own.ok_or_else(|| format!("there is no variable with the value reference {reference}"))
    }

    fn name(&self, reference: u32) -> &str {
        self.made.1.variables().get(reference as usize).map_or("", |own| own.name.as_str())
    }

    /// The value of a variable.
    ///
    /// # Errors
    /// It has none, in words.
    pub(crate) fn get(&mut self, reference: u32) -> Result<f64, String> {
        Ok(match self.role(reference)? {
            Role::Load(load, axis) => self.values.loads[load].value[axis],
            Role::Speed(speed) => self.values.speeds[speed].value,
            Role::Parameter(parameter) => self.values.parameters[parameter],
            Role::Output(column) => {
                match self.values.phase {
                    Phase::Instantiated => {
                        let name = self.name(reference);
                        return Err(format!("`{name}` has no value before the initialization"));
                    }
                    Phase::Initializing => self.begin()?,
                    _ => {}
                }
                self.values.row[column]
            }
        })
    }

    /// Sets the values of variables: all, or none where one cannot be set.
    ///
    /// # Errors
    /// One that cannot be, in words.
    pub(crate) fn set(&mut self, references: &[u32], values: &[f64]) -> Result<(), String> {
        let pairs = || references.iter().copied().zip(values.iter().copied());
        pairs().try_for_each(|(reference, value)| self.may_be(reference, value))?;
        pairs().try_for_each(|(reference, value)| self.put(reference, value))
    }

    fn is_starting(&self) -> bool {
        matches!(self.phase(), Phase::Instantiated | Phase::Initializing)
    }

    fn may_be(&self, reference: u32, value: f64) -> Result<(), String> {
        let (role, starting) = (self.role(reference)?, self.is_starting());
        if !value.is_finite() {
            return Err(format!("`{}` cannot be {value}", self.name(reference)));
        }
        match role {
            Role::Output(_) => Err(format!("`{}` is an output", self.name(reference))),
            Role::Parameter(_) if !starting => {
                let name = self.name(reference);
                Err(format!("the parameter `{name}` is fixed once the unit is initialized"))
            }
            _ => Ok(()),
        }
    }

    fn put(&mut self, reference: u32, value: f64) -> Result<(), String> {
        match self.role(reference)? {
            Role::Output(_) => {}
            Role::Parameter(parameter) => self.values.parameters[parameter] = value,
            Role::Load(load, axis) => {
                let own = &mut self.values.loads[load];
                (own.value[axis], own.rate[axis], own.is_set[axis]) = (value, 0.0, true);
            }
            Role::Speed(speed) => {
                let own = &mut self.values.speeds[speed];
                (own.value, own.rate, own.is_set) = (value, 0.0, true);
            }
        }
        if self.is_starting() {
            self.running = None;
        }
        Ok(())
    }

    /// Sets the rate of an input over the next communication step (its unit, per second).
    ///
    /// # Errors
    /// It is no input, in words.
    pub(crate) fn set_rate(&mut self, reference: u32, rate: f64) -> Result<(), String> {
        let role = self.role(reference)?;
        if !rate.is_finite() {
            return Err(format!("the rate of `{}` cannot be {rate}", self.name(reference)));
        }
        match role {
            Role::Load(load, axis) => self.values.loads[load].rate[axis] = rate,
            Role::Speed(speed) => {
                let own = &mut self.values.speeds[speed];
                (own.rate, own.is_set) = (rate, true);
            }
            _ => return Err(format!("`{}` is no input", self.name(reference))),
        }
        Ok(())
    }

    /// Says when it starts, and when it ends if that is known (s).
    ///
    /// # Errors
    /// An end that is no time after the start, in words.
    pub(crate) fn set_up(&mut self, begins: f64, ends: Option<f64>) -> Result<(), String> {
        if let Some(ends) = ends.filter(|ends| !(ends.is_finite() && *ends >= begins)) {
            return Err(format!("the end at {ends} s is not after the start at {begins} s"));
        }
        (self.values.begins, self.values.ends) = (Some(begins), ends);
        Ok(())
    }

    /// Begins the initialization.
    ///
    /// # Errors
    /// A time of the start that is another than that of the unit, in words.
    pub(crate) fn initialize(&mut self) -> Result<(), String> {
        self.expect(Phase::Instantiated, "initialized")?;
        self.values.phase = Phase::Initializing;
        Ok(())
    }

    /// Ends the initialization: its start is computed.
    ///
    /// # Errors
    /// It cannot be, in words.
    pub(crate) fn initialized(&mut self) -> Result<(), String> {
        self.expect(Phase::Initializing, "let out of its initialization")?;
        self.begin()?;
        self.values.phase = Phase::Stepping;
        Ok(())
    }

    fn expect(&self, phase: Phase, done: &str) -> Result<(), String> {
        match self.values.phase == phase {
            true => Ok(()),
            false => Err(format!("a unit that is {:?} cannot be {done}", self.values.phase)),
        }
    }

    /// The machine with the parameters as they are set.
    fn make(&mut self) -> Result<Arc<Made>, String> {
        if self.made.0 != self.values.parameters {
            let made = self.unit.make(&self.values.parameters, &mut self.warnings);
            let made = made.map_err(|failure| failure.to_string())?;
            self.made = (self.values.parameters.clone(), Arc::new(made));
        }
        Ok(self.made.1.clone())
    }

    /// Computes the start with all that is set, where that is not done yet.
    fn begin(&mut self) -> Result<(), String> {
        if self.running.is_some() {
            return Ok(());
        }
        let made = self.make()?;
        let mut running =
            Running::new(&made, |own| own.begin()).map_err(|failure| failure.to_string())?;
        let begins = running.march().time();
        let near = NEAR_POINT * made.time_step();
        if let Some(wanted) = self.values.begins.filter(|own| !((own - begins).abs() <= near)) {
            return Err(format!("this unit starts at {begins} s, not at {wanted} s"));
        }
        let Values { loads, speeds, row, .. } = &mut self.values;
        // What was not set is as the case with these parameters has it.
        for (own, body) in speeds.iter_mut().zip(made.speeds()).filter(|(own, _)| !own.is_set) {
            own.value = made.speed_at_start(*body);
        }
        // What the march of the case has, it was not told.
        let mut amplitudes = Vec::new();
        for (own, group) in loads.iter_mut().zip(made.loads()) {
            own.untold(group.start);
            own.tell(group, &mut amplitudes);
        }
        running.with(|march| {
            march.tell(&amplitudes, &[]).map_err(|error| error.to_string())?;
            march.observe();
            row.clear();
            row.extend_from_slice(march.row());
            Ok::<(), String>(())
        })?;
        self.running = Some(running);
        Ok(())
    }

    /// Takes a communication step of `length` s from time `now` (s).
    ///
    /// # Errors
    /// One that is no whole number of time steps, or not from where the unit stands; a time step that does not converge, which is
    /// the last then. In words.
    pub(crate) fn step(&mut self, now: f64, length: f64) -> Result<(), String> {
        self.expect(Phase::Stepping, "advanced")?;
        let running = self.running.as_mut().expect("it was initialized");
        let made = running.made().clone();
        let dt = made.time_step();
        let at = running.march().time();
        if !((now - at).abs() <= NEAR_POINT * dt) {
            return Err(format!("the unit stands at {at} s, and the step begins at {now} s"));
        }
        let steps = whole_steps(length, dt)?;
        if let Some(ends) = self.values.ends.filter(|ends| now + length > ends + 0.5 * dt) {
            return Err(format!(
                "a communication step of {length:e} s from {now} s goes beyond the end at {ends} s"
            ));
        }
        let span = steps as f64 * dt;
        let Values { loads, speeds, row, phase, .. } = &mut self.values;
        let mut amplitudes = Vec::new();
        for (own, group) in loads.iter_mut().zip(made.loads()) {
            own.tell(group, &mut amplitudes);
        }
        let taken = running.with(|march| {
            let turns = speeds.iter().zip(made.speeds());
            let turns: Vec<_> =
                turns.filter_map(|(own, &body)| own.tell(march, body, span)).collect();
            march.tell(&amplitudes, &turns)?;
            (0..steps).try_for_each(|_| march.advance())?;
            row.copy_from_slice(march.row());
            Ok::<(), whirl_solver::Error>(())
        });
        if let Err(error) = taken {
            *phase = Phase::Failed;
            return Err(error.to_string());
        }
        loads.iter_mut().for_each(|own| own.pass(span));
        speeds.iter_mut().for_each(|own| own.pass(span));
        Ok(())
    }

    /// Ends it.
    ///
    /// # Errors
    /// It has not begun, in words.
    pub(crate) fn terminate(&mut self) -> Result<(), String> {
        match self.phase() {
            Phase::Stepping | Phase::Failed => {
                self.values.phase = Phase::Terminated;
                Ok(())
            }
            other => Err(format!("a unit that is {other:?} cannot be terminated")),
        }
    }

    /// Makes it as it was when it was new.
    ///
    /// # Errors
    /// Its machine cannot be made, in words.
    pub(crate) fn reset(&mut self) -> Result<(), String> {
        self.running = None;
        self.values.parameters = self.unit.parameter_values();
        let made = self.make()?;
        self.values = Values::new(&made, self.unit.parameter_values());
        Ok(())
    }

    /// Its state, in bytes.
    ///
    /// # Errors
    /// It cannot be written, in words.
    pub(crate) fn state(&self) -> Result<Vec<u8>, String> {
        let point = self.running.as_ref().map(|own| own.march().checkpoint());
        let packed = pack(&self.key(), &(&self.values, point));
        packed.map_err(|error| error.to_string())
    }

    /// Takes a state.
    ///
    /// # Errors
    /// It is none of this unit, in words.
    pub(crate) fn restore(&mut self, state: &[u8]) -> Result<(), String> {
        let kept: Option<(Values, Option<Checkpoint>)> = unpack(&self.key(), state);
        let (values, point) = kept.ok_or_else(|| NO_STATE.to_owned())?;
        self.running = None;
        self.values = values;
        if let Some(point) = point {
            let made = self.make()?;
            let running = Running::new(&made, |own| own.resume(point));
            self.running = Some(running.map_err(|failure| failure.to_string())?);
        }
        Ok(())
    }

    /// Whether these bytes are a state of this unit.
    pub(crate) fn knows(&self, state: &[u8]) -> bool {
        unpack::<(Values, Option<Checkpoint>)>(&self.key(), state).is_some()
    }

    fn key(&self) -> Key {
        Key::of(&(LAYOUT, whirl_cli::sources(), self.unit.token()))
    }
}

impl Values {
    fn new(made: &Made, parameters: Vec<f64>) -> Values {
        let start = |reference: &usize| made.speed_at_start(*reference);
        Values {
            phase: Phase::Instantiated,
            begins: None,
            ends: None,
            parameters,
            loads: made.loads().iter().map(|own| LoadInput::new(own.start)).collect(),
            speeds: made.speeds().iter().map(|body| SpeedInput::new(start(body))).collect(),
            row: vec![0.0; made.built().columns().len()],
        }
    }
}

/// Time steps in a communication step.
///
/// # Errors
/// Not a whole number of them, in words.
fn whole_steps(length: f64, dt: f64) -> Result<usize, String> {
    let ratio = length / dt;
    let steps = ratio.round();
    if ratio.is_finite() && steps > MOST_STEPS {
        return Err(format!(
            "a communication step of {length:e} s has more than {MOST_STEPS:e} time steps of {dt:e} s: take shorter ones"
        ));
    }
    if steps >= 1.0 && (ratio - steps).abs() <= NEAR {
        return Ok(steps as usize);
    }
    let [below, above] =
        [ratio.floor(), ratio.floor() + 1.0].map(|own| whirl_text::rounded(own * dt, 12));
    let other = match ratio > 0.0 && ratio.is_finite() {
        true if below > 0.0 => format!("{below:e} s or {above:e} s"),
        _ => format!("{dt:e} s, or a multiple of it"),
    };
    Err(format!(
        "a communication step of {length:e} s is no whole number of time steps of {dt:e} s: take {other}"
    ))
}

#[cfg(test)]
mod tests {
    use super::whole_steps;

    #[test]
    fn steps_are_whole_up_to_rounding() {
        assert_eq!(whole_steps(7.4e-5, 7.4e-5), Ok(1));
        assert_eq!(whole_steps(0.3 - 0.2, 1e-5), Ok(10_000));
        for bad in [0.0, -7.4e-5, 1e-4, f64::NAN, f64::INFINITY, 1e-9, 7.4e5, 1e300] {
            assert!(whole_steps(bad, 7.4e-5).is_err(), "{bad}");
        }
        let said = whole_steps(1e-4, 7.4e-5).unwrap_err();
        assert!(said.ends_with("take 7.4e-5 s or 1.48e-4 s"), "{said}");
    }
}
