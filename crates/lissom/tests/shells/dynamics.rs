//! Motions of shells.

use super::CANTILEVER;
use crate::support::runs::{SCHEMES, column, goes_on_from_a_snapshot, last, run};

/// A plate that flies and spins freely.
const FREE: &str = r#"
lissom = 1
[materials.steel]
E = 2e9
nu = 0.3
density = 7800
[shells.plate]
corners = [[0, 0, 0], [0.6, 0, 0], [0.6, 0.3, 0], [0, 0.3, 0]]
divisions = [6, 3]
thickness = 0.002
material = "steel"
[initial]
velocity = [1, 2, 3]
angular_velocity = [5, 3, 8]
about = [0.3, 0.15, 0]
[outputs.momentum]
kind = "momentum"
[outputs.energy]
kind = "energy"
[outputs.corner]
kind = "position"
of = "plate@1,1"
[analysis]
kind = "dynamics"
end = 0.2
step = 1e-3
"#;

/// Momenta change as little as the scheme allows.
#[test]
fn a_plate_in_free_flight_keeps_its_momenta() {
    for scheme in SCHEMES {
        let record = run(FREE, &[("analysis.scheme", &format!("\"{scheme}\""))]);
        for component in ["p1", "p2", "p3", "l1", "l2", "l3"] {
            let values = column(&record, "momentum", component);
            let largest = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            let changed = values.iter().fold(0.0_f64, |most, value| most.max((value - values[0]).abs()));
            // Velocities have components in the axes of the nodes: momentum is as accurate as the motion.
            let allowed = if scheme.starts_with("radau") { 1e-5 } else { 3e-3 };
            assert!(changed < allowed * largest, "{scheme} {component}: {changed:e} of {largest:e}");
        }
        let energy = column(&record, "energy", "total");
        let risen = energy.iter().fold(0.0_f64, |most, value| most.max(value - energy[0]));
        assert!(risen < 2e-3 * energy[0], "{scheme}: {risen:e}");
    }
}

/// A plate of one element has the energy and the momenta of a rigid plate: ω·J ω/2 with J = m/12 (b² + h², a² + h², a² + b²). The spin about
/// the normal has a share of 1e-3 of h² besides.
#[test]
fn a_plate_of_one_element_spins_as_a_rigid_one() {
    let (mass, spin) = (7800.0 * 0.6 * 0.3 * 0.02, [5.0, 3.0, 8.0]);
    let [a, b, h] = [0.6_f64, 0.3, 0.02].map(|size| mass * size * size / 12.0);
    let inertia = [b + h, a + h, a + b + 1e-3 * h];
    let thick = FREE.replace("thickness = 0.002", "thickness = 0.02");
    for (divisions, offset) in [("[1, 1]", 0.0), ("[2, 1]", 0.0), ("[1, 1]", 0.05)] {
        let text = thick
            .replace("[6, 3]", divisions)
            .replace("material = \"steel\"", &format!("material = \"steel\"\noffset = {offset}"));
        let text = text.replace("about = [0.3, 0.15, 0]", &format!("about = [0.3, 0.15, {offset}]"));
        let record = run(&text, &[("analysis.end", "1e-3")]);
        let kinetic = column(&record, "energy", "kinetic")[0];
        let expected = 0.5 * (mass * 14.0 + (0..3).map(|k| inertia[k] * spin[k] * spin[k]).sum::<f64>());
        assert!((kinetic / expected - 1.0).abs() < 1e-10, "{divisions}: {kinetic}, {expected}");
        // About the origin: m c × v + J ω.
        let (center, velocity) = ([0.3, 0.15, offset], [1.0, 2.0, 3.0]);
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let orbit = mass * (center[i] * velocity[j] - center[j] * velocity[i]);
            let found = column(&record, "momentum", &format!("l{}", k + 1))[0];
            let expected = orbit + inertia[k] * spin[k];
            assert!((found - expected).abs() < 1e-10 * mass, "{divisions} l{}: {found}, {expected}", k + 1);
        }
    }
}

