// From the result that stands in the page to numbers: texts and motions are compressed, see docs/viewing/motion-file.md.

const inflate = async (text) => {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = letters.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
};

/** Splits a line at the commas outside of quotes. */
const fields = (line) => {
  const found = [];
  let field = "";
  let inside = false;
  for (let i = 0; i < line.length; i++) {
    const letter = line[i];
    if (letter === '"' && inside && line[i + 1] === '"') {
      field += '"';
      i++;
    } else if (letter === '"') {
      inside = !inside;
    } else if (letter === "," && !inside) {
      found.push(field);
      field = "";
    } else {
      field += letter;
    }
  }
  return [...found, field];
};

/** The table of results: times and columns, with quantity and unit from the summary where it has them. */
export const decodeHistory = async (packed, known) => {
  if (!packed) return { times: new Float64Array(), columns: [] };
  return readTable(new TextDecoder().decode(await inflate(packed)), known);
};

/** The same from the text of a table. */
export const readTable = (text, known = []) => {
  const lines = text.split("\n").filter(Boolean);
  if (!lines[0]?.startsWith("time")) throw new Error("it is no table of results");
  const names = fields(lines[0]).slice(1);
  const rows = lines.length - 1;
  const times = new Float64Array(rows);
  const columns = names.map((name) => {
    const described = known.find((column) => column.name === name) ?? {};
    const dot = name.lastIndexOf(".");
    const [output, component] = dot < 0 ? [name, ""] : [name.slice(0, dot), name.slice(dot + 1)];
    const { quantity = "", unit = "", plot = output } = described;
    return { name, output, component, quantity, unit, plot, values: new Float64Array(rows) };
  });
  for (let row = 0; row < rows; row++) {
    const numbers = lines[row + 1].split(",");
    times[row] = Number(numbers[0]);
    for (let k = 0; k < columns.length; k++) columns[k].values[row] = Number(numbers[k + 1]);
  }
  return { times, columns: withoutRoundOff(columns) };
};

/** Columns whose values are round-off beside the largest of their unit, and numbers of no size at all, are zero. */
const withoutRoundOff = (columns) => {
  const largest = ({ values }) => values.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);
  const most = new Map();
  for (const column of columns) most.set(column.unit, Math.max(most.get(column.unit) ?? 0, largest(column)));
  for (const column of columns) {
    if (largest(column) <= Math.max(1e-13 * most.get(column.unit), 1e-30)) column.values.fill(0);
  }
  return columns;
};

/** Reads the numbers of a packed motion one after the other. */
class Cursor {
  constructor(bytes) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.at = 0;
  }
  double() {
    this.at += 8;
    return this.view.getFloat64(this.at - 8, true);
  }
  /** A whole number: seven bits per byte, least first, and the sign in the last bit. */
  integer() {
    let value = 0;
    let factor = 1;
    let byte;
    do {
      byte = this.bytes[this.at++];
      value += (byte & 127) * factor;
      factor *= 128;
    } while (byte > 127);
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }
}

/** Distance of two numbers of single precision that are about one. */
const SINGLE = 2 ** -24;

/** Frames of a channel are whole multiples of its quantum, kept as second differences. Returns the distance of its numbers. */
const channel = (cursor, frames, out, offset, stride) => {
  const start = cursor.double();
  const quantum = cursor.double();
  let value = 0;
  let slope = 0;
  let largest = 0;
  for (let frame = 0; frame < frames; frame++) {
    if (quantum !== 0) {
      slope += cursor.integer();
      value += slope;
    }
    out[frame * stride + offset] = start + quantum * value;
    largest = Math.max(largest, Math.abs(start + quantum * value));
  }
  return Math.max(quantum, SINGLE * largest);
};

/** Poses and section forces of all frames. */
export const decodeMotion = async (motion) => {
  if (!motion) return null;
  const cursor = new Cursor(await inflate(motion.packed));
  const { nodes, force_points: forcePoints, frames } = motion;
  const doubles = (count) => Float64Array.from({ length: count }, () => cursor.double());
  const times = doubles(frames);
  const reference = doubles(7 * nodes.length);
  const read = (count, quanta = []) => {
    const out = new Float32Array(frames * count);
    for (let k = 0; k < count; k++) quanta[k] = channel(cursor, frames, out, k, count);
    return out;
  };
  /** Distances of the numbers that stand for displacements and rotations, one of each component. */
  const quanta = { displacements: new Float64Array(3 * nodes.length), rotations: new Float64Array(3 * nodes.length) };
  const displacements = read(3 * nodes.length, quanta.displacements);
  const rotations = read(3 * nodes.length, quanta.rotations);
  const points = forcePoints.reduce((sum, beam) => sum + beam.at.length, 0);
  const forces = read(6 * points);
  return { nodes, forcePoints, points, frames, times, reference, displacements, rotations, forces, quanta };
};
