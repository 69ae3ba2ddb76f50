// Colours of the page and of what is drawn; colour-blind readers can distinguish those of parts and curves.

/** Okabe and Ito, without black. */
export const curves = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#7F7F7F", "#B8A800"];

const light = {
  background: "#f4f6f9",
  parts: ["#6f9bc8", "#d99a6c", "#74b49b", "#c59bbd", "#d8bf6b", "#8fb8d6", "#a3a8b0", "#b5a98f"],
  joint: "#f1b434", pin: "#4d5663", axis: "#8a94a3", ground: "#a9b2be", drive: "#d1495b", spring: "#5b8c5a", stop: "#8a6d3b",
  load: "#d1495b", moment: "#8e5bb5", grid: "#c0c8d2", trace: "#d55e00", text: "#1d2430",
  neutral: "#a7afba", faint: "#6b7686", line: "#e3e7ed", selected: "#1f6feb", sky: "#ffffff", floor: "#b9c0ca", shadow: 0.38,
};

const dark = {
  ...light,
  background: "#12161c",
  parts: ["#7fadd9", "#e0a478", "#7fc4a9", "#cfa6c8", "#e0c977", "#9cc6e2", "#aab0b9", "#c2b698"],
  pin: "#8b95a3", axis: "#6b7686", ground: "#525c69", grid: "#303945", trace: "#f0a35e",
  neutral: "#58616d", text: "#e6eaf0", faint: "#98a3b3", line: "#2a323c", selected: "#58a6ff", sky: "#e9eef5", floor: "#4a5361", shadow: 0.6,
};

export const themeOf = (name) => (name === "dark" ? dark : light);

/** Viridis at equal distances. */
const viridis = [
  [0.267, 0.005, 0.329], [0.283, 0.141, 0.458], [0.254, 0.265, 0.530], [0.207, 0.372, 0.553], [0.164, 0.471, 0.558],
  [0.128, 0.567, 0.551], [0.135, 0.659, 0.518], [0.267, 0.749, 0.441], [0.478, 0.821, 0.318], [0.741, 0.873, 0.150],
  [0.993, 0.906, 0.144],
];

/** From the numbers of a screen to those of light. */
const linear = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);

/** From blue over a light grey to red, at equal distances: for values of both signs [Moreland 2009]. */
const diverging = [
  [0.230, 0.299, 0.754], [0.404, 0.535, 0.930], [0.603, 0.732, 1.000], [0.788, 0.846, 0.940], [0.866, 0.866, 0.866],
  [0.940, 0.806, 0.741], [0.968, 0.657, 0.537], [0.887, 0.413, 0.325], [0.706, 0.016, 0.150],
];

const mapOf = (isSigned) => (isSigned ? diverging : viridis);

/** Writes the colour of a share from 0 to 1, in numbers of light. */
export const shade = (share, isSigned, out) => {
  const map = mapOf(isSigned);
  const x = (Number.isFinite(share) ? Math.min(Math.max(share, 0), 1) : 0) * (map.length - 1);
  const k = Math.min(Math.floor(x), map.length - 2);
  for (let i = 0; i < 3; i++) out[i] = linear(map[k][i] + (x - k) * (map[k + 1][i] - map[k][i]));
};

export const gradientOf = (isSigned) =>
  `linear-gradient(to right, ${mapOf(isSigned)
    .map((colour) => `rgb(${colour.map((value) => Math.round(255 * value)).join(" ")})`)
    .join(", ")})`;
