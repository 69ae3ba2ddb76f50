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
    const { quantity = "", unit = "", plot = output, is_round_off: isRoundOff = false } = described;
    return { name, output, component, quantity, unit, plot, isRoundOff, values: new Float64Array(rows) };
  });
  for (let row = 0; row < rows; row++) {
    const numbers = lines[row + 1].split(",");
    times[row] = Number(numbers[0]);
    for (let k = 0; k < columns.length; k++) columns[k].values[row] = Number(numbers[k + 1]);
  }
  return { times, columns: withoutRoundOff(columns) };
};

/** Columns that are round-off as the program has found, or beside the largest of their unit, and numbers of no size at all, are zero. */
const withoutRoundOff = (columns) => {
  const largest = ({ values }) => values.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);
  const most = new Map();
  for (const column of columns) most.set(column.unit, Math.max(most.get(column.unit) ?? 0, largest(column)));
  for (const column of columns) {
    if (column.isRoundOff || largest(column) <= Math.max(1e-13 * most.get(column.unit), 1e-30)) column.values.fill(0);
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

/** Frames of a channel are whole multiples of its quantum, kept as second differences. */
const channel = (cursor, frames, out, offset, stride) => {
  const start = cursor.double();
  const quantum = cursor.double();
  let value = 0;
  let slope = 0;
  for (let frame = 0; frame < frames; frame++) {
    if (quantum !== 0) {
      slope += cursor.integer();
      value += slope;
    }
    out[frame * stride + offset] = start + quantum * value;
  }
};

/** Numbers of shells and solids in a motion: how many have them, how many each has, and how many constants. Pages of earlier versions have none. */
const fieldsOf = ({ shells = [], elastic_solids: solids = [] }, { field_stride: stride }) => {
  if (!stride) return [];
  const ofShells = shells.map(({ elements }) => ({ count: elements.length, numbers: 9, constants: 4 }));
  return [...ofShells, ...solids.map(({ elements }) => ({ count: new Set(elements.flat()).size, numbers: 2, constants: 0 }))];
};

/** Poses and section forces of all frames, and numbers of shells and solids in some. */
export const decodeMotion = async (motion, scene) => {
  if (!motion) return null;
  const cursor = new Cursor(await inflate(motion.packed));
  const { nodes, force_points: forcePoints, frames, field_stride: stride } = motion;
  const doubles = (count) => Float64Array.from({ length: count }, () => cursor.double());
  const times = doubles(frames);
  const reference = doubles(7 * nodes.length);
  const read = (count, frames) => {
    const out = new Float32Array(frames * count);
    for (let k = 0; k < count; k++) channel(cursor, frames, out, k, count);
    return out;
  };
  const displacements = read(3 * nodes.length, frames);
  const rotations = read(3 * nodes.length, frames);
  const points = forcePoints.reduce((sum, beam) => sum + beam.at.length, 0);
  const forces = read(6 * points, frames);
  const withFields = Math.min(Math.ceil((frames - 1) / stride) + 1, frames);
  const recorded = fieldsOf(scene, motion).map(({ count, constants, numbers }) => ({ count, numbers, constants: doubles(constants * count), values: read(numbers * count, withFields) }));
  return { nodes, forcePoints, points, frames, times, reference, displacements, rotations, forces, fields: { stride, parts: recorded } };
};
