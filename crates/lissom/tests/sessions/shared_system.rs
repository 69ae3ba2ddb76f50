//! Many sessions of one system: states in and out, copies, threads.

use lissom::builder::analyses::Dynamics;
use lissom::builder::joints::Revolute;
use lissom::builder::loads::JointTorque;
use lissom::builder::outputs::Relative;
use lissom::builder::parts::Body;
use lissom::builder::{BodyId, GROUND, Input, InputId, ModelBuilder, OutputId};
use lissom::{Model, Prepared};

struct Pendulum {
    model: Model,
    rod: BodyId,
    motor: InputId,
    angle: OutputId,
}

/// A rod that turns about y at its upper end, with a motor.
fn pendulum(analysis: Dynamics) -> Pendulum {
    let mut builder = ModelBuilder::new();
    builder.gravity([0.0, 0.0, -9.81]);
    let rod = builder.add(Body::new(2.0, [0.06, 0.06, 1e-3]).position([0.0, 0.0, -0.3]));
    let hinge = builder.add(Revolute::new(GROUND, rod, [0.0, 1.0, 0.0]).at([0.0; 3]));
    let motor = builder.add(Input::starting_at(0.0));
    builder.add(JointTorque::new(hinge, motor));
    let angle = builder.add(Relative::new(hinge));
    builder.add(analysis);
    Pendulum {
        model: builder.build().unwrap_or_else(|report| panic!("{}", report.render(false))),
        rod,
        motor,
        angle,
    }
}

/// The angle at the end of a second that starts at the lowest point with a rate [rad/s].
fn angle_after(prepared: &Prepared, pendulum: &Pendulum, rate: f64) -> f64 {
    let mut state = prepared.state().clone();
    prepared.set_velocity(&mut state, pendulum.rod, [-0.3 * rate, 0.0, 0.0], [0.0, rate, 0.0]).unwrap();
    let mut session = prepared.session_from(state).unwrap();
    session.step_to(1.0).unwrap();
    session.output(pendulum.angle).unwrap()[0]
}

#[test]
fn threads_share_a_system_and_do_not_disturb_each_other() {
    let pendulum = pendulum(Dynamics::new(1.0).step(1e-2));
    let prepared = pendulum.model.prepare().unwrap();
    let rates = [0.1, 0.7, 1.3, 2.9];
    let alone: Vec<f64> = rates.iter().map(|&rate| angle_after(&prepared, &pendulum, rate)).collect();
    let (prepared, pendulum) = (&prepared, &pendulum);
    let together: Vec<f64> = std::thread::scope(|scope| {
        let start = |&rate: &f64| scope.spawn(move || angle_after(prepared, pendulum, rate));
        let threads: Vec<_> = rates.iter().map(start).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert_eq!(alone, together);
    assert!(alone.windows(2).all(|pair| pair[0] != pair[1]));
}

#[test]
fn a_copy_goes_on_to_the_same_bits_and_apart() {
    for analysis in [Dynamics::new(1.0).step(1e-2), Dynamics::new(1.0).relative_tolerance(1e-6)] {
        let pendulum = pendulum(analysis);
        let mut first = pendulum.model.session().unwrap();
        first.set(pendulum.motor, 2.0).unwrap();
        first.step_to(0.3).unwrap();
        let mut copy = first.try_clone().unwrap();
        let mut other = first.try_clone().unwrap();
        other.set(pendulum.motor, -2.0).unwrap();
        for session in [&mut first, &mut copy, &mut other] {
            session.step_to(1.0).unwrap();
        }
        assert_eq!(first.state(), copy.state());
        assert_eq!(first.simulation().totals(), copy.simulation().totals());
        assert_ne!(first.output(pendulum.angle).unwrap(), other.output(pendulum.angle).unwrap());
    }
}

#[test]
fn a_state_taken_out_goes_in_again() {
    for analysis in [Dynamics::new(1.0).step(1e-3), Dynamics::new(1.0).relative_tolerance(1e-9)] {
        let pendulum = pendulum(analysis);
        let prepared = pendulum.model.prepare().unwrap();
        let mut whole = prepared.session().unwrap();
        whole.set(pendulum.motor, 2.0).unwrap();
        whole.step_to(0.4).unwrap();
        let mut rest = prepared.session_from(whole.state().clone()).unwrap();
        assert_eq!(rest.progress().time.to_bits(), whole.progress().time.to_bits());
        assert_eq!(rest.quantity(pendulum.motor).unwrap(), 2.0, "held values are part of the state");
        for session in [&mut whole, &mut rest] {
            session.step_to(1.0).unwrap();
        }
        let [angle, again] =
            [&mut whole, &mut rest].map(|session| session.output(pendulum.angle).unwrap()[0]);
        assert!((angle - again).abs() < 1e-6 * angle.abs(), "{angle} {again}");
    }
}

#[test]
fn states_that_do_not_fit_are_refused() {
    let pendulum = pendulum(Dynamics::new(1.0).step(1e-2));
    let prepared = pendulum.model.prepare().unwrap();
    let refused = |change: &dyn Fn(&mut lissom::core::system::State)| {
        let mut state = prepared.state().clone();
        change(&mut state);
        prepared.session_from(state).err().expect("refused").to_string()
    };
    assert!(
        refused(&|state| state.kinematics.nodes[1].frame.position.x += 0.1)
            .contains("violate joint `revolute_1`")
    );
    assert!(refused(&|state| state.kinematics.nodes[1].twist[0] = f64::NAN).contains("not finite"));
    assert!(refused(&|state| state.kinematics.nodes.truncate(1)).contains("1 nodes, but the model has 2"));
    let mut session = prepared.session().unwrap();
    assert!(session.step_to(f64::NAN).unwrap_err().to_string().contains("finite"));
    assert!(session.step_to(f64::INFINITY).is_err());
    // Small deviations are those of another way to compute the same position.
    let mut state = prepared.state().clone();
    state.kinematics.nodes[1].frame.position.x += 1e-12;
    assert!(prepared.session_from(state).is_ok());
}
