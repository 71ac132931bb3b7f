// Claims about what the page says of every verdict, of a run and of a study, with documents made by
// hand: an unresolved run, a failed one and an interrupted one are three things, and none looks held.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { altered, fail, judgeConservation, makeStudy, metric, resolved, unresolved } from "./documents.mjs";
import { launch, open, report, root, shoot } from "./support.mjs";

let browser;
let made;
before(async () => {
  browser = await launch();
  made = report("by-hand", "models/quickstart.yaml", "--no-timing", "--duration", "5 s");
});
after(() => browser.close());

/** The page of the report after a change to its data, and what it complained of. */
async function shown(name, change, options) {
  const opened = await open(browser, altered(made, name, change), options);
  await shoot(opened.page, name);
  return opened;
}

/** Texts of all elements. */
const texts = (page, selector) => page.evaluate((s) => [...document.querySelectorAll(s)].map((e) => e.textContent), selector);

/** Each with the change that leads to it. */
const runs = {
  agree: (member) => { member.resolution = resolved(); },
  disagree: (member) => { member.agreement.attitude_deg = metric(1e-3, 1e-9); },
  unresolved: (member) => { member.resolution = unresolved(); },
  not_judged: (member) => { for (const one of Object.values(member.agreement)) Object.assign(one, { tolerance: null, pass: null }); },
  failed: (member) => fail(member, 1.4),
  interrupted: (member) => { for (const engine of Object.values(member.engines)) Object.assign(engine, { reason: "interrupted at t = 2.5 s", t_end_s: 2.5 }); },
};

const withVerdict = (verdict) => ({ report: whole }) => {
  whole.verdict = verdict;
  whole.complete = verdict !== "interrupted";
  whole.members[0].verdict = verdict;
  runs[verdict](whole.members[0]);
};

