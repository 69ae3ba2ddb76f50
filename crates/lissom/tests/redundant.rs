//! A planar four-bar of four parallel revolutes: three of its 24 constraints repeat others. It runs, moves like the one
//! without redundancy, and gives least forces.

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
    let document = Model::from_text("four-bar", &four_bar(far, foot)).document(&[]).unwrap();
    let mut session = Session::new(&document).unwrap();
    let (record, report) = session.record();
    assert!(report.error().is_none(), "{:?}", report.error());
    (record, report.totals.yielded_at)
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
