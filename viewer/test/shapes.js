// What is drawn of parts: their names, true dimensions, the size of symbols, ground and shadow.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";

const run = (end) => `[analysis]\nkind = "dynamics"\nend = ${end}\nstep = 0.01\n`;

/** A car of 4 m that drives 90 m, with wheels given by the inertia of cylinders. */
const car = () => {
  const wheel = (name, x, y) =>
    `[bodies.${name}]\nmass = 20\ninertia = { cylinder = [0.35, 0.2], axis = "y" }\nposition = [${x}, ${y}, 0.35]\nvelocity = [30, 0, 0]
[joints.${name}]\nkind = "revolute"\nbase = "chassis"\ntip = "${name}"\nat = [${x}, ${y}, 0.35]\naxis = "y"\n`;
  return `lissom = 1\ngravity = [0, 0, -9.81]\n[bodies.chassis]\nmass = 1000\ninertia = { box = [4, 1.6, 0.6] }\nposition = [0, 0, 0.7]\nvelocity = [30, 0, 0]
[joints.rail]\nkind = "prismatic"\nbase = "ground"\ntip = "chassis"\naxis = "x"\nat = [0, 0, 0.7]
[outputs.place]\nkind = "position"\nof = "front"\n[outputs.turn]\nkind = "relative"\nof = "front"\n${wheel("front", 1.3, 0.9)}${wheel("rear", -1.3, -0.9)}${run(3)}`;
};

