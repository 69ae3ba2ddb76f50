// The ground below the model: a grid that follows the camera and fades out around its target, and the shadow of the model.

import * as THREE from "three";

import { Shadow } from "./shadow.js";

/** Cells from the middle of the grid to its edge, and parts of a line between which it fades. */
const CELLS = 14;
const PARTS = 14;

/** Lines of cells of length one in the plane z = 0, which fade out from half the distance to the edge. */
const lines = () => {
  const [points, colours] = [[], []];
  const add = (x, y) => {
    const share = Math.min(Math.max((Math.hypot(x, y) / CELLS - 0.4) / 0.6, 0), 1);
    points.push(x, y, 0);
    colours.push(1, 1, 1, 1 - share * share * (3 - 2 * share));
  };
  for (let line = -CELLS; line <= CELLS; line++) {
    for (let part = 0; part < PARTS; part++) {
      const [from, to] = [part, part + 1].map((end) => CELLS * ((2 * end) / PARTS - 1));
      for (const [a, b] of [[from, line], [line, from]].map(([x, y], k) => [[x, y], k === 0 ? [to, y] : [x, to]])) {
        add(...a);
        add(...b);
      }
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 4));
  const grid = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }));
  grid.raycast = () => {};
  grid.frustumCulled = false;
  grid.renderOrder = -2;
  return grid;
};

/** A round length that divides the length seen into five to twelve cells. */
const cellOf = (seen) => {
  const cell = 10 ** Math.floor(Math.log10(seen / 2));
  return seen / cell > 12 ? 2 * cell : cell;
};

export class Ground {
  constructor(renderer) {
    this.group = new THREE.Group();
    this.shadow = new Shadow(renderer);
    this.grid = lines();
    this.group.add(this.shadow.plane, this.grid);
  }

  /** Sets the heights of the ground and of the lowest part, the size of the model and the colours. */
  dress({ up, height, lowest, size, theme }) {
    this.grid.material.color.set(theme.grid);
    this.grid.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), up);
    [this.up, this.height] = [up, height];
    this.shadow.place({ up, height: Math.max(height, lowest), size, opacity: theme.shadow });
  }

  /** Moves the grid below the camera's target, of which this length is seen. */
  follow(target, seen) {
    const { grid, up } = this;
    this.cell = cellOf(seen);
    const across = target.clone().applyQuaternion(grid.quaternion.clone().invert());
    const snapped = across.divideScalar(this.cell).round().multiplyScalar(this.cell).setZ(0);
    grid.position.copy(snapped.applyQuaternion(grid.quaternion)).addScaledVector(up, this.height);
    grid.scale.setScalar(this.cell);
  }
}
