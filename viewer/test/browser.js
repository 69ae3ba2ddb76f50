// Pages as a browser shows them: `node test/browser.js PROGRAM`, with the program lissom. Needs chromium.

import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

import { launch, open as openPage } from "../browser.js";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const program = resolve(process.argv[2] ?? join(root, "target/release/lissom"));
const folder = mkdtempSync(join(tmpdir(), "lissom-viewer-"));

/** Makes the page of a model, with changes to it. */
const view = (model, ...set) => {
  const out = join(folder, `page${view.count++}`);
  const changes = set.flatMap((change) => ["--set", change]);
  execFileSync(program, ["view", resolve(root, model), "--out", out, "--quiet", ...changes]);
  return out;
};
view.count = 0;

/** Opens a page that must neither complain nor ask anybody. */
const open = async (browser, file, size = { width: 1200, height: 800 }) => {
  const page = await browser.newPage({ viewport: size });
  const complaints = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || complaints.push(`asks ${request.url()}`));
  await openPage(page, file);
  // What the driver of the graphics says about its speed is no complaint of the page.
  const real = () => complaints.filter((text) => !/GPU stall|swiftshader|GL Driver/i.test(text));
  return { page, complaints: real };
};

/** Rows of a table by name. */
const table = (out) => {
  const [heading, ...lines] = readFileSync(join(out, "history.csv"), "utf8").trim().split("\n");
  const names = heading.split(",");
  return lines.map((line) => Object.fromEntries(line.split(",").map((number, k) => [names[k], Number(number)])));
};

/** Points that are observed lie on the screen where the table says, at four times. */
const comparePlaces = async (page, out) => {
  const rows = table(out);
  const outputs = await page.evaluate(() => lissom.result.scene.outputs.filter((output) => output.point));
  let compared = 0;
  for (const { name, kind, point } of outputs) {
    const letters = { position: ["x", "y", "z"], displacement: ["u1", "u2", "u3"] }[kind];
    if (!letters) continue;
    for (const share of [0, 0.31, 0.77, 1]) {
      const row = rows[Math.round(share * (rows.length - 1))];
      const told = letters.map((letter) => row[`${name}.${letter}`]);
      const pixels = await page.evaluate(
        ([time, anchor, told, isChange]) => {
          lissom.player.seek(time);
          lissom.move();
          const { reference } = lissom.kinematics.motion;
          const drawn = lissom.kinematics.point(anchor);
          const at = 7 * anchor.node;
          // Offsets of displaced points are zero in these models.
          const place = isChange ? told.map((x, k) => reference[at + k] + x) : told;
          return [lissom.stage.pixel(drawn), lissom.stage.pixel(place)];
        },
        [row.time, point, told, kind === "displacement" && point.position.every((x) => x === 0)],
      );
      if (kind === "displacement" && point.position.some((x) => x !== 0)) continue;
      const distance = Math.hypot(pixels[0][0] - pixels[1][0], pixels[0][1] - pixels[1][1]);
      assert.ok(distance < 1, `${name} at ${row.time} s is drawn ${distance} pixels off`);
      compared++;
    }
  }
  return compared;
};

/** The page plays: its time goes on, and pictures are drawn. */
const plays = async (page) => {
  const before = await page.evaluate(() => {
    lissom.player.seek(lissom.player.start);
    return lissom.drawn;
  });
  await page.keyboard.press("Space");
  await page.waitForFunction((before) => lissom.drawn > before + 5 && lissom.player.time > lissom.player.start, before, { timeout: 60000 });
  await page.keyboard.press("Space");
  assert.equal(await page.evaluate(() => lissom.player.isPlaying), false);
};

/** A click on a part selects it and tells its name. The page may still lay itself out: then the click is tried again. */
const selects = async (page, part) => {
  const heading = (part) => document.querySelector("#selection h2")?.textContent.startsWith(part);
  for (let tries = 0; tries < 20 && !(await page.evaluate(heading, part)); tries++) {
    const [x, y] = await page.evaluate(async (part) => {
      lissom.player.seek(lissom.player.start);
      await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
      lissom.move();
      const { left, top } = lissom.stage.renderer.domElement.getBoundingClientRect();
      const [x, y] = lissom.stage.pixel(lissom.kinematics.point(lissom.model.anchorOf(part)));
      return [left + x, top + y];
    }, part);
    await page.mouse.click(x, y);
    await page.waitForFunction(heading, part, { timeout: 2000 }).catch(() => null);
  }
  assert.ok(await page.evaluate(heading, part), `a click on ${part} selects it`);
  await page.keyboard.press("Escape");
  assert.equal(await page.evaluate(() => lissom.model.selected), null);
};

