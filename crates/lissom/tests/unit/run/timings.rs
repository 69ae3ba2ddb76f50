//! Tests of `run::timings`, a module of it.

use super::*;

#[test]
fn the_parts_are_the_whole() {
    let mut timings = Timings::new();
    for _ in 0..40 {
        timings.begin_step();
        for phase in [Phase::Evaluation, Phase::Solve, Phase::Linearisation, Phase::Factorisation] {
            timings.begin(phase);
            std::hint::black_box((0..1000).fold(0_u64, |sum, k| std::hint::black_box(sum ^ k)));
        }
        timings.end_step();
    }
    timings.pause();
    let seconds = timings.seconds();
    assert!((seconds.steps() - timings.steps().as_secs_f64()).abs() < 1e-9);
    assert!(seconds.evaluation > 0.0 && seconds.factorisation > 0.0 && seconds.solve > 0.0);
}
