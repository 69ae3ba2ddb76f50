// What solids alone can be coloured by: numbers recorded at the nodes of their surface.

import { FieldFrames } from "./field_frames.js";
import { field, lazily } from "./shell_fields.js";

/** Names, units and functions of the recorded numbers from a place on. */
const QUANTITIES = [
  ["von Mises stress of solids", "Pa", (numbers, at) => numbers[at]],
  ["strain energy per volume", "J/m³", (numbers, at) => numbers[at + 1] ** 2],
];

class SolidValues {
  constructor(solid, kinematics, recorded) {
    this.recorded = recorded;
    this.frames = new FieldFrames(kinematics, recorded);
    // Nodes of the surface are recorded in ascending order.
    const nodes = solid.elements.flat();
    const places = new Map([...new Set(nodes)].sort((a, b) => a - b).map((node, place) => [node, place]));
    this.places = Int32Array.from(nodes, (node) => places.get(node));
    this.corners = new Float64Array(nodes.length);
  }

  /** A quantity at the corners of the surface, now. */
  of(value) {
    const { places, corners, recorded } = this;
    const numbers = this.frames.now();
    for (let corner = 0; corner < corners.length; corner++) corners[corner] = value(numbers, recorded.numbers * places[corner]);
    return corners;
  }
}

/** Fields that solids alone have, by name; `recorded` has the numbers of each. */
export const solidFields = (solids, kinematics, recorded) => {
  const valuesOf = lazily(solids, (solid, k) => new SolidValues(solid, kinematics, recorded[k]));
  const of = ([name, unit, value]) => [name, field(name, unit, solids, (solid) => valuesOf(solid).of(value))];
  return solids.length === 0 ? {} : Object.fromEntries(QUANTITIES.map(of));
};
