// A robot's body: a rod as fuselage, motor with gears, battery, and a tail of film.

import * as THREE from "three";
import { loft, painted, patch, smooth, tube } from "./loft.js";
import { colour, mixed, shaded } from "./paint.js";
import { tailTilt } from "./bird_body.js";

export function robotBody(shape, flight) {
  const { length, width, depth, tail_length: reach, tail_width: wide } = shape.body;
  const tones = Object.fromEntries(Object.entries(shape.colours).map(([name, text]) => [name, colour(text)]));
  const [front, rear] = [0.5 * length, -0.5 * length];
  const rod = 0.06 * Math.min(width, depth);
  const dark = shaded(tones.back, 0.7);
  const parts = [tube([[front, 0, 0], [rear - 0.1 * reach, 0, 0]], [rod, rod], dark, 8)];
  // A shell around the electronics, like a nose cone.
  const shell = [
    { x: front, z: 0, wide: 0.02 * width, up: 0.02 * depth, down: 0.02 * depth },
    { x: front - 0.06 * length, z: 0, wide: 0.24 * width, up: 0.22 * depth, down: 0.26 * depth },
    { x: front - 0.22 * length, z: 0, wide: 0.38 * width, up: 0.32 * depth, down: 0.42 * depth },
    { x: front - 0.36 * length, z: 0, wide: 0.34 * width, up: 0.26 * depth, down: 0.4 * depth },
    { x: front - 0.4 * length, z: 0, wide: 0.02 * width, up: 0.02 * depth, down: 0.02 * depth },
  ];
  parts.push(loft(smooth(shell, 24), (_, height) => mixed(tones.breast, tones.head, 0.5 + 0.5 * height), 18));
  const box = (size, at, tone) => painted(new THREE.BoxGeometry(...size).translate(...at), tone);
  parts.push(box([0.18 * length, 0.5 * width, 0.34 * depth], [0, 0, -0.02 * depth], tones.back));
  parts.push(box([0.22 * length, 0.3 * width, 0.2 * depth], [-0.22 * length, 0, -0.12 * depth], tones.bill));
  for (const [x, radius] of [[0.06, 0.24], [-0.05, 0.16]]) {
    for (const side of [1, -1]) {
      const gear = new THREE.CylinderGeometry(radius * depth, radius * depth, 0.04 * width, 20);
      parts.push(painted(gear.translate(x * length, side * 0.29 * width, 0.08 * depth), shaded(tones.bill, 1.25)));
    }
  }
  return reach > 0 ? [...parts, ...fin(flight, { reach, wide, rear }, tones, rod)] : parts;
}

// A triangle of film between two spars.
function fin(flight, { reach, wide, rear }, tones, rod) {
  const tilt = tailTilt(flight);
  const root = [rear + 0.05 * reach, 0, 0.5 * rod];
  const corner = (side) => [root[0] - Math.cos(tilt) * reach, 0.5 * side * wide, root[2] - Math.sin(tilt) * reach];
  const [left, right] = [corner(1), corner(-1)];
  const middle = left.map((value, k) => 0.5 * (value + right[k]) + (k === 0 ? 0.08 * reach : 0));
  const dark = shaded(tones.back, 0.8);
  const spar = (end) => tube([root, end], [0.5 * rod, 0.4 * rod], dark, 6);
  return [patch([[root, root, root], [left, middle, right]], () => tones.wing), spar(left), spar(right), spar(middle)];
}
