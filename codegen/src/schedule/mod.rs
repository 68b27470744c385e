//! From scalar expressions to straight-line code: sums factored where that saves operations, common
//! subexpressions shared, every value computed in the first stage that has what it needs.

mod program;
mod request;

pub use program::{
    Counts, Instruction, Operand, Operation, Program, ProgramInput, ProgramOutput, Stage,
};
pub use request::{Input, Output, Request, ScheduleError};
