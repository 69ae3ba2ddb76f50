// An outline around what is selected: the colours of the part stay as they are.

import * as THREE from "three";

/** Width of an outline [pixels]. */
const WIDTH = 2.5;

/** Shifts a surface outwards on the screen, and behind the part that it surrounds by `depth`. */
export class Outline {
  constructor(depth) {
    this.size = { value: new THREE.Vector2(1, 1) };
    this.depth = { value: depth };
    this.meshes = [];
    this.ofSolids = [this.made(1)];
    // Of a surface either side may be outside. One that is seen at a small angle is nearer beside itself: behind it by more than the width times
    // its slope.
    this.ofSurfaces = [1, -1].map((sign) => this.made(sign, { polygonOffset: true, polygonOffsetFactor: 2 * WIDTH, polygonOffsetUnits: 2 }));
    this.materials = [...this.ofSolids, ...this.ofSurfaces];
  }

  /** A material that shifts along the normals, or against them. */
  made(sign, properties) {
    const material = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide, ...properties });
    material.onBeforeCompile = (shader) => {
      shader.uniforms.outlineSize = this.size;
      shader.uniforms.outlineDepth = this.depth;
      shader.uniforms.outlineSign = { value: sign };
      shader.vertexShader = `uniform vec2 outlineSize;\nuniform float outlineDepth;\nuniform float outlineSign;\n${shader.vertexShader}`.replace(
        "#include <project_vertex>",
        `vec4 mvPosition = modelViewMatrix * vec4(transformed, 1.0);
        gl_Position = projectionMatrix * mvPosition;
        // Behind, but at the same place of the screen.
        vec4 behind = projectionMatrix * (mvPosition - vec4(0.0, 0.0, outlineDepth, 0.0));
        gl_Position.z = behind.z / behind.w * gl_Position.w;
        vec2 outwards = (projectionMatrix * vec4(normalMatrix * normal, 0.0)).xy * outlineSize;
        gl_Position.xy += outlineSign * ${(2 * WIDTH).toFixed(1)} * outwards / max(length(outwards), 1e-9) / outlineSize * gl_Position.w;`,
      );
    };
    return material;
  }

  /** Whether a mesh is an outline. */
  has({ material }) {
    return this.materials.includes(material);
  }

  /** Surrounds the meshes of an object; surfaces without thickness have another geometry for that. None for nothing. */
  surround(object, colour, { clientWidth, clientHeight }) {
    for (const mesh of this.meshes) mesh.removeFromParent();
    this.meshes = [];
    this.size.value.set(clientWidth, clientHeight);
    for (const material of this.materials) material.color.set(colour);
    const found = [];
    object?.traverse((child) => child.isMesh && found.push(child));
    for (const mesh of found) {
      for (const material of mesh.outlined ? this.ofSurfaces : this.ofSolids) {
        const outline = new THREE.Mesh(mesh.outlined ?? mesh.geometry, material);
        outline.raycast = () => {};
        outline.frustumCulled = false;
        mesh.add(outline);
        this.meshes.push(outline);
      }
    }
  }

  dispose() {
    for (const material of this.materials) material.dispose();
  }
}
