//! Orientation of a surface: neighbours run along their common edge in opposite directions.

use std::collections::VecDeque;

use crate::mesh::Mesh;
use crate::surface::edges::{edges, shared};

impl Mesh {
    /// Flips triangles and quadrilaterals until neighbours agree, and returns the number of flipped ones. Of each
    /// connected surface the smaller part is flipped; of equal parts the one without its first element. Edges of more
    /// than two elements do not connect. A surface with one side only, such as a Möbius strip, keeps some edges where
    /// neighbours disagree.
    pub fn orient(&mut self) -> usize {
        let mut neighbours: Vec<Vec<(usize, bool)>> = vec![Vec::new(); self.elements.len()];
        for own in shared(&edges(self)) {
            if let [first, second] = own
                && first.element != second.element
            {
                let agree = first.is_forward != second.is_forward;
                neighbours[first.element].push((second.element, agree));
                neighbours[second.element].push((first.element, agree));
            }
        }
        // Whether an element agrees with the first one of its surface.
        let mut agrees: Vec<Option<bool>> = vec![None; self.elements.len()];
        let mut flipped = 0;
        for start in 0..self.elements.len() {
            if agrees[start].is_some() {
                continue;
            }
            agrees[start] = Some(true);
            let (mut queue, mut surface) = (VecDeque::from([(start, true)]), Vec::new());
            while let Some((element, own)) = queue.pop_front() {
                surface.push((element, own));
                for &(neighbour, agree) in &neighbours[element] {
                    if agrees[neighbour].is_none() {
                        agrees[neighbour] = Some(own == agree);
                        queue.push_back((neighbour, own == agree));
                    }
                }
            }
            let opposite = surface.iter().filter(|(_, own)| !own).count();
            let wanted = 2 * opposite <= surface.len();
            for (element, _) in surface.into_iter().filter(|(_, own)| *own != wanted) {
                // The first node remains the first.
                self.elements[element].nodes[1..].reverse();
                flipped += 1;
            }
        }
        flipped
    }
}

#[cfg(test)]
#[path = "../../tests/unit/surface/orientation.rs"]
mod tests;
