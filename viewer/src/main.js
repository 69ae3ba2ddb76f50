import { connect } from "./controls.js";
import { Live } from "./live.js";
import { Viewer } from "./viewer.js";

const viewer = new Viewer();
connect(viewer);
viewer.setTheme(viewer.themeName);
const isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;
window.lissom = viewer;
const text = document.getElementById("result").textContent.trim();
viewer.ready = text ? viewer.load(JSON.parse(text)) : Promise.resolve();
if (!text) viewer.live = new Live(viewer);
viewer.ready
  .then(() => {
    document.documentElement.dataset.ready = "true";
    if (text && viewer.player.canPlay && !isCalm && !location.hash.includes("still")) viewer.player.play(true);
  })
  .catch((error) => {
    viewer.notices([{ kind: "error", text: `The results cannot be shown: ${error.message}` }]);
    throw error;
  });
