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

/// A quarter of a ring of 0.4 m with two planes of symmetry, under `pressure` from outside [Pa] with a deviation of the radius [m]. The ends
/// slide in planes: pressure has a potential, although its stiffness is not symmetric at the rim.
fn ring(pressure: f64, deviation: f64, analysis: &str) -> String {
    let held = [("a", "west", "y"), ("b", "east", "x"), ("c", "south", "z"), ("d", "north", "z")].map(|(name, side, axis)| {
        format!("[joints.{name}]\nkind = \"planar\"\nbase = \"ground\"\ntip = \"s.{side}\"\naxis = \"{axis}\"\n")
    });
    format!(
        "lissom = 1\n[materials.m]\nE = 70e9\nnu = 0.3\ndensity = 2700\n[shells.s]\n\
         surface = [\"(0.4 + {deviation}*cos(pi*u))*cos(pi/2*u)\", \"(0.4 + {deviation}*cos(pi*u))*sin(pi/2*u)\", \"0.05*v\"]\n\
         divisions = [16, 1]\nthickness = 0.003\nmaterial = \"m\"\npressure_on_top = \"{pressure}*t\"\n{}{analysis}",
        held.concat()
    )
}

/// 3 D/R³ of a ring whose ends do not strain along its axis.
fn critical_pressure() -> f64 {
    3.0 * 70e9 * 0.003_f64.powi(3) / (12.0 * (1.0 - 0.09)) / 0.4_f64.powi(3)
}

#[test]
fn a_ring_buckles_under_pressure() {
    let text = ring(0.2 * critical_pressure(), 0.0, "[analysis]\nkind = \"buckling\"\n");
    let report = buckling(&Model::from_text("ring.toml", &text), Some(2)).unwrap();
    let found = report.buckling.modes[0].load_factor;
    assert!((found / 5.0 - 1.0).abs() < 0.01, "{found}");
    // The loads of statics are those at the end of its load steps.
    let text = ring(0.2 * critical_pressure(), 0.0, "[analysis]\nkind = \"statics\"\n");
    let again = buckling(&Model::from_text("ring.toml", &text), Some(2)).unwrap();
    assert!((again.buckling.modes[0].load_factor / found - 1.0).abs() < 1e-9);
}

#[test]
fn the_path_of_a_ring_under_pressure_bifurcates() {
    let text = ring(critical_pressure(), 0.0, "[analysis]\nkind = \"path\"\nend = 1.2\nstep = 0.2\n");
    let (_, report) = crate::support::paths::follow(&text, &[]);
    let found = report.critical.first().expect("a critical point").load_factor;
    assert!((found - 1.0).abs() < 0.01, "{found}");
}

#[test]
fn an_oval_ring_beyond_its_critical_pressure_is_unstable() {
    for (factor, is_unstable) in [(0.5, false), (40.0, true)] {
        let text = ring(factor * critical_pressure(), 5e-4, "[analysis]\nkind = \"statics\"\nsteps = 1\n");
        let mut session = Model::from_text("ring.toml", &text).session().unwrap();
        let result = session.run();
        let has_warning = session.warnings().any(|warning| warning.code() == "unstable-equilibrium");
        // A step that does not converge is no wrong equilibrium either.
        assert!(
            if is_unstable { result.is_err() || has_warning } else { result.is_ok() && !has_warning },
            "{factor}"
        );
        if !is_unstable {
            assert_eq!(session.simulation().stability().last().map(|own| own.1), Some(Some(0)));
        }
    }
}

/// Half a metre of an oval tube under pressure from outside, of a factor of the critical one, held in the planes of its ends.
fn tube(factor: f64, analysis: &str) -> String {
    let held = [
        ("a", "s.south", "z"),
        ("b", "s.north", "z"),
        ("c", "s@0,0.5", "y"),
        ("d", "s@0.5,0.5", "y"),
        ("e", "s@0.25,0.5", "x"),
    ];
    let held = held.map(|(name, tip, axis)| {
        format!(
            "[joints.{name}]\nkind = \"generic\"\nbase = \"ground\"\ntip = \"{tip}\"\nlocked = [\"{axis}\"]\n"
        )
    });
    format!(
        "lissom = 1\n[materials.m]\nE = 70e9\nnu = 0.3\ndensity = 2700\n[shells.s]\n\
         surface = [\"(0.4 + 5e-4*cos(4*pi*u))*cos(2*pi*u)\", \"(0.4 + 5e-4*cos(4*pi*u))*sin(2*pi*u)\", \"0.05*v\"]\n\
         divisions = [24, 2]\nthickness = 0.003\nmaterial = \"m\"\njoin = true\npressure_on_top = \"{}*t\"\n{}\
         [analysis]\nkind = \"statics\"\n{analysis}",
        factor * critical_pressure(),
        held.concat()
    )
}

