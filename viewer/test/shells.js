// Shells and solids: what they are coloured by, and how they are drawn.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { settled } from "../browser.js";
import { FieldFrames } from "../src/field_frames.js";
import { shellEdges, smoothCorners } from "../src/shell_corners.js";
import { shellFields } from "../src/shell_fields.js";
import { solidFields } from "../src/solid_fields.js";

/** A shell of n x m elements with its nodes at places of u and v from 0 to 1, whose frames are the global axes. */
const sheet = (n, m, place, changes = {}) => {
  const positions = [];
  for (let j = 0; j <= m; j++) for (let i = 0; i <= n; i++) positions.push(place(i / n, j / m));
  const elements = [];
  for (let j = 0; j < m; j++) for (let i = 0; i < n; i++) elements.push([[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([a, b]) => b * (n + 1) + a));
  const nodes = positions.map((_, k) => k + 1);
  return { name: "sheet", nodes, positions, elements, directors: [], thickness: [0.01], offset: 0, is_homogeneous: true, area: 1, mass: 1, ...changes };
};

/** What the page knows of a motion with numbers in one frame: `numbers` of each element or node, and its area and first axis. */
const recordedOf = (numbers, constants = numbers.map(() => [1, 1, 0, 0])) => {
  const recorded = { count: numbers.length, numbers: numbers[0].length, constants: Float64Array.from(constants.flat()), values: Float32Array.from(numbers.flat()) };
  return { recorded: [recorded], kinematics: { before: 0, time: 0, motion: { frames: 1, times: [0], fields: { stride: 1, parts: [recorded] } } } };
};

/** The fields of a shell whose elements have these numbers. */
const fieldsOf = (shell, numbers, constants) => {
  const { kinematics, recorded } = recordedOf(numbers, constants);
  return shellFields([shell], kinematics, recorded);
};

const near = (found, wanted, tolerance) => {
  wanted.forEach((value, k) => assert.ok(Math.abs(found[k] - value) <= tolerance, `number ${k} is ${found[k]} for ${value}`));
};

const unit = {
  "stresses of a shell are those of its forces and moments": () => {
    const [n11, n22, n12, m11, m22, m12] = [3e4, -1e4, 2e4, 50, 20, -30];
    for (const offset of [0, 0.003]) {
      const fields = fieldsOf(sheet(1, 1, (u, v) => [u, v, 0], { offset }), [[n11, n22, n12, m11, m22, m12, 7, 8, 3]]);
      for (const [where, height] of [["top", 1], ["middle", 0], ["bottom", -1]]) {
        const [a, b, c] = [[n11, m11], [n22, m22], [n12, m12]].map(([n, m]) => n / 0.01 + (height * 6 * (m - offset * n)) / 1e-4);
        const stress = Math.sqrt(a * a - a * b + b * b + 3 * c * c);
        near(fields[`von Mises stress, ${where}`].extremes(), [stress, stress], 1e-6 * stress);
      }
      const wanted = { "membrane force N22": n22, "twisting moment M12": m12, "transverse shear force Q13": 7, "transverse shear force Q23": 8, "strain energy per area": 9, thickness: 0.01 };
      for (const [name, value] of Object.entries(wanted)) near(fields[name].extremes(), [value, value], 1e-12);
    }
  },
  "numbers are straight between the frames that have them": () => {
    const times = [0, 1, 2, 4, 5, 7, 8];
    // Frames 0, 3 and 6, at 0, 4 and 8 s; or 0, 4 and 6, at 0, 5 and 8 s.
    for (const [stride, between] of [[3, 4], [4, 5]]) {
      const recorded = { count: 2, numbers: 1, values: Float32Array.from([0, 1, 10, 3, 30, -1]) };
      const kinematics = { motion: { frames: 7, times, fields: { stride, parts: [recorded] } } };
      const frames = new FieldFrames(kinematics, recorded);
      const at = (time) => {
        Object.assign(kinematics, { time, before: Math.min(times.filter((each) => each <= time).length - 1, 5) });
        return [...frames.now()];
      };
      near([...at(0), ...at(between), ...at(8)], [0, 1, 10, 3, 30, -1], 0);
      near([...at(between / 2), ...at((between + 8) / 2)], [5, 2, 20, 1], 1e-12);
    }
  },
  "numbers of a solid are those of the nodes of its surface in their order": () => {
    const solid = { name: "block", elements: [[7, 2, 5, 5], [2, 9, 5, 5]] };
    const { kinematics, recorded } = recordedOf([[2, 0.2], [5, 0.5], [7, 0.7], [9, 0.9]]);
    const fields = solidFields([solid], kinematics, recorded);
    near(fields["von Mises stress of solids"].onShell(solid), [7, 2, 5, 5, 2, 9, 5, 5], 0);
    near(fields["strain energy per volume"].extremes(), [0.04, 0.81], 1e-6);
  },
  "values are averaged at nodes by area, and not over folds": () => {
    // Three elements of areas 1, 3 and 1; the last one is folded up.
    const xs = [0, 1, 4, 4];
    const shell = sheet(3, 1, (u, v) => [xs[Math.round(3 * u)], v, u === 1 ? 1 : 0]);
    const [up, back] = [[0, 0, 1], [-1, 0, 0]];
    shell.directors = [Array(4).fill(up), Array(4).fill(up), Array(4).fill(back)];
    const force = 8;
    const fields = fieldsOf(shell, [force, 0, 0].map((first) => [first, ...Array(8).fill(0)]), [[1, 1, 0, 0], [3, 1, 0, 0], [1, 0, 0, 1]]);
    const values = fields["membrane force N11"].onShell(shell);
    near(values, [force, force / 4, force / 4, force, force / 4, 0, 0, force / 4, 0, 0, 0, 0], 1e-9 * force);
    assert.equal(smoothCorners(shell).count, 10);
    const edges = shellEdges(shell, smoothCorners(shell));
    assert.deepEqual([edges.all, edges.outline, edges.rims].map(({ length }) => length), [10, 9, 8]);
    // On a plate without a fold the middle edges are within it.
    const plate = sheet(3, 1, (u, v) => [u, v, 0]);
    assert.deepEqual(Object.values(shellEdges(plate, smoothCorners(plate))).map(({ length }) => length), [10, 8, 8]);
  },
  "components are not averaged where axes differ, and layers have no stresses": () => {
    const shell = sheet(2, 1, (u, v) => [u, v, 0], { is_homogeneous: false });
    const fields = fieldsOf(shell, [[10, ...Array(8).fill(0)], [3, ...Array(8).fill(0)]], [[1, 1, 0, 0], [1, 0, 1, 0]]);
    near(fields["membrane force N11"].onShell(shell), [...Array(4).fill(10), ...Array(4).fill(3)], 0);
    assert.deepEqual(Object.keys(fields).filter((name) => name.includes("stress")), []);
  },
  "stresses are not averaged where the thickness changes by a step": () => {
    const shell = sheet(2, 1, (u, v) => [u, v, 0], { thickness: [0.01, 0.02] });
    const fields = fieldsOf(shell, [Array(9).fill(0), [2e6, ...Array(8).fill(0)]]);
    near(fields["von Mises stress, middle"].onShell(shell), [...Array(4).fill(0), ...Array(4).fill(1e8)], 1e-6);
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

/** The numbers of an array of a file for ParaView. */
const arrayOf = (grid, name) => {
  const [, rest] = grid.split(`Name="${name}"`);
  const bytes = Buffer.from(rest.slice(rest.indexOf(">") + 1, rest.indexOf("<")).trim(), "base64");
  return Array.from({ length: (bytes.length - 8) / 4 }, (_, k) => bytes.readFloatLE(8 + 4 * k));
};

export const shells = ({ folder, program, view, open, comparePlaces, plays, draws, selects }) => {
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
    "stresses of a page are those of exports": async (browser) => {
      const { page, complaints, out } = await shown(browser, "exported", flap(0.3, { divisions: [12, 6] }));
      execFileSync(program, ["export", out, "--format", "vtk", "--frames", "1000"]);
      const times = await page.evaluate(() => [...lissom.kinematics.motion.times]);
      for (const frame of [20, times.length - 1]) {
        const grid = readFileSync(join(out, "vtk", `motion-${String(frame).padStart(4, "0")}.vtu`), "utf8");
        // Membrane forces are resolved beside the single precision of the motion, so that stresses in the middle are as exact as those at the top.
        const largest = Math.max(...arrayOf(grid, "von Mises stress top [Pa]"));
        assert.ok(largest > 1e6, `${largest} Pa`);
        for (const [name, array] of [["von Mises stress, top", "von Mises stress top [Pa]"], ["von Mises stress, middle", "von Mises stress middle [Pa]"], ["von Mises stress, bottom", "von Mises stress bottom [Pa]"]]) {
          const [elements, values] = await page.evaluate(([time, name]) => {
            lissom.colourBy(name);
            lissom.player.seek(time);
            lissom.move();
            const [shell] = lissom.result.scene.shells;
            return [shell.elements, [...lissom.model.field.onShell(shell)]];
          }, [times[frame], name]);
          const cells = arrayOf(grid, array).slice(0, elements.length);
          const around = new Map();
          elements.flat().forEach((node, corner) => around.set(node, [...(around.get(node) ?? []), cells[corner >> 2]]));
          elements.flat().forEach((node, corner) => {
            const own = around.get(node);
            // Elements are not quite equal, so that means by area differ a little.
            const mean = own.reduce((sum, value) => sum + value, 0) / own.length;
            assert.ok(Math.abs(values[corner] - mean) < 5e-3 * largest, `${name} at ${node}: ${values[corner]} for ${mean}`);
          });
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
