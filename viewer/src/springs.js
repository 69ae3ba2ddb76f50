// Springs as coils, loads as arrows.

import * as THREE from "three";

import { placeRod } from "./joints.js";

const TURNS = 9;

/** A coil of length one along the second axis. */
class Coil extends THREE.Curve {
  constructor(radius) {
    super();
    this.radius = radius;
  }
  getPoint(t, out = new THREE.Vector3()) {
    const body = Math.min(Math.max((t - 0.08) / 0.84, 0), 1);
    const radius = this.radius * Math.min(1, 14 * Math.min(body, 1 - body));
    const angle = 2 * Math.PI * TURNS * body;
    return out.set(radius * Math.cos(angle), t - 0.5, radius * Math.sin(angle));
  }
}

/** Side and thickness of the plate at an end on the ground, relative to the model. */
const PLATE = [0.055, 0.009];

/** Plates at the ends on the ground, across the spring at the start. */
const plates = (ends, kinematics, size, theme, name) => {
  const found = new THREE.Group();
  ends.forEach((anchor, k) => {
    if (anchor.node !== 0) return;
    const [at, other] = [anchor, ends[1 - k]].map((end) => new THREE.Vector3(...kinematics.point(end)));
    const outward = at.clone().sub(other);
    if (outward.length() > 0) outward.normalize();
    else outward.copy(theme.up).negate();
    const [side, thickness] = PLATE.map((share) => share * size);
    const plate = new THREE.Mesh(new THREE.BoxGeometry(side, thickness, side), new THREE.MeshStandardMaterial({ color: theme.ground, roughness: 0.9 }));
    plate.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), outward);
    plate.position.copy(at).addScaledVector(outward, thickness / 2);
    plate.userData.part = name;
    found.add(plate);
  });
  return found;
};

export class SpringMesh {
  constructor(spring, kinematics, size, theme) {
    this.name = spring.name;
    this.kinematics = kinematics;
    this.ends = spring.anchors;
    this.material = new THREE.MeshStandardMaterial({ color: theme.spring, roughness: 0.4, metalness: 0.3 });
    const [a, b] = this.ends.map((anchor) => kinematics.point(anchor));
    const length = Math.hypot(...a.map((x, k) => x - b[k])) || size;
    // The wire is as thick along the spring as across it, at the length of the start.
    const wire = 0.0035 * size;
    const geometry = new THREE.TubeGeometry(new Coil(0.016 * size), 240, wire, 6);
    const places = geometry.attributes.position;
    const centre = new THREE.Vector3();
    const curve = new Coil(0.016 * size);
    for (let k = 0; k < places.count; k++) {
      curve.getPointAt(Math.floor(k / 7) / 240, centre);
      places.setY(k, centre.y + (places.getY(k) - centre.y) / length);
    }
    geometry.computeVertexNormals();
    this.coil = new THREE.Mesh(geometry, this.material);
    this.coil.frustumCulled = false;
    this.coil.userData.part = spring.name;
    this.mesh = new THREE.Group().add(this.coil, plates(this.ends, kinematics, size, theme, spring.name));
  }
  update() {
    placeRod(this.coil, this.kinematics.point(this.ends[0]), this.kinematics.point(this.ends[1]));
  }
}

/** Points of a cable. */
const POINTS = 33;

/** A cable, which hangs between its ends where it is slack: a parabola whose length is the free length. */
export class CableMesh {
  constructor(spring, kinematics, size, theme) {
    this.name = spring.name;
    this.kinematics = kinematics;
    this.ends = spring.anchors;
    this.free = spring.cable;
    this.up = theme.up;
    this.radius = 0.0022 * size;
    this.material = new THREE.MeshStandardMaterial({ color: theme.spring, roughness: 0.6 });
    this.mesh = new THREE.Group();
    const geometry = new THREE.CylinderGeometry(this.radius, this.radius, 1, 8);
    this.pieces = Array.from({ length: POINTS - 1 }, () => new THREE.Mesh(geometry, this.material));
    for (const piece of this.pieces) piece.userData.part = spring.name;
    this.mesh.add(...this.pieces, plates(this.ends, kinematics, size, theme, spring.name));
  }

  update() {
    const [a, b] = this.ends.map((anchor) => new THREE.Vector3(...this.kinematics.point(anchor)));
    const span = b.clone().sub(a);
    const distance = span.length();
    const slack = Math.max(this.free - distance, 0);
    // A shallow parabola of sag s over the chord d is longer by 8 s²/(3 d).
    const sag = slack > 1e-6 * distance ? Math.sqrt((3 / 8) * distance * slack) : 0;
    const down = this.up.clone().negate();
    // A vertical cable hangs to one side.
    const across = down.clone().addScaledVector(span, -down.dot(span) / Math.max(distance * distance, 1e-300));
    if (across.length() < 0.05) across.crossVectors(span, Math.abs(span.x) > 0.7 * distance ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(1, 0, 0));
    across.normalize();
    const at = (k) => {
      const s = k / (POINTS - 1);
      return a.clone().addScaledVector(span, s).addScaledVector(across, 4 * sag * s * (1 - s));
    };
    this.pieces.forEach((piece, k) => placeRod(piece, at(k), at(k + 1)));
  }
}

