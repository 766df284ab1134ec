// A bird's body: trunk, neck and head in one loft, bill, eyes, and a fan of tail feathers.

import * as THREE from "three";
import { loft, painted, patch, smooth } from "./loft.js";
import { colour, mixed, ramp, shaded, steps } from "./paint.js";
import { vane } from "./vane.js";

const FEATHERS = 10;

export function birdBody(shape, flight) {
  const { length, depth, head_length: head, bill_length: bill } = shape.body;
  const tones = Object.fromEntries(Object.entries(shape.colours).map(([name, text]) => [name, colour(text)]));
  const front = 0.47 * length;
  const rear = front - length;
  const skull = 0.36 * head; // half the height of the head
  const neck = 0.2 * depth;
  const rings = smooth(profile(shape.body, { front, rear, skull, neck }), 32);
  const bend = levelled(rings, -0.06 * length, front - 0.7 * head, flight);
  const tint = (at, height) => {
    const trunk = mixed(tones.breast, tones.back, ramp(height, -0.25, 0.5));
    return mixed(trunk, shaded(tones.head, 1 - 0.06 * height), ramp(at.was, front - 1.25 * head, front - 0.85 * head));
  };
  const parts = [loft(rings, tint, 16)];
  const nose = { x: front - 0.1 * head, z: 0.42 * neck };
  parts.push(...face(nose, { head, skull, bill, neck, front }, tones).map((part) => part.applyMatrix4(bend)));
  parts.push(...fan(shape.body, flight, { x: rear + 0.06 * length, z: 0.06 * depth }, tones));
  return parts;
}

// Rings from the bill over the breast to the rump. Lengths are those of the shape; how they swell between is drawn by eye.
function profile({ length, width, depth, head_length: head, bill_length: bill }, { front, rear, skull, neck }) {
  const ring = (x, z, wide, up, down = up) => ({ x, z, wide, up, down });
  const [nape, breast] = [front - 0.9 * head, Math.min(0.06 * length, front - 1.5 * head)];
  const throat = (share) => {
    // Between the back of the head and the breast; the neck widens late, the throat early.
    const mix = (one, two, way) => one + (two - one) * way;
    const way = (share * share * (3 - 2 * share)) ** 1.2;
    return ring(
      mix(nape, breast, share),
      mix(0.52 * neck, 0, share),
      mix(0.95 * skull, 0.5 * width, way),
      mix(0.98 * skull, 0.4 * depth, way),
      mix(1.0 * skull, 0.58 * depth, 0.5 * (way + share)),
    );
  };
  return [
    // Short feathers cover the base of the bill.
    ring(front + 0.14 * Math.min(bill, 0.5 * head), 0.36 * neck, 0.06 * skull, 0.06 * skull, 0.12 * skull),
    ring(front - 0.03 * head, 0.4 * neck, 0.44 * skull, 0.5 * skull, 0.46 * skull),
    ring(front - 0.2 * head, 0.5 * neck, 0.74 * skull, 0.86 * skull, 0.76 * skull),
    ring(front - 0.48 * head, 0.56 * neck, 0.94 * skull, 1.04 * skull, 0.95 * skull),
    ...[0, 0.25, 0.5, 0.75, 1].map(throat),
    ring(-0.1 * length, 0, 0.48 * width, 0.4 * depth, 0.56 * depth),
    ring(-0.26 * length, 0.02 * depth, 0.38 * width, 0.33 * depth, 0.4 * depth),
    ring(-0.4 * length, 0.05 * depth, 0.24 * width, 0.2 * depth, 0.24 * depth),
    ring(rear, 0.07 * depth, 0.12 * width, 0.07 * depth, 0.08 * depth),
  ];
}

// Birds hold their head level: turn head and neck against the mean pitch of the body. Returns the head's turn.
function levelled(rings, low, high, flight) {
  const turn = 0.85 * flight.mean("body_pitch");
  const hinge = rings.filter(({ x }) => x > low).at(-1);
  const about = { x: hinge.x, z: hinge.z };
  for (const ring of rings) {
    ring.was = ring.x;
    const [dx, dz] = [ring.x - about.x, ring.z - about.z];
    const angle = -turn * ramp(ring.x, low, high);
    ring.x = about.x + Math.cos(angle) * dx - Math.sin(angle) * dz;
    ring.z = about.z + Math.sin(angle) * dx + Math.cos(angle) * dz;
  }
  return new THREE.Matrix4()
    .makeTranslation(about.x, 0, about.z)
    .multiply(new THREE.Matrix4().makeRotationY(turn))
    .multiply(new THREE.Matrix4().makeTranslation(-about.x, 0, -about.z));
}

