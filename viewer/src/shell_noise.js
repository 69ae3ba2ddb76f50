// Strains of a shell that are nothing but the resolution of the motion in a page.

/** The usual error of numbers that are rounded to the distance of `quanta`, over the nodes of a shell. */
const errorOf = (quanta, nodes) => {
  let sum = 0;
  for (const node of nodes) for (let i = 0; i < 3; i++) sum += quanta[3 * node + i] ** 2;
  return Math.sqrt(sum / (3 * nodes.length) / 12);
};

/**
 * The usual error of the eight strains at a node, where four elements of medium size are averaged whose nodes are displaced and turned by their
 * errors.
 */
export const strainNoise = ({ nodes }, { quanta }, areas) => {
  if (!quanta) return new Float64Array(8);
  // The mean of four has half of the error of one.
  const length = 2 * Math.sqrt(areas.reduce((sum, area) => sum + area, 0) / areas.length);
  const turn = errorOf(quanta.rotations, nodes);
  const strain = errorOf(quanta.displacements, nodes) / length;
  const curvature = turn / length;
  const shear = strain + turn / 2;
  return Float64Array.of(strain, strain, strain, curvature, curvature, curvature, shear, shear);
};
