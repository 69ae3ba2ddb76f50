//! Joints that move no mass, through links without mass.
//!
//! Several joints of one body are a chain through massless links, which are bodies without mass in the model. The mass matrix of
//! the joints is regular if no combination of their rates leaves all bodies with mass, and all rotors, at rest: if the columns of
//! the matrix are independent whose rows are the twists of all bodies with mass, the rates of joints with a rotor, and q̇_f - k q̇_l
//! of followers. Modified Gram-Schmidt orthogonalisation finds columns that depend on those before.

use std::collections::{BTreeMap, BTreeSet};

use lissom_motion::{Motion, Vector3, Vector6, screw};

use super::{Freedom, Robot};

/// Distance of a unit column from the span of those before, below which it depends on them; also the smallest share of a column
/// in a combination.
const DEPENDENT: f64 = 1e-6;

/// Joints that move no mass.
pub(super) enum Massless {
    /// The joint with this index, by itself.
    Alone(usize),
    /// A combination of rates of the joints with these indices.
    Together(BTreeSet<usize>),
}

/// Joints between the same bodies with mass, through links without mass.
#[derive(Default)]
struct Cluster {
    joints: Vec<usize>,
    /// Links with mass at which it ends.
    ends: Vec<usize>,
    /// Followers with a joint in it: the index, that of the leader, and the factor.
    followers: Vec<(usize, usize, f64)>,
}

/// Combinations of the rates of joints that move no mass, and no rotor. `frames` are those of the links, `stops` whether each is part
/// of a body with mass or of the ground.
///
/// Where all bodies with mass are at rest, joints on both sides of one move nothing of each other: the tree is cut there.
pub(super) fn without_mass(
    robot: &Robot,
    frames: &[Motion],
    stops: &[bool],
    has_followers: bool,
) -> Vec<Massless> {
    let mut into = vec![None; robot.links.len()];
    robot.joints.iter().enumerate().for_each(|(index, joint)| into[joint.child] = Some(index));
    let mut cluster_of: Vec<usize> = Vec::with_capacity(robot.joints.len());
    for (index, joint) in robot.joints.iter().enumerate() {
        let around = into[joint.parent].filter(|_| !stops[joint.parent]);
        cluster_of.push(around.map_or(index, |parent: usize| cluster_of[parent]));
    }
    let mut clusters = BTreeMap::<usize, Cluster>::new();
    for (index, joint) in robot.joints.iter().enumerate() {
        let own = clusters.entry(cluster_of[index]).or_default();
        own.joints.push(index);
        own.ends.extend(stops[joint.child].then_some(joint.child));
    }
    // A joint alone between two bodies with mass moves one of them.
    clusters.retain(|_, own| own.joints.len() > 1 || own.ends.is_empty());
    let index = robot.joint_index();
    let followers: Vec<(usize, usize, f64)> = robot
        .joints
        .iter()
        .enumerate()
        .filter_map(|(own, joint)| {
            let (leader, factor, _) = joint.follows.as_ref().filter(|_| has_followers)?;
            Some((own, *index.get(leader.as_str())?, *factor))
        })
        .collect();
    for &(own, leader, _) in &followers {
        let [one, other] = [cluster_of[own], cluster_of[leader]];
        if one != other
            && clusters.contains_key(&other)
            && let Some(joined) = clusters.remove(&one)
        {
            joined.joints.iter().for_each(|joint| cluster_of[*joint] = other);
            let into = clusters.entry(other).or_default();
            into.joints.extend(joined.joints);
            into.ends.extend(joined.ends);
        }
    }
    for own in followers {
        let mut both = vec![cluster_of[own.0], cluster_of[own.1]];
        both.dedup();
        for cluster in both {
            clusters.entry(cluster).and_modify(|into| into.followers.push(own));
        }
    }
    clusters.values().flat_map(|own| of_cluster(robot, frames, own, (&into, stops))).collect()
}

