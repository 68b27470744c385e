//! The text of the generated kernels, for people who want to read it.

use crate::{CLEARANCES, ELEMENTS, FILMS, FORMS, LAWS, MOTIONS, Origin};

/// Folder that held the generated files when this crate was built.
pub const FOLDER: &str = env!("OUT_DIR");

macro_rules! registries {
    ($($name:literal: $origins:expr,)*) => {
        /// Generated files: name, and the whole text.
        pub const FILES: &[(&str, &str)] = &[$((
            concat!($name, ".rs"),
            include_str!(concat!(env!("OUT_DIR"), "/", $name, ".rs")),
        )),*];

        /// Where the entries of every registry come from, by the name of its module.
        pub fn registries() -> Vec<(&'static str, Vec<&'static Origin>)> {
            vec![$(($name, $origins.collect())),*]
        }
    };
}

registries! {
    "laws": LAWS.iter().map(|law| &law.origin),
    "elements": ELEMENTS.iter().map(|element| &element.origin),
    "forms": FORMS.iter(),
    "motions": MOTIONS.iter().map(|motion| &motion.origin),
    "clearances": CLEARANCES.iter().map(|clearance| &clearance.origin),
    "films": FILMS.iter().map(|film| &film.origin),
}

/// The module made from a spec.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Module {
    /// Module of its kind, such as `laws`.
    pub kind: &'static str,
    /// Its own name, such as `hu2003_linear`.
    pub name: &'static str,
    /// The generated file, such as `laws.rs`.
    pub file: &'static str,
    /// Line of the file where the text begins, from 1.
    pub line: usize,
    /// Documentation and code.
    pub text: &'static str,
}

/// The module made from the spec file at `path`, such as `laws/hu2003-linear.toml`.
pub fn module(path: &str) -> Option<Module> {
    let origin = format!("spec: {path:?},");
    FILES.iter().find_map(|&(file, text)| {
        modules(text).find(|(_, module)| module.contains(&origin)).and_then(|(start, module)| {
            let head = module.lines().find_map(|line| line.strip_prefix("pub mod "))?;
            Some(Module {
                kind: file.strip_suffix(".rs")?,
                name: head.split_whitespace().next()?,
                file,
                line: 1 + text[..start].matches('\n').count(),
                text: module,
            })
        })
    })
}

/// The modules of a generated file with their places: each ends with the first brace at the margin.
fn modules(text: &'static str) -> impl Iterator<Item = (usize, &'static str)> {
    const END: &str = "\n}\n";
    let mut start = 0;
    std::iter::from_fn(move || {
        let rest = &text[start..];
        let end = rest.find(END)? + END.len();
        let found = (start, &rest[..end]);
        start += end;
        Some(found)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_of_the_registries_has_its_module() {
        for origin in registries().into_iter().flat_map(|(_, origins)| origins) {
            let module = module(origin.spec).unwrap_or_else(|| panic!("{} has none", origin.spec));
            assert!(module.text.contains(&format!("hash: {:?},", origin.hash)), "{}", origin.spec);
            assert!(module.text.starts_with("///"), "{}", module.text);
            assert_eq!(module.text.matches("\npub mod ").count(), 1, "{}", origin.spec);
            let (_, text) = FILES.iter().find(|(file, _)| *file == module.file).unwrap();
            let line = text.lines().nth(module.line - 1).unwrap();
            assert_eq!(line, module.text.lines().next().unwrap());
        }
        assert_eq!(module("laws/no-such-law.toml"), None);
    }
}
