//! Stability of an equilibrium without a linear model: the negative pivots of a tangent at the multipliers of the equilibrium are counted, or
//! those of a tangent T nearby that has been factored before. The tangent S at the equilibrium has the same inertia if no matrix between T
//! and S is singular: if all eigenvalues of T⁻¹(S - T) are smaller than 1, so that its powers make every vector shorter.

use lissom_solver::FactorError;

use super::model::{NEUTRAL, has_symmetric, is_at_rest, nothing, point};
use super::shifted::{ACCURATE, RealShift, small_square};
use crate::consistent::redundancy::Redundancy;
use crate::iterate::hold_unbalanced_forces;
use crate::joints::evaluation_point::Chart;
use crate::round_off;
use crate::saddle_point::SaddlePoint;
use crate::saddle_point::potential::{self, Noise, has_potential};
use crate::saddle_point::stage_tangents::{Factored, FactoredSystem, StageTangents};
use crate::scaling::{Representative, Scaled};
use crate::schemes::Weights;
use crate::system::{Blend, Scratch, State, Sum, System, TangentAssembler};

/// Whether the model has a tangent at rest whose inertia determines the stability.
fn is_decided_by_inertia(system: &System, state: &State) -> bool {
    let signals = system.signals();
    is_at_rest(&state.kinematics)
        && !system.has_signal_feedback()
        && !signals.has_samples()
        && signals.delayed().is_none()
        && system.layout().velocity_rows().next().is_none()
        && system.rigid_contacts().next().is_none()
        && system.contacts().is_empty()
}

fn assemble(system: &System, state: &State, blend: Blend<f64>, values: &mut [f64]) {
    let (still, unchanged) = nothing(&state.kinematics);
    let zeros = vec![0.0; state.multipliers.len()];
    let at = point(&state.kinematics, (&still, &unchanged), &state.multipliers, &zeros);
    let mut sum = TangentAssembler::Real(Sum { blend, values, stiffness: &mut [] });
    system.assemble_tangent(&at, Chart::Body, &mut Scratch::default(), &mut sum);
}

/// Whether a stiffness derives from an energy, so that its symmetric part, which then replaces it, determines the stability. `usual` is the
/// size of its entries for lengths.
fn is_conservative(
    system: &System,
    (representative, scale): (&Representative, f64),
    values: &mut [f64],
    usual: f64,
) -> bool {
    if has_symmetric(system, representative, values, usual) {
        return true;
    }
    let (structure, count) = (system.structure(), system.layout().coordinate_count());
    if !system.has_loads_of_motion() {
        return false;
    }
    hold_unbalanced_forces(system.layout(), &structure.pattern, values);
    let has_potential = has_potential(structure, (values, count), scale, &[]);
    potential::symmetrise(&structure.pattern, values, count);
    has_potential
}

/// Whether an equilibrium is certainly stable because its tangent hardly differs from the `factored` one, of this scaling.
pub(crate) fn is_stable_like(
    system: &System,
    state: &State,
    representative: &Representative,
    (scaled, factored): (&Scaled, &mut SaddlePoint<StageTangents>),
) -> bool {
    let pattern = &*system.structure().pattern;
    let negative = factored.report().and_then(|report| report.negative_pivots);
    if negative != Some(system.layout().multiplier_count)
        || !is_decided_by_inertia(system, state)
        || !factored.matrices.has_symmetric_values(pattern)
    {
        return false;
    }
    let (mut change, blend) = (vec![0.0; pattern.entries()], scaled.blend(Weights::AT_REST));
    assemble(system, state, blend, &mut change);
    if !is_conservative(
        system,
        (representative, scaled.scale()),
        &mut change,
        blend.place * representative.stiffness,
    ) {
        return false;
    }
    factored.scale_as_factored(pattern, &mut change, scaled.scale());
    let [FactoredSystem::Real(Factored { solver, values, .. })] = &mut factored.matrices.systems[..] else {
        return false;
    };
    change.iter_mut().zip(&*values).for_each(|(value, own)| *value -= own);
    let norm = |vector: &[f64]| vector.iter().map(|value| value * value).sum::<f64>().sqrt();
    let mut noise = Noise(5);
    let mut vector: Vec<f64> = (0..pattern.size()).map(|_| noise.number()).collect();
    let mut product = vec![0.0; vector.len()];
    let first = norm(&vector);
    // Numbers that grow in an elimination without pivoting would spoil the signs of pivots.
    solver.solve(&mut vector);
    pattern.multiply(values, &vector, &mut product);
    let mut same = Noise(5);
    if !product.iter().all(|value| (value - same.number()).abs() <= ACCURATE) {
        return false;
    }
    vector.copy_from_slice(&product);
    // After as many solves as pay off, an eigenvalue of 1 or more would have kept its share of the random vector.
    (0..8).any(|_| {
        pattern.multiply(&change, &vector, &mut product);
        solver.solve(&mut product);
        std::mem::swap(&mut vector, &mut product);
        norm(&vector) <= round_off::MATRIX_ENTRY * first
    })
}

/// What the signs of pivots say about an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// No direction that satisfies the constraints decreases the energy.
    Stable,
    /// The stiffness derives from no energy.
    NoEnergy,
    /// A direction decreases the energy, or the signs do not determine it.
    Open,
}

/// Whether an equilibrium is stable.
pub(crate) fn verdict(
    system: &System,
    state: &State,
    (representative, redundancy): (&Representative, &Redundancy),
) -> Verdict {
    if !is_decided_by_inertia(system, state) {
        return Verdict::Open;
    }
    let mut has_energy = true;
    let mut shifted = RealShift::new(system, representative);
    // Just below zero, so that unconstrained directions without stiffness are not counted as unstable.
    let shift = -NEUTRAL * small_square(representative);
    let negative = shifted.factor_values(shift, |scaled, blend, values| {
        assemble(system, state, blend, values);
        redundancy.omit_from(system, values);
        let usual = blend.place * representative.stiffness;
        let is_symmetric = is_conservative(system, (representative, scaled.scale()), values, usual);
        // What else is not symmetric is examined with the whole linear model.
        has_energy = is_symmetric || !system.has_loads_of_motion();
        if is_symmetric { Ok(()) } else { Err(FactorError::NotFinite { unknown: 0 }) }
    });
    match negative {
        _ if !has_energy => Verdict::NoEnergy,
        Ok(0) if shifted.is_accurate() => Verdict::Stable,
        _ => Verdict::Open,
    }
}
