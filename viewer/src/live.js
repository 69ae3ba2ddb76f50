// Talks to the program that has opened this page: takes new results, sends the values of sliders.

const $ = (id) => document.getElementById(id);

/** Time after which a lost program is asked for again [ms]. */
const AGAIN = 1000;

export class Live {
  constructor(viewer) {
    this.viewer = viewer;
    this.version = 0;
    this.values = {};
    this.listen();
  }

  async listen() {
    for (;;) {
      try {
        const answer = await fetch(`result?after=${this.version}`, { cache: "no-store" });
        if (answer.status === 200) await this.take(await answer.json());
        else if (answer.status !== 204) throw new Error(`answer ${answer.status}`);
        this.showConnection(true);
      } catch (error) {
        // An answer that cannot be shown is reported; a program that has ended may return.
        if (!(error instanceof TypeError)) this.tell({ kind: "error", text: `The answer cannot be shown: ${error.message}` });
        this.showConnection(false);
        // A program that is started again counts its versions anew.
        this.version = 0;
        await new Promise((resolve) => setTimeout(resolve, AGAIN));
      }
    }
  }

  /** A lost connection is shown over the picture, and sliders have no effect. */
  showConnection(isConnected) {
    document.documentElement.classList.toggle("lost", !isConnected);
    $("lost").hidden = isConnected;
    for (const input of $("live").querySelectorAll("input, button")) input.disabled = !isConnected;
  }

  tell(notice) {
    this.viewer.notices(notice ? [notice] : this.viewer.result?.notices ?? []);
  }

  async take({ version, notice, result, parameters, seconds }) {
    this.version = version;
    if (parameters) this.offer(parameters);
    if (!result) return this.tell(notice);
    const isFirst = !this.viewer.result;
    result.facts += ` · simulated in ${seconds.toFixed(seconds < 0.1 ? 3 : 2)} s`;
    await this.viewer.load(result, !isFirst);
    if (isFirst && this.viewer.player.canPlay) this.viewer.player.play(true);
    document.documentElement.dataset.version = version;
  }

  /** A slider for every parameter; those that are there already stay, so that one can go on being dragged. */
  offer(parameters) {
    const names = parameters.map(({ name, base }) => `${name}=${base}`).join();
    if (names === this.offered) return this.agree(parameters);
    this.offered = names;
    const bases = Object.fromEntries(parameters.map(({ name, base }) => [name, base]));
    // A value that was changed in the file counts from now on.
    for (const name of Object.keys(this.values)) if (this.bases?.[name] !== bases[name]) delete this.values[name];
    this.bases = bases;
    for (const { name, base, value } of parameters) if (value !== undefined && value !== base) this.values[name] = value;
    const heading = Object.assign(document.createElement("h2"), { textContent: "Parameters" });
    $("live").replaceChildren(heading, ...parameters.map((parameter) => this.slider(parameter)), this.reset());
    $("live").hidden = parameters.length === 0;
  }

  /** Sliders follow those of other pages, unless one is being dragged here. */
  agree(parameters) {
    if (this.isSending || this.isChanged || this.isDragging) return;
    for (const { name, base, value } of parameters) {
      const input = [...$("live").querySelectorAll("input")].find((each) => each.dataset.parameter === name);
      if (!input || Number(input.value) === value) continue;
      if (value === base) delete this.values[name];
      else this.values[name] = value;
      input.value = value;
      input.closest("label").querySelector("output").textContent = String(Number(value.toPrecision(4)));
    }
  }

  slider({ name, base, comment }) {
    const label = Object.assign(document.createElement("label"), { className: "slider" });
    const row = Object.assign(document.createElement("span"), { className: "row" });
    const value = document.createElement("output");
    row.append(Object.assign(document.createElement("span"), { textContent: name }), value);
    const input = Object.assign(document.createElement("input"), { type: "range", step: "any" });
    [input.min, input.max] = base > 0 ? [0, 2 * base] : base < 0 ? [2 * base, 0] : [-1, 1];
    input.dataset.parameter = name;
    const show = (number) => (value.textContent = String(Number(number.toPrecision(4))));
    input.value = this.values[name] ?? base;
    show(Number(input.value));
    input.addEventListener("pointerdown", () => (this.isDragging = true));
    for (const end of ["pointerup", "pointercancel"]) input.addEventListener(end, () => (this.isDragging = false));
    input.addEventListener("input", () => {
      this.values[name] = Number(Number(input.value).toPrecision(4));
      show(this.values[name]);
      this.send();
    });
    label.append(row, ...(comment ? [Object.assign(document.createElement("small"), { textContent: comment })] : []), input);
    return label;
  }

  reset() {
    const button = Object.assign(document.createElement("button"), { textContent: "as in the file" });
    button.addEventListener("click", () => {
      this.values = {};
      for (const input of $("live").querySelectorAll("input")) {
        input.value = this.bases[input.dataset.parameter];
        input.closest("label").querySelector("output").textContent = String(this.bases[input.dataset.parameter]);
      }
      this.send();
    });
    return button;
  }

  /** Sends the values; while an answer is awaited the last ones wait. */
  async send() {
    this.isChanged = true;
    if (this.isSending) return;
    this.isSending = true;
    while (this.isChanged) {
      this.isChanged = false;
      await fetch("parameters", { method: "POST", body: JSON.stringify(this.values) }).catch(() => {});
    }
    this.isSending = false;
  }
}
