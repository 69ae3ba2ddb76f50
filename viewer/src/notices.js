// What concerns the results as a whole: warnings and failures, each with its code, its remedy and its part.

import { element } from "./panel.js";

/** So many are shown at once; the others unfold. */
const SHOWN = 5;

export class Notices {
  /** `show` shows the part and the time of a notice. */
  constructor(holder, show) {
    this.holder = holder;
    this.show = show;
  }

  /** Shows a list of notices; the same ones again are not announced again, and stay unfolded. */
  load(list) {
    const text = JSON.stringify(list);
    if (text === this.text) return;
    this.text = text;
    const made = list.map((notice) => this.paragraph(notice));
    const rest = made.splice(SHOWN);
    if (rest.length) {
      const open = this.holder.querySelector("details")?.open ?? false;
      made.push(element("details", { open }, element("summary", { textContent: `${rest.length} more` }), ...rest));
    }
    this.holder.replaceChildren(...made);
  }

  paragraph(notice) {
    const { kind, text, is_code: isCode, code, remedy, shown } = notice;
    const made = element("p", { className: `${kind}${isCode ? " code" : ""}` });
    if (kind === "error") made.setAttribute("role", "alert");
    if (code) made.append(element("b", { textContent: code, title: `lissom explain ${code}` }), " ");
    if (shown) {
      const button = element("button", { type: "button", textContent: shown, title: "show in the picture" });
      button.addEventListener("click", () => this.show(notice));
      made.append(button, " ");
    }
    made.append(text);
    if (remedy) made.append(element("span", { className: "remedy", textContent: `Remedy: ${remedy}.` }));
    return made;
  }
}
