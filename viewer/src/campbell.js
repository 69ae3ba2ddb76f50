// A Campbell diagram: frequencies and damping over the speed of rotation, with the crossings of its lines and multiples of the speed.

import { element } from "./panel.js";
import { PathPlot } from "./path.js";
import { curves } from "./theme.js";
import { spelled } from "./words.js";

/** Damping ratios below this are round-off. */
const UNDAMPED = 1e-9;

/** How lines of a whirl are drawn, and the sign at their ends. */
const WHIRLS = {
  forward: { sign: " ↻", width: 2, name: "↻ forward" },
  backward: { sign: " ↺", width: 2, dash: [7, 4], name: "↺ backward" },
  mixed: { sign: "", width: 1.4, dash: [9, 3, 2, 3], name: "mixed" },
  changes: { sign: "", width: 1.4, dash: [2, 3], name: "changes" },
  none: { sign: "", width: 1.2, name: "none" },
};

/** Units of the speed by a factor to Hz. */
const SPEEDS = { rpm: 60, "rad/s": 2 * Math.PI, Hz: 1 };

/** A table with a heading row. */
const tableOf = (heading, rows) =>
  element("table", {}, element("thead", {}, element("tr", {}, ...heading.map((name) => element("th", { textContent: name })))), element("tbody", {}, ...rows));

const row = (...cells) => element("tr", {}, ...cells.map((cell) => element("td", {}, cell)));

/** A line up to a limit. */
const below = (x, y, limit) => {
  const end = y.findIndex((value) => value > limit);
  if (end <= 0) return { x: end < 0 ? x : [], y: end < 0 ? y : [] };
  const share = (limit - y[end - 1]) / (y[end] - y[end - 1]);
  return { x: [...x.slice(0, end), x[end - 1] + share * (x[end] - x[end - 1])], y: [...y.slice(0, end), limit] };
};

export class CampbellDiagram {
  /** `colours` returns those of axes. */
  constructor(diagram, holder, colours) {
    [this.diagram, this.holder, this.colours] = [diagram, holder, colours];
    this.multiples = diagram.multiples ?? [];
    this.crossings = diagram.crossings ?? [];
    this.turns = diagram.lines.some(({ rotations }) => rotations.some((rotation) => rotation > 0));
    this.over = this.turns ? "rpm" : "value";
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(holder);
    this.draw();
  }

  /** Where values of the parameter and rates of rotation [Hz] are on the horizontal axis. */
  across(values, rotations) {
    return this.over === "value" ? values : rotations.map((rotation) => rotation * SPEEDS[this.over]);
  }

  get axis() {
    const { vary, unit } = this.diagram;
    return this.over === "value" ? `${vary}${unit ? ` [${unit}]` : ""}` : `speed of rotation [${this.over}]`;
  }

  draw() {
    const { lines } = this.diagram;
    const colours = this.colours();
    this.holder.replaceChildren();
    const drawn = (key) =>
      lines.map((line) => {
        const { sign, width, dash } = WHIRLS[line.whirl] ?? WHIRLS.none;
        const { number, values, rotations } = line;
        return { line, x: this.across(values, rotations), y: line[key], stroke: curves[(number - 1) % curves.length], width, dash, label: `${number}${sign}` };
      });
    const frequencies = drawn("frequencies");
    const most = Math.max(...frequencies.flatMap(({ y }) => y), 0);
    const [first] = lines.toSorted((a, b) => b.values.length - a.values.length);
    const x = first ? this.across(first.values, first.rotations) : [];
    const rays = (this.turns ? this.multiples : []).map((multiple) => {
      return { ...below(x, first.rotations.map((rotation) => multiple * rotation), 1.1 * most), stroke: colours.faint, width: 1, label: `${multiple}P` };
    });
    const found = this.crossings.map(({ value, rotation, multiple }) => [this.across([value], [rotation])[0], multiple * rotation]);
    const marks = { x: found.map(([at]) => at), y: found.map(([, frequency]) => frequency), stroke: colours.text, marks: "diamond" };
    this.plots = [this.card("natural frequencies", "frequency [Hz]", [...rays, ...frequencies, marks], 0.62)];
    const isDamped = lines.some(({ damping }) => damping.some((ratio) => Math.abs(ratio) > UNDAMPED));
    if (isDamped) this.plots.push(this.card("damping", "damping ratio [-]", drawn("damping"), 0.36));
    this.holder.append(this.listCrossings(), this.listLines(isDamped));
    this.resize();
  }

