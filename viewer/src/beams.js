// Beams drawn by their sections, swept along the line between the nodes.

import * as THREE from "three";

import { turn } from "./kinematics.js";

/** Sections are drawn at least this large, relative to the model. */
const LEAST = 0.0045;
/** Corners of a round section at most, and at least. */
const ROUND = [8, 20];
/** Corners cut off so much of a round section, relative to the model: half a pixel where the model fills a thousand. */
const CUT = 5e-4;

/** Corners of a section of this half width, relative to the model: a polygon of n corners lies within r (1 - cos(π/n)) of its circle. */
const cornersOf = (half) => {
  const [least, most] = ROUND;
  return Math.min(Math.max(Math.ceil(Math.PI / Math.acos(1 - Math.min(CUT / half, 1))), least), most);
};

/** Points of an outline in axes 2 and 3; round ones as many as `count`, those of a rectangle by its corners. */
const outlinePoints = (outline, count, grown) => {
  const [cy, cz] = outline.center ?? [0, 0];
  if (outline.shape === "rectangle" && count === 4) {
    const [a, b] = [Math.max(outline.width / 2, grown), Math.max(outline.height / 2, grown)];
    return [[a, b], [-a, b], [-a, -b], [a, -b]];
  }
  const [a, b] =
    outline.shape === "circle"
      ? [outline.radius, outline.radius]
      : outline.shape === "rectangle"
        ? [outline.width / 2, outline.height / 2]
        : [outline.width, outline.height];
  return Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * k) / count;
    let [c, s] = [Math.cos(angle), Math.sin(angle)];
    if (outline.shape === "rectangle") {
      const scale = 1 / Math.max(Math.abs(c), Math.abs(s));
      [c, s] = [c * scale, s * scale];
    }
    return [cy + Math.max(a, grown) * c, cz + Math.max(b, grown) * s];
  });
};

export class BeamMesh {
  constructor(beam, kinematics, size, colour) {
    this.beam = beam;
    this.kinematics = kinematics;
    const { nodes, stations } = beam;
    this.isSharp = stations.every((station) => station.outline.shape === "rectangle");
    const grown = LEAST * size;
    const largest = Math.max(grown, ...stations.flatMap(({ outline: o }) => [o.radius, o.width, o.height].filter(Boolean)));
    this.sides = this.isSharp ? 4 : cornersOf(largest / size);
    this.outlines = stations.map((station) => outlinePoints(station.outline, this.sides, grown));
    const widest = stations.flatMap(({ outline: o }) => [o.radius, o.width, o.height].filter(Boolean));
    this.isThickened = Math.min(...widest) / 2 < grown;
    this.offsets = new Map(beam.offsets.map(([index, position, [w, x, y, z]]) => [index, [position, [x, y, z, w]]]));
    const segments = nodes.length - 1;
    this.parts = Math.min(Math.max(Math.ceil(40 / segments), 1), 16);
    this.rings = segments * this.parts + 1;
    this.frames = new Float64Array(7 * nodes.length);
    this.lengths = this.segmentLengths();
    this.s = Float64Array.from({ length: this.rings }, (_, ring) => {
      const segment = Math.min(Math.floor(ring / this.parts), segments - 1);
      const u = ring / this.parts - segment;
      return beam.places[segment] + u * (beam.places[segment + 1] - beam.places[segment]);
    });
    this.build(colour);
  }

  /** Distances of neighbouring nodes as the model describes them. */
  segmentLengths() {
    const { reference } = this.kinematics.motion;
    const place = (index) => {
      const at = 7 * this.beam.nodes[index];
      const [position] = this.offsets.get(index) ?? [[0, 0, 0]];
      const q = [reference[at + 4], reference[at + 5], reference[at + 6], reference[at + 3]];
      const out = [0, 0, 0];
      turn(q, 0, ...position, out, 0);
      return out.map((value, k) => value + reference[at + k]);
    };
    return this.beam.nodes.slice(1).map((_, k) => {
      const [a, b] = [place(k), place(k + 1)];
      return Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    });
  }

