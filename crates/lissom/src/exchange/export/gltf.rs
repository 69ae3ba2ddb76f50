//! glTF 2.0, the binary form `.glb`: the mechanism with its motion as one animation. Bodies and symbols belong to moving
//! nodes; a beam is a skin over its sections, a shell over its nodes, each of which moves rigidly, so that they are exact at every
//! frame.

use std::collections::BTreeMap;

use lissom_motion::{Motion as Pose, Vector3};
use serde_json::{Value, json};

use super::buffer::Buffer;
use super::{ExportError, Format, Sink, chosen_frames, poses};
use crate::motion::RecordedRun;
use crate::pictures::geometry::{Carrier, Colour, Geometry, Mesh, Normals, Piece, span, turn_to};
use crate::pictures::picture::shade_of;
use lissom_core::kinematics::NodeId;

pub(super) const FORMAT: Format = Format {
    name: "gltf",
    summary: "One animated scene (.glb) for Blender, browsers and presentations.",
    target: "motion.glb",
    is_folder: false,
    files: &[],
    write,
};

/// Position, rotation and length along the second axis of an object at every frame.
type Track = Vec<(Pose, f64)>;

/// A file under construction.
#[derive(Default)]
struct File {
    buffer: Buffer,
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    skins: Vec<Value>,
    materials: Vec<Value>,
    colours: Vec<Colour>,
    channels: Vec<Value>,
    samplers: Vec<Value>,
}

fn write(run: &RecordedRun, most: usize, sink: &mut Sink<'_>) -> Result<(), ExportError> {
    let motion = &run.motion;
    let frames = chosen_frames(motion, most);
    let Some(&first) = frames.first() else { return Err(ExportError::Empty) };
    let geometry = Geometry::new(&run.scene, motion, false);
    let all: Vec<Vec<Pose>> = frames.iter().map(|frame| poses(motion, *frame)).collect();
    let mut file = File::default();
    // In glTF y points upward.
    let up = Pose::new(turn_to(&geometry.up).inverse(), Vector3::zeros());
    let root = file.node("model", &(up, 1.0));
    let start = motion.times()[first];
    let times: Vec<f32> = frames.iter().map(|frame| (motion.times()[*frame] - start) as f32).collect();
    let clock = file.buffer.vectors(&times, 1, true, None);
    let mut carriers: BTreeMap<NodeId, usize> = BTreeMap::new();
    let mut on_top = vec![root];
    let mut carrier = |file: &mut File, node: NodeId| {
        *carriers.entry(node).or_insert_with(|| {
            let track: Track = all.iter().map(|poses| (poses[node], 1.0)).collect();
            file.moving(&motion.header().nodes[node.index()], &track, (root, clock))
        })
    };
    for piece in &geometry.pieces {
        let material = file.material(piece.colour);
        match &piece.carrier {
            Carrier::Node(node) => {
                let mesh = file.mesh(&piece.mesh, material);
                let child = file.holding(&piece.name, mesh);
                let carrier = carrier(&mut file, *node);
                file.child(carrier, child);
            }
            Carrier::Span(anchors) => {
                let mesh = file.mesh(&piece.mesh, material);
                let track: Track = all.iter().map(|poses| span(anchors, poses)).collect();
                let node = file.moving(&piece.name, &track, (root, clock));
                file.nodes[node]["mesh"] = json!(mesh);
            }
            Carrier::Sections(sweep) => {
                let at_frames: Vec<Vec<Pose>> = all.iter().map(|poses| sweep.sections(poses)).collect();
                let rest = sweep.sections(motion.reference());
                let bone = |k: usize| {
                    let track: Track = at_frames.iter().map(|sections| (sections[k], 1.0)).collect();
                    file.moving(&format!("{} {k}", piece.name), &track, (root, clock))
                };
                let bones: Vec<usize> = (0..rest.len()).map(bone).collect();
                let around = sweep.profiles()[0].len() as u32;
                on_top.push(file.skinned(piece, material, |point| point / around, (&bones, &rest, root)));
            }
            Carrier::Nodes(nodes) => {
                // Bones have numbers of 16 bits.
                if nodes.len() > usize::from(u16::MAX) {
                    return Err(ExportError::TooLarge);
                }
                let bones: Vec<usize> = nodes.iter().map(|node| carrier(&mut file, *node)).collect();
                let rest: Vec<Pose> = nodes.iter().map(|node| motion.reference()[*node]).collect();
                file.materials[material]["doubleSided"] = json!(true);
                on_top.push(file.skinned(piece, material, |point| point, (&bones, &rest, root)));
            }
            // Arrows of loads are drawn only in pictures.
            Carrier::Arrow(_) => {}
        }
    }
    let bytes = file.finish(&run.title, &on_top)?;
    Ok(sink("", &bytes)?)
}

