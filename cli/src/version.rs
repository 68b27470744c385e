//! Which program this is.

/// Version of the package.
pub(crate) const PACKAGE: &str = env!("CARGO_PKG_VERSION");

/// Commit from which the program was built, if the build knew it.
pub(crate) const COMMIT: Option<&str> = option_env!("WHIRL_COMMIT");

/// Hash of all sources of the program, committed or not, and of the compiler.
pub(crate) const SOURCES: &str = env!("WHIRL_SOURCES");

/// Version and commit, for `--version`.
pub(crate) const LONG: &str = env!("WHIRL_VERSION");