  build(colour) {
    const { rings, sides, isSharp } = this;
    // Sharp edges have two vertices, one for each side, so that light breaks there.
    this.around = isSharp ? 2 * sides : sides;
    const hull = rings * this.around;
    const total = hull + 2 * sides;
    const geometry = new THREE.BufferGeometry();
    this.places = new THREE.BufferAttribute(new Float32Array(3 * total), 3).setUsage(THREE.DynamicDrawUsage);
    this.normals = new THREE.BufferAttribute(new Float32Array(3 * total), 3).setUsage(THREE.DynamicDrawUsage);
    this.colours = new THREE.BufferAttribute(new Float32Array(3 * total).fill(1), 3).setUsage(THREE.DynamicDrawUsage);
    const index = [];
    for (let ring = 0; ring + 1 < rings; ring++) {
      for (let side = 0; side < sides; side++) {
        const a = ring * this.around + (isSharp ? 2 * side : side);
        const b = ring * this.around + (isSharp ? 2 * side + 1 : (side + 1) % sides);
        index.push(a, b, a + this.around, b, b + this.around, a + this.around);
      }
    }
    for (let k = 1; k + 1 < sides; k++) {
      index.push(hull, hull + k + 1, hull + k, hull + sides, hull + sides + k, hull + sides + k + 1);
    }
    geometry.setIndex(index);
    geometry.setAttribute("position", this.places);
    geometry.setAttribute("normal", this.normals);
    geometry.setAttribute("color", this.colours);
    this.material = new THREE.MeshStandardMaterial({ color: colour, roughness: 0.55, metalness: 0.1 });
    this.material.side = THREE.DoubleSide;
    // Without light, so that colours are those of the legend.
    this.plain = new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide });
    this.mesh = new THREE.Mesh(geometry, this.material);
    this.mesh.frustumCulled = false;
    this.mesh.userData.part = this.beam.name;
    this.hull = hull;
    this.makeProfiles();
  }

  /** Points and normals of the outline at every ring, in axes 2 and 3. */
  makeProfiles() {
    const { beam, rings, sides, around, isSharp, outlines, s } = this;
    this.profile = new Float32Array(4 * rings * around);
    const { stations } = beam;
    for (let ring = 0; ring < rings; ring++) {
      let k = stations.findIndex((station) => station.at >= s[ring] - 1e-12);
      if (k < 0) k = stations.length - 1;
      const before = Math.max(k - 1, 0);
      const span = stations[k].at - stations[before].at;
      const x = span > 0 ? (s[ring] - stations[before].at) / span : 0;
      const at = (side) => {
        const [a, b] = [outlines[before][side % sides], outlines[k][side % sides]];
        return [a[0] + x * (b[0] - a[0]), a[1] + x * (b[1] - a[1])];
      };
      const put = (vertex, [y, z], [ny, nz]) => {
        const length = Math.hypot(ny, nz) || 1;
        this.profile.set([y, z, ny / length, nz / length], 4 * (ring * around + vertex));
      };
      for (let side = 0; side < sides; side++) {
        const [here, next] = [at(side), at(side + 1)];
        if (isSharp) {
          const normal = [next[1] - here[1], here[0] - next[0]];
          put(2 * side, here, normal);
          put(2 * side + 1, next, normal);
        } else {
          const last = at(side + sides - 1);
          put(side, here, [next[1] - last[1], last[0] - next[0]]);
        }
      }
    }
  }

  /** Section frames at the nodes, now. */
  takeFrames() {
    const { kinematics: k, beam, frames, offsets } = this;
    for (let index = 0; index < beam.nodes.length; index++) {
      const node = beam.nodes[index];
      const at = 7 * index;
      const offset = offsets.get(index);
      for (let i = 0; i < 4; i++) frames[at + 3 + i] = k.quaternions[4 * node + i];
      frames[at] = frames[at + 1] = frames[at + 2] = 0;
      if (offset) {
        const [[x, y, z], [bx, by, bz, bw]] = offset;
        turn(k.quaternions, 4 * node, x, y, z, frames, at);
        const [ax, ay, az, aw] = frames.subarray(at + 3, at + 7);
        frames[at + 3] = aw * bx + ax * bw + ay * bz - az * by;
        frames[at + 4] = aw * by - ax * bz + ay * bw + az * bx;
        frames[at + 5] = aw * bz + ax * by - ay * bx + az * bw;
        frames[at + 6] = aw * bw - ax * bx - ay * by - az * bz;
      }
      for (let i = 0; i < 3; i++) frames[at + i] += k.positions[3 * node + i];
    }
  }

  /** Moves all vertices to where the nodes are now. */
  update() {
    this.takeFrames();
    const { frames, rings, parts, lengths, around, sides, profile } = this;
    const places = this.places.array;
    const normals = this.normals.array;
    const segments = lengths.length;
    const q = [0, 0, 0, 1];
    const p = [0, 0, 0];
    const e = new Float64Array(9);
    const m = new Float64Array(6);
    for (let ring = 0; ring < rings; ring++) {
      const segment = Math.min(Math.floor(ring / parts), segments - 1);
      const u = ring / parts - segment;
      const a = 7 * segment;
      const b = a + 7;
      // The line is a cubic whose ends follow the first axes of the sections.
      turn(frames, a + 3, lengths[segment], 0, 0, m, 0);
      turn(frames, b + 3, lengths[segment], 0, 0, m, 3);
      const [u2, u3] = [u * u, u * u * u];
      const [h0, h1, h2, h3] = [2 * u3 - 3 * u2 + 1, u3 - 2 * u2 + u, 3 * u2 - 2 * u3, u3 - u2];
      for (let i = 0; i < 3; i++) {
        p[i] = h0 * frames[a + i] + h1 * m[i] + h2 * frames[b + i] + h3 * m[3 + i];
      }
      let same = 0;
      for (let i = 3; i < 7; i++) same += frames[a + i] * frames[b + i];
      const sign = same < 0 ? -1 : 1;
      let norm = 0;
      for (let i = 0; i < 4; i++) {
        q[i] = (1 - u) * frames[a + 3 + i] + u * sign * frames[b + 3 + i];
        norm += q[i] * q[i];
      }
      norm = 1 / Math.sqrt(norm);
      for (let i = 0; i < 4; i++) q[i] *= norm;
      turn(q, 0, 1, 0, 0, e, 0);
      turn(q, 0, 0, 1, 0, e, 3);
      turn(q, 0, 0, 0, 1, e, 6);
      for (let vertex = 0; vertex < around; vertex++) {
        const from = 4 * (ring * around + vertex);
        const to = 3 * (ring * around + vertex);
        for (let i = 0; i < 3; i++) {
          places[to + i] = p[i] + profile[from] * e[3 + i] + profile[from + 1] * e[6 + i];
          normals[to + i] = profile[from + 2] * e[3 + i] + profile[from + 3] * e[6 + i];
        }
      }
      const cap = ring === 0 ? 0 : ring === rings - 1 ? 1 : -1;
      if (cap < 0) continue;
      for (let side = 0; side < sides; side++) {
        const from = 3 * (ring * around + (this.isSharp ? 2 * side : side));
        const to = 3 * (this.hull + cap * sides + side);
        for (let i = 0; i < 3; i++) {
          places[to + i] = places[from + i];
          normals[to + i] = (cap === 0 ? -1 : 1) * e[i];
        }
      }
    }
    this.places.needsUpdate = true;
    this.normals.needsUpdate = true;
  }

  /** Colours the beam by a function of the fraction s that writes red, green and blue; none for its own colour. */
  paint(colourAt, own) {
    this.mesh.material = colourAt ? this.plain : this.material;
    if (!colourAt) return void this.material.color.set(own);
    const colours = this.colours.array;
    const colour = [0, 0, 0];
    for (let ring = 0; ring < this.rings; ring++) {
      colourAt(this.s[ring], colour);
      for (let vertex = 0; vertex < this.around; vertex++) colours.set(colour, 3 * (ring * this.around + vertex));
      const cap = ring === 0 ? 0 : ring === this.rings - 1 ? 1 : -1;
      for (let side = 0; cap >= 0 && side < this.sides; side++) {
        colours.set(colour, 3 * (this.hull + cap * this.sides + side));
      }
    }
    this.colours.needsUpdate = true;
  }
}
