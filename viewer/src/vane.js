// One feather: a shaft with a vane on both sides.

import { shaded } from "./paint.js";

// As few points as a rounded tip needs: software draws every face.
const ALONG = [0, 0.25, 0.55, 0.78, 0.9, 0.97, 1];
const ACROSS = [-1, 0, 1];
const TILT = 0.07; // rise of the outer edge over half the width: it lies on the next feather outwards

// Share of the whole width that lies on the outer side of the shaft, which is the narrow one.
const OUTER = 0.375;

// Width of the outer vane at a share of the length [m].
export function outerVane(s, half, round) {
  return 2 * OUTER * breadth(s, half, round);
}

function breadth(s, half, round) {
  const blunt = s < 1 - round ? 1 : Math.sqrt(Math.max(1 - ((s - 1 + round) / round) ** 2, 0));
  return half(s) * (0.45 + 0.55 * Math.min(s / 0.3, 1)) * blunt;
}

// Rows of points from base to tip. `path(s)`: [forward, out] of the shaft in metres; `half(s)`: half the width [m];
// `round`: share of the length that the rounded tip takes; `put(s, forward, out, up, colour)` makes a point at an
// offset from the shaft; `tint(s)`: the colour. The tip of the shaft is the tip of the feather.
export function vane({ path, half, round = 0.22, along = ALONG, tint, tilt = TILT }, put) {
  return along.map((s) => {
    const [here, before, after] = [path(s), path(Math.max(s - 0.02, 0)), path(Math.min(s + 0.02, 1))];
    const [forward, out] = [after[0] - before[0], after[1] - before[1]];
    const length = Math.hypot(forward, out) || 1;
    const width = breadth(s, half, round);
    return ACROSS.map((q) => {
      const off = 2 * width * q * (q > 0 ? OUTER : 1 - OUTER);
      const shade = q === 0 ? 0.9 : q > 0 ? 0.84 : 1.06;
      return put(s, here, [(out / length) * off, (-forward / length) * off], tilt * q * width, shaded(tint(s), shade));
    });
  });
}
