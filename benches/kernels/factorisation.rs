//! Refactorisation and solve of chains, beams, trees and grids, by solver and number of unknowns.
//!
//! `LISSOM_BENCH_LARGE=1` adds 200 000 unknowns.

#[path = "../../crates/lissom-solver/tests/samples.rs"]
mod samples;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use lissom_solver::kind;
use samples::{Model, chain, grid, right_hand_side, spherical_chain, tree, two_node_beam};

type Family = (&'static str, fn(usize) -> Model);
const FAMILIES: [Family; 5] = [
    ("chain", chain),
    ("tree", tree),
    ("grid", grid),
    ("spherical chain", spherical_chain),
    ("beam", two_node_beam),
];
const SOLVERS: [&str; 2] = ["sparse", "pivoting"];

fn sizes() -> Vec<usize> {
    let mut sizes = vec![200, 300, 2_000, 20_000];
    if std::env::var_os("LISSOM_BENCH_LARGE").is_some() {
        sizes.push(200_000);
    }
    sizes
}

fn factorisation(criterion: &mut Criterion) {
    for (family, model) in FAMILIES {
        for size in sizes() {
            let model = model(size);
            let structure = model.structure();
            let values = model.values::<f64>(&structure.pattern, 1, 1.0);
            let b = right_hand_side::<f64>(model.size, 2);
            for name in SOLVERS {
                let Some(kind) = kind(name) else { continue };
                let mut solver = (kind.real)(&structure);
                let mut group = criterion.benchmark_group(format!("{family}/factor"));
                group.sample_size(10).bench_function(BenchmarkId::new(name, size), |bencher| {
                    bencher.iter(|| solver.factor(&values).expect("a regular matrix"));
                });
                group.finish();
                let mut x = b.clone();
                let mut group = criterion.benchmark_group(format!("{family}/solve"));
                group.sample_size(10).bench_function(BenchmarkId::new(name, size), |bencher| {
                    bencher.iter(|| {
                        x.copy_from_slice(&b);
                        solver.solve(&mut x);
                    });
                });
                group.finish();
            }
        }
    }
}

fn analysis(criterion: &mut Criterion) {
    for (family, model) in FAMILIES {
        for size in sizes() {
            let structure = model(size).structure();
            let mut group = criterion.benchmark_group(format!("{family}/analysis"));
            let Some(kind) = kind("sparse") else { continue };
            group.sample_size(10).bench_function(BenchmarkId::new(kind.name, size), |bencher| {
                bencher.iter(|| (kind.real)(&structure));
            });
            group.finish();
        }
    }
}

criterion_group!(benches, factorisation, analysis);
criterion_main!(benches);