#[test]
fn walls_of_a_tube_that_pass_through_each_other_are_reported() {
    for (factor, crosses) in [(0.5, false), (2.0, true)] {
        let mut session = Model::from_text("tube.toml", &tube(factor, "")).session().unwrap();
        session.run().unwrap();
        let warned = session.warnings().any(|warning| warning.code() == "shell-crosses-itself");
        assert_eq!(warned, crosses, "{factor}");
    }
}

#[test]
fn the_stability_of_the_last_equilibrium_is_reported() {
    let mut session = Model::from_text("tube.toml", &tube(30.0, "steps = 10\n")).session().unwrap();
    session.run().unwrap();
    let warning = session.warnings().find(|warning| warning.code() == "unstable-equilibrium");
    let text = warning.expect("a warning").to_string();
    assert!(text.contains("the last one, at t = 1, is unstable in"), "{text}");
}

/// A beam of 1 m between clamps, pushed by a thermal strain, under a load across it: it stiffens. Whatever the load, there is no load factor.
#[test]
fn a_load_factor_of_what_bends_before_is_refused() {
    let beam = |load: f64| {
        format!(
            "lissom = 1\n[materials.m]\nE = 70e9\nnu = 0.3\ndensity = 2700\nexpansion = 2.3e-5\n[sections.s]\nshape = \"rectangle\"\nwidth = 0.02\nheight = 0.01\n\
             material = \"m\"\n[beams.b]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 6\ntemperature = 8\n\
             [joints.c]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"b.start\"\n[joints.d]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"b.end\"\n\
             [loads.q]\nkind = \"force\"\non = \"b@0.5\"\nvector = [0, 0, {load}]\n[analysis]\nkind = \"buckling\"\n"
        )
    };
    for load in [0.01, 1.0, 40.0] {
        let error = find(&beam(load), 1);
        assert!(matches!(error, Err(BucklingRunError::NotProportional(..))), "{load}: {error:?}");
    }
    // However small the load, a straight column has its factor.
    for load in [1e-4, 1.0, 100.0] {
        let report = find(&column(&format!("vector = [-{load}, 0, 0]")), 1).unwrap();
        assert!((report.buckling.modes[0].load_factor * load / (PI.powi(2) * 25.0) - 1.0).abs() < 1e-3);
    }
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

/// The load factors of a cylinder under axial load are close to each other, from the classical value E h²/(R √(3 (1 - ν²))) per length on; this
/// mesh is 16 % too stiff.
#[test]
fn dense_load_factors_of_a_cylinder_are_all_found() {
    let text = "lissom = 1\n[materials.m]\nE = 2e11\nnu = 0.3\ndensity = 7800\n[shells.s]\n\
                surface = [\"0.3*cos(2*pi*u)\", \"0.3*sin(2*pi*u)\", \"0.25*v\"]\ndivisions = [40, 8]\nthickness = 0.002\nmaterial = \"m\"\njoin = true\n\
                [joints.b]\nkind = \"generic\"\nbase = \"ground\"\ntip = \"s.south\"\nlocked = [\"x\", \"y\", \"z\"]\n\
                [joints.t]\nkind = \"generic\"\nbase = \"ground\"\ntip = \"s.north\"\nlocked = [\"x\", \"y\"]\n\
                [loads.f]\nkind = \"force\"\non = \"s.north\"\nvector = [0, 0, -1e6]\n[analysis]\nkind = \"buckling\"\n";
    let report = buckling(&Model::from_text("cylinder.toml", text), Some(16)).unwrap();
    assert_eq!((report.buckling.completeness, report.buckling.modes.len()), (Completeness::Counted, 16));
    let classical = 2.0 * PI * 2e11 * 0.002_f64.powi(2) / (3.0 * 0.91_f64).sqrt() / 1e6;
    let factors: Vec<f64> = report.buckling.modes.iter().map(|mode| mode.load_factor).collect();
    assert!((factors[0] / classical - 1.164).abs() < 0.01 && factors[15] < 1.22 * classical, "{factors:?}");
    assert!(factors.windows(2).all(|pair| pair[0] <= pair[1] * (1.0 + 1e-9)), "{factors:?}");
}
