//! Direct differentiation: sensitivities of the state to model parameters are propagated along the steps of a run. They solve linear
//! equations whose matrix is the tangent of the step.
//!
//! Legend: z increments of a step, μ multipliers, θ a model parameter; η, ν, α variations of positions, twists and accelerations at a
//! stage, which follow linearly from δz and from the variations at the start (`node_maps`); K, D, M derivatives of the forces by
//! positions, twists and accelerations; B gradient, c violations of the constraints; f forces.
//!
//! ```text
//! K η + D ν + M α + Bᵀ δμ + ∂f/∂θ = 0,      B η + ∂c/∂θ = 0
//! ```
//!
//! at each stage. The violations are those of the positions themselves, since carried violations add up. With one stage, the tangent
//! factored at the solution is the matrix of these equations. With two stages it is used for both, and corrections are iterated.
//! If strains are integrated over a step, the left-hand sides are finite differences of residuals along the variation
//! (`integrated`). Several parameters are solved simultaneously as multiple right-hand sides.

mod integrated;
mod node_maps;
mod products;
mod sensitivity;
mod stages;
mod variation;

use std::sync::Arc;

use lissom_motion::{Block, WIDTH};

use super::simulation::Simulation;
use crate::errors::StepError;
use crate::kinematics::{Quantity, Subject};
use crate::round_off;
use crate::schemes::Tableau;
use crate::system::{ParameterDifference, State};
use crate::tuning::MAX_ITERATIONS;
use integrated::Neighbour;
use stages::{Stages, largest_found};
use variation::Variation;

/// Lower bound of the contraction rate used in that estimate.
const CREDIBLE: f64 = 1e-5;
/// Lower bound of the increments' reference relative to the derivative of the state, whose round-off they have.
const ROUNDED: f64 = 1e-3;

/// Sensitivities of the state of a simulation to parameters of its model.
pub struct Sensitivities {
    numbers: Vec<Number>,
    variations: Vec<Lanes>,
    stages: Stages,
    /// Step size of the scheme's history, if it depends on one [s].
    remembered: Option<f64>,
    /// Steps so far.
    steps: usize,
    /// Whether one correction has been sufficient so far.
    is_exact: bool,
    corrections: usize,
}

/// Explicit dependence of the equations on a model parameter, at fixed motion.
struct Number {
    difference: ParameterDifference,
    /// The perturbed models.
    neighbours: Vec<Neighbour>,
}

/// Sensitivities to as many parameters as there are SIMD lanes.
struct Lanes {
    now: Variation,
    /// Derivatives of increments and multipliers of the last step, by stage.
    increments: Vec<Vec<Block>>,
    multipliers: Vec<Vec<Block>>,
}

impl Sensitivities {
    /// No parameters yet. None if the steps of `base` cannot be differentiated directly: with projected velocities, adaptive step
    /// size, feedback, wheels that roll or creep, or rotors.
    pub fn new(base: &Simulation) -> Option<Self> {
        let settings = base.settings();
        let layout = base.system.layout();
        let is_known = settings.scheme.tableau.as_ref().is_none_or(Tableau::is_stiffly_accurate)
            && settings.control.is_none()
            && !base.system.has_feedback()
            && layout.of_velocities.is_empty()
            && base.integrator.work.unit.spins.is_empty()
            && !base.system.sees_multipliers();
        is_known.then(|| Self {
            numbers: Vec::new(),
            variations: Vec::new(),
            stages: Stages::new(base),
            remembered: base.integrator.history.is_some().then(|| base.integrator.scaled.step_size()),
            steps: 0,
            is_exact: true,
            corrections: 0,
        })
    }

    /// Adds a parameter, given by simulations of perturbed models with their finite-difference weights, all at their start like
    /// `base`. False if it cannot be differentiated directly: fixed positions or signals depend on it.
    pub fn add(&mut self, base: &Simulation, neighbours: &[(&Simulation, f64)]) -> bool {
        let layout = base.system.layout();
        let lane = self.numbers.len() % WIDTH;
        let systems = neighbours.iter().map(|(of, weight)| (Arc::clone(&of.system), *weight)).collect();
        let Some(difference) = ParameterDifference::of(systems) else { return false };
        let stages = base.settings().scheme.stages.len();
        if lane == 0 {
            self.variations.push(Lanes {
                now: Variation::new(layout),
                increments: vec![vec![variation::NOTHING; layout.coordinate_count()]; stages],
                multipliers: vec![vec![variation::NOTHING; layout.multiplier_rows().len()]; stages],
            });
        }
        let Some(last) = self.variations.last_mut() else { return false };
        let states: Vec<(&State, f64)> = neighbours.iter().map(|(of, weight)| (&of.state, *weight)).collect();
        if !last.now.enter(lane, layout, &base.state.kinematics, &states) {
            last.now.clear(lane);
            if lane == 0 {
                self.variations.pop();
            }
            return false;
        }
        let neighbour = |(of, weight): &(&Simulation, f64)| Neighbour {
            system: Arc::clone(&of.system),
            weight: *weight,
            length: of.integrator.representative.length,
        };
        self.numbers.push(Number { difference, neighbours: neighbours.iter().map(neighbour).collect() });
        true
    }