/// Torsion of a clamped panel: CalculiX finds 210.1 Hz with 20 x 4 elements S8R of second order.
#[test]
fn torsion_of_a_narrow_panel_converges_from_above() {
    use lissom::Model;
    use lissom::analyses::modes::{ModeRequest, modes};
    let frequency = |across: usize| {
        let text = format!(
            "lissom = 1\n[materials.m]\nE = 70e9\nnu = 0.3\ndensity = 2700\n[shells.s]\n\
             corners = [[0, 0, 0], [0.4, 0, 0], [0.4, 0.1, 0], [0, 0.1, 0]]\ndivisions = [20, {across}]\nthickness = 0.005\nmaterial = \"m\"\n\
             [joints.c]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"s.west\"\n[analysis]\nkind = \"modes\"\n"
        );
        let request = ModeRequest { count: Some(3), ..ModeRequest::default() };
        let found = modes(&Model::from_text("model.toml", &text), &request).expect("modes");
        let twist = |mode: &lissom::core::linearized::Mode| mode.frequency;
        found.modes.iter().map(twist).find(|own| (190.0..230.0).contains(own)).expect("a mode of torsion")
    };
    let found = [1, 2, 4].map(frequency);
    assert!(found.windows(2).all(|pair| pair[0] > pair[1]), "{found:?}");
    assert!((found[0] / 208.5 - 1.0).abs() < 0.06 && (found[2] / 208.5 - 1.0).abs() < 0.01, "{found:?}");
}

/// With strains that are integrated from their rates the energy never rises, whatever the step.
#[test]
fn the_energy_decaying_scheme_gains_none_with_large_steps() {
    let record = run(
        FREE,
        &[("analysis.scheme", "\"energy-decaying\""), ("analysis.step", "1e-2"), ("analysis.end", "0.5")],
    );
    let energy = column(&record, "energy", "total");
    let rise = energy.windows(2).fold(0.0_f64, |most, pair| most.max(pair[1] - pair[0]));
    assert!(rise < 1e-9 * energy[0], "{rise:e}");
    assert!(energy.last().is_some_and(|end| *end > 0.8 * energy[0]), "{energy:?}");
}

#[test]
fn restarts_are_exact_to_the_last_bit() {
    goes_on_from_a_snapshot(FREE, [0.02, 0.04]);
}

/// The first bending mode of a cantilever of 10 m: (1.8751/l)² √(EI/ρA).
#[test]
fn modes_of_a_cantilever_are_those_of_a_beam() {
    use lissom::Model;
    use lissom::analyses::modes::{ModeRequest, modes};
    let text =
        CANTILEVER.replace("[loads.end]\nkind = \"force\"\non = \"plate.east\"\nvector = [0, 0, 4]\n", "");
    let model = Model::from_text("model.toml", &text);
    let request = ModeRequest { count: Some(2), ..ModeRequest::default() };
    let found = modes(&model, &request).expect("modes");
    let exact = (1.875_104_f64 / 10.0).powi(2) * (100.0_f64 / 100.0).sqrt() / std::f64::consts::TAU;
    let frequency = found.modes[0].frequency;
    assert!((frequency / exact - 1.0).abs() < 0.01, "{frequency}, {exact}");
}

/// A rotating strip is stretched by ρ ω² (l² - x²)/2 and stays straight.
#[test]
fn a_driven_strip_is_stretched_by_its_rotation() {
    let text = "lissom = 1\n[materials.m]\nE = 1e9\nnu = 0\ndensity = 1000\n[shells.blade]\ncorners = [[0, 0, 0], [1, 0, 0], [1, 0.1, 0], [0, 0.1, 0]]\n\
                divisions = [10, 1]\nthickness = 0.01\nmaterial = \"m\"\n\
                [bodies.hub]\nmass = 1\ninertia = [1, 1, 1]\n[joints.axle]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"hub\"\naxis = \"z\"\n\
                [joints.root]\nkind = \"clamp\"\nbase = \"hub\"\ntip = \"blade.west\"\n[joints.drive]\nkind = \"prescribed_rotation\"\njoint = \"axle\"\nrotation = \"20*t\"\n\
                [initial]\nangular_velocity = [0, 0, 20]\nsteady_rotation = true\n[outputs.tip]\nkind = \"distance\"\nof = \"blade@1,0.5\"\n\
                [analysis]\nkind = \"dynamics\"\nend = 0.2\nstep = 2e-3\n";
    let record = run(
        &text
            .replace(
                "[0, 0, 0], [1, 0, 0], [1, 0.1, 0], [0, 0.1, 0]",
                "[0, -0.05, 0], [1, -0.05, 0], [1, 0.05, 0], [0, 0.05, 0]",
            )
            .replace("blade@1,0.5", "blade@1,0"),
        &[],
    );
    // ρ ω² l³/(3 E), at the corner.
    let exact = 1000.0 * 400.0 / (3.0 * 1e9);
    let stretched = last(&record, "tip", "distance") - 1.0_f64.hypot(0.05);
    assert!((stretched / exact - 1.0).abs() < 0.02, "{stretched:e}, {exact:e}");
}
