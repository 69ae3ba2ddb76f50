// The colours of fields as a texture, so that values between vertices have the colour of the legend, too.

import * as THREE from "three";

import { shade } from "./theme.js";

/** Colours of a map. */
const COUNT = 512;

const made = new Map();

/** The texture of the colours for fields of both signs, or of one. All models use the same two. */
export const colourMap = (isSigned) => {
  const key = Boolean(isSigned);
  if (made.has(key)) return made.get(key);
  const data = new Uint8Array(4 * COUNT);
  const colour = new THREE.Color();
  const light = [0, 0, 0];
  for (let k = 0; k < COUNT; k++) {
    shade(k / (COUNT - 1), key, light);
    const { r, g, b } = colour.setRGB(...light, THREE.LinearSRGBColorSpace).convertLinearToSRGB();
    data.set([r, g, b, 1].map((value) => Math.round(255 * value)), 4 * k);
  }
  const texture = new THREE.DataTexture(data, COUNT, 1);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  made.set(key, texture);
  return texture;
};

/** Where the colour of a share from 0 to 1 is in the texture; beyond its ends are the colours of these. */
export const placeInMap = (share) => (Number.isFinite(share) ? (0.5 + Math.min(Math.max(share, 0), 1) * (COUNT - 1)) / COUNT : 0);
