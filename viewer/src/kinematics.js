// Where the nodes are at a time: between two frames displacements are straight, rotations uniform.

/** Quaternion (x, y, z, w) of the product of two. */
const multiply = (ax, ay, az, aw, bx, by, bz, bw, out, at) => {
  out[at] = aw * bx + ax * bw + ay * bz - az * by;
  out[at + 1] = aw * by - ax * bz + ay * bw + az * bx;
  out[at + 2] = aw * bz + ax * by - ay * bx + az * bw;
  out[at + 3] = aw * bw - ax * bx - ay * by - az * bz;
};

/** Quaternion of the rotation vector at `from` in `numbers`. */
const exponential = (numbers, from, out) => {
  const [x, y, z] = [numbers[from], numbers[from + 1], numbers[from + 2]];
  const angle = Math.hypot(x, y, z);
  const factor = angle < 1e-6 ? 0.5 : Math.sin(angle / 2) / angle;
  out[0] = factor * x;
  out[1] = factor * y;
  out[2] = factor * z;
  out[3] = Math.cos(angle / 2);
};

/** `vector` turned by the quaternion at `at` in `quaternions`. */
export const turn = (quaternions, at, x, y, z, out, to) => {
  const qx = quaternions[at];
  const qy = quaternions[at + 1];
  const qz = quaternions[at + 2];
  const qw = quaternions[at + 3];
  const tx = 2 * (qy * z - qz * y);
  const ty = 2 * (qz * x - qx * z);
  const tz = 2 * (qx * y - qy * x);
  out[to] = x + qw * tx + qy * tz - qz * ty;
  out[to + 1] = y + qw * ty + qz * tx - qx * tz;
  out[to + 2] = z + qw * tz + qx * ty - qy * tx;
};

export class Kinematics {
  constructor(motion) {
    this.motion = motion;
    const count = motion.nodes.length;
    this.count = count;
    /** Places [m] and quaternions (x, y, z, w) of all nodes, now. */
    this.positions = new Float64Array(3 * count);
    this.quaternions = new Float64Array(4 * count);
    /** Speeds [m/s] and distances from the start [m] of all nodes, now. */
    this.speeds = new Float64Array(count);
    this.distances = new Float64Array(count);
    /** Section forces and moments at all points, now. */
    this.forces = new Float64Array(6 * motion.points);
    /** Displacements are shown so many times as large. */
    this.magnification = 1;
    /** Against the rigid motion of which node each node's are enlarged: 0 is the ground, -1 leaves the node where it is. */
    this.frames = new Int32Array(count);
    /** The recorded frame before the time. */
    this.before = 0;
    this.a = [0, 0, 0, 1];
    this.b = [0, 0, 0, 1];
    this.set(motion.times[0]);
  }

  /** Shows the oscillation of a mode about the first frame; the time is the share of a period. */
  setMode(mode) {
    this.mode = mode;
    const { reference } = this.motion;
    const low = [0, 1, 2].map((k) => Math.min(...this.column(reference, 7, k)));
    const high = [0, 1, 2].map((k) => Math.max(...this.column(reference, 7, k)));
    const size = Math.hypot(...high.map((x, k) => x - low[k])) || 1;
    const length = (node, numbers) => Math.hypot(...numbers.slice(6 * node, 6 * node + 3));
    let most = 0;
    for (let node = 0; node + 1 < this.count; node++) {
      most = Math.max(most, Math.hypot(length(node, mode.real), length(node, mode.imaginary)));
    }
    // The largest displacement is a twelfth of the model; of modes that only turn, a turn of 0.3 rad.
    const turns = Math.max(...mode.real.map(Math.abs), 1e-300);
    this.amplitude = most > 1e-9 * size * turns ? size / 12 / most : 0.3 / turns;
  }

  column(numbers, stride, k) {
    return Array.from({ length: numbers.length / stride - 1 }, (_, row) => numbers[stride * (row + 1) + k]);
  }

