//! Strains without stress: of temperatures in beams, shells and solids, and of prestress.

use std::f64::consts::PI;

use lissom::Model;
use lissom::analyses::modes::{ModeRequest, modes};

use crate::support::refused::refused;
use crate::support::runs::{SCHEMES, column, last, run};

const STEEL: &str = "lissom = 1\n[materials.steel]\nE = 210e9\nnu = 0.3\ndensity = 7850\nexpansion = 12e-6\n";
const BRASS: &str = "[materials.brass]\nE = 100e9\nnu = 0.3\ndensity = 8400\nexpansion = 19e-6\n";
const ROD: &str =
    "[sections.rod]\nshape = \"rectangle\"\nmaterial = \"steel\"\nwidth = 0.02\nheight = 0.02\n";

const STATICS: &str = "[analysis]\nkind = \"statics\"\n";

fn clamp(name: &str, tip: &str) -> String {
    format!("[joints.{name}]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"{tip}\"\n")
}

fn output(name: &str, kind: &str, of: &str) -> String {
    format!("[outputs.{name}]\nkind = \"{kind}\"\nof = \"{of}\"\n")
}

fn beam(keys: &str) -> String {
    format!(
        "{STEEL}{ROD}[beams.rod]\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 3\n{keys}\n"
    )
}

#[test]
fn a_free_beam_expands_and_bends_and_a_held_one_is_pressed() {
    let keys = "temperature = 100\ntemperature_slope = [200, 500]";
    let rest = [
        clamp("root", "rod.start"),
        output("tip", "displacement", "rod.end"),
        "[outputs.energy]\nkind = \"energy\"\n".to_owned(),
        output("root", "section_force", "rod@0"),
    ];
    let record = run(&(beam(keys) + &rest.concat() + STATICS), &[]);
    // An arc of a line that is longer by α ΔT, with the curvature α dT/dx towards the cold side.
    let curvature = 12e-6 * 200_f64.hypot(500.0);
    let length = 1.0 + 12e-6 * 100.0;
    let sag = length * (1.0 - curvature.cos()) / curvature;
    assert!((last(&record, "tip", "u1") - (length * curvature.sin() / curvature - 1.0)).abs() < 1e-9);
    for (component, share) in [("u2", 200.0), ("u3", 500.0)] {
        let exact = -sag * share / 200_f64.hypot(500.0);
        let found = last(&record, "tip", component);
        assert!((found / exact - 1.0).abs() < 1e-6, "{component}: {found:e}, {exact:e}");
    }
    assert!(last(&record, "root", "f1").abs() < 1e-3);
    assert!(last(&record, "energy", "strain").abs() < 1e-9);

    let rest =
        [clamp("root", "rod.start"), clamp("end", "rod.end"), output("force", "section_force", "rod@0.5")];
    let record = run(&(beam("temperature = \"60*s\"") + &rest.concat() + STATICS), &[]);
    // The mean temperature is 30 K.
    let exact = -210e9 * 4e-4 * 12e-6 * 30.0;
    assert!((last(&record, "force", "f1") / exact - 1.0).abs() < 1e-9);
}

/// The compression E A α ΔT lowers frequencies of a beam with hinged ends by the factor √(1 - N/N_cr).
#[test]
fn heat_lowers_the_frequencies_of_a_held_beam() {
    let critical = PI * PI * 210e9 * 0.02_f64.powi(4) / 12.0 / (210e9 * 4e-4 * 12e-6);
    let frequency = |temperature: f64| {
        let hinge = |name: &str, tip: &str| {
            format!(
                "[joints.{name}]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"{tip}\"\naxis = [0, 1, 0]\n"
            )
        };
        let text =
            beam(&format!("temperature = {temperature}")) + &hinge("a", "rod.start") + &hinge("b", "rod.end");
        let text = text + "[analysis]\nkind = \"modes\"\n";
        let request = ModeRequest { count: Some(1), ..ModeRequest::default() };
        modes(&Model::from_text("model.toml", &text), &request).expect("modes").modes[0].frequency
    };
    let ratio = frequency(0.5 * critical) / frequency(0.0);
    assert!((ratio / 0.5_f64.sqrt() - 1.0).abs() < 2e-3, "{ratio}");
}

