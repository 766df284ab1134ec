// One flying animal: body, both wings as strips, trails and the forces on every strip. World axes: x forward, y left, z up.

import * as THREE from "three";
import { ARROWS, diverging } from "./colours.js";

const SIDES = { left: 1, right: -1 };
const TRAIL = 1; // beats

function wing(strips, side, opacity) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(strips * 12), 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(strips * 12), 3));
  const index = [];
  const outline = [];
  for (let i = 0; i < strips; i++) {
    const [a, b, c, d] = [0, 1, 2, 3].map((corner) => 4 * i + corner);
    // Mirrored corners run the other way round: turned back, both wings show the same face upwards.
    index.push(...(side > 0 ? [a, b, c, a, c, d] : [a, c, b, a, d, c]));
    outline.push(a, b, b, c, c, d, d, a);
  }
  geometry.setIndex(index);
  const edges = new THREE.BufferGeometry();
  edges.setAttribute("position", geometry.getAttribute("position"));
  edges.setIndex(outline);
  const solid = opacity === 1;
  const mesh = new THREE.Mesh(
    geometry,
    new THREE.MeshLambertMaterial({
      vertexColors: true,
      side: THREE.DoubleSide,
      transparent: !solid,
      opacity,
      depthWrite: solid,
    }),
  );
  mesh.add(new THREE.LineSegments(edges, new THREE.LineBasicMaterial({ transparent: true, opacity: 0.45 * opacity })));
  mesh.frustumCulled = mesh.children[0].frustumCulled = false;
  return mesh;
}

function arrows(count, colour, opacity) {
  const shaft = new THREE.CylinderGeometry(1, 1, 1, 8).translate(0, 0.5, 0);
  const head = new THREE.ConeGeometry(2.6, 1, 12).translate(0, 0.5, 0);
  const material = new THREE.MeshLambertMaterial({
    color: colour,
    emissive: colour,
    emissiveIntensity: 0.35,
    transparent: opacity < 1,
    opacity,
  });
  const group = new THREE.Group();
  group.add(new THREE.InstancedMesh(shaft, material, count), new THREE.InstancedMesh(head, material, count));
  for (const part of group.children) part.frustumCulled = false;
  return group;
}

export class Animal {
  constructor(flight, opacity) {
    this.flight = flight;
    this.group = new THREE.Group();
    this.still = new THREE.Group(); // what is placed relative to the body's centre of mass
    this.group.add(this.still);
    this.wings = {};
    for (const [name, side] of Object.entries(SIDES)) {
      this.wings[name] = wing(flight.strips, side, opacity);
      this.still.add(this.wings[name]);
    }
    this.body = this.makeBody(opacity);
    this.arrows = {};
    for (const [name, colour] of Object.entries(ARROWS)) {
      this.arrows[name] = arrows(2 * flight.strips, colour, opacity);
      this.still.add(this.arrows[name]);
    }
    this.trails = this.makeTrails(opacity);
    this.buffers = {
      corners: new Float64Array(flight.strips * 12),
      vectors: new Float64Array(flight.strips * 3),
      tint: new Float64Array(flight.strips),
    };
  }

  makeBody(opacity) {
    const [length, width] = this.flight.body_axes.map((half) => 2 * half);
    const material = new THREE.MeshLambertMaterial({
      color: "#9aa0a8",
      transparent: opacity < 1,
      opacity,
      depthWrite: opacity === 1,
    });
    const body = new THREE.Group();
    const trunk = new THREE.Mesh(new THREE.SphereGeometry(0.5, 32, 20).scale(length, width, width), material);
    const beak = new THREE.Mesh(new THREE.ConeGeometry(0.16 * width, 0.35 * width, 16).rotateZ(-Math.PI / 2), material);
    beak.position.x = 0.5 * length + 0.08 * width;
    body.add(trunk, beak);
    if (this.flight.tail) body.add(this.makeTail(material));
    this.still.add(body);
    return body;
  }

