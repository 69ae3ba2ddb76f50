// How parts are shown, reactions, names, the camera in the address, keys, themes and calm motion.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export const parts = ({ root, folder, view, open }) => ({
  "parts are hidden, transparent and named, and reactions are arrows": async (browser) => {
    const text = readFileSync(join(root, "examples/top.toml"), "utf8");
    writeFileSync(join(folder, "reaction.toml"), text.replace("[analysis]", '[outputs.pivot_force]\nkind = "reaction"\nof = "pivot"\n[analysis]'));
    const { page, complaints } = await open(browser, join(view(join(folder, "reaction.toml"), "analysis.end=0.2"), "view.html"));
    await page.locator('#parts [data-name="top"]').click();
    const box = (text) => page.locator("#selection .checks label", { hasText: text }).locator("input");
    await box("transparent").check();
    await box("initial shape").check();
    assert.deepEqual(await page.evaluate(() => {
      const { drawn, initial } = lissom.model.parts.get("top");
      return [drawn.material.opacity, initial.visible];
    }), [0.3, true]);
    await box("hide").check();
    await page.evaluate(() => lissom.setTheme("dark"));
    assert.deepEqual(await page.evaluate(() => [lissom.model.parts.get("top").object.visible, lissom.model.parts.get("top").drawn.material.opacity]), [false, 0.3]);
    await box("hide").uncheck();
    await page.locator("#names").check();
    await page.waitForFunction(() => [...document.querySelectorAll(".labels span")].some(({ textContent }) => textContent === "top"));
    await page.locator("#reactions").check();
    const arrow = await page.evaluate(() => {
      lissom.player.seek(lissom.player.end);
      lissom.move();
      const { arrows, most, length } = lissom.reactions;
      const [{ columns, shaft, tip, group }] = arrows;
      const force = columns.map(({ values }) => values.at(-1));
      const size = Math.hypot(...force);
      const drawn = tip.position.y + (lissom.reactions.head * tip.scale.y) / 2;
      const direction = shaft.position.clone().applyQuaternion(group.quaternion).normalize().toArray();
      return { wanted: (size * length) / most, drawn, cosine: direction.reduce((sum, x, k) => sum + (x * force[k]) / size, 0) };
    });
    assert.ok(Math.abs(arrow.drawn - arrow.wanted) < 1e-6 * arrow.wanted && arrow.cosine > 1 - 1e-9, JSON.stringify(arrow));
    assert.match(await page.locator("#force-scale").textContent(), /N per m of arrow/);
    const download = page.waitForEvent("download");
    await page.locator("#picture").click();
    const bytes = readFileSync(await (await download).path());
    assert.deepEqual([...bytes.subarray(1, 4)].map((code) => String.fromCharCode(code)).join(""), "PNG");
    assert.deepEqual(complaints(), []);
  },
  "a selected joint shows its coordinates, and a slide has a rail": async (browser) => {
    const text = readFileSync(join(root, "examples/slider-crank-elastic.toml"), "utf8").replaceAll('"parts/', `"${join(root, "examples/parts")}/`);
    const outputs = ["main_bearing", "cylinder"].map((joint) => `[outputs.of_${joint}]\nkind = "relative"\nof = "${joint}"\n`).join("");
    writeFileSync(join(folder, "coordinates.toml"), text.replace("[analysis]", `${outputs}[analysis]`));
    const { page, complaints } = await open(browser, join(view(join(folder, "coordinates.toml")), "view.html"));
    for (const [joint, coordinate, column] of [["main_bearing", "angle", "of_main_bearing.angle"], ["cylinder", "displacement", "of_cylinder.displacement"]]) {
      for (const row of [0, 0.3, 0.6, 1]) {
        const [texts, value] = await page.evaluate(([joint, share, column]) => {
          const { times, columns } = lissom.history;
          const row = Math.round(share * (times.length - 1));
          lissom.select(joint);
          lissom.player.seek(times[row]);
          lissom.move();
          return [lissom.model.coordinatesOf(joint), columns.find(({ name }) => name === column).values[row]];
        }, [joint, row, column]);
        assert.equal(texts[0][0], coordinate);
        const numbers = texts[0][1].match(/-?[\d.e-]+/g).map(Number);
        const shown = coordinate === "angle" ? numbers[1] : numbers[0];
        assert.ok(Math.abs(shown - value) < 2e-3 * Math.max(1, Math.abs(value)), `${joint} at ${row}: ${texts[0][1]}, and ${value} recorded`);
        if (coordinate === "angle") assert.ok(Math.abs(numbers[0] - (180 * value) / Math.PI) < 0.2 * Math.max(1, Math.abs(value)), `${texts[0][1]}`);
        assert.ok((await page.locator("#selection table").textContent()).includes(texts[0][1]));
      }
    }
    // Along its rod a piston has no rail; that of a mass alone is as long as the motion, with the symbol at both ends.
    const lengthOf = (page, joint) => page.evaluate((joint) => {
      const lengths = [];
      lissom.model.parts.get(joint).object.traverse(({ geometry }) => lengths.push(geometry?.parameters?.height ?? 0));
      return Math.max(...lengths);
    }, joint);
    const none = await lengthOf(page, "cylinder");
    assert.ok(none < 0.03, `${none} m`);
    assert.deepEqual(complaints(), []);
    const alone = await open(browser, join(view(join(root, "examples/bouncing-mass.toml")), "view.html"));
    const travel = await alone.page.evaluate(() => {
      const { values } = lissom.history.columns.find(({ name }) => name === "guide.displacement");
      return Math.max(...values, 0) - Math.min(...values, 0);
    });
    const rail = await lengthOf(alone.page, "guide");
    assert.ok(rail > travel && rail < 2 * travel, `a rail of ${rail} m for ${travel} m`);
  },
  "plates are at the ends of springs on the ground": async (browser) => {
    const text = `lissom = 1\ngravity = [0, 0, -9.81]\n[bodies.load]\nmass = 1\ninertia = { box = [0.2, 0.2, 0.2] }\nposition = [0, 0, -1]\n[springs.coil]\nkind = "point"\nbase = "ground"\ntip = "load"\nat_base = [0.5, 0, 0]\nat_tip = [0.5, 0, -1]\nstiffness = 1e3\n[analysis]\nkind = "dynamics"\nend = 0.1\nstep = 0.01\n`;
    writeFileSync(join(folder, "plates.toml"), text);
    const { page, complaints } = await open(browser, join(view(join(folder, "plates.toml")), "view.html"));
    const places = await page.evaluate(() => {
      const found = [];
      lissom.model.parts.get("coil").object.traverse((child) => child.geometry?.type === "BoxGeometry" && found.push(child.position.toArray()));
      return found;
    });
    assert.equal(places.length, 1);
    const [[x, , z]] = places;
    assert.ok(Math.abs(x - 0.5) < 1e-9 && z > 0 && z < 0.05, JSON.stringify(places));
    assert.deepEqual(complaints(), []);
  },
  "forces of contacts and springs are arrows": async (browser) => {
    const shown = async (file, ...set) => {
      const { page, complaints } = await open(browser, join(view(file, ...set), "view.html"));
      await page.locator("#reactions").check();
      return { page, complaints };
    };
    const disc = await shown("examples/rolling-disc.toml", "analysis.end=1");
    // The force on a disc acts where it touches the floor: at its radius from the centre, in the plane z = 0.
    for (const share of [0, 0.37, 1]) {
      const [height, radius, up] = await disc.page.evaluate((share) => {
        lissom.player.seek(share * lissom.player.end);
        lissom.move();
        const [{ group }] = lissom.reactions.arrows;
        // Forces are those of rows: the motion at the time of the row.
        lissom.kinematics.set(lissom.history.times[lissom.plots.row()]);
        lissom.reactions.update(lissom.plots.row());
        const centre = lissom.kinematics.point({ node: lissom.result.scene.bodies[0].node, position: [0, 0, 0] });
        const { x, y, z } = group.position;
        return [z, Math.hypot(x - centre[0], y - centre[1], z - centre[2]), group.visible];
      }, share);
      assert.ok(up && Math.abs(height) < 1e-9 && Math.abs(radius - 0.2) < 2e-4, `${height}, ${radius}`);
    }
    assert.deepEqual(disc.complaints(), []);
    // That on a wheel acts where the recorded contact is, along the axle.
    const wheels = await shown("examples/wheelset.toml", "analysis.end=0.4");
    const apart = await wheels.page.evaluate(() => {
      const row = lissom.history.times.length - 1;
      lissom.kinematics.set(lissom.history.times[row]);
      lissom.reactions.update(row);
      const centre = lissom.kinematics.point({ node: lissom.result.scene.bodies[0].node, position: [0, 0, 0] });
      return lissom.reactions.arrows.map(({ of, group: { position } }) => {
        const on = lissom.history.columns.find(({ name }) => name === `${of}.wheel`).values[row];
        return Math.abs(position.x - centre[0]) - (0.1506 + on);
      });
    });
    assert.equal(apart.length, 2);
    for (const distance of apart) assert.ok(Math.abs(distance) < 2e-4, `${apart}`);
    // A cable pulls its load towards the base, and not at all while it is slack.
    const crane = await shown("examples/crane-slack-cable.toml");
    const found = await crane.page.evaluate(() => {
      const { columns } = lissom.history;
      const { values } = columns.find(({ name }) => name === "cable.force");
      const arrow = lissom.reactions.arrows.find(({ of }) => of === "cable");
      return [values.indexOf(Math.max(...values)), values.indexOf(0)].map((row) => {
        lissom.kinematics.set(lissom.history.times[row]);
        lissom.reactions.update(row);
        return { isShown: arrow.group.visible, size: arrow.force(row).length(), up: arrow.force(row).z / values[row], most: values[row] };
      });
    });
    assert.deepEqual(found.map(({ isShown }) => isShown), [true, false]);
    assert.ok(Math.abs(found[0].size / found[0].most - 1) < 1e-6 && found[0].up > 0.9, JSON.stringify(found));
    assert.deepEqual(crane.complaints(), []);
  },
  "the motion as a film": async (browser) => {
    const { page } = await open(browser, join(view("examples/pendulum.toml", "analysis.end=1"), "view.html"));
    const download = page.waitForEvent("download", { timeout: 60000 });
    await page.evaluate(() => (lissom.player.speed = 1));
    await page.locator("#film").click();
    const bytes = readFileSync(await (await download).path());
    assert.deepEqual([...bytes.subarray(0, 4)], [0x1a, 0x45, 0xdf, 0xa3], "a file of Matroska, of which WebM is a kind");
    assert.ok(bytes.length > 5000, `${bytes.length} bytes`);
  },
  "the camera is in the address": async (browser) => {
    const file = join(view("examples/four-bar.toml", "analysis.end=1"), "view.html");
    const { page } = await open(browser, file);
    const box = await page.locator("#stage").boundingBox();
    await page.mouse.move(box.x + 400, box.y + 200);
    await page.mouse.down();
    await page.mouse.move(box.x + 300, box.y + 150, { steps: 4 });
    await page.mouse.up();
    await page.waitForFunction(() => location.hash.includes("camera="));
    const camera = (page) => page.evaluate(() => lissom.stage.camera.position.toArray().map((x) => x.toPrecision(4)));
    const other = await browser.newPage({ viewport: { width: 1200, height: 800 } });
    await other.goto(page.url());
    await other.waitForFunction(() => document.documentElement.dataset.ready === "true");
    assert.deepEqual(await camera(other), await camera(page));
  },
  "keys reach all controls, and themes and calm follow the system": async (browser) => {
    const file = join(view("examples/four-bar.toml", "analysis.end=1"), "view.html");
    const page = await browser.newPage({ viewport: { width: 1200, height: 800 }, colorScheme: "dark", reducedMotion: "reduce" });
    await page.goto(`file://${file}`);
    await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
    const theme = () => page.evaluate(() => document.documentElement.dataset.theme);
    assert.equal(await theme(), "dark");
    await page.emulateMedia({ colorScheme: "light" });
    await page.waitForFunction(() => document.documentElement.dataset.theme === "light");
    await page.keyboard.press("d");
    assert.equal(await theme(), "dark");
    await page.emulateMedia({ colorScheme: "dark" });
    await page.emulateMedia({ colorScheme: "light" });
    assert.equal(await theme(), "dark", "a choice stays");
    assert.equal(await page.evaluate(() => lissom.player.isPlaying), false, "calm pages do not play by themselves");
    // Every control that can be seen is reached by the tabulator key.
    const wanted = await page.evaluate(() => [...document.querySelectorAll("button, select, summary, input, [tabindex='0']")].filter((each) => each.getClientRects().length > 0 && !each.disabled && each.closest("dialog, details:not([open]) > :not(summary)") === null && each.type !== "file").length);
    await page.evaluate(() => document.body.focus());
    const reached = new Set();
    for (let k = 0; k < wanted + 10; k++) {
      await page.keyboard.press("Tab");
      reached.add(await page.evaluate(() => {
        const all = [...document.querySelectorAll("*")];
        return all.indexOf(document.activeElement);
      }));
    }
    assert.ok(reached.size >= wanted, `${reached.size} of ${wanted} controls are reached`);
    // Space presses the button that has the focus.
    await page.locator("#ortho").focus();
    await page.keyboard.press("Space");
    assert.deepEqual(await page.evaluate(() => [lissom.stage.isOrthographic, lissom.player.isPlaying]), [true, false]);
  },
  "thirty pictures per second in software": async (browser) => {
    const { page } = await open(browser, join(view("examples/four-bar.toml", "analysis.end=4"), "view.html"), { width: 1400, height: 900 });
    // Other work on the machine delays pictures, so the time of one is measured: moved, with plots, and drawn until a pixel can be read.
    const { median, rate } = await page.evaluate(async () => {
      const { stage, player } = lissom;
      const gl = stage.renderer.getContext();
      stage.sharpen(false);
      const times = Array.from({ length: 61 }, (_, k) => {
        const began = performance.now();
        player.seek(player.start + ((player.end - player.start) * k) / 60);
        lissom.move();
        stage.render();
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
        return performance.now() - began;
      });
      times.sort((a, b) => a - b);
      player.play(true);
      const before = lissom.drawn;
      await new Promise((done) => setTimeout(done, 3000));
      return { median: times[30], rate: (lissom.drawn - before) / 3 };
    });
    console.log(`        ${median.toFixed(1)} ms a picture, ${rate.toFixed(0)} pictures per second drawn in software`);
    assert.ok(median < 1000 / 30, `${median} ms`);
  },
});
