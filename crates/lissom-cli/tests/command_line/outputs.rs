//! Outputs that are expressions, seen from frames that move, or summed up: against formulas.

use std::fs;

use lissom::core::motion::Vector3;
use lissom::{Model, Record, SessionError};
use serde_json::Value;

use crate::support::rail::rail;
use crate::support::{CANTILEVER, Folder, lissom, summary};

/// A disc that turns at 2 rad/s about z at [1, 0, 0], and a stone that flies straight on.
const MODEL: &str = r#"
lissom = 1
inputs.gain = 2

[bodies.disc]
mass = 1
inertia = [1, 1, 2]
position = [1, 0, 0]

[bodies.stone]
mass = 1
inertia = [1, 1, 1]
position = [0, 3, 1]

[joints.axle]
kind = "revolute"
base = "ground"
tip = "disc"
axis = [0, 0, 1]

[initial.disc]
parts = ["disc"]
angular_velocity = [0, 0, 2]
about = [1, 0, 0]

[initial.flight]
parts = ["stone"]
velocity = [1, -1, 0.5]

[outputs.place]
kind = "position"
of = "stone"

[outputs.seen]
kind = "position"
of = "stone"
relative_to = "disc"

[outputs.drift]
kind = "displacement"
of = "stone"
relative_to = "disc"

[outputs.speed]
kind = "velocity"
of = "stone"
relative_to = "disc"

[outputs.pull]
kind = "acceleration"
of = "stone"
relative_to = "disc"

[outputs.pull_global]
kind = "acceleration"
of = "stone"
relative_to = "disc"
in = "ground"

[outputs.turned]
kind = "velocity"
of = "stone"
in = "disc"

[outputs.spin]
kind = "angular_velocity"
of = "stone"
relative_to = "disc"

[outputs.angles]
kind = "cardan_angles"
of = "disc"

[outputs.quaternion]
kind = "quaternion"
of = "disc"

[outputs.distance]
kind = "expression"
value = "sqrt(seen.x^2 + seen.y^2 + seen.z^2)"

[outputs.twice]
kind = "expression"
value = "gain*distance.value + axle.rate - axle.rotation/t0 + t"

[parameters]
t0 = 0.5

