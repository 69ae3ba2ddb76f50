// A plot of columns over another column, with a mark where the time is now.

import { tickLabels } from "./words.js";

const ROOM = { left: 74, right: 12, top: 8, bottom: 42 };
/** Least distance of labels along an axis [pixels]. */
const SPACING = { x: 70, y: 34 };

/** Round values within a range, at most so many. */
export const roundTicks = ([low, high], most) => {
  const wanted = (high - low) / Math.max(most, 1);
  const power = 10 ** Math.floor(Math.log10(wanted));
  const step = power * ([1, 2, 5, 10].find((factor) => factor * power >= wanted) ?? 10);
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.max(Math.floor(high / step + 1e-9) - first + 1, 0) }, (_, k) => (first + k) * step);
};

/** A symbol at a position. */
const drawMark = (pen, kind, x, y) => {
  pen.beginPath();
  if (kind === "diamond") for (const [dx, dy] of [[0, -6], [6, 0], [0, 6], [-6, 0]]) pen.lineTo(x + dx, y + dy);
  else if (kind === "square") pen.rect(x - 4, y - 4, 8, 8);
  else pen.arc(x, y, kind === "dot" ? 2.5 : 4, 0, 2 * Math.PI);
  pen.closePath();
  if (kind === "ring" || kind === "square") pen.stroke();
  else pen.fill();
};

