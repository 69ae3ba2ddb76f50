//! A thousand copies of a pendulum that start at different rates, on all cores: `cargo run --release --example
//! perturbed_copies`. The system is built once; every copy has its own state.
//!
//! Checks itself: a pendulum that passes its lowest position at the rate ω₀ is there again, at the same rate, after the period
//! T = 2π/(ω agm(1, √(1 - k²))) with k = ω₀/(2ω) and ω² = m g ℓ/I.

use std::error::Error;
use std::f64::consts::PI;
use std::thread;

use lissom::Prepared;
use lissom::builder::analyses::Dynamics;
use lissom::builder::joints::Revolute;
use lissom::builder::outputs::Relative;
use lissom::builder::parts::Body;
use lissom::builder::words::Scheme;
use lissom::builder::{BodyId, GROUND, ModelBuilder, OutputId, Signal, SignalId};

const COPIES: usize = 1000;
/// Mass [kg], distance of the centre of mass from the hinge [m], inertia about the centre of mass [kg m²].
const ROD: (f64, f64, f64) = (1.0, 0.5, 1.0 / 12.0);
const GRAVITY: f64 = 9.81;

/// What a copy is asked for.
#[derive(Clone, Copy)]
struct Handles {
    rod: BodyId,
    angle: OutputId,
    rate: SignalId,
}

/// The arithmetic-geometric mean.
fn agm(a: f64, b: f64) -> f64 {
    (0..40).fold((a, b), |(a, b), _| (f64::midpoint(a, b), (a * b).sqrt())).0
}

/// Rate at the lowest position of a copy [rad/s].
fn start_rate(copy: usize) -> f64 {
    1.0 + copy as f64 / COPIES as f64
}

/// How far a copy is from where it began after its period: angle [rad] and rate [rad/s].
fn miss(
    prepared: &Prepared,
    handles: Handles,
    copy: usize,
) -> Result<[f64; 2], Box<dyn Error + Send + Sync>> {
    let (mass, distance, inertia) = ROD;
    let rate = start_rate(copy);
    let omega = (mass * GRAVITY * distance / (inertia + mass * distance * distance)).sqrt();
    let modulus = rate / (2.0 * omega);
    let period = 2.0 * PI / (omega * agm(1.0, (1.0 - modulus * modulus).sqrt()));

    let mut state = prepared.state().clone();
    // The hinge is above the centre of mass.
    prepared.set_velocity(&mut state, handles.rod, [distance * rate, 0.0, 0.0], [0.0, -rate, 0.0])?;
    let mut session = prepared.session_from(state)?;
    session.step_to(period)?;
    Ok([session.output(handles.angle)?[0], session.quantity(handles.rate)? - rate])
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mass, distance, inertia) = ROD;
    let mut builder = ModelBuilder::new();
    builder.gravity([0.0, 0.0, -GRAVITY]);
    let rod =
        builder.add(Body::new(mass, [inertia, inertia, 0.01 * inertia]).position([0.0, 0.0, -distance]));
    let hinge = builder.add(Revolute::new(GROUND, rod, [0.0, -1.0, 0.0]).at([0.0; 3]));
    let angle = builder.add(Relative::new(hinge));
    let rate = builder.add(Signal::new(hinge.rate()));
    builder.add(Dynamics::new(5.0).scheme(Scheme::RadauIia).step(0.005));
    let prepared = builder.build()?.prepare()?;

    let handles = Handles { rod, angle, rate };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let misses = thread::scope(|scope| -> Result<Vec<[f64; 2]>, Box<dyn Error + Send + Sync>> {
        let prepared = &prepared;
        let share = |thread: usize| {
            let own = (thread..COPIES).step_by(threads);
            scope.spawn(move || own.map(|copy| miss(prepared, handles, copy)).collect::<Result<Vec<_>, _>>())
        };
        let shares: Vec<_> = (0..threads).map(share).collect();
        let mut misses = Vec::new();
        for share in shares {
            misses.extend(share.join().expect("copies do not panic")?);
        }
        Ok(misses)
    })
    .map_err(|error| -> Box<dyn Error> { error })?;

    let largest = misses.iter().flatten().fold(0.0, |most: f64, miss| most.max(miss.abs()));
    println!(
        "{} copies on {threads} threads; farthest from its start after a period: {largest:.1e}",
        misses.len()
    );
    assert_eq!(misses.len(), COPIES);
    assert!(largest < 1e-5, "the scheme is of third order: {largest:.1e}");
    Ok(())
}