[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 2
step = 1e-2
"#;

fn vectors(record: &Record, output: &str, names: [&str; 3]) -> Vec<Vector3> {
    let columns = names.map(|name| record.column(output, name).unwrap_or_else(|| panic!("{output}.{name}")));
    (0..record.times.len()).map(|row| Vector3::from_fn(|i, _| columns[i][row])).collect()
}

#[test]
fn what_an_observer_sees_is_what_formulas_say() {
    let mut session = Model::from_text("seen.toml", MODEL).session().unwrap();
    let record = session.run().unwrap();
    let xyz = ["x", "y", "z"];
    let (seen, drift) = (vectors(&record, "seen", xyz), vectors(&record, "drift", ["u1", "u2", "u3"]));
    let (speed, turned) =
        (vectors(&record, "speed", ["v1", "v2", "v3"]), vectors(&record, "turned", ["v1", "v2", "v3"]));
    let pull = vectors(&record, "pull", ["a1", "a2", "a3"]);
    let pull_global = vectors(&record, "pull_global", ["a1", "a2", "a3"]);
    let spin = vectors(&record, "spin", ["w1", "w2", "w3"]);
    let omega = Vector3::new(0.0, 0.0, 2.0);
    for (row, &t) in record.times.iter().enumerate() {
        let (sine, cosine) = (2.0 * t).sin_cos();
        let back = |v: Vector3| Vector3::new(cosine * v.x + sine * v.y, -sine * v.x + cosine * v.y, v.z);
        let place = Vector3::new(-1.0 + t, 3.0 - t, 1.0 + 0.5 * t);
        let velocity = Vector3::new(1.0, -1.0, 0.5);
        let x = back(place);
        let v = back(velocity) - omega.cross(&x);
        // Coriolis and centrifugal acceleration.
        let a = -2.0 * omega.cross(&v) - omega.cross(&omega.cross(&x));
        let near = |found: &Vector3, wanted: Vector3, what: &str| {
            assert!((found - wanted).norm() < 1e-8, "{what} at {t}: {found} {wanted}");
        };
        near(&seen[row], x, "position");
        near(&drift[row], x - Vector3::new(-1.0, 3.0, 1.0), "displacement");
        near(&speed[row], v, "velocity");
        near(&turned[row], back(velocity), "velocity in other axes");
        near(&pull[row], a, "acceleration");
        let global = Vector3::new(cosine * a.x - sine * a.y, sine * a.x + cosine * a.y, a.z);
        near(&pull_global[row], global, "acceleration in global axes");
        near(&spin[row], -omega, "angular velocity");
        let column = |output: &str, name: &str| record.column(output, name).unwrap()[row];
        assert!((column("distance", "value") - place.norm()).abs() < 1e-8);
        let twice = 2.0 * place.norm() + 2.0 - 2.0 * t / 0.5 + t;
        assert!((column("twice", "value") - twice).abs() < 1e-7, "{t}");
        let gamma = column("angles", "gamma");
        assert!((gamma.sin() - sine).abs() < 1e-8 && (gamma.cos() - cosine).abs() < 1e-8);
        assert!(column("angles", "alpha").abs() + column("angles", "beta").abs() < 1e-12);
        let (q0, q3) = (column("quaternion", "q0"), column("quaternion", "q3"));
        assert!((q0 - t.cos().abs()).abs() < 1e-8 && (q0 * q0 - q3 * q3 - cosine).abs() < 1e-8);
    }
}

#[test]
fn the_summary_has_statistics_of_every_column() {
    let folder = Folder::new("outputs-statistics");
    folder.write("model.toml", MODEL);
    let args = ["run", "model.toml", "--out", "out", "--no-plots", "--set", "analysis.output_every=3"];
    let ended = lissom(&args, folder.path());
    assert_eq!(ended.code, 0, "{}", ended.errors);
    let out = folder.path().join("out");
    let facts = summary(&out);
    let record = Record::from_csv(&fs::read_to_string(out.join("history.csv")).unwrap()).unwrap();
    assert_eq!(facts["statistics"].as_object().unwrap().len(), record.columns.len());
    let times = &record.times;
    for (column, values) in record.columns.iter().zip(&record.values) {
        let reported = &facts["statistics"][column.name()];
        let number = |name: &str| reported[name].as_f64().unwrap();
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let at = times[values.iter().position(|value| *value == most).unwrap()];
        assert_eq!((number("max"), number("time_of_max")), (most, at), "{}", column.name());
        assert_eq!(number("min"), values.iter().copied().fold(f64::INFINITY, f64::min));
        let integral = |power: i32| -> f64 {
            let pairs = times.windows(2).zip(values.windows(2));
            pairs.map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0].powi(power) + v[1].powi(power))).sum::<f64>() / 2.0
        };
        assert!((number("mean") - integral(1)).abs() < 1e-12 * (1.0 + most.abs()));
        assert!((number("rms") - integral(2).sqrt()).abs() < 1e-12 * (1.0 + most.abs()));
    }
}

