//! Whole systems in time: orders of convergence, energy, drift, statics.

use lissom_core::elements::inertia::Inertia;
use lissom_core::elements::{Attached, LOADS};
use lissom_core::flexible::beam::SectionLaw;
use lissom_core::flexible::beam::line::{BeamLineDescription, beam_line};
use lissom_core::joints;
use lissom_core::kinematics::Freedoms;
use lissom_core::newton::Limits;
use lissom_core::registry::{Parameters, Value};
use lissom_core::scaling::ScalingChoice;
use lissom_core::schemes::{Scheme, energy_decaying, generalized_alpha, radau_iia, statics};
use lissom_core::settings::Settings;
use lissom_core::simulation::Simulation;
use lissom_core::system::{Builder, Placement, State, System};
use lissom_motion::{Matrix3, Matrix6, Motion, Vector3, Vector6};

fn joint_kind(name: &str) -> &'static joints::JointKind {
    joints::KINDS.iter().find(|kind| kind.name == name).expect("registered")
}

fn simulation((system, state): (System, State), scheme: Scheme, step_size: f64) -> Simulation {
    let settings = Settings {
        scheme,
        step_size,
        control: None,
        scaling: ScalingChoice::default(),
        limits: Limits { tolerance: 1e-10, ..Limits::default() },
        solver: lissom_solver::kind("sparse").expect("registered"),
        threads: 1,
        from_equilibrium: false,
        follow_drives: true,
        energy_check: true,
    };
    Simulation::new(system, state, settings).expect("consistent")
}

/// The heavy top [Brüls, Cardona and Arnold 2012]: fixed point at the origin.
fn top() -> (System, State) {
    let mut builder = Builder::new();
    builder.set_gravity(Vector3::new(0.0, 0.0, -9.81));
    let center = Vector3::new(0.0, 1.0, 0.0);
    let node = builder.add_node("top", Motion::translation(center), Freedoms::Full);
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.234_375, 0.468_75, 0.234_375));
    builder.add_inertia(node, &Inertia::of_rigid_body(15.0, &Vector3::zeros(), &inertia));
    let spin = Vector3::new(0.0, 150.0, -4.615_38);
    let velocity = spin.cross(&center);
    builder.set_twist(node, Vector6::new(velocity.x, velocity.y, velocity.z, spin.x, spin.y, spin.z));
    let placement = Placement {
        nodes: [builder.ground(), node],
        at: Vector3::zeros(),
        at_tip: None,
        axis: None,
        second_axis: None,
    };
    builder.add_joint("pivot", joint_kind("spherical"), &placement, &Parameters::new()).expect("valid");
    builder.build(0.0).expect("valid")
}

fn run(simulation: &mut Simulation, steps: usize) {
    for _ in 0..steps {
        simulation.step().expect("converges");
    }
}

/// Schemes of one stage remember what belongs to the step size: an attempt of another size must not change it.
#[test]
fn a_step_that_fails_leaves_no_trace_in_the_state() {
    let mut simulation = simulation(top(), generalized_alpha::hht(-0.1).expect("valid"), 1e-3);
    run(&mut simulation, 20);
    let before = simulation.state().clone();
    simulation.set_step_size(1e3);
    simulation.step().expect_err("hundred turns in a part of a step");
    assert_eq!(*simulation.state(), before);
    simulation.set_step_size(1e-3);
    run(&mut simulation, 1);
    let node = &simulation.state().kinematics;
    assert!((node.time - before.kinematics.time - 1e-3).abs() < 1e-12, "{}", node.time);
}

#[test]
fn heavy_top_reaches_the_reference() {
    let steps = 8000;
    let mut simulation = simulation(top(), radau_iia::two_stages(), 1.0 / f64::from(steps));
    run(&mut simulation, steps as usize);
    let node = simulation.state().kinematics.nodes[1];
    let reference = Vector3::new(1.733_439_640_983_86e-1, 6.400_885_920_705_69e-1, -7.484_907_911_335_81e-1);
    let error = (node.frame.position - reference).norm();
    println!("radau top error {error:e}, totals {:?}", simulation.totals());
    assert!(error < 2e-5);
}

