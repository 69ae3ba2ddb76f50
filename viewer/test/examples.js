// All examples at three sizes and in both themes, as pixels and boxes of the page.

import assert from "node:assert/strict";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const SIZES = [[1400, 900], [1000, 700], [390, 800]];

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
    // Ground that is larger than the motion is not framed, and the camera goes with a machine that travels far.
    const grounds = stage.framed === stage.points ? [] : [...model.parts.values()].filter(({ kind }) => kind === "ground");
    for (const { object } of grounds) object.visible = false;
    const instants = player.end > player.start ? 9 : 1;
    for (let k = 0; k < instants; k++) {
      kinematics.set(player.start + ((player.end - player.start) * k) / 8);
      model.update();
      if (lissom.choices.follow === "machine") stage.accompany(lissom.way());
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
    for (const { object } of grounds) object.visible = true;
    player.seek(time);
    lissom.move();
    const [left, top, right, bottom] = edges;
    return { across: (right - left + 1) / width, down: (bottom - top + 1) / height, isCut: left === 0 || top === 0 || right === width - 1 || bottom === height - 1 };
  });

/** Pairs of texts within a canvas whose boxes overlap. */
const canvasOverlaps = (page) =>
  page.evaluate(async () => {
    const drawn = new Map();
    const { prototype } = CanvasRenderingContext2D;
    const { fillText } = prototype;
    prototype.fillText = function (text, x, y, most) {
      const { width, actualBoundingBoxAscent: ascent, actualBoundingBoxDescent: descent } = this.measureText(text);
      const wide = Math.min(width, most ?? width);
      const left = x - ({ center: wide / 2, right: wide, end: wide }[this.textAlign] ?? 0);
      const corners = [[left, y - ascent], [left + wide, y + descent]].map(([a, b]) => this.getTransform().transformPoint(new DOMPoint(a, b)));
      const [xs, ys] = [corners.map((corner) => corner.x), corners.map((corner) => corner.y)];
      if (text) drawn.set(this.canvas, [...(drawn.get(this.canvas) ?? []), { text, left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys), bottom: Math.max(...ys) }]);
      return fillText.call(this, text, x, y, most);
    };
    for (const { plot } of [...lissom.plots.plots, ...(lissom.campbell?.plots ?? [])]) plot.redraw ? plot.redraw() : plot.draw();
    await new Promise((done) => setTimeout(done, 50));
    prototype.fillText = fillText;
    const found = drawn.size ? [] : ["no text is drawn"];
    for (const [canvas, texts] of drawn) {
      texts.forEach((a, i) => {
        if (a.left < -1 || a.right > canvas.width + 1) found.push(`${a.text} is cut off`);
        for (const b of texts.slice(0, i)) if (Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1) found.push(`${b.text} over ${a.text}`);
      });
    }
    return found;
  });

/** Pairs of texts in headings, legends and controls whose boxes overlap, and boxes that reach out of the page. */
const overlaps = (page) =>
  page.evaluate(() => {
    const shown = (selector) => [...document.querySelectorAll(selector)].filter((each) => each.getClientRects().length > 0);
    const box = (each) => ({ each, ...each.getBoundingClientRect().toJSON() });
    const name = (each) => `${each.className || each.tagName} ${each.textContent.slice(0, 30)}`;
    const found = [];
    const meets = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
    const disjoint = (boxes) => {
      for (let i = 0; i < boxes.length; i++) for (let j = 0; j < i; j++) if (meets(boxes[i], boxes[j])) found.push(`${name(boxes[j].each)} over ${name(boxes[i].each)}`);
    };
    for (const card of shown(".plot")) {
      const own = (selector) => [...card.querySelectorAll(selector)].map(box);
      // The drawing with the labels of its axes must be between heading and legend.
      disjoint([...own("h3 > *"), ...own(":scope > canvas, .u-wrap"), ...own(".u-legend .u-series")]);
      const outer = card.getBoundingClientRect();
      for (const inner of own("h3, canvas, .u-legend")) if (inner.right > outer.right + 1) found.push(`${name(inner.each)} out of its card`);
    }
    disjoint(shown("#transport > *").map(box));
    disjoint(shown("header > :not(.fill)").map(box));
    disjoint(shown("#stage > .views, #scale, #legend, .gizmo").map(box));
    if (document.documentElement.scrollWidth > innerWidth) found.push(`the page is ${document.documentElement.scrollWidth} pixels wide`);
    return found;
  });

