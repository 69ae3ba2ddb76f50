// The whole model as it is drawn: parts, joints, springs, loads, traces, and what colours them.

import * as THREE from "three";

import { BeamMesh } from "./beams.js";
import { BodyMesh, PointMassMesh } from "./bodies.js";
import { coordinatesOf } from "./coordinates.js";
import { fields, rangeOf, roundOff } from "./fields.js";
import { frame } from "./framing.js";
import { Symbols } from "./joints.js";
import { Outline } from "./outline.js";
import { SectionAxes } from "./section_axes.js";
import { CASTERS } from "./shadow.js";
import { ShellMesh } from "./shells.js";
import { BeamLoad, CableMesh, LoadArrow, SpringMesh } from "./springs.js";
import { shade } from "./theme.js";
import { spelled } from "./words.js";

const spaced = (kind) => kind.replaceAll("_", " ");

/** Points of the drawn geometry over the motion, about so many at most. */
const MAX_POINTS = 120000;
/** Vertices that represent a solid. */
const MAX_CORNERS = 64;

/** Directions in which no vertex of a geometry may be missed: those of a cube's faces, edges and corners. */
const OUTWARD = [-1, 0, 1].flatMap((x) => [-1, 0, 1].flatMap((y) => [-1, 0, 1].map((z) => [x, y, z])));

/** Vertices that represent a geometry: all, or some at equal distances and the outermost ones. */
const corners = ({ attributes }) => {
  const { array, count } = attributes.position;
  const stride = Math.max(1, Math.floor(count / MAX_CORNERS));
  const found = Array.from({ length: Math.ceil(count / stride) }, (_, k) => k * stride);
  if (stride === 1) return found;
  for (const [x, y, z] of OUTWARD) {
    let [farthest, most] = [0, -Infinity];
    for (let k = 0; k < count; k++) {
      const reach = x * array[3 * k] + y * array[3 * k + 1] + z * array[3 * k + 2];
      if (reach > most) [farthest, most] = [k, reach];
    }
    found.push(farthest);
  }
  return found;
};

/** The one of some places that is nearest to their middle. */
const middleOf = (places) => {
  const middle = [0, 1, 2].map((k) => places.reduce((sum, place) => sum + place[k], 0) / places.length);
  const distances = places.map((place) => Math.hypot(...place.map((x, k) => x - middle[k])));
  return distances.indexOf(Math.min(...distances));
};

const isShown = (object) => object === null || (object.visible && isShown(object.parent));

export class ModelView {
  constructor(scene, kinematics, stage, theme, choices) {
    this.scene = scene;
    this.kinematics = kinematics;
    this.stage = stage;
    this.group = new THREE.Group();
    this.theme = { ...theme, up: stage.up };
    /** By their keys: the name, or table and name where another table has the name as well. */
    this.parts = new Map();
    this.keys = new Map();
    this.moving = [];
    this.byKind = { joints: [], springs: [], loads: [] };
    this.selected = null;
    this.field = null;
    // Symbols have the sizes and directions of the start, whenever they are drawn.
    const { time, start } = kinematics;
    kinematics.set(start);
    this.build(choices);
    kinematics.set(time);
    stage.scene.add(this.group);
  }

