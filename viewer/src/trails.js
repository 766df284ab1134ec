// Paths of the body and of both wing tips through the last beat, in the world.

import * as THREE from "three";

const BEATS = 1;

export class Trails {
  constructor(flight, opacity) {
    this.flight = flight;
    const { x, z, corners } = flight.arrays;
    const step = flight.strips * 12;
    const tip = step - 12;
    const paths = [[], [], []];
    const before = flight.periodic ? 1 : 0;
    const end = flight.samples - 1;
    for (let beat = -before; beat <= 0; beat++) {
      for (let k = 0; k < flight.samples; k++) {
        const [px, pz] = [x[k] + beat * (x[end] - x[0]), z[k] + beat * (z[end] - z[0])];
        // The quarter chord at the tip: from leading-outer to trailing-outer.
        const at = [0, 1, 2].map((i) => {
          const [lead, trail] = [corners[k * step + tip + 3 + i], corners[k * step + tip + 6 + i]];
          return lead + 0.25 * (trail - lead);
        });
        paths[0].push(px, 0, pz);
        paths[1].push(px + at[0], at[1], pz + at[2]);
        paths[2].push(px + at[0], -at[1], pz + at[2]);
      }
    }
    this.group = new THREE.Group();
    for (const path of paths) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.Float32BufferAttribute(path, 3));
      const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ transparent: true, opacity: 0.55 * opacity }));
      line.frustumCulled = false;
      this.group.add(line);
    }
  }

  show(phase, place) {
    const { flight } = this;
    const first = flight.periodic ? flight.samples : 0;
    const until = first + place.low + 1;
    const back = flight.locate(Math.max(phase - BEATS, 0)).low;
    const from = flight.periodic ? place.low + 1 : back;
    for (const line of this.group.children) line.geometry.setDrawRange(from, Math.max(until - from, 0));
  }

  tint(ink) {
    for (const line of this.group.children) line.material.color.set(ink);
  }
}
