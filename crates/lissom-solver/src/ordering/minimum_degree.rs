//! Approximate minimum degree on groups: the order for the multifrontal solver.
//!
//! Quotient graph with element absorption, mass elimination, indistinguishable variables and the approximate external
//! degree of Amestoy, Davis, Duff 1996 (SIAM J. Matrix Anal. Appl. 17, 886), with degrees counted in unknowns. In addition,
//! a group with hosts is not a candidate: it is eliminated directly after its last host.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::{GroupGraph, dissection};
use crate::structure::{Group, HostCount, Structure};

/// Elimination order of the groups with little fill. Every group follows its last host, and the groups that are eliminated with
/// that host without fill. Deterministic: among equal candidates the group whose degree has been unchanged for longest is chosen,
/// then the smaller index. A chain of equal links is therefore eliminated from both ends, and its two halves can be eliminated in
/// parallel.
///
/// # Panics
/// If [`Structure::check`] rejects the structure.
pub fn minimum_degree_order(structure: &Structure) -> Vec<usize> {
    let graph = GroupGraph::new(structure);
    order(structure, &graph, vec![0; graph.len()])
}

/// Minimum-degree order with the separators of a nested dissection last.
pub(crate) fn dissected_order(structure: &Structure, graph: &GroupGraph) -> Vec<usize> {
    order(structure, graph, dissection::ranks(structure, graph))
}

/// Elimination order of the groups' columns with little fill for any choice of pivot rows: minimum degree of AᵀA, whose factor
/// contains the factor of every such elimination (George and Ng 1985, SIAM J. Sci. Stat. Comput. 6, 390). Groups do not wait for
/// their hosts.
pub(crate) fn column_order(structure: &Structure) -> Vec<usize> {
    let free = |group: &Group| Group { hosts: Vec::new(), ..group.clone() };
    let groups = structure.groups.iter().map(free).collect();
    let free = Structure { groups, ..structure.clone() };
    order(&free, &GroupGraph::new(structure).square(), vec![0; structure.groups.len()])
}

/// Groups of a higher rank are no candidates before those of lower ranks.
fn order(structure: &Structure, graph: &GroupGraph, ranks: Vec<u32>) -> Vec<usize> {
    let mut elimination = Elimination::new(structure, graph, ranks);
    elimination.run();
    let mut order = elimination.order;
    assert_eq!(order.len(), graph.len(), "hosts form no cycle");
    order.shrink_to_fit();
    order
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// Not yet eliminated.
    Variable,
    /// Follows the variable from which it could not be distinguished.
    Merged,
    /// Coupled with nearly all others: removed from the graph until these are eliminated.
    Withheld,
    /// Eliminated; its members are a clique.
    Element,
    /// Eliminated, and its clique is part of a later one.
    Absorbed,
}

struct Elimination {
    graph: QuotientGraph,
    marked: Stamped,
    has_hosts: Vec<bool>,
    hosts: HostCount,
    freed: Vec<u32>,
    ranks: Vec<u32>,
    /// Rank, degree, time at which it was computed, variable.
    heap: BinaryHeap<Reverse<(u32, u64, u64, u32)>>,
    withheld: Vec<u32>,
    order: Vec<usize>,
    remaining_weight: u64,
}

/// Variables that remain, and elements that have replaced eliminated ones.
struct QuotientGraph {
    states: Vec<State>,
    /// Unknowns of a variable and its followers.
    weights: Vec<u64>,
    /// Variables directly coupled with a variable.
    variables: Vec<Vec<u32>>,
    /// Elements of which a variable is a member.
    elements: Vec<Vec<u32>>,
    /// Members of an element.
    members: Vec<Vec<u32>>,
    /// Degree of a variable, weight of the members of an element; both external.
    degrees: Vec<u64>,
    followers: Vec<Vec<u32>>,
}

/// Values that are valid where their stamp is the present one.
struct Stamped {
    /// Weight of an element outside the present boundary.
    outside: Vec<u64>,
    outside_stamps: Vec<u64>,
    marks: Vec<u64>,
    stamp: u64,
}

