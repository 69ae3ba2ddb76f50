//! Differentiated stages of a step: residuals of the linear equations, corrections, and the resulting variations at the end of the
//! step.

use lissom_motion::{Block, Vector6, WIDTH};

use super::integrated::IntegratedStep;
use super::node_maps::{Given, NodeMap, NodeStage, Six};
use super::products::Products;
use super::variation::NOTHING;
use super::{Lanes, Number, relative_weights};
use crate::integrator::Integrator;
use crate::integrator::equations::StepEquations;
use crate::joints::evaluation_point::Chart;
use crate::kinematics::{LOCKED, NodeId};
use crate::schemes::Combination;
use crate::settings::Unwatched;
use crate::simulation::Simulation;
use crate::system::Linearization;

/// Variations at a stage, by row.
#[derive(Clone, Debug, Default)]
struct AtStage {
    place: Vec<Block>,
    rate: Vec<Block>,
    acceleration: Vec<Block>,
}

/// Linearised stages of a step, and scratch storage.
pub(super) struct Stages {
    moving: Vec<NodeId>,
    parts: Linearization,
    products: Vec<Products>,
    /// By stage and moving node.
    maps: Vec<Vec<NodeMap>>,
    /// Explicit derivatives of the residuals by the model parameters, by stage.
    explicit: Vec<Vec<Block>>,
    residuals: Vec<Vec<Block>>,
    at: Vec<AtStage>,
    /// Variation of the scheme's algorithmic accelerations, by row.
    memory: Vec<Block>,
    scratch: [Vec<f64>; 2],
    weights: Vec<f64>,
    processor: pulp::Arch,
    /// For schemes that integrate strains.
    integrated: Option<IntegratedStep>,
}

impl Stages {
    pub(super) fn new(base: &Simulation) -> Self {
        let (system, count) = (&base.system, base.settings.scheme.stages.len());
        let layout = system.layout();
        let rows = vec![NOTHING; layout.coordinate_count()];
        let all = vec![NOTHING; layout.size()];
        let is_moving = |&node: &NodeId| layout.node_rows[node].iter().any(|&row| row != LOCKED);
        let memory = rows.clone();
        let at = AtStage { place: rows.clone(), rate: rows.clone(), acceleration: rows };
        Self {
            moving: layout.nodes().filter(is_moving).collect(),
            parts: system.empty_linearization(),
            products: vec![Products::default(); count],
            maps: vec![Vec::new(); count],
            explicit: vec![all.clone(); count],
            residuals: vec![all; count],
            at: vec![at; count],
            memory,
            scratch: [vec![0.0; layout.size()], vec![0.0; layout.size()]],
            weights: Vec::new(),
            processor: pulp::Arch::new(),
            integrated: IntegratedStep::new(base),
        }
    }

    /// Linearises the last step of `base`, whose tangent has been factored at its solution.
    pub(super) fn enter(&mut self, base: &mut Simulation) {
        self.weights = relative_weights(base);
        let Simulation { system, settings, integrator, previous, .. } = base;
        let Integrator { work, scaled, representative, .. } = integrator;
        let (layout, scheme, size) = (system.layout(), &settings.scheme, scaled.step_size());
        let pattern = &system.structure().pattern;
        let equations = StepEquations {
            system,
            scheme,
            scaled: *scaled,
            scaling: (&settings.scaling, representative),
            start: previous,
            work,
            watch: &mut Unwatched,
        };
        for (index, stage) in scheme.stages.iter().enumerate() {
            if self.integrated.is_none() {
                system.linearize(&equations.point(index), Chart::Body, &mut self.parts);
                self.products[index].enter(pattern, &self.parts);
            }
            let work = &*equations.work;
            let map = |&node: &NodeId| {
                let rows = &layout.node_rows[node];
                let own = |of: &dyn Fn(usize) -> f64| {
                    Vector6::from_fn(|k, _| if rows[k] == LOCKED { 0.0 } else { of(rows[k] as usize) })
                };
                let combined = |combination: &Combination, unit: f64| {
                    own(&|row| work.unit.combine(combination, &work.increments, row) / unit)
                };
                let stage = NodeStage {
                    twist: previous.kinematics.nodes[node].twist,
                    ahead: if scheme.dynamic { stage.abscissa * size } else { 0.0 },
                    increment: own(&|row| work.increments[index][row]),
                    rate: combined(&stage.velocity, size),
                    curvature: combined(&stage.acceleration, size * size),
                };
                NodeMap::new(scheme.parametrization, &stage)
            };
            self.maps[index] = self.moving.iter().map(map).collect();
        }
    }

