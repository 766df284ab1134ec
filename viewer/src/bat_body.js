// A bat's body: trunk and head with a short snout, ears, legs and the membrane between them.

import * as THREE from "three";
import { loft, painted, patch, smooth, tube } from "./loft.js";
import { colour, mixed, ramp, shaded, steps } from "./paint.js";

export function batBody(shape) {
  const { length, width, depth, head_length: head, ear_length: ear } = shape.body;
  const tones = Object.fromEntries(Object.entries(shape.colours).map(([name, text]) => [name, colour(text)]));
  const front = 0.5 * length;
  const skull = 0.36 * head;
  const lift = 0.12 * depth;
  const ring = (x, z, wide, up, down = up) => ({ x, z, wide, up, down });
  const rings = smooth(
    [
      ring(front, lift - 0.25 * skull, 0.01 * skull, 0.01 * skull),
      ring(front - 0.05 * head, lift - 0.22 * skull, 0.4 * skull, 0.34 * skull),
      ring(front - 0.24 * head, lift - 0.15 * skull, 0.5 * skull, 0.48 * skull),
      ring(front - 0.46 * head, lift, 0.88 * skull, 0.86 * skull),
      ring(front - 0.74 * head, lift, 1.05 * skull, 1.04 * skull),
      ring(front - 1.02 * head, 0.6 * lift, Math.max(0.95 * skull, 0.3 * width), 0.9 * skull, skull),
      ring(0.1 * length, 0, 0.5 * width, 0.46 * depth, 0.54 * depth),
      ring(-0.08 * length, 0, 0.5 * width, 0.46 * depth, 0.52 * depth),
      ring(-0.28 * length, 0, 0.38 * width, 0.36 * depth, 0.38 * depth),
      ring(-0.42 * length, 0, 0.22 * width, 0.2 * depth, 0.2 * depth),
      ring(-0.5 * length, 0, 0.01 * width, 0.01 * depth, 0.01 * depth),
    ],
    28,
  );
  const tint = ({ x }, height) => {
    const trunk = mixed(tones.breast, tones.back, ramp(height, -0.3, 0.45));
    const face = mixed(tones.head, tones.wing, ramp(x, front - 0.28 * head, front - 0.05 * head));
    return mixed(trunk, face, ramp(x, front - 1.2 * head, front - 0.9 * head));
  };
  const parts = [loft(rings, tint, 16)];
  for (const side of [1, -1]) {
    parts.push(earOf({ front, head, skull, lift, ear }, side, tones));
    for (const [size, out, tone] of [[0.15, 0, colour("#120e0c")], [0.05, 0.12 * skull, colour("#ffffff")]]) {
      const eye = new THREE.SphereGeometry(size * skull, 8, 6);
      parts.push(painted(eye.translate(front - 0.32 * head + out * 0.5, side * (0.6 * skull + out), lift + 0.28 * skull + 0.5 * out), tone));
    }
  }
  return [...parts, ...rump(shape.body, tones)];
}

// A pointed shell, open to the front.
function earOf({ front, head, skull, lift, ear }, side, tones) {
  const root = [front - 0.72 * head, side * 0.55 * skull, lift + 0.6 * skull];
  const rows = steps(0, 1, 8).map((t) => {
    const half = 0.34 * ear * Math.sqrt(Math.max(1 - t ** 2.2, 0)) * (0.7 + 0.5 * t);
    return steps(-1, 1, 7).map((q) => [
      root[0] - 0.3 * ear * t * t - 0.5 * half * (1 - q * q) + 0.1 * ear * t,
      root[1] + side * (0.35 * ear * t) + half * q,
      root[2] + ear * (1.1 * t - 0.12),
    ]);
  });
  return patch(rows, (t, q) => mixed(tones.wing, tones.head, 0.4 + 0.4 * Math.abs(2 * q - 1)).multiplyScalar(1.05 - 0.2 * t));
}

// Where the feet are [m], in body axes; the wing's membrane ends there.
export function footOf({ length, width, tail_length: tail }) {
  return [-0.5 * length - 0.55 * Math.max(tail, 0.12 * length), 0.45 * width, -0.02 * length];
}

function rump(body, tones) {
  const { length, width, tail_length: tail } = body;
  const foot = footOf(body);
  const hip = [-0.4 * length, 0.14 * width, 0];
  const parts = [1, -1].map((side) => {
    const leg = [hip, foot].map(([x, y, z]) => [x, side * y, z]);
    return tube(leg, [0.06 * width, 0.035 * width], shaded(tones.wing_tip, 1.1));
  });
  const end = [-0.5 * length - tail, 0, -0.02 * length];
  if (tail > 0) parts.push(tube([[-0.42 * length, 0, 0], end], [0.05 * width, 0.02 * width], shaded(tones.wing_tip, 1.1)));
  // From the left leg over the tail to the right leg, hollow between them.
  const rows = steps(0, 1, 4).map((t) =>
    steps(-1, 1, 13).map((q) => {
      const share = Math.abs(q);
      const back = end[0] + (foot[0] - end[0]) * share + 0.3 * share * (1 - share) * 2 * Math.max(tail, 0.1 * length);
      return [hip[0] + (back - hip[0]) * t, q * (hip[1] + (foot[1] - hip[1]) * t), -0.02 * length * t];
    }),
  );
  return [...parts, patch(rows, () => tones.wing)];
}
