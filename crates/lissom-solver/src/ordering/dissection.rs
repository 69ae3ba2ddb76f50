//! Nested dissection (George 1973, SIAM J. Numer. Anal. 10, 345): separators that divide a graph again and again, for minimum degree to
//! eliminate last. Of large meshes in space this saves most of the fill. A separator is the rim of the groups that are nearer to one of two
//! distant groups, or near to one.

use super::GroupGraph;
use crate::structure::Structure;

/// Unknowns of a set that is not divided further.
const SMALL: u64 = 600;
/// Smallest part of a set on either side of a separator.
const MIN_SHARE: f64 = 0.3;
/// Maximum number of divisions on the way to a set.
const MAX_DEPTH: u32 = 40;

/// Two sides and the separator.
type Division = [Vec<u32>; 3];

/// Rank of every group in the elimination: 0 between separators, more for larger separators.
pub(super) fn ranks(structure: &Structure, graph: &GroupGraph) -> Vec<u32> {
    let mut ranks = vec![0; graph.len()];
    // Groups in no set, such as those that follow their hosts, are in set 0.
    let mut all = Dissection { graph, set_of: vec![0; graph.len()], places: vec![0; graph.len()] };
    let is_free = |group: &u32| structure.groups[*group as usize].hosts.is_empty();
    let mut sets = vec![((0..graph.len() as u32).filter(is_free).collect::<Vec<_>>(), 0)];
    let mut name = 0;
    while let Some((set, depth)) = sets.pop() {
        name += 1;
        for (place, &group) in set.iter().enumerate() {
            (all.set_of[group as usize], all.places[group as usize]) = (name, place);
        }
        if depth < MAX_DEPTH
            && all.weight(&set) > SMALL
            && let Some([one, other, separator]) = all.divide(&set)
        {
            for &group in &separator {
                (ranks[group as usize], all.set_of[group as usize]) = (MAX_DEPTH - depth, 0);
            }
            sets.extend([(one, depth + 1), (other, depth + 1)]);
        }
    }
    ranks
}

struct Dissection<'g> {
    graph: &'g GroupGraph,
    /// The set of each group, and its place there.
    set_of: Vec<u32>,
    places: Vec<usize>,
}

impl Dissection<'_> {
    fn weight(&self, groups: &[u32]) -> u64 {
        groups.iter().map(|&group| u64::from(self.graph.weights[group as usize])).sum()
    }

    /// Places of the neighbours in the same set.
    fn neighbours(&self, group: u32) -> impl Iterator<Item = usize> + '_ {
        let set = self.set_of[group as usize];
        let all = self.graph.neighbours(group as usize).iter().map(|&other| other as usize);
        all.filter(move |&other| self.set_of[other] == set).map(|other| self.places[other])
    }

    /// Distances of a set's groups from the one at place `first`, 0 if they are not connected, and the places of those that are.
    fn distances(&self, set: &[u32], first: usize) -> (Vec<i32>, Vec<usize>) {
        let mut distances = vec![0; set.len()];
        distances[first] = 1;
        let (mut reached, mut next) = (vec![first], 0);
        while let Some(&place) = reached.get(next) {
            next += 1;
            for other in self.neighbours(set[place]) {
                if distances[other] == 0 {
                    distances[other] = distances[place] + 1;
                    reached.push(other);
                }
            }
        }
        (distances, reached)
    }

    /// Divides a set by the lightest separator found; none if there is none.
    fn divide(&self, set: &[u32]) -> Option<Division> {
        let (from_first, reached) = self.distances(set, 0);
        if reached.len() < set.len() {
            return Some(self.at(set, &from_first, 1));
        }
        let farthest = |from: usize| self.distances(set, from).1.pop();
        let one = reached.last().copied()?;
        let other = farthest(one)?;
        let [from_one, from_other] = [one, other].map(|place| self.distances(set, place).0);
        // A third one, far from both, and the one that is farthest from it.
        let third = (0..set.len()).rev().max_by_key(|&place| from_one[place].min(from_other[place]))?;
        let [from_third, from_fourth] = [third, farthest(third)?].map(|place| self.distances(set, place).0);
        let less = |a: &[i32], b: &[i32]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<i32>>();
        let differences = [less(&from_one, &from_other), less(&from_third, &from_fourth)];
        let keys = differences.iter().chain([&from_one, &from_third, &from_other, &from_fourth]);
        let divisions = keys.flat_map(|key| self.limits(set, key).map(|limit| self.at(set, key, limit)));
        divisions.min_by_key(|division| self.weight(&division[2]))
    }

    /// The values of a key next to the middle of a set, on either side.
    fn limits(&self, set: &[u32], key: &[i32]) -> impl Iterator<Item = i32> + use<> {
        let mut sorted: Vec<(i32, u32)> = key.iter().copied().zip(set.iter().copied()).collect();
        sorted.sort_unstable();
        let total = self.weight(set) as f64;
        let (mut sum, mut below, mut above) = (0.0, None, None);
        for pair in sorted.windows(2) {
            sum += f64::from(self.graph.weights[pair[0].1 as usize]) / total;
            if pair[0].0 != pair[1].0 && (MIN_SHARE..=1.0 - MIN_SHARE).contains(&sum) {
                if sum <= 0.5 {
                    below = Some(pair[1].0);
                } else {
                    above = above.or(Some(pair[1].0));
                }
            }
        }
        below.into_iter().chain(above)
    }

    /// Division of a set into groups with a key below the limit, the others, and those of the first that are coupled with others.
    fn at(&self, set: &[u32], key: &[i32], limit: i32) -> Division {
        let mut division = Division::default();
        for (&group, &value) in set.iter().zip(key) {
            let is_rim = value < limit && self.neighbours(group).any(|other| key[other] >= limit);
            division[if is_rim { 2 } else { usize::from(value >= limit) }].push(group);
        }
        division
    }
}
