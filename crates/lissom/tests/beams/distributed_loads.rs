//! Forces per length of beams, against closed forms.

use lissom::analyses::buckling::buckling;
use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};
use lissom::analyses::path::{PathEnd, PathSession};
use lissom::{Model, Session, SessionError};

use crate::support::sessions::finished;

const BEAM: &str = r#"
lissom = 1
[sections.bar]
shape = "general"
stiffness = [1e6, 4e5, 4e5, 100, 200, 200]
mass = { per_length = 1, inertia = [2e-4, 1e-4, 1e-4] }
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [2, 0, 0]
elements = 6
order = ORDER
FORCE
[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.start"
[outputs.tip]
kind = "displacement"
of = "bar.end"
[outputs.turn]
kind = "rotation"
of = "bar.end"
[outputs.root]
kind = "reaction"
of = "root"
[analysis]
ANALYSIS
"#;

fn beam(order: usize, force: &str, analysis: &str) -> String {
    BEAM.replace("ORDER", &order.to_string()).replace("FORCE", force).replace("ANALYSIS", analysis)
}

#[test]
fn a_cantilever_bends_under_a_force_per_length() {
    let statics = "kind = \"statics\"";
    for (order, most) in [(1, 2e-2), (2, 1e-4), (3, 1e-5)] {
        let run = finished(&beam(order, "force_per_length = [0, 0, -0.01]", statics));
        // w L⁴/(8 EI) + w L²/(2 GA).
        let wanted = -0.01 * (16.0 / (8.0 * 200.0) + 4.0 / (2.0 * 4e5));
        let found = run.value("tip.u3").unwrap();
        assert!((found / wanted - 1.0).abs() < most, "{order}: {found} {wanted}");
        // From the base on the tip: what holds the whole load, w L.
        assert!((run.value("root.f3").unwrap() - 0.02).abs() < 1e-8);
    }
    // Growing along the beam: w s/L: 11 w L⁴/(120 EI).
    let run = finished(&beam(3, "force_per_length = [0, 0, \"-0.01*s\"]", statics));
    let wanted = -0.01 * (11.0 * 16.0 / (120.0 * 200.0) + 4.0 / (3.0 * 4e5));
    assert!((run.value("tip.u3").unwrap() / wanted - 1.0).abs() < 1e-5);
}

/// A force that stays normal to the section rolls the beam up: without tension the bending moment is w (L-s)²/2 only as long as
/// the beam is straight; the resultant of a follower turns with it.
#[test]
fn a_force_in_section_axes_turns_with_the_section() {
    let statics = "kind = \"statics\"\nsteps = 20";
    let [dead, follower] = ["force_per_length", "section_force_per_length"]
        .map(|key| finished(&beam(3, &format!("{key} = [0, 0, 60]"), statics)));
    let value = |run: &Session, name: &str| run.value(name).unwrap();
    // The dead load keeps its resultant, w L upward; that of the follower leans back.
    assert!((value(&dead, "root.f3") + 120.0).abs() < 1e-6 && value(&dead, "root.f1").abs() < 1e-6);
    assert!(value(&follower, "root.f1") > 10.0 && value(&follower, "root.f3") > -119.0);
    assert!(value(&follower, "turn.r2").abs() > value(&dead, "turn.r2").abs());
    // Sections of the follower: root force is -w ∫ n ds with the normals n; its square is that of the chord turned by 90 degrees
    // where the beam is not stretched or sheared.
    let chord = (2.0 + value(&follower, "tip.u1")).hypot(value(&follower, "tip.u3"));
    let resultant = value(&follower, "root.f1").hypot(value(&follower, "root.f3"));
    assert!((resultant / (60.0 * chord) - 1.0).abs() < 1e-3, "{resultant} {}", 60.0 * chord);
}

#[test]
fn a_force_per_length_may_change_in_time() {
    let analysis = "kind = \"dynamics\"\nscheme = \"radau-iia\"\nend = 0.02\nstep = 1e-3";
    // Along the axis the free end moves as a bar: here the mean acceleration of the momentum, by the reaction.
    let run = finished(&beam(2, "force_per_length = [0, \"3*sin(100*t)*s\", 0]", analysis));
    assert!(run.value("tip.u2").unwrap() > 1e-4);
    for (force, words) in [
        ("force_per_length = [0, \"arm.rate\", 0]", "cannot name `arm.rate`"),
        ("force_per_length = [0, \"1/s\", 0]", "not a finite number at s = 0"),
        ("force_per_length = [0, 1]", "must have 3 entries"),
    ] {
        match Model::from_text("beam.toml", &beam(2, force, analysis)).session() {
            Err(SessionError::Model(report)) => {
                let reported = report.render(false).split_whitespace().collect::<Vec<_>>().join(" ");
                assert!(reported.contains(words), "{reported}");
            }
            Ok(_) => panic!("{force} is no good force"),
            Err(error) => panic!("{error}"),
        }
    }
}

/// A thin column, clamped at its foot, under its weight as a force per length and another load beside.
fn column(analysis: &str) -> String {
    beam(3, "force_per_length = [-10, 0, 0]", analysis)
        + r#"
[loads.top]
kind = "force"
on = "bar.end"
vector = [-1e-6, 0, 0]
[outputs.given]
kind = "power"
of = "top"
"#
}

#[test]
fn a_column_buckles_under_a_force_per_length_beside_another_load() {
    let model = Model::from_text("column.toml", &column("kind = \"buckling\""));
    let report = buckling(&model, Some(2)).unwrap();
    // Greenhill: q L³/(EI) = 7.8373, of both axes alike.
    let wanted = 7.8373 * 200.0 / (8.0 * 10.0);
    for mode in &report.buckling.modes {
        assert!((mode.load_factor / wanted - 1.0).abs() < 1e-3, "{} {wanted}", mode.load_factor);
    }
}

#[test]
fn a_path_begins_without_forces_per_length() {
    let text = column("kind = \"path\"\nend = 1").replace("[-10, 0, 0]", "[0, 0, -0.01]");
    let (record, report) = PathSession::new(&Model::from_text("beam.toml", &text)).unwrap().record();
    assert!(matches!(report.end, PathEnd::Reached), "{report:?}");
    let tip = record.column("tip", "u3").unwrap();
    assert!(tip[0].abs() < 1e-12, "{tip:?}");
    let wanted = -0.01 * (16.0 / (8.0 * 200.0) + 4.0 / (2.0 * 4e5));
    assert!((tip.last().unwrap() / wanted - 1.0).abs() < 1e-4, "{tip:?} {wanted}");
}

/// The frequencies are those of the beam alone, and outputs that name a load do not hinder them.
#[test]
fn the_undeformed_state_is_without_forces_per_length() {
    let find = |text: &str| {
        let request =
            ModeRequest { count: Some(2), about: Some(OperatingPoint::Undeformed), ..ModeRequest::default() };
        modes(&Model::from_text("beam.toml", text), &request).unwrap_or_else(|error| panic!("{error}"))
    };
    let [alone, loaded] =
        [beam(3, "", "kind = \"modes\""), column("kind = \"modes\"")].map(|text| find(&text));
    for (one, other) in alone.modes.iter().zip(&loaded.modes) {
        assert!(
            (one.frequency / other.frequency - 1.0).abs() < 1e-9,
            "{} {}",
            one.frequency,
            other.frequency
        );
    }
}
