// Claims about report.html in a real browser: it opens from a disk without network and without a
// complaint, shows the numbers of report.json, and its charts and its replay move.
import assert from "node:assert/strict";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { createHash } from "node:crypto";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { faultsOf, launch, open, report, run, scratch, seeAll, seen, shoot } from "./support.mjs";

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

/** The exact numbers of a table's rows, by the rows' names. */
const numbersOf = (page, label) => page.evaluate((name) => Object.fromEntries(
  [...document.querySelectorAll(`table[aria-label="${name}"] tbody tr`)].map((row) =>
    [row.querySelector("th").textContent, [...row.querySelectorAll("td[data-value]")].map((cell) => Number(cell.dataset.value))])), label);

/** A picture's fingerprint. */
const canvasBytes = async (page, selector) =>
  createHash("sha256").update(await page.evaluate((s) => document.querySelector(s).toDataURL(), selector)).digest("hex");

describe("the quickstart's report", () => {
  let made;
  let shown;
  before(async () => {
    made = report("quickstart", "models/quickstart.yaml", "--trials", "3");
    shown = await open(browser, made.file);
    await seeAll(shown.page);
  });
  after(() => shown.page.context().close());

  test("opens without a complaint, without network, under 4 MB", async () => {
    assert.deepEqual(shown.complaints, []);
    assert.deepEqual(shown.others(), []);
    assert.ok(statSync(made.file).size < 4e6);
    await shoot(shown.page, "quickstart");
  });

  test("says the verdict first", async () => {
    assert.equal(await shown.page.textContent("#verdict"), "The engines agree");
    assert.equal(made.json.verdict, "agree");
    assert.ok(await shown.page.evaluate(() => document.querySelector("#verdict").getBoundingClientRect().bottom < innerHeight));
  });

  test("has the numbers of report.json in its tables", async () => {
    const [member] = made.json.members;
    const agreement = Object.values(await numbersOf(shown.page, "Agreement of the engines"));
    assert.deepEqual(agreement, Object.values(member.agreement).map((m) => [m.max, m.at_s, m.tolerance].filter((v) => v !== null)));
    const books = Object.values(await numbersOf(shown.page, "Conservation"));
    for (const [row, key] of [[0, "energy_relative"], [1, "momentum_relative"], [2, "angular_momentum_relative"]])
      assert.deepEqual(books[row].slice(0, 2), [member.engines.bsm.conservation[key], member.engines.mujoco.conservation[key]]);
    const cost = await numbersOf(shown.page, "Cost");
    for (const [label, key] of [["BSM", "bsm"], ["MuJoCo", "mujoco"]])
      assert.deepEqual(cost[label], [member.timing[key].us_per_step, member.timing[key].median_s, member.engines[key].steps, member.engines[key].evaluations]);
  });

  test("draws every chart", async () => {
    const drawn = await shown.page.evaluate(() => [...document.querySelectorAll(".chart")].map((c) => c.querySelectorAll("canvas").length));
    assert.ok(drawn.length >= 16);
    assert.ok(drawn.every((n) => n > 0), `canvases: ${drawn}`);
  });

  test("zooms all charts when one is dragged across, and back", async () => {
    const { page } = shown;
    const other = ".history:nth-of-type(3) .chart canvas";
    const ticks = () => page.evaluate(() => [...document.querySelectorAll(".history:nth-of-type(3) .dygraph-axis-label-x")].map((l) => l.textContent));
    const all = await ticks();
    const first = page.locator(".chart").first();
    await first.scrollIntoViewIfNeeded();
    const before = await canvasBytes(page, other);
    const box = await first.boundingBox();
    await page.mouse.move(box.x + box.width * 0.4, box.y + 60);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.7, box.y + 62, { steps: 6 });
    await page.mouse.up();
    assert.match(await page.textContent(".tools output:has-text(' s to ')"), /^\d+\.\d* s to \d+\.\d* s$/);
    assert.notEqual(await canvasBytes(page, other), before);
    assert.notDeepEqual(await ticks(), all);
    await page.click("#reset-zoom");
    assert.deepEqual(await ticks(), all);
  });

  test("tells the values under the cursor, in every chart at once, by keyboard alone", async () => {
    const { page } = shown;
    const csv = readFileSync(join(made.folder, "bsm.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
    await page.locator(".chart").first().focus();
    await page.keyboard.press("Home");
    await page.keyboard.press("End");
    const readouts = await page.evaluate(() => [...document.querySelectorAll(".readout")].map((r) => r.querySelector("thead th").textContent));
    assert.deepEqual([...new Set(readouts)], ["t = 120 s"]);
    const w = await page.evaluate(() => document.querySelector(".readout tbody td").textContent);
    const column = csv[0].indexOf("q_BN.w [1]");
    assert.ok(Math.abs(Number(w.replace("−", "-")) - Number(csv.at(-1)[column])) < 1e-8);
    await page.keyboard.press("+");
    assert.equal(await page.isDisabled("#reset-zoom"), false);
    await page.keyboard.press("0");
    assert.equal(await page.isDisabled("#reset-zoom"), true);
  });

  test("has the numbers of a figure in a table", async () => {
    const { page } = shown;
    await page.locator(".history summary").first().click();
    await page.waitForSelector(".history .table-scroll");
    const cells = await page.evaluate(() => [...document.querySelectorAll(".history .table-scroll tbody tr")].slice(0, 1).map((r) => [...r.cells].map((c) => Number(c.textContent)))[0]);
    const csv = readFileSync(join(made.folder, "bsm.csv"), "utf8").split("\n").map((line) => line.split(","));
    assert.equal(cells[0], 0);
    assert.equal(cells[5], Number(csv[1][csv[0].indexOf("q_BN.w [1]")]));
  });

  test("plays the replay", async () => {
    const { page } = shown;
    await page.locator(".stage").scrollIntoViewIfNeeded();
    await page.waitForSelector(".stage canvas");
    const before = await canvasBytes(page, ".stage canvas");
    // The page's time passes when the test says so: 5 s of the run in a second, less a frame.
    await page.clock.install({ time: "2030-01-01" });
    await page.clock.pauseAt("2030-01-02");
    await page.click("#play");
    await page.clock.runFor(700);
    await page.click("#play");
    const time = parseFloat(await page.textContent("#replay-time"));
    assert.ok(time > 3.3 && time < 3.6, `${time} s`);
    await page.clock.resume();
    const later = await canvasBytes(page, ".stage canvas");
    assert.notEqual(later, before);
    await page.evaluate(() => { const s = document.querySelector("#scrub"); s.value = 60; s.dispatchEvent(new Event("input")); });
    assert.equal(await page.textContent("#replay-time"), "60.00 s");
    assert.notEqual(await canvasBytes(page, ".stage canvas"), later);
  });

  test("shows by how much it exaggerates", async () => {
    const { page } = shown;
    assert.equal(await page.textContent(".factor"), "");
    const before = await canvasBytes(page, ".stage canvas");
    await page.evaluate(() => { const s = document.querySelector("#factor"); s.value = 1; s.dispatchEvent(new Event("input")); });
    assert.equal(await page.textContent(".factor"), "deflections × 10");
    assert.notEqual(await canvasBytes(page, ".stage canvas"), before);
  });

  test("shows either engine, both beside one another, and other frames", async () => {
    const { page } = shown;
    const seen = new Set();
    for (const [label, value] of [["Show", "bsm"], ["Show", "sides"], ["View", "hub"], ["View", "path"]]) {
      await page.getByLabel(label, { exact: true }).selectOption(value);
      seen.add(await canvasBytes(page, ".stage canvas"));
    }
    assert.equal(seen.size, 4);
    assert.deepEqual(shown.complaints, []);
  });

  test("saves the MJCF as sccompile writes it", async () => {
    const { page } = shown;
    await page.getByText("The MJCF that MuJoCo loaded").click();
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Download wheels_and_panels.xml" }).click()]);
    assert.equal(readFileSync(await download.path(), "utf8"), run("sccompile", "models/quickstart.yaml", "--emit", "mjcf", "-o", "-"));
  });

  test("has no serious fault of accessibility, light or dark", async () => {
    assert.deepEqual(await faultsOf(shown.page), []);
    await shown.page.emulateMedia({ colorScheme: "dark" });
    await seen(shown.page); // a frame later the charts have the other colours
    await shoot(shown.page, "quickstart-dark");
    assert.deepEqual(await faultsOf(shown.page), []);
  });

  test("fits a narrow screen", async () => {
    const narrow = await open(browser, made.file, { viewport: { width: 400, height: 800 } });
    await seeAll(narrow.page);
    assert.ok(await narrow.page.evaluate(() => document.documentElement.scrollWidth) <= 400);
    await narrow.page.context().close();
  });

  test("prints every chart, in light, as wide as a sheet, and goes back", async () => {
    const fresh = await open(browser, made.file, { colorScheme: "dark" });
    const sizes = () => fresh.page.evaluate(() => ({ theme: getComputedStyle(document.documentElement).colorScheme,
      charts: [...document.querySelectorAll(".chart")].map((c) => (c.querySelector("img.on-paper") ?? c.querySelector("canvas"))?.getBoundingClientRect().right ?? Infinity) }));
    await fresh.page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
    const sheet = await sizes();
    assert.equal(sheet.theme, "light");
    assert.ok(sheet.charts.length >= 16 && Math.max(...sheet.charts) < 44 * 16 + 1, String(sheet.charts));
    if (process.env.SHOTS) writeFileSync(join(process.env.SHOTS, "quickstart.pdf"), await fresh.page.pdf({ printBackground: true }));
    await fresh.page.evaluate(() => window.dispatchEvent(new Event("afterprint")));
    const screen = await sizes();
    assert.equal(screen.theme, "dark");
    assert.ok(Math.max(...screen.charts) > 44 * 16 + 1);
    await fresh.page.context().close();
  });
});

test("a hostile description is text", async () => {
  const spec = join(scratch, "hostile.yaml");
  const hostile = `</script><script>alert(1)</script><img src=x onerror=alert(2)> & "quotes" --><!--`;
  writeFileSync(spec, `format: spacecraft/1\nname: hostile\ndescription: ${JSON.stringify(hostile)}
hub: {mass: 600 kg, inertia: [400, 380, 360]}
simulation: {integrator: rk4, step: 0.1 s, duration: 1 s}\n`);
  const { page, complaints, others } = await open(browser, report("hostile", spec, "--no-timing").file);
  await seeAll(page);
  assert.equal(await page.textContent(".lede"), hostile);
  assert.equal(await page.evaluate(() => document.querySelectorAll("img").length), 0);
  await page.getByText("The spec with every default filled in").click();
  assert.match(await page.textContent("#sources pre"), /alert\(1\)/);
  assert.deepEqual(complaints, []);
  assert.deepEqual(others(), []);
  await page.context().close();
});

test("a policy stops what is not ours", async () => {
  const { page, complaints } = await open(browser, join(scratch, "hostile/report.html"));
  await page.evaluate(() => { const s = document.createElement("script"); s.textContent = "window.intruder = true"; document.body.append(s); });
  assert.equal(await page.evaluate(() => window.intruder), undefined);
  assert.match(complaints.join(), /Content Security Policy/);
  await page.context().close();
});

test("a long run is thinned, says so, and keeps its extremes", async () => {
  const made = report("long", "models/quickstart.yaml", "--no-timing", "--duration", "4000 s", "--set", "simulation.record=0.02 s");
  assert.ok(statSync(made.file).size < 10e6);
  const { page, complaints } = await open(browser, made.file);
  await page.waitForSelector("#time-histories");
  const told = (await page.textContent("#time-histories .note")).match(/Of 200,001 samples each curve shows at most ([\d,]+)/);
  const data = await page.evaluate(() => JSON.parse(document.getElementById("data").textContent));
  const figure = data.histories.figures.find((f) => f.difference?.metric === "attitude_deg");
  const values = new Float64Array(Uint8Array.from(Buffer.from(figure.difference.series[0].values, "base64")).buffer);
  assert.ok(values.length <= Number(told[1].replace(",", "")), `${values.length} points`);
  assert.equal(Math.max(...values), made.json.members[0].agreement.attitude_deg.max);
  assert.deepEqual(complaints, []);
  await page.context().close();
});

test("the first lines say why the verdict is what it is", async () => {
  for (const [name, verdict, detail, ...args] of [
    ["exceeded", "The engines disagree", /^Furthest beyond its limit: attitude, at most .* with 1\.0 × 10⁻¹⁵ deg allowed\.$/, "--set", "agreement.attitude=1e-15 deg"],
    ["alone", "Not judged", /^MuJoCo: not asked for\.$/, "--engine", "bsm"],
  ]) {
    const { page, complaints } = await open(browser, report(name, "models/quickstart.yaml", "--no-timing", "--duration", "20 s", ...args).file);
    await seeAll(page);
    assert.equal(await page.textContent("#verdict"), verdict);
    assert.match(await page.textContent("#verdict-detail"), detail);
    assert.deepEqual(complaints, []);
    await page.context().close();
  }
});

test("an attribution says what carries the difference, and how it goes away", async () => {
  const made = report("why", "attribute", "models/paper/rw_panels.yaml", "--set", "engines.mujoco.compensate=false");
  const { page, complaints } = await open(browser, made.file);
  await seeAll(page);
  const { attribution, explanation } = made.json;
  assert.equal((await page.textContent("#why-they-differ p")).toLowerCase(), `${explanation.conclusion}.`.toLowerCase());
  const carried = await numbersOf(page, "What carries the difference");
  const left = Object.values(await numbersOf(page, "Causes removed one after another"));
  assert.ok(attribution.length > 0);
  for (const cause of attribution) assert.deepEqual(carried[cause.name], [cause.share, cause.maximum_without]);
  assert.deepEqual(left, [[explanation.maximum], ...attribution.map((cause) => [cause.maximum_left])]);
  assert.deepEqual(await faultsOf(page), []);
  assert.deepEqual(complaints, []);
  await shoot(page, "attribution");
  await page.context().close();
});

/** How much of the replay's picture is about as orange as a plume. */
const plumePixels = (page) => page.evaluate(() => {
  const stage = document.querySelector(".stage canvas");
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [stage.width, stage.height];
  const context = copy.getContext("2d");
  context.drawImage(stage, 0, 0);
  const { data } = context.getImageData(0, 0, copy.width, copy.height);
  let count = 0;
  for (let i = 0; i < data.length; i += 4) if (data[i] > data[i + 2] + 90 && data[i + 3] > 60) count += 1;
  return count;
});

test("a thruster has a plume while it burns", async () => {
  const made = report("burn", "models/paper/variable_mass.yaml", "--no-timing", "--duration", "10 s", "--set", "thrusters.main_engine.during=[[0 s, 5 s]]");
  const { page, complaints } = await open(browser, made.file);
  await page.locator(".stage").scrollIntoViewIfNeeded();
  await page.waitForSelector(".stage canvas");
  await page.getByLabel("Show", { exact: true }).selectOption("bsm");
  const at = async (time) => {
    await page.evaluate((t) => { const s = document.querySelector("#scrub"); s.value = t; s.dispatchEvent(new Event("input")); }, time);
    return plumePixels(page);
  };
  const burning = await at(4), coasting = await at(6);
  assert.ok(burning > coasting + 1000, `${burning} orange dots while it burns, ${coasting} after`);
  await shoot(page, "burn");
  assert.deepEqual(complaints, []);
  await page.context().close();
});

/** What the figures of a study's section say of orders, and what its tables hold. */
async function trendsOf(page, id) {
  for (const summary of await page.locator(`#${id} summary`).all()) await summary.click();
  await page.waitForFunction((section) => [...document.querySelectorAll(`#${section} details`)].every((d) => d.children.length > 1), id);
  return page.evaluate((section) => ({
    legends: [...document.querySelectorAll(`#${section} .legend li`)].map((li) => li.textContent),
    marks: document.querySelectorAll(`#${section} figure > svg title`).length,
    rows: [...document.querySelectorAll(`#${section} table`)].map((t) => [...t.querySelectorAll("tbody tr")].map((r) =>
      [...r.querySelectorAll("td[data-value]")].map((c) => Number(c.dataset.value)))),
  }), id);
}

const median = (list) => { const s = [...list].sort((a, b) => a - b); return s.length % 2 ? s[s.length >> 1] : (s[s.length / 2 - 1] + s[s.length / 2]) / 2; };

/** Tables hold the report's x, y and exponents, legends the medians of those between members that
 *  count; figures are grouped, so their order is their own. */
function holdsTrends(shown, json, trends, [x, y, exponents]) {
  const counts = (member) => !["unresolved", "failed", "interrupted"].includes(json.members[member].verdict);
  const fitted = (t) => t[exponents].filter((e, i) => e !== null && counts(t.members[i]) && counts(t.members[i + 1]));
  const sorted = (list) => list.map((item) => JSON.stringify(item)).sort();
  assert.deepEqual(sorted(shown.rows), sorted(trends.map((t) =>
    t[x].map((value, i) => [value, t[y][i], ...(i > 0 && t[exponents][i - 1] !== null ? [t[exponents][i - 1]] : [])]))));
  const expected = trends.map(fitted).filter((e) => e.length > 0).map((e) => median(e).toFixed(2));
  assert.deepEqual(sorted(shown.legends.map((l) => l.match(/[-\d.]+$/)?.[0]).filter(Boolean)), sorted(expected));
}

describe("studies", () => {
  const study = async (name, spec, ...args) => {
    const made = report(name, `models/paper/studies/${spec}.yaml`, ...args);
    const shown = await open(browser, made.file);
    await seeAll(shown.page);
    await shoot(shown.page, name);
    assert.deepEqual(shown.complaints, []);
    return { ...made, ...shown };
  };

  test("convergence: the orders are those of report.json", async () => {
    const { page, json } = await study("orbit_steps", "orbit_steps", "--trials", "1");
    const shown = await trendsOf(page, "convergence");
    holdsTrends(shown, json, json.studies.convergence, ["steps_s", "errors", "orders"]);
    assert.equal(shown.marks, json.studies.convergence.flatMap((t) => t.errors).filter((e) => e > 0).length);
    assert.deepEqual(await faultsOf(page), []);
    await page.context().close();
  });

  test("scaling and slopes: the exponents are those of report.json", async () => {
    const { page, json } = await study("flex_segments", "flex_segments", "--trials", "1", "--duration", "0.05 s");
    holdsTrends(await trendsOf(page, "scaling"), json, json.studies.scaling, ["degrees_of_freedom", "us_per_step", "exponents"]);
    holdsTrends(await trendsOf(page, "what-the-difference-follows"), json, json.studies.slopes, ["values", "maxima", "slopes"]);
    const named = json.studies.slopes.flatMap((t) => t.slopes.filter((_, i) => t.rounding[i] || t.rounding[i + 1]));
    assert.ok(named.length > 0 && named.every((slope) => slope === null));
    assert.equal(await page.locator("#what-the-difference-follows td", { hasText: /^rounding$/ }).count(), named.length);
    await page.context().close();
  });

  test("work and precision: a mark for every configuration that ended well", async () => {
    const { page, json } = await study("work_precision_rw", "work_precision_rw", "--trials", "1");
    const good = ["bsm", "mujoco"].flatMap((e) => json.studies.work_precision[e].configurations).filter((c) => !c.diverged);
    const shown = await trendsOf(page, "work-and-precision");
    const marks = (key) => good.filter((c) => c[key] > 0).length;
    assert.equal(shown.marks, marks("attitude_deg") + marks("position_m"));
    assert.equal(await page.locator("#members tbody tr").count(), json.members.length);
    assert.deepEqual(await faultsOf(page), []);
    await page.context().close();
  });
});
