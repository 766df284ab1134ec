// The body and the tail, which turn together: body axes, x forward, y left, z up.

import * as THREE from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { batBody } from "./bat_body.js";
import { birdBody } from "./bird_body.js";
import { surface } from "./paint.js";
import { robotBody } from "./robot_body.js";
import { CASTS } from "./shadow.js";

const MAKERS = { bird: birdBody, bat: batBody, robot: robotBody };

export class Body {
  constructor(flight, opacity) {
    this.group = new THREE.Group();
    // One mesh: every mesh more costs time in every picture.
    const parts = MAKERS[flight.shape.kind](flight.shape, flight);
    const mesh = new THREE.Mesh(mergeGeometries(parts), surface(opacity));
    if (opacity === 1) mesh.layers.enable(CASTS);
    this.group.add(mesh);
  }

  show(pitch) {
    this.group.rotation.y = -pitch;
  }
}
