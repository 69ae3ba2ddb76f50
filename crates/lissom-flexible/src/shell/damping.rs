//! Damping of a shell element: stresses in proportion to the rates of its natural strains.
//!
//! Legend: τ time of damping, V twists of the nodes, G gradients of the strains, G'[V] their rates in the motion with V.
//!
//! ```text
//! F = Gᵀ σ,    σ = τ D ė,    ė = G V
//! F by V: τ Gᵀ D G
//! F by body-frame variations: K of the stresses σ + τ Gᵀ D (G'[V] - G ad_V)
//! ```
//!
//! A variation at constant V and the motion with V do not commute: their bracket is ad_V.

use std::sync::Arc;

use lissom_motion::{Jet, Pose, Triple, Vector6, lie_bracket_matrix};

use super::Shell;
use super::constants::{Constants, Numbers};
use super::forces;
use super::linearize::{Gradient, SIZE, gradient, stressed};
use super::quadrilateral::{NODES, STRAINS};
use super::strains::Deformed;
use lissom_mechanics::elements::{Element, Tangents, Unknowns};
use lissom_mechanics::kinematics::Kinematics;

/// The damping of a shell element.
#[derive(Clone, Debug)]
pub struct ShellDamping {
    shell: Arc<Shell>,
    /// Stresses over rates of stresses [s].
    time: f64,
}

impl ShellDamping {
    /// Damping of `shell` in proportion to its stiffness, by `time` [s].
    pub fn new(shell: Arc<Shell>, time: f64) -> Self {
        Self { shell, time }
    }

    fn twists(&self, at: &Kinematics) -> [Vector6; NODES] {
        self.shell.nodes.map(|node| at.nodes[node].twist)
    }

    /// The natural stresses.
    fn stress(
        &self,
        deformed: &Deformed<f64>,
        frames: &[Pose<f64>; NODES],
        at: &Kinematics,
    ) -> [f64; STRAINS] {
        let numbers = &self.shell.numbers;
        let twists = self.twists(at).map(|twist| (&twist).into());
        let rates = deformed.rates(numbers, frames, &twists);
        forces::stress(numbers, &rates.map(|rate| self.time * rate))
    }
}

impl Element for ShellDamping {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.shell.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let (numbers, frames) = (&self.shell.numbers, self.shell.frames(at));
        let deformed = Deformed::at(numbers, &frames);
        let stress = self.stress(&deformed, &frames, at);
        let wrenches = deformed.conjugate(&stress).wrenches(numbers, &frames);
        let values = wrenches.iter().flat_map(|wrench| wrench.components());
        out.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let (numbers, frames, twists) = (&self.shell.numbers, self.shell.frames(at), self.twists(at));
        let deformed = Deformed::at(numbers, &frames);
        let (own, of_edges) = gradient(numbers, &frames, &deformed);
        let moving = std::array::from_fn(|i| in_time(&frames[i], &twists[i]));
        let (in_motion, _) = gradient(&Still(numbers), &moving, &Deformed::at(&Still(numbers), &moving));
        let mut by_places: Gradient<f64> = [[0.0; SIZE]; STRAINS];
        let brackets = twists.map(|twist| lie_bracket_matrix(&twist));
        for k in 0..STRAINS {
            for column in 0..SIZE {
                let (first, turned) = (column - column % 6, column % 6);
                let bracket: f64 =
                    (0..6).map(|i| own[k][first + i] * brackets[column / 6][(i, turned)]).sum();
                by_places[k][column] = in_motion[k][column].first - bracket;
            }
        }
        let [mut by_rates, mut by_strains] = [[[0.0; SIZE]; STRAINS]; 2];
        numbers.stiffness_times(&own, &mut by_rates);
        numbers.stiffness_times(&by_places, &mut by_strains);
        let stress = self.stress(&deformed, &frames, at);
        let mut matrix = [[0.0; SIZE]; SIZE];
        stressed(numbers, (&frames, &deformed), &of_edges, &stress, &mut matrix);
        let weighted = |by: &Gradient<f64>, i: usize, j: usize| {
            self.time * (0..STRAINS).map(|k| own[k][i] * by[k][j]).sum::<f64>()
        };
        for i in 0..SIZE {
            for j in 0..SIZE {
                out.stiffness[i * SIZE + j] += matrix[i][j] + weighted(&by_strains, i, j);
                out.damping[i * SIZE + j] += weighted(&by_rates, i, j);
            }
        }
    }
}

/// The constants of an element as functions of time.
struct Still<'n>(&'n Numbers);

impl Constants<Jet<f64>> for Still<'_> {
    fn number(&self, place: usize) -> Jet<f64> {
        Jet::constant(Constants::<f64>::number(self.0, place))
    }
}

/// A frame with its rate.
fn in_time(frame: &Pose<f64>, twist: &Vector6) -> Pose<Jet<f64>> {
    let [velocity, spin] = [0, 3].map(|k| Triple::new(twist[k], twist[k + 1], twist[k + 2]));
    let (rotation, velocity) = (frame.rotation, frame.rotation.apply(velocity));
    let scalar = -0.5 * rotation.vector.dot(spin);
    let vector = (spin.scaled(rotation.scalar) + rotation.vector.cross(spin)).scaled(0.5);
    let rates = [scalar, vector.x, vector.y, vector.z, velocity.x, velocity.y, velocity.z];
    let values = frame.components();
    Pose::from_components(std::array::from_fn(|k| Jet { value: values[k], first: rates[k], second: 0.0 }))
}