  build(choices) {
    const { scene, kinematics, theme } = this;
    const size = this.stage.size;
    let colour = 0;
    const next = () => theme.parts[colour++ % theme.parts.length];
    for (const beam of scene.beams) {
      const own = next();
      const drawn = new BeamMesh(beam, kinematics, size, own);
      this.add("parts", drawn, drawn.mesh, own, { kind: "beam", part: beam });
    }
    // Scenes of earlier versions have no shells. Solids are drawn by their surface, as closed shells.
    for (const part of [...(scene.shells ?? []), ...(scene.elastic_solids ?? [])]) {
      const own = next();
      const drawn = new ShellMesh(part, kinematics, size, own);
      this.add("parts", drawn, drawn.mesh, own, { kind: "shell", part });
    }
    for (const body of scene.bodies) {
      const own = next();
      const drawn = new BodyMesh(body, this.attachedTo(body), kinematics, size, own, choices.bodyShape);
      this.add("parts", drawn, drawn.group, own, { kind: "body", part: body });
    }
    const heaviest = Math.max(...scene.point_masses.map((mass) => mass.mass), 0);
    for (const mass of scene.point_masses) {
      const isGround = mass.node === 0;
      const own = isGround ? theme.ground : next();
      const shaped = { ...mass, shape: { center: [0, 0, 0] } };
      const drawn = mass.surface ? new BodyMesh(shaped, [], kinematics, size, own) : new PointMassMesh(mass, heaviest, kinematics, size, own);
      this.add("parts", drawn, drawn.group, own, { kind: isGround ? "ground" : "point mass", part: mass });
    }
    this.buildConnections(size);
  }

  buildConnections(size) {
    const { scene, kinematics, theme } = this;
    /** Those of a table; scenes of earlier versions name none. */
    const of = (list, name, table) => list.filter((each) => each.name === name && (each.table ?? table) === table);
    /** By its symbols, if it has any. */
    const bySymbols = (part, kind, table, list = table) => {
      const own = { symbols: of(scene.symbols, part.name, table), rods: of(scene.rods, part.name, table) };
      if (own.symbols.length === 0) return false;
      const drawn = new Symbols(part, own, kinematics, size, theme);
      this.add(table, drawn, drawn.group, null, { kind, part });
      this.byKind[list].push(drawn.group);
      return true;
    };
    for (const joint of scene.joints) {
      const kind = joint.anchors ? `${spaced(joint.kind)} joint` : spaced(joint.kind);
      const table = joint.kind === "superelement" ? "superelements" : "joints";
      if (!bySymbols(joint, kind, table, "joints")) this.register(table, { kind, part: joint });
    }
    for (const spring of scene.springs) {
      const kind = /friction|stop|bushing|rope/.test(spring.kind) ? spaced(spring.kind) : `${spring.kind} spring`;
      if (bySymbols(spring, kind, "springs")) continue;
      if (!spring.anchors) {
        this.register("springs", { kind, part: spring });
        continue;
      }
      const drawn = new (spring.cable === undefined ? SpringMesh : CableMesh)(spring, kinematics, size, theme);
      this.add("springs", drawn, drawn.mesh, null, { kind, part: spring });
      this.byKind.springs.push(drawn.mesh);
    }
    const span = [scene.start, scene.end];
    for (const load of scene.loads) {
      if (bySymbols(load, spaced(load.kind), "loads")) continue;
      const drawn = new LoadArrow(load, kinematics, size, theme, span);
      const table = load.kind.endsWith("local_load") ? "local_loads" : "loads";
      this.add(table, drawn, drawn.group, null, { kind: spaced(load.kind), part: load });
      this.byKind.loads.push(drawn.group);
    }
    // Loads of coordinates are in no list of their own.
    const known = new Set([...scene.joints, ...scene.springs, ...scene.loads].map((each) => each.name));
    for (const { name, table } of scene.symbols) {
      if (table ? !this.keys.has(`${table} ${name}`) : !known.has(name)) bySymbols({ name }, "load of a joint", table ?? "loads", "loads");
      known.add(name);
    }
    for (const load of scene.beam_loads) {
      const drawn = new BeamLoad(load, kinematics, size, theme, span);
      this.moving.push(drawn);
      this.group.add(drawn.group);
      this.byKind.loads.push(drawn.group);
    }
  }

  /** Lists a part of a table, and returns its key. */
  register(table, facts) {
    const { name } = facts.part;
    const key = this.parts.has(name) ? `${table}.${name}` : name;
    this.keys.set(`${table} ${name}`, key);
    this.parts.set(key, { name, ...facts });
    return key;
  }

