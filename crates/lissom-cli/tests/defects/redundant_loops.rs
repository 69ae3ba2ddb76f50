//! Loops with redundant constraints: small, loaded, rounded and hung on too many hinges.

use std::f64::consts::PI;
use std::fs;

use crate::defects::results::{Results, largest, model, near};
use crate::support::{Folder, lissom};

fn violation(results: &Results) -> f64 {
    let summary = fs::read_to_string(results.path("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    summary["max_constraint_violation"].as_f64().unwrap()
}

/// A driven four-bar of parallel revolutes with a crank of 3 mm: the angle of the rocker is that of links in the plane, which are 2.5,
/// sqrt(34)/2 / 2 and 1.5 cranks long.
#[test]
fn small_loops_move_like_large_ones() {
    let results = Results::clean("small-four-bar-3mm.toml", &[]);
    assert!(violation(&results) < 1e-12);
    // Positions of the joints in lengths of the crank.
    let (ground, coupler, rocker) = (2.5, 2.5_f64.hypot(0.5), 1.5);
    for (time, angle) in results.column("time").into_iter().zip(results.column("d.angle")) {
        let crank = 2.0 * PI * time;
        // From the far pivot to the pin of the crank, by the law of cosines.
        let (x, z) = (crank.sin() - ground, crank.cos());
        let distance = x.hypot(z);
        let between =
            ((rocker * rocker + distance * distance - coupler * coupler) / (2.0 * rocker * distance)).acos();
        let expected = x.atan2(z) + between;
        near("d.angle", (angle - expected).sin(), 0.0, 2e-6);
    }
}

#[test]
fn small_loops_have_equilibria() {
    for scale in [1.0, 0.2, 0.05] {
        let scaled = |name: &str, values: [f64; 3]| format!("{name}={:?}", values.map(|value| scale * value));
        let changes = [
            scaled("bodies.crank.position", [0.0, 0.0, 0.025]),
            scaled("bodies.coupler.position", [0.05, 0.0, 0.05]),
            scaled("bodies.rocker.position", [0.1, 0.0, 0.025]),
            scaled("joints.b.at", [0.0, 0.0, 0.05]),
            scaled("joints.c.at", [0.1, 0.0, 0.05]),
            scaled("joints.d.at", [0.1, 0.0, 0.0]),
        ];
        let options: Vec<&str> = changes.iter().flat_map(|change| ["--set", change.as_str()]).collect();
        let results = Results::clean("small-four-bar-statics.toml", &options);
        // Three links of the same mass, of which the coupler is raised by the whole crank.
        for (time, moment) in results.column("time").into_iter().zip(results.column("m.moment")) {
            let weight = 0.00125 * 9.81 * 0.05 * scale;
            near("m.moment", moment / weight, -2.0 * (0.5 * time).sin(), 1e-9);
        }
    }
}

#[test]
fn a_toggle_press_bears_its_load_at_every_tolerance() {
    for tolerance in ["1e-3", "1e-5", "1e-7"] {
        let results = Results::of(
            "run",
            "toggle-press.toml",
            &["--no-plots", "--set", &format!("analysis.relative_tolerance={tolerance}")],
        );
        results.assert_done();
        assert!(violation(&results) < 5e-9, "{tolerance}: {}", violation(&results));
    }
}

/// Two wheels coupled by rods at right angles whose pins are rounded to seven digits: both turn with the torque over all inertia.
#[test]
fn coupling_rods_of_seven_digits_do_not_bind() {
    let options = ["--no-plots"];
    for change in [&[][..], &["--unset", "analysis.step"]] {
        let results = Results::of("run", "coupling-rods-seven-digits.toml", &[&options, change].concat());
        results.assert_done();
        // 900 N m, two wheels of 450 kg m², two rods of 180 kg on cranks of 0.35 m.
        let crank: f64 = 0.322_371_3_f64.hypot(0.136_296_4);
        let rate = 900.0 / (2.0 * 450.0 + 2.0 * 180.0 * crank * crank);
        near("a.rate", results.last("a.rate"), 10.0 * rate, 2e-3);
        near("a.angle", results.last("a.angle"), 50.0 * rate, 5e-3);
        for force in ["c.f1", "c.f2"] {
            assert!(largest(&results.column(force)) < 4e3, "{force}: {}", largest(&results.column(force)));
        }
    }
}

/// Two wheels on one axle: along it the contact forces are not unique.
#[test]
fn two_rolling_wheels_on_an_axle_take_few_steps() {
    let results = Results::of("run", "two-rolling-wheels.toml", &["--no-plots"]);
    results.assert_done();
    let summary = fs::read_to_string(results.path("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert!(summary["steps"].as_u64().unwrap() < 60, "{}", summary["steps"]);
}

/// A door on two hinges swings about them as if they were in line, up to the geometric tolerance; beyond, nothing can move.
#[test]
fn hinges_out_of_line() {
    let axis = |angle: &str| format!("joints.k.axis=[{angle}, 1, 0]");
    let aligned = Results::of("run", "hinges-out-of-line.toml", &["--no-plots", "--set", &axis("0")]);
    aligned.assert_done();
    for angle in ["1e-8", "1e-7", "1e-6", "5e-6"] {
        let results = Results::of("run", "hinges-out-of-line.toml", &["--no-plots", "--set", &axis(angle)]);
        results.assert_done();
        near(angle, results.last("q.angle"), aligned.last("q.angle"), 1e-5);
        assert_eq!(
            results.ended.errors.contains("redundant-misfit"),
            angle.parse::<f64>().unwrap() > 1e-6,
            "{angle}"
        );
    }
    for angle in ["1e-4", "1e-3", "1e-2"] {
        let folder = Folder::new(&format!("hinges-{angle}"));
        for command in ["run", "check"] {
            let ended =
                lissom(&[command, &model("hinges-out-of-line.toml"), "--set", &axis(angle)], folder.path());
            assert_ne!(ended.code, 0, "{command} {angle}");
            let errors = &ended.errors;
            assert!(
                errors.contains("no degree of freedom") && errors.contains("`h`"),
                "{command} {angle}: {errors}"
            );
        }
    }
}

/// A swing on three hinges in line: their forces are those of least norm, which in sum are the force of one.
#[test]
fn the_forces_of_three_hangers_are_of_least_norm() {
    let text = |hinges: &str| {
        format!(
            r#"
lissom = 1
gravity = [0, 0, -9.81]
bodies.seat = {{ mass = 17.33, inertia = [4, 3, 2], position = [0.6, 0, -0.8] }}
{hinges}
analysis = {{ kind = "dynamics", end = 2 }}
"#
        )
    };
    let hinge = |name: &str, y: f64| {
        format!(
            "joints.{name} = {{ kind = \"revolute\", base = \"ground\", tip = \"seat\", at = [0, {y}, 0], axis = \"y\" }}\n\
             outputs.{name} = {{ kind = \"reaction\", of = \"{name}\" }}\n"
        )
    };
    let run = |hinges: &[(&str, f64)]| {
        let hinges: String = hinges.iter().map(|(name, y)| hinge(name, *y)).collect();
        let folder = Folder::new(&format!("hangers-{}", hinges.len()));
        let path = folder.path().join("swing.toml");
        fs::write(&path, text(&hinges)).unwrap();
        let results =
            Results::of("run", path.to_str().unwrap(), &["--no-plots", "--set", "analysis.output_step=0.05"]);
        results.assert_done();
        results
    };
    let [three, one] = [run(&[("a", -1.0), ("b", 0.0), ("c", 1.0)]), run(&[("b", 0.0)])];
    for component in ["f1", "f3"] {
        let of = |results: &Results, name: &str| results.column(&format!("{name}.{component}"));
        let columns = ["a", "b", "c"].map(|name| of(&three, name));
        for (k, expected) in of(&one, "b").into_iter().enumerate() {
            for column in &columns {
                near(component, column[k], expected / 3.0, 2e-2);
            }
        }
    }
}

/// A scissor jack with redundant hinges, whose thread has its equations in the axes of the spindle that turns: each is redundant at some
/// angles and the only independent one at others. The pins of the spindle are 54 mm closer together after nine turns.
#[test]
fn redundant_equations_in_axes_that_turn_are_exchanged_in_time() {
    let (arm, half): (f64, f64) = (0.26, 0.245);
    let height = |half: f64| 2.0 * (arm * arm - half * half).sqrt();
    let risen = height(half - 0.027) - height(half);
    let alpha = ["--set", "analysis.scheme=generalized-alpha", "--set", "analysis.step=0.004"];
    let euler = ["--set", "analysis.scheme=backward-euler", "--set", "analysis.step=0.01"];
    let exchanged = ["--set", "joints.thr.base=spindle", "--set", "joints.thr.tip=tr"];
    for change in [&[][..], &alpha, &euler, &exchanged] {
        let results = Results::of("run", "scissor-jack.toml", &[&["--no-plots"], change].concat());
        results.assert_done();
        near("up.displacement", results.last("up.displacement"), risen, 1e-8);
        assert!(violation(&results) < 1e-8, "{change:?}: {}", violation(&results));
    }
}
