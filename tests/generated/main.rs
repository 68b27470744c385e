//! Generated code: its text, its bits against the tape, its values against direct evaluation, and the
//! clearance's derivatives.

mod bits;
mod clearance;
mod golden;
mod hyper;
mod motion;
mod random;