/// Combinations of the rates of the joints of a cluster, which alone move its ends.
fn of_cluster(
    robot: &Robot,
    frames: &[Motion],
    Cluster { joints, ends, followers }: &Cluster,
    (into, stops): (&[Option<usize>], &[bool]),
) -> Vec<Massless> {
    let columns: Vec<(usize, Column)> = joints
        .iter()
        .flat_map(|&index| {
            columns(robot.joints[index].freedom).into_iter().map(move |column| (index, column))
        })
        .collect();
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for &body in ends {
        let (mut path, mut next) = (BTreeSet::new(), into[body]);
        while let Some(joint) = next {
            path.insert(joint);
            let parent = robot.joints[joint].parent;
            next = into[parent].filter(|_| !stops[parent]);
        }
        let about = frames[body].position;
        let twist = |(index, column): &(usize, Column)| {
            let moves = path.contains(index);
            if moves { column.twist(robot, frames, *index, &about) } else { Vector6::zeros() }
        };
        let twists: Vec<Vector6> = columns.iter().map(twist).collect();
        rows.extend((0..6).map(|k| twists.iter().map(|twist| twist[k]).collect::<Vec<_>>()));
    }
    let unit = |at: usize, factor: f64| {
        columns.iter().map(move |(index, _)| if *index == at { factor } else { 0.0 })
    };
    for &index in joints.iter().filter(|index| robot.joints[**index].armature > 0.0) {
        rows.push(unit(index, 1.0).collect());
    }
    for &(own, leader, factor) in followers {
        rows.push(unit(own, 1.0).zip(unit(leader, -factor)).map(|(own, other)| own + other).collect());
    }
    let mut found = Vec::new();
    let mut basis: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    for (at, (index, _)) in columns.iter().enumerate() {
        let mut column: Vec<f64> = rows.iter().map(|row| row[at]).collect();
        let length = norm(&column);
        if length == 0.0 {
            found.push(Massless::Alone(*index));
            continue;
        }
        // The combination of columns that `column` is.
        let mut shares = vec![0.0; columns.len()];
        shares[at] = 1.0;
        scale(&mut [&mut column, &mut shares], 1.0 / length);
        // Twice, against round-off.
        for (direction, own) in basis.iter().chain(&basis) {
            let along: f64 = direction.iter().zip(&column).map(|(a, b)| a * b).sum();
            for (into, from) in [(&mut column, direction), (&mut shares, own)] {
                into.iter_mut().zip(from).for_each(|(into, from)| *into -= along * from);
            }
        }
        let rest = norm(&column);
        if rest < DEPENDENT {
            let largest = shares.iter().fold(0.0_f64, |largest, share| largest.max(share.abs()));
            let shared = (0..columns.len()).filter(|&k| shares[k].abs() > DEPENDENT * largest);
            found.push(Massless::Together(shared.map(|k| columns[k].0).collect()));
        } else {
            scale(&mut [&mut column, &mut shares], 1.0 / rest);
            basis.push((column, shares));
        }
    }
    found
}

fn norm(column: &[f64]) -> f64 {
    column.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

fn scale(columns: &mut [&mut Vec<f64>], factor: f64) {
    columns.iter_mut().flat_map(|column| column.iter_mut()).for_each(|entry| *entry *= factor);
}

/// A unit rate of a joint.
#[derive(Clone, Copy)]
enum Column {
    /// About the joint's axis, or along it.
    Axis,
    /// About a global axis through the anchor.
    About(usize),
    /// Along a global axis.
    Along(usize),
}

fn columns(freedom: Freedom) -> Vec<Column> {
    match freedom {
        Freedom::Fixed => Vec::new(),
        Freedom::Rotation | Freedom::Displacement => vec![Column::Axis],
        Freedom::Ball => (0..3).map(Column::About).collect(),
        Freedom::Floating => (0..3).map(Column::About).chain((0..3).map(Column::Along)).collect(),
    }
}

impl Column {
    /// Velocity of the point `about` and angular velocity, in global axes.
    fn twist(self, robot: &Robot, frames: &[Motion], index: usize, about: &Vector3) -> Vector6 {
        let joint = &robot.joints[index];
        let frame = &frames[joint.child];
        let at = frame.transform_point(&joint.anchor);
        let turn = |axis: Vector3| screw(&axis.cross(&(about - at)), &axis);
        let unit = |k: usize| Vector3::from_fn(|row, _| f64::from(u8::from(row == k)));
        match self {
            Self::Axis if joint.freedom == Freedom::Rotation => turn(frame.rotation.apply(&joint.axis)),
            Self::Axis => screw(&frame.rotation.apply(&joint.axis), &Vector3::zeros()),
            Self::About(k) => turn(unit(k)),
            Self::Along(k) => screw(&unit(k), &Vector3::zeros()),
        }
    }
}
