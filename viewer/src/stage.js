// Camera, light, ground and axes: what stands around the model.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

/** Whether the processor draws, for want of a graphics card: every sample of a pixel then costs as much as a pixel. */
const drawsInSoftware = () => {
  const gl = document.createElement("canvas").getContext("webgl2");
  const named = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = named ? gl.getParameter(named.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|basic render/i.test(name);
};

export class Stage {
  constructor(holder, changed) {
    this.holder = holder;
    this.changed = changed;
    this.isSoftware = drawsInSoftware();
    this.renderer = new THREE.WebGLRenderer({ antialias: !this.isSoftware, preserveDrawingBuffer: true });
    this.sharpen(true);
    holder.prepend(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.hemisphere = new THREE.HemisphereLight(0xffffff, 0x888888, 1.7);
    this.sun = new THREE.DirectionalLight(0xffffff, 1.9);
    this.scene.add(this.hemisphere, this.sun, this.sun.target);
    this.perspective = new THREE.PerspectiveCamera(32, 1, 0.01, 1000);
    this.orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
    this.camera = this.perspective;
    this.centre = new THREE.Vector3();
    this.size = 1;
    this.up = new THREE.Vector3(0, 0, 1);
    this.gizmo = holder.querySelector(".gizmo");
    new ResizeObserver(() => this.resize()).observe(holder);
    this.makeControls();
  }

  /** Where the processor draws, edges of a picture that stands still are smoothed by four pixels for one, others are not. */
  sharpen(isStill) {
    const ratio = Math.min(window.devicePixelRatio, 2) * (this.isSoftware && isStill ? 2 : 1);
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
  }

  makeControls() {
    this.controls?.dispose();
    this.camera.up.copy(this.up);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.zoomToCursor = true;
    this.controls.enableDamping = false;
    this.controls.target.copy(this.centre);
    this.controls.addEventListener("change", this.changed);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.perspective.aspect = width / height;
    this.perspective.updateProjectionMatrix();
    this.fitOrthographic();
    this.changed();
  }

  /** The orthographic camera sees as much as the other one at the same distance. */
  fitOrthographic() {
    const { clientWidth: width, clientHeight: height } = this.holder;
    const half = this.camera.position.distanceTo(this.controls.target) * Math.tan((16 * Math.PI) / 180);
    const o = this.orthographic;
    [o.left, o.right, o.top, o.bottom] = [(-half * width) / height, (half * width) / height, half, -half];
    o.near = -20 * this.size;
    o.far = 40 * this.size;
    o.updateProjectionMatrix();
  }

  get isOrthographic() {
    return this.camera === this.orthographic;
  }

  setOrthographic(isWanted) {
    if (isWanted === this.isOrthographic) return;
    const target = this.controls.target.clone();
    const from = this.camera;
    this.fitOrthographic();
    this.camera = isWanted ? this.orthographic : this.perspective;
    this.camera.position.copy(from.position);
    this.camera.zoom = 1;
    this.makeControls();
    this.controls.target.copy(target);
    this.controls.update();
    this.fitOrthographic();
    this.changed();
  }

  /** Puts ground and axes around what lies between two corners. */
  surround({ low, high }, up, theme) {
    this.low = new THREE.Vector3(...low);
    this.high = new THREE.Vector3(...high);
    this.centre.copy(this.low).add(this.high).multiplyScalar(0.5);
    this.size = Math.max(this.high.clone().sub(this.low).length(), 1e-9);
    this.up.copy(up);
    this.perspective.near = this.size / 500;
    this.perspective.far = this.size * 60;
    this.perspective.updateProjectionMatrix();
    this.dress(theme);
  }

  dress(theme) {
    this.theme = theme;
    this.renderer.setClearColor(theme.background);
    this.hemisphere.color.set(theme.sky);
    this.hemisphere.groundColor.set(theme.floor);
    this.hemisphere.position.copy(this.up);
    for (const thing of [this.grid, this.axes]) {
      if (!thing) continue;
      this.scene.remove(thing);
      thing.geometry.dispose();
    }
    const cell = 10 ** Math.floor(Math.log10(this.size / 2));
    const step = this.size / cell > 12 ? 2 * cell : cell;
    const cells = 2 * Math.ceil((0.7 * this.size) / step);
    this.grid = new THREE.GridHelper(cells * step, cells, theme.gridMain, theme.grid);
    this.grid.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), this.up);
    const snapped = this.centre.clone().divideScalar(step).round().multiplyScalar(step);
    const lowest = this.lowest() - 0.06 * this.size;
    snapped.addScaledVector(this.up, lowest - snapped.dot(this.up));
    this.grid.position.copy(snapped);
    this.grid.raycast = () => {};
    this.cell = step;
    this.axes = new THREE.AxesHelper(0.11 * this.size);
    this.axes.setColors("#d1495b", "#2f9e63", "#3b74d9");
    this.axes.raycast = () => {};
    this.scene.add(this.grid, this.axes);
  }

  /** Height of the lowest point. */
  lowest() {
    const of = (k) => Math.min(this.up.getComponent(k) * this.low.getComponent(k), this.up.getComponent(k) * this.high.getComponent(k));
    return of(0) + of(1) + of(2);
  }

  /** Looks along `direction`, from so far that all is seen. */
  look(direction, up = this.up) {
    const away = new THREE.Vector3(...direction).normalize();
    const { clientWidth: width, clientHeight: height } = this.holder;
    const half = this.high.clone().sub(this.low).multiplyScalar(0.5);
    this.camera.up.copy(up);
    const right = new THREE.Vector3().crossVectors(up, away).normalize();
    const above = new THREE.Vector3().crossVectors(away, right);
    const reach = (axis) => Math.abs(axis.x * half.x) + Math.abs(axis.y * half.y) + Math.abs(axis.z * half.z) + 0.05 * this.size;
    const needed = Math.max(reach(above), (reach(right) * height) / Math.max(width, 1));
    const distance = (1.08 * needed) / Math.tan((16 * Math.PI) / 180) + reach(away);
    this.controls.target.copy(this.centre);
    this.camera.position.copy(this.centre).addScaledVector(away, distance);
    this.camera.zoom = 1;
    this.controls.update();
    this.fitOrthographic();
    this.changed();
  }

  /** Moves target and camera together. */
  follow(place) {
    const shift = new THREE.Vector3(...place).sub(this.controls.target);
    this.controls.target.add(shift);
    this.camera.position.add(shift);
    this.camera.lookAt(this.controls.target);
  }

  /** Where a place lies on the canvas, in pixels of the page. */
  pixel(place) {
    // The camera may have moved since it last drew.
    this.camera.updateMatrixWorld();
    const seen = new THREE.Vector3(...place).project(this.camera);
    const { clientWidth: width, clientHeight: height } = this.holder;
    return [((seen.x + 1) / 2) * width, ((1 - seen.y) / 2) * height];
  }

  render() {
    const away = this.camera.position.clone().sub(this.controls.target).normalize();
    const right = new THREE.Vector3(1, 0, 0).applyQuaternion(this.camera.quaternion);
    this.sun.position.copy(this.controls.target).add(away).addScaledVector(this.up, 0.9).addScaledVector(right, -0.5);
    this.sun.target.position.copy(this.controls.target);
    this.renderer.render(this.scene, this.camera);
    this.drawGizmo();
  }

  /** The global axes in a corner. */
  drawGizmo() {
    const canvas = this.gizmo;
    const ratio = Math.min(window.devicePixelRatio, 2);
    const side = 76;
    if (canvas.width !== side * ratio) canvas.width = canvas.height = side * ratio;
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, side, side);
    const turn = this.camera.quaternion.clone().invert();
    const arms = [["x", "#d1495b"], ["y", "#2f9e63"], ["z", "#3b74d9"]].map(([name, colour], k) => {
      const arm = new THREE.Vector3().setComponent(k, 1).applyQuaternion(turn);
      return { name, colour, arm };
    });
    pen.font = "600 11px system-ui, sans-serif";
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.lineWidth = 2;
    pen.lineCap = "round";
    for (const { name, colour, arm } of arms.sort((a, b) => a.arm.z - b.arm.z)) {
      const [x, y] = [side / 2 + 25 * arm.x, side / 2 - 25 * arm.y];
      pen.strokeStyle = pen.fillStyle = colour;
      pen.globalAlpha = arm.z < -0.1 ? 0.55 : 1;
      pen.beginPath();
      pen.moveTo(side / 2, side / 2);
      pen.lineTo(x, y);
      pen.stroke();
      pen.fillText(name, side / 2 + 33 * arm.x, side / 2 - 33 * arm.y);
    }
    pen.globalAlpha = 1;
  }
}
