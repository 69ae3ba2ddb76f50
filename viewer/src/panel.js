// The panel at the side of the page: the parts, and details of the selected one.

import { spelled } from "./words.js";

export const element = (tag, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
};

/** A name that has several lines at its points and underscores where it is long. */
export const breakable = (name) => name.split(/(?<=[._])/).flatMap((piece, k) => (k ? [element("wbr"), piece] : [piece]));

const vector = (numbers) => numbers.map((x) => spelled(x, 5)).join("  ");

/** What a part is called: solids are drawn as shells. */
const wordOf = (kind, part) => (kind === "shell" && part?.volume !== undefined ? "solid" : kind);

/** What does not change about a part. */
const constants = (kind, part, drawn) => {
  const rows = [];
  const add = (name, value) => value !== undefined && value !== null && rows.push([name, value]);
  if (kind === "beam") {
    add("length", `${spelled(part.length, 5)} m`);
    add("elements", `${part.elements}, order ${part.order}`);
    add("section", part.stations.length === 1 ? part.stations[0].section : part.stations.map((s) => s.section).join(", "));
    add("mass", `${spelled(part.mass_per_length, 4)} kg/m at the start`);
    add("EA", `${spelled(part.stiffness[0], 4)} N`);
    add("GJ", `${spelled(part.stiffness[3], 4)} N m²`);
    add("EI₂, EI₃", `${spelled(part.stiffness[4], 4)}, ${spelled(part.stiffness[5], 4)} N m²`);
    if (drawn?.isThickened) add("drawn", "thicker than it is");
  }
  if (kind === "shell" && part.volume !== undefined) {
    add("volume", `${spelled(part.volume, 5)} m³`);
    add("elements", String(part.element_count));
    add("nodes", String(part.nodes.length));
  } else if (kind === "shell") {
    const [least, most] = [Math.min(...part.thickness), Math.max(...part.thickness)];
    add("area", `${spelled(part.area, 5)} m²`);
    add("thickness", most > least ? `${spelled(least, 4)} to ${spelled(most, 4)} m` : `${spelled(most, 5)} m`);
    add("elements", String(part.elements.length));
    add("nodes", String(part.nodes.length));
    if (!part.is_homogeneous) add("section", "of layers");
  }
  if (part.mass !== undefined) add("mass", `${spelled(part.mass, 5)} kg`);
  if (part.inertia) add("inertia", `${vector([0, 1, 2].map((k) => part.inertia[k][k]))} kg m²`);
  if (drawn?.isShrunk) add("drawn", "smaller than its inertia");
  if (part.parts?.length) add("connects", part.parts.join(" — "));
  if (part.joint) add("acts on joint", part.joint);
  if (part.part) add("acts on", part.part);
  if (part.follower !== undefined) add("direction", part.follower ? "follows the part" : "fixed in space");
  return rows;
};

export class Panel {
  /** `style` is called with a part and how it is shown, which `styleOf` returns. */
  constructor({ selection, parts }, select, { style, styleOf }) {
    [this.style, this.styleOf] = [style, styleOf];
    this.selection = selection;
    this.parts = parts;
    this.select = select;
    parts.addEventListener("click", (event) => this.choose(event));
    parts.addEventListener("keydown", (event) => event.key === "Enter" && this.choose(event));
  }

  choose(event) {
    const name = event.target.closest("li")?.dataset.name;
    if (name) this.select(name);
  }

  list(model) {
    this.model = model;
    const items = model
      ? [...model.parts].map(([key, { name, kind, part, own }]) => {
          const dot = element("i");
          dot.style.background = own ?? "var(--faint)";
          const item = element("li", { tabIndex: 0 }, dot, element("b", {}, ...breakable(name)), element("span", { textContent: wordOf(kind, part) }));
          item.dataset.name = key;
          return item;
        })
      : [];
    this.parts.replaceChildren(...items);
    this.parts.parentElement.hidden = items.length === 0;
  }

  /** Shows a part; none for nothing. */
  show(name, plots) {
    for (const item of this.parts.children) item.classList.toggle("selected", item.dataset.name === name);
    const known = name && this.model?.parts.get(name);
    this.cells = [];
    if (!known) return void this.selection.replaceChildren();
    const { kind, part, drawn } = known;
    const table = element("table");
    const row = (title, value) => {
      const cell = element("td", { textContent: value });
      table.append(element("tr", {}, element("td", { textContent: title }), cell));
      return cell;
    };
    for (const [title, value] of constants(kind, part, drawn)) row(title, value);
    const { kinematics } = this.model;
    const anchor = this.model.anchorOf(name);
    if (anchor) {
      const where = kind === "beam" || kind === "shell" ? "middle at" : "at";
      const cells = { place: row(`${where} [m]`, ""), speed: row("node's speed", "") };
      this.cells.push(() => {
        cells.place.textContent = vector(kinematics.point(anchor));
        cells.speed.textContent = `${spelled(kinematics.speeds[anchor.node], 4)} m/s`;
      });
    }
    this.model.coordinatesOf(name).forEach(([coordinate], k) => {
      const cell = row(coordinate, "");
      this.cells.push(() => (cell.textContent = this.model.coordinatesOf(name)[k][1]));
    });
    for (const output of this.outputsOf(name)) {
      for (const { name: column, unit } of plots.valuesOf(output)) {
        const cell = row(column, "");
        this.cells.push(() => {
          const now = plots.valuesOf(output).find((value) => value.name === column);
          cell.textContent = `${spelled(now.value, 5)} ${unit}`;
        });
      }
    }
    const heading = element("h2", { textContent: known.name }, element("span", { textContent: wordOf(kind, part) }));
    this.selection.replaceChildren(heading, ...(known.object ? [this.switches(name, kind)] : []), table);
    this.update();
  }

  /** Boxes for how a part is shown. */
  switches(name, kind) {
    const now = this.styleOf(name);
    const own = { beam: [["hasAxes", "section axes"]], shell: [["hasEdges", "elements"]] };
    const boxes = [["isHidden", "hide"], ["isTransparent", "transparent"], ["hasInitial", "initial shape"], ...(own[kind] ?? [])].map(([key, text]) => {
      const box = element("input", { type: "checkbox", checked: Boolean(now[key]) });
      box.addEventListener("change", () => this.style(name, { ...this.styleOf(name), [key]: box.checked }));
      return element("label", {}, box, text);
    });
    return element("div", { className: "checks" }, ...boxes);
  }

  /** Names of the outputs of a part. */
  outputsOf(name) {
    return this.model.scene.outputs.filter((output) => this.model.keyOf(output) === name).map((output) => output.name);
  }

  update() {
    for (const fill of this.cells ?? []) fill();
  }
}
