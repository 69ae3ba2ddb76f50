//! Offset and damping of sections.

use lissom::Model;
use lissom::analyses::modes::{ModeRequest, modes};
use lissom_core::linearized::Mode;

use crate::support::runs::{column, last, run};

/// A strip of 1 x 0.1 x 0.01 m without contraction across, with `keys`.
fn strip(keys: &str, rest: &str) -> String {
    format!(
        "lissom = 1\n[materials.m]\nE = 1e9\nnu = 0\ndensity = 1000\n[shells.strip]\n\
         corners = [[0, 0, 0], [1, 0, 0], [1, 0.1, 0], [0, 0.1, 0]]\ndivisions = [20, 2]\nthickness = 0.01\nmaterial = \"m\"\n{keys}\n{rest}\n"
    )
}

const CLAMP: &str = "[joints.root]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"strip.west\"\n";

fn modes_of(text: &str, count: usize) -> Vec<Mode> {
    let text = format!("{text}[analysis]\nkind = \"modes\"\n");
    let request = ModeRequest { count: Some(count), ..ModeRequest::default() };
    modes(&Model::from_text("model.toml", &text), &request).expect("modes").modes
}

/// Tension F along a line at a distance z from the middle of the thickness bends by F z l²/(2 E I), towards the other side.
#[test]
fn tension_along_an_eccentric_surface_bends() {
    let rest = format!(
        "{CLAMP}[loads.pull]\nkind = \"force\"\non = \"strip.east\"\nvector = [0.01, 0, 0]\n[outputs.tip]\nkind = \"displacement\"\n\
         of = \"strip@1,0.5\"\n[outputs.stress]\nkind = \"shell_stress\"\nof = \"strip@0.5,0.5\"\n[analysis]\nkind = \"statics\"\nend = 1\n"
    );
    let record = run(&strip("offset = 0.02", &rest), &[]);
    let stiffness = 1e9 * 0.1 * 0.01_f64.powi(3) / 12.0;
    let exact = 0.01 * 0.02 / (2.0 * stiffness);
    let moved = last(&record, "tip", "u3");
    assert!((moved / exact - 1.0).abs() < 2e-3, "{moved:e}, {exact:e}");
    // F/A - F z c/I at the top, where the line is below the middle.
    let mean = 0.01 / (0.1 * 0.01);
    let bending = 0.01 * 0.02 * 0.005 / (0.1 * 0.01_f64.powi(3) / 12.0);
    for (component, exact) in [("top11", mean - bending), ("bottom11", mean + bending)] {
        let stress = last(&record, "stress", component);
        assert!((stress / exact - 1.0).abs() < 5e-3, "{component}: {stress}, {exact}");
    }
    assert!(last(&record, "stress", "error") < 0.02 * bending);
}

/// A free plate has the same frequencies wherever its surface of reference is.
#[test]
fn frequencies_of_a_free_plate_do_not_depend_on_the_offset() {
    let [own, other] = ["", "offset = 0.01"].map(|keys| modes_of(&strip(keys, ""), 12));
    let elastic = |modes: Vec<Mode>| -> Vec<f64> {
        modes.iter().map(|mode| mode.frequency).filter(|frequency| *frequency > 0.1).take(4).collect()
    };
    let (own, other) = (elastic(own), elastic(other));
    assert_eq!(own.len(), 4);
    for (one, two) in own.iter().zip(&other) {
        assert!((one / two - 1.0).abs() < 2e-3, "{own:?}, {other:?}");
    }
}

/// The damping ratio of a mode is τ ω/2, and a motion with large rotations decays without gaining energy.
#[test]
fn damping_is_in_proportion_to_the_stiffness() {
    let first = &modes_of(&strip("damping = 1e-3", CLAMP), 1)[0];
    let exact = 0.5e-3 * std::f64::consts::TAU * first.frequency;
    assert!((first.damping / exact - 1.0).abs() < 1e-3, "{}, {exact}", first.damping);
    let rest = format!(
        "{CLAMP}[loads.kick]\nkind = \"force\"\non = \"strip.east\"\nvector = [0, 0, 1]\nscale = \"step(0.1 - t)\"\n[outputs.energy]\nkind = \"energy\"\n\
         [outputs.work]\nkind = \"work\"\nof = \"kick\"\n[outputs.power]\nkind = \"power\"\nof = \"kick\"\n\
         [analysis]\nkind = \"dynamics\"\nend = 0.5\nstep = 1e-3\n"
    );
    for scheme in ["generalized-alpha", "energy-decaying"] {
        let record = run(&strip("damping = 0.1", &rest), &[("analysis.scheme", &format!("\"{scheme}\""))]);
        let (energy, work) = (column(&record, "energy", "total"), column(&record, "work", "work"));
        let given = work[work.len() - 1];
        assert!(given > 1e-3, "{scheme}: {given}");
        let most = energy.iter().copied().fold(0.0, f64::max);
        assert!(most < given && energy[energy.len() - 1] < 0.3 * most, "{scheme}: {most}, {given}");
        assert!(column(&record, "power", "power").iter().any(|power| *power > 0.0));
    }
}

/// What a load on a set of nodes does is the sum over its nodes: all that an undamped strip has.
#[test]
fn the_work_of_a_load_on_a_set_is_the_energy() {
    let rest = "[loads.push]\nkind = \"force\"\non = \"strip.east\"\nvector = [0, 0, 1]\nscale = \"sin(20*t)\"\n[outputs.energy]\nkind = \"energy\"\n\
                [outputs.work]\nkind = \"work\"\nof = \"push\"\n[analysis]\nkind = \"dynamics\"\nend = 0.2\nstep = 5e-4\n";
    let record = run(&strip("", rest), &[]);
    let (energy, work) = (last(&record, "energy", "total"), last(&record, "work", "work"));
    assert!((energy / work - 1.0).abs() < 1e-2, "{energy}, {work}");
}