describe("a run", () => {
  test("has words and a look of its own for every verdict", async () => {
    const looks = new Map();
    for (const verdict of Object.keys(runs)) {
      const { page, complaints } = await shown(`run-${verdict}`, withVerdict(verdict));
      const look = await page.evaluate(() => {
        const line = document.querySelector(".verdict");
        const mark = ["::before", "::after"].map((part) => getComputedStyle(line.querySelector(".verdict-mark"), part));
        return { key: line.dataset.verdict, look: [getComputedStyle(line).color, ...mark.flatMap((m) => [m.borderStyle, m.width, m.height, m.transform, m.left])].join() };
      });
      assert.equal(look.key, verdict);
      looks.set(look.look, verdict);
      if (["unresolved", "not_judged", "failed", "interrupted"].includes(verdict)) {
        assert.deepEqual(await texts(page, ".pass, td.fail"), [], `${verdict}: nothing is held or exceeded`);
        assert.doesNotMatch(await page.textContent("#verdict"), /agree/);
      }
      assert.deepEqual(complaints, []);
      await page.context().close();
    }
    assert.equal(looks.size, Object.keys(runs).length, [...looks.values()].join());
  });

  test("that is unresolved says what is lost, and which step would do", async () => {
    const { page } = await shown("resolution", withVerdict("unresolved"));
    const { reasons: [reason] } = unresolved();
    assert.match(await page.textContent("#verdict-detail"), /w\.1 swings at 26\.6 rad\/s.*says nothing\.$/);
    assert.deepEqual(await texts(page, "#resolution .reasons li"), [reason]);
    const facts = Object.fromEntries((await texts(page, "#resolution dt")).map((key, i) => [key, i]));
    const values = await texts(page, "#resolution dd");
    assert.match(values[facts["fastest motion"]], /^w\.1: 26\.64 rad\/s, a period of 236 ms, undamped$/);
    assert.match(values[facts["largest loss"]], /^w\.1: 33 % of its motion$/);
    assert.equal(values[facts["largest stable step"]], "106 ms");
    assert.equal(values[facts["advised step"]], "5 ms");
    assert.deepEqual(await texts(page, "#resolution .note"), ["the orbit is not looked at."]);
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll("#resolution td")].map((c) => Number(c.dataset.value))), [1.5, 1.5, 1, 1.5, 1.49, 0.993]);
    assert.deepEqual([...new Set(await texts(page, "#agreement td.unjudged"))].sort(), ["not judged", "unresolved"]);
    await page.context().close();
  });

  test("that failed or was interrupted says until when it was compared", async () => {
    for (const [verdict, said, cell] of [["failed", /stopped at t = 1\.40 s/, "stopped"], ["interrupted", /interrupted at t = 2\.50 s/, "so far"]]) {
      const { page } = await shown(`until-${verdict}`, withVerdict(verdict));
      assert.match((await texts(page, "#agreement .note")).join(), said);
      assert.ok((await texts(page, "#agreement td.unjudged")).includes(cell));
      await page.context().close();
    }
  });

  test("that was interrupted after a tolerance was exceeded says so", async () => {
    const { page } = await shown("interrupted-exceeded", (data) => {
      withVerdict("interrupted")(data);
      data.report.members[0].agreement.attitude_deg = metric(1e-3, 1e-9);
    });
    assert.deepEqual(await texts(page, "#agreement td.fail"), ["EXCEEDED"]);
    await page.context().close();
  });

  test("is judged by its balances and references where these have tolerances", async () => {
    const tolerances = { energy_relative: 1, momentum_relative: null, angular_momentum_relative: 1e-30 };
    const { page } = await shown("judged", ({ report: whole }) => {
      const [member] = whole.members;
      judgeConservation(member, tolerances);
      member.references = { torque_free: { bsm: { attitude_deg: metric(1e-10, 1e-9) }, mujoco: { attitude_deg: metric(1e-8, 1e-9) } } };
      member.verdict = whole.verdict = "disagree";
    });
    const [member] = made.json.members;
    assert.deepEqual(await texts(page, "#conservation td:nth-of-type(1)"), ["ok", "not judged", "EXCEEDED"]);
    assert.deepEqual(await texts(page, "#references td:nth-of-type(2)"), ["ok", "EXCEEDED"]);
    const numbers = await page.evaluate(() => [...document.querySelectorAll("#conservation tbody tr")].map((row) => [...row.querySelectorAll("td[data-value]")].map((c) => Number(c.dataset.value))));
    assert.deepEqual(numbers, Object.entries(tolerances).map(([key, tolerance]) =>
      [member.engines.bsm.conservation[key], member.engines.mujoco.conservation[key], ...(tolerance === null ? [] : [tolerance])]));
    assert.match(await page.textContent("#verdict-detail"), /^Furthest beyond its limit: angular momentum, at most \S+ × \S+, with 1\.0 × 10⁻³⁰ allowed\.$/);
    await page.context().close();
  });

  test("of an older report, without the newer fields, is shown as far as it tells", async () => {
    const { page, complaints } = await shown("older", ({ report: whole }) => {
      const [member] = whole.members;
      fail(member, 1.4);
      for (const key of ["verdict", "resolution", "conservation"]) delete member[key];
      whole.verdict = "not_judged";
    });
    assert.equal(await page.textContent("#verdict"), "The run failed");
    assert.equal(await page.locator("#resolution").count(), 0);
    assert.equal(await page.locator("#conservation td").count(), 6);
    assert.deepEqual(complaints, []);
    await page.context().close();
  });

  test("of ten years is told in years", async () => {
    const { page } = await shown("ten-years", ({ report: whole }) => {
      Object.assign(whole.members[0].agreement.attitude_deg, { at_s: 315569259.75 });
      Object.assign(whole.members[0].agreement.rate_rad_s, { at_s: 864000 });
    });
    assert.deepEqual((await texts(page, "#agreement tbody tr td:nth-of-type(3)")).slice(0, 2), ["10.000 years", "10.000 days"]);
    await page.context().close();
  });

  test("keeps its verdicts in sight on a narrow screen", async () => {
    const { page } = await shown("narrow", withVerdict("disagree"), { viewport: { width: 400, height: 800 } });
    const rights = await page.evaluate(() => [...document.querySelectorAll("#agreement tbody tr td:nth-of-type(1)")].map((c) => c.getBoundingClientRect().right));
    assert.ok(rights.length > 0 && Math.max(...rights) <= 400, String(rights));
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 400);
    await page.context().close();
  });
});

