// The vehicle as three.js draws it, built from the very MJCF that MuJoCo loaded: bodies are groups,
// each joint a group of its own inside its body, geoms are meshes. MuJoCo's quaternions are scalar
// first, three's are scalar last.

/** @param {string | null} text @param {number[]} otherwise */
const numbersIn = (text, otherwise) => (text === null ? otherwise : text.trim().split(/\s+/).map(Number));

/** @param {Element} element @param {string} name */
const childrenNamed = (element, name) => [...element.children].filter((child) => child.tagName === name);

/** How an engine's vehicle looks: solid, or drawn by its edges alone.
 *  @typedef {{edges: string, solid: boolean}} Look */

class Vehicle {
  /** @param {Document} mjcf @param {Look} look @param {Force[]} forces */
  constructor(mjcf, look, forces) {
    this.look = look;
    this.root = new THREE.Group();
    /** @type {Map<string, {group: any, axis: any, slides: boolean}>} */
    this.joints = new Map();
    /** What turns with a wheel, about its own z axis, where the wheel's body is a token elsewhere.
     *  @type {Map<string, any[]>} */
    this.discs = new Map();
    /** @type {{drawn: any, sign: number, force: number[][], largest: number}[]} */
    this.forces = [];
    this.materials = new Map(childrenNamed(childrenNamed(mjcf.documentElement, "asset")[0] || mjcf.documentElement, "material")
      .map((m) => [m.getAttribute("name"), numbersIn(m.getAttribute("rgba"), [0.6, 0.7, 0.8, 1])]));
    const world = childrenNamed(mjcf.documentElement, "worldbody")[0];
    this.addBody(childrenNamed(world, "body")[0], this.root, true);
    this.extent = Number(childrenNamed(mjcf.documentElement, "statistic")[0]?.getAttribute("extent") || 1);
    forces.forEach((force) => this.addForce(force));
  }

  /** @param {Element} body @param {any} parent @param {boolean} isHub */
  addBody(body, parent, isHub) {
    let group = new THREE.Group();
    parent.add(group);
    if (!isHub) place(group, body);
    for (const joint of childrenNamed(body, "joint")) {
      if (isHub) break; // a point mass's three slides: the root is moved instead
      const moving = new THREE.Group();
      group.add(moving);
      group = moving;
      this.joints.set(joint.getAttribute("name") || "", { group,
        axis: new THREE.Vector3(...numbersIn(joint.getAttribute("axis"), [0, 0, 1])).normalize(),
        slides: joint.getAttribute("type") === "slide" });
    }
    for (const geom of childrenNamed(body, "geom")) this.addGeom(geom, group);
    for (const site of childrenNamed(body, "site")) {
      const point = new THREE.Group();
      point.name = "site " + site.getAttribute("name");
      point.position.set(...numbersIn(site.getAttribute("pos"), [0, 0, 0]));
      group.add(point);
    }
    for (const child of childrenNamed(body, "body")) this.addBody(child, group, false);
  }

  /** @param {Element} geom @param {any} group */
  addGeom(geom, group) {
    const shape = geometryOf(geom.getAttribute("type"), numbersIn(geom.getAttribute("size"), [0.1]));
    if (!shape) return;
    const placed = new THREE.Group();
    place(placed, geom);
    const node = new THREE.Group();
    placed.add(node);
    const wheel = (geom.getAttribute("name") || "").split(".")[0];
    if (wheel) this.discs.set(wheel, [...(this.discs.get(wheel) || []), node]);
    if (this.look.solid) {
      const [r, g, b, alpha] = this.materials.get(geom.getAttribute("material")) || numbersIn(geom.getAttribute("rgba"), [0.6, 0.7, 0.8, 1]);
      const mesh = new THREE.Mesh(shape, new THREE.MeshLambertMaterial({ color: new THREE.Color(r, g, b), transparent: alpha < 1, opacity: alpha,
        depthWrite: alpha >= 1, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, side: alpha < 1 ? THREE.DoubleSide : THREE.FrontSide }));
      node.add(mesh);
    }
    node.add(this.outline(geom.getAttribute("type") === "sphere" ? greatCircles(shape.parameters.radius) : new THREE.EdgesGeometry(shape, 25)));
    group.add(placed);
  }

  /** Over a solid vehicle dashes, so that both colours are seen where both lines are.
   *  @param {any} lines */
  outline(lines) {
    const material = this.look.solid ? new THREE.LineBasicMaterial({ color: this.look.edges })
      : new THREE.LineDashedMaterial({ color: this.look.edges, dashSize: 0.09, gapSize: 0.09, depthFunc: THREE.LessEqualDepth });
    const made = new THREE.LineSegments(lines, material);
    made.renderOrder = this.look.solid ? 0 : 1;
    return this.look.solid ? made : made.computeLineDistances();
  }

