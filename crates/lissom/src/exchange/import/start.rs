//! Start positions of joints: those that are given, those of followers, and others at their reference value or, where limits
//! exclude it, at the nearest position within the limits of the joint and of its followers.

use std::collections::{BTreeMap, BTreeSet};

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
        let names: BTreeSet<&str> = known.iter().copied().collect();
        let mut unknown: Vec<&String> = given
            .values
            .keys()
            .chain(given.rates.keys())
            .filter(|name| !names.contains(name.as_str()))
            .collect();
        unknown.dedup();
        start.obstacles.extend(unknown.iter().map(|name| {
            format!("there is no moving joint `{name}`; moving joints are {}", known.join(", "))
        }));
        let (leaders, faults) = leaders(robot, options);
        start.obstacles.extend(faults);
        // The joints that follow each joint in the end, with itself if it follows none.
        let mut followers: BTreeMap<usize, Vec<&Following>> = BTreeMap::new();
        for own in &leaders {
            followers.entry(own.leader).or_default().push(own);
        }
        for own in leaders.iter().filter(|own| own.joint == own.leader) {
            start.place_leader(robot, own.joint, &followers[&own.leader], options);
        }
        for own in leaders.iter().filter(|own| own.joint != own.leader) {
            start.place_follower(&robot.joints[own.joint], &robot.joints[own.leader], own.relation);
        }
        // Limits of positions that were given, and of their followers.
        for (joint, range) in robot.joints.iter().filter_map(|joint| Some((joint, range(joint, options)?))) {
            let Some(own) = start.pose.values.get(&joint.name) else { continue };
            // Of two ends only one may be infinite.
            let width = range[1] - range[0];
            let slack = NEAR * if width.is_finite() { width } else { 1.0 };
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

    /// The position of a joint that follows no other, within the limits of all that follow it.
    fn place_leader(&mut self, robot: &Robot, index: usize, followers: &[&Following], options: Options) {
        let joint = &robot.joints[index];
        if self.pose.values.contains_key(&joint.name) {
            return;
        }
        let [mut low, mut high] = [f64::NEG_INFINITY, f64::INFINITY];
        for own in followers {
            let (factor, offset) = own.relation;
            let Some(ends) = range(&robot.joints[own.joint], options).filter(|_| factor != 0.0) else {
                continue;
            };
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

/// The joint that another follows in the end, `leader` = `joint` if it follows none.
struct Following {
    joint: usize,
    leader: usize,
    /// Factor and offset of the joint's coordinate over that of the leader.
    relation: (f64, f64),
}

/// For each moving joint the one that it follows in the end; and faults of those without one.
fn leaders(robot: &Robot, options: Options) -> (Vec<Following>, Vec<String>) {
    let moving = || robot.joints.iter().enumerate().filter(|(_, joint)| joint.moves());
    let mut by_name = BTreeMap::new();
    moving().for_each(|(index, joint)| _ = by_name.entry(joint.name.as_str()).or_insert(index));
    let (mut found, mut faults) = (Vec::new(), Vec::new());
    let mut known: Vec<Option<(usize, f64, f64)>> = vec![None; robot.joints.len()];
    for (index, joint) in moving() {
        // Joints from this one to one with a known leader, each with its factor and offset over the next one.
        let (mut path, mut at) = (Vec::new(), index);
        let end = loop {
            if let Some(end) = known[at] {
                break Ok(end);
            }
            let own = &robot.joints[at];
            let Some((name, factor, offset)) = own.follows.as_ref().filter(|_| options.mimic) else {
                break Ok((at, 1.0, 0.0));
            };
            path.push((at, *factor, *offset));
            match by_name.get(name.as_str()) {
                _ if path.len() > robot.joints.len() => {
                    break Err(format!(
                        "{}joint `{}` mimics itself, through other joints",
                        prefix(&joint.source),
                        joint.name
                    ));
                }
                Some(next) => at = *next,
                None => {
                    let source = prefix(&own.source);
                    break Err(format!(
                        "{source}joint `{}` mimics `{name}`, which is no moving joint",
                        own.name
                    ));
                }
            }
        };
        match end {
            Ok(mut end) => {
                known[at] = Some(end);
                for (joint, factor, offset) in path.into_iter().rev() {
                    end = (end.0, factor * end.1, offset + factor * end.2);
                    known[joint] = Some(end);
                }
                found.push(Following { joint: index, leader: end.0, relation: (end.1, end.2) });
            }
            Err(fault) => faults.push(fault),
        }
    }
    (found, faults)
}

/// A location before a message.
pub(super) fn prefix(source: &str) -> String {
    if source.is_empty() { String::new() } else { format!("{source}: ") }
}
