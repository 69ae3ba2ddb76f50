//! Joints of open trees: without such a joint the system falls apart. If only rates of joints are given, those of the others are zero;
//! velocities of parts leave the others at rest, as far as joints permit.

use crate::joints::constraint::{Port, ports_of};
use crate::kinematics::{CoordinateId, GROUND, LOCKED, NodeId};
use crate::system::System;

/// A joint between two groups of nodes, each of which moves as one part.
struct Edge {
    groups: [usize; 2],
    coordinates: Vec<CoordinateId>,
}

/// Rows of joint coordinates that neither loops nor other constraints determine, in mechanisms with given rates of joints and no given
/// velocity of a part. `is_given` is by row.
pub(super) fn undetermined(system: &System, is_given: &[bool]) -> Vec<usize> {
    let layout = system.layout();
    let rows = |node: NodeId| layout.rows_of_node(node).iter().filter(|&&row| row != LOCKED);
    let mut groups = Groups::new(layout.node_count());
    for node in layout.nodes().filter(|&node| rows(node).next().is_none()) {
        groups.unite(&[GROUND.index(), node.index()]);
    }
    // Flexible parts determine velocities as joints do: without a jerk they begin to move undeformed.
    for element in system.elements_with(|own| own.deformation) {
        groups.unite(&element.unknowns().nodes.iter().map(|node| node.index()).collect::<Vec<_>>());
    }
    let mut uses = vec![0; layout.coordinate_rows.len()];
    let mut joints = Vec::new();
    for constraint in system.constraints() {
        let (mut nodes, mut coordinates) = (Vec::new(), Vec::new());
        for port in ports_of(constraint) {
            match port {
                Port::Node(node) => nodes.push(node.index()),
                Port::Coordinate(coordinate) => {
                    uses[coordinate.index()] += 1;
                    coordinates.push(coordinate);
                }
                Port::NoNode => {}
            }
        }
        match (&nodes[..], coordinates.is_empty()) {
            (&[base, tip], false) => joints.push(([base, tip], coordinates)),
            _ => groups.unite(&nodes),
        }
    }
    let edges: Vec<Edge> = joints
        .into_iter()
        .map(|(nodes, coordinates)| Edge { groups: nodes.map(|node| groups.of(node)), coordinates })
        .collect();
    let ground = groups.of(GROUND.index());
    // Connected otherwise than by the ground.
    let mut mechanisms = Groups::new(layout.node_count());
    edges
        .iter()
        .filter(|edge| !edge.groups.contains(&ground))
        .for_each(|edge| mechanisms.unite(&edge.groups));
    let row_of = |coordinate: &CoordinateId| layout.row_of_coordinate(*coordinate);
    let mut has_rates = vec![false; layout.node_count()];
    for edge in edges.iter().filter(|edge| edge.coordinates.iter().any(|own| is_given[row_of(own)])) {
        for group in edge.groups {
            has_rates[mechanisms.of(group)] = true;
        }
    }
    for node in layout.nodes().filter(|&node| rows(node).any(|&row| is_given[row as usize])) {
        has_rates[mechanisms.of(groups.of(node.index()))] = false;
    }
    let bridges = bridges(layout.node_count(), &edges).into_iter().map(|edge| &edges[edge]);
    let moved = |edge: &Edge| edge.groups[usize::from(edge.groups[0] == ground)];
    let chosen: Vec<&Edge> = bridges.filter(|edge| has_rates[mechanisms.of(moved(edge))]).collect();
    let coordinates = chosen.into_iter().flat_map(|edge| &edge.coordinates);
    let alone = coordinates.filter(|coordinate| uses[coordinate.index()] == 1);
    alone.map(row_of).filter(|&row| !is_given[row]).collect()
}

/// Disjoint sets of nodes or groups.
struct Groups(Vec<usize>);

impl Groups {
    fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    fn of(&mut self, mut member: usize) -> usize {
        while self.0[member] != member {
            self.0[member] = self.0[self.0[member]];
            member = self.0[member];
        }
        member
    }

    fn unite(&mut self, members: &[usize]) {
        for pair in members.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|member| self.of(member));
            self.0[a.max(b)] = a.min(b);
        }
    }
}

/// Edges that are in no loop [Tarjan 1974].
fn bridges(count: usize, edges: &[Edge]) -> Vec<usize> {
    let mut neighbours: Vec<Vec<(usize, usize)>> = vec![Vec::new(); count];
    for (index, edge) in edges.iter().enumerate().filter(|(_, own)| own.groups[0] != own.groups[1]) {
        let [a, b] = edge.groups;
        neighbours[a].push((b, index));
        neighbours[b].push((a, index));
    }
    let (mut number, mut lowest) = (vec![usize::MAX; count], vec![usize::MAX; count]);
    let mut found = Vec::new();
    for start in 0..count {
        if number[start] != usize::MAX {
            continue;
        }
        // Groups in the order in which they are reached, each with the edge to it and the group before it.
        let mut order: Vec<(usize, usize, usize)> = Vec::new();
        let mut open = Some((start, usize::MAX, usize::MAX));
        // The groups between the first and the present one, each with the edge to it and the number of neighbours seen.
        let mut path: Vec<(usize, usize, usize)> = Vec::new();
        while let Some((own, edge, before)) = open.take() {
            (number[own], lowest[own]) = (order.len(), order.len());
            order.push((own, edge, before));
            path.push((own, edge, 0));
            while let Some((own, edge, next)) = path.last_mut() {
                let Some(&(other, by)) = neighbours[*own].get(*next) else {
                    path.pop();
                    continue;
                };
                *next += 1;
                if by == *edge {
                    continue;
                }
                if number[other] == usize::MAX {
                    open = Some((other, by, *own));
                    break;
                }
                lowest[*own] = lowest[*own].min(number[other]);
            }
        }
        for &(own, edge, before) in order.iter().skip(1).rev() {
            lowest[before] = lowest[before].min(lowest[own]);
            if lowest[own] == number[own] {
                found.push(edge);
            }
        }
    }
    found.sort_unstable();
    found
}
