// Moving pictures for elsewhere, made in the browser: one beat as a GIF, or as a video where the browser records them.
/*! GIFs are written by gifenc 1.0.3, copyright 2017 Matt DesLauriers, MIT license */

import { applyPalette, GIFEncoder, quantize } from "gifenc";

const [MOST_FRAMES, FEWEST_FRAMES] = [48, 12];
const SHORTEST_FRAME = 20; // ms; viewers of GIFs show shorter ones slowly
const SHORTEST_VIDEO = 2; // s
const VIDEOS = [
  { type: "video/mp4;codecs=avc1.42E01F", ending: "mp4", name: "MP4" },
  { type: "video/webm;codecs=vp9", ending: "webm", name: "WebM" },
  { type: "video/webm", ending: "webm", name: "WebM" },
];

// The kinds of video that this browser records; none without MediaRecorder.
export function videos() {
  const able = VIDEOS.filter(
    ({ type }) => window.MediaRecorder?.isTypeSupported(type) && HTMLCanvasElement.prototype.captureStream,
  );
  return able.filter(({ ending }, nth) => able.findIndex((other) => other.ending === ending) === nth);
}

// The words that stand in an element, with the boxes of the page that they fill.
function words(element) {
  const found = [];
  const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
  const range = document.createRange();
  while (walker.nextNode()) {
    const { currentNode: node } = walker;
    for (const { 0: word, index } of node.textContent.matchAll(/\S+/g)) {
      range.setStart(node, index);
      range.setEnd(node, index + word.length);
      const box = range.getBoundingClientRect();
      if (box.width) found.push([word, box]);
    }
  }
  return found;
}

// A canvas of a width in pixels, on which the viewer's picture is painted with its texts.
class Film {
  constructor(viewer, width) {
    this.viewer = viewer;
    const { clientWidth, clientHeight } = viewer.picture;
    this.ratio = width / clientWidth;
    this.canvas = document.createElement("canvas");
    this.canvas.width = width;
    this.canvas.height = 2 * Math.round((0.5 * width * clientHeight) / clientWidth); // videos want even numbers
    this.pen = this.canvas.getContext("2d", { willReadFrequently: true });
    this.before = { phase: viewer.phase, playing: viewer.playing };
    viewer.pause();
    const { renderer, camera } = viewer.stage;
    renderer.setPixelRatio(1);
    renderer.setSize(width, this.canvas.height, false);
    camera.aspect = width / this.canvas.height;
    camera.updateProjectionMatrix();
  }

  paint(phase) {
    const { viewer, pen, canvas } = this;
    const { stage } = viewer;
    viewer.set(phase);
    stage.render(); // at once: the drawing is gone after this task
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = getComputedStyle(viewer.root).backgroundColor;
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.drawImage(viewer.canvas, 0, 0, canvas.width, canvas.height);
    this.write();
  }

  // The texts and legends that the page lays over the picture, in the same corners, and the phase.
  write() {
    const { viewer, pen, canvas } = this;
    const { color, backgroundColor } = getComputedStyle(viewer.root);
    pen.fillStyle = pen.strokeStyle = color;
    pen.shadowColor = backgroundColor; // as in the page, a soft edge makes texts legible over the picture
    pen.shadowBlur = 3;
    this.writePart(viewer.heading, 0, 0);
    this.writePart(viewer.legend, 0, 1);
    this.writePart(viewer.measures.element, 1, 1);
    pen.font = `${13 * this.enlarged}px system-ui, sans-serif`;
    pen.textBaseline = "middle";
    pen.textAlign = "center";
    pen.fillText(viewer.readout.textContent, 0.5 * canvas.width, canvas.height - 18 * this.enlarged);
    pen.textAlign = "left";
    pen.shadowBlur = 0;
  }

  // Texts are not made smaller than three quarters: they would be illegible.
  get enlarged() {
    return Math.max(this.ratio, 0.75);
  }

