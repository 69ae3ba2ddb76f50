// The whole model as it is drawn: parts, joints, springs, loads, traces, and what colours them.

import * as THREE from "three";

import { BeamMesh } from "./beams.js";
import { BodyMesh, PointMassMesh } from "./bodies.js";
import { fields, rangeOf } from "./fields.js";
import { JointSymbol } from "./joints.js";
import { LoadArrow, SpringMesh } from "./springs.js";
import { shade } from "./theme.js";

export class ModelView {
  constructor(scene, kinematics, stage, theme, choices) {
    this.scene = scene;
    this.kinematics = kinematics;
    this.stage = stage;
    this.group = new THREE.Group();
    this.theme = { ...theme, up: stage.up };
    this.parts = new Map();
    this.moving = [];
    this.byKind = { joints: [], springs: [], loads: [] };
    this.selected = null;
    this.field = null;
    this.build(choices);
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
      this.add(beam.name, drawn, drawn.mesh, own, { kind: "beam", part: beam });
    }
    for (const body of scene.bodies) {
      const own = next();
      const drawn = new BodyMesh(body, this.attachedTo(body), kinematics, size, own, choices.bodyShape);
      this.add(body.name, drawn, drawn.group, own, { kind: "body", part: body });
    }
    const heaviest = Math.max(...scene.point_masses.map((mass) => mass.mass), 0);
    for (const mass of scene.point_masses) {
      const own = next();
      const drawn = new PointMassMesh(mass, heaviest, kinematics, size, own);
      this.add(mass.name, drawn, drawn.group, own, { kind: "point mass", part: mass });
    }
    this.buildConnections(size);
  }

  buildConnections(size) {
    const { scene, kinematics, theme } = this;
    const symbols = new Map();
    for (const joint of scene.joints.filter((joint) => joint.anchors)) {
      const symbol = new JointSymbol({ ...joint, around: this.thicknessAt(joint) }, kinematics, size, theme);
      symbols.set(joint.name, symbol);
      this.add(joint.name, symbol, symbol.group, null, { kind: `${joint.kind} joint`, part: joint });
      if (symbol.link) this.group.add(symbol.link);
      this.byKind.joints.push(symbol.group, ...(symbol.link ? [symbol.link] : []));
    }
    for (const drive of scene.joints.filter((joint) => joint.joint)) {
      symbols.get(drive.joint)?.addDrive(drive, theme);
      this.parts.set(drive.name, { kind: drive.kind.replaceAll("_", " "), part: drive });
    }
    for (const spring of scene.springs) {
      if (!spring.anchors) {
        this.parts.set(spring.name, { kind: `${spring.kind} spring`, part: spring });
        continue;
      }
      const drawn = new SpringMesh(spring, kinematics, size, theme);
      this.add(spring.name, drawn, drawn.mesh, null, { kind: `${spring.kind} spring`, part: spring });
      this.byKind.springs.push(drawn.mesh);
    }
    for (const load of scene.loads) {
      const drawn = new LoadArrow(load, kinematics, size, theme, [scene.start, scene.end]);
      this.add(load.name, drawn, drawn.group, null, { kind: load.kind, part: load });
      this.byKind.loads.push(drawn.group);
    }
  }

  /** Radius of a symbol that the sections at a joint do not hide. */
  thicknessAt(joint) {
    const nodes = joint.anchors.map((anchor) => anchor.node);
    const half = ({ outline: o }) => (o.shape === "circle" ? o.radius : o.shape === "ellipse" ? Math.min(o.width, o.height) : Math.min(o.width, o.height) / 2);
    const beams = this.scene.beams.filter((beam) => [beam.nodes[0], beam.nodes[beam.nodes.length - 1]].some((node) => node !== 0 && nodes.includes(node)));
    const thickest = Math.max(...beams.flatMap((beam) => beam.stations.map(half)), 0);
    return Math.min(1.45 * thickest, 0.04 * this.stage.size);
  }

  add(name, drawn, object, own, facts) {
    this.parts.set(name, { ...facts, drawn, object, own });
    this.moving.push(drawn);
    this.group.add(object);
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

  /** Moves all to where the nodes are now. */
  update() {
    for (const drawn of this.moving) drawn.update();
    for (const kind of Object.keys(this.hidden ?? {})) {
      if (this.hidden[kind]) for (const object of this.byKind[kind]) object.visible = false;
    }
    if (this.field) this.paint();
  }

  /** Colours parts by a field, or by their own colours. Gives the range of the field. */
  colourBy(name) {
    this.field = fields(this.scene, this.kinematics)[name] ?? null;
    this.range = this.field && rangeOf(this.field, this.kinematics);
    for (const { drawn, own } of this.parts.values()) if (!this.field && drawn?.paint) drawn.paint(null, own);
    if (this.field) this.paint();
    return this.field && { range: this.range, ...this.field };
  }

  paint() {
    const [low, high] = this.range;
    const share = (value) => (high > low ? (value - low) / (high - low) : 0);
    for (const [name, { drawn, kind, own, part }] of this.parts) {
      if (kind === "beam") {
        const value = this.field.alongBeam(part);
        if (value) drawn.paint((s, out) => shade(share(value(s)), out), own);
        else drawn.paint(null, own);
      } else if (kind === "body" || kind === "point mass") {
        const value = this.field.ofNode?.(part.node);
        if (value === undefined) drawn.paint(null, own);
        else drawn.paint((out) => shade(share(value), out), own);
      }
    }
  }

  /** Marks a part; none for nothing. */
  select(name) {
    const glow = (part, colour) => {
      part?.object?.traverse((child) => child.material?.emissive?.set(colour));
      part?.drawn?.link?.material.emissive.set(colour);
    };
    glow(this.parts.get(this.selected), 0x000000);
    this.selected = this.parts.has(name) ? name : null;
    glow(this.parts.get(this.selected), new THREE.Color(this.theme.selected).multiplyScalar(0.45));
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
    const { part, kind } = known;
    if (kind === "beam") return { node: part.nodes[part.nodes.length >> 1], position: [0, 0, 0] };
    if (part.node !== undefined) return { node: part.node, position: part.shape?.center ?? [0, 0, 0] };
    if (part.anchor) return part.anchor;
    if (part.anchors) return part.anchors[1];
    return part.joint ? this.anchorOf(part.joint) : null;
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

  dispose() {
    this.stage.scene.remove(this.group);
    this.group.traverse((child) => {
      child.geometry?.dispose();
      child.material?.dispose?.();
    });
  }
}
