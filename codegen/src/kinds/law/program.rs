//! The program that computes a law.

use super::{LawInput, LawSpec};
use crate::schedule::{Input, Output, Program, Request, ScheduleError, Stage, schedule};

impl LawSpec {
    /// The program of the law, of one stage: inputs in the order of the file, then states, in SI; for every output o, then
    /// for the rate of every state, the outputs o, do_dinput₀, do_dinput₁, …. Kernels are emitted from it, and a
    /// [`Tape`](crate::tape::Tape) of it gives the same bits.
    ///
    /// # Errors
    /// None for a law that was read without errors and stays within the bounds of the graph.
    pub fn program(&self) -> Result<Program, ScheduleError> {
        let mut outputs = Vec::new();
        for output in &self.outputs {
            outputs.push(Output { name: output.name.clone(), expression: output.value });
            for (input, derivative) in self.inputs.iter().zip(&output.derivatives) {
                let name = format!("d{}_d{}", output.name, input.name);
                outputs.push(Output { name, expression: *derivative });
            }
        }
        let request = Request {
            stages: vec![Stage::new("spring", &[], 1.0)],
            inputs: self.inputs.iter().map(input).collect(),
            outputs,
            names: Vec::new(),
        };
        schedule(&mut self.graph.clone(), &request)
    }

    /// What of [`LawSpec::program`] gives the outputs alone, to the same bits: neither derivatives nor rates of states.
    pub fn forces_of(&self, program: &Program) -> Program {
        program.restricted(|name| self.given().iter().any(|output| output.name == name))
    }

    /// The program of the energy that the law stores (J), from its inputs and states; none if it does not say so.
    ///
    /// # Errors
    /// As [`LawSpec::program`].
    pub fn stored_program(&self) -> Result<Option<Program>, ScheduleError> {
        let Some(stored) = &self.stored else { return Ok(None) };
        let request = Request {
            stages: vec![Stage::new("spring", &[], 1.0)],
            inputs: self.inputs.iter().map(input).collect(),
            outputs: vec![Output { name: "stored".to_owned(), expression: stored.value }],
            names: Vec::new(),
        };
        schedule(&mut self.graph.clone(), &request).map(Some)
    }

    /// The program of the measures of [`LawSpec::valid`], in their order, SI, from the inputs of the law; none if
    /// there are none.
    ///
    /// # Errors
    /// As [`LawSpec::program`].
    pub fn measures_program(&self) -> Result<Option<Program>, ScheduleError> {
        if self.valid.is_empty() {
            return Ok(None);
        }
        let outputs = self
            .valid
            .iter()
            .map(|own| Output { name: format!("measure_{}", own.name), expression: own.value });
        let request = Request {
            stages: vec![Stage::new("spring", &[], 1.0)],
            inputs: self.inputs.iter().map(input).collect(),
            outputs: outputs.collect(),
            names: Vec::new(),
        };
        schedule(&mut self.graph.clone(), &request).map(Some)
    }
}

fn input(input: &LawInput) -> Input {
    Input { name: input.name.clone(), symbol: input.symbol, stage: 0 }
}