/** Pictures are not empty: pixels differ from the background, and from those at another time. */
const draws = async (page) => {
  const shot = async (share) => {
    await page.evaluate((share) => lissom.player.seek(lissom.player.start + share * (lissom.player.end - lissom.player.start)), share);
    await page.waitForTimeout(250);
    return page.evaluate(() => {
      const canvas = lissom.stage.renderer.domElement;
      const copy = Object.assign(document.createElement("canvas"), { width: 160, height: 100 });
      const pen = copy.getContext("2d");
      pen.drawImage(canvas, 0, 0, 160, 100);
      return [...pen.getImageData(0, 0, 160, 100).data];
    });
  };
  const [first, second] = [await shot(0), await shot(0.4)];
  const differs = first.filter((value, k) => Math.abs(value - second[k]) > 12).length;
  assert.ok(new Set(first).size > 30, "something is drawn");
  assert.ok(differs > 20, `the picture moves: ${differs} numbers differ`);
};

const tests = {
  "a mechanism of beams": async (browser) => {
    const out = view("examples/tip-crank.toml", "analysis.end=0.2");
    const { page, complaints } = await open(browser, join(out, "view.html"));
    assert.ok((await comparePlaces(page, out)) >= 8);
    await plays(page);
    await draws(page);
    await page.evaluate(() => lissom.look("front"));
    await selects(page, "beam");
    for (const colour of await page.evaluate(() => [...document.getElementById("colour").options].map((option) => option.value))) {
      await page.selectOption("#colour", colour);
      assert.equal(await page.locator("#legend").isVisible(), colour !== "part");
    }
    assert.equal(await page.locator(".plot").count(), 6);
    assert.deepEqual(complaints(), []);
  },
  "bodies, springs and all kinds of joints": async (browser) => {
    const text = readFileSync(join(root, "crates/lissom-model/tests/every_kind.toml"), "utf8");
    const outputs = ["f", "two.end"].map((node, k) => `[outputs.place${k}]\nkind = "position"\nof = "${node}"\n`);
    writeFileSync(join(folder, "every.toml"), text.replace("[analysis]", `${outputs.join("")}[analysis]`));
    const out = view(join(folder, "every.toml"));
    const { page, complaints } = await open(browser, join(out, "view.html"));
    assert.equal(await comparePlaces(page, out), 8);
    await selects(page, "h");
    for (const key of ["t", "d", "o", "c", "1", "2", "3", "0", "End", "ArrowLeft", "Home", "+", "-", "l", "f"]) await page.keyboard.press(key);
    await page.selectOption("#shape", "ellipsoid");
    await page.selectOption("#magnify", "2");
    await page.waitForTimeout(300);
    assert.deepEqual(complaints(), []);
  },
  "bodies in a plane": async (browser) => {
    const out = view("verification/andrews-squeezer/model.toml");
    const { page, complaints } = await open(browser, join(out, "view.html"));
    await plays(page);
    await draws(page);
    assert.deepEqual(complaints(), []);
  },
  "paths, spectra and other results in the plots": async (browser) => {
    const out = view("examples/pendulum.toml");
    const other = view("examples/pendulum.toml", "springs.spring.stiffness=14", "analysis.step=7e-3");
    const { page, complaints } = await open(browser, join(out, "view.html"));
    const choices = page.locator(".plot .over");
    assert.equal(await choices.count(), 6);
    await choices.nth(0).selectOption("column bob.x");
    assert.equal(await page.locator(".plot canvas").count() > 0, true);
    await choices.nth(1).selectOption("frequency");
    // The amplitude of a sine of 5 Hz, by unequal rows.
    const amplitude = await page.evaluate(() => {
      const times = Float64Array.from({ length: 2001 }, (_, k) => 1e-3 * k + 0.1 * Math.sin(Math.PI * 1e-3 * k) ** 2);
      const found = lissom.spectrum(times, [times.map((t) => 3 + 0.5 * Math.sin(10 * Math.PI * t))]);
      return found.amplitudes[0][found.frequencies.findIndex((f) => Math.abs(f - 5) < 0.1)];
    });
    assert.ok(Math.abs(amplitude - 0.5) < 5e-3, `${amplitude}`);
    for (const [file, series] of [["view.html", 3], ["history.csv", 3]]) {
      await page.setInputFiles("#compare input", join(other, file));
      await page.waitForFunction((file) => lissom.plots.other?.name !== undefined && lissom.plots.compared === file, file, { timeout: 60000 });
      const count = await page.evaluate(() => lissom.plots.plots.map(({ plot }) => plot.series?.length));
      assert.equal(count[1], series, "one curve of each");
      assert.equal(count[5], 9, "four energies of each");
    }
    await page.evaluate(() => lissom.player.seek(0.5));
    await page.waitForTimeout(200);
    assert.deepEqual(complaints(), []);
    await page.setInputFiles("#compare input", join(root, "README.md"));
    await page.waitForFunction(() => document.querySelector("#notices .error")?.textContent.includes("cannot be compared"), null, { timeout: 60000 });
  },
  "statics": async (browser) => {
    const out = view("verification/right-angle-frame/model.toml");
    const { page, complaints } = await open(browser, join(out, "view.html"));
    assert.match(await page.locator("#clock").textContent(), /load/);
    await plays(page);
    assert.deepEqual(complaints(), []);
  },
  "natural modes": async (browser) => {
    const out = join(folder, "modes");
    execFileSync(program, ["modes", join(root, "examples/four-bar.toml"), "--count", "5", "--out", out, "--quiet"]);
    execFileSync(program, ["view", out, "--quiet"]);
    const { page, complaints } = await open(browser, join(out, "view.html"));
    assert.equal(await page.locator("#modes li").count(), 5);
    await page.keyboard.press("n");
    await page.waitForFunction(() => document.getElementById("clock").textContent.startsWith("mode 2:"), null, { timeout: 60000 });
    await draws(page);
    await plays(page);
    assert.deepEqual(complaints(), []);
  },
  "a phone": async (browser) => {
    const out = view("examples/four-bar.toml", "analysis.end=2");
    const { page, complaints } = await open(browser, join(out, "view.html"), { width: 390, height: 800 });
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= 390, `${wide} pixels wide`);
    await plays(page);
    assert.deepEqual(complaints(), []);
  },
  "a model at its start, and a run that failed": async (browser) => {
    const still = join(folder, "still.html");
    execFileSync(program, ["view", join(root, "examples/top.toml"), "--initial", "--html", still, "--quiet"]);
    const first = await open(browser, still);
    assert.ok(await first.page.locator("#play").isDisabled());
    assert.deepEqual(first.complaints(), []);
    const out = join(folder, "failed");
    const failed = spawnSync(program, ["view", join(root, "examples/four-bar.toml"), "--out", out, "--quiet", "--set", "analysis.max_iterations=1", "--set", "analysis.tolerance=1e-14"]);
    assert.equal(failed.status, 3);
    const second = await open(browser, join(out, "view.html"));
    assert.match(await second.page.locator("#notices .error").textContent(), /failed/);
    assert.deepEqual(second.complaints(), []);
  },
  "a model that is saved and dragged": async (browser) => {
    const model = join(folder, "live.toml");
    const text = readFileSync(join(root, "examples/tip-crank.toml"), "utf8").replace("end = 0.4", "end = 0.05");
    writeFileSync(model, text);
    const live = spawn(program, ["live", model], { stdio: ["ignore", "pipe", "inherit"] });
    try {
      const address = await new Promise((found) => live.stdout.once("data", (data) => found(String(data).trim())));
      const page = await browser.newPage();
      const complaints = [];
      page.on("pageerror", (error) => complaints.push(error.message));
      page.on("request", (request) => request.url().startsWith(address) || complaints.push(`asks ${request.url()}`));
      await page.goto(address);
      const shown = (value) => page.waitForFunction((value) => lissom.result?.scene.beams[0].stations[0].outline.height === value, value, { timeout: 60000 });
      await shown(0.1);
      writeFileSync(model, text.replace("height = 0.1", "height = 0.12"));
      await shown(0.12);
      // A mistake is told beside the last picture, and is gone when it is mended.
      writeFileSync(model, text.replace("order = 3", "order = 9"));
      await page.waitForFunction(() => document.querySelector("#notices .error")?.textContent.includes("order"), null, { timeout: 60000 });
      assert.ok(await page.evaluate(() => lissom.model !== null));
      writeFileSync(model, text);
      await shown(0.1);
      assert.equal(await page.locator("#notices p").count(), 0);
      const before = await page.evaluate(() => lissom.live.version);
      await page.locator("[data-parameter=T]").fill("2");
      await page.waitForFunction((before) => lissom.live.version > before, before, { timeout: 60000 });
      assert.deepEqual(complaints, []);
      // Another page cannot read the results.
      const stranger = await browser.newPage();
      await stranger.goto("data:text/html,<title>stranger</title>");
      const seen = await stranger.evaluate((address) => fetch(`${address}result?after=0`).then((answer) => answer.text(), () => "refused"), address);
      assert.equal(seen, "refused");
    } finally {
      live.kill("SIGKILL");
    }
  },
};

const browser = await launch();
let failures = 0;
for (const [name, test] of Object.entries(tests)) {
  // A browser that draws in software on a busy machine may be late for once: what fails twice is wrong.
  for (const isLast of [false, true]) {
    const began = Date.now();
    try {
      await test(browser);
      console.log(`ok      ${name} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
      break;
    } catch (error) {
      if (isLast) failures++;
      console.log(`${isLast ? "FAILED" : "again"}  ${name}\n${error.stack}`);
    }
  }
}
await browser.close();
rmSync(folder, { recursive: true });
process.exit(failures === 0 ? 0 : 1);
