//! Linear buckling against closed forms.

use lissom::AnalysisWarning;
use std::f64::consts::PI;
use std::fmt::Write;

use lissom::Model;
use lissom::analyses::buckling::{BucklingReport, BucklingRunError, buckling};
use lissom_core::linearized::Completeness;

/// A clamped column of unit length under a load along its axis.
fn column(load: &str) -> String {
    format!(
        r#"
lissom = 1
[sections.bar]
shape = "general"
stiffness = [1e7, 1e7, 1e7, 1e4, 100, 300]
mass = [1, 1, 1, 1, 1, 1]
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
up = [0, 0, 1]
elements = 8
[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.start"
[loads.push]
kind = "force"
on = "bar.end"
{load}
[analysis]
kind = "buckling"
"#
    )
}

fn find(text: &str, count: usize) -> Result<BucklingReport, BucklingRunError> {
    buckling(&Model::from_text("column.toml", text), Some(count))
}

#[test]
fn an_euler_column_buckles_about_both_axes() {
    let report = find(&column("vector = [-2, 0, 0]"), 4).unwrap();
    assert_eq!(report.buckling.completeness, Completeness::Counted);
    // (2k - 1)² π² EI/(4 L²) over the load, lowered by shear and raised by shortening, both P/1e7.
    let exact = [100.0, 300.0, 900.0, 2500.0].map(|bending| PI.powi(2) * bending / 8.0);
    assert_eq!(report.buckling.modes.len(), 4);
    for (mode, exact) in report.buckling.modes.iter().zip(exact) {
        let error = (mode.load_factor / exact - 1.0).abs();
        assert!(error < 1e-3, "{} for {exact}", mode.load_factor);
    }
    assert!((report.buckling.modes[0].load_factor / exact[0] - 1.0).abs() < 1e-4);
    assert!(report.warnings.is_empty(), "{:?}", report.warnings);
    // The first one bends about the soft axis, 2: it moves along 3.
    let tip = &report.shapes[0][report.shapes[0].len() - 1];
    assert!(tip.displacement[2].re.abs() > 100.0 * tip.displacement[1].re.abs());
}

#[test]
fn what_does_not_buckle_is_reported() {
    let report = find(&column("vector = [2, 0, 0]"), 2).unwrap();
    assert!(
        report.buckling.modes.is_empty() && report.warnings == [AnalysisWarning::Stiffening],
        "{:?}",
        report.warnings
    );
    assert!(matches!(find(&column("vector = [-300, 0, 0]"), 1), Err(BucklingRunError::AlreadyCritical(_))));
    assert_eq!(report.buckling.completeness, Completeness::Counted);
    let follower = find(&column("vector = [0, 0.1, 0]\nfollower = true"), 1);
    assert!(matches!(follower, Err(BucklingRunError::Buckling(_))), "{follower:?}");
}

/// Clamped columns side by side, each as stiff about both axes of its section, under the same load.
fn round_columns(count: usize) -> String {
    let mut text = "lissom = 1\n[analysis]\nkind = \"buckling\"\n[sections.tube]\nshape = \"general\"\n\
        stiffness = [1e7, 1e7, 1e7, 1e4, 200, 200]\nmass = [1, 1, 1, 1, 1, 1]\n"
        .to_owned();
    for k in 0..count {
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "[beams.b{k}]\nsection = \"tube\"\nfrom = [0, {k}, 0]\nto = [1, {k}, 0]\nelements = 4\n\
            [joints.j{k}]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"b{k}.start\"\n\
            [loads.l{k}]\nkind = \"force\"\non = \"b{k}.end\"\nvector = [-2, 0, 0]\n"
        );
    }
    text
}

#[test]
fn factors_that_come_several_times_are_counted_whole_wherever_the_count_cuts_them() {
    for (columns, counts) in [(1, 1..=6), (4, 3..=3), (6, 5..=5)] {
        for count in counts {
            let report = find(&round_columns(columns), count).unwrap();
            assert_eq!(report.buckling.completeness, Completeness::Counted, "{count} of {columns}");
            assert!(report.warnings.is_empty(), "{:?}", report.warnings);
            assert_eq!(report.buckling.modes.len(), count);
            for (index, mode) in report.buckling.modes.iter().enumerate() {
                let order = 2.0 * (index / (2 * columns)) as f64 + 1.0;
                let exact = PI.powi(2) * order * order * 200.0 / 8.0;
                assert!((mode.load_factor / exact - 1.0).abs() < 2e-3, "{} for {exact}", mode.load_factor);
            }
        }
    }
}

/// More than there are: all that there are, and a warning; what nobody asked for is no matter.
#[test]
fn fewer_factors_than_asked_for_are_reported() {
    let text = column("vector = [-2, 0, 0]").replace("elements = 8", "elements = 1\norder = 1");
    let reported = |count: Option<usize>| {
        let report = buckling(&Model::from_text("column.toml", &text), count).unwrap();
        assert_eq!(report.buckling.completeness, Completeness::Counted);
        (report.buckling.modes.len(), report.warnings)
    };
    let (number, warnings) = reported(Some(200));
    assert!(number < 200);
    assert_eq!(warnings, [AnalysisWarning::FewerLoadFactors { wanted: 200, found: number }]);
    assert!(reported(Some(number)).1.is_empty());
    let (few, warnings) = reported(None);
    assert!(few <= number && warnings.is_empty(), "{few} {warnings:?}");
}

/// Constant loads of statics grow over its load steps: buckling takes their full size.
#[test]
fn loads_of_statics_have_their_full_size() {
    let column = "lissom = 1\n[materials.m]\nE = 1e9\nnu = 0.3\ndensity = 1000\n[sections.s]\nshape = \"rectangle\"\nmaterial = \"m\"\nwidth = 0.02\nheight = 0.01\n\
                  [beams.b]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [0, 0, 1]\nelements = 4\n[joints.j]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"b.start\"\n\
                  [loads.f]\nkind = \"force\"\non = \"b.end\"\nvector = [0, 0, -1]\n[analysis]\nkind = \"KIND\"\n";
    let factor = |kind: &str| {
        let model = Model::from_text("column.toml", &column.replace("KIND", kind));
        buckling(&model, Some(1)).unwrap().buckling.modes[0].load_factor
    };
    let [one, other] = ["buckling", "statics"].map(factor);
    assert!((one / other - 1.0).abs() < 1e-12 && one > 3.0, "{one}, {other}");
}
