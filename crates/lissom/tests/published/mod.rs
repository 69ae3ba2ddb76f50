//! Published models of two other programs, Exudyn and MBDyn, in our words: those of their test suites and small examples that a model
//! file can say. Exudyn's published values belong to steps that are not converged (one to seven digits); compared are values of both
//! programs refined to convergence, by extrapolation over steps, and formulas or integrated equations where there are any. MBDyn's
//! inputs come without values; they are compared with formulas and integrated equations alone.

use std::f64::consts::PI;

use lissom::Model;

/// A published model.
struct Published {
    /// What it is, and what it is called there.
    name: &'static str,
    called: &'static str,
    /// Without its analysis; the output `value` is what is compared.
    text: &'static str,
    /// How long it moves, and the longer one of two steps [s].
    end: f64,
    step: f64,
    /// Formula or integrated equation, and how far from it we may be.
    exact: Option<(fn() -> f64, f64)>,
    /// Refined value of the other program, where it was run, and how far from it we may be: its last digit that stands still.
    refined: Option<(f64, f64)>,
}

/// m x'' + c x' + k x = F below critical damping, at a time.
fn oscillation([mass, damping, stiffness]: [f64; 3], force: f64, [place, rate]: [f64; 2], time: f64) -> f64 {
    let rest = force / stiffness;
    let decay = 0.5 * damping / mass;
    let omega = (stiffness / mass - decay * decay).sqrt();
    let (cosine, sine) = (place - rest, (rate + decay * (place - rest)) / omega);
    rest + (-decay * time).exp() * (cosine * (omega * time).cos() + sine * (omega * time).sin())
}

/// Solution of x'' = a(t, x, x') by the classical Runge-Kutta method in small steps.
fn motion(acceleration: &dyn Fn(f64, [f64; 2]) -> f64, start: [f64; 2], end: f64) -> f64 {
    const STEPS: u32 = 400_000;
    let step = end / f64::from(STEPS);
    let rate = |time: f64, state: [f64; 2]| [state[1], acceleration(time, state)];
    let mut state = start;
    for k in 0..STEPS {
        let time = f64::from(k) * step;
        let ahead = |rate: [f64; 2], part: f64| [0, 1].map(|i| state[i] + part * step * rate[i]);
        let one = rate(time, state);
        let two = rate(time + 0.5 * step, ahead(one, 0.5));
        let three = rate(time + 0.5 * step, ahead(two, 0.5));
        let four = rate(time + step, ahead(three, 1.0));
        state = [0, 1].map(|i| state[i] + step / 6.0 * (one[i] + 2.0 * (two[i] + three[i]) + four[i]));
    }
    state[0]
}

/// The value at the end, extrapolated over two steps: the scheme is of third order.
fn found(published: &Published) -> f64 {
    let [long, short] = [1.0, 0.5].map(|part| {
        let Published { text, end, step, .. } = published;
        let text = format!(
            "lissom = 1\n{text}[analysis]\nkind = \"dynamics\"\nscheme = \"radau-iia\"\ntolerance = 1e-12\nend = {end}\n\
             step = {:e}\n",
            part * step
        );
        let model = Model::from_text("model.toml", &text);
        let mut session = model.session().unwrap_or_else(|error| panic!("{}: {error}", published.name));
        let record = session.run().unwrap();
        *record.column("value", "value").unwrap().last().unwrap()
    });
    short + (short - long) / 7.0
}

#[test]
fn published_models_have_their_refined_values() {
    check(EXUDYN);
}

#[test]
fn published_models_follow_their_formulas() {
    check(MBDYN);
}

