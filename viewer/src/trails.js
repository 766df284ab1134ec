// Paths of the body and of both wing tips through the last beat, in the world: ribbons that fade with age. Their
// colour is the force on the outer strips of the wing, over the largest of the flights shown.

import * as THREE from "three";
import { sequential } from "./colours.js";
import { body, outerForce, samples, tip } from "./paths.js";
import { Ribbon } from "./ribbon.js";

const BEATS = 1;

export class Trails {
  constructor(flight, opacity) {
    const along = samples(flight, 1);
    const shed = along.map(({ k, shift }) => flight.phase[k] + shift.phase);
    this.force = outerForce(flight);
    this.along = along;
    const common = { shed, life: BEATS, soft: 0.35 };
    const wings = [1, -1].map((side) => {
      const points = along.flatMap((sample) => tip(flight, sample, side));
      const shades = new Array(points.length).fill(0);
      return new Ribbon({ ...common, points, shades, width: 0.07 * flight.semi_span, spread: 0.3, opacity: 0.95 * opacity });
    });
    const points = along.flatMap((sample) => body(flight, sample));
    const path = new Ribbon({ ...common, points, width: 0.016 * flight.semi_span, spread: 1, opacity: 0.5 * opacity });
    [this.left, this.right, this.body] = [...wings, path];
    this.group = new THREE.Group();
    for (const ribbon of this.ribbons) this.group.add(ribbon.mesh);
  }

  get ribbons() {
    return [this.left, this.right, this.body];
  }

  // Colour the tips' ribbons: `most` is the force at the end of the scale [N].
  scale(most) {
    this.most = most;
    for (const ribbon of [this.left, this.right]) {
      const shade = ribbon.mesh.geometry.getAttribute("shade");
      this.along.forEach(({ k }, nth) => {
        const colour = sequential(most > 0 ? this.force[k] / most : 0);
        for (const vertex of [2 * nth, 2 * nth + 1]) shade.setXYZ(vertex, ...colour);
      });
      shade.needsUpdate = true;
    }
  }

  show(phase, most) {
    if (most !== this.most) this.scale(most);
    for (const ribbon of this.ribbons) ribbon.show(phase);
  }

  tint(ink) {
    this.body.tint(ink);
  }
}
