// The replay as a part of the page: its controls, and what is written in the picture.

const views = {
  inertial: "Vehicle in inertial axes",
  hub: "Vehicle in hub axes",
  orbital: "Vehicle in orbital axes (radial, along, across)",
  path: "Path of the centre of mass",
};

const shows = { both: "Both, overlaid", sides: "Both, side by side", bsm: "BSM", mujoco: "MuJoCo" };

/** @param {string} label @param {Record<string, string>} options @param {string} now
 *  @param {(key: string) => void} chosen */
function choice(label, options, now, chosen) {
  const select = html("select", { "aria-label": label }, ...Object.entries(options).map(([value, text]) => html("option", { value, selected: value === now }, text)));
  select.addEventListener("change", () => chosen(select.value));
  return html("label", {}, label, select);
}

/** @param {string} label @param {Attributes} attributes @param {(value: number) => void} moved */
function slider(label, attributes, moved) {
  const input = html("input", { type: "range", "aria-label": label, ...attributes });
  input.addEventListener("input", () => moved(Number(input.value)));
  return { input, node: html("label", {}, label, input) };
}

/** @param {Player} player */
function transport(player) {
  const play = html("button", { type: "button", id: "play" }, "Play");
  play.addEventListener("click", () => player.toggle());
  const time = html("output", { id: "replay-time" });
  const scrub = slider("Time", { min: player.begin, max: player.end, step: "any", value: player.begin, id: "scrub" }, (t) => player.seek(t));
  scrub.node.classList.add("scrub");
  player.onChange.push(() => {
    play.textContent = player.playing ? "Pause" : "Play";
    scrub.input.value = String(player.time);
    scrub.input.setAttribute("aria-valuetext", instant(player.time));
    time.textContent = instant(player.time);
    if (player.playing) sharedTime.point(player.time);
  });
  return html("div", { class: "tools" }, play, scrub.node, time);
}

/** @param {Player} player */
function lookTools(player) {
  const { gravity } = player.replay;
  const { orbital, ...plain } = views;
  const speed = slider("Speed", { min: -2, max: 2, step: 0.25, value: 0 }, (v) => { player.speed = 10 ** v * Math.max((player.end - player.begin) / 24, 1e-9); player.draw(); });
  const factor = slider("Exaggerate deflections", { min: 0, max: 3, step: 0.25, value: 0, id: "factor" }, (v) => { player.factor = 10 ** v; player.draw(); });
  const said = html("output");
  player.onChange.push(() => { said.textContent = `${span(player.speed)} per second`; });
  const rebuild = () => { player.build(); player.frame(); player.draw(); };
  const button = (/** @type {string} */ text, /** @type {string} */ label, /** @type {() => void} */ act) => {
    const made = html("button", { type: "button", "aria-label": label }, text);
    made.addEventListener("click", act);
    return made;
  };
  return html("div", { class: "tools" },
    player.actors.length > 1 ? choice("Show", shows, player.show, (key) => { player.show = key; rebuild(); }) : null,
    choice("View", gravity ? views : plain, player.view, (key) => { player.view = key; player.frame(); player.draw(); }),
    speed.node, said, player.replay.joints.length > 0 ? factor.node : null,
    button("−", "Zoom out", () => player.zoom(1.25)), button("+", "Zoom in", () => player.zoom(0.8)),
    button("↺", "Turn left", () => player.turn(0.2)), button("↻", "Turn right", () => player.turn(-0.2)));
}

/** @param {Player} player @param {HTMLElement} stage */
function captions(player, stage) {
  const caption = html("div", { class: "caption" });
  const factor = html("div", { class: "factor" });
  const sides = html("div", { class: "sides" }, ...player.actors.map((a) => html("span", { class: "engine-" + a.key }, a.label)));
  stage.append(caption, factor, sides);
  player.onChange.push(() => {
    caption.textContent = `t = ${instant(player.time)}`;
    factor.textContent = player.factor === 1 ? "" : `deflections × ${written(player.factor, 3)}`;
    sides.hidden = !(player.show === "sides" && player.view !== "path");
    sides.style.display = sides.hidden ? "none" : "";
  });
}

function replaySection() {
  const { replay } = page;
  if (!replay || (!replay.frames.bsm && !replay.frames.mujoco))
    return replay === null && page.histories.samples > 0 ? section("Replay", note("MuJoCo has no model of this vehicle, so there is nothing to draw.")) : null;
  const stage = html("div", { class: "stage", role: "img", "aria-label": "The vehicle in motion, drawn from the MJCF" });
  const node = section("Replay",
    note("Drawn from the MJCF's own geometry, around the centre of mass. BSM is solid with blue edges, MuJoCo dashed orange edges: where both agree, they lie on one another. Axes: x red, y green, z blue. Drag to turn."),
    stage);
  const player = new Player(stage, replay);
  captions(player, stage);
  const tools = [transport(player), lookTools(player)];
  node.append(...tools);
  player.tell();
  whenNear(stage, () => {
    try {
      player.start();
    } catch (error) {
      [stage, ...tools].forEach((part) => part.remove());
      node.append(note(`This browser shows no 3-D graphics (${error}).`));
    }
  });
  return node;
}
