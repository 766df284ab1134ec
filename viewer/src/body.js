// The body and the tail, which turn together: body axes, x forward, y left, z up.

import * as THREE from "three";

export class Body {
  constructor(flight, opacity) {
    const [length, width] = flight.body_axes.map((half) => 2 * half);
    const material = new THREE.MeshLambertMaterial({
      color: "#9aa0a8",
      transparent: opacity < 1,
      opacity,
      depthWrite: opacity === 1,
    });
    this.group = new THREE.Group();
    const trunk = new THREE.Mesh(new THREE.SphereGeometry(0.5, 32, 20).scale(length, width, width), material);
    const beak = new THREE.Mesh(new THREE.ConeGeometry(0.16 * width, 0.35 * width, 16).rotateZ(-Math.PI / 2), material);
    beak.position.x = 0.5 * length + 0.08 * width;
    this.group.add(trunk, beak);
    if (flight.tail) this.group.add(this.makeTail(flight.tail, material));
  }

  // A triangle in body axes: root, left and right corner.
  makeTail(corners, look) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(corners, 3));
    geometry.setIndex([0, 1, 2]);
    geometry.computeVertexNormals();
    const material = look.clone();
    material.side = THREE.DoubleSide;
    return new THREE.Mesh(geometry, material);
  }

  show(pitch) {
    this.group.rotation.y = -pitch;
  }
}