  /** A thruster's plume goes against its force, any other force is an arrow along it. Both are made
   *  along +y from the point where they act. @param {Force} force */
  addForce({ site, is_thruster, force }) {
    const point = this.root.getObjectByName("site " + site);
    if (!point || !this.look.solid) return;
    const sign = is_thruster ? -1 : 1;
    const shape = is_thruster ? new THREE.ConeBufferGeometry(0.24, 1, 24, 1, true).rotateX(Math.PI).translate(0, 0.5, 0)
      : new THREE.ConeBufferGeometry(0.035, 1, 16).translate(0, 0.5, 0);
    const drawn = new THREE.Mesh(shape, new THREE.MeshBasicMaterial({ color: is_thruster ? "#ff9f3f" : colour("--s2"), transparent: true,
      opacity: is_thruster ? 0.5 : 0.85, depthWrite: false, side: THREE.DoubleSide }));
    drawn.visible = false;
    point.add(drawn);
    this.forces.push({ drawn, sign, force, largest: Math.max(...force.map((row) => Math.hypot(row[1], row[2], row[3]))) });
  }

  /** @param {State} state @param {number} factor of deflections */
  pose(state, factor) {
    state.joints.forEach((value, name) => this.turn(name, factor * value));
    state.wheels.forEach((angle, name) => this.spin(name, angle));
    for (const { drawn, sign, force, largest } of this.forces) {
      const row = [...force].reverse().find((r) => r[0] <= state.time) || [0, 0, 0, 0];
      const now = new THREE.Vector3(row[1], row[2], row[3]);
      drawn.visible = now.length() > 0;
      if (!drawn.visible) continue;
      drawn.scale.setScalar(this.extent * (0.2 + 0.35 * now.length() / largest));
      drawn.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), now.normalize().multiplyScalar(sign));
    }
  }

  /** @param {string} name @param {number} angle */
  spin(name, angle) {
    const discs = this.discs.get(name) || [];
    discs.forEach((disc) => disc.quaternion.setFromAxisAngle(new THREE.Vector3(0, 0, 1), angle));
  }

  /** @param {string} name @param {number} value */
  turn(name, value) {
    const joint = this.joints.get(name);
    if (!joint) return;
    if (joint.slides) joint.group.position.copy(joint.axis).multiplyScalar(value);
    else joint.group.quaternion.setFromAxisAngle(joint.axis, value);
  }
}

/** Where an element with `pos` and `quat` or `zaxis` sits. @param {any} node @param {Element} element */
function place(node, element) {
  node.position.set(...numbersIn(element.getAttribute("pos"), [0, 0, 0]));
  const [w, x, y, z] = numbersIn(element.getAttribute("quat"), [1, 0, 0, 0]);
  node.quaternion.set(x, y, z, w).normalize();
  const axis = element.getAttribute("zaxis");
  if (axis !== null)
    node.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(...numbersIn(axis, [0, 0, 1])).normalize());
}

/** MuJoCo's sizes are halves, its cylinders stand along z. @param {string | null} type @param {number[]} size */
function geometryOf(type, size) {
  switch (type) {
    case "box": return new THREE.BoxBufferGeometry(2 * size[0], 2 * size[1], 2 * size[2]);
    case "cylinder": return new THREE.CylinderBufferGeometry(size[0], size[0], 2 * size[1], 40).rotateX(Math.PI / 2);
    case "sphere": return new THREE.SphereBufferGeometry(size[0], 32, 20);
    case "ellipsoid": return new THREE.SphereBufferGeometry(1, 32, 20).scale(size[0], size[1], size[2]);
    default: return null;
  }
}

/** A ball has no edges: three circles stand for them. @param {number} radius */
function greatCircles(radius) {
  const points = [];
  for (const [u, v] of [["x", "y"], ["y", "z"], ["z", "x"]])
    for (let i = 0; i < 48; i += 1)
      for (const angle of [i, i + 1].map((k) => k * Math.PI / 24))
        points.push(Object.assign(new THREE.Vector3(), { [u]: radius * Math.cos(angle), [v]: radius * Math.sin(angle) }));
  return new THREE.BufferGeometry().setFromPoints(points);
}

/** Three axes from a point: x red, y green, z blue as everywhere. @param {number} length */
const triad = (length) => new THREE.AxesHelper(length);
