// Numbers in words.

/** A number with so many digits, without trailing zeros. */
export const spelled = (value, digits = 6) => {
  if (!Number.isFinite(value)) return String(value);
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) return String(Number(value.toPrecision(digits)));
  const [mantissa, exponent] = value.toExponential(Math.max(digits - 3, 1)).split("e");
  return `${Number(mantissa)}e${Number(exponent)}`;
};

/** Labels of ascending ticks: all of one format, with as many digits as they need to differ. */
export const tickLabels = (ticks) => {
  const numbers = ticks.filter((tick) => Number.isFinite(tick));
  const most = Math.max(...numbers.map(Math.abs), 0);
  if (most === 0) return ticks.map((tick) => (Number.isFinite(tick) ? "0" : ""));
  const steps = numbers.slice(1).map((tick, k) => Math.abs(tick - numbers[k])).filter((step) => step > 0);
  const least = steps.length ? Math.min(...steps) : most;
  // What is far below the distance of ticks is the round-off of a zero.
  const clean = (tick) => (Math.abs(tick) < 1e-9 * least ? 0 : tick);
  const isPlain = most < 1e6 && (most >= 1e-3 || least >= 1e-3);
  const scale = isPlain ? 1 : 10 ** Math.floor(Math.log10(most) + 1e-9);
  for (let digits = Math.max(0, -Math.floor(Math.log10(least / scale) + 1e-9)); ; digits++) {
    const mantissas = ticks.map((tick) => (Number.isFinite(tick) ? String(Number((clean(tick) / scale).toFixed(digits))) : ""));
    const shown = mantissas.filter(Boolean);
    const isExact = numbers.every((tick, k) => Math.abs(Number(shown[k]) * scale - tick) <= 0.05 * least);
    if ((new Set(shown).size === new Set(numbers.map(clean)).size && isExact) || digits > 12) {
      return mantissas.map((text) => (text === "" || text === "0" || isPlain ? text : `${text}e${Math.log10(scale).toFixed(0)}`));
    }
  }
};

/** A factor as people say it. */
export const factor = (value) => {
  const text = value >= 1 ? String(Number(value.toPrecision(3))) : `1/${Number((1 / value).toPrecision(3))}`;
  return `${text} ×`;
};