#[test]
fn a_beam_that_is_cooled_at_once_vibrates_alike_with_every_scheme() {
    let text = beam("temperature = -100\ntemperature_slope = [0, 300]")
        + &clamp("root", "rod.start")
        + &output("tip", "displacement", "rod.end")
        + "[analysis]\nkind = \"dynamics\"\nend = 0.02\nstep = 1e-4\n";
    let runs: Vec<[f64; 2]> = SCHEMES
        .iter()
        .map(|scheme| {
            let record = run(&text, &[("analysis.scheme", scheme)]);
            ["u1", "u3"].map(|component| {
                let values = column(&record, "tip", component);
                values.iter().sum::<f64>() / values.len() as f64
            })
        })
        .collect();
    for means in &runs {
        for (own, first) in means.iter().zip(runs[0]) {
            assert!((own / first - 1.0).abs() < 0.02, "{runs:?}");
        }
    }
}

/// Two layers with different expansion bend to the curvature 6 Δα ΔT (1 + m)²/(h (3 (1 + m)² + (1 + m n)(m² + 1/(m n)))), m = 1 the ratio
/// of their thicknesses, n that of their moduli [Timoshenko 1925]; a plate in both directions, since Poisson's ratios are equal.
#[test]
fn a_strip_of_two_metals_bends_as_timoshenko_says() {
    let text = format!(
        "{STEEL}{BRASS}[shells.strip]\ncorners = [[0, 0, 0], [0.1, 0, 0], [0.1, 0.01, 0], [0, 0.01, 0]]\ndivisions = [20, 2]\n\
         plies = [{{ thickness = 1e-3, material = \"steel\" }}, {{ thickness = 1e-3, material = \"brass\" }}]\ntemperature = 10\n"
    ) + &clamp("root", "strip.west")
        + &output("tip", "displacement", "strip@1,0.5")
        + &output("stress", "shell_stress", "strip@0.5,0.5")
        + &output("force", "shell_force", "strip@0.5,0.5")
        + STATICS;
    let record = run(&text, &[]);
    let (h, n) = (2e-3, 210.0 / 100.0);
    let curvature = 6.0 * 7e-6 * 10.0 * 4.0 / (h * (12.0 + (1.0 + n) * (1.0 + 1.0 / n)));
    let exact = -0.5 * curvature * 0.1 * 0.1;
    let tip = last(&record, "tip", "u3");
    // The clamp hinders the curvature across.
    assert!((tip / exact - 1.0).abs() < 0.03, "{tip:e}, {exact:e}");
    let force = last(&record, "force", "n11");
    // Layers carry thousands of newtons per metre.
    assert!(force.abs() < 10.0, "{force:e}");
    // By hand: layers of one thickness t with E1, E2 carry ∓ P, with the moment M = E κ t³/12/(1 - ν) of each about its middle.
    let t = 1e-3;
    let [steel, brass] = [210e9, 100e9].map(|young: f64| young / 0.7);
    let force = curvature * t * t * (steel + brass) / 12.0;
    let at = |component: &str| last(&record, "stress", component);
    // Outer faces: the steel below, the brass above; bending towards the steel stretches the brass's outside less than its inside.
    let exact = [-force / t + brass * curvature * t / 2.0, force / t - steel * curvature * t / 2.0];
    for (component, exact) in ["top11", "bottom11"].iter().zip(exact) {
        let found = at(component);
        assert!((found / exact - 1.0).abs() < 0.02, "{component}: {found:e}, {exact:e}");
    }
}

/// Joints of three points that hold a part without hindering it.
fn held(corner: &str, along: &str, across: &str) -> String {
    let joint = |name: &str, kind: &str, tip: &str, axis: &str| {
        format!("[joints.{name}]\nkind = \"{kind}\"\nbase = \"ground\"\ntip = \"part@{tip}\"\n{axis}")
    };
    joint("corner", "spherical", corner, "")
        + &joint("y", "point_in_plane", along, "axis = \"y\"\n")
        + &joint("z", "point_in_plane", along, "axis = \"z\"\n").replace("joints.z", "joints.z1")
        + &joint("z", "point_in_plane", across, "axis = \"z\"\n")
}

