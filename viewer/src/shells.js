// Shells drawn by their middle surface, which follows the nodes: every element is a fan of four triangles about its centre.

import * as THREE from "three";

import { colourMap, placeInMap } from "./colour_map.js";
import { shellEdges, smoothCorners } from "./shell_corners.js";

/** Lines are this dark beside the shell, and this much before it, relative to the model. */
const DARKER = 0.1;
const NEARER = 0.002;

/** Behind the normal a shell is a little darker, so that the sides differ. */
const darkenBack = (shader) => {
  shader.fragmentShader = shader.fragmentShader.replace(
    "#include <color_fragment>",
    "#include <color_fragment>\n  if (!gl_FrontFacing) diffuseColor.rgb *= 0.8;",
  );
};

const dynamic = (count) => new THREE.BufferAttribute(new Float32Array(3 * count), 3).setUsage(THREE.DynamicDrawUsage);

export class ShellMesh {
  constructor(shell, kinematics, size, colour) {
    /** Lines are so much nearer than the surface that they are seen. */
    this.nearer = { value: NEARER * size };
    this.shell = shell;
    this.kinematics = kinematics;
    this.count = shell.elements.length;
    /** The node of each corner. */
    this.nodes = Int32Array.from(shell.elements.flat(), (index) => shell.nodes[index]);
    const smooth = smoothCorners(shell);
    this.groups = smooth.groups;
    /** Sums of normals, and of directions out of the surface at its rim, by the number of a smooth corner. */
    this.sums = new Float64Array(3 * smooth.count);
    this.outwards = new Float64Array(3 * smooth.count);
    this.edges = shellEdges(shell, smooth);
    this.rims = Int32Array.from(this.edges.rims.flat());
    this.isRim = new Uint8Array(smooth.count);
    for (const corner of this.rims) this.isRim[this.groups[corner]] = 1;
    this.build(colour);
  }

