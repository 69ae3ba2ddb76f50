//! The smallest gap of a contact, also where nothing touches. Bounding spheres exclude nearly all pairs of parts with bounds.

use super::{ContactSet, PlacedMeeting, gap_of};
use lissom_mechanics::kinematics::Kinematics;

/// The smallest gap between the parts of a contact.
#[derive(Clone, Debug)]
pub struct SmallestGap {
    /// Index of the contact.
    rule: usize,
    /// Pairs with a part without bounds, and their points.
    unbounded: Vec<([usize; 2], Vec<PlacedMeeting>)>,
    /// Positions of the parts with bounds among those of the contact.
    bounded: Vec<usize>,
}

impl SmallestGap {
    /// Smallest gap of the contact of this index.
    pub fn new(set: &ContactSet, rule: usize) -> Self {
        let contact = &set.rules[rule];
        let parts = &contact.parts;
        let is_bounded = |part: usize| set.parts[part].radius.is_finite();
        let mut unbounded = Vec::new();
        for (index, &tip) in parts.iter().enumerate() {
            for (place, &base) in parts[..index].iter().enumerate() {
                if is_bounded(base) && is_bounded(tip) || !contact.may_touch([place, index]) {
                    continue;
                }
                unbounded.push(([base, tip], points(set, rule, [base, tip])));
            }
        }
        let bounded = (0..parts.len()).filter(|&place| is_bounded(parts[place])).collect();
        Self { rule, unbounded, bounded }
    }

    /// At a configuration [m]; infinite if no parts can touch.
    pub fn at(&self, set: &ContactSet, at: &Kinematics) -> f64 {
        let mut least = f64::INFINITY;
        for (parts, meetings) in &self.unbounded {
            least = least_of(set, *parts, meetings, at).min(least);
        }
        let contact = &set.rules[self.rule];
        for (index, &place) in self.bounded.iter().enumerate() {
            let tip = contact.parts[place];
            let own = at.nodes[set.parts[tip].node].frame.position;
            for &other in self.bounded[..index].iter().filter(|&&other| contact.may_touch([other, place])) {
                let base = contact.parts[other];
                let apart = (at.nodes[set.parts[base].node].frame.position - own).norm();
                if apart - set.parts[base].radius - set.parts[tip].radius < least {
                    let parts = [base, tip];
                    least = least_of(set, parts, &points(set, self.rule, parts), at).min(least);
                }
            }
        }
        least
    }
}

/// The points of two parts; none if they cannot touch.
fn points(set: &ContactSet, rule: usize, parts: [usize; 2]) -> Vec<PlacedMeeting> {
    set.meetings_of(rule, parts).ok().flatten().unwrap_or_default()
}

fn least_of(set: &ContactSet, parts: [usize; 2], meetings: &[PlacedMeeting], at: &Kinematics) -> f64 {
    let nodes = parts.map(|part| set.parts[part].node);
    let gaps = meetings.iter().map(|(meeting, _)| gap_of(meeting, nodes, at));
    gaps.fold(f64::INFINITY, f64::min)
}