  add(table, drawn, object, own, facts) {
    const key = this.register(table, { ...facts, drawn, object, own });
    const castsShadow = table !== "loads" && facts.kind !== "ground";
    object.traverse((child) => {
      child.userData.part = key;
      if (child.isMesh && castsShadow) child.layers.enable(CASTERS);
    });
    this.moving.push(drawn);
    this.group.add(object);
  }

  /** The key of the part to which an output belongs. */
  keyOf({ of, table }) {
    return this.keys.get(`${table} ${of}`) ?? of;
  }

  /** Points of a body where joints, springs, loads and outputs are. */
  attachedTo(body) {
    const { joints, springs, loads } = this.scene;
    const anchors = [...joints, ...springs].flatMap((each) => each.anchors ?? []);
    const all = [...anchors, ...loads.map((load) => load.anchor)];
    return all.filter((anchor) => anchor.node === body.node).map((anchor) => anchor.position);
  }

  show(kind, isShown) {
    for (const object of this.byKind[kind]) object.visible = isShown;
    this.hidden = { ...this.hidden, [kind]: !isShown };
  }

  /**
   * How a part is shown: `isHidden`, `isTransparent`, whether its initial shape is drawn as a ghost, a beam with the axes of its sections, and
   * a shell with the edges of its elements.
   */
  style(name, { isHidden = false, isTransparent = false, hasInitial = false, hasAxes = false, hasEdges = false }) {
    const known = this.parts.get(name);
    if (!known?.object) return;
    known.isHidden = isHidden;
    known.object.visible = !isHidden;
    const materials = new Set([known.drawn.plain, known.drawn.material, ...(known.drawn.painted ?? [])]);
    known.object.traverse((child) => child.isMesh && !this.outline?.has(child) && materials.add(child.material));
    for (const material of materials) {
      if (!material) continue;
      Object.assign(material, { transparent: isTransparent, opacity: isTransparent ? 0.3 : 1, depthWrite: !isTransparent, needsUpdate: true });
    }
    if (known.initial) {
      this.group.remove(known.initial);
      known.initial.traverse((child) => child.geometry?.dispose());
    }
    if (known.axes) {
      this.group.remove(known.axes.lines);
      known.axes.dispose();
    }
    known.axes = hasAxes && known.kind === "beam" ? new SectionAxes(known.drawn, 0.05 * this.stage.size) : null;
    if (known.axes) this.group.add(known.axes.lines);
    known.drawn.showEdges?.(hasEdges);
    known.initial = hasInitial ? this.initialShape(known) : null;
    if (known.initial) this.group.add(known.initial);
  }

  /** A transparent copy of a part at the start of the run. */
  initialShape({ drawn, object }) {
    const { time, start } = this.kinematics;
    this.kinematics.set(start);
    drawn.update();
    const material = new THREE.MeshBasicMaterial({ color: this.theme.faint, transparent: true, opacity: 0.35, depthWrite: false });
    object.updateMatrix();
    const copy = object.clone(true);
    copy.visible = true;
    copy.traverse((child) => {
      child.raycast = () => {};
      if (!child.geometry) return;
      child.geometry = child.geometry.clone();
      // Of lines and outlines there is no ghost.
      if (child.isMesh && !this.outline?.has(child)) child.material = material;
      else child.visible = false;
    });
    this.kinematics.set(time);
    drawn.update();
    return copy;
  }

  isHidden(name) {
    return Boolean(this.parts.get(name)?.isHidden);
  }

  /** Moves all to where the nodes are now. */
  update() {
    for (const drawn of this.moving) drawn.update();
    for (const { isHidden, object, axes } of this.parts.values()) {
      if (isHidden) object.visible = false;
      axes?.update();
    }
    for (const kind of Object.keys(this.hidden ?? {})) {
      if (this.hidden[kind]) for (const object of this.byKind[kind]) object.visible = false;
    }
    if (this.field) this.paint();
  }

