//! Forces and moments of joints on their tip, of drives and couplings on coordinates.

use std::sync::Arc;

use lissom_mechanics::joints::Equations;
use lissom_mechanics::joints::attached::AttachedJoint;
use lissom_mechanics::kinematics::{CoordinateId, Quantity};
use lissom_motion::{Vector3, rotation_part, translation_part};
use lissom_system::OutputDerivatives;
use lissom_system::{State, System};

use super::derivatives::{add, multiplier_row, of_local};
use super::frames::name_of;
use super::{Build, Evaluation, Found, NamesAndUnits, OutputQuantity, SOLUTION, Subjects};
use crate::outputs::channel_components::numbered;
use crate::outputs::entry::{Output, ReactionAxes};
use crate::outputs::kinds::{Declaration, Feature, OutputComponent, Subject};
use crate::text::report::Problem;

/// Registry entry.
pub(crate) const REACTION: Declaration = Declaration {
    word: "reaction",
    summary: "Force and moment of a joint on its tip.",
    subject: Subject::Joint,
    features: &[Feature::JointAxes, Feature::Fatigue, Feature::Accelerations],
    components: &[("f1", "N"), ("f2", "N"), ("f3", "N"), ("m1", "N m"), ("m2", "N m"), ("m3", "N m")],
    build: Build::System(SOLUTION, quantity),
};
fn quantity(output: &Output, system: &System, _: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let joints = system.joints().iter().enumerate().filter(|(_, joint)| joint.name == name.value);
    match joints.map(|(index, _)| index).collect::<Vec<_>>()[..] {
        [] => {}
        [index] => return Ok(Arc::new(OfJoint { index, axes: output.axes })),
        ref several if output.axes == ReactionAxes::Ground => {
            return Ok(Arc::new(OfJoints(several.to_vec())));
        }
        ref several => {
            let message = format!(
                "`{}` consists of {} joints, which have no axes in common",
                name.value,
                several.len()
            );
            return Err(Problem::error(name.span, message).help("leave out `axes`"));
        }
    }
    if output.axes != ReactionAxes::Ground {
        let message = format!("the reaction of `{}` has no axes: it acts on coordinates", name.value);
        return Err(Problem::error(name.span, message).help("leave out `axes`"));
    }
    if let Some(index) = system.sliders().iter().position(|slider| slider.name == name.value) {
        return Ok(Arc::new(OfSlider { index, is_aligned: system.sliders()[index].equations() > 3 }));
    }
    if let Some(index) = system.mean_motions().iter().position(|own| own.name == name.value) {
        return Ok(Arc::new(OfMeanMotion(index)));
    }
    if let Some(index) = system.couplings().iter().position(|coupling| coupling.name == name.value) {
        return Ok(Arc::new(OfCoupling {
            index,
            coordinates: system.couplings()[index].coordinates.clone(),
        }));
    }
    if let Some(index) = system.drives().iter().position(|drive| drive.name == name.value) {
        let coordinate = system.drives()[index].prescribed.coordinate;
        return Ok(Arc::new(OfDrive { index, coordinate }));
    }
    Err(Problem::error(name.span, format!("there is no joint called `{}`", name.value)))
}

/// What acts along a coordinate.
fn effort(quantity: Quantity) -> OutputComponent {
    match quantity {
        Quantity::Angle => ("moment", "N m"),
        Quantity::Length | Quantity::State => ("force", "N"),
    }
}

/// Multipliers of the state on which a joint's reaction depends.
pub(super) fn multipliers(joint: &AttachedJoint, state: &State) -> Equations {
    let mut mu = Equations::default();
    mu[..joint.reacting().len()].copy_from_slice(&state.multipliers[joint.reacting()]);
    mu
}

/// Force and moment of a joint between two nodes.
struct OfJoint {
    index: usize,
    axes: ReactionAxes,
}

impl OutputQuantity for OfJoint {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let joint = &at.system.joints()[self.index];
        let reaction = joint.reaction(at.motion(), &multipliers(joint, at.state));
        let frame = match self.axes {
            ReactionAxes::Ground => {
                out.extend_from_slice(reaction.as_slice());
                return;
            }
            ReactionAxes::Base => joint.output_frames[0],
            ReactionAxes::Tip => joint.output_frames[1],
        };
        let axes = at.motion().nodes[frame.node].frame.rotation * frame.offset.rotation;
        for part in [translation_part(&reaction), rotation_part(&reaction)] {
            out.extend_from_slice(axes.apply_inverse(&part).as_slice());
        }
    }

    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let joint = &at.system.joints()[self.index];
        let axes = match self.axes {
            ReactionAxes::Ground => None,
            ReactionAxes::Base => Some(joint.output_frames[0]),
            ReactionAxes::Tip => Some(joint.output_frames[1]),
        };
        let found = joint.reaction_derivatives(at.motion(), &multipliers(joint, at.state), axes);
        Some(of_local(&found, joint.first_multiplier, at.system))
    }
}

