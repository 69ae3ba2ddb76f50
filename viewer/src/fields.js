// What parts can be coloured by.

const names = ["axial force", "shear force 2", "shear force 3", "torsion", "bending moment 2", "bending moment 3"];

/** A function of the fraction s from values at places that ascend; straight beyond the ends of an element. */
const piecewise = (at, value) => (s) => {
  let k = 0;
  while (k + 2 < at.length && at[k + 1] < s) k++;
  if (at.length === 1) return value(0);
  const x = (s - at[k]) / (at[k + 1] - at[k]);
  return value(k) + x * (value(k + 1) - value(k));
};

/** A field of the numbers of nodes. */
const ofNodes = (title, unit, numbers) => ({
  title,
  unit,
  alongBeam: (beam) => piecewise(beam.places, (k) => numbers()[beam.nodes[k]]),
  ofNode: (node) => numbers()[node],
  extremes: () => [0, numbers().reduce((most, value) => Math.max(most, value), 0)],
});

/** All fields by name. */
export const fields = (scene, kinematics) => {
  const found = {
    speed: ofNodes("speed", "m/s", () => kinematics.speeds),
    displacement: ofNodes("displacement", "m", () => kinematics.distances),
  };
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
    found[name] = ofForces(name, j < 3 ? "N" : "N m", (k) => forces[k + j]);
  });
  return found;
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
