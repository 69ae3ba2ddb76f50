//! An element of one's own: a spring whose force is the cube of its elongation holds a point mass. The period of its swing is
//! known in closed form.
//!
//! `cargo run --release -p lissom --example own_element`

use std::error::Error;

use lissom::core::elements::{Element, Energy, Tangents, Unknowns};
use lissom::core::kinematics::{Freedoms, Kinematics, NodeId};
use lissom::core::motion::{Matrix6, Motion, Vector3};
use lissom::core::newton::Limits;
use lissom::core::scaling::ScalingChoice;
use lissom::core::schemes::radau_iia;
use lissom::core::settings::Settings;
use lissom::core::simulation::Simulation;
use lissom::core::solvers;
use lissom::core::system::Builder;

/// Mass [kg], stiffness [N/m³], amplitude [m].
const MASS: f64 = 2.0;
const STIFFNESS: f64 = 50.0;
const AMPLITUDE: f64 = 0.5;

/// Complete elliptic integral K of the modulus 1/√2.
const QUARTER: f64 = 1.854_074_677_301_372;

/// A pull k |x|² x of a point mass towards the origin.
#[derive(Clone, Debug)]
struct CubicSpring {
    node: [NodeId; 1],
    stiffness: f64,
}

impl CubicSpring {
    /// The position of the mass [m]; its axes are those of the inertial frame, because it does not rotate.
    fn position(&self, at: &Kinematics) -> Vector3 {
        at.nodes[self.node[0]].frame.position
    }
}

impl Element for CubicSpring {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.node)
    }

    /// The force is on the left-hand side of the equations of motion: m a + k |x|² x = 0.
    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let x = self.position(at);
        let force = self.stiffness * x.norm_squared() * x;
        for axis in 0..3 {
            out[axis] += force[axis];
        }
    }

    /// ∂F/∂x = k (|x|² 1 + 2 x xᵀ), in the first three of the node's six rows and columns.
    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let (x, size) = (self.position(at), out.size());
        for row in 0..3 {
            for column in 0..3 {
                let diagonal = if row == column { x.norm_squared() } else { 0.0 };
                out.stiffness[row * size + column] += self.stiffness * (diagonal + 2.0 * x[row] * x[column]);
            }
        }
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let squared = self.position(at).norm_squared();
        Energy { strain: 0.25 * self.stiffness * squared * squared, ..Energy::default() }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut builder = Builder::new();
    let start = Motion::translation(Vector3::new(AMPLITUDE, 0.0, 0.0));
    let node = builder.add_node("mass", start, Freedoms::Translations);
    builder.add_inertia(node, &Matrix6::from_diagonal_element(MASS));
    builder.add_element(CubicSpring { node: [node], stiffness: STIFFNESS });
    let (system, state) = builder.build(0.0)?;

    let period = 4.0 * QUARTER * (MASS / STIFFNESS).sqrt() / AMPLITUDE;
    let settings = Settings {
        scheme: radau_iia::three_stages(),
        step_size: period / 200.0,
        control: None,
        scaling: ScalingChoice::default(),
        limits: Limits::default(),
        solver: solvers::kind("sparse").ok_or("no such solver")?,
        threads: 1,
        from_equilibrium: false,
        follow_drives: true,
        energy_check: true,
    };
    let mut simulation = Simulation::new(system, state, settings)?;
    for _ in 0..200 {
        simulation.step()?;
    }
    let place = simulation.state().kinematics.nodes[node].frame.position;
    println!("after {period:.6} s: {:.9} m, started at {AMPLITUDE} m", place.x);
    assert!((place.x - AMPLITUDE).abs() < 1e-8, "{place:?}");
    Ok(())
}
