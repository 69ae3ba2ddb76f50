// Von Mises stresses of elastic solids, by elements like those of the run: at points of each element, extrapolated to its nodes, and means by volume
// at the nodes. Stresses are those of the recorded frame that is nearest: positions between frames, or magnified ones, would have others.

/** Corners at the ends of each edge, in the order of the middle nodes. */
const HEXAHEDRON_EDGES = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
const TETRAHEDRON_EDGES = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
const HEXAHEDRON_CORNERS = [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]];
const TETRAHEDRON_CORNERS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];

const withMiddles = (corners, edges) => [...corners, ...edges.map(([a, b]) => corners[a].map((x, k) => (x + corners[b][k]) / 2))];
const HEXAHEDRON = withMiddles(HEXAHEDRON_CORNERS, HEXAHEDRON_EDGES);
const TETRAHEDRON = withMiddles(TETRAHEDRON_CORNERS, TETRAHEDRON_EDGES);

/** Slopes of the functions of a hexahedron at a point. */
const hexahedronSlopes = (p) =>
  HEXAHEDRON.map((node, i) => {
    const factors = node.map((n, k) => (n === 0 ? 1 - p[k] * p[k] : 1 + n * p[k]));
    const slopes = node.map((n, k) => (n === 0 ? -2 * p[k] : n));
    const product = factors[0] * factors[1] * factors[2];
    const sum = i < 8 ? node[0] * p[0] + node[1] * p[1] + node[2] * p[2] - 2 : 1;
    return [0, 1, 2].map((k) => (i < 8 ? 0.125 : 0.25) * (slopes[k] * factors[(k + 1) % 3] * factors[(k + 2) % 3] * sum + (i < 8 ? product * node[k] : 0)));
  });

