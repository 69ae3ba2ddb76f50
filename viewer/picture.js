// A picture of a page of results: `node picture.js PAGE.html PICTURE.png [TIME] [WIDTHxHEIGHT] [COLOUR]`.

import { resolve } from "node:path";

import { launch, open, settled } from "./browser.js";

const [file, picture, time = "0", size = "1200x760", colour = "part"] = process.argv.slice(2);
const [width, height] = size.split("x").map(Number);
const browser = await launch();
const page = await browser.newPage({ viewport: { width, height } });
await open(page, resolve(file));
await page.evaluate(
  ([time, colour]) => {
    lissom.player.seek(time);
    lissom.colourBy(colour);
  },
  [Number(time), colour],
);
await settled(page);
await page.screenshot({ path: picture });
await browser.close();
