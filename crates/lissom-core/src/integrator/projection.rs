//! Projection of the velocities onto the constraints after a step of a scheme that does not satisfy them exactly.

use lissom_solver::SolverKind;

use crate::consistent::initial_conditions::ConsistentInitialConditions;
use crate::errors::InitialError;
use crate::kinematics::{CoordinateId, Quantity};
use crate::scaling::Representative;
use crate::schemes::Tableau;
use crate::system::{State, System};

/// Removes the velocity components that violate the constraints after a step that is not stiffly accurate. The projection is
/// orthogonal with respect to the kinetic energy, which therefore decreases; the fraction 1 - α of the decrease is restored by
/// scaling all velocities.
pub(crate) struct Projection {
    initial: ConsistentInitialConditions,
    tableau: Tableau,
}

impl Projection {
    pub(crate) fn new(
        system: &System,
        state: &State,
        representative: &Representative,
        solver: &SolverKind,
        tableau: Tableau,
    ) -> Self {
        Self { initial: ConsistentInitialConditions::new(system, state, representative, solver), tableau }
    }

    pub(crate) fn apply(&mut self, system: &System, state: &mut State) -> Result<(), InitialError> {
        let before = system.energy(&state.kinematics).kinetic;
        self.initial.velocities(system, state)?;
        let after = system.energy(&state.kinematics).kinetic;
        let wanted = after + (1.0 - self.tableau.dissipation) * (before - after);
        let is_driven = system.has_driven_constraint(&state.kinematics);
        if !is_driven && after > 0.0 && wanted > after {
            let factor = (wanted / after).sqrt();
            for node in &mut state.kinematics.nodes {
                node.twist *= factor;
            }
            for (id, coordinate) in CoordinateId::enumerate(&mut state.kinematics.coordinates) {
                if system.layout().coordinate_quantity(id) != Quantity::State {
                    coordinate.rate *= factor;
                }
            }
        }
        Ok(())
    }
}