  /** Colours parts by a field, or by their own colours. `covered` is `run`, `instant`, or two numbers. */
  colourBy(name, covered) {
    this.field = fields(this.scene, this.kinematics)[name] ?? null;
    this.covered = covered;
    if (!this.field) {
      for (const { drawn, own } of this.parts.values()) drawn?.paint?.(null, own);
      return;
    }
    this.floor = roundOff(this.field, this.kinematics, this.stage.size);
    this.ofRun = this.rangeShown(rangeOf(this.field, this.kinematics));
    this.paint();
  }

  /** Zero for what is round-off. */
  clean(value) {
    return Math.abs(value) > this.floor ? value : 0;
  }

  /** Fields of both signs have zero in the middle of their colours. */
  rangeShown([low, high]) {
    if (!this.field.isSigned) return [this.clean(low), this.clean(high)];
    const most = Math.max(Math.abs(this.clean(low)), Math.abs(this.clean(high)));
    return [-most, most];
  }

  /** The field with the range of its colours, as the legend shows it. */
  shownField() {
    return this.field && { ...this.field, range: this.range };
  }

  paint() {
    const { field, covered, theme } = this;
    this.range = covered === "run" ? this.ofRun : covered === "instant" ? this.rangeShown(field.extremes()) : covered;
    const [low, high] = this.range;
    const share = (value) => (high > low ? (this.clean(value) - low) / (high - low) : field.isSigned ? 0.5 : 0);
    for (const { drawn, kind, part } of this.parts.values()) {
      if (kind === "beam") {
        const value = field.alongBeam(part);
        drawn.paint(value ? (s, out) => shade(share(value(s)), field.isSigned, out) : null, theme.neutral);
      } else if (kind === "shell") {
        const values = field.onShell?.(part);
        drawn.paint(values ? share : null, theme.neutral, values, field.isSigned);
      } else if (kind === "body" || kind === "point mass") {
        const value = field.ofNode?.(part.node);
        drawn.paint(value === undefined ? null : (out) => shade(share(value), field.isSigned, out), theme.neutral);
      }
    }
  }

  /** Points of all that is drawn, at so many instants of the motion as are cheap, and which are framed; sets the height of the lowest that casts a shadow. */
  points() {
    const { kinematics } = this;
    const { time } = kinematics;
    const { start, end, motion } = kinematics;
    const sources = [];
    this.group.traverse((mesh) => mesh.isMesh && sources.push([mesh, corners(mesh.geometry)]));
    const count = sources.reduce((sum, [, indices]) => sum + indices.length, 0);
    const instants = end > start ? Math.min(Math.max(Math.floor(MAX_POINTS / count), 8), 48, Math.max(motion.frames, 24)) : 1;
    const [found, pieces] = [[], []];
    const at = new THREE.Vector3();
    this.lowest = Infinity;
    for (let k = 0; k < instants; k++) {
      kinematics.set(start + ((end - start) * k) / Math.max(instants - 1, 1));
      for (const drawn of this.moving) drawn.update();
      this.group.updateMatrixWorld(true);
      const middle = kinematics.middle();
      for (const [source, [mesh, indices]] of sources.entries()) {
        if (!isShown(mesh)) continue;
        const isGround = this.parts.get(mesh.userData.part)?.kind === "ground";
        pieces.push({ source, middle, isGround, from: found.length, to: found.length + 3 * indices.length });
        const castsShadow = mesh.layers.isEnabled(CASTERS);
        for (const index of indices) {
          at.fromBufferAttribute(mesh.geometry.attributes.position, index).applyMatrix4(mesh.matrixWorld);
          found.push(at.x, at.y, at.z);
          if (castsShadow) this.lowest = Math.min(this.lowest, at.dot(this.theme.up));
        }
      }
    }
    kinematics.set(start);
    const first = kinematics.middle();
    kinematics.set(time);
    const points = new Float32Array(found.length ? found : [0, 0, 0]);
    return { points, framed: frame(points, pieces, first) };
  }

  /** Outlines a part; none for nothing. */
  select(name) {
    this.selected = this.parts.has(name) ? name : null;
    this.outline ??= new Outline(0.012 * this.stage.size);
    this.outline.surround(this.parts.get(this.selected)?.object, this.theme.selected, this.stage.holder);
  }

