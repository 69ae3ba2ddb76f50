//! Outputs of superelements: modal coordinates, and what a recovery matrix makes of the deformation.

use std::fmt::Write;

use super::*;

/// A cantilever under a tip force that is reduced to two modes, with a recovery matrix.
fn held(rest: &str, recovery: Option<&str>) -> Model {
    let request = ReduceRequest { corrections: false, ..request(&["bar.start", "bar.end"], 2) };
    let report = reduce(&Model::from_text("model.toml", &beam(MODES)), &request)
        .unwrap_or_else(|error| panic!("{error}"));
    let (_, table) = report.files.last().expect("the table");
    let mut texts: BTreeMap<String, String> = report.files.iter().cloned().collect();
    let mut table = table.clone();
    if let Some(text) = recovery {
        texts.insert("recovery.mtx".to_owned(), text.to_owned());
        table += "recovery = \"recovery.mtx\"\n";
    }
    Model::from_text("model.toml", &format!("{table}{rest}")).with_known(texts)
}

/// Rows of a matrix as a file.
fn file(rows: &[Vec<f64>]) -> String {
    let columns = rows[0].len();
    let mut text = format!("%%MatrixMarket matrix array real general\n{} {columns}\n", rows.len());
    for column in 0..columns {
        for row in rows {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{:?}", row[column]);
        }
    }
    text
}

/// In the units of the file modes have unit mass: ½ q̇² of one that is alone in motion is its kinetic energy, and ½ ω² q² its strain energy;
/// the recovery matrix sees the same amplitudes, and displacements of the tip against the root and in its axes.
#[test]
fn modal_coordinates_and_what_is_recovered_of_them() {
    let unit = |row: usize| (0..14).map(|k| f64::from(u8::from(k == row))).collect::<Vec<f64>>();
    let rows = [unit(7), unit(11), unit(12), unit(13).iter().map(|one| 2.0 * one).collect(), unit(1)];
    let rest = format!(
        "{}[outputs.modes]\nkind = \"modal\"\nof = \"part\"\n[outputs.seen]\nkind = \"recovered\"\nof = \"part\"\n\
         [outputs.end]\nkind = \"displacement\"\nof = \"part.bar_end\"\n\
         [outputs.turn]\nkind = \"rotation\"\nof = \"part.bar_end\"\n[outputs.energy]\nkind = \"energy\"\n\
         [loads.tip]\nkind = \"force\"\non = \"part.bar_end\"\nvector = [0, 1, 0.5]\nscale = \"sin(40*t)\"\n\
         [analysis]\nkind = \"dynamics\"\nend = 0.1\nstep = 1e-4\nscheme = \"radau-iia\"\n",
        clamp("part.bar_start")
    );
    let record = ran(&held(&rest, Some(&file(&rows))), &[]);
    let of = |output: &str, component: &str| column(&record, output, component);
    for (one, other, factor) in [
        (("seen", "r1"), ("end", "u2"), 1.0),
        (("seen", "r2"), ("turn", "r3"), 1.0),
        (("seen", "r3"), ("modes", "q1"), 1.0),
        (("seen", "r4"), ("modes", "q2"), 2.0),
        (("seen", "r5"), ("end", "u2"), 0.0),
    ] {
        let (one, other) = (of(one.0, one.1), of(other.0, other.1));
        let most = other.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        assert!(most > 1e-6, "it moves");
        for (one, other) in one.iter().zip(other) {
            assert!((one - factor * other).abs() < 1e-9 * most, "{one} {other}");
        }
    }
    // Rates are those of the amplitudes.
    for number in 1..=2 {
        let (q, v) = (of("modes", &format!("q{number}")), of("modes", &format!("v{number}")));
        let most = v.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        for k in 1..q.len() - 1 {
            let slope = (q[k + 1] - q[k - 1]) / 2e-4;
            assert!((slope - v[k]).abs() < 0.01 * most, "{number}: {slope} {}", v[k]);
        }
    }
}

/// Both interfaces held, a mode swings alone: energies in the units of the file.
#[test]
fn modal_coordinates_are_in_the_units_of_the_file() {
    let rest = format!(
        "{}[joints.end]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"part.bar_end\"\n\
         [outputs.modes]\nkind = \"modal\"\nof = \"part\"\n[outputs.energy]\nkind = \"energy\"\n\
         [analysis]\nkind = \"dynamics\"\nend = 0.05\nstep = 1e-4\nscheme = \"radau-iia\"\n",
        clamp("part.bar_start")
    );
    let model = held(&rest, None);
    let weighed = Model::from_text(
        "model.toml",
        &model.text().replace("lissom = 1\n", "lissom = 1\ngravity = [0, -3, -5]\n"),
    )
    .with_included(model.included());
    let record = ran(&weighed, &[]);
    let of = |output: &str, component: &str| column(&record, output, component);
    let kinetic = of("energy", "kinetic");
    let most = kinetic.iter().fold(0.0_f64, |most, value| most.max(*value));
    let (v1, v2) = (of("modes", "v1"), of("modes", "v2"));
    assert!(most > 1e-9);
    for (kinetic, (v1, v2)) in kinetic.iter().zip(v1.iter().zip(v2)) {
        let own = 0.5 * (v1 * v1 + v2 * v2);
        assert!((kinetic - own).abs() < 1e-6 * most, "{kinetic} {own}");
    }
}

#[test]
fn recovery_that_does_not_fit_is_refused() {
    let message = |recovery: Option<&str>, kind: &str| {
        let rest = format!(
            "{}[outputs.seen]\nkind = \"{kind}\"\nof = \"part\"\n[analysis]\nkind = \"statics\"\nsteps = 1\n",
            clamp("part.bar_start")
        );
        let model = held(&rest, recovery);
        let text = match model.session() {
            Err(lissom::SessionError::Model(report)) => report.render(false),
            Err(other) => other.to_string(),
            Ok(_) => String::new(),
        };
        text.replace('│', " ").split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let few = file(&[vec![1.0; 13]]);
    assert!(
        message(Some(&few), "recovered").contains("has 13 columns"),
        "{}",
        message(Some(&few), "recovered")
    );
    assert!(message(None, "recovered").contains("has no `recovery`"), "{}", message(None, "recovered"));
    assert_eq!(message(None, "modal"), "");
}
