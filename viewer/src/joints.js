// Joints as symbols: what turns is round about its axis, what slides lies along it. They sit on the base.

import * as THREE from "three";

import { Carried, rod } from "./bodies.js";

const along = new THREE.Vector3(0, 1, 0);

const directed = (mesh, axis) => {
  mesh.quaternion.setFromUnitVectors(along, new THREE.Vector3(...axis));
  return mesh;
};

const cylinder = (radius, length, material, axis) =>
  directed(new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, length, 24), material), axis);

const ring = (radius, tube, material, axis, arc = 2 * Math.PI) => {
  const geometry = new THREE.TorusGeometry(radius, tube, 10, 40, arc);
  geometry.rotateX(Math.PI / 2);
  return directed(new THREE.Mesh(geometry, material), axis);
};

const box = (x, y, z, material, axis) =>
  directed(new THREE.Mesh(new THREE.BoxGeometry(x, y, z), material), axis);

/** A dashed line through the origin. */
const axisLine = (axis, length, colour) => {
  const points = [-length, length].map((x) => new THREE.Vector3(...axis).multiplyScalar(x));
  const material = new THREE.LineDashedMaterial({ color: colour, dashSize: length / 8, gapSize: length / 12 });
  const line = new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), material);
  line.computeLineDistances();
  line.raycast = () => {};
  return line;
};

/** Symbols by kind: meshes about the origin. */
const symbols = {
  revolute: (r, m, [axis]) => [
    cylinder(0.62 * r, 1.5 * r, m.dark, axis),
    cylinder(0.95 * r, 0.7 * r, m.light, axis),
  ],
  spherical: (r, m) => [new THREE.Mesh(new THREE.SphereGeometry(0.85 * r, 28, 20), m.light)],
  universal: (r, m, [first, second]) => [
    cylinder(0.4 * r, 2.4 * r, m.light, first),
    cylinder(0.4 * r, 2.4 * r, m.dark, second),
  ],
  prismatic: (r, m, [axis]) => [box(1.3 * r, 2.2 * r, 1.3 * r, m.light, axis), box(0.55 * r, 4.6 * r, 0.55 * r, m.dark, axis)],
  cylindrical: (r, m, [axis]) => [cylinder(0.85 * r, 2 * r, m.light, axis), cylinder(0.4 * r, 4.6 * r, m.dark, axis)],
  clamp: (r, m) => [box(1.5 * r, 1.5 * r, 1.5 * r, m.dark, [0, 1, 0])],
  swing_arm: (r, m, [axis]) => [cylinder(0.75 * r, 1.2 * r, m.light, axis)],
};
const other = (r, m) => [new THREE.Mesh(new THREE.OctahedronGeometry(0.8 * r), m.light)];

export class JointSymbol extends Carried {
  constructor(joint, kinematics, size, theme) {
    super(joint.anchors[0].node, kinematics);
    this.name = joint.name;
    this.joint = joint;
    this.radius = Math.max(0.0135 * size, joint.around);
    this.materials = {
      light: new THREE.MeshStandardMaterial({ color: theme.joint, roughness: 0.4, metalness: 0.1 }),
      dark: new THREE.MeshStandardMaterial({ color: theme.pin, roughness: 0.5, metalness: 0.2 }),
    };
    this.holder = new THREE.Group();
    this.holder.position.set(...joint.anchors[0].position);
    this.group.add(this.holder);
    const draw = symbols[joint.kind] ?? other;
    const complete = joint.axes.length >= { revolute: 1, prismatic: 1, cylindrical: 1, swing_arm: 1, universal: 2 }[joint.kind];
    const isDrawn = draw === other || !(joint.kind in { revolute: 0, prismatic: 0, cylindrical: 0, swing_arm: 0, universal: 0 }) || complete;
    for (const mesh of (isDrawn ? draw : other)(this.radius, this.materials, joint.axes)) this.holder.add(mesh);
    this.lines = joint.axes.map((axis) => axisLine(axis, 4.2 * this.radius, theme.axis));
    this.lines.forEach((line) => this.holder.add(line));
    if (joint.anchors[0].node === 0) this.addGround(theme);
    this.holder.traverse((child) => (child.userData.part = joint.name));
    const [a, b] = joint.anchors;
    this.link = null;
    if (["distance", "swing_arm", "rigid_link"].includes(joint.kind)) {
      this.link = rod([0, 0, 0], [0, 1, 0], 0.35 * this.radius, this.materials.dark);
      this.link.userData.part = joint.name;
      this.ends = [a, b];
    }
  }

  /** A plinth under what is held by the ground. */
  addGround(theme) {
    const r = this.radius;
    const material = new THREE.MeshStandardMaterial({ color: theme.ground, roughness: 0.9 });
    const plinth = new THREE.Mesh(new THREE.CylinderGeometry(0.55 * r, 1.75 * r, 1.9 * r, 4, 1), material);
    plinth.geometry.rotateY(Math.PI / 4);
    plinth.quaternion.setFromUnitVectors(along, theme.up);
    plinth.position.copy(theme.up).multiplyScalar(-1.15 * r);
    this.holder.add(plinth);
  }

  /** An arrow about the axis of a joint that is driven. */
  addDrive(drive, theme) {
    const [axis] = this.joint.axes;
    if (!axis) return;
    const r = this.radius;
    const material = new THREE.MeshStandardMaterial({ color: theme.drive, roughness: 0.4 });
    const symbol = new THREE.Group();
    if (drive.kind === "prescribed_displacement") {
      const shaft = new THREE.Mesh(new THREE.CylinderGeometry(0.18 * r, 0.18 * r, 4 * r, 12), material);
      const head = new THREE.Mesh(new THREE.ConeGeometry(0.5 * r, 1.2 * r, 16), material);
      head.position.y = 2.4 * r;
      symbol.add(shaft, head);
    } else {
      const arc = new THREE.Mesh(new THREE.TorusGeometry(2 * r, 0.16 * r, 10, 40, 1.5 * Math.PI), material);
      const head = new THREE.Mesh(new THREE.ConeGeometry(0.45 * r, 1.1 * r, 16), material);
      head.position.set(0.3 * r, -2 * r, 0);
      head.rotation.z = -Math.PI / 2;
      const flat = new THREE.Group();
      flat.add(arc, head);
      flat.rotation.x = -Math.PI / 2;
      symbol.add(flat);
    }
    symbol.quaternion.setFromUnitVectors(along, new THREE.Vector3(...axis));
    this.holder.add(symbol);
    symbol.traverse((child) => (child.userData.part = drive.name));
  }

  update() {
    super.update();
    if (this.link) placeRod(this.link, this.kinematics.point(this.ends[0]), this.kinematics.point(this.ends[1]));
  }
}

/** Lays a rod of length one between two points. */
export const placeRod = (mesh, from, to) => {
  const [a, b] = [new THREE.Vector3(...from), new THREE.Vector3(...to)];
  const span = b.clone().sub(a);
  const length = Math.max(span.length(), 1e-12);
  mesh.position.copy(a.add(b).multiplyScalar(0.5));
  mesh.quaternion.setFromUnitVectors(along, span.divideScalar(length));
  mesh.scale.set(1, length, 1);
};

export { ring };