/// Position, velocity and multiplier of the top at 0.05 s.
fn top_at(scheme: Scheme, steps: usize) -> [Vector3; 3] {
    let mut simulation = simulation(top(), scheme, 0.05 / steps as f64);
    run(&mut simulation, steps);
    let state = simulation.state();
    let node = &state.kinematics.nodes[1];
    let multipliers = Vector3::from_column_slice(&state.multipliers);
    [node.frame.position, node.velocity_at(&Vector3::zeros()), multipliers]
}

#[test]
fn schemes_have_their_orders_for_position_velocity_and_multiplier() {
    let reference = top_at(radau_iia::three_stages(), 1024);
    let schemes: [(&str, Scheme, [f64; 3], usize); 8] = [
        ("generalized-alpha", generalized_alpha::with_spectral_radius(0.8).expect("valid"), [2.0; 3], 512),
        ("hht", generalized_alpha::hht(-0.3).expect("valid"), [2.0; 3], 512),
        ("radau", radau_iia::two_stages(), [3.0, 2.0, 1.0], 64),
        ("radau with three stages", radau_iia::three_stages(), [5.0, 3.0, 2.0], 16),
        ("radau with five stages", radau_iia::five_stages(), [9.0, 5.0, 4.0], 8),
        ("decaying", energy_decaying::with_spectral_radius(0.0).expect("valid"), [3.0, 3.0, 2.0], 256),
        ("mixed", energy_decaying::with_spectral_radius(0.5).expect("valid"), [2.0, 2.0, 1.0], 128),
        ("preserving", energy_decaying::with_spectral_radius(1.0).expect("valid"), [2.0, 2.0, 1.0], 256),
    ];
    for (name, scheme, orders, steps) in schemes {
        let errors = [steps, 2 * steps].map(|steps| {
            let result = top_at(scheme.clone(), steps);
            [0, 1, 2].map(|i| (result[i] - reference[i]).norm())
        });
        for i in 0..3 {
            let order = (errors[0][i] / errors[1][i]).log2();
            println!("{name} {i}: errors {:e} {:e}, order {order:.2}", errors[0][i], errors[1][i]);
            assert!(order > orders[i] - 0.15, "{name}: order {order} of quantity {i}");
        }
    }
}

/// Within a step the motion has an error of the order of the polynomial through the stages, or of the cubic between the ends.
#[test]
fn schemes_have_their_order_between_the_ends_of_a_step() {
    let schemes: [(&str, Scheme, f64, usize); 5] = [
        ("generalized-alpha", generalized_alpha::with_spectral_radius(0.8).expect("valid"), 2.0, 256),
        ("radau", radau_iia::two_stages(), 3.0, 64),
        ("radau with three stages", radau_iia::three_stages(), 4.0, 16),
        ("radau with five stages", radau_iia::five_stages(), 6.0, 8),
        ("radau with seven stages", radau_iia::seven_stages(), 8.0, 6),
    ];
    for (name, scheme, order, steps) in schemes {
        let [coarse, fine] = [steps, 2 * steps].map(|steps| {
            let step = 0.05 / steps as f64;
            let mut stepped = simulation(top(), scheme.clone(), step);
            run(&mut stepped, steps);
            let time = 0.05 - 0.63 * step;
            let mut within = stepped.state().clone();
            stepped.interpolate(time, &mut within);
            let mut reference = simulation(top(), radau_iia::five_stages(), time / 128.0);
            run(&mut reference, 128);
            let place = |state: &State| state.kinematics.nodes[1].frame.position;
            (place(&within) - place(reference.state())).norm()
        });
        let found = (coarse / fine).log2();
        println!("{name}: errors {coarse:e} {fine:e}, order {found:.2}");
        assert!(found > order - 0.3, "{name}: order {found}");
    }
}

/// Largest second difference of the top's multipliers over some steps, and the largest multiplier.
fn roughness(simulation: &mut Simulation, steps: usize) -> (f64, f64) {
    let mut last = [Vector3::zeros(); 2];
    let (mut rough, mut largest) = (0.0_f64, 0.0_f64);
    for step in 0..steps {
        simulation.step().expect("converges");
        let now = Vector3::from_column_slice(&simulation.state().multipliers);
        if step > 1 {
            rough = rough.max((now - 2.0 * last[1] + last[0]).norm());
        }
        largest = largest.max(now.norm());
        last = [last[1], now];
    }
    (rough, largest)
}