impl Elimination {
    fn new(structure: &Structure, graph: &GroupGraph, ranks: Vec<u32>) -> Elimination {
        let count = graph.len();
        // As in Amestoy, Davis, Duff 2004 (ACM Trans. Math. Softw. 30, 381): nodes of more than 10 √n neighbours.
        let dense = 16.0_f64.max(10.0 * (count as f64).sqrt()) as usize;
        let mut states = vec![State::Variable; count];
        let mut withheld = Vec::new();
        for group in 0..count {
            if graph.neighbours(group).len() > dense {
                states[group] = State::Withheld;
                withheld.push(group as u32);
            }
        }
        let variables: Vec<Vec<u32>> = (0..count)
            .map(|group| {
                let neighbours = graph.neighbours(group).iter().copied();
                neighbours.filter(|&other| states[other as usize] == State::Variable).collect()
            })
            .collect();
        let weights: Vec<u64> = graph.weights.iter().map(|&weight| u64::from(weight)).collect();
        let degrees: Vec<u64> = variables
            .iter()
            .map(|neighbours| neighbours.iter().map(|&other| weights[other as usize]).sum())
            .collect();
        let has_hosts: Vec<bool> = structure.groups.iter().map(|group| !group.hosts.is_empty()).collect();
        let heap = (0..count)
            .filter(|&group| states[group] == State::Variable && !has_hosts[group])
            .map(|group| Reverse((ranks[group], degrees[group], 0, group as u32)))
            .collect();
        let remaining_weight = weights.iter().sum();
        let graph = QuotientGraph {
            states,
            weights,
            variables,
            elements: vec![Vec::new(); count],
            members: vec![Vec::new(); count],
            degrees,
            followers: vec![Vec::new(); count],
        };
        Elimination {
            graph,
            marked: Stamped {
                outside: vec![0; count],
                outside_stamps: vec![0; count],
                marks: vec![0; count],
                stamp: 0,
            },
            has_hosts,
            hosts: HostCount::new(&structure.groups),
            freed: Vec::new(),
            ranks,
            heap,
            withheld,
            order: Vec::with_capacity(count),
            remaining_weight,
        }
    }

    fn run(&mut self) {
        while let Some(Reverse((_, degree, _, variable))) = self.heap.pop() {
            let index = variable as usize;
            if self.graph.states[index] == State::Variable && self.graph.degrees[index] == degree {
                self.eliminate(index);
                self.eliminate_freed();
            }
        }
        for variable in std::mem::take(&mut self.withheld) {
            if !self.has_hosts[variable as usize] {
                self.place(variable as usize);
                self.eliminate_freed();
            }
        }
    }

    /// Eliminates the groups whose last host has just been eliminated, smallest index first.
    fn eliminate_freed(&mut self) {
        while !self.freed.is_empty() {
            let mut freed = std::mem::take(&mut self.freed);
            freed.sort_unstable();
            for variable in freed {
                match self.graph.states[variable as usize] {
                    State::Variable => self.eliminate(variable as usize),
                    State::Withheld => self.place(variable as usize),
                    State::Merged | State::Element | State::Absorbed => {}
                }
            }
        }
    }

    /// Appends a variable and its followers to the order.
    fn place(&mut self, variable: usize) {
        self.order.push(variable);
        self.hosts.place(variable, &mut self.freed);
        for follower in std::mem::take(&mut self.graph.followers[variable]) {
            self.place(follower as usize);
        }
    }

    fn eliminate(&mut self, pivot: usize) {
        let mut boundary = self.take_boundary(pivot);
        self.graph.states[pivot] = State::Element;
        self.remaining_weight -= self.graph.weights[pivot];
        self.place(pivot);
        let mut weight: u64 = boundary.iter().map(|&member| self.graph.weights[member as usize]).sum();

        self.weigh_elements_outside(&boundary);
        for &member in &boundary {
            self.update_lists(member as usize, pivot as u32);
        }
        // Members that are coupled only with the new element are eliminated with it, without fill.
        for &member in &boundary {
            let index = member as usize;
            if self.graph.variables[index].is_empty()
                && self.graph.elements[index].len() == 1
                && self.hosts.is_free(index)
            {
                self.graph.states[index] = State::Absorbed;
                self.remaining_weight -= self.graph.weights[index];
                weight -= self.graph.weights[index];
                self.graph.elements[index].clear();
                self.place(index);
            }
        }
        boundary.retain(|&member| self.graph.states[member as usize] == State::Variable);
        self.merge_indistinguishable(&mut boundary);
        for &member in &boundary {
            self.update_degree(member as usize, weight);
        }
        self.graph.degrees[pivot] = weight;
        self.graph.members[pivot] = boundary;
    }

    /// All couplings of the pivot; the elements of which it was a member are absorbed.
    fn take_boundary(&mut self, pivot: usize) -> Vec<u32> {
        self.marked.stamp += 1;
        self.marked.marks[pivot] = self.marked.stamp;
        let mut boundary = Vec::new();
        let mut collect = |list: &[u32], states: &[State], marks: &mut [u64]| {
            for &member in list {
                let index = member as usize;
                if states[index] == State::Variable && marks[index] != self.marked.stamp {
                    marks[index] = self.marked.stamp;
                    boundary.push(member);
                }
            }
        };
        for element in std::mem::take(&mut self.graph.elements[pivot]) {
            let index = element as usize;
            if self.graph.states[index] == State::Element {
                self.graph.states[index] = State::Absorbed;
                collect(
                    &std::mem::take(&mut self.graph.members[index]),
                    &self.graph.states,
                    &mut self.marked.marks,
                );
            }
        }
        collect(
            &std::mem::take(&mut self.graph.variables[pivot]),
            &self.graph.states,
            &mut self.marked.marks,
        );
        boundary
    }

