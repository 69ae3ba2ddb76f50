//! Superelements: reduced beams against beams, rigid motion, prestress, files, and all schemes.

use crate::support::runs::{column, last, set};

mod against_beams;
mod deformed;
mod load_stiffness;
mod mean_motion;
mod moments;
mod outputs;

use std::collections::BTreeMap;

use lissom::Model;
use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};
use lissom::analyses::reduce::{ReduceError, ReduceReport, ReduceRequest, reduce};

const SCHEMES: [&str; 5] = ["radau-iia", "radau-iia-5", "generalized-alpha", "hht", "energy-decaying"];

/// A slender beam along x, of eight elements.
fn beam(rest: &str) -> String {
    format!(
        r#"
lissom = 1
[sections.bar]
shape = "general"
stiffness = [1e6, 4e5, 4e5, 100, 200, 300]
mass = {{ per_length = 1, inertia = [2e-4, 1e-4, 1e-4] }}
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 8
order = 3
{rest}
"#
    )
}

const MODES: &str = "[analysis]\nkind = \"modes\"\n";

fn try_reduce(text: &str, interfaces: &[&str], modes: usize) -> Result<ReduceReport, ReduceError> {
    reduce(&Model::from_text("model.toml", text), &request(interfaces, modes))
}

fn request(interfaces: &[&str], modes: usize) -> ReduceRequest {
    ReduceRequest {
        parts: Vec::new(),
        interfaces: interfaces.iter().map(|name| (*name).to_owned()).collect(),
        modes,
        corrections: true,
        free_modes: false,
        recover: Vec::new(),
        about: OperatingPoint::Static,
        name: Some("part".to_owned()),
    }
}

fn reduced(text: &str, interfaces: &[&str], modes: usize) -> ReduceReport {
    try_reduce(text, interfaces, modes).unwrap_or_else(|error| panic!("{error}"))
}

/// Reduced to static shapes and modes, without what makes up for those omitted.
fn reduced_to_modes(text: &str, interfaces: &[&str], modes: usize) -> ReduceReport {
    let request = ReduceRequest { corrections: false, ..request(interfaces, modes) };
    reduce(&Model::from_text("model.toml", text), &request).unwrap_or_else(|error| panic!("{error}"))
}

/// The model that uses a reduced part, with the files of its matrices.
fn using(report: &ReduceReport, rest: &str) -> Model {
    let (_, text) = report.files.last().expect("the table comes last");
    let texts: BTreeMap<String, String> = report.files.iter().cloned().collect();
    Model::from_text("model.toml", &format!("{text}\n{rest}")).with_known(texts)
}

fn frequencies(model: &Model, count: usize) -> Vec<f64> {
    let request =
        ModeRequest { count: Some(count), about: Some(OperatingPoint::Static), ..ModeRequest::default() };
    let found = modes(model, &request).unwrap_or_else(|error| panic!("{error}"));
    found.modes.iter().map(|mode| mode.frequency).collect()
}

fn clamp(node: &str) -> String {
    format!("[joints.root]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"{node}\"\n")
}

fn ran(model: &Model, overrides: &[(String, String)]) -> lissom::Record {
    let mut session = model.with_overrides(overrides).session().unwrap_or_else(|error| panic!("{error}"));
    session.run().unwrap().into_record()
}