describe("a study", () => {
  const integrators = { rk4: 4, rk2: 2, euler: 1 };
  const study = (data) => {
    makeStudy(data, integrators);
    fail(data.report.members[3], 1.4);
    data.report.verdict = "agree";
  };

  test("marks what failed or is unresolved, and leaves it out of its fits", async () => {
    const { page, complaints } = await shown("study", study);
    assert.match(await page.textContent("#verdict-detail"), /1 member failed and 2 members are unresolved: they are marked and left out of every fit\.$/);
    assert.deepEqual(await texts(page, "#members td.unresolved"), ["unresolved", "unresolved"]);
    assert.deepEqual(await texts(page, "#members td.fail"), ["BSM, MuJoCo failed"]);
    assert.equal(await page.locator("#convergence figure > svg .out").count(), 2 * Object.keys(integrators).length);
    const orders = (await texts(page, "#convergence .legend li")).map((text) => text.match(/^(?:BSM|MuJoCo), (\w+), order ([\d.]+)$/)).filter(Boolean);
    assert.deepEqual(orders.map(([, name, order]) => [name, Number(order)]), Object.entries(integrators).flatMap(([name, order]) => [[name, order], [name, order]]));
    assert.deepEqual(complaints, []);
    await page.context().close();
  });

  test("knows of members that are only in report.json", async () => {
    const { page } = await shown("many", (data) => {
      study(data);
      data.report.members.splice(3);
      data.left_out = { 3: "failed", 7: "unresolved", 11: "unresolved" };
    });
    assert.match(await page.textContent("#verdict-detail"), /1 member failed and 2 members are unresolved/);
    assert.equal(await page.locator("#convergence figure > svg .out").count(), 2 * Object.keys(integrators).length);
    await page.context().close();
  });

  test("counts its members from 0, as their folders are", async () => {
    const { page } = await shown("counted", study);
    assert.deepEqual(await texts(page, "#members tbody th"), Array.from({ length: 12 }, (_, i) => String(i)));
    assert.deepEqual((await texts(page, "#members tbody td:nth-of-type(1)")).slice(0, 3), [".", "0001", "0002"]);
    assert.match((await texts(page, "#convergence figure > svg title")).join(), /member 7, unresolved/);
    await page.context().close();
  });

  test("scrolls a wide table inside its box", async () => {
    const { page } = await shown("wide", (data) => {
      study(data);
      for (const member of data.report.members)
        for (let i = 0; i < 12; i += 1) member.settings[`wheels.rw_${i}.spin_inertia`] = "0.08 kg m2";
    });
    const box = await page.evaluate(() => { const b = document.querySelector("#members .scroll"); return { inner: b.scrollWidth, outer: b.clientWidth, right: b.getBoundingClientRect().right, page: document.documentElement.scrollWidth, window: innerWidth }; });
    assert.ok(box.inner > box.outer && box.right <= box.window && box.page <= box.window, JSON.stringify(box));
    await page.context().close();
  });

  test("gives an integrator one colour in all its figures, and none of an engine's", async () => {
    const { page } = await shown("colours", (data) => {
      study(data);
      // The same integrators in another figure, in another order, and one more.
      const { convergence } = data.report.studies;
      convergence.push(...convergence.toReversed().map((trend) => ({ ...trend, metric: "rate_rad_s" })));
      data.report.studies.scaling = ["bsm", "mujoco"].map((engine) => ({ engine, set: "x", degrees_of_freedom: [1, 2], us_per_step: [1, 2], exponents: [1] }));
    });
    const entries = await page.evaluate(() => [...document.querySelectorAll("#convergence .legend li, #scaling .legend li")].map((li) =>
      [li.textContent, getComputedStyle(li.querySelector("circle, rect") || li).stroke]));
    const colours = new Map();
    for (const [text, stroke] of entries) {
      const name = text.match(/^(?:BSM|MuJoCo), (\w+), order/)?.[1] ?? text.match(/^(BSM|MuJoCo), exponent/)?.[1];
      if (name) colours.set(name, (colours.get(name) ?? new Set()).add(stroke));
    }
    assert.equal(colours.size, 5);
    for (const [name, strokes] of colours) assert.equal(strokes.size, 1, `${name}: ${[...strokes]}`);
    assert.equal(new Set([...colours.values()].flatMap((s) => [...s])).size, 5);
    await page.context().close();
  });

  test("names the integrators of work and precision", async () => {
    const { page, complaints } = await shown("work", (data) => {
      study(data);
      const point = (integrator, i) => ({ member: i, settings: { "simulation.integrator": integrator, "simulation.step": `${i + 1} s` }, diverged: false, attitude_deg: 10 ** -i, position_m: 10 ** -i, evaluations: 1000 * (i + 1), frontier: true });
      const engine = { floor: { attitude_deg: 1e-9, position_m: 1e-9 }, configurations: [point("rk4", 0), point("rk4", 1), point("euler", 2)] };
      data.report.studies = { work_precision: { bsm: engine, mujoco: engine } };
      data.is_work_precision = true;
    });
    assert.deepEqual((await texts(page, "#work-and-precision figure:first-of-type .legend li")), ["BSM, rk4", "BSM, euler", "MuJoCo, rk4", "MuJoCo, euler"]);
    assert.deepEqual(complaints, []);
    await page.context().close();
  });

  test("tells the laws of paths that step together apart, and a count from a quantity", async () => {
    const schema = JSON.parse(readFileSync(join(root, "schemas/spacecraft.schema.json"), "utf8"));
    const integers = new Set();
    const walk = (node, key) => {
      if (node === null || typeof node !== "object" || key === "campaign") return; // no study sweeps a campaign
      if (node.type === "integer") integers.add(key);
      for (const [name, child] of Object.entries(node)) walk(child, ["items", "anyOf", "oneOf"].includes(name) || Array.isArray(node) ? key : name);
    };
    walk(schema, "");
    assert.ok(integers.has("segments"));
    const paths = ["hub.mass", "wheels.rw_x.mass", ...[...integers].map((key) => `panels.wing_p.${key}`)];
    const { page } = await shown("zip", (data) => {
      study(data);
      data.report.members.forEach((member, i) => { member.settings = Object.fromEntries(paths.map((path) => [path, i + 1])); });
      data.report.studies = { convergence: [], scaling: [], slopes: paths.map((set) => ({ metric: "attitude_deg", set, values: [1, 2], maxima: [1, 2], slopes: [1] })) };
    });
    assert.deepEqual(await texts(page, "#what-the-difference-follows figcaption"), paths.map((path) => `attitude over ${path}`));
    assert.match((await texts(page, "#what-the-difference-follows .note")).join(), /step together/);
    const axes = (await texts(page, "#what-the-difference-follows svg text")).filter((text) => paths.some((path) => text.startsWith(path)));
    assert.deepEqual(axes, paths.map((path) => (integers.has(path.split(".").pop()) ? path : `${path} [SI]`)));
    await page.context().close();
  });
});

