//! What entries of all registries say: where they come from, and their variables.

/// Where an entry comes from.
#[derive(Debug, Clone, Copy)]
pub struct Origin {
    /// The name by which cases refer to it.
    pub name: &'static str,
    /// One line for people.
    pub title: &'static str,
    /// Paper and equation, standard, or book.
    pub source: &'static str,
    /// Path of the spec file inside this crate, such as `laws/hu2003-linear.toml`.
    pub spec: &'static str,
    /// The whole spec file.
    pub text: &'static str,
    /// Hash (hex) of the spec file and of everything else that its kernels were made from.
    pub hash: &'static str,
}

/// A named scalar with its unit, at the surface of a kernel.
#[derive(Debug, Clone, Copy)]
pub struct Variable {
    /// Symbol used in the spec, such as `h`.
    pub name: &'static str,
    /// SI unit in which the kernel takes or gives it, such as `m` or `m/s`.
    pub unit: &'static str,
    /// One line for people.
    pub title: &'static str,
}
