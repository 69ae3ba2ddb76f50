// Joints, springs and loads by the symbols that the scene gives them: solids that nodes carry, rods between two places.

import * as THREE from "three";

import { Carried, rod } from "./bodies.js";

const along = new THREE.Vector3(0, 1, 0);

/** Geometries of the forms, by their sizes in multiples of the radius; their axis is the second one. */
const forms = {
  cylinder: ([radius, length]) => new THREE.CylinderGeometry(radius, radius, length, 24),
  cone: ([radius, length]) => new THREE.ConeGeometry(radius, length, 20),
  ball: ([radius]) => new THREE.SphereGeometry(radius, 28, 20),
  block: ([width, length, depth]) => new THREE.BoxGeometry(width, length, depth),
  ring: ([radius, tube]) => new THREE.TorusGeometry(radius, tube, 10, 40).rotateX(Math.PI / 2),
  octahedron: ([radius]) => new THREE.OctahedronGeometry(radius),
};

/** Colours of the theme by what solids are coloured as. */
const tones = { light: "joint", dark: "pin", drive: "drive", spring: "spring", stop: "stop", load: "load", moment: "moment" };

/** A dashed line through the origin. */
const axisLine = (axis, length, colour) => {
  const points = [-length, length].map((x) => new THREE.Vector3(...axis).multiplyScalar(x));
  const material = new THREE.LineDashedMaterial({ color: colour, dashSize: length / 8, gapSize: length / 12 });
  const line = new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), material);
  line.computeLineDistances();
  line.raycast = () => {};
  return line;
};

/** Radius of a symbol that sections of this half thickness do not hide. */
const radiusOf = (around, size) => Math.max(0.0135 * size, Math.min(1.45 * around, 0.04 * size));

/** Turns the second axis of a solid to `axis`, and the first one to `side`; without a side by the shortest way. */
const orient = (mesh, axis, side) => {
  if (!side) return mesh.quaternion.setFromUnitVectors(along, axis);
  const first = new THREE.Vector3(...side);
  return mesh.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(first, axis, first.clone().cross(axis)));
};

/** A symbol that one node carries. */
class Symbol extends Carried {
  constructor(symbol, kinematics, size, theme) {
    super(symbol.anchor.node, kinematics);
    this.radius = symbol.unit ?? radiusOf(symbol.around, size);
    this.holder = new THREE.Group();
    this.holder.position.set(...symbol.anchor.position);
    this.group.add(this.holder);
    for (const { form, size: sizes, place, axis, side, tone } of symbol.solids) {
      const geometry = forms[form](sizes.map((length) => length * this.radius));
      const metalness = tone === "dark" ? 0.2 : 0.1;
      const material = new THREE.MeshStandardMaterial({ color: theme[tones[tone]], roughness: 0.45, metalness });
      const mesh = new THREE.Mesh(geometry, material);
      mesh.position.set(...place).multiplyScalar(this.radius);
      orient(mesh, new THREE.Vector3(...axis), side);
      this.holder.add(mesh);
    }
  }

  /** Dashed lines along the axes of a joint. */
  addAxes(axes, theme) {
    for (const axis of axes) this.holder.add(axisLine(axis, 4.2 * this.radius, theme.axis));
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
}

/** Kinds of joints that slide along their first axis. */
const SLIDING = ["prismatic", "cylindrical"];
/** Half length of the symbol of such a joint, width of its rail, and side and thickness of the plates at the ends, in its radii. */
const [REACH, RAIL, PLATE, THICKNESS] = [2.3, 0.4, 2.2, 0.35];

/** The rail on the ground along which a joint slides over the motion, with a plate at each end; none if it does not leave its symbol, or another part comes across. */
const rail = ({ anchors: [base, tip], axes: [axis] }, kinematics, r, theme) => {
  const direction = new THREE.Vector3(...axis);
  const [least, most] = kinematics.slide([base, tip], axis);
  if (Math.max(-least, most) < REACH * r) return null;
  const [low, high] = [Math.min(least, 0) - REACH * r, Math.max(most, 0) + REACH * r];
  // Along a connecting rod its plates would look like collars.
  if (kinematics.crosses([base, tip], axis, { ends: [low, high], width: PLATE * r, away: 2 * REACH * r })) return null;
  const found = new THREE.Group();
  const add = (sides, place, color) => {
    const mesh = new THREE.Mesh(new THREE.BoxGeometry(...sides), new THREE.MeshStandardMaterial({ color, roughness: 0.8 }));
    mesh.position.y = place;
    found.add(mesh);
  };
  add([RAIL * r, high - low, RAIL * r], (low + high) / 2, theme.pin);
  for (const end of [low, high]) add([PLATE * r, THICKNESS * r, PLATE * r], end, theme.ground);
  found.position.set(...base.position);
  found.quaternion.setFromUnitVectors(along, direction);
  return found;
};

/** All symbols and the rod of a joint, spring or load. */
export class Symbols {
  constructor(part, { symbols, rods }, kinematics, size, theme) {
    this.name = part.name;
    this.kinematics = kinematics;
    this.group = new THREE.Group();
    this.anchor = symbols[0]?.anchor ?? null;
    this.symbols = symbols.map((symbol) => new Symbol(symbol, kinematics, size, theme));
    for (const symbol of this.symbols) this.group.add(symbol.group);
    const [first] = this.symbols;
    // What rolls on the ground is no support.
    const isSchematic = first && symbols[0].unit === undefined;
    if (isSchematic && part.axes) first.addAxes(part.axes, theme);
    const isOnGround = isSchematic && part.axes && part.anchors?.[0].node === 0;
    if (isOnGround) first.addGround(theme);
    const way = isOnGround && SLIDING.includes(part.kind) ? rail(part, kinematics, first.radius, theme) : null;
    if (way) this.group.add(way);
    const material = new THREE.MeshStandardMaterial({ color: theme.pin, roughness: 0.5, metalness: 0.2 });
    this.rods = rods.map(({ anchors, radius = 0.35 * radiusOf(0, size) }) => {
      const mesh = rod([0, 0, 0], [0, 1, 0], radius, material);
      this.group.add(mesh);
      return { mesh, anchors };
    });
    this.group.traverse((child) => (child.userData.part = part.name));
  }

  update() {
    for (const symbol of this.symbols) symbol.update();
    for (const { mesh, anchors } of this.rods) placeRod(mesh, ...anchors.map((anchor) => this.kinematics.point(anchor)));
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
