// A sketch of the wake, not a computation: vortex ribbons leave the wing tips, and at both ends of the downstroke the
// trailing edge from tip to tip, and move with the induced velocity of the flight's air loads. Strong where the outer
// wing carries much, they close to rings in hover.

import * as THREE from "three";
import { outerForce, samples, tip, trailingEdge } from "./paths.js";
import { Ribbon } from "./ribbon.js";

const BEATS = 3;
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
      const points = trailingEdge(flight, sample);
      const instants = new Array(points.length / 3).fill(flight.phase[sample.k] + sample.shift.phase);
      const ribbon = { ...common, points, shed: instants, width: 0.12 * flight.semi_span, opacity: 0.45 * opacity };
      this.ribbons.push(new Ribbon(ribbon));
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

// Whether a downstroke begins or ends between this sample and the one before.
function reverses(flight, along, nth) {
  if (nth === 0) return false;
  const [before, here] = [along[nth - 1], along[nth]].map(({ k, shift }) => flight.phase[k] + shift.phase);
  // The end of a beat is the start of the next.
  const starts = [along[nth].shift.phase, along[nth].shift.phase + flight.last];
  const ends = flight.downstrokes.flat().flatMap((end) => (flight.periodic ? starts : [0]).map((start) => start + end));
  return ends.some((end) => before < end && end <= here);
}
