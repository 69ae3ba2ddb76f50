// Forces as arrows: reactions of joints and of contacts on the tip, in global axes, forces of springs and resultants of local loads, as
// recorded in the table.

import * as THREE from "three";

/** Length of the arrow of the largest force of the run, relative to the model. */
const LENGTH = 0.22;
/** Axis of the joint's base that is normal to the surface of contact, by kind. */
const NORMALS = { rolling: 0, wheel_on_rail: 1 };

/** A direction in the axes of a node, in global axes. */
const carried = (kinematics, { node, position }, direction) => {
  const [from, to] = [kinematics.point({ node, position }), kinematics.point({ node, position: position.map((x, k) => x + direction[k]) })];
  return new THREE.Vector3(...to.map((x, k) => x - from[k]));
};

/**
 * Where the line of action of a force meets a plane through `base`: the contact. The moment [N m] is about `point`, at which a
 * force along the plane is drawn.
 */
const contactPoint = (point, force, moment, base, normal) => {
  const onLine = force.clone().cross(moment).divideScalar(force.lengthSq()).add(point);
  const slope = force.dot(normal);
  if (Math.abs(slope) < 1e-3 * force.length()) return point;
  return onLine.addScaledVector(force, base.clone().sub(onLine).dot(normal) / slope);
};

export class Reactions {
  /** Arrows for those outputs of a model that are forces with columns in the table. */
  constructor(model, history, kinematics, size, colour) {
    const { scene } = model;
    [this.history, this.kinematics] = [history, kinematics];
    this.group = new THREE.Group();
    // Within wheels and beams arrows would be hidden.
    this.material = new THREE.MeshStandardMaterial({ color: colour, roughness: 0.4, depthTest: false });
    const r = 0.004 * size;
    this.head = 8 * r;
    const columnsOf = (name, components) => components.map((component) => history.columns.find((column) => column.name === `${name}.${component}`));
    const kinds = {
      reaction: (output) => this.ofJoint(output, scene, columnsOf),
      spring: (output) => this.ofSpring(output, scene, columnsOf),
      contact_force: (output) => this.ofContact(output, columnsOf),
      local_load: (output) => this.ofLocalLoad(output, scene, columnsOf),
    };
    const arrowOf = (output) => {
      const arrow = kinds[output.kind]?.(output);
      return arrow && { ...arrow, of: output.of, key: model.keyOf(output) };
    };
    this.arrows = scene.outputs.map(arrowOf).filter((arrow) => arrow?.columns.every(Boolean));
    for (const arrow of this.arrows) {
      arrow.group = new THREE.Group();
      arrow.shaft = new THREE.Mesh(new THREE.CylinderGeometry(r, r, 1, 10), this.material);
      arrow.tip = new THREE.Mesh(new THREE.ConeGeometry(2.9 * r, this.head, 16), this.material);
      arrow.group.add(arrow.shaft, arrow.tip);
      for (const mesh of arrow.group.children) {
        mesh.userData.part = arrow.key;
        mesh.renderOrder = 1;
      }
      this.group.add(arrow.group);
    }
    /** The largest force of the run [N], whose arrow has this length [m]. */
    this.most = 0;
    this.length = LENGTH * size;
    for (const { columns, count } of this.arrows) {
      const values = columns.slice(0, count).map((column) => column.values);
      values[0].forEach((_, row) => (this.most = Math.max(this.most, Math.hypot(...values.map((each) => each[row])))));
    }
    this.group.visible = false;
  }

