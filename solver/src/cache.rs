//! Results of long computations kept on disk or in memory, found again by a hash of everything they depend on.
//!
//! A file that is not exactly what was stored under its key, down to the last bit, counts as not there.

mod key;
mod memory;

use std::env;
use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;

use self::key::{HASH, hash};
pub use self::key::{Key, RunningKey};
use self::memory::{Memory, lock};

/// First bytes of every file; another layout gets another number.
const MAGIC: &[u8] = b"whirl cache 1\n";
/// How names begin and end that files have until they are whole.
const ASIDE: [&str; 2] = [".whirl-", ".part"];
/// A file that is not whole after this time is one of a process that was killed: none takes so long to write.
pub const ABANDONED: Duration = Duration::from_secs(24 * 60 * 60);

/// Hash of the sources of everything that reduces bodies, dependencies and compiler included: values of another
/// program are not trusted, whether its changes are committed or not.
pub(crate) const PROGRAM: &str = env!("WHIRL_REDUCTION_SOURCES");

/// Stored values: in a folder, in the memory of this process, or in both.
#[derive(Debug, Clone)]
pub struct Cache {
    folder: Option<PathBuf>,
    /// Shared by all clones.
    memory: Option<Arc<Memory>>,
}

/// A value, and how it was come by.
#[derive(Debug)]
pub struct Found<T> {
    /// The value.
    pub value: T,
    /// Whether it was there.
    pub cached: bool,
    /// Why it could not be kept on disk.
    pub unkept: Option<io::Error>,
}

impl Cache {
    /// The cache in `folder`, which is made when something is stored.
    pub fn new(folder: impl Into<PathBuf>) -> Cache {
        Cache { folder: Some(folder.into()), memory: None }
    }

    /// The cache in the platform's folder for such files; `None` if the environment names none.
    pub fn of_platform() -> Option<Cache> {
        platform_folder(|name| env::var_os(name)).map(|folder| Cache::new(folder.join("whirl")))
    }

    /// A cache whose values stay in memory, too, for as long as it or a clone of it lives; in memory only where there is no
    /// `other`. What several threads need at once is made by one of them.
    ///
    /// Those threads must not be workers of rayon's global pool: one that waits there for another's factorisation may be
    /// given a task that waits for the value that it is making itself.
    pub fn shared(other: Option<Cache>) -> Cache {
        Cache { folder: other.and_then(|own| own.folder), memory: Some(Arc::default()) }
    }

