//! The properties of the energy-decaying scheme, on a rigid and flexible spatial model.

use lissom::start::lower;
use lissom_core::simulation::Simulation;
use lissom_model::Document;
use lissom_model::lower::registry::registry;

use crate::support::runs;

const MODEL: &str = include_str!("../../../../examples/energy.toml");

/// Every joint, spring and order of beam in one mechanism.
const EVERY_KIND: &str = include_str!("every_kind.toml");

fn start(overrides: &[(&str, &str)]) -> (Simulation, usize) {
    start_of(MODEL, overrides)
}

fn start_of(model: &str, overrides: &[(&str, &str)]) -> (Simulation, usize) {
    let overrides = runs::overrides(overrides);
    let document = Document::parse_with(model, "energy.toml", &registry(), &overrides)
        .unwrap_or_else(|report| panic!("{}", report.render(false)));
    let lowered = lower(&document).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let simulation = Simulation::new(lowered.system, lowered.state, lowered.settings).expect("consistent");
    (simulation, lowered.plan.steps)
}

fn total(simulation: &Simulation) -> f64 {
    simulation.system().energy_of(simulation.state()).total()
}

/// Energy that is exchanged: the scale that round-off is measured with.
const SCALE: f64 = 1.0;

#[test]
fn energy_never_increases_for_any_step() {
    // The shortest steps see the beam buckle and swing back, at a quarter of the cost.
    for (step, end) in [("1e-4", "0.5"), ("1e-3", "2.0"), ("1e-2", "2.0"), ("3e-2", "2.0"), ("0.1", "2.0")] {
        let (mut simulation, steps) = start(&[("analysis.step", step), ("analysis.end", end)]);
        let first = total(&simulation);
        let mut before = first;
        let mut worst = f64::NEG_INFINITY;
        for _ in 0..steps {
            simulation.step().unwrap_or_else(|error| panic!("{error}"));
            let now = total(&simulation);
            worst = worst.max(now - before);
            before = now;
        }
        println!(
            "step {step}: energy {first:.6} to {before:.6}, largest increase {worst:e}, {:?}",
            simulation.totals()
        );
        assert!(worst < 1e-12 * SCALE, "step {step}: energy grew by {worst:e}");
    }
}

#[test]
fn energy_is_preserved_where_nothing_is_to_be_damped() {
    for (step, end) in [("2e-4", "0.2"), ("5e-4", "0.5"), ("1e-3", "2.0")] {
        let (mut simulation, steps) =
            start(&[("analysis.step", step), ("analysis.end", end), ("analysis.spectral_radius", "1.0")]);
        let first = total(&simulation);
        for _ in 0..steps {
            simulation.step().unwrap_or_else(|error| panic!("{error}"));
        }
        let change = total(&simulation) - first;
        println!("step {step}: change of energy {change:e}, {:?}", simulation.totals());
        assert!(change.abs() < 1e-10 * SCALE, "{change:e}");
    }
}

#[test]
fn energy_never_increases_with_any_joint_spring_or_beam() {
    let named = |name: &str| EVERY_KIND.contains(&format!("kind = \"{name}\""));
    // Prescribed motions bring power from outside; the work of sliders and means of sets in a step is of the order of the scheme.
    let is_covered =
        |name: &str| !name.starts_with("prescribed") && !["slider", "mean_motion"].contains(&name);
    let joints = lissom_core::joints::KINDS.iter().filter(|kind| is_covered(kind.name));
    assert!(joints.clone().count() >= 9 && joints.clone().all(|kind| named(kind.name)));
    // The bristles of friction are first-order states, which the scheme's promise does not cover; forces of stops and
    // bushings are those at its stages, not integrated over the step.
    // What latches take at the instant is no matter of a step.
    let is_at_stages = |name: &str| {
        ["friction", "stop", "latch"].iter().any(|end| name.ends_with(end))
            || ["bearing", "bushing", "journal_bearing", "rolling_contact", "tyre"].contains(&name)
    };
    let mut springs = lissom_core::elements::SPRINGS.iter().filter(|kind| !is_at_stages(kind.name));
    assert!(springs.all(|kind| named(kind.name)));
    for (step, radius, bound) in
        [("1e-3", "0.0", 1e-12), ("5e-3", "0.0", 1e-12), ("2e-2", "0.0", 1e-12), ("1e-3", "1.0", 1e-10)]
    {
        let changes =
            [("analysis.step", step), ("analysis.spectral_radius", radius), ("analysis.end", "0.5")];
        let (mut simulation, steps) = start_of(EVERY_KIND, &changes);
        let mut before = total(&simulation);
        for _ in 0..steps {
            simulation.step().unwrap_or_else(|error| panic!("{error}"));
            let now = total(&simulation);
            assert!(now - before < bound * SCALE, "step {step}: energy grew by {:e}", now - before);
            before = now;
        }
    }
}

/// Two bodies that tumble, each spring that is integrated over a step alone between them, and beams of each order.
const TUMBLING: &str = r"
lissom = 1
[bodies.a]
mass = 1
inertia = [0.02, 0.05, 0.04]
position = [0, 0, 0]
velocity = [0.1, -0.4, 0.2]
angular_velocity = [3, -2, 4]
[bodies.b]
mass = 0.6
inertia = [0.03, 0.02, 0.04]
position = [1, 0.2, -0.1]
velocity = [-0.3, 0.5, 0.1]
angular_velocity = [-2, 3, 1]
";
const SECTION: &str = r#"
[sections.bar]
shape = "general"
stiffness = [2e3, 2e3, 2e3, 8, 6, 9]
mass = { per_length = 0.3, inertia = [4e-4, 2e-4, 2e-4] }
"#;

