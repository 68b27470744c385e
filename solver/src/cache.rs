//! Results of long computations kept on disk, found again by a hash of everything they depend on.
//!
//! A file that is not exactly what was stored under its key, down to the last bit, counts as not there.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// First bytes of every file; another layout gets another number.
const MAGIC: &[u8] = b"whirl cache 1\n";
/// Bytes of a SHA-256.
const HASH: usize = 32;

/// How names begin and end that files have until they are whole.
const ASIDE: [&str; 2] = [".whirl-", ".part"];
/// A file that is not whole after this time is one of a process that was killed: none takes so long to write.
pub const ABANDONED: Duration = Duration::from_secs(24 * 60 * 60);

/// Hash of the sources of everything that reduces bodies, dependencies and compiler included: values of another
/// program are not trusted, whether its changes are committed or not.
pub(crate) const PROGRAM: &str = env!("WHIRL_REDUCTION_SOURCES");

/// What a stored value depends on, as a hash.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Key([u8; HASH]);

impl Key {
    /// The key of everything in `dependencies`.
    ///
    /// # Panics
    /// If `dependencies` refuses to be serialised, which no type of this workspace does.
    pub fn of(dependencies: &impl Serialize) -> Key {
        let bytes = postcard::to_allocvec(dependencies).expect("plain data can be serialised");
        Key(hash(&bytes))
    }

    /// 64 hexadecimal digits.
    pub fn hex(&self) -> String {
        self.0.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

fn hash(bytes: &[u8]) -> [u8; HASH] {
    Sha256::digest(bytes).into()
}

/// A folder of stored values.
#[derive(Debug, Clone)]
pub struct Cache {
    folder: PathBuf,
}

impl Cache {
    /// The cache in `folder`, which is made when something is stored.
    pub fn new(folder: impl Into<PathBuf>) -> Cache {
        Cache { folder: folder.into() }
    }

    /// The cache in the platform's folder for such files; `None` if the environment names none.
    pub fn of_platform() -> Option<Cache> {
        platform_folder(|name| env::var_os(name)).map(|folder| Cache::new(folder.join("whirl")))
    }

    /// Where values are stored.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn path(&self, key: &Key) -> PathBuf {
        self.folder.join(format!("{}.bin", key.hex()))
    }

    /// The value stored under `key`; `None` if there is none, or one that is damaged.
    pub fn load<T: DeserializeOwned>(&self, key: &Key) -> Option<T> {
        unpack(key, &fs::read(self.path(key)).ok()?)
    }

    /// Stores `value` under `key`. The file appears whole or not at all, whoever else stores or loads it.
    ///
    /// # Errors
    /// The folder cannot be made or written.
    pub fn store(&self, key: &Key, value: &impl Serialize) -> io::Result<()> {
        let bytes = pack(key, value)?;
        fs::create_dir_all(&self.folder)?;
        remove_unfinished(&self.folder, ABANDONED);
        write_whole(&self.path(key), &bytes)
    }
}

/// A value under its key, with a checksum.
///
/// # Errors
/// The value refuses to be serialised.
pub fn pack(key: &Key, value: &impl Serialize) -> io::Result<Vec<u8>> {
    let value = postcard::to_allocvec(value).map_err(io::Error::other)?;
    Ok([MAGIC, &key.0, &hash(&value), &value].concat())
}

/// The value that was packed under `key`; `None` for bytes that are damaged or have another key.
pub fn unpack<T: DeserializeOwned>(key: &Key, bytes: &[u8]) -> Option<T> {
    let rest = bytes.strip_prefix(MAGIC)?.strip_prefix(&key.0)?;
    let (checksum, value) = rest.split_at_checked(HASH)?;
    if checksum != hash(value) {
        return None;
    }
    postcard::from_bytes(value).ok()
}

/// Writes a file that appears under its name whole or not at all; an older one stays until then.
///
/// # Errors
/// It cannot be written; nothing is left of it then.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_aside(path, bytes)?()
}

