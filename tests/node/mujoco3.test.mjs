// Claims about the MJCF in today's MuJoCo: it loads there, and the accelerations are those of the
// MuJoCo 2.2 that our engine is, to 1e-10 of the largest.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import load from "@mujoco/mujoco";
import { root, run } from "./support.mjs";

const mujoco = await load();
const folder = join(root, "tests/golden/expected");

for (const file of readdirSync(folder).filter((name) => name.endsWith(".xml")))
  test(`${file} moves in MuJoCo ${mujoco.mj_versionString()} as it does in 2.2`, () => {
    const model = mujoco.MjModel.from_xml_string(readFileSync(join(folder, file), "utf8"));
    const data = new mujoco.MjData(model);
    for (const state of JSON.parse(run("mjcf_accelerations", join(folder, file)))) {
      assert.equal(model.nq, state.qpos.length);
      for (const key of ["qpos", "qvel", "ctrl"]) data[key].set(state[key]);
      mujoco.mj_forward(model, data);
      const scale = Math.max(...state.qacc.map(Math.abs));
      state.qacc.forEach((expected, i) =>
        assert.ok(Math.abs(data.qacc[i] - expected) <= 1e-10 * scale, `qacc[${i}]: ${data.qacc[i]}, 2.2 says ${expected}`));
    }
    data.delete();
    model.delete();
  });
