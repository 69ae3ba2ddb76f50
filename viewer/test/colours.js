// Colours of fields against the legend, by pixels of the page.

import assert from "node:assert/strict";
import { join } from "node:path";

import { settled } from "../browser.js";

/** Colour of the picture at a pixel of the page, and of the legend at a share of its bar. */
const pixelsOf = async (page, spot, share) => {
  const shot = (await page.screenshot()).toString("base64");
  return page.evaluate(
    async ([shot, spot, share]) => {
      const image = new Image();
      image.src = `data:image/png;base64,${shot}`;
      await image.decode();
      const pen = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height }).getContext("2d", { willReadFrequently: true });
      pen.drawImage(image, 0, 0);
      const at = ([x, y]) => [...pen.getImageData(Math.round(x), Math.round(y), 1, 1).data.slice(0, 3)];
      const bar = document.querySelector("#legend .bar").getBoundingClientRect();
      return { part: at(spot), legend: at([bar.left + share * bar.width, bar.top + bar.height / 2]) };
    },
    [shot, spot, share],
  );
};

const far = (a, b) => Math.max(...a.map((value, k) => Math.abs(value - b[k])));

export const colours = ({ view, open }) => ({
  "colours of fields are those of the legend": async (browser) => {
    const { page, complaints } = await open(browser, join(view("examples/turbine-rotor.toml", "analysis.end=1"), "view.html"));
    for (const name of ["axial force", "bending moment"]) {
      for (const covered of ["run", "instant"]) {
        await page.selectOption("#colour", name);
        await page.selectOption("#legend select", covered);
        await page.evaluate((name) => {
          lissom.player.seek(0.7);
          lissom.colourBy(name);
          lissom.look("side");
          lissom.move();
        }, name);
        const { spot, share } = await page.evaluate(() => {
          const { model, kinematics, stage } = lissom;
          const beam = model.scene.beams[0];
          const node = beam.nodes[beam.nodes.length >> 1];
          const { left, top } = stage.renderer.domElement.getBoundingClientRect();
          const [x, y] = stage.pixel(kinematics.point({ node, position: [0, 0, 0] }));
          const [low, high] = model.range;
          const value = model.field.alongBeam(beam)(beam.places[beam.nodes.length >> 1]);
          return { spot: [left + x, top + y], share: (value - low) / (high - low) };
        });
        await settled(page);
        const plain = await pixelsOf(page, spot, share);
        assert.ok(far(plain.part, plain.legend) < 12, `${name}, ${covered}: drawn ${plain.part}, legend ${plain.legend}`);
        // Selecting a part leaves its colours as they are.
        await page.evaluate(() => lissom.select(lissom.model.scene.beams[0].name));
        await settled(page);
        const selected = await pixelsOf(page, spot, share);
        assert.deepEqual(selected.part, plain.part, `${name} of a selected part`);
        await page.evaluate(() => lissom.select(null));
      }
    }
    // Zero is in the middle of the colours of a field of both signs, and ticks differ.
    await page.selectOption("#colour", "axial force");
    const ticks = await page.locator("#legend .ends span").allTextContents();
    assert.equal(ticks.length, 5);
    assert.equal(ticks[2], "0");
    assert.equal(new Set(ticks).size, 5);
    assert.equal(ticks[0], `-${ticks[4]}`);
    // A range of the user.
    await page.selectOption("#legend select", "own");
    await page.locator("#legend input").nth(0).fill("-10");
    await page.locator("#legend input").nth(1).fill("30");
    await page.locator("#legend input").nth(1).press("Enter");
    assert.deepEqual(await page.evaluate(() => lissom.model.range), [-10, 30]);
    assert.deepEqual(await page.locator("#legend .ends span").allTextContents(), ["-10", "0", "10", "20", "30"]);
    assert.deepEqual(complaints(), []);
  },
  "round-off is zero, and tick labels differ": async (browser) => {
    const { page } = await open(browser, join(view("examples/four-bar.toml", "analysis.end=1"), "view.html"));
    const found = await page.evaluate(async () => {
      const labels = [[4.1885, 4.189, 4.1895], [-0.02, -0.01, 0, 0.01], [-5e-15, 0.5, 1], [12345.678, 12345.679], [-1e-7, 0, 1e-7]].map(lissom.tickLabels);
      // A straight beam without torsion whose torsion is noise.
      const { model, kinematics } = lissom;
      const { forces } = kinematics.motion;
      for (let k = 3; k < forces.length; k += 6) forces[k] = 5e-15 * (k % 4 ? 1 : -1);
      lissom.colourBy("torsion");
      return { labels, range: model.range, ticks: document.querySelector("#legend .ends").textContent, table: lissom.readTable("time,a.x,a.y\n0,1,5e-15\n1,2,1e-37\n").columns.map(({ values }) => [...values]) };
    });
    assert.deepEqual(found.labels, [["4.1885", "4.189", "4.1895"], ["-0.02", "-0.01", "0", "0.01"], ["0", "0.5", "1"], ["12345.678", "12345.679"], ["-1e-7", "0", "1e-7"]]);
    assert.deepEqual(found.range.map(Math.abs), [0, 0]);
    assert.equal(found.ticks, "0");
    assert.deepEqual(found.table, [[1, 2], [0, 0]]);
  },
});
