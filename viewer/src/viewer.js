// The page as a whole: results in, picture, plots and panel out.

import * as THREE from "three";

import { CampbellDiagram } from "./campbell.js";
import { decodeHistory, decodeMotion, readTable } from "./decode.js";
import { fields } from "./fields.js";
import { sides } from "./framing.js";
import { Kinematics } from "./kinematics.js";
import { Labels } from "./labels.js";
import { Legend } from "./legend.js";
import { ModelView } from "./model.js";
import { Modes } from "./modes.js";
import { Notices } from "./notices.js";
import { Panel, element } from "./panel.js";
import { Player } from "./player.js";
import { Plots, colours, rangeShown } from "./plots.js";
import { Reactions } from "./reactions.js";
import { SectionDiagram } from "./section_diagram.js";
import { spectrum } from "./spectrum.js";
import { Stage } from "./stage.js";
import { themeOf } from "./theme.js";
import { waterfall } from "./waterfall.js";
import { factor, spelled, tickLabels } from "./words.js";

/** Size of a model of one body, relative to the body. */
const ABOUT_BODIES = 1.5;

/** Marks of events at most. */
const MAX_EVENTS = 200;

const $ = (id) => document.getElementById(id);
const ICONS = {
  play: '<svg width="13" height="14" viewBox="0 0 13 14"><path fill="currentColor" d="M1 0.6v12.8L12.4 7z"/></svg>',
  pause: '<svg width="12" height="14" viewBox="0 0 12 14"><path fill="currentColor" d="M0 0h4v14H0zM8 0h4v14H8z"/></svg>',
  dark: "☾",
  light: "☀",
};
const VIEWS = { iso: [1, -1.35, 0.75], front: [0, -1, 0], side: [1, 0, 0], top: [0, 0, 1] };

export class Viewer {
  /** For tests. */
  spectrum = spectrum;
  waterfall = waterfall;
  tickLabels = tickLabels;
  rangeShown = rangeShown;
  readTable = readTable;

