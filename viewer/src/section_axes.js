// Axes of the sections of a beam at its nodes: 1 along the beam in red, 2 in green, 3 in blue, as the global axes.

import * as THREE from "three";

const COLOURS = ["#d1495b", "#2f9e63", "#3b74d9"];
/** Nodes with axes at most. */
const MAX_NODES = 24;

export class SectionAxes {
  /** Of the drawn beam, with arms of this length. */
  constructor(drawn, length) {
    [this.drawn, this.length] = [drawn, length];
    const count = drawn.beam.nodes.length;
    const stride = Math.ceil(count / MAX_NODES);
    this.nodes = Array.from({ length: Math.ceil(count / stride) }, (_, k) => k * stride);
    const colours = this.nodes.flatMap(() => COLOURS.flatMap((colour) => [...new THREE.Color(colour).toArray(), ...new THREE.Color(colour).toArray()]));
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(18 * this.nodes.length), 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(colours), 3));
    // They are seen within the beam, too.
    this.lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ vertexColors: true, depthTest: false }));
    this.lines.renderOrder = 2;
    this.lines.frustumCulled = false;
    this.lines.raycast = () => {};
  }

  update() {
    const { frames } = this.drawn;
    const { position } = this.lines.geometry.attributes;
    const turn = new THREE.Quaternion();
    const from = new THREE.Vector3();
    const arm = new THREE.Vector3();
    this.nodes.forEach((node, k) => {
      from.fromArray(frames, 7 * node);
      turn.fromArray(frames, 7 * node + 3);
      for (let axis = 0; axis < 3; axis++) {
        arm.set(0, 0, 0).setComponent(axis, this.length).applyQuaternion(turn).add(from);
        from.toArray(position.array, 18 * k + 6 * axis);
        arm.toArray(position.array, 18 * k + 6 * axis + 3);
      }
    });
    position.needsUpdate = true;
  }

  dispose() {
    this.lines.geometry.dispose();
    this.lines.material.dispose();
  }
}
