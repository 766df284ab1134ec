// The strips of one wing as the model has them: four corners each, coloured by a quantity.

import * as THREE from "three";
import { diverging } from "./colours.js";

export class Strips {
  constructor(count, side, opacity) {
    this.side = side;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(count * 12), 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(count * 12), 3));
    const index = [];
    const outline = [];
    for (let i = 0; i < count; i++) {
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
    const material = new THREE.MeshLambertMaterial({
      vertexColors: true,
      side: THREE.DoubleSide,
      transparent: !solid,
      opacity,
      depthWrite: solid,
    });
    this.edges = new THREE.LineSegments(edges, new THREE.LineBasicMaterial({ transparent: true, opacity: 0.45 * opacity }));
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.add(this.edges);
    this.mesh.frustumCulled = this.edges.frustumCulled = false;
  }

  // `corners`: of the left wing's strips, about the body's centre of mass; `tint`: the quantity, one value a strip.
  show(corners, tint, range) {
    const { geometry } = this.mesh;
    const position = geometry.getAttribute("position");
    const colour = geometry.getAttribute("color");
    for (let i = 0; i < corners.length; i += 3) {
      position.array[i] = corners[i];
      position.array[i + 1] = this.side * corners[i + 1];
      position.array[i + 2] = corners[i + 2];
    }
    const shade = new THREE.Color();
    for (let strip = 0; strip < tint.length; strip++) {
      shade.setRGB(...diverging(tint[strip], range), THREE.SRGBColorSpace);
      for (let corner = 0; corner < 4; corner++) shade.toArray(colour.array, 12 * strip + 3 * corner);
    }
    position.needsUpdate = colour.needsUpdate = true;
    geometry.computeVertexNormals();
  }
}
