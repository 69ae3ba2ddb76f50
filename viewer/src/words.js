// Numbers in words.

/** A number with so many digits, without zeros that tell nothing. */
export const spelled = (value, digits = 6) => {
  if (!Number.isFinite(value)) return String(value);
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) return String(Number(value.toPrecision(digits)));
  const [mantissa, exponent] = value.toExponential(Math.max(digits - 3, 1)).split("e");
  return `${Number(mantissa)}e${Number(exponent)}`;
};

/** A factor as people say it. */
export const factor = (value) => {
  const text = value >= 1 ? String(Number(value.toPrecision(3))) : `1/${Number((1 / value).toPrecision(3))}`;
  return `${text} ×`;
};