  /** The reaction of a joint, at its tip or where wheel and surface touch. */
  ofJoint({ name, of, is_global: isGlobal }, scene, columnsOf) {
    const joint = scene.joints.find((each) => each.name === of);
    if (!isGlobal || !joint?.anchors) return null;
    const [base, tip] = joint.anchors;
    const forces = columnsOf(name, ["f1", "f2", "f3"]);
    const force = (row) => new THREE.Vector3(...forces.map(({ values }) => values[row]));
    const at = () => new THREE.Vector3(...this.kinematics.point(tip));
    const normal = joint.axes[NORMALS[joint.kind]];
    if (!normal) return { columns: forces, count: 3, force, at };
    const moments = columnsOf(name, ["m1", "m2", "m3"]);
    const moment = (row) => new THREE.Vector3(...moments.map(({ values }) => values[row]));
    // Moments are about the origin of the node that carries the wheel.
    const centre = () => new THREE.Vector3(...this.kinematics.point({ node: tip.node, position: [0, 0, 0] }));
    const contact = (row) => contactPoint(centre(), force(row), moment(row), new THREE.Vector3(...this.kinematics.point(base)), carried(this.kinematics, base, normal));
    return { columns: [...forces, ...moments], count: 3, force, at: contact };
  }

  /** The force of a contact on its tip, at the centre of the normal forces. */
  ofContact({ name }, columnsOf) {
    const columns = columnsOf(name, ["f1", "f2", "f3", "x1", "x2", "x3"]);
    const vector = (first, row) => new THREE.Vector3(...columns.slice(first, first + 3).map(({ values }) => values[row]));
    return { columns, count: 3, force: (row) => vector(0, row), at: (row) => vector(3, row) };
  }

  /** The resultant of a local load: at its node, or at that of its beam which is nearest to the line of action. */
  ofLocalLoad({ name, of }, scene, columnsOf) {
    const load = scene.loads.find((each) => each.name === of && each.kind.endsWith("local_load"));
    if (!load) return null;
    const beam = load.kind === "distributed_local_load" && scene.beams.find((each) => each.name === load.part);
    const anchors = beam ? beam.nodes.map((node) => ({ node, position: [0, 0, 0] })) : [load.anchor];
    const columns = columnsOf(name, ["f1", "f2", "f3", "m1", "m2", "m3"]);
    const vector = (first, row) => new THREE.Vector3(...columns.slice(first, first + 3).map(({ values }) => values[row]));
    const at = (row) => {
      const [force, moment] = [vector(0, row), vector(3, row)];
      // The moment is about the origin; its part along the force is the same about all points.
      const apart = (point) => moment.clone().sub(point.clone().cross(force)).length();
      const points = anchors.map((anchor) => new THREE.Vector3(...this.kinematics.point(anchor)));
      return points.reduce((best, point) => (apart(point) < apart(best) ? point : best));
    };
    return { columns, count: 3, force: (row) => vector(0, row), at };
  }

  /** The force of a spring on its tip: along the line between its ends, or along the axis of the joint on which it acts. */
  ofSpring({ name, of }, scene, columnsOf) {
    const spring = scene.springs.find((each) => each.name === of);
    const joint = scene.joints.find((each) => each.name === spring?.joint);
    const columns = columnsOf(name, ["force"]);
    const tension = (row) => columns[0].values[row];
    const point = (anchor) => new THREE.Vector3(...this.kinematics.point(anchor));
    if (spring?.anchors && spring.kind === "point") {
      const [base, tip] = spring.anchors;
      return { columns, count: 1, at: () => point(tip), force: (row) => point(base).sub(point(tip)).normalize().multiplyScalar(tension(row)) };
    }
    if (!joint?.anchors || joint.kind !== "prismatic") return null;
    const [base, tip] = joint.anchors;
    return { columns, count: 1, at: () => point(tip), force: (row) => carried(this.kinematics, base, joint.axes[0]).multiplyScalar(-tension(row)) };
  }

  /** Shows the forces of a row of the table. */
  update(row) {
    if (!this.group.visible) return;
    for (const arrow of this.arrows) {
      const { group, shaft, tip } = arrow;
      const force = arrow.force(row);
      const size = force.length();
      group.visible = size > 1e-6 * this.most;
      if (!group.visible) continue;
      const length = (this.length * size) / this.most;
      const head = Math.min(this.head, 0.6 * length);
      group.position.copy(arrow.at(row));
      group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), force.divideScalar(size));
      [shaft.scale.y, shaft.position.y] = [length - head, (length - head) / 2];
      [tip.scale.y, tip.position.y] = [head / this.head, length - head / 2];
    }
  }
}
