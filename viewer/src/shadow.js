// A soft shadow on the ground below the model: the model seen from below, blurred. It costs one more picture of few pixels, whatever the
// materials of the model.

import * as THREE from "three";

/** Layer of what casts a shadow. */
export const CASTERS = 1;
/** Pixels along a side of the shadow. */
const PIXELS = 192;
/** Half of its side, relative to the model. */
const REACH = 0.9;
/** Height above which nothing casts a shadow, relative to the model. */
const HIGHEST = 1.1;
/** Distance between the samples of the blur [pixels]. */
const BLUR = 1.6;

/** Weights of a Gaussian curve at three points on either side. */
const blurred = `varying vec2 at; uniform sampler2D source; uniform vec2 along;
  void main() {
    float sum = 0.227 * texture2D(source, at).a;
    sum += 0.1945 * (texture2D(source, at + along).a + texture2D(source, at - along).a);
    sum += 0.1216 * (texture2D(source, at + 2.0 * along).a + texture2D(source, at - 2.0 * along).a);
    sum += 0.0703 * (texture2D(source, at + 3.0 * along).a + texture2D(source, at - 3.0 * along).a);
    gl_FragColor = vec4(0.0, 0.0, 0.0, sum);
  }`;

export class Shadow {
  constructor(renderer) {
    this.renderer = renderer;
    const make = (options) => new THREE.WebGLRenderTarget(PIXELS, PIXELS, options);
    this.targets = [make({ samples: 4 }), make({ depthBuffer: false })];
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
    this.camera.layers.set(CASTERS);
    // The nearer to the ground, the darker.
    this.silhouette = new THREE.ShaderMaterial({
      side: THREE.DoubleSide,
      vertexShader: "void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
      fragmentShader: "void main() { gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0 - gl_FragCoord.z); }",
      blending: THREE.NoBlending,
    });
    this.blur = new THREE.ShaderMaterial({
      uniforms: { source: { value: null }, along: { value: new THREE.Vector2() } },
      vertexShader: "varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }",
      fragmentShader: blurred,
      blending: THREE.NoBlending,
      depthTest: false,
      depthWrite: false,
    });
    this.screen = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), this.blur);
    this.screen.frustumCulled = false;
    this.screen.layers.set(CASTERS);
    const plane = new THREE.PlaneGeometry(1, 1);
    // Seen from above, right is left.
    const { uv } = plane.attributes;
    for (let k = 0; k < uv.count; k++) uv.setX(k, 1 - uv.getX(k));
    const material = new THREE.MeshBasicMaterial({ color: 0, map: this.targets[0].texture, transparent: true, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -4 });
    this.plane = new THREE.Mesh(plane, material);
    this.plane.raycast = () => {};
    this.plane.renderOrder = -1;
  }

  /** Sets the height of the ground and the size of the model. */
  place({ up, height, size, opacity }) {
    this.plane.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), up);
    this.plane.scale.setScalar(2 * REACH * size);
    this.plane.material.opacity = opacity;
    [this.up, this.height] = [up, height];
    const half = REACH * size;
    Object.assign(this.camera, { left: -half, right: half, top: half, bottom: -half, near: 0, far: HIGHEST * size });
    this.camera.updateProjectionMatrix();
    this.camera.up.set(0, 1, 0).applyQuaternion(this.plane.quaternion);
  }

  /** Draws the shadow of a scene about the point of the ground below `centre`. */
  update(scene, centre) {
    const { renderer, camera, up, plane, screen } = this;
    plane.position.copy(centre).addScaledVector(up, this.height - centre.dot(up));
    camera.position.copy(plane.position).addScaledVector(up, -1e-4 * camera.far);
    camera.lookAt(camera.position.clone().add(up));
    camera.updateMatrixWorld();
    const [colour, alpha] = [renderer.getClearColor(new THREE.Color()), renderer.getClearAlpha()];
    renderer.setClearColor(0, 0);
    scene.overrideMaterial = this.silhouette;
    renderer.setRenderTarget(this.targets[0]);
    renderer.render(scene, camera);
    scene.overrideMaterial = null;
    for (const k of [0, 1]) {
      this.blur.uniforms.source.value = this.targets[k].texture;
      this.blur.uniforms.along.value.setComponent(k, BLUR / PIXELS).setComponent(1 - k, 0);
      renderer.setRenderTarget(this.targets[1 - k]);
      renderer.render(screen, camera);
    }
    renderer.setRenderTarget(null);
    renderer.setClearColor(colour, alpha);
  }
}
