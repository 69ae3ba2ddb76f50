// Reactions of joints as arrows: forces on the tip whose components are recorded in global axes.

import * as THREE from "three";

/** Length of the arrow of the largest reaction of the run, relative to the model. */
const LENGTH = 0.22;

export class Reactions {
  /** Arrows for those outputs of `scene` that are reactions with columns in the table. */
  constructor(scene, history, kinematics, size, colour) {
    [this.history, this.kinematics] = [history, kinematics];
    this.group = new THREE.Group();
    this.material = new THREE.MeshStandardMaterial({ color: colour, roughness: 0.4 });
    const r = 0.004 * size;
    this.head = 8 * r;
    const columnsOf = (name) => ["f1", "f2", "f3"].map((component) => history.columns.find((column) => column.name === `${name}.${component}`));
    this.arrows = scene.outputs
      .filter((output) => output.kind === "reaction" && output.is_global)
      .map(({ name, of }) => ({ of, columns: columnsOf(name), anchor: scene.joints.find((joint) => joint.name === of)?.anchors?.[1] }))
      .filter(({ columns, anchor }) => anchor && columns.every(Boolean));
    for (const arrow of this.arrows) {
      arrow.group = new THREE.Group();
      arrow.shaft = new THREE.Mesh(new THREE.CylinderGeometry(r, r, 1, 10), this.material);
      arrow.tip = new THREE.Mesh(new THREE.ConeGeometry(2.9 * r, this.head, 16), this.material);
      arrow.group.add(arrow.shaft, arrow.tip);
      for (const mesh of arrow.group.children) mesh.userData.part = arrow.of;
      this.group.add(arrow.group);
    }
    /** The largest force of the run [N], whose arrow has this length [m]. */
    this.most = 0;
    this.length = LENGTH * size;
    for (const { columns } of this.arrows) {
      const [x, y, z] = columns.map(({ values }) => values);
      x.forEach((_, row) => (this.most = Math.max(this.most, Math.hypot(x[row], y[row], z[row]))));
    }
    this.group.visible = false;
  }

  /** Shows the forces of a row of the table. */
  update(row) {
    if (!this.group.visible) return;
    for (const { columns, anchor, group, shaft, tip } of this.arrows) {
      const force = new THREE.Vector3(...columns.map(({ values }) => values[row]));
      const size = force.length();
      group.visible = size > 1e-6 * this.most;
      if (!group.visible) continue;
      const length = (this.length * size) / this.most;
      const head = Math.min(this.head, 0.6 * length);
      group.position.set(...this.kinematics.point(anchor));
      group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), force.divideScalar(size));
      [shaft.scale.y, shaft.position.y] = [length - head, (length - head) / 2];
      [tip.scale.y, tip.position.y] = [head / this.head, length - head / 2];
    }
  }
}
