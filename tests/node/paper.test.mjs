// Claims about the page on paper: printed to PDF by Chromium, every curve is there in every viewer.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { pathToFileURL } from "node:url";
import { altered, makeStudy } from "./documents.mjs";
import { launch, open, report, scratch } from "./support.mjs";

const chromiumPath = process.env.CHROMIUM || "/usr/bin/chromium";
const dotsPerInch = 100;
const dots = dotsPerInch / 72; // of a point

const tool = (program, ...args) => execFileSync(program, args, { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"], maxBuffer: 1 << 28 });

/** The engines that most people's viewers are made of, each told to draw a PDF as PPM files. */
const viewers = {
  poppler: (pdf, folder) => tool("pdftoppm", "-r", String(dotsPerInch), pdf, join(folder, "page")),
  MuPDF: (pdf, folder) => tool("mutool", "draw", "-q", "-r", String(dotsPerInch), "-o", join(folder, "page-%03d.ppm"), pdf),
  Ghostscript: (pdf, folder) => tool("gs", "-q", "-dSAFER", "-dBATCH", "-dNOPAUSE", "-sDEVICE=ppmraw", `-r${dotsPerInch}`, `-sOutputFile=${join(folder, "page-%03d.ppm")}`, pdf),
};

/** Words of every page with their places [pt]. */
function wordsOf(pdf) {
  const numbers = (text) => Object.fromEntries([...text.matchAll(/(\w+)="([-\d.]+)"/g)].map(([, key, value]) => [key, Number(value)]));
  return tool("pdftotext", "-bbox", pdf, "-").split("<page ").slice(1).map((page) => ({
    ...numbers(page.slice(0, page.indexOf(">"))),
    words: [...page.matchAll(/<word ([^>]*)>([^<]*)<\/word>/g)].map(([, place, text]) => ({ text, ...numbers(place) })),
  }));
}

/** Where charts are [pt]: above each `time [s]`, which stands at a chart's lower right corner. */
function chartsOf(pages) {
  return pages.flatMap(({ words }, page) => words
    .filter((word, i) => word.text === "[s]" && words[i - 1]?.text === "time")
    .map(({ xMax, yMin }) => ({ page, left: xMax - 160, right: xMax, top: yMin - 100, bottom: yMin - 4 })));
}

/** @returns {{width: number, height: number, pixels: Buffer}} */
function ppm(file) {
  const bytes = readFileSync(file);
  const [, width, height] = bytes.subarray(0, 200).toString("latin1").replace(/#[^\n]*\n/g, "").split(/\s+/).map(Number);
  return { width, height, pixels: bytes.subarray(bytes.length - 3 * width * height) };
}

/** How many dots of an area have a colour: axes, grid and text are grey. */
function coloured({ width, height, pixels }, { left, right, top, bottom }) {
  let count = 0;
  for (let y = Math.max(0, Math.round(top * dots)); y < Math.min(height, Math.round(bottom * dots)); y += 1)
    for (let x = Math.round(left * dots); x < Math.min(width, Math.round(right * dots)); x += 1) {
      const dot = pixels.subarray(3 * (y * width + x), 3 * (y * width + x) + 3);
      if (Math.max(...dot) - Math.min(...dot) > 30) count += 1;
    }
  return count;
}

/** In each viewer the dots of every chart. */
function seenIn(name, pdf) {
  const charts = chartsOf(wordsOf(pdf));
  return Object.fromEntries(Object.entries(viewers).map(([viewer, draw]) => {
    const folder = join(scratch, `${name}-${viewer}`);
    mkdirSync(folder);
    draw(pdf, folder);
    const pages = readdirSync(folder).sort().map((file) => ppm(join(folder, file)));
    return [viewer, charts.map((chart) => coloured(pages[chart.page], chart))];
  }));
}

let browser;
let made;
before(async () => {
  browser = await launch();
  made = report("printed", "models/quickstart.yaml", "--no-timing", "--duration", "20 s",
    "--set", "engines.mujoco.compensate=false");
});
after(() => browser.close());

describe("on paper every curve is seen in every viewer", () => {
  const hasCurves = (name, pdf, charts) => {
    for (const [viewer, counts] of Object.entries(seenIn(name, pdf))) {
      assert.equal(counts.length, charts, `charts in the PDF, ${viewer}`);
      // A curve crosses the area: at least half as many dots as it is wide.
      assert.ok(Math.min(...counts) > 80 * dots, `${viewer} shows ${counts} coloured dots in the charts`);
    }
  };
  const chartCount = (page) => page.evaluate(() => document.querySelectorAll(".chart").length);

  test("printed by a program that drives the browser, from a dark screen", async () => {
    const { page, complaints } = await open(browser, made.file, { colorScheme: "dark" });
    const pdf = join(scratch, "driven.pdf");
    await page.pdf({ path: pdf, printBackground: true, timeout: 0 });
    hasCurves("driven", pdf, await chartCount(page));
    assert.equal(await page.evaluate(() => document.querySelectorAll("img").length), 0, "the images are gone again");
    assert.deepEqual(complaints, []);
    await page.context().close();
  });

  test("printed by the browser itself", async () => {
    const pdf = join(scratch, "itself.pdf");
    tool(chromiumPath, "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
      "--disable-component-update", "--disable-sync", `--user-data-dir=${join(scratch, "profile")}`, `--print-to-pdf=${pdf}`, pathToFileURL(made.file).href);
    const { page } = await open(browser, made.file);
    hasCurves("itself", pdf, await chartCount(page));
    await page.context().close();
  });
});

test("a browser that only changes the medium gets its images too, once, and loses them again", async () => {
  const { page, complaints } = await open(browser, made.file);
  const images = () => page.evaluate(() => document.querySelectorAll("img.on-paper").length);
  await page.emulateMedia({ media: "print" });
  await page.waitForSelector("img.on-paper", { state: "attached", timeout: 0 });
  await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  const charts = await page.evaluate(() => document.querySelectorAll(".chart").length);
  const stages = await page.evaluate(() => document.querySelectorAll(".stage").length);
  assert.equal(await images(), charts + stages);
  await page.emulateMedia({ media: "screen" });
  await page.waitForSelector("img.on-paper", { state: "detached", timeout: 0 });
  assert.equal(await page.evaluate(() => document.documentElement.className), "");
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("a study's first sheet has more than its title, and its widest table fits", async () => {
  const { page } = await open(browser, altered(made, "printed-study", (shown) => makeStudy(shown)));
  const pdf = join(scratch, "study.pdf");
  await page.pdf({ path: pdf, printBackground: true, timeout: 0 });
  const pages = wordsOf(pdf);
  const texts = pages[0].words.map((word) => word.text).join(" ");
  assert.match(texts, /Convergence.* order 4\.00/);
  assert.ok(Math.max(...pages[0].words.map((word) => word.yMax)) > 0.6 * pages[0].height);
  for (const { words, width } of pages) assert.ok(Math.max(...words.map((word) => word.xMax)) < width);
  await page.context().close();
});
