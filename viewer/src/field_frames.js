// Recorded numbers of a shell or solid at the time that is shown: straight between the frames that have them.

export class FieldFrames {
  constructor(kinematics, recorded) {
    this.kinematics = kinematics;
    this.recorded = recorded;
    this.between = new Float64Array(recorded.numbers * recorded.count);
  }

  /** The numbers of all elements or nodes, now. */
  now() {
    const { between, recorded } = this;
    const { motion, before, time } = this.kinematics;
    const { stride } = motion.fields;
    const width = between.length;
    const last = Math.ceil((motion.frames - 1) / stride);
    const first = Math.floor(before / stride);
    const next = Math.min(first + 1, last);
    const [start, end] = [first, next].map((frame) => motion.times[Math.min(frame * stride, motion.frames - 1)]);
    const share = end > start ? Math.min(Math.max((time - start) / (end - start), 0), 1) : 0;
    for (let k = 0; k < width; k++) {
      const value = recorded.values[first * width + k];
      between[k] = value + share * (recorded.values[next * width + k] - value);
    }
    return between;
  }
}