#[test]
fn multipliers_of_the_energy_decaying_scheme_stay_smooth() {
    for radius in [0.0, 0.5, 1.0] {
        let scheme = energy_decaying::with_spectral_radius(radius).expect("valid");
        let mut simulation = simulation(top(), scheme, 2e-4);
        let (early, _) = roughness(&mut simulation, 500);
        run(&mut simulation, 9000);
        let (late, largest) = roughness(&mut simulation, 500);
        println!("radius {radius}: second differences {early:e}, {late:e} of multipliers up to {largest:e}");
        assert!(late < 3.0 * early && late < 1e-2 * largest, "{radius}: {early:e} {late:e}");
    }
}

fn law(stiffness: [f64; 6]) -> SectionLaw {
    SectionLaw::elastic(Matrix6::from_diagonal(&Vector6::from_row_slice(&stiffness)))
}

fn straight(s: f64, length: f64) -> Motion {
    Motion::translation(Vector3::new(s * length, 0.0, 0.0))
}

/// The load factor is the time.
#[derive(Debug)]
struct Ramp;
impl lissom_core::registry::TimeFunction for Ramp {
    fn value(&self, time: f64) -> f64 {
        time
    }
    fn first_derivative(&self, _: f64) -> f64 {
        1.0
    }
    fn second_derivative(&self, _: f64) -> f64 {
        0.0
    }
}

#[test]
fn cantilever_rolls_up_to_a_circle() {
    let mut builder = Builder::new();
    let (length, bending) = (10.0, 86.9e3);
    let (contribution, line) = beam_line(
        builder.model(),
        &BeamLineDescription {
            name: "beam",
            elements: 8,
            order: 3,
            frame: &|s| straight(s, length),
            law: &|_| law([1770e3, 1770e3, 1770e3, 8.16e3, bending, 215e3]),
            mass: &|_, _| Matrix6::identity(),
            ends: [None, None],
        },
    );
    builder.add(contribution);
    let placement = Placement {
        nodes: [builder.ground(), line.nodes[0]],
        at: Vector3::zeros(),
        at_tip: None,
        axis: None,
        second_axis: None,
    };
    builder.add_joint("root", joint_kind("clamp"), &placement, &Parameters::new()).expect("valid");
    let end = *line.nodes.last().expect("there");
    let moment = Vector3::new(0.0, -2.0 * std::f64::consts::PI * bending / length, 0.0);
    let load = LOADS.iter().find(|kind| kind.name == "moment").expect("registered");
    let parameters = Parameters::new()
        .with("vector", Value::Vector(moment))
        .with("scale", Value::Function(std::sync::Arc::new(Ramp)));
    builder.add_of_kind(load, Attached::to_nodes([(end, Vector3::zeros())]), &parameters).expect("valid");
    let steps = 10;
    let mut simulation = simulation(builder.build(0.0).expect("valid"), statics::statics(), 0.1);
    run(&mut simulation, steps);
    let tip = simulation.state().kinematics.nodes[end].frame.position;
    println!("tip {tip:?} totals {:?}", simulation.totals());
    assert!(tip.norm() < 1e-8, "{tip:?}");
}

/// A rope of rubber, pinned at the origin, in the frame `turn` of everything.
fn rope(turn: &Motion, elements: usize) -> (System, State) {
    let mut builder = Builder::new();
    builder.set_gravity(turn.rotation.apply(&Vector3::new(0.0, -9.81, 2.0)));
    let radius = 0.005_f64;
    let area = std::f64::consts::PI * radius * radius;
    let inertia = area * radius * radius / 4.0;
    let (young, shear, density) = (5e6, 5e6 / 3.0, 1100.0);
    let stiffness =
        [young * area, shear * area, shear * area, 2.0 * shear * inertia, young * inertia, young * inertia];
    let mass = [area, area, area, 2.0 * inertia, inertia, inertia].map(|value| density * value);
    let (contribution, line) = beam_line(
        builder.model(),
        &BeamLineDescription {
            name: "rope",
            elements,
            order: 3,
            frame: &|s| *turn * straight(s, 1.0),
            law: &|_| law(stiffness),
            mass: &|_, _| Matrix6::from_diagonal(&Vector6::from_row_slice(&mass)),
            ends: [None, None],
        },
    );
    builder.add(contribution);
    let placement = Placement {
        nodes: [builder.ground(), line.nodes[0]],
        at: turn.position,
        at_tip: None,
        axis: None,
        second_axis: None,
    };
    builder.add_joint("pivot", joint_kind("spherical"), &placement, &Parameters::new()).expect("valid");
    builder.build(0.0).expect("valid")
}

