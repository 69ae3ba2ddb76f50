// Pages of `lissom live`: two of them, and a program that is started again.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { chmodSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const MODEL = `lissom = 1
gravity = [0, 0, -9.81]
[parameters]
stiffness = 300  # of the spring, N/m
mass = 2
# Length of the spring without load, m
length = 0.5
[bodies.load]
mass = "mass"
inertia = [0.01, 0.01, 0.01]
position = [0, 0, "-length"]
[springs.coil]
kind = "point"
base = "ground"
tip = "load"
at_base = [0, 0, 0]
length = "length"
stiffness = "stiffness"
[analysis]
kind = "dynamics"
end = 0.5
step = 0.01
`;

export const live = ({ program, folder }) => ({
  "two tabs agree, and a program that is started again": async (browser) => {
    const model = join(folder, "tabs.toml");
    writeFileSync(model, MODEL);
    const runtime = join(folder, "runtime");
    mkdirSync(runtime, { recursive: true });
    chmodSync(runtime, 0o700);
    const start = async () => {
      const child = spawn(program, ["live", model], { stdio: ["ignore", "pipe", "inherit"], env: { ...process.env, XDG_RUNTIME_DIR: runtime } });
      const address = await new Promise((found) => child.stdout.once("data", (data) => found(String(data).trim())));
      return { child, address };
    };
    const ended = (child) => new Promise((done) => (child.once("exit", done), child.kill("SIGKILL")));
    let { child, address } = await start();
    try {
      const [first, second] = [await browser.newPage(), await browser.newPage()];
      for (const page of [first, second]) {
        await page.goto(address);
        await page.waitForFunction(() => lissom.result, null, { timeout: 60000 });
      }
      const names = await first.evaluate(() => [...document.querySelectorAll("#live input")].map((input) => input.dataset.parameter));
      assert.deepEqual(names, ["stiffness", "mass", "length"], "the order of the file");
      assert.deepEqual(await first.locator("#live small").allTextContents(), ["of the spring, N/m", "Length of the spring without load, m"]);
      await first.locator("[data-parameter=mass]").fill("3");
      await second.waitForFunction(() => document.querySelector("[data-parameter=mass]").value === "3", null, { timeout: 60000 });
      assert.ok(await first.locator("#lost").isHidden());
      await ended(child);
      await first.locator("#lost").waitFor({ timeout: 60000 });
      assert.ok(await first.locator("[data-parameter=mass]").isDisabled());
      writeFileSync(model, MODEL.replace("end = 0.5", "end = 0.7"));
      const again = await start();
      child = again.child;
      assert.equal(again.address, address);
      // While it runs, another program for the same model has another port.
      const other = await start();
      assert.notEqual(new URL(other.address).port, new URL(address).port);
      await ended(other.child);
      await first.waitForFunction(() => lissom.player.end === 0.7, null, { timeout: 60000 });
      assert.ok(await first.locator("#lost").isHidden());
      assert.ok(await first.locator("[data-parameter=mass]").isEnabled());
      // A model that grows stays in the picture.
      writeFileSync(model, MODEL.replace("length = 0.5", "length = 5"));
      await first.waitForFunction(() => Math.abs(lissom.stage.low.z) > 4, null, { timeout: 60000 });
      assert.equal(await first.evaluate(() => lissom.stage.isPoorlyFramed()), false);
    } finally {
      await ended(child);
    }
  },
});
