//! Links and joints in the order of a tree, for formats that list them in any order; joints at the ends of the tree that move no mass.

use std::collections::BTreeSet;

use super::{Freedom, ImportError, JointSpring, Measured, MotorRating, Robot, RobotJoint};

impl Robot {
    /// Moves the root to the front and joints after their parent joints. All that refers to links or joints by their index refers to
    /// the new ones.
    ///
    /// # Errors
    /// If two joints have the same name, or the joints do not form a tree on one root.
    pub(super) fn in_order(mut self) -> Result<Self, ImportError> {
        let Self { links, joints, .. } = &self;
        let mut names = BTreeSet::new();
        let mut into: Vec<Option<usize>> = vec![None; links.len()];
        let mut from: Vec<Vec<usize>> = vec![Vec::new(); links.len()];
        for (number, joint) in joints.iter().enumerate() {
            if !names.insert(&joint.name) {
                return Err(ImportError::new(format!("two joints are called `{}`", joint.name)));
            }
            if let Some(other) = into[joint.child].replace(number) {
                let message = format!(
                    "link `{}` is a child of both `{}` and `{}`: the joints must form a tree",
                    links[joint.child].name, joints[other].name, joint.name
                );
                return Err(ImportError::new(message));
            }
            from[joint.parent].push(number);
        }
        let roots: Vec<usize> = (0..links.len()).filter(|&link| into[link].is_none()).collect();
        let [root] = roots[..] else {
            let named: Vec<&str> = roots.iter().map(|&link| links[link].name.as_str()).collect();
            let message = match roots.len() {
                0 if links.is_empty() => "it has no <link>".to_owned(),
                0 => "every link is a child of another one: there is no root".to_owned(),
                _ => format!(
                    "several links have no parent, but only one can be the root: {}",
                    named.join(", ")
                ),
            };
            return Err(ImportError::new(message));
        };
        let (mut order, mut sorted) = (vec![root], Vec::new());
        let mut next = 0;
        while let Some(&parent) = order.get(next) {
            order.extend(from[parent].iter().map(|&number| joints[number].child));
            sorted.extend(&from[parent]);
            next += 1;
        }
        let (new_link, new_joint) = (inverse(&order, links.len()), inverse(&sorted, joints.len()));
        if let Some(lost) = new_link.iter().position(Option::is_none) {
            let lost = &links[lost].name;
            return Err(ImportError::new(format!("link `{lost}` is its own ancestor in a loop of joints")));
        }
        self.links = taken(self.links, &order);
        self.joints = taken(self.joints, &sorted);
        // Every link and joint has a new index.
        let link = |own: &mut usize| *own = new_link[*own].unwrap_or(0);
        let joint = |own: &mut usize| *own = new_joint[*own].unwrap_or(0);
        self.joints.iter_mut().flat_map(|own| [&mut own.parent, &mut own.child]).for_each(link);
        self.closures.iter_mut().flat_map(|own| &mut own.links).for_each(link);
        self.ropes.iter_mut().flat_map(|own| &mut own.along).for_each(|(own, _)| link(own));
        self.contacts.excluded.iter_mut().flatten().for_each(link);
        self.contacts.pairs.iter_mut().flat_map(|own| &mut own.links).for_each(link);
        self.compensations.iter_mut().for_each(|own| link(&mut own.link));
        self.tendons.iter_mut().flat_map(|own| &mut own.terms).for_each(|(own, _)| joint(own));
        self.motors.iter_mut().for_each(|own| joint(&mut own.joint));
        for sensor in &mut self.sensors {
            match &mut sensor.quantity {
                Measured::Coordinate(own) | Measured::Rate(own) => joint(own),
                Measured::Motion { link: own, .. } => link(own),
            }
        }
        Ok(self)
    }

    /// Fixes joints that move no mass, such as those of tools and frames of cameras: their motion is no motion of the self.
    pub(super) fn fix_massless_ends(&mut self) {
        let mut has_mass: Vec<bool> = self.links.iter().map(|link| link.inertia.is_some()).collect();
        for joint in self.joints.iter().rev() {
            has_mass[joint.parent] |= has_mass[joint.child];
        }
        if !has_mass.first().is_some_and(|has| *has) {
            return;
        }
        let leaders: BTreeSet<String> =
            self.joints.iter().filter_map(|joint| Some(joint.follows.as_ref()?.0.clone())).collect();
        let is_end = |joint: &&mut RobotJoint| {
            joint.freedom != Freedom::Fixed && !has_mass[joint.child] && !leaders.contains(&joint.name)
        };
        let mut names = Vec::new();
        for joint in self.joints.iter_mut().filter(is_end) {
            names.push(format!("`{}`", joint.name));
            joint.freedom = Freedom::Fixed;
            (joint.range, joint.follows, joint.rating) = (None, None, MotorRating::default());
            (joint.damping, joint.friction, joint.spring) = (0.0, 0.0, JointSpring::default());
        }
        if !names.is_empty() {
            self.left_out.push(format!(
                "the motion of joints that carry no mass, which are fixed: {}",
                names.join(", ")
            ));
        }
    }
}

/// New positions by old ones; none for those that `order` does not list.
fn inverse(order: &[usize], count: usize) -> Vec<Option<usize>> {
    let mut places = vec![None; count];
    order.iter().enumerate().for_each(|(new, &old)| places[old] = Some(new));
    places
}

/// Entries in another order.
fn taken<T>(all: Vec<T>, order: &[usize]) -> Vec<T> {
    let mut all: Vec<Option<T>> = all.into_iter().map(Some).collect();
    order.iter().filter_map(|&old| all[old].take()).collect()
}
