// What the first picture of a motion shows: the whole motion, or only the machine where that travels far.

/** A machine that travels over so many times its size is framed alone, and the camera goes with it. */
const FAR = 6;
/** Parts of the ground are framed if the picture becomes at most so many times as large. */
const ROOM = 1.5;

/** Lengths of the sides of the box of points, one after the other. */
export const sides = (points) => {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (let k = 0; k < points.length; k++) {
    low[k % 3] = Math.min(low[k % 3], points[k]);
    high[k % 3] = Math.max(high[k % 3], points[k]);
  }
  return high.map((x, k) => Math.max(x - low[k], 0));
};

const diagonal = (points) => Math.hypot(...sides(points));

/** The points of some pieces, shifted. */
const joined = (points, pieces, shiftOf = () => [0, 0, 0]) => {
  const found = new Float32Array(pieces.reduce((sum, { from, to }) => sum + to - from, 0));
  let at = 0;
  for (const piece of pieces) {
    const shift = shiftOf(piece);
    for (let k = piece.from; k < piece.to; k++) found[at++] = points[k] + shift[k % 3];
  }
  return found;
};

/**
 * Points to be framed, and whether the camera goes with the machine; the points are then those of all instants, shifted to the
 * middle of the machine at the start. `points` are those of the drawn geometry over the motion; a piece is a range of them: of the mesh
 * `source` at the instant at which the middle of the machine is `middle`, at the start `start`.
 */
export const frame = (points, pieces, start) => {
  const starts = new Map();
  const moving = new Set();
  for (const { source, from } of pieces) {
    if (!starts.has(source)) starts.set(source, from);
    const first = starts.get(source);
    if ([0, 1, 2].some((k) => points[first + k] !== points[from + k])) moving.add(source);
  }
  const machine = pieces.filter(({ source }) => moving.has(source));
  if (machine.length) {
    const own = joined(points, machine, ({ middle }) => start.map((x, k) => x - middle[k]));
    if (diagonal(joined(points, machine)) > FAR * diagonal(own)) return { points: own, start, travels: true };
  }
  const parts = joined(points, pieces.filter(({ isGround }) => !isGround));
  const isSmall = parts.length > 0 && diagonal(points) > ROOM * diagonal(parts);
  return { points: isSmall ? parts : points, start, travels: false };
};
