//! Start positions of joints: those that are given, those of followers, and others at their reference value or, where limits
//! exclude it, at the nearest position within the limits of the joint and of its followers.

use std::collections::BTreeMap;

use super::model_text::Options;
use super::{Pose, Robot, RobotJoint};

/// Relative deviation of a follower's position from that of its leader.
const NEAR: f64 = 1e-9;

/// A start position that was chosen because limits exclude the reference value.
#[derive(Clone, Debug, PartialEq)]
pub struct ChosenStart {
    /// Name of the joint.
    pub joint: String,
    /// Start position of the joint [rad, m].
    pub value: f64,
    /// The excluded value [rad, m].
    pub excluded: f64,
    /// Limits for the joint from its own range and those of its followers [rad, m].
    pub limits: [f64; 2],
}

impl ChosenStart {
    /// The choice and its reason, in a sentence.
    pub fn sentence(&self) -> String {
        let Self { joint, value, excluded, limits: [low, high] } = self;
        format!(
            "joint `{joint}` starts at {value}, the position nearest to {excluded} within its limits {low} … {high}"
        )
    }
}

/// The start positions that are chosen for `robot` because its limits exclude reference values that `pose` does not replace.
pub fn chosen_starts(robot: &Robot, pose: &Pose, options: Options) -> Vec<ChosenStart> {
    Start::of(robot, pose, options).chosen
}

/// Start of a robot.
pub(super) struct Start {
    /// Positions and rates of all joints with a coordinate.
    pub(super) pose: Pose,
    pub(super) chosen: Vec<ChosenStart>,
    /// Values for unknown joints, beyond limits, or that contradict a leader.
    pub(super) obstacles: Vec<String>,
}

impl Start {
    pub(super) fn of(robot: &Robot, given: &Pose, options: Options) -> Self {
        let mut start = Self { pose: given.clone(), chosen: Vec::new(), obstacles: Vec::new() };
        let known: Vec<&str> =
            robot.joints.iter().filter(|joint| joint.moves()).map(|joint| joint.name.as_str()).collect();
        let mut unknown: Vec<&String> = given
            .values
            .keys()
            .chain(given.rates.keys())
            .filter(|name| !known.contains(&name.as_str()))
            .collect();
        unknown.dedup();
        start.obstacles.extend(unknown.iter().map(|name| {
            format!("there is no moving joint `{name}`; moving joints are {}", known.join(", "))
        }));
        let mut leaders = Vec::new();
        for joint in robot.joints.iter().filter(|joint| joint.moves()) {
            match leader(robot, joint, options) {
                Ok(found) => leaders.push((joint, found)),
                Err(obstacle) => start.obstacles.push(obstacle),
            }
        }
        for (joint, _) in leaders.iter().filter(|(joint, (leader, _, _))| joint.name == leader.name) {
            start.place_leader(joint, &leaders, options);
        }
        for (joint, (leader, factor, offset)) in
            leaders.iter().filter(|(joint, (leader, _, _))| joint.name != leader.name)
        {
            start.place_follower(joint, leader, (*factor, *offset));
        }
        // Limits of positions that were given, and of their followers.
        for (joint, range) in robot.joints.iter().filter_map(|joint| Some((joint, range(joint, options)?))) {
            let Some(own) = start.pose.values.get(&joint.name) else { continue };
            let slack = NEAR * (range[1] - range[0]);
            if *own < range[0] - slack || *own > range[1] + slack {
                start.obstacles.push(format!(
                    "{}joint `{}` starts at {own}, outside of its limits {} … {}: give it another position by `--position`, or \
                     omit limits by `--without limits`",
                    prefix(&joint.source),
                    joint.name,
                    range[0],
                    range[1]
                ));
            }
        }
        start
    }

    /// The position of a joint that follows no other.
    fn place_leader(
        &mut self,
        joint: &RobotJoint,
        leaders: &[(&RobotJoint, (&RobotJoint, f64, f64))],
        options: Options,
    ) {
        if self.pose.values.contains_key(&joint.name) {
            return;
        }
        let [mut low, mut high] = [f64::NEG_INFINITY, f64::INFINITY];
        for (follower, (_, factor, offset)) in
            leaders.iter().filter(|(_, (leader, _, _))| leader.name == joint.name)
        {
            let Some(ends) = range(follower, options).filter(|_| *factor != 0.0) else { continue };
            let [one, other] = ends.map(|end| (end - offset) / factor);
            (low, high) = (low.max(one.min(other)), high.min(one.max(other)));
        }
        let excluded = joint.reference;
        let mut value = excluded;
        if low > high {
            self.obstacles.push(format!(
                "{}joint `{}`: no position is within its limits and those of the joints that mimic it: correct them, or omit \
                 limits by `--without limits`",
                prefix(&joint.source),
                joint.name
            ));
        } else if !(low..=high).contains(&value) {
            value = value.clamp(low, high);
            self.chosen.push(ChosenStart { joint: joint.name.clone(), value, excluded, limits: [low, high] });
        }
        self.pose.values.insert(joint.name.clone(), value);
    }

    /// The position and rate of a joint that follows another.
    fn place_follower(&mut self, joint: &RobotJoint, leader: &RobotJoint, (factor, offset): (f64, f64)) {
        let of =
            |all: &BTreeMap<String, f64>, default: f64| all.get(&leader.name).copied().unwrap_or(default);
        let position = factor * of(&self.pose.values, leader.reference) + offset;
        let rate = factor * of(&self.pose.rates, 0.0);
        for (all, wanted) in [(&mut self.pose.values, position), (&mut self.pose.rates, rate)] {
            match all.get(&joint.name) {
                Some(own) if (own - wanted).abs() > NEAR * (1.0 + wanted.abs()) => {
                    self.obstacles.push(format!(
                        "{}joint `{}` mimics `{}` and must start at {wanted}, not {own}: omit this value",
                        prefix(&joint.source),
                        joint.name,
                        leader.name
                    ));
                }
                _ => {
                    all.insert(joint.name.clone(), wanted);
                }
            }
        }
    }
}

/// The range of a joint with limits.
fn range(joint: &RobotJoint, options: Options) -> Option<[f64; 2]> {
    joint.range.filter(|_| options.limits && joint.moves())
}

/// The joint that `joint` follows in the end, with factor and offset; itself if it follows none.
fn leader<'a>(
    robot: &'a Robot,
    joint: &'a RobotJoint,
    options: Options,
) -> Result<(&'a RobotJoint, f64, f64), String> {
    let (mut at, mut factor, mut offset) = (joint, 1.0, 0.0);
    for _ in 0..=robot.joints.len() {
        let Some((name, own_factor, own_offset)) = at.follows.as_ref().filter(|_| options.mimic) else {
            return Ok((at, factor, offset));
        };
        (factor, offset) = (factor * own_factor, offset + factor * own_offset);
        at = robot.joints.iter().find(|other| other.name == *name && other.moves()).ok_or_else(|| {
            format!("{}joint `{}` mimics `{name}`, which is no moving joint", prefix(&at.source), at.name)
        })?;
    }
    Err(format!("{}joint `{}` mimics itself, through other joints", prefix(&joint.source), joint.name))
}

/// A location before a message.
pub(super) fn prefix(source: &str) -> String {
    if source.is_empty() { String::new() } else { format!("{source}: ") }
}
