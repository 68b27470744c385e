//! What a schedule is asked for, and why it can be refused.

use super::program::Stage;
use crate::expression::Id;

/// A symbol that the program takes as an input.
#[derive(Debug, Clone)]
pub struct Input {
    /// Its name in the program.
    pub name: String,
    /// The scalar symbol.
    pub symbol: Id,
    /// Stage at which it is known.
    pub(crate) stage: usize,
}

/// An expression that the program computes.
#[derive(Debug, Clone)]
pub struct Output {
    /// Its name in the program.
    pub name: String,
    /// The scalar expression.
    pub(crate) expression: Id,
}

/// What to schedule.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// Stages in the order in which they run; the last sees all others that inputs name.
    pub(crate) stages: Vec<Stage>,
    /// Every symbol of the outputs, each at its stage.
    pub inputs: Vec<Input>,
    /// Outputs.
    pub outputs: Vec<Output>,
    /// Names for expressions inside, such as the definitions of a spec.
    pub(crate) names: Vec<(Id, String)>,
}

impl Request {
    /// A request with one stage, which runs once for every set of inputs.
    pub fn flat(inputs: &[(&str, Id)], outputs: &[(&str, Id)]) -> Self {
        Request {
            stages: vec![Stage::new("all", &[], 1.0)],
            inputs: inputs
                .iter()
                .map(|(name, symbol)| Input { name: name.to_string(), symbol: *symbol, stage: 0 })
                .collect(),
            outputs: outputs
                .iter()
                .map(|(name, expression)| Output {
                    name: name.to_string(),
                    expression: *expression,
                })
                .collect(),
            names: Vec::new(),
        }
    }
}

/// Why an expression cannot be scheduled.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ScheduleError {
    /// A symbol that is no input.
    #[error("`{symbol}` is used in `{output}` but is not among the inputs")]
    Unbound {
        /// The symbol.
        symbol: String,
        /// The first output that uses it.
        output: String,
    },
    /// Something that is not made of scalars.
    #[error("`{output}` contains a vector or matrix; only scalars are scheduled")]
    NotScalar {
        /// The output.
        output: String,
    },
    /// No stage sees all that an expression needs.
    #[error("`{output}` needs values of stages that no stage sees together")]
    NoStage {
        /// The output.
        output: String,
    },
    /// The graph grew past its bounds.
    #[error("the expressions grow past the bounds on numbers and nodes")]
    Exceeded,
    /// A pass changed the value of an output: a defect of the generator.
    #[error("rewriting `{output}` changed its value; this is a defect of the generator")]
    MeaningChanged {
        /// The output.
        output: String,
    },
}
