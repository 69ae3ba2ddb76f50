// A plot of every output under the picture, or of several that are drawn together, with one time cursor for all of them.

import uPlot from "uplot";

import { breakable, element } from "./panel.js";
import { isPlace, orbit } from "./orbit.js";
import { PathPlot } from "./path.js";
import { spectrum } from "./spectrum.js";
import { curves } from "./theme.js";
import { WaterfallPlot, hasWaterfall, waterfall } from "./waterfall.js";
import { spelled, tickLabels } from "./words.js";

/** Colours of axes. */
export const colours = () => ({ line: css("--line"), faint: css("--faint"), text: css("--text") });

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** Room for the labels of an axis. */
const roomOf = (_, labels) => 20 + 7 * Math.max(...(labels ?? []).map((label) => label.length), 3);

/** Largest extent of values that are constant except for round-off, relative to their size. */
const ROUND_OFF = 1e-10;

/** Range of an axis from the extremes of its values: the round-off of a constant is not enlarged. */
export const rangeShown = (_, low, high) => {
  if (low == null) return [null, null];
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (high - low > ROUND_OFF * size) return uPlot.rangeNum(low, high, 0.1, true);
  const room = size > 0 ? 0.1 * size : 1;
  return [low - room, high + room];
};

/** Columns of one plot and one unit belong together. */
const groups = (columns) => {
  const found = new Map();
  for (const column of columns) {
    const key = keyOf([column]);
    if (!found.has(key)) found.set(key, []);
    found.get(key).push(column);
  }
  return [...found.values()];
};

/** Word of a choice before the name of a column. */
const WATERFALL = "waterfall ";

/** Interval in which values beside the curves change [ms]. */
const LEGIBLE = 100;

/** Positions of contacts, beside which gaps would be a straight line, have a plot of their own, as in static plots. */
const CENTRE = "centre of contact";

const keyOf = ([{ plot, unit, quantity }]) => `${plot}\n${unit}${quantity === CENTRE ? `\n${CENTRE}` : ""}`;

/** Quantities of columns, each once. */
const quantitiesOf = (columns) => [...new Set(columns.map(({ quantity }) => quantity))].filter(Boolean).join(", ");

/** What distinguishes a column from the others of its plot. */
const labelOf = (column, columns) => {
  if (!column.component || column.component === "value") return column.output;
  return columns.some(({ output }) => output !== column.output) ? column.name : column.component;
};

export class Plots {
  /** `seek` receives the time that was clicked. */
  constructor(holder, seek) {
    this.holder = holder;
    this.seek = seek;
    this.time = 0;
    this.range = null;
    this.plots = [];
    /** Plots that are not shown, the one that fills the space, and their order, by plot and unit. */
    this.hidden = new Set();
    this.largest = null;
    this.order = [];
    this.chooser = document.getElementById("chooser");
    /** What plots are drawn over where that is not time, by plot and unit. */
    this.over = new Map();
    /** Another result on top of this one. */
    this.other = null;
    new ResizeObserver(() => this.resize()).observe(holder);
  }

  /** `clock` is what rows run over: `time`, `load`, or the `length` of a path. */
  load(history, clock) {
    this.history = history;
    this.clock = clock;
    this.range = null;
    this.draw();
  }

  /** Draws the columns of another result, dashed, into the plots of those that have their names; none for nothing. */
  compare(history, name) {
    this.other = history && { ...history, name };
    this.draw();
  }

  /** The same columns of the other result. */
  others(columns) {
    const found = this.other?.columns ?? [];
    return columns.map((column) => found.find((other) => other.name === column.name && (!other.unit || !column.unit || other.unit === column.unit)));
  }

  draw() {
    for (const { plot } of this.plots) plot.destroy();
    this.holder.replaceChildren();
    this.plots = [];
    if (this.diagram && this.largest === null) this.holder.append(this.diagram.card);
    this.chooser.hidden = this.history.times.length < 2;
    if (this.history.times.length < 2) return;
    const found = new Map(groups(this.history.columns).map((columns) => [keyOf(columns), columns]));
    this.order = [...this.order.filter((key) => found.has(key)), ...[...found.keys()].filter((key) => !this.order.includes(key))];
    if (!found.has(this.largest)) this.largest = null;
    for (const key of this.order) {
      if (this.largest ? key === this.largest : !this.hidden.has(key)) this.plots.push(this.plot(found.get(key)));
    }
    this.holder.classList.toggle("single", this.largest !== null);
    this.offer();
    this.resize();
    this.mark(this.marked);
  }

