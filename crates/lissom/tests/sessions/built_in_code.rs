//! Models built in code are those of files, to the last bit; their errors are reported.

use lissom::builder::analyses::{Dynamics, Statics};

use crate::support::runs;

use lissom::builder::joints::{
    Clamp, Friction, PrescribedRotation, Prismatic, Revolute, Spherical, SwingArm,
};
use lissom::builder::loads::{Force, JointForce, JointTorque};
use lissom::builder::outputs::{Displacement, Energy, Position, Reaction, Relative};
use lissom::builder::parts::{Beam, Body, PointMass};
use lissom::builder::sections::{General, Material, Rectangle, SliceMass, Tube};
use lissom::builder::springs::Torsional;
use lissom::builder::words::{Direction, Plane, Scheme};
use lissom::builder::{
    Event, Expression, GROUND, Input, ModelBuilder, Shear, Signal, State, TabulatedFunction, outputs,
};
use lissom::{Model, Override, Record};

/// What is recorded, and the iterations it took.
fn results(model: &Model, overrides: &[Override]) -> (Record, usize) {
    let mut session = model.with_overrides(overrides).session().unwrap_or_else(|error| panic!("{error}"));
    let (record, report) = session.run().unwrap().into_parts();
    (record, report.totals.newton_iterations)
}

/// The same numbers from the file of this name in the folder of examples, and from code.
fn assert_same(file: &str, builder: &ModelBuilder, overrides: &[(&str, &str)]) {
    let overrides = runs::overrides(overrides);
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(file);
    let of_file = results(&Model::read(&path).unwrap(), &overrides);
    let built = builder.build().unwrap_or_else(|report| panic!("{}", report.render(false)));
    assert!(of_file.0.times.len() > 10);
    assert_eq!(of_file, results(&built, &overrides), "{file}");
}

#[test]
fn a_pendulum() {
    let mut builder = ModelBuilder::new();
    let bob = PointMass::new(1.0).position([0.0, -1.0, 0.0]).plane(Plane::Xy).velocity([1.0, 0.0, 0.0]);
    let bob = builder.add_named("bob", bob);
    let arm = builder.add_named("arm", SwingArm::new(GROUND, bob, [0.0, 0.0, 1.0]).at([0.0; 3]));
    builder.add_named("spring", Torsional::new(arm).stiffness(10.0));
    builder.add_named("bob", Position::new(bob));
    builder.add_named("arm", Relative::new(arm));
    builder.add_named("force", Reaction::new(arm));
    builder.add_named("energy", Energy::new());
    let analysis =
        Dynamics::new(1.0).scheme(Scheme::GeneralizedAlpha).spectral_radius(0.8).step(1e-2).penalty(1.0);
    builder.add(analysis);
    assert_same("pendulum.toml", &builder, &[]);
}

#[test]
fn flexible_beams_that_share_nodes() {
    let mut builder = ModelBuilder::new();
    let aluminium = builder.add(Material::new(73e9, 2700.0).poisson_ratio(0.3));
    let steel = builder.add(Material::new(210e9, 7800.0).poisson_ratio(0.3));
    let strip = builder.add(Rectangle::new(aluminium, 0.0025, 0.1).shear(5.0 / 6.0));
    let tube = builder.add(Tube::new(steel, 0.015, 0.010).shear(Shear::Cowper));
    let (c, l, g) = ([1.0, 0.005, 0.0], [1.0, 0.005, -0.5], [0.97, 0.005, -0.5]);
    let up = [0.0, 0.0, 1.0];
    let line = |elements: usize| Beam::new(elements).order(3usize);
    let beam = line(8).section(strip).from([0.0; 3]).to([1.0, 0.0, 0.0]).up(up);
    let beam = builder.add_named("beam", beam);
    let connector = builder.add_named("connector", line(2).section(strip).from(beam.end()).to(c).up(up));
    let link = builder.add_named("link", line(4).section(tube).from(c).to(l));
    let crank = builder.add_named("crank", line(2).section(tube).from(l).to(g));
    let root = builder.add_named("root", Clamp::new(GROUND, beam.start()));
    builder.add_named("C", Spherical::new(connector.end(), link.start()));
    builder.add_named("L", Revolute::new(link.end(), crank.start(), [0.0, 1.0, 0.0]));
    let hinge = builder.add_named("G", Revolute::new(GROUND, crank.end(), [0.0, -1.0, 0.0]));
    let rotation = Expression::text("1.6*(1-cos(2*pi*t/1.6))");
    let drive = builder.add_named("drive", PrescribedRotation::new(hinge, rotation));
    builder.add_named("midspan", Displacement::new(beam.at(0.5)));
    builder.add_named("tip", Displacement::new(beam.end()));
    builder.add_named("root", Reaction::new(root));
    builder.add_named("drive", Reaction::new(drive));
    builder.add_named("energy", Energy::new());
    builder.add(Dynamics::new(0.4).scheme(Scheme::RadauIia).step(5e-4));
    assert_same("tip-crank.toml", &builder, &[("analysis.end", "0.01")]);
}

