// All examples at three sizes and in both themes, as pixels and boxes of the page.

import assert from "node:assert/strict";
import { readdirSync } from "node:fs";
import { join } from "node:path";

const SIZES = [[1400, 900], [1000, 700], [390, 800]];
const THEMES = ["light", "dark"];

/** Shares of the width and the height of the stage that the drawn geometry fills over the whole motion, and whether it touches an edge. */
const coverage = (page) =>
  page.evaluate(() => {
    const { stage, player, model, kinematics } = lissom;
    const { time } = player;
    player.play(false);
    const [width, height] = [200, 200];
    const copy = Object.assign(document.createElement("canvas"), { width, height });
    const pen = copy.getContext("2d", { willReadFrequently: true });
    const edges = [width, height, -1, -1];
    [stage.grid.visible, stage.axes.visible] = [false, false];
    const instants = player.end > player.start ? 9 : 1;
    for (let k = 0; k < instants; k++) {
      kinematics.set(player.start + ((player.end - player.start) * k) / 8);
      model.update();
      stage.render();
      pen.drawImage(stage.renderer.domElement, 0, 0, width, height);
      const { data } = pen.getImageData(0, 0, width, height);
      const background = data.slice(0, 3);
      for (let at = 0; at < data.length; at += 4) {
        if (Math.max(...[0, 1, 2].map((i) => Math.abs(data[at + i] - background[i]))) < 24) continue;
        const [x, y] = [(at / 4) % width, Math.floor(at / 4 / width)];
        edges[0] = Math.min(edges[0], x);
        edges[1] = Math.min(edges[1], y);
        edges[2] = Math.max(edges[2], x);
        edges[3] = Math.max(edges[3], y);
      }
    }
    [stage.grid.visible, stage.axes.visible] = [true, true];
    player.seek(time);
    lissom.move();
    const [left, top, right, bottom] = edges;
    return { across: (right - left + 1) / width, down: (bottom - top + 1) / height, isCut: left === 0 || top === 0 || right === width - 1 || bottom === height - 1 };
  });

export const examples = ({ root, view, open }) => {
  const files = readdirSync(join(root, "examples")).filter((file) => file.endsWith(".toml") && file !== "connecting-rod.toml");
  return {
    "all examples at three sizes and in both themes": async (browser) => {
      for (const file of files) {
        const { page, complaints } = await open(browser, join(view(`examples/${file}`), "view.html"));
        for (const [width, height] of SIZES) {
          await page.setViewportSize({ width, height });
          await page.waitForFunction(([width]) => innerWidth === width && lissom.stage.renderer.domElement.clientWidth === lissom.stage.holder.clientWidth, [width], { timeout: 60000 });
          // The theme changes no sizes: dark pictures are measured at the first size.
          for (const theme of width === SIZES[0][0] ? THEMES : THEMES.slice(0, 1)) {
            await page.evaluate((theme) => lissom.setTheme(theme), theme);
            const { across, down, isCut } = await coverage(page);
            const filled = Math.max(across, down);
            const what = `${file} at ${width} x ${height}, ${theme}`;
            assert.ok(filled >= 0.3 && filled <= 0.9 && !isCut, `${what}: ${across} across, ${down} down, cut off: ${isCut}`);
          }
        }
        assert.deepEqual(complaints(), [], file);
        await page.close();
      }
    },
  };
};
