//! Coordinates without a position in space, with matrices of their own, which may be geared to a joint.

use super::{Maker, short};

impl Maker {
    /// Seldom, two generalised coordinates that swing, and matrices on them or on a coordinate of a joint.
    pub(super) fn oscillators(&mut self) {
        if !self.draw.chance(0.15) {
            return;
        }
        let start = [0, 1].map(|_| self.draw.between(-0.05, 0.05));
        self.tables.push(format!("[joints.own]\nkind = \"generalized_coordinates\"\nstart = {start:?}\n"));
        let masses = [0, 1].map(|_| self.draw.size(0.3, 3.0));
        let coupled = short(masses[0].min(masses[1]) * self.draw.between(-0.5, 0.5));
        let springs = [0, 1].map(|_| self.draw.size(10.0, 300.0));
        let between = self.draw.size(5.0, 100.0);
        let damping = match self.draw.below(3) {
            // Gyroscopic: it takes no energy.
            0 => "damping = [[0, 0.8], [-0.8, 0]]\n",
            1 => "damping = [0.4, 0.1]\n",
            _ => "",
        };
        self.is_conservative &= damping != "damping = [0.4, 0.1]\n";
        self.tables.push(format!(
            "[springs.own]\nkind = \"coordinate_dynamics\"\ncoordinates = [\"own\"]\n\
             mass = [[{}, {coupled}], [{coupled}, {}]]\n{damping}\
             stiffness = [[{}, {}], [{}, {}]]\n",
            masses[0],
            masses[1],
            short(springs[0] + between),
            -between,
            -between,
            short(springs[1] + between)
        ));
        for number in 1..=2 {
            // What is compared are positions.
            self.tables.push(format!(
                "[outputs.at_own{number}]\nkind = \"expression\"\nvalue = \"own.displacement{number}\"\n"
            ));
        }
        if self.coordinates.is_empty() {
            return;
        }
        if self.draw.chance(0.6) {
            let of = self.draw.of(&self.coordinates.clone());
            let ratio = self.draw.between(0.1, 0.6) * if self.draw.chance(0.5) { 1.0 } else { -1.0 };
            self.tables.push(format!(
                "[joints.geared]\nkind = \"equation\"\nequation = \"own.displacement1 - {} - {ratio}*{}.{}\"\n",
                start[0], of.joint, of.component
            ));
        }
        if self.draw.chance(0.4) {
            let of = self.draw.of(&self.coordinates.clone());
            let [mass, stiffness] = if of.is_angle {
                [self.draw.size(5e-3, 0.05), self.draw.size(0.2, 5.0)]
            } else {
                [self.draw.size(0.1, 1.0), self.draw.size(10.0, 200.0)]
            };
            self.tables.push(format!(
                "[springs.rotor]\nkind = \"coordinate_dynamics\"\ncoordinates = [\"{}.{}\"]\nmass = {mass}\nstiffness = {stiffness}\n",
                of.joint,
                if of.is_angle { of.component.replace("angle", "rotation") } else { of.component.to_owned() }
            ));
        }
    }
}