#[test]
fn free_flexible_pendulum_keeps_its_energy_as_the_scheme_promises() {
    for (scheme, gain, loss) in [
        (generalized_alpha::with_spectral_radius(1.0).expect("valid"), 1e-3, 1e-3),
        (generalized_alpha::hht(-0.05).expect("valid"), 1e-4, 1e-2),
        (radau_iia::two_stages(), 1e-6, 1e-2),
    ] {
        let name = scheme.name.clone();
        let mut simulation = simulation(rope(&Motion::identity(), 4), scheme, 1e-3);
        let start = simulation.system().energy_of(simulation.state()).total();
        run(&mut simulation, 500);
        let end = simulation.system().energy_of(simulation.state());
        let change = (end.total() - start) / end.kinetic;
        println!("{name}: relative change of energy {change:e}, {:?}", simulation.totals());
        assert!(change < gain && change > -loss, "{name}: relative change of energy {change:e}");
    }
}

#[test]
fn turned_models_give_turned_results() {
    let turn = Motion::exponential(&Vector6::new(3.0, -2.0, 1.0, 0.7, -1.1, 2.0));
    for scheme in
        [generalized_alpha::hht(-0.1).expect("valid"), radau_iia::two_stages(), radau_iia::three_stages()]
    {
        let [straight, turned] = [Motion::identity(), turn].map(|turn| {
            let mut simulation = simulation(rope(&turn, 3), scheme.clone(), 2e-3);
            run(&mut simulation, 100);
            simulation.state().clone()
        });
        for (a, b) in straight.kinematics.nodes.iter().zip(&turned.kinematics.nodes).skip(1) {
            let place = (turn * a.frame).relative_to(&b.frame).logarithm();
            assert!(place.norm() < 1e-8, "{}: {place:?}", scheme.name);
            assert!((a.twist - b.twist).norm() < 1e-6);
        }
        let force = |state: &State| Vector3::from_column_slice(&state.multipliers).norm();
        assert!((force(&straight) - force(&turned)).abs() < 1e-8 * force(&straight));
    }
}

#[test]
fn constraints_do_not_drift_and_the_top_keeps_its_energy() {
    let mut simulation = simulation(top(), radau_iia::two_stages(), 1e-4);
    let energy = |simulation: &Simulation| simulation.system().energy_of(simulation.state());
    let start = energy(&simulation);
    run(&mut simulation, 100_000);
    let mut absolute = vec![0.0; 3];
    simulation.system().violations(&simulation.state().kinematics, &mut absolute);
    let worst = absolute.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let end = energy(&simulation);
    let change = (end.total() - start.total()) / start.kinetic;
    println!("violation {worst:e}, energy {change:e}, {:?}", simulation.totals());
    assert!(worst < 1e-13, "{worst:e}");
    let totals = simulation.totals();
    let per_step = totals.newton_iterations as f64 / totals.steps as f64;
    // How often the tangent is renewed depends on the last digits, and so on the processor and on
    // the order of a sum: the page states a bound.
    let bound = 500;
    assert!(totals.factorizations < bound, "{}", totals.factorizations);
    let figure = format!(
        "violation below 1e-13 m, {per_step:.1} iterations per step, fewer than {bound} factorisations"
    );
    let page = include_str!("../../../docs/measured.md");
    assert!(page.contains(&figure), "docs/measured.md does not say: {figure}");
    assert!(change.abs() < 1e-5 && change < 1e-9, "{change:e}");
}
