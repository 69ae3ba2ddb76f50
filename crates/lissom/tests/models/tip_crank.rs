//! The source's main problem, from its model file: lateral buckling of a beam lifted by a tip crank.

use lissom::start::lower;
use lissom_core::simulation::Simulation;
use lissom_model::Document;
use lissom_model::lower::registry::registry;

use crate::support::runs;

const TIP_CRANK: &str = include_str!("../../../../examples/tip-crank.toml");

const MEASURED: &str = include_str!("../../../../docs/measured.md");

/// The figure is in the book as it was measured.
fn assert_reported(figure: &str) {
    assert!(MEASURED.contains(figure), "docs/measured.md does not say: {figure}");
}

struct Run {
    /// Time and mid-span displacements.
    rows: Vec<[f64; 4]>,
    simulation: Simulation,
}

fn run(text: &str, overrides: &[(&str, &str)]) -> Run {
    let overrides = runs::overrides(overrides);
    let document = Document::parse_with(text, "tip-crank.toml", &registry(), &overrides)
        .unwrap_or_else(|report| panic!("{}", report.render(false)));
    let lowered = lower(&document).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let midspan = lowered.channels.iter().find(|channel| channel.name == "midspan").expect("recorded");
    let mut simulation =
        Simulation::new(lowered.system, lowered.state, lowered.settings).expect("consistent");
    let mut rows = Vec::new();
    for step in 0..=lowered.plan.steps {
        if step > 0 {
            simulation.step().unwrap_or_else(|error| panic!("{error}"));
        }
        let mut values = Vec::new();
        midspan.evaluate(simulation.system(), simulation.state(), &mut values);
        rows.push([simulation.state().kinematics.time, values[0], values[1], values[2]]);
    }
    Run { rows, simulation }
}

fn passes(run: &Run, level: f64) -> f64 {
    run.rows.iter().find(|row| row[2].abs() > level).map_or(f64::INFINITY, |row| row[0])
}

#[test]
fn lateral_buckling_sets_in_near_a_twentieth_of_a_second_with_both_schemes() {
    for overrides in [
        &[("analysis.scheme", "radau-iia"), ("analysis.step", "5e-4")][..],
        &[("analysis.scheme", "hht"), ("analysis.alpha", "-0.3"), ("analysis.step", "5e-4")][..],
    ] {
        let run = run(TIP_CRANK, overrides);
        let (tenth, one) = (passes(&run, 1e-4), passes(&run, 1e-3));
        println!("{overrides:?}: 0.1 mm at {tenth} s, 1 mm at {one} s, {:?}", run.simulation.totals());
        assert!((0.04..0.06).contains(&tenth), "0.1 mm passed at {tenth} s");
        assert!(one < 0.08, "1 mm passed at {one} s");
        if overrides.contains(&("analysis.scheme", "radau-iia")) {
            assert_reported(&format!(
                "lateral displacement passes 0.1 mm at {tenth:.3} s, 1 mm at {one:.3} s"
            ));
        }
        let totals = run.simulation.totals();
        assert_eq!((totals.steps, totals.rejected_steps), (800, 0));
        assert!((run.rows[800][0] - 0.4).abs() < 1e-12);
        let mut violations = vec![0.0; run.simulation.system().layout().multiplier_rows().len()];
        run.simulation.system().violations(&run.simulation.state().kinematics, &mut violations);
        let worst = violations.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        assert!(worst < 1e-9, "violation {worst}");
    }
}

/// Steps and tangents beside the speeds; times belong to a machine.
#[test]
fn a_tangent_serves_many_steps() {
    for step in ["1e-3", "1e-4"] {
        let overrides = [("analysis.scheme", "hht"), ("analysis.alpha", "-0.3"), ("analysis.step", step)];
        let totals = *run(TIP_CRANK, &overrides).simulation.totals();
        assert_reported(&format!("{} steps, {} tangents", totals.steps, totals.factorizations));
    }
}

/// u2 of the mid-span at 0.1 s converges with the step.
#[test]
fn lateral_displacement_converges_with_the_step() {
    let last = |step: &str, scheme: &str| {
        let run = run(
            TIP_CRANK,
            &[
                ("analysis.scheme", scheme),
                ("analysis.step", step),
                ("analysis.end", "0.1"),
                ("analysis.tolerance", "1e-9"),
            ],
        );
        run.rows.last().expect("there")[2]
    };
    let reference = last("2.5e-5", "radau-iia");
    println!("u2(0.1 s) = {reference:.10e}");
    // Below these steps the waves that the sudden start of the crank sends through the stiff bars begin to
    // be resolved; they contribute about 1e-6 and have an order of their own.
    let mut figures = Vec::new();
    for (scheme, steps, order, reached) in [
        ("radau-iia", ["2e-3", "1e-3", "5e-4"], 2.8, 1e-6),
        ("energy-decaying", ["2e-3", "1e-3", "5e-4"], 2.8, 1e-6),
        ("hht", ["1e-3", "5e-4", "2.5e-4"], 1.9, 1e-5),
    ] {
        let errors = steps.map(|step| (last(step, scheme) / reference - 1.0).abs());
        let orders = [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()];
        println!("{scheme}: relative errors {errors:?}, orders {orders:?}");
        let total = 0.5 * (errors[0] / errors[2]).log2();
        assert!(total > order, "{scheme}: orders {orders:?}, errors {errors:?}");
        let fine = (last("2.5e-4", scheme) / reference - 1.0).abs();
        assert!(fine < reached, "{scheme}: error {fine} at 2.5e-4 s");
        figures.push((total, orders[1], errors));
    }
    let [(_, radau, of_radau), (_, decaying, of_decaying), (hht, _, of_hht)] = figures[..] else {
        panic!("three schemes")
    };
    assert_reported(&format!(
        "Radau order {radau:.2}, HHT order {hht:.1}; {:.0e} and {:.1e} relative at h = 0.5 ms",
        of_radau[2], of_hht[1]
    ));
    assert_reported(&format!("order {decaying:.2}, {:.1e} relative at h = 0.5 ms", of_decaying[2]));
}

