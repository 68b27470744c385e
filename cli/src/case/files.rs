//! What a case is made of: files beside its texts, and all values of these.

use std::path::{Path, PathBuf};

use whirl_codegen::diagnostic::Diagnostics;
use whirl_codegen::document::tree::Node;

use super::library::{FileStore, load};
use super::named_body::Form;
use super::rotor::Mesh;
use super::start::Start;
use super::{Case, CaseText};

impl Case {
    /// Files of which its bodies are made: meshes and matrices.
    pub(crate) fn other_files(&self) -> Vec<PathBuf> {
        let mut all = Vec::new();
        for body in &self.machine.bodies {
            let Form::Meshed(own) = &body.form else { continue };
            match &own.body.mesh {
                Mesh::File(file) => all.push(file.path.clone()),
                Mesh::Matrices(files) => all.extend(files.request.paths()),
                Mesh::Generated(_) => {}
            }
        }
        all
    }

    /// The folder of results of the run from which it goes on, if it does.
    pub(crate) fn goes_on_from(&self) -> Option<&Path> {
        match &self.start {
            Start::State(folder) => Some(Path::new(folder.text())),
            _ => None,
        }
    }
}

impl CaseText {
    /// All values of the case and of what it includes, by their keys as they are varied: `load.2.force` is that of the second of
    /// several `[[load]]`.
    ///
    /// # Errors
    /// Files that cannot be read or are no TOML.
    pub(crate) fn values_by_key(&self) -> Result<Vec<(String, Node)>, Diagnostics> {
        let (tree, _) = load(FileStore::Given(self), self.path(), None)?;
        let mut all = Vec::new();
        tree.each(&mut |key, node| all.push((counted(&key), node.clone())));
        Ok(all)
    }
}

/// `load[1].force` as `load.2.force`.
fn counted(key: &str) -> String {
    let mut parts = key.split('[');
    let mut all = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        match part.split_once(']').map(|(count, rest)| (count.parse::<usize>(), rest)) {
            Some((Ok(count), rest)) => all += &format!(".{}{rest}", count + 1),
            _ => all += &format!("[{part}"),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_of_lists_count_from_one() {
        let pairs = [("load[0].force", "load.1.force"), ("a.b", "a.b"), ("x[9]", "x.10")];
        for (key, expected) in pairs {
            assert_eq!(counted(key), expected);
        }
    }
}
