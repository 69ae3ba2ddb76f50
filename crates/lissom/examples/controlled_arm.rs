//! An arm that a controller outside of the simulation drives: `cargo run --release --example controlled_arm`.
//!
//! Every millisecond the controller reads the joint and sets the motor's torque, which is held until the next time.
//!
//! Checks itself: with a torque τ that is held for h, an arm without gravity moves by θ' = θ + h θ̇ + h² τ/(2 I),
//! θ̇' = θ̇ + h τ/I. The same controller on this recurrence gives the same motion.

use std::error::Error;

use lissom::builder::analyses::Dynamics;
use lissom::builder::joints::Revolute;
use lissom::builder::loads::JointTorque;
use lissom::builder::outputs::Relative;
use lissom::builder::parts::Body;
use lissom::builder::words::Scheme;
use lissom::builder::{GROUND, Input, ModelBuilder, Signal};

/// Time from one command to the next [s].
const PERIOD: f64 = 1e-3;
const COMMANDS: u32 = 1000;
/// Angle to be reached [rad].
const TARGET: f64 = 0.8;
/// Mass [kg], distance of the centre of mass from the hinge [m], inertia about the centre of mass [kg m²].
const ARM: (f64, f64, f64) = (2.0, 0.4, 0.1);
/// Largest torque of the motor [N m].
const LIMIT: f64 = 15.0;

/// A proportional and derivative controller with a limit: torque [N m] for angle [rad] and rate [rad/s].
fn controller(angle: f64, rate: f64) -> f64 {
    (60.0 * (TARGET - angle) - 9.0 * rate).clamp(-LIMIT, LIMIT)
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mass, distance, inertia) = ARM;
    let mut builder = ModelBuilder::new();
    builder.title("Arm driven from outside");
    let bar = builder.add(Body::new(mass, [0.01, inertia, inertia]).position([distance, 0.0, 0.0]));
    let hinge = builder.add(Revolute::new(GROUND, bar, [0.0, 0.0, 1.0]).at([0.0; 3]));
    let motor = builder.add(Input::starting_at(0.0));
    builder.add(JointTorque::new(hinge, motor));
    // A joint's output has its coordinate; its rate is a signal.
    let angle = builder.add(Relative::new(hinge));
    let rate = builder.add(Signal::new(hinge.rate()));
    builder.add(Dynamics::new(f64::from(COMMANDS) * PERIOD).scheme(Scheme::RadauIia).step(PERIOD));

    let mut session = builder.build()?.session()?;
    let about_hinge = inertia + mass * distance * distance;
    let mut expected = (0.0, 0.0);
    for command in 1..=COMMANDS {
        let torque = controller(session.output(angle)?[0], session.quantity(rate)?);
        session.set(motor, torque)?;
        session.step_to(f64::from(command) * PERIOD)?;

        let acceleration = controller(expected.0, expected.1) / about_hinge;
        expected.0 += PERIOD * expected.1 + 0.5 * PERIOD * PERIOD * acceleration;
        expected.1 += PERIOD * acceleration;
        let found = session.output(angle)?[0];
        assert!(
            (found - expected.0).abs() < 1e-9,
            "{found} rad, not {} rad, after {command} commands",
            expected.0
        );
        if command % 100 == 0 {
            println!(
                "t = {:.1} s  angle = {found:.6} rad  torque = {torque:+.4} N m",
                session.progress().time
            );
        }
    }
    let end = session.output(angle)?[0];
    assert!((end - TARGET).abs() < 1e-3, "the arm is at {end} rad");
    Ok(())
}
