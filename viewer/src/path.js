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

export class PathPlot {
  /**
   * `curves` are { x, y, stroke, dash, fill }; dashed ones and envelopes have no mark. `axes` contains the names of both
   * axes with their units, and whether lengths along both are equal, as for a trajectory.
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
    const sides = [this.width - ROOM.left - ROOM.right, this.height - ROOM.top - ROOM.bottom];
    const scale = Math.max(...this.whole.map(([low, high], k) => (high - low) / sides[k]));
    [this.x, this.y] = this.whole.map(([low, high], k) => {
      const half = (scale * sides[k]) / 2;
      return [(low + high) / 2 - half, (low + high) / 2 + half];
    });
  }

  place(x, y) {
    const { width, height } = this;
    const share = (value, [low, high]) => (value - low) / (high - low);
    const across = width - ROOM.left - ROOM.right;
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
    pen.rect(ROOM.left, ROOM.top, width - ROOM.left - ROOM.right, height - ROOM.top - ROOM.bottom);
    pen.clip();
    for (const { x, y, stroke, dash, fill } of this.curves) {
      pen.strokeStyle = pen.fillStyle = stroke;
      pen.lineWidth = 1.5;
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
  }

  /** Lines and labels at round values, and the names of both axes. */
  drawAxes(pen) {
    const { colours, width, height, axes } = this;
    const [right, bottom] = [width - ROOM.right, height - ROOM.bottom];
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
