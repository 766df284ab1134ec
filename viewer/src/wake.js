// A sketch of the wake, not a computation: vortex ribbons leave the wing tips, and at both ends of the downstroke one
// leaves the wings from tip to tip. They move with the induced velocity of the flight's air loads and are strong where
// the outer wing carries much; in hover they close to rings.

import * as THREE from "three";
import { body, outerForce, quarterChord, samples, tip } from "./paths.js";
import { Ribbon } from "./ribbon.js";

const BEATS = 3;
const POINTS = 33; // of a ribbon from tip to tip
const TONES = { light: "#1f6fb2", dark: "#a8d4ff" };

export class Wake {
  constructor(flight, opacity) {
    this.group = new THREE.Group();
    this.ribbons = [];
    if (!flight.wake) return;
    const [forward, up] = flight.wake.induced.map((speed) => speed / flight.frequency);
    const along = samples(flight, BEATS);
    const shed = along.map(({ k, shift }) => flight.phase[k] + shift.phase);
    const force = outerForce(flight);
    const most = Math.max(...force, 1e-12);
    const common = { life: BEATS, drift: [forward, 0, up], spread: 2.2, soft: 1, opacity: 0.85 * opacity };
    const strengths = along.map(({ k }) => force[k] / most);
    for (const side of [1, -1]) {
      const points = along.flatMap((sample) => tip(flight, sample, side));
      this.ribbons.push(new Ribbon({ ...common, points, shed, strengths, width: 0.16 * flight.semi_span }));
    }
    for (const sample of along.filter((_, nth) => reverses(flight, along, nth))) {
      const points = fromTipToTip(flight, sample);
      const instants = new Array(POINTS).fill(flight.phase[sample.k] + sample.shift.phase);
      const faint = instants.map((_, nth) => {
        const fromEnd = Math.min(nth, POINTS - 1 - nth);
        return Math.min(fromEnd / 3, 1) * (0.75 - (1.2 * fromEnd) / (POINTS - 1));
      });
      const width = 0.12 * flight.semi_span;
      this.ribbons.push(new Ribbon({ ...common, points, shed: instants, strengths: faint, width }));
    }
    for (const ribbon of this.ribbons) this.group.add(ribbon.mesh);
  }

  show(phase, floor) {
    for (const ribbon of this.ribbons) ribbon.show(phase, floor);
  }

  tint(theme) {
    for (const ribbon of this.ribbons) ribbon.tint(TONES[theme]);
  }
}

// A smooth line along both wings, faint in the middle, flat [m].
function fromTipToTip(flight, sample) {
  const half = (side) => [1, 0.75, 0.5].map((fraction) => quarterChord(flight, sample, fraction, side));
  const knots = [...half(1), body(flight, sample), ...half(-1).reverse()];
  const curve = new THREE.CatmullRomCurve3(knots.map((knot) => new THREE.Vector3(...knot)));
  return curve.getPoints(POINTS - 1).flatMap((point) => point.toArray());
}

// Whether a downstroke begins or ends between this sample and the one before.
function reverses(flight, along, nth) {
  if (nth === 0) return false;
  const [before, here] = [along[nth - 1], along[nth]].map(({ k, shift }) => flight.phase[k] + shift.phase);
  // The end of a beat is the start of the next.
  const starts = [along[nth].shift.phase, along[nth].shift.phase + flight.last];
  const ends = flight.downstrokes.flat().flatMap((end) => (flight.periodic ? starts : [0]).map((start) => start + end));
  return ends.some((end) => before < end && end <= here);
}