  get start() {
    return this.motion.times[0];
  }
  get end() {
    if (this.mode) return 1;
    return this.motion.times[this.motion.frames - 1];
  }

  /** Moves all nodes to where they are at a share of the period of a mode. */
  oscillate(share) {
    const { mode, count, positions, quaternions, a } = this;
    const { reference, displacements, rotations } = this.motion;
    const factor = this.amplitude * this.magnification;
    const [c, s] = [factor * Math.cos(2 * Math.PI * share), factor * Math.sin(2 * Math.PI * share)];
    const turned = [0, 0, 0];
    const base = [0, 0, 0, 1];
    const both = [0, 0, 0, 1];
    for (let node = 0; node < count; node++) {
      const value = (k) => {
        const at = 6 * (node - 1) + k;
        return node === 0 ? 0 : c * mode.real[at] - s * (mode.imaginary[at] ?? 0);
      };
      for (let k = 0; k < 3; k++) {
        positions[3 * node + k] = reference[7 * node + k] + displacements[3 * node + k] + value(k);
        turned[k] = value(3 + k);
      }
      this.distances[node] = Math.hypot(value(0), value(1), value(2)) / (this.amplitude || 1);
      exponential(turned, 0, a);
      exponential(rotations, 3 * node, base);
      multiply(...a, ...base, both, 0);
      const r = 7 * node + 3;
      multiply(...both, reference[r + 1], reference[r + 2], reference[r + 3], reference[r], quaternions, 4 * node);
    }
  }