/// Models by formula and by refined value: each has at least one of them.
fn check(models: &[Published]) {
    let mut wrong = Vec::new();
    for published in models {
        assert!(published.exact.is_some() || published.refined.is_some(), "{}", published.name);
        let found = found(published);
        let mut compare = |against: &str, reference: f64, within: f64| {
            let missed = (found - reference).abs();
            // Not a number is wrong, too.
            if missed.is_nan() || missed > within {
                wrong.push(format!(
                    "{} ({}): {found:e}, {against} {reference:e}: {missed:.1e} for {within:.0e}",
                    published.name, published.called
                ));
            }
        };
        if let Some((exact, within)) = published.exact {
            compare("exact", exact(), within);
        }
        if let Some((refined, within)) = published.refined {
            compare("refined", refined, within);
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

const EXUDYN: &[Published] = &[
    Published {
        name: "a mass falls",
        called: "LoadMassProportional",
        text: include_str!("mass.toml"),
        end: 1.0,
        step: 1e-2,
        exact: Some((|| -0.5 * 9.81, 1e-13)),
        refined: Some((-4.905, 1e-12)),
    },
    Published {
        name: "a mass on springs along three axes",
        called: "ObjectConnectorCartesianSpringDamper",
        text: include_str!("three-springs.toml"),
        end: 1.0,
        step: 1e-3,
        exact: Some((|| oscillation([5.0, 250.0, 5000.0], -5.0, [0.0, 0.0], 1.0), 1e-14)),
        refined: Some((-0.000_999_999_999_979_017_7, 1e-15)),
    },
    Published {
        name: "a mass that is led",
        called: "ObjectConnectorCoordinate",
        text: include_str!("led-mass.toml"),
        end: 1.0,
        step: 1e-2,
        exact: Some((|| 0.05, 1e-13)),
        refined: Some((0.05, 1e-14)),
    },
    Published {
        name: "a mass on a cubic spring",
        called: "ObjectConnectorCoordinateSpringDamper",
        text: include_str!("cubic-spring.toml"),
        end: 1.0,
        step: 1e-3,
        exact: Some((
            || motion(&|_, [x, v]| (1.0 - 500.0 * x - 5000.0 * x.powi(3) - 80.0 * v) / 5.0, [0.0, 0.0], 1.0),
            1e-12,
        )),
        refined: Some((0.001_999_524_868_8, 1e-12)),
    },
    Published {
        name: "a point pendulum on a distance",
        called: "ObjectConnectorDistance",
        text: include_str!("distance-pendulum.toml"),
        end: 1.0,
        step: 1e-3,
        exact: Some((|| motion(&|_, [angle, _]| -9.81 * angle.cos(), [0.0, 0.0], 1.0).cos(), 1e-10)),
        refined: Some((-0.986_291_751_16, 1e-10)),
    },
    Published {
        name: "a slide on a spring",
        called: "ObjectConnectorLinearSpringDamper",
        text: include_str!("slide.toml"),
        end: 1.0,
        step: 1e-3,
        exact: Some((|| oscillation([1.0, 20.0, 2000.0], 1.0, [0.0, 0.0], 1.0), 1e-13)),
        refined: Some((0.000_499_981_029_08, 1e-13)),
    },
    Published {
        name: "a body on a bushing",
        called: "ObjectConnectorRigidBodySpringDamper",
        text: include_str!("bushing.toml"),
        end: 1.0,
        step: 1e-3,
        exact: Some((|| oscillation([1.0, 5.0, 500.0], 0.0, [0.0, 1000.0], 1.0), 1e-07)),
        refined: Some((-0.839_791_7, 2e-06)),
    },
    Published {
        name: "a mass on a spring that is stretched",
        called: "ObjectConnectorSpringDamper",
        text: include_str!("stretched-spring.toml"),
        end: 1.0,
        step: 1e-3,
        exact: Some((|| 1.0 + oscillation([1.0, 1.0, 100.0], 0.0, [0.05, 0.0], 1.0), 1e-11)),
        refined: Some((0.973_539_559_05, 1e-10)),
    },
    Published {
        name: "a hinge on a spring",
        called: "ObjectConnectorTorsionalSpringDamper",
        text: include_str!("hinge-spring.toml"),
        end: 1.0,
        step: 1e-3,
        exact: Some((|| oscillation([1.0, 20.0, 2000.0], 1.0, [0.0, 0.0], 1.0), 1e-13)),
        refined: Some((0.000_499_981_029_08, 1e-13)),
    },
    Published {
        name: "a hinge under a moment",
        called: "ObjectJointRevoluteZ",
        text: include_str!("hinge-moment.toml"),
        end: 1.0,
        step: 1e-2,
        exact: Some((|| 0.5, 1e-13)),
        refined: Some((0.5, 1e-12)),
    },
    Published {
        name: "a rod that swings from level",
        called: "ObjectKinematicTree",
        text: include_str!("rod.toml"),
        end: 1.0,
        step: 1e-3,
        exact: Some((
            || motion(&|_, [angle, _]| -9.81 * 0.5 * angle.cos() / (1.01 / 12.0 + 0.25), [0.0, 0.0], 1.0),
            1e-10,
        )),
        refined: Some((-3.134_018_551_808_6, 1e-09)),
    },
    Published {
        name: "a mass that goes on",
        called: "ObjectMass1D, ObjectMassPoint, ObjectMassPoint2D",
        text: include_str!("free-mass.toml"),
        end: 1.0,
        step: 1e-2,
        exact: Some((|| 2.0, 1e-13)),
        refined: Some((2.0, 1e-12)),
    },
    Published {
        name: "a body that goes on and turns",
        called: "ObjectRigidBody2D",
        text: include_str!("free-body.toml"),
        end: 1.0,
        step: 1e-2,
        exact: Some((|| 2.0 + 0.75 * PI, 1e-09)),
        refined: Some((4.356_194_490_192, 1e-09)),
    },
    Published {
        name: "a rotor that goes on",
        called: "ObjectRotationalMass1D",
        text: include_str!("free-rotor.toml"),
        end: 1.0,
        step: 1e-2,
        exact: Some((|| 2.0, 1e-13)),
        refined: Some((2.0, 1e-12)),
    },
    Published {
        name: "a sweep on a cubic spring",
        called: "springDamperUserFunctionTest",
        text: include_str!("sweep.toml"),
        end: 50.0,
        step: 1e-3,
        exact: Some((
            || {
                0.5 + motion(
                    &|t, [x, v]| {
                        (80.0 * (0.5 * t * t).sin() - 400.0 * x - 4000.0 * x.powi(3) - 4.0 * v) / 1.6
                    },
                    [0.0, 0.0],
                    50.0,
                )
            },
            1e-09,
        )),
        refined: Some((0.506_557_558_35, 1e-09)),
    },
    Published {
        name: "a body on springs and dampers with six degrees of freedom",
        called: "connectorRigidBodySpringDamperTest",
        text: include_str!("six-springs.toml"),
        end: 0.1,
        step: 1e-4,
        exact: Some((
            || {
                let place = oscillation([1.0, 50.0, 5000.0], 0.0, [0.0, 10.0], 0.1);
                let angle = oscillation([1.0, 5.0, 5000.0], 0.0, [0.0, 8.0 * PI], 0.1);
                0.1 + place + 0.1 * angle.cos() - 0.1 * angle.sin()
            },
            1e-11,
        )),
        refined: Some((0.182_707_494_24, 1e-10)),
    },
    Published {
        name: "a four-bar of point masses",
        called: "fourBarMechanismTest",
        text: include_str!("four-bar.toml"),
        end: 2.0,
        step: 1e-3,
        exact: None,
        refined: Some((-2.376_452_866_7, 1e-09)),
    },
    Published {
        name: "two bodies with products of inertia on a hinge and a ball",
        called: "rigidBodyCOMtest",
        text: include_str!("two-bodies.toml"),
        end: 1.0,
        step: 1e-3,
        exact: None,
        refined: Some((3.409_434_835_9, 1e-09)),
    },
    Published {
        name: "a chain of four bodies on balls",
        called: "sphericalJointTest",
        text: include_str!("chain.toml"),
        end: 1.0,
        step: 1e-3,
        exact: None,
        refined: Some((4.409_082_301_3, 1e-09)),
    },
    Published {
        name: "four satellites about a star",
        called: "connectorGravityTest",
        text: include_str!("satellites.toml"),
        end: 1e6,
        step: 50.0,
        // The farthest, on its circle; the star is heavier by 1e17.
        exact: Some((
            || {
                let angle = (6.6743e-11 * 1e20_f64 / 1e18).sqrt() * 1e6;
                1e6 * (angle.cos() + angle.sin())
            },
            1e-3,
        )),
        refined: Some((1_014_867.395_06, 1e-3)),
    },
    Published {
        name: "two trees of links that are led",
        called: "createKinematicTreeTest",
        text: include_str!("link-trees.toml"),
        end: 1.2,
        step: 5e-4,
        exact: None,
        refined: Some((3.340_819_520_32, 1e-10)),
    },
    Published {
        name: "a wheel on a table that is braked from an event on",
        called: "rotatingTableTest",
        text: include_str!("rotating-table.toml"),
        end: 5.0,
        step: 2.5e-3,
        exact: None,
        refined: Some((0.278_930_165, 1e-8)),
    },
    Published {
        name: "a pendulum that lets go of a mass and of its pivot",
        called: "switchingConstraintsPendulum",
        text: include_str!("released-pendulum.toml"),
        end: 2.0,
        step: 1e-3,
        exact: Some((
            || {
                // From a circle about (-1, 0) both leave along its tangent with 2 m/s.
                let leaves = |angle: f64, time: f64| {
                    let (sine, cosine) = angle.sin_cos();
                    [0.5 * cosine - 2.0 * time * sine, 0.5 * sine + 2.0 * time * cosine]
                };
                let (mass, rod) = (leaves(0.4, 1.9), leaves(1.2, 1.7));
                (mass[0] - rod[0]).hypot(mass[1] - rod[1])
            },
            5e-7,
        )),
        refined: Some((2.803_890_66, 5e-7)),
    },
    Published {
        name: "a mass that sticks and slips on bristles",
        called: "lugreFrictionTest",
        text: include_str!("bristle.toml"),
        end: 25.0,
        step: 1e-3,
        exact: None,
        refined: Some((1.908_839_199_2, 1e-8)),
    },
    Published {
        name: "two shafts and a cross",
        called: "universalJoint",
        text: include_str!("universal-joint.toml"),
        end: 6.0,
        step: 2e-3,
        // The second shaft goes round as often as the first.
        exact: Some((
            || {
                let first = 60.0_f64;
                let second = ((0.25 * PI).cos() * first.sin()).atan2(first.cos());
                second + 2.0 * PI * ((first - second) / (2.0 * PI)).round()
            },
            1e-10,
        )),
        refined: Some((59.912_814_470_8, 1e-9)),
    },
];

const MBDYN: &[Published] = &[
    Published {
        name: "a body on a screw along an oblique axis",
        called: "joints/screw/screw_test_1",
        text: include_str!("screw.toml"),
        end: 1.0,
        step: 1e-2,
        exact: Some((
            || {
                let travel = 0.01 / (2.0 * PI);
                let turning = 3.0 - 9.81 / 3.0_f64.sqrt() * travel;
                3.0_f64.sqrt() * travel * 0.5 * turning / (1.0 + travel * travel)
            },
            1e-14,
        )),
        refined: None,
    },
    Published {
        name: "two geared rotors under a moment for half a second",
        called: "joints/total/gear",
        text: include_str!("gear.toml"),
        end: 2.0,
        step: 1e-2,
        exact: Some((|| -5.0, 1e-12)),
        refined: None,
    },
    Published {
        name: "a body that cannot turn, on springs along three axes",
        called: "joints/deformablehinge/deformabledisplacementjoint0",
        text: include_str!("bushing-slide.toml"),
        end: 0.15,
        step: 1e-4,
        exact: Some((
            || {
                let (own, forced) = (4000.0_f64.sqrt(), 1000.0_f64.sqrt());
                let led = (forced * 0.15).sin() - forced / own * (own * 0.15).sin();
                3.0 * 10.0 / (0.25 * 3000.0) * led + 10.0 / own * (own * 0.15).sin()
            },
            1e-11,
        )),
        refined: None,
    },
    Published {
        name: "a mass that falls towards a centre",
        called: "body/centralgravity",
        text: include_str!("central-gravity.toml"),
        end: 1.0,
        step: 1e-3,
        exact: Some((|| motion(&|_, [place, _]| -0.667_384 / (place * place), [1.0, 0.0], 1.0), 1e-12)),
        refined: None,
    },
    Published {
        name: "states on their way to a limit cycle",
        called: "genel/hopf-bifurcation/hb",
        text: include_str!("limit-cycle.toml"),
        end: 5.0,
        step: 5e-3,
        exact: Some((
            || {
                // The squared radius grows by (r²)' = 2 r² (0.1 - 0.01 r²); the phase is its integral. Here 2 · 0.1 · 5 = 1.
                let growth = 1.0_f64.exp();
                let squared = 0.1 * growth / (0.01 * growth + 0.09);
                let phase = 50.0 * ((0.01 * growth + 0.09) / 0.1).ln();
                squared.sqrt() * phase.cos()
            },
            1e-9,
        )),
        refined: None,
    },
    Published {
        name: "a pendulum with drag",
        called: "forces/force/pendulum-drag",
        text: include_str!("drag-pendulum.toml"),
        end: 2.0,
        step: 1e-3,
        exact: Some((
            || {
                let drag = 0.5 * 1.225;
                motion(&|_, [angle, rate]| -9.81 * angle.sin() - drag * rate.abs() * rate, [0.0, 1.0], 2.0)
                    .sin()
            },
            1e-10,
        )),
        refined: None,
    },
    Published {
        name: "a motor with the current as a state",
        called: "elec/motor",
        text: include_str!("motor.toml"),
        end: 0.1,
        step: 1e-4,
        exact: Some((
            || {
                motion(
                    &|t, [speed, growth]| {
                        (100.0 * (10.0 * PI * t).sin() - 10.0 * growth - 100.0 * speed) / 1e-3
                    },
                    [0.0, 0.0],
                    0.1,
                )
            },
            1e-11,
        )),
        refined: None,
    },
    Published {
        name: "a reed that is blown",
        called: "genel/clarinet-reed/cr",
        text: include_str!("reed.toml"),
        end: 2.0,
        step: 2e-3,
        exact: Some((
            || motion(&|_, [place, speed]| 1.0 - place + 5.0 * speed - speed.powi(3), [0.0, 0.0], 2.0),
            1e-11,
        )),
        refined: None,
    },
    Published {
        name: "a hinge that is held after half a second",
        called: "driven/initialassembly",
        text: include_str!("latched-hinge.toml"),
        end: 1.0,
        step: 1e-2,
        exact: Some((|| 0.5, 2e-8)),
        refined: None,
    },
];