/// Frequencies of the cantilever and of the free beam come nearer to those of the beam with every mode.
#[test]
fn frequencies_converge_to_those_of_the_beam() {
    for hold in [String::new(), clamp("bar.start")] {
        let exact = frequencies(&Model::from_text("model.toml", &beam(&format!("{hold}{MODES}"))), 14);
        let rigid = exact.iter().filter(|frequency| **frequency == 0.0).count();
        let error = |number: usize| {
            let report = reduced_to_modes(&beam(MODES), &["bar.start", "bar.end"], number);
            let hold = hold.replace("bar.start", "part.bar_start");
            let found = frequencies(&using(&report, &format!("{hold}{MODES}")), 14);
            assert_eq!(found[..rigid], exact[..rigid], "rigid modes are as many");
            let errors: Vec<f64> = (rigid..rigid + 6).map(|k| found[k] / exact[k] - 1.0).collect();
            // A reduced model is stiffer.
            assert!(errors.iter().all(|error| *error > -1e-8), "{errors:?}");
            errors.into_iter().fold(0.0, f64::max)
        };
        let errors = [8, 16, 32, 60].map(error);
        assert!(errors.windows(2).all(|pair| pair[1] < 0.6 * pair[0]), "{errors:?}");
        assert!(errors[0] < 0.02 && errors[3] < 1e-4, "{errors:?}");
    }
}

/// All modes together are the beam itself: the same frequencies to round-off.
#[test]
fn all_modes_are_the_whole_beam() {
    let text = beam(MODES).replace("elements = 8", "elements = 2").replace("order = 3", "order = 2");
    let exact = frequencies(&Model::from_text("model.toml", &text), 30);
    let report = reduced(&text, &["bar.start", "bar.end"], 18);
    assert_eq!(report.unknowns, [30, 30]);
    assert!((report.mass - 1.0).abs() < 1e-12, "{}", report.mass);
    let found = frequencies(&using(&report, MODES), 30);
    for (found, exact) in found.iter().zip(&exact) {
        assert!((found - exact).abs() <= 1e-6 * exact, "{found} {exact}");
    }
    // More are not there.
    let error = try_reduce(&text, &["bar.start", "bar.end"], 19).expect_err("too many").to_string();
    assert!(error.contains("only 18 modes"), "{error}");
}

/// A free superelement that turns about a principal axis keeps energy and momentum, and moves as the rigid body of its inertia.
#[test]
fn rigid_motion_is_that_of_the_rigid_body() {
    let stiff = beam(MODES).replace("[1e6, 4e5, 4e5, 100, 200, 300]", "[1e10, 4e9, 4e9, 1e6, 2e6, 3e6]");
    let report = reduced(&stiff, &["bar.start", "bar.end"], 2);
    let rest = "[initial]\nvelocity = [0.5, 0, 1]\nangular_velocity = [0.02, 3, 0.5]\n\
                [outputs.energy]\nkind = \"energy\"\n[outputs.momentum]\nkind = \"momentum\"\n\
                [outputs.end]\nkind = \"position\"\nof = \"part.bar_end\"\n\
                [analysis]\nkind = \"dynamics\"\nend = 1\nstep = 5e-4\nscheme = \"radau-iia\"\n";
    let flexible = ran(&using(&report, rest), &[]);
    let body = "lissom = 1\n[bodies.part]\nmass = 1\nposition = [0, 0, 0]\ncenter_of_mass = [0.5, 0, 0]\n";
    // A uniform bar: 1/12, with the inertia of its sections.
    let inertia = format!("inertia = [2e-4, {0}, {0}]\n", 1.0 / 12.0 + 1e-4);
    let rigid_rest = rest.replace("of = \"part.bar_end\"", "of = \"part\"\npoint = [1, 0, 0]");
    let rigid = ran(&Model::from_text("model.toml", &format!("{body}{inertia}{rigid_rest}")), &[]);
    for component in ["x", "y", "z"] {
        let [one, other] = [&flexible, &rigid].map(|record| last(record, "end", component));
        assert!((one - other).abs() < 2e-5, "{component}: {one}, rigid {other}");
    }
    for component in ["p1", "p2", "p3", "l1", "l2", "l3"] {
        let values = column(&flexible, "momentum", component);
        let change = values.iter().map(|value| (value - values[0]).abs()).fold(0.0, f64::max);
        assert!(change < 1e-7, "{component}: {change:e}");
        assert!((values[0] - column(&rigid, "momentum", component)[0]).abs() < 1e-9, "{component}");
    }
    let energy = column(&flexible, "energy", "total");
    assert!(energy.iter().all(|value| (value / energy[0] - 1.0).abs() < 1e-5), "{:?}", energy.last());
}

