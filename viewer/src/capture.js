// Pictures and films of the page: PNG of this instant, WebM of the whole motion.

const save = (blob, name) => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
};

const nameOf = (viewer) => (viewer.result?.name || "lissom").replace(/[^\w.-]+/g, "-");

export const picture = (viewer) => {
  viewer.stage.render();
  viewer.stage.renderer.domElement.toBlob((blob) => save(blob, `${nameOf(viewer)}.png`), "image/png");
};

/** Plays the motion once from its start and records it. */
export const film = async (viewer) => {
  const { player, stage } = viewer;
  if (!player.canPlay || viewer.isFilming) return;
  viewer.isFilming = true;
  const stream = stage.renderer.domElement.captureStream(30);
  const recorder = new MediaRecorder(stream, { mimeType: "video/webm" });
  const chunks = [];
  recorder.addEventListener("dataavailable", ({ data }) => chunks.push(data));
  const ended = new Promise((done) => recorder.addEventListener("stop", done));
  const { isLooping } = player;
  player.isLooping = false;
  player.seek(player.start);
  recorder.start();
  player.play(true);
  while (player.isPlaying) await new Promise((next) => setTimeout(next, 50));
  recorder.stop();
  await ended;
  stream.getTracks().forEach((track) => track.stop());
  player.isLooping = isLooping;
  viewer.isFilming = false;
  save(new Blob(chunks, { type: "video/webm" }), `${nameOf(viewer)}.webm`);
};