  build(colour) {
    const { count } = this;
    // Four corners and the centre of each element.
    [this.places, this.normals, this.directions] = Array.from({ length: 3 }, () => dynamic(5 * count));
    /** Places of the vertices' values in the map of colours; the second number is the same for all. */
    this.shares = new THREE.BufferAttribute(new Float32Array(10 * count).fill(0.5), 2).setUsage(THREE.DynamicDrawUsage);
    const index = new Uint32Array(12 * count);
    for (let element = 0; element < count; element++) {
      const first = 5 * element;
      for (let k = 0; k < 4; k++) index.set([first + k, first + ((k + 1) & 3), first + 4], 12 * element + 3 * k);
    }
    const surface = (normals) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setIndex(new THREE.BufferAttribute(index, 1));
      geometry.setAttribute("position", this.places);
      geometry.setAttribute("normal", normals);
      return geometry;
    };
    const geometry = surface(this.normals);
    geometry.setAttribute("uv", this.shares);
    this.material = new THREE.MeshStandardMaterial({ color: colour, roughness: 0.6, metalness: 0.05, side: THREE.DoubleSide });
    this.material.onBeforeCompile = darkenBack;
    // Without light, so that colours are those of the legend on both sides.
    this.plain = new THREE.MeshBasicMaterial({ map: colourMap(false), side: THREE.DoubleSide });
    this.mesh = new THREE.Mesh(geometry, this.material);
    this.mesh.frustumCulled = false;
    // An outline around the selected shell goes out of its plane at the rim.
    this.outlined = this.mesh.outlined = surface(this.directions);
    this.rim = this.lines(this.edges.outline, 0.9);
    this.grid = this.lines(this.edges.all, 0.45);
    this.grid.visible = false;
    this.mesh.add(this.rim, this.grid);
    this.darken(colour);
  }

  /** Lines along pairs of corners, at the places of the surface. */
  lines(edges, opacity) {
    const geometry = new THREE.BufferGeometry();
    const vertex = (corner) => 5 * (corner >> 2) + (corner & 3);
    geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from(edges.flat(), vertex), 1));
    geometry.setAttribute("position", this.places);
    const material = new THREE.LineBasicMaterial({ transparent: true, opacity });
    material.onBeforeCompile = (shader) => {
      shader.uniforms.nearer = this.nearer;
      shader.vertexShader = `uniform float nearer;\n${shader.vertexShader}`.replace(
        "#include <project_vertex>",
        `#include <project_vertex>
        vec4 before = projectionMatrix * (mvPosition + vec4(0.0, 0.0, nearer, 0.0));
        gl_Position.z = before.z / before.w * gl_Position.w;`,
      );
    };
    const lines = new THREE.LineSegments(geometry, material);
    lines.frustumCulled = false;
    lines.raycast = () => {};
    return lines;
  }

  /** Lines have a darker colour than the shell. */
  darken(colour) {
    for (const { material } of [this.rim, this.grid]) material.color.set(colour).multiplyScalar(DARKER);
  }

  /** Shows or hides the edges of elements. */
  showEdges(isShown) {
    this.grid.visible = isShown;
  }

  /** Moves all vertices to where the nodes are now. */
  update() {
    const { count, nodes, groups, sums } = this;
    const { positions } = this.kinematics;
    const places = this.places.array;
    sums.fill(0);
    for (let element = 0; element < count; element++) {
      const centre = 3 * (5 * element + 4);
      places[centre] = places[centre + 1] = places[centre + 2] = 0;
      for (let k = 0; k < 4; k++) {
        const corner = 4 * element + k;
        const here = 3 * nodes[corner];
        const next = 3 * nodes[4 * element + ((k + 1) & 3)];
        const last = 3 * nodes[4 * element + ((k + 3) & 3)];
        const x = positions[here];
        const y = positions[here + 1];
        const z = positions[here + 2];
        const to = 3 * (5 * element + k);
        places[to] = x;
        places[to + 1] = y;
        places[to + 2] = z;
        places[centre] += x / 4;
        places[centre + 1] += y / 4;
        places[centre + 2] += z / 4;
        const ax = positions[next] - x;
        const ay = positions[next + 1] - y;
        const az = positions[next + 2] - z;
        const bx = positions[last] - x;
        const by = positions[last + 1] - y;
        const bz = positions[last + 2] - z;
        const sum = 3 * groups[corner];
        sums[sum] += ay * bz - az * by;
        sums[sum + 1] += az * bx - ax * bz;
        sums[sum + 2] += ax * by - ay * bx;
      }
    }
    this.normalize(sums);
    this.reachOut();
    this.spread();
    for (const attribute of [this.places, this.normals, this.directions]) attribute.needsUpdate = true;
  }

  normalize(vectors) {
    for (let k = 0; k < vectors.length; k += 3) {
      const length = Math.sqrt(vectors[k] ** 2 + vectors[k + 1] ** 2 + vectors[k + 2] ** 2) || 1;
      vectors[k] /= length;
      vectors[k + 1] /= length;
      vectors[k + 2] /= length;
    }
  }

  /** Directions out of the surface at its rim: across the edges, in the plane. */
  reachOut() {
    const { rims, nodes, groups, sums, outwards } = this;
    const { positions } = this.kinematics;
    outwards.fill(0);
    for (let k = 0; k < rims.length; k++) {
      const corner = rims[k];
      const [from, to] = k % 2 === 0 ? [corner, rims[k + 1]] : [rims[k - 1], corner];
      const [a, b] = [3 * nodes[from], 3 * nodes[to]];
      const [x, y, z] = [positions[b] - positions[a], positions[b + 1] - positions[a + 1], positions[b + 2] - positions[a + 2]];
      const length = Math.sqrt(x * x + y * y + z * z) || 1;
      const at = 3 * groups[corner];
      outwards[at] += (y * sums[at + 2] - z * sums[at + 1]) / length;
      outwards[at + 1] += (z * sums[at] - x * sums[at + 2]) / length;
      outwards[at + 2] += (x * sums[at + 1] - y * sums[at]) / length;
    }
    this.normalize(outwards);
  }

  /** Writes normals and outward directions from the smooth corners to the vertices. */
  spread() {
    const { count, groups, sums, outwards, isRim } = this;
    const [normals, directions] = [this.normals.array, this.directions.array];
    for (let element = 0; element < count; element++) {
      const centre = 3 * (5 * element + 4);
      for (let i = 0; i < 3; i++) normals[centre + i] = 0;
      for (let k = 0; k < 4; k++) {
        const group = groups[4 * element + k];
        const to = 3 * (5 * element + k);
        const source = isRim[group] ? outwards : sums;
        for (let i = 0; i < 3; i++) {
          normals[to + i] = sums[3 * group + i];
          normals[centre + i] += sums[3 * group + i] / 4;
          directions[to + i] = source[3 * group + i];
        }
      }
      for (let i = 0; i < 3; i++) directions[centre + i] = normals[centre + i];
    }
  }

  /** Colours the shell by values at its corners, of which `share` is the place in the colours from 0 to 1; none for its own colour. */
  paint(share, own, values, isSigned) {
    this.mesh.material = share ? this.plain : this.material;
    this.darken(own);
    if (!share) return void this.material.color.set(own);
    this.plain.map = colourMap(isSigned);
    const shares = this.shares.array;
    for (let element = 0; element < this.count; element++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) {
        const value = share(values[4 * element + k]);
        sum += value;
        shares[2 * (5 * element + k)] = placeInMap(value);
      }
      shares[2 * (5 * element + 4)] = placeInMap(sum / 4);
    }
    this.shares.needsUpdate = true;
  }
}
