// A camera that turns about a point of the scene: viewer/core/camera.cpp. Narrow pictures show as much from side to side as those of 4 : 3.
const leastAspect = 4 / 3;
const leastNearOverFar = 1e-6;

class Camera {
  constructor(page) {
    this.page = page;
    this.aspect = leastAspect;  // of what is dragged: width over height
    this.reset(0);
  }

  reset(index) {
    const given = this.page.cameras[index], w = given.world;
    this.index = index;
    Object.assign(this, { perspective: given.perspective, yFov: given.yFov, yMag: Math.abs(given.yMag), zNear: given.zNear, zFar: given.zFar });
    this.right = normalize(w.slice(0, 3));
    this.up = normalize(w.slice(4, 7));
    this.back = normalize(w.slice(8, 11));
    this.position = w.slice(12, 15);
    const depth = -dot(subtract(this.page.sphere.centre, this.position), this.back);
    this.distance = depth > 0.05 * this.page.sphere.radius ? depth : 0.5 * this.page.sphere.radius;
  }

  get pivot() { return subtract(this.position, scale(this.back, this.distance)); }

  // What the file's camera leaves out nearby and far away is there once it has moved.
  free() {
    this.zNear = Math.min(this.zNear, 1e-3 * this.page.sphere.reach);
    this.zFar = 0;
  }

  // About +Y, and up and down, but not over the pole.
  turn(around, upwards) {
    this.free();
    const pivot = this.pivot, height = Math.asin(Math.max(-1, Math.min(1, this.back[1]))), most = 0.499 * Math.PI;
    const rise = Math.max(-most, Math.min(most, height + upwards)) - height;
    const move = v => turned(turned(v, this.right, -rise), [0, 1, 0], around);
    [this.back, this.up] = [move(this.back), move(this.up)].map(normalize);
    this.right = normalize(cross(this.up, this.back));
    this.position = add(pivot, scale(this.back, this.distance));
  }

  // In parts of the picture's height.
  pan(x, y) {
    this.free();
    const height = this.heightAt(this.distance);
    this.position = add(this.position, add(scale(this.right, -x * height), scale(this.up, y * height)));
  }

  approach(factor) {
    this.free();
    const pivot = this.pivot;
    this.distance = Math.max(1e-3 * this.page.sphere.radius, Math.min(1e3 * this.page.sphere.radius, this.distance * factor));
    if (!this.perspective) this.yMag *= factor;
    this.position = add(pivot, scale(this.back, this.distance));
  }

  // Of a picture on the plane at unit depth, or of an orthographic one.
  halfHeight(aspect) { return (this.perspective ? Math.tan(0.5 * this.yFov) : this.yMag) * Math.max(leastAspect / aspect, 1); }

  // What the picture shows at a depth, from its lower edge to its upper one, in m.
  heightAt(depth) { return 2 * this.halfHeight(this.aspect) * (this.perspective ? depth : 1); }

  matrices(aspect) {
    const { centre, reach } = this.page.sphere;
    const depth = -dot(subtract(centre, this.position), this.back);
    let far = depth + reach, near = Math.max(this.zNear, depth - reach);
    if (this.zFar > 0) far = Math.min(far, this.zFar);
    if (this.perspective) near = Math.max(near, far * leastNearOverFar, 1e-9);
    if (!(far > near)) far = near + reach;
    const half = this.halfHeight(aspect);
    const projection = this.perspective ? perspectiveMatrix(half, aspect, near, far) : orthographicMatrix(half * aspect, half, near, far);
    return {
      clipFromScene: multiply(projection, viewMatrix(this.right, this.up, this.back, this.position)),
      eye: [...this.position, this.perspective ? 1 : 0], forward: [...scale(this.back, -1), 0],
      pixelRight: [...scale(this.right, half * aspect), 0], pixelUp: [...scale(this.up, half), 0],
    };
  }
}

// What takes the scene to a camera of these axes and this place.
function viewMatrix(right, up, back, position) {
  const axes = [right, up, back];
  const m = new Array(16).fill(0);
  for (let row = 0; row < 3; ++row) {
    for (let column = 0; column < 3; ++column) m[4 * column + row] = axes[row][column];
    m[12 + row] = -dot(axes[row], position);
  }
  m[15] = 1;
  return m;
}

function perspectiveMatrix(halfHeight, aspect, near, far) {
  const f = 1 / halfHeight;
  const m = new Array(16).fill(0);
  m[0] = f / aspect;
  m[5] = f;
  m[10] = (far + near) / (near - far);
  m[11] = -1;
  m[14] = 2 * far * near / (near - far);
  return m;
}

function orthographicMatrix(halfWidth, halfHeight, near, far) {
  const m = new Array(16).fill(0);
  m[0] = 1 / halfWidth;
  m[5] = 1 / halfHeight;
  m[10] = 2 / (near - far);
  m[14] = (far + near) / (near - far);
  m[15] = 1;
  return m;
}