    /// Computes the explicit derivatives of the residuals by the model parameters, at fixed motion.
    pub(super) fn reach(&mut self, base: &Simulation, numbers: &[Number]) {
        if let Some(integrated) = &mut self.integrated {
            for explicit in &mut self.explicit {
                explicit.fill(NOTHING);
            }
            for (lane, number) in numbers.iter().enumerate() {
                integrated.differ(base, &number.neighbours, lane, &mut self.explicit);
            }
            return;
        }
        let [scratch, own] = &mut self.scratch;
        let work = &base.integrator.work;
        for (index, explicit) in self.explicit.iter_mut().enumerate() {
            explicit.fill(NOTHING);
            for (lane, number) in numbers.iter().enumerate() {
                own.fill(0.0);
                number.difference.add(&work.motions[index].at, &work.multipliers[index], scratch, own);
                for (block, value) in explicit.iter_mut().zip(&*own) {
                    block[lane] = *value;
                }
            }
        }
    }

    /// Computes the residuals of the linear equations of `count` parameters with the present increments and multipliers.
    pub(super) fn evaluate(&mut self, base: &Simulation, lanes: &Lanes, count: usize) {
        if let Some(integrated) = &mut self.integrated {
            for (residual, explicit) in self.residuals.iter_mut().zip(&self.explicit) {
                residual.copy_from_slice(explicit);
            }
            for lane in 0..count {
                integrated.vary(base, lanes, lane, &mut self.residuals);
            }
            return;
        }
        let pattern = &base.system.structure().pattern;
        for index in 0..self.residuals.len() {
            self.vary(base, lanes, index);
            let residual = &mut self.residuals[index];
            residual.copy_from_slice(&self.explicit[index]);
            let AtStage { place, rate, acceleration } = &self.at[index];
            let multipliers = &lanes.multipliers[index];
            self.products[index].add(
                self.processor,
                pattern,
                [place, rate, acceleration],
                multipliers,
                residual,
            );
        }
    }

    /// Computes the variations at a stage.
    fn vary(&mut self, base: &Simulation, lanes: &Lanes, index: usize) {
        self.processor.dispatch(Vary {
            base,
            lanes,
            index,
            moving: &self.moving,
            maps: &self.maps[index],
            out: &mut self.at[index],
        });
    }

    /// Solves for corrections and applies them. Returns the largest scaled correction in each lane.
    pub(super) fn correct(&mut self, base: &mut Simulation, lanes: &mut Lanes) -> Block {
        let layout = base.system.layout();
        let (count, work) = (layout.coordinate_count(), &mut *base.integrator.work);
        let factor = base.integrator.scaled.multiplier_factor();
        // The tangent contains the augmented term, which vanishes with the violations: subtract it from the multipliers.
        for (residual, multipliers) in self.residuals.iter().zip(&mut lanes.multipliers) {
            for ((value, violation), weight) in
                multipliers.iter_mut().zip(&residual[count..]).zip(&self.weights)
            {
                for lane in 0..WIDTH {
                    value[lane] -= weight * violation[lane];
                }
            }
        }
        for residual in &mut self.residuals {
            work.tangent.omitted().iter().for_each(|&row| residual[row] = NOTHING);
        }
        for residual in &mut self.residuals {
            multiply(residual, &work.units.rows);
        }
        work.tangent.matrices.solve_several(&base.settings.scheme.coupling, &mut self.residuals);
        let mut sizes = NOTHING;
        for (index, residual) in self.residuals.iter_mut().enumerate() {
            if let Some(factors) = work.tangent.row_factors() {
                multiply(residual, factors);
            }
            for ((value, correction), size) in
                lanes.increments[index].iter_mut().zip(&*residual).zip(&work.units.coordinates)
            {
                for lane in 0..WIDTH {
                    value[lane] -= correction[lane];
                    sizes[lane] = larger(sizes[lane], size * correction[lane]);
                }
            }
            for (value, correction) in lanes.multipliers[index].iter_mut().zip(&residual[count..]) {
                for lane in 0..WIDTH {
                    value[lane] -= factor * correction[lane];
                }
            }
        }
        sizes
    }

    /// Stores the variations at the end of the step.
    pub(super) fn leave(&mut self, base: &Simulation, lanes: &mut Lanes) {
        let last = self.residuals.len() - 1;
        self.vary(base, lanes, last);
        let scheme = &base.settings.scheme;
        let size = base.integrator.scaled.step_size();
        if let Some(tableau) = &scheme.tableau {
            for index in 0..last {
                self.vary(base, lanes, index);
            }
            self.integrate_rates(&tableau.inverse[last], &lanes.now.rate, size);
        }
        let mut memory = std::mem::take(&mut self.memory);
        combine(&scheme.algorithmic, lanes, size, 1.0 / (size * size), &mut memory);
        self.memory = std::mem::replace(&mut lanes.now.algorithmic, memory);
        std::mem::swap(&mut lanes.now.place, &mut self.at[last].place);
        std::mem::swap(&mut lanes.now.rate, &mut self.at[last].rate);
        std::mem::swap(&mut lanes.now.acceleration, &mut self.at[last].acceleration);
        lanes.now.multipliers.copy_from_slice(&lanes.multipliers[last]);
    }
}

