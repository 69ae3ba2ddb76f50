// An outline around what is selected: the colours of the part stay as they are.

import * as THREE from "three";

/** Width of an outline [pixels]. */
const WIDTH = 2.5;

/** Shifts a surface outwards on the screen, and behind the part that it surrounds by `depth`. */
export class Outline {
  constructor(depth) {
    this.size = { value: new THREE.Vector2(1, 1) };
    this.material = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide });
    this.material.onBeforeCompile = (shader) => {
      shader.uniforms.outlineSize = this.size;
      shader.uniforms.outlineDepth = this.depth;
      shader.vertexShader = `uniform vec2 outlineSize;\nuniform float outlineDepth;\n${shader.vertexShader}`.replace(
        "#include <project_vertex>",
        `vec4 mvPosition = modelViewMatrix * vec4(transformed, 1.0);
        mvPosition.z -= outlineDepth;
        gl_Position = projectionMatrix * mvPosition;
        vec2 outwards = (projectionMatrix * vec4(normalMatrix * normal, 0.0)).xy * outlineSize;
        gl_Position.xy += ${(2 * WIDTH).toFixed(1)} * outwards / max(length(outwards), 1e-9) / outlineSize * gl_Position.w;`,
      );
    };
    this.depth = { value: depth };
    this.meshes = [];
  }

  /** Surrounds the meshes of an object; none for nothing. */
  surround(object, colour, { clientWidth, clientHeight }) {
    for (const mesh of this.meshes) mesh.removeFromParent();
    this.meshes = [];
    this.size.value.set(clientWidth, clientHeight);
    this.material.color.set(colour);
    const found = [];
    object?.traverse((child) => child.isMesh && found.push(child));
    for (const mesh of found) {
      const outline = new THREE.Mesh(mesh.geometry, this.material);
      outline.raycast = () => {};
      outline.frustumCulled = false;
      mesh.add(outline);
      this.meshes.push(outline);
    }
  }

  dispose() {
    this.material.dispose();
  }
}
