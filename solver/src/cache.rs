//! Results of long computations kept on disk, found again by a hash of everything they depend on.
//!
//! A file that is not exactly what was stored under its key, down to the last bit, counts as not there.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;
use sha2::{Digest, Sha256};

/// First bytes of every file; another layout gets another number.
const MAGIC: &[u8] = b"whirl cache 1\n";
/// Bytes of a SHA-256.
const HASH: usize = 32;

/// What a stored value depends on, as a hash.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
        let bytes = fs::read(self.path(key)).ok()?;
        let rest = bytes.strip_prefix(MAGIC)?.strip_prefix(&key.0)?;
        let (checksum, value) = rest.split_at_checked(HASH)?;
        if checksum != hash(value) {
            return None;
        }
        postcard::from_bytes(value).ok()
    }

    /// Stores `value` under `key`. The file appears whole or not at all.
    ///
    /// # Errors
    /// The folder cannot be made or written.
    pub fn store(&self, key: &Key, value: &impl Serialize) -> io::Result<()> {
        let value = postcard::to_allocvec(value).map_err(io::Error::other)?;
        fs::create_dir_all(&self.folder)?;
        let partial = self.folder.join(format!("{}.{}.part", key.hex(), std::process::id()));
        let written = fs::File::create(&partial).and_then(|mut file| {
            file.write_all(MAGIC)?;
            file.write_all(&key.0)?;
            file.write_all(&hash(&value))?;
            file.write_all(&value)?;
            file.sync_all()
        });
        let stored = written.and_then(|()| fs::rename(&partial, self.path(key)));
        if stored.is_err() {
            let _ = fs::remove_file(&partial);
        }
        stored
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
    fn the_platform_folder_is_absolute() {
        let home = |name: &str| (name == "HOME").then(|| OsString::from("relative"));
        assert_eq!(platform_folder(home), None);
    }
}