  /** A plot with its heading; `share` is its height relative to the window's. */
  card(name, label, drawn, share) {
    const choice = element("select", { className: "over", ariaLabel: "drawn over" });
    const options = [["value", this.diagram.vary], ...(this.turns ? Object.keys(SPEEDS).map((unit) => [unit, `speed [${unit}]`]) : [])];
    choice.append(...options.map(([value, text]) => new Option(`over ${text}`, value)));
    choice.value = this.over;
    choice.addEventListener("change", () => {
      this.over = choice.value;
      this.draw();
    });
    const told = element("span", { textContent: "↻ solid: forward, ↺ dashed: backward" });
    const card = element("section", { className: "plot wide" }, element("h3", {}, element("b", { textContent: name }), told, choice));
    this.holder.append(card);
    const plot = new PathPlot(card, drawn, this.colours(), { x: this.axis, y: label, hasNoMark: true });
    card.addEventListener("pointermove", (event) => {
      const { left, top } = plot.canvas.getBoundingClientRect();
      const near = plot.nearest(event.clientX - left, event.clientY - top);
      if (near?.distance < 30 && near.curve.line) told.textContent = this.describe(near.curve.line, near.row);
    });
    return { plot, card, share };
  }

  /** A mode in words. */
  describe({ number, whirl, values, rotations, frequencies, damping }, k) {
    const speed = this.turns ? `${spelled(60 * rotations[k], 5)} rpm` : `${this.diagram.vary} ${spelled(values[k], 5)}`;
    return `line ${number}, whirl ${whirl}: ${spelled(frequencies[k], 5)} Hz, damping ratio ${spelled(Math.abs(damping[k]) > UNDAMPED ? damping[k] : 0, 3)} at ${speed}`;
  }

  listCrossings() {
    const { vary } = this.diagram;
    const rows = this.crossings.map(({ line, multiple, value, rotation, whirl }) =>
      row(`${multiple}P`, spelled(60 * rotation, 5), spelled(2 * Math.PI * rotation, 5), spelled(value, 5), spelled(multiple * rotation, 5), String(line), WHIRLS[whirl]?.name ?? whirl));
    const made = rows.length ? tableOf(["order", "rpm", "rad/s", vary, "Hz", "line", "whirl"], rows) : element("p", { textContent: "No line meets a multiple of the speed of rotation." });
    return element("section", { className: "plot critical" }, element("h3", {}, element("b", { textContent: "critical speeds" })), made);
  }

  listLines(isDamped) {
    const range = (numbers) => [Math.min(...numbers), Math.max(...numbers)].map((value) => spelled(value, 4)).filter((text, k, all) => k === 0 || text !== all[0]).join(" to ");
    const rows = this.diagram.lines.map(({ number, whirl, frequencies, damping }) => {
      const dot = element("i");
      dot.style.background = curves[(number - 1) % curves.length];
      return row(element("span", {}, dot, ` ${number}`), WHIRLS[whirl]?.name ?? whirl, range(frequencies), ...(isDamped ? [range(damping)] : []));
    });
    return element("section", { className: "plot lines" }, element("h3", {}, element("b", { textContent: "lines" })), tableOf(["line", "whirl", "Hz", ...(isDamped ? ["damping ratio"] : [])], rows));
  }

  resize() {
    for (const { plot, card, share } of this.plots) {
      const [width, height] = [Math.max(card.clientWidth - 4, 160), Math.max(share * window.innerHeight, 200)];
      if (width !== plot.width || height !== plot.height) plot.setSize({ width, height });
    }
  }

  destroy() {
    this.observer.disconnect();
    this.holder.replaceChildren();
  }
}
