// Amplitudes over frequency of rows that need not lie at equal distances: as docs/viewing/plots.md has it.

const MOST_LINES = 1500;
const MOST_WORK = 1.2e7;

/** Frequencies [Hz] and the amplitudes of each list of values; none where there are too few rows. */
export const spectrum = (times, lists) => {
  const rows = times.length;
  const duration = rows > 3 ? times[rows - 1] - times[0] : 0;
  if (!(duration > 0)) return null;
  const weights = Float64Array.from(times, (time, row) => {
    const before = row > 0 ? time - times[row - 1] : 0;
    const after = row + 1 < rows ? times[row + 1] - time : 0;
    return 0.5 * (before + after) * (1 - Math.cos((2 * Math.PI * (time - times[0])) / duration));
  });
  const whole = weights.reduce((sum, weight) => sum + weight, 0);
  const lines = Math.max(Math.min((rows - 1) >> 1, MOST_LINES, Math.floor(MOST_WORK / rows / lists.length)), 1);
  const frequencies = Float64Array.from({ length: lines }, (_, line) => (line + 1) / duration);
  const amplitudes = lists.map((values) => {
    const mean = values.reduce((sum, value, row) => sum + weights[row] * value, 0) / whole;
    return Array.from(frequencies, (frequency) => {
      let [cosines, sines] = [0, 0];
      for (let row = 0; row < rows; row++) {
        const angle = 2 * Math.PI * frequency * (times[row] - times[0]);
        const part = weights[row] * (values[row] - mean);
        cosines += part * Math.cos(angle);
        sines += part * Math.sin(angle);
      }
      return (2 * Math.hypot(cosines, sines)) / whole;
    });
  });
  // Values far below the largest are round-off, and zero has no decade.
  const most = Math.max(...amplitudes.flat());
  const shown = amplitudes.map((list) => list.map((value) => (value > 1e-8 * most ? value : null)));
  return most > 0 ? { frequencies, amplitudes: shown, isCut: lines < (rows - 1) >> 1 } : null;
};