  /** The part that a diagnostic names: itself, the one that contains a node or coordinate, or the one of an output. */
  partOf(name) {
    const output = this.scene.outputs.find((each) => each.name === name);
    for (let part = output ? this.keyOf(output) : name; part; part = part.slice(0, Math.max(part.search(/[.@][^.@]*$/), 0))) {
      if (this.parts.has(part)) return part;
    }
    return null;
  }

  /** The name of what is drawn at a pixel. */
  pick(x, y) {
    const { clientWidth: width, clientHeight: height } = this.stage.holder;
    this.stage.camera.updateMatrixWorld();
    const caster = new THREE.Raycaster();
    for (const [dx, dy] of [[0, 0], [4, 0], [-4, 0], [0, 4], [0, -4]]) {
      const at = new THREE.Vector2((2 * (x + dx)) / width - 1, 1 - (2 * (y + dy)) / height);
      caster.setFromCamera(at, this.stage.camera);
      for (const child of this.group.children) child.geometry?.computeBoundingSphere();
      const hit = caster.intersectObject(this.group, true).find((found) => found.object.userData.part);
      if (hit) return hit.object.userData.part;
    }
    return null;
  }

  /** A point that stands for a part. */
  anchorOf(name) {
    const known = this.parts.get(name);
    if (!known) return null;
    const { part, kind, drawn } = known;
    if (kind === "beam") return { node: part.nodes[part.nodes.length >> 1], position: [0, 0, 0] };
    if (kind === "shell") return { node: part.nodes[middleOf(part.positions)], position: [0, 0, 0] };
    if (part.node !== undefined) return { node: part.node, position: part.shape?.center ?? [0, 0, 0] };
    if (part.anchor) return part.anchor;
    if (part.anchors) return part.anchors[1];
    return drawn?.anchor ?? (part.joint ? this.anchorOf(this.keyOf({ of: part.joint, table: "joints" })) : null);
  }

  /** Coordinates of a joint or drive now, as names and texts; none of other parts and of modes. */
  coordinatesOf(name) {
    const known = this.parts.get(name);
    const { kinematics, scene } = this;
    if (!known?.part.axes || kinematics.mode) return [];
    known.coordinates ??= coordinatesOf(known.part, scene.joints, kinematics.motion);
    return known.coordinates.map(({ name: coordinate, values }) => {
      const value = kinematics.between(values);
      return [coordinate, coordinate === "angle" ? `${spelled((180 * value) / Math.PI, 4)}° (${spelled(value, 4)} rad)` : `${spelled(value, 4)} m`];
    });
  }

  /** Draws the paths of points. */
  trace(anchors) {
    for (const line of this.lines ?? []) {
      this.group.remove(line);
      line.geometry.dispose();
    }
    this.lines = anchors.map((anchor) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(this.kinematics.path(anchor), 3));
      const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: this.theme.trace }));
      line.raycast = () => {};
      line.frustumCulled = false;
      this.group.add(line);
      return line;
    });
  }

  /** Becomes a transparent copy that cannot be picked. */
  becomeGhost() {
    const material = new THREE.MeshBasicMaterial({ color: this.theme.faint, transparent: true, opacity: 0.35, depthWrite: false });
    this.group.traverse((child) => {
      child.raycast = () => {};
      if (child.isMesh) child.material = material;
      else if (child.isLine) child.visible = false;
    });
  }

  /** Is drawn no more. */
  leave() {
    this.stage.scene.remove(this.group);
  }

  /** Releases the memory of the graphics card. */
  dispose() {
    this.group.traverse((child) => {
      child.geometry?.dispose();
      child.material?.dispose?.();
    });
    for (const drawn of this.moving) {
      drawn.material?.dispose();
      drawn.plain?.dispose();
      drawn.painted?.forEach((material) => material.dispose());
      drawn.outlined?.dispose();
    }
    this.outline?.dispose();
  }
}
