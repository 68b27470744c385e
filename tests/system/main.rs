//! The reference system from its shipped case files, run by the binary as a user runs it: against the
//! histories of an independent program, and against what the paper says of its results.

mod automatic;
mod full_newton;
mod histories;
mod paper;
mod run;
mod summary;
mod validity;