/// A mass at 1 m/s meets a stop after 0.5 s. Records of chosen steps are closer during the contact, which must not count more.
#[test]
fn means_are_over_time_whatever_the_distances_of_records() {
    let folder = Folder::new("outputs-means");
    let stop =
        "[springs.stop]\nkind = \"axial_stop\"\njoint = \"rail\"\nrange = [-9, 0.5]\nstiffness = 1e6\n";
    folder.write("model.toml", &rail(1.0, 1.0, stop, "relative_tolerance = 1e-6"));
    let ended = lissom(&["run", "model.toml", "--out", "out", "--no-plots"], folder.path());
    assert_eq!(ended.code, 0, "{}", ended.errors);
    let contact = std::f64::consts::PI * 1e-3;
    let rest = 0.5 - contact;
    let mean = 0.125 + 0.5 * contact + 2e-6 + 0.5 * rest - 0.5 * rest * rest;
    let square = (0.25 - contact.powi(3)) / 3.0 + 0.25 * contact;
    let out = folder.path().join("out");
    let statistics = &summary(&out)["statistics"]["rail.displacement"];
    let number = |name: &str| statistics[name].as_f64().unwrap();
    assert!((number("mean") - mean).abs() < 1e-4, "{} instead of {mean}", number("mean"));
    assert!((number("rms") - square.sqrt()).abs() < 1e-3, "{} instead of {}", number("rms"), square.sqrt());
    // Each record counts once.
    let record = Record::from_csv(&fs::read_to_string(out.join("history.csv")).unwrap()).unwrap();
    let values = record.column("rail", "displacement").unwrap();
    let of_records = values.iter().sum::<f64>() / values.len() as f64;
    assert!((of_records - mean).abs() > 0.01, "{of_records}");
}

#[test]
fn mistakes_in_outputs_and_starts_are_reported() {
    for (from, to, wanted) in [
        ("seen.x^2", "seen.a^2", "`seen` has no component `a`"),
        ("seen.x^2", "sen.x^2", "there is no `sen.x`"),
        ("gain*distance.value", "twice.value", "the output `twice` is an expression of itself"),
        (
            "relative_to = \"disc\"\n\n[outputs.drift]",
            "relative_to = \"dics\"\n\n[outputs.drift]",
            "did you mean `disc`?",
        ),
        (
            "kind = \"position\"\nof = \"stone\"\n\n",
            "kind = \"energy\"\nin = \"disc\"\n\n",
            "unknown key `in`",
        ),
        (
            "parts = [\"stone\"]",
            "parts = [\"stone\", \"disc\"]",
            "`disc` moves at the start as `disc` and as `flight`",
        ),
        ("parts = [\"stone\"]", "parts = [\"stome\"]", "did you mean `stone`?"),
        ("parts = [\"stone\"]", "part = [\"stone\"]", "lacks `parts`"),
        (
            "inputs.gain = 2",
            "inputs.gain = 2\nsignals.fast = \"twice.value\"\noutputs.e.kind = \"energy\"\nsignals.slow = \"e.total\"",
            "which only sampled signals can depend on",
        ),
    ] {
        assert!(MODEL.contains(from), "{from}");
        let error =
            Model::from_text("wrong.toml", &MODEL.replacen(from, to, 1)).session().map(|_| ()).unwrap_err();
        let lissom::SessionError::Model(report) = error else { panic!("{error}") };
        let shown = report.render(false);
        let joined = shown.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
        assert!(joined.contains(wanted), "{wanted}: {shown}");
    }
}

#[test]
fn an_entry_of_parts_moves_with_all_that_is_in_it() {
    let text = MODEL
        .replace("[bodies.stone]", "[parts.kit.bodies.stone]")
        .replace("parts = [\"stone\"]", "parts = [\"kit\"]")
        .replace("of = \"stone\"", "of = \"kit.stone\"");
    let record = Model::from_text("kit.toml", &text).session().unwrap().run().unwrap();
    assert!((record.column("turned", "v1").unwrap()[0] - 1.0).abs() < 1e-15);
}