#[test]
fn a_sampled_controller_with_an_actuator() {
    let mut builder = ModelBuilder::new();
    builder.gravity([0.0, -9.81, 0.0]);
    let bar = builder.add_named("bar", Body::new(2.0, [0.002, 0.1, 0.1]).position([0.4, 0.0, 0.0]));
    let arm = builder.add_named("arm", Revolute::new(GROUND, bar, [0.0, 0.0, 1.0]).at([0.0; 3]));
    let target = builder.add_named("target", Input::starting_at(0.8));
    let ramp = (Expression::time() / 0.3).function("smoothstep");
    let reference = builder.add_named("reference", Signal::new(target * ramp));
    let period = 1e-3;
    let error = builder.add_named("error", Signal::sampled(reference - arm.angle(), period, 0.0));
    let sum = builder.add_named("sum", Signal::sampled(Expression::itself() + period * error, period, 0.0));
    let command = 60.0 * error + 80.0 * sum - 8.0 * arm.rate();
    let command = builder.add_named("command", Signal::sampled(command, period, 0.0));
    let torque = State::new((command - Expression::itself()) / 5e-3).magnitude(10.0);
    let torque = builder.add_named("torque", torque);
    let limited = Expression::from(-30.0).max(Expression::from(30.0).min(torque));
    builder.add_named("motor", JointTorque::new(arm, limited));
    builder.add_named("arm", Relative::new(arm));
    builder.add_named("reference", outputs::Signal::new(reference));
    builder.add_named("command", outputs::Signal::new(command));
    builder.add_named("torque", outputs::Signal::new(torque));
    builder.add(Dynamics::new(1.5).scheme(Scheme::RadauIia).step(1e-3).output_every(5usize));
    assert_same("controlled-arm.toml", &builder, &[("analysis.end", "0.2")]);
}

#[test]
fn tables_and_filters_of_signals() {
    let mut builder = ModelBuilder::new();
    let block = builder.add(Body::new(1.0, [1.0; 3]));
    builder.add(Prismatic::new(GROUND, block, [1.0, 0.0, 0.0]));
    let rows = TabulatedFunction::of_rows([[0.0, 1.0], [1.0, 3.0]]);
    let table = builder.add_named("table", Signal::tabulated(Expression::time(), rows));
    let mean = Signal::sampled(table, 0.1, 0.0).filtered([0.5, 0.5], [1.0]);
    let mean = builder.add_named("mean", mean);
    let last = builder.add_named("last", Signal::sampled(mean.last(), 0.1, 7.0));
    for (name, signal) in [("table", table), ("mean", mean), ("last", last)] {
        builder.add_named(name, outputs::Signal::new(signal));
    }
    builder.add(Dynamics::new(0.25).step(0.05));
    let (record, _) = results(&builder.build().unwrap(), &[]);
    let at_end = |name: &str| *record.column(name, "value").unwrap().last().unwrap();
    for (name, wanted) in [("table", 1.5), ("mean", 0.5 * (1.4 + 1.2)), ("last", 0.5 * (1.2 + 1.0))] {
        assert!((at_end(name) - wanted).abs() < 1e-12, "{name}");
    }
}

#[test]
fn events_and_steps_of_chosen_size() {
    let mut builder = ModelBuilder::new();
    builder.gravity([0.0, 0.0, -9.81]);
    let mass = builder.add_named("mass", Body::new(1.0, [1e-3, 1e-3, 1e-3]));
    let guide = builder.add_named("guide", Prismatic::new(GROUND, mass, [0.0, 0.0, 1.0]));
    let depth = Expression::from(0.0).max(Expression::from(-0.5) - guide.displacement());
    let depth = builder.add_named("depth", Signal::new(depth));
    let loss = Expression::from(0.0).max(1.0 - 0.2 * guide.velocity());
    builder.add_named("stop", JointForce::new(guide, 1e7 * depth * loss));
    let bounce = Event::new(guide.displacement() + 0.5).direction(Direction::Falling);
    builder.add_named("bounce", bounce);
    builder.add_named("top", Event::new(guide.velocity()).direction(Direction::Falling));
    builder.add_named("guide", Relative::new(guide));
    builder.add_named("depth", outputs::Signal::new(depth));
    builder.add(Dynamics::new(2.0).relative_tolerance(1e-6).output_step(0.01));
    assert_same("bouncing-mass.toml", &builder, &[]);
}

