// From a save to the new picture: `node test/latency.js PROGRAM MODEL [KEY=VALUE …]` prints the median of ten saves. Needs chromium.

import { spawn } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";

import { launch } from "../browser.js";

const [program, model, ...set] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "lissom-latency-"));
// With the files that it includes.
cpSync(dirname(model), folder, { recursive: true });
const file = join(folder, basename(model));
const text = readFileSync(file, "utf8");
const live = spawn(resolve(program), ["live", file, ...set.flatMap((change) => ["--set", change])], { stdio: ["ignore", "pipe", "inherit"] });
const browser = await launch();
try {
  const address = await new Promise((found) => live.stdout.once("data", (data) => found(String(data).trim())));
  const page = await browser.newPage({ viewport: { width: 1200, height: 800 } });
  await page.goto(address);
  await page.waitForFunction(() => lissom.result, null, { timeout: 120000 });
  await page.keyboard.press("Space");
  const times = [];
  for (let k = 0; k < 11; k++) {
    const [version, drawn] = await page.evaluate(() => [lissom.live.version, lissom.drawn]);
    const began = performance.now();
    writeFileSync(file, `${text}\n# ${"x".repeat(1 + (k % 3))}`);
    await page.waitForFunction(([version, drawn]) => Number(document.documentElement.dataset.version) > version && lissom.drawn > drawn, [version, drawn], { timeout: 120000 });
    // Reading a pixel waits until all is drawn.
    await page.evaluate(() => {
      const gl = lissom.stage.renderer.getContext();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    });
    times.push(performance.now() - began);
  }
  const seconds = await page.evaluate(() => document.getElementById("facts").textContent);
  times.sort((a, b) => a - b);
  console.log(`${(times[5] / 1000).toFixed(2)} s from save to picture (${(times[0] / 1000).toFixed(2)} to ${(times[10] / 1000).toFixed(2)}); ${seconds}`);
} finally {
  live.kill("SIGKILL");
  await browser.close();
  rmSync(folder, { recursive: true });
}
