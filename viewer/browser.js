// A browser for tests and pictures: the system's chromium, drawing without a graphics card.

import { existsSync } from "node:fs";

import { chromium } from "playwright-core";

const paths = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

export const launch = () =>
  chromium.launch({
    executablePath: process.env.CHROMIUM ?? paths.find((path) => existsSync(path)),
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  });

/** Opens a page of results and waits until it shows them. */
export const open = async (page, file) => {
  await page.goto(`file://${file}#still`);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true", null, { timeout: 60000 });
};

/** Waits until the page has drawn what was asked of it: however long a picture takes. */
export const settled = (page) =>
  page.evaluate(async () => {
    for (let pictures = 0; pictures < 3; pictures++) await new Promise((next) => requestAnimationFrame(next));
  });