  // One part, which keeps its distance to a corner of the picture: `right` and `foot` are 0 or 1.
  writePart(part, right, foot) {
    const { viewer, pen, canvas, enlarged } = this;
    const frame = viewer.picture.getBoundingClientRect();
    const corner = [right ? frame.right : frame.left, foot ? frame.bottom : frame.top];
    const place = (box) => [
      right * canvas.width + (box.left - corner[0]) * enlarged,
      foot * canvas.height + (box.top - corner[1]) * enlarged,
      box.width * enlarged,
      box.height * enlarged,
    ];
    for (const scale of part.querySelectorAll(".wb-gradient")) {
      const [left, top, width, height] = place(scale.getBoundingClientRect());
      const colours = pen.createLinearGradient(left, 0, left + width, 0);
      const stops = getComputedStyle(scale).backgroundImage.match(/rgba?\([^)]*\)/g);
      stops.forEach((stop, nth) => colours.addColorStop(nth / (stops.length - 1), stop));
      pen.fillStyle = colours;
      pen.fillRect(left, top, width, height);
      pen.fillStyle = pen.strokeStyle;
    }
    for (const bar of part.querySelectorAll(".wb-bar-line"))
      this.bracket(place(bar.getBoundingClientRect()), bar.clientWidth);
    for (const [word, box] of words(part)) {
      const [left, top, , height] = place(box);
      pen.font = `${parseFloat(getComputedStyle(part).fontSize) * enlarged}px system-ui, sans-serif`;
      pen.textBaseline = "middle";
      pen.fillText(word, left, top + 0.5 * height);
    }
  }

  // The scale of the arrows, which the picture makes smaller even where its texts are not.
  bracket([left, top, width, height], pixels) {
    const { pen, enlarged } = this;
    if (!width) return;
    const start = left + width - pixels * this.ratio;
    pen.lineWidth = 2 * enlarged;
    pen.beginPath();
    pen.moveTo(start, top);
    pen.lineTo(start, top + height);
    pen.lineTo(left + width, top + height);
    pen.lineTo(left + width, top);
    pen.stroke();
  }

  // Put the viewer back as it was.
  end() {
    if (!this.viewer.root.isConnected) return;
    this.viewer.resize();
    this.viewer.set(this.before.phase);
    if (this.before.playing) this.viewer.play();
  }
}

// First and last phase of the beat that is shown now, and how long the viewer takes for it [s].
function beat({ phase, last, rate, flights }) {
  const from = Math.max(Math.min(Math.floor(phase), last - 1), 0);
  const to = Math.min(from + 1, last);
  return { from, to, seconds: (to - from) / (flights[0].frequency * rate) };
}

const pause = () => new Promise((done) => setTimeout(done));

// `progress(share)` is called after every frame; `signal`: of an AbortController. Returns a Blob, its frames and size.
export async function gif(viewer, width, progress, signal) {
  const { from, to, seconds } = beat(viewer);
  const frames = Math.max(Math.min(MOST_FRAMES, Math.floor((1000 * seconds) / SHORTEST_FRAME)), FEWEST_FRAMES);
  const delay = Math.max(Math.round((1000 * seconds) / frames), SHORTEST_FRAME);
  const film = new Film(viewer, width);
  const { canvas, pen } = film;
  const pixels = (nth) => {
    film.paint(from + ((to - from) * nth) / frames);
    return pen.getImageData(0, 0, canvas.width, canvas.height).data;
  };
  try {
    // One palette for all frames, from four of them: with a new one each, still colours would flicker.
    const sample = [0, 1, 2, 3].flatMap((quarter) => thinned(pixels((quarter * frames) / 4)));
    const palette = quantize(new Uint8Array(sample), 256);
    const encoder = GIFEncoder();
    for (let nth = 0; nth < frames; nth++) {
      signal.throwIfAborted();
      const look = nth ? {} : { palette, repeat: 0 };
      encoder.writeFrame(applyPalette(pixels(nth), palette), canvas.width, canvas.height, { delay, ...look });
      progress((nth + 1) / frames);
      await pause();
    }
    encoder.finish();
    return { blob: new Blob([encoder.bytes()], { type: "image/gif" }), frames, width, height: canvas.height };
  } finally {
    film.end();
  }
}

// Every 13th pixel is enough for a palette.
function thinned(data) {
  const found = [];
  for (let at = 0; at < data.length; at += 4 * 13) found.push(data[at], data[at + 1], data[at + 2], 255);
  return found;
}

// Recorded while it plays, at the viewer's speed; whole beats for at least two seconds.
export async function video(viewer, width, { type }, progress, signal) {
  const { from, to, seconds } = beat(viewer);
  const whole = seconds * Math.ceil(SHORTEST_VIDEO / seconds);
  const film = new Film(viewer, width);
  try {
    film.paint(from);
    const recorder = new MediaRecorder(film.canvas.captureStream(), { mimeType: type, videoBitsPerSecond: 8e6 });
    const parts = [];
    recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
    const stopped = new Promise((done, fail) => {
      recorder.addEventListener("stop", done);
      recorder.addEventListener("error", (event) => fail(event.error));
    });
    recorder.start();
    const start = performance.now();
    for (let spent = 0; spent < whole && !signal.aborted; spent = 0.001 * (performance.now() - start)) {
      film.paint(from + ((spent / seconds) % 1) * (to - from));
      progress(spent / whole);
      await new Promise((done) => requestAnimationFrame(done));
    }
    recorder.stop();
    await stopped;
    signal.throwIfAborted();
    return { blob: new Blob(parts, { type: type.split(";")[0] }), seconds: whole, width, height: film.canvas.height };
  } finally {
    film.end();
  }
}
