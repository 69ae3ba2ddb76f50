//! Surfaces that move along themselves: conveyor belts.

use crate::support::runs::{last, run_without_warnings};
use crate::support::sessions::finished;

/// Both solutions of contacts, with the error of positions [m] that each may have.
const SOLUTIONS: [(&str, f64); 2] =
    [("relative_tolerance = 1e-6", 2e-5), ("scheme = \"backward-euler\"\nstep = 1e-3", 1e-3)];

/// A parcel laid on a belt that runs at 1 m/s, with a velocity of 0.3 m/s across it.
fn parcel(ground: &str, contact: &str, analysis: &str) -> String {
    format!(
        r#"
lissom = 1
gravity = [0, 0, -10]
[ground]
shape = {ground}
[bodies.parcel]
mass = 2
inertia = {{ box = [0.4, 0.4, 0.2] }}
shape = {{ box = [0.4, 0.4, 0.2] }}
position = [0, 0, 0.1]
velocity = [0, 0.3, 0]
[contacts.belt]
{contact}
stiffness = 1e5
dissipation = 1
friction = 0.2
[outputs.parcel]
kind = "position"
of = "parcel"
[outputs.velocity]
kind = "velocity"
of = "parcel"
[analysis]
kind = "dynamics"
end = 2
{analysis}
"#
    )
}

/// With the relative velocity u it slides for u/(μ g) along -u: by u²/(2 μ g) relative to the belt.
#[test]
fn a_parcel_is_carried_by_a_belt() {
    let (plane, on_belt) = ("{ kind = \"plane\" }", "base = \"ground\"\ntip = \"parcel\"");
    // A belt under the parcel, and one on the parcel that drives it along the ground.
    let belts = [
        format!("{on_belt}\nsurface_velocity = [1, 0, 0]"),
        "base = \"parcel\"\ntip = \"ground\"\nsurface_velocity = [-1, 0, 0]".to_owned(),
    ];
    let speed = 1.0_f64.hypot(0.3);
    let slid = speed / 4.0;
    for belt in belts {
        for (analysis, allowed) in SOLUTIONS {
            let record = run_without_warnings(&parcel(plane, &belt, analysis), &[]);
            let found = ["x", "y"].map(|axis| last(&record, "parcel", axis));
            let wanted = [2.0 - slid, 0.3 * slid];
            for (found, wanted) in found.into_iter().zip(wanted) {
                assert!((found - wanted).abs() < allowed, "{belt} {analysis}: {found} {wanted}");
            }
            assert!((last(&record, "velocity", "v1") - 1.0).abs() < 1e-6, "{belt} {analysis}");
        }
    }
}

/// The drive of the belt supplies μ m g cos(u) v until the parcel sticks: the balance of energy knows it.
#[test]
fn the_drive_of_a_belt_supplies_work() {
    let belt = "base = \"ground\"\ntip = \"parcel\"\nsurface_velocity = [1, 0, 0]";
    for (analysis, _) in SOLUTIONS {
        let session = finished(&parcel("{ kind = \"plane\" }", belt, analysis));
        let work = session.simulation().energy_balance().loads;
        // The force along the belt over the time of sliding is the momentum along it.
        assert!((work - 2.0).abs() < 0.02, "{analysis}: {work}");
    }
}

/// A belt that runs uphill carries a parcel that would slide down, and lowers it at its speed.
#[test]
fn inclined_belts_lift_and_hold() {
    for (velocity, (analysis, allowed)) in
        [0.0, 0.4, -0.4].into_iter().flat_map(|v| SOLUTIONS.map(|own| (v, own)))
    {
        let belt = format!(
            "base = \"ground\"\ntip = \"parcel\"\nsurface_velocity = [{velocity}, 0, 0]\nstatic_friction = 0.2"
        );
        let text = parcel("{ kind = \"plane\" }", &belt, analysis)
            .replace("gravity = [0, 0, -10]", "gravity = [-1, 0, -10]")
            .replace("velocity = [0, 0.3, 0]", &format!("velocity = [{velocity}, 0, 0]"));
        let record = run_without_warnings(&text, &[]);
        let found = last(&record, "parcel", "x");
        assert!((found - 2.0 * velocity).abs() < allowed, "{velocity} {analysis}: {found}");
    }
}

#[test]
fn surfaces_without_friction_are_rejected() {
    let belt = "base = \"ground\"\ntip = \"parcel\"\nsurface_velocity = [1, 0, 0]";
    let text = parcel("{ kind = \"plane\" }", belt, "").replace("friction = 0.2\n", "");
    assert!(crate::support::refused::refused(&text).contains("without `friction`"));
}
