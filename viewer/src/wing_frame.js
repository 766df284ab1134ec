// The moving frame of a wing: from the corners of its strips, where a point of the wing is in space.

const AXES = 12; // numbers of one frame: point on the pitch axis, chord (forward), normal (up), span (to the tip)

// A frame at the root, at every strip's centre, at every joint and at the tip: the strip's own at its centre, the mean
// of both neighbours at a joint, so that the skin moves exactly as the strips do, also in a folded hand.
export class WingFrame {
  constructor(strips) {
    this.strips = strips;
    this.knots = new Float64Array((2 * strips + 1) * AXES);
  }

  // `corners`: of the left wing's strips, 12 numbers each.
  set(corners) {
    const { strips, knots } = this;
    knots.fill(0);
    for (let i = 0; i < strips; i++) {
      const weights = [i ? 0.5 : 1, 1, i < strips - 1 ? 0.5 : 1];
      const [chord, span] = [new Array(3), new Array(3)];
      for (let k = 0; k < 3; k++) {
        const [a, b, c, d] = [0, 3, 6, 9].map((corner) => corners[12 * i + corner + k]);
        const [inner, outer] = [0.75 * a + 0.25 * d, 0.75 * b + 0.25 * c];
        [inner, 0.5 * (inner + outer), outer].forEach((point, j) => {
          knots[(2 * i + j) * AXES + k] += weights[j] * point;
        });
        chord[k] = a + b - c - d;
        span[k] = outer - inner;
      }
      unit(chord);
      unit(span);
      const normal = cross(chord, span);
      for (let j = 0; j < 3; j++) {
        const at = (2 * i + j) * AXES;
        for (let k = 0; k < 3; k++) {
          knots[at + 3 + k] += chord[k];
          knots[at + 6 + k] += normal[k];
          knots[at + 9 + k] += span[k];
        }
      }
    }
    for (let knot = 0; knot <= 2 * strips; knot++) {
      for (const axis of [3, 6, 9]) unit(knots, knot * AXES + axis);
    }
  }

  // The frame at a span fraction, written into `out` from `at` on.
  read(eta, out, at = 0) {
    const place = Math.min(Math.max(eta, 0), 1) * 2 * this.strips;
    const low = Math.min(Math.floor(place + 1e-9), 2 * this.strips - 1);
    const share = place - low;
    for (let k = 0; k < AXES; k++) {
      const before = this.knots[low * AXES + k];
      out[at + k] = before + share * (this.knots[(low + 1) * AXES + k] - before);
    }
    for (const axis of [3, 6, 9]) unit(out, at + axis);
  }

  // Where a point is: span fraction, metres ahead of the pitch axis, metres along the normal.
  place(eta, ahead, up) {
    const frame = new Float64Array(AXES);
    this.read(eta, frame);
    return [0, 1, 2].map((k) => frame[k] + ahead * frame[3 + k] + up * frame[6 + k]);
  }
}

WingFrame.AXES = AXES;

function unit(values, at = 0) {
  const size = Math.hypot(values[at], values[at + 1], values[at + 2]) || 1;
  for (let k = at; k < at + 3; k++) values[k] /= size;
}

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
