//! A pendulum built in code, and its period: `cargo run --release --example pendulum`.
//!
//! Checks itself: the period of a rod that swings by 60 degrees is T = 2π/(ω agm(1, cos(θ₀/2))) with ω² = m g ℓ/I.

use std::error::Error;
use std::f64::consts::PI;

use lissom::builder::analyses::Dynamics;
use lissom::builder::joints::Revolute;
use lissom::builder::outputs::{Energy, Relative};
use lissom::builder::parts::Body;
use lissom::builder::{GROUND, ModelBuilder};

/// Mass [kg], distance of the centre of mass from the hinge [m], inertia about the centre of mass [kg m²].
const ROD: (f64, f64, f64) = (1.0, 0.5, 1.0 / 12.0);
const GRAVITY: f64 = 9.81;
/// Angle from the lowest position at the start, from rest [rad].
const START: f64 = PI / 3.0;

/// The arithmetic-geometric mean.
fn agm(a: f64, b: f64) -> f64 {
    (0..40).fold((a, b), |(a, b), _| (f64::midpoint(a, b), (a * b).sqrt())).0
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mass, distance, inertia) = ROD;
    let mut builder = ModelBuilder::new();
    builder.title("Pendulum");
    builder.gravity([0.0, 0.0, -GRAVITY]);
    let place = [distance * START.sin(), 0.0, -distance * START.cos()];
    let rod = builder.add(Body::new(mass, [inertia, inertia, 0.01 * inertia]).position(place));
    let hinge = builder.add(Revolute::new(GROUND, rod, [0.0, -1.0, 0.0]).at([0.0; 3]));
    // The joint counts from its position at the start.
    let angle = builder.add(Relative::new(hinge));
    let energy = builder.add(Energy::new());

    let omega = (mass * GRAVITY * distance / (inertia + mass * distance * distance)).sqrt();
    let period = 2.0 * PI / (omega * agm(1.0, (START / 2.0).cos()));
    builder.add(Dynamics::new(period).relative_tolerance(1e-9).output_step(period / 4.0));

    let mut session = builder.build()?.session()?;
    let results = session.run()?;
    let swing = &results.values[session.columns_of(angle)?.start];
    let total = &results.values[session.columns_of(energy)?.end - 1];
    for ((time, swing), energy) in results.time().iter().zip(swing).zip(total) {
        println!("t = {time:.6} s  angle = {:+.6} rad  energy = {energy:.9} J", START + swing);
    }
    // From one side through the lowest position to the other, and back.
    for (found, expected) in swing.iter().zip([0.0, -START, -2.0 * START, -START, 0.0]) {
        assert!((found - expected).abs() < 1e-5, "{found} rad, not {expected} rad");
    }
    assert_eq!(swing.len(), 5);
    Ok(())
}
