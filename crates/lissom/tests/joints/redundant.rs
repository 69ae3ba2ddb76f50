//! Constraints that repeat others. A planar four-bar of four parallel revolutes, of whose 24 constraints three do: it runs,
//! moves like the one without redundancy, and gives least forces. Two joints of one pair whose repeated pivot is round-off
//! that elimination does not take for zero.

use lissom::{Model, Record, Session};

fn four_bar(far: &str, foot: &str) -> String {
    format!(
        r#"
lissom = 1
gravity = [0, -9.81, 0]

[bodies.crank]
mass = 1.0
inertia = [1e-3, 0.02, 0.02]
position = [0.125, 0.25, 0]

[bodies.coupler]
mass = 2.0
inertia = [1e-3, 0.1, 0.1]
position = [0.75, 0.6, 0]

[bodies.rocker]
mass = 1.5
inertia = [1e-3, 0.05, 0.05]
position = [1.125, 0.35, 0]

[joints.A]
kind = "revolute"
base = "ground"
tip = "crank"
at = [0, 0, 0]
axis = [0, 0, 1]

[joints.B]
kind = "revolute"
base = "crank"
tip = "coupler"
at = [0.25, 0.5, 0]
axis = [0, 0, 1]

[joints.C]
base = "coupler"
tip = "rocker"
at = [1.25, 0.7, 0]
{far}

[joints.D]
base = "ground"
tip = "rocker"
at = [1, 0, 0]
{foot}

[outputs.C]
kind = "position"
of = "rocker"
point = [1.25, 0.7, 0]

[outputs.forces]
kind = "reaction"
of = "D"

[outputs.energy]
kind = "energy"

[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1.0
step = 2e-3
"#
    )
}

fn run(far: &str, foot: &str) -> (Record, Option<usize>) {
    let document = Model::from_text("four-bar", &four_bar(far, foot)).document().unwrap();
    let mut session = Session::new(&document).unwrap();
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    assert!(report.error().is_none(), "{:?}", report.error());
    (record, report.totals.regularized_at)
}

const HINGE: &str = "kind = \"revolute\"\naxis = [0, 0, 1]";
const BALL: &str = "kind = \"spherical\"";
const CROSS: &str = "kind = \"universal\"\naxis = [0, 0, 1]\nsecond_axis = [1, 0, 0]";

#[test]
fn four_parallel_revolutes_move_like_the_loop_without_redundancy() {
    let (redundant, yielded) = run(HINGE, HINGE);
    let (plain, held) = run(BALL, CROSS);
    assert!(yielded.is_some() && held.is_none());
    let last = redundant.times.len() - 1;
    for component in ["x", "y", "z"] {
        let [a, b] = [&redundant, &plain].map(|record| record.column("C", component).unwrap()[last]);
        assert!((a - b).abs() < 1e-8, "{component}: {a} and {b}");
    }
    // It moves, and what it need not bear it does not.
    let start = redundant.column("C", "x").unwrap();
    assert!((start[last] - start[0]).abs() > 0.1);
    for component in ["f3", "m1", "m2"] {
        let most =
            redundant.column("forces", component).unwrap().iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        assert!(most < 1e-4, "{component}: {most}");
    }
}

/// A chain whose last body is held by `link`.
fn chain(link: &str, step: &str) -> Record {
    let text = format!(
        r#"
lissom = 1
gravity = [0, -9.81, 0]

[bodies.first]
mass = 1.51
inertia = [0.016888, 0.007053, 0.016461]
position = [0.4552, -0.4248, -0.4704]

[bodies.second]
mass = 2.49
inertia = [0.017973, 0.019856, 0.020098]
position = [0.9276, -0.5388, 0.0144]
rotation = [-1.479, -0.861, -0.03]

[bodies.third]
mass = 0.838
inertia = [0.011048, 0.010762, 0.009022]
position = [0.6404, -0.6684, -0.3756]
center_of_mass = [0.0475, 0.028, -0.0256]

[joints.ball]
kind = "spherical"
base = "ground"
tip = "first"
at = [0.20424, -0.23704, -0.26016]

[joints.thread]
kind = "screw"
base = "first"
tip = "second"
at = [0.70324, -0.42004, -0.23136]
axis = [0.42, 0.082, 0.38]
lead = 0.3447

{link}

[outputs.third]
kind = "acceleration"
of = "third"

[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 4e-3
{step}
"#
    );
    let document = Model::from_text("chain", &text).document().unwrap();
    let (record, report) = Session::new(&document).unwrap().run().unwrap().into_parts();
    let totals = report.totals;
    // Nearly thirty in each step where the repeated pivot was round-off.
    assert!(totals.factorizations <= 2 + totals.steps / 2, "{totals:?}");
    record
}

const CLAMP: &str = "[joints.link]\nkind = \"clamp\"\nbase = \"second\"\ntip = \"third\"";
const TWO_JOINTS: &str = r#"
[joints.shafts]
kind = "constant_velocity"
base = "second"
tip = "third"
at = [0.7528, -0.58168, -0.20844]
axis = [0.236, -0.138, -0.824]

[joints.point]
kind = "spherical"
base = "third"
tip = "second"
at = [0.82848, -0.65288, -0.21084]
"#;

#[test]
fn two_joints_that_repeat_each_other_accelerate_like_a_clamp() {
    for step in ["step = 1e-3", "step = 2e-5", "relative_tolerance = 1e-5"] {
        let [clamped, jointed] = [CLAMP, TWO_JOINTS].map(|link| chain(link, step));
        for component in ["a1", "a2", "a3"] {
            let [a, b] = [&clamped, &jointed].map(|record| record.column("third", component).unwrap());
            assert!((a[0] - b[0]).abs() < 1e-9, "{step}, {component} at the start: {} and {}", a[0], b[0]);
            let [a, b] = [a, b].map(|values| values[values.len() - 1]);
            assert!((a - b).abs() < 2e-3, "{step}, {component}: {a} and {b}");
        }
    }
}