    /// `|L_e \ L_p|` for every element that touches the boundary (Amestoy, Davis, Duff 1996, algorithm 2).
    fn weigh_elements_outside(&mut self, boundary: &[u32]) {
        for &member in boundary {
            let weight = self.graph.weights[member as usize];
            for &element in &self.graph.elements[member as usize] {
                let index = element as usize;
                if self.graph.states[index] != State::Element {
                    continue;
                }
                if self.marked.outside_stamps[index] != self.marked.stamp {
                    self.marked.outside_stamps[index] = self.marked.stamp;
                    self.marked.outside[index] = self.graph.degrees[index];
                }
                self.marked.outside[index] -= weight;
            }
        }
    }

    /// Removes the couplings that the new element covers from the lists of a member, and adds the element.
    fn update_lists(&mut self, member: usize, pivot: u32) {
        let (states, marks, stamp) = (&mut self.graph.states, &self.marked.marks, self.marked.stamp);
        let outside = &self.marked.outside;
        let absorbed = &mut self.graph.members;
        self.graph.elements[member].retain(|&element| {
            let index = element as usize;
            if states[index] == State::Element && outside[index] == 0 {
                // Aggressive absorption: all its members are in the new element.
                states[index] = State::Absorbed;
                absorbed[index] = Vec::new();
            }
            states[index] == State::Element
        });
        self.graph.variables[member]
            .retain(|&other| states[other as usize] == State::Variable && marks[other as usize] != stamp);
        self.graph.elements[member].push(pivot);
    }

    fn update_degree(&mut self, member: usize, boundary_weight: u64) {
        let own = self.graph.weights[member];
        let (newest, older) =
            self.graph.elements[member].split_last().expect("the new element has been added");
        debug_assert!(self.graph.states[*newest as usize] == State::Element);
        let outside: u64 = older.iter().map(|&element| self.marked.outside[element as usize]).sum();
        let direct: u64 =
            self.graph.variables[member].iter().map(|&other| self.graph.weights[other as usize]).sum();
        let inside = boundary_weight - own;
        let degree = (outside + direct + inside)
            .min(self.graph.degrees[member] + inside)
            .min(self.remaining_weight - own);
        self.graph.degrees[member] = degree;
        if !self.has_hosts[member] {
            self.heap.push(Reverse((self.ranks[member], degree, self.marked.stamp, member as u32)));
        }
    }

    /// Merges members of the boundary with equal lists: they remain equal until they are eliminated.
    fn merge_indistinguishable(&mut self, boundary: &mut Vec<u32>) {
        let mut hashed: Vec<(u64, u32)> = boundary
            .iter()
            .filter(|&&member| !self.has_hosts[member as usize])
            .map(|&member| (self.hash(member as usize), member))
            .collect();
        hashed.sort_unstable();
        let mut begin = 0;
        while begin < hashed.len() {
            let end = begin + hashed[begin..].partition_point(|&(hash, _)| hash == hashed[begin].0);
            for first in begin..end {
                let leader = hashed[first].1 as usize;
                if self.graph.states[leader] != State::Variable || first + 1 == end {
                    continue;
                }
                self.mark_lists(leader);
                for &(_, candidate) in &hashed[first + 1..end] {
                    if self.graph.states[candidate as usize] == State::Variable
                        && self.has_marked_lists(candidate as usize, leader)
                    {
                        self.merge(leader, candidate);
                    }
                }
            }
            begin = end;
        }
        boundary.retain(|&member| self.graph.states[member as usize] == State::Variable);
    }

    fn hash(&self, member: usize) -> u64 {
        let lists = self.graph.variables[member].iter().chain(&self.graph.elements[member]);
        lists.fold(0_u64, |sum, &item| {
            sum.wrapping_add((u64::from(item) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15))
        })
    }

    fn mark_lists(&mut self, leader: usize) {
        self.marked.stamp += 1;
        for &item in self.graph.variables[leader].iter().chain(&self.graph.elements[leader]) {
            self.marked.marks[item as usize] = self.marked.stamp;
        }
    }

    fn has_marked_lists(&self, candidate: usize, leader: usize) -> bool {
        self.graph.variables[candidate].len() == self.graph.variables[leader].len()
            && self.graph.elements[candidate].len() == self.graph.elements[leader].len()
            && self.graph.variables[candidate]
                .iter()
                .chain(&self.graph.elements[candidate])
                .all(|&item| self.marked.marks[item as usize] == self.marked.stamp)
    }

    fn merge(&mut self, leader: usize, follower: u32) {
        let index = follower as usize;
        self.graph.states[index] = State::Merged;
        self.graph.weights[leader] += self.graph.weights[index];
        self.graph.degrees[leader] = self.graph.degrees[leader].saturating_sub(self.graph.weights[index]);
        self.graph.followers[leader].push(follower);
        self.graph.variables[index] = Vec::new();
        self.graph.elements[index] = Vec::new();
    }
}
