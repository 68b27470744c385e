//! Verification, validation and golden tests across the crates.
