//! Shares of nodes in what is spread over them.

use std::collections::{BTreeSet, HashMap};

use crate::kinds::face::area_shares;
use crate::parts::meshed_part::MeshedPart;

/// Whether all of some nodes are among those that are wanted.
type IsIn<'a> = dyn Fn(&[usize]) -> bool + 'a;
/// Adds the shares of nodes.
type Add<'a> = dyn FnMut(&[usize], &[f64]) + 'a;

impl MeshedPart {
    /// Share of each of these nodes in something that is spread over them; the sum is 1. By volume where the nodes span solid elements,
    /// otherwise by area of quadrilaterals or outer faces, otherwise by length of their sides, otherwise alike. Shares in faces of second
    /// order are those of a uniform force per area, and so those of corners are zero or negative.
    pub fn shares(&self, nodes: &[usize]) -> Vec<f64> {
        let sizes = self.sizes(nodes);
        let whole: f64 = sizes.iter().sum();
        sizes.into_iter().map(|size| size / whole).collect()
    }

    fn sizes(&self, nodes: &[usize]) -> Vec<f64> {
        let index: HashMap<usize, usize> = nodes.iter().enumerate().map(|(k, &node)| (node, k)).collect();
        let mut sizes = vec![0.0; nodes.len()];
        for collect in [Self::by_elements, Self::by_faces, Self::by_sides] {
            let mut is_known = false;
            collect(self, &|own| own.iter().all(|node| index.contains_key(node)), &mut |own, shares| {
                own.iter().zip(shares).for_each(|(node, share)| sizes[index[node]] += share);
                is_known = true;
            });
            if is_known {
                return sizes;
            }
        }
        vec![1.0; nodes.len()]
    }

    fn by_elements(&self, is_in: &IsIn<'_>, add: &mut Add<'_>) {
        for own in self.elements.iter().filter(|own| is_in(&own.nodes)) {
            let p = self.positions_of(&own.nodes);
            match own.shape.solid_kind() {
                Some((kind, _)) => add(&own.nodes, &kind.shares(&p).unwrap_or_default()),
                None => add(&own.nodes, &[0.125 * (p[2] - p[0]).cross(&(p[3] - p[1])).norm(); 4]),
            }
        }
    }

    fn by_faces(&self, is_in: &IsIn<'_>, add: &mut Add<'_>) {
        for face in self.faces.iter().filter(|face| is_in(face)) {
            add(face, &area_shares(&self.positions_of(face)));
        }
    }

    fn by_sides(&self, is_in: &IsIn<'_>, add: &mut Add<'_>) {
        let mut seen = BTreeSet::new();
        let surface = self.elements.iter().map(|own| &own.nodes).filter(|_| self.faces.is_empty());
        for face in surface.chain(&self.faces) {
            let corners = if self.faces.is_empty() { face.len() } else { face.len() / 2 };
            for i in 0..corners {
                let ends = [face[i], face[(i + 1) % corners]];
                let length = (self.positions[ends[1]] - self.positions[ends[0]]).norm();
                let is_new = |side: &[usize], seen: &mut BTreeSet<[usize; 2]>| {
                    is_in(side) && seen.insert([ends[0].min(ends[1]), ends[0].max(ends[1])])
                };
                match face.get(corners + i) {
                    Some(&middle) if is_new(&[ends[0], middle, ends[1]], &mut seen) => {
                        let shares = [1.0, 4.0, 1.0].map(|share| share * length / 6.0);
                        add(&[ends[0], middle, ends[1]], &shares);
                    }
                    None if is_new(&ends, &mut seen) => add(&ends, &[0.5 * length; 2]),
                    _ => {}
                }
            }
        }
    }
}
