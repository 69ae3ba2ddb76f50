// Names of parts over the picture; a name that would cover another one is left out.

import { element } from "./panel.js";

const HEIGHT = 15;

export class Labels {
  constructor(stage) {
    this.stage = stage;
    this.holder = element("div", { className: "labels", ariaHidden: "true", hidden: true });
    stage.holder.append(this.holder);
  }

  show(isShown) {
    this.holder.hidden = !isShown;
  }

  /** Puts names where parts are drawn. */
  update(model) {
    if (this.holder.hidden || !model) return;
    const taken = [];
    const names = [];
    for (const [key, { name }] of model.parts) {
      const anchor = model.isHidden(key) ? null : model.anchorOf(key);
      if (!anchor) continue;
      const [x, y] = this.stage.pixel(model.kinematics.point(anchor));
      const box = [x, y, x + 7 * name.length, y + HEIGHT];
      if (taken.some((other) => box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3])) continue;
      taken.push(box);
      const label = element("span", { textContent: name });
      [label.style.left, label.style.top] = [`${x.toFixed(1)}px`, `${y.toFixed(1)}px`];
      names.push(label);
    }
    this.holder.replaceChildren(...names);
  }
}