#[test]
fn kinds_answer_for_tables_and_functions() {
    let folder = Folder::new("outputs-kinds");
    for (word, wanted) in [
        ("output", "  expression  "),
        ("outputs", "relative_to"),
        ("section", "  tube  "),
        ("function", "`smoothstep`"),
        ("smoothstep", "Functions of expressions"),
        ("part", "like: "),
        ("initial", "[initial.*]"),
        ("beam", "stations: "),
        ("analysis", "generalized-alpha"),
        ("reaction", "axes: `\"ground\"`"),
        ("tube", "outer_radius: a number > 0 [m]."),
        ("damping", "[springs.*]  axial, point"),
        ("forces", "control: "),
        ("gravity", "Holds three numbers"),
        ("radau-iia", "Two-stage Radau IIA"),
        ("point mass", "[point_masses.*]"),
    ] {
        let ended = lissom(&["kinds", word], folder.path());
        assert!(ended.code == 0 && ended.output.contains(wanted), "{word}: {}{}", ended.output, ended.errors);
    }
    for (word, wanted) in [
        ("reacton", "`lissom kinds reaction`"),
        ("massless_rod", "`lissom kinds distance`"),
        ("hinge", "revolute"),
    ] {
        let ended = lissom(&["kinds", word], folder.path());
        assert!(ended.code == 2 && ended.errors.contains(wanted), "{word}: {}", ended.errors);
    }
    let json = lissom(&["kinds", "reaction", "--json"], folder.path()).output;
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["outputs"][0]["parameters"][0]["name"], "of");
    let ended = lissom(&["kinds", "nonsense"], folder.path());
    assert!(ended.code == 2 && ended.errors.contains("section"), "{}", ended.errors);
    let all = lissom(&["kinds"], folder.path()).output;
    assert!(
        all.contains("See also `lissom kinds WORD`") && all.contains("  cam, clamp, constant_velocity"),
        "{all}"
    );
    assert!(all.lines().count() < 80, "{all}");
    let ended = lissom(&["kinds", "conveyor"], folder.path());
    assert!(ended.code == 0 && ended.output.contains("surface_velocity"), "{}{}", ended.output, ended.errors);
    let ended = lissom(&["explain", "conveyor"], folder.path());
    assert!(ended.code == 2 && ended.errors.len() < 300, "{}", ended.errors);
    let schema: Value = serde_json::from_str(&lissom(&["schema"], folder.path()).output).unwrap();
    assert_eq!(schema["properties"]["initial"]["additionalProperties"]["required"][0], "parts");
}

/// Two arms, one after the other, with one of everything that gives or takes power, and a beam on the second.
const POWERS: &str = r#"
lissom = 1

[bodies.upper]
mass = 2
inertia = [0.1, 0.2, 0.3]
position = [0.5, 0.1, 0]
[bodies.lower]
mass = 1
inertia = [0.1, 0.1, 0.15]
position = [1.5, 0, 0.2]
rotation = [0.3, 0.2, 0.1]

[joints.shoulder]
kind = "revolute"
base = "ground"
tip = "upper"
at = [0, 0, 0]
axis = [0, 0.6, 0.8]
friction = { coulomb = 0.4, static = 0.4, stribeck = 0.1, viscous = 0.1 }
[joints.elbow]
kind = "revolute"
base = "upper"
tip = "lower"
at = [1, 0, 0]
axis = [0, 0, 1]
[joints.drive]
kind = "prescribed_rotation"
joint = "elbow"
rotation = "0.2*sin(3*t)^2"

[springs.coil]
kind = "torsional"
joint = "shoulder"
stiffness = 5
damping = 0.3
[springs.cord]
kind = "point"
base = "ground"
tip = "lower"
at_base = [1, 1, 1]
at_tip = [1.6, 0.1, 0.2]
stiffness = 40

[loads.motor]
kind = "joint_torque"
joint = "shoulder"
torque = "3*cos(t) - 0.2*shoulder.rate"
[loads.push]
kind = "force"
on = "lower"
at = [1.5, 0.3, 0.2]
vector = [0, 1, 2]
follower = true

[initial.arms]
parts = ["upper", "lower"]
angular_velocity = [0, 0.9, 1.2]

[outputs.motor]
kind = "power"
of = "motor"
[outputs.push]
kind = "power"
of = "push"
[outputs.coil]
kind = "power"
of = "coil"
[outputs.cord]
kind = "power"
of = "cord"
[outputs.friction]
kind = "power"
of = "shoulder"
[outputs.drive]
kind = "power"
of = "drive"
[outputs.turn]
kind = "relative"
of = "shoulder"
[outputs.spring]
kind = "spring"
of = "cord"
[outputs.energy]
kind = "energy"

