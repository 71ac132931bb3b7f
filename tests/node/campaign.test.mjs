// Claims about the page of a campaign, in a real browser: it shows the numbers of report.json, its
// pictures come without a library, and names stay text.
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { altered } from "./documents.mjs";
import { faultsOf, launch, open, run, scratch, seeAll, shoot } from "./support.mjs";

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

/** A campaign made by hand, as tests/runtime has it. @param {number} members @param {number} missing */
function campaign(name, members, missing) {
  const folder = join(scratch, name);
  run("campaign_page", folder, String(members), String(missing));
  return { file: join(folder, "report.html"), json: JSON.parse(readFileSync(join(folder, "report.json"), "utf8")) };
}

/** Texts of all elements. */
const texts = (page, selector) => page.evaluate((s) => [...document.querySelectorAll(s)].map((e) => e.textContent), selector);

/** Texts of a table's rows, by the rows' names. */
const rowsOf = (page, label) => page.evaluate((name) => Object.fromEntries(
  [...document.querySelectorAll(`table[aria-label="${name}"] tbody tr`)].map((row) =>
    [row.querySelector("th").textContent, [...row.querySelectorAll("td")].map((cell) => cell.textContent)])), label);

describe("a campaign's page", () => {
  let made;
  let shown;
  before(async () => {
    made = campaign("campaign", 1200, 20);
    shown = await open(browser, made.file);
    await seeAll(shown.page);
  });
  after(() => shown.page.context().close());

  test("opens without a complaint, without network, under half a megabyte", async () => {
    assert.deepEqual(shown.complaints, []);
    assert.deepEqual(shown.others(), []);
    assert.ok(statSync(made.file).size < 5e5);
    assert.deepEqual(await texts(shown.page, "main .problem:not(#engines .problem)"), []);
    await shoot(shown.page, "campaign");
  });

  test("says first what failed, what is broken and what is missing", async () => {
    const { page } = shown;
    const [peak] = made.json.campaign.outputs;
    assert.equal(await page.textContent("#verdict"), "2 of 1200 members failed");
    assert.equal(await page.textContent("#verdict-detail"),
      `1 of 1 requirement broken: peak is not below 0.08 rad in ${peak.pass.flown.of - peak.pass.flown.passed} members. ` +
      "2 members could not be flown. 20 members are missing: 1180–1199.");
    assert.equal(await page.textContent("#setting"), "1178 of 1200 members flown · 3 numbers drawn · latin hypercube sampling · seed 7");
  });

  test("has the numbers of report.json in its tables", async () => {
    const { page } = shown;
    const [peak, touch] = made.json.campaign.outputs;
    const rows = await rowsOf(page, "Outputs");
    const four = (value) => String(Number(value.toPrecision(4)));
    assert.equal(rows["peak [rad]"][0], "below 0.08 rad");
    assert.match(rows["peak [rad]"][1], new RegExp(`^${peak.pass.flown.passed} of 1178 \\d\\d\\.?\\d? % \\(\\d\\d\\.?\\d? to \\d\\d\\.?\\d? %\\)$`));
    assert.match(rows["peak [rad]"][2], new RegExp(`^${peak.pass.all.passed} of 1200 `));
    assert.deepEqual(rows["peak [rad]"].slice(3), [four(peak.min), four(peak.median),
      `${four(peak.p95)} ${four(peak.p95_bounds[0])} to ${four(peak.p95_bounds[1])}`, four(peak.max), `< ${four(peak.tolerance_95_95)}`, "1178"]);
    assert.deepEqual(rows["touch [s]"].slice(0, 3), ["–", "–", "–"]);
    assert.equal(rows["touch [s]"].at(-1), String(touch.count));
    assert.deepEqual((await rowsOf(page, "Drawn numbers"))["hub.mass"], ["normal, sigma 2 %, truncate 3", "600", "kg"]);
    assert.deepEqual(await rowsOf(page, "Why members were not flown"), { "`omega_BN_B` is absurd: .. rad/s": ["2", "399"] });
  });

  test("sorts what drives an output, and says why there is no Sobol’ index", async () => {
    const { page } = shown;
    assert.deepEqual(Object.keys(await rowsOf(page, "Drivers of peak")).slice(0, 1), ["hub.mass"]);
    assert.match((await texts(page, ".drivers .note")).join(), /Sobol’ indices are not computed: 2 of 1180 members have no value\./);
  });

  test("draws a distribution per output and three drivers of each", async () => {
    const { page } = shown;
    assert.equal(await page.locator("#distributions figure").count(), 2);
    assert.equal(await page.locator("#drivers figure").count(), 6);
    const steps = await page.evaluate(() => document.querySelector("#distributions .curve").getAttribute("d").match(/H/g).length);
    assert.ok(steps > 300 && steps <= 400, String(steps));
    const broken = made.json.campaign.outputs[0].pass.flown;
    assert.equal(await page.evaluate(() => document.querySelector("#drivers figure").querySelectorAll("svg[role=img] .broken").length), broken.of - broken.passed);
    assert.equal(await page.evaluate(() => document.querySelector("#drivers figure").querySelectorAll("svg[role=img] .absent").length), 2);
  });

  test("names the twins that disagree and what tells them apart, with care", async () => {
    const { twins } = made.json.campaign;
    const said = await shown.page.textContent("#engines");
    assert.match(said, new RegExp(`They disagree in ${twins.disagree} of ${twins.agree + twins.disagree}: `));
    assert.match(said, new RegExp(`in members ${twins.members[0]}, ${twins.members[1]}`));
    assert.match(said, /hub\.mass differs most .* in 100 % of such pairs it is larger in the one that disagrees\. .*That does not make it the cause\./);
  });

  test("names the worst and the kept members with the command that flies each", async () => {
    const { worst } = made.json.campaign;
    const rows = await rowsOf(shown.page, "Worst members");
    const [first] = worst;
    assert.deepEqual(rows[first.member].filter((_, i) => i !== 1), ["peak", "BROKEN", "–", first.command]);
    assert.deepEqual(Object.keys(await rowsOf(shown.page, "Kept members")), ["0", "17"]);
    assert.equal((await rowsOf(shown.page, "Kept members"))[17][0], "0017/");
  });

  test("can be used by everybody, in light and in dark", async () => {
    for (const colorScheme of ["light", "dark"]) {
      const { page } = await open(browser, made.file, { colorScheme });
      await seeAll(page);
      assert.deepEqual(await faultsOf(page), [], colorScheme);
      await shoot(page, `campaign-${colorScheme}`);
      await page.context().close();
    }
  });

  test("fits a narrow screen", async () => {
    const { page } = await open(browser, made.file, { viewport: { width: 390, height: 800 } });
    await seeAll(page);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    await shoot(page, "campaign-narrow");
    await page.context().close();
  });

  test("prints all its pictures, also those that were not near yet", async () => {
    const { page } = await open(browser, made.file);
    await page.pdf({ path: join(scratch, "campaign.pdf"), printBackground: true, timeout: 0 });
    assert.equal(await page.locator("#drivers figure").count(), 6);
    await page.context().close();
  });
});