/// What falls freely from rest does not bend, and its centre falls as a stone does.
#[test]
fn weight_does_not_strain_what_falls() {
    let report = reduced(&beam(MODES), &["bar.start", "bar.end"], 4);
    let rest = "gravity = [1, -2, -9.81]\n[outputs.energy]\nkind = \"energy\"\n\
                [outputs.end]\nkind = \"displacement\"\nof = \"part.bar_end\"\n\
                [analysis]\nkind = \"dynamics\"\nend = 0.5\nstep = 1e-2\nscheme = \"radau-iia\"\n";
    let (_, table) = report.files.last().expect("the table");
    let texts: BTreeMap<String, String> = report.files.iter().cloned().collect();
    // Gravity is above all tables.
    let (gravity, rest) = rest.split_once('\n').expect("two lines");
    let text = table.replace("lissom = 1\n", &format!("lissom = 1\n{gravity}\n"));
    let model = Model::from_text("model.toml", &format!("{text}\n{rest}")).with_known(texts);
    let record = ran(&model, &[]);
    assert!(column(&record, "energy", "strain").iter().all(|strain| strain.abs() < 1e-18));
    let total = column(&record, "energy", "total");
    assert!(total.iter().all(|value| (value - total[0]).abs() < 1e-9));
    assert!((last(&record, "end", "u3") + 0.5 * 9.81 * 0.25).abs() < 1e-9);
}

/// A cantilever that sags under its weight and a tip mass: the superelement as the beam, for small deflections.
#[test]
fn statics_and_weight_are_those_of_the_beam() {
    let rest = |start: &str, end: &str| {
        format!(
            "{}[bodies.mass]\nmass = 0.2\ninertia = [1e-3, 1e-3, 1e-3]\nposition = [1, 0, 0]\n\
             [joints.tip]\nkind = \"clamp\"\nbase = \"{end}\"\ntip = \"mass\"\n\
             [outputs.tip]\nkind = \"displacement\"\nof = \"{end}\"\n\
             [outputs.root]\nkind = \"reaction\"\nof = \"root\"\n\
             [analysis]\nkind = \"statics\"\nsteps = 1\n",
            clamp(start)
        )
    };
    let with_weight = |text: &str| text.replace("lissom = 1\n", "lissom = 1\ngravity = [0, 0.3, -0.5]\n");
    let report = reduced(&beam(MODES), &["bar.start", "bar.end"], 12);
    let (_, table) = report.files.last().expect("the table");
    let texts: BTreeMap<String, String> = report.files.iter().cloned().collect();
    let text = format!("{}{}", with_weight(table), rest("part.bar_start", "part.bar_end"));
    let found = ran(&Model::from_text("model.toml", &text).with_known(texts), &[]);
    let exact = ran(&Model::from_text("model.toml", &with_weight(&beam(&rest("bar.start", "bar.end")))), &[]);
    for component in ["u2", "u3"] {
        let [one, other] = [&found, &exact].map(|record| last(record, "tip", component));
        assert!((one / other - 1.0).abs() < 1e-4, "{component}: {one}, beam {other}");
    }
    for component in ["f2", "f3", "m2", "m3"] {
        let [one, other] = [&found, &exact].map(|record| last(record, "root", component));
        assert!((one / other - 1.0).abs() < 1e-4, "{component}: {one}, beam {other}");
    }
}

