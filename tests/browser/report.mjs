// Opens a report from disk in headless Chromium, without network, and uses it as a person would.
//
//   node report.mjs REPORT EXPECTED CHROMIUM [SCREENSHOTS]
//
// EXPECTED is JSON: { pictures: [{ label, width, height, rgb: [[r, g, b], …] }] }, the reference last, read
// from the EXR files by somebody else than the page. Ends with 1 and the first thing that was wrong.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [report, expectedFile, executablePath, screenshots] = process.argv.slice(2);
const expected = JSON.parse(readFileSync(expectedFile, "utf8"));
const address = pathToFileURL(report).href;

// Playwright gives each run a folder of its own for the browser's data, and removes it.
const browser = await chromium.launch({
  executablePath,
  headless: true,
  args: [
    "--no-sandbox",
    "--disable-gpu",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
  ],
});

// A page that is open and ready, and what it complained about or asked for.
const open = async (options) => {
  const context = await browser.newContext({ viewport: { width: 1300, height: 900 }, ...options });
  await context.setOffline(true);
  const page = await context.newPage();
  const wrong = [];
  // Warnings are about this script's own reading of canvases.
  page.on("console", (m) => m.type() === "error" && wrong.push(`console: ${m.text()}`));
  page.on("pageerror", (e) => wrong.push(`error: ${e.message}`));
  page.on("request", (r) => {
    if (r.url() !== address && !r.url().startsWith("data:")) wrong.push(`request: ${r.url()}`);
  });
  await page.goto(address);
  if (options.javaScriptEnabled !== false) await page.waitForSelector("html[data-ready]", { timeout: 20_000 });
  return { page, wrong, close: () => context.close() };
};

// The pixels of an element's canvas, as text to compare.
const drawn = (page, selector) => page.$eval(selector, (c) => c.toDataURL());
const views = (page) => page.$$eval(".pane canvas", (all) => all.map((c) => c.dataset.view));
const labels = (page) => page.$$eval(".pane figcaption b", (all) => all.map((b) => b.textContent));
const pressed = (locator) => locator.getAttribute("aria-pressed");