function face(nose, { head, skull, bill, neck, front }, tones) {
  const parts = [];
  if (bill > 0) {
    const thick = skull * Math.min(Math.max((0.3 * head) / bill, 0.13), 0.46);
    const reach = bill + 0.1 * head;
    const stations = [0, 0.12, 0.35, 0.65, 0.9, 1].map((s, i) => ({
      x: nose.x + reach * s,
      z: nose.z - 0.12 * skull - 0.25 * thick * s ** 2,
      wide: 0.8 * thick * [1, 0.95, 0.7, 0.45, 0.24, 0.02][i],
      up: thick * [1, 0.95, 0.75, 0.5, 0.26, 0.02][i],
      down: thick * [0.9, 0.8, 0.6, 0.42, 0.3, 0.02][i],
    })).reverse();
    parts.push(loft(smooth(stations, 8), (_, height) => shaded(tones.bill, 1 + 0.1 * height), 8));
  }
  const [dark, pale] = [colour("#15110e"), mixed(tones.head, colour("#ffffff"), 0.28)];
  for (const side of [1, -1]) {
    const at = [front - 0.4 * head, side * 0.84 * skull, 0.62 * neck + 0.22 * skull];
    const ball = (size, out, tone, ahead = 0, above = 0) =>
      painted(sphere(size * skull, [at[0] + ahead, at[1] + side * out, at[2] + above]), tone);
    parts.push(ball(0.25, -0.08 * skull, pale), ball(0.2, 0.005 * skull, dark));
    parts.push(ball(0.055, 0.15 * skull, colour("#ffffff"), 0.05 * skull, 0.1 * skull));
  }
  return parts;
}

function sphere(radius, at) {
  return new THREE.SphereGeometry(radius, 9, 6).translate(...at);
}

// The tail: feathers that fan from the rump. Its tilt is that of the vehicle's tail, where the model has one.
function fan({ tail_length: reach, tail_width: wide }, flight, root, tones) {
  if (!(reach > 0)) return [];
  const tilt = tailTilt(flight);
  const spread = Math.atan2(0.5 * wide, reach);
  const inside = 0.12 * reach;
  return steps(-1, 1, FEATHERS).map((turn) => {
    const angle = turn * spread;
    const long = (reach / Math.cos(spread * 0.6)) * (1 - 0.06 * turn * turn) + inside;
    const half = Math.max((0.75 * wide) / FEATHERS, 0.05 * reach);
    const path = (s) => [-Math.cos(angle) * long * s, Math.sin(angle) * long * s];
    const tint = (s) => mixed(tones.back, tones.wing_tip, 0.25 + 0.6 * ramp(s, 0.6, 1));
    // The middle feathers lie on top.
    const layer = 0.035 * wide * (1 - turn * turn);
    const lean = Math.abs(turn) < 0.2 ? 0 : -Math.sign(turn);
    const put = (s, here, off, up, tone) => ({ at: [here[0] + off[0], here[1] + off[1], layer + lean * up], tone });
    const rows = vane({ path, half: () => half, round: 0.16, tint, tilt: 0.1 }, put);
    const place = ([x, y, z]) => [
      root.x + Math.cos(tilt) * (x + inside) - Math.sin(tilt) * z,
      y,
      root.z + Math.sin(tilt) * (x + inside) + Math.cos(tilt) * z,
    ];
    return patch(
      rows.map((row) => row.map(({ at }) => place(at))),
      (i, j) => rows[Math.round(i * (rows.length - 1))][Math.round(j * (rows[0].length - 1))].tone,
    );
  });
}

// Slope of the vehicle's tail, from its root to the middle of its rear edge [rad]; 0 without a tail.
export function tailTilt({ tail }) {
  if (!tail) return 0;
  const [forward, up] = [tail[0] - 0.5 * (tail[3] + tail[6]), tail[2] - 0.5 * (tail[5] + tail[8])];
  return Math.atan2(up, forward);
}
