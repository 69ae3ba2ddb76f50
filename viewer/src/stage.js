// Camera, light, ground and axes: what stands around the model.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { Ground } from "./ground.js";

/** Whether the processor draws, for want of a graphics card: every sample of a pixel then costs as much as a pixel. */
const drawsInSoftware = () => {
  const gl = document.createElement("canvas").getContext("webgl2");
  const named = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = named ? gl.getParameter(named.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|basic render/i.test(name);
};

/** Half of the angle of view [rad]. */
const HALF_ANGLE = (16 * Math.PI) / 180;
/** Share of the height and the width of the picture that the drawn geometry may fill. */
const FILLED = 0.8;

/** Length of the scale bar at most [pixels]. */
const LONGEST_BAR = 110;

/** A length in the unit in which it is a short number. */
const metres = (length) => {
  const [factor, unit] = [[1e-3, "km"], [1, "m"], [1e3, "mm"], [1e6, "µm"]].find(([factor]) => length * factor >= 0.0999) ?? [1e6, "µm"];
  return `${Number((length * factor).toPrecision(3))} ${unit}`;
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
    this.ground = new Ground(this.renderer);
    /** The ground as it is shown or hidden. */
    this.grid = this.ground.group;
    this.scene.add(this.hemisphere, this.sun, this.sun.target, this.grid);
    this.perspective = new THREE.PerspectiveCamera((360 * HALF_ANGLE) / Math.PI, 1, 0.01, 1000);
    this.orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
    this.camera = this.perspective;
    this.centre = new THREE.Vector3();
    this.size = 1;
    this.extent = 1;
    this.filled = FILLED;
    /** Points of the drawn geometry over the motion, one after the other. */
    this.points = new Float32Array();
    /** Those that `look` brings into the picture, and how far the camera has gone with the machine since the start. */
    this.framed = this.points;
    this.gone = new THREE.Vector3();
    /** Whether the camera is where `look` has put it, so that it follows the size of the window. */
    this.isFramed = false;
    this.up = new THREE.Vector3(0, 0, 1);
    this.gizmo = holder.querySelector(".gizmo");
    this.scale = holder.querySelector("#scale");
    new ResizeObserver(() => this.resize()).observe(holder);
    this.makeControls();
  }

  /** Where the processor draws, a picture that stands still has a shadow, and edges smoothed by four pixels for one; others have neither. */
  sharpen(isStill) {
    this.hasShadow = isStill || !this.isSoftware;
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
    this.controls.addEventListener("end", () => this.linkCamera());
    this.controls.addEventListener("start", () => (this.isFramed = false));
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.perspective.aspect = width / height;
    this.perspective.updateProjectionMatrix();
    this.fitOrthographic();
    if (this.isFramed) this.look(this.direction, this.upward);
    this.changed();
  }

  /** The orthographic camera sees as much as the other one at the same distance. */
  fitOrthographic() {
    const { clientWidth: width, clientHeight: height } = this.holder;
    const half = this.camera.position.distanceTo(this.controls.target) * Math.tan(HALF_ANGLE);
    const o = this.orthographic;
    [o.left, o.right, o.top, o.bottom] = [(-half * width) / height, (half * width) / height, half, -half];
    o.near = -20 * this.extent;
    o.far = 40 * this.extent;
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

  /** Sets the size of the model, by which symbols are drawn, its extent with its travel from two corners, and the upward direction. */
  measure({ low, high, size }, up) {
    this.size = Math.max(size, 1e-9);
    this.extent = Math.max(Math.hypot(...high.map((x, k) => x - low[k])), this.size);
    this.up.copy(up);
  }

  /** Puts ground and axes around the points of the drawn geometry, of which some are framed and the lowest part has this height. */
  surround(points, framed, lowest, theme) {
    this.points = points;
    this.framed = framed;
    this.lowestPart = lowest;
    const box = new THREE.Box3();
    const at = new THREE.Vector3();
    for (let k = 0; k < points.length; k += 3) box.expandByPoint(at.fromArray(points, k));
    [this.low, this.high] = [box.min, box.max];
    box.getCenter(this.centre);
    this.perspective.near = this.size / 500;
    this.perspective.far = this.extent * 60;
    this.perspective.updateProjectionMatrix();
    this.dress(theme);
  }

  /** Hides what lies beyond a plane across an axis, at a share of the extent of the drawn geometry; all is shown without an axis. Returns
   *  the place of the plane [m]. */
  cut(axis, share) {
    this.renderer.clippingPlanes = [];
    if (axis === null || !this.low) return null;
    const [low, high] = [this.low, this.high].map((corner) => corner.getComponent(axis));
    const place = low + share * (high - low);
    this.renderer.clippingPlanes = [new THREE.Plane(new THREE.Vector3().setComponent(axis, -1), place)];
    return place;
  }

  /** Whether some of what is framed is out of the picture, or it fills less than a third of it. */
  isPoorlyFramed() {
    this.camera.updateMatrixWorld();
    const seen = new THREE.Vector3();
    const [low, high] = [new THREE.Vector2(Infinity, Infinity), new THREE.Vector2(-Infinity, -Infinity)];
    for (let k = 0; k < this.framed.length; k += 3) {
      seen.fromArray(this.framed, k).add(this.gone).project(this.camera);
      low.min(seen);
      high.max(seen);
    }
    const { x, y } = high.clone().sub(low);
    return Math.max(-low.x, -low.y, high.x, high.y) > 1 || Math.max(x, y) < 0.67;
  }

  dress(theme) {
    this.theme = theme;
    this.renderer.setClearColor(theme.background);
    this.hemisphere.color.set(theme.sky);
    this.hemisphere.groundColor.set(theme.floor);
    this.hemisphere.position.copy(this.up);
    this.ground.dress({ up: this.up, height: this.lowest(), lowest: this.lowestPart, size: this.size, theme });
    this.axes?.removeFromParent();
    this.axes?.geometry.dispose();
    this.axes = new THREE.AxesHelper(0.11 * this.size);
    this.axes.setColors("#d1495b", "#2f9e63", "#3b74d9");
    this.axes.raycast = () => {};
    this.scene.add(this.axes);
  }

  /** Height of the lowest point. */
  lowest() {
    const of = (k) => Math.min(this.up.getComponent(k) * this.low.getComponent(k), this.up.getComponent(k) * this.high.getComponent(k));
    return of(0) + of(1) + of(2);
  }

  /** Looks along `direction`, with all that is framed in the picture. */
  look(direction, up = this.up) {
    this.direction = direction;
    this.upward = up;
    const away = new THREE.Vector3(...direction).normalize();
    this.camera.up.copy(up);
    const right = new THREE.Vector3().crossVectors(up, away).normalize();
    const above = new THREE.Vector3().crossVectors(away, right);
    const { clientWidth: width, clientHeight: height } = this.holder;
    const slope = this.filled * Math.tan(HALF_ANGLE);
    const slopes = [(slope * width) / Math.max(height, 1), slope];
    // A point at depth w toward the camera is in the picture if r + slope w and slope w - r do not exceed its edges.
    const reach = [-Infinity, -Infinity, -Infinity, -Infinity];
    let [near, far] = [-Infinity, Infinity];
    const points = this.framed;
    for (let k = 0; k < points.length; k += 3) {
      const [x, y, z] = [points[k], points[k + 1], points[k + 2]];
      const along = (axis) => axis.x * x + axis.y * y + axis.z * z;
      const w = along(away);
      near = Math.max(near, w);
      far = Math.min(far, w);
      [right, above].forEach((axis, k) => {
        const r = along(axis);
        const depth = this.isOrthographic ? 0 : slopes[k] * w;
        reach[2 * k] = Math.max(reach[2 * k], depth + r);
        reach[2 * k + 1] = Math.max(reach[2 * k + 1], depth - r);
      });
    }
    const half = (k) => (reach[2 * k] + reach[2 * k + 1]) / 2;
    const middle = (near + far) / 2;
    const distance = Math.max(half(0) / slopes[0], half(1) / slopes[1], 1e-3 * this.size) + (this.isOrthographic ? middle : 0);
    const eye = new THREE.Vector3().addScaledVector(away, distance);
    [right, above].forEach((axis, k) => eye.addScaledVector(axis, (reach[2 * k] - reach[2 * k + 1]) / 2));
    eye.add(this.gone);
    this.controls.target.copy(eye).addScaledVector(away, middle - distance);
    this.camera.position.copy(eye);
    this.camera.zoom = 1;
    this.controls.update();
    this.isFramed = true;
    this.fitOrthographic();
    this.changed();
  }

  /** Brings the whole motion into the picture, from the direction in which the camera looks. */
  fit() {
    this.framed = this.points;
    this.gone.set(0, 0, 0);
    this.reframe();
  }

  /** Brings what is framed into the picture, from the direction in which the camera looks. */
  reframe() {
    const away = this.camera.position.clone().sub(this.controls.target);
    this.look(away.toArray(), this.camera.up.clone());
  }

  /** Writes position, target and upward direction of the camera into the address, so that a link shows the same picture. */
  linkCamera() {
    const { position, up, zoom } = this.camera;
    // As at the start, where the page begins.
    const [eye, target] = [position, this.controls.target].map((place) => place.clone().sub(this.gone));
    const numbers = [eye, target, up].flatMap((vector) => vector.toArray().map((x) => Number(x.toPrecision(6))));
    const others = location.hash.slice(1).split("&").filter((word) => word && !word.startsWith("camera="));
    history.replaceState(null, "", `#${[...others, `camera=${[...numbers, Number(zoom.toPrecision(5)), Number(this.isOrthographic)].join(",")}`].join("&")}`);
  }

  /** Looks as the address has it, if it has a camera. */
  lookAsLinked(hash) {
    const numbers = hash.match(/camera=([^&]+)/)?.[1].split(",").map(Number) ?? [];
    if (numbers.length !== 11 || !numbers.every(Number.isFinite)) return;
    this.setOrthographic(numbers[10] === 1);
    this.isFramed = false;
    this.camera.position.fromArray(numbers, 0);
    this.controls.target.fromArray(numbers, 3);
    this.camera.up.fromArray(numbers, 6);
    this.camera.zoom = numbers[9];
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.fitOrthographic();
    this.changed();
  }

  /** Moves target and camera together, to this target. */
  follow(place) {
    this.shift(new THREE.Vector3(...place).sub(this.controls.target));
  }

  /** Goes with the machine, which is so far from its start. */
  accompany(way) {
    const gone = new THREE.Vector3(...way);
    this.shift(gone.clone().sub(this.gone));
    this.gone.copy(gone);
  }

  shift(way) {
    this.controls.target.add(way);
    this.camera.position.add(way);
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

  /** Draws the model, whose middle is `centre` now. */
  render(centre = this.middle ?? this.centre) {
    this.middle = centre;
    const away = this.camera.position.clone().sub(this.controls.target).normalize();
    const right = new THREE.Vector3(1, 0, 0).applyQuaternion(this.camera.quaternion);
    this.sun.position.copy(this.controls.target).add(away).addScaledVector(this.up, 0.9).addScaledVector(right, -0.5);
    this.sun.target.position.copy(this.controls.target);
    if (this.grid.visible) {
      const { clientWidth: width, clientHeight: height } = this.holder;
      this.ground.follow(this.controls.target, (0.8 * Math.min(width, height)) / this.pixelsPerMetre());
      this.ground.shadow.plane.visible = this.hasShadow;
      if (this.hasShadow) this.ground.shadow.update(this.scene, centre);
    }
    this.renderer.render(this.scene, this.camera);
    this.drawGizmo();
    this.drawScale();
  }

  /** Pixels of a metre at the distance of the point that the camera looks at. */
  pixelsPerMetre() {
    const { clientHeight: height } = this.holder;
    if (this.isOrthographic) return (height * this.camera.zoom) / (this.camera.top - this.camera.bottom);
    return height / (2 * this.camera.position.distanceTo(this.controls.target) * Math.tan(HALF_ANGLE));
  }

  /** A bar of a round length, true at the distance of the point that the camera looks at, and the cell of the grid. */
  drawScale() {
    const most = LONGEST_BAR / this.pixelsPerMetre();
    const power = 10 ** Math.floor(Math.log10(most));
    const length = power * [5, 2, 1].find((factor) => factor * power <= most * (1 + 1e-9));
    const width = `${(length * this.pixelsPerMetre()).toFixed(1)}px`;
    const text = `${metres(length)}${this.grid.visible ? ` · grid ${metres(this.ground.cell)}` : ""}`;
    const [bar, label] = this.scale.children;
    if (bar.style.width !== width) bar.style.width = width;
    if (label.textContent !== text) label.textContent = text;
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