/** As many files of each kind as LISSOM_PAGES says, others every day (CI_SEED); all without it. */
const shown = (root, files) => {
  const count = Number(process.env.LISSOM_PAGES ?? files.length);
  const first = Number(process.env.CI_SEED ?? 0) * count;
  const kinds = [/^\[(parts\..*)?beams\./m, /^\[(parts\..*)?(contacts|loads|springs)\./m, /^/];
  const kindOf = (file) => kinds.findIndex((kind) => kind.test(readFileSync(join(root, "examples", file), "utf8")));
  const of = (kind) => files.filter((file) => kindOf(file) === kind);
  return kinds.flatMap((_, kind) => {
    const all = of(kind);
    return all.slice(0, count).map((_, k) => all[(first + k) % all.length]);
  });
};

export const examples = ({ root, folder, view, viewExample, open }) => {
  const files = readdirSync(join(root, "examples")).filter((file) => file.endsWith(".toml") && file !== "connecting-rod.toml");
  return {
    "parts have the dimensions of their data": async (browser) => {
      // Every body of every example has a shape.
      for (const file of files) {
        const text = readFileSync(join(root, "examples", file), "utf8");
        const count = (pattern) => text.match(pattern)?.length ?? 0;
        assert.ok(count(/^shape = [[{]|^mesh = /gm) >= count(/^\[.*bodies\.\w+\]/gm), `${file}: a body without a shape`);
      }
      const panel = join(folder, "panel.toml");
      // The inertia of a panel of 1.2 x 0.02 x 1 m, and a cable that becomes slack.
      const sides = [1.2, 0.02, 1];
      const inertia = [0, 1, 2].map((k) => sides.reduce((sum, side, j) => sum + (j === k ? 0 : side * side), 0) / 12);
      writeFileSync(panel, `lissom = 1\ngravity = [0, 0, -9.81]\n[bodies.panel]\nmass = 1\ninertia = ${JSON.stringify(inertia)}\nposition = [0, 0, -1.5]\n[springs.cable]\nkind = "point"\nbase = "ground"\ntip = "panel"\nat_base = [0, 0, 0]\nat_tip = [0, 0, -1]\nlength = 1.2\nstiffness = 1e4\nside = "tension"\n[analysis]\nkind = "dynamics"\nend = 0.1\nstep = 0.01\n`);
      const { page, complaints } = await open(browser, join(view(panel), "view.html"));
      const drawn = await page.evaluate(() => {
        lissom.player.seek(0);
        lissom.move();
        const { object } = lissom.model.parts.get("panel");
        const box = object.children.find(({ geometry }) => geometry.type === "BoxGeometry");
        const cable = lissom.model.parts.get("cable").drawn;
        const length = cable.pieces.reduce((sum, piece) => sum + piece.scale.y, 0);
        const { stage } = lissom;
        lissom.look("front");
        const ends = [0, 1].map((x) => stage.pixel([stage.controls.target.x + x, stage.controls.target.y, stage.controls.target.z]));
        stage.render();
        const [bar, label] = stage.scale.children;
        return { box: box.scale.toArray(), length, metre: ends[1][0] - ends[0][0], bar: bar.getBoundingClientRect().width, label: label.textContent };
      });
      drawn.box.forEach((side, k) => assert.ok(Math.abs(side - sides[k]) < 1e-6, `${drawn.box}`));
      assert.ok(Math.abs(drawn.length - 1.2) < 0.05, `a slack cable of ${drawn.length} m`);
      const [, number, unit, cell] = drawn.label.match(/^([\d.]+) (m|mm) · grid ([\d.]+ m+)$/);
      const length = Number(number) * (unit === "mm" ? 1e-3 : 1);
      assert.ok(cell && Math.abs(drawn.bar - length * drawn.metre) < 2, `a bar of ${drawn.bar} pixels for ${drawn.label}`);
      assert.deepEqual(complaints(), []);
    },
    "all examples at three sizes and in both themes": async (browser) => {
      for (const file of shown(root, files)) {
        const { page, complaints } = await open(browser, join(viewExample(file), "view.html"));
        for (const [width, height] of SIZES) {
          await page.setViewportSize({ width, height });
          await page.waitForFunction(([width]) => innerWidth === width && lissom.stage.renderer.domElement.clientWidth === lissom.stage.holder.clientWidth, [width], { timeout: 60000 });
          // The theme changes no sizes: the largest pictures are dark, the others light.
          const theme = width === SIZES[0][0] ? "dark" : "light";
          await page.evaluate((theme) => lissom.setTheme(theme), theme);
          const { across, down, isCut } = await coverage(page);
          const filled = Math.max(across, down);
          const what = `${file} at ${width} x ${height}, ${theme}`;
          assert.deepEqual(await overlaps(page), [], what);
          if (await page.evaluate(() => lissom.plots.plots.length)) assert.deepEqual(await canvasOverlaps(page), [], what);
          assert.ok(filled >= 0.3 && filled <= 0.9 && !isCut, `${what}: ${across} across, ${down} down, cut off: ${isCut}`);
        }
        assert.deepEqual(complaints(), [], file);
        await page.close();
      }
    },
  };
};