fn floats(values: impl IntoIterator<Item = f64>) -> Vec<f32> {
    values.into_iter().map(|value| value as f32).collect()
}

/// Quaternion with the scalar last, as in glTF.
fn quaternion(pose: &Pose) -> [f64; 4] {
    let [w, x, y, z] = pose.rotation.quaternion();
    [x, y, z, w]
}

impl File {
    fn node(&mut self, name: &str, (pose, length): &(Pose, f64)) -> usize {
        let place: [f64; 3] = pose.position.into();
        self.nodes.push(json!({
            "name": name,
            "translation": floats(place),
            "rotation": floats(quaternion(pose)),
            "scale": floats([1.0, *length, 1.0]),
        }));
        self.nodes.len() - 1
    }

    /// A node that contains a mesh and moves with another one.
    fn holding(&mut self, name: &str, mesh: usize) -> usize {
        self.nodes.push(json!({ "name": name, "mesh": mesh }));
        self.nodes.len() - 1
    }

    fn child(&mut self, of: usize, child: usize) {
        match self.nodes[of].get_mut("children").and_then(Value::as_array_mut) {
            Some(children) => children.push(json!(child)),
            None => self.nodes[of]["children"] = json!([child]),
        }
    }

    /// A node that moves below another one.
    fn moving(&mut self, name: &str, track: &Track, (parent, clock): (usize, usize)) -> usize {
        let node = self.node(name, &track[0]);
        self.child(parent, node);
        if track.iter().all(|state| *state == track[0]) {
            return node;
        }
        let places = floats(track.iter().flat_map(|(pose, _)| <[f64; 3]>::from(pose.position)));
        self.channel(node, "translation", (&places, 3), clock);
        // A quaternion and its opposite are the same rotation: the sign closest to the previous one is chosen.
        let mut last = quaternion(&track[0].0);
        let mut turns = Vec::new();
        for (pose, _) in track {
            let next = quaternion(pose);
            let same: f64 = (0..4).map(|k| last[k] * next[k]).sum();
            last = if same < 0.0 { next.map(|part| -part) } else { next };
            turns.extend(last);
        }
        self.channel(node, "rotation", (&floats(turns), 4), clock);
        if track.iter().any(|state| state.1 != track[0].1) {
            let sizes = floats(track.iter().flat_map(|(_, length)| [1.0, *length, 1.0]));
            self.channel(node, "scale", (&sizes, 3), clock);
        }
        node
    }

    fn channel(&mut self, node: usize, path: &str, (values, size): (&[f32], usize), clock: usize) {
        let output = self.buffer.vectors(values, size, false, None);
        self.channels
            .push(json!({ "sampler": self.samplers.len(), "target": { "node": node, "path": path } }));
        self.samplers.push(json!({ "input": clock, "output": output, "interpolation": "LINEAR" }));
    }

    fn material(&mut self, colour: Colour) -> usize {
        if let Some(known) = self.colours.iter().position(|known| *known == colour) {
            return known;
        }
        // From screen values to linear light.
        let linear = |part: u8| (f64::from(part) / 255.0).powf(2.2);
        let [r, g, b] = shade_of(colour).map(linear);
        self.colours.push(colour);
        self.materials.push(json!({ "pbrMetallicRoughness": {
            "baseColorFactor": floats([r, g, b, 1.0]), "metallicFactor": 0.1, "roughnessFactor": 0.6 } }));
        self.materials.len() - 1
    }

    /// A mesh whose faces have their own points.
    fn mesh(&mut self, mesh: &Mesh, material: usize) -> usize {
        let (attributes, indices, _) = self.faces(mesh);
        self.meshes.push(json!({ "primitives": [
            { "attributes": attributes, "indices": indices, "material": material }] }));
        self.meshes.len() - 1
    }