/// Without the sudden start the whole course converges at the order of the scheme, however stiff the bars.
#[test]
fn the_course_converges_at_third_order_where_the_crank_starts_smoothly() {
    let course = |step: &str, scheme: &str| {
        let overrides = [
            ("joints.drive.rotation", "\"0.12*sin(pi*t/0.2)^6\""),
            ("analysis.scheme", scheme),
            ("analysis.step", step),
            ("analysis.end", "0.1"),
        ];
        let run = run(TIP_CRANK, &overrides);
        let stride = (run.rows.len() - 1) / 50;
        run.rows.iter().step_by(stride).map(|row| row[2]).collect::<Vec<f64>>()
    };
    let reference = course("5e-5", "radau-iia");
    let size = reference.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let error = |step: &str| {
        let course = course(step, "energy-decaying");
        let differences = course.iter().zip(&reference).map(|(a, b)| (a - b).abs());
        differences.fold(0.0_f64, f64::max) / size
    };
    let errors = ["2e-3", "1e-3", "5e-4", "2.5e-4"].map(error);
    println!("energy-decaying, smooth start: relative errors {errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 2.7, "order {order}, errors {errors:?}");
    }
}

/// And with the mesh.
#[test]
fn lateral_displacement_converges_with_the_mesh() {
    let last = |factor: usize| {
        let counts = [8, 2, 4, 2].map(|count| (count * factor / 2).to_string());
        let run = run(
            TIP_CRANK,
            &[
                ("analysis.step", "2e-4"),
                ("analysis.end", "0.1"),
                ("beams.beam.elements", &counts[0]),
                ("beams.connector.elements", &counts[1]),
                ("beams.link.elements", &counts[2]),
                ("beams.crank.elements", &counts[3]),
            ],
        );
        run.rows.last().expect("there")[2]
    };
    let values = [1, 2, 4].map(last);
    let changes = [values[1] - values[0], values[2] - values[1]].map(|change| (change / values[2]).abs());
    println!("u2(0.1 s) with half, given and double mesh: {values:?}, changes {changes:?}");
    assert!(changes[1] < 1e-4 && changes[1] < 0.1 * changes[0]);
    assert_reported(&format!("{:.1e} relative from the given to the doubled mesh", changes[1]));
}

/// Static lateral buckling load of the cantilever alone under a dead tip load [Timoshenko and Gere 1961,
/// section 6.3]: P = 4.013 √(EI GJ)/L².
#[test]
fn static_buckling_load_of_the_cantilever() {
    // The lateral stiffness of the tip, from a tiny lateral load, vanishes at the buckling load; by
    // symmetry it is a function of P².
    let model = r#"
lissom = 1
[materials.aluminium]
E = 73e9
nu = 0.3
density = 2700
[sections.strip]
shape = "rectangle"
material = "aluminium"
width = 0.0025
height = 0.1
[beams.beam]
section = "strip"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 8
up = [0, 0, 1]
[joints.root]
kind = "clamp"
base = "ground"
tip = "beam.start"
[loads.down]
kind = "force"
on = "beam.end"
vector = [0, 0, 50]
scale = "t"
[loads.side]
kind = "force"
on = "beam.end"
vector = [0, 1e-6, 0]
[outputs.midspan]
kind = "displacement"
of = "beam.end"
[analysis]
kind = "statics"
steps = 60
end = 1.0
"#;
    let run = run(model, &[]);
    let (young, shear) = (73e9, 73e9 / 2.6);
    let (width, height) = (0.0025_f64, 0.1);
    let bending = young * height * width.powi(3) / 12.0;
    let torsion = shear * lissom_model::sections::rectangle_torsion_constant(width, height);
    let expected = 4.013 * (bending * torsion).sqrt();
    assert!(expected > 40.0 && expected < 50.0, "{expected}");
    // Two points well below the load: 1/u2 as a straight line in P².
    let points: Vec<(f64, f64)> = run
        .rows
        .iter()
        .filter(|row| (0.9..0.985).contains(&(50.0 * row[0] / expected)))
        .map(|row| ((50.0 * row[0]).powi(2), 1.0 / row[2]))
        .collect();
    assert!(points.len() >= 3, "{points:?}");
    let found = root_of_parabola(&points[points.len() - 3..]).sqrt();
    println!("buckling load {found} N, expected {expected} N");
    assert!((found / expected - 1.0).abs() < 5e-3, "{found} against {expected}");
    assert_reported(&format!("{:.3} % above 4.013", 100.0 * (found / expected - 1.0)));
}

/// Root beyond the last of three points of the parabola through them.
fn root_of_parabola(points: &[(f64, f64)]) -> f64 {
    let value = |x: f64| {
        (0..3)
            .map(|i| {
                let others = (0..3).filter(|&j| j != i);
                others.map(|j| (x - points[j].0) / (points[i].0 - points[j].0)).product::<f64>() * points[i].1
            })
            .sum::<f64>()
    };
    let (mut low, mut high) = (points[2].0, 3.0 * points[2].0);
    let sign = value(low);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if value(middle) * sign > 0.0 { low = middle } else { high = middle }
    }
    low
}
