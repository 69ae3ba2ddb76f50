// Plots: chosen, enlarged and arranged, over another column, along beams, and of other results.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export const plots = ({ program, root, folder, view, open }) => ({
  "a Campbell diagram": async (browser) => {
    const rotor = readFileSync(join(root, "crates/lissom/tests/support/rotor.toml"), "utf8");
    const model = join(folder, "overhung.toml");
    writeFileSync(model, `lissom = 1\n[parameters]\nspeed = 10.0\n[initial]\nangular_velocity = ["speed", 0, 0]\n${rotor}stiffness = 2000\n[joints.drive]\nkind = "prescribed_rotation"\njoint = "bearing"\nrotation = "speed*t"\n[analysis]\nkind = "dynamics"\nend = 1\nstep = 1e-3\n`);
    const out = join(folder, "campbell");
    const make = (...more) => {
      execFileSync(program, ["campbell", model, "--vary", "parameters.speed=25:200:8", "--count", "4", "--rays", "1", "--out", out, "--quiet", ...more]);
      execFileSync(program, ["view", out, "--quiet"]);
      return open(browser, join(out, "view.html"));
    };
    const { page, complaints } = await make();
    assert.match(await page.locator("#facts").textContent(), /^2 lines over 8 values of parameters.speed$/);
    assert.equal(await page.locator("#stage").isVisible(), false);
    // Critical speeds in closed form: (I_t - I_p) Ω² = k forward, (I_t + I_p) Ω² = k backward.
    const rows = (await page.locator(".critical tbody tr").all()).map((row) => row.locator("td").allTextContents());
    const found = Object.fromEntries((await Promise.all(rows)).map(([order, rpm, rate, , frequency, , whirl]) => [`${order} ${whirl}`, [rpm, rate, frequency].map(Number)]));
    assert.deepEqual(Object.keys(found).sort(), ["1P ↺ backward", "1P ↻ forward"]);
    for (const [key, inertia] of [["1P ↻ forward", 0.6 - 0.3], ["1P ↺ backward", 0.6 + 0.3]]) {
      const rate = Math.sqrt(2000 / inertia);
      [(60 * rate) / (2 * Math.PI), rate, rate / (2 * Math.PI)].forEach((wanted, k) => assert.ok(Math.abs(found[key][k] / wanted - 1) < 2e-5, `${key}: ${found[key]}`));
    }
    // Lines are continued by shape: the forward one rises and the backward one, which is dashed, falls.
    const curves = await page.evaluate(() => lissom.campbell.plots[0].plot.curves.map(({ label, dash, y, x, marks }) => ({ label, dash: Boolean(dash), x, y, marks })));
    const of = (sign) => curves.filter(({ label }) => label?.endsWith(sign));
    assert.deepEqual([of("↻").length, of("↺").length, of("P").length, curves.filter(({ marks }) => marks).length], [1, 1, 1, 1]);
    assert.ok(!of("↻")[0].dash && of("↺")[0].dash);
    of("↻")[0].y.forEach((y, k, all) => assert.ok(k === 0 || y > all[k - 1]));
    of("↺")[0].y.forEach((y, k, all) => assert.ok(k === 0 || y < all[k - 1]));
    assert.ok(Math.abs(of("↻")[0].x.at(-1) - (200 * 60) / (2 * Math.PI)) < 1e-6, "over rpm");
    assert.equal(await page.evaluate(() => lissom.campbell.plots.length), 1, "no damping");
    for (const [choice, last] of [["rad/s", 200], ["value", 200], ["Hz", 200 / (2 * Math.PI)]]) {
      await page.locator(".wide .over").selectOption(choice);
      assert.ok(Math.abs((await page.evaluate(() => lissom.campbell.plots[0].plot.curves.at(-2).x.at(-1))) - last) < 1e-6, choice);
    }
    const at = await page.evaluate(() => {
      const { plot } = lissom.campbell.plots[0];
      const { left, top } = plot.canvas.getBoundingClientRect();
      const { x, y } = plot.curves.find(({ label }) => label?.endsWith("↻"));
      const place = plot.place(x[3], y[3]);
      return [left + place[0], top + place[1]];
    });
    await page.mouse.move(...at);
    assert.match(await page.locator(".wide h3 span").textContent(), /whirl forward: [\d.]+ Hz, damping ratio 0 at 954.93 rpm/);
    assert.deepEqual(complaints(), []);
    const damped = await make("--set", "springs.one.damping=2", "--set", "springs.two.damping=2");
    assert.equal(await damped.page.evaluate(() => lissom.campbell.plots[1].plot.axes.y), "damping ratio [-]");
    await damped.page.setViewportSize({ width: 390, height: 800 });
    await damped.page.waitForFunction(() => document.documentElement.scrollWidth <= 390, null, { timeout: 10000 });
    assert.deepEqual(damped.complaints(), []);
  },
  "an orbit with its turns": async (browser) => {
    const model = join(folder, "orbit.toml");
    writeFileSync(model, `lissom = 1\n[bodies.rotor]\nmass = 1\ninertia = [1, 1, 1]\n[joints.bearing]\nkind = "revolute"\nbase = "ground"\ntip = "rotor"\naxis = [1, 0, 0]\n[joints.drive]\nkind = "prescribed_rotation"\njoint = "bearing"\nrotation = "10*t"\n[outputs.rim]\nkind = "position"\nof = "rotor"\npoint = [0, 0.1, 0]\n[outputs.shaft]\nkind = "relative"\nof = "bearing"\n[analysis]\nkind = "dynamics"\nend = 2\nstep = 1e-2\n`);
    const { page, complaints } = await open(browser, join(view(model), "view.html"));
    await page.locator(".plot", { hasText: "rim position" }).locator(".over").selectOption("orbit");
    const { axes, marks, scale } = await page.evaluate(() => {
      const { plot } = lissom.plots.plots.find(({ plot }) => plot.place);
      const [a, b, c] = [plot.place(0, 0), plot.place(0.1, 0), plot.place(0, 0.1)];
      return { axes: plot.axes, marks: plot.curves.filter(({ marks }) => marks), scale: (b[0] - a[0]) / (a[1] - c[1]) };
    });
    assert.match(axes.x, /^rim\.y \[m\] .* turns of shaft$/);
    assert.equal(axes.y, "rim.z [m]");
    assert.ok(Math.abs(scale - 1) < 1e-6);
    const of = (kind) => marks.find((curve) => curve.marks === kind);
    assert.deepEqual([of("ring").x.length, of("square").x.length, of("dot").x.length], [1, 1, 3]);
    // 20 rad are three whole turns; each ends where the orbit begins.
    of("dot").x.forEach((x, k) => assert.ok(Math.hypot(x - 0.1, of("dot").y[k]) < 1e-3));
    assert.deepEqual(complaints(), []);
  },
  "round-off is not a curve, gaps are apart from positions, and headings are whole": async (browser) => {
    const model = join(folder, "headings.toml");
    const long = "a_ball_that_falls_on_the_ground_and_whose_name_is_longer_than_the_heading_of_a_plot";
    const title = "A ball with a title that is much longer than the heading of a page can be, even on a wide screen, with all its buttons beside it";
    writeFileSync(model, `lissom = 1\ntitle = "${title}"\ngravity = [0, 0, -9.81]\n[ground]\nshape = { box = [2, 2, 0.1], position = [0, 0, -0.05] }\n[bodies.${long}]\nmass = 1\ninertia = { sphere = 0.1 }\nshape = { sphere = 0.1 }\nposition = [0.7, 0, 0.11]\n[contacts.floor]\nbase = "ground"\ntip = "${long}"\nstiffness = 1e5\ndissipation = 1\n[outputs.${long}]\nkind = "position"\nof = "${long}"\n[outputs.floor]\nkind = "contact_force"\nof = "floor"\n[analysis]\nkind = "dynamics"\nend = 0.3\nstep = 1e-3\n`);
    const { page, complaints } = await open(browser, join(view(model), "view.html"));
    const headings = await page.locator(".plot h3 div").allTextContents();
    assert.ok(headings.includes("floor gap [m]") && headings.includes("floor centre of contact [m]"), JSON.stringify(headings));
    const cut = await page.evaluate(() => [...document.querySelectorAll("#title, .plot h3 div, .plot h3 b, #parts b")].filter((each) => each.scrollWidth > each.clientWidth + 1 && getComputedStyle(each).display !== "inline").map((each) => each.textContent));
    assert.deepEqual(cut, []);
    assert.equal(await page.locator("#title").textContent(), title);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    // Columns that the program calls round-off are zero; a constant with round-off has an axis of its size.
    const [zero, constant, range, nothing, real] = await page.evaluate(() => {
      const text = "time,a.x,b.x\n0,1,7e-12\n1,2,-3e-12\n";
      const [a, b] = lissom.readTable(text, [{ name: "a.x", unit: "m" }, { name: "b.x", unit: "rad", is_round_off: true }]).columns;
      return [[...b.values], [...a.values], lissom.rangeShown(null, 5, 5 + 1e-10), lissom.rangeShown(null, 0, 0), lissom.rangeShown(null, 5, 5.1)];
    });
    assert.deepEqual([zero, constant], [[0, 0], [1, 2]]);
    assert.ok(range[0] < 4.9 && range[1] > 5.1 && nothing[0] === -1 && nothing[1] === 1, JSON.stringify([range, nothing]));
    assert.ok(real[1] - real[0] < 0.2, JSON.stringify(real));
    assert.deepEqual(complaints(), []);
  },
  "plots are chosen, enlarged, moved and split": async (browser) => {
    const { page, complaints } = await open(browser, join(view("examples/pendulum.toml"), "view.html"));
    const names = () => page.evaluate(() => lissom.plots.plots.map(({ output }) => output));
    const all = await names();
    await page.locator("#chooser summary").click();
    await page.locator("#chooser li input").first().uncheck();
    assert.deepEqual(await names(), all.slice(1));
    await page.locator("#chooser li input").first().check();
    await page.locator("#chooser li button").nth(1).click();
    assert.deepEqual((await names()).slice(0, 2), [all[1], all[0]]);
    await page.locator("#chooser summary").click();
    await page.locator(".plot h3 button").first().click();
    assert.deepEqual(await names(), [all[1]]);
    await page.locator("#splitter").focus();
    const height = () => page.evaluate(() => document.getElementById("plots").clientHeight);
    const before = await height();
    await page.keyboard.press("ArrowUp");
    assert.equal((await height()) - before, 24);
    await page.locator(".plot h3 button").first().click();
    assert.equal((await names()).length, all.length);
    // Hovering one plot leaves the curves of the others as they are.
    const faded = await page.evaluate(() => lissom.plots.plots.filter(({ plot }) => plot.over).map(({ plot }) => [plot.cursor.focus?.prox ?? -1, plot.cursor.sync.setSeries]));
    for (const [proximity, isShared] of faded) assert.ok(!(proximity > 0) && !isShared);
    // A sine whose frequency grows from 5 to 15 Hz: the largest amplitude of each window is at the frequency of its centre.
    const swept = await page.evaluate(() => {
      const times = Float64Array.from({ length: 4801 }, (_, k) => k / 1200);
      const values = times.map((t) => 0.5 * Math.sin(2 * Math.PI * (5 * t + 1.25 * t * t)));
      return lissom.waterfall(times, values).windows.map(({ at, frequencies, amplitudes }) => [5 + 2.5 * at, frequencies[amplitudes.indexOf(Math.max(...amplitudes))]]);
    });
    assert.ok(swept.length >= 20);
    for (const [wanted, found] of swept) assert.ok(Math.abs(wanted - found) < 3.1, `${found} Hz for ${wanted}`);
    // A trajectory has names, units and equal lengths on its axes.
    await page.locator(".plot", { hasText: "bob position" }).locator(".over").selectOption("column bob.x");
    const { axes, scale } = await page.evaluate(() => {
      const { plot } = lissom.plots.plots.find(({ plot }) => plot.place);
      const [a, b, c] = [plot.place(0, 0), plot.place(0.1, 0), plot.place(0, 0.1)];
      return { axes: plot.axes, scale: (b[0] - a[0]) / (a[1] - c[1]) };
    });
    assert.equal(axes.x, "bob.x [m]");
    assert.match(axes.y, /bob.*\[m\]/);
    assert.ok(Math.abs(scale - 1) < 1e-6, `${scale}`);
    assert.deepEqual(complaints(), []);
  },
  "section forces along a beam, events, and a ghost": async (browser) => {
    const out = view("examples/turbine-rotor.toml", "analysis.end=0.5");
    const { page, complaints } = await open(browser, join(out, "view.html"));
    const long = await open(browser, join(view("examples/turbine-rotor.toml"), "view.html"));
    // Each component has a waterfall, with a colour bar in its unit.
    const card = long.page.locator(".plot", { has: long.page.locator("h3 b", { hasText: /^blade1\.tip$/ }) }).first();
    const choices = await card.locator(".over option").evaluateAll((all) => all.map(({ value }) => value).filter((value) => value.startsWith("waterfall ")));
    assert.deepEqual(choices, ["waterfall blade1.tip.u1", "waterfall blade1.tip.u2", "waterfall blade1.tip.u3"]);
    await card.locator(".over").selectOption(choices[1]);
    const drawn = await long.page.evaluate(() => {
      const { plot } = lissom.plots.plots.find(({ plot }) => plot.found);
      return { windows: plot.found.windows.length, axes: plot.axes };
    });
    assert.ok(drawn.windows >= 20 && drawn.axes.x.includes("blade1.tip.u2") && drawn.axes.bar === "m", JSON.stringify(drawn));
    await page.evaluate(() => lissom.select(lissom.model.scene.beams[0].name));
    await page.locator(".plot.sections .over").selectOption("0");
    const found = await page.evaluate(() => {
      const { diagram } = lissom.plots;
      const { motion } = lissom.kinematics;
      const [low, high] = diagram.envelope;
      let isWithin = true;
      for (const time of motion.times) {
        lissom.player.seek(time);
        lissom.move();
        isWithin &&= diagram.now.y.every((value, k) => value >= low[k] && value <= high[k]);
      }
      return { isWithin, first: diagram.now.y[0], force: lissom.kinematics.forces[0], reached: high[0] > low[0] };
    });
    assert.deepEqual([found.isWithin, found.reached, found.first === found.force], [true, true, true]);
    // Section axes are perpendicular, and the first one is along the beam.
    await page.locator("#selection .checks label", { hasText: "section axes" }).locator("input").check();
    const cosines = await page.evaluate(() => {
      lissom.move();
      const { axes, drawn } = lissom.model.parts.get(lissom.model.selected);
      const { array } = axes.lines.geometry.attributes.position;
      const arm = (k) => [0, 1, 2].map((i) => (array[6 * k + 3 + i] - array[6 * k + i]) / axes.length);
      const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
      const [next] = axes.nodes.slice(1);
      const along = [0, 1, 2].map((i) => drawn.frames[7 * next + i] - drawn.frames[i]);
      const length = Math.hypot(...along);
      return [dot(arm(0), arm(1)), dot(arm(0), arm(2)), dot(arm(1), arm(2)), dot(arm(0), along) / length];
    });
    assert.ok(cosines.slice(0, 3).every((value) => Math.abs(value) < 1e-3) && cosines[3] > 0.99, `${cosines}`);
    const other = view("examples/turbine-rotor.toml", "analysis.end=0.5", "parameters.speed=8");
    await page.setInputFiles("#compare input", join(other, "view.html"));
    await page.locator("#compared").waitFor();
    const apart = await page.evaluate(() => {
      lissom.player.seek(lissom.player.end);
      lissom.move();
      const { node } = { node: lissom.model.scene.beams[0].nodes.at(-1) };
      const at = (kinematics) => kinematics.point({ node, position: [0, 0, 0] });
      return Math.hypot(...at(lissom.kinematics).map((x, k) => x - at(lissom.ghost.kinematics)[k]));
    });
    assert.ok(apart > 1, `the ghost is ${apart} m apart`);
    await page.locator("#compared button").click();
    assert.equal(await page.evaluate(() => lissom.ghost ?? lissom.plots.other), null);
    assert.deepEqual(complaints(), []);
    const bounces = await open(browser, join(view("examples/bouncing-mass.toml"), "view.html"));
    const mark = bounces.page.locator("#events button").first();
    assert.match(await mark.getAttribute("title"), /^bounce at 0\.319/);
    await mark.focus();
    await bounces.page.keyboard.press("Enter");
    assert.ok(Math.abs((await bounces.page.evaluate(() => lissom.player.time)) - 0.31927543) < 1e-6);
  },
});
