//! From all spec files to the text of all kernels: what a build of the kernels spends before the compiler.

use criterion::{Criterion, criterion_group, criterion_main};
use whirl_benches::specs;
use whirl_codegen::generate::generate;

fn all(c: &mut Criterion) {
    let files = specs::files();
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