  constructor() {
    this.themeName = this.storedTheme();
    document.documentElement.dataset.theme = this.themeName;
    this.theme = themeOf(this.themeName);
    this.isStale = true;
    /** Models that were drawn before; see `rebuild`. */
    this.replaced = [];
    this.stage = new Stage($("stage"), () => (this.isStale = true));
    this.player = new Player(() => (this.isMoved = true));
    this.plots = new Plots($("plots"), (time) => this.player.seek(time));
    this.panel = new Panel({ selection: $("selection"), parts: $("parts") }, (name) => this.select(name), {
      style: (name, style) => this.style(name, style),
      styleOf: (name) => this.choices.styles.get(name) ?? {},
    });
    this.labels = new Labels(this.stage);
    this.shown = new Notices($("notices"), (notice) => this.point(notice));
    this.modes = new Modes($("modes"), (index) => this.showMode(index));
    this.legend = new Legend($("legend"), (covered) => this.cover(covered));
    this.choices = { bodyShape: "box", colour: "part", covered: "run", component: 5, styles: new Map(), reactions: false, magnification: 1, against: "", traces: false, follow: "" };
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.chosenTheme() || this.setTheme(this.storedTheme()));
    requestAnimationFrame((now) => this.draw(now));
  }

  /** The theme that was chosen, otherwise that of the system, which may change. */
  storedTheme() {
    return this.chosenTheme() ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  }

  chosenTheme() {
    try {
      return localStorage.getItem("lissom-theme") ?? this.chosen ?? null;
    } catch {
      // Pages from files may have no storage.
      return this.chosen ?? null;
    }
  }

  /** Chooses a theme instead of the system's. */
  chooseTheme(name) {
    this.chosen = name;
    try {
      localStorage.setItem("lissom-theme", name);
    } catch {
      // The choice is then for this page alone.
    }
    this.setTheme(name);
  }

  setTheme(name) {
    this.themeName = name;
    document.documentElement.dataset.theme = name;
    this.theme = themeOf(name);
    $("theme").textContent = ICONS[name === "dark" ? "light" : "dark"];
    if (this.kinematics) this.rebuild();
    if (this.campbell) this.campbell.draw();
    else this.plots.history && this.plots.draw();
  }

  /** Shows other results; with `keeps` the view stays as it is. */
  async load(result, keeps = false) {
    const [history, motion] = await Promise.all([
      decodeHistory(result.history, result.columns ?? []),
      decodeMotion(result.motion, result.scene),
    ]);
    const { scene } = result;
    this.result = result;
    this.history = history;
    const isStatic = Boolean(scene?.is_static);
    $("title").textContent = result.title || result.name || "results";
    document.title = `${result.title || result.name} — Lissom`;
    $("facts").textContent = result.facts ?? "";
    this.kinematics = motion && motion.frames > 0 ? new Kinematics(motion) : null;
    if (this.kinematics) this.kinematics.magnification = this.choices.magnification;
    this.modes.load(this.kinematics ? result.modes ?? [] : []);
    if (this.modes.current) {
      this.kinematics.setMode(this.modes.current);
      this.modes.mark(this.modes.index);
    }
    const span = this.kinematics
      ? [this.kinematics.start, this.kinematics.end]
      : [history.times[0] ?? 0, history.times[history.times.length - 1] ?? 0];
    this.isStatic = isStatic;
    this.offerFrames();
    $("stage").parentElement.classList.toggle("empty", !this.kinematics);
    this.campbell?.destroy();
    this.campbell = null;
    document.body.classList.toggle("diagram", Boolean(result.campbell));
    this.plots.load(history, isStatic ? (scene.path ? "length" : "load") : "time");
    const selected = keeps ? this.model?.selected : null;
    this.rebuild();
    if (this.kinematics && !keeps) {
      this.follow(this.framed.travels ? "machine" : "");
      this.firstLook();
      this.stage.lookAsLinked(location.hash);
    }
    this.player.load(...span, isStatic, keeps);
    if (this.kinematics && keeps) {
      this.move();
      if (this.stage.isPoorlyFramed()) this.stage.reframe();
    }
    if (this.modes.current) this.player.speed = 0.5;
    this.offerColours();
    this.select(selected);
    if (result.campbell) this.campbell = new CampbellDiagram(result.campbell, $("plots"), colours);
    this.notices(result.notices ?? []);
    this.markEvents(result.events ?? []);
    $("scrub").disabled = $("play").disabled = !this.player.canPlay;
    this.isMoved = true;
  }

  /** Lays the plots of other results over these: those of a page, or a table. */
  async compare(input) {
    const [file] = input.files;
    input.value = "";
    if (!file) return;
    try {
      const text = await file.text();
      let [history, name, other] = [null, file.name.replace(/\.[a-z]+$/, ""), null];
      if (text.trimStart().startsWith("<")) {
        const page = new DOMParser().parseFromString(text, "text/html");
        const held = page.getElementById("result");
        if (!held) throw new Error("it is no page of results");
        const result = JSON.parse(held.textContent);
        history = await decodeHistory(result.history, result.columns ?? []);
        name = result.name || name;
        other = { scene: result.scene, motion: await decodeMotion(result.motion, result.scene) };
      } else {
        history = readTable(text);
      }
      const own = new Set(this.history.columns.map((column) => column.name));
      if (!history.columns.some((column) => own.has(column.name))) throw new Error("it has no column of these results");
      this.plots.compare(history, name);
      this.plots.compared = file.name;
      this.setGhost(other);
      const remove = element("button", { type: "button", textContent: "×", title: `remove ${name}`, ariaLabel: `remove ${name}` });
      remove.addEventListener("click", () => this.dropComparison());
      $("compared").replaceChildren(`with ${name} `, remove);
      $("compared").hidden = false;
      this.isMoved = true;
    } catch (error) {
      this.notices([...(this.result.notices ?? []), { kind: "error", text: `${file.name} cannot be compared: ${error.message}` }]);
    }
  }

  /** Marks under the time line; each shows its time. */
  markEvents(events) {
    const { start, end } = this.player;
    const marks = events.slice(0, MAX_EVENTS).map(({ time, name }) => {
      const title = `${name} at ${spelled(time, 5)} s`;
      const mark = element("button", { type: "button", title, ariaLabel: title });
      mark.style.left = `${(100 * (time - start)) / (end - start || 1)}%`;
      mark.addEventListener("click", () => this.point({ time }));
      return mark;
    });
    $("events").replaceChildren(...marks);
  }

  /** Removes the other results from plots and picture. */
  dropComparison() {
    this.plots.compare(null);
    this.setGhost(null);
    $("compared").hidden = true;
    this.isMoved = true;
  }

  /** Draws the model of other results, with its own motion, as a ghost; none for nothing. */
  setGhost(other) {
    this.ghost?.leave();
    this.ghost?.dispose();
    this.ghost = null;
    this.compared = other;
    if (!other?.motion?.frames || !this.kinematics || this.modes.current) return;
    const kinematics = new Kinematics(other.motion);
    this.ghost = new ModelView(other.scene, kinematics, this.stage, this.theme, this.choices);
    this.ghost.becomeGhost();
    for (const kind of ["joints", "springs", "loads"]) this.ghost.show(kind, false);
  }

  /** Shows another mode, from the first to the last. */
  showMode(index) {
    const count = this.modes.modes?.length ?? 0;
    if (count === 0) return;
    this.modes.mark((index + count) % count);
    this.kinematics.setMode(this.modes.current);
    this.colourBy(this.choices.colour);
    if (this.choices.traces) this.setTraces(true);
    this.isMoved = true;
  }

  /** Shows notices, with what the picture has of the part and the time that they name. */
  notices(list) {
    // Modes have no time, and along a path the clock shows its length.
    const hasTime = this.history && !this.modes.current && !this.result.scene?.path;
    const at = ({ time }) => hasTime && Number.isFinite(time) && (this.isStatic ? `load ${spelled(time, 4)}` : `${spelled(time, 4)} s`);
    const found = list.map((notice) => {
      const part = notice.part && this.model?.partOf(notice.part);
      const shown = [part, at(notice)].filter(Boolean).join(", ");
      return { ...notice, part, time: hasTime ? notice.time : null, shown };
    });
    this.shown.load(found);
  }

  /** Shows the part and the time of a notice. */
  point({ part, time }) {
    if (part) this.select(part);
    if (!Number.isFinite(time)) return;
    this.player.play(false);
    this.player.seek(time);
  }

  /**
   * Draws the model anew, as after another theme. The old one is given back only when the new one has been drawn with the same
   * shaders: otherwise they would be compiled again for every model, which takes ten times as long as drawing.
   */
  rebuild() {
    const selected = this.model?.selected;
    if (this.model) {
      this.model.leave();
      this.replaced.push(this.model);
    }
    this.model = null;
    if (this.kinematics) {
      this.stage.measure(this.extent(), this.upward());
      this.model = new ModelView(this.result.scene, this.kinematics, this.stage, this.theme, this.choices);
      const { points, framed } = this.model.points();
      this.framed = framed;
      this.stage.surround(points, framed.points, this.model.lowest, this.theme);
      if (framed.travels && this.choices.follow !== "machine") this.stage.framed = points;
      this.stage.grid.visible = $("grid").checked;
      for (const box of document.querySelectorAll("[data-show]")) this.model.show(box.dataset.show, box.checked);
      this.reactions = new Reactions(this.model, this.history, this.kinematics, this.stage.size, this.theme.load);
      this.model.group.add(this.reactions.group);
      this.showReactions(this.choices.reactions);
      for (const [name, style] of this.choices.styles) this.model.style(name, style);
      this.colourBy(this.choices.colour);
      this.setTraces(this.choices.traces);
    }
    if (this.compared) this.setGhost(this.compared);
    this.panel.list(this.model);
    this.select(selected);
    this.isMoved = true;
  }

  /** Corners of the space in which the model moves, and the size of the model without its travel, by which symbols are drawn. */
  extent() {
    const { joints, springs, bodies, point_masses: masses } = this.result.scene;
    const anchors = [...joints, ...springs].flatMap((each) => each.anchors ?? []);
    const { low, high, size } = this.kinematics.bounds(anchors.filter(({ node }) => node === 0).map(({ position }) => position));
    const diagonals = bodies.map(({ shape }) => Math.hypot(...shape.sides));
    for (const { node, surface } of [...bodies, ...masses]) {
      if (!surface?.points.length) continue;
      const at = this.kinematics.motion.reference.subarray(7 * node, 7 * node + 3);
      const sides = [0, 1, 2].map((k) => {
        const [least, most] = surface.points.reduce(([least, most], point) => [Math.min(least, point[k]), Math.max(most, point[k])], [Infinity, -Infinity]);
        [low[k], high[k]] = [Math.min(low[k], at[k] + least), Math.max(high[k], at[k] + most)];
        return most - least;
      });
      const index = bodies.findIndex((body) => body.node === node);
      if (index >= 0) diagonals[index] = Math.hypot(...sides);
    }
    const travel = Math.hypot(...high.map((x, k) => x - low[k]));
    // A single point has room as well.
    const room = travel > 0 ? 0 : Math.max(...bodies.flatMap((body) => body.shape.sides), 1) / 2;
    const largest = Math.max(size, ...diagonals.map((diagonal) => ABOUT_BODIES * diagonal));
    const own = room > 0 ? Math.sqrt(12) * room : largest > 0 ? Math.min(largest, travel) : travel;
    return { low: low.map((x) => x - room), high: high.map((x) => x + room), size: own };
  }

  /** Against gravity, if that is along an axis; otherwise z. */
  upward() {
    const gravity = new THREE.Vector3(...this.result.scene.gravity);
    const size = gravity.length();
    if (size > 0) {
      gravity.divideScalar(-size);
      for (let k = 0; k < 3; k++) if (Math.abs(gravity.getComponent(k)) > 0.999) return gravity;
    }
    return new THREE.Vector3(0, 0, 1);
  }

  /** Plane motion is looked at almost from the front, all other motion and shells at an angle. */
  firstLook() {
    if (this.result.scene.shells?.length || this.result.scene.elastic_solids?.length) return this.look("iso");
    const thickness = sides(this.stage.framed);
    const k = thickness.indexOf(Math.min(...thickness));
    const extent = this.framed.travels ? Math.hypot(...thickness) : this.stage.extent;
    if (thickness[k] > 0.12 * extent || this.kinematics.turnsOutOfPlane(k)) return this.look("iso");
    if (this.stage.up.getComponent(k) !== 0) return this.look("top");
    this.stage.look(this.oriented(k === 0 ? [1, -0.32, 0.24] : [0.28, -1, 0.24]));
  }

  /** A direction given for z upward, for the axis that is upward here. */
  oriented(direction) {
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), this.stage.up);
    return new THREE.Vector3(...direction).applyQuaternion(turn).toArray();
  }

  /** How far the middle of the machine is from where it was at the start. */
  way() {
    const { kinematics, framed } = this;
    return kinematics.middle().map((x, k) => x - framed.start[k]);
  }

  /** Lets the camera go with the selected `part` or with the whole `machine`; with neither it stays. */
  follow(what) {
    const { stage, framed } = this;
    this.choices.follow = what;
    $("follow").checked = what !== "";
    stage.gone.set(...(what === "machine" && this.kinematics ? this.way() : [0, 0, 0]));
    if (framed?.travels) stage.framed = what === "machine" ? framed.points : stage.points;
    this.isMoved = true;
  }

  /** Brings the whole motion into the picture. */
  fit() {
    this.follow("");
    this.stage.fit();
  }

  look(name) {
    const isTop = name === "top";
    // Named views are those of the axes' names, whatever is upward.
    const up = isTop ? new THREE.Vector3(0, 1, 0) : name === "iso" ? this.stage.up : new THREE.Vector3(0, 0, 1);
    this.stage.look(name === "iso" ? this.oriented(VIEWS.iso) : VIEWS[name], up);
  }

  select(name) {
    this.model?.select(name);
    const selected = this.model?.selected ?? null;
    this.panel.show(selected, this.plots);
    this.showDiagram();
    this.plots.mark(selected ? this.panel.outputsOf(selected) : []);
    if (this.choices.traces) this.setTraces(true);
    this.isMoved = true;
  }

  /** The section forces along the selected beam. */
  showDiagram(component = this.choices.component) {
    this.choices.component = component;
    const known = this.model?.parts.get(this.model.selected);
    const isBeam = known?.kind === "beam" && this.kinematics.motion.points > 0;
    this.plots.showDiagram(isBeam ? SectionDiagram.of(known.part, this.kinematics, component, colours(), (other) => this.showDiagram(other)) : null);
  }

  /** Paths of the selected part, or of all points that are observed. */
  setTraces(isWanted) {
    this.choices.traces = isWanted;
    $("traces").checked = isWanted;
    if (!this.model) return;
    const anchor = this.model.selected && this.model.anchorOf(this.model.selected);
    const observed = this.result.scene.outputs.map((output) => output.point).filter((point) => point && point.node !== 0);
    const moving = observed.length ? observed : this.result.scene.bodies.map((body) => ({ node: body.node, position: body.shape.center }));
    this.model.trace(isWanted ? (anchor ? [anchor] : moving) : []);
    this.isMoved = true;
  }

  offerColours() {
    const all = this.kinematics ? Object.keys(fields(this.result.scene, this.kinematics)) : [];
    // Of modes there are shapes alone.
    const names = this.modes.current ? ["displacement"] : all;
    $("colour").replaceChildren(...["part", ...names].map((name) => new Option(name, name)));
    $("colour").value = this.choices.colour;
    if (!$("colour").value) this.colourBy("part");
  }

  colourBy(name) {
    this.choices.colour = name;
    $("colour").value = name;
    this.model?.colourBy(name, this.choices.covered);
    this.legend.show(this.model?.shownField());
    this.isMoved = true;
  }

  /** How a part is shown, also after the model is drawn anew. */
  style(name, style) {
    this.choices.styles.set(name, style);
    this.model?.style(name, style);
    this.isMoved = true;
  }

  /** Reactions as arrows, with their scale. */
  showReactions(isShown) {
    this.choices.reactions = isShown;
    if (!this.reactions) return;
    const { most, length, arrows } = this.reactions;
    $("reactions").closest("label").hidden = arrows.length === 0;
    this.reactions.group.visible = isShown;
    $("force-scale").hidden = !(isShown && arrows.length);
    $("force-scale").textContent = `forces: ${spelled(most / length, 3)} N per m of arrow, at most ${spelled(most, 3)} N`;
    this.isMoved = true;
  }

  /** Colours cover the range of the run, that of this instant, or two numbers. */
  cover(covered) {
    this.choices.covered = covered;
    this.colourBy(this.choices.colour);
  }

  magnify(value) {
    this.choices.magnification = value;
    $("magnify").value = String(value);
    if (!this.kinematics) return;
    this.kinematics.magnification = value;
    if (this.choices.traces) this.setTraces(true);
    this.isMoved = true;
  }

  /** What deformations can be enlarged against: the model as it is described, the start of each beam, or the motion of a part. */
  offerFrames() {
    const { bodies, beams, shells = [], elastic_solids: solids = [] } = this.result.scene ?? { bodies: [], beams: [] };
    const parts = [...bodies.map(({ name, node }) => [name, node]), ...[...beams, ...shells, ...solids].map(({ name, nodes }) => [name, nodes[0]])];
    this.frames = new Map(this.modes.current ? [] : parts);
    const own = beams.length && !this.modes.current ? [["of each beam", "each beam's start"]] : [];
    const texts = [["", "as described"], ...own, ...[...this.frames.keys()].map((name) => [`part ${name}`, name])];
    $("frame").replaceChildren(...texts.map(([value, text]) => new Option(text, value)));
    if (!texts.some(([value]) => value === this.choices.against)) this.choices.against = "";
    this.setFrames();
  }

  setFrames() {
    const { against } = this.choices;
    $("frame").value = against;
    const frames = this.kinematics?.frames;
    if (!frames) return;
    frames.fill(against === "of each beam" ? -1 : this.frames.get(against.replace(/^part /, "")) ?? 0);
    if (against !== "of each beam") return;
    for (const { nodes } of this.result.scene.beams) {
      // Beams that share a node are one structure: they go on from the start of the first.
      const known = nodes.find((node) => frames[node] >= 0);
      const start = known === undefined ? nodes[0] : frames[known];
      for (const node of nodes) frames[node] = start;
    }
  }

  against(value) {
    this.choices.against = value;
    this.setFrames();
    this.magnify(this.choices.magnification);
  }

  /** Moves everything to the time of the player. */
  move() {
    const { time } = this.player;
    this.kinematics?.set(time);
    this.model?.update();
    if (this.ghost) {
      const { start, end } = this.ghost.kinematics;
      this.ghost.kinematics.set(Math.min(Math.max(time, start), end));
      this.ghost.update();
    }
    if (this.choices.covered === "instant") this.legend.show(this.model?.shownField());
    if (this.choices.follow === "machine") this.stage.accompany(this.way());
    const followed = this.choices.follow === "part" && this.model?.selected && this.model.anchorOf(this.model.selected);
    if (followed) this.stage.follow(this.kinematics.point(followed));
    this.plots.setTime(time);
    this.reactions?.update(this.plots.row());
    this.panel.update();
    this.tell();
    this.isMoved = false;
    this.isStale = true;
  }

  tell() {
    const { time, start, end, speed, isPlaying, isLooping } = this.player;
    $("scrub").value = end > start ? String((time - start) / (end - start)) : "0";
    const digits = Math.max(0, Math.min(6, 3 - Math.floor(Math.log10(Math.max(end - start, 1e-9)))));
    const mode = this.modes.current;
    if (mode) $("clock").textContent = `mode ${this.modes.index + 1}: ${spelled(mode.frequency, 5)} Hz`;
    else if (this.result.scene?.path) $("clock").textContent = `${this.result.scene.path.name} ${spelled(this.pathValue(time), 5)}`;
    else $("clock").textContent = this.isStatic ? `load ${time.toFixed(3)}` : `${time.toFixed(digits)} s of ${spelled(end, 6)} s`;
    $("speed").textContent = factor(speed);
    const icon = isPlaying ? ICONS.pause : ICONS.play;
    if (this.icon !== icon) $("play").innerHTML = this.icon = icon;
    $("loop").setAttribute("aria-pressed", String(isLooping));
  }

  /** The load factor, or the number that is varied, at a length of an equilibrium path. */
  pathValue(length) {
    const { lengths, values } = this.result.scene.path;
    const next = lengths.findIndex((known) => known >= length);
    if (next <= 0) return values.at(next) ?? 0;
    const x = (length - lengths[next - 1]) / (lengths[next] - lengths[next - 1] || 1);
    return values[next - 1] + x * (values[next] - values[next - 1]);
  }

  /** Goes some frames on; back where negative. */
  step(frames) {
    this.player.play(false);
    const times = this.kinematics ? this.kinematics.motion.times : this.history.times;
    let now = 0;
    while (now + 1 < times.length && times[now + 1] <= this.player.time + 1e-12) now++;
    this.player.seek(times[Math.min(Math.max(now + frames, 0), times.length - 1)]);
  }

  draw(now) {
    if (this.player.tick(now)) this.isMoved = true;
    if (this.isMoved && this.history) this.move();
    if (this.isStale && this.model) {
      this.stage.sharpen(!this.player.isPlaying);
      this.stage.render(new THREE.Vector3(...this.kinematics.middle()));
      this.labels.update(this.model);
      for (const model of this.replaced.splice(0)) model.dispose();
      this.isStale = false;
      this.drawn = (this.drawn ?? 0) + 1;
    }
    requestAnimationFrame((next) => this.draw(next));
  }
}