[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 0.3
step = 2e-4
"#;

#[test]
fn powers_are_what_the_kinetic_energy_grows_by() {
    let mut session = Model::from_text("powers.toml", POWERS).session().unwrap();
    let record = session.run().unwrap();
    let of = |output: &str, component: &str| {
        record.column(output, component).unwrap_or_else(|| panic!("{output}"))
    };
    let all = ["motor", "push", "coil", "cord", "friction", "drive"];
    let powers = all.map(|output| of(output, "power"));
    let (kinetic, rate) = (of("energy", "kinetic"), of("turn", "rate"));
    let spring = [of("spring", "force"), of("spring", "rate")];
    let largest = powers.map(|power| power.iter().fold(0.0_f64, |most, value| most.max(value.abs())));
    assert!(largest.iter().all(|&most| most > 0.1), "each has a share: {largest:?}");
    // The multipliers of Radau IIA are right to first order of the step, and those of the very first one less.
    for row in 3..record.times.len() - 2 {
        let time = record.times[row];
        let slope =
            (8.0 * (kinetic[row + 1] - kinetic[row - 1]) - kinetic[row + 2] + kinetic[row - 2]) / 2.4e-3;
        let sum: f64 = powers.iter().map(|power| power[row]).sum();
        assert!((slope - sum).abs() < 1e-4 * largest.iter().sum::<f64>(), "at {time}: {slope} {sum}");
        let motor = (3.0 * time.cos() - 0.2 * rate[row]) * rate[row];
        assert!((powers[0][row] - motor).abs() < 1e-9, "at {time}: {} {motor}", powers[0][row]);
        let cord = -spring[0][row] * spring[1][row];
        assert!((powers[3][row] - cord).abs() < 1e-9, "at {time}: {} {cord}", powers[3][row]);
        assert!(powers[4][row] <= 0.0, "friction takes: {}", powers[4][row]);
    }
}

#[test]
fn what_has_no_power_is_reported_with_what_has() {
    let elbow = POWERS.replace("of = \"shoulder\"\n[outputs.drive]", "of = \"elbow\"\n[outputs.drive]");
    let words = |text: &str| match Model::from_text("powers.toml", text).session() {
        Err(SessionError::Model(report)) => report.render(false),
        _ => panic!("the model is wrong"),
    };
    let words_of_elbow = words(&elbow);
    assert!(words_of_elbow.contains("`elbow` has no power"), "{words_of_elbow}");
    assert!(words_of_elbow.contains("a joint with friction"), "{words_of_elbow}");
    let unknown = POWERS.replace("of = \"motor\"", "of = \"moter\"");
    let words = words(&unknown);
    assert!(words.contains("no spring, load or joint") && words.contains("did you mean `motor`"), "{words}");
}

#[test]
fn a_line_is_the_places_of_all_nodes() {
    let model = CANTILEVER.to_owned()
        + "\n[outputs.axis]\nkind = \"line\"\nof = \"bar\"\n[outputs.foot]\nkind = \"position\"\nof = \"bar@0\"\n\
           [outputs.end]\nkind = \"position\"\nof = \"bar@1\"\n";
    let mut session = Model::from_text("line.toml", &model).session().unwrap();
    let record = session.run().unwrap();
    let components: Vec<&str> = record
        .columns
        .iter()
        .filter(|column| column.output == "axis")
        .map(|column| column.component.as_str())
        .collect();
    let last = components.len() / 3 - 1;
    assert_eq!(components[..4], ["x0", "y0", "z0", "x1"]);
    assert!(last >= 2, "{components:?}");
    for axis in ["x", "y", "z"] {
        assert_eq!(record.column("axis", &format!("{axis}0")), record.column("foot", axis));
        assert_eq!(record.column("axis", &format!("{axis}{last}")), record.column("end", axis));
    }
    // Along the beam positions go on.
    let middle = record.column("axis", "x1").unwrap()[0];
    let ends = ["x0".to_owned(), format!("x{last}")].map(|name| record.column("axis", &name).unwrap()[0]);
    assert!(middle > ends[0] && middle < ends[1], "{ends:?} {middle}");
}