/** The same of a tetrahedron. */
const tetrahedronSlopes = (p) => {
  const volume = [1 - p[0] - p[1] - p[2], ...p];
  const slope = [[-1, -1, -1], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const corners = volume.map((own, i) => slope[i].map((x) => (4 * own - 1) * x));
  return [...corners, ...TETRAHEDRON_EDGES.map(([i, j]) => slope[i].map((x, k) => 4 * (volume[j] * x + volume[i] * slope[j][k])))];
};

const NEAR = Math.sqrt(1 / 3);
const LOW = (5 - Math.sqrt(5)) / 20;
const SHAPES = {
  hexahedron: {
    points: HEXAHEDRON_CORNERS.map((corner) => corner.map((x) => NEAR * x)),
    slopes: hexahedronSlopes,
    weight: 1,
    shares: HEXAHEDRON.map((node) => HEXAHEDRON_CORNERS.map((corner) => corner.reduce((product, x, k) => product * 0.5 * (1 + (x * node[k]) / NEAR), 1))),
  },
  tetrahedron: {
    points: [0, 1, 2, 3].map((i) => [1, 2, 3].map((k) => (i === k ? 1 - 3 * LOW : LOW))),
    slopes: tetrahedronSlopes,
    weight: 1 / 24,
    shares: TETRAHEDRON.map((node) => [1 - node[0] - node[1] - node[2], ...node].map((own) => (own - LOW) / (1 - 4 * LOW))),
  },
};

/** Cofactors of a matrix by rows, and its determinant in the last place. */
const cofactors = (m) => {
  const c = [
    m[4] * m[8] - m[5] * m[7], m[5] * m[6] - m[3] * m[8], m[3] * m[7] - m[4] * m[6],
    m[2] * m[7] - m[1] * m[8], m[0] * m[8] - m[2] * m[6], m[1] * m[6] - m[0] * m[7],
    m[1] * m[5] - m[2] * m[4], m[2] * m[3] - m[0] * m[5], m[0] * m[4] - m[1] * m[3],
  ];
  return [...c, m[0] * c[0] + m[1] * c[1] + m[2] * c[2]];
};

/** Elements of one shape at rest: gradients of the functions and volumes at the points. */
const atRest = (elements, shape, positions) =>
  elements.map((nodes) => {
    const points = shape.points.map((point) => {
      const slopes = shape.slopes(point);
      const m = new Array(9).fill(0);
      nodes.forEach((node, i) => {
        for (let r = 0; r < 3; r++) for (let k = 0; k < 3; k++) m[3 * r + k] += positions[node][r] * slopes[i][k];
      });
      const c = cofactors(m);
      return { volume: shape.weight * c[9], gradients: slopes.map((s) => [0, 1, 2].map((r) => (c[3 * r] * s[0] + c[3 * r + 1] * s[1] + c[3 * r + 2] * s[2]) / c[9])) };
    });
    return { nodes, points, shares: shape.shares, volume: points.reduce((sum, { volume }) => sum + volume, 0) };
  });

class SolidStresses {
  constructor(solid, kinematics) {
    this.solid = solid;
    this.kinematics = kinematics;
    this.nodes = Int32Array.from(solid.nodes);
    this.positions = new Float64Array(3 * this.nodes.length);
    this.quaternions = new Float64Array(4 * this.nodes.length);
    this.frame = -1;
    this.elements = Object.entries(SHAPES).flatMap(([name, shape]) => atRest(solid.cells[name] ?? [], shape, solid.positions));
    const count = solid.nodes.length;
    this.sums = new Float64Array(6 * count);
    this.volumes = new Float64Array(count);
    for (const { nodes, volume } of this.elements) for (const node of nodes) this.volumes[node] += volume;
    this.mises = new Float64Array(count);
    this.corners = new Float64Array(4 * solid.elements.length);
  }

  /** Cauchy stress from the gradient, the pressure of rubber on the mean dilatation being `mean`. */
  stress(f, mean) {
    const { is_neo_hookean: isRubber, shear, bulk } = this.solid;
    const c = cofactors(f);
    const j = c[9];
    const product = (a, b) => [0, 1, 2, 0, 0, 1].map((r, k) => {
      const s = [0, 1, 2, 1, 2, 2][k];
      return a[3 * r] * b[3 * s] + a[3 * r + 1] * b[3 * s + 1] + a[3 * r + 2] * b[3 * s + 2];
    });
    if (isRubber) {
      const b = product(f, f);
      const factor = shear * j ** (-5 / 3);
      const pressure = Math.min(bulk, (14 / 3) * shear) * (j - 1) + mean;
      return b.map((x, k) => factor * (k < 3 ? x - (b[0] + b[1] + b[2]) / 3 : x) + (k < 3 ? pressure : 0));
    }
    // F S Fᵀ/J.
    const e = new Array(9).fill(0);
    for (let r = 0; r < 3; r++) for (let s = 0; s < 3; s++) e[3 * r + s] = 0.5 * (f[r] * f[s] + f[3 + r] * f[3 + s] + f[6 + r] * f[6 + s] - (r === s ? 1 : 0));
    const first = (bulk - (2 / 3) * shear) * (e[0] + e[4] + e[8]);
    const second = e.map((x, k) => 2 * shear * x + (k % 4 === 0 ? first : 0));
    const fs = new Array(9).fill(0);
    for (let r = 0; r < 3; r++) for (let s = 0; s < 3; s++) for (let k = 0; k < 3; k++) fs[3 * r + s] += (f[3 * r + k] * second[3 * k + s]) / j;
    return product(fs, f);
  }

  /** Von Mises stresses at the corners of the surface. */
  now() {
    const { before, after, share } = this.kinematics;
    const frame = share < 0.5 ? before : after;
    if (frame === this.frame) return this.corners;
    this.frame = frame;
    this.kinematics.recorded(frame, this.nodes, this.positions, this.quaternions);
    const { positions, solid, sums, mises } = this;
    const { is_neo_hookean: isRubber, shear, bulk } = solid;
    sums.fill(0);
    for (const { nodes, points, shares, volume } of this.elements) {
      const origin = 3 * nodes[0];
      const gradients = points.map((point) => {
        const f = new Array(9).fill(0);
        nodes.forEach((node, i) => {
          for (let r = 0; r < 3; r++) for (let k = 0; k < 3; k++) f[3 * r + k] += (positions[3 * node + r] - positions[origin + r]) * point.gradients[i][k];
        });
        return f;
      });
      const dilated = gradients.reduce((sum, f, k) => sum + points[k].volume * cofactors(f)[9], 0) / volume - 1;
      const mean = isRubber ? Math.max(bulk - (14 / 3) * shear, 0) * dilated : 0;
      const known = gradients.map((f) => this.stress(f, mean));
      nodes.forEach((node, i) => {
        for (let k = 0; k < 6; k++) sums[6 * node + k] += volume * known.reduce((sum, stress, p) => sum + shares[i][p] * stress[k], 0);
      });
    }
    for (let node = 0; node < mises.length; node++) {
      const [a, b, c, d, e, f] = sums.subarray(6 * node, 6 * node + 6).map((sum) => sum / this.volumes[node]);
      mises[node] = Math.sqrt(Math.max(0.5 * ((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2) + 3 * (d * d + e * e + f * f), 0));
    }
    for (let corner = 0; corner < this.corners.length; corner++) this.corners[corner] = mises[solid.elements[corner >> 2][corner & 3]];
    return this.corners;
  }
}

/** Fields that solids alone have, by name. */
export const solidFields = (solids, kinematics) => {
  if (solids.length === 0) return {};
  const known = new Map();
  const onShell = (solid) => {
    if (!solids.includes(solid)) return null;
    if (!known.has(solid)) known.set(solid, new SolidStresses(solid, kinematics));
    return known.get(solid).now();
  };
  const extremes = () => {
    let most = 0;
    for (const solid of solids) for (const value of onShell(solid)) most = Math.max(most, value);
    return [0, most];
  };
  // Strains of the resolution of the motion: positions have six digits of the size of the model.
  const roundOff = () => 1e-5 * Math.max(...solids.map(({ shear }) => shear));
  const name = "von Mises stress of solids";
  return { [name]: { title: name, unit: "Pa", isSigned: false, alongBeam: () => null, onShell, extremes, roundOff } };
};