/// A beam under tension is stiffer across, and a superelement reduced under tension is, too.
#[test]
fn prestress_raises_frequencies() {
    let hold = "[joints.root]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"bar.start\"\n\
                [joints.guide]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"bar.end\"\naxis = [1, 0, 0]\n";
    let pull = "[loads.pull]\nkind = \"force\"\non = \"bar.end\"\nvector = [8000, 0, 0]\n";
    let text = |loads: &str| beam(&format!("{hold}{loads}{MODES}"));
    let [slack, tight] =
        ["", pull].map(|loads| frequencies(&Model::from_text("model.toml", &text(loads)), 4)[0]);
    assert!(tight > 1.3 * slack, "{slack} {tight}");
    let report = reduced(&text(pull), &["bar.start", "bar.end"], 10);
    assert!(report.is_preloaded);
    let rest = format!("{hold}{pull}{MODES}")
        .replace("bar.start", "part.bar_start")
        .replace("bar.end", "part.bar_end");
    let found = frequencies(&using(&report, &rest), 4)[0];
    assert!((found / tight - 1.0).abs() < 1e-4, "{found}, beam under tension {tight}");
    // Reduced without tension it does not know of it.
    let report = reduced(&text(""), &["bar.start", "bar.end"], 10);
    assert!(!report.is_preloaded);
    let rest = rest.replace(&pull.replace("bar.end", "part.bar_end"), "");
    let found = frequencies(&using(&report, &rest), 4)[0];
    assert!((found / slack - 1.0).abs() < 1e-4, "{found}, beam without tension {slack}");
}

/// The model of a spinning-up arm, with the beam or its superelement.
fn arm(start: &str, end: &str) -> String {
    format!(
        "[joints.hinge]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"{start}\"\naxis = [0, 0, 1]\n\
         [joints.motor]\nkind = \"prescribed_rotation\"\njoint = \"hinge\"\nrotation = \"0.8*(1 - cos(4*t))\"\n\
         [outputs.tip]\nkind = \"position\"\nof = \"{end}\"\n\
         [outputs.energy]\nkind = \"energy\"\n\
         [analysis]\nkind = \"dynamics\"\nend = 0.4\nstep = 1e-3\nscheme = \"radau-iia\"\n"
    )
}

/// An arm that is moved to and fro: the superelement follows the beam, with every scheme and with steps of controlled size.
#[test]
fn a_moved_arm_follows_the_beam_with_all_schemes() {
    let report = reduced(&beam(MODES), &["bar.start", "bar.end"], 8);
    let model = using(&report, &arm("part.bar_start", "part.bar_end"));
    let exact = ran(&Model::from_text("model.toml", &beam(&arm("bar.start", "bar.end"))), &[]);
    let bent = last(&exact, "tip", "y") - (0.8 * (1.0 - 1.6_f64.cos())).sin();
    assert!(bent.abs() > 1e-4, "it must bend: {bent}");
    let difference = |record: &lissom::Record| {
        let part = |component: &str| last(record, "tip", component) - last(&exact, "tip", component);
        part("x").hypot(part("y"))
    };
    for scheme in SCHEMES {
        let error = difference(&ran(&model, &[set("analysis.scheme", scheme)]));
        assert!(error < 0.05 * bent.abs(), "{scheme}: {error:e} of {bent:e}");
    }
    let controlled = [set("analysis.relative_tolerance", "1e-6")];
    let model = model.without("analysis.step");
    let error = difference(&ran(&model, &controlled));
    assert!(error < 0.05 * bent.abs(), "controlled: {error:e} of {bent:e}");
}

/// With steps of controlled size the error follows the tolerance: the mass of superelements counts.
#[test]
fn errors_follow_the_tolerance() {
    let report = reduced(&beam(MODES), &["bar.start", "bar.end"], 4);
    let model = using(&report, &arm("part.bar_start", "part.bar_end")).without("analysis.step");
    let end = |tolerance: &str| {
        let record = ran(&model, &[set("analysis.relative_tolerance", tolerance)]);
        ["x", "y"].map(|component| last(&record, "tip", component))
    };
    let exact = end("1e-8");
    for (tolerance, allowed) in [("1e-4", 1e-4), ("1e-6", 1e-6)] {
        let found = end(tolerance);
        let error = (found[0] - exact[0]).hypot(found[1] - exact[1]);
        assert!(error < 3.0 * allowed, "{tolerance}: {error:e}");
    }
}