    /// Number of corrections so far, those of simultaneous parameters counted once.
    pub fn corrections(&self) -> usize {
        self.corrections
    }

    /// Largest derivative of the state by the parameter of this index: of a position, or of a rate or acceleration over a step
    /// [-, rad per unit of the parameter].
    pub fn extent(&self, base: &Simulation, index: usize) -> f64 {
        self.variations[index / WIDTH]
            .now
            .extents(&base.integrator.work.units.coordinates, base.integrator.scaled.step_size())
            [index % WIDTH]
    }

    /// Displaces a copy of the state of `base` by `share` times its derivative by the parameter of this index.
    pub fn displace(&self, base: &Simulation, index: usize, share: f64, out: &mut State) {
        out.clone_from(&base.state);
        self.variations[index / WIDTH].now.displace(index % WIDTH, base.system.layout(), share, out);
    }

    /// Differentiates the last step of `base`. False if there is no such step, for example after one that was subdivided.
    ///
    /// # Errors
    /// If its tangent is singular, or corrections do not converge.
    pub fn advance(&mut self, base: &mut Simulation) -> Result<bool, StepError> {
        if self.remembered.is_some_and(|size| size != base.integrator.scaled.step_size()) {
            return Ok(false);
        }
        if !base.renew_at_solution()? {
            return Ok(false);
        }
        self.stages.enter(base);
        self.steps += 1;
        let is_seen = !self.is_exact || self.steps.is_power_of_two() || base.settings.scheme.stages.len() > 1;
        for (index, lanes) in self.variations.iter_mut().enumerate() {
            let first = index * WIDTH;
            let numbers = &self.numbers[first..self.numbers.len().min(first + WIDTH)];
            let (made, is_exact) = step(&mut self.stages, base, lanes, numbers, is_seen)?;
            self.corrections += made;
            self.is_exact &= is_exact;
        }
        Ok(true)
    }
}

/// Differentiates one step by several parameters. Returns the number of corrections, and whether the first was sufficient.
fn step(
    stages: &mut Stages,
    base: &mut Simulation,
    lanes: &mut Lanes,
    numbers: &[Number],
    is_seen: bool,
) -> Result<(usize, bool), StepError> {
    let (count, is_integrated) = (base.settings.scheme.stages.len(), base.settings.scheme.tableau.is_some());
    stages.reach(base, numbers);
    if count == 1 {
        lanes.increments[0].fill(variation::NOTHING);
        lanes.multipliers[0].fill(variation::NOTHING);
    }
    let (mut made, mut is_exact) = (0, true);
    let mut rounding: Option<Block> = None;
    let (mut first, mut before) = ([0.0_f64; WIDTH], [f64::INFINITY; WIDTH]);
    loop {
        stages.evaluate(base, lanes, numbers.len());
        let sizes = stages.correct(base, lanes);
        made += 1;
        if made == 1 {
            (first, before) = (sizes, sizes);
            if !is_seen {
                break;
            }
            continue;
        }
        let known = largest_found(base, lanes);
        let rounding = rounding.get_or_insert_with(|| {
            lanes.now.extents(&base.integrator.work.units.coordinates, base.integrator.scaled.step_size())
        });
        let reference: Block =
            std::array::from_fn(|lane| first[lane].max(known[lane]).max(ROUNDED * rounding[lane]));
        if made == 2 {
            is_exact = (0..WIDTH).all(|lane| sizes[lane] <= round_off::ITERATION * reference[lane]);
        }
        let left = |lane| if is_integrated { integrated::round_off(base, lanes, lane) } else { 0.0 };
        // The remaining correction follows from the contraction rate; corrections that no longer contract are round-off.
        let is_done = |lane: usize| {
            let contraction = sizes[lane] / before[lane].max(f64::MIN_POSITIVE);
            // Small corrections that do not contract by half are round-off.
            if contraction > 0.5 {
                return sizes[lane] <= (round_off::DERIVATIVE * reference[lane]).max(left(lane));
            }
            contraction.max(CREDIBLE) * sizes[lane] <= round_off::ITERATION * reference[lane]
        };
        if (0..WIDTH).all(is_done) {
            break;
        }
        if sizes.iter().any(|size| !size.is_finite()) || made >= MAX_ITERATIONS {
            return Err(StepError::NotConverged {
                time: base.state.kinematics.time,
                iterations: made,
                correction: sizes.iter().fold(0.0, |most, size| size.max(most)),
                worst: Subject::nameless("derivatives of the motion"),
                hint: "the tangent of the step does not serve its derivatives: choose a smaller step",
            });
        }
        before = sizes;
    }
    stages.leave(base, lanes);
    Ok((made, is_exact))
}

/// Weights of the violations in the augmented term.
fn relative_weights(base: &Simulation) -> Vec<f64> {
    let layout = base.system.layout();
    let augmentation = base.integrator.scaled.augmentation();
    let of = |quantity: &Quantity| augmentation.weight * augmentation.relative(*quantity);
    layout.quantities()[layout.multiplier_rows()].iter().map(of).collect()
}
