//! Joints of open trees. Without such a joint the system falls apart. If velocities are given on one side only, nothing determines
//! the rates of its coordinates.

use crate::joints::constraint::{Port, ports_of};
use crate::kinematics::{CoordinateId, GROUND, LOCKED, NodeId};
use crate::system::System;

/// A joint between two rigid groups of nodes.
struct Edge {
    groups: [usize; 2],
    coordinates: Vec<CoordinateId>,
}

/// Rows of joint coordinates that neither loops, other constraints nor given velocities determine, by row whether these are given.
pub(super) fn undetermined(system: &System, is_given: &[bool]) -> Vec<usize> {
    let layout = system.layout();
    let mut parents: Vec<usize> = (0..layout.node_count()).collect();
    let mut unite = |nodes: &[NodeId]| {
        for pair in nodes.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|node| root(&mut parents, node.index()));
            parents[a.max(b)] = a.min(b);
        }
    };
    // Flexible parts determine velocities as joints do: without a jerk they begin to move undeformed.
    system.elements_with(|own| own.deformation).for_each(|element| unite(&element.unknowns().nodes));
    let mut uses = vec![0; layout.coordinate_rows.len()];
    let mut joints = Vec::new();
    for constraint in system.constraints() {
        let (mut nodes, mut coordinates) = (Vec::new(), Vec::new());
        for port in ports_of(constraint) {
            match port {
                Port::Node(node) => nodes.push(node),
                Port::Coordinate(coordinate) => {
                    uses[coordinate.index()] += 1;
                    coordinates.push(coordinate);
                }
                Port::NoNode => {}
            }
        }
        match (&nodes[..], coordinates.is_empty()) {
            (&[base, tip], false) => joints.push(([base, tip], coordinates)),
            _ => unite(&nodes),
        }
    }
    let group = |node: NodeId, parents: &mut Vec<usize>| root(parents, node.index());
    let edges: Vec<Edge> = joints
        .into_iter()
        .map(|(nodes, coordinates)| Edge { groups: nodes.map(|node| group(node, &mut parents)), coordinates })
        .collect();
    let mut given = vec![0; layout.node_count()];
    for node in layout.nodes() {
        let mut rows = layout.rows_of_node(node).iter().filter(|&&row| row != LOCKED).peekable();
        if node == GROUND || rows.peek().is_none() || rows.any(|&row| is_given[row as usize]) {
            given[group(node, &mut parents)] += 1;
        }
    }
    let bridges = bridges(layout.node_count(), &edges, &given);
    let coordinates = bridges.into_iter().flat_map(|edge| &edges[edge].coordinates);
    let alone = coordinates.filter(|coordinate| uses[coordinate.index()] == 1);
    alone.map(|&coordinate| layout.row_of_coordinate(coordinate)).filter(|&row| !is_given[row]).collect()
}

fn root(parents: &mut [usize], mut node: usize) -> usize {
    while parents[node] != node {
        parents[node] = parents[parents[node]];
        node = parents[node];
    }
    node
}

/// Edges that are in no loop, with nothing given on one side [Tarjan 1974].
fn bridges(count: usize, edges: &[Edge], given: &[usize]) -> Vec<usize> {
    let mut neighbours: Vec<Vec<(usize, usize)>> = vec![Vec::new(); count];
    for (index, Edge { groups: [a, b], .. }) in
        edges.iter().enumerate().filter(|(_, own)| own.groups[0] != own.groups[1])
    {
        neighbours[*a].push((*b, index));
        neighbours[*b].push((*a, index));
    }
    let (mut number, mut lowest, mut below) =
        (vec![usize::MAX; count], vec![usize::MAX; count], given.to_vec());
    let mut found = Vec::new();
    for start in 0..count {
        if number[start] != usize::MAX {
            continue;
        }
        // Groups in the order in which they are reached, each with the edge to it and the group before it.
        let mut order: Vec<(usize, usize, usize)> = Vec::new();
        let mut open = vec![(start, usize::MAX, usize::MAX)];
        let mut path: Vec<(usize, usize, usize)> = Vec::new();
        while let Some((own, edge, before)) = open.pop() {
            number[own] = order.len();
            lowest[own] = order.len();
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
                    open.push((other, by, *own));
                    break;
                }
                lowest[*own] = lowest[*own].min(number[other]);
            }
        }
        let whole: usize = order.iter().map(|&(own, ..)| given[own]).sum();
        for &(own, edge, before) in order.iter().skip(1).rev() {
            below[before] += below[own];
            lowest[before] = lowest[before].min(lowest[own]);
            if lowest[own] == number[own] && (below[own] == 0 || below[own] == whole) {
                found.push(edge);
            }
        }
    }
    found.sort_unstable();
    found
}
