//! What the kernels of each spec add to the compile time of the crate of the specs, and how large they are.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use whirl_benches::specs;
use whirl_codegen::generate::{SpecFile, generate};

/// Compilations of which the fastest counts.
const TRIES: usize = 3;

fn main() {
    // What cargo adds to the arguments begins with a dash.
    let only = env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let files = specs::files();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("compile");
    fs::create_dir_all(&folder).expect("a folder");
    let compiler = Compiler { folder: &folder, libm: libm() };
    let beside = |file: &SpecFile| file.path.starts_with("forms/") || file.path.ends_with(".csv");
    let shared: Vec<SpecFile> = files.iter().filter(|file| beside(file)).cloned().collect();
    let nothing = compiler.compile(&shared);
    println!(
        "the crate without kernels: {:.2} s of CPU time, object code {} B",
        nothing.time, nothing.code
    );
    println!("{:40} {:>8} {:>12} {:>12}", "added by", "CPU s", "text kB", "object kB");
    let print = |name: &str, found: &Cost| {
        let [text, code] = [found.text - nothing.text, found.code - nothing.code];
        let time = found.time - nothing.time;
        println!("{name:40} {time:8.2} {:12.1} {:12.1}", text as f64 / 1e3, code as f64 / 1e3);
    };
    let asked = |file: &&SpecFile| only.as_ref().is_none_or(|part| file.path.contains(part));
    for file in files.iter().filter(|file| !beside(file)).filter(asked) {
        let own = [&shared[..], std::slice::from_ref(file)].concat();
        print(&file.path, &compiler.compile(&own));
    }
    if only.is_none() {
        print("all together", &compiler.compile(&files));
    }
}

/// What a compilation costs.
struct Cost {
    /// CPU time (s).
    time: f64,
    /// Generated text (B).
    text: u64,
    /// Code and constants (B).
    code: u64,
}

struct Compiler<'a> {
    folder: &'a Path,
    libm: PathBuf,
}

impl Compiler<'_> {
    /// Compiles the crate of the specs with the kernels of some files, as a release build does but in one
    /// piece.
    fn compile(&self, files: &[SpecFile]) -> Cost {
        let made = generate(files).unwrap_or_else(|errors| panic!("{errors}"));
        let mut text = 0;
        for file in &made {
            text += file.text.len() as u64;
            fs::write(self.folder.join(&file.name), &file.text).expect("a file");
        }
        let mut time = f64::INFINITY;
        for _ in 0..TRIES {
            let before = children();
            let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
            let status = Command::new(rustc)
                .args(["--edition=2024", "--crate-name=whirl_specs", "--crate-type=lib"])
                .args(["--emit=obj", "-Copt-level=3", "-Ccodegen-units=1", "-Awarnings"])
                .arg(format!("--extern=libm={}", self.libm.display()))
                .arg("--out-dir")
                .arg(self.folder)
                .arg(specs::root().join("src/lib.rs"))
                .env("OUT_DIR", self.folder)
                .status();
            assert!(status.expect("a compiler").success());
            time = time.min(children() - before);
        }
        Cost { time, text, code: code(&self.folder.join("whirl_specs.o")) }
    }
}

/// CPU time of all processes that this one started and that ended (s): Linux counts it in hundredths.
fn children() -> f64 {
    let text = fs::read_to_string("/proc/self/stat").expect("Linux");
    let behind = text.rsplit_once(')').expect("a name").1;
    let fields: Vec<&str> = behind.split_whitespace().collect();
    fields[13..15].iter().map(|ticks| ticks.parse::<f64>().expect("a number") / 100.0).sum()
}

/// Code and constants of an object file by `size`, of the GNU binary utilities.
fn code(object: &Path) -> u64 {
    let output = Command::new("size").arg(object).output().expect("the command `size`");
    let text = String::from_utf8_lossy(&output.stdout);
    let row = text.lines().nth(1).and_then(|line| line.split_whitespace().next());
    row.and_then(|size| size.parse().ok()).expect("a size")
}

/// The library that kernels call, which was compiled with this program.
fn libm() -> PathBuf {
    let folder = env::current_exe().expect("a path").with_file_name("");
    let mut found: Vec<PathBuf> = fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| {
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
            name.is_some_and(|name| name.starts_with("liblibm-") && name.ends_with(".rlib"))
        })
        .collect();
    found.sort_by_key(|path| fs::metadata(path).and_then(|facts| facts.modified()).ok());
    found.pop().expect("the compiled libm beside this program")
}
