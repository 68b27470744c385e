//! Formulas: parsed, checked, lowered, differentiated, evaluated, scheduled, run and printed.
#![no_main]

#[path = "../../codegen/tests/hostile/target.rs"]
#[allow(dead_code, reason = "the other target uses the rest")]
mod target;

libfuzzer_sys::fuzz_target!(|text: &str| {
    target::formula(text);
});
