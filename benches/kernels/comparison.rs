//! Times of a refactorisation and of a solve beside those of other solvers, as a table.
//!
//! `cargo bench --manifest-path benches/kernels/Cargo.toml --bench comparison` compares with `faer`; `--features klu` with KLU as well, for
//! which `libsuitesparse-dev` must be installed. `LISSOM_BENCH_LARGE=1` adds 200 000 unknowns.

mod contenders;
#[path = "../../crates/lissom-solver/tests/samples.rs"]
mod samples;

use std::time::{Duration, Instant};

use contenders::{Contender, Ours, ldlt::Ldlt, lu::Lu};
use lissom_solver::Pattern;
use samples::{Model, chain, closed_loop, grid, right_hand_side, tree};

type Family = (&'static str, fn(usize) -> Model);
const FAMILIES: [Family; 4] = [("chain", chain), ("tree", tree), ("loop", closed_loop), ("grid", grid)];

/// Time spent on each figure.
const PATIENCE: Duration = Duration::from_millis(400);

/// The shortest time of many runs, in microseconds: what other work on the machine does not disturb.
fn shortest(mut run: impl FnMut()) -> f64 {
    run();
    let (began, mut least) = (Instant::now(), f64::INFINITY);
    let mut runs = 0;
    while runs < 3 || began.elapsed() < PATIENCE {
        let start = Instant::now();
        run();
        least = least.min(1e6 * start.elapsed().as_secs_f64());
        runs += 1;
    }
    least
}

/// Times of factorisation and solve.
fn times(contender: &mut dyn Contender, values: &[f64], b: &[f64]) -> [f64; 2] {
    let factor = shortest(|| contender.factor(values));
    let mut x = b.to_vec();
    let solve = shortest(|| {
        x.copy_from_slice(b);
        contender.solve(&mut x);
    });
    [factor, solve]
}

/// (A + Aᵀ)/2: what a solver for symmetric matrices can be given.
fn symmetric_part(pattern: &Pattern, values: &[f64]) -> Vec<f64> {
    let mut out = values.to_vec();
    for column in 0..pattern.size() {
        for position in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
            let row = pattern.row_indices()[position];
            let mirror = pattern.position(column, row).expect("the pattern is symmetric");
            out[position] = 0.5 * (values[position] + values[mirror]);
        }
    }
    out
}

fn main() {
    // Cargo runs benches as tests too, where times mean nothing.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    let mut sizes = vec![200, 2_000, 20_000];
    if std::env::var_os("LISSOM_BENCH_LARGE").is_some() {
        sizes.push(200_000);
    }
    println!(
        "| family | unknowns | LU [µs] | faer | KLU | LDLᵀ [µs] | faer | solve LU [µs] | faer | KLU | solve LDLᵀ [µs] | faer |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
    for (family, model) in FAMILIES {
        for &size in &sizes {
            compare(family, &model(size));
        }
    }
}

/// One line of the table.
fn compare(family: &str, model: &Model) {
    let structure = model.structure();
    let values = model.values::<f64>(&structure.pattern, 1, 1.0);
    let symmetric = symmetric_part(&structure.pattern, &values);
    let b = right_hand_side::<f64>(model.size, 2);
    let lu = times(&mut Ours::lu(&structure), &values, &b);
    let other_lu = times(&mut Lu::new(&structure.pattern), &values, &b);
    let klu = klu_times(&structure.pattern, &values, &b);
    let ldlt = times(&mut Ours::ldlt(&structure), &symmetric, &b);
    let other_ldlt = times(&mut Ldlt::new(&structure), &symmetric, &b);
    let part = |which: usize| {
        let klu = klu.map_or("–".to_owned(), |times| format!("{:.1}x", times[which] / lu[which]));
        format!(
            "{:.1} | {:.1}x | {klu} | {:.1} | {:.1}x",
            lu[which],
            other_lu[which] / lu[which],
            ldlt[which],
            other_ldlt[which] / ldlt[which]
        )
    };
    println!("| {family} | {} | {} | {} |", model.size, part(0), part(1));
}

#[cfg(feature = "klu")]
#[expect(clippy::unnecessary_wraps, reason = "the same signature with and without KLU")]
fn klu_times(pattern: &Pattern, values: &[f64], b: &[f64]) -> Option<[f64; 2]> {
    Some(times(&mut contenders::klu::Klu::new(pattern, values), values, b))
}

#[cfg(not(feature = "klu"))]
fn klu_times(_: &Pattern, _: &[f64], _: &[f64]) -> Option<[f64; 2]> {
    None
}
