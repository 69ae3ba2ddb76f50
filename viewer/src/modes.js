// The list of natural modes beside the picture.

import { spelled } from "./words.js";

const words = { oscillation: "", rigid: "rigid", decay: "overdamped", divergence: "grows", flutter: "grows" };

export class Modes {
  constructor(list, choose) {
    this.list = list;
    this.choose = choose;
    this.index = 0;
    const pick = (event) => {
      const item = event.target.closest("li");
      if (item) choose(Number(item.dataset.index));
    };
    list.addEventListener("click", pick);
    list.addEventListener("keydown", (event) => event.key === "Enter" && pick(event));
  }

  load(modes) {
    this.modes = modes;
    this.list.parentElement.hidden = modes.length === 0;
    const items = modes.map(({ name: title = "", frequency, damping, kind }, index) => {
      const item = Object.assign(document.createElement("li"), { tabIndex: 0, title });
      item.dataset.index = String(index);
      const name = Object.assign(document.createElement("b"), { textContent: `${index + 1}   ${spelled(frequency, 5)} Hz` });
      const shown = words[kind] || (damping ? `damping ${spelled(damping, 3)}` : "");
      const facts = [title, shown].filter(Boolean).join(" · ");
      item.append(name, Object.assign(document.createElement("span"), { textContent: facts }));
      return item;
    });
    this.list.replaceChildren(...items);
  }

  get current() {
    return this.modes?.[this.index];
  }

  mark(index) {
    this.index = index;
    for (const item of this.list.children) item.classList.toggle("selected", Number(item.dataset.index) === index);
    this.list.children[index]?.scrollIntoView({ block: "nearest" });
  }
}
