// Air loads as arrows from the quarter chord of every strip, both wings.

import * as THREE from "three";

export class Arrows {
  constructor(strips, colour, opacity) {
    this.strips = strips;
    const shaft = new THREE.CylinderGeometry(1, 1, 1, 8).translate(0, 0.5, 0);
    const head = new THREE.ConeGeometry(2.6, 1, 12).translate(0, 0.5, 0);
    const material = new THREE.MeshLambertMaterial({
      color: colour,
      emissive: colour,
      emissiveIntensity: 0.35,
      transparent: opacity < 1,
      opacity,
    });
    this.group = new THREE.Group();
    this.shafts = new THREE.InstancedMesh(shaft, material, 2 * strips);
    this.heads = new THREE.InstancedMesh(head, material, 2 * strips);
    this.group.add(this.shafts, this.heads);
    for (const part of this.group.children) part.frustumCulled = false;
  }

  // `vectors`: of the left wing [N]; `scale`: metres for one newton; `thickness`: of a shaft [m].
  show(vectors, corners, { scale, thickness }) {
    const [up, way, root, size, turn, matrix] = [
      new THREE.Vector3(0, 1, 0),
      new THREE.Vector3(),
      new THREE.Vector3(),
      new THREE.Vector3(),
      new THREE.Quaternion(),
      new THREE.Matrix4(),
    ];
    for (let i = 0; i < 2 * this.strips; i++) {
      const side = i < this.strips ? 1 : -1;
      const strip = i % this.strips;
      const [x, y, z] = [0, 1, 2].map((k) => {
        const at = 12 * strip + k;
        // Quarter chord, mid-strip.
        return 0.375 * (corners[at] + corners[at + 3]) + 0.125 * (corners[at + 6] + corners[at + 9]);
      });
      root.set(x, side * y, z);
      way.set(vectors[3 * strip], side * vectors[3 * strip + 1], vectors[3 * strip + 2]).multiplyScalar(scale);
      const length = way.length();
      const head = Math.min(8 * thickness, 0.5 * length);
      const thick = Math.min(thickness, 0.12 * length);
      turn.setFromUnitVectors(up, length > 0 ? way.divideScalar(length) : way.copy(up));
      this.shafts.setMatrixAt(i, matrix.compose(root, turn, size.set(thick, length - head, thick)));
      root.addScaledVector(way, length - head);
      this.heads.setMatrixAt(i, matrix.compose(root, turn, size.set(thick, head, thick)));
    }
    this.shafts.instanceMatrix.needsUpdate = this.heads.instanceMatrix.needsUpdate = true;
  }
}