test("the last tick of every axis is inside its figure", async () => {
  const { page } = await shown("ticks", (data) => makeStudy(data));
  const outside = await page.evaluate(() => [...document.querySelectorAll("#convergence figure")].flatMap((figure) => {
    const box = figure.getBoundingClientRect();
    return [...figure.querySelectorAll("svg text")].filter((text) => { const t = text.getBoundingClientRect(); return t.right > box.right + 0.5 || t.left < box.left - 0.5; }).map((t) => t.textContent);
  }));
  assert.deepEqual(outside, []);
  const chart = page.locator(".chart").first();
  await chart.scrollIntoViewIfNeeded();
  await chart.locator("canvas").first().waitFor({ state: "attached", timeout: 0 });
  assert.equal(await chart.evaluate((node) => getComputedStyle(node.firstElementChild).overflow), "clip");
  await page.context().close();
});

test("the vehicle fills the replay from edge to edge, one way or the other", async () => {
  const { page } = await shown("filled", () => {});
  await page.locator(".stage").scrollIntoViewIfNeeded();
  await page.waitForSelector(".stage canvas", { timeout: 0 });
  for (const [show, view] of [["both", "inertial"], ["bsm", "hub"]]) {
    await page.getByLabel("Show", { exact: true }).selectOption(show);
    await page.getByLabel("View", { exact: true }).selectOption(view);
    const filled = await page.evaluate(() => {
      const stage = document.querySelector(".stage canvas"), copy = document.createElement("canvas");
      const { width, height } = Object.assign(copy, { width: stage.width, height: stage.height });
      const context = copy.getContext("2d");
      context.drawImage(stage, 0, 0);
      const { data } = context.getImageData(0, 0, width, height);
      const columns = new Set(), rows = new Set();
      for (let i = 3; i < data.length; i += 4)
        if (data[i] > 40) { columns.add(((i - 3) / 4) % width); rows.add(Math.floor((i - 3) / 4 / width)); }
      const across = (Math.max(...columns) - Math.min(...columns)) / width, along = (Math.max(...rows) - Math.min(...rows)) / height;
      return { across, along, edges: [Math.min(...columns), width - 1 - Math.max(...columns)] };
    });
    assert.ok(Math.max(filled.across, filled.along) > 0.75 && Math.min(...filled.edges) > 0, `${show}, ${view}: ${JSON.stringify(filled)}`);
  }
  await page.context().close();
});
