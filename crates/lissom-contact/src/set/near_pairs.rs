//! Pairs of parts that may touch within a step: their bounding spheres, enlarged by the travel that the step allows, overlap. Found
//! by sweep and prune along one axis [Baraff 1992]; parts without bounds are near to all others.

use super::ContactSet;
use lissom_mechanics::kinematics::{GROUND, Kinematics};

/// Two parts of a contact that are near.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct NearPair {
    /// Index of the contact.
    pub rule: u32,
    /// Indices of the parts, the base first.
    pub parts: [u32; 2],
}

impl NearPair {
    /// Numbers that order pairs as they are compared.
    pub fn rank(&self) -> (u32, u32, u32) {
        (self.rule, self.parts[0], self.parts[1])
    }
}

/// Finds near pairs.
#[derive(Clone, Debug, Default)]
pub struct NearPairs {
    /// Bounding radii by part [m].
    radii: Vec<f64>,
    /// Contacts of each part with the part's position in it, ascending.
    rules: Vec<Vec<[u32; 2]>>,
    /// Parts with bounds in the order of their lower ends, and parts without.
    order: Vec<(f64, u32)>,
    unbounded: Vec<u32>,
    found: Vec<NearPair>,
}

impl NearPairs {
    /// Search among the parts of a set.
    pub fn new(set: &ContactSet) -> Self {
        let radii: Vec<f64> = set.parts.iter().map(|part| part.radius).collect();
        let mut rules = vec![Vec::new(); set.parts.len()];
        for (rule, contact) in set.rules.iter().enumerate() {
            for (place, &part) in contact.parts.iter().enumerate() {
                rules[part].push([rule as u32, place as u32]);
            }
        }
        let is_bounded = |&part: &u32| radii[part as usize].is_finite();
        let (bounded, unbounded): (Vec<u32>, Vec<u32>) = (0..radii.len() as u32).partition(is_bounded);
        let order = bounded.into_iter().map(|part| (0.0, part)).collect();
        Self { radii, rules, order, unbounded, found: Vec::new() }
    }

    /// The pairs that are near at a configuration, in ascending order, if each part moves by no more than its `travel` [m].
    pub fn find(&mut self, set: &ContactSet, at: &Kinematics, travel: &[f64]) -> &[NearPair] {
        let Self { radii, rules, order, unbounded, found } = self;
        found.clear();
        let place = |part: u32| at.nodes[set.parts[part as usize].node].frame.position;
        let extent = |part: u32| radii[part as usize] + travel[part as usize];
        for (low, part) in order.iter_mut() {
            *low = place(*part).x - extent(*part);
        }
        // Hardly anything changes from step to step.
        order.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut add = |one: u32, other: u32| push_shared(set, rules, [one, other], found);
        for (index, &(_, one)) in order.iter().enumerate() {
            let (own, reach) = (place(one), extent(one));
            let high = own.x + reach;
            for &(_, other) in order[index + 1..].iter().take_while(|(low, _)| *low <= high) {
                let apart = (place(other) - own).norm_squared();
                if apart <= (reach + extent(other)).powi(2) {
                    add(one, other);
                }
            }
            for &other in &*unbounded {
                add(one, other);
            }
        }
        for (index, &one) in unbounded.iter().enumerate() {
            for &other in &unbounded[..index] {
                add(one, other);
            }
        }
        found.sort_unstable_by_key(NearPair::rank);
        found
    }
}

/// Adds the contacts to which two parts both belong.
fn push_shared(set: &ContactSet, rules: &[Vec<[u32; 2]>], parts: [u32; 2], found: &mut Vec<NearPair>) {
    let nodes = parts.map(|part| set.parts[part as usize].node);
    if nodes[0] == nodes[1] || nodes.into_iter().all(|node| node == GROUND) {
        return;
    }
    let [ours, theirs] = parts.map(|part| &rules[part as usize]);
    for &[rule, place] in ours {
        if let Ok(index) = theirs.binary_search_by_key(&rule, |own| own[0]) {
            let [one, other] = parts;
            let places = [place as usize, theirs[index][1] as usize];
            if !set.rules[rule as usize].may_touch(places) {
                continue;
            }
            let parts = if place < theirs[index][1] { [one, other] } else { [other, one] };
            found.push(NearPair { rule, parts });
        }
    }
}
