//! A force that follows from a scalar measure of the motion and its rate, such as a coordinate or the length of a line. The measure states
//! how it depends on the motion, the law states the force; everything else of an element follows from both.
//!
//! Legend: e measure, f force of the law with stiffness k and damping c, G and R gradients of e and ė by positions.
//!
//! ```text
//! forces f G,      δ(f G) = G (k G + c R)ᵀ δq + c G Gᵀ δq̇ + f δG
//! ```

use std::fmt::Debug;

use super::contribution::Contribution;
use super::force_law::{ForceLaw, Response};
use super::initial_model::InitialModel;
use super::{
    Capabilities, Element, Energy, ForceLaws, Limit, LimitKind, Load, Spring, Tangents, Unknowns, Validity,
};
use crate::evaluation::switch_states::SwitchStates;
use crate::kinematics::step_stages::{STAGES, StepStages};
use crate::kinematics::{CarriedFrame, Kinematics, Switch};
use crate::law::VisitLaw;
use crate::signals::measurement::Gradient;

/// Force at a stage of a step over the measure and its rate.
pub(crate) type StageForce<'l> = dyn Fn(usize, [f64; 2]) -> f64 + 'l;

/// A number of the motion. It is evaluated once for each purpose, as a `Reading`.
pub(crate) trait Measure: Clone + Debug + Send + Sync + 'static {
    /// The motion as far as the measure depends on it.
    type Reading;

    /// Unknowns on which it depends.
    fn unknowns(&self) -> Unknowns<'_>;

    /// The motion at one instant.
    fn read(&self, at: &Kinematics) -> Self::Reading;

    /// Measure and rate [m or rad, and per second].
    fn motion(reading: &Self::Reading) -> [f64; 2];

    /// Gradients of measure and rate.
    fn gradients(&self, reading: &Self::Reading) -> [Gradient; 2];

    /// Adds a force times the gradient.
    fn add_force(&self, reading: &Self::Reading, force: f64, out: &mut [f64]);

    /// Adds the derivatives of a constant force times the gradient. Default: the gradient is constant.
    fn add_bend(&self, _reading: &Self::Reading, _force: f64, _out: &mut Tangents) {}

    /// Adds the forces at both stages of a step, for schemes that integrate strains. Default: the measure is integrated exactly.
    fn stage_forces(&self, step: &StepStages<'_>, force: &StageForce<'_>, out: &mut [&mut [f64]; STAGES]) {
        for j in 0..STAGES {
            let reading = self.read(step.stages[j]);
            self.add_force(&reading, force(j, Self::motion(&reading)), out[j]);
        }
    }

    /// Known breakpoints of the measure, if it is also a function of time, which then supplies energy. Default: it is not.
    fn breakpoints(&self) -> Option<Vec<f64>> {
        None
    }

    /// Passes a law with kinks or jumps to `visit`, over numbers that change smoothly. Default: over measure and rate.
    fn visit(&self, law: &ForceLaw, reading: &Self::Reading, visit: &mut VisitLaw<'_>) {
        visit(law, &Self::motion(reading));
    }

    /// Frames of base and tip, if the force acts between two. Default: none.
    fn frames(&self) -> Option<[CarriedFrame; 2]> {
        None
    }

    /// Kinds of limits.
    const LIMITS: &'static [LimitKind] = &[];

    /// A limit over a step under a force at a configuration. Default: it has none.
    fn limit(
        &self,
        _kind: LimitKind,
        _step: [&Kinematics; 2],
        _force: &dyn Fn([f64; 2], &Kinematics) -> f64,
    ) -> Option<Limit<'_>> {
        None
    }
}

/// A force over a measure x and its rate v. Sides are frozen branches of its switches, from which it is continued.
pub(crate) trait MeasuredLaw: Clone + Debug + Send + Sync + 'static {
    /// Whether some laws of this type supply energy.
    const SUPPLIES: bool;

    /// Whether this one does, so that its work is computed.
    fn is_active(&self) -> bool;

    /// The force with its derivatives.
    fn response(&self, motion: [f64; 2], sides: &[f64]) -> Response;

    /// Potential energy [J].
    fn energy(&self, value: f64, sides: &[f64]) -> f64;

    /// Whether the force depends on the rate.
    fn dissipates(&self) -> bool;

    /// Number of kinks and jumps.
    fn switch_count(&self) -> usize;

    /// Appends numbers that change their sign at kinks and jumps.
    fn add_switches(&self, motion: [f64; 2], sides: &[f64], out: &mut Vec<Switch>);

    /// The law as a function whose kinks are examined along a step. Default: only its switches are.
    fn examined(&self) -> Option<&ForceLaw> {
        None
    }

    /// Kinds of limits; those of the measure otherwise.
    const LIMITS: &'static [LimitKind] = &[];

    /// A limit of the law at a value of the measure. Default: it has none.
    fn limit(&self, _value: f64) -> Option<Limit<'_>> {
        None
    }
}

