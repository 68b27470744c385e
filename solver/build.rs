//! Identifies the program to the cache: a hash of the sources from which bodies are reduced.

include!("sources.rs");

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    // Laws and cases are no part of a body; the case files that are built in lie in a folder of their own.
    let folders = [
        "codegen/src",
        "solver/src",
        "specs/src",
        "specs/elements",
        "specs/forms",
        "specs/motion",
        "codegen/text/src",
    ];
    let files =
        ["Cargo.lock", "Cargo.toml", "solver/build.rs", "solver/sources.rs", "specs/build.rs"];
    println!("cargo::rustc-env=WHIRL_REDUCTION_SOURCES={}", sources(&root, &folders, &files));
}
