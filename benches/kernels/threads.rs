//! What two threads make of a refactorisation and of a solve, as a table: time of one thread over that of two, run in turn.
//!
//! `cargo bench --manifest-path benches/kernels/Cargo.toml --bench threads`; `LISSOM_BENCH_LARGE=1` adds 200 000 unknowns.

#[path = "../../crates/lissom-solver/tests/samples.rs"]
mod samples;

use std::time::{Duration, Instant};

use lissom_solver::{LinearSolver, Multifrontal, Symmetric};
use samples::{Model, chain, closed_loop, grid, right_hand_side, spherical_chain, tree, two_node_beam};

type Family = (&'static str, fn(usize) -> Model);
const FAMILIES: [Family; 6] = [
    ("chain of spherical joints", spherical_chain),
    ("chain", chain),
    ("beam", two_node_beam),
    ("tree", tree),
    ("loop", closed_loop),
    ("grid", grid),
];

/// Time spent on each figure.
const PATIENCE: Duration = Duration::from_millis(800);

/// The shortest times of both in turn: what other work on the machine does not disturb.
fn ratio(mut one: impl FnMut(), mut two: impl FnMut()) -> f64 {
    let mut least = [f64::INFINITY; 2];
    let (began, mut runs) = (Instant::now(), 0);
    while runs < 4 || began.elapsed() < PATIENCE {
        for (least, run) in least.iter_mut().zip([&mut one as &mut dyn FnMut(), &mut two]) {
            let start = Instant::now();
            run();
            *least = least.min(start.elapsed().as_secs_f64());
        }
        runs += 1;
    }
    least[0] / least[1]
}

/// Ratios of factorisation and solve.
fn ratios<T: LinearSolver<f64>>([mut one, mut two]: [T; 2], values: &[f64], b: &[f64]) -> [f64; 2] {
    two.set_threads(2);
    let factor = |solver: &mut T| {
        solver.factor(values).expect("a regular matrix");
    };
    let factor = ratio(|| factor(&mut one), || factor(&mut two));
    let (mut x, mut y) = (b.to_vec(), b.to_vec());
    let solve = |solver: &mut T, x: &mut [f64]| {
        x.copy_from_slice(b);
        solver.solve(x);
    };
    let solve = ratio(|| solve(&mut one, &mut x), || solve(&mut two, &mut y));
    assert!(x == y, "threads change no bit");
    [factor, solve]
}

fn main() {
    // Cargo runs benches as tests too, where times mean nothing.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    let mut sizes = vec![9_000, 20_000];
    if std::env::var_os("LISSOM_BENCH_LARGE").is_some() {
        sizes.push(200_000);
    }
    println!("| family | unknowns | LU | solve LU | LDLᵀ | solve LDLᵀ |");
    println!("|---|---|---|---|---|---|");
    for (family, model) in FAMILIES {
        for &size in &sizes {
            let model = model(size);
            let structure = model.structure();
            // LDLᵀ reads one of each pair of entries, so that these will do for both.
            let values = model.values::<f64>(&structure.pattern, 1, 1.0);
            let b = right_hand_side::<f64>(model.size, 2);
            let lu = ratios([(); 2].map(|()| Multifrontal::new(&structure)), &values, &b);
            let ldlt = ratios([(); 2].map(|()| Symmetric::new(&structure)), &values, &b);
            let [factor, solve, symmetric, solve_symmetric] = [lu[0], lu[1], ldlt[0], ldlt[1]];
            println!(
                "| {family} | {} | {factor:.2}x | {solve:.2}x | {symmetric:.2}x | {solve_symmetric:.2}x |",
                model.size
            );
        }
    }
}
