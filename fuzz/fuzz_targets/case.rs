//! Case files, read and examined as `whirl check` does.
#![no_main]

use std::fs;

libfuzzer_sys::fuzz_target!(|text: &str| {
    let folder = std::env::temp_dir().join(format!("whirl-fuzz-{}", std::process::id()));
    let path = folder.join("case.toml");
    let written = fs::create_dir_all(&folder).and_then(|()| fs::write(&path, text));
    written.expect("the folder can be written");
    let _ = whirl_cli::examine(&path.to_string_lossy());
});
