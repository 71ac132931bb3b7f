// Where the camera stands so that what it looks at fills the picture.

/** The corners of the boxes around whatever is drawn below a node, in the axes of the scene.
 *  @param {any} node @returns {any[]} */
function cornersOf(node) {
  /** @type {any[]} */
  const corners = [];
  node.updateMatrixWorld(true);
  node.traverseVisible((/** @type {any} */ part) => {
    if (!part.geometry) return;
    if (!part.geometry.boundingBox) part.geometry.computeBoundingBox();
    const { min, max } = part.geometry.boundingBox;
    for (const x of [min.x, max.x])
      for (const y of [min.y, max.y])
        for (const z of [min.z, max.z]) corners.push(new THREE.Vector3(x, y, z).applyMatrix4(part.matrixWorld));
  });
  return corners;
}

/** What is left free at the edges, as a part of half the picture. */
const framingMargin = 0.06;

/** The nearest point on a line of sight from which all places are in the picture.
 *  @param {any[]} places @param {any} sight unit vector towards the camera @param {number} aspect
 *  @param {number} fov [rad], from bottom to top */
function viewAlong(places, sight, aspect, fov) {
  const right = new THREE.Vector3(0, 0, 1).cross(sight).normalize(), up = sight.clone().cross(right);
  const middle = (/** @type {any} */ axis) => {
    const values = places.map((p) => p.dot(axis));
    return (Math.min(...values) + Math.max(...values)) / 2;
  };
  const target = right.clone().multiplyScalar(middle(right)).addScaledVector(up, middle(up)).addScaledVector(sight, middle(sight));
  const tall = Math.tan(fov / 2) * (1 - framingMargin), wide = Math.tan(fov / 2) * aspect * (1 - framingMargin);
  let distance = 1e-3;
  for (const place of places) {
    const from = place.clone().sub(target);
    const across = Math.max(Math.abs(from.dot(right)) / wide, Math.abs(from.dot(up)) / tall);
    distance = Math.max(distance, across + from.dot(sight));
  }
  return { eye: target.clone().addScaledVector(sight, distance), target, distance };
}

/** Of the sides from which a vehicle may be seen, from above always, that which shows it largest.
 *  @param {any[]} places @param {number} aspect @param {number} fov [rad] */
function bestView(places, aspect, fov) {
  const views = [];
  for (let azimuth = -150; azimuth <= 15; azimuth += 15) {
    const angle = (azimuth + 2.5) * Math.PI / 180, height = 25 * Math.PI / 180;
    const sight = new THREE.Vector3(Math.cos(height) * Math.cos(angle), Math.cos(height) * Math.sin(angle), Math.sin(height));
    views.push(viewAlong(places, sight, aspect, fov));
  }
  return views.reduce((best, view) => (view.distance < best.distance ? view : best));
}
