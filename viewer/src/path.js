// A plot of columns over another column, with a mark where the time is now.

import { spelled } from "./words.js";

const ROOM = { left: 62, right: 12, top: 8, bottom: 26 };

export class PathPlot {
  /** `curves` are { label, x, y, stroke, dash }; those of `owner` have its rows. */
  constructor(card, curves, colours) {
    this.curves = curves;
    this.colours = colours;
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
    [this.x, this.y] = [of("x"), of("y")];
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
    this.draw();
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
    const { colours, width, height } = this;
    const pen = this.canvas.getContext("2d");
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.strokeStyle = colours.line;
    pen.strokeRect(ROOM.left, ROOM.top, width - ROOM.left - ROOM.right, height - ROOM.top - ROOM.bottom);
    pen.fillStyle = colours.faint;
    pen.font = "11px system-ui";
    pen.textAlign = "center";
    for (const share of [0, 0.5, 1]) {
      const value = this.x[0] + share * (this.x[1] - this.x[0]);
      pen.fillText(spelled(value, 3), Math.min(this.place(value, this.y[0])[0], width - 24), height - 9);
    }
    pen.textAlign = "right";
    for (const share of [0, 0.5, 1]) {
      const value = this.y[0] + share * (this.y[1] - this.y[0]);
      pen.fillText(spelled(value, 3), ROOM.left - 6, Math.max(this.place(this.x[0], value)[1] + 4, 11));
    }
    for (const { x, y, stroke, dash } of this.curves) {
      pen.strokeStyle = stroke;
      pen.lineWidth = 1.5;
      pen.setLineDash(dash ?? []);
      pen.beginPath();
      for (let row = 0; row < x.length; row++) pen.lineTo(...this.place(x[row], y[row]));
      pen.stroke();
      pen.setLineDash([]);
      if (dash || this.row >= x.length) continue;
      pen.fillStyle = stroke;
      pen.beginPath();
      pen.arc(...this.place(x[this.row], y[this.row]), 4, 0, 2 * Math.PI);
      pen.fill();
    }
  }

  destroy() {
    this.canvas.remove();
  }
}
