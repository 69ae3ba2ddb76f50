// Which corners of the elements of a shell are one point of a smooth surface: those at a node that agree about the normal.

/** Cosine of the greatest angle between normals of one smooth surface; those that a node carries for it are equal. */
const SAME = 0.9999;

/**
 * Numbers the corners of elements, four for each, so that those with one number are at one node and agree; `agrees` is called with two
 * corners.
 */
const numbered = (elements, agrees) => {
  const groups = new Int32Array(4 * elements.length);
  const firsts = new Map();
  let count = 0;
  for (let corner = 0; corner < groups.length; corner++) {
    const node = elements[corner >> 2][corner & 3];
    if (!firsts.has(node)) firsts.set(node, []);
    const known = firsts.get(node);
    const first = known.find((other) => agrees(corner, other));
    if (first === undefined) known.push(corner);
    groups[corner] = first === undefined ? count++ : groups[first];
  }
  return { groups, count };
};

/** Corners of one smooth surface: their elements carry the same normal. */
export const smoothCorners = ({ elements, directors }) =>
  numbered(elements, (a, b) => {
    if (!directors?.length) return true;
    const [one, other] = [directors[a >> 2][a & 3], directors[b >> 2][b & 3]];
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2] > SAME;
  });

/** The same where in addition the elements agree, as about their axes. */
export const agreeingCorners = (shell, agree) => {
  const { groups } = smoothCorners(shell);
  return numbered(shell.elements, (a, b) => groups[a] === groups[b] && agree(a >> 2, b >> 2));
};

/** Pairs of corners that are the edges of a shell: all of them once, those at rims and folds, and those at rims alone, with the rim on the right. */
export const shellEdges = ({ elements }, { groups }) => {
  const known = new Map();
  elements.forEach((nodes, element) => {
    for (let k = 0; k < 4; k++) {
      const next = (k + 1) & 3;
      const key = nodes[k] < nodes[next] ? `${nodes[k]} ${nodes[next]}` : `${nodes[next]} ${nodes[k]}`;
      const edge = [4 * element + k, 4 * element + next];
      if (!known.has(key)) known.set(key, []);
      known.get(key).push(edge);
    }
  });
  const groupsOf = (edge) => edge.map((corner) => groups[corner]).sort((a, b) => a - b).join();
  const all = [...known.values()];
  const rims = all.filter((edges) => edges.length === 1);
  const isFold = (edges) => edges.some((edge) => groupsOf(edge) !== groupsOf(edges[0]));
  const first = (edges) => edges[0];
  return { all: all.map(first), outline: all.filter((edges) => edges.length !== 2 || isFold(edges)).map(first), rims: rims.map(first) };
};
