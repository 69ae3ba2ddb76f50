// Shells: strains of known deformations, what they are coloured by, and how they are drawn.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { settled } from "../browser.js";
import { shellEdges, smoothCorners } from "../src/shell_corners.js";
import { shellFields } from "../src/shell_fields.js";
import { ShellStrains } from "../src/shell_strains.js";

/** Stiffness of a homogeneous layer, by rows. */
const layer = (young, poisson, thickness) => {
  const rows = new Array(64).fill(0);
  const [plane, shear] = [young / (1 - poisson ** 2), young / (2 * (1 + poisson))];
  for (const [first, factor] of [[0, thickness], [3, thickness ** 3 / 12]]) {
    for (let i = 0; i < 2; i++) for (let j = 0; j < 2; j++) rows[8 * (first + i) + first + j] = factor * plane * (i === j ? 1 : poisson);
    rows[9 * (first + 2)] = factor * shear;
  }
  rows[63] = rows[54] = (5 / 6) * shear * thickness;
  return rows;
};

/** A shell of n x m elements with its nodes at places of u and v from 0 to 1, whose frames are the global axes. */
const sheet = (n, m, place, changes = {}) => {
  const positions = [];
  for (let j = 0; j <= m; j++) for (let i = 0; i <= n; i++) positions.push(place(i / n, j / m));
  const elements = [];
  for (let j = 0; j < m; j++) for (let i = 0; i < n; i++) elements.push([[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([a, b]) => b * (n + 1) + a));
  const nodes = positions.map((_, k) => k + 1);
  const axes = positions.map(() => [1, 0, 0, 0]);
  return { name: "sheet", nodes, positions, elements, axes, directors: [], thickness: [0.01], offset: 0, directions: [[1, 0, 0]], stiffness: [layer(2e11, 0.3, 0.01)], is_homogeneous: true, area: 1, mass: 1, ...changes };
};

/** About an axis by an angle: scalar first. */
const turned = (axis, angle) => {
  const length = Math.hypot(...axis) || 1;
  return [Math.cos(angle / 2), ...axis.map((x) => (Math.sin(angle / 2) * x) / length)];
};
const product = ([a, b, c, d], [e, f, g, h]) => [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e];
const rotated = (q, x) => product(product(q, [0, ...x]), [q[0], -q[1], -q[2], -q[3]]).slice(1);

/** What the page would know of a motion of two frames: that of the description, and one with nodes at these places with these rotations. */
const kinematicsOf = (shell, places, rotations) => ({
  before: 1,
  after: 1,
  share: 0,
  motion: {},
  recorded: (frame, nodes, positions, quaternions) => {
    nodes.forEach((_, k) => {
      positions.set(frame === 0 ? shell.positions[k] : places[k], 3 * k);
      const [w, x, y, z] = frame === 0 ? shell.axes[k] : product(rotations[k], shell.axes[k]);
      quaternions.set([x, y, z, w], 4 * k);
    });
  },
});

/** Strains of the elements with their nodes at these places with these rotations. */
const strainsOf = (shell, places, rotations) => {
  const [positions, quaternions] = [new Float64Array(3 * places.length), new Float64Array(4 * places.length)];
  kinematicsOf(shell, places, rotations).recorded(1, shell.nodes, positions, quaternions);
  const out = new Float64Array(8 * shell.elements.length);
  new ShellStrains(shell).at(positions, quaternions, out);
  return shell.elements.map((_, element) => [...out.subarray(8 * element, 8 * element + 8)]);
};

const near = (found, wanted, tolerance) => {
  wanted.forEach((value, k) => assert.ok(Math.abs(found[k] - value) <= tolerance, `number ${k} is ${found[k]} for ${value}`));
};

/** A warped, curved and distorted surface with normals of its own at the corners of one element. */
const curved = () => {
  const shell = sheet(3, 2, (u, v) => [u + 0.1 * v * u, 0.7 * v + 0.08 * u * u, 0.3 * u * u - 0.2 * u * v + 0.05 * v]);
  shell.axes = shell.positions.map(([x, y]) => turned([1 + x, y, 0.3], 0.4 + x));
  shell.directions = [[1, 0.2, 0.1]];
  const tilted = [[0.1, 0, 1], [0, 0.2, 1], [0.1, 0.1, 1], [0, 0, 1]].map((x) => x.map((value) => value / Math.hypot(...x)));
  shell.directors = shell.elements.map((_, element) => (element === 1 ? tilted : tilted.map(() => [0, 0, 1])));
  return shell;
};

const unit = {
  "strains of a shell that moves as a whole are zero": () => {
    const shell = curved();
    const turn = turned([0.3, -1, 0.7], 2.3);
    const places = shell.positions.map((x) => rotated(turn, x).map((value, k) => value + [3, -2, 5][k]));
    for (const strains of strainsOf(shell, places, places.map(() => turn))) near(strains, Array(8).fill(0), 1e-12);
    // Without the turn of the nodes there is transverse shear.
    const sheared = strainsOf(shell, places, places.map(() => [1, 0, 0, 0]));
    assert.ok(Math.abs(sheared[0][6]) > 0.1);
  },
  "a plate that is stretched has its membrane force along the stretch": () => {
    const strain = 1e-3 + 1e-6 / 2;
    for (const [direction, along] of [[[1, 0, 0], 0], [[0, 2, 0.5], 1]]) {
      const shell = sheet(4, 3, (u, v) => [2 * u, v, 0], { directions: [direction] });
      const places = shell.positions.map(([x, y, z]) => [1.001 * x, y, z]);
      const none = places.map(() => [1, 0, 0, 0]);
      const wanted = Array(8).fill(0);
      wanted[along] = strain;
      for (const found of strainsOf(shell, places, none)) near(found, wanted, 1e-15);
      const fields = shellFields([shell], kinematicsOf(shell, places, none));
      const force = shell.stiffness[0][0] * strain;
      const [names, values] = [["N11", "N22"], [force, 0.3 * force]];
      if (along === 1) names.reverse();
      names.forEach((name, k) => near(fields[`membrane force ${name}`].extremes(), [values[k], values[k]], 1e-9 * force));
      const stress = (force / 0.01) * Math.sqrt(1 - 0.3 + 0.09);
      for (const where of ["top", "middle", "bottom"]) near(fields[`von Mises stress, ${where}`].extremes(), [stress, stress], 1e-9 * stress);
      near(fields["strain energy per area"].extremes(), [(force * strain) / 2, (force * strain) / 2], 1e-9 * force * strain);
    }
  },
  "distorted elements have the strains of a constant deformation": () => {
    const shell = sheet(1, 1, (u, v) => [[[0, 0, 0], [0.3, 1.4, 0]], [[1.2, -0.2, 0], [0.9, 0.8, 0]]][u][v]);
    // F = 1 + H in the plane: E = (FᵀF - 1)/2.
    const [a, b, c, d] = [1.02, 0.03, -0.01, 0.98];
    const places = shell.positions.map(([x, y]) => [a * x + b * y, c * x + d * y, 0]);
    const [found] = strainsOf(shell, places, places.map(() => [1, 0, 0, 0]));
    near(found, [(a * a + c * c - 1) / 2, (b * b + d * d - 1) / 2, a * b + c * d, 0, 0, 0, 0, 0], 1e-15);
    // The nodes' normals turn by a constant curvature: d = (-k x - t y, -t x, 1), small enough to be linear.
    const [k, t] = [1e-7, 0.4e-7];
    const bent = strainsOf(shell, shell.positions, shell.positions.map(([x, y]) => turned([t * x, -(k * x + t * y), 0], Math.hypot(t * x, k * x + t * y))));
    near(bent[0].slice(3, 6), [-k, 0, -2 * t], 1e-13);
  },
  "a plate that is bent to an arc and stretched has more stress on its outer side": () => {
    const [n, angle, strain] = [12, 0.05, 1e-4];
    const shell = sheet(n, 2, (u, v) => [u, 0.3 * v, 0]);
    // Elements are chords of a circle, and the normal is out of it.
    const radius = (1 + strain) / (2 * n * Math.sin(angle / 2));
    const along = shell.positions.map(([x]) => n * angle * x);
    const places = shell.positions.map(([, y], k) => [radius * Math.sin(along[k]), y, radius * (Math.cos(along[k]) - 1)]);
    const rotations = along.map((turn) => turned([0, 1, 0], turn));
    const [membrane, bending] = [strain + strain ** 2 / 2, n * angle * (1 + strain)];
    // Whatever the axes of the nodes, which carry the normal.
    const axes = shell.positions.map((_, k) => turned([1, k, 2], 0.3 + k));
    const directors = shell.elements.map((nodes) => nodes.map((node) => rotated([axes[node][0], ...axes[node].slice(1).map((x) => -x)], [0, 0, 1])));
    for (const own of [shell, { ...shell, axes, directors }]) {
      for (const found of strainsOf(own, places, rotations)) near(found, [membrane, 0, 0, bending, 0, 0, 0, 0], 1e-12);
    }
    const fields = shellFields([shell], kinematicsOf(shell, places, rotations));
    const moment = shell.stiffness[0][27] * bending;
    near(fields["bending moment M11"].extremes(), [moment, moment], 1e-9 * moment);
    near(fields["bending moment M22"].extremes(), [0.3 * moment, 0.3 * moment], 1e-9 * moment);
    const factor = (2e11 / 0.91) * Math.sqrt(1 - 0.3 + 0.09);
    for (const [where, height] of [["top", 0.005], ["middle", 0], ["bottom", -0.005]]) {
      const stress = factor * Math.abs(membrane + height * bending);
      near(fields[`von Mises stress, ${where}`].extremes(), [stress, stress], 1e-6 * stress);
    }
  },
  "values are averaged at nodes by area, and not over folds": () => {
    // Three elements of areas 1, 3 and 1; the last one is folded up.
    const xs = [0, 1, 4, 4];
    const shell = sheet(3, 1, (u, v) => [xs[Math.round(3 * u)], v, u === 1 ? 1 : 0]);
    const [up, back] = [[0, 0, 1], [-1, 0, 0]];
    shell.directors = [Array(4).fill(up), Array(4).fill(up), Array(4).fill(back)];
    shell.directions = [[1, 0, 0], [1, 0, 0], [0, 0, 1]];
    const places = shell.positions.map(([x, y, z]) => [x > 0.5 ? x + 1e-3 : x, y, z]);
    const fields = shellFields([shell], kinematicsOf(shell, places, places.map(() => [1, 0, 0, 0])));
    const field = fields["membrane force N11"];
    const force = shell.stiffness[0][0] * (1e-3 + 5e-7);
    const values = field.onShell(shell);
    near(values, [force, force / 4, force / 4, force, force / 4, 0, 0, force / 4, 0, 0, 0, 0], 1e-9 * force);
    assert.equal(smoothCorners(shell).count, 10);
    const edges = shellEdges(shell, smoothCorners(shell));
    assert.deepEqual([edges.all, edges.outline, edges.rims].map(({ length }) => length), [10, 9, 8]);
    // On a plate without a fold the middle edges are within it.
    const plate = sheet(3, 1, (u, v) => [u, v, 0]);
    assert.deepEqual(Object.values(shellEdges(plate, smoothCorners(plate))).map(({ length }) => length), [10, 8, 8]);
  },
  "components are not averaged where axes differ, and layers have no stresses": () => {
    const shell = sheet(2, 1, (u, v) => [u, v, 0], { directions: [[1, 0, 0], [0, 1, 0]], is_homogeneous: false });
    const places = shell.positions.map(([x, y, z]) => [1.001 * x, y, z]);
    const fields = shellFields([shell], kinematicsOf(shell, places, places.map(() => [1, 0, 0, 0])));
    const force = shell.stiffness[0][0] * (1e-3 + 5e-7);
    near(fields["membrane force N11"].onShell(shell), [...Array(4).fill(force), ...Array(4).fill(0.3 * force)], 1e-9 * force);
    assert.deepEqual(Object.keys(fields).filter((name) => name.includes("stress")), []);
  },
  "stresses are not averaged where the thickness changes by a step": () => {
    const shell = sheet(2, 1, (u, v) => [u, v, 0], { thickness: [0.01, 0.02], stiffness: [layer(2e11, 0.3, 0.01), layer(2e11, 0.3, 0.02)] });
    const places = shell.positions.map(([x, y, z]) => [x > 0.6 ? x + 1e-3 : x, y, z]);
    const fields = shellFields([shell], kinematicsOf(shell, places, places.map(() => [1, 0, 0, 0])));
    const stress = (2e11 / 0.91) * (2e-3 + 2e-6) * Math.sqrt(1 - 0.3 + 0.09);
    near(fields["von Mises stress, middle"].onShell(shell), [...Array(4).fill(0), ...Array(4).fill(stress)], 1e-9 * stress);
    assert.deepEqual([...fields.thickness.onShell(shell)], [...Array(4).fill(0.01), ...Array(4).fill(0.02)]);
  },
};

/** A clamped sheet that bends under its weight and a force at a corner. */
const flap = (end, { divisions = [16, 8], thickness = 0.002, more = "" } = {}) => `lissom = 1
gravity = [0, 0, -9.81]
[materials.aluminium]
E = 70e9
nu = 0.33
density = 2700
[shells.sheet]
surface = ["u", "0.4*(v - 0.5)", "0.1*u*u"]
divisions = [${divisions}]
thickness = ${thickness}
material = "aluminium"
[joints.root]
kind = "clamp"
base = "ground"
tip = "sheet.west"
[loads.push]
kind = "force"
on = "sheet@1,0"
vector = [0, 0, -10]
[outputs.tip]
kind = "position"
of = "sheet@1,0.5"
[outputs.energy]
kind = "energy"
${more}
[analysis]
kind = "dynamics"
end = ${end}
step = 5e-3
`;

export const shells = ({ folder, view, open, comparePlaces, plays, draws, selects }) => {
  const shown = (browser, name, text) => {
    writeFileSync(join(folder, `${name}.toml`), text);
    const out = view(join(folder, `${name}.toml`));
    return open(browser, join(out, "view.html")).then((opened) => ({ ...opened, out }));
  };
  return {
    ...unit,
    "a shell is drawn where its nodes are, and is a part like others": async (browser) => {
      const { page, complaints, out } = await shown(browser, "flap", flap(0.3));
      assert.ok((await comparePlaces(page, out)) >= 4);
      await plays(page);
      await draws(page);
      await selects(page, "sheet");
      const found = await page.evaluate(() => {
        lissom.player.seek(0.2);
        lissom.move();
        const [shell] = lissom.result.scene.shells;
        const { drawn } = lissom.model.parts.get("sheet");
        const { positions } = lissom.kinematics;
        const [places, normals] = [drawn.places.array, drawn.normals.array];
        let [apart, tilt, square] = [0, 0, 0];
        shell.elements.forEach((corners, element) => {
          const at = corners.map((corner) => [0, 1, 2].map((k) => positions[3 * shell.nodes[corner] + k]));
          corners.forEach((_, corner) => {
            const vertex = 3 * (5 * element + corner);
            const side = (other) => at[other % 4].map((x, k) => x - at[corner][k]);
            for (let k = 0; k < 3; k++) apart = Math.max(apart, Math.abs(places[vertex + k] - at[corner][k]));
            const along = side(corner + 1);
            const length = Math.hypot(...along);
            tilt = Math.max(tilt, Math.abs(along.reduce((sum, x, k) => sum + (x * normals[vertex + k]) / length, 0)));
            square = Math.max(square, Math.abs(1 - Math.hypot(...normals.subarray(vertex, vertex + 3))));
          });
        });
        return { apart, tilt, square };
      });
      assert.ok(found.apart < 1e-6 && found.tilt < 0.05 && found.square < 1e-6, JSON.stringify(found));
      await page.locator('#parts [data-name="sheet"]').click();
      const facts = await page.locator("#selection table").innerText();
      for (const wanted of [/area\s+0.4026\d* m²/, /thickness\s+0.002 m/, /elements\s+128\s/, /nodes\s+153\s/, /mass\s+2.174\d* kg/]) assert.match(facts, wanted);
      const box = (text) => page.locator("#selection .checks label", { hasText: text }).locator("input");
      await box("elements").check();
      await box("transparent").check();
      await box("initial shape").check();
      const state = () => page.evaluate(() => {
        const { drawn, initial, object } = lissom.model.parts.get("sheet");
        const ghost = initial.geometry.attributes.position.array;
        return { edges: drawn.grid.visible, opacity: drawn.material.opacity, ghost: Math.hypot(ghost[0] - drawn.places.array[0], ghost[1919] - drawn.places.array[1919]) > 0, isVisible: object.visible };
      });
      await page.evaluate(() => lissom.setTheme("dark"));
      assert.deepEqual(await state(), { edges: true, opacity: 0.3, ghost: true, isVisible: true });
      await box("hide").check();
      assert.equal((await state()).isVisible, false);
      await box("hide").uncheck();
      await page.selectOption("#magnify", "10");
      await page.selectOption("#frame", "part sheet");
      await page.locator("#names").check();
      await page.waitForFunction(() => [...document.querySelectorAll(".labels span")].some(({ textContent }) => textContent === "sheet"));
      // A cut hides what lies beyond it.
      const drawn = () =>
        page.evaluate(() => {
          const { renderer } = lissom.stage;
          lissom.stage.render(lissom.stage.centre);
          const gl = renderer.getContext();
          const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
          const pixels = new Uint8Array(4 * width * height);
          gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
          const [r, g, b] = pixels;
          let count = 0;
          for (let k = 0; k < pixels.length; k += 4) count += Math.abs(pixels[k] - r) + Math.abs(pixels[k + 1] - g) + Math.abs(pixels[k + 2] - b) > 60;
          return count;
        });
      await page.locator("#grid").uncheck();
      const whole = await drawn();
      await page.selectOption("#cut", "0");
      assert.match(await page.locator("#cut-place").innerText(), /^x < [\d.]+ m$/);
      const most = await drawn();
      await page.locator("#cut-at").fill("0.1");
      const least = await drawn();
      assert.ok(least < 0.7 * most && most < 0.95 * whole, `${least}, ${most} of ${whole} pixels`);
      await page.selectOption("#cut", "");
      assert.equal(await drawn(), whole);
      await page.locator("#grid").check();
      // All of the motion is in the picture.
      await page.evaluate(() => lissom.magnify(1));
      assert.equal(await page.evaluate(() => (lissom.stage.fit(), lissom.stage.isPoorlyFramed())), false);
      assert.deepEqual(complaints(), []);
    },
    "a solid is coloured by the stresses of the table, and is called a solid": async (browser) => {
      const out = view(new URL("../../examples/solids/crane-hook.toml", import.meta.url).pathname);
      const { page, complaints } = await open(browser, join(out, "view.html"));
      const [heading, ...lines] = readFileSync(join(out, "history.csv"), "utf8").trim().split("\n");
      const wanted = Number(lines.at(-1).split(",")[heading.split(",").indexOf("inside.mises")]);
      await page.selectOption("#colour", "von Mises stress of solids");
      const largest = await page.evaluate(() => {
        lissom.player.seek(lissom.player.end);
        lissom.move();
        return Math.max(...lissom.model.field.onShell(lissom.result.scene.elastic_solids[0]));
      });
      // The node of the output is within the hook, and the greatest stress beside it.
      assert.ok(largest >= 0.999 * wanted && largest < 1.05 * wanted, `${largest} Pa for ${wanted} Pa`);
      assert.match(await page.locator("#parts").innerText(), /hook\s+solid/);
      assert.deepEqual(complaints(), []);
    },
    "the strain energy of a shell is that of the table, however its deformation is drawn": async (browser) => {
      const { page, complaints, out } = await shown(browser, "energy", flap(0.5, { divisions: [32, 12], thickness: 0.02 }));
      const [heading, ...lines] = readFileSync(join(out, "history.csv"), "utf8").trim().split("\n");
      const column = heading.split(",").findIndex((name) => name.endsWith(".strain"));
      await page.selectOption("#colour", "strain energy per area");
      for (const magnification of [1, 20]) {
        for (const share of [0.5, 1]) {
          const row = lines[Math.round(share * (lines.length - 1))].split(",").map(Number);
          const energy = await page.evaluate(
            ([time, magnification]) => {
              lissom.magnify(magnification);
              lissom.player.seek(time);
              lissom.move();
              const [shell] = lissom.result.scene.shells;
              const values = lissom.model.field.onShell(shell);
              // Corners have a quarter of an element; these are nearly equal.
              return (values.reduce((sum, value) => sum + value, 0) / values.length) * shell.area;
            },
            [row[0], magnification],
          );
          assert.ok(Math.abs(energy - row[column]) < 0.02 * row[column], `${energy} J for ${row[column]} J`);
        }
      }
      assert.deepEqual(complaints(), []);
    },
    "shells and beams have one list of fields, and colours of shells are those of the legend": async (browser) => {
      const beam = `[sections.rod]\nshape = "circle"\nradius = 0.01\nmaterial = "aluminium"\n[beams.rod]\nfrom = [0, 1, 0]\nto = [1, 1, 0]\nsection = "rod"\nelements = 2\norder = 3\n[joints.end]\nkind = "clamp"\nbase = "ground"\ntip = "rod.start"\n`;
      const { page, complaints } = await shown(browser, "both", flap(0.2, { divisions: [8, 4], more: beam }));
      const names = await page.evaluate(() => [...document.getElementById("colour").options].map(({ value }) => value));
      for (const name of ["displacement", "axial force", "strain energy", "von Mises stress, top", "membrane force N11", "bending moment M22", "transverse shear force Q23", "thickness"]) assert.ok(names.includes(name), name);
      const painted = (name) => page.evaluate(async (name) => {
        lissom.colourBy(name);
        lissom.player.seek(0.15);
        lissom.move();
        await new Promise((next) => requestAnimationFrame(next));
        const isPainted = (part) => lissom.model.parts.get(part).drawn.mesh.material === lissom.model.parts.get(part).drawn.plain;
        return [isPainted("sheet"), isPainted("rod"), document.querySelector("#legend span").textContent];
      }, name);
      assert.deepEqual(await painted("displacement"), [true, true, "displacement [m]"]);
      assert.deepEqual(await painted("axial force"), [false, true, "axial force [N]"]);
      assert.deepEqual(await painted("bending moment M11"), [true, false, "bending moment M11 [N m/m]"]);
      assert.deepEqual(await painted("von Mises stress, bottom"), [true, false, "von Mises stress, bottom [Pa]"]);
      assert.deepEqual(await painted("part"), [false, false, "von Mises stress, bottom [Pa]"]);
      // The pixel at the centre of an element has the colour of the mean of its corners, on either side.
      await page.evaluate(() => document.querySelector('[data-show="loads"]').click());
      for (const [name, from] of [["bending moment M11", [0.5, -1, 1]], ["von Mises stress, top", [0.5, -1, -1]]]) {
        await page.evaluate(([name, from]) => {
          lissom.colourBy(name);
          lissom.player.seek(0.15);
          lissom.stage.grid.visible = false;
          lissom.stage.look(from);
          lissom.move();
        }, [name, from]);
        await settled(page);
        const [spot, share] = await page.evaluate(() => {
          const { model, stage } = lissom;
          const [shell] = model.scene.shells;
          const element = 10;
          const values = model.field.onShell(shell).subarray(4 * element, 4 * element + 4);
          const [low, high] = model.range;
          const { left, top } = stage.renderer.domElement.getBoundingClientRect();
          const at = 3 * (5 * element + 4);
          const [x, y] = stage.pixel([...model.parts.get("sheet").drawn.places.array.subarray(at, at + 3)]);
          return [[left + x, top + y], (values.reduce((sum, value) => sum + value, 0) / 4 - low) / (high - low)];
        });
        const shot = (await page.screenshot()).toString("base64");
        const [part, legend] = await page.evaluate(async ([shot, spot, share]) => {
          const image = new Image();
          image.src = `data:image/png;base64,${shot}`;
          await image.decode();
          const pen = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height }).getContext("2d", { willReadFrequently: true });
          pen.drawImage(image, 0, 0);
          const bar = document.querySelector("#legend .bar").getBoundingClientRect();
          const at = ([x, y]) => [...pen.getImageData(Math.round(x), Math.round(y), 1, 1).data.slice(0, 3)];
          return [at(spot), at([bar.left + share * bar.width, bar.top + bar.height / 2])];
        }, [shot, spot, share]);
        assert.ok(Math.max(...part.map((value, k) => Math.abs(value - legend[k]))) < 6, `${name}: drawn ${part}, legend ${legend}`);
      }
      assert.deepEqual(complaints(), []);
    },
    "a shell of two thousand elements moves sixty times per second": async (browser) => {
      const { page, complaints } = await shown(browser, "large", flap(0.02, { divisions: [64, 32] }));
      const measured = await page.evaluate(() => {
        lissom.player.play(false);
        const { start, end } = lissom.player;
        return ["part", "von Mises stress, top"].map((name) => {
          const began = performance.now();
          lissom.colourBy(name);
          const chosen = performance.now() - began;
          const times = Array.from({ length: 101 }, (_, k) => {
            lissom.player.seek(start + ((end - start) * k) / 100);
            const began = performance.now();
            lissom.move();
            return performance.now() - began;
          });
          return [chosen, times.sort((a, b) => a - b)[50]];
        });
      });
      const [[, plain], [chosen, coloured]] = measured;
      console.log(`        ${plain.toFixed(1)} ms to move 2048 elements, ${coloured.toFixed(1)} ms with colours, ${chosen.toFixed(0)} ms to choose them`);
      assert.ok(coloured < 1000 / 60, `${coloured} ms`);
      assert.deepEqual(complaints(), []);
    },
  };
};
