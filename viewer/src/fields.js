// What parts can be coloured by.

import { ofShellNodes, shellFields } from "./shell_fields.js";
import { solidFields } from "./solid_fields.js";

const names = ["axial force", "shear force 2", "shear force 3", "torsion", "bending moment 2", "bending moment 3"];

/** A function of the fraction s from values at places that ascend; straight beyond the ends of an element. */
const piecewise = (at, value) => (s) => {
  let k = 0;
  while (k + 2 < at.length && at[k + 1] < s) k++;
  if (at.length === 1) return value(0);
  const x = (s - at[k]) / (at[k + 1] - at[k]);
  return value(k) + x * (value(k + 1) - value(k));
};

/** The inverse of a symmetric positive matrix, by rows. */
const inverse = (matrix) => {
  const n = 6;
  const rows = Array.from({ length: n }, (_, i) => [...matrix.slice(n * i, n * i + n), ...Array.from({ length: n }, (_, j) => (i === j ? 1 : 0))]);
  for (let i = 0; i < n; i++) {
    const pivot = rows[i][i];
    for (let j = 0; j < 2 * n; j++) rows[i][j] /= pivot;
    for (let k = 0; k < n; k++) {
      if (k === i) continue;
      const factor = rows[k][i];
      for (let j = 0; j < 2 * n; j++) rows[k][j] -= factor * rows[i][j];
    }
  }
  return rows.flatMap((row) => row.slice(n));
};

/** The compliance of the section of a beam at the fraction s; none where stations do not state their stiffness. */
const compliance = ({ stations }, s) => {
  if (stations.some(({ stiffness }) => stiffness?.length !== 36)) return null;
  let next = stations.findIndex((station) => station.at > s);
  if (next < 0) next = stations.length;
  const before = stations[Math.max(next - 1, 0)];
  const after = stations[Math.min(next, stations.length - 1)];
  const x = after.at > before.at ? (s - before.at) / (after.at - before.at) : 0;
  return inverse(before.stiffness.map((value, k) => value + x * (after.stiffness[k] - value)));
};

/** A field of the numbers of nodes. */
const ofNodes = (title, unit, numbers) => ({
  title,
  unit,
  alongBeam: (beam) => piecewise(beam.places, (k) => numbers()[beam.nodes[k]]),
  ofNode: (node) => numbers()[node],
  onShell: ofShellNodes(numbers),
  extremes: () => [0, numbers().reduce((most, value) => Math.max(most, value), 0)],
});

/** Fields of section forces by name. */
const beamFields = (scene, kinematics) => {
  const found = {};
  if (kinematics.motion.points === 0) return found;
  const first = new Map();
  let count = 0;
  for (const { beam, at } of kinematics.motion.forcePoints) {
    first.set(beam, { at, first: count });
    count += at.length;
  }
  const ofForces = (title, unit, value) => ({
    title,
    unit,
    alongBeam: (beam) => {
      const points = first.get(beam.name);
      return points && piecewise(points.at, (k) => value(6 * (points.first + k)));
    },
    extremes: () => {
      let [low, high] = [Infinity, -Infinity];
      for (let k = 0; k < 6 * count; k += 6) {
        const here = value(k);
        low = Math.min(low, here);
        high = Math.max(high, here);
      }
      return [low, high];
    },
  });
  const { forces } = kinematics;
  found["bending moment"] = ofForces("bending moment", "N m", (k) => Math.hypot(forces[k + 4], forces[k + 5]));
  found["shear force"] = ofForces("shear force", "N", (k) => Math.hypot(forces[k + 1], forces[k + 2]));
  names.forEach((name, j) => {
    found[name] = { ...ofForces(name, j < 3 ? "N" : "N m", (k) => forces[k + j]), isSigned: true };
  });
  const compliances = kinematics.motion.forcePoints.flatMap(({ beam, at }) => {
    const part = scene.beams.find((each) => each.name === beam);
    return at.map((s) => part && compliance(part, s));
  });
  if (compliances.every(Boolean)) {
    // Half the product of section forces and the strains that they belong to.
    found["strain energy"] = ofForces("strain energy per length", "J/m", (k) => {
      const flexible = compliances[k / 6];
      let sum = 0;
      for (let i = 0; i < 6; i++) for (let j = 0; j < 6; j++) sum += forces[k + i] * flexible[6 * i + j] * forces[k + j];
      return sum / 2;
    });
  }
  return found;
};

/** All fields by name. Pages of earlier versions have none of shells and solids. */
export const fields = (scene, kinematics) => {
  const { parts } = kinematics.motion.fields;
  const [shells, solids] = parts.length ? [scene.shells ?? [], scene.elastic_solids ?? []] : [[], []];
  return {
    speed: ofNodes("speed", "m/s", () => kinematics.speeds),
    displacement: ofNodes("displacement", "m", () => kinematics.distances),
    ...beamFields(scene, kinematics),
    ...shellFields(shells, kinematics, parts),
    ...solidFields(solids, kinematics, parts.slice(shells.length)),
  };
};

/** Values below this are round-off: section forces beside the largest of the run, motions beside the size of the model. */
const ROUND_OFF = 1e-9;

/** The largest value that is round-off in a field. */
export const roundOff = (field, { motion }, size) => {
  const { unit } = field;
  if (unit === "m") return ROUND_OFF * size;
  if (unit === "m/s") return (ROUND_OFF * size) / Math.max(motion.times[motion.frames - 1] - motion.times[0], 1e-300);
  if (unit !== "N" && unit !== "N m") return 0;
  return ROUND_OFF * motion.forces.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
};

/** The same over a period of a mode. */
const rangeOfMode = (field, kinematics) => {
  const { time } = kinematics;
  let most = 0;
  for (let k = 0; k < 24; k++) {
    kinematics.set(k / 24);
    most = Math.max(most, field.extremes()[1]);
  }
  kinematics.set(time);
  return [0, most];
};

/** Least and greatest value over all frames. */
export const rangeOf = (field, kinematics) => {
  const { motion, time } = kinematics;
  if (kinematics.mode) return rangeOfMode(field, kinematics);
  const stride = Math.max(1, Math.floor(motion.frames / 300));
  let [low, high] = [Infinity, -Infinity];
  for (let frame = 0; frame < motion.frames; frame += stride) {
    kinematics.set(motion.times[frame]);
    const [least, most] = field.extremes();
    low = Math.min(low, least);
    high = Math.max(high, most);
  }
  kinematics.set(time);
  return [low, high];
};
