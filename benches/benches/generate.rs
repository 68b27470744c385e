//! From all spec files to the text of all kernels: what a build of the kernels spends before the compiler.

use std::fs;
use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use whirl_codegen::generate::{ENDINGS, SpecFile, folders, generate};

/// Every file that the build script of the kernels reads.
fn specs() -> Vec<SpecFile> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs");
    let mut files = Vec::new();
    for folder in folders() {
        for entry in fs::read_dir(root.join(folder)).expect("a folder of specs") {
            let path = entry.expect("an entry").path();
            let ending = path.extension().and_then(|ending| ending.to_str());
            if ending.is_some_and(|ending| ENDINGS.contains(&ending)) {
                let name = path.file_name().expect("a name").to_string_lossy();
                let text = fs::read_to_string(&path).expect("a text");
                files.push(SpecFile { path: format!("{folder}/{name}"), text });
            }
        }
    }
    files
}

fn all(c: &mut Criterion) {
    let files = specs();
    let made = generate(&files).unwrap_or_else(|errors| panic!("{errors}"));
    let bytes: usize = made.iter().map(|file| file.text.len()).sum();
    println!("{} spec files give {bytes} bytes of Rust in {} files", files.len(), made.len());
    let mut group = c.benchmark_group("generate");
    group.sample_size(10);
    group.bench_function("all specs", |b| {
        b.iter(|| generate(&files).unwrap_or_else(|errors| panic!("{errors}")));
    });
    group.finish();
}

criterion_group!(generation, all);
criterion_main!(generation);