/// Elements of any shape expand without stress, and their pictures know it.
#[test]
fn distorted_shells_and_solids_expand_without_stress() {
    let shell = format!(
        "{STEEL}[shells.part]\nsurface = [\"u + 0.1*u*v\", \"0.7*v + 0.1*u*v\", \"0.1*u*u\"]\ndivisions = [5, 4]\nthickness = 0.01\n\
         material = \"steel\"\ntemperature = 50\n"
    );
    let solid = |model: &str| {
        format!(
            "{STEEL}[solids.part]\nvolume = [\"u + 0.1*u*v\", \"0.7*v + 0.1*u*w\", \"0.3*w + 0.1*u*u\"]\ndivisions = [3, 2, 1]\n\
             material = \"steel\"\nmodel = \"{model}\"\ntemperature = 50\n"
        )
    };
    let parts = [
        (shell, held("0,0", "1,0", "0,1"), "shell_stress", "0.4,0.5", "mises_top"),
        (solid("st-venant-kirchhoff"), held("0,0,0", "1,0,0", "0,1,0"), "solid_stress", "1,0.5,1", "mises"),
        (solid("neo-hookean"), held("0,0,0", "1,0,0", "0,1,0"), "solid_stress", "1,0.5,1", "mises"),
    ];
    for (part, joints, kind, place, component) in parts {
        let outputs = output("stress", kind, &format!("part@{place}"));
        let text = part + &joints + &outputs + STATICS;
        let record = run(&text, &[]);
        // A held one would have 126 MPa or more.
        let stress = last(&record, "stress", component);
        assert!(stress.abs() < 2e4, "{kind}: {stress:e}");
    }
}

/// Beams, shells and solids are longer by α ΔT, also where its square counts.
#[test]
fn beams_shells_and_solids_expand_alike() {
    let heat = "temperature = 4000\n";
    let shell = format!(
        "{STEEL}[shells.part]\ncorners = [[0, 0, 0], [1, 0, 0], [1, 0.5, 0], [0, 0.5, 0]]\ndivisions = [2, 1]\nthickness = 0.01\n\
         material = \"steel\"\n{heat}"
    ) + &held("0,0", "1,0", "0,1");
    let solid = format!(
        "{STEEL}[solids.part]\nvolume = [\"u\", \"0.5*v\", \"0.2*w\"]\ndivisions = [2, 1, 1]\nmaterial = \"steel\"\n{heat}"
    ) + &held("0,0,0", "1,0,0", "0,1,0");
    let rod = beam(heat) + &clamp("root", "rod.start");
    for (part, end) in [(rod, "rod.end"), (shell, "part@1,0"), (solid, "part@1,0,0")] {
        let record = run(&(part + &output("end", "displacement", end) + STATICS), &[]);
        let longer = last(&record, "end", "u1");
        assert!((longer / (4000.0 * 12e-6) - 1.0).abs() < 1e-8, "{end}: {longer}");
    }
}

/// A bar whose temperature grows across it bends to the curvature α dT/dz without stress, between supports with it.
#[test]
fn a_solid_with_a_gradient_bends() {
    let text = format!(
        "{STEEL}[solids.bar]\nsize = [1, 0.1, 0.1]\norigin = [0, 0, 0]\ndivisions = [4, 1, 1]\nmaterial = \"steel\"\n\
         temperature = \"1000*(z - 0.05)\"\nsets = {{ corner = {{ near = [0, 0, 0] }}, side = {{ near = [0, 0.1, 0] }}, upper = {{ near = [0, 0, 0.1] }} }}\n"
    );
    let joint = |name: &str, tip: &str, axis: &str| {
        format!(
            "[joints.{name}]\nkind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"bar.{tip}\"\naxis = \"{axis}\"\n"
        )
    };
    let text = text
        + "[joints.corner]\nkind = \"spherical\"\nbase = \"ground\"\ntip = \"bar.corner\"\n"
        + &joint("side", "side", "x")
        + &joint("level", "side", "z")
        + &joint("upper", "upper", "x")
        + &output("end", "displacement", "bar@1,0,0")
        + &output("stress", "solid_stress", "bar@0.5,0,1")
        + STATICS;
    let record = run(&text, &[]);
    let exact = -12e-6 * 1000.0 / 2.0;
    let found = last(&record, "end", "u3");
    assert!((found / exact - 1.0).abs() < 2e-3, "{found:e}, {exact:e}");
    assert!(last(&record, "stress", "mises") < 2e5);
}

/// f = √(N/m (k² + l²))/2 of a square membrane.
#[test]
fn a_taut_membrane_vibrates_at_its_tone() {
    let text = "lissom = 1\n[materials.film]\nE = 3e9\nnu = 0.3\ndensity = 1400\n[shells.film]\n\
        corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]\ndivisions = [16, 16]\nthickness = 1e-4\nmaterial = \"film\"\n\
        prestress = [700, 700, 0]\n";
    let sides = ["west", "east", "south", "north"].map(|side| {
        format!("[joints.{side}]\nkind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"film.{side}\"\naxis = \"z\"\n")
            + &format!("[joints.{side}_x]\nkind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"film.{side}\"\naxis = \"x\"\n")
            + &format!("[joints.{side}_y]\nkind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"film.{side}\"\naxis = \"y\"\n")
    });
    let text = text.to_owned() + &sides.concat();
    let request = ModeRequest { count: Some(2), ..ModeRequest::default() };
    let model = Model::from_text("model.toml", &(text.clone() + "[analysis]\nkind = \"modes\"\n"));
    let found = modes(&model, &request).expect("modes").modes[0].frequency;
    let exact = (700.0 / (1400.0 * 1e-4) * 2.0_f64).sqrt() / 2.0;
    assert!((found / exact - 1.0).abs() < 1e-2, "{found}, {exact}");
    let record = run(&(text + &output("force", "shell_force", "film@0.5,0.5") + STATICS), &[]);
    for (component, exact) in [("n11", 700.0), ("n22", 700.0)] {
        assert!((last(&record, "force", component) / exact - 1.0).abs() < 1e-9, "{component}");
    }
}

