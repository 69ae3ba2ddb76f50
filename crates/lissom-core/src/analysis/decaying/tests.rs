//! The tangent of the energy-decaying scheme against differences of its residual.

use lissom_motion::{Matrix3, Matrix6, Vector3};

use super::*;
use crate::elements::beam::SectionLaw;
use crate::elements::beam_line::{BeamLineDescription, add_beam_line};
use crate::elements::inertia::Inertia;
use crate::joints::KINDS;
use crate::registry::Parameters;
use crate::scaling::ScalingChoice;
use crate::system::{Builder, Freedoms, Placement};

fn model() -> (System, State) {
    let mut builder = Builder::new();
    builder.set_gravity(Vector3::new(0.0, 0.3, -1.0));
    let line = add_beam_line(
        &mut builder,
        &BeamLineDescription {
            name: "beam",
            elements: 1,
            order: 2,
            frame: &|s| Motion::translation(Vector3::new(s, 0.0, 0.0)),
            law: &|_| SectionLaw { stiffness: Matrix6::identity() * 10.0, damping: 0.0 },
            mass: &|_| Matrix6::identity(),
            ends: [None, None],
        },
    );
    let body = builder.add_node("body", Motion::translation(Vector3::new(1.5, 0.2, 0.0)), Freedoms::Full);
    builder
        .add_inertia(body, &Inertia::of_rigid_body(2.0, &Vector3::new(0.1, 0.0, 0.2), &Matrix3::identity()));
    let end = *line.nodes.last().expect("there");
    for (name, kind, nodes, at) in [
        ("root", "revolute", [0, line.nodes[0]], Vector3::zeros()),
        ("tip", "spherical", [end, body], Vector3::new(1.0, 0.0, 0.0)),
    ] {
        let kind = KINDS.iter().find(|known| known.name == kind).expect("registered");
        let placement =
            Placement { nodes, at, at_tip: None, axis: Some(Vector3::new(0.2, 1.0, 0.1)), second_axis: None };
        builder.add_joint(name, kind, &placement, &Parameters::new()).expect("valid");
    }
    builder.build(0.0).expect("valid")
}

/// The tangent is close to the derivative of the residual where increments are small.
#[test]
fn tangent_is_close_to_the_derivative() {
    for alpha in [0.0, 1.0] {
        let (system, state) = model();
        let representative = Representative { mass: 1.0, damping: 0.0, stiffness: 1.0, length: 1.0 };
        let scaled = Scaled::new(&ScalingChoice::default(), &representative, 0.1);
        let solver = lissom_solver::kind("sparse").expect("registered");
        let mut work = DecayingWorkspace::new(&system, &state, &representative, solver);
        let size = work.layout.size();
        let count = work.layout.coordinates;
        let pattern = std::sync::Arc::clone(&work.layout.structure.pattern);
        let rescale = |_| scaled;
        let mut equations = DecayingEquations {
            system: &system,
            scheme: TimeDiscontinuous { alpha },
            scaled,
            rescale: &rescale,
            start: &state,
            work: &mut work,
        };
        equations.predict();
        for row in 0..count {
            equations.work.jump.increments[row] = 1e-3 * ((row * 7 % 11) as f64 - 5.0);
            equations.work.glide.increments[row] = 2e-3 * ((row * 5 % 13) as f64 - 6.0);
        }
        equations.update();
        equations.assemble_tangent();
        let values = equations.work.values.clone();
        let residual = |equations: &mut DecayingEquations<'_>, unknown: usize, change: f64| {
            let factor = equations.scaled.multiplier_factor();
            let work = &mut *equations.work;
            if unknown < count {
                work.jump.increments[unknown] += change;
                work.glide.increments[unknown] -= change;
            } else if unknown < 2 * count {
                work.glide.increments[unknown - count] += change;
            } else if unknown < 2 * count + work.layout.multipliers {
                work.multipliers[unknown - 2 * count] += factor * change;
            } else {
                let coordinate = unknown - 2 * count - work.layout.multipliers;
                work.definitions[coordinate] += change;
            }
            equations.update();
            equations.evaluate();
            equations.work.residual.clone()
        };
        for column in 0..size {
            let step = 1e-5;
            let plus = residual(&mut equations, column, step);
            let minus = residual(&mut equations, column, -2.0 * step);
            residual(&mut equations, column, step);
            for row in 0..size {
                let found = (plus[row] - minus[row]) / (2.0 * step);
                let exact = pattern.position(row, column).map_or(0.0, |p| values[p]);
                assert!(
                    (exact - found).abs() < 0.1 * (1.0 + found.abs()),
                    "alpha {alpha}: row {row} column {column} of {count} {size}: {exact} but {found}"
                );
            }
        }
    }
}
