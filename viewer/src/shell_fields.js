// What shells can be coloured by: stresses, forces and moments per length, energy and thickness, from numbers recorded at the centres of elements.
//
// At a node they are means by the areas of the elements that agree there.

import { FieldFrames } from "./field_frames.js";
import { agreeingCorners, smoothCorners } from "./shell_corners.js";

/** Components of elements at a node are averaged where their first axes differ by less than 30°. */
const ALIGNED = 0.866;
/** Elements whose thicknesses differ by more than this factor have stresses of their own. */
const STEP = 1.25;

/** Von Mises stress at a height, in halves of the thickness above the middle, from the forces and moments of a homogeneous shell from a place on.
 *  Moments are about the surface of the nodes, from which the middle is offset. */
const misesAt = (height) => (numbers, at, h, offset) => {
  const bending = (6 * height) / (h * h);
  const membrane = 1 / h - bending * offset;
  const [s11, s22, s12] = [0, 1, 2].map((k) => membrane * numbers[at + k] + bending * numbers[at + 3 + k]);
  return Math.sqrt(Math.max(s11 * s11 - s11 * s22 + s22 * s22 + 3 * s12 * s12, 0));
};

const component = (k) => (numbers, at) => numbers[at + k];

/** Names, units and functions of the recorded numbers, the place where those of an element begin, its thickness and offset. */
const QUANTITIES = [
  ...[["top", 1], ["middle", 0], ["bottom", -1]].map(([where, height]) => ({ name: `von Mises stress, ${where}`, unit: "Pa", value: misesAt(height), isStress: true })),
  ...["11", "22", "12"].map((axes, k) => ({ name: `membrane force N${axes}`, unit: "N/m", value: component(k), isComponent: true })),
  ...["11", "22", "12"].map((axes, k) => ({ name: `${axes === "12" ? "twisting" : "bending"} moment M${axes}`, unit: "N m/m", value: component(3 + k), isComponent: true })),
  ...["13", "23"].map((axes, k) => ({ name: `transverse shear force Q${axes}`, unit: "N/m", value: component(6 + k), isComponent: true })),
  { name: "strain energy per area", unit: "J/m²", value: (numbers, at) => numbers[at + 8] ** 2 },
];

/** A number of an element, or the one for all. */
const of = (list, element) => list[list.length > 1 ? element : 0];

/** The values of quantities at the corners of a shell. */
class ShellValues {
  constructor(shell, kinematics, recorded) {
    this.shell = shell;
    this.recorded = recorded;
    this.frames = new FieldFrames(kinematics, recorded);
    const { count } = recorded;
    this.ofElements = new Float64Array(count);
    this.corners = new Float64Array(4 * count);
    this.sums = new Float64Array(4 * count);
    this.areas = new Float64Array(4 * count);
  }

  /** Corners whose elements have one value there: for components of tensors also their axes must agree. */
  groupsOf({ isComponent }) {
    const { constants } = this.recorded;
    const { thickness } = this.shell;
    if (!isComponent && thickness.length === 1) return (this.smooth ??= smoothCorners(this.shell));
    // Of each element the area is recorded, and the first axis.
    const isAligned = (a, b) => [1, 2, 3].reduce((sum, k) => sum + constants[4 * a + k] * constants[4 * b + k], 0) > ALIGNED;
    const isAlike = (a, b) => Math.max(of(thickness, a) / of(thickness, b), of(thickness, b) / of(thickness, a)) < STEP;
    if (!isComponent) return (this.alike ??= agreeingCorners(this.shell, isAlike));
    return (this.aligned ??= agreeingCorners(this.shell, (a, b) => isAligned(a, b) && isAlike(a, b)));
  }

  /** A quantity at all corners, now. */
  of(quantity) {
    const numbers = this.frames.now();
    const { ofElements, recorded } = this;
    const { thickness, offset = 0 } = this.shell;
    for (let element = 0; element < recorded.count; element++) {
      ofElements[element] = quantity.value(numbers, recorded.numbers * element, of(thickness, element), offset);
    }
    return this.averaged(this.groupsOf(quantity));
  }

  /** Values of elements averaged by area to corners. */
  averaged({ groups }) {
    const { ofElements, corners, sums, areas } = this;
    const { constants } = this.recorded;
    sums.fill(0);
    areas.fill(0);
    for (let corner = 0; corner < corners.length; corner++) {
      const element = corner >> 2;
      sums[groups[corner]] += constants[4 * element] * ofElements[element];
      areas[groups[corner]] += constants[4 * element];
    }
    for (let corner = 0; corner < corners.length; corner++) corners[corner] = sums[groups[corner]] / areas[groups[corner]];
    return corners;
  }
}

/** Numbers of nodes at the corners of shells, as `onShell` of a field. */
export const ofShellNodes = (numbers) => {
  const known = new Map();
  return (shell) => {
    if (!known.has(shell)) known.set(shell, [Int32Array.from(shell.elements.flat(), (index) => shell.nodes[index]), new Float64Array(4 * shell.elements.length)]);
    const [nodes, corners] = known.get(shell);
    const now = numbers();
    for (let corner = 0; corner < corners.length; corner++) corners[corner] = now[nodes[corner]];
    return corners;
  };
};

/** Least and greatest of the values at the corners of shells. */
const extremesOf = (shells, onShell) => {
  let [low, high] = [Infinity, -Infinity];
  for (const shell of shells) {
    const values = onShell(shell);
    for (let k = 0; k < values.length; k++) {
      if (values[k] < low) low = values[k];
      if (values[k] > high) high = values[k];
    }
  }
  return [low, high];
};

/** What belongs to each of some parts, made when it is first asked for. */
export const lazily = (parts, make) => {
  const known = new Map();
  return (part) => {
    if (!known.has(part)) known.set(part, make(part, parts.indexOf(part)));
    return known.get(part);
  };
};

/** A field of some shells or solids alone. */
export const field = (title, unit, parts, onShell, isSigned = false) => ({
  title,
  unit,
  isSigned,
  alongBeam: () => null,
  onShell: (part) => (parts.includes(part) ? onShell(part) : null),
  extremes: () => extremesOf(parts, onShell),
});

/** Fields that shells alone have, by name; `recorded` has the numbers of each. */
export const shellFields = (shells, kinematics, recorded) => {
  const found = {};
  if (shells.length === 0) return found;
  const valuesOf = lazily(shells, (shell, k) => new ShellValues(shell, kinematics, recorded[k]));
  for (const quantity of QUANTITIES) {
    const those = shells.filter((shell) => !quantity.isStress || shell.is_homogeneous);
    if (those.length === 0) continue;
    found[quantity.name] = field(quantity.name, quantity.unit, those, (shell) => valuesOf(shell).of(quantity), Boolean(quantity.isComponent));
  }
  const thicknesses = new Map(shells.map((shell) => [shell, Float64Array.from({ length: 4 * shell.elements.length }, (_, corner) => of(shell.thickness, corner >> 2))]));
  found.thickness = field("thickness", "m", shells, (shell) => thicknesses.get(shell));
  return found;
};
