// The push in a link: the name of the one that is shown, and one that is to be shown once the page has its flight.

export class LinkedPush {
  // `face`: the explorer whose viewer shows pushes.
  constructor(face) {
    this.face = face;
    this.wanted = "";
  }

  // What a link says now; empty without a push.
  get name() {
    return this.wanted || (this.face.viewer?.pushes.name ?? "");
  }

  // Show this push with the next answer.
  want(name) {
    this.wanted = name;
  }

  // An answer stands on the page. Its gusts are asked for if they are missing; a flight that has none is shown without.
  heard() {
    const { answer, viewer } = this.face;
    if (!this.wanted || !answer || answer.provisional) return;
    if (!viewer || !this.face.isPushed(answer)) this.wanted = "";
    else if (!answer.scene.pushes) this.face.onpush();
    else {
      const { wanted } = this;
      this.wanted = "";
      viewer.pushes.open(wanted);
      this.face.onpushed();
    }
  }
}