  /** The list in which plots are chosen and moved up. */
  offer() {
    const rows = this.order.map((key, index) => {
      const [name, unit] = key.split("\n");
      const box = element("input", { type: "checkbox", checked: !this.hidden.has(key) });
      box.addEventListener("change", () => this.hide(key, !box.checked));
      const up = element("button", { type: "button", textContent: "↑", title: "move up", ariaLabel: `move ${name} up`, disabled: index === 0 });
      up.addEventListener("click", () => {
        this.order.splice(index - 1, 2, key, this.order[index - 1]);
        this.redraw();
      });
      return element("li", {}, element("label", {}, box, ` ${name}${unit ? ` [${unit}]` : ""}`), up);
    });
    this.chooser.querySelector("ul").replaceChildren(...rows);
  }

  hide(key, isHidden) {
    if (isHidden) this.hidden.add(key);
    else this.hidden.delete(key);
    this.redraw();
  }

  enlarge(key) {
    this.largest = this.largest === key ? null : key;
    this.redraw();
  }

  redraw() {
    this.draw();
    this.setTime(this.time);
  }

  /** Shows a diagram along a beam before the other plots; none for nothing. */
  showDiagram(diagram) {
    if (this.diagram) this.diagram.card.remove();
    this.diagram = diagram;
    if (!diagram || this.largest !== null) return;
    this.holder.prepend(diagram.card);
    this.resize();
    diagram.update();
  }

  plot(columns) {
    const card = document.createElement("section");
    card.className = "plot";
    const [{ plot: name, unit, component }] = columns;
    const outputs = columns.map(({ output }) => output);
    const quantity = quantitiesOf(columns);
    const heading = document.createElement("h3");
    const isOne = columns.length === 1 && component;
    const measured = quantity && quantity !== name ? ` ${isOne ? component : quantity}` : "";
    // Names may be long: they have as many lines as they need.
    heading.append(element("div", {}, element("b", {}, ...breakable(name)), element("span", { textContent: measured }), element("span", { className: "unit", textContent: unit ? ` [${unit}]` : "" })));
    const key = keyOf(columns);
    const button = (textContent, title, action) => {
      const made = element("button", { type: "button", textContent, title, ariaLabel: `${title}: ${name}` });
      made.addEventListener("click", action);
      return made;
    };
    const isLargest = this.largest === key;
    heading.append(this.choice(key), button(isLargest ? "⤡" : "⤢", isLargest ? "show all plots" : "show this plot alone", () => this.enlarge(key)));
    if (!isLargest) heading.append(button("×", "hide this plot", () => this.hide(key, true)));
    card.append(heading);
    this.holder.append(card);
    const over = this.over.get(key) ?? "time";
    const others = this.others(columns);
    if (over === "frequency") {
      const drawn = this.spectrum(columns, others, card);
      if (drawn) return { plot: drawn, card, outputs, isFree: true };
    } else if (over.startsWith(WATERFALL)) {
      const column = columns.find(({ name }) => over === WATERFALL + name) ?? columns[0];
      const drawn = waterfall(this.history.times, column.values);
      const range = [this.history.times[0], this.history.times.at(-1)];
      const axes = { x: `t [s], largest amplitude of ${column.name} ${drawn && spelled(drawn.most, 3)} ${column.unit}`, y: "f [Hz]", bar: column.unit };
      if (drawn) return { plot: new WaterfallPlot(card, drawn, range, colours(), axes), card, outputs, isFree: true };
    } else if (over === "orbit") {
      const drawn = orbit(columns, this.history.columns, this.history.times, card, colours());
      if (drawn) return { plot: drawn, card, outputs, isFree: true };
    } else if (over !== "time") {
      const drawn = this.path(columns, over, card);
      if (drawn) return { plot: drawn, card, outputs, isFree: true };
    }
    const axis = { stroke: css("--faint"), grid: { stroke: css("--line"), width: 1 }, ticks: { stroke: css("--line"), width: 1 }, font: "11px system-ui" };
    const series = columns.map((column, k) => ({
      label: labelOf(column, columns),
      stroke: curves[k % curves.length],
      width: 1.6,
      points: { show: false },
      value: (_, value) => (value == null ? "" : spelled(value)),
    }));
    others.forEach((column, k) => {
      if (!column) return;
      series.push({ ...series[k], label: `${series[k].label}, ${this.other.name}`, dash: [6, 4], spanGaps: true });
    });
    const own = [this.history.times, ...columns.map((column) => column.values)];
    const known = others.filter(Boolean);
    // Rows of both results, in the order of time; a curve goes on between its own rows.
    const table = known.length ? uPlot.join([own, [this.other.times, ...known.map((column) => column.values)]]) : own;
    if (known.length) series.forEach((each) => (each.spanGaps = true));
    const options = {
      width: 300,
      height: 170,
      cursor: { sync: { key: "time", setSeries: false }, drag: { x: true, y: false, dist: 6 }, points: { size: 6 } },
      scales: { x: { time: false }, y: { range: rangeShown } },
      axes: [
        { ...axis, size: 28, space: 64, values: (_, ticks) => tickLabels(ticks) },
        { ...axis, size: roomOf, values: (_, ticks) => tickLabels(ticks) },
      ],
      series: [{ label: this.clock === "time" ? "t [s]" : this.clock, value: (_, value) => (value == null ? "" : spelled(value)) }, ...series],
      hooks: {
        draw: [(plot) => this.placeTime(plot)],
        ready: [(plot) => this.listen(plot)],
        setScale: [(plot, key) => key === "x" && this.share(plot)],
      },
    };
    const plot = new uPlot(options, table, card);
    return { plot, card, outputs, isJoined: known.length > 0 };
  }

