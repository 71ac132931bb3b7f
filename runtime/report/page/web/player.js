// The vehicle of either engine or both at any time, in a frame of choice, from any side.

class Player {
  /** @param {HTMLElement} stage @param {Replay} replay */
  constructor(stage, replay) {
    this.stage = stage;
    this.mjcf = new DOMParser().parseFromString(page.mjcf, "text/xml");
    /** @type {{key: "bsm" | "mujoco", label: string, motion: Motion, vehicle?: any, holder?: any}[]} */
    this.actors = engines.filter((e) => replay.frames[e.key]).map((e) => ({ ...e,
      motion: new Motion(replay.frames[e.key] || "", replay.joints, replay.wheels) }));
    this.replay = replay;
    this.begin = Math.min(...this.actors.map((a) => a.motion.begin));
    this.end = Math.max(...this.actors.map((a) => a.motion.end));
    this.time = this.begin;
    this.factor = 1;
    this.view = replay.point_mass ? "path" : "inertial";
    this.show = this.actors.length > 1 ? "both" : this.actors[0].key;
    this.playing = false;
    this.speed = Math.max((this.end - this.begin) / 24, 1e-9);
    /** @type {(() => void)[]} */
    this.onChange = [];
  }

  start() {
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.stage.append(this.renderer.domElement);
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.01, 1000);
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.enableKeys = false;
    this.controls.enablePan = false;
    this.controls.enableZoom = false; // the wheel scrolls the page; buttons and keys zoom
    this.controls.addEventListener("change", () => this.draw());
    this.build();
    this.resize();
    this.frame();
    new ResizeObserver(() => this.resize()).observe(this.stage);
    document.addEventListener("repaint", () => { this.build(); this.resize(); });
  }

  build() {
    if (!this.renderer) return;
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.HemisphereLight("#ffffff", "#8a94a0", 0.75));
    this.sun = new THREE.DirectionalLight("#ffffff", 0.55);
    this.scene.add(this.sun);
    for (const actor of this.actors) {
      const solid = actor.key === "bsm" || this.show !== "both";
      actor.vehicle = new Vehicle(this.mjcf, { solid, edges: colour("--" + actor.key) }, this.replay.forces);
      actor.holder = new THREE.Group();
      actor.holder.add(actor.vehicle.root);
      this.scene.add(actor.holder);
    }
    this.extent = this.actors[0].vehicle.extent;
    this.axes = triad(this.extent * 0.5);
    this.scene.add(this.axes);
    this.way = this.buildWay();
    this.scene.add(this.way);
  }

  /** The path, the size of the vehicle's stage, with a dot for each engine and one for the origin. */
  buildWay() {
    const way = new THREE.Group();
    const all = this.actors.flatMap((actor) => actor.motion.path());
    const centre = this.replay.gravity ? new THREE.Vector3() : new THREE.Box3().setFromPoints(all).getCenter(new THREE.Vector3());
    this.wayCentre = centre;
    this.wayScale = this.extent * 0.8 / (Math.max(...all.map((p) => p.distanceTo(centre))) || 1);
    for (const actor of this.actors) {
      // MuJoCo's on top of BSM's, so dashed, and its dot open.
      const over = actor.key === "mujoco" && this.actors.length > 1;
      const shade = { color: colour("--" + actor.key) };
      const points = actor.motion.path().map((p) => p.sub(centre).multiplyScalar(this.wayScale));
      const line = new THREE.Line(new THREE.BufferGeometry().setFromPoints(points),
        over ? new THREE.LineDashedMaterial({ ...shade, dashSize: this.extent * 0.03, gapSize: this.extent * 0.03 }) : new THREE.LineBasicMaterial(shade));
      way.add(over ? line.computeLineDistances() : line);
      const dot = new THREE.Mesh(new THREE.SphereBufferGeometry(this.extent * (over ? 0.034 : 0.022), 10, 8), new THREE.MeshBasicMaterial({ ...shade, wireframe: over }));
      dot.name = actor.key;
      way.add(dot);
    }
    if (this.replay.gravity)
      way.add(new THREE.Mesh(new THREE.SphereBufferGeometry(this.extent * 0.045, 24, 16), new THREE.MeshBasicMaterial({ color: colour("--soft") })));
    return way;
  }

  /** The camera where the whole vehicle is in view. */
  frame() {
    if (!this.camera) return;
    const aspect = this.stage.clientWidth / this.stage.clientHeight / (this.show === "sides" && this.view !== "path" ? 2 : 1);
    const { eye, target, distance } = bestView(this.places(), aspect, this.camera.fov * Math.PI / 180);
    this.camera.up.set(0, 0, 1);
    this.camera.position.copy(eye);
    this.camera.near = distance / 200;
    this.camera.far = distance * 20;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(target);
    this.controls.update();
  }

  /** Where anything is seen during the run, in the axes of the view. */
  places() {
    this.way.visible = this.view === "path";
    // A path may be a point: its dots are not to fill the picture.
    if (this.view === "path")
      return [...cornersOf(this.way), ...[-0.3, 0.3].map((x) => new THREE.Vector3(x, x, x).multiplyScalar(this.extent))];
    const now = this.time;
    const places = [];
    for (let i = 0; i <= 24; i += 1) {
      this.time = this.begin + (this.end - this.begin) * i / 24;
      for (const actor of this.actors) {
        this.placeActor(actor);
        if (actor.holder.visible) places.push(...cornersOf(actor.holder));
      }
    }
    this.time = now;
    return places;
  }

  /** @param {number} factor */
  zoom(factor) {
    if (!this.camera) return;
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  /** @param {number} angle [rad] */
  turn(angle) {
    if (!this.camera) return;
    this.camera.position.sub(this.controls.target).applyAxisAngle(new THREE.Vector3(0, 0, 1), angle).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.stage;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Rotation from inertial axes to those of the view. @param {Motion} motion @param {State} state */
  viewRotation(motion, state) {
    if (this.view === "hub") return state.attitude.clone().conjugate();
    if (this.view !== "orbital") return new THREE.Quaternion();
    const radial = state.centre.clone().normalize();
    const across = state.centre.clone().cross(motion.velocity(state.time)).normalize();
    if (radial.length() === 0 || across.length() === 0) return new THREE.Quaternion();
    const basis = new THREE.Matrix4().makeBasis(radial, across.clone().cross(radial), across);
    return new THREE.Quaternion().setFromRotationMatrix(basis).conjugate();
  }

  draw() {
    if (!this.renderer) return this.tell();
    for (const actor of this.actors) this.placeActor(actor);
    this.way.visible = this.view === "path";
    this.sun.position.copy(this.camera.position).add(new THREE.Vector3(0, 0, this.extent * 3));
    if (this.show === "sides" && this.view !== "path") this.drawSides();
    else {
      this.renderer.setScissorTest(false);
      this.renderer.setViewport(0, 0, this.stage.clientWidth, this.stage.clientHeight);
      this.renderer.render(this.scene, this.camera);
    }
    this.tell();
  }

  tell() {
    for (const listener of this.onChange) listener();
  }

  /** @param {any} actor */
  placeActor(actor) {
    const state = actor.motion.at(Math.min(this.time, actor.motion.end));
    const shown = this.show === "both" || this.show === "sides" || this.show === actor.key;
    actor.holder.visible = shown && this.view !== "path";
    actor.holder.quaternion.copy(this.viewRotation(actor.motion, state));
    actor.vehicle.root.position.copy(state.position).sub(state.centre);
    actor.vehicle.root.quaternion.copy(state.attitude);
    actor.vehicle.pose(state, this.factor);
    const dot = this.way.getObjectByName(actor.key);
    dot.position.copy(state.centre).sub(this.wayCentre).multiplyScalar(this.wayScale);
    dot.visible = shown;
  }

  drawSides() {
    const width = this.stage.clientWidth, height = this.stage.clientHeight, half = width / 2;
    this.renderer.setScissorTest(true);
    this.camera.aspect = half / height;
    this.camera.updateProjectionMatrix();
    this.actors.forEach((actor, i) => {
      this.actors.forEach((other) => { other.holder.visible = other === actor; });
      this.renderer.setViewport(i * half, 0, half, height);
      this.renderer.setScissor(i * half, 0, half, height);
      this.renderer.render(this.scene, this.camera);
    });
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** @param {number} time */
  seek(time) {
    this.time = Math.min(Math.max(time, this.begin), this.end);
    this.draw();
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.time >= this.end) this.time = this.begin;
    let last = performance.now();
    const advance = (/** @type {number} */ now) => {
      if (!this.playing) return;
      this.time += this.speed * (now - last) / 1000;
      last = now;
      if (this.time >= this.end) { this.time = this.end; this.playing = false; }
      this.draw();
      requestAnimationFrame(advance);
    };
    if (this.playing) requestAnimationFrame(advance);
    this.draw();
  }
}