    /// Where values are stored, if on disk.
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    fn path(&self, key: &Key) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(format!("{}.bin", key.hex())))
    }

    /// The value stored under `key`; `None` if there is none, or one that is damaged.
    pub fn load<T: DeserializeOwned>(&self, key: &Key) -> Option<T> {
        let held = self.memory.as_ref().and_then(|memory| lock(&memory.slot(key)).clone());
        let held = held.and_then(|bytes| unpack(key, &bytes));
        held.or_else(|| unpack(key, &fs::read(self.path(key)?).ok()?))
    }

    /// The value stored under `key`, or the one that `make` makes, which is stored then.
    ///
    /// # Errors
    /// As `make`; the next one that needs it tries again.
    pub fn load_or_make<T: Serialize + DeserializeOwned, E>(
        &self,
        key: &Key,
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<Found<T>, E> {
        let Some(memory) = &self.memory else {
            if let Some(value) = self.load(key) {
                return Ok(Found { value, cached: true, unkept: None });
            }
            let value = make()?;
            let unkept = self.store(key, &value).err();
            return Ok(Found { value, cached: false, unkept });
        };
        let slot = memory.slot(key);
        let mut held = lock(&slot);
        if held.is_none() {
            *held = self.path(key).and_then(|path| Some(fs::read(path).ok()?.into()));
        }
        if let Some(value) = held.as_ref().and_then(|bytes| unpack(key, bytes)) {
            return Ok(Found { value, cached: true, unkept: None });
        }
        *held = None;
        let value = make()?;
        let kept = pack(key, &value).and_then(|bytes| {
            let written = self.write(key, &bytes);
            *held = Some(bytes.into());
            written
        });
        Ok(Found { value, cached: false, unkept: kept.err() })
    }

    /// The values in memory, packed, for another process; none of a cache that keeps none there.
    pub fn held(&self) -> Vec<Arc<[u8]>> {
        self.memory.as_ref().map(|memory| memory.all()).unwrap_or_default()
    }

    /// Takes a packed value into memory; whether it is one. It is found by who needs it on the same kind of processor and with
    /// the same program.
    pub fn adopt(&self, packed: &[u8]) -> bool {
        let key = packed.strip_prefix(MAGIC).and_then(|rest| rest.first_chunk::<HASH>());
        let (Some(key), Some(memory)) = (key, &self.memory) else { return false };
        *lock(&memory.slot(&Key(*key))) = Some(packed.into());
        true
    }

    /// Stores `value` under `key`. The file appears whole or not at all, whoever else stores or loads it.
    ///
    /// # Errors
    /// The folder cannot be made or written.
    pub fn store(&self, key: &Key, value: &impl Serialize) -> io::Result<()> {
        let bytes = pack(key, value)?;
        if let Some(memory) = &self.memory {
            *lock(&memory.slot(key)) = Some(bytes.as_slice().into());
        }
        self.write(key, &bytes)
    }

    fn write(&self, key: &Key, bytes: &[u8]) -> io::Result<()> {
        let (Some(folder), Some(path)) = (&self.folder, self.path(key)) else { return Ok(()) };
        fs::create_dir_all(folder)?;
        remove_unfinished(folder, ABANDONED);
        write_whole(&path, bytes)
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
        let place = format!("whirl-cache-test-{name}-{}", std::process::id());
        let cache = Cache::new(env::temp_dir().join(place));
        let _ = fs::remove_dir_all(folder(&cache));
        cache
    }

    fn folder(cache: &Cache) -> &Path {
        cache.folder().unwrap()
    }

    fn file(cache: &Cache, key: &Key) -> PathBuf {
        cache.path(key).unwrap()
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
        fs::copy(file(&cache, &key), file(&cache, &other)).unwrap();
        assert_eq!(cache.load::<Vec<f64>>(&other), None);
        fs::remove_dir_all(folder(&cache)).unwrap();
    }

    #[test]
    fn a_damaged_file_counts_as_absent_and_is_replaced() {
        let cache = cache("damaged");
        let key = Key::of(&"key");
        cache.store(&key, &vec![7u64; 20]).unwrap();
        let whole = fs::read(file(&cache, &key)).unwrap();
        for at in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] ^= 1;
            fs::write(file(&cache, &key), &damaged).unwrap();
            assert_eq!(cache.load::<Vec<u64>>(&key), None, "byte {at}");
            fs::write(file(&cache, &key), &whole[..at]).unwrap();
            assert_eq!(cache.load::<Vec<u64>>(&key), None, "cut at {at}");
        }
        cache.store(&key, &vec![7u64; 20]).unwrap();
        assert_eq!(cache.load(&key), Some(vec![7u64; 20]));
        assert_eq!(fs::read_dir(folder(&cache)).unwrap().count(), 1);
        fs::remove_dir_all(folder(&cache)).unwrap();
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
        assert_eq!(fs::read_dir(folder(&cache)).unwrap().count(), 1, "no partial files are left");
        fs::remove_dir_all(folder(&cache)).unwrap();
    }

    #[test]
    fn what_many_need_at_once_is_made_by_one() {
        let shared = Cache::shared(None);
        let (key, made) = (Key::of(&"key"), std::sync::atomic::AtomicUsize::new(0));
        let need = || {
            let found = shared.load_or_make(&key, || {
                made.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                std::thread::sleep(Duration::from_millis(20));
                Ok::<_, ()>(vec![1.5; 100])
            });
            assert_eq!(found.unwrap().value, vec![1.5; 100]);
        };
        std::thread::scope(|scope| (0..4).for_each(|_| drop(scope.spawn(need))));
        assert_eq!(made.into_inner(), 1);
        let other = Cache::shared(None);
        assert!(shared.held().iter().all(|packed| other.adopt(packed)) && !other.adopt(b"no"));
        let found = other.load_or_make(&key, || Err::<Vec<f64>, _>("made")).unwrap();
        assert!(found.cached && found.unkept.is_none());
        let failed = other.load_or_make(&Key::of(&"other"), || Err::<Vec<f64>, _>("made"));
        assert_eq!(failed.unwrap_err(), "made");
    }

    #[test]
    fn a_shared_cache_keeps_its_values_on_disk_too() {
        let disk = cache("shared");
        let key = Key::of(&"key");
        let of = |cache: &Cache| cache.load_or_make(&key, || Ok::<_, ()>(7_u64)).unwrap();
        assert!(!of(&Cache::shared(Some(disk.clone()))).cached);
        assert_eq!(disk.load(&key), Some(7_u64));
        let again = Cache::shared(Some(disk.clone()));
        assert!(of(&again).cached);
        fs::write(file(&disk, &key), "damaged").unwrap();
        assert!(of(&again).cached, "what is in memory is not read again");
        assert!(!of(&Cache::shared(Some(disk.clone()))).cached);
        fs::remove_dir_all(folder(&disk)).unwrap();
    }

    #[test]
    fn what_killed_processes_left_goes_and_what_others_write_stays() {
        let cache = cache("abandoned");
        fs::create_dir_all(folder(&cache)).unwrap();
        let touch = |name: &str| File::create(folder(&cache).join(name)).unwrap();
        let old = SystemTime::now() - ABANDONED - Duration::from_secs(60);
        touch(".whirl-old.part").set_modified(old).unwrap();
        touch("whirl-notes.part").set_modified(old).unwrap();
        let being_written = write_aside(&folder(&cache).join("other"), b"new").unwrap();
        cache.store(&Key::of(&"key"), &1).unwrap();
        being_written().unwrap();
        let entries = fs::read_dir(folder(&cache)).unwrap();
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        let stored = OsString::from(format!("{}.bin", Key::of(&"key").hex()));
        let mut expected = [stored, "other".into(), "whirl-notes.part".into()];
        expected.sort();
        assert_eq!(names, expected);
        fs::remove_dir_all(folder(&cache)).unwrap();
    }

    #[test]
    fn what_cannot_be_written_leaves_the_older_file() {
        let cache = cache("older");
        fs::create_dir_all(folder(&cache).join("taken")).unwrap();
        assert!(write_whole(&folder(&cache).join("taken"), b"new").is_err());
        assert!(write_whole(&folder(&cache).join("absent/file"), b"new").is_err());
        write_whole(&folder(&cache).join("file"), b"new").unwrap();
        assert_eq!(fs::read_dir(folder(&cache)).unwrap().count(), 2);
        fs::remove_dir_all(folder(&cache)).unwrap();
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
