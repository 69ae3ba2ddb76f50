//! Orientation of a surface: neighbours run along their common edge in opposite directions.

use std::collections::VecDeque;

use crate::edges::{edges, shared};
use crate::mesh::Mesh;

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
mod tests {
    use crate::fault::MeshFaultKind;
    use crate::obj;

    const STRIP: &str = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 1 0\n";

    #[test]
    fn the_smaller_part_is_flipped() {
        let mut mesh = obj::read(&format!("{STRIP}f 6 5 1 2\nf 2 6 7 3\nf 3 7 8\nf 3 4 8\n")).expect("valid");
        let before = mesh.clone();
        assert_eq!(mesh.orient(), 2);
        assert!(mesh.surface_faults().is_empty());
        assert_eq!(mesh.elements[1].nodes, [1, 2, 6, 5]);
        assert_eq!([&mesh.elements[0], &mesh.elements[3]], [&before.elements[0], &before.elements[3]]);
        assert_eq!(mesh.orient(), 0);
        // The first element is the only opposite one.
        let mut mesh = obj::read(&format!("{STRIP}f 1 5 6 2\nf 2 3 7 6\nf 3 4 8 7\n")).expect("valid");
        assert_eq!(mesh.orient(), 1);
        assert_eq!(mesh.elements[0].nodes, [0, 1, 5, 4]);
    }

    #[test]
    fn a_strip_with_one_side_remains_with_a_fault() {
        let text = format!("{STRIP}f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 5 1 8\n");
        let mut mesh = obj::read(&text).expect("valid");
        mesh.orient();
        let is_opposite = |kind| kind == MeshFaultKind::OppositeOrientation;
        assert_eq!(mesh.surface_faults().iter().filter(|fault| is_opposite(fault.kind)).count(), 1);
    }
}