/// An element whose force is a law over a measure.
#[derive(Clone, Debug)]
pub(crate) struct OverMeasure<M, L> {
    measure: M,
    law: L,
    switch_states: SwitchStates,
}

impl<M: Measure, L: MeasuredLaw> OverMeasure<M, L> {
    /// Contribution of one such element.
    pub(super) fn contribution(model: &InitialModel, measure: M, law: L) -> Contribution {
        Contribution::of(model, Self { measure, law, switch_states: SwitchStates::default() })
    }

    fn response(&self, reading: &M::Reading, at: &Kinematics) -> Response {
        self.law.response(M::motion(reading), self.switch_states.of(at))
    }

    fn supplies(&self) -> bool {
        self.law.is_active() || self.measure.breakpoints().is_some()
    }
}

impl<M: Measure, L: MeasuredLaw> Element for OverMeasure<M, L> {
    fn unknowns(&self) -> Unknowns<'_> {
        self.measure.unknowns()
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let reading = self.measure.read(at);
        self.measure.add_force(&reading, self.response(&reading, at).force, out);
    }

    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        let force = |j: usize, motion| self.law.response(motion, self.switch_states.of(step.stages[j])).force;
        self.measure.stage_forces(step, &force, out);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let reading = self.measure.read(at);
        let response = self.response(&reading, at);
        let [Gradient { by_place: along, .. }, Gradient { by_place: turning, .. }] =
            self.measure.gradients(&reading);
        let size = out.size();
        for (i, of_row) in along[..size].iter().enumerate().filter(|(_, of_row)| **of_row != 0.0) {
            for j in 0..size {
                out.stiffness[i * size + j] +=
                    of_row * (response.stiffness * along[j] + response.damping * turning[j]);
                out.damping[i * size + j] += of_row * response.damping * along[j];
            }
        }
        self.measure.add_bend(&reading, response.force, out);
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        if L::SUPPLIES && self.supplies() {
            return Energy::default();
        }
        let [value, _] = M::motion(&self.measure.read(at));
        Energy { strain: self.law.energy(value, self.switch_states.of(at)), ..Energy::default() }
    }

    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        Some(&mut self.switch_states)
    }

    fn capabilities(&self) -> Capabilities<'_> {
        let load: Option<&dyn Load> = if L::SUPPLIES { Some(self) } else { None };
        let validity: Option<&dyn Validity> = if self.limits().is_empty() { None } else { Some(self) };
        let frames = self.measure.frames();
        Capabilities {
            load,
            validity,
            frames,
            spring: Some(self),
            laws: Some(self),
            ..Capabilities::default()
        }
    }
}

impl<M: Measure, L: MeasuredLaw> Load for OverMeasure<M, L> {
    fn is_active(&self) -> bool {
        self.supplies()
    }

    fn breakpoints(&self) -> Vec<f64> {
        self.measure.breakpoints().unwrap_or_default()
    }
}

impl<M: Measure, L: MeasuredLaw> Spring for OverMeasure<M, L> {
    fn dissipates(&self) -> bool {
        self.law.dissipates()
    }

    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        let reading = self.measure.read(at);
        let [value, rate] = M::motion(&reading);
        [value, rate, self.response(&reading, at).force]
    }

    fn spring_gradients(&self, at: &Kinematics) -> Option<[Gradient; 3]> {
        let reading = self.measure.read(at);
        Some(self.response(&reading, at).gradients(self.measure.gradients(&reading)))
    }
}

impl<M: Measure, L: MeasuredLaw> Validity for OverMeasure<M, L> {
    fn limits(&self) -> &'static [LimitKind] {
        if L::LIMITS.is_empty() { M::LIMITS } else { L::LIMITS }
    }

    fn limit(&self, kind: LimitKind, step: [&Kinematics; 2]) -> Option<Limit<'_>> {
        if L::LIMITS.contains(&kind) {
            return self.law.limit(M::motion(&self.measure.read(step[1]))[0]);
        }
        let force = |motion, at: &Kinematics| self.law.response(motion, self.switch_states.of(at)).force;
        self.measure.limit(kind, step, &force)
    }
}

impl<M: Measure, L: MeasuredLaw> ForceLaws for OverMeasure<M, L> {
    fn switch_count(&self) -> usize {
        self.law.switch_count()
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        let motion = M::motion(&self.measure.read(at));
        self.law.add_switches(motion, self.switch_states.of(at), out);
    }

    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        if let Some(law) = self.law.examined() {
            self.measure.visit(law, &self.measure.read(at), visit);
        }
    }
}