  /** What a plot is drawn over. */
  choice(key) {
    const select = document.createElement("select");
    select.className = "over";
    select.setAttribute("aria-label", "drawn over");
    const names = this.history.columns.map((column) => column.name);
    const own = this.history.columns.filter((column) => keyOf([column]) === key);
    const isOrbit = isPlace(own);
    const waterfalls = hasWaterfall(this.history.times.length) ? own.map((column) => [WATERFALL + column.name, own.length > 1 ? `waterfall of ${labelOf(column, own)}` : "waterfall"]) : [];
    const options = [["time", `over ${this.clock}`], ...(isOrbit ? [["orbit", "orbit"]] : []), ...(this.clock === "time" ? [["frequency", "spectrum"], ...waterfalls] : [])];
    select.append(...[...options, ...names.map((name) => [`column ${name}`, `over ${name}`])].map(([value, text]) => new Option(text, value)));
    select.value = this.over.get(key) ?? "time";
    select.addEventListener("change", () => {
      this.over.set(key, select.value);
      this.draw();
      this.setTime(this.time);
    });
    return select;
  }

  /** Amplitudes over frequency. */
  spectrum(columns, others, card) {
    const found = spectrum(this.history.times, columns.map((column) => column.values));
    if (!found) return null;
    const axis = { stroke: css("--faint"), grid: { stroke: css("--line"), width: 1 }, ticks: { stroke: css("--line"), width: 1 }, font: "11px system-ui" };
    const series = columns.map((column, k) => ({ label: labelOf(column, columns), stroke: curves[k % curves.length], width: 1.4, points: { show: false }, value: (_, value) => (value == null ? "" : spelled(value)) }));
    const lists = [...found.amplitudes];
    const known = this.other ? others.filter(Boolean) : [];
    const other = known.length ? spectrum(this.other.times, known.map((column) => column.values)) : null;
    let table = [found.frequencies, ...lists];
    if (other) {
      known.forEach((column, k) => series.push({ ...series[columns.findIndex((own) => own.name === column.name)], label: `${labelOf(column, columns)}, ${this.other.name}`, dash: [6, 4], value: (_, value) => (value == null ? "" : spelled(value)), index: k }));
      table = uPlot.join([table, [other.frequencies, ...other.amplitudes]]);
      series.forEach((each) => (each.spanGaps = true));
    }
    const options = {
      width: 300,
      height: 170,
      cursor: { points: { size: 6 } },
      scales: { x: { time: false }, y: { distr: 3 } },
      axes: [
        { ...axis, size: 28, space: 64, values: (_, ticks) => tickLabels(ticks) },
        { ...axis, size: roomOf, values: (_, ticks) => ticks.map((tick) => (tick == null ? "" : spelled(tick, 4))) },
      ],
      series: [{ label: found.isCut ? "f [Hz], the lowest" : "f [Hz]", value: (_, value) => (value == null ? "" : spelled(value)) }, ...series],
    };
    return new uPlot(options, table, card);
  }

