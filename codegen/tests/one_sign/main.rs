//! One sign flipped anywhere in what computes a derivative, and the check of derivatives fails: the check
//! compares them with differences of the spec's own formula, and those of laws with slopes by dual numbers.

mod clearances;
mod films;
mod flip;
mod laws;
mod motions;
#[path = "../hostile/random.rs"]
#[allow(dead_code, reason = "the fuzzer uses the rest")]
mod random;
