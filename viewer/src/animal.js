// One flying animal: body and wings, and over them strips, trails and forces. World axes: x forward, y left, z up.

import * as THREE from "three";
import { Arrows } from "./arrows.js";
import { Body } from "./body.js";
import { ARROWS, themeOf } from "./colours.js";
import { Strips } from "./strips.js";
import { Trails } from "./trails.js";
import { Wake } from "./wake.js";
import { Wings } from "./wings.js";

const SIDES = { left: 1, right: -1 };

export class Animal {
  constructor(flight, opacity) {
    this.opacity = opacity;
    this.group = new THREE.Group();
    this.still = new THREE.Group(); // what is placed relative to the body's centre of mass
    this.group.add(this.still);
    this.strips = Object.fromEntries(
      Object.entries(SIDES).map(([name, side]) => [name, new Strips(flight.strips, side, opacity)]),
    );
    this.arrows = Object.fromEntries(
      Object.entries(ARROWS).map(([name, colour]) => [name, new Arrows(flight.strips, colour, opacity)]),
    );
    this.wings = new Wings(flight, opacity);
    this.still.add(this.wings.group, ...Object.values(this.strips).map((wing) => wing.mesh));
    this.still.add(...Object.values(this.arrows).map((each) => each.group));
    this.buffers = {
      corners: new Float64Array(flight.strips * 12),
      vectors: new Float64Array(flight.strips * 3),
      tint: new Float64Array(flight.strips),
    };
    this.fly(flight);
  }

  // Whether a flight is one of this animal, to be drawn with this opacity.
  suits(flight, opacity) {
    const looks = ({ strips, semi_span: span, shape }) => JSON.stringify([strips, span, shape]);
    return opacity === this.opacity && looks(flight) === looks(this.flight);
  }

  // Fly another flight: make anew what depends on it, and keep the wings. Returns the parts that are used no more.
  fly(flight) {
    const used = new THREE.Group();
    if (this.flight) used.add(this.body.group, this.trails.group, this.wake.group);
    this.flight = flight;
    this.body = new Body(flight, this.opacity);
    this.trails = new Trails(flight, this.opacity);
    this.wake = new Wake(flight, this.opacity);
    this.still.add(this.body.group);
    this.group.add(this.trails.group, this.wake.group);
    return used;
  }

  // Draw the animal at a phase. `look`: whether strips and which colours, which arrows, their scale, whether trails and wake.
  show(phase, look) {
    const { flight, buffers } = this;
    const place = flight.locate(phase);
    const [pivotX, pivotZ] = flight.pivot(phase, place);
    this.group.position.set(-pivotX, look.offset, -pivotZ);
    this.still.position.set(flight.number("x", place), 0, flight.number("z", place));
    const pitch = flight.number("body_pitch", place);
    this.body.show(pitch);
    flight.read("corners", place, buffers.corners);
    this.wings.show(buffers.corners, pitch);
    this.wings.fade(look.strips);
    flight.read(look.colour, place, buffers.tint);
    for (const wing of Object.values(this.strips)) {
      wing.show(buffers.corners, buffers.tint, look.range);
      wing.mesh.visible = look.strips;
    }
    for (const [name, arrows] of Object.entries(this.arrows)) {
      arrows.group.visible = look.arrows.has(name) && name in flight.arrays;
      if (arrows.group.visible) arrows.show(flight.read(name, place, buffers.vectors), buffers.corners, look);
    }
    this.trails.group.visible = look.trails;
    if (look.trails) this.trails.show(phase, look.tipForce);
    this.wake.group.visible = look.wake;
    if (look.wake) this.wake.show(phase, look.floor);
  }

  tint(ink) {
    for (const wing of Object.values(this.strips)) wing.edges.material.color.set(ink);
    this.trails.tint(ink);
    this.wake.tint(themeOf(ink));
  }

  // What is drawn of one wing's strips, in the world of its data: corners and normals of every strip.
  drawn(side) {
    const { geometry } = this.strips[side].mesh;
    const at = this.still.position;
    const corners = Array.from(geometry.getAttribute("position").array, (value, i) => value + [at.x, at.y, at.z][i % 3]);
    return { corners, normals: Array.from(geometry.getAttribute("normal").array) };
  }

  // Points of the left wing's skin in the world of its data, from [span fraction, metres ahead of the pitch axis].
  skinPoints(points) {
    const at = this.still.position.toArray();
    return points.map(([eta, ahead]) => this.wings.frame.place(eta, ahead, 0).map((value, k) => value + at[k]));
  }

}

// Free what the graphics hold of a group.
export function dispose(group) {
  group.traverse((node) => {
    node.dispose?.(); // of instanced meshes
    node.geometry?.dispose();
    node.material?.dispose();
  });
}
