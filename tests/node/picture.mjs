// The picture in the README: what the quickstart's report shows first, its replay and its first
// chart. Started by `tools/check-page --picture FILE`.
import { mkdirSync, renameSync, statSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { launch, open, report } from "./support.mjs";

/** Sections that the picture has. */
const parts = ["agreement", "replay", "time-histories"];

/** When the panels are out and on their way back [s]. */
const instant = 1.5;

const file = resolve(process.argv[2]);
const browser = await launch();
const { page } = await open(browser, report("picture", "models/quickstart.yaml", "--no-timing").file,
  { viewport: { width: 1200, height: 760 }, colorScheme: "light" });
page.setDefaultTimeout(0);

await page.evaluate((shown) => {
  for (const section of document.querySelectorAll("main > section")) section.hidden = !shown.includes(section.id);
  document.querySelectorAll(".history:not(:first-of-type), #theme").forEach((node) => { node.hidden = true; });
}, parts);
for (const place of [".stage", ".chart"]) {
  await page.locator(place).first().scrollIntoViewIfNeeded();
  await page.locator(`${place} canvas`).first().waitFor({ state: "attached" });
}
await page.evaluate((time) => {
  const scrub = document.querySelector("#scrub");
  scrub.value = time;
  scrub.dispatchEvent(new Event("input"));
  window.scrollTo(0, 0);
}, instant);

const bottom = await page.locator(".history .pair").first().evaluate((node) => node.getBoundingClientRect().bottom + window.scrollY);
mkdirSync(dirname(file), { recursive: true });
await page.screenshot({ path: `${file}.part.png`, fullPage: true, clip: { x: 0, y: 0, width: 1200, height: Math.ceil(bottom) + 24 } });
renameSync(`${file}.part.png`, file);
await browser.close();
console.log(`${file}: ${Math.round(statSync(file).size / 1000)} kB`);
