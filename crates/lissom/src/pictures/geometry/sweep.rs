//! Beams as sections that are swept along the line between the nodes: a cubic whose ends follow the first axes of the
//! sections, with linear taper between stations, as drawn by the page.

use lissom_model::scene::{Beam, Outline};
use lissom_motion::{Motion as Pose, Rotation, Vector3};

use super::mesh::Mesh;
use lissom_core::kinematics::NodeId;

/// Number of points of round outlines.
const ROUND: usize = 20;
/// Minimum number of sections with which a beam is drawn.
const RINGS: usize = 40;

/// A beam that can be drawn at any poses of the nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    nodes: Vec<NodeId>,
    /// Section frames in the frames of the nodes.
    offsets: Vec<Pose>,
    /// Lengths between the nodes in the configuration of the model file [m].
    lengths: Vec<f64>,
    /// Number of sections between two nodes.
    parts: usize,
    /// Fraction of the beam at every section.
    places: Vec<f64>,
    /// Outline at every section in its axes 2 and 3 [m].
    profiles: Vec<Vec<[f64; 2]>>,
}

impl Sweep {
    /// A beam of a model whose nodes have the poses `reference` in the configuration of the model file. The minimum half
    /// thickness of its sections is `least` [m].
    pub fn new(beam: &Beam, reference: &[Pose], least: f64) -> Self {
        let mut offsets = vec![Pose::identity(); beam.nodes.len()];
        for (index, position, quaternion) in &beam.offsets {
            let rotation = Rotation::from_quaternion(*quaternion).unwrap_or_default();
            offsets[*index] = Pose::new(rotation, Vector3::from(*position));
        }
        let place = |index: usize| (reference[beam.nodes[index]] * offsets[index]).position;
        let segments = beam.nodes.len() - 1;
        let lengths = (0..segments).map(|k| (place(k + 1) - place(k)).norm()).collect();
        let parts = RINGS.div_ceil(segments).clamp(1, 16);
        let places: Vec<f64> = (0..=segments * parts)
            .map(|ring| {
                let segment = (ring / parts).min(segments - 1);
                let u = ring as f64 / parts as f64 - segment as f64;
                beam.places[segment] + u * (beam.places[segment + 1] - beam.places[segment])
            })
            .collect();
        let is_sharp =
            beam.stations.iter().all(|station| matches!(station.outline, Outline::Rectangle { .. }));
        let outlines: Vec<Vec<[f64; 2]>> =
            beam.stations.iter().map(|station| outline(&station.outline, is_sharp, least)).collect();
        let profile = |s: &f64| {
            let last = beam.stations.len() - 1;
            let after = beam.stations.iter().position(|station| station.at >= s - 1e-12).unwrap_or(last);
            let before = after.saturating_sub(1);
            let span = beam.stations[after].at - beam.stations[before].at;
            let x = if span > 0.0 { (s - beam.stations[before].at) / span } else { 0.0 };
            let between = |(a, b): (&[f64; 2], &[f64; 2])| [0, 1].map(|k| a[k] + x * (b[k] - a[k]));
            outlines[before].iter().zip(&outlines[after]).map(between).collect()
        };
        let profiles = places.iter().map(profile).collect();
        Self { nodes: beam.nodes.clone(), offsets, lengths, parts, places, profiles }
    }

    /// Fraction of the beam at every section, ascending.
    pub fn places(&self) -> &[f64] {
        &self.places
    }

    /// Outline at every section in its axes 2 and 3 [m].
    pub fn profiles(&self) -> &[Vec<[f64; 2]>] {
        &self.profiles
    }

    /// Frames of all sections for these poses of the nodes.
    pub fn sections(&self, poses: &[Pose]) -> Vec<Pose> {
        let frames: Vec<Pose> =
            self.nodes.iter().zip(&self.offsets).map(|(node, offset)| poses[*node] * *offset).collect();
        let segments = self.lengths.len();
        let section = |ring: usize| {
            let segment = (ring / self.parts).min(segments - 1);
            let u = ring as f64 / self.parts as f64 - segment as f64;
            let (a, b) = (&frames[segment], &frames[segment + 1]);
            let tangent = |frame: &Pose| frame.rotation.apply(&Vector3::x()) * self.lengths[segment];
            let (u2, u3) = (u * u, u * u * u);
            let position = a.position * (2.0 * u3 - 3.0 * u2 + 1.0)
                + tangent(a) * (u3 - 2.0 * u2 + u)
                + b.position * (3.0 * u2 - 2.0 * u3)
                + tangent(b) * (u3 - u2);
            Pose::new(between(&a.rotation, &b.rotation, u), position)
        };
        (0..self.places.len()).map(section).collect()
    }

    /// The surface for these poses of the nodes, section by section.
    pub fn mesh(&self, poses: &[Pose]) -> Mesh {
        let rings: Vec<Vec<Vector3>> = (self.sections(poses).iter())
            .zip(&self.profiles)
            .map(|(frame, profile)| {
                profile.iter().map(|[y, z]| frame.transform_point(&Vector3::new(0.0, *y, *z))).collect()
            })
            .collect();
        Mesh::of_rings(&rings)
    }
}

/// The rotation at a fraction between two, along the chord of their quaternions.
pub(super) fn between(a: &Rotation, b: &Rotation, share: f64) -> Rotation {
    let (p, q) = (a.quaternion(), b.quaternion());
    let same: f64 = (0..4).map(|k| p[k] * q[k]).sum();
    let sign = if same < 0.0 { -1.0 } else { 1.0 };
    let mean: [f64; 4] = std::array::from_fn(|k| (1.0 - share) * p[k] + share * sign * q[k]);
    Rotation::from_quaternion(mean).unwrap_or(*a)
}

/// Points of an outline, counterclockwise about axis 1.
fn outline(outline: &Outline, is_sharp: bool, least: f64) -> Vec<[f64; 2]> {
    let (half, center, is_rectangle) = match *outline {
        Outline::Rectangle { width, height } => ([0.5 * width, 0.5 * height], [0.0; 2], true),
        Outline::Circle { radius, .. } => ([radius; 2], [0.0; 2], false),
        Outline::Ellipse { width, height, center } => ([width, height], center, false),
    };
    let [a, b] = half.map(|half| half.max(least));
    if is_sharp {
        return vec![[a, b], [-a, b], [-a, -b], [a, -b]];
    }
    let point = |k: usize| {
        let (s, c) = (std::f64::consts::TAU * k as f64 / ROUND as f64).sin_cos();
        let out = if is_rectangle { 1.0 / c.abs().max(s.abs()) } else { 1.0 };
        [center[0] + a * c * out, center[1] + b * s * out]
    };
    (0..ROUND).map(point).collect()
}
