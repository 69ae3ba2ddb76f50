// Strains of the elements of a shell at their centres, from positions and rotations of its nodes.
//
// Legend: x positions, d directors, an edge goes from node I to node J, c = x_J - x_I; x_r … d_s mean derivatives.
//
//   membrane   c·c/8 at four edges,    x_r·x_s/2
//   bending    g c·(d_J - d_I)/4,      (x_r·d_s + x_s·d_r)/2,     g = 1 + q/24 + 3q²/640 + 5q³/7168,   q = |d_J - d_I|²
//   shear      c·(d_I + d_J)/4
//
// all without their values in the stress-free state, and interpolated as in crates/lissom-mechanics/src/elements/shell.

import { turn } from "./kinematics.js";

/** First and second node of the edges along r at s = -1 and 1, and along s at r = -1 and 1. */
const EDGES = [[0, 1], [3, 2], [0, 3], [1, 2]];
/** Derivatives of the mean x_r and x_s by the nodes' positions. */
const BY_R = [-0.25, 0.25, 0.25, -0.25];
const BY_S = [-0.25, -0.25, 0.25, 0.25];

/** Strains in natural coordinates: five of the membrane, five of bending, four of shear. */
const NATURAL = 14;
/** Numbers of the interpolation at a centre: 3 x 5 for membrane and bending, 2 x 2 for shear. */
const WEIGHTS = 19;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const minus = (a, b, factor = 1) => [a[0] - factor * b[0], a[1] - factor * b[1], a[2] - factor * b[2]];
const scaled = (a, factor) => [factor * a[0], factor * a[1], factor * a[2]];
const unit = (a) => scaled(a, 1 / Math.hypot(...a));

/** Weights of an element's natural strains at its centre, its first local axis and its area, from its corners and a direction. */
const centre = (x, direction) => {
  const mean = (by) => [0, 1, 2].map((i) => x.reduce((sum, place, k) => sum + by[k] * place[i], 0));
  const [along, across] = [mean(BY_R), mean(BY_S)];
  const normal = cross(along, across);
  const area = Math.hypot(...normal);
  const up = scaled(normal, 1 / area);
  const first = unit(minus(direction, up, dot(direction, up)));
  const second = cross(up, first);
  // The inverse of [x_r·a1, x_r·a2; x_s·a1, x_s·a2].
  const [j11, j12, j21, j22] = [dot(along, first), dot(along, second), dot(across, first), dot(across, second)];
  const determinant = j11 * j22 - j12 * j21;
  const [a, b, c, d] = [j22, -j12, -j21, j11].map((value) => value / determinant);
  // How far the element is from a parallelogram: x_d = c_r x_r + c_s x_s, least squares.
  const saddle = mean([0.25, -0.25, 0.25, -0.25]);
  const [rr, rs, ss] = [dot(along, along), dot(along, across), dot(across, across)];
  const [right, other] = [dot(along, saddle), dot(across, saddle)];
  const gram = rr * ss - rs * rs;
  const [cr, cs] = [(ss * right - rs * other) / gram, (rr * other - rs * right) / gram];
  const p = cr * cr + cs * cs - 1;
  const [ea, eb, ec, ed] = [cr * (cr + 1), cr * (cr - 1), cs * (cs + 1), cs * (cs - 1)].map((value) => value / (2 * p));
  const ee = (2 * cr * cs) / p;
  const covariant = [
    [0.5 - ea, 0.5 - eb, -ec, -ed, -ee],
    [-ea, -eb, 0.5 - ec, 0.5 - ed, -ee],
    [0, 0, 0, 0, 1],
  ];
  const toLocal = [
    [a * a, b * b, 2 * a * b],
    [c * c, d * d, 2 * c * d],
    [2 * a * c, 2 * b * d, 2 * (a * d + b * c)],
  ];
  const weights = toLocal.flatMap((row) => [0, 1, 2, 3, 4].map((k) => row[0] * covariant[0][k] + row[1] * covariant[1][k] + row[2] * covariant[2][k]));
  // Shear at the centre is the mean of two edges.
  return { weights: [...weights, a / 2, b / 2, c / 2, d / 2], first, area: 4 * area };
};

