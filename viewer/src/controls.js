// Buttons, keys and the pointer.

import { film, picture } from "./capture.js";
import { split } from "./splitter.js";

const $ = (id) => document.getElementById(id);

/** A pointer that has moved farther than this has dragged [pixels]. */
const CLICK = 5;

export const connect = (viewer) => {
  const { player, stage } = viewer;
  const on = (id, event, action) => $(id).addEventListener(event, action);
  on("play", "click", () => player.play());
  on("scrub", "input", () => player.seek(player.start + Number($("scrub").value) * (player.end - player.start)));
  on("slower", "click", () => player.faster(false));
  on("faster", "click", () => player.faster(true));
  const loop = () => {
    player.isLooping = !player.isLooping;
    viewer.tell();
  };
  on("loop", "click", loop);
  const theme = () => viewer.chooseTheme(viewer.themeName === "dark" ? "light" : "dark");
  on("theme", "click", theme);
  const ortho = () => {
    stage.setOrthographic(!stage.isOrthographic);
    $("ortho").setAttribute("aria-pressed", String(stage.isOrthographic));
  };
  on("ortho", "click", ortho);
  on("fit", "click", () => viewer.model && viewer.fit());
  for (const button of document.querySelectorAll("[data-view]")) {
    button.addEventListener("click", () => viewer.model && viewer.look(button.dataset.view));
  }
  on("colour", "change", () => viewer.colourBy($("colour").value));
  on("magnify", "change", () => viewer.magnify(Number($("magnify").value)));
  on("frame", "change", () => viewer.against($("frame").value));
  on("shape", "change", () => {
    viewer.choices.bodyShape = $("shape").value;
    viewer.rebuild();
  });
  const cut = () => {
    const axis = $("cut").value;
    const place = stage.cut(axis === "" ? null : Number(axis), Number($("cut-at").value));
    $("cut-at").closest("label").hidden = place === null;
    if (place !== null) $("cut-place").textContent = `${"xyz"[axis]} < ${Number(place.toPrecision(3))} m`;
    viewer.isStale = true;
  };
  on("cut", "change", cut);
  on("cut-at", "input", cut);
  const follow = (isWanted) => viewer.follow(isWanted ? (viewer.model?.selected ? "part" : "machine") : "");
  on("names", "change", () => {
    viewer.labels.show($("names").checked);
    viewer.isStale = true;
  });
  on("reactions", "change", () => viewer.showReactions($("reactions").checked));
  on("picture", "click", () => picture(viewer));
  on("film", "click", () => film(viewer));
  on("traces", "change", () => viewer.setTraces($("traces").checked));
  on("follow", "change", () => follow($("follow").checked));
  on("grid", "change", () => {
    stage.grid.visible = $("grid").checked;
    viewer.isStale = true;
  });
  for (const box of document.querySelectorAll("[data-show]")) {
    box.addEventListener("change", () => {
      viewer.model?.show(box.dataset.show, box.checked);
      viewer.isMoved = true;
    });
  }
  on("compare", "change", (event) => viewer.compare(event.target));
  split($("splitter"), $("plots"));
  on("help", "click", () => $("keys").showModal());
  const nextColour = () => {
    const select = $("colour");
    select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
    viewer.colourBy(select.value);
  };
  const actions = {
    " ": () => player.play(),
    ArrowLeft: (event) => viewer.step(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => viewer.step(event.shiftKey ? 10 : 1),
    Home: () => player.seek(player.start),
    End: () => player.seek(player.end),
    "-": () => player.faster(false),
    "+": () => player.faster(true),
    "=": () => player.faster(true),
    l: loop,
    o: ortho,
    a: () => viewer.model && viewer.fit(),
    d: theme,
    c: nextColour,
    f: () => follow(!viewer.choices.follow),
    t: () => viewer.setTraces(!viewer.choices.traces),
    0: () => viewer.look("iso"),
    1: () => viewer.look("front"),
    2: () => viewer.look("side"),
    3: () => viewer.look("top"),
    n: () => viewer.showMode(viewer.modes.index + 1),
    p: () => viewer.showMode(viewer.modes.index - 1),
    Escape: () => viewer.select(null),
    "?": () => $("keys").showModal(),
  };
  document.addEventListener("keydown", (event) => {
    const isTyping = event.target.matches("select, textarea, input:not([type=range]):not([type=checkbox])");
    const action = event.target.closest("#splitter") ? null : actions[event.key];
    // Space on a button or a box presses it.
    const isPressing = event.key === " " && event.target.matches("button, summary, input[type=checkbox], input[type=file]");
    if (!action || isTyping || isPressing || event.ctrlKey || event.metaKey || event.altKey || $("keys").open || !viewer.history) return;
    event.preventDefault();
    action(event);
  });
  point(viewer);
};

/** Names what is under the pointer, and selects it on a click. */
const point = (viewer) => {
  const canvas = viewer.stage.renderer.domElement;
  const place = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  let down = null;
  let last = 0;
  canvas.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
  canvas.addEventListener("pointerup", (event) => {
    const isClick = down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < CLICK;
    down = null;
    if (isClick && event.button === 0) viewer.select(viewer.model?.pick(...place(event)) ?? null);
  });
  const tip = $("tip");
  canvas.addEventListener("pointermove", (event) => {
    if (event.pointerType !== "mouse" || event.buttons || viewer.player.isPlaying || event.timeStamp - last < 60) return;
    last = event.timeStamp;
    const [x, y] = place(event);
    const name = viewer.model?.pick(x, y);
    tip.hidden = !name;
    if (!name) return;
    tip.textContent = [name, ...viewer.model.coordinatesOf(name).map(([, text]) => text)].join(", ");
    [tip.style.left, tip.style.top] = [`${x}px`, `${y}px`];
  });
  canvas.addEventListener("pointerleave", () => (tip.hidden = true));
};