export class LoadArrow {
  constructor(load, kinematics, size, theme, span) {
    this.name = load.name;
    this.load = load;
    this.kinematics = kinematics;
    this.span = span;
    this.length = 0.16 * size;
    const colour = load.kind === "moment" ? theme.moment : theme.load;
    this.material = new THREE.MeshStandardMaterial({ color: colour, roughness: 0.4 });
    const r = 0.0045 * size;
    this.group = new THREE.Group();
    this.shaft = new THREE.Mesh(new THREE.CylinderGeometry(r, r, 1, 12), this.material);
    this.group.add(this.shaft);
    this.heads = Array.from({ length: load.kind === "moment" ? 2 : 1 }, () => {
      const head = new THREE.Mesh(new THREE.ConeGeometry(2.9 * r, 8 * r, 20), this.material);
      this.group.add(head);
      return head;
    });
    this.headLength = 8 * r;
    this.most = Math.max(...load.scale.map(Math.abs), 0) || 1;
    this.group.traverse((child) => (child.userData.part = load.name));
  }

  /** The factor of the load now. */
  factor() {
    const { scale } = this.load;
    if (scale.length === 0) return this.most;
    const [start, end] = this.span;
    const x = Math.min(Math.max((this.kinematics.time - start) / (end - start), 0), 1) * (scale.length - 1);
    const k = Math.min(Math.floor(x), scale.length - 2);
    return scale[k] + (x - k) * (scale[k + 1] - scale[k]);
  }

  update() {
    const { load, kinematics } = this;
    if (!load.vector) return void (this.group.visible = false);
    const direction = new THREE.Vector3(...load.vector);
    if (load.follower) {
      const q = kinematics.quaternions.subarray(4 * load.anchor.node, 4 * load.anchor.node + 4);
      direction.applyQuaternion(new THREE.Quaternion(...q));
    }
    const share = this.factor() / this.most;
    const norm = direction.length();
    this.group.visible = norm > 0 && Math.abs(share) > 1e-3;
    if (!this.group.visible) return;
    direction.multiplyScalar(Math.sign(share) / norm);
    const length = this.length * (0.25 + 0.75 * Math.abs(share));
    // The arrow of a force ends at the point it acts on, that of a moment begins there.
    const at = new THREE.Vector3(...kinematics.point(load.anchor));
    this.group.position.copy(at);
    this.group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), direction);
    const tip = load.kind === "moment" ? length : 0;
    this.shaft.scale.y = length - this.headLength;
    this.shaft.position.y = tip - this.headLength - this.shaft.scale.y / 2;
    this.heads.forEach((head, k) => (head.position.y = tip - this.headLength * (0.5 + 0.8 * k)));
  }
}

/** A force per length of a beam: arrows that end on its line. */
export class BeamLoad {
  constructor(load, kinematics, size, theme, span) {
    this.load = load;
    this.kinematics = kinematics;
    this.span = span;
    this.length = 0.08 * size;
    const material = new THREE.MeshStandardMaterial({ color: theme.load, roughness: 0.4 });
    const r = 0.0025 * size;
    this.headLength = 8 * r;
    this.most = Math.max(...load.vectors.flat().map((vector) => Math.hypot(...vector)), 0) || 1;
    this.group = new THREE.Group();
    this.arrows = load.anchors.map(() => {
      const arrow = new THREE.Group();
      const shaft = new THREE.Mesh(new THREE.CylinderGeometry(r, r, 1, 8), material);
      const head = new THREE.Mesh(new THREE.ConeGeometry(2.9 * r, this.headLength, 12), material);
      arrow.add(shaft, head);
      this.group.add(arrow);
      return { arrow, shaft, head };
    });
    this.group.traverse((child) => (child.userData.part = load.beam));
  }

  /** Forces per length at all places, now. */
  vectors() {
    const { vectors } = this.load;
    const [start, end] = this.span;
    const x = Math.min(Math.max((this.kinematics.time - start) / (end - start || 1), 0), 1) * (vectors.length - 1);
    const k = Math.max(Math.min(Math.floor(x), vectors.length - 2), 0);
    const next = vectors[Math.min(k + 1, vectors.length - 1)];
    return vectors[k].map((vector, at) => vector.map((value, i) => value + (x - k) * (next[at][i] - value)));
  }

  update() {
    const { load, kinematics } = this;
    const vectors = this.vectors();
    this.arrows.forEach(({ arrow, shaft, head }, k) => {
      const direction = new THREE.Vector3(...vectors[k]);
      const share = direction.length() / this.most;
      arrow.visible = share > 1e-3;
      if (!arrow.visible) return;
      direction.normalize();
      const { node } = load.anchors[k];
      if (load.follower) direction.applyQuaternion(new THREE.Quaternion(...kinematics.quaternions.subarray(4 * node, 4 * node + 4)));
      const length = this.length * (0.25 + 0.75 * share);
      arrow.position.set(...kinematics.point(load.anchors[k]));
      arrow.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), direction);
      shaft.scale.y = Math.max(length - this.headLength, 1e-3 * length);
      shaft.position.y = -this.headLength - shaft.scale.y / 2;
      head.position.y = -this.headLength / 2;
    });
  }
}
