// Amplitudes over frequency and time: spectra of windows that overlap by half.

import { roundTicks } from "./path.js";
import { spectrum } from "./spectrum.js";
import { shade } from "./theme.js";
import { spelled, tickLabels } from "./words.js";

const ROOM = { left: 74, right: 74, top: 8, bottom: 42 };
/** Width of the colour bar, and its distance from the picture. */
const BAR = { width: 12, gap: 10 };
/** Windows over the run, each of two of this many parts. */
const PARTS = 24;
/** Decades below the largest amplitude that have colours. */
const DECADES = 4;

/** Rows of the shortest window. */
const MIN_ROWS = 16;

/** Whether a table of so many rows is long enough. */
export const hasWaterfall = (rows) => Math.floor((2 * rows) / PARTS) >= MIN_ROWS;

/** Centres of the windows [s], frequencies [Hz], and amplitudes by window; none where there are too few rows. */
export const waterfall = (times, values) => {
  const rows = times.length;
  const length = Math.floor((2 * rows) / PARTS);
  if (!hasWaterfall(rows)) return null;
  const found = [];
  for (let first = 0; first + length <= rows; first += length >> 1) {
    const part = times.subarray(first, first + length);
    const one = spectrum(part, [values.subarray(first, first + length)]);
    found.push({ at: (part[0] + part[length - 1]) / 2, duration: part[length - 1] - part[0], frequencies: one?.frequencies ?? [], amplitudes: one?.amplitudes[0] ?? [] });
  }
  const highest = Math.max(...found.map(({ frequencies }) => frequencies.at(-1) ?? 0));
  const most = Math.max(...found.flatMap(({ amplitudes }) => [...amplitudes].map((value) => value ?? 0)));
  return highest > 0 && most > 0 ? { windows: found, highest, most } : null;
};

export class WaterfallPlot {
  constructor(card, found, [start, end], colours, axes) {
    [this.found, this.x, this.y, this.colours, this.axes] = [found, [start, end], [0, found.highest], colours, axes];
    this.canvas = document.createElement("canvas");
    card.append(this.canvas);
  }

  setSize({ width, height }) {
    [this.width, this.height] = [width, height];
    const ratio = Math.min(window.devicePixelRatio, 2);
    [this.canvas.width, this.canvas.height] = [width * ratio, height * ratio];
    [this.canvas.style.width, this.canvas.style.height] = [`${width}px`, `${height}px`];
    this.ratio = ratio;
    this.draw();
  }

  draw() {
    const { width, height, found, colours } = this;
    const pen = this.canvas.getContext("2d");
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const [right, bottom] = [width - ROOM.right, height - ROOM.bottom];
    const x = (time) => ROOM.left + ((right - ROOM.left) * (time - this.x[0])) / (this.x[1] - this.x[0]);
    const y = (frequency) => bottom - ((bottom - ROOM.top) * frequency) / this.y[1];
    const light = [0, 0, 0];
    const colour = (level) => {
      shade(level, false, light);
      return `rgb(${light.map((value) => Math.round(255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055))).join(" ")})`;
    };
    for (const { at, duration, frequencies, amplitudes } of found.windows) {
      const step = frequencies[0];
      for (let k = 0; k < frequencies.length; k++) {
        pen.fillStyle = colour(amplitudes[k] > 0 ? 1 + Math.log10(amplitudes[k] / found.most) / DECADES : 0);
        // Whole pixels leave no gaps.
        const [left, end] = [at - duration / 4, at + duration / 4].map(x);
        const [top, base] = [0.5, -0.5].map((half) => Math.max(y(frequencies[k] + half * step), ROOM.top));
        pen.fillRect(Math.floor(left), Math.floor(top), Math.ceil(end) - Math.floor(left), Math.ceil(base) - Math.floor(top));
      }
    }
    pen.strokeStyle = colours.line;
    pen.strokeRect(ROOM.left, ROOM.top, right - ROOM.left, bottom - ROOM.top);
    pen.fillStyle = colours.faint;
    pen.font = "11px system-ui";
    pen.textAlign = "center";
    const times = roundTicks(this.x, (right - ROOM.left) / 70);
    tickLabels(times).forEach((label, k) => pen.fillText(label, x(times[k]), bottom + 14));
    pen.fillText(this.axes.x, (ROOM.left + right) / 2, height - 6);
    pen.textAlign = "right";
    const levels = roundTicks(this.y, (bottom - ROOM.top) / 34);
    tickLabels(levels).forEach((label, k) => pen.fillText(label, ROOM.left - 6, Math.max(y(levels[k]) + 4, 11)));
    pen.textAlign = "center";
    pen.save();
    pen.translate(11, (ROOM.top + bottom) / 2);
    pen.rotate(-Math.PI / 2);
    pen.fillText(this.axes.y, 0, 0);
    pen.restore();
    this.drawBar(pen, [right + BAR.gap, ROOM.top, bottom], colour);
  }

  /** Colours of amplitudes by decades, from the largest downwards. */
  drawBar(pen, [left, top, bottom], colour) {
    for (let y = top; y < bottom; y++) {
      pen.fillStyle = colour((bottom - y) / (bottom - top));
      pen.fillRect(left, y, BAR.width, 1);
    }
    pen.strokeStyle = this.colours.line;
    pen.strokeRect(left, top, BAR.width, bottom - top);
    pen.fillStyle = this.colours.faint;
    pen.textAlign = "left";
    for (let decade = 0; decade <= DECADES; decade++) {
      const label = spelled(this.found.most / 10 ** decade, 2);
      const y = top + ((bottom - top) * decade) / DECADES;
      pen.fillText(label, left + BAR.width + 4, Math.max(y + 4, 11));
    }
    pen.fillText(this.axes.bar ? `[${this.axes.bar}]` : "", left, bottom + 14);
  }

  destroy() {
    this.canvas.remove();
  }
}
