// Rigid bodies as the boxes or ellipsoids that have their inertia, with arms to the points where something is attached.

import * as THREE from "three";

/** Sides of boxes are drawn at least this large, relative to the model. */
const LEAST = 0.003;
/** Boxes whose second side is so many times the reach of the attachments are those of inertias that are not a solid's. */
const BULKY = 2.5;

const up = new THREE.Vector3(0, 1, 0);

/** A thin rod between two points. */
export const rod = (from, to, radius, material) => {
  const [a, b] = [new THREE.Vector3(...from), new THREE.Vector3(...to)];
  const span = b.clone().sub(a);
  const length = span.length();
  const mesh = new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, length, 12), material);
  mesh.position.copy(a.add(b).multiplyScalar(0.5));
  if (length > 0) mesh.quaternion.setFromUnitVectors(up, span.divideScalar(length));
  return mesh;
};

/** Cosine of the greatest angle [36°] between triangles whose common edge is round. */
const ROUND = 0.81;

/** Triangles with edges between them, where their angle is not that of a round surface. */
const surface = ({ points, triangles }) => {
  const normal = new THREE.Vector3();
  const edge = new THREE.Vector3();
  const at = points.map((point) => new THREE.Vector3(...point));
  const normals = triangles.map(([a, b, c]) => normal.subVectors(at[b], at[a]).cross(edge.subVectors(at[c], at[a])).normalize().clone());
  // Files repeat the points of every triangle.
  const keys = points.map((point) => point.join());
  const around = new Map(keys.map((key) => [key, []]));
  triangles.forEach((corners, k) => corners.forEach((corner) => around.get(keys[corner]).push(normals[k])));
  const smooth = triangles.flatMap((corners, k) =>
    corners.flatMap((corner) => {
      normal.set(0, 0, 0);
      for (const other of around.get(keys[corner])) if (other.dot(normals[k]) > ROUND) normal.add(other);
      return normal.normalize().toArray();
    }),
  );
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(triangles.flat().flatMap((corner) => points[corner]), 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(smooth, 3));
  return geometry;
};

/** Triangles of every colour of a surface, those in the colour of their part first. */
const byColour = ({ points, triangles, colours = [] }) => {
  const own = new Set(colours.flatMap(({ first, count }) => Array.from({ length: count }, (_, k) => first + k)));
  const painted = colours.map(({ first, count, shade }) => ({ points, triangles: triangles.slice(first, first + count), shade }));
  return [{ points, triangles: triangles.filter((_, k) => !own.has(k)) }, ...painted].filter((each) => each.triangles.length > 0);
};

/** Something that moves with a node. */
export class Carried {
  constructor(node, kinematics) {
    this.node = node;
    this.kinematics = kinematics;
    this.group = new THREE.Group();
  }
  update() {
    const { positions: p, quaternions: q } = this.kinematics;
    this.group.position.set(p[3 * this.node], p[3 * this.node + 1], p[3 * this.node + 2]);
    this.group.quaternion.set(...q.subarray(4 * this.node, 4 * this.node + 4));
  }
}

export class BodyMesh extends Carried {
  constructor(body, anchors, kinematics, size, colour, shape) {
    super(body.node, kinematics);
    this.name = body.name;
    this.material = new THREE.MeshStandardMaterial({ color: colour, roughness: 0.6, metalness: 0.05 });
    /** Materials of colours that the model names. */
    this.painted = [];
    if (body.surface) {
      for (const each of byColour(body.surface)) this.group.add(new THREE.Mesh(surface(each), this.materialOf(each)));
      const { center } = body.shape;
      // Points of attachment beyond the surface hang on arms.
      const within = new THREE.Box3().setFromPoints(body.surface.points.map((point) => new THREE.Vector3(...point))).expandByScalar(0.02 * size);
      for (const at of anchors) {
        if (!within.containsPoint(new THREE.Vector3(...at))) this.group.add(rod(center, at, 0.0055 * size, this.material));
      }
      this.group.traverse((child) => (child.userData.part = body.name));
      return;
    }
    const { center, sides, quaternion } = body.shape;
    const reach = Math.max(...anchors.map((at) => Math.hypot(...at.map((x, k) => x - center[k]))), 0);
    // Inertias far bulkier than what the body reaches, as of models in a plane, must not hide all else.
    const usual = reach > 0.02 * size ? reach : 0.375 * size;
    const [, second] = sides.toSorted((a, b) => b - a);
    this.isShrunk = second > BULKY * usual;
    const share = this.isShrunk ? (0.28 * usual) / second : 1;
    const least = LEAST * size;
    const drawn = sides.map((side) => Math.max(share * side, least));
    const geometry =
      shape === "ellipsoid" ? new THREE.SphereGeometry(Math.sqrt(5 / 12), 32, 20) : new THREE.BoxGeometry(1, 1, 1);
    const mesh = new THREE.Mesh(geometry, this.material);
    mesh.scale.set(...drawn);
    mesh.position.set(...center);
    const [w, x, y, z] = quaternion;
    mesh.quaternion.set(x, y, z, w);
    this.group.add(mesh);
    for (const at of anchors) {
      if (Math.hypot(...at.map((x, k) => x - center[k])) > 0.5 * least) {
        this.group.add(rod(center, at, 0.0055 * size, this.material));
      }
    }
    this.group.traverse((child) => (child.userData.part = body.name));
  }

  /** The material of triangles: of a colour of their own, or that of the part. */
  materialOf({ shade }) {
    if (!shade) return this.material;
    const material = this.material.clone();
    material.color.setRGB(...shade.map((part) => part / 255), THREE.SRGBColorSpace);
    this.painted.push(material);
    return material;
  }

  paint(colourAt, own) {
    // Without light, so that colours are those of the legend.
    this.plain ??= new THREE.MeshBasicMaterial();
    this.group.traverse((child) => {
      const isOwn = child.material === this.material || this.painted?.includes(child.material);
      if (isOwn && colourAt) [child.lit, child.material] = [child.material, this.plain];
      else if (child.material === this.plain && !colourAt) child.material = child.lit;
    });
    if (!colourAt) return void this.material.color.set(own);
    const colour = [0, 0, 0];
    colourAt(colour);
    this.plain.color.setRGB(...colour, THREE.LinearSRGBColorSpace);
  }
}

export class PointMassMesh extends Carried {
  constructor(mass, heaviest, kinematics, size, colour) {
    super(mass.node, kinematics);
    this.name = mass.name;
    this.material = new THREE.MeshStandardMaterial({ color: colour, roughness: 0.5 });
    const radius = size * (0.012 + 0.016 * Math.cbrt(mass.mass / heaviest));
    const mesh = new THREE.Mesh(new THREE.SphereGeometry(radius, 28, 18), this.material);
    mesh.userData.part = mass.name;
    this.group.add(mesh);
  }
}
PointMassMesh.prototype.paint = BodyMesh.prototype.paint;
