// Both wings of an animal as one sees them: feathers, membrane or film over the frame that the strips give.

import * as THREE from "three";
import { feathers } from "./feathers.js";
import { film } from "./film.js";
import { membrane } from "./membrane.js";
import { surface } from "./paint.js";
import { Planform } from "./planform.js";
import { WingFrame } from "./wing_frame.js";
import { WingSkin } from "./wing_skin.js";

const COVERS = { feathers, membrane, film };
// Light passes through a bat's membrane and a robot's film.
const CLEAR = { feathers: 1, membrane: 0.93, film: 0.62 };
const FADED = 0.28; // of the skin where the strips are shown

export class Wings {
  constructor(flight, opacity) {
    const { cover } = flight.shape;
    this.frame = new WingFrame(flight.strips);
    this.planform = new Planform(flight.shape, flight.semi_span);
    this.group = new THREE.Group();
    const { sheet, bones } = COVERS[cover](this.planform);
    this.skins = [[sheet, CLEAR[cover]], [bones, 1]]
      .filter(([part]) => part)
      .map(([part, clear]) => ({ skin: new WingSkin(part, surface(clear * opacity)), opacity: clear * opacity }));
    for (const { skin } of this.skins) {
      for (const mesh of skin.meshes) mesh.castShadow = mesh.receiveShadow = opacity === 1;
      this.group.add(...skin.meshes);
    }
  }

  // `corners`: of the left wing's strips about the body's centre of mass; `pitch`: of the body, which holds the seams.
  show(corners, pitch) {
    this.frame.set(corners);
    for (const { skin } of this.skins) skin.show(this.frame, pitch);
  }

  // Fade the skin, so that the strips are seen through it.
  fade(faded) {
    if (faded === this.faded) return;
    this.faded = faded;
    for (const { skin, opacity } of this.skins) {
      for (const { material } of skin.meshes) {
        material.opacity = faded ? FADED * opacity : opacity;
        material.transparent = material.opacity < 1;
        material.depthWrite = !faded && opacity > 0.5;
        material.needsUpdate = true;
      }
    }
  }
}
