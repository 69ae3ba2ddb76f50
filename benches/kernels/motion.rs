//! The functions a beam element calls at every iteration, at small, moderate and large rotations.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use lissom_motion::{
    Motion, ScrewTangent, Vector6, inverse_tangent_transpose_times, tangent_derivative,
    tangent_derivative_transpose_times, tangent_hessian, tangent_times, tangent_transpose_times,
};

fn kernels(criterion: &mut Criterion) {
    let axis = Vector6::new(0.4, -0.2, 0.3, 0.36, 0.48, -0.8);
    let a = Vector6::new(0.1, 0.5, -0.3, 0.7, -0.2, 0.6);
    let w = Vector6::new(-0.4, 0.2, 0.8, 0.3, 0.9, -0.5);
    for (name, angle) in [("0.01 rad", 0.01), ("0.5 rad", 0.5), ("2 rad", 2.0)] {
        let d = axis * angle;
        let base = Motion::exponential(&a);
        let motion = base * Motion::exponential(&d);
        let mut group = criterion.benchmark_group(name);
        group.bench_function("relative_to", |b| b.iter(|| black_box(&motion).relative_to(black_box(&base))));
        let relative = motion.relative_to(&base);
        group.bench_function("logarithm", |b| b.iter(|| black_box(&relative).logarithm()));
        group.bench_function("exponential", |b| b.iter(|| Motion::exponential(black_box(&d))));
        group.bench_function("adjoint_times", |b| b.iter(|| black_box(&motion).adjoint_times(black_box(&a))));
        group.bench_function("tangent_times", |b| b.iter(|| tangent_times(black_box(&d), black_box(&a))));
        group.bench_function("tangent_transpose_times", |b| {
            b.iter(|| tangent_transpose_times(black_box(&d), black_box(&w)));
        });
        group.bench_function("inverse_tangent_transpose_times", |b| {
            b.iter(|| inverse_tangent_transpose_times(black_box(&d), black_box(&w)));
        });
        group.bench_function("tangent_derivative_transpose_times", |b| {
            b.iter(|| tangent_derivative_transpose_times(black_box(&d), black_box(&a), black_box(&w)));
        });
        group.bench_function("tangent_derivative", |b| {
            b.iter(|| tangent_derivative(black_box(&d), black_box(&a)));
        });
        group.bench_function("tangent_hessian", |b| {
            b.iter(|| tangent_hessian(black_box(&d), black_box(&a), black_box(&w)));
        });
        group.bench_function("ScrewTangent::new", |b| b.iter(|| ScrewTangent::new(black_box(&d))));
        let prepared = ScrewTangent::new(&d);
        group.bench_function("ScrewTangent::times", |b| b.iter(|| black_box(&prepared).times(black_box(&a))));
        group.bench_function("ScrewTangent::derivative_transpose_times", |b| {
            b.iter(|| black_box(&prepared).derivative_transpose_times(black_box(&a), black_box(&w)));
        });
        group.finish();
    }
}

criterion_group!(benches, kernels);
criterion_main!(benches);
