// The state of the vehicle at any time, between the frames that the page holds.

/** @typedef {{time: number, position: any, centre: any, attitude: any, joints: Map<string, number>,
 *             wheels: Map<string, number>}} State */

class Motion {
  /** @param {string} text rows of time, hub position, centre of mass, quaternion, joints, wheel angles
   *  @param {string[]} joints @param {string[]} wheels */
  constructor(text, joints, wheels) {
    this.values = doubles(text);
    this.joints = joints;
    this.wheels = wheels;
    this.width = 11 + joints.length + wheels.length;
    this.count = this.values.length / this.width;
    this.begin = this.values[0];
    this.end = this.values[(this.count - 1) * this.width];
  }

  /** @param {number} time */
  frameAt(time) {
    let low = 0, high = this.count - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.values[middle * this.width] <= time) low = middle;
      else high = middle;
    }
    return low;
  }

  /** @param {number} frame @param {number} column */
  value(frame, column) {
    return this.values[frame * this.width + column];
  }

  /** @param {number} frame @param {number} column */
  vector(frame, column) {
    return new THREE.Vector3(this.value(frame, column), this.value(frame, column + 1), this.value(frame, column + 2));
  }

  /** @param {number} frame */
  quaternion(frame) {
    return new THREE.Quaternion(this.value(frame, 8), this.value(frame, 9), this.value(frame, 10), this.value(frame, 7));
  }

  /** Linear between frames, attitude along the shortest arc. @param {number} time @returns {State} */
  at(time) {
    const a = this.frameAt(time), b = Math.min(a + 1, this.count - 1);
    const span = this.value(b, 0) - this.value(a, 0);
    const part = span > 0 ? Math.min(Math.max((time - this.value(a, 0)) / span, 0), 1) : 0;
    const mixed = (/** @type {number} */ column) => this.value(a, column) + part * (this.value(b, column) - this.value(a, column));
    const named = (/** @type {string[]} */ names, /** @type {number} */ first) => new Map(names.map((name, i) => [name, mixed(first + i)]));
    return {
      time, position: this.vector(a, 1).lerp(this.vector(b, 1), part), centre: this.vector(a, 4).lerp(this.vector(b, 4), part),
      attitude: this.quaternion(a).slerp(this.quaternion(b), part),
      joints: named(this.joints, 11), wheels: named(this.wheels, 11 + this.joints.length),
    };
  }

  /** Velocity of the centre of mass, well enough for a frame of reference. @param {number} time */
  velocity(time) {
    const a = Math.min(this.frameAt(time), Math.max(this.count - 2, 0));
    return this.vector(Math.min(a + 1, this.count - 1), 4).sub(this.vector(a, 4));
  }

  /** The way of the centre of mass. */
  path() {
    return Array.from({ length: this.count }, (_, frame) => this.vector(frame, 4));
  }
}
