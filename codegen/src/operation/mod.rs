//! What is done to scalars: operations, functions, and the numbers over which they have values.

mod bytecode;
mod function;
mod number;
mod rounding;

pub(crate) use bytecode::Bytecode;
pub use bytecode::{Operand, Operation, Relation};
pub use function::{Arithmetic, Function, Parity};
pub use number::{Dual, Number};
pub use rounding::Rounded;
