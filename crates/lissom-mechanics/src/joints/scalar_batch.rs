//! Joints whose equations cannot be evaluated in the lanes of a vector register, such as those that contain a search:
//! they are evaluated one by one.

use std::any::Any;
use std::ops::Range;

use lissom_motion::WIDTH;

use super::Equations;
use super::attached::AttachedJoint;
use super::blocks::{JointBatch, Results, ViolationRates, Wanted};
use super::constraint::{Constraint as _, violation_rates};
use super::derivatives::{Derivatives, LOCAL};
use super::starts::StartBlock;
use super::{MAX_COORDINATES, MAX_EQUATIONS};
use crate::joints::evaluation_point::{Chart, Point};
use crate::kinematics::Kinematics;

/// Such joints of all kinds.
pub(crate) struct ScalarJointBatch {
    joints: Vec<AttachedJoint>,
    indices: Vec<u32>,
    starts: Vec<usize>,
}

impl ScalarJointBatch {
    pub(super) fn new() -> Self {
        Self { joints: Vec::new(), indices: Vec::new(), starts: vec![0] }
    }

    pub(super) fn push(&mut self, index: usize, joint: AttachedJoint) {
        let last = self.starts[self.starts.len() - 1];
        self.starts.push(last + LOCAL + joint.equations());
        self.indices.push(index as u32);
        self.joints.push(joint);
    }
}

impl JointBatch for ScalarJointBatch {
    fn indices(&self) -> &[u32] {
        &self.indices
    }

    fn starts(&self) -> &[usize] {
        &self.starts
    }

    fn block_items(&self, block: usize) -> Range<usize> {
        block * WIDTH..self.joints.len().min((block + 1) * WIDTH)
    }

    fn begin(&self, _: &Kinematics, _: &mut Vec<StartBlock>) {}

    fn evaluate(
        &self,
        wanted: Wanted,
        point: &Point<'_>,
        _: Option<&[StartBlock]>,
        blocks: Range<usize>,
        add: &mut dyn FnMut(usize, &Results),
    ) {
        let mut results = [[0.0; WIDTH]; LOCAL + MAX_EQUATIONS];
        for block in blocks {
            for (lane, item) in self.block_items(block).enumerate() {
                let joint = &self.joints[item];
                let configuration = joint.configuration(&point.increments);
                let change = joint.joint().violation_change(&configuration.0, &configuration.1);
                let mut mu = Equations::default();
                for k in 0..joint.equations() {
                    let multiplier = joint.first_multiplier + k;
                    let violation = point.violations[multiplier] + change[k];
                    let relative = point.augmentation.relative(joint.joint().equation_quantity(k));
                    mu[k] = point.multipliers[multiplier] + point.augmentation.weight * relative * violation;
                    results[LOCAL + k][lane] = violation;
                }
                if wanted == Wanted::All {
                    let forces = joint.forces(&configuration, &mu);
                    for (row, force) in results.iter_mut().zip(forces.iter()) {
                        row[lane] = *force;
                    }
                }
            }
            add(block, &results);
        }
    }

    fn violation_rates(
        &self,
        at: &Kinematics,
        _: &[StartBlock],
        take: &mut dyn FnMut(usize, &ViolationRates),
    ) {
        let mut results = [[[0.0; WIDTH]; MAX_EQUATIONS]; 2];
        for block in 0..self.joints.len().div_ceil(WIDTH) {
            for (lane, item) in self.block_items(block).enumerate() {
                let joint = &self.joints[item];
                let mut own = [[0.0; MAX_EQUATIONS]; 2];
                let [rates, accelerations] = own.each_mut().map(|own| &mut own[..joint.equations()]);
                let mut gradient = [0.0; MAX_EQUATIONS * (12 + MAX_COORDINATES)];
                let gradient = &mut gradient[..joint.equations() * joint.size()];
                violation_rates(joint, at, gradient, [rates, accelerations]);
                for (blocks, own) in results.iter_mut().zip(own) {
                    blocks.iter_mut().zip(own).for_each(|(block, value)| block[lane] = value);
                }
            }
            take(block, &results);
        }
    }

    fn linearize(
        &self,
        _: &[AttachedJoint],
        point: &Point<'_>,
        _: Option<&[StartBlock]>,
        chart: Chart<'_>,
        scratch: &mut Derivatives,
        take: &mut dyn FnMut(usize, &mut Derivatives),
    ) {
        for (joint, &index) in self.joints.iter().zip(&self.indices) {
            let configuration = joint.configuration(&point.increments);
            joint.linearize_for(joint.joint(), &configuration, point, chart, scratch);
            take(index as usize, scratch);
        }
    }

    fn pack(&mut self, _: &[AttachedJoint]) {}

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }
}