const checks = {
  async "legends put curves away in all plots of a group"({ page }) {
    const first = page.locator(".plot").nth(0);
    const item = first.locator(".legend button").nth(0);
    const place = await item.getAttribute("data-place");
    const same = page.locator(`.plot .legend [data-place="${place}"]`);
    const before = await drawn(page, ".plot .uplot canvas");
    await item.click();
    for (const other of await same.all()) assert.equal(await pressed(other), "false");
    assert.notEqual(await drawn(page, ".plot .uplot canvas"), before);
    await item.click();
    for (const other of await same.all()) assert.equal(await pressed(other), "true");
    assert.equal(await drawn(page, ".plot .uplot canvas"), before);
  },

  async "a plot tells the values of the point under the pointer"({ page }) {
    const plot = page.locator(".plot .u-over").first();
    await plot.scrollIntoViewIfNeeded();
    const box = await plot.boundingBox();
    const tip = page.locator(".plot .tip").first();
    for (let i = 0; i < 400 && !(await tip.isVisible()); i++) {
      await page.mouse.move(box.x + box.width * ((i % 20) / 20), box.y + (box.height * Math.floor(i / 20)) / 20);
    }
    assert.match(await tip.textContent(), /\d samples, [\d.e-]+ s/);
    await page.mouse.move(0, 0);
  },

  async "every picture shows the numbers of its file"({ page }) {
    const viewer = page.locator("#viewer");
    await viewer.scrollIntoViewIfNeeded();
    assert.deepEqual(await labels(page), expected.pictures.map((p) => p.label));
    const { width, height } = expected.pictures[0];
    const canvas = page.locator(".pane canvas").first();
    for (let n = 0; n < 12; n++) {
      const [x, y] = [(5 * n + 1) % width, (7 * n + 2) % height];
      await canvas.hover({
        position: await canvas.evaluate((c, at) => {
          // Where the pixel lies, from what the page says that it shows: the whole picture.
          const scale = Math.min(c.clientWidth / at.width, c.clientHeight / at.height);
          return {
            x: (c.clientWidth - at.width * scale) / 2 + (at.x + 0.5) * scale,
            y: (c.clientHeight - at.height * scale) / 2 + (at.y + 0.5) * scale,
          };
        }, { x, y, width, height }),
      });
      assert.match(await page.locator(".readout .pixel").textContent(), new RegExp(`pixel ${x}, ${y}$`));
      const rows = await page.$$eval(".readout tbody tr", (all) =>
        all.map((r) => [...r.cells].map((c) => c.textContent)),
      );
      expected.pictures.forEach((picture, i) => {
        assert.equal(rows[i][0], picture.label);
        const shown = rows[i].slice(1, 4).map((text) => Math.fround(Number(text)));
        assert.deepEqual(shown, picture.rgb[y * width + x], `${picture.label} at ${x}, ${y}`);
      });
    }
  },

  async "the colours on the screen are those of the sRGB curve"({ page }) {
    const curve = (v) => {
      const x = Math.min(1, Math.max(0, v));
      return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
    };
    const { width, height, rgb } = expected.pictures[0];
    await page.locator(".stops").fill("0");
    const shown = await page.$eval(".pane canvas", (c, [w, h]) => {
      const scale = Math.min(c.width / w, c.height / h);
      const [left, top] = [(c.width - w * scale) / 2, (c.height - h * scale) / 2];
      const at = (x, y) => [...c.getContext("2d").getImageData(left + (x + 0.5) * scale, top + (y + 0.5) * scale, 1, 1).data];
      return Array.from({ length: w * h }, (_, i) => at(i % w, Math.floor(i / w)).slice(0, 3));
    }, [width, height]);
    shown.forEach((pixel, i) =>
      pixel.forEach((code, c) => {
        // Half a code of rounding, and what a step of the page's table may add: 12.92 · 255/4096/2.
        const distance = Math.abs(code - curve(rgb[i][c]));
        assert.ok(distance <= 0.5 + 0.41, `pixel ${i}: ${pixel} for ${rgb[i]}`);
      }),
    );
  },

  async "wheel and drag move all pictures together"({ page }) {
    const canvas = page.locator(".pane canvas").first();
    await canvas.click();
    await canvas.hover({ position: { x: 30, y: 30 } });
    await page.mouse.wheel(0, -480);
    await page.waitForFunction(() => Number(document.querySelector(".pane canvas").dataset.view.split(" ")[2]) > 2);
    const zoomed = await views(page);
    assert.equal(zoomed.length, expected.pictures.length);
    assert.equal(new Set(zoomed).size, 1, zoomed.join("; "));
    await page.mouse.down();
    await page.mouse.move((await canvas.boundingBox()).x + 70, (await canvas.boundingBox()).y + 50, { steps: 4 });
    await page.mouse.up();
    const moved = await views(page);
    assert.notEqual(moved[0], zoomed[0]);
    assert.equal(new Set(moved).size, 1);
    await page.keyboard.press("0");
    assert.match((await views(page))[0], /^0\.5\d* 0\.5\d* 1\./);
  },

  async "a wheel does not catch those who scroll by"({ page }) {
    await page.evaluate(() => document.activeElement.blur());
    await page.locator(".pane canvas").first().hover();
    const before = await views(page);
    await page.mouse.wheel(0, -120);
    await page.waitForTimeout(100);
    assert.deepEqual(await views(page), before);
  },

  async "keys flip between pictures"({ page }) {
    await page.locator("#viewer").focus();
    const runs = expected.pictures.slice(0, -1);
    const seen = new Set();
    for (const [i, picture] of runs.entries()) {
      await page.keyboard.press(String(i + 1));
      assert.deepEqual(await labels(page), [picture.label]);
      seen.add(await drawn(page, ".pane canvas"));
    }
    await page.keyboard.press("r");
    assert.deepEqual(await labels(page), ["reference"]);
    seen.add(await drawn(page, ".pane canvas"));
    assert.equal(seen.size, runs.length + 1, "pictures do not differ");
    await page.keyboard.press("+");
    assert.match((await views(page))[0], / 1\.25/);
    await page.keyboard.press("0");
    await page.keyboard.press("g");
    assert.equal((await labels(page)).length, expected.pictures.length);
  },

  async "the border of a split moves by pointer and by key"({ page }) {
    await page.locator('[data-layout="split"]').click();
    assert.deepEqual(await labels(page), [expected.pictures[0].label, "reference"]);
    const handle = page.locator(".handle");
    const before = await drawn(page, ".pane canvas");
    const box = await handle.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    const frame = await page.locator(".frame").boundingBox();
    await page.mouse.move(frame.x + 0.2 * frame.width, box.y + 20, { steps: 5 });
    await page.mouse.up();
    const now = Number(await handle.getAttribute("aria-valuenow"));
    assert.ok(Math.abs(now - 20) <= 1, `${now}`);
    assert.notEqual(await drawn(page, ".pane canvas"), before);
    await handle.focus();
    await page.keyboard.press("ArrowRight");
    assert.equal(Number(await handle.getAttribute("aria-valuenow")), now + 2);
    await page.locator('[data-layout="grid"]').click();
  },

  async "exposure makes brighter, and maps are there"({ page }) {
    const light = () =>
      page.$eval(".pane canvas", (c) => {
        const { data } = c.getContext("2d").getImageData(0, 0, c.width, c.height);
        return data.reduce((sum, v, i) => (i % 4 === 3 ? sum : sum + v), 0);
      });
    const slider = page.locator(".stops");
    const dark = await light();
    await slider.fill("2");
    assert.ok((await light()) > 1.1 * dark);
    await slider.fill("0");
    const select = page.locator(".kinds");
    const kinds = await select.locator("option").evaluateAll((all) => all.map((o) => o.value));
    for (const kind of ["picture", "relative", "squared", "flip", "samples"]) {
      assert.ok(kinds.includes(kind), `${kind} of ${kinds}`);
    }
    const seen = new Set();
    for (const kind of kinds) {
      await select.selectOption(kind);
      seen.add(await drawn(page, ".pane canvas"));
    }
    assert.ok(seen.size >= 5, `${seen.size} of ${kinds}`);
    await select.selectOption("picture");
  },

  async "tables sort by click and by key"({ page }) {
    const table = page.locator("#results");
    const column = await table.locator("th").evaluateAll((all) => all.findIndex((h) => h.textContent === "relMSE"));
    const keys = () =>
      table.locator("tbody tr").evaluateAll((rows, c) => rows.map((r) => Number(r.cells[c].dataset.key)), column);
    const head = table.locator("th").nth(column);
    await head.locator("button").click();
    const up = await keys();
    assert.equal(await head.getAttribute("aria-sort"), "ascending");
    assert.deepEqual(up, [...up].sort((a, b) => a - b));
    await head.locator("button").focus();
    await page.keyboard.press("Enter");
    assert.equal(await head.getAttribute("aria-sort"), "descending");
    assert.deepEqual(await keys(), [...up].reverse());
    await table.locator("th button").first().click();
    const names = await table.locator("tbody tr td:first-child").allTextContents();
    assert.deepEqual(names, [...names].sort((a, b) => a.localeCompare(b)));
  },

  async "dark and light are a click away"({ page }) {
    const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const toggle = page.locator("#theme");
    const seen = {};
    for (let i = 0; i < 3; i++) {
      seen[(await toggle.textContent()).slice(2)] = await paper();
      await toggle.click();
    }
    assert.notEqual(seen.dark, seen.light);
    assert.equal(seen.auto, seen.light);
  },

  async "on paper everything is open and still"({ page }) {
    await page.emulateMedia({ media: "print" });
    for (const selector of [".plot .static svg", "#stills img", "#repeat .configs pre"]) {
      const box = await page.locator(selector).first().boundingBox();
      assert.ok(box && box.width > 0 && box.height > 0, `${selector} is not on paper`);
    }
    for (const selector of ["#viewer", ".plot .live", "#theme"]) {
      assert.equal(await page.locator(selector).first().isVisible(), false, selector);
    }
    await page.emulateMedia({ media: "screen" });
  },
};