describe("a campaign's page", () => {
  let made;
  before(() => { made = campaign("campaign-whole", 300, 0); });

  /** @param {string} name @param {(campaign: any, data: any) => void} change */
  const changed = async (name, change) => {
    const opened = await open(browser, altered(made, name, (data) => change(data.report.campaign, data)));
    await seeAll(opened.page);
    return opened;
  };

  test("shows Sobol’ indices where every member has a value", async () => {
    const { page } = await changed("sobol", () => {});
    const [driver] = made.json.campaign.outputs[0].drivers;
    assert.equal((await rowsOf(page, "Drivers of peak"))["hub.mass"][2],
      `${driver.sobol_first.value.toFixed(2)} (${driver.sobol_first.interval.map((v) => v.toFixed(2)).join(" to ")})`);
    await page.context().close();
  });

  test("names the members that are not resolved, and why the first is not", async () => {
    const { page } = await changed("unresolved-campaign", (campaign) => {
      campaign.unresolved = { count: 2, members: [3, 17], reason: "w.1 swings at 26.6 rad/s" };
    });
    const said = await page.textContent("#not-resolved");
    assert.match(said, /does not resolve members 3, 17\./);
    assert.match(said, /Member 3: w\.1 swings at 26\.6 rad\/s\./);
    await page.context().close();
  });

  test("takes names for text, whatever they are", async () => {
    const hostile = "<img src=x onerror=alert(1)></script>\"'";
    const { page, complaints } = await changed("hostile-campaign", (campaign, data) => {
      campaign.outputs.forEach((output, i) => { output.name = hostile + i; output.meaning = hostile; });
      for (const output of campaign.outputs) for (const driver of output.drivers) driver.name = hostile + driver.name;
      for (const drawn of campaign.drawn) drawn.name = hostile + drawn.name;
      data.scatter.drawn = Object.fromEntries(Object.entries(data.scatter.drawn).map(([name, text]) => [hostile + name, text]));
      for (const one of campaign.worst) Object.assign(one, { output: hostile + "0", command: hostile });
      campaign.failures = [{ reason: hostile, count: 1, first: 3 }];
      campaign.unresolved = { count: 1, members: [3], reason: hostile };
      campaign.remarks = [hostile];
    });
    assert.deepEqual(complaints, []);
    assert.equal(await page.locator("main img").count(), 0);
    assert.equal(await page.locator("#drivers figure").count(), 6);
    assert.equal((await texts(page, "#members-to-look-at code"))[0], hostile);
    await page.context().close();
  });

  test("says so where nothing is required, drawn, flown or kept", async () => {
    const { page, complaints } = await changed("bare-campaign", (campaign, data) => {
      Object.assign(campaign, { outputs: [], drawn: [], failures: [], worst: [], kept: [], flown: 0 });
      campaign.twins = { flown: 0, agree: 0, disagree: 0, interval: [0, 1], members: [], driver: null };
      data.distributions = [];
    });
    assert.deepEqual(complaints, []);
    assert.match(await page.textContent("#verdict-detail"), /^The spec requires nothing of the outputs\. 300 members could not be flown\.$/);
    assert.equal(await page.locator("main section").count(), 0);
    await page.context().close();
  });

  test("of outputs that nobody reached has no pictures of them", async () => {
    const empty = campaign("campaign-empty", 5, 5);
    const { page, complaints } = await open(browser, empty.file);
    await seeAll(page);
    assert.deepEqual(complaints, []);
    assert.equal(await page.locator("figure").count(), 0);
    assert.match(await page.textContent("#verdict-detail"), /5 members are missing: 0–4\./);
    await page.context().close();
  });
});
