// Orbits: the path of a point in the plane in which it moves, normal to the axis of a shaft.

import { PathPlot } from "./path.js";
import { curves } from "./theme.js";

/** Whether columns are the three coordinates of a point. */
export const isPlace = (columns) => columns.length === 3 && ["position", "displacement"].includes(columns[0].quantity) && columns[0].unit === "m";

const extent = (values) => values.reduce((most, value) => Math.max(most, value), -Infinity) - values.reduce((least, value) => Math.min(least, value), Infinity);

/** The first column that is an angle of more than two turns without a jump, which counts revolutions. */
const rotation = (columns) => columns.find(({ unit, values }) => unit === "rad" && extent(values) > 4 * Math.PI && values.every((value, row) => row === 0 || Math.abs(value - values[row - 1]) < Math.PI));

/** The instants of whole turns since the start as rows with their fractions. */
export const turns = (angles) => {
  const found = [];
  for (let row = 1; row < angles.length; row++) {
    const [before, after] = [row - 1, row].map((k) => (angles[k] - angles[0]) / (2 * Math.PI));
    const step = Math.sign(after - before);
    for (let turn = step > 0 ? Math.floor(before) + 1 : Math.ceil(before) - 1; step * (after - turn) >= 0 && step !== 0; turn += step) found.push(row - 1 + (turn - before) / (after - before));
  }
  return found;
};

/** The plot of an orbit in `card`; none for other columns. A ring is at the start, a square at the end, and dots after each turn. */
export const orbit = (columns, all, times, card, colours) => {
  if (!isPlace(columns)) return null;
  const least = columns.reduce((thinnest, column) => (extent(column.values) < extent(thinnest.values) ? column : thinnest));
  const [x, y] = columns.filter((column) => column !== least);
  const last = times.length - 1;
  const at = (column, place) => {
    const row = Math.min(Math.floor(place), last - 1);
    return column.values[row] + (place - row) * (column.values[row + 1] - column.values[row]);
  };
  const marks = (rows, stroke, kind) => ({ x: rows.map((row) => at(x, row)), y: rows.map((row) => at(y, row)), stroke, marks: kind });
  const turning = rotation(all);
  const drawn = [{ x: x.values, y: y.values, stroke: curves[0] }, marks([0], colours.text, "ring"), marks([last], colours.text, "square")];
  if (turning) drawn.splice(1, 0, marks(turns(turning.values), curves[1], "dot"));
  const told = turning ? `○ start, □ end, • turns of ${turning.output}` : "○ start, □ end";
  return new PathPlot(card, drawn, colours, { x: `${x.name} [m]   ${told}`, y: `${y.name} [m]`, isEqual: true });
};
