//! Linear analyses of shells: rotation and reduction.

use std::collections::BTreeMap;

use lissom::Model;
use lissom::analyses::campbell::{CampbellRequest, Variation, campbell};
use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};
use lissom::analyses::reduce::{ReduceRequest, reduce};

/// √(EI/(ρ A l⁴)) of the blade below [1/s].
const UNIT: f64 = 2.886_751_345_948_129;

/// Rotation stiffens a strip against deflections out of its plane: frequencies of a beam clamped on the axis, over [`UNIT`], at 2 and 4
/// [`UNIT`]s of speed [Wright, Smith, Thresher and Wang 1982, table 2].
#[test]
fn a_strip_that_rotates_has_published_frequencies() {
    let text = "lissom = 1\n[parameters]\nspeed = 10.0\n[materials.m]\nE = 1e9\nnu = 0\ndensity = 1000\n[shells.blade]\n\
                corners = [[0, -0.02, 0], [1, -0.02, 0], [1, 0.02, 0], [0, 0.02, 0]]\ndivisions = [24, 1]\nthickness = 0.01\nmaterial = \"m\"\n\
                [bodies.hub]\nmass = 1\ninertia = [1, 1, 1]\n[joints.axle]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"hub\"\naxis = \"z\"\n\
                [joints.drive]\nkind = \"prescribed_rotation\"\njoint = \"axle\"\nrotation = \"speed*t\"\n\
                [joints.root]\nkind = \"clamp\"\nbase = \"hub\"\ntip = \"blade.west\"\n\
                [initial]\nangular_velocity = [0, 0, \"speed\"]\nsteady_rotation = true\n[analysis]\nkind = \"dynamics\"\nend = 1\nstep = 1e-3\n";
    let request = CampbellRequest {
        vary: Variation { path: "parameters.speed".to_owned(), from: UNIT * 2.0, to: UNIT * 4.0, values: 2 },
        count: 3,
        shift: None,
        averaged: false,
        rays: Vec::new(),
    };
    let found =
        campbell(&Model::from_text("model.toml", text), &request).unwrap_or_else(|error| panic!("{error}"));
    let csv = found.csv();
    let flap = |speed: f64| -> f64 {
        let rows = csv.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
        let own = rows.filter(|row| row[0].parse::<f64>().is_ok_and(|value| (value - speed).abs() < 1e-6));
        own.map(|row| row[3].parse::<f64>().expect("a frequency")).fold(f64::INFINITY, f64::min)
    };
    let turn = std::f64::consts::TAU;
    for (speed, published) in [(2.0, 4.1373), (4.0, 5.5850)] {
        let found = turn * flap(UNIT * speed) / UNIT;
        assert!((found / published - 1.0).abs() < 0.01, "{speed}: {found}\n{csv}");
    }
}

/// A panel reduced to two nodes has the first frequencies of its elements.
#[test]
fn a_reduced_panel_has_its_first_frequencies() {
    let panel = "lissom = 1\n[materials.m]\nE = 1e9\nnu = 0.3\ndensity = 1000\n[shells.panel]\ncorners = [[0, 0, 0], [1, 0, 0], [1, 0.5, 0], [0, 0.5, 0]]\n\
                 divisions = [8, 4]\nthickness = 0.01\nmaterial = \"m\"\nsets = { motor = { near = [1, 0.5, 0] } }\n";
    let clamp = |tip: &str| {
        format!(
            "[joints.root]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"{tip}\"\n[analysis]\nkind = \"modes\"\n"
        )
    };
    let frequencies = |model: &Model| -> Vec<f64> {
        let request =
            ModeRequest { count: Some(4), about: Some(OperatingPoint::Static), ..ModeRequest::default() };
        let found = modes(model, &request).unwrap_or_else(|error| panic!("{error}"));
        found.modes.iter().map(|mode| mode.frequency).collect()
    };
    let request = ReduceRequest {
        parts: Vec::new(),
        // As the command line separates it.
        interfaces: ["panel@0", "0.5", "panel.motor"].map(str::to_owned).to_vec(),
        modes: 12,
        corrections: false,
        free_modes: false,
        recover: Vec::new(),
        about: OperatingPoint::Static,
        name: Some("part".to_owned()),
    };
    let model = Model::from_text("model.toml", &format!("{panel}[analysis]\nkind = \"modes\"\n"));
    let report = reduce(&model, &request).unwrap_or_else(|error| panic!("{error}"));
    let (_, table) = report.files.last().expect("the table comes last");
    let interface = report.interfaces[0].clone();
    let files: BTreeMap<String, String> = report.files.iter().cloned().collect();
    let reduced = format!("{table}\n{}", clamp(&format!("part.{interface}")));
    let reduced = frequencies(&Model::from_text("model.toml", &reduced).with_known(files));
    let whole = frequencies(&Model::from_text("model.toml", &format!("{panel}{}", clamp("panel@0,0.5"))));
    for (one, other) in reduced.iter().zip(&whole) {
        assert!((one / other - 1.0).abs() < 5e-3, "{reduced:?}, {whole:?}");
    }
}

/// A panel with its middle beside the nodes, between two bodies: bodies have no stiffness, and what is round-off of that of the panel holds
/// none of them.
#[test]
fn a_panel_with_an_offset_is_reduced() {
    let text = "lissom = 1\n[materials.m]\nE = 1e10\nnu = 0.25\ndensity = 1500\n[shells.s]\n\
                corners = [[0, 0, 0], [0.8, 0, 0], [0.8, 0.2, 0], [0, 0.2, 0]]\ndivisions = [8, 2]\nthickness = 0.006\noffset = -0.02\nmaterial = \"m\"\n\
                [bodies]\na = { mass = 1, inertia = [0.01, 0.01, 0.01], position = [0, 0.1, 0] }\nb = { mass = 2, inertia = [0.01, 0.02, 0.01], position = [0.8, 0.1, 0] }\n\
                [joints]\nja = { kind = \"clamp\", base = \"a\", tip = \"s.west\" }\njb = { kind = \"clamp\", base = \"b\", tip = \"s.east\" }\n\
                [analysis]\nkind = \"dynamics\"\nend = 1\nstep = 1e-3\n";
    let request = ReduceRequest {
        parts: Vec::new(),
        interfaces: ["a", "b"].map(str::to_owned).to_vec(),
        modes: 4,
        corrections: false,
        free_modes: false,
        recover: Vec::new(),
        about: OperatingPoint::Undeformed,
        name: Some("part".to_owned()),
    };
    let report =
        reduce(&Model::from_text("model.toml", text), &request).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(report.interfaces.len(), 2);
}
