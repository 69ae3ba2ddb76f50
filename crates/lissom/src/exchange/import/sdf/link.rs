//! Links of SDF: their mass, shapes and sensors.

use lissom_motion::Motion;

use super::super::{
    ImportError, Link, LinkInertia, Measured, MotionKind, Sensor, Visual, VisualShape, WeightCompensation,
};
use super::element::Element;
use super::{Body, Reader, shape};

impl Reader<'_> {
    /// A link with its mass and shapes; what is wrong with it becomes an obstacle.
    pub(super) fn link(&mut self, number: usize, poses: &[Motion]) -> Link {
        let Body { element, frame, around } = self.links[number];
        let (scope, index) = (self.frames.all[frame].scope, self.robot.links.len());
        let inertia = self.robot.keep(inertia(element)).flatten();
        let mut link = Link::new(self.name(frame), inertia, element.source.clone());
        if inertia.is_some()
            && element.child("gravity").is_some()
            && self.robot.keep(element.flag("gravity")) == Some(false)
        {
            self.robot.compensations.push(WeightCompensation { link: index, share: 1.0 });
        }
        let collides = if element.child("self_collide").is_some() {
            self.robot.keep(element.flag("self_collide")).unwrap_or(false)
        } else {
            around.collides
        };
        let group = around.model.filter(|_| !collides);
        let origin = |own: &Element| -> Result<Motion, ImportError> {
            let (pose, base) = own.pose()?;
            let base = base.map_or(Ok(frame), |base| self.frames.required(scope, base, own))?;
            Ok(poses[frame].inverse() * poses[base] * pose)
        };
        for own in element.children.iter().filter(|child| is_inertial_unit(child)) {
            let Some(frame) = self.robot.keep(origin(own)) else { continue };
            let name = format!("{} {}", link.name, own.attribute("name").unwrap_or("imu"));
            for (word, kind) in
                [("gyro", MotionKind::OwnAngularVelocity), ("acceleration", MotionKind::SpecificForce)]
            {
                let quantity = Measured::Motion { kind, link: index, frame };
                self.robot.sensors.push(Sensor { name: format!("{name} {word}"), quantity });
            }
        }
        for own in element.children.iter().filter(|child| child.tag == "visual") {
            let read = origin(own).and_then(|origin| shape::shape(own, origin));
            // What only draws is no reason to read nothing.
            match read {
                Ok(shape) => link.visuals.extend(shape),
                Err(error) => self.robot.left_out.push(format!("a <visual>: {}", error.message)),
            }
        }
        for own in element.children.iter().filter(|child| child.tag == "collision") {
            let read = origin(own).and_then(|origin| shape::shape(own, origin));
            let Some(read) = self.robot.keep(read) else { continue };
            let Some(touch) = self.robot.keep(shape::touch(own, group)) else { continue };
            let shape = read.filter(|own| !matches!(own.shape, VisualShape::Mesh { .. }));
            self.surfaces += usize::from(shape::has_other_properties(own));
            match (shape, touch) {
                (Some(mut shape), Some(touch)) => {
                    shape.touch = Some(touch);
                    // A shape that is also drawn is one shape.
                    let is_same = |other: &&mut Visual| {
                        other.shape == shape.shape && other.origin == shape.origin && other.touch.is_none()
                    };
                    match link.visuals.iter_mut().find(is_same) {
                        Some(same) => same.touch = Some(touch),
                        None => link.visuals.push(shape),
                    }
                }
                (Some(shape), None) => link.collisions.push(shape),
                (None, Some(_)) => self.robot.left_out.push(format!(
                    "the touches of {}, a mesh or another shape that cannot touch",
                    own.words()
                )),
                (None, None) => {}
            }
            let bounce = own
                .within(&["surface", "bounce"])
                .map_or(Ok(0.0), |own| own.number("restitution_coefficient", 0.0));
            if self.robot.keep(bounce).is_some_and(|value| value > 0.0) {
                self.robot.unsupported.push(format!("the restitution of {}", own.words()));
            }
        }
        link
    }
}

/// The mass of a link, which is 1 kg with 1 kg m² about each axis unless it is given.
fn inertia(link: &Element) -> Result<Option<LinkInertia>, ImportError> {
    let unit = Element::default();
    let own = link.child("inertial").unwrap_or(&unit);
    if own.attribute("auto").is_some_and(|word| matches!(word, "true" | "1")) {
        return Err(own.fault("inertia from shapes (`auto`) is not supported: write mass and inertia"));
    }
    if let Some(added) = own.child("fluid_added_mass")
        && added.children.iter().any(|entry| entry.text.parse() != Ok(0.0))
    {
        return Err(added.fault("added mass of a fluid is not supported: remove it"));
    }
    let (pose, base) = own.pose()?;
    if let Some(base) = base {
        return Err(
            own.fault(format!("its pose cannot be relative to `{base}`: it is in the frame of the link"))
        );
    }
    let mass = own.number("mass", 1.0)?;
    if mass < 0.0 {
        return Err(own.fault(format!("its mass is negative, {mass} kg")));
    }
    let tensor = own.child("inertia").unwrap_or(&unit);
    let of = |tag: &str, default: f64| tensor.number(tag, default);
    let entries = [
        of("ixx", 1.0)?,
        of("iyy", 1.0)?,
        of("izz", 1.0)?,
        of("ixy", 0.0)?,
        of("ixz", 0.0)?,
        of("iyz", 0.0)?,
    ];
    Ok(LinkInertia::placed(mass, entries, &pose))
}

/// Whether an element is a sensor of angular velocity and acceleration.
pub(super) fn is_inertial_unit(element: &Element) -> bool {
    element.tag == "sensor" && element.attribute("type") == Some("imu")
}
