// A plot of every output under the picture, with one time cursor for all of them.

import uPlot from "uplot";

import { curves } from "./theme.js";
import { spelled } from "./words.js";

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** Columns of one output and one unit belong together. */
const groups = (columns) => {
  const found = new Map();
  for (const column of columns) {
    const key = `${column.output}\n${column.unit}`;
    if (!found.has(key)) found.set(key, []);
    found.get(key).push(column);
  }
  return [...found.values()];
};

export class Plots {
  /** `seek` is told the time that was clicked. */
  constructor(holder, seek) {
    this.holder = holder;
    this.seek = seek;
    this.time = 0;
    this.range = null;
    this.plots = [];
    new ResizeObserver(() => this.resize()).observe(holder);
  }

  load(history, isStatic) {
    this.history = history;
    this.isStatic = isStatic;
    this.range = null;
    this.draw();
  }

  draw() {
    for (const { plot } of this.plots) plot.destroy();
    this.holder.replaceChildren();
    this.plots = [];
    if (this.history.times.length < 2) return;
    for (const columns of groups(this.history.columns)) this.plots.push(this.plot(columns));
    this.resize();
    this.mark(this.marked);
  }

  plot(columns) {
    const card = document.createElement("section");
    card.className = "plot";
    const [{ output, quantity, unit }] = columns;
    const heading = document.createElement("h3");
    const [{ component }] = columns;
    const isOne = columns.length === 1 && component;
    const measured = quantity && quantity !== output ? ` ${isOne ? component : quantity}` : "";
    heading.append(output, Object.assign(document.createElement("span"), { textContent: `${measured}${unit ? ` [${unit}]` : ""}` }));
    card.append(heading);
    this.holder.append(card);
    const axis = { stroke: css("--faint"), grid: { stroke: css("--line"), width: 1 }, ticks: { stroke: css("--line"), width: 1 }, font: "11px system-ui" };
    const series = columns.map((column, k) => ({
      label: column.component || column.output,
      stroke: curves[k % curves.length],
      width: 1.6,
      points: { show: false },
      value: (_, value) => (value == null ? "" : spelled(value)),
    }));
    const options = {
      width: 300,
      height: 170,
      cursor: { sync: { key: "time", setSeries: false }, drag: { x: true, y: false, dist: 6 }, points: { size: 6 }, focus: { prox: 24 } },
      scales: { x: { time: false } },
      axes: [
        { ...axis, size: 28, values: (_, ticks) => ticks.map((tick) => spelled(tick, 5)) },
        { ...axis, size: 58, values: (_, ticks) => ticks.map((tick) => spelled(tick, 4)) },
      ],
      series: [{ label: this.isStatic ? "load" : "t [s]", value: (_, value) => (value == null ? "" : spelled(value)) }, ...series],
      hooks: {
        draw: [(plot) => this.drawTime(plot)],
        ready: [(plot) => this.listen(plot)],
        setScale: [(plot, key) => key === "x" && this.share(plot)],
      },
    };
    const plot = new uPlot(options, [this.history.times, ...columns.map((column) => column.values)], card);
    return { plot, card, output };
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
    for (const { plot } of this.plots) {
      if (plot !== from && (plot.scales.x.min !== min || plot.scales.x.max !== max)) plot.setScale("x", { min, max });
    }
    this.isSharing = false;
  }

  drawTime(plot) {
    const x = plot.valToPos(this.time, "x", true);
    const { left, top, width, height } = plot.bbox;
    if (!(x >= left && x <= left + width)) return;
    const pen = plot.ctx;
    pen.save();
    pen.strokeStyle = css("--accent");
    pen.lineWidth = 1.5 * devicePixelRatio;
    pen.beginPath();
    pen.moveTo(x, top);
    pen.lineTo(x, top + height);
    pen.stroke();
    pen.restore();
  }

  setTime(time) {
    this.time = time;
    const row = this.row();
    for (const { plot, card } of this.plots) {
      if (!this.isSeen(card)) continue;
      plot.redraw(false, false);
      // Where no pointer asks for others, the legend tells the values now.
      if (!(plot.cursor.left >= 0)) plot.setLegend({ idx: row }, false);
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
    for (const { card, output } of this.plots) {
      const isMarked = outputs.includes(output);
      card.classList.toggle("marked", isMarked);
      if (isMarked) first ??= card;
    }
    if (first) this.holder.scrollTo({ left: first.offsetLeft - this.holder.offsetLeft - 8, top: first.offsetTop - this.holder.offsetTop - 8, behavior: "smooth" });
  }

  resize() {
    for (const { plot, card } of this.plots) {
      const width = Math.max(card.clientWidth - 4, 160);
      if (width !== plot.width) plot.setSize({ width, height: 170 });
    }
  }
}
