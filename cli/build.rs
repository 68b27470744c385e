//! Tells the program from which commit it is built, where that is known, and from which sources.

include!("../solver/sources.rs");

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let git = |arguments: &[&str]| {
        let output = Command::new("git").arg("-C").arg(&root).args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_string())
    };
    let commit = git(&["rev-parse", "--short=12", "HEAD"]).unwrap_or_default();
    let changed = |path: String| println!("cargo::rerun-if-changed={path}");
    // `HEAD` changes with the branch, the log with every commit.
    for name in ["HEAD", "logs/HEAD"] {
        if let Some(path) = git(&["rev-parse", "--path-format=absolute", "--git-path", name])
            && Path::new(&path).exists()
        {
            changed(path);
        }
    }
    changed("build.rs".to_string());
    let package = env!("CARGO_PKG_VERSION");
    let long =
        if commit.is_empty() { package.to_string() } else { format!("{package} ({commit})") };
    if !commit.is_empty() {
        println!("cargo::rustc-env=WHIRL_COMMIT={commit}");
    }
    println!("cargo::rustc-env=WHIRL_VERSION={long}");
    let folders = ["cli/src", "codegen/src", "solver/src", "specs", "codegen/text/src"];
    let files =
        ["Cargo.lock", "Cargo.toml", "cli/build.rs", "solver/build.rs", "solver/sources.rs"];
    println!("cargo::rustc-env=WHIRL_SOURCES={}", sources(&root, &folders, &files));
}
