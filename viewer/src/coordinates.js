// Coordinates of joints over the motion: angles and displacements along the axis since the configuration of the model file.

import * as THREE from "three";

/** Which coordinates joints of a kind have. */
const KINDS = { revolute: ["angle"], prismatic: ["displacement"], cylindrical: ["angle", "displacement"], screw: ["angle", "displacement"] };

/** Pose of a node in a frame; without a frame in the model file. */
const poseOf = ({ nodes, reference, displacements, rotations }, node, frame) => {
  const place = new THREE.Vector3().fromArray(reference, 7 * node);
  const [w, x, y, z] = reference.subarray(7 * node + 3, 7 * node + 7);
  const turned = new THREE.Quaternion(x, y, z, w);
  if (frame === undefined) return { place, turned };
  const at = 3 * (frame * nodes.length + node);
  const vector = new THREE.Vector3().fromArray(rotations, at);
  const angle = vector.length();
  if (angle > 0) turned.premultiply(new THREE.Quaternion().setFromAxisAngle(vector.divideScalar(angle), angle));
  return { place: place.add(new THREE.Vector3().fromArray(displacements, at)), turned };
};

/** Rotation and position of the tip of a joint in the frame of its base. */
const relative = (motion, anchors, frame) => {
  const [base, tip] = anchors.map(({ node, position }) => {
    const { place, turned } = poseOf(motion, node, frame);
    return { turned, at: new THREE.Vector3(...position).applyQuaternion(turned).add(place) };
  });
  const inverse = base.turned.clone().invert();
  return { turned: inverse.clone().multiply(tip.turned), at: tip.at.sub(base.at).applyQuaternion(inverse) };
};

/** The coordinates of a joint, or of the joint that is driven: names and values in all frames. None of other kinds. */
export const coordinatesOf = (part, joints, motion) => {
  const joint = part.joint ? joints.find(({ name }) => name === part.joint) : part;
  const names = (joint?.anchors && KINDS[joint.kind]) ?? [];
  if (names.length === 0) return [];
  const axis = new THREE.Vector3(...joint.axes[0]);
  const first = relative(motion, joint.anchors);
  const back = first.turned.clone().invert();
  const values = { angle: new Float64Array(motion.frames), displacement: new Float64Array(motion.frames) };
  for (let frame = 0; frame < motion.frames; frame++) {
    const { turned, at } = relative(motion, joint.anchors, frame);
    const { x, y, z, w } = turned.multiply(back);
    const angle = 2 * Math.atan2(axis.x * x + axis.y * y + axis.z * z, w);
    // Turns are counted from frame to frame.
    const before = frame > 0 ? values.angle[frame - 1] : 0;
    values.angle[frame] = angle + 2 * Math.PI * Math.round((before - angle) / (2 * Math.PI));
    values.displacement[frame] = at.sub(first.at).dot(axis);
  }
  return names.map((name) => ({ name, values: values[name] }));
};