const run = async (name, work) => {
  try {
    await work();
    console.log(`ok: ${name}`);
  } catch (error) {
    console.log(`not ok: ${name}\n${error.stack ?? error}`);
    process.exitCode = 1;
  }
};

const desk = await open({ colorScheme: "light" });
for (const [name, check] of Object.entries(checks)) await run(name, () => check(desk));
await run("nothing is asked for and nothing complained about", () => assert.deepEqual(desk.wrong, []));
if (screenshots) await desk.page.screenshot({ path: `${screenshots}/light.png`, fullPage: true });
await desk.close();

await run("a dark system has a dark page", async () => {
  const { page, wrong, close } = await open({ colorScheme: "dark" });
  const [r] = (await page.evaluate(() => getComputedStyle(document.body).backgroundColor)).match(/\d+/g);
  assert.ok(Number(r) < 60);
  assert.deepEqual(wrong, []);
  if (screenshots) await page.screenshot({ path: `${screenshots}/dark.png`, fullPage: true });
  await close();
});

await run("a phone shows it all, and two fingers zoom", async () => {
  const size = { width: 360, height: 740 };
  const { page, wrong, close } = await open({ viewport: size, isMobile: true, hasTouch: true, deviceScaleFactor: 2 });
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(width <= size.width, `${width} pixels wide`);
  if (screenshots) await page.screenshot({ path: `${screenshots}/phone.png`, fullPage: true });
  const canvas = page.locator(".pane canvas").first();
  await canvas.evaluate((c) => c.scrollIntoView({ block: "center" }));
  const { x, y } = await canvas.boundingBox();
  const session = await page.context().newCDPSession(page);
  const touch = (type, ...points) =>
    session.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: points.map(([dx, id]) => ({ x: x + dx, y: y + 40, id })),
    });
  await touch("touchStart", [60, 0], [80, 1]);
  for (let i = 1; i <= 5; i++) await touch("touchMove", [60 - 4 * i, 0], [80 + 4 * i, 1]);
  await touch("touchEnd");
  const all = await views(page);
  assert.ok(Number(all[0].split(" ")[2]) > 1.5, all[0]);
  assert.equal(new Set(all).size, 1);
  assert.deepEqual(wrong, []);
  await close();
});

await run("without scripts verdict, plots, pictures and tables are there", async () => {
  const { page, close } = await open({ javaScriptEnabled: false });
  for (const selector of ["#verdict", ".plot svg", "#stills img", "#results tbody tr", "#repeat pre"]) {
    assert.ok(await page.locator(selector).first().isVisible(), selector);
  }
  assert.equal(await page.locator("#viewer").isVisible(), false);
  await close();
});

await browser.close();
