//! Generated code: its text, its bits against the tape, its values against direct evaluation, the
//! derivatives of clearance and motion, and specs dropped into the folders.

mod bits;
mod clearance;
mod contact;
mod dropped;
mod golden;
mod hostile_names;
mod hyper;
mod motion;
mod random;
mod registers;
mod skeletons;
mod workspace;
