//! How the shared library is linked.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        // Without symbols that nobody asks for.
        println!("cargo::rustc-cdylib-link-arg=-Wl,--strip-all");
        // Threads that reduce bodies outlive the last unit: what they run must stay where it is.
        println!("cargo::rustc-cdylib-link-arg=-Wl,-z,nodelete");
    }
}