export class ShellStrains {
  constructor({ positions, elements, axes, directors, directions }) {
    const count = elements.length;
    this.count = count;
    this.corners = Int32Array.from(elements.flat());
    /** Normals that the corners carry, in the axes of their nodes. */
    this.carried = new Float64Array(12 * count);
    for (let corner = 0; corner < 4 * count; corner++) {
      this.carried.set(directors?.length ? directors[corner >> 2][corner & 3] : [0, 0, 1], 3 * corner);
    }
    this.weights = new Float64Array(WEIGHTS * count);
    /** First local axes and areas of the elements. */
    this.firsts = new Float64Array(3 * count);
    this.areas = new Float64Array(count);
    elements.forEach((nodes, element) => {
      const found = centre(nodes.map((node) => positions[node]), directions[directions.length > 1 ? element : 0]);
      this.weights.set(found.weights, WEIGHTS * element);
      this.firsts.set(found.first, 3 * element);
      this.areas[element] = found.area;
    });
    this.x = new Float64Array(12);
    this.d = new Float64Array(12);
    this.own = new Float64Array(NATURAL);
    this.free = new Float64Array(NATURAL * count);
    const places = Float64Array.from(positions.flat());
    const quaternions = Float64Array.from(axes.flatMap(([w, x, y, z]) => [x, y, z, w]));
    for (let element = 0; element < count; element++) {
      this.natural(element, places, quaternions);
      this.free.set(this.own, NATURAL * element);
    }
  }

  /** Natural strains of an element, with their values in the stress-free state still in them, to `own`. */
  natural(element, positions, quaternions) {
    const { corners, carried, x, d, own } = this;
    const origin = 3 * corners[4 * element];
    for (let k = 0; k < 4; k++) {
      const node = corners[4 * element + k];
      for (let i = 0; i < 3; i++) x[3 * k + i] = positions[3 * node + i] - positions[origin + i];
      const at = 12 * element + 3 * k;
      turn(quaternions, 4 * node, carried[at], carried[at + 1], carried[at + 2], d, 3 * k);
    }
    for (let k = 0; k < 4; k++) {
      const from = 3 * EDGES[k][0];
      const to = 3 * EDGES[k][1];
      let length = 0;
      let bending = 0;
      let q = 0;
      let shear = 0;
      for (let i = 0; i < 3; i++) {
        const chord = x[to + i] - x[from + i];
        const change = d[to + i] - d[from + i];
        length += chord * chord;
        bending += chord * change;
        q += change * change;
        shear += chord * (d[from + i] + d[to + i]);
      }
      own[k] = length / 8;
      own[5 + k] = (bending / 4) * (1 + q * (1 / 24 + q * (3 / 640 + (q * 5) / 7168)));
      own[10 + k] = shear / 4;
    }
    let membrane = 0;
    let twist = 0;
    for (let i = 0; i < 3; i++) {
      let xr = 0;
      let xs = 0;
      let dr = 0;
      let ds = 0;
      for (let k = 0; k < 4; k++) {
        xr += BY_R[k] * x[3 * k + i];
        xs += BY_S[k] * x[3 * k + i];
        dr += BY_R[k] * d[3 * k + i];
        ds += BY_S[k] * d[3 * k + i];
      }
      membrane += xr * xs;
      twist += xr * ds + xs * dr;
    }
    own[4] = membrane / 2;
    own[9] = twist / 2;
  }

  /**
   * Writes ε11, ε22, 2 ε12 [-], κ11, κ22, 2 κ12 [1/m], 2 ε13, 2 ε23 [-] of each element to `out`, for positions and quaternions
   * (x, y, z, w) of the shell's nodes.
   */
  at(positions, quaternions, out) {
    const { count, weights, own, free } = this;
    for (let element = 0; element < count; element++) {
      this.natural(element, positions, quaternions);
      for (let k = 0; k < NATURAL; k++) own[k] -= free[NATURAL * element + k];
      const w = WEIGHTS * element;
      const to = 8 * element;
      for (let row = 0; row < 3; row++) {
        let membrane = 0;
        let bending = 0;
        for (let k = 0; k < 5; k++) {
          const weight = weights[w + 5 * row + k];
          membrane += weight * own[k];
          bending += weight * own[5 + k];
        }
        out[to + row] = membrane;
        out[to + 3 + row] = bending;
      }
      const along = own[10] + own[11];
      const across = own[12] + own[13];
      out[to + 6] = weights[w + 15] * along + weights[w + 16] * across;
      out[to + 7] = weights[w + 17] * along + weights[w + 18] * across;
    }
  }
}
