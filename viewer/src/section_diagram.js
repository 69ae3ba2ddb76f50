// A section force along the selected beam now, between its least and greatest values over the run.

import { element } from "./panel.js";
import { PathPlot } from "./path.js";
import { curves } from "./theme.js";

const NAMES = ["axial force [N]", "shear force 2 [N]", "shear force 3 [N]", "torsion [N m]", "bending moment 2 [N m]", "bending moment 3 [N m]"];

export class SectionDiagram {
  /** None for a beam whose section forces are not recorded. */
  static of(beam, kinematics, component, colours, change) {
    const points = kinematics.motion.forcePoints;
    const index = points.findIndex((each) => each.beam === beam.name);
    if (index < 0 || kinematics.mode) return null;
    const first = points.slice(0, index).reduce((sum, { at }) => sum + at.length, 0);
    return new SectionDiagram(beam, kinematics, { first, at: points[index].at, component }, colours, change);
  }

  constructor(beam, kinematics, { first, at, component }, colours, change) {
    [this.kinematics, this.first, this.component] = [kinematics, first, component];
    const choice = element("select", { className: "over", ariaLabel: "section force" }, ...NAMES.map((name, k) => new Option(name, String(k))));
    choice.value = String(component);
    choice.addEventListener("change", () => change(Number(choice.value)));
    this.card = element("section", { className: "plot sections" }, element("h3", {}, element("b", { textContent: beam.name }), element("span", { textContent: "along the beam" }), choice));
    const x = at.map((s) => s * beam.length);
    const { forces, frames } = kinematics.motion;
    const width = kinematics.forces.length;
    const [low, high] = [Array(at.length).fill(Infinity), Array(at.length).fill(-Infinity)];
    for (let frame = 0; frame < frames; frame++) {
      for (let k = 0; k < at.length; k++) {
        const value = forces[frame * width + 6 * (first + k) + component];
        low[k] = Math.min(low[k], value);
        high[k] = Math.max(high[k], value);
      }
    }
    this.envelope = [low, high];
    const stroke = curves[0];
    const around = { x: [...x, ...x.toReversed()], y: [...low, ...high.toReversed()], stroke, fill: 0.15 };
    this.now = { x, y: Array(at.length).fill(0), stroke };
    const zero = { x: [0, beam.length], y: [0, 0], stroke: colours.faint, dash: [2, 3] };
    this.plot = new PathPlot(this.card, [around, zero, this.now], colours, { x: "length along the beam [m]", y: NAMES[component], hasNoMark: true });
  }

  /** Shows the values of this instant. */
  update() {
    for (let k = 0; k < this.now.y.length; k++) this.now.y[k] = this.kinematics.forces[6 * (this.first + k) + this.component];
    this.plot.draw();
  }
}
