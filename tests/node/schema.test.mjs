// The JSON Schema as an editor uses it: ajv accepts every model, refuses what a schema can see, and
// every key has words to show.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import Ajv from "ajv";
import { parse } from "yaml";
import { root } from "./support.mjs";

const schema = JSON.parse(readFileSync(join(root, "schemas/spacecraft.schema.json"), "utf8"));
const validate = new Ajv({ strict: true, keywords: ["x-unit"], allowUnionTypes: true, strictRequired: false, strictTypes: false }).compile(schema);
const read = (file) => readFileSync(join(root, file), "utf8");

// As in compiler/diag/codes.def: unknown, missing, excluding keys; type; word; length of a list.
const visible = new Set(["SC2001", "SC2002", "SC2003", "SC2005", "SC2009", "SC2011", "SC2012"]);

// What the schema leaves to the compiler, and why.
const forgiven = {
  campaign_keep_by_nothing: "`by` is needed because of `worst`",
  campaign_output_form: "`within` is needed because of `reduce`",
  campaign_output_signal: "a stop needs a bound on either side",
  study_path_unknown: "a path is text to a schema",
  thruster_without_isp: "`isp` is needed because of `tank`",
};

function specs(folder) {
  return readdirSync(join(root, folder), { recursive: true })
    .filter((name) => name.endsWith(".yaml"))
    .map((name) => join(folder, name));
}

test("every model and golden spec is valid", () => {
  const files = [...specs("models"), ...specs("tests/golden")];
  assert.ok(files.length > 30);
  for (const file of files) {
    assert.ok(validate(parse(read(file))), `${file}: ${JSON.stringify(validate.errors?.slice(0, 3))}`);
  }
});

test("what a schema can see in the malformed corpus is refused", () => {
  let seen = 0;
  const accepted = [];
  for (const name of readdirSync(join(root, "tests/malformed"))) {
    if (!name.endsWith(".expected")) continue;
    const base = `tests/malformed/${name.slice(0, -".expected".length)}`;
    const codes = [...read(`tests/malformed/${name}`).matchAll(/^(\S+?):.* error\[(SC\d+)\]/gm)];
    // Faults of an override or of an extended file are not in the text an editor has open.
    if (!codes.some(([, file, code]) => visible.has(code) && base.endsWith(file.replace(".yaml", "")))) continue;
    seen += 1;
    if (validate(parse(read(`${base}.yaml`)))) accepted.push(base.split("/").pop());
  }
  assert.ok(seen > 20, `${seen} cases`);
  assert.deepEqual(accepted.filter((name) => !(name in forgiven)), []);
});

test("every key has a description", () => {
  const silent = [];
  const walk = (part, path) => {
    if (!part || typeof part !== "object") return;
    for (const [key, value] of Object.entries(part.properties ?? {})) {
      if (!value.description) silent.push(`${path}.${key}`);
      walk(value, `${path}.${key}`);
    }
    for (const next of [part.items, ...(part.anyOf ?? []), ...(part.oneOf ?? [])]) walk(next, path);
  };
  walk(schema, "");
  assert.deepEqual(silent, []);
});
