//! Names of modes: the parts that move most, how they move, and which of the modes of this kind it is, such as "1st bending of `tower`
//! along y".

use std::collections::BTreeMap;

use lissom_core::linearized::NodeShape;
use lissom_motion::{Matrix3, Vector3};
use num_complex::Complex64;

/// Parts with at least this fraction of the largest kinetic energy are named, at most so many.
const NAMED: (f64, usize) = (0.5, 3);
/// A rotation is the larger motion if its arc at this fraction of the part's size exceeds the displacement.
const ARM: f64 = 0.1;
/// Rotations of nodes of a shell with smaller displacements than this fraction of their arc over an element are of directors alone.
const DIRECTORS: f64 = 0.05;
/// Sections across the longest axis of a shell or solid.
const SECTIONS: usize = 8;
/// A direction is along an axis if this fraction of it is.
const ALONG: f64 = 0.9;

/// Names of modes in the order of their frequencies: of each the shape at all nodes, the share of each part in its kinetic energy, and
/// whether it is a rigid motion.
pub(super) fn names(
    shapes: &[Vec<NodeShape>],
    shares: &[BTreeMap<String, f64>],
    is_rigid: impl Fn(usize) -> bool,
) -> Vec<String> {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    let named = |(index, (shape, shares)): (usize, (&Vec<NodeShape>, &BTreeMap<String, f64>))| {
        let words = motion(shape, shares, is_rigid(index))?;
        let count = counts.entry(words.clone()).or_default();
        *count += 1;
        Some(format!("{} {words}", ordinal(*count)))
    };
    shapes.iter().zip(shares).enumerate().map(named).map(Option::unwrap_or_default).collect()
}

fn ordinal(number: usize) -> String {
    let ending = match (number % 10, number % 100) {
        (1, last) if last != 11 => "st",
        (2, last) if last != 12 => "nd",
        (3, last) if last != 13 => "rd",
        _ => "th",
    };
    format!("{number}{ending}")
}

/// Which parts move, and how the one with the largest energy does; none if no part has any.
fn motion(shape: &[NodeShape], shares: &BTreeMap<String, f64>, is_rigid: bool) -> Option<String> {
    let mut parts: Vec<(&String, f64)> = shares.iter().map(|(part, share)| (part, *share)).collect();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let (first, most) = *parts.first().filter(|(_, share)| *share > 0.0)?;
    let listed = parts.iter().take_while(|(_, share)| *share >= NAMED.0 * most).take(NAMED.1);
    let listed: Vec<String> = listed.map(|(part, _)| format!("`{part}`")).collect();
    if is_rigid {
        return Some(format!("rigid motion of {}", listed.join(", ")));
    }
    let own: Vec<&NodeShape> = shape.iter().filter(|node| is_of(&node.node, first)).collect();
    let largest = |vector: fn(&NodeShape) -> Vector3| {
        own.iter().map(|node| vector(node)).max_by(|a, b| a.norm().total_cmp(&b.norm()))
    };
    let moved = largest(|node| Vector3::from(node.displacement.map(Complex64::norm)))?;
    let turned = largest(|node| Vector3::from(node.rotation.map(Complex64::norm)))?;
    let place = |node: &NodeShape| Vector3::from(node.position);
    let span = own.first().zip(own.last()).map_or_else(Vector3::zeros, |(a, b)| place(b) - place(a));
    let size = if span.norm() > 0.0 { span.norm() } else { 1.0 };
    let is_turning = ARM * size * turned.norm() > moved.norm();
    let apart =
        own.iter().skip(1).map(|node| (place(node) - place(own[0])).norm()).fold(f64::INFINITY, f64::min);
    if is_of_mesh(&own.first()?.node) && moved.norm() < DIRECTORS * apart * turned.norm() {
        return Some(format!("vibration of directors of {}", listed.join(", ")));
    }
    let line = span.try_normalize(0.0).map(|line| line.abs());
    let is_twisted = is_of_mesh(&own.first()?.node) && is_twisted(&own);
    let words = match line {
        _ if is_twisted => "torsion".to_owned(),
        Some(line) if is_turning && along(&turned, &line) => "torsion".to_owned(),
        Some(line) if along(&moved, &line) => "extension".to_owned(),
        Some(_) => format!("bending along {}", axis(&moved)),
        None if is_turning => format!("rotation about {}", axis(&turned)),
        None => format!("translation along {}", axis(&moved)),
    };
    let (kind, direction) = words.split_once(' ').unwrap_or((&words, ""));
    let direction = if direction.is_empty() { String::new() } else { format!(" {direction}") };
    Some(format!("{kind} of {}{direction}", listed.join(", ")))
}

