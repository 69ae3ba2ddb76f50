//! Bearings between bodies that rotate, and struts of variable length between two points.

use super::{Maker, short, triple};

impl Maker {
    /// A bearing between two nodes, whose forces follow no energy.
    pub(super) fn bearing(&mut self) {
        let [a, b] = [0, 1].map(|_| self.draw.below(self.nodes.len()));
        if a == b || !self.draw.chance(0.1) {
            return;
        }
        self.is_conservative = false;
        let name = format!("p{}", self.tables.len());
        let pair = format!("base = \"{}\"\ntip = \"{}\"\n", self.nodes[a].name, self.nodes[b].name);
        let k = self.draw.size(20.0, 300.0);
        let (cross, damping) = (short(0.1 * k), short(0.02 * k));
        self.tables.push(if self.draw.chance(0.5) {
            format!(
                "[springs.{name}]\nkind = \"bearing\"\n{pair}stiffness = [[{k}, {cross}], [-{cross}, {k}]]\n\
                 damping = {damping}\nk23 = \"{damping}*speed\"\n"
            )
        } else {
            format!(
                "[springs.{name}]\nkind = \"journal_bearing\"\n{pair}at_base = {}\nradius = 0.5\nlength = 0.5\nclearance = 0.5\n\
                 viscosity = {k}\n",
                triple(self.nodes[b].place)
            )
        });
    }

    /// A rod between two nodes with a spring along it.
    pub(super) fn strut(&mut self) {
        let [a, b] = [0, 1].map(|_| self.draw.below(self.nodes.len()));
        if a == b || self.nodes[b].name == "ground" || !self.draw.chance(0.1) {
            return;
        }
        let (base, tip) = (self.nodes[a].name.clone(), self.nodes[b].name.clone());
        let name = format!("j{}", self.tables.len());
        let stiffness = self.draw.size(20.0, 300.0);
        self.tables.push(format!(
            "[joints.{name}]\nkind = \"telescopic_rod\"\nbase = \"{base}\"\ntip = \"{tip}\"\n\
             [springs.{name}]\nkind = \"axial\"\njoint = \"{name}\"\nstiffness = {stiffness}\n"
        ));
    }
}