export class PathPlot {
  /**
   * `curves` are { x, y, stroke, dash, fill, width, label, marks }; dashed ones and envelopes have no mark of the time, a label is
   * at the end of its curve, and marks are instead of a line. `axes` contains the names of both axes with their units, and
   * whether lengths along both are equal, as for a trajectory.
   */
  constructor(card, curves, colours, axes) {
    this.curves = curves;
    this.colours = colours;
    this.axes = axes;
    this.canvas = document.createElement("canvas");
    card.append(this.canvas);
    const of = (key) => {
      let [low, high] = [Infinity, -Infinity];
      for (const curve of curves) for (const value of curve[key]) {
        if (!Number.isFinite(value)) continue;
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
      const room = high > low ? 0.03 * (high - low) : Math.abs(high) * 0.1 || 1;
      return [low - room, high + room];
    };
    [this.x, this.y] = this.whole = [of("x"), of("y")];
    this.row = 0;
    /** Room for labels of curves. */
    this.right = curves.some(({ label }) => label) ? 40 : ROOM.right;
  }

  setSize({ width, height }) {
    [this.width, this.height] = [width, height];
    const ratio = Math.min(window.devicePixelRatio, 2);
    this.canvas.width = width * ratio;
    this.canvas.height = height * ratio;
    this.canvas.style.width = `${width}px`;
    this.canvas.style.height = `${height}px`;
    this.ratio = ratio;
    if (this.axes.isEqual) this.equalise();
    this.draw();
  }

  /** The shorter range grows until a length is as long along both axes. */
  equalise() {
    const sides = [this.width - ROOM.left - this.right, this.height - ROOM.top - ROOM.bottom];
    const scale = Math.max(...this.whole.map(([low, high], k) => (high - low) / sides[k]));
    [this.x, this.y] = this.whole.map(([low, high], k) => {
      const half = (scale * sides[k]) / 2;
      return [(low + high) / 2 - half, (low + high) / 2 + half];
    });
  }

  place(x, y) {
    const { width, height } = this;
    const share = (value, [low, high]) => (value - low) / (high - low);
    const across = width - ROOM.left - this.right;
    const down = height - ROOM.top - ROOM.bottom;
    return [ROOM.left + across * share(x, this.x), ROOM.top + down * (1 - share(y, this.y))];
  }

  mark(row) {
    this.row = row;
    this.draw();
  }

  draw() {
    if (!this.width) return;
    const { width, height } = this;
    const pen = this.canvas.getContext("2d");
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    this.drawAxes(pen);
    pen.save();
    pen.beginPath();
    pen.rect(ROOM.left, ROOM.top, width - ROOM.left - this.right, height - ROOM.top - ROOM.bottom);
    pen.clip();
    for (const { x, y, stroke, dash, fill, width: breadth, marks } of this.curves) {
      pen.strokeStyle = pen.fillStyle = stroke;
      pen.lineWidth = breadth ?? 1.5;
      if (marks) {
        for (let row = 0; row < x.length; row++) drawMark(pen, marks, ...this.place(x[row], y[row]));
        continue;
      }
      pen.setLineDash(dash ?? []);
      pen.beginPath();
      for (let row = 0; row < x.length; row++) pen.lineTo(...this.place(x[row], y[row]));
      if (fill) {
        pen.globalAlpha = fill;
        pen.fill();
        pen.globalAlpha = 1;
        continue;
      }
      pen.stroke();
      pen.setLineDash([]);
      if (dash || this.row >= x.length || this.axes.hasNoMark) continue;
      pen.beginPath();
      pen.arc(...this.place(x[this.row], y[this.row]), 4, 0, 2 * Math.PI);
      pen.fill();
    }
    pen.restore();
    this.drawLabels(pen);
  }

  /** Names at the ends of curves, moved apart where curves end side by side. */
  drawLabels(pen) {
    const named = this.curves.filter(({ label, x }) => label && x.length > 0);
    const ends = named.map((curve) => {
      const last = curve.x.length - 1;
      const [x, y] = this.place(curve.x[last], curve.y[last]);
      return { ...curve, x, y };
    });
    const edge = this.width - this.right;
    pen.textAlign = "left";
    // Curves that end within the plot have their names there.
    const [within, beside] = [true, false].map((isWithin) => ends.filter(({ x }) => x < edge - 0.1 * edge === isWithin));
    for (const { label, stroke, x, y } of within) {
      pen.fillStyle = stroke;
      pen.fillText(label, x + 5, Math.max(y + 4, ROOM.top + 10));
    }
    beside.sort((a, b) => b.y - a.y);
    let free = this.height - ROOM.bottom;
    for (const { label, stroke, y } of beside) {
      const at = Math.min(y + 4, free);
      free = at - 12;
      if (at < ROOM.top) break;
      pen.fillStyle = stroke;
      pen.fillText(label, edge + 5, at);
    }
  }

  /** The value of a curve nearest to a position on the canvas: curve, row and distance [pixels]. */
  nearest(left, top) {
    let found = null;
    this.curves.forEach(({ x, y, marks }, index) => {
      if (marks) return;
      for (let row = 0; row < x.length; row++) {
        const [px, py] = this.place(x[row], y[row]);
        const distance = Math.hypot(px - left, py - top);
        if (!found || distance < found.distance) found = { curve: this.curves[index], row, distance };
      }
    });
    return found;
  }

  /** Lines and labels at round values, and the names of both axes. */
  drawAxes(pen) {
    const { colours, width, height, axes } = this;
    const [right, bottom] = [width - this.right, height - ROOM.bottom];
    pen.strokeStyle = colours.line;
    pen.fillStyle = colours.faint;
    pen.font = "11px system-ui";
    pen.lineWidth = 1;
    pen.strokeRect(ROOM.left, ROOM.top, right - ROOM.left, bottom - ROOM.top);
    const line = (from, to) => {
      pen.beginPath();
      pen.moveTo(...from);
      pen.lineTo(...to);
      pen.stroke();
    };
    const xs = roundTicks(this.x, (right - ROOM.left) / SPACING.x);
    this.labels = { x: tickLabels(xs), y: [] };
    pen.textAlign = "center";
    xs.forEach((x, k) => {
      const [at] = this.place(x, 0);
      line([at, ROOM.top], [at, bottom]);
      const half = pen.measureText(this.labels.x[k]).width / 2;
      pen.fillText(this.labels.x[k], Math.min(at, width - half - 1), bottom + 14);
    });
    const ys = roundTicks(this.y, (bottom - ROOM.top) / SPACING.y);
    this.labels.y = tickLabels(ys);
    pen.textAlign = "right";
    ys.forEach((y, k) => {
      const [, at] = this.place(0, y);
      line([ROOM.left, at], [right, at]);
      pen.fillText(this.labels.y[k], ROOM.left - 6, Math.min(Math.max(at + 4, 11), bottom + 4));
    });
    pen.textAlign = "center";
    pen.fillText(axes.x, (ROOM.left + right) / 2, height - 6, right - ROOM.left);
    pen.save();
    pen.translate(11, (ROOM.top + bottom) / 2);
    pen.rotate(-Math.PI / 2);
    pen.fillText(axes.y, 0, 0, bottom - ROOM.top);
    pen.restore();
  }

  destroy() {
    this.canvas.remove();
  }
}
