// Strains of a shell at the time that is shown: those of the two recorded frames around it, and straight between them. Strains of places
// between frames would be wrong: a chord that turns is shorter there.

import { ShellStrains } from "./shell_strains.js";

export class ShellStates {
  constructor(shell, kinematics) {
    this.kinematics = kinematics;
    this.nodes = Int32Array.from(shell.nodes);
    this.strains = new ShellStrains(shell);
    this.positions = new Float64Array(3 * this.nodes.length);
    this.quaternions = new Float64Array(4 * this.nodes.length);
    const numbers = () => new Float64Array(8 * shell.elements.length);
    this.frames = [{ frame: -1, strains: numbers() }, { frame: -1, strains: numbers() }];
    this.between = numbers();
  }

  /** Strains in a frame, which stay known until two others are asked for. */
  inFrame(frame, kept) {
    const [first, second] = this.frames;
    if (first.frame === frame) return first;
    if (second.frame === frame) return second;
    const free = first === kept ? second : second === kept ? first : first.frame < second.frame ? first : second;
    this.kinematics.recorded(frame, this.nodes, this.positions, this.quaternions);
    this.strains.at(this.positions, this.quaternions, free.strains);
    free.frame = frame;
    return free;
  }

  /** Strains now, eight of each element. */
  now() {
    const { before, after, share } = this.kinematics;
    if (share === 0) return this.inFrame(before).strains;
    if (share === 1) return this.inFrame(after).strains;
    const one = this.inFrame(before);
    const { strains: to } = this.inFrame(after, one);
    const { strains: from } = one;
    for (let k = 0; k < from.length; k++) this.between[k] = from[k] + share * (to[k] - from[k]);
    return this.between;
  }
}