  /** Columns over another one. */
  path(columns, over, card) {
    const name = over.replace(/^column /, "");
    const of = (history) => history?.columns.find((column) => column.name === name);
    const x = of(this.history);
    if (!x) return null;
    const all = columns.map((column, k) => ({ x: x.values, y: column.values, stroke: curves[k % curves.length] }));
    const otherX = of(this.other);
    this.others(columns).forEach((column, k) => {
      if (column && otherX) all.push({ x: otherX.values, y: column.values, stroke: curves[k % curves.length], dash: [6, 4] });
    });
    const named = (column) => `${column.name}${column.unit ? ` [${column.unit}]` : ""}`;
    // Both axes of a trajectory are lengths of one output.
    const isEqual = x.unit !== "" && columns.every((column) => column.unit === x.unit && column.output === x.output);
    const axes = { x: named(x), y: columns.length === 1 ? named(columns[0]) : `${columns[0].output}${columns[0].unit ? ` [${columns[0].unit}]` : ""}`, isEqual };
    return new PathPlot(card, all, colours(), axes);
  }

  /** A click sets the time, a drag zooms, a double click shows all. */
  listen(plot) {
    let down = null;
    plot.over.addEventListener("pointerdown", (event) => (down = event.clientX));
    plot.over.addEventListener("pointerup", (event) => {
      if (down !== null && Math.abs(event.clientX - down) < 4) {
        const { left } = plot.over.getBoundingClientRect();
        this.seek(plot.posToVal(event.clientX - left, "x"));
      }
      down = null;
    });
  }

  /** All plots show the same part of the time. */
  share(from) {
    if (this.isSharing) return;
    const { min, max } = from.scales.x;
    this.isSharing = true;
    for (const { plot, isFree } of this.plots) {
      if (!isFree && plot !== from && (plot.scales.x.min !== min || plot.scales.x.max !== max)) plot.setScale("x", { min, max });
    }
    this.isSharing = false;
  }

  /** Moves the line of the time over a plot, which is not drawn again for it. */
  placeTime(plot) {
    const line = plot.over.querySelector(".now") ?? plot.over.appendChild(element("div", { className: "now" }));
    const { min, max } = plot.scales.x;
    line.hidden = !(this.time >= min && this.time <= max);
    if (!line.hidden) line.style.transform = `translateX(${plot.valToPos(this.time, "x").toFixed(1)}px)`;
  }

  setTime(time) {
    this.time = time;
    this.diagram?.update();
    const row = this.row();
    // Values that change faster cannot be read.
    const isLegible = !(performance.now() - this.lastLegend < LEGIBLE);
    if (isLegible) this.lastLegend = performance.now();
    else this.late ??= setTimeout(() => ((this.late = null), this.setTime(this.time)), LEGIBLE);
    for (const { plot, card, isFree, isJoined } of this.plots) {
      if (!this.isSeen(card)) continue;
      if (isFree) {
        plot.mark?.(row);
        continue;
      }
      this.placeTime(plot);
      // Without a pointer over the plot, the legend shows the current values.
      if (isLegible && !(plot.cursor.left >= 0)) plot.setLegend({ idx: isJoined ? plot.valToIdx(this.time) : row }, false);
    }
  }

  isSeen(card) {
    const { top, bottom } = card.getBoundingClientRect();
    return bottom > 0 && top < window.innerHeight;
  }

  /** The row nearest to the time now. */
  row() {
    const { times } = this.history;
    let [low, high] = [0, Math.max(times.length - 1, 0)];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= this.time) low = middle;
      else high = middle;
    }
    return Math.abs(times[high] - this.time) < Math.abs(times[low] - this.time) ? high : low;
  }

  /** Values of all columns at the row nearest to the time now. */
  valuesOf(output) {
    const { columns } = this.history;
    const row = this.row();
    return columns.filter((column) => column.output === output).map((column) => ({ ...column, value: column.values[row] }));
  }

  /** Marks the plots of some outputs, and brings the first of them into view. */
  mark(outputs = []) {
    this.marked = outputs;
    let first = null;
    for (const { card, outputs: own } of this.plots) {
      const isMarked = own.some((output) => outputs.includes(output));
      card.classList.toggle("marked", isMarked);
      if (isMarked) first ??= card;
    }
    if (this.diagram && outputs.length) this.holder.scrollTo({ top: 0 });
    else if (first) this.holder.scrollTo({ left: first.offsetLeft - this.holder.offsetLeft - 8, top: first.offsetTop - this.holder.offsetTop - 8, behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth" });
  }

  resize() {
    const height = this.largest === null ? 170 : Math.max(this.holder.clientHeight - 110, 170);
    const fit = (plot, card) => {
      const width = Math.max(card.clientWidth - 4, 160);
      if (width !== plot.width || height !== plot.height) plot.setSize({ width, height });
    };
    for (const { plot, card } of this.plots) fit(plot, card);
    if (this.diagram) fit(this.diagram.plot, this.diagram.card);
  }
}
