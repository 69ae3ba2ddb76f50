//! Pictures of a simulation at its present state, from a view that does not depend on the motion.

use lissom_core::simulation::Simulation;
use lissom_model::output::Image;
use lissom_model::scene::Scene;
use lissom_model::{Document, Report};
use lissom_motion::{Motion as Pose, Vector3};

use super::depth_image::depth_image;
use super::paint::Paint;
use super::view::{Projection, View};
use crate::motion::{Motion, MotionRecorder};
use crate::pictures::geometry::{Carrier, Colour, Geometry};
use crate::start::lower_with_units;

/// Default length of the shorter side of a picture, relative to the model at its start.
const AROUND: f64 = 1.5;

/// Direction and section of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Framing {
    /// Direction of view.
    pub view: View,
    /// Width and height [pixels].
    pub size: [u32; 2],
    /// Position in the middle of the picture [m]; by default the middle of the model at its start.
    pub center: Option<Vector3>,
    /// Length of the shorter side of the picture [m]; by default 1.5 times the model at its start.
    pub extent: Option<f64>,
}

/// A model to be drawn at states of its simulations.
pub struct Camera {
    geometry: Geometry,
    center: Vector3,
    extent: f64,
}

impl Camera {
    /// For a model.
    ///
    /// # Errors
    /// If the model is invalid.
    ///
    /// # Panics
    /// If the positions of its start are not finite, which a valid model excludes.
    pub fn of(document: &Document) -> Result<Self, Report> {
        let lowered = lower_with_units(document)?;
        let (scene, start) = (Scene::of(document, &lowered.placed()), &lowered.state.kinematics);
        let mut bytes = Vec::new();
        let written = MotionRecorder::new(&lowered, None, &mut bytes).write_still(start);
        written.expect("memory accepts all bytes");
        let motion = Motion::from_bytes(&bytes).expect("the start is finite");
        let mut geometry = Geometry::new(&scene, &motion, true);
        // Loads are sampled until the end of the analysis, which a simulation may leave.
        geometry.pieces.retain(|piece| !matches!(piece.carrier, Carrier::Arrow(_)));
        let poses: Vec<Pose> = start.nodes.iter().map(|node| node.frame).collect();
        let (mut low, mut high) = (geometry.low, geometry.high);
        for piece in geometry.pieces.iter().filter(|piece| piece.colour != Colour::Ground) {
            for point in piece.at(&poses, start.time).iter().flat_map(|mesh| &mesh.points) {
                (low, high) = (low.inf(point), high.sup(point));
            }
        }
        Ok(Self { geometry, center: 0.5 * (low + high), extent: AROUND * (high - low).norm() })
    }

    /// The present state of a simulation of the model. The forces of loads are not drawn.
    pub fn image(&self, simulation: &Simulation, framing: &Framing) -> Image {
        let now = &simulation.state().kinematics;
        let poses: Vec<Pose> = now.nodes.iter().map(|node| node.frame).collect();
        let projection = Projection::of(&self.geometry, framing.view);
        let center = projection.flat(&framing.center.unwrap_or(self.center));
        let half = framing.size.map(|side| 0.5 * f64::from(side));
        let scale = 2.0 * half[0].min(half[1]) / framing.extent.unwrap_or(self.extent);
        let place =
            |[x, y]: &[f64; 2]| [half[0] + (x - center[0]) * scale, half[1] - (y - center[1]) * scale];
        depth_image((&self.geometry, &Paint::default(), &projection), (&poses, now.time), framing.size, place)
    }
}