#[test]
fn a_snapshot_goes_on_to_the_last_bit() {
    let report = reduced(&beam(MODES), &["bar.start", "bar.end"], 3);
    let model = using(&report, &arm("part.bar_start", "part.bar_end"));
    for scheme in SCHEMES {
        let overrides = [set("analysis.scheme", scheme)];
        let mut session = model.with_overrides(&overrides).session().expect("a good model");
        session.step_to(0.05).expect("steps");
        let snapshot = session.snapshot().to_bytes();
        let go_on = |session: &mut lissom::Session| {
            session.step_to(0.1).expect("steps");
            let mut values = Vec::new();
            session.values(&mut values);
            values
        };
        let straight = go_on(&mut session);
        let mut other = model.with_overrides(&overrides).session().expect("a good model");
        other
            .restore(&lissom::SessionSnapshot::from_bytes(&snapshot).expect("a snapshot"))
            .expect("of this model");
        assert_eq!(go_on(&mut other), straight, "{scheme}");
    }
}

/// Two superelements, each placed and turned, are one beam.
#[test]
fn parts_are_placed_and_joined() {
    let half = beam(MODES).replace("elements = 8", "elements = 4");
    let report = reduced(&half.replace("to = [1, 0, 0]", "to = [0.5, 0, 0]"), &["bar.start", "bar.end"], 10);
    let (_, table) = report.files.last().expect("the table");
    let own = table.split_once("[superelements.part]").expect("a table").1;
    let text = format!(
        "lissom = 1\n[superelements.one]\nposition = [1, 2, 3]\nrotation = [0, 0, \"pi/2\"]\n{own}\n\
         [superelements.two]\nposition = [1, 2.5, 3]\naxes = [[0, 1, 0], [-1, 0, 0]]\n{own}\n\
         [joints.root]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"one.bar_start\"\n\
         [joints.middle]\nkind = \"clamp\"\nbase = \"one.bar_end\"\ntip = \"two.bar_start\"\n{MODES}"
    );
    let texts: BTreeMap<String, String> = report.files.iter().cloned().collect();
    let found = frequencies(&Model::from_text("model.toml", &text).with_known(texts), 4);
    let exact =
        frequencies(&Model::from_text("model.toml", &beam(&format!("{}{MODES}", clamp("bar.start")))), 4);
    for (found, exact) in found.iter().zip(&exact) {
        assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
    }
}

/// A superelement of a superelement is one.
#[test]
fn a_reduced_part_can_be_reduced_again() {
    let first = reduced(&beam(MODES), &["bar.start", "bar.end"], 12);
    let request = ReduceRequest {
        parts: Vec::new(),
        interfaces: vec!["part.bar_start".to_owned()],
        modes: 10,
        corrections: true,
        free_modes: false,
        recover: Vec::new(),
        about: OperatingPoint::Static,
        name: Some("again".to_owned()),
    };
    let again = reduce(&using(&first, MODES), &request).unwrap_or_else(|error| panic!("{error}"));
    let found = frequencies(&using(&again, &format!("{}{MODES}", clamp("again.part_bar_start"))), 3);
    let exact =
        frequencies(&Model::from_text("model.toml", &beam(&format!("{}{MODES}", clamp("bar.start")))), 3);
    for (found, exact) in found.iter().zip(&exact) {
        assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
    }
}