/// A cantilever whose section changes at once in the middle: F l³/(3 EI) of two parts, and its mass.
#[test]
fn sections_change_at_once() {
    let text = format!(
        "{STEEL}{ROD}[sections.thin]\nshape = \"rectangle\"\nmaterial = \"steel\"\nwidth = 0.01\nheight = 0.01\n\
         [beams.rod]\nstations = [{{ at = 0, section = \"rod\" }}, {{ at = 0.5, section = \"rod\" }}, {{ at = 0.5, section = \"thin\" }}, {{ at = 1, section = \"thin\" }}]\n\
         from = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n"
    ) + &clamp("root", "rod.start")
        + "[loads.tip]\nkind = \"force\"\non = \"rod.end\"\nvector = [0, 0, -0.1]\n"
        + &output("tip", "displacement", "rod.end")
        + &output("root", "reaction", "root");
    let record = run(&(text.clone() + STATICS), &[]);
    let [thick, thin] = [0.02_f64, 0.01].map(|side| 210e9 * side.powi(4) / 12.0);
    let bending = (1.0 - 0.125) / (3.0 * thick) + 0.125 / (3.0 * thin);
    let shear = |side: f64| 0.5 / (210e9 / 2.6 * 0.85 * side * side);
    let exact = -0.1 * (bending + shear(0.02) + shear(0.01));
    let found = last(&record, "tip", "u3");
    assert!((found / exact - 1.0).abs() < 1e-4, "{found:e}, {exact:e}");
    let weighed = text
        .replace("vector = [0, 0, -0.1]", "vector = [0, 0, 0]")
        .replace("lissom = 1\n", "lissom = 1\ngravity = [0, 0, -10]\n");
    let record = run(&(weighed + STATICS), &[]);
    let weight = 10.0 * 7850.0 * 0.5 * (4e-4 + 1e-4);
    assert!((last(&record, "root", "f3").abs() / weight - 1.0).abs() < 1e-4);
    let inside = refused(&(text.replace("elements = 4", "elements = 3") + STATICS));
    assert!(inside.contains("inside of one of its 3 elements"), "{inside}");
}

#[test]
fn messages_name_the_remedy() {
    let cold = refused(&(beam("temperature = 10").replace("expansion = 12e-6", "") + STATICS));
    assert!(cold.contains("does not expand") && cold.contains("12e-6"), "{cold}");
    let over_time = refused(&(beam("temperature = \"10*t\"") + STATICS));
    assert!(over_time.contains('t'), "{over_time}");
    let shell = format!(
        "{STEEL}[shells.strip]\ncorners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]\ndivisions = [2, 2]\nthickness = 0.01\nmaterial = \"steel\"\n"
    );
    let nowhere = refused(&(shell + &clamp("a", "strip@0.3,0") + STATICS));
    assert!(nowhere.contains("has no node at 0.3,0"), "{nowhere}");
}

/// A thin plate that is cold and free to shrink has no tension, and the frequencies of a warm one.
#[test]
fn cold_alone_changes_no_frequencies() {
    let frequencies = |temperature: &str| {
        let text = format!(
            "{STEEL}[shells.part]\ncorners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]\ndivisions = [6, 6]\nthickness = 1e-3\n\
             material = \"steel\"\ntemperature = {temperature}\n"
        ) + &held("0,0", "1,0", "0,1")
            + "[analysis]\nkind = \"modes\"\n";
        let request = ModeRequest { count: Some(6), ..ModeRequest::default() };
        let found = modes(&Model::from_text("model.toml", &text), &request).expect("modes").modes;
        found.iter().map(|mode| mode.frequency).collect::<Vec<_>>()
    };
    let (cold, warm) = (frequencies("-30"), frequencies("0"));
    for (cold, warm) in cold.iter().zip(&warm) {
        assert!((cold / warm - 1.0).abs() < 2e-3, "{cold} {warm}");
    }
}
