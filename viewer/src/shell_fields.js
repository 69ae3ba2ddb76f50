// What shells can be coloured by: stresses, forces and moments per length, energy and thickness.
//
// Numbers of an element are those at its centre; at a node they are means by the areas of the elements that agree there.

import { agreeingCorners, smoothCorners } from "./shell_corners.js";
import { strainNoise } from "./shell_noise.js";
import { ShellStates } from "./shell_states.js";

/** Components of elements at a node are averaged where their first axes differ by less than 30°. */
const ALIGNED = 0.866;
/** Elements whose thicknesses differ by more than this factor have stresses of their own. */
const STEP = 1.25;

/** Von Mises stress at a height, in halves of the thickness above the middle, from the forces and moments of a homogeneous shell. Moments are
 *  about the surface of the nodes, from which the middle is offset. */
const misesAt = (height) => (forces, _, h, at, offset) => {
  const bending = (6 * height) / (h * h);
  const membrane = 1 / h - bending * offset;
  const s11 = membrane * forces[0] + bending * forces[3];
  const s22 = membrane * forces[1] + bending * forces[4];
  const s12 = membrane * forces[2] + bending * forces[5];
  return Math.sqrt(Math.max(s11 * s11 - s11 * s22 + s22 * s22 + 3 * s12 * s12, 0));
};

const energyPerArea = (forces, strains, _, at) => {
  let sum = 0;
  for (let k = 0; k < 8; k++) sum += forces[k] * strains[at + k];
  return sum / 2;
};

const component = (k) => (forces) => forces[k];

/** Names, units and functions of forces per length, strains, thickness, where the strains begin and offset. */
const QUANTITIES = [
  ...[["top", 1], ["middle", 0], ["bottom", -1]].map(([where, height]) => ({ name: `von Mises stress, ${where}`, unit: "Pa", value: misesAt(height), isStress: true })),
  ...["11", "22", "12"].map((axes, k) => ({ name: `membrane force N${axes}`, unit: "N/m", value: component(k), isComponent: true })),
  ...["11", "22", "12"].map((axes, k) => ({ name: `${axes === "12" ? "twisting" : "bending"} moment M${axes}`, unit: "N m/m", value: component(3 + k), isComponent: true })),
  ...["13", "23"].map((axes, k) => ({ name: `transverse shear force Q${axes}`, unit: "N/m", value: component(6 + k), isComponent: true })),
  { name: "strain energy per area", unit: "J/m²", value: energyPerArea },
];

/** A number of an element, or the one for all. */
const of = (list, element) => list[list.length > 1 ? element : 0];

/** The values of quantities at the corners of a shell. */
class ShellValues {
  constructor(shell, kinematics) {
    this.shell = shell;
    this.states = new ShellStates(shell, kinematics);
    const count = shell.elements.length;
    this.count = count;
    this.stiffness = shell.stiffness.map((rows) => Float64Array.from(rows));
    this.forces = new Float64Array(8);
    this.ofElements = new Float64Array(count);
    this.corners = new Float64Array(4 * count);
    this.sums = new Float64Array(4 * count);
    this.areas = new Float64Array(4 * count);
  }

  /** Corners whose elements have one value there: for components of tensors also their axes must agree. */
  groupsOf({ isComponent }) {
    const { firsts } = this.states.strains;
    const { thickness } = this.shell;
    if (!isComponent && thickness.length === 1) return (this.smooth ??= smoothCorners(this.shell));
    const isAligned = (a, b) => firsts[3 * a] * firsts[3 * b] + firsts[3 * a + 1] * firsts[3 * b + 1] + firsts[3 * a + 2] * firsts[3 * b + 2] > ALIGNED;
    const isAlike = (a, b) => Math.max(of(thickness, a) / of(thickness, b), of(thickness, b) / of(thickness, a)) < STEP;
    if (!isComponent) return (this.alike ??= agreeingCorners(this.shell, isAlike));
    return (this.aligned ??= agreeingCorners(this.shell, (a, b) => isAligned(a, b) && isAlike(a, b)));
  }

  /** Forces and moments per length of an element for strains from `at` on, to `forces`. */
  resultants(element, strains, at) {
    const { forces } = this;
    const stiffness = of(this.stiffness, element);
    for (let i = 0; i < 8; i++) {
      let sum = 0;
      for (let j = 0; j < 8; j++) sum += stiffness[8 * i + j] * strains[at + j];
      forces[i] = sum;
    }
    return forces;
  }

  /** What a quantity is where there are no strains but those of the resolution of the motion: values below twice that are round-off. */
  roundOff(quantity) {
    this.noise ??= strainNoise(this.shell, this.states.kinematics.motion, this.states.strains.areas);
    let most = 0;
    for (let element = 0; element < this.count; element += Math.max(1, this.count >> 4)) {
      const stiffness = of(this.stiffness, element);
      for (let i = 0; i < 8; i++) {
        let sum = 0;
        for (let j = 0; j < 8; j++) sum += (stiffness[8 * i + j] * this.noise[j]) ** 2;
        this.forces[i] = Math.sqrt(sum);
      }
      most = Math.max(most, quantity.value(this.forces, this.noise, of(this.shell.thickness, element), 0, this.shell.offset ?? 0));
    }
    return 2 * most;
  }

  /** A quantity at all corners, now. */
  of(quantity) {
    const strains = this.states.now();
    const { count, ofElements } = this;
    for (let element = 0; element < count; element++) {
      const forces = this.resultants(element, strains, 8 * element);
      ofElements[element] = quantity.value(forces, strains, of(this.shell.thickness, element), 8 * element, this.shell.offset ?? 0);
    }
    return this.averaged(this.groupsOf(quantity));
  }

  /** Values of elements averaged by area to corners. */
  averaged({ groups }) {
    const { ofElements, corners, sums, areas } = this;
    const { areas: own } = this.states.strains;
    sums.fill(0);
    areas.fill(0);
    for (let corner = 0; corner < corners.length; corner++) {
      const element = corner >> 2;
      sums[groups[corner]] += own[element] * ofElements[element];
      areas[groups[corner]] += own[element];
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

/** Fields that shells alone have, by name. */
export const shellFields = (shells, kinematics) => {
  const found = {};
  if (shells.length === 0) return found;
  const known = new Map();
  const valuesOf = (shell) => {
    if (!known.has(shell)) known.set(shell, new ShellValues(shell, kinematics));
    return known.get(shell);
  };
  const add = (name, unit, has, onShell, isSigned, roundOff) => {
    const those = shells.filter(has);
    if (those.length === 0) return;
    found[name] = { title: name, unit, isSigned, alongBeam: () => null, onShell: (shell) => (those.includes(shell) ? onShell(shell) : null), extremes: () => extremesOf(those, onShell), roundOff: () => Math.max(...those.map(roundOff)) };
  };
  for (const quantity of QUANTITIES) {
    const has = quantity.isStress ? (shell) => shell.is_homogeneous : () => true;
    const [onShell, roundOff] = [(shell) => valuesOf(shell).of(quantity), (shell) => valuesOf(shell).roundOff(quantity)];
    add(quantity.name, quantity.unit, has, onShell, Boolean(quantity.isComponent), roundOff);
  }
  const thicknesses = new Map(shells.map((shell) => [shell, Float64Array.from({ length: 4 * shell.elements.length }, (_, corner) => of(shell.thickness, corner >> 2))]));
  add("thickness", "m", () => true, (shell) => thicknesses.get(shell), false, () => 0);
  return found;
};