/// Writes a file under a name that nobody else has, beside `path`; what is given back moves it there. It is removed
/// if that is dropped.
///
/// # Errors
/// It cannot be written.
pub fn write_aside(
    path: &Path,
    bytes: &[u8],
) -> io::Result<impl FnOnce() -> io::Result<()> + use<>> {
    write_aside_by(path, &mut |file| file.write_all(bytes))
}

/// As [`write_aside`], of a file that `write` fills.
///
/// # Errors
/// As there, and what `write` fails with.
pub fn write_aside_by(
    path: &Path,
    write: &mut dyn FnMut(&mut fs::File) -> io::Result<()>,
) -> io::Result<impl FnOnce() -> io::Result<()> + use<>> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut aside = tempfile::Builder::new();
    aside.prefix(ASIDE[0]).suffix(ASIDE[1]);
    #[cfg(unix)]
    let mode: fs::Permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    // What the user's mask leaves of it, as for any other file.
    #[cfg(unix)]
    aside.permissions(mode);
    let mut file = aside.tempfile_in(folder.unwrap_or_else(|| Path::new(".")))?;
    write(file.as_file_mut())?;
    file.as_file().sync_all()?;
    let path = path.to_path_buf();
    Ok(move || file.persist(path).map(|_| ()).map_err(|error| error.error))
}