    /// Attributes and triangles of faces, flat for a closed surface and round for an open one, and the point of the mesh for each
    /// vertex.
    fn faces(&mut self, mesh: &Mesh) -> (Value, usize, Vec<u32>) {
        let (mut places, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        let mut origins: Vec<u32> = Vec::new();
        let all = Normals::of(mesh);
        for (index, face) in mesh.faces.iter().enumerate() {
            let Some(own) = all.face(index) else { continue };
            let first = origins.len() as u32;
            for k in face {
                places.extend(<[f64; 3]>::from(mesh.points[*k as usize]));
                normals.extend(<[f64; 3]>::from(if mesh.is_open { all.at(*k, &own) } else { own }));
                origins.push(*k);
            }
            for k in 1..face.len() as u32 - 1 {
                triangles.extend([first, first + k, first + k + 1]);
            }
        }
        let position = self.buffer.vectors(&floats(places), 3, true, Some(34962));
        let normal = self.buffer.vectors(&floats(normals), 3, false, Some(34962));
        let indices = self.buffer.triangles(&triangles);
        (json!({ "POSITION": position, "NORMAL": normal }), indices, origins)
    }

    /// A piece as a skin: the bone for each of its points, and all bones with their poses in the mesh.
    fn skinned(
        &mut self,
        piece: &Piece,
        material: usize,
        bone_of: impl Fn(u32) -> u32,
        (bones, rest, root): (&[usize], &[Pose], usize),
    ) -> usize {
        let (mut attributes, indices, origins) = self.faces(&piece.mesh);
        let joints: Vec<u16> = origins.iter().map(|point| bone_of(*point) as u16).collect();
        let weights: Vec<f32> = origins.iter().flat_map(|_| [1.0, 0.0, 0.0, 0.0]).collect();
        attributes["JOINTS_0"] = json!(self.buffer.joints(&joints));
        attributes["WEIGHTS_0"] = json!(self.buffer.vectors(&weights, 4, false, Some(34962)));
        self.meshes.push(json!({ "primitives": [
            { "attributes": attributes, "indices": indices, "material": material }] }));
        let mesh = self.meshes.len() - 1;
        let mut bind = Vec::new();
        for pose in rest {
            let inverse = pose.inverse();
            let turn = inverse.rotation.matrix();
            // By columns.
            for column in 0..3 {
                bind.extend([turn[(0, column)], turn[(1, column)], turn[(2, column)], 0.0]);
            }
            bind.extend([inverse.position.x, inverse.position.y, inverse.position.z, 1.0]);
        }
        let bind = self.buffer.vectors(&floats(bind), 16, false, None);
        self.skins.push(json!({ "inverseBindMatrices": bind, "joints": bones, "skeleton": root }));
        // The position of a skin is determined by its bones only.
        self.nodes.push(json!({ "name": piece.name, "mesh": mesh, "skin": self.skins.len() - 1 }));
        self.nodes.len() - 1
    }

    /// The binary file.
    fn finish(mut self, title: &str, on_top: &[usize]) -> Result<Vec<u8>, ExportError> {
        self.buffer.bytes.resize(self.buffer.bytes.len().next_multiple_of(4), 0);
        let mut document = json!({
            "asset": { "version": "2.0", "generator": format!("Lissom {}", crate::VERSION), "extras": { "title": title } },
            "scene": 0,
            "scenes": [{ "nodes": on_top }],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials,
            "accessors": self.buffer.accessors,
            "bufferViews": self.buffer.views,
            "buffers": [{ "byteLength": self.buffer.bytes.len() }],
        });
        // Lists may not be empty.
        if !self.skins.is_empty() {
            document["skins"] = self.skins.into();
        }
        if !self.channels.is_empty() {
            document["animations"] =
                json!([{ "name": "motion", "channels": self.channels, "samplers": self.samplers }]);
        }
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let binary = self.buffer.bytes;
        let whole = u32::try_from(28 + text.len() + binary.len()).map_err(|_| ExportError::TooLarge)?;
        let mut bytes = Vec::with_capacity(whole as usize);
        bytes.extend(b"glTF");
        bytes.extend(2_u32.to_le_bytes());
        bytes.extend(whole.to_le_bytes());
        bytes.extend((text.len() as u32).to_le_bytes());
        bytes.extend(b"JSON");
        bytes.extend(text);
        bytes.extend((binary.len() as u32).to_le_bytes());
        bytes.extend(b"BIN\0");
        bytes.extend(binary);
        Ok(bytes)
    }
}