impl Stages {
    /// Computes the accelerations at the end for schemes that integrate velocities: h V̇ = Σ_j (A⁻¹)_j (V_j - V_0).
    fn integrate_rates(&mut self, weights: &[f64], start: &[Block], size: f64) {
        let last = self.at.len() - 1;
        for row in 0..start.len() {
            let mut sum = NOTHING;
            for (at, weight) in self.at.iter().zip(weights) {
                for lane in 0..WIDTH {
                    sum[lane] += weight / size * (at.rate[row][lane] - start[row][lane]);
                }
            }
            self.at[last].acceleration[row] = sum;
        }
    }
}

struct Vary<'a> {
    base: &'a Simulation,
    lanes: &'a Lanes,
    index: usize,
    moving: &'a [NodeId],
    maps: &'a [NodeMap],
    out: &'a mut AtStage,
}

impl pulp::WithSimd for Vary<'_> {
    type Output = ();

    #[expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]
    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        let Vary { base, lanes, index, moving, maps, out } = self;
        let (layout, scheme) = (base.system.layout(), &base.settings.scheme);
        let (stage, size) = (&scheme.stages[index], base.integrator.scaled.step_size());
        let (now, own) = (&lanes.now, &lanes.increments[index]);
        combine(&stage.velocity, lanes, size, 1.0 / size, &mut out.rate);
        combine(&stage.acceleration, lanes, size, 1.0 / (size * size), &mut out.acceleration);
        let straight = if scheme.dynamic { 1.0 } else { 0.0 };
        for &row in &layout.coordinate_rows {
            let row = row as usize;
            for lane in 0..WIDTH {
                let ahead = straight * now.rate[row][lane];
                out.place[row][lane] = now.place[row][lane] + stage.abscissa * size * ahead + own[row][lane];
                out.rate[row][lane] += ahead;
            }
        }
        for (map, &node) in maps.iter().zip(moving) {
            let rows = &layout.node_rows[node];
            let given = Given {
                place: six(rows, &now.place),
                twist: six(rows, &now.rate),
                increment: six(rows, own),
                rate: six(rows, &out.rate),
                curvature: six(rows, &out.acceleration),
            };
            let [places, rates, accelerations] = map.apply(&given);
            for k in 0..6 {
                if rows[k] != LOCKED {
                    let row = rows[k] as usize;
                    out.place[row] = places[k];
                    out.rate[row] = rates[k];
                    out.acceleration[row] = accelerations[k];
                }
            }
        }
    }
}

/// Values in the rows of a node, zero for locked degrees of freedom.
#[expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]
#[inline(always)]
fn six(rows: &[u32; 6], values: &[Block]) -> Six {
    let mut six = [NOTHING; 6];
    for k in 0..6 {
        if rows[k] != LOCKED {
            six[k] = values[rows[k] as usize];
        }
    }
    six
}

/// A scheme's linear combination of increments and of the start of a unit step, times a factor, in all rows.
#[expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]
#[inline(always)]
fn combine(combination: &Combination, lanes: &Lanes, size: f64, factor: f64, out: &mut [Block]) {
    let now = &lanes.now;
    let square = factor * size * size;
    out.fill(NOTHING);
    let starts = [
        (&now.rate, factor * size * combination.velocity),
        (&now.algorithmic, square * combination.algorithmic),
        (&now.acceleration, square * combination.acceleration),
    ];
    let increments = lanes.increments.iter().zip(combination.increments.map(|weight| factor * weight));
    for (values, weight) in starts.into_iter().chain(increments) {
        if weight == 0.0 {
            continue;
        }
        for (sum, value) in out.iter_mut().zip(values) {
            for lane in 0..WIDTH {
                sum[lane] += weight * value[lane];
            }
        }
    }
}

/// Largest scaled derivative of an increment in each lane.
pub(super) fn largest_found(base: &Simulation, lanes: &Lanes) -> Block {
    let mut largest = NOTHING;
    for increments in &lanes.increments {
        for (value, size) in increments.iter().zip(&base.integrator.work.units.coordinates) {
            for lane in 0..WIDTH {
                largest[lane] = larger(largest[lane], size * value[lane]);
            }
        }
    }
    largest
}

fn multiply(values: &mut [Block], factors: &[f64]) {
    for (block, factor) in values.iter_mut().zip(factors) {
        for value in block {
            *value *= factor;
        }
    }
}

/// The larger magnitude; NaN if one of them is.
fn larger(most: f64, value: f64) -> f64 {
    if value.abs() <= most || most.is_nan() { most } else { value.abs() }
}