/// Sum of the forces of the joints of a set of nodes on their tips, global axes, and of their moments about the mean of their positions.
struct OfJoints(Vec<usize>);

impl OutputQuantity for OfJoints {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let place = |joint: &AttachedJoint| {
            let tip = joint.frames[1];
            at.motion().nodes[tip.node].frame.transform_point(&tip.offset.position)
        };
        let joints = || self.0.iter().map(|&index| &at.system.joints()[index]);
        let middle = joints().map(place).sum::<Vector3>() / self.0.len() as f64;
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for joint in joints() {
            let reaction = joint.reaction(at.motion(), &multipliers(joint, at.state));
            let own = translation_part(&reaction);
            force += own;
            moment += rotation_part(&reaction) + (place(joint) - middle).cross(&own);
        }
        out.extend(force.iter().chain(&moment));
    }
}

/// Force and moment of a set of nodes on the body that follows it, about the mean of the set, global axes.
struct OfMeanMotion(usize);

impl OutputQuantity for OfMeanMotion {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let own = &at.system.mean_motions()[self.0];
        let multipliers = &at.state.multipliers[own.first_multiplier..];
        out.extend(own.reaction(at.motion(), multipliers).iter().flat_map(|part| part.iter()));
    }
}

/// Force of a slider on its tip, global axes [N], and the moment [N m] where it holds the tip's orientation.
struct OfSlider {
    index: usize,
    is_aligned: bool,
}

impl OutputQuantity for OfSlider {
    fn components(&self, _: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        let count = if self.is_aligned { 6 } else { 3 };
        Some(REACTION.components[..count].iter().map(|&(word, unit)| (word.to_owned(), unit)).collect())
    }

    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let own = &at.system.sliders()[self.index];
        let reaction = own.reaction(at.motion(), &at.state.multipliers[own.first_multiplier..]);
        let count = if self.is_aligned { 2 } else { 1 };
        out.extend(reaction.iter().take(count).flatten());
    }

    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let own = &at.system.sliders()[self.index];
        let found = own.reaction_derivatives(at.motion(), &at.state.multipliers[own.first_multiplier..]);
        let mut all = of_local(&found, own.first_multiplier, at.system);
        all.truncate(if self.is_aligned { 6 } else { 3 });
        Some(all)
    }
}

/// Forces of a relation on its coordinates.
struct OfCoupling {
    index: usize,
    coordinates: Vec<CoordinateId>,
}

impl OutputQuantity for OfCoupling {
    fn components(&self, quantity: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        let efforts = self.coordinates.iter().map(|&own| effort(quantity(own)));
        let (words, units): (Vec<&str>, Vec<&'static str>) = efforts.unzip();
        Some(numbered(&words).into_iter().zip(units).collect())
    }

    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let coupling = &at.system.couplings()[self.index];
        out.extend(coupling.forces(at.motion(), at.state.multipliers[coupling.multiplier]));
    }

    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let coupling = &at.system.couplings()[self.index];
        let (slopes, hessian) = (coupling.slopes(at.motion()), coupling.hessian(at.motion()));
        let mu = at.state.multipliers[coupling.multiplier];
        let of = |k: usize| {
            let mut own = OutputDerivatives::default();
            add(&mut own.by_multiplier, multiplier_row(at.system, coupling.multiplier), -slopes[k]);
            for (column, &coordinate) in hessian.iter().zip(&coupling.coordinates) {
                let row = at.system.layout().row_of_coordinate(coordinate);
                add(&mut own.by_place, row, -mu * column[k]);
            }
            own
        };
        Some((0..coupling.count()).map(of).collect())
    }
}

/// Force of a drive on its coordinate: minus its multiplier.
struct OfDrive {
    index: usize,
    coordinate: CoordinateId,
}

impl OutputQuantity for OfDrive {
    fn components(&self, quantity: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        let (word, unit) = effort(quantity(self.coordinate));
        Some(vec![(word.to_owned(), unit)])
    }

    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        out.push(-at.state.multipliers[at.system.drives()[self.index].multiplier]);
    }

    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let mut own = OutputDerivatives::default();
        let multiplier = at.system.drives()[self.index].multiplier;
        add(&mut own.by_multiplier, multiplier_row(at.system, multiplier), -1.0);
        Some(vec![own])
    }
}
