//! Where the files of a case stand in a unit: as they stand to each other on the disk, below the folder that has all of them.

use std::path::{Component, Path, PathBuf};

use crate::errors::Failure;

/// The folder of the case among the resources.
pub(super) const CASE: &str = "case";

/// Paths in the unit of these files, in their order.
///
/// # Errors
/// A path that is no text.
pub(super) fn paths(files: &[PathBuf]) -> Result<Vec<String>, Failure> {
    let whole: Vec<PathBuf> = files.iter().map(|own| normal(own)).collect();
    let folder = |path: &Path| path.parent().unwrap_or(Path::new("")).to_path_buf();
    let root = whole.iter().map(|own| folder(own)).reduce(|a, b| shared(&a, &b));
    let root = root.unwrap_or_default();
    let within = |path: &PathBuf| {
        let below = path.strip_prefix(&root).expect("the folder is above all of them");
        let parts: Option<Vec<&str>> =
            below.components().map(|own| own.as_os_str().to_str()).collect();
        let Some(parts) = parts else {
            return Err(Failure::Argument {
                message: format!(
                    "`{}` cannot go into a unit: its name is no UTF-8",
                    path.display()
                ),
                help: "give it another name".to_owned(),
            });
        };
        Ok(format!("{CASE}/{}", parts.join("/")))
    };
    whole.iter().map(within).collect()
}

/// A path from the root, without `.` and `..`.
fn normal(path: &Path) -> PathBuf {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let mut own = PathBuf::new();
    for part in whole.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                own.pop();
            }
            part => own.push(part),
        }
    }
    own
}

/// What the beginnings of two paths have alike.
fn shared(a: &Path, b: &Path) -> PathBuf {
    let both = a.components().zip(b.components());
    both.take_while(|(a, b)| a == b).map(|(a, _)| a).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_stand_to_each_other_as_before() {
        let files = ["/a/cases/x.toml", "/a/cases/../common/y.toml", "/a/cases/./m/z.inp"];
        let found = paths(&files.map(PathBuf::from)).unwrap();
        assert_eq!(found, ["case/cases/x.toml", "case/common/y.toml", "case/cases/m/z.inp"]);
        assert_eq!(paths(&[PathBuf::from("/a/x.toml")]).unwrap(), ["case/x.toml"]);
    }
}
