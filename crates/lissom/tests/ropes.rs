//! Ropes over pulleys against formulas: tackles, hoists, and ropes that go slack.

use lissom::{Model, Record, SessionError};

/// A hook of 12 kg on a rail, hung from the ground by four falls of one rope.
const TACKLE: &str = r#"
lissom = 1
gravity = [0, 0, -10]

[bodies.hook]
mass = 12
inertia = [1, 1, 1]

[joints.rail]
kind = "prismatic"
base = "ground"
tip = "hook"
axis = [0, 0, 1]

[springs.hoist]
kind = "rope"
along = [
    { on = "ground", at = [0, 0, 5] },
    { on = "hook" },
    { on = "ground", at = [0, 0, 5] },
    { on = "hook" },
    { on = "ground", at = [0, 0, 5] },
]
stiffness = 1000

[outputs.hoist]
kind = "spring"
of = "hoist"
[outputs.rail]
kind = "relative"
of = "rail"
[outputs.energy]
kind = "energy"
[outputs.work]
kind = "work"
of = "hoist"
[outputs.support]
kind = "reaction"
of = "rail"

[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 2
step = 2e-3
"#;

fn run(text: &str, set: &[(&str, &str)]) -> Record {
    let set: Vec<_> = set.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
    let (record, report) = Model::from_text("rope.toml", text).session(&set).unwrap().record();
    assert!(report.is_complete());
    record
}

fn column<'r>(record: &'r Record, output: &str, component: &str) -> &'r [f64] {
    record.column(output, component).unwrap_or_else(|| panic!("{output}.{component}"))
}

#[test]
fn a_tackle_divides_the_weight_among_its_falls() {
    let statics =
        TACKLE.split("[analysis]").next().unwrap().to_owned() + "[analysis]\nkind = \"statics\"\nsteps = 4\n";
    // Taut from the start: a slack rope holds nothing, and has no equilibrium.
    let record = run(&statics, &[("springs.hoist.length", "19.99")]);
    let tension = column(&record, "hoist", "force").last().unwrap();
    assert!((tension - 12.0 * 10.0 / 4.0).abs() < 1e-9, "{tension}");
    // four falls, 30 N / (1000 N/m) longer than 19.99 m
    let sunk = column(&record, "rail", "displacement").last().unwrap();
    assert!((sunk + (30.0 / 1000.0 - 0.01) / 4.0).abs() < 1e-10, "{sunk}");
}

/// m z'' = 4 k (4 (5 - z) - L) - m g with L = L0 - 0.2 t² from equilibrium: z = z0 + 0.05 t² - 0.1 m/(16 k) (1 - cos ω t).
#[test]
fn a_winch_hoists_by_a_quarter_of_what_it_takes_in() {
    let slack = 12.0 * 10.0 / (4.0 * 1000.0);
    let length = format!("{} - 0.2*t^2", 20.0 - slack);
    let set = [("springs.hoist.length", length.as_str())];
    let omega = (16.0 * 1000.0 / 12.0_f64).sqrt();
    let errors = ["4e-3", "2e-3"].map(|step| {
        let record = run(TACKLE, &[set[0], ("analysis.step", step)]);
        let (times, places) = (&record.times, column(&record, "rail", "displacement"));
        let error = times.iter().zip(places).map(|(time, place)| {
            let exact = 0.05 * time * time - 0.1 * 12.0 / 16000.0 * (1.0 - (omega * time).cos());
            (place - exact).abs()
        });
        // The work of the winch is what the hook has got; weight is not among the works.
        let lifted = column(&record, "energy", "total");
        let work = column(&record, "work", "work").last().unwrap();
        assert!((work - (lifted.last().unwrap() - lifted[0])).abs() < 2e-4, "{work} {lifted:?}");
        error.fold(0.0, f64::max)
    });
    assert!(errors[1] < 1e-6 && errors[0] / errors[1] > 6.0, "{errors:?}");
}

#[test]
fn a_slack_rope_lets_fall_and_throws_back() {
    // 0.2 m of free fall, then a bounce without loss.
    let text = TACKLE.replace("step = 2e-3", "relative_tolerance = 1e-7");
    let record = run(&text, &[("springs.hoist.length", "20.8")]);
    let (places, tension) = (column(&record, "rail", "displacement"), column(&record, "hoist", "force"));
    for (row, time) in record.times.iter().enumerate().filter(|(_, time)| **time < 0.2) {
        assert!((places[row] + 5.0 * time * time).abs() < 1e-9 && tension[row] == 0.0, "{time}");
    }
    assert!(tension.iter().all(|&tension| tension >= 0.0) && tension.iter().any(|&tension| tension > 100.0));
    // m g (0.2 + x) = ½ 16 k x²
    let deepest = places.iter().copied().fold(0.0, f64::min);
    let sag = (120.0 + (120.0_f64.powi(2) + 2.0 * 16000.0 * 24.0).sqrt()) / 16000.0;
    assert!((deepest + 0.2 + sag).abs() < 1e-3, "{deepest} {sag}");
    let energy = column(&record, "energy", "total");
    assert!(energy.iter().all(|now| (now - energy[0]).abs() < 1e-3 * 24.0), "{energy:?}");
}

/// Two buckets over a pulley on the ground: (m1 - m2) g/(m1 + m2), whatever the rope does inside of itself.
#[test]
fn two_buckets_over_a_pulley_accelerate_as_atwood_says() {
    let text = r#"
lissom = 1
gravity = [0, 0, -10]
[point_masses.heavy]
mass = 3
position = [-1, 0, 0]
[point_masses.light]
mass = 2
position = [1, 0, 0]
[springs.rope]
kind = "rope"
along = [
    { on = "heavy" },
    { on = "ground", at = [-1, 0, 4] },
    { on = "ground", at = [1, 0, 4] },
    { on = "light" },
]
stiffness = 1e5
length = 9.99976
[outputs.heavy]
kind = "position"
of = "heavy"
[outputs.light]
kind = "position"
of = "light"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1
step = 1e-3
"#;
    let record = run(text, &[]);
    let (heavy, light) = (column(&record, "heavy", "z"), column(&record, "light", "z"));
    // At the tension 2 m1 m2 g/(m1 + m2) = 24 N, without oscillation from the start.
    for (row, time) in record.times.iter().enumerate() {
        let fallen = 0.5 * 2.0 * time * time;
        assert!((heavy[row] + fallen).abs() < 1e-9 && (light[row] - fallen).abs() < 1e-9, "t = {time}");
    }
}

#[test]
fn ropes_that_cannot_be_are_refused() {
    for (from, to, wanted) in [
        (
            "{ on = \"hook\" },\n    { on = \"ground\"",
            "{ on = \"ground\", at = [0, 0, 5] },\n    { on = \"ground\"",
            "at one point",
        ),
        ("{ on = \"hook\" }", "{ on = \"hock\" }", "hock"),
        ("{ on = \"hook\" }", "{ at = [0, 0, 1] }", "lacks `on`"),
        ("{ on = \"hook\" }", "\"hook\"", "must be a table"),
    ] {
        let error = Model::from_text("rope.toml", &TACKLE.replacen(from, to, 1)).session(&[]).map(|_| ());
        let Err(SessionError::Model(report)) = error else { panic!("{wanted}") };
        let shown = report.render(false);
        let joined = shown.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
        assert!(joined.contains(wanted), "{wanted}: {shown}");
    }
}