  /** The last frame not after `time`. */
  frameAt(time) {
    const { times, frames } = this.motion;
    let low = 0;
    let high = frames - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (times[middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** Moves all nodes to where they are at `time`. */
  set(time) {
    const { motion, count, positions, quaternions, a, b } = this;
    const { times, frames, displacements, rotations, reference, forces } = motion;
    const frame = Math.min(this.frameAt(time), Math.max(frames - 2, 0));
    const next = Math.min(frame + 1, frames - 1);
    const duration = times[next] - times[frame];
    const x = duration > 0 ? Math.min(Math.max((time - times[frame]) / duration, 0), 1) : 0;
    this.time = time;
    if (this.mode) return this.oscillate(time);
    this.before = frame;
    const m = this.magnification;
    const before = 3 * count * frame;
    const after = 3 * count * next;
    /** Rotation of a node since the description of the model, into `a`. */
    const turned = (node) => {
      exponential(rotations, before + 3 * node, a);
      exponential(rotations, after + 3 * node, b);
      const same = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0 ? -1 : 1;
      let norm = 0;
      for (let k = 0; k < 4; k++) {
        a[k] += x * (same * b[k] - a[k]);
        norm += a[k] * a[k];
      }
      norm = 1 / Math.sqrt(norm);
      for (let k = 0; k < 4; k++) a[k] *= norm;
    };
    const shiftOf = (node, k) => {
      const first = displacements[before + 3 * node + k];
      return first + x * (displacements[after + 3 * node + k] - first);
    };
    const carriers = new Map();
    if (m !== 1) for (const frame of new Set(this.frames)) if (frame >= 0) carriers.set(frame, this.carrier(frame, turned, shiftOf));
    for (let node = 0; node < count; node++) {
      const p = 3 * node;
      let speed = 0;
      let distance = 0;
      for (let k = 0; k < 3; k++) {
        const first = displacements[before + p + k];
        const change = displacements[after + p + k] - first;
        const shift = first + x * change;
        positions[p + k] = reference[7 * node + k] + shift;
        speed += change * change;
        distance += shift * shift;
      }
      this.speeds[node] = duration > 0 ? Math.sqrt(speed) / duration : 0;
      this.distances[node] = Math.sqrt(distance);
      turned(node);
      const carrier = node > 0 && carriers.get(this.frames[node]);
      if (carrier) this.magnify(node, carrier, m);
      const r = 7 * node + 3;
      multiply(
        a[0], a[1], a[2], a[3],
        reference[r + 1], reference[r + 2], reference[r + 3], reference[r],
        quaternions, 4 * node,
      );
    }
    const width = this.forces.length;
    for (let k = 0; k < width; k++) {
      const first = forces[frame * width + k];
      this.forces[k] = first + x * (forces[next * width + k] - first);
    }
  }

  /** The rigid motion of a node that deformations are shown against: quaternion, and places before and after. */
  carrier(frame, turned, shiftOf) {
    turned(frame);
    const { reference } = this.motion;
    const from = [0, 1, 2].map((k) => reference[7 * frame + k]);
    return { turn: [...this.a], from, to: from.map((place, k) => place + shiftOf(frame, k)) };
  }

  /** Moves a node, whose place is known and whose rotation is `a`, `m` times as far from where the carrier would have taken it. */
  magnify(node, { turn: q, from, to }, m) {
    const { positions, a, b } = this;
    const { reference } = this.motion;
    const rigid = [0, 0, 0];
    turn(q, 0, reference[7 * node] - from[0], reference[7 * node + 1] - from[1], reference[7 * node + 2] - from[2], rigid, 0);
    for (let k = 0; k < 3; k++) {
      const carried = to[k] + rigid[k];
      positions[3 * node + k] = carried + m * (positions[3 * node + k] - carried);
    }
    // The rotation that is left after that of the carrier, by its angle times m.
    multiply(...a, -q[0], -q[1], -q[2], q[3], b, 0);
    const sign = b[3] < 0 ? -1 : 1;
    const sine = Math.hypot(b[0], b[1], b[2]);
    const half = Math.atan2(sine, sign * b[3]);
    const factor = sign * (sine > 1e-12 ? Math.sin(m * half) / sine : m);
    multiply(factor * b[0], factor * b[1], factor * b[2], Math.cos(m * half), ...q, a, 0);
  }

  /** A number that is known in all frames, now: straight between two of them. */
  between(values) {
    const { times, frames } = this.motion;
    const frame = Math.min(this.frameAt(this.time), Math.max(frames - 2, 0));
    const next = Math.min(frame + 1, frames - 1);
    const duration = times[next] - times[frame];
    const x = duration > 0 ? Math.min(Math.max((this.time - times[frame]) / duration, 0), 1) : 0;
    return values[frame] + x * (values[next] - values[frame]);
  }

  /** The place of a point carried by a node, now. */
  point(anchor, out = [0, 0, 0]) {
    const { node, position } = anchor;
    turn(this.quaternions, 4 * node, position[0], position[1], position[2], out, 0);
    for (let k = 0; k < 3; k++) out[k] += this.positions[3 * node + k];
    return out;
  }

  /**
   * Least and greatest places of all nodes but the ground over all frames, with `fixed` places on the ground, and the size of the model: that
   * of its parts at one instant, without their travel. Fixed places count at the start.
   */
  bounds(fixed) {
    const { count, motion } = this;
    const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    const [least, most] = [[...low], [...high]];
    let size = 0;
    const m = this.mode || this.frames.some((frame) => frame !== 0) ? 1 : this.magnification;
    const stride = Math.max(1, Math.floor((motion.frames * count) / 400000));
    for (let frame = 0; frame < motion.frames; frame += stride) {
      least.fill(Infinity);
      most.fill(-Infinity);
      const include = (place, k) => {
        least[k] = Math.min(least[k], place);
        most[k] = Math.max(most[k], place);
      };
      if (frame === 0) for (const place of fixed) place.forEach(include);
      for (let node = count > 1 ? 1 : 0; node < count; node++) {
        for (let k = 0; k < 3; k++) {
          const shift = motion.displacements[3 * (frame * count + node) + k];
          include(motion.reference[7 * node + k] + m * shift, k);
        }
      }
      size = Math.max(size, Math.hypot(...most.map((x, k) => x - least[k])));
      for (let k = 0; k < 3; k++) {
        low[k] = Math.min(low[k], least[k]);
        high[k] = Math.max(high[k], most[k]);
      }
    }
    // A mode goes a twelfth of the model beyond its state.
    const room = this.mode ? Math.hypot(...high.map((x, k) => x - low[k])) / 12 : 0;
    return { low: low.map((x) => x - room), high: high.map((x) => x + room), size };
  }

  /**
   * Whether another part comes as near as `width` to a rail from `base` along an axis, between its `ends`, away from the `tip` that slides on it; looked
   * for at fifty frames.
   */
  crosses([base, tip], axis, { ends: [low, high], width, away }) {
    const { motion, count } = this;
    const now = this.time;
    const [[ax, ay, az], [bx, by, bz]] = [axis, base.position];
    const along = (x, y, z) => ax * (x - bx) + ay * (y - by) + az * (z - bz);
    const step = Math.max(1, Math.ceil(motion.frames / 50));
    let found = false;
    for (let frame = 0; frame < motion.frames && !found; frame += step) {
      this.set(motion.times[frame]);
      const slider = along(...this.point(tip));
      for (let node = 1; node < count && !found; node++) {
        const [x, y, z] = [this.positions[3 * node], this.positions[3 * node + 1], this.positions[3 * node + 2]];
        const way = along(x, y, z);
        if (node === tip.node || way <= low || way >= high || Math.abs(way - slider) <= away) continue;
        found = Math.hypot(x - bx - way * ax, y - by - way * ay, z - bz - way * az) < width;
      }
    }
    this.set(now);
    return found;
  }

  /** Least and greatest distance over all frames along an axis from a place on the ground to one that slides along it, without turning about others. */
  slide([base, tip], axis) {
    const { motion, count } = this;
    const along = (place) => axis.reduce((sum, x, k) => sum + x * place[k], 0);
    const shift = (frame) => along(motion.displacements.subarray(3 * (frame * count + tip.node), 3 * (frame * count + tip.node) + 3));
    const now = this.time;
    this.set(this.start);
    const first = along(this.point(tip)) - along(base.position) - shift(0);
    this.set(now);
    let [least, most] = [Infinity, -Infinity];
    for (let frame = 0; frame < motion.frames; frame++) {
      const place = first + shift(frame);
      least = Math.min(least, place);
      most = Math.max(most, place);
    }
    return [least, most];
  }

  /** The middle between the outermost nodes, now. */
  middle() {
    return [0, 1, 2].map((k) => {
      let [least, most] = [Infinity, -Infinity];
      for (let at = (this.count > 1 ? 3 : 0) + k; at < 3 * this.count; at += 3) {
        least = Math.min(least, this.positions[at]);
        most = Math.max(most, this.positions[at]);
      }
      return (least + most) / 2;
    });
  }

  /** Whether a node turns by more than this about another axis than the one of this number, as wheels and shafts do in a plane. */
  turnsOutOfPlane(axis, angle = 0.1) {
    if (this.mode) return false;
    const { rotations } = this.motion;
    for (let at = 0; at < rotations.length; at += 3) {
      const about = Math.hypot(...[0, 1, 2].filter((k) => k !== axis).map((k) => rotations[at + k]));
      if (about > angle) return true;
    }
    return false;
  }

  /** Places of a carried point in all frames, one after the other. */
  path(anchor) {
    // A mode has a period of 48 places instead of frames.
    const frames = this.mode ? 49 : this.motion.frames;
    const times = this.mode ? Array.from({ length: frames }, (_, k) => k / 48) : this.motion.times;
    const now = this.time;
    const path = new Float32Array(3 * frames);
    const place = [0, 0, 0];
    for (let frame = 0; frame < frames; frame++) {
      this.set(times[frame]);
      this.point(anchor, place);
      path.set(place, 3 * frame);
    }
    this.set(now);
    return path;
  }
}
