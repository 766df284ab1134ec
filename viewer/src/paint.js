// Colours of skins, and small numbers that shape them.

import * as THREE from "three";

export function colour(text) {
  return new THREE.Color(text);
}

export function mixed(one, two, share) {
  return one.clone().lerp(two, Math.min(Math.max(share, 0), 1));
}

export function shaded(base, factor) {
  return base.clone().multiplyScalar(factor);
}

// From 0 below `low` to 1 above `high`, smoothly.
export function ramp(value, low, high) {
  const share = Math.min(Math.max((value - low) / (high - low), 0), 1);
  return share * share * (3 - 2 * share);
}

export function steps(from, until, count) {
  return Array.from({ length: count }, (_, i) => from + ((until - from) * i) / (count - 1));
}

// A surface with a colour at every point. `opacity` below 1 is a ghost, or a film that lets light through.
export function surface(opacity) {
  return new THREE.MeshLambertMaterial({
    vertexColors: true,
    side: THREE.DoubleSide,
    transparent: opacity < 1,
    opacity,
    depthWrite: opacity > 0.5,
  });
}
