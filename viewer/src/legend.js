// The legend of a field: its colours, ticks, and the range that they cover.

import { element } from "./panel.js";
import { gradientOf } from "./theme.js";
import { tickLabels } from "./words.js";

const TICKS = 5;

export class Legend {
  /** `change` is called after another range is chosen: `run`, `instant` or two numbers. */
  constructor(holder, change) {
    this.holder = holder;
    this.title = element("span");
    this.choice = element("select", { ariaLabel: "range of colours" }, new Option("whole run", "run"), new Option("this instant", "instant"), new Option("own range", "own"));
    this.bar = element("div", { className: "bar" });
    this.ticks = element("div", { className: "ends" });
    this.inputs = ["lowest value", "highest value"].map((ariaLabel) => element("input", { type: "number", step: "any", ariaLabel }));
    this.own = element("div", { className: "own", hidden: true }, ...this.inputs);
    holder.replaceChildren(element("div", { className: "row" }, this.title, this.choice), this.bar, this.ticks, this.own);
    const changed = () => {
      this.own.hidden = this.choice.value !== "own";
      const numbers = this.inputs.map((input) => Number(input.value));
      const isRange = this.inputs.every((input) => input.value !== "") && numbers[1] > numbers[0];
      if (this.choice.value === "own" && !isRange) this.inputs.forEach((input, k) => (input.value = String(this.range[k])));
      change(this.choice.value !== "own" ? this.choice.value : isRange ? numbers : this.range);
    };
    this.choice.addEventListener("change", changed);
    for (const input of this.inputs) input.addEventListener("change", changed);
  }

  /** Shows a field with the range that its colours cover; none for nothing. */
  show(field) {
    this.holder.hidden = !field;
    if (!field) return;
    const [low, high] = (this.range = field.range);
    const text = `${field.title} [${field.unit}]`;
    if (this.title.textContent !== text) this.title.textContent = text;
    this.bar.style.background = gradientOf(field.isSigned);
    const labels = high > low ? tickLabels(Array.from({ length: TICKS }, (_, k) => low + ((high - low) * k) / (TICKS - 1))) : tickLabels([low]);
    if (labels.join() !== this.labels) this.ticks.replaceChildren(...labels.map((label) => element("span", { textContent: label })));
    this.labels = labels.join();
  }
}