#[test]
fn what_is_no_elastic_assembly_is_refused() {
    let message =
        |text: &str, interfaces: &[&str]| try_reduce(text, interfaces, 0).expect_err("wrong").to_string();
    let held = beam(&format!("{}{MODES}", clamp("bar@0.5")));
    for (text, interfaces, words) in [
        (beam(MODES), vec!["bar.middle"], "have no node `bar.middle`"),
        (beam(MODES), vec!["bar@0.51"], "has no node at `bar@0.51`"),
        (beam(MODES), vec!["bar.start", "bar@0"], "is specified twice"),
        (held, vec!["bar.start"], "`root` connects a part that is not reduced"),
        (
            beam(&format!(
                "{}[loads.push]\nkind = \"force\"\non = \"bar@0.5\"\nvector = [0, 0, 1]\n{MODES}",
                clamp("bar.start")
            )),
            vec!["bar.start"],
            "`push` connects a part that is not reduced",
        ),
        (
            beam(&format!(
                "[bodies.loose]\nmass = 1\ninertia = [1, 1, 1]\nposition = [1, 0, 0]\n\
                 [joints.hinge]\nkind = \"revolute\"\nbase = \"bar.end\"\ntip = \"loose\"\naxis = [0, 1, 0]\n{MODES}"
            )),
            vec!["bar.start"],
            "with its interfaces held",
        ),
    ] {
        let error = message(&text, &interfaces);
        assert!(error.contains(words), "{interfaces:?}, {words}: {error}");
    }
}

/// Files in a folder: the table that was written, the archive instead of the single files, and mistakes.
#[test]
fn files_are_read_as_they_were_written() {
    let report =
        reduced(&beam(MODES).replace("[beams.bar]", "damping = 1e-4\n[beams.bar]"), &["bar.start"], 3);
    assert!(report.files.iter().any(|(name, _)| name == "part-damping.mtx"), "damping is reduced, too");
    let folder = std::env::temp_dir().join(format!("lissom-superelements-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    for (name, text) in &report.files {
        std::fs::write(folder.join(name), text).expect("a file");
    }
    std::fs::write(folder.join("part.npz"), &report.archive).expect("a file");
    let rest = format!("{}{MODES}", clamp("part.bar_start"));
    let (_, table) = report.files.last().expect("the table");
    let read = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, format!("{text}{rest}")).expect("a file");
        Model::read(&path).expect("a text")
    };
    let kept: Vec<&str> = table.lines().filter(|line| !line.contains(".mtx")).collect();
    let archived = format!("{}\nmatrices = \"part.npz\"\n", kept.join("\n"));
    let one = read("one.toml", table).document().expect("a good model");
    let other = read("other.toml", &archived).document().expect("a good model");
    assert_eq!(one.superelements[0].matrices, other.superelements[0].matrices);
    // Who has the texts needs no archive.
    let model = read("other.toml", &archived);
    model.document().expect("a good model");
    let elsewhere = Model::from_text("other.toml", model.text()).with_included(model.included());
    let again = elsewhere.document().expect("texts are enough");
    assert_eq!(one.superelements[0].matrices, again.superelements[0].matrices);
    for (from, to, words) in [
        ("part.npz", "none.npz", "cannot be read"),
        ("part.npz", "part-mass.mtx", "it is not an NPZ archive"),
        ("matrices = \"part.npz\"", "", "lacks `mass`"),
        ("matrices =", "floating = \"tip\"\nmatrices =", "which is none of its interfaces"),
        ("matrices =", "modal_damping = 0.1\nstiffness_damping = 1\nmatrices =", "has both `modal_damping`"),
        ("part.bar_start", "part.tip", "which is not an interface of the superelement `part`"),
        ("part.bar_start", "part", "names the superelement `part`, not one of its interfaces"),
    ] {
        let text = format!("{archived}{rest}").replace(from, to);
        let path = folder.join("wrong.toml");
        std::fs::write(&path, text).expect("a file");
        let message = Model::read(&path).expect("a text").document();
        let message = message.expect_err(words).render(false).replace('│', " ");
        assert!(
            message.split_whitespace().collect::<Vec<_>>().join(" ").contains(words),
            "{words}: {message}"
        );
    }
    std::fs::remove_dir_all(&folder).expect("a folder");
}