  // A triangle in body axes: root, left and right corner; it turns with the body.
  makeTail(look) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(this.flight.tail, 3));
    geometry.setIndex([0, 1, 2]);
    geometry.computeVertexNormals();
    const material = look.clone();
    material.side = THREE.DoubleSide;
    return new THREE.Mesh(geometry, material);
  }

  // Paths of the body and of both wing tips through the last beat, in the world.
  makeTrails(opacity) {
    const { flight } = this;
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
    const trails = new THREE.Group();
    for (const path of paths) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.Float32BufferAttribute(path, 3));
      const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ transparent: true, opacity: 0.55 * opacity }));
      line.frustumCulled = false;
      trails.add(line);
    }
    this.group.add(trails);
    return trails;
  }

  // Draw the animal at a phase. `look`: which colours, which arrows, their scale, whether trails.
  show(phase, look) {
    const { flight, buffers } = this;
    const place = flight.locate(phase);
    const [pivotX, pivotZ] = flight.pivot(phase, place);
    this.group.position.set(-pivotX, look.offset, -pivotZ);
    this.still.position.set(flight.number("x", place), 0, flight.number("z", place));
    this.body.rotation.y = -flight.number("body_pitch", place);
    flight.read("corners", place, buffers.corners);
    flight.read(look.colour, place, buffers.tint);
    for (const [name, side] of Object.entries(SIDES)) this.showWing(this.wings[name], side, look.range);
    for (const [name, group] of Object.entries(this.arrows)) {
      group.visible = look.arrows.has(name) && name in flight.arrays;
      if (group.visible) this.showArrows(group, flight.read(name, place, buffers.vectors), look);
    }
    this.trails.visible = look.trails;
    if (look.trails) this.showTrails(phase, place);
  }

  showWing(mesh, side, range) {
    const position = mesh.geometry.getAttribute("position");
    const colour = mesh.geometry.getAttribute("color");
    const { corners, tint } = this.buffers;
    for (let i = 0; i < corners.length; i += 3) {
      position.array[i] = corners[i];
      position.array[i + 1] = side * corners[i + 1];
      position.array[i + 2] = corners[i + 2];
    }
    const shade = new THREE.Color();
    for (let strip = 0; strip < tint.length; strip++) {
      shade.setRGB(...diverging(tint[strip], range), THREE.SRGBColorSpace);
      for (let corner = 0; corner < 4; corner++) shade.toArray(colour.array, 12 * strip + 3 * corner);
    }
    position.needsUpdate = colour.needsUpdate = true;
    mesh.geometry.computeVertexNormals();
  }

  showArrows(group, vectors, look) {
    const [shafts, heads] = group.children;
    const [up, way, root, size, turn, matrix] = [
      new THREE.Vector3(0, 1, 0),
      new THREE.Vector3(),
      new THREE.Vector3(),
      new THREE.Vector3(),
      new THREE.Quaternion(),
      new THREE.Matrix4(),
    ];
    const { strips } = this.flight;
    const { corners } = this.buffers;
    for (let i = 0; i < 2 * strips; i++) {
      const side = i < strips ? 1 : -1;
      const strip = i % strips;
      const [x, y, z] = [0, 1, 2].map((k) => {
        const at = 12 * strip + k;
        // Quarter chord, mid-strip.
        return 0.375 * (corners[at] + corners[at + 3]) + 0.125 * (corners[at + 6] + corners[at + 9]);
      });
      root.set(x, side * y, z);
      way.set(vectors[3 * strip], side * vectors[3 * strip + 1], vectors[3 * strip + 2]).multiplyScalar(look.scale);
      const length = way.length();
      const head = Math.min(8 * look.thickness, 0.5 * length);
      const thick = Math.min(look.thickness, 0.12 * length);
      turn.setFromUnitVectors(up, length > 0 ? way.divideScalar(length) : way.copy(up));
      shafts.setMatrixAt(i, matrix.compose(root, turn, size.set(thick, length - head, thick)));
      root.addScaledVector(way, length - head);
      heads.setMatrixAt(i, matrix.compose(root, turn, size.set(thick, head, thick)));
    }
    shafts.instanceMatrix.needsUpdate = heads.instanceMatrix.needsUpdate = true;
  }

  showTrails(phase, place) {
    const { flight } = this;
    const first = flight.periodic ? flight.samples : 0;
    const until = first + place.low + 1;
    const back = flight.locate(Math.max(phase - TRAIL, 0)).low;
    const from = flight.periodic ? place.low + 1 : back;
    for (const line of this.trails.children) line.geometry.setDrawRange(from, Math.max(until - from, 0));
  }

  tint(ink) {
    for (const mesh of Object.values(this.wings)) mesh.children[0].material.color.set(ink);
    for (const line of this.trails.children) line.material.color.set(ink);
  }

  // What is drawn of one wing, in the world of its data: corners and normals of every strip.
  drawn(side) {
    const mesh = this.wings[side];
    const at = this.still.position;
    const position = mesh.geometry.getAttribute("position").array;
    const corners = Array.from(position, (value, i) => value + [at.x, at.y, at.z][i % 3]);
    return { corners, normals: Array.from(mesh.geometry.getAttribute("normal").array) };
  }

  dispose() {
    this.group.traverse((node) => {
      node.geometry?.dispose();
      node.material?.dispose();
    });
  }
}