/// Removes the files in `folder` that [`write_aside`] wrote `age` ago or earlier and that have not got their names:
/// what a process leaves that is killed. One that cannot be removed stays.
pub fn remove_unfinished(folder: &Path, age: Duration) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let modified = entry.metadata().and_then(|found| found.modified());
        // A time in the future, by another machine's clock, is no age.
        let old = modified.is_ok_and(|time| time.elapsed().unwrap_or_default() >= age);
        if name.starts_with(ASIDE[0]) && name.ends_with(ASIDE[1]) && old {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// XDG on Unix, `Library/Caches` on macOS, `LOCALAPPDATA` on Windows.
fn platform_folder(variable: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    let folder = |name: &str| variable(name).map(PathBuf::from).filter(|path| path.is_absolute());
    if cfg!(windows) {
        folder("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        folder("HOME").map(|home| home.join("Library/Caches"))
    } else {
        folder("XDG_CACHE_HOME").or_else(|| folder("HOME").map(|home| home.join(".cache")))
    }
}

/// Processor and those of its instructions on which the bits of results depend.
pub fn instruction_set() -> String {
    let mut words = vec![env::consts::ARCH];
    #[cfg(target_arch = "x86_64")]
    {
        let found = [
            ("avx2", is_x86_feature_detected!("avx2")),
            ("fma", is_x86_feature_detected!("fma")),
            ("avx512f", is_x86_feature_detected!("avx512f")),
        ];
        words.extend(found.iter().filter(|(_, here)| *here).map(|(name, _)| *name));
    }
    words.join("+")
}

#[cfg(test)]
mod tests {
    use std::fs::File;
    use std::time::SystemTime;

    use super::*;

    fn cache(name: &str) -> Cache {
        let folder = format!("whirl-cache-test-{name}-{}", std::process::id());
        let cache = Cache::new(env::temp_dir().join(folder));
        let _ = fs::remove_dir_all(cache.folder());
        cache
    }

    #[test]
    fn what_was_stored_is_found_under_its_key_only() {
        let cache = cache("found");
        let (key, other) = (Key::of(&("mesh", 1.0)), Key::of(&("mesh", 1.0 + f64::EPSILON)));
        let value = vec![1.0, -0.0, 1e300];
        assert_eq!(cache.load::<Vec<f64>>(&key), None);
        cache.store(&key, &value).unwrap();
        assert_eq!(cache.load(&key), Some(value));
        assert_eq!(cache.load::<Vec<f64>>(&other), None);
        fs::copy(cache.path(&key), cache.path(&other)).unwrap();
        assert_eq!(cache.load::<Vec<f64>>(&other), None);
        fs::remove_dir_all(cache.folder()).unwrap();
    }

    #[test]
    fn a_damaged_file_counts_as_absent_and_is_replaced() {
        let cache = cache("damaged");
        let key = Key::of(&"key");
        cache.store(&key, &vec![7u64; 20]).unwrap();
        let whole = fs::read(cache.path(&key)).unwrap();
        for at in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] ^= 1;
            fs::write(cache.path(&key), &damaged).unwrap();
            assert_eq!(cache.load::<Vec<u64>>(&key), None, "byte {at}");
            fs::write(cache.path(&key), &whole[..at]).unwrap();
            assert_eq!(cache.load::<Vec<u64>>(&key), None, "cut at {at}");
        }
        cache.store(&key, &vec![7u64; 20]).unwrap();
        assert_eq!(cache.load(&key), Some(vec![7u64; 20]));
        assert_eq!(fs::read_dir(cache.folder()).unwrap().count(), 1);
        fs::remove_dir_all(cache.folder()).unwrap();
    }

    #[test]
    fn many_may_store_and_load_the_same_value_at_once() {
        let cache = cache("many");
        let (key, value) = (Key::of(&"key"), vec![7u64; 5000]);
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..25 {
                        cache.store(&key, &value).unwrap();
                        assert_eq!(cache.load(&key).as_ref(), Some(&value));
                    }
                });
            }
        });
        assert_eq!(fs::read_dir(cache.folder()).unwrap().count(), 1, "no partial files are left");
        fs::remove_dir_all(cache.folder()).unwrap();
    }

    #[test]
    fn what_killed_processes_left_goes_and_what_others_write_stays() {
        let cache = cache("abandoned");
        fs::create_dir_all(cache.folder()).unwrap();
        let file = |name: &str| File::create(cache.folder().join(name)).unwrap();
        let old = SystemTime::now() - ABANDONED - Duration::from_secs(60);
        file(".whirl-old.part").set_modified(old).unwrap();
        file("whirl-notes.part").set_modified(old).unwrap();
        let being_written = write_aside(&cache.folder().join("other"), b"new").unwrap();
        cache.store(&Key::of(&"key"), &1).unwrap();
        being_written().unwrap();
        let entries = fs::read_dir(cache.folder()).unwrap();
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        let stored = OsString::from(format!("{}.bin", Key::of(&"key").hex()));
        let mut expected = [stored, "other".into(), "whirl-notes.part".into()];
        expected.sort();
        assert_eq!(names, expected);
        fs::remove_dir_all(cache.folder()).unwrap();
    }

    #[test]
    fn what_cannot_be_written_leaves_the_older_file() {
        let cache = cache("older");
        fs::create_dir_all(cache.folder().join("taken")).unwrap();
        assert!(write_whole(&cache.folder().join("taken"), b"new").is_err());
        assert!(write_whole(&cache.folder().join("absent/file"), b"new").is_err());
        write_whole(&cache.folder().join("file"), b"new").unwrap();
        assert_eq!(fs::read_dir(cache.folder()).unwrap().count(), 2);
        fs::remove_dir_all(cache.folder()).unwrap();
    }

    mod build {
        include!("../sources.rs");

        pub(super) fn of(root: &Path) -> String {
            sources(root, &["src"], &["lock"])
        }
    }

    #[test]
    fn the_program_is_another_with_every_change_of_its_sources() {
        let root = tempfile::tempdir().unwrap();
        let source = root.path().join("src/deep/part.rs");
        fs::create_dir_all(source.parent().unwrap()).unwrap();
        let mut seen = vec![build::of(root.path())];
        let mut changed = |what: &str| {
            let hash = build::of(root.path());
            assert_eq!(hash, build::of(root.path()), "{what}");
            assert!(!seen.contains(&hash), "{what}");
            seen.push(hash);
        };
        fs::write(&source, "let x = 1;").unwrap();
        changed("a new file");
        fs::write(&source, "let x = 2;").unwrap();
        changed("another text of the same length");
        fs::rename(&source, source.with_file_name("other.rs")).unwrap();
        changed("another name");
        fs::write(root.path().join("lock"), "faer 1").unwrap();
        changed("another dependency");
        assert_eq!(PROGRAM.len(), 64);
    }

    #[test]
    fn the_platform_folder_is_absolute() {
        let home = |name: &str| (name == "HOME").then(|| OsString::from("relative"));
        assert_eq!(platform_folder(home), None);
    }
}
