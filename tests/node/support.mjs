// What the tests share: the programs, the browser, and a report opened in it as a user would.
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

export const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const bin = process.env.TWINCRAFT_BIN || join(root, "build/release/bin");

export const scratch = mkdtempSync(join(tmpdir(), "twincraft-page-"));
process.on("exit", () => rmSync(scratch, { recursive: true, force: true }));

/** Runs one of our programs. @returns {string} its standard output */
export const run = (program, ...args) =>
  execFileSync(join(bin, program), args, { cwd: root, encoding: "utf8", maxBuffer: 1 << 28 });

/** A report made by scsim, with what it says of itself. Exit code 1 is a verdict, no fault. */
export function report(name, spec, ...args) {
  const folder = join(scratch, name);
  try {
    run("scsim", spec, "-o", folder, "--quiet", ...args);
  } catch (error) {
    if (error.status !== 1) throw error;
  }
  return { folder, file: join(folder, "report.html"), json: JSON.parse(readFileSync(join(folder, "report.json"), "utf8")) };
}

/** What takes longer has hung: no claim is about time [ms]. */
const HANG = 600_000;

export const launch = () => chromium.launch({
  timeout: HANG,
  executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});

/** A page without network that keeps what it complained of and what it asked for. */
export async function open(browser, file, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 860 }, offline: true, reducedMotion: "reduce", ...options });
  context.setDefaultTimeout(HANG);
  const page = await context.newPage();
  const complaints = [];
  const requests = [];
  page.on("console", (message) => { if (["error", "warning"].includes(message.type())) complaints.push(message.text()); });
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("dialog", (dialog) => { complaints.push("a dialog: " + dialog.message()); dialog.dismiss(); });
  page.on("request", (request) => requests.push(request.url()));
  const url = pathToFileURL(file).href;
  await page.goto(url);
  return { page, complaints, others: () => requests.filter((r) => r !== url && !r.startsWith("data:") && !r.startsWith("blob:")) };
}

/** Waits until the page has drawn what is near the window: observers are told all at once, in the
 *  order they were made, so the one made here is told last. */
export const seen = (page) => page.evaluate(() => new Promise((told) => {
  new IntersectionObserver((_, observer) => { observer.disconnect(); told(); }).observe(document.body);
}));

/** Scrolls through everything, so that what is drawn when it is near is drawn. */
export async function seeAll(page) {
  const height = await page.evaluate(() => document.body.scrollHeight);
  for (let y = 0; y < height; y += 500) {
    await page.evaluate((to) => window.scrollTo(0, to), y);
    await seen(page);
  }
  await page.evaluate(() => window.scrollTo(0, 0));
}

/** Pictures for people, when asked for with SHOTS=folder. */
export async function shoot(page, name) {
  if (process.env.SHOTS) await page.screenshot({ path: join(process.env.SHOTS, name + ".png"), fullPage: true });
}

const axe = createRequire(import.meta.url).resolve("axe-core/axe.min.js");

/** No dependence on the page's scripts: axe is put in by the test, past the page's policy. */
export async function faultsOf(page) {
  const client = await page.context().newCDPSession(page);
  await client.send("Page.setBypassCSP", { enabled: true });
  const source = readFileSync(axe, "utf8");
  await page.evaluate(source);
  const result = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  return result.violations.filter((v) => ["serious", "critical"].includes(v.impact))
    .map((v) => `${v.id}: ${v.nodes.slice(0, 3).map((n) => n.html.slice(0, 120)).join(" | ")}`);
}
