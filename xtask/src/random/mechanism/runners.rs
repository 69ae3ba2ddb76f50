//! Parts that run along others: a body that slides along a beam, wheels and balls on a plane.

use super::{Maker, Node, short, triple};

impl Maker {
    /// At times, where there is a beam, a body that slides along it and is pulled by a spring.
    pub(super) fn bead(&mut self) {
        let Some((beam, start, end)) = self.beams.first().cloned() else { return };
        if !self.draw.chance(0.3) {
            return;
        }
        let part = self.draw.between(0.3, 0.7);
        let place = [0, 1, 2].map(|k| short(start[k] + part * (end[k] - start[k])));
        let (name, _) = self.body(93, place);
        self.tables
            .push(format!("[joints.slide]\nkind = \"slider\"\nbeams = [\"{beam}\"]\ntip = \"{name}\"\n"));
        self.pulled(&name);
        self.nodes.push(Node { name, place });
    }

    /// Seldom, a ball or a disc that rolls on a plane of the ground and is pulled by a spring.
    pub(super) fn wheel(&mut self) {
        if !self.draw.chance(0.08) {
            return;
        }
        let Wheel { name, place, at, normal, shape } = self.on_plane(90, true);
        let creep = self.draw.of(&["", "", "creep = 1e-4\n"]);
        self.is_conservative &= creep.is_empty();
        self.tables.push(format!(
            "[joints.floor]\nkind = \"rolling\"\nbase = \"ground\"\ntip = \"{name}\"\nat = {at}\naxis = {normal}\n{shape}{creep}"
        ));
        self.pulled(&name);
        self.nodes.push(Node { name, place });
    }

    /// Seldom, a disc that slips on a plane which yields.
    pub(super) fn slipping_wheel(&mut self) {
        if !self.draw.chance(0.08) {
            return;
        }
        self.is_conservative = false;
        let Wheel { name, place, at, normal, shape } = self.on_plane(94, false);
        let (stiffness, friction) = (self.draw.size(500.0, 5000.0), self.draw.between(0.1, 0.6));
        self.tables.push(format!(
            "[springs.ground]\nkind = \"rolling_contact\"\nbase = \"ground\"\ntip = \"{name}\"\nat_base = {at}\n\
             normal = {normal}\n{shape}stiffness = {stiffness}\ndissipation = 0.5\nfriction_coefficient = {friction}\n\
             slip_velocity = 0.05\n"
        ));
        self.pulled(&name);
        self.nodes.push(Node { name, place });
    }

    /// A body above a plane against gravity, as a disc that touches it or, where its axis may lie across the plane, a ball.
    fn on_plane(&mut self, number: usize, may_be_ball: bool) -> Wheel {
        let falls = |tables: &[String], along: &str| tables.iter().any(|table| table.contains(along));
        let mut normal = if falls(&self.tables, "[0, -9.81, 0]") { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
        for part in &mut normal {
            *part = short(*part + self.draw.between(-0.2, 0.2));
        }
        let length = normal.iter().map(|part| part * part).sum::<f64>().sqrt();
        let height = self.draw.between(0.1, 0.4);
        let at = [0, 1, 2].map(|_| self.draw.between(-0.5, 0.5));
        let place = [0, 1, 2].map(|k| short(at[k] + height * normal[k] / length));
        let (name, _) = self.body(number, place);
        let shape = if self.draw.chance(0.5) && may_be_ball {
            format!(
                "wheel_axis = {}\nradius = 0\nrim = {:.12}\n",
                triple(normal),
                distance(place, at, normal)
            )
        } else {
            let across = self.draw.perpendicular(normal);
            let lean = self.draw.between(-0.2, 0.2);
            let axis = [0, 1, 2].map(|k| short(across[k] + lean * normal[k]));
            format!("wheel_axis = {}\nrim = {}\n", triple(axis), self.draw.of(&["0", "0.02"]))
        };
        Wheel { name, place, at: triple(at), normal: triple(normal), shape }
    }
}

/// A wheel: its node and the keys that define where it touches.
struct Wheel {
    name: String,
    place: [f64; 3],
    at: String,
    normal: String,
    shape: String,
}

/// Distance of a position from the plane through a point.
fn distance(place: [f64; 3], at: [f64; 3], normal: [f64; 3]) -> f64 {
    let length = normal.iter().map(|part| part * part).sum::<f64>().sqrt();
    (0..3).map(|k| (place[k] - at[k]) * normal[k]).sum::<f64>() / length
}
