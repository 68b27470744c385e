//! The laws in specs/: derivatives three ways, reports and names, and each against numbers of its source.

mod angular_contact;
mod contact;
mod films;
mod given;
mod impact;
mod kernel;
mod mounts;
mod reading;
mod rolling;
mod rub;
mod slope;
mod straddle;
mod three_ways;

use std::fs;
use std::path::Path;

use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::law::LawSpec;

/// Every law file, read.
fn laws() -> Vec<LawSpec> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/laws");
    let entries = fs::read_dir(&folder).expect("specs/laws is there");
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    assert!(!files.is_empty());
    files
        .iter()
        .map(|file| {
            let text = fs::read_to_string(file).expect("a readable file");
            let beside = |name: &str| {
                let table = file.with_file_name(name);
                let text = fs::read_to_string(&table).map_err(|error| error.to_string())?;
                Ok(Source::new(table, text))
            };
            let law = LawSpec::read_with(&Source::new(file, text), &beside);
            let law = law.unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(Some(law.name.as_str()), file.file_stem().and_then(|stem| stem.to_str()));
            law
        })
        .collect()
}

/// The range over which a law was analysed, input after input, SI.
fn ranges(law: &LawSpec) -> Vec<[f64; 2]> {
    let units = law.inputs.iter().map(|input| input.unit.factor().to_f64());
    law.report.ranges.iter().zip(units).map(|((.., range), unit)| range.map(|x| x * unit)).collect()
}