/// What holds the two bodies together, by kind.
fn holds() -> Vec<(String, String)> {
    let joint = "[joints.j]\nkind = \"cylindrical\"\nbase = \"a\"\ntip = \"b\"\nat = [0.5, 0, 0]\naxis = [0.2, 1, 0.3]\n";
    let mut all: Vec<(String, String)> = [
        ("point", "base = \"a\"\ntip = \"b\"\nat_base = [0.1, 0.3, 0]\nat_tip = [0.9, 0, 0.2]\nstiffness = 300\nlength = 0.6"),
        (
            "rope",
            "along = [{ on = \"a\", at = [0.1, 0.2, 0] }, { on = \"ground\", at = [0.4, 0.6, 0.5] }, \
             { on = \"b\", at = [0.9, -0.1, 0] }, { on = \"a\", at = [0, -0.2, 0.1] }]\nstiffness = 10\nlength = 0.1",
        ),
    ]
    .map(|(kind, rest)| (kind.to_owned(), format!("[springs.s]\nkind = \"{kind}\"\n{rest}\n")))
    .into();
    for (kind, stiffness) in [("axial", 300), ("torsional", 8)] {
        let spring = format!("[springs.s]\nkind = \"{kind}\"\njoint = \"j\"\nstiffness = {stiffness}\n");
        all.push((kind.to_owned(), format!("{joint}{spring}")));
    }
    for order in 1..=3 {
        let beam = format!(
            "{SECTION}[beams.s]\nsection = \"bar\"\nfrom = [0.1, 0, 0.1]\nto = [0.9, 0.2, 0]\nelements = 2\norder = {order}\n\
             [joints.first]\nkind = \"clamp\"\nbase = \"a\"\ntip = \"s.start\"\n\
             [joints.last]\nkind = \"clamp\"\nbase = \"b\"\ntip = \"s.end\"\n"
        );
        all.push((format!("beam of order {order}"), beam));
    }
    all
}

/// Steps over which springs turn and stretch by much: the forces of each alone do exactly the work that its energy changes by.
#[test]
fn each_spring_and_beam_alone_preserves_energy_over_long_steps() {
    for (kind, hold) in holds() {
        for step in ["2e-3", "1e-2"] {
            let text = format!(
                "{TUMBLING}{hold}[analysis]\nkind = \"dynamics\"\nscheme = \"energy-decaying\"\nspectral_radius = 1.0\n\
                 end = 0.3\nstep = {step}\n"
            );
            let (mut simulation, steps) = start_of(&text, &[]);
            let first = total(&simulation);
            let stored = |simulation: &Simulation| simulation.system().energy_of(simulation.state()).strain;
            let mut most = [0.0_f64; 2];
            for _ in 0..steps {
                simulation.step().unwrap_or_else(|error| panic!("{error}"));
                most[0] = most[0].max((total(&simulation) - first).abs());
                most[1] = most[1].max(stored(&simulation));
            }
            println!("{kind}, {step}: {most:?}");
            assert!(most[1] > 0.02, "{kind}: it is strained: {most:?}");
            assert!(most[0] < 1e-10, "{kind}, step {step}: {most:?}");
        }
    }
}

/// Position and velocity of the second body at 4 ms.
fn bob(step: &str) -> [lissom_motion::Vector3; 2] {
    const BOB: usize = 2;
    let (mut simulation, steps) = start(&[("analysis.step", step), ("analysis.end", "0.004")]);
    for _ in 0..steps {
        simulation.step().unwrap_or_else(|error| panic!("{error}"));
    }
    let node = &simulation.state().kinematics.nodes[BOB];
    let velocity = node.twist.fixed_rows::<3>(0).into_owned();
    [node.frame.position, node.frame.rotation.apply(&velocity)]
}

#[test]
fn places_and_velocities_of_a_flexible_chain_are_of_second_order() {
    // Steps that resolve the waves which the release sends through the beam: velocities show them.
    let reference = bob("5e-7");
    let errors = ["1e-5", "5e-6", "2.5e-6"].map(|step| {
        let found = bob(step);
        [0, 1].map(|k| (found[k] - reference[k]).norm())
    });
    for pair in errors.windows(2) {
        let orders = [0, 1].map(|k| (pair[0][k] / pair[1][k]).log2());
        println!("errors {:?}, orders {orders:.2?}", pair[1]);
        assert!(orders.iter().all(|&order| order >= 1.9), "{orders:?}");
    }
}

#[test]
fn newtons_tolerance_is_the_users() {
    let run = |overrides: &[(&str, &str)]| {
        let (mut simulation, steps) = start(&[&[("analysis.end", "0.5")], overrides].concat());
        let first = total(&simulation);
        let mut most = first;
        for _ in 0..steps {
            simulation.step().unwrap_or_else(|error| panic!("{error}"));
            most = most.max(total(&simulation));
        }
        (simulation.totals().newton_iterations, most - first)
    };
    let [(by_default, none), (exact, _), (coarse, grown)] =
        [&[][..], &[("analysis.tolerance", "1e-12")], &[("analysis.tolerance", "1e-3")]].map(run);
    println!("{by_default} iterations, {exact} with 1e-12, {coarse} with 1e-3, which gains {grown:e}");
    assert!(by_default == exact && 4 * coarse < 3 * exact);
    // The promise holds for exact solutions only.
    assert!(none < 1e-12 * SCALE && grown < 1e-3 * SCALE);
}