/// A description of a robot has no position for it.
#[test]
fn no_description_of_rigid_bodies_leaves_it_out_unseen() {
    let document = Model::read(std::path::Path::new(&example("slider-crank-elastic.toml")))
        .expect("a text")
        .document()
        .expect("a good model");
    let message = lissom::exchange::import::from_model(&document).expect_err("flexible").to_string();
    assert!(message.contains("superelement `rod` is flexible"), "{message}");
}

fn example(name: &str) -> String {
    format!("{}/../../examples/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// The slider crank with the beam, and with its superelement.
fn slider_cranks() -> (Model, Model) {
    let path = |name: &str| std::path::PathBuf::from(example(name));
    let rod = Model::read(&path("connecting-rod.toml")).expect("a text");
    let model = Model::read(&path("slider-crank-elastic.toml")).expect("a text");
    let own = model.text();
    let (head, rest) = own.split_once("[superelements.rod]").expect("the table of the rod");
    let (_, rest) = rest.split_once("[bodies.crank]").expect("the crank");
    let (_, beam) = rod.text().split_once("[materials.aluminium]").expect("the material");
    let (beam, _) = beam.split_once("[analysis]").expect("the end");
    let beam = beam
        .replace("from = [0, 0, 0]", "from = [\"crank\", 0, 0]")
        .replace("to = [0.15, 0, 0]", "to = [\"crank + rod\", 0, 0]");
    let rest = rest
        .replace("rod.crank_pin", "rod.start")
        .replace("rod.middle", "rod@0.5")
        .replace("rod.piston_pin", "rod.end");
    let text = format!("{head}[materials.aluminium]{beam}[bodies.crank]{rest}");
    (Model::from_text("model.toml", &text), model)
}

/// By which part of the largest deflection of the rod the two differ, and that deflection [m].
fn rod_error(exact: &Model, model: &Model, overrides: &[(String, String)]) -> (f64, f64) {
    let records = [exact, model].map(|model| ran(model, overrides));
    let columns = records.each_ref().map(|record| column(record, "deflection", "u2"));
    let most = columns[0].iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let wrong = columns[0].iter().zip(columns[1]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    (wrong / most, most)
}

/// Forces of the rod of the slider crank on both of its pins are those of the beam, by every scheme and over speeds.
#[test]
fn pins_of_the_slider_crank_are_loaded_as_by_the_beam() {
    let pins = ["crank_pin", "piston_pin"];
    let outputs = pins.map(|pin| format!("[outputs.{pin}]\nkind = \"reaction\"\nof = \"{pin}\"\n")).concat();
    let (exact, model) = slider_cranks();
    let with_pins = |model: &Model| {
        Model::from_text(
            "model.toml",
            &model.text().replace("[outputs.piston]", &format!("{outputs}[outputs.piston]")),
        )
    };
    let path = std::path::PathBuf::from(example("slider-crank-elastic.toml"));
    let texts: BTreeMap<String, String> = ["mass", "stiffness", "damping", "geometric"]
        .map(|name| format!("parts/rod-{name}.mtx"))
        .map(|name| (name.clone(), std::fs::read_to_string(path.with_file_name(&name)).expect("a matrix")))
        .into();
    let [exact, model] = [with_pins(&exact), with_pins(&model).with_known(texts)];
    let cases =
        SCHEMES.map(|scheme| (600, scheme)).into_iter().chain([(250, SCHEMES[0]), (1000, SCHEMES[0])]);
    for (speed, scheme) in cases {
        let overrides = [
            set("parameters.speed", &format!("{speed}*2*pi/60")),
            set("analysis.scheme", &format!("\"{scheme}\"")),
        ];
        let [exact, found] = [&exact, &model].map(|model| ran(model, &overrides));
        for pin in pins {
            for component in ["f1", "f2"] {
                let [exact, found] = [&exact, &found].map(|record| column(record, pin, component));
                let most = exact.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
                let wrong = exact.iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(wrong < 0.02 * most, "{speed} 1/min, {scheme}, {pin}.{component}: {wrong} of {most}");
            }
        }
    }
}

/// The rod of the slider crank is that of `connecting-rod.toml`, and bends as the beam does. The differences of
/// second order in its file are as exact as differences are.
#[test]
fn the_rod_of_the_slider_crank_bends_as_the_beam() {
    let path = |name: &str| std::path::PathBuf::from(example(name));
    let request = ReduceRequest {
        parts: Vec::new(),
        interfaces: ["rod.start", "rod@0.5", "rod.end"].map(str::to_owned).to_vec(),
        modes: 4,
        corrections: false,
        free_modes: false,
        recover: Vec::new(),
        about: OperatingPoint::Static,
        name: Some("rod".to_owned()),
    };
    let rod = Model::read(&path("connecting-rod.toml")).expect("a text");
    let report = reduce(&rod, &request).unwrap_or_else(|error| panic!("{error}"));
    let (exact, model) = slider_cranks();
    let remade = using(&report, MODES).document().expect("a good model");
    let kept = model.document().expect("a good model");
    let difference = &remade.superelements[0].matrices.stiffness - &kept.superelements[0].matrices.stiffness;
    assert!(difference.amax() < 1e-8 * kept.superelements[0].matrices.stiffness.amax());
    let [remade, kept] = [remade, kept].map(|document| {
        document.superelements[0].matrices.geometric.as_ref().expect("of second order").stacked()
    });
    // Modes have no sign, and those of one frequency no direction.
    let difference = (remade.norm() / kept.norm() - 1.0).abs();
    assert!(difference < 1e-6, "{difference:e}");
    let (wrong, most) = rod_error(&exact, &model, &[]);
    assert!(most > 4e-6 && wrong < 0.04, "{wrong:e} of {most:e}");
}

/// Large deformations cause a warning.
#[test]
fn leaving_the_linear_range_is_a_warning() {
    let report = reduced(&beam(MODES), &["bar.start", "bar.end"], 2);
    let rest = format!(
        "{}[loads.push]\nkind = \"force\"\non = \"part.bar_end\"\nvector = [0, 0, 400]\n\
         [analysis]\nkind = \"statics\"\nsteps = 2\n",
        clamp("part.bar_start")
    );
    let mut session = using(&report, &rest).session().expect("a good model");
    session.run().unwrap();
    let codes: Vec<&str> = session.warnings().map(lissom_core::errors::Warning::code).collect();
    assert_eq!(codes, ["beyond-linear"]);
}

/// What turns nearly as fast as it swings is stiffened by that, which its matrices do not contain: a warning reports it. The first
/// frequency with the floating interface held is 7.9 Hz.
#[test]
fn turning_fast_is_a_warning() {
    let report = reduced(&beam(MODES), &["bar.start", "bar.end"], 4);
    for (speed, expected) in [(10.0, vec![]), (20.0, vec!["turns-fast"])] {
        let rest = format!(
            "[joints.hinge]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"part.bar_start\"\naxis = [0, 0, 1]\n\
             [initial]\nangular_velocity = [0, 0, {speed}]\nsteady_rotation = true\n\
             [analysis]\nkind = \"dynamics\"\nend = 0.05\nstep = 1e-3\n"
        );
        let mut session = using(&bare(&report), &rest).session().expect("a good model");
        session.run().unwrap();
        let codes: Vec<&str> = session.warnings().map(lissom_core::errors::Warning::code).collect();
        assert_eq!(codes, expected, "{speed} rad/s");
    }
}

/// The files of a reduction without its geometric stiffness, as another program would give them.
fn bare(report: &ReduceReport) -> ReduceReport {
    let mut report = report.clone();
    for (_, text) in &mut report.files {
        let kept: Vec<&str> = text.lines().filter(|line| !line.starts_with("geometric")).collect();
        *text = format!("{}\n", kept.join("\n"));
    }
    report
}