export const shapes = ({ folder, view, open }) => {
  const shown = (browser, name, text) => {
    writeFileSync(join(folder, `${name}.toml`), text);
    return open(browser, join(view(join(folder, `${name}.toml`)), "view.html"));
  };
  return {
    "a body and a joint of one name are two parts": async (browser) => {
      const { page, complaints } = await shown(browser, "names", car());
      const listed = await page.locator("#parts li").evaluateAll((items) => items.map((item) => item.innerText.split("\n")));
      for (const kind of ["body", "revolute joint"]) assert.ok(listed.some(([name, own]) => name === "front" && own === kind), JSON.stringify(listed));
      for (const [key, output] of [["front", "place"], ["joints.front", "turn"]]) {
        await page.locator(`#parts [data-name="${key}"]`).click();
        assert.deepEqual(await page.evaluate(() => lissom.panel.outputsOf(lissom.model.selected)), [output]);
        assert.equal(await page.evaluate(() => lissom.model.outline.meshes[0].parent.userData.part), key);
      }
      assert.deepEqual(complaints(), []);
    },
    "shapes have their colours, except while a field is shown": async (browser) => {
      const solid = `shape = [{ box = [1, 1, 1], colour = "#d1495b" }, { sphere = 0.2, position = [0, 0, 1] }, { sphere = 0.1, position = [0, 1, 0], colour = "#2e86ab" }]`;
      const text = `lissom = 1\n[bodies.box]\nmass = 1\ninertia = { box = [1, 1, 1] }\nvelocity = [1, 0, 0]\n${solid}\n${run(0.1)}`;
      const { page, complaints } = await shown(browser, "painted", text);
      const drawn = (field) =>
        page.evaluate((field) => {
          lissom.colourBy(field);
          const { drawn } = lissom.model.parts.get("box");
          return drawn.group.children.filter((child) => child.isMesh).map(({ material, geometry }) => [`#${material.color.getHexString()}`, geometry.attributes.position.count / 3]);
        }, field);
      const own = await drawn("part");
      assert.equal(own.length, 3);
      assert.deepEqual(own.slice(1).map(([colour]) => colour), ["#d1495b", "#2e86ab"]);
      assert.equal(own[1][1], 12, "triangles of the box");
      const fields = await page.locator("#colour option").evaluateAll((all) => all.map((each) => each.value));
      const speed = await drawn(fields.find((field) => field.includes("speed") || field.includes("velocity")));
      assert.equal(new Set(speed.map(([colour]) => colour)).size, 1, JSON.stringify([fields, speed]));
      assert.deepEqual(await drawn("part"), own);
      assert.deepEqual(complaints(), []);
    },
    "symbols scale with the model, and the ground follows it": async (browser) => {
      const { page, complaints } = await shown(browser, "car", car());
      const { size, extent, apart, cells } = await page.evaluate(() => {
        const { stage, player, kinematics } = lissom;
        player.seek(player.end);
        lissom.move();
        const place = kinematics.point({ node: lissom.result.scene.bodies[0].node, position: [0, 0, 0] });
        stage.follow(place);
        stage.render(stage.centre.clone().set(...kinematics.middle()));
        const { shadow, grid, cell } = stage.ground;
        const distance = ({ position }) => Math.hypot(position.x - place[0], position.y - place[1]);
        return { size: stage.size, extent: stage.extent, apart: distance(shadow.plane), cells: distance(grid) / cell };
      });
      assert.ok(size > 3 && size < 8 && extent > 90, `${size} m of ${extent} m`);
      assert.ok(apart < 1 && cells < 1, `the shadow is ${apart} m, the grid ${cells} cells beside the car`);
      assert.deepEqual(complaints(), []);
    },
    "a machine that travels far is framed alone, and fit shows the whole motion": async (browser) => {
      const { page, complaints } = await shown(browser, "far", car());
      /** Where the ends of the car are in the picture at a share of the run, as shares of its width. */
      const ends = (share) =>
        page.evaluate((share) => {
          const { stage, player, kinematics } = lissom;
          player.seek(share * player.end);
          lissom.move();
          const { node } = lissom.result.scene.bodies[0];
          const pixels = [-2, 2].map((x) => stage.pixel(kinematics.point({ node, position: [x, 0, 0] }))[0] / stage.holder.clientWidth);
          return { pixels, length: Math.abs(pixels[1] - pixels[0]), isFollowing: document.getElementById("follow").checked };
        }, share);
      const isWithin = ({ pixels }) => pixels.every((x) => x > 0 && x < 1);
      for (const share of [0, 0.5, 1]) {
        const seen = await ends(share);
        assert.ok(seen.isFollowing && seen.length > 0.3 && isWithin(seen), JSON.stringify(seen));
      }
      await page.keyboard.press("1");
      assert.ok(isWithin(await ends(0.7)), "seen from the front at another time");
      await page.keyboard.press("a");
      for (const share of [0, 1]) {
        const seen = await ends(share);
        assert.ok(!seen.isFollowing && seen.length < 0.1 && isWithin(seen), `${share}: ${JSON.stringify(seen)}`);
      }
      await page.keyboard.press("f");
      await page.keyboard.press("0");
      assert.ok((await ends(0.2)).length > 0.3, "followed again");
      assert.deepEqual(complaints(), []);
    },
    "ground that is larger than the motion is not framed": async (browser) => {
      const text = `lissom = 1\n[bodies.box]\nmass = 1\ninertia = { box = [0.2, 0.2, 0.2] }\nshape = { box = [0.2, 0.2, 0.2] }\nvelocity = [1, 0, 0]\n[ground]\nshape = { box = [20, 20, 0.1] }\n${run(0.5)}`;
      const { page, complaints } = await shown(browser, "floor", text);
      const side = await page.evaluate(() => {
        const [left, right] = [-0.1, 0.1].map((x) => lissom.stage.pixel([x, 0, 0])[0]);
        return (right - left) / lissom.stage.holder.clientWidth;
      });
      assert.ok(side > 0.1, `${side}`);
      assert.deepEqual(complaints(), []);
    },
    "a shadow darkens the ground below the model, and not beside it": async (browser) => {
      const box = `lissom = 1\ngravity = [0, 0, -9.81]\n[bodies.box]\nmass = 1\ninertia = { box = [1, 1, 0.2] }\nposition = [0, 0, 0.2]\n[joints.base]\nkind = "prismatic"\nbase = "ground"\ntip = "box"\naxis = "x"\n${run(0.1)}`;
      const { page } = await shown(browser, "shadow", box);
      const [below, beside] = await page.evaluate(() => {
        const { stage } = lissom;
        lissom.look("front");
        stage.ground.grid.visible = false;
        // Parts cast their shadow, but are not drawn.
        stage.camera.layers.set(0);
        lissom.model.group.traverse((child) => child.layers.disable(0));
        stage.camera.position.set(0, -4, 3);
        stage.controls.target.set(0, 0, 0);
        stage.controls.update();
        stage.render();
        const gl = stage.renderer.getContext();
        const ratio = stage.renderer.getPixelRatio();
        return [[0, 0, stage.lowestPart], [1.05, 0, stage.lowestPart]].map((place) => {
          const [x, y] = stage.pixel(place);
          const pixel = new Uint8Array(4);
          gl.readPixels(Math.round(x * ratio), Math.round((stage.holder.clientHeight - y) * ratio), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
          return pixel[0];
        });
      });
      assert.ok(below < beside - 30, `${below} below the box, ${beside} beside it`);
    },
    "bodies look like the solids of their inertia, and round ones are smooth": async (browser) => {
      const { page, complaints } = await shown(browser, "cylinder", car());
      const { reach, along, bend } = await page.evaluate(() => {
        const { geometry } = lissom.model.parts.get("front").object.children[0];
        const [places, normals] = [geometry.attributes.position, geometry.attributes.normal].map(({ array }) => array);
        const found = { reach: 0, along: 0, bend: 0 };
        for (let k = 0; k < places.length; k += 3) {
          const radius = Math.hypot(places[k], places[k + 2]);
          found.reach = Math.max(found.reach, radius);
          found.along = Math.max(found.along, Math.abs(places[k + 1]));
          // Normals of the round side are those of a cylinder, not of its facets.
          if (Math.abs(normals[k + 1]) < 0.5) found.bend = Math.max(found.bend, Math.hypot(normals[k] - places[k] / radius, normals[k + 2] - places[k + 2] / radius));
        }
        return found;
      });
      assert.ok(Math.abs(reach - 0.35) < 1e-6 && Math.abs(along - 0.1) < 1e-6, `${reach}, ${along}`);
      assert.ok(bend < 0.04, `normals differ by ${bend}`);
      assert.deepEqual(complaints(), []);
    },
    "ropes have their diameter, and local loads are arrows": async (browser) => {
      const body = `[bodies.load]\nmass = 100\ninertia = { sphere = 0.25 }\nposition = [0, 0, 1]\n[outputs.place]\nkind = "position"\nof = "load"\n`;
      const rope = `[springs.hoist]\nkind = "rope"\nalong = [{ on = "ground", at = [-0.5, 0, 3] }, { on = "load", at = [0, 0, 1.25] }, { on = "ground", at = [0.5, 0, 3] }]\nstiffness = 2e5\ndiameter = 0.06\n`;
      const wind = `[local_loads.wind]\non = "load"\naxes = "global"\nflow = [10, 0, 0]\nforce = ["20*u1", 0, 0]\n[outputs.wind]\nkind = "local_load"\nof = "wind"\n`;
      const { page, complaints } = await shown(browser, "hoist", `lissom = 1\ngravity = [0, 0, -9.81]\n${body}${rope}${wind}${run(0.2)}`);
      await page.locator("#reactions").check();
      const { radius, kind, force, apart } = await page.evaluate(() => {
        lissom.player.seek(0);
        lissom.move();
        const [{ mesh }] = lissom.model.parts.get("hoist").drawn.rods;
        const arrow = lissom.reactions.arrows.find(({ of }) => of === "wind");
        const { x, y, z } = arrow.group.position;
        return { radius: mesh.geometry.parameters.radiusTop, kind: lissom.model.parts.get("wind").kind, force: arrow.force(0).toArray(), apart: Math.hypot(x, y, z - 1) };
      });
      assert.deepEqual([radius, kind], [0.03, "local load"]);
      assert.ok(Math.abs(force[0] - 200) < 1e-6 && apart < 1e-3, `${force} N, ${apart} m`);
      assert.deepEqual(complaints(), []);
    },
    "on phones sliders are beside the picture": async (browser) => {
      const { page } = await shown(browser, "phone", car());
      for (const [width, height] of [[390, 800], [844, 390], [667, 375]]) {
        await page.setViewportSize({ width, height });
        const [stage, slider, scrolled] = await page.evaluate(async () => {
          const live = document.getElementById("live");
          live.hidden = false;
          live.innerHTML = '<h2>Parameters</h2><label class="slider"><span class="row"><span>stiffness</span><output>1</output></span><input type="range"></label>';
          const box = async (own, top) => {
            window.scrollTo(0, top);
            await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
            return document.querySelector(own).getBoundingClientRect().toJSON();
          };
          return [await box("#stage", 0), await box("#live input", 0), await box("#stage", 200)];
        });
        const what = `${width} x ${height}: ${JSON.stringify([stage, slider, scrolled])}`;
        assert.ok(stage.top >= 0 && stage.height >= 0.4 * height, what);
        if (height > 500) assert.ok(slider.top >= stage.bottom - 1 && scrolled.top >= 0, what);
        else assert.ok(slider.left >= stage.right - 1, what);
        assert.ok(slider.bottom < height - 40, what);
        assert.ok(slider.width > 100, `a slider of ${slider.width} pixels`);
      }
    },
  };
};