/// A cantilever under a tip force in load steps, with a general section.
fn cantilever() -> (ModelBuilder, lissom::builder::OutputId) {
    let mut builder = ModelBuilder::new();
    let mass = SliceMass::new(1.0, [2e-4, 1e-4, 1e-4]);
    let section = builder.add(General::new([1e6, 4e5, 4e5, 100.0, 200.0, 200.0], mass));
    let bar =
        builder.add(Beam::new(4usize).section(section).from([0.0; 3]).to([1.0, 0.0, 0.0]).order(2usize));
    builder.add(Clamp::new(GROUND, bar.start()));
    builder.add(Force::new(bar.end(), [0.0, 0.0, 1.0]).scale(3.0));
    let tip = builder.add(Displacement::new(bar.end()));
    builder.add(Statics::new().steps(4usize));
    (builder, tip)
}

#[test]
fn outputs_are_read_by_their_ids() {
    let (builder, tip) = cantilever();
    let mut session = builder.build().unwrap().session().unwrap();
    let record = session.run().unwrap();
    let columns = session.columns_of(tip).unwrap();
    assert_eq!(columns.len(), 3);
    let now = session.output(tip).unwrap();
    let recorded: Vec<f64> = columns.map(|column| record.values[column][4]).collect();
    assert_eq!(now, recorded);
    // P ℓ³/(3 EI) + P ℓ/(GA).
    let linear = 3.0 / 600.0 + 3.0 / 4e5;
    assert!((now[2] - linear).abs() < 1e-4 * linear, "{now:?}");
}

#[test]
fn ids_of_another_model_are_refused() {
    let (builder, _) = cantilever();
    let (_, foreign) = cantilever();
    let mut session = builder.build().unwrap().session().unwrap();
    assert!(session.output(foreign).unwrap_err().to_string().contains("another model"));
    assert!(builder.name(foreign).is_err());

    let mut other = ModelBuilder::new();
    let body = other.add(Body::new(1.0, [1.0; 3]));
    let (mut builder, _) = cantilever();
    builder.add_named("hinge", Revolute::new(GROUND, body, [0.0, 0.0, 1.0]));
    let report = builder.build().unwrap_err().render(false);
    assert!(report.contains("`hinge`: a body of another model"), "{report}");
    assert!(report.contains("built_in_code.rs:"), "the location in the code is reported: {report}");
}

#[test]
fn what_is_wrong_is_reported_as_for_files() {
    let wrong = |build: &dyn Fn(&mut ModelBuilder)| {
        let (mut builder, _) = cantilever();
        build(&mut builder);
        builder.build().expect_err("a wrong model").render(false)
    };
    let report = wrong(&|builder| {
        builder.add_named("stone", PointMass::new(f64::NAN));
    });
    assert!(report.contains("`mass` of point mass `stone` must be a finite number"), "{report}");
    let report = wrong(&|builder| {
        builder.add_named("twice", PointMass::new(1.0));
        builder.add_named("twice", PointMass::new(1.0));
    });
    assert!(report.contains("two entries of [point_masses] are called `twice`"), "{report}");
    let report = wrong(&|builder| {
        builder.add(Dynamics::new(1.0));
    });
    assert!(report.contains("there are two [analysis]"), "{report}");
    let report = wrong(&|builder| {
        let body = builder.add(Body::new(1.0, [1.0; 3]));
        builder.add_named("pin", Revolute::new(GROUND, body, [0.0; 3]).friction(Friction::new(1.0)));
    });
    assert!(report.contains("`axis` of joint `pin` must point somewhere"), "{report}");
    let report = ModelBuilder::new().build().expect_err("an empty model").render(false);
    assert!(report.contains("the model is empty"), "{report}");
}

#[test]
fn what_is_built_is_a_file() {
    let (builder, _) = cantilever();
    let text = builder.to_toml().unwrap();
    let of_code = results(&builder.build().unwrap(), &[]);
    assert_eq!(of_code, results(&Model::from_text("again.toml", &text), &[]), "{text}");
    // Overrides reach it as they reach a file.
    let stiffer = ("sections.general_1.stiffness".to_owned(), "[1e6, 4e5, 4e5, 100, 400, 400]".to_owned());
    let (record, _) = results(&builder.build().unwrap(), &[stiffer]);
    assert!(record.values[2][4] < 0.51 * of_code.0.values[2][4]);
}
