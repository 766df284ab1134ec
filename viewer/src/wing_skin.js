// A wing's skin: a mesh for each side whose points are fixed in the moving frame of the wing.

import * as THREE from "three";
import { WingFrame } from "./wing_frame.js";

const { AXES } = WingFrame;

// Collects the points and faces of a left wing. A point is a span fraction, metres ahead of the pitch axis, metres along
// the normal, and metres along the span, which keep their size when the wing retracts.
export class Sheet {
  constructor() {
    this.stations = [];
    this.known = new Map();
    this.points = []; // station, ahead, up, out
    this.colours = [];
    this.index = [];
    this.seams = []; // points held by the body: number of the point, and its place in body axes
  }

  add(eta, ahead, up, out, colour) {
    const key = Math.round(1e5 * eta);
    if (!this.known.has(key)) {
      this.known.set(key, this.stations.length);
      this.stations.push(eta);
    }
    this.points.push(this.known.get(key), ahead, up, out);
    this.colours.push(colour.r, colour.g, colour.b);
    return this.points.length / 4 - 1;
  }

  hold(point, place) {
    this.seams.push({ point, place });
  }

  // Faces of a grid whose rows are lists of points. Faces look up where rows go outwards and columns go forward.
  grid(rows) {
    for (let i = 1; i < rows.length; i++) {
      for (let j = 1; j < rows[i].length; j++) {
        const [a, b, c, d] = [rows[i - 1][j - 1], rows[i][j - 1], rows[i][j], rows[i - 1][j]];
        this.index.push(a, d, c, a, c, b);
      }
    }
  }
}

export class WingSkin {
  constructor(sheet, look) {
    this.sheet = sheet;
    const count = sheet.points.length / 4;
    this.points = Float64Array.from(sheet.points);
    this.frames = new Float64Array(sheet.stations.length * AXES);
    this.meshes = [1, -1].map((side) => {
      const geometry = new THREE.BufferGeometry();
      for (const name of ["position", "normal"]) {
        geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(3 * count), 3));
      }
      geometry.setAttribute("color", new THREE.Float32BufferAttribute(sheet.colours, 3));
      // Mirrored faces run the other way round: turned back, both wings show the same face upwards.
      const index = side > 0 ? sheet.index : sheet.index.map((_, i, all) => all[i - (i % 3) + ((3 - (i % 3)) % 3)]);
      geometry.setIndex(index);
      const mesh = new THREE.Mesh(geometry, look);
      mesh.frustumCulled = false;
      return mesh;
    });
  }

  show(frame, pitch) {
    const { sheet, points, frames } = this;
    const [left, right] = this.meshes.map(({ geometry }) => geometry.attributes);
    const place = left.position.array;
    sheet.stations.forEach((eta, i) => frame.read(eta, frames, i * AXES));
    for (let i = 0, k = 0; i < points.length; i += 4, k += 3) {
      const at = points[i] * AXES;
      for (let j = 0; j < 3; j++) {
        place[k + j] =
          frames[at + j] +
          points[i + 1] * frames[at + 3 + j] +
          points[i + 2] * frames[at + 6 + j] +
          points[i + 3] * frames[at + 9 + j];
      }
    }
    const [cos, sin] = [Math.cos(pitch), Math.sin(pitch)];
    for (const { point, place: [x, y, z] } of sheet.seams) {
      place.set([cos * x - sin * z, y, sin * x + cos * z], 3 * point);
    }
    normals(place, sheet.index, left.normal.array);
    for (const name of ["position", "normal"]) {
      right[name].array.set(left[name].array);
      for (let i = 1; i < right[name].array.length; i += 3) right[name].array[i] *= -1;
      left[name].needsUpdate = right[name].needsUpdate = true;
    }
  }
}

// Normals of points, means of their faces' weighted by area.
function normals(place, index, out) {
  out.fill(0);
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [3 * index[i], 3 * index[i + 1], 3 * index[i + 2]];
    const [ux, uy, uz] = [place[b] - place[a], place[b + 1] - place[a + 1], place[b + 2] - place[a + 2]];
    const [vx, vy, vz] = [place[c] - place[a], place[c + 1] - place[a + 1], place[c + 2] - place[a + 2]];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const point of [a, b, c]) {
      out[point] += x;
      out[point + 1] += y;
      out[point + 2] += z;
    }
  }
  for (let i = 0; i < out.length; i += 3) {
    const size = Math.hypot(out[i], out[i + 1], out[i + 2]) || 1;
    out[i] /= size;
    out[i + 1] /= size;
    out[i + 2] /= size;
  }
}