/// Whether a node is one of a part.
fn is_of(node: &str, part: &str) -> bool {
    node.strip_prefix(part).is_some_and(|rest| rest.is_empty() || rest.starts_with(['@', '.']))
}

/// Whether sections across the longest axis of a part rotate about it more than they move otherwise.
fn is_twisted(own: &[&NodeShape]) -> bool {
    let place = |node: &NodeShape| Vector3::from(node.position);
    let moved = |node: &NodeShape| Vector3::from(node.displacement.map(|value| value.re));
    let mean = own.iter().map(|node| place(node)).sum::<Vector3>() / own.len() as f64;
    let spread: Matrix3 =
        own.iter().map(|node| (place(node) - mean) * (place(node) - mean).transpose()).sum();
    let axes = spread.symmetric_eigen();
    let axis: Vector3 = axes.eigenvectors.column(axes.eigenvalues.imax()).into();
    let along = |node: &NodeShape| (place(node) - mean).dot(&axis);
    let most = own.iter().map(|node| along(node).abs()).fold(0.0, f64::max);
    let mut sections = vec![Vec::new(); SECTIONS];
    for node in own {
        let fraction = 0.5 * (along(node) / most + 1.0);
        sections[((fraction * SECTIONS as f64) as usize).min(SECTIONS - 1)].push(*node);
    }
    let (mut turned, mut shifted) = (0.0, 0.0);
    for nodes in sections.iter().filter(|nodes| nodes.len() > 1) {
        let count = nodes.len() as f64;
        let middle = nodes.iter().map(|node| place(node)).sum::<Vector3>() / count;
        let shift = nodes.iter().map(|node| moved(node)).sum::<Vector3>() / count;
        let arm = |node: &NodeShape| axis.cross(&(place(node) - middle));
        let square: f64 = nodes.iter().map(|node| arm(node).norm_squared()).sum();
        let turning: f64 = nodes.iter().map(|node| arm(node).dot(&moved(node))).sum();
        turned += if square > 0.0 { turning * turning / square } else { 0.0 };
        shifted += count * shift.norm_squared();
    }
    turned > shifted
}

/// Whether a node of a part has a name as those of shells and solids: `part@u,v`, or `part@number`; that of beams is `part@s`.
fn is_of_mesh(node: &str) -> bool {
    node.rsplit_once('@').is_some_and(|(_, place)| place.contains(',') || !place.contains('.'))
}

fn along(vector: &Vector3, direction: &Vector3) -> bool {
    vector.dot(direction) > ALONG * vector.norm()
}

/// The axis along which a vector of magnitudes is, or the two or three with the largest parts of it.
fn axis(vector: &Vector3) -> String {
    let mut axes: Vec<(f64, &str)> = vector.iter().copied().zip(["x", "y", "z"]).collect();
    axes.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut square = 0.0;
    let mut named: Vec<&str> = Vec::new();
    for (size, axis) in axes {
        square += size * size;
        named.push(axis);
        if square > ALONG * ALONG * vector.norm_squared() {
            break;
        }
    }
    named.sort_unstable();
    named.join(" and ")
}

#[cfg(test)]
#[path = "../../../tests/unit/analyses/modes/names.rs"]
mod tests;
